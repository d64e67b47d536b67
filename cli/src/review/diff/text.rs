//! Two texts, block by block: what is written otherwise, apart from what shall count for nothing.
//!
//! What a block says is normalised by its own dialect's rules: where `X100` counts increments it is not
//! `X100.`, where it counts millimetres it is. Only spelling is looked at; what blocks do is `motion`'s
//! matter.

use std::cell::RefCell;
use std::io;

use ncc_dialects::{Bare, Family, INTEGER_FEED, Quantity, Settings};
use ncc_driver::review::diff::tell::{Account, Block, Difference, decoded};
use ncc_driver::side::Side;
use similar::{DiffOp, group_diff_ops};

use super::args::Ignore;
use super::edits::edits;
use super::lines::{Both, Lines, Say};

/// Blocks around a difference that are shown.
const AROUND: usize = 3;
/// Blocks of a difference that an account keeps.
const MOST_BLOCKS: usize = 100;
/// Differences that are kept.
const MOST: usize = 20_000;
/// Bytes of a block that are shown and kept: no control reads a longer one.
const LONGEST: usize = 16 * 1024;
/// The option that says what a number without a point counts, and its value that makes them units.
const POINT_OPTION: (&str, &str) = ("decimal_point", "calculator");

/// What was found.
pub(crate) struct Texts {
    /// The account.
    pub(crate) account: Account,
    /// Differences in the unified form, each with what is around it.
    pub(crate) unified: Vec<String>,
}

/// Compares two texts.
///
/// # Errors
/// Reading them.
pub(crate) fn compare(sides: &mut [Side; 2], ignore: &[Ignore]) -> io::Result<Texts> {
    let ignored = |what| ignore.contains(&what) || ignore.contains(&Ignore::All);
    let rules = Rules {
        numbers: ignored(Ignore::Numbers),
        blanks: ignored(Ignore::Blanks),
        comments: ignored(Ignore::Comments),
        case: ignored(Ignore::Case),
        format: ignored(Ignore::NumberFormat),
    };
    let shown = [0, 1].map(|side: usize| sides[side].source.shown.clone());
    let dialects = [0, 1].map(|side: usize| sides[side].dialect().id.clone());
    let [first, second] = sides;
    let mut texts = [lines(first, rules)?, lines(second, rules)?];
    let ops = edits(&mut Both { texts: &mut texts, around: AROUND })?;
    let crlf = [texts[0].crlf, texts[1].crlf];
    let texts = RefCell::new(texts);
    let unread = RefCell::new(None);
    let block = |side: usize, i: usize| {
        shown_block(&mut texts.borrow_mut()[side], i).unwrap_or_else(|error| {
            unread.borrow_mut().get_or_insert(error);
            Block { line: 0, text: String::new() }
        })
    };
    let mut differences = Vec::new();
    let (mut only, mut same, mut count) = ([0u64; 2], 0u64, 0u64);
    for op in &ops {
        if let DiffOp::Equal { len, .. } = op {
            same += *len as u64;
            continue;
        }
        let ranges = [op.old_range(), op.new_range()];
        only = [only[0] + ranges[0].len() as u64, only[1] + ranges[1].len() as u64];
        count += 1;
        if differences.len() < MOST {
            let blocks = [0, 1].map(|side: usize| {
                ranges[side].clone().take(MOST_BLOCKS).map(|i| block(side, i)).collect::<Vec<Block>>()
            });
            let before = |side: usize| ranges[side].start.checked_sub(1).map(|i| block(side, i));
            differences.push(Difference {
                kind: "text",
                title: title([ranges[0].len(), ranges[1].len()]),
                values: None,
                offset: None,
                tool: None,
                moves: [0; 2],
                holes: [0; 2],
                skip: Vec::new(),
                more: [0, 1].map(|side: usize| ranges[side].len() > MOST_BLOCKS),
                paired: ranges[0].len() == ranges[1].len(),
                beside: [0, 1].map(|side: usize| if blocks[side].is_empty() { before(side) } else { None }),
                blocks,
            });
        }
    }
    let mut notes = Vec::new();
    if crlf[0] != crlf[1] {
        let name = |crlf: bool| if crlf { "CR LF" } else { "LF" };
        notes.push(format!("lines end with {} and with {}", name(crlf[0]), name(crlf[1])));
    }
    // How lines end is a matter of blanks.
    let equal = count == 0 && (crlf[0] == crlf[1] || rules.blanks);
    let listed = differences.len() as u64;
    let unified = group_diff_ops(ops, AROUND).iter().map(|group| hunk(group, &block)).collect();
    if let Some(error) = unread.take() {
        return Err(error);
    }
    let plural = |n: u64| if n == 1 { "block" } else { "blocks" };
    let summary = match (equal, count) {
        (true, _) if ignore.is_empty() => "the same text".to_owned(),
        (true, _) => "the same text, apart from what counts for nothing".to_owned(),
        (false, 0) => "the same blocks with other line ends".to_owned(),
        (false, n) => format!(
            "{} {} of the first and {} of the second differ, in {n} {}",
            only[0],
            plural(only[0]),
            only[1],
            if n == 1 { "place" } else { "places" }
        ),
    };
    let account = Account {
        level: "text",
        names: shown,
        dialects,
        equal,
        summary,
        same,
        unmatched: only,
        worlds: 0,
        settings: 0,
        tolerance: 0.0,
        notes,
        differences,
        left_out: count - listed,
    };
    Ok(Texts { account, unified })
}

