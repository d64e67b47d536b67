//! Texts of a shop that programs depend on: profiles of its machines, and dictionaries of its dialects. Every change of one is
//! a revision, and nothing is overwritten.
//!
//! ```text
//! GET    /api/v1/machines         all of them; likewise /api/v1/dialects
//! GET    /api/v1/machines/NAME    a text, as its owner wrote it
//! PUT    /api/v1/machines/NAME    a text
//! DELETE /api/v1/machines/NAME
//! GET    /api/v1/machines/NAME/revisions           its history
//! GET    /api/v1/machines/NAME/revisions/N         the text then
//! POST   /api/v1/machines/NAME/revisions/N/restore
//! ```
//!
//! `machines` and `dialects` have the addresses, `texts` and `revisions` the work that they have in common, `fits` the
//! conditions of each sort, and `known` makes them known to the compiler.

mod dialects;
mod fits;
mod known;
mod machines;
mod revisions;
mod texts;

use std::sync::Arc;

use utoipa_axum::router::OpenApiRouter;

use crate::Shared;

pub(crate) use self::known::{dialects, dictionary, named, of_texts, profile, stated_dialect};

/// Addresses of machines and dialects.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    machines::routes().merge(dialects::routes())
}
