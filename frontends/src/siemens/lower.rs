//! Lowering of a block: from its words or its tree to statements.
//!
//! What a code or name means comes from the dictionary alone. A block with a fault gives
//! diagnostics and no statements; what it says of modes still counts, so that one slip is not
//! reported again at every block after it.
//!
//! Refused, wherever it stands: synchronised actions, macros, calls by path.
//!
//! Not here: which word is what (`sort`), what is computed (`computing`), the program's flow (`flow`), and what
//! the functions, moves, frames, cycles, patterns and calls of a block mean; they have files of their own beside
//! this one.

mod fast_block;
mod fast_lower;

use std::collections::HashSet;

use ncc_dialects::{NameMeaning, Settings};
use ncc_ir::canon::{Plane, Units};
use ncc_ir::diag::Fault;
use ncc_ir::program::{Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{CodeUnsupported, Unsupported, ValueUnsupported};

use super::block_words::{UsualBlocks, Words};
use super::program::repeated_blocks::RepeatedBlocks;
use super::siemens_state::{ModalCall, Motion, SiemensState, Stand};
use super::text::tree::{Block, BlockNumber, Called, Item, Statement};
use super::text::unit::Kind;
use super::text_facts::Surfaces;
use super::values::typed::Typed;
use crate::batch::{Batch, refused};
use crate::common::Source;
use crate::common::fast_lower::FastLower;
use crate::common::only_value::OnlyValue;
use crate::common::saved::Saved;
use crate::common::switched::Met;
use crate::common::text::decode;
use crate::initial_modes::Inherited;
use crate::siemens::program::handed::Handed;
use crate::siemens::program::open_structures::{Closes, Flow};
use crate::siemens::values::variables::Variables;

/// Lowers the blocks of one text, one after the other.
#[derive(Debug)]
pub(super) struct Lower {
    pub(super) settings: Settings,
    /// Whether what the program never says is assumed and reported.
    pub(super) assume: bool,
    /// What subprograms find active.
    pub(super) inherited: Inherited,
    /// Whether the program is another's that is not in the text, and returns to it.
    pub(super) called: bool,
    /// Whether refused blocks are noted.
    pub(super) watch: bool,
    /// Whether what is assumed of the control is reported: its modes are by `assume` alone.
    pub(super) reports: bool,
    pub(super) state: SiemensState,
    pub(super) only_units: OnlyValue<Units>,
    pub(super) only_scaled: OnlyValue<bool>,
    pub(super) only_plane: OnlyValue<Plane>,
    pub(super) repeated_blocks: RepeatedBlocks,
    /// Tool position, as far as words have said it.
    pub(super) stand: Stand,
    /// What the statements have activated last, as a subprogram's position would find it.
    pub(super) moved: Option<Motion>,
    /// Whether no move has followed the code of the active motion.
    pub(super) motion_without_move: bool,
    /// Whether a cycle was activated where the active motion is not known: it is not known after
    /// it either.
    pub(super) cycled: bool,
    /// Whether the active cycle must be activated again, because a feed was stated since.
    pub(super) recall: bool,
    /// Whether the active modal tap has activated its own speed and made no hole yet: until it does,
    /// the control has the speed that was stated before.
    pub(super) idle_tap: bool,
    /// Whether control has gone elsewhere, or a switch has left in doubt, where a motion at feed was active.
    pub(super) feed_away: bool,
    /// Where a position was first taken for rapid that such a motion may reach.
    pub(super) rapid_taken: Option<Span>,
    /// The radius by which every corner is rounded.
    pub(super) rounding: Option<ncc_ir::expr::num::Num>,
    pub(super) surfaces: Surfaces,
    /// Rows, options and patterns that have been reported.
    pub(super) reported: HashSet<Box<str>>,
    /// The subprogram that is being read; `None` in the main program.
    pub(super) sub: Option<Procedure>,
    /// What `MCALL` had activated where the subprogram was called.
    pub(super) entry: ModalCall,
    /// What the text that begins is, as far as its header, its heading, or its file's name states it.
    pub(super) unit: Option<Kind>,
    /// Where the text first moves at a feed that it has not stated: that of its caller, if it is a subprogram.
    pub(super) callers_feed: Option<Span>,
    /// Whether the program that is being read has ended.
    pub(super) ended: bool,
    /// What plain moves need; `None` if a block must be looked at.
    pub(super) fast_lower: Option<FastLower>,
    usual: UsualBlocks,
    pub(super) now: Now,
    words: Words,
    stretch: Option<Stretch>,
    pub(super) variables: Variables,
    /// What is computed in the words of the block.
    pub(super) exprs: Vec<Typed>,
    pub(super) flow: Flow,
    pub(super) handed: Handed,
    /// Whether the value of a work offset was set that may be active, and none has been activated since.
    pub(super) stale: bool,
    /// Value of a computed number of a table's entry, where a statement is read for each of them.
    pub(super) worth: Option<u32>,
    /// Such statements.
    pub(super) saved: Saved,
    /// Whether a block has been read that is executed and defines nothing.
    pub(super) executed: bool,
    /// What the text has said of swivelled planes.
    pub(super) tilt: Met,
}

/// Blocks one after another that one switch skips: within them, what they say counts.
#[derive(Debug)]
struct Stretch {
    level: u8,
    /// What was active before the first of them.
    before: SiemensState,
    moved: Option<Motion>,
    /// What is active if they are not skipped.
    inside: SiemensState,
    moved_inside: Option<Motion>,
}

/// State of the block that is being lowered.
#[derive(Debug, Default)]
pub(super) struct Now {
    number: Option<u32>,
    skip: Option<u8>,
    pub(super) pushed: bool,
    /// Whether something was refused.
    pub(super) failed: bool,
    /// Whether a word was refused, so that it is not known what the others belong to.
    pub(super) refused: bool,
    pub(super) m_codes: u8,
    /// A block that is a heading, and no statement.
    pub(super) heading: bool,
    /// All of the block.
    pub(super) span: Span,
    /// Length of the target before the block.
    pub(super) mark: usize,
    /// Variables that the block sets.
    pub(super) set: Vec<Box<str>>,
    /// Whether its comment stands elsewhere already.
    comment_taken: bool,
}

/// What a block has besides its words.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Head {
    skip: Option<(u8, Span)>,
    number: Option<u32>,
    label: Option<Span>,
    comment: Option<Span>,
    pub(super) span: Span,
}

