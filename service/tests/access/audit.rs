//! The audit: each change is in it, and none can be taken out unseen.

use ncc_service::{Role, Scope, Users};
use serde_json::{Value, json};

use super::{CHEAP, PASSWORD, User, admin, limits, log_in, make, user, with_rights};
use crate::client::{PROGRAM, Server, TABLE_10};

/// Account, way, action and subject of all entries, the oldest first.
fn entries(server: &Server, by: &User, query: &str) -> Vec<[String; 4]> {
    let told = by.get(server, &format!("/api/v1/audit?limit=1000{query}"));
    assert_eq!(told.status, 200, "{}", told.text());
    let told = told.json();
    let text = |entry: &Value, name: &str| entry[name].as_str().expect("a text").to_owned();
    let entry = |entry: &Value| ["account", "way", "action", "subject"].map(|name| text(entry, name));
    told["audit"].as_array().expect("a list").iter().rev().map(entry).collect()
}

#[test]
fn each_change_is_in_the_audit() {
    let server = Server::limited(limits());
    make(&server, &User::default(), "/api/v1/programs?name=before.cn", &PROGRAM.into());
    let root = admin(&server);
    let known = entries(&server, &root, "").len();
    let ask = |method: &str, target: &str, body: Value| {
        let answer = root.ask(&server, method, target, &body);
        assert!(answer.status < 300, "{method} {target}: {}", answer.text());
        answer
    };
    let program = make(&server, &root, "/api/v1/programs?name=a.cn&folder=f&dialect=mach9", &PROGRAM.into());
    let path = format!("/api/v1/programs/{program}");
    ask("PUT", &format!("{path}/text"), format!("{PROGRAM}G0X3.\n").into());
    ask("PATCH", &path, json!({ "tags": ["t"] }));
    ask("DELETE", &path, Value::Null);
    ask("POST", &format!("{path}/revisions/1/restore"), Value::Null);
    let translation =
        make(&server, &root, "/api/v1/translations", &json!({ "program": program, "to": "fanuc" }));
    ask("POST", &format!("/api/v1/translations/{translation}/states"), json!({ "state": "in-review" }));
    let job = make(&server, &root, "/api/v1/jobs", &json!({ "under": "nothing", "to": "fanuc" }));
    ask("DELETE", &format!("/api/v1/jobs/{job}"), Value::Null);
    ask("PUT", "/api/v1/machines/romi", serde_json::from_str(TABLE_10).expect("JSON"));
    ask("DELETE", "/api/v1/machines/romi", Value::Null);
    ask("POST", "/transpiler/d.cn?dialect=mach9", PROGRAM.into());
    ask("PUT", "/transpiler/d.cn", PROGRAM.into());
    ask("DELETE", "/persistence/d.cn", Value::Null);
    ask("POST", "/api/v1/accounts", super::account("ben", &[("f", "reader")]));
    ask(
        "PATCH",
        "/api/v1/accounts/ben",
        json!({ "rights": [], "password": "a new password", "disabled": true }),
    );
    ask("PATCH", "/api/v1/accounts/ben", json!({ "disabled": false }));
    let token = make(&server, &root, "/api/v1/tokens", &json!({ "name": "t", "scopes": ["read"] }));
    ask("DELETE", &format!("/api/v1/tokens/{token}"), Value::Null);
    assert_eq!(log_in(&server, "root", "not the password").status, 401);
    assert_eq!(log_in(&server, "perhaps a password", "root").status, 401);
    let other = user(&server, "root");
    assert_eq!(other.ask(&server, "DELETE", "/api/v1/session", &Value::Null).status, 204);
    ask("GET", "/api/v1/audit?form=csv", Value::Null);
    let all = entries(&server, &root, "");
    let new: Vec<(&str, &str)> =
        all[known..].iter().map(|[_, _, action, subject]| (action.as_str(), subject.as_str())).collect();
    let expected = [
        ("program.created", program.as_str()),
        ("program.text", &program),
        ("program.details", &program),
        ("program.deleted", &program),
        ("program.restored", &program),
        ("translation.create", &translation),
        ("translation.state", &translation),
        ("job.create", &job),
        ("job.cancel", &job),
        ("machine.put", "romi"),
        ("machine.delete", "romi"),
        ("document.create", "d.cn"),
        ("document.replace", "d.cn"),
        ("document.delete", "d.cn"),
        ("account.create", "ben"),
        ("account.rights", "ben"),
        ("account.password", "ben"),
        ("account.disable", "ben"),
        ("account.enable", "ben"),
        ("token.create", &token),
        ("token.delete", &token),
        ("login.failed", "root"),
        ("login.failed", ""),
        ("login", "root"),
        ("logout", "root"),
        ("audit.export", "audit"),
    ];
    assert_eq!(new, expected);
    assert_eq!(all[0][..3], ["ana", "local", "program.created"].map(str::to_owned));
    assert_eq!(all[1], ["ana", "local", "account.create", "root"].map(str::to_owned));
    assert!(all[known..].iter().all(|[account, way, action, _]| {
        action == "login.failed" || (account == "root" && way == "login")
    }));
    // A refused request changes nothing and has no entry.
    let ben = with_rights(&server, &root, "eva", &[("", "reader")]);
    let before = entries(&server, &root, "").len();
    assert_eq!(ben.ask(&server, "DELETE", &path, &Value::Null).status, 403);
    assert_eq!(root.ask(&server, "PATCH", "/api/v1/accounts/root", &json!({ "disabled": true })).status, 409);
    assert_eq!(entries(&server, &root, "").len(), before);
}

