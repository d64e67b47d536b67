//! Questions on the command line: who stops for them, who goes on, and what answers them.

use std::fs;

use super::*;

const UNITS: &str = "%\nO1\nG17 G90 G94 G54\nS1000 M03\nG00 X0. Y0. Z5.\nG01 X1.5 F100.\nM30\n%\n";
const POINT: &str = "%\nO2\nG21 G17 G90 G94 G54\nS1000 M03\nG00 X0. Y0. Z100\nG01 X1.5 F100.\nM30\n%\n";
const BOTH: &str = "%\nO3\nG17 G90 G94 G54\nS1000 M03\nG00 X0. Y0. Z100\nG01 X1.5 F100.\nM30\n%\n";
const PLAIN: &str = "%\nO4\nG21 G17 G90 G94 G54\nS1000 M03\nG00 X0. Y0. Z5.\nG01 X1.5 F100.\nM30\n%\n";

fn programs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("units.nc", UNITS), ("point.nc", POINT), ("both.nc", BOTH), ("plain.nc", PLAIN)] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn say(folder: &Path, line: &str) -> Done {
    ncc(folder, &line.split(' ').collect::<Vec<_>>())
}

#[test]
fn a_translation_stops_with_all_questions_of_a_program() {
    let folder = programs();
    let at = folder.path();
    let done = say(at, "fanuc to siemens both.nc").exits(1);
    assert_eq!(done.out, "");
    let units = done.err.find("question[NC0301]: mm or inch?").expect("the unit");
    let point =
        done.err.find("question[NC0303]: is Z100 100 or 0.1").or(done.err.find("question[NC0303]: is Z100 "));
    assert!(units < point.expect("the point"), "{}", done.err);
    let done = done.says("not translated: 2 questions; nothing was written");
    // They are no chatter.
    let quiet = say(at, "fanuc to siemens both.nc -q").exits(1);
    assert_eq!(quiet.err.matches("question[").count(), 2, "{}", quiet.err);
    assert!(done.err.starts_with(&quiet.err), "{}", quiet.err);
    // One answer leaves the other question.
    let left = say(at, "fanuc to siemens both.nc --units mm").exits(1).err;
    assert!(!left.contains("NC0301") && left.contains("is Z100 100 mm or 0.1 mm?"), "{left}");
    say(at, "fanuc to siemens both.nc --units mm --from-option decimal_point=calculator").exits(0);
    // Where nothing is verified, it is asked all the same.
    say(at, "fanuc to siemens both.nc --no-verify").exits(1).says("2 questions");
    say(at, "fanuc to siemens plain.nc").exits(0);
}

#[test]
fn answers_make_what_they_say() {
    let folder = programs();
    let at = folder.path();
    let made = |line: &str| say(at, line).exits(0).out;
    assert!(made("fanuc to siemens units.nc --units mm").contains("G710 "));
    assert!(made("fanuc to siemens units.nc --units inch").contains("G700 "));
    assert!(made("fanuc to siemens point.nc --from-option decimal_point=calculator").contains(" Z100\n"));
    assert!(made("fanuc to siemens point.nc --from-option decimal_point=increment").contains(" Z0.100\n"));
    // A program that states its unit keeps it.
    assert!(made("fanuc to siemens plain.nc --units inch").contains("G710 "));
    // A profile answers for good; a command line that contradicts it is wrong.
    let profile = "id = \"shop\"\ntitle = \"Shop\"\ndialect = \"fanuc\"\n[power_on]\nunits = \"inch\"\n[options]\ndecimal_point = \"calculator\"\n";
    fs::write(at.join("shop.toml"), profile).unwrap();
    let both = made("translate --machine-from shop.toml --to siemens both.nc");
    assert!(both.contains("G700 ") && both.contains(" Z100\n"), "{both}");
    say(at, "translate --machine-from shop.toml --to siemens both.nc --units mm").exits(2).says("--units");
    say(at, "canon to fanuc plain.nc --units inch").exits(2).says("--units");
}

