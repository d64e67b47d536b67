//! The three services of the case study (Aguiar 2023, 3.2 to 3.4): TRANSPILER, PERSISTENCE and OUTPUT.
//!
//! ```text
//! POST   /transpiler/NAME?dialect=D&machine=M    a program in, its document stored      (table 6)
//! GET    /persistence/NAME                       the stored payload                     (table 7)
//! GET    /output/NAME?type=csv|cmf               an output of the stored document       (table 8)
//! ```
//!
//! The source says nothing of bodies, status codes, or lists; those are HTTP's (RFC 9110). Names are the key of a document,
//! so two programs of one name on two machines are one document: POST of the second one is refused with 409. Each service
//! can run alone, and then finds the store over HTTP (`remote`).

pub(crate) mod document;
mod output;
mod persistence;
mod remote;
mod shelf;
mod transpiler;

use std::sync::Arc;

use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::Shared;

pub(crate) use self::remote::Remote;
pub(crate) use self::shelf::Shelf;

/// Addresses of TRANSPILER.
pub(crate) fn transpiler() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new().routes(routes!(transpiler::list)).routes(routes!(
        transpiler::create,
        transpiler::read,
        transpiler::update,
        transpiler::delete
    ))
}

/// Addresses of PERSISTENCE.
pub(crate) fn persistence() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new().routes(routes!(persistence::list)).routes(routes!(
        persistence::create,
        persistence::read,
        persistence::update,
        persistence::delete
    ))
}

/// Addresses of OUTPUT.
pub(crate) fn output() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new().routes(routes!(output::read))
}
