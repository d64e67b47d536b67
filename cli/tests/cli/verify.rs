//! `ncc verify`, and certificates.

use super::*;
use sha2::{Digest, Sha256};

/// What [`GOOD`] is on a Fanuc, as somebody else might write it.
const OTHER: &str = "%\nO0007\nN1 G21 G90 G17 G40 G49 G80 G94\nN2 G54\nN3 T1 M6\nN4 S1000 M3\n\
    N5 G0 X0 Y0\nN6 G43 H1 Z5.\nN7 G1 Z-1. F100.\nN8 X10.\nN9 G0 Z50.\nN10 M5\nN11 M30\n%\n";

fn pair() -> tempfile::TempDir {
    let folder = folder();
    std::fs::write(folder.path().join("other.nc"), OTHER).unwrap();
    folder
}

fn write(folder: &tempfile::TempDir, name: &str, text: &str) {
    std::fs::write(folder.path().join(name), text).unwrap();
}

fn read(folder: &tempfile::TempDir, name: &str) -> String {
    std::fs::read_to_string(folder.path().join(name)).unwrap()
}

#[test]
fn verdicts() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    expect("verify-equal.txt", &run(&["mach9:good.cn", "fanuc:other.nc"]).exits(0).out);
    run(&["mach9:good.cn", "mach9:good.cn"]).exits(0);
    // The other way round: what a Fanuc says, the other control has no words for.
    run(&["fanuc:other.nc", "mach9:good.cn"]).exits(0);
    write(&folder, "off.nc", &OTHER.replace("X10.", "X10.004"));
    expect("verify-different.txt", &run(&["mach9:good.cn", "fanuc:off.nc"]).exits(1).out);
    let within = run(&["mach9:good.cn", "fanuc:off.nc", "--tolerance", "0.005"]).exits(0).out;
    expect("verify-tolerance.txt", &within);
    run(&["mach9:good.cn", "fanuc:off.nc", "--tolerance", "0.003"]).exits(1);
    // A feed is no length.
    write(&folder, "feed.nc", &OTHER.replace("F100.", "F101."));
    run(&["mach9:good.cn", "fanuc:feed.nc", "--tolerance", "1"]).exits(1);
    assert_eq!(run(&["mach9:good.cn", "fanuc:feed.nc", "-q"]).exits(1).out, "");
    let mut certificate = run(&["mach9:good.cn", "fanuc:off.nc", "--format", "json"]).exits(1).out;
    // The dictionaries by their digests, which change with every row.
    for name in ["mach9", "fanuc"] {
        let file = format!("{}/../ir/dialects/data/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let digest = Sha256::digest(std::fs::read(file).unwrap());
        let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(certificate.matches(&digest).count(), 1, "{name}");
        certificate = certificate.replace(&digest, &format!("digest of {name}.toml"));
    }
    expect("verify.json", &certificate);
}

/// What the output leaves unsaid is not taken for granted, what the source leaves unsaid is.
#[test]
fn what_is_left_unsaid() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    write(&folder, "unsaid.nc", &OTHER.replace("N2 G54\n", ""));
    expect("verify-unsaid.txt", &run(&["mach9:good.cn", "fanuc:unsaid.nc"]).exits(1).out);
    // Of a source it is taken for granted, and two programs for one control leave the same unsaid.
    run(&["fanuc:unsaid.nc", "fanuc:other.nc"]).exits(0);
    run(&["fanuc:unsaid.nc", "fanuc:unsaid.nc"]).exits(0);
    write(&folder, "units.nc", &OTHER.replace("G21 ", ""));
    let units = run(&["mach9:good.cn", "fanuc:units.nc"]).exits(1).out;
    assert!(
        units.contains("never states its unit of length")
            && units.contains("nothing settles it: unit of length"),
        "{units}"
    );
    // Feeds may count turns of the spindle.
    write(&folder, "feeds.nc", &OTHER.replace(" G94", ""));
    let feeds = run(&["mach9:good.cn", "fanuc:feeds.nc"]).exits(1).out;
    assert!(feeds.contains("never states its feed mode"), "{feeds}");
    run(&["fanuc:feeds.nc", "fanuc:other.nc"]).exits(0);
}

/// Ends and centres of two arcs are the same to the tolerance, and the one is nearly a whole circle.
#[test]
fn an_arc_is_not_the_rest_of_its_circle() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    for (name, end) in [("little.nc", "Y0.004"), ("more.nc", "Y0.006"), ("nearly.nc", "Y-0.004")] {
        write(&folder, name, &OTHER.replace("N9 ", &format!("G3 X10. {end} I-10. J0.\nN9 ")));
    }
    run(&["fanuc:little.nc", "fanuc:more.nc", "--tolerance", "0.01"]).exits(0);
    let told = run(&["fanuc:little.nc", "fanuc:nearly.nc", "--tolerance", "0.01"]).exits(1).out;
    assert!(told.contains("an arc of T1 with another centre, direction or sweep"), "{told}");
    run(&["fanuc:nearly.nc", "fanuc:little.nc", "--tolerance", "0.01"]).exits(1);
    // The same for `ncc diff`.
    let diff = |other: &str| ncc(folder.path(), &["diff", "fanuc:little.nc", other, "--tolerance", "0.01"]);
    diff("fanuc:more.nc").exits(0);
    diff("fanuc:nearly.nc").exits(1);
}

