//! What passes share: walking a body, known facts, needs, writing.

pub mod known_facts;
pub(crate) mod needs;
pub(crate) mod shared_map;
pub(crate) mod walk;
pub(crate) mod write;
