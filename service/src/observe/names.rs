//! Names of requests: in the log, in the audit, and in the header `X-Request-Id` of the answer.

use axum::http::HeaderMap;

/// The header.
pub(crate) const HEADER: &str = "x-request-id";

/// Signs of a name at most.
const LONGEST: usize = 64;

/// The name of a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RequestName(String);

impl RequestName {
    /// The client's name for it, or one by chance. A name that could forge a line of the log is replaced.
    pub(crate) fn of(headers: &HeaderMap) -> RequestName {
        let stated = headers.get(HEADER).and_then(|value| value.to_str().ok());
        let is_plain = |name: &&str| {
            (1..=LONGEST).contains(&name.len())
                && name.bytes().all(|sign| sign.is_ascii_alphanumeric() || b"-_.".contains(&sign))
        };
        RequestName(stated.filter(is_plain).map_or_else(by_chance, str::to_owned))
    }

    /// The name as text.
    pub(crate) fn text(&self) -> &str {
        &self.0
    }
}

/// A name of 64 bits by chance; a computer without chance gets an empty one.
fn by_chance() -> String {
    getrandom::u64().map(|bits| format!("{bits:016x}")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use axum::http::HeaderValue;

    use super::*;

    #[test]
    fn a_name_cannot_forge_the_log() {
        let of = |value: &'static str| {
            RequestName::of(&HeaderMap::from_iter([(
                HEADER.parse().expect("a name"),
                HeaderValue::from_static(value),
            )]))
        };
        assert_eq!(of("job-7.a_B").text(), "job-7.a_B");
        for forged in ["", "a b", "a=b", "a\"b"] {
            assert_eq!(of(forged).text().len(), 16, "{forged:?}");
        }
        assert_ne!(RequestName::of(&HeaderMap::new()), RequestName::of(&HeaderMap::new()));
    }
}
