//! Tokens: no more than their scopes, and no more than their accounts.

use serde_json::{Value, json};

use super::{User, admin, limits, make, user, with_rights};
use crate::client::{PROGRAM, Server};

fn token(server: &Server, by: &User, scopes: &[&str]) -> (String, User) {
    let made = by.ask(server, "POST", "/api/v1/tokens", &json!({ "name": "erp", "scopes": scopes }));
    assert_eq!(made.status, 201, "{}", made.text());
    let made = made.json();
    let text = |name: &str| made[name].as_str().expect("a text").to_owned();
    assert!(text("token").starts_with("ncc_") && text("token").len() == 56, "{made}");
    (text("id"), User::token(&text("token")))
}

#[test]
fn a_token_does_what_its_scopes_say() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let program = make(&server, &root, "/api/v1/programs?name=a.cn&dialect=mach9", &PROGRAM.into());
    let translation =
        make(&server, &root, "/api/v1/translations", &json!({ "program": program, "to": "fanuc" }));
    let states = format!("/api/v1/translations/{translation}/states");
    let acts = |by: &User| {
        let step = |state: &str| by.ask(&server, "POST", &states, &json!({ "state": state })).status;
        [
            by.get(&server, &format!("/api/v1/programs/{program}")).status,
            by.ask(&server, "POST", "/api/v1/jobs", &json!({ "under": "nothing", "to": "fanuc" })).status,
            step("obsolete"),
            by.get(&server, "/api/v1/audit").status,
            by.get(&server, "/api/v1/tokens").status,
        ]
    };
    // An act that is allowed, and cannot be done now, is 409.
    assert_eq!(acts(&root), [200, 202, 200, 200, 200]);
    assert_eq!(acts(&token(&server, &root, &["read"]).1), [200, 403, 403, 403, 403]);
    assert_eq!(acts(&token(&server, &root, &["change"]).1), [200, 202, 403, 403, 403]);
    assert_eq!(acts(&token(&server, &root, &["release"]).1), [200, 403, 409, 403, 403]);
    assert_eq!(acts(&token(&server, &root, &["admin", "admin"]).1), [200, 403, 403, 200, 403]);
    // No scope makes an account stronger than it is.
    let ben = with_rights(&server, &root, "ben", &[("", "reader")]);
    let (_, all) = token(&server, &ben, &["read", "change", "release", "admin"]);
    assert_eq!(acts(&all), [200, 403, 403, 403, 403]);
}

#[test]
fn a_token_is_made_listed_and_taken_back() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("", "reader")]);
    let (id, own) = token(&server, &ben, &["read"]);
    let (other, _) = token(&server, &root, &["read"]);
    let listed = ben.get(&server, "/api/v1/tokens").json();
    let all = listed["tokens"].as_array().expect("a list");
    assert_eq!((all.len(), &all[0]["id"], &all[0]["scopes"]), (1, &json!(id), &json!(["read"])));
    assert!(all[0]["token"].is_null() && !listed.to_string().contains("ncc_"), "{listed}");
    // That of another account is as one that is not there.
    for id in [&other, "nothing"] {
        assert_eq!(ben.ask(&server, "DELETE", &format!("/api/v1/tokens/{id}"), &Value::Null).status, 404);
    }
    assert_eq!(own.get(&server, "/api/v1/programs").status, 200);
    assert_eq!(ben.ask(&server, "DELETE", &format!("/api/v1/tokens/{id}"), &Value::Null).status, 204);
    assert_eq!(own.get(&server, "/api/v1/programs").status, 401);
    // Each ends.
    let (id, own) = token(&server, &root, &["read"]);
    assert_eq!(own.get(&server, "/api/v1/programs").status, 200);
    server.sql(&format!("UPDATE token SET expires = 1 WHERE id = '{id}'")).expect("time goes by");
    assert_eq!(own.get(&server, "/api/v1/programs").status, 401);
    for asked in [
        json!({ "name": "", "scopes": ["read"] }),
        json!({ "name": "t", "scopes": [] }),
        json!({ "name": "t", "scopes": ["root"] }),
        json!({ "name": "t", "scopes": ["read"], "expires": "2020-01-01T00:00:00Z" }),
        json!({ "name": "t", "scopes": ["read"], "expires": "soon" }),
        json!({ "name": "t", "scopes": ["read"], "account": "root" }),
    ] {
        assert_eq!(ben.ask(&server, "POST", "/api/v1/tokens", &asked).status, 422, "{asked}");
    }
    let asked = json!({ "name": "t", "scopes": ["read"], "expires": "2099-01-01T00:00:00Z" });
    let made = ben.ask(&server, "POST", "/api/v1/tokens", &asked);
    assert_eq!(made.json()["expires"], "2099-01-01T00:00:00Z", "{}", made.text());
    // Without accounts there are no tokens.
    let alone = Server::limited(limits());
    let made = alone.json("POST", "/api/v1/tokens", asked.to_string().as_bytes());
    assert_eq!(made.status, 409, "{}", made.text());
    // Those of a disabled account are nobody's.
    let (_, own) = token(&server, &user(&server, "ben"), &["read"]);
    server.sql("UPDATE account SET is_disabled = TRUE WHERE name = 'ben'").expect("it is disabled");
    assert_eq!(own.get(&server, "/api/v1/programs").status, 401);
}
