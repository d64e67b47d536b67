//! Logins: what is right, what is guessed, and what is sent instead of a password.

use std::time::Duration;

use ncc_service::{Limits, Rate};
use serde_json::{Value, json};

use super::{PASSWORD, User, admin, limits, log_in, session, user, with_rights};
use crate::client::Server;

const RARELY: Duration = Duration::from_secs(1000);

#[test]
fn a_login_begins_a_session_and_a_logout_ends_it() {
    let server = Server::limited(limits());
    let none = server.get("/api/v1/session").json();
    assert_eq!((&none["user"], &none["login"]), (&json!("ana"), &json!("none")), "{none}");
    assert_eq!(none["rights"], json!([{ "folder": "", "role": "admin" }]));
    assert_eq!(log_in(&server, "root", PASSWORD).status, 409);
    let root = admin(&server);
    let out = server.get("/api/v1/session").json();
    assert_eq!(out, json!({ "user": null, "login": "needed", "rights": [], "csrf": "" }));
    let answer = log_in(&server, "root", PASSWORD);
    let cookie = answer.header("set-cookie").to_owned();
    for part in ["; HttpOnly", "; SameSite=Strict", "; Path=/", "; Max-Age=604800"] {
        assert!(cookie.contains(part), "{cookie}");
    }
    assert!(!cookie.contains("Secure") && !cookie.contains("Domain"), "{cookie}");
    let own = session(&answer);
    let told = own.get(&server, "/api/v1/session").json();
    assert_eq!((&told["user"], &told["csrf"]), (&json!("root"), &json!(own.csrf)));
    assert_eq!(own.get(&server, "/api/v1/programs").status, 200);
    assert_eq!(own.ask(&server, "DELETE", "/api/v1/session", &Value::Null).status, 204);
    for user in [&own, &User::default()] {
        let answer = user.get(&server, "/api/v1/programs");
        assert_eq!((answer.status, answer.header("www-authenticate")), (401, "Bearer realm=\"ncc\""));
    }
    // The other session goes on, until nobody has used it for 12 hours, or for 7 days.
    assert_eq!(root.get(&server, "/api/v1/programs").status, 200);
    for column in ["seen", "made"] {
        let root = user(&server, "root");
        server.sql(&format!("UPDATE login SET {column} = {column} - 700000")).expect("time goes by");
        assert_eq!(root.get(&server, "/api/v1/programs").status, 401, "{column}");
    }
}

/// A guess learns nothing: neither which accounts are there, nor which are disabled.
#[test]
fn a_wrong_user_looks_as_a_wrong_password() {
    let server = Server::limited(limits());
    let root = admin(&server);
    with_rights(&server, &root, "ben", &[("", "reader")]);
    with_rights(&server, &root, "gone", &[("", "reader")]);
    assert_eq!(root.ask(&server, "DELETE", "/api/v1/accounts/gone", &Value::Null).status, 204);
    let answers =
        [("ben", "wrong password"), ("nobody", PASSWORD), ("gone", PASSWORD), ("", ""), ("BEN", PASSWORD)]
            .map(|(user, password)| log_in(&server, user, password));
    for answer in &answers {
        assert_eq!((answer.status, &answer.body), (401, &answers[0].body), "{}", answer.text());
        assert_eq!(answer.header("set-cookie"), "");
    }
}

#[test]
fn guesses_are_counted() {
    let few = Limits { attempts: Rate { burst: 4, every: RARELY }, ..limits() };
    let server = Server::limited(few);
    let root = admin(&server);
    // Those that are right do not count.
    (0..10).for_each(|_| drop(user(&server, "root")));
    for (number, name) in ["root", "other", "third", "fourth", "root", "root"].iter().enumerate() {
        let asked = json!({ "user": name, "password": "a wrong one" }).to_string();
        // A header that names another client is not believed.
        let forwarded = format!("198.51.100.{number}");
        let headers = [
            ("Content-Type", "application/json"),
            ("X-Forwarded-For", forwarded.as_str()),
            ("Forwarded", "for=198.51.100.77"),
            ("X-Real-IP", forwarded.as_str()),
        ];
        let answer = server.ask("POST", "/api/v1/session", &headers, asked.as_bytes());
        assert_eq!(answer.status, if number < 4 { 401 } else { 429 }, "{number}: {}", answer.text());
        if answer.status == 429 {
            let wait: u64 = answer.header("retry-after").parse().expect("seconds");
            assert!((1..=1001).contains(&wait), "{wait}");
        }
    }
    assert_eq!(log_in(&server, "root", PASSWORD).status, 429);
    // Running sessions go on.
    let audit = root.get(&server, "/api/v1/audit?action=login.failed").json();
    let all = audit["audit"].as_array().expect("a list");
    assert_eq!(all.len(), 4);
    assert!(all.iter().all(|entry| entry["address"] == "127.0.0.1"), "{audit}");
}

