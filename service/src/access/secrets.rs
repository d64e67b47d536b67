//! Secrets of requests: the cookie of a session, the token of a program, and the value against forged requests.
//!
//! Only digests of them are kept. The value of a session against forged requests is a digest of the cookie's secret, and so
//! is in no table: a page of this server can ask for it, and a page of another server cannot.

use axum::http::header::{AUTHORIZATION, COOKIE};
use axum::http::{HeaderMap, HeaderName, HeaderValue};

use crate::http::Problem;
use crate::store::digest;

/// The name of the cookie.
const NAME: &str = "ncc_session";

/// The header with the value against forged requests.
pub(crate) const CSRF: HeaderName = HeaderName::from_static("x-ncc-csrf");

/// The beginning of each token, so that a search finds one that has got into a text.
pub(crate) const TOKEN: &str = "ncc_";

/// Signs of a secret: 260 bits.
const SIGNS: usize = 52;

/// A new secret.
pub(crate) fn secret() -> Result<String, Problem> {
    crate::chance::signs(SIGNS).map_err(|_| Problem::fault())
}

/// The digest of a secret, as it is kept.
pub(crate) fn kept(secret: &str) -> String {
    digest(&[b"kept", secret.as_bytes()])
}

/// The value of a session against forged requests.
pub(crate) fn csrf(secret: &str) -> String {
    digest(&[b"csrf", secret.as_bytes()])
}

/// The secret of the session of a request. Two cookies of the name may be those of two servers, and are none.
pub(crate) fn session(headers: &HeaderMap) -> Option<String> {
    let cookies = headers.get_all(COOKIE).iter().filter_map(|value| value.to_str().ok());
    let mut own = cookies
        .flat_map(|value| value.split(';'))
        .filter_map(|pair| pair.trim().split_once('='))
        .filter(|(name, _)| *name == NAME)
        .map(|(_, value)| value.to_owned());
    let first = own.next()?;
    (own.next().is_none() && first.len() == SIGNS).then_some(first)
}

/// The token of a request: `Some(None)` where the header has another form.
pub(crate) fn token(headers: &HeaderMap) -> Option<Option<String>> {
    let mut values = headers.get_all(AUTHORIZATION).iter();
    let first = values.next()?.to_str().ok();
    let token = first.and_then(|value| value.split_once(' '));
    let token =
        token.filter(|(scheme, token)| scheme.eq_ignore_ascii_case("bearer") && token.starts_with(TOKEN));
    Some(token.filter(|_| values.next().is_none()).map(|(_, token)| token.trim().to_owned()))
}

/// Whether a request has the value of its session against forged requests.
pub(crate) fn is_meant(headers: &HeaderMap, secret: &str) -> bool {
    let mut values = headers.get_all(CSRF).iter();
    let value = values.next().map(HeaderValue::as_bytes);
    // Both are digests of a secret that a stranger does not have: the time of the comparison says nothing of it.
    values.next().is_none() && value == Some(csrf(secret).as_bytes())
}

/// The cookie of a session. A browser sends it to this server alone, never from a page of another one, and shows it to no
/// script.
pub(crate) fn cookie(secret: &str, seconds: i64, is_secure: bool) -> String {
    let secure = if is_secure { "; Secure" } else { "" };
    format!("{NAME}={secret}; HttpOnly; SameSite=Strict; Path=/; Max-Age={seconds}{secure}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(name: HeaderName, values: &[&str]) -> HeaderMap {
        let value = |value: &&str| (name.clone(), HeaderValue::from_str(value).expect("a value"));
        values.iter().map(value).collect()
    }

    #[test]
    fn a_cookie_is_read_once() {
        let secret = secret().expect("chance");
        let of = |values: &[&str]| session(&with(COOKIE, values));
        let own = format!("{NAME}={secret}");
        assert_eq!(of(&[&format!("a=b; {own}; c=d")]).as_ref(), Some(&secret));
        assert_eq!(of(&["a=b", &own]), Some(secret));
        for wrong in [&[own.as_str(), own.as_str()][..], &[&format!("{own}; {own}")], &["ncc_session=x"], &[]]
        {
            assert_eq!(of(wrong), None, "{wrong:?}");
        }
        assert_eq!(of(&[&own.to_uppercase()]), None);
    }

    #[test]
    fn a_token_has_its_form() {
        let of = |values: &[&str]| token(&with(AUTHORIZATION, values));
        assert_eq!(of(&["Bearer ncc_a"]), Some(Some("ncc_a".to_owned())));
        assert_eq!(of(&["bearer  ncc_a"]), Some(None));
        assert_eq!(of(&["Basic ncc_a"]), Some(None));
        assert_eq!(of(&["Bearer ncc_a", "Bearer ncc_b"]), Some(None));
        assert_eq!(of(&[]), None);
    }

    #[test]
    fn the_value_against_forged_requests_is_that_of_the_session() {
        let (own, other) = (secret().expect("chance"), secret().expect("chance"));
        assert!(is_meant(&with(CSRF, &[&csrf(&own)]), &own));
        for wrong in [&[][..], &[""], &[&csrf(&other)], &[&own], &[&kept(&own)], &[&csrf(&own), &csrf(&own)]]
        {
            assert!(!is_meant(&with(CSRF, wrong), &own), "{wrong:?}");
        }
    }
}
