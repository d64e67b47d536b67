//! Rounded and chamfered corners, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Rounded and chamfered corners that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CornersLack {
        /// A rounded or chamfered corner.
        Corner,
        /// A corner beside blocks with block skip.
        BesideSkippedBlock,
        /// A corner between moves whose places are known only when the program runs.
        PlacesAtRunTime,
    }
}
