//! Why a mutant that the verification lets pass makes the same cut.
//!
//! The verdict is never taken from the comparison that is being tested. Either the word itself is
//! of a kind that no control acts upon (a comment, a block number, a program's name, text after the
//! end), or the second interpreter, which shares nothing with the compiler, makes the same events
//! of both texts, from several power-on states; the class then names what kind of word it was.

use std::cell::OnceCell;

use ncc_tests::besides;
use ncc_tests::corpus::Program;
use ncc_tests::interpreter::{PowerOn, Setup};
use ncc_tests::plain::{self, Corners, Plain, Tolerance};

use crate::words::{Change, Is, Mutant};

/// A class of equivalent mutants, or why there is none.
pub(crate) fn class(emitted: &Emitted, mutant: &Mutant) -> Result<&'static str, String> {
    let (dialect, text) = (emitted.dialect, emitted.text);
    let old = &text[mutant.at.clone()];
    let sinumerik = dialect == "siemens";
    // A comment on a Sinumerik begins with a semicolon; the operator reads the rest.
    if sinumerik && mutant.change != Change::Swapped && mutant.is == Is::Text && old[0] == b'"' {
        return Err("a message's text is no comment".into());
    }
    if mutant.change != Change::Swapped {
        match mutant.is {
            Is::Text => return Ok("a comment, text or title"),
            Is::Letter(b'N' | b':') => return Ok("a block number"),
            Is::Name if old[0] == b'N' && old[1..].iter().all(u8::is_ascii_digit) => {
                return Ok("a block number");
            }
            _ => {}
        }
    }
    if behind_the_end(dialect, text, mutant.at.start) {
        return Ok("behind the end of the program");
    }
    if let Err(why) = the_same_moves(emitted, &mutant.text, &same) {
        // Where the source stands already, the digits of the target may leave less than their last one to go.
        let class = match &mutant.change {
            Change::Swapped => "order of blocks about a move that is less than the last digit",
            // After it the control stops the spindle by itself, or the program does.
            Change::Deleted | Change::Sibling(_) if mutant.is == Is::Letter(b'M') && is_spindle(old) => {
                "a spindle code about a move that is less than the last digit"
            }
            _ => return Err(why),
        };
        return the_same_moves(emitted, &mutant.text, &but_for_short).map(|()| class).map_err(|_| why);
    }
    Ok(match (&mutant.change, mutant.is) {
        (Change::Sibling(mark), _) if mark == "AC" || mark == "IC" => "a place counted from elsewhere",
        (_, Is::Name) if old.starts_with(b"CYCLE") => "a cycle that does the same with these arguments",
        (Change::Sibling(_), Is::Name) if old.starts_with(b"STRAIGHT_") => "a move that goes nowhere",
        (Change::Swapped, _) => "order of blocks without an event between",
        (Change::Sign, _) if !old.iter().any(|b| (b'1'..=b'9').contains(b)) => "minus zero",
        (_, Is::Letter(b'O')) if matches!(dialect, "fanuc" | "haas") => "the program's number",
        (Change::Sibling(_), Is::Letter(b'M')) => "a code that ends the program alike",
        (Change::Sibling(_), Is::Letter(b'G') | Is::Name) => "a setting that nothing after it depends on",
        (Change::Deleted, Is::Letter(b'G' | b'M')) => {
            "a code that restates what is in force, or ends what is not"
        }
        (Change::Deleted, Is::Letter(b'X' | b'Y' | b'Z' | b'A' | b'B' | b'C')) => {
            "an axis that stands there already"
        }
        (Change::Deleted, Is::Letter(b'I' | b'J' | b'K')) => "a centre word of zero",
        (_, Is::Letter(b'F')) => "a feed that is in force, or that nothing is cut with",
        (_, Is::Letter(b'S')) => "a speed that is in force, or that nothing turns with",
        (_, Is::Letter(b'D')) if sinumerik => "a length that no Z takes up",
        (_, Is::Name) if old.starts_with(b"%_N_") => "the program's name",
        (_, Is::Label) => "a label that nothing repeats from",
        (Change::Deleted, Is::Named) => "a word of an arc that says it already",
        (_, Is::Named) => "a turn of no angle",
        (Change::Deleted, Is::Sign) if old == b"," => "a comma before nothing",
        (_, Is::Letter(b'T')) => "a tool called ahead, and called again",
        (_, Is::Letter(b'H' | b'O')) => "a length that no Z takes up",
        (Change::Digit | Change::Sign, Is::Letter(b'Z')) if in_a_cycle(text, mutant.at.start) => {
            "a cycle's word that is in force, or that makes no hole"
        }
        (Change::Sign | Change::Digit, Is::Letter(b'X' | b'Y' | b'Z'))
            if block_before(text, mutant.at.start).windows(3).any(|w| w == b"G52" || w == b"G92") =>
        {
            "a shift that is taken back before anything moves"
        }
        (_, Is::Letter(b'R' | b'Q' | b'P' | b'L' | b'D')) => {
            "a cycle's word that is in force, or that makes no hole"
        }
        (Change::Digit, Is::Letter(b'G' | b'M')) => "a setting that nothing after it depends on",
        (Change::Deleted, Is::Sign) => "a mark of the frame",
        (Change::Deleted, Is::Name | Is::Number) => "a word that restates what is in force",
        (_, Is::Number) => "a value that nothing depends on",
        (_, Is::Sign) => "a mark of the frame",
        (_, Is::Name | Is::Letter(_)) => {
            return Err("the same events, but of no class that has a name".into());
        }
        (_, Is::Text) => "a comment, text or title",
    })
}