/// Two profiles of one name are not one control where they state other things of it.
#[test]
fn a_name_does_not_make_one_control() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    let profile = |plane: &str| {
        format!("id = \"m\"\ntitle = \"t\"\ndialect = \"fanuc\"\n[power_on]\nplane = \"{plane}\"\n")
    };
    write(&folder, "a.toml", &profile("xy"));
    write(&folder, "b.toml", &profile(""));
    let arc = OTHER.replace(" G17", "").replace("N9 ", "G3 X10. Y0. I-10. J0.\nN9 ");
    write(&folder, "arc.nc", &arc);
    let same = ["fanuc:arc.nc", "fanuc:arc.nc", "--machine-from", "a.toml", "--machine-to"];
    run(&[&same[..], &["a.toml"]].concat()).exits(0);
    let told = run(&[&same[..], &["b.toml"]].concat()).exits(5).out;
    // In the plane of one of the worlds the arc is none.
    assert!(told.contains("ncc cannot execute the output"), "{told}");
}

/// Every value of a certificate that anybody alters, and every row that is left out or put in twice, keeps it
/// from holding; but for the names of files, which ncc made it, and what it says was asked for where the
/// answer is the same.
#[test]
fn a_certificate_that_was_tampered_with() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    write(&folder, "off.nc", &OTHER.replace("X10.", "X10.004").replace("N2 G54\n", ""));
    write(&folder, "shop.toml", "id = \"shop\"\ntitle = \"A shop's\"\nbase = \"fanuc\"\n");
    let calls: [&[&str]; 3] = [
        &["mach9:good.cn", "fanuc:other.nc", "--tolerance", "0.01"],
        &["fanuc:off.nc", "shop:other.nc", "--dialect", "shop.toml", "--machine-from", "fanuc-vmc"],
        &["mach9:good.cn", "fanuc:good.cn"],
    ];
    for call in calls {
        run(&[call, &["--cert", "c.json"]].concat());
        let certificate: serde_json::Value = serde_json::from_str(&read(&folder, "c.json")).unwrap();
        let mut altered = Vec::new();
        alter(&certificate, String::new(), &mut altered);
        assert!(altered.len() > 60, "{}", altered.len());
        for (at, value) in altered {
            let mut other = certificate.clone();
            *other.pointer_mut(&at).unwrap() = value.clone();
            if other == certificate {
                continue;
            }
            // An option that is chosen as the dictionary would choose it was asked for too.
            let asked = at.starts_with("/asked/") || at.ends_with("/chosen");
            let name = at.ends_with("/file") || at.ends_with("/machine") || at == "/ncc_version";
            // The whole of a row is another thing than its name.
            let name = name && value.is_string();
            write(&folder, "t.json", &other.to_string());
            let told = run(&["--cert", "t.json"]);
            let holds = told.out.starts_with("t.json: holds");
            assert!(asked || name || !holds, "{at} = {value}: {}", told.out);
        }
    }
    // What nobody can have asked for.
    run(&["mach9:good.cn", "fanuc:other.nc", "--tolerance", "0.01", "--cert", "c.json"]).exits(0);
    for mm in ["-0.01", "1001.0"] {
        write(&folder, "t.json", &read(&folder, "c.json").replace("_mm\": 0.01", &format!("_mm\": {mm}")));
        run(&["--cert", "t.json"]).exits(5).says("a tolerance of");
    }
}

/// All that can be altered in a document: places, each with another value.
fn alter(value: &serde_json::Value, at: String, found: &mut Vec<(String, serde_json::Value)>) {
    use serde_json::{Value, json};
    match value {
        Value::Null => found.push((at, json!(1.5))),
        Value::Bool(is) => found.push((at, json!(!is))),
        Value::Number(n) => {
            found.push((at, n.as_u64().map_or_else(|| json!(n.as_f64().unwrap() + 0.001), |n| json!(n + 1))))
        }
        Value::String(text) => {
            found.push((at.clone(), json!(format!("{text}x"))));
            found.push((at, json!(format!("x/{text}"))));
        }
        Value::Array(rows) => {
            for (i, row) in rows.iter().enumerate() {
                let twice: Vec<&Value> = rows.iter().chain([row]).collect();
                found.push((at.clone(), json!(twice)));
                let without: Vec<&Value> =
                    rows.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, row)| row).collect();
                found.push((at.clone(), json!(without)));
                alter(row, format!("{at}/{i}"), found);
            }
        }
        Value::Object(fields) => {
            for (key, value) in fields {
                alter(value, format!("{at}/{key}"), found);
            }
        }
    }
}

