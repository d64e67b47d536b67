//! Every address, every method, every role.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::{User, account, admin, limits, make, user, with_rights};
use crate::client::{PROGRAM, Server, TABLE_10, repository};

/// The weakest role that may, in the order of their strength.
const ROLES: [&str; 6] = ["none", "reader", "editor", "reviewer", "releaser", "admin"];

/// An address, with a method. `{program}` and others are new things, made for each request.
struct Row {
    method: &'static str,
    path: &'static str,
    /// More of the address.
    query: &'static str,
    body: Body,
    /// The weakest role that may.
    least: &'static str,
    /// The answer to those who may.
    done: u16,
    /// The answer to an account without rights that may not; those with rights that may not get 403.
    hidden: u16,
}

#[derive(Clone, Copy)]
enum Body {
    None,
    Program,
    Dictionary,
    Json(fn(&Things) -> Value),
}

/// New things.
struct Things {
    program: String,
    translation: String,
    job: String,
    name: String,
}

const fn row(
    method: &'static str,
    path: &'static str,
    query: &'static str,
    least: &'static str,
    done: u16,
    hidden: u16,
) -> Row {
    Row { method, path, query, body: Body::None, least, done, hidden }
}

const fn with(row: Row, body: Body) -> Row {
    Row { body, ..row }
}

fn payload(own: &Things) -> Value {
    named_payload(&own.name)
}

/// A payload in the place of the document that was made.
fn payload_over(own: &Things) -> Value {
    named_payload(&format!("{}-d", own.name))
}

/// A dictionary that adds nothing to its base.
fn dictionary(name: &str) -> String {
    format!("id = {name:?}\ntitle = \"\"\nbase = \"fanuc\"\n")
}

fn named_payload(name: &str) -> Value {
    json!({ "prog_name": name, "machine_name": "romi", "dialect": "mach9", "blocks": [] })
}

/// The target of hooks. No event is about their folder, so nothing is sent there.
const TARGET: &str = "http://127.0.0.1:9/";

fn hook() -> Value {
    json!({ "target": format!("{TARGET}a"), "events": ["release"], "folder": "nothing/here" })
}

/// Addresses of programs, translations and jobs.
fn programs() -> Vec<Row> {
    let translation: fn(&Things) -> Value = |own| json!({ "program": own.program, "to": "fanuc" });
    vec![
        row("GET", "/api/v1/programs", "", "none", 200, 0),
        with(
            row("POST", "/api/v1/programs", "?name={name}&folder=plates", "editor", 201, 403),
            Body::Program,
        ),
        row("GET", "/api/v1/folders", "", "none", 200, 0),
        row("GET", "/api/v1/programs/{program}", "", "reader", 200, 404),
        with(
            row("PATCH", "/api/v1/programs/{program}", "", "editor", 200, 404),
            Body::Json(|own| json!({ "name": format!("{}.x", own.name) })),
        ),
        row("DELETE", "/api/v1/programs/{program}", "", "editor", 200, 404),
        row("GET", "/api/v1/programs/{program}/text", "", "reader", 200, 404),
        with(row("PUT", "/api/v1/programs/{program}/text", "", "editor", 200, 404), Body::Program),
        row("GET", "/api/v1/programs/{program}/revisions", "", "reader", 200, 404),
        row("GET", "/api/v1/programs/{program}/revisions/1", "", "reader", 200, 404),
        row("GET", "/api/v1/programs/{program}/revisions/1/text", "", "reader", 200, 404),
        row("POST", "/api/v1/programs/{program}/revisions/1/restore", "", "editor", 201, 404),
        row(
            "GET",
            "/api/v1/programs/{program}/outputs/summary",
            "?machine=romi-discovery-4022",
            "reader",
            200,
            404,
        ),
        row("GET", "/api/v1/programs/{program}/comparison", "?from=1&to=1", "reader", 200, 404),
        row("GET", "/api/v1/programs/{program}/facts", "", "reader", 200, 404),
        row("GET", "/api/v1/search", "", "none", 200, 0),
        row("GET", "/api/v1/translations", "", "none", 200, 0),
        with(row("POST", "/api/v1/translations", "", "editor", 200, 403), Body::Json(translation)),
        row("GET", "/api/v1/translations/{translation}", "", "reader", 200, 404),
        row("GET", "/api/v1/translations/{translation}/states", "", "reader", 200, 404),
        with(
            row("POST", "/api/v1/translations/{translation}/states", "", "editor", 200, 404),
            Body::Json(|_| json!({ "state": "in-review" })),
        ),
        row("GET", "/api/v1/translations/{translation}/output", "", "reader", 200, 404),
        row("GET", "/api/v1/jobs", "", "none", 200, 0),
        with(
            row("POST", "/api/v1/jobs", "", "editor", 202, 403),
            Body::Json(|own| json!({ "programs": [own.program], "to": "fanuc" })),
        ),
        row("GET", "/api/v1/jobs/{job}", "", "reader", 200, 404),
        row("DELETE", "/api/v1/jobs/{job}", "", "editor", 200, 404),
        row("GET", "/api/v1/jobs/{job}/results", "", "reader", 200, 404),
        row("GET", "/api/v1/jobs/{job}/events", "", "reader", 200, 404),
    ]
}

