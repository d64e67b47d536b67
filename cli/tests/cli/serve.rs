//! `ncc serve user`, `audit`, `import`, `backup` and `restore`: work on a database without a server.

use super::*;

/// A command with a password from a pipe.
fn with_password(folder: &Path, args: &[&str], password: &str) -> (i32, String) {
    let mut child = Command::new(NCC)
        .args(args)
        .current_dir(folder)
        .env_remove("NCC_DATABASE_URL")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(password.as_bytes()).unwrap();
    let done = child.wait_with_output().unwrap();
    let text = [done.stdout, done.stderr].concat();
    (done.status.code().unwrap_or(-1), String::from_utf8_lossy(&text).into_owned())
}

#[test]
fn accounts_are_made_with_a_password_from_a_pipe() {
    let folder = folder();
    let folder = folder.path();
    let user =
        |args: &[&str], password: &str| with_password(folder, &[&["serve", "user"], args].concat(), password);
    let (code, told) = user(&["add", "ben", "--role", "reader"], "correct horse\n");
    assert!(code == 2 && told.contains("--role admin"), "{told}");
    let (code, told) = user(&["add", "ana", "--role", "admin"], "short\n");
    assert!(code == 2 && told.contains("10 to 1024 bytes"), "{told}");
    assert_eq!(user(&["add", "ana", "--role", "admin"], "correct horse\n"), (0, String::new()));
    assert_eq!(user(&["add", "ben", "--role", "editor", "--folder", "plates"], "correct horse\n").0, 0);
    assert_eq!(user(&["list"], ""), (0, "ana: admin\nben: editor in plates\n".to_owned()));
    // A password is no argument, and a role is one of the roles.
    assert_eq!(user(&["add", "eva", "--role", "admin", "--password", "correct horse"], "").0, 2);
    assert_eq!(user(&["add", "eva", "--role", "king"], "correct horse\n").0, 2);
    assert_eq!(user(&["add", "Eva", "--role", "reader"], "correct horse\n").0, 2);
    let (code, token) = user(&["token", "ben", "--for", "erp", "--scope", "change"], "");
    assert!(code == 0 && token.starts_with("ncc_") && token.trim().len() == 56, "{token}");
    assert_eq!(user(&["disable", "ben"], "").0, 0);
    assert_eq!(user(&["disable", "ana"], "").0, 2);
    assert_eq!(user(&["password", "nobody"], "correct horse\n").0, 2);
    assert_eq!(user(&["list"], "").1, "ana: admin\nben: editor in plates (disabled)\n");
    let (code, told) = with_password(folder, &["serve", "audit"], "");
    assert!(code == 0 && told.starts_with("4 entries, each follows the one before it"), "{told}");
    // Others may not ask without TLS, whatever accounts there are.
    let (code, told) = with_password(folder, &["serve", "--listen", "0.0.0.0:0"], "");
    assert!(code == 2 && told.contains("--tls-cert FILE"), "{told}");
    let alone = ["serve", "--listen", "0.0.0.0:0", "--database", "other.sqlite"];
    let (code, told) = with_password(folder, &alone, "");
    assert!(code == 2 && told.contains("ncc serve user add"), "{told}");
}

#[test]
fn hooks_have_targets_of_a_form() {
    let folder = folder();
    let folder = folder.path();
    let serve =
        |args: &[&str]| with_password(folder, &[&["serve", "--listen", "127.0.0.1:0"], args].concat(), "");
    for (args, why) in [
        (&["--hook-target", "erp.example"][..], "it begins with https://"),
        (&["--hook-target", "https://ana:secret@erp.example/"], "neither user nor password"),
        (&["--hook-target", "https://erp.example/", "--hook-ca", "no/such.pem"], "no/such.pem"),
        (&["--hook-ca", "own.pem"], "--hook-target"),
        (&["--only", "persistence", "--hook-target", "https://erp.example/"], "cannot be used with"),
    ] {
        let (code, told) = serve(args);
        assert!(code == 2 && told.contains(why), "{args:?}: {code} {told}");
    }
}

const PROGRAM: &str = "%\nO1\nG21 G17 G90 G94 G54\nG00 X1.\nM30\n%\n";

