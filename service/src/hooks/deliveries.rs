//! Deliveries of a hook, for admins.
//!
//! ```text
//! GET  /api/v1/hooks/ID/deliveries             the newest first: before, limit
//! POST /api/v1/hooks/ID/deliveries/DELIVERY    sends it again, under the same name
//! ```

use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use super::TAG;
use crate::Shared;
use crate::access::Caller;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::{Delivery, StoreError};

/// A delivery.
#[derive(Serialize, ToSchema)]
#[schema(as = Delivery)]
struct DeliveryDocument {
    /// Name in addresses, and of the message: `webhook-id`.
    id: String,
    /// `release`, `stale`, `job`.
    event: String,
    /// The name of the translation or the job.
    subject: String,
    /// Time of the event, UTC.
    #[schema(format = DateTime)]
    moment: String,
    /// `waiting` before the first attempt, `sending`, `failed` until the next one, `delivered`, `given-up`.
    state: String,
    /// Attempts that have begun.
    attempts: i64,
    /// Time of the next attempt, UTC.
    #[schema(format = DateTime)]
    next: Option<String>,
    /// Status of the last answer.
    status: Option<i64>,
    /// Reason why there was no answer.
    reason: Option<String>,
    /// Time of its end, UTC.
    #[schema(format = DateTime)]
    ended: Option<String>,
}

/// A page of deliveries.
#[derive(Serialize, ToSchema)]
struct Deliveries {
    deliveries: Vec<DeliveryDocument>,
    /// Value of `before` for the next page.
    next: Option<i64>,
}

fn told(own: Delivery) -> DeliveryDocument {
    DeliveryDocument {
        id: own.id,
        event: own.event,
        subject: own.subject,
        moment: http::moment(own.moment),
        state: own.state,
        attempts: own.attempts,
        next: own.next.map(http::moment),
        status: own.status,
        reason: Some(own.reason).filter(|reason| !reason.is_empty()),
        ended: own.ended.map(http::moment),
    }
}

/// Lists the deliveries of a hook, the newest first.
#[utoipa::path(get, path = "/api/v1/hooks/{id}/deliveries", tag = TAG,
    params(
        ("id" = String, Path),
        ("before" = Option<i64>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Deliveries)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    caller.may(Act::Administer, "")?;
    let mut query = Query::of(query.as_deref());
    let before = query.number("before")?.unwrap_or(i64::MAX);
    let most = query.limit()?;
    query.end("before, limit")?;
    let all = shared.store(&caller, move |store| Ok(store.deliveries(&id, before, most)?)).await?;
    let next = all.last().filter(|_| all.len() == most as usize).map(|last| last.number);
    Ok(http::json(&Deliveries { deliveries: all.into_iter().map(told).collect(), next }))
}

/// Sends a delivery again, under the same name.
#[utoipa::path(post, path = "/api/v1/hooks/{id}/deliveries/{delivery}", tag = TAG,
    params(("id" = String, Path), ("delivery" = String, Path)),
    responses((status = 202, body = DeliveryDocument)))]
pub(super) async fn again(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path((id, delivery)): Path<(String, String)>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    caller.may(Act::Administer, "")?;
    let again = shared
        .store(&caller, move |store| {
            store.send_again(&id, &delivery).map_err(|error| match error {
                StoreError::Changed => Problem::conflict("it is being sent, or its hook is stopped")
                    .help("make another hook where its receiver has stopped this one with 410"),
                error => error.into(),
            })
        })
        .await?;
    Ok((StatusCode::ACCEPTED, http::json(&told(again))).into_response())
}