/// Addresses of machines, documents, sessions, tokens, accounts and the audit.
fn others() -> Vec<Row> {
    let machine: Body = Body::Json(|own| {
        let table: Value = serde_json::from_str(TABLE_10).expect("JSON");
        json!({ "name": own.name, "tool_change_time": table["tool_change_time"], "max_feed": 15000, "start_spindle_time": 2 })
    });
    vec![
        row("GET", "/api/v1/machines", "", "none", 200, 0),
        row("GET", "/api/v1/machines/romi", "", "reader", 200, 404),
        with(row("PUT", "/api/v1/machines/{name}", "", "admin", 201, 403), machine),
        row("DELETE", "/api/v1/machines/{machine}", "", "admin", 204, 403),
        row("GET", "/api/v1/machines/{machine}/revisions", "", "reader", 200, 404),
        row("GET", "/api/v1/machines/{machine}/revisions/1", "", "reader", 200, 404),
        row("POST", "/api/v1/machines/{machine}/revisions/1/restore", "", "admin", 201, 403),
        row("GET", "/api/v1/dialects", "", "none", 200, 0),
        row("GET", "/api/v1/dialects/shop", "", "reader", 200, 404),
        with(row("PUT", "/api/v1/dialects/{name}", "", "admin", 201, 403), Body::Dictionary),
        row("DELETE", "/api/v1/dialects/{dialect}", "", "admin", 204, 403),
        row("GET", "/api/v1/dialects/{dialect}/revisions", "", "reader", 200, 404),
        row("GET", "/api/v1/dialects/{dialect}/revisions/1", "", "reader", 200, 404),
        row("POST", "/api/v1/dialects/{dialect}/revisions/1/restore", "", "admin", 201, 403),
        row("GET", "/transpiler", "", "none", 200, 0),
        row("GET", "/persistence", "", "none", 200, 0),
        with(row("POST", "/transpiler/{name}", "?dialect=mach9", "editor", 201, 404), Body::Program),
        row("GET", "/transpiler/{document}", "", "reader", 200, 404),
        with(row("PUT", "/transpiler/{document}", "", "editor", 200, 404), Body::Program),
        row("DELETE", "/transpiler/{document}", "", "editor", 204, 404),
        with(row("POST", "/persistence/{name}", "", "editor", 201, 404), Body::Json(payload)),
        row("GET", "/persistence/{document}", "", "reader", 200, 404),
        with(row("PUT", "/persistence/{document}", "", "editor", 204, 404), Body::Json(payload_over)),
        row("DELETE", "/persistence/{document}", "", "editor", 204, 404),
        row("GET", "/output/{document}", "", "reader", 200, 404),
        row("GET", "/api/v1/accounts", "", "admin", 200, 403),
        with(
            row("POST", "/api/v1/accounts", "", "admin", 201, 403),
            Body::Json(|own| account(&own.name, &[])),
        ),
        row("GET", "/api/v1/accounts/{account}", "", "admin", 200, 403),
        with(
            row("PATCH", "/api/v1/accounts/{account}", "", "admin", 200, 403),
            Body::Json(|_| json!({ "rights": [] })),
        ),
        row("DELETE", "/api/v1/accounts/{account}", "", "admin", 204, 403),
        row("GET", "/api/v1/audit", "", "admin", 200, 403),
        row("GET", "/api/v1/hooks", "", "admin", 200, 403),
        with(row("POST", "/api/v1/hooks", "", "admin", 201, 403), Body::Json(|_| hook())),
        row("GET", "/api/v1/hooks/{hook}", "", "admin", 200, 403),
        row("DELETE", "/api/v1/hooks/{hook}", "", "admin", 204, 403),
        row("GET", "/api/v1/hooks/{hook}/deliveries", "", "admin", 200, 403),
        // Nothing was delivered.
        row("POST", "/api/v1/hooks/{hook}/deliveries/none", "", "admin", 404, 403),
        row("GET", "/metrics", "", "reader", 200, 404),
        row("GET", "/", "", "anybody", 200, 0),
        row("GET", "/api/v1/openapi.json", "", "anybody", 200, 0),
        row("GET", "/api/v1/docs/", "", "anybody", 200, 0),
        row("PUT", "/api/v1/engine/{name}", "", "reader", 204, 403),
        row("DELETE", "/api/v1/engine/{name}", "", "none", 204, 0),
        // A room is its user's alone, and this one nobody has.
        row("PUT", "/api/v1/engine/{name}/files/a", "", "none", 404, 0),
        row("PUT", "/api/v1/engine/{name}/called/{program}", "", "none", 404, 0),
        row("POST", "/api/v1/engine/{name}/run", "", "none", 404, 0),
        row("GET", "/api/v1/session", "", "anybody", 200, 0),
        with(
            row("POST", "/api/v1/session", "", "anybody", 401, 0),
            Body::Json(|_| json!({ "user": "root", "password": "another one" })),
        ),
        row("DELETE", "/api/v1/session", "", "session", 204, 0),
        with(
            row("PUT", "/api/v1/session/password", "", "session", 401, 0),
            Body::Json(|_| json!({ "old": "another one", "new": "and a third one" })),
        ),
        row("GET", "/api/v1/tokens", "", "session", 200, 0),
        with(
            row("POST", "/api/v1/tokens", "", "session", 201, 0),
            Body::Json(|_| json!({ "name": "t", "scopes": ["read"] })),
        ),
        row("DELETE", "/api/v1/tokens/nothing", "", "session", 404, 0),
    ]
}

