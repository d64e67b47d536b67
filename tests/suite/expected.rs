//! Outputs that somebody has read: `tests/expected/<from>/<name>/to.<dialect>.<extension>`. What was
//! taken for granted stands in their heads; what is refused is listed in `refusals.txt`.

use ncc_dialects::builtin;
use ncc_tests::corpus;
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, rendered, translate};

#[test]
fn outputs_are_as_read() {
    let mut failures = Failures::default();
    let mut compared = 0;
    let expected = corpus::root().join("tests/expected");
    for program in corpus::all() {
        let folder = expected.join(program.dialect).join(&program.name);
        // A folder, even an empty one, asks for all outputs of that program.
        if !folder.is_dir() {
            continue;
        }
        for to in corpus::DIALECTS {
            let job = job(program.dialect, to, &program.file);
            let (outcome, text) = translate(&job, &program.text);
            let extension = builtin(to).expect("a dialect").extensions[0].to_lowercase();
            let output = folder.join(format!("to.{to}.{extension}"));
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            if outcome.release.is_ok() {
                failures.check(&what, expect::file(&output, &text));
            } else if output.exists() {
                failures.add(&what, rendered(&job, &program.file, &program.text, &outcome.diagnostics));
            }
            compared += 1;
        }
    }
    assert!(compared >= 40, "{compared} outputs");
    failures.finish();
}
