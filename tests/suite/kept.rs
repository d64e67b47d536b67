//! Programs that compute and are kept as such: the second interpreter runs the source and what was written of it, and
//! both must make the same moves. It shares nothing with the readers, the writers and the verification.
//!
//! What it does not run is listed with its reason in `tests/computing/unjudged.txt`, to be read by a person.

use std::fmt::Write;
use std::fs;

use ncc_tests::besides;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::{self, Failures};
use ncc_tests::plain::{self, Corners, Tolerance};

/// A text in the place of a program tells why there is none.
fn is_program(text: &[u8]) -> bool {
    let told = ["note[", "warning[", "error[", "bug["];
    !told.iter().any(|told| text.starts_with(told.as_bytes()))
}

#[test]
fn what_is_kept_makes_the_moves_of_its_source() {
    let mut failures = Failures::default();
    let mut unjudged = String::new();
    let mut judged = 0;
    let sources: Vec<_> = DIALECTS.into_iter().flat_map(corpus::computing).collect();
    for path in corpus::files(&corpus::root().join("tests/computing/kept")) {
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let text = fs::read(&path).unwrap_or_default();
        let from = |p: &&corpus::Program| file.starts_with(&format!("{}-{}.", p.dialect, p.name));
        let Some(source) = sources.iter().find(from) else {
            failures.add(&file, "the output of no program");
            continue;
        };
        let to = path.extension().and_then(|to| DIALECTS.into_iter().find(|d| to == *d));
        let Some(to) = to.filter(|_| is_program(&text)) else { continue };
        let within = Tolerance {
            corners: Corners::between(source.dialect, to),
            arcs: plain::says_arcs(to),
            ..Tolerance::ROUNDED
        };
        for seed in [0, 1, 2] {
            let world = plain::of_dialect(plain::world(seed), source.dialect);
            let world = besides::zeroed(world, [source.dialect, to]);
            let start = world.start.map(|n| n as f64 / 1e9);
            for skip in [0, 0x7fe] {
                let run = |dialect: &str, text: &[u8]| {
                    // Its own file ends behind a subprogram that stands alone.
                    if dialect == "linuxcnc" && text.ends_with(b" endsub\nM2\n%\n") {
                        return Err("a subprogram that nothing calls".to_owned());
                    }
                    let machine = plain::second(dialect, text, plain::setup(&world, skip))?;
                    Ok::<_, String>(besides::as_shown(plain::of_machine(&machine, start), to))
                };
                match (run(source.dialect, &source.text), run(to, &text)) {
                    (Ok(a), Ok(b)) => {
                        judged += 1;
                        if let Err(fault) = plain::compare(&a, &b, within) {
                            let text = String::from_utf8_lossy(&text);
                            failures.add(&file, format!("world {seed} skip {skip:b}: {fault}\n{text}"));
                        }
                    }
                    (Err(why), _) if (seed, skip) == (0, 0) => {
                        let _ = writeln!(unjudged, "{file}: the source, {why}");
                    }
                    (_, Err(why)) if (seed, skip) == (0, 0) => {
                        let _ = writeln!(unjudged, "{file}: {why}");
                    }
                    _ => {}
                }
            }
        }
    }
    let list = corpus::root().join("tests/computing/unjudged.txt");
    failures.check("unjudged", expect::file(&list, unjudged.as_bytes()));
    println!("{judged} runs");
    assert!(judged > 50);
    failures.finish();
}