/// A caller: its name, its user, and how strong it is; `None` where it is let in nowhere.
struct Caller {
    name: &'static str,
    user: User,
    strength: Option<usize>,
    is_token: bool,
}

fn callers(server: &Server, root: &User) -> Vec<Caller> {
    let mut all = vec![Caller { name: "nobody", user: User::default(), strength: None, is_token: false }];
    for (strength, role) in ROLES.iter().enumerate() {
        let rights = [("", *role)];
        let rights = if *role == "none" { &rights[..0] } else { &rights[..] };
        let user = with_rights(server, root, &format!("a-{role}"), rights);
        all.push(Caller { name: role, user, strength: Some(strength), is_token: false });
    }
    let token = |by: &User, scopes: &[&str]| {
        let made = by.ask(server, "POST", "/api/v1/tokens", &json!({ "name": "t", "scopes": scopes }));
        (
            made.json()["id"].as_str().expect("a name").to_owned(),
            made.json()["token"].as_str().map(User::token),
        )
    };
    let (_, reads) = token(root, &["read"]);
    all.push(Caller {
        name: "admin, token to read",
        user: reads.expect("a token"),
        strength: Some(1),
        is_token: true,
    });
    let (id, expired) = token(root, &["read", "change", "release", "admin"]);
    server.sql(&format!("UPDATE token SET expires = 1 WHERE id = '{id}'")).expect("the token has expired");
    all.push(Caller {
        name: "expired token",
        user: expired.expect("a token"),
        strength: None,
        is_token: true,
    });
    let disabled = with_rights(server, root, "a-disabled", &[("", "releaser")]);
    server.sql("UPDATE account SET is_disabled = TRUE WHERE name = 'a-disabled'").expect("it is disabled");
    all.push(Caller { name: "disabled", user: disabled, strength: None, is_token: false });
    all
}

fn put_dialect(server: &Server, root: &User, name: &str) {
    let target = format!("/api/v1/dialects/{name}");
    let made = root.send(server, "PUT", &target, Some("application/toml"), dictionary(name).as_bytes());
    assert_eq!(made.status, 201, "{}", made.text());
}

