//! Programs of a shop, their revisions, their translations ([`translations`], [`states`]), and jobs over many of them ([`jobs`]).
//!
//! ```text
//! POST   /api/v1/programs?folder=F&name=N       a new program; the body is its text
//! GET    /api/v1/programs                       programs by folder, name, tag, dialect, machine
//! GET    /api/v1/programs/ID                    what is known of one
//! PATCH  /api/v1/programs/ID                    its folder, name, tags, dialect, machine
//! DELETE /api/v1/programs/ID                    its revisions stay
//! GET    /api/v1/programs/ID/text, PUT          its text
//! GET    /api/v1/programs/ID/revisions          its history, the newest first
//! GET    /api/v1/programs/ID/revisions/N        what was known of it then
//! GET    /api/v1/programs/ID/revisions/N/text   its text then
//! POST   /api/v1/programs/ID/revisions/N/restore
//! GET    /api/v1/programs/ID/outputs/WHAT       times, tools, checks ([`outputs`])
//! ```
//!
//! Every change makes a revision, so nothing is overwritten. The tag of a program is the number of its revision.

mod document;
mod jobs;
mod outputs;
mod programs;
mod revisions;
mod states;
mod texts;
mod translations;

use std::sync::Arc;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::routing::{get, post};

use crate::Shared;

pub(crate) use self::programs::new_id;

/// Addresses of programs, translations and jobs.
pub(crate) fn routes() -> Router<Arc<Shared>> {
    Router::new()
        .route("/api/v1/programs", get(programs::list).post(programs::create))
        .route("/api/v1/programs/{id}", get(programs::read).patch(programs::change).delete(programs::delete))
        .route("/api/v1/programs/{id}/text", get(texts::read).put(texts::change))
        .route("/api/v1/programs/{id}/revisions", get(revisions::list))
        .route("/api/v1/programs/{id}/revisions/{number}", get(revisions::read))
        .route("/api/v1/programs/{id}/revisions/{number}/text", get(texts::read_revision))
        .route("/api/v1/programs/{id}/revisions/{number}/restore", post(revisions::restore))
        .route("/api/v1/programs/{id}/outputs/{what}", get(outputs::read))
        .route("/api/v1/translations", get(translations::list).post(translations::create))
        .route("/api/v1/translations/{id}", get(translations::read))
        .route("/api/v1/translations/{id}/states", get(states::list).post(states::step))
        .route("/api/v1/translations/{id}/{what}", get(translations::outcome))
        .route("/api/v1/jobs", get(jobs::list).post(jobs::create))
        .route("/api/v1/jobs/{id}", get(jobs::read).delete(jobs::cancel))
        .route("/api/v1/jobs/{id}/results", get(jobs::results))
        .route("/api/v1/jobs/{id}/events", get(jobs::events))
        // Texts come in pieces, and are counted as they come.
        .layer(DefaultBodyLimit::disable())
}
