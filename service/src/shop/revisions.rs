//! The history of a text.

use axum::http::StatusCode;
use axum::http::header::{ETAG, LOCATION};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use utoipa::ToSchema;

use super::fits::fits;
use super::texts::{Asked, told};
use crate::Shared;
use crate::access::Caller;
use crate::api::revision_number;
use crate::http::body;
use crate::http::conditions::{etag, expected, is_known, not_modified};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::{ShopRevision, Sort};

/// A revision of a text.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = TextRevision)]
struct Revision {
    /// Its number, from 1.
    number: i64,
    /// The text was deleted.
    deleted: bool,
    /// The account that made it; empty of profiles that are older than their revisions.
    author: String,
    /// Its time, UTC.
    #[schema(format = DateTime)]
    made: String,
}

/// A page of revisions.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = TextRevisions)]
pub(super) struct Revisions {
    revisions: Vec<Revision>,
    /// Value of `before` for the next page.
    next: Option<i64>,
}

fn document(of: &ShopRevision) -> Revision {
    Revision {
        number: of.number,
        deleted: of.text.is_none(),
        author: of.author.clone(),
        made: http::moment(of.made),
    }
}

/// The text of a revision that has one.
fn text_of(of: ShopRevision, sort: Sort) -> Result<(String, String), Problem> {
    match of.text {
        Some(text) => Ok((text, of.tag)),
        None => Err(Problem::absent(format!("the {} was deleted in this revision", sort.name()))),
    }
}

/// Lists the revisions of a text, the newest first.
pub(super) async fn list(shared: &Shared, caller: &Caller, asked: Asked) -> Result<Response, Problem> {
    let mut query = Query::of(asked.query.as_deref());
    let before = query.number("before")?.unwrap_or(i64::MAX);
    let most = query.limit()?;
    query.end("before, limit")?;
    let Asked { sort, name, .. } = asked;
    let listed =
        shared.store(caller, move |store| Ok(store.shop_revisions(sort, &name, before, most)?)).await?;
    let next = listed.last().filter(|last| last.number > 1).map(|last| last.number);
    let next = next.filter(|_| listed.len() == most as usize);
    Ok(http::json(&Revisions { revisions: listed.iter().map(document).collect(), next }))
}

/// Gives a text as it was in a revision.
pub(super) async fn read(
    shared: &Shared,
    caller: &Caller,
    asked: Asked,
    number: &str,
) -> Result<Response, Problem> {
    asked.has_no_query()?;
    body::name(&asked.name)?;
    let number = revision_number(number)?;
    let Asked { sort, name, headers, .. } = asked;
    let found = shared.store(caller, move |store| Ok(store.shop_revision(sort, &name, number)?)).await?;
    let (text, tag) = text_of(found, sort)?;
    let tag = etag(&tag, "");
    Ok(if is_known(&headers, &tag) { not_modified(tag) } else { told(text, tag) })
}

/// Makes a new revision that is as an earlier one.
pub(super) async fn restore(
    shared: &Shared,
    caller: &Caller,
    asked: Asked,
    number: &str,
) -> Result<Response, Problem> {
    asked.has_no_query()?;
    caller.may(Act::Administer, "")?;
    let over = expected(&asked.headers)?;
    body::name(&asked.name)?;
    let number = revision_number(number)?;
    let place = asked.place();
    let Asked { sort, name, .. } = asked;
    let (tag, _) = shared
        .store(caller, move |store| {
            let (text, _) = text_of(store.shop_revision(sort, &name, number)?, sort)?;
            // A later ncc may have another idea of such texts, or one of this name.
            let touched = fits(store, sort, &name, &text)?;
            Ok(store.keep_shop_text(sort, &name, &text, &touched, &over)?)
        })
        .await?;
    Ok((StatusCode::CREATED, [(LOCATION, place), (ETAG, etag(&tag, ""))]).into_response())
}
