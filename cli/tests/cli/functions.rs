//! Custom functions of a user's dictionary: programs are started with the user's word alone, and everything that they may do
//! wrong is refused at the block.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::time::Duration;

use super::*;

const SHOP: &str = "\
id = \"shop\"
title = \"Our Fanuc\"
base = \"fanuc\"

[functions.G200]
command = [\"./programs/g200.sh\", \"G200\"]

[functions.G201]
command = [\"sh\", \"programs/g201.sh\"]
until = \"G202\"
time_limit = 1
";

const PROGRAM: &str = "%\nO0012\nG21 G90 G17 G94 G54 G40 G49 G80\nS1000 M03\nG00 X1. Y0. Z5.\nG01 Z-1. F200.\n\
                       G200 X10. F100. (slot)\nG00 Z5.\nM30\n%\n";

const TOGETHER: &str = "%\nO0012\nG21 G90 G17 G94 G54 G40 G49 G80\nS1000 M03\nG00 X1. Y0. Z5.\nG01 Z-1. F200.\n\
                        G201\nX10.\nG202\nG00 Z5.\nM30\n%\n";

/// Goes to X10 at feed: the one block of its input has its answer in the parameter.
const SLOT: &str = r#"#!/bin/sh
echo "$1" >> started
sed -E 's/"function_name":"G200"/"function_name":"STRAIGHT_FEED"/
s/"x1":[^,]*(.*"x":([-0-9.]*))/"x1":\2\1/
s/"feed":[^,]*/"feed":100.0/' "$2" > "$3"
"#;

/// A folder with the dictionary in `shop`, its programs, and two part programs; `tmp` is for temporary files.
fn shop() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir_all(at.join("shop/programs")).unwrap();
    fs::create_dir(at.join("tmp")).unwrap();
    fs::write(at.join("shop/shop.toml"), SHOP).unwrap();
    fs::write(at.join("part.nc"), PROGRAM).unwrap();
    fs::write(at.join("together.nc"), TOGETHER).unwrap();
    script(at, "g200.sh", SLOT);
    folder
}

fn script(at: &Path, name: &str, text: &str) {
    let path = at.join("shop/programs").join(name);
    fs::write(&path, text).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
}

fn called(at: &Path, line: &str) -> Command {
    let mut command = command(NCC, at, &line.split(' ').collect::<Vec<_>>());
    command.args(["--dialect", "shop/shop.toml"]).env("TMPDIR", at.join("tmp"));
    command
}

/// Runs ncc with the dictionary; no temporary file is left.
fn run(at: &Path, line: &str) -> Done {
    let done = finish(called(at, line));
    let left: Vec<_> = fs::read_dir(at.join("tmp")).unwrap().collect();
    assert!(left.is_empty(), "{left:?}");
    done
}

fn allowed(at: &Path, line: &str) -> Done {
    run(at, &format!("{line} --run-functions"))
}

#[test]
fn a_program_says_what_a_block_does() {
    let folder = shop();
    let at = folder.path();
    let done = allowed(at, "shop to canon part.nc --no-head").exits(0);
    let moves = "SET_FEED_RATE(100.0)\nSTRAIGHT_FEED(10.0, 0.0, -1.0)\nCOMMENT(\"slot\")";
    assert!(done.out.contains(moves), "{}", done.out);
    done.says("G200 by a program of the user (line 7)").says("verified");
    let done = allowed(at, "shop to siemens part.nc -v").exits(0).says("[NC0314]").says("part.nc:7:");
    assert!(done.out.contains("\nG1 Z-1 F200\nX10 F100 ; slot\nG0 Z5\n"), "{}", done.out);
    // Every verb reads the program in one way.
    assert!(allowed(at, "time --from shop part.nc --as csv").exits(0).out.contains("STRAIGHT_FEED,10.0"));
    allowed(at, "check shop:part.nc").exits(0);
    allowed(at, "plot --from shop part.nc -o plot.svg").exits(0);
    allowed(at, "fmt --from shop part.nc --check").exits(0);
    allowed(at, "diff shop:part.nc shop:part.nc").exits(0);
    let shown = run(at, "dialects show shop").exits(0).out;
    assert!(shown.contains("G200            ./programs/g200.sh G200, at most 10 s"), "{shown}");
    assert!(shown.contains("G201 … G202     sh programs/g201.sh, at most 1 s"), "{shown}");
}

#[test]
fn a_program_is_started_once_for_an_input() {
    let folder = shop();
    let at = folder.path();
    // Read, verified, and executed under other facts of the control.
    allowed(at, "shop to siemens part.nc").exits(0);
    assert_eq!(fs::read_to_string(at.join("shop/started")).unwrap(), "G200\n");
}

#[test]
fn nothing_is_started_without_the_users_word() {
    let folder = shop();
    let at = folder.path();
    let verbs = [
        "shop to canon part.nc",
        "check shop:part.nc",
        "time --from shop part.nc",
        "plot --from shop part.nc",
        "verify shop:part.nc shop:part.nc",
        "auto to canon part.nc",
        "shop to canon part.nc -- --run-functions",
    ];
    for line in verbs {
        let done = run(at, line);
        assert!(!at.join("shop/started").exists(), "{line}");
        assert_ne!(done.code, 0, "{line}: {}", done.out);
    }
    run(at, "shop to canon part.nc")
        .exits(1)
        .says("[NC0243]")
        .says("part.nc:7:1")
        .says("`./programs/g200.sh G200`")
        .says("`--run-functions`");
}

#[test]
fn a_function_with_its_end_gets_its_blocks_together() {
    let folder = shop();
    let at = folder.path();
    script(
        at,
        "g201.sh",
        "cp \"$1\" given.json\nsed -n -E 's/\"function_name\":\"HOLE\"/\"function_name\":\"STRAIGHT_FEED\"/
         s/\"x1\":[^,]*(.*\"x\":([-0-9.]*))/\"x1\":\\2\\1/
         /STRAIGHT_FEED/{s/,$//;s/^/[/;s/$/]/;p;}' \"$1\" > \"$2\"\n",
    );
    let done = allowed(at, "shop to canon together.nc --no-head").exits(0);
    assert!(done.out.contains("STRAIGHT_FEED(10.0"), "{}", done.out);
    let given = fs::read_to_string(at.join("shop/given.json")).unwrap();
    let names = ["START_CYCLE", "HOLE", "END_CYCLE"].map(|name| given.find(name).expect(name));
    assert!(names.is_sorted(), "{given}");
    assert_eq!(given.lines().count(), 5, "{given}");
}

/// Faults of a program, each with the words of ncc about it.
#[test]
fn what_a_program_does_wrong_is_refused_at_the_block() {
    let folder = shop();
    let at = folder.path();
    let wrong = [
        ("exit 0", "your program wrote no answer"),
        (": > $3", "the answer of your program is empty"),
        ("mkdir $3", "the answer of your program is not a plain file"),
        ("ln -s /etc/passwd $3", "the answer of your program is not a plain file"),
        ("printf '[\\000]' > $3", "the answer of your program is not text"),
        ("head -c 300 $2 > $3", "the answer of your program is not a list of blocks"),
        ("cp $2 $3", "the answer of your program is not a list of blocks"),
        ("head -c 40000001 /dev/zero > $3", "your program wrote more than 40000000 bytes"),
        (
            "sed 's/\"function_name\":\"G200\"/\"function_name\":\"SELECT_TOOL\"/' $2 > $3",
            "SELECT_TOOL is not taken",
        ),
        ("echo no such slot >&2; exit 3", "your program ended with exit code 3"),
        ("kill -9 $$", "a signal ended your program"),
    ];
    for (does, says) in wrong {
        script(at, "g200.sh", &format!("#!/bin/sh\n{does}\n"));
        let done = allowed(at, "shop to canon part.nc").exits(1);
        let done = done.says("[NC0244]").says(&format!("G200: {says}")).says("part.nc:7:1");
        assert_eq!(done.out, "", "{does}");
        assert!(!does.contains("slot") || done.err.contains("no such slot"), "{}", done.err);
        // Standard output is nobody's.
        assert!(!done.err.contains("root:"), "{}", done.err);
    }
    fs::remove_file(at.join("shop/programs/g200.sh")).unwrap();
    allowed(at, "shop to canon part.nc").exits(1).says("your program cannot be started").says("No such file");
}

/// A process that is over, or waits for its parent to look.
fn is_over(process: &str) -> bool {
    let alive = Command::new("kill").args(["-0", process]).stderr(Stdio::null()).status().unwrap().success();
    let state = fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    !alive || state.contains(") Z ")
}

#[test]
fn a_program_that_takes_too_long_ends_with_all_that_it_started() {
    let folder = shop();
    let at = folder.path();
    script(at, "g201.sh", "sleep 600 &\necho $! > process\nsleep 600\n");
    allowed(at, "shop to canon together.nc").exits(1).says("G201: your program ran for 1 s and was ended");
    let process = fs::read_to_string(at.join("shop/process")).unwrap();
    assert!(
        (0..100).any(|_| is_over(process.trim()) || (std::thread::sleep(Duration::from_millis(20)), false).1)
    );
}

#[test]
fn an_interrupt_ends_the_program() {
    let folder = shop();
    let at = folder.path();
    script(at, "g200.sh", "#!/bin/sh\necho $$ > process\nsleep 600\n");
    let mut command = called(at, "shop to canon part.nc --run-functions -o out.nc");
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let process = at.join("shop/process");
    while !fs::read_to_string(&process).is_ok_and(|text| text.ends_with('\n')) {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(is_over(fs::read_to_string(&process).unwrap().trim()));
    assert!(!at.join("out.nc").exists());
    assert_eq!(fs::read_dir(at.join("tmp")).unwrap().count(), 0);
}

#[test]
fn a_certificate_holds_as_long_as_the_program_answers_so() {
    let folder = shop();
    let at = folder.path();
    allowed(at, "shop to fanuc part.nc -o out.nc").exits(0);
    allowed(at, "verify shop:part.nc fanuc:out.nc --cert cert.json").exits(0);
    let cert = fs::read_to_string(at.join("cert.json")).unwrap();
    assert!(cert.contains("\"shop functions\""), "{cert}");
    allowed(at, "verify --cert cert.json --recheck part.nc out.nc").exits(0);
    // The same moves by another answer.
    script(
        at,
        "g200.sh",
        &SLOT.replace("\"$2\" > \"$3\"", "\"$2\" | sed 's/}]*$/} /' > \"$3\"; echo >> \"$3\""),
    );
    let done = allowed(at, "verify --cert cert.json --recheck part.nc out.nc").exits(1);
    assert!(done.out.contains("the dictionary shop functions is another one"), "{}", done.out);
    // Without the program nothing can be compared.
    run(at, "verify --cert cert.json --recheck part.nc out.nc").exits(5);
}

#[test]
fn what_is_wrong_with_a_function_is_told_at_its_place() {
    let folder = shop();
    let at = folder.path();
    for (from, to, says) in [
        ("\"./programs/g200.sh\", \"G200\"", "", "`command` needs a program"),
        ("functions.G200", "functions.G81", "this code has a [[code]] row"),
        ("functions.G200", "functions.Q7", "Q7"),
        ("until = \"G202\"", "until = \"G200\"", "two rows of this name"),
        ("time_limit = 1", "time_limit = 601", "`time_limit` is 1 to 600 s"),
        ("time_limit = 1", "most_blocks = 0", "`most_blocks` 1 to 100000"),
        ("time_limit = 1", "shell = true", "unknown field `shell`"),
        ("base = \"fanuc\"", "base = \"siemens\"", "`[functions]` is for dialects of letters and numbers"),
    ] {
        fs::write(at.join("shop/shop.toml"), SHOP.replace(from, to)).unwrap();
        run(at, "dialects").exits(2).says(says).says("shop.toml:");
    }
}

/// The example of the book does what the book says.
#[test]
fn the_example_of_the_book() {
    if Command::new("python3").arg("--version").output().is_err() {
        let _ = writeln!(std::io::stderr(), "skipped: no python3");
        return;
    }
    let page = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/book/src/use/own-dialect.md");
    let page = fs::read_to_string(page).unwrap();
    let part = page.split("## Functions that a program of yours processes").nth(1).expect("the section");
    let text = |kind: &str| {
        let (_, rest) = part.split_once(&format!("```{kind}\n")).expect(kind);
        rest.split_once("```").expect("its end").0.to_owned()
    };
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir(at.join("functions")).unwrap();
    fs::write(at.join("shop.toml"), text("toml")).unwrap();
    fs::write(at.join("functions/g200.py"), text("python")).unwrap();
    fs::write(at.join("part.nc"), text("gcode")).unwrap();
    let line = "shop to canon part.nc --dialect shop.toml --run-functions --no-head";
    let done = ncc(at, &line.split(' ').collect::<Vec<_>>()).exits(0);
    assert_eq!(done.out, text("canon"));
}
