//! `ncc serve import`, `backup` and `restore`. The server itself is tested in `service/tests`.

use super::*;

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
