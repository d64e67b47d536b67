//! Errors as documents by RFC 9457: `application/problem+json`.

use axum::http::header::{CONTENT_TYPE, RETRY_AFTER, WWW_AUTHENTICATE};
use axum::http::{HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

use crate::store::StoreError;
use crate::work::NotDone;

/// The media type.
pub(crate) const MEDIA: &str = "application/problem+json";

/// An error with its reason and help.
#[derive(Clone, Debug)]
pub(crate) struct Problem(Box<Body>);

#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = Problem)]
pub(crate) struct Body {
    /// The name of its kind.
    #[serde(rename = "type")]
    kind: String,
    /// The same in words.
    title: &'static str,
    status: u16,
    /// The error in this request.
    detail: String,
    /// Actions of the user.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    help: Vec<String>,
    /// Diagnostics of the program, each as a line of `ncc --format json`.
    #[serde(skip_serializing_if = "Option::is_none")]
    diagnostics: Option<Value>,
    /// Questions that are open, with their answers.
    #[serde(skip_serializing_if = "Option::is_none")]
    questions: Option<Value>,
    /// The same as the command line prints it.
    #[serde(skip_serializing_if = "Option::is_none")]
    messages: Option<String>,
    #[serde(skip)]
    retry_after: Option<u32>,
}

/// A kind of problem: its name, its status, and its words.
type Kind = (&'static str, StatusCode, &'static str);

const ABSENT: Kind = ("absent", StatusCode::NOT_FOUND, "nothing is kept under this name");
const EXISTS: Kind = ("exists", StatusCode::CONFLICT, "the name is taken");
const CONFLICT: Kind = ("conflict", StatusCode::CONFLICT, "this cannot be done now");
const CHANGED: Kind = ("changed", StatusCode::PRECONDITION_FAILED, "it is not what you have read");
const REQUEST: Kind = ("request", StatusCode::BAD_REQUEST, "the request is not of the form");
const MEDIA_TYPE: Kind = ("media-type", StatusCode::UNSUPPORTED_MEDIA_TYPE, "the body is of another type");
const TOO_SLOW: Kind = ("too-slow", StatusCode::REQUEST_TIMEOUT, "the body came too slowly");
const TOO_LARGE: Kind = ("too-large", StatusCode::PAYLOAD_TOO_LARGE, "the body is too large");
const REFUSED: Kind = ("refused", StatusCode::UNPROCESSABLE_ENTITY, "the program is refused");
const CONTENT: Kind = ("content", StatusCode::UNPROCESSABLE_ENTITY, "the body cannot be used");
const NOT_MADE: Kind = ("not-made", StatusCode::UNPROCESSABLE_ENTITY, "this output cannot be made");
const TOO_LONG: Kind = ("too-long", StatusCode::UNPROCESSABLE_ENTITY, "the program takes too long");
const STRANGER: Kind = ("stranger", StatusCode::FORBIDDEN, "the request is not meant for this server");
const FORBIDDEN: Kind = ("forbidden", StatusCode::FORBIDDEN, "you have no right to this");
const LOGIN: Kind = ("login-needed", StatusCode::UNAUTHORIZED, "a login is needed");
const TOO_MANY: Kind = ("too-many", StatusCode::TOO_MANY_REQUESTS, "too many requests");
const METHOD: Kind = ("method", StatusCode::METHOD_NOT_ALLOWED, "the address does not take this method");
const REUSED: Kind = ("reused", StatusCode::UNPROCESSABLE_ENTITY, "the key was used for another request");
const FULL: Kind = ("full", StatusCode::INSUFFICIENT_STORAGE, "the disk is full");
const BUSY: Kind = ("busy", StatusCode::SERVICE_UNAVAILABLE, "too much is asked at once");
const OTHER: Kind =
    ("other-service", StatusCode::BAD_GATEWAY, "another service does not answer as it should");
const FAULT: Kind = ("fault", StatusCode::INTERNAL_SERVER_ERROR, "a fault of the service");

impl Problem {
    fn of((name, status, title): Kind, detail: impl Into<String>) -> Problem {
        Problem(Box::new(Body {
            kind: format!("urn:ncc:problem:{name}"),
            title,
            status: status.as_u16(),
            detail: detail.into(),
            help: Vec::new(),
            diagnostics: None,
            questions: None,
            messages: None,
            retry_after: (status == StatusCode::SERVICE_UNAVAILABLE).then_some(1),
        }))
    }

    /// With what is wrong with a program or a profile.
    fn found(mut self, diagnostics: Option<Value>) -> Problem {
        self.0.diagnostics = diagnostics;
        self
    }

    /// With what to do.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Problem {
        self.0.help.push(help.into());
        self
    }

    /// The first action of the user.
    pub(crate) fn first_help(&self) -> Option<&str> {
        self.0.help.first().map(String::as_str)
    }

    /// The error in one line.
    pub(crate) fn detail(&self) -> &str {
        &self.0.detail
    }

    /// All of it, as it is told.
    pub(crate) fn body(&self) -> Value {
        serde_json::to_value(&self.0).unwrap_or_default()
    }

    /// With questions that are open.
    pub(crate) fn asking(mut self, questions: Option<Value>) -> Problem {
        self.0.questions = questions;
        self
    }

    /// Whether the request is not of the form.
    pub(crate) fn is_request(&self) -> bool {
        self.0.status == StatusCode::BAD_REQUEST.as_u16()
    }

    /// Whether the service could not do its part: the same may be done later.
    pub(crate) fn is_of_the_service(&self) -> bool {
        self.0.status >= StatusCode::INTERNAL_SERVER_ERROR.as_u16()
    }

    /// Nothing is kept under a name.
    pub(crate) fn absent(detail: impl Into<String>) -> Problem {
        Problem::of(ABSENT, detail)
    }

    /// Whether nothing is kept under the name.
    pub(crate) fn is_absent(&self) -> bool {
        self.0.status == StatusCode::NOT_FOUND.as_u16()
    }

    /// The request is not of the form.
    pub(crate) fn request(detail: impl Into<String>) -> Problem {
        Problem::of(REQUEST, detail)
    }

    /// The body is of another type than it should be.
    pub(crate) fn media(takes: &str) -> Problem {
        Problem::of(MEDIA_TYPE, format!("it takes {takes}")).help(format!("Content-Type: {takes}"))
    }

    /// The body is too large.
    pub(crate) fn too_large(most: u64) -> Problem {
        Problem::of(TOO_LARGE, format!("it takes {most} bytes at most"))
    }

    /// The body is compressed.
    pub(crate) fn encoding() -> Problem {
        Problem::of(MEDIA_TYPE, "it takes no Content-Encoding").help("send the body as it is")
    }

    /// The body did not come in time.
    pub(crate) fn too_slow() -> Problem {
        Problem::of(TOO_SLOW, "its time was over before its end")
    }

    /// Too much is asked at once.
    pub(crate) fn busy(detail: &str) -> Problem {
        Problem::of(BUSY, detail).help("ask again later")
    }

    /// The body is not what it should be.
    pub(crate) fn content(detail: impl Into<String>) -> Problem {
        Problem::of(CONTENT, detail)
    }

    /// The program is refused: what was found, as JSON and as the command line prints it.
    pub(crate) fn refused(
        detail: impl Into<String>,
        diagnostics: Option<Value>,
        messages: String,
    ) -> Problem {
        let mut refused = Problem::of(REFUSED, detail).found(diagnostics);
        refused.0.messages = Some(messages).filter(|text| !text.is_empty());
        refused
    }

    /// The output cannot be made of what is stored.
    pub(crate) fn not_made(detail: impl Into<String>, diagnostics: Option<Value>) -> Problem {
        Problem::of(NOT_MADE, detail).found(diagnostics)
    }

    /// The body has faults, each with its place.
    pub(crate) fn faulty(detail: impl Into<String>, diagnostics: Value) -> Problem {
        Problem::of(CONTENT, detail).found(Some(diagnostics))
    }

    /// The stored state does not allow the request now.
    pub(crate) fn conflict(detail: impl Into<String>) -> Problem {
        Problem::of(CONFLICT, detail)
    }

    /// The name is taken.
    pub(crate) fn exists(detail: impl Into<String>) -> Problem {
        Problem::of(EXISTS, detail)
    }

    /// The request is not meant for this server.
    pub(crate) fn stranger() -> Problem {
        Problem::of(STRANGER, "its Host or its Origin is another one")
    }

    /// The user has no right to this.
    pub(crate) fn forbidden(detail: impl Into<String>) -> Problem {
        Problem::of(FORBIDDEN, detail)
    }

    /// The request has neither a session nor a token, or one that is over.
    pub(crate) fn login_needed() -> Problem {
        Problem::of(LOGIN, "it has neither a session nor a token that holds")
            .help("POST /api/v1/session begins a session; programs send Authorization: Bearer TOKEN")
    }

    /// The account is not there, or its password is another one.
    pub(crate) fn wrong_login() -> Problem {
        Problem::of(LOGIN, "the user or the password is wrong")
    }

    /// A request of a session without the value that a page of another server does not have.
    pub(crate) fn forged() -> Problem {
        Problem::of(FORBIDDEN, "the header X-NCC-CSRF is not that of the session")
            .help("GET /api/v1/session has its value: csrf")
    }

    /// A user asks too often.
    pub(crate) fn too_many(wait: std::time::Duration) -> Problem {
        let mut problem = Problem::of(TOO_MANY, "wait as long as Retry-After says");
        problem.0.retry_after = Some(u32::try_from(wait.as_secs()).unwrap_or(u32::MAX).saturating_add(1));
        problem
    }

    /// The address does not take the method.
    pub(crate) fn method() -> Problem {
        Problem::of(METHOD, "the Allow header lists those that it takes")
    }

    /// There is no such address.
    pub(crate) fn no_address() -> Problem {
        Problem::absent("there is no such address")
    }

    /// Another service cannot be reached, or answers with something else.
    pub(crate) fn other_service(detail: impl Into<String>) -> Problem {
        Problem::of(OTHER, detail)
    }

    /// A fault of the service; what it was is written to its log.
    pub(crate) fn fault() -> Problem {
        Problem::of(FAULT, "the log of the service tells more")
    }

    /// Of work that was not done within its limits.
    pub(crate) fn of_work(not: NotDone, limit: std::time::Duration) -> Problem {
        match not {
            NotDone::Busy => Problem::busy("all places of the queue are taken"),
            NotDone::TooLong => {
                Problem::of(TOO_LONG, format!("it was stopped after {} s", limit.as_secs_f64()))
            }
            NotDone::Broken => Problem::fault(),
        }
    }

    /// The same problem of another service, as it was told.
    pub(crate) fn passed_on(status: StatusCode, body: Value) -> Problem {
        let kind = [ABSENT, EXISTS, CHANGED, TOO_LARGE, CONTENT, FULL, BUSY, LOGIN, FORBIDDEN, TOO_MANY]
            .into_iter()
            .find(|kind| kind.1 == status)
            .unwrap_or(OTHER);
        let detail = body.get("detail").and_then(Value::as_str).unwrap_or("it gives no reason").to_owned();
        Problem::of(kind, detail)
    }
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Problem {
        match error {
            StoreError::Absent => Problem::of(ABSENT, "there is none"),
            StoreError::Exists => Problem::of(EXISTS, "POST makes new ones only").help("PUT replaces it"),
            StoreError::Changed => {
                Problem::of(CHANGED, "another request has changed it").help("read it again")
            }
            StoreError::Forbidden => Problem::forbidden("your rights do not include this"),
            StoreError::LastAdmin => Problem::conflict("nobody could administer the service any more")
                .help("one account that is not disabled has the role `admin` in the folder \"\""),
            StoreError::Reused => {
                Problem::of(REUSED, "Idempotency-Key").help("give each request a key of its own")
            }
            StoreError::TooMany => Problem::conflict("there are as many as there may be").help("delete one"),
            StoreError::Full => Problem::of(FULL, "nothing was changed"),
            StoreError::Busy => Problem::busy("the database is taken by others"),
            StoreError::Database(words) => {
                crate::observe::fault(&words);
                Problem::fault()
            }
        }
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.0.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut body = serde_json::to_vec_pretty(&self.0).unwrap_or_default();
        body.push(b'\n');
        let mut answer = (status, [(CONTENT_TYPE, MEDIA)], body).into_response();
        if let Some(seconds) = self.0.retry_after {
            answer.headers_mut().insert(RETRY_AFTER, HeaderValue::from(seconds));
        }
        if status == StatusCode::UNAUTHORIZED {
            answer.headers_mut().insert(WWW_AUTHENTICATE, HeaderValue::from_static("Bearer realm=\"ncc\""));
        }
        answer
    }
}
