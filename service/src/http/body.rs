//! Bodies of requests, and names in addresses.

use std::error::Error;

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{FromRequestParts, Path};
use axum::http::header::{CONTENT_ENCODING, CONTENT_TYPE};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::Problem;
use super::arrival::Broken;

/// Entries of a list without `limit`, and at most.
pub(crate) const LISTED: [u32; 2] = [100, 1000];

/// Bytes of a name at most.
pub(crate) const NAME: usize = 255;

/// A body as a whole.
///
/// # Errors
/// It is larger than the limit, came too slowly, or broke off; or too much arrives at once.
pub(crate) fn whole(body: Result<Bytes, BytesRejection>, most: u64) -> Result<Bytes, Problem> {
    body.map_err(|rejection| match rejection.status() {
        StatusCode::PAYLOAD_TOO_LARGE => Problem::too_large(most),
        _ => broken(&rejection),
    })
}

/// Reason why a body did not arrive.
pub(crate) fn broken(error: &(dyn Error + 'static)) -> Problem {
    match Broken::of(error) {
        Some(Broken::TooSlow) => Problem::too_slow(),
        Some(Broken::Crowded) => Problem::busy("too many bodies arrive at once"),
        None => Problem::request("the body broke off"),
    }
}

/// Bytes of a request in JSON at most.
const REQUEST: u64 = 1 << 20;

/// A request in JSON.
///
/// # Errors
/// The body has another type, is too large, broke off, or is no object of this form.
pub(crate) fn json<T: DeserializeOwned>(
    headers: &HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Result<T, Problem> {
    if media(headers)?.as_deref() != Some("application/json") {
        return Err(Problem::media("application/json"));
    }
    let text = whole(body, REQUEST)?;
    if text.len() as u64 > REQUEST {
        return Err(Problem::too_large(REQUEST));
    }
    object(&text)
}

/// A JSON object.
///
/// # Errors
/// It is none, or not of the form.
pub(crate) fn object<T: DeserializeOwned>(text: &[u8]) -> Result<T, Problem> {
    // A list would be read as an object without names.
    let object: Map<String, Value> =
        serde_json::from_slice(text).map_err(|error| Problem::content(error.to_string()))?;
    serde_json::from_value(object.into()).map_err(|error| Problem::content(error.to_string()))
}

/// The media type of a body, without parameters, in small letters; none where it is not stated.
///
/// # Errors
/// The body is compressed: it would be read as it is.
pub(crate) fn media(headers: &HeaderMap) -> Result<Option<String>, Problem> {
    if headers.get(CONTENT_ENCODING).is_some_and(|encoding| encoding != "identity") {
        return Err(Problem::encoding());
    }
    let Some(value) = headers.get(CONTENT_TYPE) else { return Ok(None) };
    let value = value.to_str().unwrap_or("?");
    Ok(Some(value.split(';').next().unwrap_or_default().trim().to_ascii_lowercase()))
}

/// A name that something is kept under: text of 1 to 255 bytes without control characters and `/`.
///
/// # Errors
/// It is none.
pub(crate) fn name(name: &str) -> Result<&str, Problem> {
    let fits = !name.is_empty()
        && name.len() <= NAME
        && !name.chars().any(|sign| sign.is_control() || sign == '/')
        && !matches!(name, "." | "..");
    let form = || Problem::request("a name has 1 to 255 bytes, and neither control characters nor `/`");
    fits.then_some(name).ok_or_else(form)
}

/// The name in the address of a request.
///
/// # Errors
/// As of [`name`].
pub(crate) struct Name(pub(crate) String);

impl<S: Send + Sync> FromRequestParts<S> for Name {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Name, Problem> {
        let decoded = Path::<String>::from_request_parts(parts, state).await;
        let Path(decoded) = decoded.map_err(|_| Problem::request("the name is no text in UTF-8"))?;
        name(&decoded)?;
        Ok(Name(decoded))
    }
}

/// A name as it stands in an address.
pub(crate) fn encoded(name: &str) -> String {
    /// Signs that stand for themselves (RFC 3986, 2.3).
    const KEPT: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~');
    utf8_percent_encode(name, KEPT).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_text_of_one_line() {
        assert!(name("peça 3.cn").is_ok() && name("a").is_ok() && name(&"x".repeat(255)).is_ok());
        for wrong in ["", ".", "..", "a/b", "a\nb", "a\0", &"x".repeat(256)] {
            assert!(name(wrong).is_err(), "{wrong:?}");
        }
        assert_eq!(encoded("peça 3.cn"), "pe%C3%A7a%203.cn");
    }
}