#[test]
fn programs_that_cannot_be_compared() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    run(&["mach9:good.cn", "fanuc:good.cn"]).exits(5).says("good.cn: not compared").says("reads like mach9");
    run(&["mach9:bad.cn", "fanuc:other.nc"]).exits(5).says("GOX-15.");
    run(&["mach9:other.nc", "fanuc:good.cn"]).exits(5).says("other.nc: not compared");
    write(&folder, "empty.nc", "");
    run(&["mach9:good.cn", "fanuc:empty.nc"]).exits(5);
    std::fs::write(folder.path().join("binary.nc"), [0u8, 1, 2, 255, 0, 9]).unwrap();
    run(&["mach9:good.cn", "fanuc:binary.nc"]).exits(5);
    // A dialect that nobody names and nothing tells.
    write(&folder, "words.nc", "hello world\n");
    run(&["mach9:good.cn", "words.nc"]).exits(5).says("is not certain");
    ncc(folder.path(), &["diff", "mach9:good.cn", "words.nc"]).exits(5).says("is not certain");
    // Sentences are refused as such, as in every verb.
    write(&folder, "prose.nc", "Nothing of this is meant for a machine!\n");
    run(&["mach9:good.cn", "prose.nc"]).exits(1).says("plain text, not a program");
    ncc(folder.path(), &["diff", "mach9:good.cn", "prose.nc"]).exits(1).says("plain text, not a program");
    write(&folder, "cut.nc", &OTHER[..OTHER.len() - 30]);
    run(&["mach9:good.cn", "fanuc:cut.nc"]).exits(1);
    run(&["mach9:good.cn"]).exits(2).says("ncc verify SRC OUT");
    run(&["mach9:good.cn", "fanuc:none.nc"]).exits(4);
    run(&["mach9:-", "fanuc:-"]).exits(2).says("only once");
    run(&["mach9:good.cn", "fanuc:other.nc", "--tolerance", "-1"]).exits(2);
    run(&["mach9:good.cn", "fanuc:other.nc", "--cert", "good.cn"]).exits(2).says("never written over");
    let json = run(&["mach9:bad.cn", "fanuc:other.nc", "--format", "json"]).exits(5);
    assert!(json.err.is_empty() && json.out.contains("\"verdict\": \"not-compared\""), "{json:?}");
}

#[test]
fn certificates() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    run(&["mach9:good.cn", "fanuc:other.nc", "--cert", "c.json"]).exits(0);
    let certificate = read(&folder, "c.json");
    expect("certificate-holds.txt", &run(&["--cert", "c.json"]).exits(0).out);
    // From another folder; under other names.
    let elsewhere = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.json");
    ncc(elsewhere.path(), &["verify", "--cert", path.to_str().unwrap()]).exits(0);
    write(&folder, "a", GOOD);
    write(&folder, "b", OTHER);
    run(&["--cert", "c.json", "--recheck", "a", "b"]).exits(0);
    assert_eq!(read(&folder, "c.json"), certificate);
    let swapped = run(&["--cert", "c.json", "--recheck", "fanuc:b", "mach9:a"]).exits(1).out;
    assert!(swapped.contains("good.cn is another file"), "{swapped}");
    run(&["--cert", "c.json", "--tolerance", "1"]).exits(2).says("--tolerance is in the certificate");

    // Somebody has been at it.
    for (from, to, says) in [
        ("\"verdict\": \"equal\"", "\"verdict\": \"different\"", "verdict: the certificate says"),
        ("\"events\": ", "\"events\": 1", "compared/events: the certificate says"),
        ("\"skip_settings\": 1", "\"skip_settings\": 2", "compared/skip_settings"),
        ("\"tolerance_mm\": null", "\"tolerance_mm\": 1.0", ""),
        ("\"sha256\": \"", "\"sha256\": \"0", "is another file: sha256 0"),
    ] {
        let other = certificate.replacen(from, to, 1);
        assert_ne!(other, certificate, "{from}");
        write(&folder, "t.json", &other);
        let code = i32::from(!says.is_empty());
        let told = run(&["--cert", "t.json"]).exits(code).out;
        assert!(told.contains(says), "{from}: {told}");
    }
    let at = certificate.rfind("\"sha256\": \"").unwrap();
    write(&folder, "t.json", &format!("{}\"sha256\": \"f{}", &certificate[..at], &certificate[at + 11..]));
    let told = run(&["--cert", "t.json"]).exits(1).out;
    assert!(told.contains("the dictionary fanuc is another one"), "{told}");
    let version = format!("\"ncc_version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    write(&folder, "t.json", &certificate.replace(&version, "\"ncc_version\": \"0.0.9\""));
    let told = run(&["--cert", "t.json"]).exits(0).out;
    assert!(told.contains("it was made by ncc 0.0.9"), "{told}");

    // No certificates.
    write(&folder, "t.json", &certificate.replacen("\"blocks\"", "\"block\"", 1));
    run(&["--cert", "t.json"]).exits(5).says("no certificate of ncc verify: unknown field `block`");
    let without = certificate.replacen("  \"summary\": \"the same cut\",\n", "", 1);
    write(&folder, "t.json", &without);
    run(&["--cert", "t.json"]).exits(5).says("missing field `summary`");
    write(&folder, "t.json", &certificate.replacen("\"version\": 1", "\"version\": 2", 1));
    run(&["--cert", "t.json"]).exits(5).says("has version 2 of the form");
    run(&["--cert", "good.cn"]).exits(5).says("no certificate");
    write(&folder, "t.json", &certificate[..certificate.len() / 2]);
    run(&["--cert", "t.json"]).exits(5).says("no certificate");
    run(&["--cert", "none.json"]).exits(4).says("no such file");

    // The files have changed since.
    write(&folder, "other.nc", &OTHER.replace("X10.", "X10.5"));
    expect("certificate-fails.txt", &run(&["--cert", "c.json"]).exits(1).out);
    std::fs::remove_file(folder.path().join("other.nc")).unwrap();
    run(&["--cert", "c.json"]).exits(4).says("other.nc");
}

