//! The back-end of the Sinumerik's own language.
//!
//! Blocks of letters and numbers are written as in every other dialect, by a writer of words within; this room
//! has what is stated in another form: cycles and patterns called with arguments, frames, arcs by
//! name, edges of tools, messages, labels and units. Codes, names and the order of arguments come
//! from the dictionary. What it lacks is a fault at the statement, never silent.
//!
//! ```text
//! a cycle of drilling    `MCALL CYCLE81(3,3,0,-6)`
//! ```
//!
//! Not here: expanding what the control cannot say (passes), and judging the result (verification).

mod computed_entry;
mod computing;
mod cycle;
mod data;
mod edge_left;
mod frame;
mod motion;
mod names;
mod pattern;
mod plain;
mod polar;
mod spindle;
mod statement;
mod tilt;
mod tool;
mod unit;
mod variable;

use std::collections::BTreeSet;

use ncc_dialects::{CallRow, Dialect, Meaning, NameRole, Quantity, Settings};
use ncc_ir::canon::{Modes, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::lack::{FeedsLack, ModesLack};
use ncc_ir::program::{Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;

use computing::Computing;
use names::Names;
use variable::Variables;

use crate::Layout;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Letter;
use crate::common::fault::{cannot, unwritable};
use crate::common::number::{Format, Shaped};
use crate::common::packed::{each_blocks, packed};
use crate::common::table::WritesBlocks;
use crate::common::words::Words;
use crate::common::{Sink, number};

/// Whether the text has an active cycle for the blocks that follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Modal {
    Off,
    On,
    /// On one way, or as the caller has it.
    Doubtful,
}

/// What is active in the text besides codes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Standing {
    modal: Modal,
    /// The feed that the program has active, if it is known.
    feed: Option<Num>,
    /// The speed of the spindle, if it is known.
    speed: Option<Num>,
    /// Whether the text has the active same; a boring cycle leaves none that is known.
    feed_said: bool,
    /// Whether a tool change has made an edge active that the program did not ask for.
    edge_waits: bool,
    /// Whether that change is one of a subprogram, after which the active length is not the one of the start.
    edge_of_call: bool,
    /// The block-skip level of that change, where no other one waits: a length of the same level answers it.
    edge_level: Option<u8>,
}

impl Standing {
    const START: Standing = Standing {
        modal: Modal::Off,
        feed: None,
        speed: None,
        feed_said: true,
        edge_waits: false,
        edge_of_call: false,
        edge_level: None,
    };

    /// What holds if the block between `before` and now may have been skipped.
    fn join(&mut self, before: Standing) {
        if self.modal != before.modal {
            self.modal = Modal::Doubtful;
        }
        if self.feed != before.feed {
            self.feed = None;
        }
        if self.speed != before.speed {
            self.speed = None;
        }
        self.feed_said &= before.feed_said;
        self.edge_waits |= before.edge_waits;
        self.edge_of_call |= before.edge_of_call;
    }
}

/// Writes a program in the Sinumerik's language.
#[derive(Clone, Debug)]
pub struct Writer {
    pub(crate) words: Words,
    dialect: &'static Dialect,
    /// Whether a tool change makes edge 1 active.
    edge_with_tool: bool,
    /// Subprograms that may return with that edge active.
    leave_edge: BTreeSet<Text>,
    /// The machine keeps its own lengths in inches.
    inch_machine: bool,
    standing: Standing,
    /// A cycle that the program has active and the text has not, because it was called once for a
    /// hole where the tool stood.
    owed: Option<String>,
    /// Whether a cycle has been called in this unit.
    cycled: bool,
    /// Whether the next straight move is in machine coordinates.
    raw: bool,
    /// Whether a work offset has new values that may be active, and has not been activated since.
    stale: bool,
    /// Whether inches have been stated.
    inches: bool,
    /// Whether the feed counts in the machine's basic system, and which that is.
    basic_feed: bool,
    basic_units: Units,
    /// The name of an arc's radius, with the sign before its number, and the form of that.
    radius: Option<(String, Format)>,
    names: Names,
    /// Subprograms that are called while a cycle is active.
    under_cycle: BTreeSet<Box<str>>,
    /// Labels made for repetitions.
    repeats: u32,
    /// Whether the program returns to one that is not in the text.
    alone: bool,
    /// Whether a subprogram has been written, so that every unit needs its header.
    units: bool,
    computing: Computing,
    variables: Variables,
    /// The main procedure of a program that computes, until it is written.
    main: Option<Procedure>,
    /// Calls whose rows nobody confirms, as far as told.
    reported: BTreeSet<&'static str>,
}

