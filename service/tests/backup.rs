//! Programs that are imported, and databases that are copied and made again, over both stores.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use ncc_service::{Entry, Hooks, Import, Imported, Limits, NotImported, Part, Place, backup, restore};
use rusqlite::Connection;
use serde_json::{Value, json};

use crate::client::{PROGRAM, Server, here, place};
use crate::programs::new;
use crate::search::settled;

/// A target of hooks where nobody listens.
const TARGET: &str = "http://127.0.0.1:9/";

fn serve(place: &Place) -> Server {
    let hooks = Hooks { targets: vec![TARGET.to_owned()], authorities: None };
    Server::with_hooks(here(), &Part::All { database: place.clone() }, Limits::default(), &hooks)
}

fn put(into: &Import, folder: &str, name: &str, text: &str) -> Result<Imported, NotImported> {
    let entry = Entry { folder, name, dialect: "mach9", machine: "" };
    into.put(&entry, &mut Cursor::new(text.as_bytes()))
}

/// A text of several pieces with few blocks.
fn long() -> String {
    format!("({})\n", "-".repeat(997)).repeat(2500)
}

#[test]
fn a_program_is_imported_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = place(&folder.path().join("a.sqlite"));
    // A server runs on the same database.
    let server = serve(&place);
    let import = Import::open(&place, "eva").expect("a database");
    let all = |name: &str, text: &str| put(&import, "shop/a", name, text).expect("imported");
    assert_eq!(all("part.cn", PROGRAM), Imported::New);
    assert_eq!(all("part.cn", PROGRAM), Imported::Same);
    let other = format!("{PROGRAM}G0Z9.\n");
    assert_eq!(all("part.cn", &other), Imported::Changed);
    assert_eq!(all("empty.cn", ""), Imported::New);
    for (folder, name) in [("/a", "x"), ("a/..", "x"), ("a", "x/y"), ("a", "")] {
        assert!(
            matches!(put(&import, folder, name, "M5\n"), Err(NotImported::Refused(_))),
            "{folder} {name}"
        );
    }
    let long = long();
    assert_eq!((all("long.cn", &long), all("long.cn", &long)), (Imported::New, Imported::Same));
    assert!(import.has_machine("fanuc-vmc") == Ok(true) && import.has_machine("none") == Ok(false));
    settled(&server);
    let found = server.get("/api/v1/search?under=shop&tool=1").json();
    let id = found["programs"][0]["id"].as_str().expect("a program").to_owned();
    assert_eq!(server.get(&format!("/api/v1/programs/{id}/text")).text(), other);
    let history = server.get(&format!("/api/v1/programs/{id}/revisions")).json();
    let history = history["revisions"].as_array().expect("a list");
    assert_eq!(
        (history.len(), &history[0]["author"], &history[0]["message"]),
        (2, &json!("eva"), &json!("imported"))
    );
}

/// A database with something of everything; gives its server and its place.
fn filled(folder: &Path) -> (Server, Place) {
    let place = place(&folder.join("a.sqlite"));
    let server = serve(&place);
    assert_eq!(server.romi().status, 201);
    let id = new(&server, "name=part.cn&folder=f&dialect=mach9&tag=x", PROGRAM);
    let deleted = new(&server, "name=old.cn&folder=f&dialect=mach9", "M5\n");
    assert_eq!(server.delete(&format!("/api/v1/programs/{deleted}")).status, 200);
    new(&server, "name=long.cn&folder=f&dialect=mach9", &long());
    server.keep("document");
    let asked = json!({ "program": id, "to": "fanuc" }).to_string();
    let made = server.json("POST", "/api/v1/translations", asked.as_bytes());
    let made = made.json()["id"].as_str().expect("a translation").to_owned();
    for state in ["in-review", "approved", "released"] {
        let path = format!("/api/v1/translations/{made}/states");
        assert_eq!(server.json("POST", &path, json!({ "state": state }).to_string().as_bytes()).status, 200);
    }
    let hook = json!({ "target": TARGET, "events": ["job"] }).to_string();
    assert_eq!(server.json("POST", "/api/v1/hooks", hook.as_bytes()).status, 201);
    let job = json!({ "under": "f", "to": "haas" }).to_string();
    let job =
        server.json("POST", "/api/v1/jobs", job.as_bytes()).json()["id"].as_str().expect("a job").to_owned();
    // Its end.
    server.get(&format!("/api/v1/jobs/{job}/events"));
    settled(&server);
    (server, place)
}

/// All that a server tells of its database.
fn told(server: &Server) -> Vec<Value> {
    let mut all: Vec<Value> =
        ["programs?deleted=true", "search", "translations", "jobs", "machines", "hooks"]
            .map(|what| server.get(&format!("/api/v1/{what}")).json())
            .into();
    for program in all[1]["programs"].as_array().expect("a list").clone() {
        let path = format!("/api/v1/programs/{}", program["id"].as_str().expect("a name"));
        all.push(server.get(&format!("{path}/revisions")).json());
        all.push(json!(server.get(&format!("{path}/text")).text()));
    }
    for translation in all[2]["translations"].as_array().expect("a list").clone() {
        let path = format!("/api/v1/translations/{}", translation["id"].as_str().expect("a name"));
        all.push(server.get(&format!("{path}/states")).json());
        all.push(json!(server.get(&format!("{path}/certificate")).text()));
    }
    all.push(server.get("/persistence/document?form=ncc").json());
    all
}