impl Head {
    fn from_block(block: &Block) -> Head {
        let number = block.number.map(|BlockNumber { value, .. }| value);
        let Block { skip, label, comment, span, .. } = *block;
        Head { skip, number, label, comment, span }
    }
}

impl Lower {
    pub(super) fn new(settings: Settings, assume: bool) -> Lower {
        let usual = UsualBlocks::new(&settings);
        Lower {
            settings,
            assume,
            called: false,
            inherited: Inherited::default(),
            watch: false,
            reports: assume,
            state: SiemensState::default(),
            only_units: OnlyValue::default(),
            only_scaled: OnlyValue::default(),
            only_plane: OnlyValue::default(),
            repeated_blocks: RepeatedBlocks::default(),
            stand: Stand::default(),
            moved: None,
            motion_without_move: false,
            cycled: false,
            recall: false,
            idle_tap: false,
            feed_away: false,
            rapid_taken: None,
            reported: HashSet::new(),
            sub: None,
            entry: ModalCall::None,
            unit: None,
            callers_feed: None,
            ended: false,
            fast_lower: None,
            usual,
            now: Now::default(),
            words: Words::default(),
            stretch: None,
            variables: Variables::default(),
            exprs: Vec::new(),
            flow: Flow::default(),
            handed: Handed::default(),
            stale: false,
            worth: None,
            saved: Saved::default(),
            executed: false,
            tilt: Met::default(),
            rounding: None,
            surfaces: Surfaces::default(),
        }
    }

    /// Lowers a block that the grammar has read.
    pub(super) fn block(&mut self, block: &Block, src: Source, out: &mut Batch) {
        let head = Head::from_block(block);
        let before = self.enter_stretch(&head, out);
        self.begin(&head, src, out);
        self.statement(&block.statement, &head, src, out);
        if before.as_ref().is_some_and(|(before, _)| before.modes.motion != self.state.modes.motion) {
            self.leave_motion(head.span, out);
        }
        self.close(&head, src, out);
        self.leave_stretch(before, &head, out);
        if head.label.is_some() {
            self.repeated_blocks.label_over(&self.state);
        }
        let definition = matches!(
            block.statement,
            Statement::Declare(_) | Statement::Procedure { .. } | Statement::Extern { .. }
        );
        self.executed |= !definition && !says_nothing(&block.statement);
        self.refresh();
    }

