//! How far the frame of a text has been read, and the names of its programs.
//!
//! Not here: the lines that frame it (`framing`).

use std::collections::HashSet;

use ncc_dialects::Dialect;
use ncc_ir::program::Text;
use ncc_ir::source::Span;

/// Longest name of a program.
const LONGEST_NAME: usize = 32;

/// What a program is called by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::word) enum Called {
    Number(u32),
    Name(Text),
}

impl Called {
    /// What a name in brackets calls: `<O12>` is a number; `None` is no name.
    pub(in crate::word) fn parse(bracketed: &[u8]) -> Option<Called> {
        let name = std::str::from_utf8(bracketed).ok()?.strip_prefix('<')?.strip_suffix('>')?;
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        if let Some(number) = name.strip_prefix('O').filter(|rest| digits(rest)) {
            return number.parse().ok().filter(|number| *number > 0).map(Called::Number);
        }
        let fits = |b: u8| b.is_ascii_alphanumeric() || b"+-_.".contains(&b);
        let is_name = (1..=LONGEST_NAME).contains(&name.len()) && name.bytes().all(fits);
        // A name of digits alone would be another program than that number's.
        (is_name && !digits(name)).then(|| Called::Name(name.into()))
    }

    /// The name by which statements call it.
    pub(in crate::word) fn text(&self) -> Text {
        match self {
            Called::Number(number) => number.to_string().into(),
            Called::Name(name) => name.clone(),
        }
    }
}

/// How far the frame of the text is.
#[derive(Debug)]
pub(in crate::word) struct Frame {
    /// Line that stands before and after the program; empty for none.
    pub(in crate::word) mark: &'static str,
    /// Line that counts for nothing; empty for none.
    pub(in crate::word) ignored: &'static str,
    /// Letter of the program number and the sign that may stand for it; 0 for none.
    pub(in crate::word) number: [u8; 2],
    pub(in crate::word) title: bool,
    /// Whether programs may have names.
    pub(in crate::word) named: bool,
    /// Whether the main program may have number 0, which is none.
    pub(in crate::word) zero: bool,
    /// Whether text before the mark is skipped.
    pub(in crate::word) leader: bool,
    /// Whether a mark after the end needs none before the program.
    pub(in crate::word) mark_behind_end: bool,
    /// Whether the mark that opens the text has been met.
    pub(in crate::word) opened: bool,
    /// A mark with blocks before it that no mark opens; blocks after it are those that a control would execute.
    pub(in crate::word) first_mark: Option<Span>,
    /// Nothing is read any more: the closing mark has been met.
    pub(in crate::word) closed: bool,
    /// Whether any block with words has been met.
    pub(in crate::word) blocks: bool,
    /// Whether anything was refused.
    pub(in crate::word) faulty: bool,
    /// Whether text after the end was reported.
    pub(in crate::word) after_end: bool,
    /// Not a text; nothing is read any more.
    pub(in crate::word) is_binary: bool,
    pub(in crate::word) control_signs: u32,
    /// Numbers and names of the programs met.
    pub(in crate::word) programs: HashSet<Text>,
    /// The same, in small letters.
    pub(in crate::word) lower_case: HashSet<String>,
    /// End of what has been read.
    pub(in crate::word) end: u32,
}

impl Frame {
    pub(in crate::word) fn new(dialect: &'static Dialect) -> Frame {
        let program = &dialect.program;
        let sign = |c: Option<char>| c.map_or(0, |c| c as u8);
        Frame {
            mark: &program.frame,
            ignored: &program.ignored,
            number: [sign(program.number), sign(program.number_also)],
            title: program.title,
            named: program.names,
            zero: program.zero_unnumbered,
            leader: program.leader,
            mark_behind_end: program.mark_behind_end,
            opened: false,
            first_mark: None,
            closed: false,
            blocks: false,
            faulty: false,
            after_end: false,
            is_binary: false,
            control_signs: 0,
            programs: HashSet::new(),
            lower_case: HashSet::new(),
            end: 0,
        }
    }
}

impl Frame {
    /// Whether the control skips text before the mark.
    pub(in crate::word) fn has_leader(&self) -> bool {
        self.leader
    }

    /// Numbers and names of the programs met.
    pub(in crate::word) fn programs(&self) -> &HashSet<Text> {
        &self.programs
    }
}
