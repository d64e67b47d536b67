//! Counters for Prometheus.
//!
//! | metric | labels |
//! |---|---|
//! | `ncc_requests_total` | method, route, status |
//! | `ncc_request_seconds` | method, route: until the head of the answer |
//! | `ncc_requests_running` | |
//! | `ncc_work_running`, `ncc_work_waiting` | pieces of work of the compiler |
//! | `ncc_tasks` | state: programs of jobs |
//! | `ncc_deliveries_total` | end: attempts of this process to tell a hook: delivered, failed, given-up |
//! | `ncc_build_info` | version |

use std::sync::Arc;
use std::time::Duration;

use axum::extract::{RawQuery, State};
use axum::http::Method;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::metrics::info::Info;
use prometheus_client::registry::Registry;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

use crate::Shared;
use crate::access::Caller;
use crate::http::Problem;
use crate::http::query::Query;
use crate::rights::Act;

/// The media type of OpenMetrics.
const MEDIA: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// Bounds of the times of requests, s.
const TIMES: [f64; 10] = [0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.5, 2.5, 30.0];

type Labels = Vec<(&'static str, String)>;
type Times = Family<Labels, Histogram, fn() -> Histogram>;

/// Counters of this process.
pub(crate) struct Counters {
    registry: Registry,
    requests: Family<Labels, Counter>,
    times: Times,
    running: Gauge,
    work_running: Gauge,
    work_waiting: Gauge,
    tasks: Family<Labels, Gauge>,
    deliveries: Family<Labels, Counter>,
}

/// Counts down when it is dropped: a request whose client has gone is running no more.
pub(super) struct Running(Gauge);

impl Drop for Running {
    fn drop(&mut self) {
        self.0.dec();
    }
}

impl Counters {
    /// Counters that begin at 0.
    pub(crate) fn new() -> Counters {
        let mut registry = Registry::with_prefix("ncc");
        let requests = Family::default();
        let times = Times::new_with_constructor(|| Histogram::new(TIMES));
        let [running, work_running, work_waiting] = [(); 3].map(|()| Gauge::default());
        let tasks = Family::default();
        let deliveries = Family::default();
        registry.register("requests", "Requests that were answered", requests.clone());
        registry.register("request_seconds", "Time until the head of the answer", times.clone());
        registry.register("requests_running", "Requests that are being answered", running.clone());
        registry.register("work_running", "Pieces of work of the compiler that run", work_running.clone());
        registry.register("work_waiting", "Pieces of work of the compiler that wait", work_waiting.clone());
        registry.register("tasks", "Programs of jobs", tasks.clone());
        registry.register("deliveries", "Attempts to tell a hook of an event", deliveries.clone());
        registry.register("build", "This ncc", Info::new(vec![("version", env!("CARGO_PKG_VERSION"))]));
        Counters { registry, requests, times, running, work_running, work_waiting, tasks, deliveries }
    }

    /// A request begins.
    pub(super) fn begin(&self) -> Running {
        self.running.inc();
        Running(self.running.clone())
    }

    /// A request has been answered. A route has the names of its parts, not their values: so there are few of them.
    pub(super) fn count(&self, method: &Method, route: Option<&str>, status: u16, took: Duration) {
        let known = [Method::GET, Method::PUT, Method::POST, Method::PATCH, Method::DELETE, Method::HEAD];
        let method = if known.contains(method) { method.as_str() } else { "other" };
        let of = || vec![("method", method.to_owned()), ("route", route.unwrap_or("none").to_owned())];
        let with_status = of().into_iter().chain([("status", status.to_string())]).collect();
        self.requests.get_or_create(&with_status).inc();
        self.times.get_or_create(&of()).observe(took.as_secs_f64());
    }

    /// An attempt to tell a hook has ended.
    pub(crate) fn count_delivery(&self, end: &'static str) {
        self.deliveries.get_or_create(&vec![("end", end.to_owned())]).inc();
    }
}

/// Address of the counters.
pub(crate) fn routes() -> OpenApiRouter<Arc<Shared>> {
    OpenApiRouter::new().routes(routes!(read))
}

/// Gives the counters of this process (OpenMetrics).
#[utoipa::path(get, path = "/metrics", tag = "service",
    responses((status = 200, body = String, content_type = "application/openmetrics-text")))]
async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Read, "")?;
    let counters = &shared.counters;
    let [running, waiting] = shared.pool.load().map(|count| i64::try_from(count).unwrap_or(i64::MAX));
    counters.work_running.set(running);
    counters.work_waiting.set(waiting);
    if shared.own.is_some() {
        let counts = shared.store(&caller, |store| Ok(store.tasks_by_state()?)).await?;
        counters.tasks.clear();
        for (state, count) in counts {
            counters.tasks.get_or_create(&vec![("state", state)]).set(count);
        }
    }
    let mut text = String::new();
    encode(&mut text, &counters.registry).map_err(|_| Problem::fault())?;
    Ok(([(CONTENT_TYPE, MEDIA)], text).into_response())
}
