//! Which files are read, written, and left alone.

use std::fs;

use super::*;

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn an_output_file_appears_whole() {
    let folder = folder();
    let folder = folder.path();
    let plain = ncc(folder, &["mach9", "to", "fanuc", "good.cn"]).exits(0).out;
    let done = ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "part.nc"]).exits(0);
    assert_eq!(done.out, "");
    assert_eq!(fs::read_to_string(folder.join("part.nc")).unwrap(), plain);
    fs::write(folder.join("part.nc"), "OLD").unwrap();
    ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "part.nc"]).exits(0);
    assert_eq!(fs::read_to_string(folder.join("part.nc")).unwrap(), plain);
    assert_eq!(names(folder), ["bad.cn", "good.cn", "part.nc"]);
}

#[test]
fn a_refused_program_leaves_the_old_output() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("part.nc"), "OLD").unwrap();
    let done = ncc(folder, &["mach9", "to", "fanuc", "bad.cn", "-o", "part.nc"]).exits(1);
    assert_eq!(done.out, "");
    assert_eq!(fs::read_to_string(folder.join("part.nc")).unwrap(), "OLD");
    ncc(folder, &["mach9", "to", "fanuc", "bad.cn", "-o", "new.nc"]).exits(1);
    assert_eq!(names(folder), ["bad.cn", "good.cn", "part.nc"]);
}

#[test]
fn a_source_is_never_written_over() {
    let folder = folder();
    let folder = folder.path();
    fs::create_dir(folder.join("sub")).unwrap();
    for name in ["good.cn", "./good.cn", "sub/../good.cn"] {
        ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", name]).exits(2).says("is the source");
        ncc(folder, &["mach9", "to", "fanuc", "good.cn", "--report", name]).exits(2).says("is the source");
    }
    ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "x", "--report", "x"]).exits(2);
    assert_eq!(fs::read_to_string(folder.join("good.cn")).unwrap(), GOOD);
    assert_eq!(names(folder), ["bad.cn", "good.cn", "sub"]);
}

#[cfg(unix)]
#[test]
fn links_lead_to_the_same_file() {
    let folder = folder();
    let folder = folder.path();
    std::os::unix::fs::symlink("good.cn", folder.join("link.cn")).unwrap();
    fs::hard_link(folder.join("good.cn"), folder.join("hard.cn")).unwrap();
    for name in ["link.cn", "hard.cn"] {
        ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", name]).exits(2).says("is the source");
    }
    std::os::unix::fs::symlink("real.nc", folder.join("out.nc")).unwrap();
    fs::write(folder.join("real.nc"), "OLD").unwrap();
    ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "out.nc"]).exits(0);
    assert!(fs::symlink_metadata(folder.join("out.nc")).unwrap().is_symlink());
    assert!(fs::read_to_string(folder.join("real.nc")).unwrap().starts_with('%'));
}

#[cfg(unix)]
#[test]
fn a_new_file_has_usual_permissions_and_an_old_one_keeps_its_own() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let folder = folder.path();
    let mode = |name: &str| fs::metadata(folder.join(name)).unwrap().permissions().mode() & 0o777;
    ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "part.nc"]).exits(0);
    assert_eq!(mode("part.nc"), mode("good.cn"));
    fs::set_permissions(folder.join("part.nc"), fs::Permissions::from_mode(0o640)).unwrap();
    ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "part.nc"]).exits(0);
    assert_eq!(mode("part.nc"), 0o640);
}

#[cfg(unix)]
#[test]
fn stdout_onto_the_source_is_refused() {
    let folder = folder();
    let mut command = command(NCC, folder.path(), &["mach9", "to", "fanuc", "good.cn"]);
    command.stdout(fs::File::options().write(true).open(folder.path().join("good.cn")).unwrap());
    finish(command).exits(2).says("the source itself");
    assert_eq!(fs::read_to_string(folder.path().join("good.cn")).unwrap(), GOOD);
}

