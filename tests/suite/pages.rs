//! Side-by-side pages: `tests/pages/*.md`, one fact in every dialect.
//!
//! Of every ordered pair of blocks: the text on the right makes the same cut as the text on the
//! left (judged by the compiler), and translating the left one works. Where it gives the right
//! one's very text, the page says so in `text-exact:`. A block marked `refused NC0501` says that
//! every translation into that dialect is refused with that code; of several, with one of them.
//!
//! `differs: mach9→fanuc` names directions in which the block on the right does not make the same
//! cut, and the page says why.
//!
//! `UPDATE_EXPECT=1` fills empty blocks by translation and writes the `text-exact:` line anew.

use ncc_driver::job::Failure;
use ncc_driver::translate::judge::Judge;
use ncc_exec::world::World;
use ncc_ir::expr::num::ONE;
use ncc_tests::besides;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::{self, Failures};
use ncc_tests::page::{self, Page};
use ncc_tests::plain::{self, Corners, Tolerance};
use ncc_tests::translate::{GRBLHAL, job, rendered, settings, stopping, translate};

#[test]
fn one_fact_in_every_dialect() {
    let mut failures = Failures::default();
    let pages = corpus::files(&corpus::root().join("tests/pages"));
    assert!(pages.len() >= 25, "{} pages", pages.len());
    let mut pairs = 0;
    for path in pages {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut text = std::fs::read_to_string(&path).expect("a page");
        if expect::updating() {
            text = filled(&text);
        }
        let page = page::read(&text);
        let mut exact = Vec::new();
        // A page may have a block of a Grbl with other options too.
        let own = page.block(GRBLHAL).map(|_| GRBLHAL);
        let languages: Vec<&str> = DIALECTS.into_iter().chain(own).collect();
        for from in &languages {
            for to in &languages {
                let what = format!("{name}: {from} to {to}");
                if let Some(is_exact) = failures.check(&what, pair(&page, from, to)) {
                    pairs += 1;
                    if is_exact {
                        exact.push(format!("{from}→{to}"));
                    }
                }
            }
        }
        let line = format!("text-exact: {}", exact.join(" "));
        let text = text.lines().map(|l| if l.starts_with("text-exact: ") { &line } else { l });
        let text = text.collect::<Vec<_>>().join("\n") + "\n";
        failures.check(&name, expect::file(&path, text.as_bytes()));
    }
    println!("{pairs} pairs");
    failures.finish();
}

/// Checks a pair of blocks; true if the translation gives the very text.
fn pair(page: &Page, from: &str, to: &str) -> Result<bool, String> {
    let block = |dialect: &str| page.block(dialect).ok_or_else(|| format!("no block in {dialect}"));
    let (left, right) = (block(from)?, block(to)?);
    if left.notes.first().is_some_and(|n| n == "refused") {
        return Ok(false);
    }
    let file = format!("page.{from}");
    let mut job = job(from, to, &file);
    job.head = false;
    let (outcome, written) = translate(&job, left.text.as_bytes());
    let said = || rendered(&job, &file, left.text.as_bytes(), &outcome.diagnostics);
    let direction = format!("{from}→{to}");
    let refused = page.fact("refused").filter(|refused| refused.split(' ').any(|word| word == direction));
    let notes = match refused {
        Some(refused) => ["refused"].into_iter().chain(refused.split(' ')).map(str::to_owned).collect(),
        None => right.notes.clone(),
    };
    if let [refused, listed @ ..] = &notes[..] {
        let codes: Vec<String> = stopping(&job, &outcome).iter().map(|c| format!("NC{c:04}")).collect();
        return match outcome.release {
            // Several codes at once stand as `NC0226+NC0501`.
            Err(Failure::Refused)
                if refused == "refused" && !codes.is_empty() && listed.contains(&codes.join("+")) =>
            {
                Ok(false)
            }
            _ => Err(format!("expected a refusal with {listed:?}, found {codes:?}\n{}", said())),
        };
    }
    if outcome.release.is_err() {
        return Err(said());
    }
    let judge = Judge::new(&job, left.text.as_bytes()).map_err(|e| e.to_string())?;
    let judged = judge.judge_another(right.text.as_bytes());
    let differs = page.fact("differs").is_some_and(|d| d.split(' ').any(|d| d == direction));
    match (judged, differs) {
        (Ok(_), false) => Ok(written == right.text.as_bytes()),
        (Err(_), true) => Ok(false),
        (Ok(_), true) => Err(format!("the {to} block is the same cut, and the page says that it differs")),
        (Err(d), false) => Err(format!("the {to} block is not the same cut: {:?}", d.fault)),
    }
}