    /// What was active before a block that may be skipped, or before the first of several that are
    /// skipped together.
    fn enter_stretch(&mut self, head: &Head, out: &mut Batch) -> Option<(SiemensState, Option<Motion>)> {
        let stretch = self.stretch.take();
        let (level, _) = head.skip?;
        match stretch {
            Some(stretch) if stretch.level == level => {
                self.state = stretch.inside;
                self.moved = stretch.moved_inside;
                Some((stretch.before, stretch.moved))
            }
            _ => {
                // What a block in it says in its place is not active where that is skipped.
                self.leave_motion_before(head.span, out);
                Some((self.state.clone(), self.moved))
            }
        }
    }

    /// What is active after a block that may be skipped; `before` is what was active before the first of those that
    /// are skipped together.
    fn leave_stretch(
        &mut self,
        before: Option<(SiemensState, Option<Motion>)>,
        head: &Head,
        out: &mut Batch,
    ) {
        let (Some((before, moved)), Some((level, _))) = (before, head.skip) else { return };
        let (inside, moved_inside) = (self.state.clone(), self.moved);
        self.state.join(&before);
        if self.state.modes.motion.value().is_none() {
            self.motion_goes_on(&[before.modes.motion, inside.modes.motion], out);
        }
        self.stand.forget();
        if self.moved != moved {
            self.moved = None;
        }
        self.stretch = Some(Stretch { level, before, moved, inside, moved_inside });
    }

    fn begin(&mut self, head: &Head, src: Source, out: &mut Batch) {
        let level = head.skip.map(|(level, _)| skip_level(level));
        self.exprs.clear();
        self.now = Now {
            number: head.number,
            skip: level,
            mark: self.target(out).len(),
            span: head.span,
            ..Now::default()
        };
        if let (Some(level), Some((written, at))) = (level, head.skip)
            && level > self.settings.dialect.block.skip_levels
        {
            let code = format!("/{written}").into();
            self.fault(Fault::NotSupported { code, what: CodeUnsupported::SkipLevel.into() }, at, out);
        }
        if head.label.is_none() && self.has_targets() {
            self.arrive(None, head.number, head.span, src, out);
        }
        if let Some(label) = head.label {
            let mut name: Text = src.text(label).to_ascii_uppercase().into();
            let row = self.settings.dialect.name_row(&name);
            let end = row.is_some_and(|row| row.means == Some(NameMeaning::EndOfRepeat));
            if end {
                name = self.repeated_blocks.end_name();
            } else if let Some(row) = row {
                let refuse =
                    row.refuse.as_deref().map_or(ValueUnsupported::ReservedLabel.into(), Unsupported::named);
                self.not_supported(&name, refuse, label, out);
            }
            self.arrive(Some(&name), head.number, label, src, out);
            self.repeated_blocks.label(name.clone(), &self.state);
            if end {
                self.repeated_blocks.is_end();
            }
            out.whole = true;
            self.push(label, Op::Label(name), out);
        }
    }

