//! The log: one line for each request, on stderr.

use std::io;
use std::sync::Arc;
use std::time::Instant;

use axum::extract::{MatchedPath, Request, State};
use axum::http::HeaderValue;
use axum::middleware::Next;
use axum::response::Response;
use tracing::level_filters::LevelFilter;

use super::counters::Counters;
use super::names::{HEADER, RequestName};

/// The amount of the log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Level {
    /// Faults of the service.
    #[default]
    Faults,
    /// Requests too.
    Requests,
}

/// The form of the log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Lines for people.
    #[default]
    Text,
    /// A JSON object a line.
    Json,
}

/// Writes the log of this process to stderr from now on. A second call has no effect.
pub fn log(level: Level, form: Form) {
    let most = match level {
        Level::Faults => LevelFilter::WARN,
        Level::Requests => LevelFilter::INFO,
    };
    let lines = tracing_subscriber::fmt().with_max_level(most).with_writer(io::stderr).with_target(false);
    // A log that is there already stays.
    let _ = match form {
        Form::Text => lines.with_ansi(false).try_init(),
        Form::Json => lines.json().flatten_event(true).try_init(),
    };
}

/// Names a request, counts it, and writes its line.
pub(crate) async fn pass(
    State(counters): State<Arc<Counters>>,
    mut request: Request,
    next: Next,
) -> Response {
    let name = RequestName::of(request.headers());
    request.extensions_mut().insert(name.clone());
    let method = request.method().clone();
    let path = request.uri().path().to_owned();
    let route = request.extensions().get::<MatchedPath>().map(|route| route.as_str().to_owned());
    let running = counters.begin();
    let begin = Instant::now();
    let mut answer = next.run(request).await;
    let (status, took) = (answer.status().as_u16(), begin.elapsed());
    drop(running);
    counters.count(&method, route.as_deref(), status, took);
    if let Ok(value) = HeaderValue::from_str(name.text()) {
        answer.headers_mut().insert(HEADER, value);
    }
    let milliseconds = took.as_secs_f64() * 1e3;
    tracing::info!(request = name.text(), %method, path, status, milliseconds);
    answer
}
