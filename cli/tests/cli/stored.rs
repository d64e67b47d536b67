//! Sources that are stored as no control reads them, and folders for temporary files that cannot be used.

use super::*;

const PROGRAM: &str = "%\nO1\nG21 G17 G90 G94 G54\nG00 X1.\nM30\n%\n";

#[test]
fn a_text_is_named_as_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let wide = |big: bool| -> Vec<u8> {
        let two = |c: u16| if big { c.to_be_bytes() } else { c.to_le_bytes() };
        PROGRAM.encode_utf16().flat_map(two).collect()
    };
    let cases: [(Vec<u8>, &str, &str); 4] = [
        (
            wide(false),
            "part.nc is not a part program as it is stored: UTF-16",
            "`iconv -f UTF-16LE -t UTF-8 <",
        ),
        (
            wide(true),
            "part.nc is not a part program as it is stored: UTF-16",
            "`iconv -f UTF-16BE -t UTF-8 <",
        ),
        (
            [vec![0xff, 0xfe], wide(false)].concat(),
            "part.nc is not a part program as it is stored: UTF-16",
            "`iconv -f UTF-16LE",
        ),
        (
            PROGRAM.replace('\n', "\r").into(),
            "part.nc is not a part program as it is stored: its lines end with CR",
            r"`tr '\r' '\n' <",
        ),
    ];
    for (text, message, help) in cases {
        std::fs::write(folder.path().join("part.nc"), text).unwrap();
        for arguments in [
            &["fanuc", "to", "haas", "part.nc"][..],
            &["auto", "to", "haas", "part.nc"],
            &["check", "part.nc"],
            &["time", "--from", "fanuc", "part.nc"],
            &["fmt", "--from", "fanuc", "part.nc"],
            &["diff", "--from", "fanuc", "part.nc", "part.nc"],
        ] {
            let code = if arguments[0] == "diff" { 5 } else { 1 };
            ncc(folder.path(), arguments).exits(code).says(message).says(help);
        }
    }
    // As the help says.
    std::fs::write(folder.path().join("part.nc"), PROGRAM.replace('\n', "\r\n")).unwrap();
    ncc(folder.path(), &["fanuc", "to", "haas", "part.nc"]).exits(0);
}

#[test]
fn the_leader_of_a_tape_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let mut outputs = Vec::new();
    for before in ["", "\0\0\0\0\n", "Posted by CAM\n", "REVISION 2\n\nfor machine 7\n"] {
        let text = format!("{before}{PROGRAM}\0\0");
        std::fs::write(folder.path().join("part.nc"), text).unwrap();
        let done = ncc(folder.path(), &["fanuc", "to", "haas", "--no-head", "part.nc"]).exits(0);
        let told = before.starts_with(char::is_alphabetic);
        assert_eq!(done.err.contains("warning[NC0114]: text before the first `%`"), told, "{}", done.err);
        outputs.push(done.out);
    }
    outputs.dedup();
    assert_eq!(outputs.len(), 1, "{outputs:?}");
}

#[cfg(unix)]
#[test]
fn a_folder_for_temporary_files_is_named() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    for (name, reason) in [("none", "there is no such folder"), ("file", "it is not a folder")] {
        for arguments in [
            &["fanuc", "to", "haas", "-"][..],
            &["time", "--from", "fanuc", "-"],
            &["check", "--from", "fanuc", "-"],
            &["fmt", "--from", "fanuc", "-"],
        ] {
            let temporary = folder.path().join(name);
            let mut command = command(NCC, folder.path(), arguments);
            command.env("TMPDIR", &temporary).stdin(Stdio::piped());
            command.stdout(Stdio::piped()).stderr(Stdio::piped());
            let mut child = command.spawn().unwrap();
            let _ = child.stdin.take().unwrap().write_all(PROGRAM.as_bytes());
            let done = child.wait_with_output().unwrap();
            let err = String::from_utf8(done.stderr).unwrap();
            assert_eq!(done.status.code(), Some(4), "{err}");
            let shown = temporary.display();
            let message =
                format!("cannot read <stdin>: cannot use the folder of temporary files, {shown}: {reason}");
            assert!(err.contains(&message), "{err}");
            assert!(err.contains("help: name a folder with free space: TMPDIR=/var/tmp"), "{err}");
        }
    }
}
