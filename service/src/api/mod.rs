//! Programs of a shop, their revisions, their translations ([`translations`], [`states`]), and jobs over many of them ([`jobs`]).
//!
//! ```text
//! POST   /api/v1/programs?folder=F&name=N       a new program; the body is its text
//! GET    /api/v1/programs                       programs by folder, name, tag, dialect, machine
//! GET    /api/v1/folders                        folders, each with the number of its programs
//! GET    /api/v1/programs/ID                    what is known of one
//! PATCH  /api/v1/programs/ID                    its folder, name, tags, dialect, machine
//! DELETE /api/v1/programs/ID                    its revisions stay
//! GET    /api/v1/programs/ID/text, PUT          its text
//! GET    /api/v1/programs/ID/revisions          its history, the newest first
//! GET    /api/v1/programs/ID/revisions/N        what was known of it then
//! GET    /api/v1/programs/ID/revisions/N/text   its text then
//! POST   /api/v1/programs/ID/revisions/N/restore
//! GET    /api/v1/programs/ID/outputs/WHAT       times, tools, checks, pictures, a setup sheet ([`outputs`])
//! GET    /api/v1/programs/ID/comparison         two revisions by their motion ([`comparison`])
//! GET    /api/v1/programs/ID/facts              what it does, as it is searched by
//! GET    /api/v1/search                         programs by what they say and do ([`search`])
//! ```
//!
//! Every change makes a revision, so nothing is overwritten. The tag of a program is the number of its revision.

mod comparison;
mod document;
mod executed;
mod folders;
mod jobs;
mod operations;
mod outputs;
mod page;
mod programs;
mod revisions;
mod search;
mod sheet;
mod states;
mod texts;
mod translations;

use std::sync::Arc;

use axum::extract::DefaultBodyLimit;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::Shared;

pub(crate) use self::comparison::compare;
pub(crate) use self::document::{fits, folder as folder_fits, number as revision_number};
pub(crate) use self::programs::new_id;

/// Addresses of programs, translations and jobs.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new()
        .routes(routes!(programs::list, programs::create))
        .routes(routes!(folders::list))
        .routes(routes!(programs::read, programs::change, programs::delete))
        .routes(routes!(texts::read, texts::change))
        .routes(routes!(revisions::list))
        .routes(routes!(revisions::read))
        .routes(routes!(texts::read_revision))
        .routes(routes!(revisions::restore))
        .routes(routes!(outputs::read))
        .routes(routes!(comparison::read))
        .routes(routes!(search::facts))
        .routes(routes!(search::search))
        .routes(routes!(translations::list, translations::create))
        .routes(routes!(translations::read))
        .routes(routes!(states::list, states::step))
        .routes(routes!(translations::outcome))
        .routes(routes!(jobs::list, jobs::create))
        .routes(routes!(jobs::read, jobs::cancel))
        .routes(routes!(jobs::results))
        .routes(routes!(jobs::events))
        // Texts come in pieces, and are counted as they come.
        .layer(DefaultBodyLimit::disable())
}