/// A line that differs, or one around it.
fn shown_block(lines: &mut Lines, index: usize) -> io::Result<Block> {
    let Some(place) = lines.place(index) else { return Ok(Block { line: 0, text: String::new() }) };
    let text = decoded(&lines.text(place, LONGEST)?);
    let text = if place.length > LONGEST as u64 { text + "…" } else { text };
    Ok(Block { line: place.number, text })
}

fn title([a, b]: [usize; 2]) -> String {
    let many = |n: usize| if n == 1 { "1 block".to_owned() } else { format!("{n} blocks") };
    match (a, b) {
        (a, 0) => format!("{} only in the first", many(a)),
        (0, b) => format!("{} only in the second", many(b)),
        (a, b) if a == b => format!("{} changed", many(a)),
        (a, b) => format!("{} replaced by {b}", many(a)),
    }
}

/// A stretch in the unified form.
fn hunk(group: &[DiffOp], block: &dyn Fn(usize, usize) -> Block) -> String {
    let mut text = String::new();
    let mut spans = [(0u64, 0usize); 2];
    for op in group {
        let ranges = [op.old_range(), op.new_range()];
        for (side, sign) in ['-', '+'].into_iter().enumerate() {
            let equal = matches!(op, DiffOp::Equal { .. });
            for i in ranges[side].clone() {
                let block = block(side, i);
                if spans[side].1 == 0 {
                    spans[side].0 = block.line;
                }
                spans[side].1 += 1;
                match (equal, side) {
                    (true, 0) => text += &format!(" {}\n", block.text),
                    (true, _) => {}
                    (false, _) => text += &format!("{sign}{}\n", block.text),
                }
            }
        }
    }
    let [(a, n), (b, m)] = spans;
    format!("@@ -{a},{n} +{b},{m} @@\n{text}")
}

/// The lines of a text, with what they say by these rules.
fn lines(side: &mut Side, rules: Rules) -> io::Result<Lines<'_>> {
    let Side { source, job } = side;
    let settings: &Settings = &job.from;
    let bare = bare(settings);
    let say = move |line: &[u8], said: &mut Vec<u8>| {
        normal(line, settings, &rules, &bare, said);
        !(said.is_empty() && (rules.blanks || (rules.comments && !line.is_empty())))
    };
    let say: Option<Say> = if rules == Rules::default() { None } else { Some(Box::new(say)) };
    Lines::new(&mut *source.file, say)
}

/// What counts for nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Rules {
    numbers: bool,
    blanks: bool,
    comments: bool,
    case: bool,
    format: bool,
}