#[test]
fn stdin_is_a_source() {
    let folder = folder();
    let folder = folder.path();
    let done = ncc_with(folder, &["mach9", "to", "fanuc", "-"], GOOD.as_bytes())
        .exits(0)
        .says("<stdin>: mach9 to fanuc");
    assert!(done.out.starts_with("%\nO"));
    ncc_with(folder, &["mach9", "to", "fanuc", "-"], BAD.as_bytes()).exits(1).says("<stdin>:2:");
    ncc_with(folder, &["mach9", "to", "fanuc", "-", "-o", "-"], GOOD.as_bytes()).exits(0);
}

#[test]
fn files_that_cannot_be_used_are_exit_4() {
    let folder = folder();
    let folder = folder.path();
    ncc(folder, &["mach9", "to", "fanuc", "none.cn"])
        .exits(4)
        .says("cannot read none.cn: there is no such file");
    ncc(folder, &["mach9", "to", "fanuc", "."]).exits(2).says("name a folder for the outputs");
    ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "no/part.nc"])
        .exits(4)
        .says("cannot write no/part.nc");
    // Found out before anything else is.
    let done = ncc(folder, &["mach9", "to", "fanuc", "bad.cn", "-o", "no/part.nc"]).exits(4);
    assert!(!done.err.contains("NC0"), "{}", done.err);
    ncc(folder, &["mach9", "to", "fanuc", "good.cn", "--report", "no/r.json"]).exits(4);
}

#[test]
fn a_file_without_any_program_is_a_clear_error() {
    let folder = folder();
    let folder = folder.path();
    let binary: Vec<u8> = (0..=255u8).cycle().take(10_000).collect();
    for (name, text) in [("empty.cn", b"".as_slice()), ("binary.cn", &binary), ("zeros.cn", &[0; 5000])] {
        fs::write(folder.join(name), text).unwrap();
        for from in ["mach9", "fanuc", "canon", "ir"] {
            let done = ncc(folder, &[from, "to", "fanuc", name]).exits(1).says("error[NC");
            assert_eq!(done.out, "", "{from} {name}");
            assert!(done.err.len() < 100_000, "{from} {name}: {} bytes of messages", done.err.len());
            assert!(!done.err.contains('\0') && !done.err.contains('\x1b'), "{from} {name}");
        }
    }
}

#[test]
fn an_empty_file_is_no_riddle() {
    let folder = folder();
    let folder = folder.path();
    for text in ["", "\n\r\n \t\n"] {
        fs::write(folder.join("empty.cn"), text).unwrap();
        for line in ["auto to fanuc empty.cn", "time empty.cn", "doctor empty.cn --to fanuc"] {
            let words: Vec<&str> = line.split(' ').collect();
            let done = ncc(folder, &words).exits(1).says("empty.cn is empty");
            assert!(!done.err.contains("--from"), "{line}: {}", done.err);
        }
    }
    fs::write(folder.join("empty.cn"), "hello\n").unwrap();
    ncc(folder, &["auto", "to", "fanuc", "empty.cn"]).exits(2).says("is not certain");
}

#[test]
fn what_is_no_text_is_named_as_that() {
    let folder = folder();
    let folder = folder.path();
    let wide: Vec<u8> = "%\nO1\nG0 X1.\nM30\n%\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [&b"\0\0\0\0"[..], b"\x7fELF\x02\x01\0\0G0 X1.\n", &wide] {
        fs::write(folder.join("other.nc"), bytes).unwrap();
        for line in ["auto to fanuc other.nc", "check other.nc", "fmt other.nc", "time other.nc"] {
            let words: Vec<&str> = line.split(' ').collect();
            ncc(folder, &words).exits(1).says("other.nc is not a part program");
        }
        ncc(folder, &["diff", "other.nc", "other.nc"]).exits(5).says("other.nc is not a part program");
    }
}