#[test]
fn a_backup_is_restored_to_either_database() {
    let folder = tempfile::tempdir().expect("a folder");
    let (server, from) = filled(folder.path());
    let file = folder.path().join("backup.sqlite");
    let before = told(&server);
    let rows = backup(&from, &file).expect("a backup");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        assert_eq!(file.metadata().expect("a file").permissions().mode() & 0o777, 0o600);
    }
    assert!(backup(&from, &file).is_err_and(|why| why.contains("exists")), "nothing is written over");
    // What is done after it is not in it.
    new(&server, "name=later.cn", "M5\n");
    for (at, to) in [Place::File(folder.path().join("b.sqlite")), place(&folder.path().join("c.sqlite"))]
        .iter()
        .enumerate()
    {
        assert_eq!(restore(to, &file), Ok(rows), "{at}");
        let again = serve(to);
        settled(&again);
        assert_eq!(told(&again), before, "{at}");
        // Numbers go on where they were.
        new(&again, "name=next.cn", "M5\n(next)\n");
        again.keep("other");
        settled(&again);
        assert!(restore(to, &file).is_err_and(|why| why.contains("not empty")), "{at}");
        // A backup of what was restored has the same tables.
        let second = folder.path().join(format!("second{at}.sqlite"));
        backup(to, &second).expect("a backup");
        assert_eq!(counts(&second).keys().collect::<Vec<_>>(), counts(&file).keys().collect::<Vec<_>>());
    }
}

/// Rows by table.
fn counts(file: &PathBuf) -> std::collections::BTreeMap<String, i64> {
    let open = Connection::open(file).expect("a file");
    let mut names = open.prepare("SELECT name FROM sqlite_schema WHERE type = 'table'").expect("tables");
    let names = names.query_map([], |row| row.get::<_, String>(0)).expect("tables");
    let count = |name: &str| open.query_row(&format!("SELECT count(*) FROM {name}"), [], |row| row.get(0));
    names
        .map(|name| name.expect("a name"))
        .map(|name| (name.clone(), count(&name).expect("a count")))
        .collect()
}

#[test]
fn each_table_is_in_a_backup() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_server, from) = filled(folder.path());
    let file = folder.path().join("backup.sqlite");
    backup(&from, &file).expect("a backup");
    let copied = counts(&file);
    match &from {
        Place::File(path) => assert_eq!(counts(path), copied),
        Place::Server(address) => {
            let mut client = postgres::Client::connect(address, postgres::NoTls).expect("the server");
            let names = "SELECT tablename FROM pg_tables WHERE schemaname = 'public' AND tablename <> 'ncc_migration'";
            let names = client.query(names, &[]).expect("tables");
            assert_eq!(names.len(), copied.len(), "{copied:?}");
            for name in names {
                let name: String = name.get(0);
                let own: i64 =
                    client.query_one(&format!("SELECT count(*) FROM {name}"), &[]).expect("a count").get(0);
                assert_eq!(copied.get(&name), Some(&own), "{name}");
            }
        }
    }
    for name in [
        "content_piece",
        "delivery",
        "document_piece",
        "fact",
        "hook",
        "job",
        "machine",
        "program_tag",
        "state",
        "task",
        "term",
    ] {
        assert!(copied[name] > 0, "{name} is empty, so that this test says nothing of it");
    }
}

#[test]
fn a_damaged_backup_restores_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_server, from) = filled(folder.path());
    for (at, (damage, why)) in [
        ("UPDATE content_piece SET bytes = CAST('x' AS BLOB) WHERE number = 1", "another digest"),
        ("DELETE FROM content_piece WHERE number = 2", "another digest"),
        ("PRAGMA foreign_keys = OFF; DELETE FROM program WHERE name = 'part.cn'", "not there"),
        ("PRAGMA user_version = 1000", "a later ncc"),
        ("PRAGMA application_id = 1", "no database of ncc"),
    ]
    .into_iter()
    .enumerate()
    {
        let file = folder.path().join(format!("{at}.sqlite"));
        backup(&from, &file).expect("a backup");
        Connection::open(&file).and_then(|open| open.execute_batch(damage)).expect("damage");
        let to = place(&folder.path().join(format!("to{at}.sqlite")));
        let restored = restore(&to, &file);
        assert!(restored.as_ref().is_err_and(|words| words.contains(why)), "{damage}: {restored:?}");
        assert_eq!(serve(&to).get("/api/v1/programs").json()["programs"], json!([]), "{damage}");
    }
    let none = folder.path().join("none.sqlite");
    assert!(backup(&Place::File(none.clone()), &folder.path().join("x.sqlite")).is_err() && !none.exists());
    assert!(!folder.path().join("x.sqlite").exists(), "no file is left");
    std::fs::write(&none, "text").expect("a file");
    assert!(restore(&place(&folder.path().join("y.sqlite")), &none).is_err());
}