/// Whether a bare number of a letter counts increments, letter by letter.
fn bare(settings: &Settings) -> [bool; 26] {
    let dialect = settings.dialect;
    let mut all = [false; 26];
    let units = dialect.option.iter().any(|o| o.name == POINT_OPTION.0)
        && settings.get(POINT_OPTION.0) == POINT_OPTION.1;
    for row in dialect.address.iter().filter(|row| row.letter.is_ascii_uppercase()) {
        let whole = row.quantity == Quantity::Feed && settings.get(POINT_OPTION.0) == INTEGER_FEED;
        let rule = if whole { Bare::Units } else { dialect.numbers(row.quantity).bare };
        all[(row.letter as u8 - b'A') as usize] = rule == Bare::Increments && !units;
    }
    all
}

/// Appends what a line says to nothing.
fn normal(line: &[u8], settings: &Settings, rules: &Rules, bare: &[bool; 26], out: &mut Vec<u8>) {
    let dialect = settings.dialect;
    let (open, close) = (dialect.comment.open.as_bytes(), dialect.comment.close.as_bytes());
    let quotes = dialect.family == Family::Sinumerik;
    let mut at = 0;
    if rules.numbers {
        at = after_number(line, dialect.block.number, dialect.block.skip.as_bytes(), out);
    }
    let mut letters = 0;
    while let Some(&byte) = line.get(at) {
        let rest = &line[at..];
        if !open.is_empty() && rest.starts_with(open) {
            let len = match close.is_empty() {
                true => rest.len(),
                false => {
                    rest.windows(close.len()).position(|w| w == close).map_or(rest.len(), |i| i + close.len())
                }
            };
            if !rules.comments {
                out.extend_from_slice(&rest[..len]);
            }
            at += len;
            letters = 0;
        } else if quotes && byte == b'"' {
            let len = memchr::memchr(b'"', &rest[1..]).map_or(rest.len(), |i| i + 2);
            out.extend_from_slice(&rest[..len]);
            at += len;
            letters = 0;
        } else if byte.is_ascii_whitespace() {
            if !rules.blanks {
                out.push(byte);
            }
            at += 1;
        } else if byte.is_ascii_alphabetic() {
            out.push(if rules.case { byte.to_ascii_uppercase() } else { byte });
            letters += 1;
            at += 1;
            let omitted = rules.format
                && dialect.block.omitted_zero
                && !line[at..]
                    .iter()
                    .find(|b| !b.is_ascii_whitespace())
                    .is_some_and(|b| b.is_ascii_digit() || b"+-.".contains(b));
            if omitted {
                out.push(b'0');
            }
        } else {
            let of_letter = letters == 1 || (letters > 0 && dialect.block.omitted_zero);
            let signed = of_letter && (byte == b'-' || byte == b'+');
            let digits = &rest[usize::from(signed)..];
            let len = digits.iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
            // Digits that end a name of several letters belong to it.
            if rules.format && len > 0 && (letters < 2 || of_letter) {
                let letter = out.last().filter(|_| of_letter).map(|b| b.to_ascii_uppercase());
                let counts = letter.is_some_and(|l| l.is_ascii_uppercase() && bare[(l - b'A') as usize]);
                let len = usize::from(signed) + len;
                plain(&rest[..len], counts, out);
                at += len;
            } else {
                let len = len.max(1) + usize::from(signed && len > 0);
                out.extend_from_slice(&rest[..len.min(rest.len())]);
                at += len;
            }
            letters = 0;
        }
    }
    if rules.comments && !rules.blanks {
        // What stood before a comment that counts for nothing.
        let kept = out.iter().rposition(|b| !b.is_ascii_whitespace()).map_or(0, |i| i + 1);
        out.truncate(kept);
    }
}