/// A folder with programs, and with files that are none.
fn shop() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    put("shop/one.nc", PROGRAM.as_bytes());
    put("shop/a/b/two.nc", GOOD.as_bytes());
    put("shop/a/notes.pdf", b"%PDF");
    put("shop/.hidden.nc", PROGRAM.as_bytes());
    folder
}

#[test]
fn a_folder_is_imported() {
    let folder = shop();
    let at = folder.path();
    let import =
        |more: &[&str]| ncc(at, &[&["serve", "import", "shop", "--database", "a.sqlite"], more].concat());
    let first = import(&["-v"]).exits(0);
    assert!(first.out.starts_with("2 programs: 2 new, 0 changed, 0 the same"), "{}", first.out);
    for line in ["left out: 2 other files", "notes.pdf: of another extension", ".hidden.nc: hidden"] {
        assert!(first.out.contains(line), "{line}: {}", first.out);
    }
    assert!(import(&[]).exits(0).out.starts_with("2 programs: 0 new, 0 changed, 2 the same"));
    std::fs::write(at.join("shop/one.nc"), PROGRAM.replace("X1.", "X2.")).unwrap();
    assert!(import(&[]).exits(0).out.starts_with("2 programs: 0 new, 1 changed, 1 the same"));
    assert!(import(&["--into", "other/place"]).exits(0).out.starts_with("2 programs: 2 new"));
    // A file that is no text, and a link, are left out and reported.
    std::fs::write(at.join("shop/raw.nc"), b"G0\0\0X1").unwrap();
    let third = import(&[]).exits(1);
    assert!(third.err.contains("raw.nc: it is no text") && third.out.contains("1 not imported"), "{third:?}");
    std::fs::remove_file(at.join("shop/raw.nc")).unwrap();
    #[cfg(unix)]
    {
        std::fs::write(at.join("secret.nc"), PROGRAM).unwrap();
        std::os::unix::fs::symlink(at.join("secret.nc"), at.join("shop/link.nc")).unwrap();
        std::os::unix::fs::symlink(at, at.join("shop/circle")).unwrap();
        let linked = import(&[]).exits(1);
        assert!(
            linked.err.contains("link.nc: it is a link") && linked.out.starts_with("2 programs"),
            "{linked:?}"
        );
    }
    for (wrong, words) in [
        (&["serve", "import", "none", "--database", "a.sqlite"][..], "none is no folder"),
        (&["serve", "import", "shop", "--database", "a.sqlite", "--from", "x"], "there is no dialect `x`"),
        (&["serve", "import", "shop", "--database", "a.sqlite", "--machine", "x"], "there is no machine `x`"),
        (
            &["serve", "import", "shop/a", "--database", "a.sqlite", "--from", "mach9"],
            "there is no program in",
        ),
    ] {
        ncc(at, wrong).exits(2).says(words);
    }
}

#[test]
fn a_backup_is_restored() {
    let folder = shop();
    let at = folder.path();
    ncc(at, &["serve", "import", "shop", "--database", "a.sqlite"]).exits(0);
    let made = ncc(at, &["serve", "backup", "b.sqlite", "--database", "a.sqlite"]).exits(0);
    assert!(made.out.starts_with("b.sqlite: ") && made.out.ends_with(" rows\n"), "{}", made.out);
    ncc(at, &["serve", "backup", "b.sqlite", "--database", "a.sqlite"]).exits(2).says("is there already");
    ncc(at, &["serve", "backup", "c.sqlite", "--database", "none.sqlite"])
        .exits(4)
        .says("cannot use the database");
    let restored = ncc(at, &["serve", "restore", "b.sqlite", "--database", "new.sqlite"]).exits(0);
    assert_eq!(restored.out.replace(" restored", ""), made.out);
    let again = ncc(at, &["serve", "import", "shop", "--database", "new.sqlite"]).exits(0);
    assert!(again.out.starts_with("2 programs: 0 new, 0 changed, 2 the same"), "{}", again.out);
    ncc(at, &["serve", "restore", "b.sqlite", "--database", "new.sqlite"])
        .exits(4)
        .says("the database is not empty");
    ncc(at, &["serve", "restore", "shop/one.nc", "--database", "x.sqlite"]).exits(4).says("cannot restore");
}