/// Dictionaries of a shop and profiles are found again by their names in the certificate.
#[test]
fn a_certificate_of_machines() {
    let folder = pair();
    let run = |arguments: &[&str]| ncc(folder.path(), &[&["verify"], arguments].concat());
    write(&folder, "shop.toml", "id = \"shop\"\ntitle = \"A shop's\"\nbase = \"fanuc\"\n");
    run(&["mach9:good.cn", "shop:other.nc", "--dialect", "shop.toml", "--cert", "c.json"]).exits(0);
    let told = read(&folder, "c.json");
    assert!(told.contains("\"name\": \"shop\"") && told.contains("\"name\": \"fanuc\""), "{told}");
    run(&["--cert", "c.json"]).exits(0);
    write(&folder, "shop.toml", "id = \"shop\"\ntitle = \"Another\"\nbase = \"fanuc\"\n");
    let told = run(&["--cert", "c.json"]).exits(1).out;
    assert!(told.contains("the dictionary shop is another one"), "{told}");
    run(&["fanuc:other.nc", "other.nc", "--machine-to", "fanuc-vmc", "--cert", "m.json"]).exits(0);
    assert!(read(&folder, "m.json").contains("\"name\": \"fanuc-vmc\""));
    run(&["--cert", "m.json"]).exits(0);
}

/// A value in a message that one control shows without the zeros at its end, and the other with all of them.
#[test]
fn values_in_messages() {
    let folder = folder();
    let source = "G17 G90 G94 G710 G54 D0\nR1=-1.25 R2=R1*2\nG0 X0 Y0 Z5\nMSG(\"DEPTH \"<<R1)\nX1\n\
        MSG(\"TWICE \"<<R2<<\" MM \")\nX2\nM30\n";
    write(&folder, "shown.mpf", source);
    let run = |arguments: &[&str]| ncc(folder.path(), arguments);
    let told = run(&["siemens", "to", "linuxcnc", "shown.mpf", "-o", "shown.ngc"]).exits(0).err;
    assert!(told.contains("values in messages, with 6 decimal places (`-v` lists them)"), "{told}");
    let written = read(&folder, "shown.ngc");
    assert!(written.contains("(DEBUG,DEPTH #101)"), "{written}");
    let verify = |out: &str| run(&["verify", "siemens:shown.mpf", out]);
    verify("linuxcnc:shown.ngc").exits(0);
    run(&["verify", "linuxcnc:shown.ngc", "siemens:shown.mpf"]).exits(0);
    write(&folder, "digits.ngc", &written.replace("(DEBUG,DEPTH #101)", "(DEBUG,DEPTH %.1f#101)"));
    verify("linuxcnc:digits.ngc").exits(1);
    // Straight blocks show what the source shows.
    run(&["siemens", "to", "linuxcnc", "shown.mpf", "--pass", "flatten", "-o", "flat.ngc"]).exits(0);
    let written = read(&folder, "flat.ngc");
    assert!(written.contains("(MSG,DEPTH -1.25)") && written.contains("(MSG,TWICE -2.5 MM)"), "{written}");
    verify("linuxcnc:flat.ngc").exits(0);
}