/// The blocks of a page make the same moves for the second interpreter too, which judges without the
/// compiler. A control's own peck clearance is the one that the pages name, so nothing differs here.
#[test]
fn blocks_agree_by_the_second_interpreter() {
    let mut failures = Failures::default();
    let mut compared = 0;
    for path in corpus::files(&corpus::root().join("tests/pages")) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let page = page::read(&std::fs::read_to_string(&path).expect("a page"));
        let blocks: Vec<_> =
            page.blocks.iter().filter(|b| b.notes.is_empty() && !b.text.is_empty()).collect();
        for world in [0, 1, 2].map(plain::world) {
            let world = World { peck_clearance: ONE, break_lift: ONE, ..world };
            let start = world.start.map(|n| n as f64 / 1e9);
            for skip in [0, 0b10, 0b100, 0x7fe] {
                let moves_in = |world: &World, dialect: &str, text: &str| {
                    let machine = plain::second(dialect, text.as_bytes(), plain::setup(world, skip))?;
                    Ok::<_, String>(plain::of_machine(&machine, start))
                };
                let moves = |dialect: &str, text: &str| moves_in(&world, dialect, text);
                let lists: Vec<_> =
                    blocks.iter().map(|b| (b.language.as_str(), moves(&b.language, &b.text))).collect();
                let Some((first, (Ok(expected), rest))) =
                    lists.split_first().map(|((d, list), rest)| (d, (list, rest)))
                else {
                    failures.add(&name, format!("{:?}", lists.first().map(|l| l.1.as_ref().err())));
                    continue;
                };
                for ((dialect, list), block) in rest.iter().zip(&blocks[1..]) {
                    compared += 1;
                    let within = Tolerance {
                        corners: Corners::between(first, dialect),
                        arcs: plain::says_arcs(dialect),
                        ..Tolerance::ROUNDED
                    };
                    let result = match by_hand(dialect) {
                        // Where tools are put in by hand, the zero of Z is set by each.
                        true => {
                            let world = World { zeroed_by_tool: true, ..world.clone() };
                            moves_in(&world, first, &blocks[0].text)
                                .map(|first| besides::as_shown(first, dialect))
                                .and_then(|first| {
                                    plain::compare(&first, &moves_in(&world, dialect, &block.text)?, within)
                                })
                        }
                        false => list.clone().and_then(|l| plain::compare(expected, &l, within)),
                    };
                    failures.check(format!("{name}: {first} and {dialect}, skip {skip:b}"), result);
                }
            }
        }
    }
    println!("{compared} comparisons");
    failures.finish();
}

/// Whether tools are changed by hand on the control of a dialect.
fn by_hand(dialect: &str) -> bool {
    settings(dialect).dialect.can.change_by_hand
}

/// The page with its empty blocks translated from the first one that has a text.
fn filled(text: &str) -> String {
    let page = page::read(text);
    let mut out = String::new();
    let mut lines = text.lines().peekable();
    // A Fanuc block says its work offset.
    let source = page.blocks.iter().filter(|b| !b.text.is_empty()).max_by_key(|b| b.language == "fanuc");
    let has_exact = text.lines().any(|l| l.starts_with("text-exact: "));
    while let Some(line) = lines.next() {
        if line.starts_with("```") && !has_exact && !out.contains("text-exact: ") {
            out.push_str("text-exact: \n\n");
        }
        out.push_str(line);
        out.push('\n');
        let language = line.strip_prefix("```").filter(|l| DIALECTS.contains(l) || *l == GRBLHAL);
        if let (Some(to), Some(source), Some(&"```")) = (language, source, lines.peek()) {
            let mut job = job(&source.language, to, "page");
            job.head = false;
            let (_, written) = translate(&job, source.text.as_bytes());
            out.push_str(&String::from_utf8_lossy(&written));
        }
    }
    out
}
