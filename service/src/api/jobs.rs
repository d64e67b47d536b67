//! Jobs: the programs of a folder, or some, translated one after the other.
//!
//! ```text
//! POST   /api/v1/jobs              { "under": "plates", "to": "fanuc", … }
//! GET    /api/v1/jobs              the newest first
//! GET    /api/v1/jobs/ID           how far it is
//! GET    /api/v1/jobs/ID/results   what became of each program
//! GET    /api/v1/jobs/ID/events    the same as it comes (server-sent events)
//! DELETE /api/v1/jobs/ID           cancels it
//! ```

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::header::LOCATION;
use axum::http::{HeaderMap, StatusCode};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use utoipa::ToSchema;

use super::document::folder;
use super::programs::new_id;
use crate::Shared;
use crate::access::Caller;
use crate::http::body;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::{Job, TaskResult, Wanted};
use crate::translating::Asked;

/// Programs of a job at most.
const PROGRAMS: u32 = 100_000;

/// Interval of the events of a job.
const GLANCE: Duration = Duration::from_millis(200);

/// Group of the addresses in the description.
const TAG: &str = "jobs";

/// The programs of a job: a folder with its subfolders, a tag, a list, or a union of these. Its other fields are those of a
/// translation's request, but for `program` and `revision`.
#[derive(Debug, Default, Deserialize, ToSchema)]
#[schema(as = JobRequest)]
struct Which {
    /// A folder, with those below it; empty is all.
    under: Option<String>,
    tag: Option<String>,
    /// Names of programs.
    #[serde(default)]
    programs: Vec<String>,
}

/// A job.
#[derive(Clone, Debug, PartialEq, Serialize, ToSchema)]
#[schema(as = Job)]
struct JobDocument {
    /// Name in addresses.
    id: String,
    /// The request for each program, without its empty fields.
    #[schema(value_type = Object)]
    asked: Value,
    author: String,
    /// Its begin, UTC.
    #[schema(format = DateTime)]
    made: String,
    /// Its end, UTC.
    #[schema(format = DateTime)]
    ended: Option<String>,
    cancelled: bool,
    /// Number of tasks by state: `waiting`, `running`, `done`, `refused`, `cancelled`.
    tasks: BTreeMap<String, i64>,
}

/// A page of jobs.
#[derive(Debug, Serialize, ToSchema)]
struct Jobs {
    jobs: Vec<JobDocument>,
    /// Value of `before` for the next page.
    next: Option<String>,
}

/// A program of a job.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Task)]
struct TaskDocument {
    /// Counted from 1.
    number: i64,
    program: String,
    folder: String,
    name: String,
    revision: i64,
    /// `waiting`, `running`, `done`, `refused`, `cancelled`.
    state: String,
    /// The translation that was made.
    translation: Option<String>,
    /// Reason of a refusal: a problem document.
    #[schema(value_type = Option<Object>)]
    problem: Option<Value>,
}

/// A page of the programs of a job.
#[derive(Debug, Serialize, ToSchema)]
struct Results {
    results: Vec<TaskDocument>,
    /// Value of `after` for the next page.
    next: Option<i64>,
}

fn told(job: &Job) -> JobDocument {
    let asked: Value = serde_json::from_str(&job.asked).unwrap_or_default();
    JobDocument {
        id: job.id.clone(),
        asked: super::translations::short(&asked),
        author: job.author.clone(),
        made: http::moment(job.made),
        ended: job.ended.map(http::moment),
        cancelled: job.is_cancelled,
        tasks: job.counts.clone(),
    }
}

/// Splits a request into its programs and the request for each program.
fn taken_apart(mut object: Map<String, Value>) -> Result<(Which, Asked), Problem> {
    let mut which = Map::new();
    for name in ["under", "tag", "programs"] {
        which.extend(object.remove(name).map(|value| (name.to_owned(), value)));
    }
    for name in ["program", "revision"] {
        if object.contains_key(name) {
            return Err(Problem::content(format!(
                "a job has no `{name}`: it is about `programs`, or those `under` a folder"
            )));
        }
    }
    let form = |error: serde_json::Error| Problem::content(error.to_string());
    let which: Which = serde_json::from_value(which.into()).map_err(form)?;
    if which.under.is_none() && which.tag.is_none() && which.programs.is_empty() {
        return Err(Problem::content("it names no programs")
            .help("\"under\": FOLDER, \"tag\": TAG, or \"programs\": [ID, …]"));
    }
    folder(which.under.as_deref().unwrap_or_default())?;
    Ok((which, serde_json::from_value(object.into()).map_err(form)?))
}

