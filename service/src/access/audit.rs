//! The audit, for admins.
//!
//! ```text
//! GET /api/v1/audit             who did what when, the newest first: account, subject, action, from, until, before, limit
//! GET /api/v1/audit?form=csv    all of it, the oldest first
//! ```

use std::sync::Arc;
use std::time::UNIX_EPOCH;

use axum::body::{Body, Bytes};
use axum::extract::{RawQuery, State};
use axum::http::header::{CONTENT_DISPOSITION, CONTENT_TYPE};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use serde::Serialize;
use utoipa::ToSchema;

use super::caller::Caller;
use crate::Shared;
use crate::http::body::LISTED;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::store::{Entry, Filter};

/// The first line of the table.
const HEAD: &str = "number,moment,account,way,address,request,action,subject,detail,digest\r\n";

/// A form of the audit.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Json,
    Csv,
}

/// An entry of the audit.
#[derive(Serialize, ToSchema)]
#[schema(as = AuditEntry)]
struct EntryDocument {
    /// Counted from 1.
    number: i64,
    /// Its time, UTC.
    #[schema(format = DateTime)]
    moment: String,
    /// The account, or the user of this computer.
    account: String,
    /// The way by which the account was known: a session, a token, a job, the command line.
    way: String,
    /// Address of the client.
    address: String,
    /// Name of the request: `X-Request-Id`.
    request: String,
    action: String,
    subject: String,
    detail: String,
    /// SHA-256 of this entry and of the digest before.
    digest: String,
}

/// A page of the audit.
#[derive(Serialize, ToSchema)]
struct Audit {
    audit: Vec<EntryDocument>,
    /// Value of `before` for the next page.
    next: Option<i64>,
}

fn told(entry: &Entry) -> EntryDocument {
    let own = entry.clone();
    EntryDocument {
        number: own.number,
        moment: http::moment(own.moment),
        account: own.account,
        way: own.way,
        address: own.address,
        request: own.request,
        action: own.action,
        subject: own.subject,
        detail: own.detail,
        digest: own.digest,
    }
}

/// A line of the table. A cell that a spreadsheet would compute begins with `'`.
fn line(entry: &Entry) -> String {
    let cell = |text: &str| {
        let computed = text.starts_with(['=', '+', '-', '@', '\t', '\r']);
        format!("\"{}{}\"", if computed { "'" } else { "" }, text.replace('"', "\"\""))
    };
    let texts = [
        &*http::moment(entry.moment),
        &entry.account,
        &entry.way,
        &entry.address,
        &entry.request,
        &entry.action,
        &entry.subject,
        &entry.detail,
        &entry.digest,
    ];
    format!("{},{}\r\n", entry.number, texts.map(cell).join(","))
}

/// A moment in an address.
fn moment(query: &mut Query, name: &str) -> Result<Option<i64>, Problem> {
    let Some(text) = query.one(name)? else { return Ok(None) };
    let form = || Problem::request(format!("`{name}` takes no `{text}`")).help("2026-01-31T12:00:00Z");
    let at = humantime::parse_rfc3339(&text).ok().and_then(|at| at.duration_since(UNIX_EPOCH).ok());
    at.and_then(|since| i64::try_from(since.as_secs()).ok()).map(Some).ok_or_else(form)
}

/// Gives the audit, the newest entry first; as a table (CSV), the oldest first.
#[utoipa::path(get, path = "/api/v1/audit", tag = "accounts",
    params(
        ("form" = Option<String>, Query, pattern = "^(json|csv)$", description = "`json`, or `csv`"),
        ("account" = Option<String>, Query, description = "Entries of an account"),
        ("subject" = Option<String>, Query, description = "Entries about a thing"),
        ("action" = Option<String>, Query, description = "Entries of an action"),
        ("from" = Option<String>, Query, description = "Entries at this moment and later: `2026-01-31T12:00:00Z`"),
        ("until" = Option<String>, Query, description = "Entries before this moment"),
        ("before" = Option<i64>, Query, description = "The last one of the page before: its `next`; not for a table"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it; not for a table"),
    ),
    responses((status = 200, content((Audit = "application/json"), (String = "text/csv; charset=utf-8; header=present")))))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    caller.may(Act::Administer, "")?;
    let mut query = Query::of(query.as_deref());
    let form = query.among("form", &[("json", Form::Json), ("csv", Form::Csv)])?.unwrap_or(Form::Json);
    let filter = Filter {
        account: query.one("account")?,
        subject: query.one("subject")?,
        action: query.one("action")?,
        from: moment(&mut query, "from")?,
        until: moment(&mut query, "until")?,
    };
    if form == Form::Csv {
        query.end("form, account, subject, action, from, until")?;
        shared.store(&caller, |store| Ok(store.note_alone("audit.export", "audit", "")?)).await?;
        let headers = [
            (CONTENT_TYPE, "text/csv; charset=utf-8; header=present"),
            (CONTENT_DISPOSITION, "attachment; filename=audit.csv"),
        ];
        return Ok((headers, Body::from_stream(lines(shared, caller, filter))).into_response());
    }
    let before = query.number("before")?.unwrap_or(i64::MAX);
    let most = query.limit()?;
    query.end("form, account, subject, action, from, until, before, limit")?;
    let entries = shared.store(&caller, move |store| Ok(store.audit(&filter, before, most)?)).await?;
    let next = entries.last().filter(|_| entries.len() == most as usize).map(|last| last.number);
    Ok(http::json(&Audit { audit: entries.iter().map(told).collect(), next }))
}

/// The table in pieces. One that breaks off ends without its last chunk.
fn lines(
    shared: Arc<Shared>,
    caller: Caller,
    filter: Filter,
) -> impl stream::Stream<Item = Result<Bytes, axum::BoxError>> {
    let begin = (shared, caller, filter, Some(0_i64));
    stream::try_unfold(begin, async |(shared, caller, filter, after)| {
        let Some(after) = after else { return Ok(None) };
        let own = filter.clone();
        let read = move |store: &crate::store::Store| Ok(store.audit_after(&own, after, LISTED[1])?);
        let piece = shared.store(&caller, read).await;
        let piece = piece.map_err(|_| axum::BoxError::from("the store"))?;
        let mut text = if after == 0 { HEAD.to_owned() } else { String::new() };
        piece.iter().for_each(|entry| text.push_str(&line(entry)));
        let next = piece.last().filter(|_| piece.len() == LISTED[1] as usize).map(|last| last.number);
        Ok(Some((Bytes::from(text), (shared, caller, filter, next))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_text_for_a_spreadsheet() {
        let entry = Entry {
            number: 7,
            moment: 0,
            account: "ana".into(),
            way: "login".into(),
            address: "127.0.0.1".into(),
            request: String::new(),
            action: "program.created".into(),
            subject: "=cmd|' /C calc'!A0".into(),
            detail: "say \"hello\",\n@x".into(),
            digest: "ab".into(),
        };
        assert_eq!(
            line(&entry),
            "7,\"1970-01-01T00:00:00Z\",\"ana\",\"login\",\"127.0.0.1\",\"\",\"program.created\",\
             \"'=cmd|' /C calc'!A0\",\"say \"\"hello\"\",\n@x\",\"ab\"\r\n"
        );
    }
}