    fn statement(&mut self, statement: &Statement, head: &Head, src: Source, out: &mut Batch) {
        match statement {
            Statement::Words { items, jumps } => {
                if !items.is_empty() || jumps.is_empty() {
                    self.items(items, head, src, out);
                }
                if !self.now.refused {
                    self.jumps(jumps, src, out);
                }
            }
            Statement::RepeatSection { first, last, count } => {
                self.repeat(*first, *last, count.as_ref(), head, src, out);
            }
            Statement::CallModal(called) => self.call_modal(called.as_ref(), head, src, out),
            Statement::Call { file: Some(name), section: None } => {
                self.call_by_text(name, head, src, out);
            }
            Statement::Procedure { name, parameters, attributes } => {
                self.procedure(*name, parameters, attributes, src, out);
            }
            Statement::Extern { .. } => self.now.heading = true,
            Statement::RepeatBlock { label, count } => {
                self.repeat(*label, Some(*label), count.as_ref(), head, src, out);
            }
            Statement::Call { .. } | Statement::CallByPath { .. } => {
                let word = if matches!(statement, Statement::CallByPath { .. }) { "PCALL" } else { "CALL" };
                self.refuse_word(word, head.span, out);
            }
            Statement::CallExternal(file) => self.call_external(file, head, src, out),
            Statement::CallIso(_) => self.refuse_word("ISOCALL", head.span, out),
            Statement::Synchronous(_) => {
                let code = src.text(head.span);
                self.not_supported(&code, CodeUnsupported::SynchronisedAction, head.span, out);
            }
            Statement::If(condition) => self.begin_if(condition, head, src, out),
            Statement::Else => self.otherwise(head, src, out),
            Statement::EndIf => self.close_structure(Closes::If, None, head, src, out),
            Statement::Loop => self.begin_loop(head, src, out),
            Statement::EndLoop => self.close_structure(Closes::Loop, None, head, src, out),
            Statement::For { counter, from, to } => self.begin_for(counter, from, to, head, src, out),
            Statement::EndFor => self.close_structure(Closes::For, None, head, src, out),
            Statement::While(condition) => self.begin_while(condition, head, src, out),
            Statement::EndWhile => self.close_structure(Closes::While, None, head, src, out),
            Statement::Repeat => self.begin_repeat(head, src, out),
            Statement::Until(condition) => {
                self.close_structure(Closes::Until, Some(condition), head, src, out);
            }
            Statement::Case { value, branches, default } => {
                self.case(value, branches, default.as_ref(), head.span, src, out);
            }
            Statement::Declare(definition) => self.define(definition, head.span, src, out),
            Statement::Define { .. } => self.not_supported("DEFINE", CodeUnsupported::Macro, head.span, out),
            Statement::Redefine(_) => {
                self.not_supported("REDEF", CodeUnsupported::DefinedAnew, head.span, out)
            }
        }
    }

    /// Words, assignments and calls of a block.
    fn items(&mut self, items: &[Item], head: &Head, src: Source, out: &mut Batch) {
        if self.standalone_item(items, head, src, out) {
            return;
        }
        let mut words = std::mem::take(&mut self.words);
        words.clear();
        self.sort_items(items, &mut words, src, out);
        self.no_word_reads_what_is_set(src, out);
        self.words(&mut words, head, src, out);
        self.words = words;
    }

    /// Items that stand alone in their block: calls by name or number, cycles, patterns, messages.
    /// `false` if the block has none.
    fn standalone_item(&mut self, items: &[Item], head: &Head, src: Source, out: &mut Batch) -> bool {
        let is_call = |item: &Item| match item {
            Item::Word(word) => word.letter == b'L',
            Item::Set { .. } => false,
            Item::Name(called) => self.is_call(called, src),
        };
        let Some(at) = items.iter().position(is_call) else {
            return false;
        };
        let (before, rest) = items.split_at(at);
        let Some((item, after)) = rest.split_first() else {
            return false;
        };
        // A slip of the pen is reported as one, and not as a call.
        if let Some(letter) = crate::siemens::text::letters::letter_for_zero(src, head.span) {
            self.fault(Fault::LetterOForZero, letter, out);
            return true;
        }
        match item {
            Item::Word(word) => self.call_number(word.span, before, after, src, out),
            Item::Name(called) => self.call_name(called, before, after, head, src, out),
            Item::Set { .. } => return false,
        }
        true
    }

    /// Whether a name calls something: whatever the dictionary has no other use for.
    fn is_call(&self, called: &Called, src: Source) -> bool {
        let name = src.text(called.name).to_ascii_uppercase();
        match self.settings.dialect.name_row(&name) {
            Some(row) if row.means == Some(NameMeaning::Message) => true,
            Some(_) if name == "SETAL" => true,
            Some(_) => called.arguments.is_some() && self.is_word_with_arguments(&name),
            None => true,
        }
    }

    /// A word of the language that the dictionary refuses.
    pub(super) fn refuse_word(&mut self, word: &str, at: Span, out: &mut Batch) {
        let row = self.settings.dialect.name_row(word);
        let what = row.and_then(|row| row.refuse.as_deref());
        let what = what.map_or(ValueUnsupported::Call.into(), Unsupported::named);
        self.not_supported(word, what, at, out);
    }