#[test]
fn the_audit_is_filtered_and_comes_page_by_page() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let ben = with_rights(&server, &root, "ben", &[("", "editor")]);
    let programs: Vec<String> = (0..5)
        .map(|number| make(&server, &ben, &format!("/api/v1/programs?name={number}"), &PROGRAM.into()))
        .collect();
    assert_eq!(entries(&server, &root, "&account=ben&action=program.created").len(), 5);
    assert_eq!(entries(&server, &root, "&account=root&action=program.created").len(), 0);
    assert_eq!(entries(&server, &root, &format!("&subject={}", programs[2])).len(), 1);
    assert_eq!(entries(&server, &root, "&from=2099-01-01T00:00:00Z").len(), 0);
    let all = entries(&server, &root, "&until=2099-01-01T00:00:00Z&from=2020-01-01T00:00:00Z");
    let (mut paged, mut before) = (Vec::new(), String::new());
    loop {
        let page = root.get(&server, &format!("/api/v1/audit?limit=2{before}")).json();
        paged.extend(page["audit"].as_array().expect("a list").iter().map(|entry| entry["number"].as_i64()));
        let Some(next) = page["next"].as_i64() else { break };
        before = format!("&before={next}");
    }
    assert_eq!(paged, (1..=all.len() as i64).rev().map(Some).collect::<Vec<_>>());
    for wrong in ["from=yesterday", "form=xml", "who=ben", "before=x", "form=csv&before=3"] {
        assert_eq!(root.get(&server, &format!("/api/v1/audit?{wrong}")).status, 400, "{wrong}");
    }
    let table = root.get(&server, "/api/v1/audit?form=csv&account=ben");
    assert_eq!(table.header("content-type"), "text/csv; charset=utf-8; header=present");
    let text = table.text();
    assert!(
        text.contains("number,moment,account,way,address,request,action,subject,detail,digest\r\n"),
        "{text}"
    );
    assert_eq!(text.matches("\"program.created\"").count(), 5, "{text}");
}

