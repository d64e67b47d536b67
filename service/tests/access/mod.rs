//! Users: who may do what, and what nobody may.

mod attempts;
mod audit;
mod folders;
mod forged;
mod roles;
pub(crate) mod tls;
mod tokens;

use std::time::Duration;

use ncc_service::{Cost, Limits, Rate};
use serde_json::{Value, json};

use crate::client::{Answer, Server};

/// The password of all accounts here.
pub(crate) const PASSWORD: &str = "correct horse";

/// The least cost of a password.
pub(crate) const CHEAP: Cost = Cost { memory: 8, rounds: 1, lanes: 1 };

/// Limits with cheap passwords, and as many attempts as a test needs.
pub(crate) fn limits() -> Limits {
    Limits {
        password: CHEAP,
        attempts: Rate { burst: 1000, every: Duration::from_secs(1) },
        ..Limits::default()
    }
}

/// A session, or a token.
#[derive(Clone, Debug, Default)]
pub(crate) struct User {
    /// Headers of each of its requests.
    pub(crate) headers: Vec<(String, String)>,
    /// Its cookie.
    pub(crate) cookie: String,
    /// Its value against forged requests.
    pub(crate) csrf: String,
}

impl User {
    pub(crate) fn token(token: &str) -> User {
        let header = ("Authorization".to_owned(), format!("Bearer {token}"));
        User { headers: vec![header], ..User::default() }
    }

    pub(crate) fn ask(&self, server: &Server, method: &str, target: &str, body: &Value) -> Answer {
        let (media, text) = match body {
            Value::Null => (None, Vec::new()),
            Value::String(text) => (Some("text/plain"), text.clone().into_bytes()),
            other => (Some("application/json"), other.to_string().into_bytes()),
        };
        self.send(server, method, target, media, &text)
    }

    pub(crate) fn send(
        &self,
        server: &Server,
        method: &str,
        target: &str,
        media: Option<&str>,
        body: &[u8],
    ) -> Answer {
        let own = self.headers.iter().map(|(name, value)| (name.as_str(), value.as_str()));
        let headers: Vec<_> = own.chain(media.map(|media| ("Content-Type", media))).collect();
        server.ask(method, target, &headers, body)
    }

    pub(crate) fn get(&self, server: &Server, target: &str) -> Answer {
        self.ask(server, "GET", target, &Value::Null)
    }
}

/// Asks for a session.
pub(crate) fn log_in(server: &Server, user: &str, password: &str) -> Answer {
    let asked = json!({ "user": user, "password": password });
    server.json("POST", "/api/v1/session", asked.to_string().as_bytes())
}

/// The session of an answer.
pub(crate) fn session(answer: &Answer) -> User {
    assert_eq!(answer.status, 200, "{}", answer.text());
    let cookie = answer.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    let csrf = answer.json()["csrf"].as_str().expect("a value").to_owned();
    let headers = vec![("Cookie".to_owned(), cookie.clone()), ("X-NCC-CSRF".to_owned(), csrf.clone())];
    User { headers, cookie, csrf }
}

/// A session of an account.
pub(crate) fn user(server: &Server, name: &str) -> User {
    session(&log_in(server, name, PASSWORD))
}

/// Makes the first account, `root`, and begins its session.
pub(crate) fn admin(server: &Server) -> User {
    let made =
        server.json("POST", "/api/v1/accounts", account("root", &[("", "admin")]).to_string().as_bytes());
    assert_eq!(made.status, 201, "{}", made.text());
    user(server, "root")
}

/// A request for an account.
pub(crate) fn account(name: &str, rights: &[(&str, &str)]) -> Value {
    let rights: Vec<Value> =
        rights.iter().map(|(folder, role)| json!({ "folder": folder, "role": role })).collect();
    json!({ "name": name, "password": PASSWORD, "rights": rights })
}

/// Makes an account with rights, and begins its session.
pub(crate) fn with_rights(server: &Server, admin: &User, name: &str, rights: &[(&str, &str)]) -> User {
    let made = admin.ask(server, "POST", "/api/v1/accounts", &account(name, rights));
    assert_eq!(made.status, 201, "{}", made.text());
    user(server, name)
}

/// Makes something, and gives its name.
pub(crate) fn make(server: &Server, by: &User, target: &str, body: &Value) -> String {
    let made = by.ask(server, "POST", target, body);
    assert!(matches!(made.status, 201 | 202), "{target}: {}", made.text());
    made.json()["id"].as_str().expect("a name").to_owned()
}
