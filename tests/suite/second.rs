//! The second interpreter: it runs the corpus, and its events are the compiler's.

use ncc_tests::corpus;
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::Setup;
use ncc_tests::plain;

/// Every word-address program of the corpus is in the second interpreter's scope.
#[test]
fn runs_the_corpus() {
    let mut failures = Failures::default();
    for program in ["mach9", "fanuc"].into_iter().flat_map(corpus::of) {
        let what = format!("{}/{}", program.dialect, program.file);
        if let Some(m) = failures.check(&what, plain::second(program.dialect, &program.text, Setup::plain()))
        {
            if std::env::var_os("NCC_SHOW").is_some() {
                println!("== {what}");
                for e in plain::of_machine(&m, [0.0; 6]) {
                    println!("{}", plain::show(&e));
                }
            }
        }
    }
    failures.finish();
}
