//! Requests that a page of another server, or a thief of half a secret, might send.

use serde_json::{Value, json};

use super::{PASSWORD, User, admin, limits, log_in, session, user, with_rights};
use crate::client::{PROGRAM, Server};

/// The status of a request with these headers.
fn status(server: &Server, method: &str, target: &str, headers: &[(&str, &str)]) -> u16 {
    let with_type: Vec<_> = headers.iter().copied().chain([("Content-Type", "text/plain")]).collect();
    server.ask(method, target, &with_type, if method == "GET" { b"" } else { PROGRAM.as_bytes() }).status
}

#[test]
fn a_change_of_a_session_needs_its_value() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let other = user(&server, "root");
    let new = "/api/v1/programs?name=a.cn";
    let cookie = ("Cookie", root.cookie.as_str());
    let secret = root.cookie.split_once('=').expect("a secret").1;
    for wrong in [
        vec![cookie],
        vec![cookie, ("X-NCC-CSRF", "")],
        vec![cookie, ("X-NCC-CSRF", "null")],
        vec![cookie, ("X-NCC-CSRF", other.csrf.as_str())],
        vec![cookie, ("X-NCC-CSRF", secret)],
        vec![cookie, ("X-NCC-CSRF", root.csrf.as_str()), ("X-NCC-CSRF", root.csrf.as_str())],
        vec![cookie, ("X-NCC-CSRF", &root.csrf[1..])],
        vec![cookie, ("X-NCC-CSRF", root.csrf.as_str()), ("Origin", "http://example.com")],
        vec![cookie, ("X-NCC-CSRF", root.csrf.as_str()), ("Origin", "null")],
        // The value can be in no address and in no cookie.
        vec![("Cookie", &*format!("{}; X-NCC-CSRF={}", root.cookie, root.csrf))],
    ] {
        assert_eq!(status(&server, "POST", new, &wrong), 403, "{wrong:?}");
    }
    for method in ["PUT", "PATCH", "DELETE", "POST", "BREW"] {
        assert_eq!(status(&server, method, "/api/v1/accounts/root", &[cookie]), 403, "{method}");
    }
    assert_eq!(status(&server, "DELETE", "/api/v1/session", &[cookie]), 403);
    assert_eq!(status(&server, "POST", &format!("{new}&csrf={}", root.csrf), &[cookie]), 403);
    let own = format!("http://{}", server.address);
    let right = [cookie, ("X-NCC-CSRF", root.csrf.as_str()), ("Origin", own.as_str())];
    assert_eq!(status(&server, "POST", new, &right), 201);
}

/// A login makes a secret of its own, whatever cookie somebody has given to the browser before.
#[test]
fn a_session_is_not_chosen_by_others() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let chosen = format!("ncc_session={}", "a".repeat(52));
    let asked = json!({ "user": "root", "password": PASSWORD }).to_string();
    let log_in_with = |cookie: &str| {
        let headers = [("Content-Type", "application/json"), ("Cookie", cookie)];
        session(&server.ask("POST", "/api/v1/session", &headers, asked.as_bytes()))
    };
    let own = log_in_with(&chosen);
    assert_ne!(own.cookie, chosen);
    assert_eq!(status(&server, "GET", "/api/v1/programs", &[("Cookie", &chosen)]), 401);
    // The session before it ends.
    let again = log_in_with(&own.cookie);
    assert_ne!(again.cookie, own.cookie);
    assert_eq!(own.get(&server, "/api/v1/programs").status, 401);
    assert_eq!(again.get(&server, "/api/v1/programs").status, 200);
    assert_eq!(root.get(&server, "/api/v1/programs").status, 200);
}

/// Secrets in other places than theirs, secrets of another kind, and several at once.
#[test]
fn a_secret_is_taken_from_its_place_alone() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let made =
        root.ask(&server, "POST", "/api/v1/tokens", &json!({ "name": "t", "scopes": ["admin", "change"] }));
    let token = made.json()["token"].as_str().expect("a token").to_owned();
    let secret = root.cookie.split_once('=').expect("a secret").1.to_owned();
    let (bearer, basic) = (format!("Bearer {token}"), format!("Basic {token}"));
    assert_eq!(status(&server, "GET", "/api/v1/programs", &[("Authorization", &bearer)]), 200);
    for name in ["token", "access_token", "bearer", "key", "api_key", "ncc_session"] {
        let target = format!("/api/v1/programs?{name}={token}");
        assert_eq!(server.get(&target).status, 401, "{name}");
    }
    let session_as_token = format!("Bearer {secret}");
    let long = format!("Bearer ncc_{}", "a".repeat(60_000));
    for wrong in [
        vec![("Authorization", basic.as_str())],
        vec![("Authorization", token.as_str())],
        vec![("Authorization", session_as_token.as_str())],
        vec![("Authorization", "Bearer ")],
        vec![("Authorization", "Bearer ncc_")],
        vec![("Authorization", "Bearer ncc_' OR '1'='1")],
        vec![("Authorization", long.as_str())],
        vec![("Authorization", &bearer[..bearer.len() - 1])],
        vec![("Authorization", &*bearer.to_uppercase())],
        vec![("Authorization", bearer.as_str()), ("Authorization", "Bearer ncc_x")],
        // A token that is wrong is not made good by a cookie.
        vec![("Authorization", "Bearer ncc_x"), ("Cookie", root.cookie.as_str())],
        vec![("Proxy-Authorization", bearer.as_str())],
        vec![("X-NCC-User", "root"), ("X-Remote-User", "root"), ("X-Forwarded-User", "root")],
        vec![("Cookie", &*format!("ncc_session={token}"))],
        vec![("Cookie", &*format!("{0}; {0}", root.cookie))],
        vec![("Cookie", root.cookie.as_str()), ("Cookie", "ncc_session=x")],
        vec![("Cookie", &*root.cookie.to_uppercase())],
        vec![("Cookie", "ncc_session=")],
    ] {
        assert_eq!(status(&server, "GET", "/api/v1/programs", &wrong), 401, "{wrong:?}");
    }
    // An address that only looks as one that is open.
    for target in [
        "/api/v1/session/",
        "//api/v1/session",
        "/api/v1/%73ession",
        "/api/v1/session/x",
        "/api/v1/session;x",
        "/x",
    ] {
        assert_eq!(server.get(target).status, 401, "{target}");
    }
    let secrets = [secret, root.csrf.clone(), token];
    for table in ["login", "token", "audit"] {
        let column = if table == "audit" { "subject || detail" } else { "digest || account" };
        for row in server.select(&format!("SELECT {column} FROM {table}")) {
            assert!(secrets.iter().all(|secret| !row.contains(secret.as_str())), "{table}: {row}");
        }
    }
}