/// A mutant that is as near to the source as the text itself: the last digit of a number that was
/// rounded, or a word that says the rounded place where an axis stands, or spindle or coolant that are started again
/// before an earlier move, in which the source has them on. Half a unit of the last digit
/// is what equality allows; the second interpreter runs the source and the mutant.
pub(crate) fn rounded(
    source: &Program,
    emitted: &Emitted,
    mutant: &Mutant,
    only: Option<u16>,
) -> Option<&'static str> {
    let class = match mutant.change {
        Change::Digit => "the last digit of a rounded number, as near to the source",
        Change::Deleted => "an axis that stands there already, but for a rounding",
        // What the target's control has switched off by itself is on again in time for the next cut.
        Change::Swapped if switches_on(block_after(emitted.text, mutant.at.start)) => {
            "a switch that is started again earlier, where the source has it on"
        }
        Change::Swapped if starts_spindle(&emitted.text[mutant.at.clone()]) => {
            "a spindle that is started again later, before the cut, where the source has it on"
        }
        Change::Sign | Change::Sibling(_) | Change::Swapped => return None,
    };
    let has = |code: &[u8]| emitted.text.windows(code.len()).any(|w| w == code);
    let inch = [&b"G20"[..], b"G70", b"INCHES", b"inch"].iter().any(|code| has(code));
    let half = if inch { 0.00128 } else { 0.000_501 };
    let corners = Corners::between(source.dialect, emitted.dialect);
    let within = Tolerance { place: half, feed: half, corners, arcs: plain::says_arcs(emitted.dialect) };
    for seed in [0, 1, 2] {
        let world = plain::of_dialect(plain::world(seed), source.dialect);
        let world = besides::zeroed(world, [source.dialect, emitted.dialect]);
        let start = world.start.map(|n| n as f64 / 1e9);
        for skip in [0, 0b10, 0x7fe] {
            let list = |dialect: &str, text: &[u8], only: Option<u16>| {
                let mut setup = plain::setup(&world, skip);
                setup.power_on.offset = only.map_or(setup.power_on.offset, u32::from);
                Some(plain::of_machine(&plain::second(dialect, text, setup).ok()?, start))
            };
            let (a, b) =
                (list(source.dialect, &source.text, None)?, list(emitted.dialect, &mutant.text, only)?);
            plain::compare(&a, &b, within).ok()?;
        }
    }
    Some(class)
}

/// Whether a word is a code of the spindle: it starts or stops it.
fn is_spindle(word: &[u8]) -> bool {
    matches!(word, b"M3" | b"M03" | b"M4" | b"M04" | b"M5" | b"M05")
}

/// Whether a block starts the spindle or coolant, and does nothing else.
fn switches_on(block: &[u8]) -> bool {
    match block.trim_ascii() {
        b"M3" | b"M03" | b"M4" | b"M04" | b"M7" | b"M07" | b"M8" | b"M08" => true,
        b"START_SPINDLE_CLOCKWISE()" | b"START_SPINDLE_COUNTERCLOCKWISE()" => true,
        block => matches!(block, b"FLOOD_ON()" | b"MIST_ON()"),
    }
}

/// Whether the first of these blocks starts the spindle and moves nothing.
fn starts_spindle(blocks: &[u8]) -> bool {
    let first = blocks.split(|b| *b == b'\n').next().unwrap_or_default().trim_ascii();
    let mut words = first.split(|b| *b == b' ').filter(|word| !word.is_empty());
    let starts = words.clone().any(|word| matches!(word, b"M3" | b"M03" | b"M4" | b"M04"));
    starts && words.all(|word| matches!(word[0], b'N' | b'G' | b'S' | b'M'))
}

/// The block after the one that begins at a place.
fn block_after(text: &[u8], place: usize) -> &[u8] {
    text[place..].split(|b| *b == b'\n').nth(1).unwrap_or_default()
}

/// Whether a word stands in the block of a canned cycle.
fn in_a_cycle(text: &[u8], place: usize) -> bool {
    block_before(text, place).windows(2).any(|w| w == b"G8")
}

/// What stands before a word in its block.
fn block_before(text: &[u8], place: usize) -> &[u8] {
    let from = text[..place].iter().rposition(|b| *b == b'\n').map_or(0, |n| n + 1);
    &text[from..place]
}

