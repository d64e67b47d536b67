//! Pages and pictures: their policies, and texts as HTML.

use axum::http::header::{CONTENT_SECURITY_POLICY, CONTENT_TYPE, ETAG};
use axum::http::{HeaderMap, HeaderValue};
use axum::response::{IntoResponse, Response};

use crate::http::conditions::{etag, is_known, not_modified};
use crate::store::digest;

/// Rights of a page that stands by itself: its own style, and nothing else.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'; base-uri 'none'; \
                      form-action 'none'; sandbox";

/// The same for one that has pictures in it.
const WITH_PICTURES: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'; \
                             base-uri 'none'; form-action 'none'; sandbox";

/// The media type of a page.
pub(super) const HTML: &str = "text/html; charset=utf-8";

/// The media type of a drawing.
pub(super) const SVG: &str = "image/svg+xml";

/// The media type of tables.
pub(super) const CSV: &str = "text/csv; charset=utf-8; header=present";

/// Something that was made of many texts.
pub(super) struct Made {
    /// Its media type.
    pub(super) media: &'static str,
    /// Its bytes.
    pub(super) bytes: Vec<u8>,
    /// Whether it is a page or a drawing that has pictures in it.
    pub(super) has_pictures: bool,
}

impl Made {
    /// The answer, unless its reader has it. `form` is a part of its tag.
    pub(super) fn answer(self, headers: &HeaderMap, form: &str) -> Response {
        // Only the output itself says whether it is still the same.
        let tag = etag(&digest(&[&self.bytes]), form);
        if is_known(headers, &tag) {
            return not_modified(tag);
        }
        let mut answer = ([(CONTENT_TYPE, self.media.to_owned()), (ETAG, tag)], self.bytes).into_response();
        if matches!(self.media, HTML | SVG) {
            let policy = if self.has_pictures { WITH_PICTURES } else { POLICY };
            answer.headers_mut().insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(policy));
        }
        answer
    }
}

/// A text as a part of HTML: signs of HTML are none, and no sign turns the direction of writing or is invisible.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for sign in text.chars() {
        match sign {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}' => {
                out.push('\u{fffd}');
            }
            sign if sign.is_control() => out.push('\u{fffd}'),
            sign => out.push(sign),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_no_html() {
        assert_eq!(escaped("<b a='1'>\"&\u{202e}\n"), "&lt;b a=&#39;1&#39;&gt;&quot;&amp;\u{fffd}\u{fffd}");
        assert_eq!(escaped("G1 X1.5 (ä…)"), "G1 X1.5 (ä…)");
    }
}