/// The rights of an account that is changed are gone at once, and so are those of its sessions and tokens.
#[test]
fn rights_are_lost_at_once() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("", "editor")]);
    let made =
        ben.ask(&server, "POST", "/api/v1/tokens", &json!({ "name": "t", "scopes": ["read", "change"] }));
    let token = User::token(made.json()["token"].as_str().expect("a token"));
    let change = |asked: Value| {
        let changed = root.ask(&server, "PATCH", "/api/v1/accounts/ben", &asked);
        assert_eq!(changed.status, 200, "{}", changed.text());
    };
    let new = |by: &User, name: &str| {
        by.ask(&server, "POST", &format!("/api/v1/programs?name={name}"), &PROGRAM.into()).status
    };
    assert_eq!([new(&ben, "a"), new(&token, "b")], [201, 201]);
    change(json!({ "rights": [{ "role": "reader" }] }));
    assert_eq!([new(&ben, "c"), new(&token, "d")], [403, 403]);
    let seen = |by: &User| by.get(&server, "/api/v1/programs").json()["programs"].as_array().map(Vec::len);
    assert_eq!([seen(&ben), seen(&token)], [Some(2), Some(2)]);
    change(json!({ "rights": [] }));
    assert_eq!([seen(&ben), seen(&token)], [Some(0), Some(0)]);
    change(json!({ "rights": [{ "role": "releaser" }], "disabled": true }));
    let get = |by: &User| by.get(&server, "/api/v1/programs").status;
    assert_eq!([get(&ben), get(&token), log_in(&server, "ben", PASSWORD).status], [401, 401, 401]);
    // Neither comes back with the account.
    change(json!({ "disabled": false }));
    assert_eq!([get(&ben), get(&token), log_in(&server, "ben", PASSWORD).status], [401, 401, 200]);
    let ben = user(&server, "ben");
    change(json!({ "password": "given by the admin" }));
    assert_eq!([get(&ben), log_in(&server, "ben", PASSWORD).status], [401, 401]);
}

/// Somebody can always administer.
#[test]
fn the_last_admin_stays() {
    let server = Server::limited(limits());
    // The first account is an admin of everything: nobody could make others.
    for rights in [&[][..], &[("", "releaser")], &[("plates", "editor")]] {
        let first =
            server.json("POST", "/api/v1/accounts", super::account("a", rights).to_string().as_bytes());
        assert_eq!(first.status, 409, "{}", first.text());
    }
    assert_eq!(server.get("/api/v1/session").json()["login"], "none");
    let root = admin(&server);
    let patch = |asked: Value| root.ask(&server, "PATCH", "/api/v1/accounts/root", &asked).status;
    assert_eq!(patch(json!({ "rights": [] })), 409);
    assert_eq!(patch(json!({ "rights": [{ "folder": "", "role": "releaser" }] })), 409);
    assert_eq!(patch(json!({ "disabled": true })), 409);
    assert_eq!(root.ask(&server, "DELETE", "/api/v1/accounts/root", &Value::Null).status, 409);
    assert_eq!(root.get(&server, "/api/v1/accounts/root").json()["rights"][0]["role"], "admin");
    with_rights(&server, &root, "second", &[("", "admin")]);
    assert_eq!(root.ask(&server, "DELETE", "/api/v1/accounts/root", &Value::Null).status, 204);
    assert_eq!(root.get(&server, "/api/v1/accounts").status, 401);
}

/// An account has a name that looks as no other one, and folders that are folders.
#[test]
fn what_is_wrong_with_an_account_is_refused() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let make = |name: &str, rights: Value| {
        let account = json!({ "name": name, "password": PASSWORD, "rights": rights });
        root.ask(&server, "POST", "/api/v1/accounts", &account).status
    };
    for name in ["", "Root", "r\u{43e}ot", "root ", "a/b", "..", "a\nb", "\u{202e}toor", &"a".repeat(65)] {
        assert_eq!(make(name, json!([])), 422, "{name:?}");
    }
    assert_eq!(make("root", json!([])), 409);
    for folder in ["plates/", "/plates", "plates//left", "plates/../secret", ".", "a\u{0}b", "a\tb"] {
        assert_eq!(make("ben", json!([{ "folder": folder, "role": "reader" }])), 422, "{folder:?}");
    }
    for rights in [
        json!([{ "folder": "plates", "role": "admin" }]),
        json!([{ "folder": "", "role": "root" }]),
        json!([{ "folder": "a", "role": "reader" }, { "folder": "a", "role": "editor" }]),
        json!([{ "folder": "a", "role": "reader", "rank": 5 }]),
        json!("admin"),
    ] {
        assert_eq!(make("ben", rights.clone()), 422, "{rights}");
    }
    assert_eq!(make("ben", json!([{ "folder": "plates", "role": "editor" }])), 201);
}