/// Neither a mistake nor a hand in the database changes the audit unseen.
#[test]
fn the_audit_is_kept() {
    let server = Server::limited(limits());
    let root = admin(&server);
    for number in 0..6 {
        make(&server, &root, &format!("/api/v1/programs?name={number}"), &PROGRAM.into());
    }
    let users = || Users::with_cost(&server.place(), "op", CHEAP).expect("the database");
    let line = users().audit().expect("it holds");
    assert!(line.starts_with("8 entries, each follows the one before it"), "{line}");
    for sql in [
        "UPDATE audit SET account = 'somebody else' WHERE number = 4",
        "UPDATE audit SET detail = detail",
        "DELETE FROM audit WHERE number = 4",
        "DELETE FROM audit",
    ] {
        let refused = server.sql(sql).expect_err(sql);
        assert!(refused.contains("append-only"), "{refused}");
    }
    // Somebody who may change the form of the database is found by the chain.
    let drop = match server.place() {
        ncc_service::Place::File(_) => "DROP TRIGGER audit_kept; DROP TRIGGER audit_stays;",
        ncc_service::Place::Server(_) => "DROP TRIGGER audit_kept ON audit;",
    };
    server.sql(drop).expect("it is dropped");
    let before = server.select("SELECT account FROM audit WHERE number = 4").pop().expect("an entry");
    for (hand, undone, found) in [
        (
            "UPDATE audit SET account = 'mallory' WHERE number = 4",
            format!("UPDATE audit SET account = '{before}' WHERE number = 4"),
            "entry 4",
        ),
        (
            "UPDATE audit SET moment = moment - 1 WHERE number = 1",
            "UPDATE audit SET moment = moment + 1 WHERE number = 1".to_owned(),
            "entry 1",
        ),
        (
            "UPDATE audit SET number = 99 WHERE number = 8",
            "UPDATE audit SET number = 8 WHERE number = 99".to_owned(),
            "entry 99",
        ),
        ("DELETE FROM audit WHERE number = 5", String::new(), "entry 6"),
    ] {
        server.sql(hand).expect("it is changed");
        let broken = users().audit().expect_err(hand);
        assert!(broken.reason.starts_with(found), "{hand}: {}", broken.reason);
        server.sql(&undone).expect("it is undone");
        assert_eq!(users().audit().is_ok(), !undone.is_empty(), "{hand}");
    }
}

/// Accounts by the command line, while a server runs.
#[test]
fn accounts_of_the_command_line_hold_at_once() {
    let server = Server::limited(limits());
    let users = Users::with_cost(&server.place(), "op", CHEAP).expect("the database");
    assert_eq!(server.get("/api/v1/programs").status, 200);
    let reason = users.add("ben", Role::Reader, "", PASSWORD).expect_err("no admin").reason;
    assert!(reason.contains("admin"), "{reason}");
    users.add("root", Role::Admin, "", PASSWORD).expect("an account");
    users.add("ben", Role::Editor, "plates", PASSWORD).expect("an account");
    let since = std::time::Instant::now();
    while server.get("/api/v1/programs").status == 200 {
        assert!(since.elapsed() < std::time::Duration::from_secs(10), "it is known within 250 ms");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert_eq!(users.list().expect("a list"), ["ben: editor in plates", "root: admin"]);
    let token = users.token("root", "erp", vec![Scope::Admin], None).expect("a token");
    let root = User::token(&token);
    assert_eq!(root.get(&server, "/api/v1/accounts").status, 200);
    assert_eq!(user(&server, "ben").get(&server, "/api/v1/programs").status, 200);
    users.password("ben", "another password").expect("it is changed");
    assert_eq!(
        [log_in(&server, "ben", PASSWORD).status, log_in(&server, "ben", "another password").status],
        [401, 200]
    );
    users.disable("ben").expect("it is disabled");
    assert_eq!(log_in(&server, "ben", "another password").status, 401);
    assert_eq!(users.list().expect("a list")[0], "ben: editor in plates (disabled)");
    for wrong in [
        users.add("Ben", Role::Reader, "", PASSWORD),
        users.add("ben", Role::Reader, "", PASSWORD),
        users.add("eva", Role::Admin, "plates", PASSWORD),
        users.add("eva", Role::Reader, "../plates", PASSWORD),
        users.add("eva", Role::Reader, "", "short"),
        users.disable("eva"),
        users.disable("root"),
        users.password("eva", PASSWORD),
        users.token("eva", "t", vec![Scope::Read], None).map(drop),
        users.token("ben", "t", vec![Scope::Read], None).map(drop),
        users.token("root", "t", Vec::new(), None).map(drop),
    ] {
        assert!(wrong.is_err());
    }
    let by_command = entries(&server, &root, "&account=op");
    assert!(
        by_command.len() >= 5 && by_command.iter().all(|[_, way, ..]| way == "command"),
        "{by_command:?}"
    );
}
