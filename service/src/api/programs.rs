//! Programs: made, listed, described, deleted.

use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::extract::rejection::BytesRejection;
use axum::extract::{Path, RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;
use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;

use super::document::{Program, changed, details, document, folder, machine, message_fits, said, tags, told};
use super::texts::receive;
use crate::Shared;
use crate::access::Caller;
use crate::http::body;
use crate::http::conditions::expected;
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::rights::Act;
use crate::shop::named;
use crate::store::{Details, Once, Said, Wanted, digest};

/// Group of the addresses in the description.
const TAG: &str = "programs";

/// The header of a request that may be sent again.
const KEY: &str = "idempotency-key";

/// Bytes of a description at most.
const DESCRIPTION: u64 = 1 << 16;

/// The key of a request that may be sent again.
fn once(headers: &HeaderMap, asked: &str) -> Result<Option<Once>, Problem> {
    let Some(key) = headers.get(KEY) else { return Ok(None) };
    let key = key.to_str().ok().filter(|key| (1..=255).contains(&key.len()));
    let form = || Problem::request("Idempotency-Key has 1 to 255 signs of ASCII");
    Ok(Some(Once { key: key.ok_or_else(form)?.to_owned(), request: digest(&[asked.as_bytes()]) }))
}

/// Keeps a new program.
///
/// The body is its text, of up to 256 MB.
#[utoipa::path(post, path = "/api/v1/programs", tag = TAG,
    params(
        ("name" = String, Query, min_length = 1, max_length = 255, description = "File name"),
        ("folder" = Option<String>, Query, description = "Folder, with `/` between names; the top without it"),
        ("dialect" = Option<String>, Query, description = "Its dialect, one of `ncc dialects`"),
        ("machine" = Option<String>, Query, description = "The machine that it was written for"),
        ("tag" = Option<Vec<String>>, Query, description = "Tags"),
        ("message" = Option<String>, Query, max_length = 2000, description = "A message for the revision"),
        ("Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 255,
            description = "A key of the writer: a request that is sent again with it is done once"),
    ),
    request_body(content((String = "text/plain"), (Vec<u8> = "application/octet-stream")),
        description = "The text of the program, as it is on the machine"),
    responses((status = 201, body = Program, headers(("Location" = String), ("ETag" = String)))))]
pub(super) async fn create(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Body,
) -> Result<Response, Problem> {
    let asked = query.unwrap_or_default();
    let once = once(&headers, &asked)?;
    let mut query = Query::of(Some(&asked));
    let details = details(&mut query)?;
    caller.may_in(Act::Change, &details.folder)?;
    let said = said(&mut query, caller.name())?;
    query.end("name, folder, dialect, machine, tag, message")?;
    let dialect = details.dialect.clone();
    shared.store(&caller, move |store| named(store, &dialect)).await?;
    let text = receive(&shared, &caller, &headers, body).await?;
    let id = new_id()?;
    let made = shared
        .store(&caller, move |store| {
            let aside = text.aside();
            store.create_program(&id, &details, text, &said, once.as_ref()).or_else(|error| {
                store.forget(aside)?;
                Err(error.into())
            })
        })
        .await?;
    let place = format!("/api/v1/programs/{}", made.program);
    Ok(changed(&made, Some(place)))
}

/// A name that nothing else has: 100 bits by chance.
pub(crate) fn new_id() -> Result<String, Problem> {
    crate::chance::signs(20).map_err(|_| Problem::fault())
}

/// A page of programs.
#[derive(Debug, Serialize, ToSchema)]
struct Programs {
    programs: Vec<Program>,
    /// Value of `after` for the next page.
    next: Option<String>,
}

/// Lists programs in the order of their folders and names.
#[utoipa::path(get, path = "/api/v1/programs", tag = TAG,
    params(
        ("folder" = Option<String>, Query, description = "The folder; empty is the top"),
        ("under" = Option<String>, Query, description = "A folder and those below it"),
        ("name" = Option<String>, Query, description = "A part of the name, in any case"),
        ("tag" = Option<String>, Query, description = "A tag"),
        ("dialect" = Option<String>, Query, description = "The dialect that is kept with it"),
        ("machine" = Option<String>, Query, description = "The machine that is kept with it"),
        ("deleted" = Option<bool>, Query, description = "The deleted ones"),
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = Programs)))]
pub(super) async fn list(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let top = |folders: Vec<String>| folders.into_iter().next();
    let wanted = Wanted {
        folder: top(query.all("folder")),
        under: query.one("under")?,
        name: query.one("name")?,
        tag: query.one("tag")?,
        dialect: query.one("dialect")?,
        machine: query.one("machine")?,
        deleted: query.among("deleted", &[("true", true), ("false", false)])?.unwrap_or(false),
        after: query.one("after")?,
        act: Act::Read,
        most: query.limit()?,
    };
    query.end("folder, under, name, tag, dialect, machine, deleted, after, limit")?;
    let most = wanted.most as usize;
    let listed = shared.store(&caller, move |store| Ok(store.programs(&wanted)?)).await?;
    let next = listed.last().filter(|_| listed.len() == most).map(|last| last.program.clone());
    Ok(http::json(&Programs { programs: listed.iter().map(document).collect(), next }))
}

/// Gives what is known of a program.
#[utoipa::path(get, path = "/api/v1/programs/{id}", tag = TAG,
    params(("id" = String, Path), ("If-None-Match" = Option<String>, Header)),
    responses((status = 200, body = Program, headers(("ETag" = String))), (status = 304)))]
