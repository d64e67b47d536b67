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
use serde_json::{Value, json};

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

fn told(entry: &Entry) -> Value {
    json!({
        "number": entry.number,
        "moment": http::moment(entry.moment),
        "account": entry.account,
        "way": entry.way,
        "address": entry.address,
        "request": entry.request,
        "action": entry.action,
        "subject": entry.subject,
        "detail": entry.detail,
        "digest": entry.digest,
    })
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

/// Gives the audit.
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
    let most = query.number("limit")?.unwrap_or(LISTED[0]).clamp(1, LISTED[1]);
    query.end("form, account, subject, action, from, until, before, limit")?;
    let entries = shared.store(&caller, move |store| Ok(store.audit(&filter, before, most)?)).await?;
    let next = entries.last().filter(|_| entries.len() == most as usize).map(|last| last.number);
    let entries: Vec<Value> = entries.iter().map(told).collect();
    Ok(http::json(&json!({ "audit": entries, "next": next })))
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
