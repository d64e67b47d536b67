//! Bodies of requests, and names in addresses.

use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::http::header::CONTENT_TYPE;
use axum::http::{HeaderMap, StatusCode};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

use super::Problem;

/// Entries of a list without `limit`, and at most.
pub(crate) const LISTED: [u32; 2] = [100, 1000];

/// Bytes of a name at most.
const NAME: usize = 255;

/// A body as a whole.
///
/// # Errors
/// It is larger than the limit, or broke off.
pub(crate) fn whole(body: Result<Bytes, BytesRejection>, most: u64) -> Result<Bytes, Problem> {
    body.map_err(|rejection| match rejection.status() {
        StatusCode::PAYLOAD_TOO_LARGE => Problem::too_large(most),
        _ => Problem::request("the body broke off"),
    })
}

/// The media type of a body, without parameters, in small letters; none where it is not stated.
pub(crate) fn media(headers: &HeaderMap) -> Option<String> {
    let value = headers.get(CONTENT_TYPE)?.to_str().unwrap_or("?");
    Some(value.split(';').next().unwrap_or_default().trim().to_ascii_lowercase())
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
