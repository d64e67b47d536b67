//! What the README shows is what is printed. Its pictures are held in `plot`.

use super::*;

/// Commands of the README whose whole output it shows.
const SHOWN: [&[&str]; 3] =
    [&["dialects"], &["machines"], &["time", "corpus/mach9/teste.cn", "--machine", "romi-discovery-4022"]];

#[test]
fn the_readme_shows_what_is_printed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    for arguments in SHOWN {
        let printed = ncc(&root, arguments).exits(0).out;
        let block = format!("```\n{printed}```\n");
        assert!(readme.contains(&block), "ncc {}: the README does not show\n{printed}", arguments.join(" "));
    }
}
