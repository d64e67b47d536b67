//! What `ncc simulate` cannot show.

/// Why a program cannot be simulated, by its first move of that kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsimulated {
    /// It cuts while a rotary axis moves, or with the part turned by one.
    Rotary,
    /// It cuts without a tilted plane while the tool, or the part, is turned as one before has turned it.
    Leaning,
    /// It cuts on a tilted plane on which it has not turned the tool upright.
    Tilted,
    /// It cuts from a place that ncc does not know, as a plane has come or gone.
    Unplaced,
}