#[test]
fn assuming_goes_on_and_says_so_first() {
    let folder = programs();
    let at = folder.path();
    let done = say(at, "fanuc to siemens both.nc --assume --report r.json").exits(0);
    let head: Vec<&str> = done.out.lines().take(3).collect();
    assert_eq!(head[2], "; not answered: units = mm; decimal_point = increment", "{}", done.out);
    let account: Vec<&str> = done.err.lines().collect();
    let verified = account.iter().position(|line| line.contains(", verified: ")).expect("an account");
    assert_eq!(account[verified + 1], "  not answered           units = mm (line 5)", "{}", done.err);
    assert_eq!(
        account[verified + 2],
        "                         decimal_point = increment (line 5)",
        "{}",
        done.err
    );
    let report: serde_json::Value = serde_json::from_slice(&fs::read(at.join("r.json")).unwrap()).unwrap();
    let codes = |list: &serde_json::Value| -> Vec<String> {
        list.as_array().unwrap().iter().map(|entry| entry["code"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(codes(&report["questions"]), ["NC0301", "NC0303"]);
    assert_eq!(report["questions"][0]["answers"][1]["option"], "--units inch");
    assert_eq!(report["questions"][0]["answers"][0]["taken"], true);
    assert_eq!(codes(&report["assumptions"])[..2], ["NC0301", "NC0303"]);
    assert_eq!(report["result"], "verified");
    // Without it, the report is written too.
    say(at, "fanuc to siemens both.nc --report r.json").exits(1);
    let report: serde_json::Value = serde_json::from_slice(&fs::read(at.join("r.json")).unwrap()).unwrap();
    assert_eq!(codes(&report["questions"]), ["NC0301", "NC0303"]);
    assert_eq!(report["result"], "refused");
    let lines = say(at, "fanuc to siemens point.nc --format json").exits(1).err;
    let first: serde_json::Value = serde_json::from_str(lines.lines().next().unwrap()).unwrap();
    assert_eq!(first["severity"], "question");
    assert_eq!(first["answers"][0]["result"], "100 mm");
}

/// People read an error with both turns; programs find it among the questions too.
#[test]
fn a_rotary_turn_is_a_question_for_programs() {
    let folder = folder();
    let at = folder.path();
    let turn = "G21 G17 G90 G94 G54\nG0 X0 Y0 Z5 A0\nS500 M3\nG1 X20 A270 F500\nM2\n";
    fs::write(at.join("turn.ngc"), turn).unwrap();
    fs::write(at.join("units.ngc"), turn.replace("G21 ", "").replace("F500", "F50")).unwrap();
    let report = |arguments: &str, code: i32| -> serde_json::Value {
        let done = say(at, &format!("{arguments} --report r.json")).exits(code);
        assert_eq!(
            done.err.contains("error[NC0522]: does A turn by 270 degrees here, or by -90?"),
            code == 1
        );
        serde_json::from_slice(&fs::read(at.join("r.json")).unwrap()).unwrap()
    };
    let asked = report("linuxcnc to fanuc turn.ngc", 1);
    let answers = &asked["questions"][0]["answers"];
    assert_eq!(asked["questions"][0]["code"], "NC0522");
    assert_eq!(answers[0]["result"], "A turns by 270 degrees");
    assert_eq!(answers[1]["result"], "A turns by -90 degrees");
    // Each answer leaves nothing to ask.
    for answer in [&answers[0], &answers[1]] {
        let option = answer["option"].as_str().unwrap();
        let answered = report(&format!("linuxcnc to fanuc turn.ngc {option}"), 0);
        assert_eq!(answered["questions"], serde_json::json!([]));
    }
    // Where one machine is stated, the other alone is asked.
    let one = report("linuxcnc to fanuc turn.ngc --from-option rotary_turn=shortest", 1);
    assert_eq!(one["questions"][0]["answers"][1]["option"], "--to-option rotary_turn=shortest");
    // With another question, the more dangerous one comes first.
    let both = report("linuxcnc to fanuc units.ngc", 1);
    let codes: Vec<&str> =
        both["questions"].as_array().unwrap().iter().map(|one| one["code"].as_str().unwrap()).collect();
    assert_eq!(codes, ["NC0301", "NC0522"]);
    let done = say(at, "linuxcnc to fanuc turn.ngc units.ngc -o out --format json").exits(1);
    let batch: serde_json::Value = serde_json::from_str(&done.out).unwrap();
    assert_eq!(batch["files"][0]["questions"][0]["code"], "NC0522");
    assert_eq!(batch["files"][1]["questions"][1]["code"], "NC0522");
}

#[test]
fn a_batch_stops_for_each_program_by_itself() {
    let folder = programs();
    let at = folder.path();
    fs::create_dir(at.join("in")).unwrap();
    for name in ["units.nc", "point.nc", "plain.nc"] {
        fs::rename(at.join(name), at.join("in").join(name)).unwrap();
    }
    let done = say(at, "fanuc to siemens in -o out").exits(1);
    assert!(done.out.contains("line 5: mm or inch? The program never states its unit"), "{}", done.out);
    assert!(done.out.contains("line 5: is Z100 100 mm or 0.1 mm?"), "{}", done.out);
    assert!(at.join("out/plain.MPF").is_file() && !at.join("out/units.MPF").exists());
    let done = say(at, "fanuc to siemens in -o out2 --format json").exits(1);
    let document: serde_json::Value = serde_json::from_str(&done.out).unwrap();
    let asked: usize = document["files"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["questions"].as_array().unwrap().len())
        .sum();
    assert_eq!(asked, 2, "{}", done.out);
    say(at, "fanuc to siemens in -o out3 --assume").exits(0);
}

/// Everybody else says in one line how it reads, and goes on.
#[test]
fn other_verbs_never_stop() {
    let folder = programs();
    let at = folder.path();
    let line = "units.nc: not stated, and it changes the cut; ncc took units = mm (else `--units inch`)\n";
    fs::write(at.join("loose.nc"), UNITS.replace("G01 X1.5", "g1x1.5")).unwrap();
    for verb in [
        "time --from fanuc units.nc",
        "check --from fanuc units.nc",
        "plot --from fanuc units.nc -o p.svg",
        "diff fanuc:units.nc fanuc:units.nc",
        "git-textconv --from fanuc units.nc",
        "fmt --from fanuc units.nc --number 10:10",
    ] {
        let done = say(at, verb);
        assert_eq!(done.code, 0, "{verb}: {}{}", done.out, done.err);
        assert!(done.err.starts_with(line), "{verb}: {}", done.err);
    }
    let verified = say(at, "verify fanuc:units.nc fanuc:units.nc");
    assert!(verified.err.starts_with(line), "{}", verified.err);
    let arguments = "git-diff --from fanuc part.nc units.nc 0 100644 loose.nc 0 100644";
    let told = say(at, arguments).exits(0);
    assert!(told.err.contains("ncc took units = mm"), "{}", told.err);
    // What is answered is not told.
    for verb in ["time --from fanuc units.nc --units inch", "check --from fanuc plain.nc"] {
        assert!(!say(at, verb).exits(0).err.contains("not stated"), "{verb}");
    }
    let way = say(at, "time --from fanuc units.nc --units inch").exits(0).out;
    assert!(way.contains("38.1 mm"), "{way}");
}

/// A program that fits two controls which read it otherwise.
#[test]
fn a_recognised_control_is_asked_where_another_cuts_otherwise() {
    let folder = programs();
    let at = folder.path();
    fs::write(at.join("feed.nc"), PLAIN.replace("O4", "O1234").replace("F100.", "F100")).unwrap();
    let done = say(at, "auto to siemens feed.nc").exits(1);
    done.says("question[NC0330]: fanuc or haas?").says("`--from fanuc` (the feed is 100 mm/min)");
    say(at, "fanuc to siemens feed.nc").exits(0);
    let assumed = say(at, "auto to siemens feed.nc --assume").exits(0);
    assert!(assumed.out.contains("; not answered: control = fanuc"), "{}", assumed.out);
    say(at, "auto to siemens plain.nc").exits(0);
}
