//! What is compared of how corners are taken.

/// What of corners two dialects both have words for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Corners {
    All,
    /// Going through one is said as a stop.
    StopOrRounded,
    Nothing,
}

impl Corners {
    /// Of two dialects.
    pub fn between(a: &str, b: &str) -> Corners {
        match [a, b] {
            // Its corners are always rounded, and it has no words for it.
            pair if pair.iter().any(|d| matches!(*d, "mach9" | "grbl" | "grblhal")) => Corners::Nothing,
            pair if pair.iter().any(|d| matches!(*d, "fanuc" | "haas" | "siemens" | "mach3")) => {
                Corners::StopOrRounded
            }
            _ => Corners::All,
        }
    }
}