pub(super) async fn read(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let found = shared.store(&caller, move |store| Ok(store.program(&id)?)).await?;
    Ok(told(&found, &headers))
}

/// Changes of the details (RFC 7396): a field that is left out stays, `null` clears a field.
#[derive(Debug, Default, Deserialize, ToSchema)]
#[serde(default, deny_unknown_fields)]
struct Patch {
    /// Folder, with `/` between names.
    #[serde(deserialize_with = "stated")]
    #[schema(value_type = Option<String>)]
    folder: Option<Option<String>>,
    name: Option<String>,
    /// One of `ncc dialects`.
    #[serde(deserialize_with = "stated")]
    #[schema(value_type = Option<String>)]
    dialect: Option<Option<String>>,
    #[serde(deserialize_with = "stated")]
    #[schema(value_type = Option<String>)]
    machine: Option<Option<String>>,
    #[serde(deserialize_with = "stated")]
    #[schema(value_type = Option<Vec<String>>)]
    tags: Option<Option<Vec<String>>>,
    /// A message for the revision.
    #[schema(max_length = 2000)]
    message: String,
}

/// A field that is there, whatever it holds.
fn stated<'de, D: Deserializer<'de>, T: Deserialize<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

impl Patch {
    fn read(text: &[u8]) -> Result<Patch, Problem> {
        let mut patch: Patch = body::object(text)?;
        message_fits(&patch.message)?;
        patch.name.as_deref().map_or(Ok(""), body::name)?;
        let text = |field: &Option<Option<String>>| field.clone().flatten().unwrap_or_default();
        folder(&text(&patch.folder))?;
        machine(&text(&patch.machine))?;
        patch.tags = patch.tags.map(|own| own.map(tags).transpose()).transpose()?;
        Ok(patch)
    }

    fn put(self, details: &mut Details) {
        details.name = self.name.unwrap_or_else(|| std::mem::take(&mut details.name));
        for (field, own) in [
            (self.folder, &mut details.folder),
            (self.dialect, &mut details.dialect),
            (self.machine, &mut details.machine),
        ] {
            if let Some(value) = field {
                *own = value.unwrap_or_default();
            }
        }
        if let Some(tags) = self.tags {
            details.tags = tags.unwrap_or_default();
        }
    }
}

/// Changes folder, name, tags, dialect or machine of a program.
#[utoipa::path(patch, path = "/api/v1/programs/{id}", tag = TAG,
    params(("id" = String, Path), ("If-Match" = Option<String>, Header)),
    request_body(content((Patch = "application/merge-patch+json"), (Patch = "application/json"))),
    responses((status = 200, body = Program, headers(("ETag" = String)))))]
pub(super) async fn change(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let over = expected(&headers)?;
    if !matches!(body::media(&headers)?.as_deref(), Some("application/json" | "application/merge-patch+json"))
    {
        return Err(Problem::media("application/merge-patch+json"));
    }
    let text = body::whole(body, DESCRIPTION)?;
    let mut patch = Patch::read(&text)?;
    let said = Said { author: caller.name().to_owned(), message: std::mem::take(&mut patch.message) };
    let made = shared
        .store(&caller, move |store| {
            named(store, &patch.dialect.clone().flatten().unwrap_or_default())?;
            Ok(store.change_details(&id, |details| patch.put(details), &said, &over)?)
        })
        .await?;
    Ok(changed(&made, None))
}

/// Deletes a program; its revisions stay.
#[utoipa::path(delete, path = "/api/v1/programs/{id}", tag = TAG,
    params(
        ("id" = String, Path),
        ("message" = Option<String>, Query, max_length = 2000, description = "A message for the revision"),
        ("If-Match" = Option<String>, Header),
    ),
    responses((status = 200, body = Program, headers(("ETag" = String)))))]
pub(super) async fn delete(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let mut query = Query::of(query.as_deref());
    let said = said(&mut query, caller.name())?;
    query.end("message")?;
    let over = expected(&headers)?;
    let made = shared.store(&caller, move |store| Ok(store.delete_program(&id, &said, &over)?)).await?;
    Ok(changed(&made, None))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_patch_changes_what_it_names() {
        let before = || Details {
            folder: "a".into(),
            name: "n".into(),
            dialect: "fanuc".into(),
            machine: "m".into(),
            tags: vec!["t".into()],
        };
        let after = |text: &str| {
            let mut details = before();
            Patch::read(text.as_bytes()).expect("a patch").put(&mut details);
            details
        };
        assert_eq!(after("{}"), before());
        assert_eq!(
            after(r#"{"machine": null, "tags": ["z", "a", "z"]}"#),
            Details { machine: String::new(), tags: vec!["a".into(), "z".into()], ..before() }
        );
        assert_eq!(
            after(r#"{"folder": "x/y", "name": "o", "dialect": "haas"}"#),
            Details { folder: "x/y".into(), name: "o".into(), dialect: "haas".into(), ..before() }
        );
        for wrong in ["", "[]", r#"{"name": ""}"#, r#"{"folder": "/a"}"#, r#"{"nam": "a"}"#] {
            assert!(Patch::read(wrong.as_bytes()).is_err(), "{wrong}");
        }
    }

    #[test]
    fn ids_differ() {
        let [one, other] = [(); 2].map(|()| new_id().expect("chance"));
        assert!(one.len() == 20 && one != other);
    }
}