impl Writer {
    /// A writer at the start of a program.
    pub fn new(settings: Settings, layout: Layout) -> Writer {
        let basic_inch = settings.get("feed_unit") == "inch";
        let radius = settings.dialect.name_with(NameRole::Radius).map(|row| {
            let quantity = row.quantity.unwrap_or(Quantity::Length);
            let counts = quantity == Quantity::Integer;
            (format!("{}=", row.name), Format::new(settings.dialect.numbers(quantity), counts))
        });
        Writer {
            dialect: settings.dialect,
            radius,
            edge_with_tool: settings.get("edge_after_change") == "1",
            leave_edge: BTreeSet::new(),
            inch_machine: settings.get("feed_unit") == "inch",
            words: Words::new(settings, &layout),
            standing: Standing::START,
            stale: false,
            inches: false,
            owed: None,
            cycled: false,
            raw: false,
            basic_feed: false,
            basic_units: if basic_inch { Units::Inch } else { Units::Mm },
            names: Names::default(),
            under_cycle: BTreeSet::new(),
            repeats: 0,
            alone: false,
            units: false,
            computing: Computing::default(),
            variables: Variables::default(),
            main: None,
            reported: BTreeSet::new(),
        }
    }

    /// A program that is called by another states nothing before its first event: it would go on in its caller.
    /// Where the source's codes of motion end a cycle, that of the caller is ended before all that is executed.
    pub fn stands_alone(&mut self, taken: &Modes, moves_end_cycles: bool) {
        self.alone = true;
        if moves_end_cycles {
            self.standing.modal = Modal::Doubtful;
        }
        self.words.stands_alone(taken);
    }

    /// Writes statements of the main procedure, in pieces of whole blocks. `assumed` holds the facts
    /// that the source relies on without having said them; it may grow from piece to piece.
    pub fn write(&mut self, stmts: &[Stmt], assumed: &Modes, out: &mut Vec<u8>, diags: &mut Vec<Diagnostic>) {
        self.words.take_for_granted(assumed);
        let mut sink = Sink { out, diags };
        if let Some(main) = self.main.take() {
            self.begin_variables(&main, &mut sink);
            if !main.parameters.is_empty() {
                self.main_parameters(&main, &mut sink);
            }
        }
        self.body(stmts, &mut sink);
    }

    fn body(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        let mut at = 0;
        while at < stmts.len() {
            if let Some(lines) = packed(&stmts[at]) {
                each_blocks(lines, |blocks| self.body(blocks, sink));
                at += 1;
                continue;
            }
            let end = self.words.block_end(stmts, at);
            let block = &stmts[at..end];
            if let Some(trace) = &mut self.words.trace {
                trace.enter(block);
            }
            if !self.plain_block(block, sink) {
                self.words.pass_on(sink.out);
                self.source_block(block, sink);
            }
            if self.words.trace.is_some() {
                self.words.block_written(sink.out);
            }
            at = end;
        }
        self.words.pass_on(sink.out);
    }

    /// Writes a block that is nothing but a straight move, or leaves it untouched.
    #[inline]
    fn plain_block(&mut self, block: &[Stmt], sink: &mut Sink) -> bool {
        match block {
            [stmt @ Stmt { op: Op::Hole(to), .. }] => return self.plain_hole(stmt, &to.to, sink.out),
            [stmt @ Stmt { op: Op::ArcFeed(arc), .. }] => return self.plain_arc(stmt, arc, sink.out),
            _ => {}
        }
        let plain = self.writes_plainly() && self.words.plain_block(block, sink);
        if let (true, Op::SetFeedRate(Expr::Num(feed))) = (plain, &block[0].op) {
            self.standing.feed = Some(*feed);
        }
        plain
    }

    fn source_block(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        let Some(first) = stmts.first() else { return };
        self.words.open_block(first);
        self.words.numbers.seen(first.number, first.span);
        if self.alone && self.standing.modal == Modal::Doubtful && !self.cycled && executed(&first.op) {
            if let Err(fault) = self.end_modal(sink) {
                sink.report(fault, first.span);
            }
            self.words.flush(false, sink);
            self.words.split = true;
        }
        let mut at = 0;
        while at < stmts.len() {
            at += self.one(&stmts[at..], sink);
        }
        self.words.close_block(stmts, sink);
    }

