//! Description of all addresses (OpenAPI 3.1), made of the handlers, and a page to try them.
//!
//! ```text
//! GET /api/v1/openapi.json
//! GET /api/v1/docs/
//! ```
//!
//! Every address has errors of one form, so they are added here and not at each handler.

use std::sync::Arc;

use axum::http::HeaderValue;
use axum::http::header::CONTENT_SECURITY_POLICY;
use axum::response::Response;
use axum::routing::get;
use axum::{Router, middleware};
use utoipa::openapi::path::Operation;
use utoipa::openapi::security::{
    ApiKey, ApiKeyValue, HttpAuthScheme, HttpBuilder, SecurityRequirement, SecurityScheme,
};
use utoipa::openapi::{ContentBuilder, OpenApi, Ref, RefOr, Required, ResponseBuilder};
use utoipa::{PartialSchema, ToSchema};
use utoipa_axum::router::OpenApiRouter;
use utoipa_swagger_ui::{Config, SwaggerUi};

use super::json;
use super::problem::{Body, MEDIA};
use crate::Shared;

/// Address of the description.
const DESCRIPTION: &str = "/api/v1/openapi.json";

/// Address of the page.
const PAGE: &str = "/api/v1/docs";

/// Rights of the page: its own scripts, and styles that its scripts write.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; \
                      connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

/// Routes of the description and its page, which hold nothing of a user.
pub(crate) fn open() -> impl Iterator<Item = String> {
    let page = ["", "/", "/{*rest}"].map(|rest| format!("{PAGE}{rest}"));
    page.into_iter().chain([DESCRIPTION.to_owned()])
}

/// The routes of some addresses, with the description of all of them and the page.
pub(crate) fn described(addresses: OpenApiRouter<Arc<Shared>>) -> Router<Arc<Shared>> {
    let (routes, mut of) = addresses.split_for_parts();
    describe(&mut of);
    let page = SwaggerUi::new(PAGE).config(Config::from(DESCRIPTION).validator_url("none"));
    let page = Router::<()>::from(page).layer(middleware::map_response(with_policy));
    routes.merge(page.with_state(())).route(DESCRIPTION, get(move || async move { json(&of) }))
}

async fn with_policy(mut answer: Response) -> Response {
    answer.headers_mut().insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
    answer
}

/// Adds the parts that all addresses share.
fn describe(of: &mut OpenApi) {
    of.info.title = "ncc".to_owned();
    of.info.version = env!("CARGO_PKG_VERSION").to_owned();
    of.info.description = Some(
        "Programs of machines, their revisions, translations and outputs. Lengths are in mm, times in s, feeds in mm/min."
            .to_owned(),
    );
    of.info.contact = None;
    let name = Body::name();
    let problem = ContentBuilder::new().schema(Some(Ref::from_schema_name(&*name))).build();
    let error = ResponseBuilder::new().description("An error (RFC 9457)").content(MEDIA, problem).build();
    let components = of.components.get_or_insert_default();
    components.schemas.insert(name.into_owned(), Body::schema());
    let cookie = ApiKeyValue::with_description("ncc_session", "The cookie of `POST /api/v1/session`");
    let token =
        HttpBuilder::new().scheme(HttpAuthScheme::Bearer).description(Some("Of `POST /api/v1/tokens`"));
    components.security_schemes.insert("token".to_owned(), SecurityScheme::Http(token.build()).into());
    components
        .security_schemes
        .insert("session".to_owned(), SecurityScheme::ApiKey(ApiKey::Cookie(cookie)).into());
    // Without accounts neither is needed.
    let none = SecurityRequirement::default();
    let [token, session] =
        ["token", "session"].map(|name| SecurityRequirement::new::<_, [&str; 0], _>(name, []));
    of.security = Some(vec![none, token, session]);
    for operation in of.paths.paths.values_mut().flat_map(operations) {
        operation.responses.responses.insert("default".to_owned(), RefOr::T(error.clone()));
        // An empty body is an empty text.
        if let Some(RefOr::T(body)) = operation.request_body.as_mut()
            && body.content.contains_key("text/plain")
        {
            body.required = Some(Required::False);
        }
    }
}

/// Operations of a path.
fn operations(of: &mut utoipa::openapi::PathItem) -> impl Iterator<Item = &mut Operation> {
    [&mut of.get, &mut of.put, &mut of.post, &mut of.delete, &mut of.patch].into_iter().flatten()
}
