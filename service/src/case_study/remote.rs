//! A PERSISTENCE elsewhere, over HTTP.

use std::time::Duration;

use axum::http::{HeaderValue, StatusCode};
use serde::Deserialize;
use serde_json::Value;
use ureq::Agent;
use ureq::http::header::{AUTHORIZATION, CONTENT_TYPE, ETAG, IF_MATCH};

use super::document::{WHOLE_MEDIA, Whole};
use crate::http::Problem;
use crate::http::body::encoded;
use crate::http::conditions::etag;
use crate::store::{Condition, Listed, ShopText};

/// Time limit of an answer.
const PATIENCE: Duration = Duration::from_secs(30);

/// Bytes of an answer at most.
const MOST: u64 = 1 << 30;

/// A PERSISTENCE elsewhere.
#[derive(Clone)]
pub(crate) struct Remote {
    agent: Agent,
    /// Its address, without `/` at the end.
    address: String,
    /// The token of the request, by which PERSISTENCE decides.
    bearer: Option<HeaderValue>,
}

/// An answer.
struct Answer {
    status: StatusCode,
    tag: String,
    body: Vec<u8>,
}

impl Remote {
    /// The one at an address: `http://127.0.0.1:8275`.
    pub(crate) fn at(address: &str) -> Remote {
        let config = Agent::config_builder()
            .timeout_global(Some(PATIENCE))
            .http_status_as_error(false)
            .max_redirects(0)
            // No other host is asked, whatever the environment says.
            .proxy(None)
            .build();
        Remote {
            agent: Agent::new_with_config(config),
            address: address.trim_end_matches('/').to_owned(),
            bearer: None,
        }
    }

    /// The same for a request with a token, or without.
    pub(super) fn with(&self, bearer: Option<HeaderValue>) -> Remote {
        Remote { bearer, ..self.clone() }
    }

    fn ask(
        &self,
        method: &str,
        path: &str,
        over: &Condition,
        body: Option<(&str, &[u8])>,
    ) -> Result<Answer, Problem> {
        let cannot = |error: ureq::Error| Problem::other_service(format!("PERSISTENCE: {error}"));
        let mut request =
            ureq::http::Request::builder().method(method).uri(format!("{}{path}", self.address));
        if let Some(bearer) = &self.bearer {
            request = request.header(AUTHORIZATION, bearer);
        }
        if let Condition::OneOf(tags) = over {
            let tags: Vec<String> = tags.iter().map(|tag| etag(tag, "")).collect();
            // Tags that nobody can have match nothing, as an empty list would.
            request =
                request.header(IF_MATCH, if tags.is_empty() { "\"\"".to_owned() } else { tags.join(", ") });
        }
        let form = |error: ureq::http::Error| Problem::other_service(format!("PERSISTENCE: {error}"));
        let answer = match body {
            Some((media, bytes)) => {
                self.agent.run(request.header(CONTENT_TYPE, media).body(bytes).map_err(form)?)
            }
            None => self.agent.run(request.body(()).map_err(form)?),
        };
        let mut answer = answer.map_err(cannot)?;
        let status = StatusCode::from_u16(answer.status().as_u16()).unwrap_or(StatusCode::BAD_GATEWAY);
        let tag = answer.headers().get(ETAG).and_then(|tag| tag.to_str().ok()).unwrap_or_default();
        let tag = tag.trim_matches('"').to_owned();
        let body = answer.body_mut().with_config().limit(MOST).read_to_vec().map_err(cannot)?;
        if status.is_success() {
            return Ok(Answer { status, tag, body });
        }
        Err(Problem::passed_on(status, serde_json::from_slice(&body).unwrap_or(Value::Null)))
    }

    fn json<'a, T: Deserialize<'a>>(answer: &'a Answer) -> Result<T, Problem> {
        let wrong = |error| Problem::other_service(format!("PERSISTENCE ({}): {error}", answer.status));
        serde_json::from_slice(&answer.body).map_err(wrong)
    }

    fn send(&self, method: &str, name: &str, whole: &Whole, over: &Condition) -> Result<String, Problem> {
        let body = serde_json::to_vec(whole).unwrap_or_default();
        let path = format!("/persistence/{}", encoded(name));
        Ok(self.ask(method, &path, over, Some((WHOLE_MEDIA, &body)))?.tag)
    }

    pub(super) fn create(&self, name: &str, whole: &Whole) -> Result<String, Problem> {
        self.send("POST", name, whole, &Condition::Any)
    }

    pub(super) fn replace(&self, name: &str, whole: &Whole, over: &Condition) -> Result<String, Problem> {
        self.send("PUT", name, whole, over)
    }

    pub(super) fn delete(&self, name: &str, over: &Condition) -> Result<(), Problem> {
        self.ask("DELETE", &format!("/persistence/{}", encoded(name)), over, None).map(|_| ())
    }

    pub(super) fn find(&self, name: &str) -> Result<(String, Whole), Problem> {
        let path = format!("/persistence/{}?form=whole", encoded(name));
        let answer = self.ask("GET", &path, &Condition::Any, None)?;
        let whole = Remote::json(&answer)?;
        let tag = answer.tag.split_once('-').map_or(answer.tag.as_str(), |(digest, _)| digest).to_owned();
        Ok((tag, whole))
    }

    pub(super) fn list(&self, after: &str, most: u32) -> Result<Vec<Listed>, Problem> {
        #[derive(Deserialize)]
        struct List {
            documents: Vec<Listed>,
        }
        let path = format!("/persistence?limit={most}&after={}", encoded(after));
        let answer = self.ask("GET", &path, &Condition::Any, None)?;
        Ok(Remote::json::<List>(&answer)?.documents)
    }

    pub(super) fn machine(&self, name: &str) -> Result<ShopText, Problem> {
        self.text("machines", name)
    }

    /// All dictionaries that do not come with ncc.
    pub(super) fn dialects(&self) -> Result<Vec<ShopText>, Problem> {
        #[derive(Deserialize)]
        struct One {
            name: String,
            ships_with_ncc: bool,
        }
        #[derive(Deserialize)]
        struct List {
            dialects: Vec<One>,
        }
        let answer = self.ask("GET", "/api/v1/dialects", &Condition::Any, None)?;
        let list: List = Remote::json(&answer)?;
        let own = list.dialects.iter().filter(|one| !one.ships_with_ncc);
        own.map(|one| self.text("dialects", &one.name)).collect()
    }

    /// A text of the shop.
    fn text(&self, sort: &str, name: &str) -> Result<ShopText, Problem> {
        let answer = self.ask("GET", &format!("/api/v1/{sort}/{}", encoded(name)), &Condition::Any, None)?;
        let no_text = |_| Problem::other_service("PERSISTENCE: a profile or a dictionary is no text");
        let text = String::from_utf8(answer.body).map_err(no_text)?;
        Ok(ShopText { name: name.to_owned(), text, tag: answer.tag })
    }
}