/// Passes over a block number; the mark of a block with block skip stays.
fn after_number(line: &[u8], letter: Option<char>, skip: &[u8], out: &mut Vec<u8>) -> usize {
    let blanks = |at: usize| at + line[at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
    let digits = |at: usize| at + line[at..].iter().take_while(|b| b.is_ascii_digit()).count();
    let start = blanks(0);
    let mut at = start;
    if !skip.is_empty() && line[at..].starts_with(skip) {
        at = blanks(digits(at + skip.len()));
    }
    let is = letter.is_some_and(|l| {
        line.get(at).is_some_and(|b| b.to_ascii_uppercase() == l.to_ascii_uppercase() as u8)
    });
    let end = if is { digits(at + 1) } else { at };
    if !is || end == at + 1 {
        return 0;
    }
    out.extend_from_slice(&line[..at]);
    blanks(end)
}

/// A number, with its sign if it has one, in its shortest form; where it counts increments, it is marked.
fn plain(number: &[u8], increments: bool, out: &mut Vec<u8>) {
    let negative = number.starts_with(b"-");
    let digits = &number[usize::from(number.starts_with(b"-") || number.starts_with(b"+"))..];
    let point = digits.contains(&b'.');
    let whole_end = digits.iter().position(|b| *b == b'.').unwrap_or(digits.len());
    let whole = &digits[..whole_end];
    let whole = &whole[whole.iter().take_while(|b| **b == b'0').count()..];
    let part = digits.get(whole_end + 1..).unwrap_or_default();
    let part = &part[..part.iter().rposition(|b| *b != b'0').map_or(0, |i| i + 1)];
    if whole.is_empty() && part.is_empty() {
        out.push(b'0');
        return;
    }
    if negative {
        out.push(b'-');
    }
    out.extend_from_slice(if whole.is_empty() { b"0" } else { whole });
    if !part.is_empty() {
        out.push(b'.');
        out.extend_from_slice(part);
    }
    if increments && !point {
        out.push(b'i');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_dialects::builtin;

    fn said(dialect: &str, line: &str, rules: Rules) -> String {
        let settings = Settings::new(builtin(dialect).expect("a built-in dialect"));
        let mut said = Vec::new();
        normal(line.as_bytes(), &settings, &rules, &bare(&settings), &mut said);
        String::from_utf8(said).expect("a text")
    }

    const ALL: Rules = Rules { numbers: true, blanks: true, comments: true, case: true, format: true };

    #[test]
    fn numbers_are_the_dialects_own() {
        let same = |dialect, a, b| said(dialect, a, ALL) == said(dialect, b, ALL);
        assert!(
            same("fanuc", "X1.", "X1.0")
                && same("fanuc", "X1.", "X+1.000")
                && same("fanuc", "G1 X1.", "G01X1.")
        );
        assert!(!same("fanuc", "X100", "X100."), "least increments");
        assert!(same("mach9", "X100", "X100."), "whole units");
        assert!(same("mach9", "G24X0.Y", "G24X0Y0."));
        assert!(!same("fanuc", "X1.5", "X-1.5") && !same("fanuc", "X1.5", "Y1.5"));
        assert!(same("fanuc", "X0", "X-0."));
        assert!(!same("siemens", "CYCLE81(1,2)", "CYCLE82(1,2)"));
        assert!(same("siemens", "CYCLE81(1.0,2)", "cycle81(1, 2.)"));
    }

    #[test]
    fn what_counts_for_nothing() {
        assert_eq!(said("fanuc", "N10 G1 X1. (CUT)", ALL), "G1X1");
        assert_eq!(said("fanuc", "/2 N10 G1", Rules { numbers: true, ..Rules::default() }), "/2 G1");
        assert_eq!(said("fanuc", "N10 G1 (A)", Rules { comments: true, ..Rules::default() }), "N10 G1");
        assert_eq!(said("fanuc", "g1 x1", Rules { case: true, ..Rules::default() }), "G1 X1");
        assert_eq!(said("siemens", "MSG(\"A ; B\") ; C", ALL), "MSG(\"A ; B\")");
        assert_eq!(said("fanuc", "N10 G1  X1.", Rules::default()), "N10 G1  X1.");
        assert_eq!(said("fanuc", "NOTHING", Rules { numbers: true, ..Rules::default() }), "NOTHING");
    }
}