/// Whether a place lies behind the block that ends the program, outside of subprograms.
fn behind_the_end(dialect: &str, text: &[u8], place: usize) -> bool {
    let before = String::from_utf8_lossy(&text[..place]).into_owned();
    match dialect {
        "mach9" => before.lines().any(|l| matches!(l.trim(), "M2" | "M30")),
        // What follows there are subprograms, each with its own end.
        "siemens" => {
            let unit = before.rfind("%_N_").map_or(&before[..], |at| &before[at..]);
            let end = |w: &str| matches!(w, "M2" | "M02" | "M30" | "M17" | "RET");
            let bare = |l: &str| l.split(';').next().unwrap_or_default().to_owned();
            let whole = &unit[..unit.rfind('\n').map_or(0, |n| n + 1)];
            whole.lines().any(|l| !l.starts_with('/') && bare(l).split_whitespace().any(end))
                && !String::from_utf8_lossy(&text[place..]).starts_with("%_N_")
        }
        // What follows there are subprograms, up to the percent sign.
        "fanuc" | "haas" => {
            let rest = String::from_utf8_lossy(&text[place..]).into_owned();
            rest.trim_start().starts_with('%') && before.contains('\n')
        }
        _ => false,
    }
}

/// An emitted text, with what the second interpreter makes of it.
pub(crate) struct Emitted<'t> {
    pub(crate) dialect: &'t str,
    pub(crate) text: &'t [u8],
    /// Of which dialect the source is.
    from: &'t str,
    runs: OnceCell<Vec<Result<Vec<Plain>, String>>>,
}

impl<'t> Emitted<'t> {
    pub(crate) fn new(from: &'t str, dialect: &'t str, text: &'t [u8]) -> Emitted<'t> {
        Emitted { dialect, text, from, runs: OnceCell::new() }
    }

    /// Runs its text, or another one in its place.
    fn run(&self, text: &[u8], state: State) -> Result<Vec<Plain>, String> {
        run(self.dialect, text, state, [self.from, self.dialect])
    }

    /// Its events from several states, in the order of [`states`].
    fn runs(&self) -> &[Result<Vec<Plain>, String>] {
        self.runs.get_or_init(|| states(self.text).map(|s| self.run(self.text, s)).collect())
    }
}

/// A state of the control: modes at power-on, world, switches of block skip.
type State = (PowerOn, u32, u16);

/// The states in which a text is run; without a skip mark the switches do not matter.
fn states(text: &[u8]) -> impl Iterator<Item = State> {
    let unusual = PowerOn {
        inch: true,
        absolute: false,
        plane: 19,
        offset: 4,
        entry: 9,
        return_initial: false,
        motion: 1,
        tool: None,
        edge: 1,
    };
    let skips: &[u16] = match text.contains(&b'/') {
        true => &[0, 0b10, 0b100, 0b1000, 0x400, 0x7fe],
        false => &[0],
    };
    [PowerOn::default(), unusual].into_iter().flat_map(move |power_on| {
        [0, 1, 2].into_iter().flat_map(move |seed| skips.iter().map(move |skip| (power_on, seed, *skip)))
    })
}

fn run(
    dialect: &str,
    text: &[u8],
    (power_on, seed, skip): State,
    sides: [&str; 2],
) -> Result<Vec<Plain>, String> {
    let world = besides::zeroed(plain::world(seed), sides);
    let start = world.start.map(|n| n as f64 / 1e9);
    let setup = Setup { power_on, ..plain::setup(&world, skip) };
    Ok(plain::of_machine(&plain::second(dialect, text, setup)?, start))
}

/// How the events of two texts are held together.
type Compare = dyn Fn(&[Plain], &[Plain]) -> Result<(), String>;

fn same(was: &[Plain], now: &[Plain]) -> Result<(), String> {
    plain::compare(was, now, Tolerance::SAME)
}

/// Straight moves of less than half a thousandth of a millimetre are none.
fn but_for_short(was: &[Plain], now: &[Plain]) -> Result<(), String> {
    let [was, now] = [was, now].map(|list| ncc_tests::besides::longer(list, HALF));
    plain::compare(&was, &now, Tolerance { place: HALF, ..Tolerance::SAME })
}

/// Half of a thousandth of a millimetre.
const HALF: f64 = 0.0005;

/// Runs both texts in the second interpreter, from several states.
fn the_same_moves(emitted: &Emitted, mutant: &[u8], compare: &Compare) -> Result<(), String> {
    let mut ran = 0;
    for (state, was) in states(emitted.text).zip(emitted.runs()) {
        let Ok(was) = was else { continue };
        let now = emitted.run(mutant, state).map_err(|why| format!("the second interpreter stops: {why}"))?;
        compare(was, &now)?;
        ran += 1;
    }
    if ran < 3 {
        return Err("the second interpreter does not run the text itself".into());
    }
    Ok(())
}
