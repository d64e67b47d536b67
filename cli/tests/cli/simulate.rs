//! `ncc simulate` as a process: the files that it writes, and the picture of the book. What it says is in
//! `sessions/simulate.md`.

use super::*;

/// The picture of the book, by the arguments that make it.
const PICTURE: [&str; 6] =
    ["simulate", "corpus/mach9/teste.cn", "--stock", "X-25:25 Y-75:75 Z-12:0", "--tool", "1=flat,50"];

#[test]
fn the_picture_of_the_book_is_what_is_drawn() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = tempfile::tempdir().unwrap();
    let drawn = folder.path().join("part.png");
    let arguments = [&PICTURE[..], &["-q", "--png", drawn.to_str().unwrap()]].concat();
    ncc(&root, &arguments).exits(0);
    let drawn = std::fs::read(drawn).unwrap();
    let file = root.join("docs/book/src/images/teste-part.png");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&file, &drawn).unwrap();
    }
    assert!(
        std::fs::read(&file).unwrap_or_default() == drawn,
        "{} differs; bless it with UPDATE_EXPECT=1",
        file.display()
    );
    assert!(book::page("use/simulate.md").contains("(../images/teste-part.png)"));
}

#[test]
fn files_are_what_their_options_say() {
    let folder = folder();
    let folder = folder.path();
    let files = ["--png", "a.png", "--svg", "a.svg", "--stl", "a.stl", "--cells", "64", "-q"];
    let call = [&["simulate", "good.cn", "--from", "mach9"], &files[..]].concat();
    ncc(folder, &call).exits(0);
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    assert!(read("a.png").starts_with(b"\x89PNG\r\n"));
    assert!(read("a.svg").starts_with(b"<svg ") && read("a.svg").ends_with(b"</svg>\n"));
    // A header of 80 bytes, a count, and 50 bytes for each triangle.
    let stl = read("a.stl");
    let count = u32::from_le_bytes(stl[80..84].try_into().unwrap()) as usize;
    assert!(count > 100 && stl.len() == 84 + 50 * count, "{count} in {}", stl.len());
    // What was written is read back: the part is the same as itself.
    let call =
        ["simulate", "good.cn", "--from", "mach9", "--against", "a.stl", "--cells", "64", "--tolerance", "5"];
    ncc(folder, &call).exits(0);
    // The source is not written over.
    ncc(folder, &["simulate", "good.cn", "--from", "mach9", "--stl", "good.cn"]).exits(2);
}