/// Begins a job: programs are translated one after the other.
#[utoipa::path(post, path = "/api/v1/jobs", tag = TAG,
    request_body = Which,
    responses((status = 202, body = JobDocument, headers(("Location" = String)))))]
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may_somewhere(Act::Change)?;
    let (which, asked) = taken_apart(body::json(&headers, body)?)?;
    let (id, author) = (new_id()?, caller.name().to_owned());
    let place = format!("/api/v1/jobs/{id}");
    let job = shared
        .store(&caller, move |store| {
            let mut programs = Vec::new();
            for program in &which.programs {
                store.allows(Act::Change, program)?;
                programs.push((program.clone(), store.program(program)?.number));
            }
            if which.under.is_some() || which.tag.is_some() {
                // The top has all folders below it.
                let under = which.under.filter(|folder| !folder.is_empty());
                let wanted =
                    Wanted { under, tag: which.tag, most: PROGRAMS, act: Act::Change, ..Wanted::default() };
                programs.extend(store.programs(&wanted)?.into_iter().map(|own| (own.program, own.number)));
            }
            let asked = serde_json::to_string(&asked).unwrap_or_default();
            store.create_job(&id, &asked, &author, &programs)?;
            Ok(store.job(&id)?)
        })
        .await?;
    Ok((StatusCode::ACCEPTED, [(LOCATION, place)], http::json(&told(&job))).into_response())
}

/// Lists jobs, the newest first.
#[utoipa::path(get, path = "/api/v1/jobs", tag = TAG,
    params(
        ("before" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Jobs)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let before = query.one("before")?;
    let most = query.limit()?;
    query.end("before, limit")?;
    let jobs = shared.store(&caller, move |store| Ok(store.jobs(before.as_deref(), most)?)).await?;
    let next = jobs.last().filter(|_| jobs.len() == most as usize).map(|last| last.id.clone());
    Ok(http::json(&Jobs { jobs: jobs.iter().map(told).collect(), next }))
}

/// Gives the progress of a job.
#[utoipa::path(get, path = "/api/v1/jobs/{id}", tag = TAG,
    params(("id" = String, Path)),
    responses((status = 200, body = JobDocument)))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let job = shared.store(&caller, move |store| Ok(store.job(&id)?)).await?;
    Ok(http::json(&told(&job)))
}

/// Cancels a job: running tasks are stopped, and no further one begins.
#[utoipa::path(delete, path = "/api/v1/jobs/{id}", tag = TAG,
    params(("id" = String, Path)),
    responses((status = 200, body = JobDocument)))]
pub(super) async fn cancel(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let job = shared
        .store(&caller, move |store| {
            store.cancel(&id)?;
            Ok(store.job(&id)?)
        })
        .await?;
    Ok(http::json(&told(&job)))
}

/// Lists the programs of a job with their results.
#[utoipa::path(get, path = "/api/v1/jobs/{id}/results", tag = TAG,
    params(
        ("id" = String, Path),
        ("after" = Option<i64>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Results)))]
pub(super) async fn results(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let after = query.number("after")?.unwrap_or(0);
    let most = query.limit()?;
    query.end("after, limit")?;
    let all = shared.store(&caller, move |store| Ok(store.results(&id, after, most)?)).await?;
    let next = all.last().filter(|_| all.len() == most as usize).map(|last| last.number);
    let task = |of: &TaskResult| {
        let [folder, name] = &of.place;
        let result: Value = serde_json::from_str(&of.result).unwrap_or_default();
        TaskDocument {
            number: of.number,
            program: of.program.clone(),
            folder: folder.clone(),
            name: name.clone(),
            revision: of.revision,
            state: of.state.clone(),
            translation: result.get("translation").and_then(Value::as_str).map(str::to_owned),
            problem: result.get("problem").cloned(),
        }
    };
    Ok(http::json(&Results { results: all.iter().map(task).collect(), next }))
}

/// State of a reader of events.
struct Watching {
    shared: Arc<Shared>,
    caller: Caller,
    id: String,
    told: Option<JobDocument>,
    over: bool,
}

/// Gives the progress of a job as it goes on: server-sent events `progress`, and `end` at last.
#[utoipa::path(get, path = "/api/v1/jobs/{id}/events", tag = TAG,
    params(("id" = String, Path)),
    responses((status = 200, description = "Events, whose data is a job", content_type = "text/event-stream")))]
pub(super) async fn events(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let known = id.clone();
    shared.store(&caller, move |store| Ok(store.job(&known)?)).await?;
    let watching = Watching { shared, caller, id, told: None, over: false };
    let events = stream::unfold(watching, async |mut watching| {
        loop {
            if watching.over || ncc_exec::halt::is_asked() {
                return None;
            }
            let id = watching.id.clone();
            // A session that has ended meanwhile, and rights that were lost, end the events.
            let now = move |store: &crate::store::Store| Ok(store.renewed()?.job(&id)?);
            let job = watching.shared.store(&watching.caller, now).await.ok()?;
            let now = told(&job);
            watching.over = job.ended.is_some();
            if watching.told.as_ref() != Some(&now) {
                let name = if watching.over { "end" } else { "progress" };
                let event = Event::default().event(name).json_data(&now).ok()?;
                watching.told = Some(now);
                return Some((Ok::<_, Infallible>(event), watching));
            }
            tokio::time::sleep(GLANCE).await;
        }
    });
    Ok(Sse::new(events).keep_alive(KeepAlive::default()).into_response())
}