/// Makes what a row needs, and its address.
fn prepared(server: &Server, root: &User, row: &Row, name: &str) -> (String, Things) {
    let needs = |word: &str| row.path.contains(word);
    let mut own = Things {
        program: String::new(),
        translation: String::new(),
        job: String::new(),
        name: name.to_owned(),
    };
    let target = format!("{}{}", row.path, row.query);
    if needs("program") || needs("translation") || needs("job") {
        let place = format!("/api/v1/programs?name={name}.cn&folder=plates&dialect=mach9");
        own.program = make(server, root, &place, &PROGRAM.into());
    }
    if needs("translation") {
        let asked = json!({ "program": own.program, "to": "fanuc" });
        own.translation = make(server, root, "/api/v1/translations", &asked);
    }
    if needs("{job}") {
        let asked = json!({ "programs": [own.program], "to": "fanuc" });
        own.job = make(server, root, "/api/v1/jobs", &asked);
    }
    if needs("{document}") {
        let made = root.ask(server, "POST", &format!("/transpiler/{name}-d?dialect=mach9"), &PROGRAM.into());
        assert_eq!(made.status, 201, "{}", made.text());
    }
    if needs("{machine}") {
        let text = TABLE_10.replace("romi", &format!("{name}-m"));
        let made = root.ask(
            server,
            "PUT",
            &format!("/api/v1/machines/{name}-m"),
            &serde_json::from_str(&text).expect("JSON"),
        );
        assert_eq!(made.status, 201, "{}", made.text());
    }
    if needs("{dialect}") {
        put_dialect(server, root, &format!("{name}-l"));
    }
    let hook = if needs("{hook}") { make(server, root, "/api/v1/hooks", &hook()) } else { String::new() };
    if needs("{account}") {
        let made = root.ask(server, "POST", "/api/v1/accounts", &account(&format!("{name}-a"), &[]));
        assert_eq!(made.status, 201, "{}", made.text());
    }
    let target = target
        .replace("{program}", &own.program)
        .replace("{translation}", &own.translation)
        .replace("{job}", &own.job)
        .replace("{document}", &format!("{name}-d"))
        .replace("{machine}", &format!("{name}-m"))
        .replace("{dialect}", &format!("{name}-l"))
        .replace("{account}", &format!("{name}-a"))
        .replace("{hook}", &hook)
        .replace("{name}", name);
    (target, own)
}

fn expected(row: &Row, caller: &Caller) -> u16 {
    let Some(strength) = caller.strength else { return if row.least == "anybody" { row.done } else { 401 } };
    match (row.least, caller.is_token) {
        ("anybody", _) | ("session", false) => return row.done,
        ("session", true) => return 403,
        _ => {}
    }
    let least = ROLES.iter().position(|role| *role == row.least).expect("a role");
    match (strength >= least, strength) {
        (true, _) => row.done,
        (false, 0) => row.hidden,
        (false, _) => 403,
    }
}

