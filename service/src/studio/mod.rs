//! The studio's page and its engines.
//!
//! ```text
//! GET    /                                   the page; its files beside it
//! PUT    /api/v1/engine/ROOM                 a room with an engine, empty
//! DELETE /api/v1/engine/ROOM                 lets go of it
//! PUT    /api/v1/engine/ROOM/files/NAME      a file for the engine of that room
//! PUT    /api/v1/engine/ROOM/called/ID       the programs in the folder of a stored program, which it may call
//! POST   /api/v1/engine/ROOM/run             a request; the answer is a line of JSON, then the outputs
//! ```
//!
//! Not here: the page (`ncc_studio`), the engine (`ncc_engine`).

mod page;
mod rooms;
mod work;

use std::sync::Arc;

use axum::routing::{post, put};
use utoipa_axum::router::OpenApiRouter;

use crate::Shared;

pub(crate) use self::page::open;
pub(crate) use self::rooms::Rooms;

/// Addresses of the page and of its engines. They are a matter between the page and its server, and not in the description
/// of the addresses for others.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::from(page::routes())
        .route("/api/v1/engine/{room}", put(work::open).delete(work::close))
        .route("/api/v1/engine/{room}/files/{name}", put(work::keep))
        .route("/api/v1/engine/{room}/called/{program}", put(work::called))
        .route("/api/v1/engine/{room}/run", post(work::run))
}
