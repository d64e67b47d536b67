//! `--from auto`: which dialect a text is written in, and why.
//!
//! Every dialect's own dictionary is held against the beginning of the text: what only it can
//! explain speaks for it, what it cannot explain speaks against it. One dialect must fit clearly
//! better than all others, else nothing is chosen: a program read in the wrong dialect would cut
//! another part.
//!
//! ```text
//! `MCALL CYCLE81(…)`    siemens, as no other dialect has the word
//! ```
//!
//! Not here: whether the text is a milling program at all (`ncc_frontends::recognise`).

pub mod better;
pub mod names;
mod sign;

use std::collections::BTreeMap;
use std::io::{self, Read, Seek, SeekFrom};

use ncc_dialects::{Dialect, Family, Meaning, Role};

use crate::problem::{Exit, Problem};
use crate::render::messages::message::Help;
use crate::source::Source;

pub use better::better;
use sign::{Sign, guessed};

/// How much of the text is looked at.
const BEGINNING: u64 = 1 << 16;
/// What an editor may put before a text in UTF-8; the readers pass over it.
const MARK: &[u8] = b"\xEF\xBB\xBF";
/// So many letters without a number, one after the other, are no block in any dialect.
const WORDS_OF_A_TEXT: u32 = 5;

/// What was found out.
#[derive(Debug)]
pub enum Guess {
    /// One dialect, the reasons, and others that explain the text as well: those that build on it.
    Sure(&'static Dialect, Vec<String>, Vec<&'static Dialect>),
    /// None; for every dialect that something speaks for, what speaks against it.
    Unsure(Vec<(&'static Dialect, Vec<String>)>),
}

/// Reasons for or against a dialect, each with the line where it was met first.
#[derive(Debug, Default)]
struct Evidence {
    /// The text says itself what it is.
    conclusive: bool,
    /// Whether a G or M code of the dialect was met.
    codes: bool,
    /// Whether a block with words was met.
    begun: bool,
    /// Whether the end of the program was met.
    ended: bool,
    /// Whether a line of `%` was met.
    marked: bool,
    /// Whether the program's number has other digits than the control writes: a custom alone.
    digits: bool,
    speaks_for: BTreeMap<Sign, usize>,
    against: BTreeMap<Sign, usize>,
}

impl Evidence {
    fn pro(&mut self, line: usize, sign: Sign) {
        self.speaks_for.entry(sign).or_insert(line);
    }

    fn con(&mut self, line: usize, sign: Sign) {
        self.against.entry(sign).or_insert(line);
    }

    /// The first signs in words, with their lines.
    fn list(signs: &BTreeMap<Sign, usize>) -> Vec<String> {
        let mut signs: Vec<_> = signs.iter().map(|(sign, line)| (*line, sign)).collect();
        signs.sort();
        let words = |(line, sign): (usize, &Sign)| {
            guessed("sign").text("sign", sign.words()).text("line", line.to_string()).headline()
        };
        signs.into_iter().take(4).map(words).collect()
    }
}

/// Looks at a source.
///
/// # Errors
/// Reading it.
pub fn guess(
    source: &mut (impl Read + Seek),
    dialects: impl IntoIterator<Item = &'static Dialect>,
) -> io::Result<Guess> {
    source.seek(SeekFrom::Start(0))?;
    let mut text = Vec::new();
    source.take(BEGINNING).read_to_end(&mut text)?;
    if text.len() as u64 == BEGINNING {
        // The last line may be cut.
        text.truncate(text.iter().rposition(|b| *b == b'\n').unwrap_or(0));
    }
    let text = text.strip_prefix(MARK).unwrap_or(&text);
    let found = dialects.into_iter().map(|dialect| (dialect, evidence(dialect, text)));
    Ok(judge(found.collect()))
}

/// A dialect that a source is read as.
#[derive(Debug)]
pub struct Recognised {
    /// It.
    pub dialect: &'static Dialect,
    /// What speaks for it.
    pub reasons: Vec<String>,
    /// Others that explain the text as well: those that build on it.
    pub rivals: Vec<&'static Dialect>,
}

/// The dialect of a source, of those that are known.
///
/// # Errors
/// The dialect is not certain, or the source cannot be read.
pub fn recognise(source: &mut Source, dialects: &[&'static Dialect]) -> Result<Recognised, Problem> {
    let found = guess(&mut source.file, dialects.iter().copied());
    match found.map_err(|e| Problem::file("read", &source.shown, &e))? {
        Guess::Sure(dialect, reasons, rivals) => Ok(Recognised { dialect, reasons, rivals }),
        Guess::Unsure(_) if source.is_blank()? => {
            Err(Problem::of(Exit::Refused, &guessed("empty").text("file", source.shown.as_str()), None))
        }
        Guess::Unsure(_) if source.is_no_text()? => {
            Err(Problem::of(Exit::Refused, &guessed("binary").text("file", source.shown.as_str()), None))
        }
        Guess::Unsure(fits) => {
            let ids: Vec<&str> = dialects.iter().map(|dialect| dialect.id.as_str()).collect();
            let name_it = Help::new("help").text("dialects", ids.join(", "));
            let fits = fits.iter().map(|(dialect, against)| match against.is_empty() {
                true => Help::new("help-fits").text("dialect", dialect.id.as_str()),
                false => Help::new("help-against")
                    .text("dialect", dialect.id.as_str())
                    .text("signs", against.join(", ")),
            });
            let helps = [name_it].into_iter().chain(fits).collect();
            let message = guessed("unsure").text("file", source.shown.as_str());
            Err(Problem::of(Exit::Usage, &message, Some(helps)))
        }
    }
}

fn judge(mut found: Vec<(&'static Dialect, Evidence)>) -> Guess {
    if let Some((dialect, evidence)) = found.iter().find(|(_, evidence)| evidence.conclusive) {
        return Guess::Sure(dialect, Evidence::list(&evidence.speaks_for), Vec::new());
    }
    found.retain(|(_, evidence)| !evidence.speaks_for.is_empty());
    // Where a dialect explains all that one that builds on it explains, it is the plainer reading; one that is part of
    // another leaves the text to that.
    let fits: Vec<(&str, usize)> = found.iter().map(|(d, e)| (d.id.as_str(), e.against.len())).collect();
    let plainer = |d: &Dialect, e: &Evidence| {
        let fits = |other: &String| fits.iter().any(|(id, n)| id == other && *n <= e.against.len());
        [&d.base, &d.part_of].into_iter().flatten().any(fits)
    };
    let (others, rest) = found.into_iter().partition(|(dialect, evidence)| plainer(dialect, evidence));
    let (built_on, mut found): (Vec<(&'static Dialect, Evidence)>, Vec<_>) = (others, rest);
    found.sort_by_key(|(_, e)| (e.against.len(), usize::MAX - e.speaks_for.len()));
    let others = found.get(1).map_or(usize::MAX, |(_, next)| next.against.len());
    let clear = found.first().is_some_and(|(_, best)| match best.against.len() {
        0 => others > 0,
        // One mistake in a program that cannot be anything else.
        1 => others >= 4 && best.speaks_for.len() >= 3,
        _ => false,
    });
    match found.first() {
        Some((dialect, evidence)) if clear => {
            let as_well = |(other, own): &&(&'static Dialect, Evidence)| {
                [&other.base, &other.part_of].into_iter().flatten().any(|near| *near == dialect.id)
                    && own.against.len() - usize::from(own.digits) <= evidence.against.len()
            };
            let rivals = built_on.iter().filter(as_well).map(|(other, _)| *other).collect();
            Guess::Sure(dialect, Evidence::list(&evidence.speaks_for), rivals)
        }
        Some(_) | None => {
            Guess::Unsure(found.into_iter().map(|(d, e)| (d, Evidence::list(&e.against))).collect())
        }
    }
}

fn evidence(dialect: &Dialect, text: &[u8]) -> Evidence {
    let mut evidence = Evidence::default();
    let lines = text.split(|b| *b == b'\n').map(<[u8]>::trim_ascii).enumerate().map(|(i, l)| (i + 1, l));
    let mut frames = 0;
    for (number, line) in lines.filter(|(_, line)| !line.is_empty()) {
        // What follows the end of the frame is no program any more.
        frames += usize::from(!dialect.program.frame.is_empty() && line == dialect.program.frame.as_bytes());
        if frames == 2 {
            break;
        }
        match dialect.family {
            Family::Word => word_line(dialect, number, line, frames > 0, &mut evidence),
            Family::Canon => canon_line(number, line, &mut evidence),
            Family::Sinumerik => names::line(dialect, number, line, &mut evidence),
            Family::Ir => {
                match line.starts_with(b"ncc-ir") {
                    true => {
                        evidence.conclusive = true;
                        evidence.pro(number, Sign::TextForm);
                    }
                    false => evidence.con(number, Sign::OtherForm),
                }
                break;
            }
        }
    }
    evidence
}

/// A line such as `STRAIGHT_FEED(1.0, 2.0, 3.0)`.
fn canon_line(number: usize, line: &[u8], evidence: &mut Evidence) {
    let name = line.iter().take_while(|b| b.is_ascii_uppercase() || **b == b'_').count();
    if name >= 4 && line.get(name) == Some(&b'(') && line.contains(&b')') {
        evidence.pro(number, Sign::CanonicalCalls);
    } else if line[0].is_ascii_alphanumeric() || line[0] == b'%' {
        evidence.con(number, Sign::NoCall);
    }
}

fn word_line(dialect: &Dialect, number: usize, line: &[u8], framed: bool, evidence: &mut Evidence) {
    let frame = dialect.program.frame.as_bytes();
    if line == b"%" {
        let alone = evidence.begun && !std::mem::replace(&mut evidence.marked, true);
        match frame == line {
            false if dialect.program.ignored == "%" => {}
            // Such a control reads from there, if the program has no end of its own.
            true if alone && dialect.program.mark_behind_end && !evidence.ended => {
                evidence.con(number, Sign::MarkAfter);
            }
            true => evidence.pro(number, Sign::Mark),
            false => evidence.con(number, Sign::NoMark),
        }
        return;
    }
    let Some(code) = without_comment(dialect, number, line, evidence) else { return };
    if !code.trim_ascii().is_empty() && !std::mem::replace(&mut evidence.begun, true) {
        first_block(dialect, number, &code, framed, evidence);
    }
    if code.trim_ascii_start().starts_with(b"/") && dialect.block.skip_levels == 0 {
        evidence.con(number, Sign::NoSkip);
    }
    if is_o_word(&code) {
        match dialect.program.o_words {
            true => evidence.pro(number, Sign::FlowWords),
            false => evidence.con(number, Sign::FlowWords),
        }
        return;
    }
    if code.windows(2).any(|two| two == b"#<") {
        match dialect.program.o_words {
            true => evidence.pro(number, Sign::NamedVariable),
            false => evidence.con(number, Sign::NamedVariable),
        }
        return;
    }
    if dialect.program.o_words && code.iter().any(|b| b"#[=".contains(b)) {
        return;
    }
    if dialect.program.macros && code.contains(&b'=') && !code.contains(&b'#') {
        evidence.con(number, Sign::NoVariable);
        return;
    }
    if dialect.program.macros && code.iter().any(|b| b"#[=".contains(b)) {
        return;
    }
    if dialect.program.macros && is_flow(&code) {
        return;
    }
    let mut at = 0;
    let mut alone = 0;
    let (mut centre, mut arc) = (0u8, true);
    while at < code.len() {
        let letter = code[at].to_ascii_uppercase();
        let from = at;
        at += 1;
        if !letter.is_ascii_uppercase() {
            if !b" \t/+-.0123456789%:".contains(&letter) && dialect.block.end.as_bytes() != [letter] {
                let c = char::from(letter);
                evidence.con(number, Sign::Foreign(c));
            }
            continue;
        }
        while code.get(at).is_some_and(|b| b" \t".contains(b)) {
            at += 1;
        }
        let digits = code[at..].iter().take_while(|b| b"+-.0123456789".contains(b)).count();
        let value = std::str::from_utf8(&code[at..at + digits]).unwrap_or("");
        at += digits;
        alone = if digits == 0 { alone + 1 } else { 0 };
        if alone == WORDS_OF_A_TEXT {
            evidence.con(number, Sign::Letters);
        }
        let word = String::from_utf8_lossy(&code[from..at]).into_owned();
        let numbers_program = from == 0 && dialect.program.number == Some(char::from(letter));
        if numbers_program && code[at..].iter().any(u8::is_ascii_alphabetic) {
            evidence.con(number, Sign::WordsAfter(word.trim().to_owned()));
        }
        word_of(dialect, number, letter, value, &word, from == 0, evidence);
        match letter {
            b'I'..=b'K' if digits > 0 => centre |= 1 << (letter - b'I'),
            b'G' => arc &= tenths(value).is_some_and(|code| code <= 30),
            _ => {}
        }
        if calls_a_macro(dialect, letter, value) {
            // Any letter is an argument.
            return;
        }
    }
    // An arc has two centre words in every plane; few controls pass over a third.
    let rules = &dialect.arc;
    if centre == 0b111 && arc && !(rules.centre_outside_zero || rules.centre_outside_ignored) {
        evidence.con(number, Sign::CentreWords);
    }
}

/// The first block of a program, which may begin with its number.
fn first_block(dialect: &Dialect, number: usize, code: &[u8], framed: bool, evidence: &mut Evidence) {
    let first = code.trim_ascii()[0].to_ascii_uppercase();
    let letters = [dialect.program.number, dialect.program.number_also];
    let numbered = letters.iter().flatten().any(|letter| *letter as u32 == u32::from(first));
    match dialect.program.number {
        Some(_) if first == b':' && !numbered => evidence.con(number, Sign::Foreign(':')),
        Some(letter) if numbered && dialect.program.unnumbered_main => {
            evidence.con(number, Sign::NumberedMain(letter));
        }
        Some(letter) if framed && !numbered && !dialect.program.unnumbered_main => {
            evidence.con(number, Sign::NoNumber(letter));
        }
        Some(_) | None => {}
    }
}

fn calls_a_macro(dialect: &Dialect, letter: u8, value: &str) -> bool {
    let row = tenths(value).and_then(|tenths| dialect.code_row(letter, tenths));
    letter == b'G' && row.is_some_and(|row| row.means.is_some_and(Meaning::calls_macro))
}

fn word_of(
    dialect: &Dialect,
    line: usize,
    letter: u8,
    value: &str,
    word: &str,
    first: bool,
    evidence: &mut Evidence,
) {
    let c = char::from(letter);
    if value.is_empty() {
        match dialect.block.omitted_zero {
            true => evidence.pro(line, Sign::LetterIsZero),
            false => evidence.con(line, Sign::WithoutNumber(c)),
        }
    }
    if dialect.block.number == Some(c) {
        return;
    }
    if dialect.program.number == Some(c) {
        match first {
            true => program_number(dialect, line, word, value, evidence),
            false => evidence.con(line, Sign::InBlock(word.to_owned())),
        }
        return;
    }
    if matches!(letter, b'G' | b'M') {
        let Some(tenths) = tenths(value) else { return };
        match dialect.code_row(letter, tenths).map(|row| row.means) {
            None => evidence.con(line, Sign::UnknownCode(word.to_owned())),
            Some(_) if dialect.code_row(letter, tenths).is_some_and(|row| row.other_machine) => {
                evidence.con(line, Sign::OtherMachine(word.to_owned()));
            }
            Some(Some(Meaning::UseLengthUnits(_))) => evidence.pro(line, Sign::UnitCode(word.to_owned())),
            Some(Some(meaning)) => {
                evidence.ended |= meaning == Meaning::ProgramEnd;
                if !std::mem::replace(&mut evidence.codes, true) {
                    evidence.pro(line, Sign::Code(word.to_owned()));
                }
            }
            Some(None) => {}
        }
        return;
    }
    match dialect.address_row(letter).map(|row| row.role) {
        None => evidence.con(line, Sign::NoAddress(c)),
        Some(Role::Corrector) if first || value.is_empty() => {}
        Some(Role::Corrector) => evidence.pro(line, Sign::LengthWord(word.to_owned())),
        Some(_) => {}
    }
}

/// A program's number: written with leading zeros, it shows how many digits the control gives it.
fn program_number(dialect: &Dialect, line: usize, word: &str, value: &str, evidence: &mut Evidence) {
    let letter = word.chars().next().unwrap_or(' ').to_ascii_uppercase();
    evidence.pro(line, Sign::ProgramNumber(letter));
    let digits = value.len();
    if value.starts_with('0') && digits != dialect.program.number_digits {
        evidence.digits = true;
        evidence.con(line, Sign::Digits(word.to_owned(), digits));
    }
}

/// The line without its comment, and nothing if it cannot be separated.
fn without_comment(
    dialect: &Dialect,
    number: usize,
    line: &[u8],
    evidence: &mut Evidence,
) -> Option<Vec<u8>> {
    let (open, close) = (dialect.comment.open.as_bytes(), dialect.comment.close.as_bytes());
    let mut code = Vec::new();
    let mut at = 0;
    while at < line.len() {
        let rest = &line[at..];
        if !open.is_empty() && rest.starts_with(open) {
            evidence.pro(number, Sign::Comment(dialect.comment.open.clone()));
            match rest.iter().position(|b| close.first() == Some(b)) {
                Some(end) => at += end + close.len(),
                None => break,
            }
            continue;
        }
        if rest[0] == b'(' {
            evidence.con(number, Sign::Foreign('('));
            return None;
        }
        if dialect.comment.line.as_bytes() == &rest[..1] {
            break;
        }
        if rest[0] == b';' {
            if dialect.block.end != ";" || rest.iter().any(|b| !b"; ".contains(b)) {
                evidence.con(number, Sign::CommentText);
            }
            break;
        }
        code.push(rest[0]);
        at += 1;
    }
    Some(code)
}

/// The number of a code in tenths: `5.1` is 51; a letter alone is 0.
fn tenths(value: &str) -> Option<u32> {
    let (whole, tenth) = value.split_once('.').unwrap_or((value, ""));
    let number = |digits: &str| if digits.is_empty() { Some(0) } else { digits.parse::<u32>().ok() };
    number(whole)?.checked_mul(10)?.checked_add(number(tenth).filter(|t| *t < 10)?)
}

/// Whether a line says by an O word where the program goes: `O100 while [...]`, `o<pocket> call [1]`.
fn is_o_word(code: &[u8]) -> bool {
    let code = code.trim_ascii().to_ascii_lowercase();
    let Some(rest) = code.strip_prefix(b"o") else { return false };
    let rest = rest.trim_ascii_start();
    let name = match rest.first() {
        Some(b'<') => rest.iter().position(|b| *b == b'>').map_or(0, |end| end + 1),
        _ => rest.iter().take_while(|b| b.is_ascii_digit()).count(),
    };
    let rest = rest[name..].trim_ascii_start();
    let word = rest.iter().take_while(|b| b.is_ascii_alphabetic()).count();
    const WORDS: [&[u8]; 15] = [
        b"sub",
        b"endsub",
        b"call",
        b"return",
        b"if",
        b"elseif",
        b"else",
        b"endif",
        b"while",
        b"endwhile",
        b"do",
        b"repeat",
        b"endrepeat",
        b"break",
        b"continue",
    ];
    name > 0 && WORDS.contains(&&rest[..word])
}

/// Whether a line without variables is one of a macro language: a jump, or where a loop begins or ends.
fn is_flow(code: &[u8]) -> bool {
    let code = code.trim_ascii().to_ascii_uppercase();
    let code = match code.strip_prefix(b"N") {
        Some(rest) => {
            let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
            rest[digits..].trim_ascii_start()
        }
        None => &code[..],
    };
    [&b"GOTO"[..], b"END", b"DO"].iter().any(|word| {
        code.strip_prefix(*word).is_some_and(|rest| rest.trim_ascii().first().is_some_and(u8::is_ascii_digit))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    fn id(text: &str) -> Option<&'static str> {
        match guess(&mut Cursor::new(text.as_bytes()), ncc_dialects::builtins()).unwrap() {
            Guess::Sure(dialect, reasons, _) => {
                assert!(!reasons.is_empty());
                Some(&dialect.id)
            }
            Guess::Unsure(_) => None,
        }
    }

    #[test]
    fn each_is_recognised() {
        assert_eq!(id("%\nO1 (A)\nG21 G90\nG0 X1. (B)\nM30\n%\n"), Some("fanuc"));
        // As an editor saves it that marks texts in UTF-8.
        assert_eq!(id("\u{feff}%\nO1 (A)\nG21 G90\nG0 X1. (B)\nM30\n%\n"), Some("fanuc"));
        assert_eq!(id("\u{feff};A\nG71\nT1M6\nO1S500M3\nGZ0\nM2\n"), Some("mach9"));
        assert_eq!(id("%\n(A)\nG21 G90\nG0 X1. (B)\nM2\n%\n"), Some("linuxcnc"));
        assert_eq!(id(";A\nG71\nT1M6\nO1S500M3\nGZ0\nM2\n"), Some("mach9"));
        assert_eq!(id("STRAIGHT_FEED(1.0, 2.0, 3.0)\nPROGRAM_END()\n"), Some("canon"));
        assert_eq!(id("ncc-ir 1\n"), Some("ir"));
        let flange = ";FLANGE\nG710 G17 G90\nT1 D1\nMCALL CYCLE81(3,3,0,-6)\nX=R1+5\nM30\n";
        assert_eq!(id(flange), Some("siemens"));
        assert_eq!(id("%_N_PART_MPF\nG0 X1\nM30\n"), Some("siemens"));
    }

    #[test]
    fn what_fits_several_is_not_chosen() {
        for text in ["", "\n\n", "G0 X1.\nM30\n", "hello world\n", "\0\0\0\0", "X1 Y2\n"] {
            assert_eq!(id(text), None, "{text:?}");
        }
    }
}
