//! The programs of the corpus are read without an error.

use std::path::Path;

use ncc_ir::diag::Gravity;

use super::*;

#[test]
fn the_corpus_is_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpus/siemens");
    let mut count = 0;
    let mut wrong = String::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let text = std::fs::read(&path).expect("a file");
        let out = read_with(settings(), true, &text);
        count += 1;
        for (diagnostic, shown) in out.diagnostics.iter().zip(diagnostics(&out, &text)) {
            if diagnostic.fault.gravity() == Gravity::Error {
                wrong += &format!("{}: {shown}\n", path.display());
            }
        }
    }
    assert!(count >= 57, "{count}");
    assert!(wrong.is_empty(), "{wrong}");
}