/// A program that an editor has marked as UTF-8 is recognised as it is read.
#[test]
fn a_mark_before_the_text_is_no_part_of_it() {
    let folder = folder();
    let folder = folder.path();
    let marked = [b"\xEF\xBB\xBF", &fs::read(folder.join("good.cn")).unwrap()[..]].concat();
    fs::write(folder.join("marked.cn"), marked).unwrap();
    ncc(folder, &["auto", "to", "fanuc", "marked.cn"]).exits(0).says("read as mach9");
    ncc(folder, &["diff", "good.cn", "marked.cn"]).exits(0);
}

#[cfg(unix)]
#[test]
fn what_must_not_be_written_is_left_as_it_is() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("part.nc"), "OLD").unwrap();
    fs::set_permissions(folder.join("part.nc"), fs::Permissions::from_mode(0o444)).unwrap();
    for option in ["-o", "--report"] {
        ncc(folder, &["mach9", "to", "fanuc", "good.cn", option, "part.nc"])
            .exits(4)
            .says("cannot write part.nc");
        assert_eq!(fs::read_to_string(folder.join("part.nc")).unwrap(), "OLD");
    }
    assert_eq!(names(folder), ["bad.cn", "good.cn", "part.nc"]);

    let closed = folder.join("closed");
    fs::create_dir(&closed).unwrap();
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o555)).unwrap();
    // The superuser may write anywhere.
    if fs::write(closed.join("try"), "").is_err() {
        ncc(folder, &["mach9", "to", "fanuc", "good.cn", "-o", "closed/part.nc"])
            .exits(4)
            .says("cannot write closed/part.nc");
        assert_eq!(names(&closed), [""; 0]);
    }
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o755)).unwrap();
}

#[test]
fn line_ends_are_kept_or_chosen() {
    let folder = folder();
    let folder = folder.path();
    let run = |text: &str, eol: &[&str]| {
        fs::write(folder.join("p.cn"), text).unwrap();
        ncc(folder, &[&["mach9", "to", "fanuc", "p.cn"], eol].concat()).exits(0).out
    };
    let windows = GOOD.replace('\n', "\r\n");
    let lf = run(GOOD, &[]);
    assert!(!lf.contains('\r'));
    assert_eq!(run(GOOD, &["--eol", "crlf"]), lf.replace('\n', "\r\n"));
    let kept = run(&windows, &[]);
    assert_eq!(kept.matches("\r\n").count(), kept.matches('\n').count());
    assert!(!run(&windows, &["--eol", "lf"]).contains('\r'));
}

#[cfg(unix)]
#[test]
fn a_reader_that_stops_is_no_panic() {
    let folder = folder();
    let long = format!(
        "G90\nG71\nG17\nT1M6\nO1S1000M3\nG0X0.Y0.\nZ5.\nG1Z-1.F100\n{}M2\n",
        "X10.\nX0.\n".repeat(50_000)
    );
    fs::write(folder.path().join("long.cn"), long).unwrap();
    let time = "time long.cn --from mach9 --machine romi-discovery-4022 -q --as";
    for (verb, first) in [
        ("mach9 to fanuc long.cn -q", "%\n"),
        (&format!("{time} ndjson"), "{"),
        (&format!("{time} csv"), "n,block,"),
    ] {
        let line = format!("{{ {NCC} {verb}; echo exit $? >&2; }} | head -n 1");
        let done = finish(command("sh", folder.path(), &["-c", &line])).exits(0);
        assert!(done.out.starts_with(first), "{verb}: {}", done.out);
        assert_eq!(done.err, "exit 4\n", "{verb}");
    }
    for closed in [">&-", "2>&-", ">&- 2>&-", "> /dev/full", "2> /dev/full"] {
        for verb in ["mach9 to fanuc good.cn", "dialects", "--help", "explain NC0107", "nonsense"] {
            let line = format!("{NCC} {verb} {closed}");
            let done = finish(command("sh", folder.path(), &["-c", &line]));
            assert!(done.code < 5 && !done.err.contains("panicked"), "{line}: {}", done.err);
        }
    }
}