#[test]
fn each_role_may_do_what_the_table_says() {
    let server = Server::telling(&[TARGET.to_owned()], limits());
    let root = admin(&server);
    let romi =
        root.ask(&server, "PUT", "/api/v1/machines/romi", &serde_json::from_str(TABLE_10).expect("JSON"));
    assert_eq!(romi.status, 201);
    put_dialect(&server, &root, "shop");
    let callers = callers(&server, &root);
    let mut wrong = Vec::new();
    let rows: Vec<Row> = programs().into_iter().chain(others()).collect();
    for (number, row) in rows.iter().enumerate() {
        let mut made = None;
        for (of, caller) in callers.iter().enumerate() {
            // A reader changes nothing for those after it.
            if row.method != "GET" || made.is_none() {
                made = Some(prepared(&server, &root, row, &format!("t{number}-{of}")));
            }
            let (target, own) = made.as_ref().expect("it is made");
            let (media, body) = match row.body {
                Body::None => (None, String::new()),
                Body::Program => (Some("text/plain"), PROGRAM.to_owned()),
                Body::Dictionary => (Some("application/toml"), dictionary(&own.name)),
                Body::Json(make) => (Some("application/json"), make(own).to_string()),
            };
            // A logout would end the session of the rows after it.
            let user = match (row.method, row.path, caller.strength) {
                ("DELETE", "/api/v1/session", Some(_)) if !caller.is_token => {
                    user(&server, &format!("a-{}", caller.name))
                }
                _ => caller.user.clone(),
            };
            let answer = user.send(&server, row.method, target, media, body.as_bytes());
            let expected = expected(row, caller);
            if answer.status != expected {
                wrong.push(format!(
                    "{} {} by {}: {}, not {expected}: {}",
                    row.method,
                    row.path,
                    caller.name,
                    answer.status,
                    answer.text().lines().nth(3).unwrap_or_default()
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Addresses that no text in the source states, by their files.
const COMPUTED: [(&str, &str); 2] = [("page.rs", "/"), ("openapi.rs", "/api/v1/openapi.json")];

/// The addresses in the sources: those of `.route("…")` and of `#[utoipa::path(…, path = "…")]`.
fn routes(folder: &Path, found: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            routes(&path, found);
            continue;
        }
        let text = fs::read_to_string(&path).unwrap_or_default();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let after = |word: &'static str| {
            text.match_indices(word)
                .map(|(at, word)| text[at + word.len()..].trim_start())
                .collect::<Vec<_>>()
        };
        let routed = after(".route(").into_iter().map(|rest| rest.strip_prefix('"'));
        let described = after("utoipa::path(").into_iter();
        let described = described.map(|rest| rest.split_once("path = \"").map(|(_, stated)| stated));
        for stated in routed.chain(described) {
            let stated = stated.and_then(|stated| stated.split('"').next());
            let computed = || COMPUTED.iter().find(|(file, _)| *file == name).map(|(_, address)| *address);
            let address = stated.or_else(computed);
            found
                .insert(address.unwrap_or_else(|| panic!("an address of {name} that is no text")).to_owned());
        }
    }
}

/// Whether an address of the table is one of a route: `/a/{id}`.
fn is_of(path: &str, route: &str) -> bool {
    let (own, other): (Vec<_>, Vec<_>) = (path.split('/').collect(), route.split('/').collect());
    own.len() == other.len()
        && own.iter().zip(&other).all(|(own, other)| other.starts_with('{') || own == other)
}

/// The table has each method of each address. The addresses are those of the sources, the methods those that the server
/// says.
#[test]
fn the_table_has_every_address() {
    let mut all = BTreeSet::new();
    routes(&repository("service/src"), &mut all);
    assert!(all.len() >= 35, "{} addresses: {all:?}", all.len());
    let server = Server::limited(limits());
    let root = admin(&server);
    let rows: Vec<Row> = programs().into_iter().chain(others()).collect();
    for route in &all {
        let target = route.replace("{what}", "output").replace(['{', '}'], "");
        let answer = root.ask(&server, "BREW", &target, &Value::Null);
        assert_eq!(answer.status, 405, "{route}: {}", answer.text());
        for method in answer.header("allow").split(',').map(str::trim).filter(|method| *method != "HEAD") {
            // A route with less of its own comes first: `/states` before `/{what}`.
            let has = rows.iter().any(|row| row.method == method && is_of(row.path, route));
            assert!(has, "the table of roles lacks {method} {route}");
        }
    }
    for row in &rows {
        let is_page = row.path.starts_with("/api/v1/docs/");
        assert!(is_page || all.iter().any(|route| is_of(row.path, route)), "no route is {}", row.path);
    }
}

/// Who may put a translation into which state.
#[test]
fn each_step_has_its_role() {
    let server = Server::limited(limits());
    let root = admin(&server);
    let users = ROLES[1..5].iter().map(|role| with_rights(&server, &root, role, &[("plates", role)]));
    let users: Vec<User> = users.collect();
    let program =
        make(&server, &root, "/api/v1/programs?name=a.cn&folder=plates&dialect=mach9", &PROGRAM.into());
    let translation =
        make(&server, &root, "/api/v1/translations", &json!({ "program": program, "to": "fanuc" }));
    let path = format!("/api/v1/translations/{translation}/states");
    // Each step, and the weakest role that may do it.
    for (state, least) in [
        ("in-review", 1),
        ("draft", 2),
        ("in-review", 1),
        ("approved", 2),
        ("draft", 2),
        ("in-review", 1),
        ("approved", 2),
        ("released", 3),
        ("obsolete", 3),
        ("draft", 2),
        ("obsolete", 3),
    ] {
        for (strength, user) in users.iter().enumerate() {
            let answer = user.ask(&server, "POST", &path, &json!({ "state": state }));
            let expected = if strength < least { 403 } else { 200 };
            assert_eq!(answer.status, expected, "{state} by {}: {}", ROLES[strength + 1], answer.text());
            if answer.status == 200 {
                let steps = user.get(&server, &path).json();
                let last = steps["states"].as_array().and_then(|all| all.last()).cloned().expect("a step");
                assert_eq!(
                    (last["state"].as_str(), last["author"].as_str()),
                    (Some(state), Some(ROLES[strength + 1]))
                );
                break;
            }
        }
    }
}