/// A malformed password takes neither memory nor time.
#[test]
fn a_login_has_its_form() {
    let server = Server::limited(limits());
    let root = admin(&server);
    for (password, status) in [
        ("x".repeat(1024), 401),
        ("x".repeat(100_000), 401),
        ("x".repeat(200_000), 413),
        ("x".repeat(20_000_000), 413),
        ("\0".repeat(100), 401),
        ("\u{202e}drow".to_owned(), 401),
    ] {
        assert_eq!(log_in(&server, "root", &password).status, status, "{} bytes", password.len());
    }
    for body in [
        "",
        "[]",
        "null",
        "{}",
        "{\"user\": \"root\"}",
        "{\"user\": [\"root\"], \"password\": {\"$ne\": \"\"}}",
        "{\"user\": \"root\", \"password\": null}",
        "{\"user\": \"root\", \"password\": \"correct horse\", \"role\": \"admin\"}",
        "user=root&password=correct+horse",
    ] {
        let answer = server.json("POST", "/api/v1/session", body.as_bytes());
        assert_eq!((answer.status, answer.header("set-cookie")), (422, ""), "{body}");
    }
    let form = [("Content-Type", "application/x-www-form-urlencoded")];
    assert_eq!(server.ask("POST", "/api/v1/session", &form, b"user=root&password=correct+horse").status, 415);
    // A password of an account is long enough, and not too long.
    for password in ["", "short", "123456789", &"x".repeat(1025)] {
        let account = json!({ "name": "ben", "password": password, "rights": [] });
        assert_eq!(root.ask(&server, "POST", "/api/v1/accounts", &account).status, 422, "{password:?}");
    }
}

/// The digest of a password that would take all memory, put into the database by somebody else.
#[test]
fn a_digest_that_costs_too_much_is_not_computed() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let cheap = server.select("SELECT password FROM account").pop().expect("a digest");
    assert!(cheap.starts_with("$argon2id$v=19$m=8,t=1,p=1$"), "{cheap}");
    for bomb in [
        cheap.replace("m=8", "m=4294967295"),
        cheap.replace("t=1", "t=4294967295"),
        cheap.replace("p=1", "p=16777215"),
        cheap.replace("argon2id", "argon2x"),
        String::new(),
        "$".repeat(1000),
    ] {
        server.sql(&format!("UPDATE account SET password = '{bomb}'")).expect("it is changed");
        assert_eq!(log_in(&server, "root", PASSWORD).status, 401, "{bomb}");
    }
    assert_eq!(root.get(&server, "/api/v1/programs").status, 200);
    server.sql(&format!("UPDATE account SET password = '{cheap}'")).expect("it is changed back");
    assert_eq!(log_in(&server, "root", PASSWORD).status, 200);
}

#[test]
fn another_password_ends_the_other_sessions() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let [one, other] = [0, 1].map(|_| user(&server, "root"));
    let change = |by: &User, old: &str, new: &str| {
        by.ask(&server, "PUT", "/api/v1/session/password", &json!({ "old": old, "new": new })).status
    };
    let token = one.ask(&server, "POST", "/api/v1/tokens", &json!({ "name": "t", "scopes": ["admin"] }));
    let token = User::token(token.json()["token"].as_str().expect("a token"));
    // A session, or a token, without the password cannot change it.
    assert_eq!(change(&one, "not it at all", "another password"), 401);
    assert_eq!(change(&token, PASSWORD, "another password"), 403);
    assert_eq!(change(&one, PASSWORD, "short"), 422);
    assert_eq!(change(&one, PASSWORD, "another password"), 204);
    let statuses = [&one, &other, &root].map(|user| user.get(&server, "/api/v1/programs").status);
    assert_eq!(statuses, [200, 401, 401]);
    assert_eq!(log_in(&server, "root", PASSWORD).status, 401);
    assert_eq!(log_in(&server, "root", "another password").status, 200);
}

#[test]
fn each_account_has_its_rate() {
    let few = Limits { requests: Rate { burst: 30, every: RARELY }, ..limits() };
    let server = Server::limited(few);
    // The user of this computer has no limit.
    for _ in 0..40 {
        assert_eq!(server.get("/api/v1/programs").status, 200);
    }
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("", "reader")]);
    let statuses: Vec<u16> = (0..40).map(|_| ben.get(&server, "/api/v1/programs").status).collect();
    assert_eq!(statuses.iter().filter(|status| **status == 200).count(), 30, "{statuses:?}");
    let late = ben.get(&server, "/api/v1/programs");
    assert!(late.status == 429 && !late.header("retry-after").is_empty(), "{}", late.text());
    assert_eq!(root.get(&server, "/api/v1/programs").status, 200);
    // Without a login it is the address that counts, and another one's account goes on.
    let statuses: Vec<u16> = (0..40).map(|_| server.get("/api/v1/programs").status).collect();
    assert!(statuses.contains(&401) && statuses.last() == Some(&429), "{statuses:?}");
    assert_eq!(root.get(&server, "/api/v1/programs").status, 200);
}

#[test]
fn work_of_the_compiler_has_a_rate_of_its_own() {
    let few = Limits { work_of_one: Rate { burst: 2, every: RARELY }, ..limits() };
    let server = Server::limited(few);
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("", "editor")]);
    let ask = |by: &User, name: &str| {
        by.ask(&server, "POST", &format!("/transpiler/{name}?dialect=mach9"), &crate::client::PROGRAM.into())
            .status
    };
    assert_eq!([ask(&ben, "a"), ask(&ben, "b"), ask(&ben, "c"), ask(&root, "d")], [201, 201, 429, 201]);
    assert_eq!(ben.get(&server, "/persistence/a").status, 200);
}