    /// Where statements go.
    #[inline]
    pub(super) fn target<'o>(&'o mut self, out: &'o mut Batch) -> &'o mut Vec<Stmt> {
        out.body(&mut self.sub)
    }

    /// Adds a statement to the block.
    pub(super) fn push(&mut self, span: Span, op: Op, out: &mut Batch) {
        self.check_rounding(&op, span, out);
        let number = if self.now.pushed { None } else { self.now.number };
        let joined = std::mem::replace(&mut self.now.pushed, true);
        let skip = self.now.skip;
        self.target(out).push(Stmt { span, number, skip, joined, comment: None, op });
    }

    /// From here on, statements stand in a block of their own.
    pub(super) fn apart(&mut self) {
        self.now.pushed = false;
        self.now.number = None;
    }

    /// The block's number, for a statement that stands elsewhere.
    pub(super) fn take_number(&mut self) -> Option<u32> {
        self.now.number.take().filter(|_| !self.now.pushed)
    }

    /// Whether a switch may skip the block.
    pub(super) fn skipped(&self) -> bool {
        self.now.skip.is_some()
    }

    /// Reports something that refuses the block.
    pub(super) fn fault(&mut self, fault: Fault, span: Span, out: &mut Batch) {
        self.now.failed = true;
        out.report(fault, span);
    }

    /// The same, for a value that is then missing.
    pub(super) fn refuse<T>(&mut self, fault: Fault, span: Span, out: &mut Batch) -> Option<T> {
        self.fault(fault, span, out);
        None
    }

    /// Refuses by name what the dictionary or the language names.
    pub(super) fn not_supported(
        &mut self,
        code: &str,
        what: impl Into<Unsupported>,
        span: Span,
        out: &mut Batch,
    ) {
        self.now.refused = true;
        self.fault(Fault::not_supported(code, what), span, out);
    }

    /// Whether something is met for the first time by the reports.
    pub(super) fn first_time(&mut self, name: &str) -> bool {
        self.reports && self.reported.insert(name.into())
    }

    /// Ends the block: its comment, or what stands for an empty one.
    fn close(&mut self, head: &Head, src: Source, out: &mut Batch) {
        if self.now.failed {
            let mark = self.now.mark;
            self.target(out).truncate(mark);
            if self.watch {
                self.target(out).push(refused(head.span));
            }
            return self.forgive();
        }
        let comment = self.take_comment(head, src).map(|text| *text);
        match (comment, self.now.pushed) {
            (None, true) => {}
            (None, false) if self.now.heading => {}
            (None, false) => self.push(head.span, Op::Blank, out),
            (Some(text), false) => self.push(head.span, Op::Comment(text), out),
            (Some(text), true) => {
                if let Some(stmt) = self.target(out).last_mut() {
                    stmt.comment = Some(Box::new(text));
                }
            }
        }
    }

    /// The block's comment, if it does not stand elsewhere already.
    pub(super) fn take_comment(&mut self, head: &Head, src: Source) -> Option<Box<Text>> {
        if std::mem::replace(&mut self.now.comment_taken, true) {
            return None;
        }
        head.comment.map(|comment| self.text_of_comment(src.bytes(comment)))
    }

    fn text_of_comment(&self, text: &[u8]) -> Box<Text> {
        // The blank that is written between mark and text is no part of the text.
        let mark = self.settings.dialect.comment.open.as_bytes();
        let between = mark.get(1..).unwrap_or_default();
        Box::new(decode(text.strip_prefix(between).unwrap_or(text)))
    }

    /// After a refused block, what it may have said is not asked for again.
    pub(super) fn forgive(&mut self) {
        self.state.modes.forgive();
        self.stand.forget();
        self.moved = None;
    }
}

/// The level of a skip mark, as it is written: the plain slash is level 0, the first level of both makes.
fn skip_level(written: u8) -> u8 {
    match written {
        0 => 1,
        1 => 10,
        level => level,
    }
}

/// Whether a statement has no words.
fn says_nothing(statement: &Statement) -> bool {
    matches!(statement, Statement::Words { items, jumps } if items.is_empty() && jumps.is_empty())
}