    /// Writes the first of the statements that are left of a block, and those that are stated with it;
    /// gives their number.
    fn one(&mut self, rest: &[Stmt], sink: &mut Sink) -> usize {
        let stmt = &rest[0];
        if stmt.skip.is_some() && self.owed.is_some() {
            // What is active must not depend on the switch.
            self.words.flush(false, sink);
            self.words.block.skip = None;
            if let Err(fault) = self.pay_call(sink) {
                sink.report(fault, stmt.span);
            }
        }
        let opened = self.words.open(stmt, sink);
        let before = self.standing;
        let tilt = tilt::first_swivel(rest);
        let both = self.speed_and_feed(rest);
        let defined = variable::defined_together(rest);
        let said = match (tilt, both) {
            _ if defined > 0 => defined,
            (Some(tilt), _) => tilt.said(),
            (None, Some(_)) => 2,
            (None, None) => cycle::called_here(rest),
        };
        let written = match (&opened, tilt, both) {
            (Err(fault), ..) => Err(fault.clone()),
            (Ok(_), ..) if defined > 1 => {
                self.before_statement(stmt, sink).and_then(|()| self.declare(&rest[..defined], sink))
            }
            (Ok(_), Some(tilt), _) => self.tilt(tilt, stmt.span, sink),
            (Ok(_), None, Some(both)) => self.write_both(both, stmt.span, sink),
            (Ok(_), None, None) => self.statement(stmt, said, sink),
        };
        self.words.close(stmt, opened.ok(), written, sink);
        for further in &rest[1..said] {
            self.words.close(further, None, Ok(()), sink);
        }
        if stmt.skip.is_some() {
            let answered = !self.standing.edge_waits && before.edge_level == stmt.skip;
            self.standing.join(before);
            self.standing.edge_waits &= !answered;
        }
        said
    }

    /// A block of its own in which nothing else can stand but its label: where blocks are repeated up to a label, its
    /// whole block is.
    fn alone(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        let words = &mut self.words;
        if !words.block.is_empty() && !words.block.is_label() {
            words.flush(false, sink);
            words.split = true;
        }
        words.admit(&Need::new(Rank::Call), sink)?;
        words.block.text(Part::Mode, text);
        Ok(())
    }

