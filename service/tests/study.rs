//! The case study's own program, machine and rows, and its document in both forms and both stages.

use std::fs;

use serde_json::Value;

use crate::client::{Answer, PROGRAM, Server, repository};

/// The state in which table 9 begins, and the function that takes the time of its tool change.
const TABLE_9: &str =
    "dialect=mach9&machine=romi&start=X-9%2CY15.588%2CZ3&start_time=84.191448&tool_change_on=select";

/// Sends a program of the corpus.
fn post(server: &Server, name: &str, query: &str) -> Answer {
    let text = fs::read(repository("corpus/mach9").join(name)).expect("the corpus");
    let made = server.ask("POST", &format!("/transpiler/{name}?{query}"), &[], &text);
    assert_eq!(made.status, 201, "{}", made.text());
    made
}

fn rows(text: &str) -> Vec<Vec<String>> {
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// Whether a computed value, rounded to three digits, is the printed one; positions are printed with two.
fn is_printed(column: usize, computed: &str, printed: &str) -> bool {
    let (Ok(a), Ok(b)) = (computed.parse::<f64>(), printed.parse::<f64>()) else {
        return computed == printed;
    };
    match column {
        1..=3 => (a - b).abs() < 0.005,
        _ => (a * 1000.0).round() == (b * 1000.0).round(),
    }
}

/// Table 9 on the machine of table 10 gives table 11, each row and each column.
#[test]
fn table_9_gives_table_11() {
    let printed = repository("../shared/cases/mach9/table11.csv");
    let Ok(printed) = fs::read_to_string(&printed) else {
        println!("skipped: no ../shared/cases/mach9 beside the repository");
        return;
    };
    let server = Server::all();
    assert_eq!(server.romi().status, 201);
    post(&server, "table9.cn", TABLE_9);
    for target in ["/output/table9.cn", "/output/table9.cn&type=csv", "/output/table9.cn?type=csv"] {
        let ours = rows(&server.get(target).text());
        let printed = rows(&printed);
        assert_eq!((printed.len(), ours.len()), (24, 24), "{target}");
        for (k, (ours, printed)) in ours.iter().zip(&printed).enumerate() {
            for (column, printed) in printed.iter().enumerate() {
                let own = &ours[column + 2];
                assert!(is_printed(column, own, printed), "row {k}: {own} is not {printed}");
            }
        }
    }
}

/// The rows are those of the command line: the file is what `ncc time --as csv` writes, held by the suite of the
/// repository.
#[test]
fn rows_are_those_of_the_command_line() {
    let server = Server::all();
    post(&server, "teste.cn", "dialect=mach9&machine=romi-discovery-4022");
    let ours = server.get("/output/teste.cn?type=csv");
    let session = fs::read_to_string(repository("tests/time/teste.csv")).expect("the session");
    assert_eq!(ours.text(), session);
}

/// The list of canonical functions of table 9 begins and ends as table 12 does.
#[test]
fn table_9_gives_a_list_of_functions() {
    let server = Server::all();
    server.romi();
    let made = post(&server, "table9.cn", TABLE_9).json();
    assert_eq!(made["cmf"], true, "{made}");
    let list = server.get("/output/table9.cn&type=cmf").text();
    for function in ["SELECT_TOOL(3)", "SET_SPINDLE_SPEED(1857.0)", "START_SPINDLE_CLOCKWISE()"] {
        assert!(list.lines().any(|line| line == function), "{function}: {list}");
    }
    assert!(list.lines().filter(|line| line.starts_with("STRAIGHT_FEED(")).count() == 4, "{list}");
}

/// Members of the document in the printed form, and what the source has in them.
#[test]
fn the_printed_form_is_the_sources() {
    let server = Server::all();
    server.romi();
    post(&server, "table9.cn", &format!("{TABLE_9}&option=o_word=ignore"));
    let before = server.get("/transpiler/table9.cn?stage=before").json();
    assert_eq!(
        (&before["prog_name"], &before["machine_name"], &before["dialect"]),
        (&"table9.cn".into(), &"romi".into(), &"mach9".into())
    );
    let blocks = before["blocks"].as_array().expect("blocks");
    let block = |gcode: &str| blocks.iter().find(|block| block["gcode"] == gcode).expect("the block");
    for (gcode, name, feed, speed, parameters) in [
        ("G81", "START_CYCLE", 186, 1857, r#"[{"z":-8.0,"r":3.0,"f":186}]"#),
        ("G25", "RECTANGULAR_LAYOUT", 0, 0, r#"[{"x":30.0,"y":130.0,"i":2,"j":2}]"#),
        ("G80", "END_CYCLE", 0, 1857, "[{}]"),
    ] {
        let block = block(gcode);
        assert_eq!(block["function_name"], name);
        assert_eq!(
            (&block["feed"], &block["speed"], &block["tool"]),
            (&feed.into(), &speed.into(), &3.into())
        );
        assert_eq!(block["parameters"], serde_json::from_str::<Value>(parameters).expect("JSON"), "{gcode}");
        for field in ["dx", "dy", "dz", "distance", "time", "timestamp"] {
            assert_eq!(block[field], 0.0, "{gcode}, {field}");
        }
    }
    let after = server.get("/transpiler/table9.cn").json();
    let after = after["blocks"].as_array().expect("blocks");
    assert!(after.len() > blocks.len() && after.iter().all(|block| block["function_name"] != "START_CYCLE"));
}

/// A payload of either form and either stage comes back byte for byte, and the outputs of what was put in are those of
/// what was made.
#[test]
fn a_payload_comes_back_as_it_was_put_in() {
    let server = Server::all();
    server.romi();
    post(&server, "table9.cn", TABLE_9);
    let csv = server.get("/output/table9.cn").text();
    for (query, processed) in [
        ("form=ncc&stage=after", true),
        ("form=printed&stage=after", true),
        ("form=ncc&stage=before", false),
        ("form=printed&stage=before", false),
        ("form=stored", true),
    ] {
        let text = server.get(&format!("/persistence/table9.cn?{query}")).body;
        let other = Server::all();
        let tight = serde_json::to_vec(&serde_json::from_slice::<Value>(&text).expect("JSON")).expect("JSON");
        for text in [text, tight] {
            let put = other.json("POST", "/persistence/table9.cn", &text);
            assert_eq!(put.status, 201, "{query}: {}", put.text());
            assert_eq!(other.get("/persistence/table9.cn").body, text, "{query}");
            let stage = if processed { "after" } else { "before" };
            assert_eq!(other.get(&format!("/persistence/table9.cn?stage={stage}")).body, text, "{query}");
            let rows_of = other.get("/output/table9.cn");
            match processed {
                // The printed form has the G word of a block alone, and rounds nothing else.
                true => assert_eq!(without_block(&rows_of.text()), without_block(&csv), "{query}"),
                false => assert_eq!(rows_of.status, 422, "{query}: {}", rows_of.text()),
            }
            other.delete("/persistence/table9.cn");
        }
    }
}

fn without_block(csv: &str) -> Vec<Vec<String>> {
    let mut rows = rows(csv);
    rows.iter_mut().for_each(|row| {
        row.remove(1);
    });
    rows
}

/// The printed form of what was put in in the printed form is that.
#[test]
fn the_printed_form_is_read_back() {
    let server = Server::all();
    server.romi();
    post(&server, "table9.cn", TABLE_9);
    for stage in ["before", "after"] {
        let printed = server.get(&format!("/transpiler/table9.cn?stage={stage}")).body;
        let other = Server::all();
        assert_eq!(other.json("POST", "/persistence/table9.cn", &printed).status, 201);
        let again = other.get(&format!("/persistence/table9.cn?form=printed&stage={stage}")).body;
        assert_eq!(String::from_utf8_lossy(&again), String::from_utf8_lossy(&printed), "{stage}");
    }
}

/// The times of a program without a machine rest on assumptions, and its writer reads them.
#[test]
fn the_assumptions_of_the_times_are_reported() {
    let server = Server::all();
    let made = server.program("POST", "/transpiler/a?dialect=mach9", PROGRAM).json();
    let assumed: Vec<_> =
        made["assumed"].as_array().expect("a list").iter().filter_map(|line| line.as_str()).collect();
    assert!(assumed.contains(&"rapid rate = 30000 mm/min"), "{assumed:?}");
}