    /// Ends the cycle that the text may have active, before what must not make a hole.
    fn end_modal(&mut self, sink: &mut Sink) -> Result<(), Fault> {
        self.owed = None;
        if self.standing.modal == Modal::Off {
            return Ok(());
        }
        let word = self.call_modal()?;
        // A feed belongs to the move that follows.
        let feed = self.words.block.take_feed();
        self.alone(word, sink)?;
        self.standing.modal = Modal::Off;
        if !feed.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
            self.words.block.put_feed(feed);
        }
        Ok(())
    }

    /// Calls up what the program has active, before holes are made with it.
    fn pay_call(&mut self, sink: &mut Sink) -> Result<(), Fault> {
        if let Some(call) = self.owed.take() {
            let modal = self.call_modal()?;
            self.alone(&format!("{modal} {call}"), sink)?;
            self.standing.modal = Modal::On;
        }
        Ok(())
    }

    /// Writes a feed. One of the machine's basic system needs its own code of units.
    fn feed(&mut self, feed: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let Expr::Num(n) = feed else { return self.words.feed_rate(feed, span, sink) };
        let (units, in_force) = match (n.unit, self.words.active.units) {
            (Unit::Mm, Some(in_force)) => (Units::Mm, in_force),
            (Unit::Inch, Some(in_force)) => (Units::Inch, in_force),
            _ => return self.words.feed_rate(feed, span, sink),
        };
        let basic = units != in_force && units == self.basic_units;
        if basic != self.basic_feed {
            let meaning = Some(Meaning::UseLengthUnits(in_force));
            let row = self.dialect.code.iter().find(|r| r.means == meaning && r.feed_stays == basic);
            let row = row.ok_or_else(|| cannot(FeedsLack::FeedUnit))?;
            self.words.admit(&Need::new(Rank::Setting), sink)?;
            self.words.block.text(Part::Mode, &row.code);
            self.basic_feed = basic;
        }
        if !basic {
            return self.words.feed_rate(feed, span, sink);
        }
        self.words.rely("feed_unit", span, sink);
        // The digits are those of the other unit; the letter's rules are the same.
        let unit = if in_force == Units::Inch { Unit::Inch } else { Unit::Mm };
        self.words.feed_rate(&Expr::Num(Num { unit, ..*n }), span, sink)
    }

    /// States the feed that is active in the program, if the text has lost it.
    fn restate_feed(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if !self.standing.feed_said {
            if let Some(feed) = self.standing.feed {
                self.feed(&Expr::Num(feed), span, sink)?;
            }
            self.standing.feed_said = true;
        }
        Ok(())
    }

    /// How numbers of a quantity are written, and the letter by which diagnostics name them.
    fn letter(&self, name: &str, quantity: Quantity) -> Letter {
        let letter = name.bytes().find(u8::is_ascii_alphabetic).unwrap_or(b'X').to_ascii_uppercase();
        let counts = quantity == Quantity::Integer;
        Letter { letter, format: Format::new(self.dialect.numbers(quantity), counts) }
    }

    /// A value after the letter of its word; what is computed stands after `=`.
    fn lettered(
        &mut self,
        name: &str,
        letter: &Letter,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        let between = if matches!(value, Expr::Node(_)) { "=" } else { "" };
        Ok(format!("{name}{between}{}", self.value(letter, value, span, sink)?))
    }

    /// A value as it is written after a name.
    fn value(&mut self, letter: &Letter, value: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        if let Expr::Node(_) = value {
            let text = self.words.behind(value, None, span, sink)?;
            return Ok(text.trim_start_matches('=').to_owned());
        }
        let trimmed;
        let value = match value {
            // Milliseconds and sums have zeros at their end that nobody wrote.
            Expr::Num(n) if n.unit == Unit::Second => {
                trimmed = Expr::Num(n.trimmed());
                &trimmed
            }
            _ => value,
        };
        Ok(digits(self.words.number(letter, value, span, sink)?))
    }

    /// A length that the translation knows, in the active unit.
    fn length(&self, nanos: Nanos, letter: &Letter) -> Result<String, Fault> {
        let unit = match self.words.active.units {
            Some(Units::Mm) => Unit::Mm,
            Some(Units::Inch) => Unit::Inch,
            None => return Err(cannot(ModesLack::LengthUnitUnknown)),
        };
        self.near(nanos, letter, unit)
    }

    /// The written number nearest to a value.
    fn near(&self, nanos: Nanos, letter: &Letter, unit: Unit) -> Result<String, Fault> {
        let n = number::from_nanos(nanos, &letter.format, unit);
        let shaped = number::shape(n, &letter.format);
        Ok(digits(shaped.map_err(|why| unwritable(why, letter.letter, n))?))
    }

    /// Tells once that a call rests on a row that nobody confirms.
    fn tell_unsure(&mut self, row: &'static CallRow, meaning: &str, span: Span, sink: &mut Sink) {
        if !row.sure && self.reported.insert(&row.name) {
            let code = row.name.as_str().into();
            sink.report(Fault::AssumedRow { code, meaning: meaning.into() }, span);
        }
    }
}

/// Whether a statement is one of a block that is executed.
fn executed(op: &Op) -> bool {
    !matches!(op, Op::Comment(_) | Op::Blank | Op::NoEffect(_) | Op::Declare(_))
}

/// A number as text.
fn digits(n: Shaped) -> String {
    let mut text = Vec::new();
    number::append(&mut text, n);
    String::from_utf8_lossy(&text).into_owned()
}

/// A word of one letter.
fn lettered(letter: u8, n: Shaped) -> String {
    let mut text = Vec::with_capacity(16);
    text.push(letter);
    number::append(&mut text, n);
    // Letters and digits are ASCII.
    String::from_utf8(text).unwrap_or_default()
}

/// A call with its arguments; those that are left out at the end are not written.
fn call_text(row: &CallRow, mut arguments: Vec<Option<String>>) -> String {
    while arguments.last().is_some_and(Option::is_none) {
        arguments.pop();
    }
    let arguments: Vec<String> = arguments
        .into_iter()
        .zip(&row.parameters)
        .map(|(argument, parameter)| match (argument, parameter.write) {
            (Some(text), _) => text,
            (None, Some(value)) => value.to_string(),
            (None, None) => String::new(),
        })
        .collect();
    format!("{}({})", row.name, arguments.join(","))
}

impl WritesBlocks for Writer {
    fn words(&mut self) -> &mut Words {
        &mut self.words
    }

    #[inline]
    fn writes_plainly(&self) -> bool {
        let standing = &self.standing;
        let said = standing.modal == Modal::Off && standing.feed_said && !standing.edge_waits;
        said && self.owed.is_none() && !(self.raw || self.basic_feed || self.stale)
    }

    fn feed_stated(&mut self, feed: Num) {
        self.standing.feed = Some(feed);
    }

    fn blocks(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        self.body(stmts, sink);
    }
}
