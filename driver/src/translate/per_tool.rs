//! A file per tool: a program whose tools are changed by hand, cut at its tool changes.
//!
//! ```text
//! … G0 Z20 │ M5 M9 G53 G0 Z0 T5 M0 │ S3000 M3 …    →    … G0 Z20 / M5 M9 G53 G0 Z0 / M2
//!                                                        G21 G17 … / G54 / M5 M9 G53 G0 Z0 / S3000 M3 …
//! ```
//!
//! The whole program is written with the tool change by hand, and verified. Then its text is cut. Each file
//! starts on a machine at rest: it states the modes that are active at its tool change, moves Z to machine zero, and moves
//! each axis whose position its first move does not state. If a file cannot state a fact, ncc refuses it. The text of the
//! whole program and of the files is kept in memory; statements and events are not.
//!
//! Not here: whether each file does the same as its part of the whole (`verify_run::per_tool`), and the names of the
//! files (`job::ToolFile`).

pub(super) mod origins;
mod scan;

use std::io;
use std::ops::Range;

use ncc_backends::{Head, Layout, Numbering, Writer};
use ncc_dialects::Meaning;
use ncc_ir::canon::{Axis, Distance, Fact, Modes, Units};
use ncc_ir::diag::{Diagnostic, Fault, FileNeeds, Gravity};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::{Coord, FrameSlot, Move, Op, Point, Stmt};
use ncc_ir::source::Span;
use ncc_machines::reading::Told;

use self::origins::{Cut, PerTool};
use self::scan::{Change, Scanned, scan};
use super::translation::Translation;
use crate::job::{Job, Output, ToolFile};
use crate::render::per_tool::{Begins, begin_line, file_line, per_tool as per_tool_words};
use crate::render::source::Lines;
use crate::source::Readable;
use crate::verify_run::Verifier;
use crate::verify_run::per_tool::{self, Part};

/// Digits after the point of an exact position; the writer rounds it.
const EXACT: u8 = 9;

impl Translation<'_> {
    /// Cuts the verified text at its tool changes, and verifies each file alone.
    ///
    /// # Errors
    /// Reading the source or the temporary file of the output.
    pub(super) fn cut_by_tool(&mut self, source: &mut dyn Readable) -> io::Result<()> {
        let Some(mut own) = self.per_tool.take().filter(|_| self.errors == 0 && !self.failed) else {
            return Ok(());
        };
        let text = self.output.to_vec()?;
        let inherited = self.inherited(&self.batch.assumed);
        match self.cut(&text, &inherited) {
            Ok(cut) => {
                own.cut = cut;
                own.number_lines(source, &text, self.job)?;
            }
            Err(Uncut::Refused { at, needs }) => {
                let fault = Fault::NoFileOfTool { needs };
                let found = Diagnostic::new(fault, own.source_of(&text, at));
                self.take(vec![found], Told::Writer);
            }
            Err(Uncut::Found(found)) => self.take(found, Told::Writer),
            Err(Uncut::Differs { at, difference }) => {
                self.failed = true;
                let difference = per_tool_words("differs").text("difference", difference).headline().into();
                let fault = Fault::NotTheSame { difference };
                self.diagnostics.push(Diagnostic::new(fault, own.source_of(&text, at)));
            }
        }
        self.per_tool = Some(own);
        Ok(())
    }

    /// The files without their heads; empty if the program has no tool change.
    fn cut(&self, text: &[u8], inherited: &Modes) -> Result<Vec<Cut>, Uncut> {
        let refused = |at, needs| Uncut::Refused { at, needs };
        let scanned = scan(self.job, text).map_err(|(at, needs)| refused(at, needs))?;
        let Scanned { changes, cuts_before, used } = scanned;
        let Some(first) = changes.first() else { return Ok(Vec::new()) };
        let (mut begins, mut offsets, mut parts) = (Vec::new(), Vec::new(), Vec::new());
        if cuts_before {
            begins.push([0, 0]);
            let mut file = Text::default();
            file.body(text, 0..first.comments);
            file.joint(&self.end_of_file(&first.modes)?);
            offsets.push(Vec::new());
            parts.push(Part {
                tool: None,
                changes: 0,
                own_beginning: 0,
                bodies: file.bodies,
                text: file.text,
            });
        }
        for (at, change) in changes.iter().enumerate() {
            let next = changes.get(at + 1);
            let mut file = Text::default();
            let whole = at == 0 && !cuts_before;
            begins.push([if whole { 0 } else { change.comments }, change.block.start]);
            if let Some(place) = change.relative_z {
                return Err(refused(place, FileNeeds::Place(Axis::Z)));
            }
            let own_beginning = if whole { change.block.start } else { 0 };
            if whole {
                file.joint(&text[..own_beginning]);
                places(change)?;
                let mut stmts = up(change.modes.units);
                stmts.extend(remark(change));
                file.joint(&self.written(&stmts, Some(&change.modes))?);
            } else {
                file.body(text, change.comments..change.block.start);
                file.joint(&self.beginning(change).and_then(|stmts| self.written(&stmts, None))?);
            }
            file.body(text, change.block.end..next.map_or(text.len(), |next| next.comments));
            if let Some(next) = next {
                file.joint(&self.end_of_file(&next.modes)?);
            }
            let tool = Some(change.tool);
            offsets.push(change.offsets.clone());
            let own_beginning = own_beginning as u32;
            parts.push(Part { tool, changes: 1, own_beginning, bodies: file.bodies, text: file.text });
        }
        per_tool::verify(self.job, text, &parts, &used, inherited).map_err(|found| {
            match found.difference {
                Some(difference) => Uncut::Differs { at: found.at, difference },
                None => refused(found.at, FileNeeds::AnotherTool),
            }
        })?;
        let cut = |((part, begins), offsets): ((Part, [usize; 2]), Vec<u16>)| Cut {
            tool: part.tool,
            offsets,
            lines: None,
            begins,
            text: part.text,
        };
        Ok(parts.into_iter().zip(begins).zip(offsets).map(cut).collect())
    }

    /// The blocks before the moves of a tool.
    fn beginning(&self, change: &Change) -> Result<Vec<Stmt>, Uncut> {
        let refused = |needs| refused(change, needs);
        let Modes { units, plane, feed_mode, work_offset, return_level, distance, no_origin_shift, .. } =
            change.modes;
        let mut ops: Vec<Op> = Vec::new();
        ops.extend(units.map(Op::UseLengthUnits));
        ops.extend(plane.map(Op::SelectPlane));
        ops.push(Op::SetDistanceMode(Distance::Absolute));
        ops.extend(feed_mode.map(Op::SetFeedMode));
        ops.extend(return_level.map(Op::SetReturnLevel));
        ops.extend(work_offset.map(Op::SetOriginOffsets));
        // Only if the program states it: else the reset decides.
        ops.extend(no_origin_shift.filter(|none| *none).map(|_| Op::ClearFrame(FrameSlot::Shift)));
        let mut stmts: Vec<Stmt> = ops.into_iter().map(|op| Stmt::new(Span::default(), op)).collect();
        stmts.append(&mut up(units));
        stmts.extend(remark(change));
        let mut to = Point::default();
        for (axis, at) in places(change)? {
            to.set(axis, place(at, axis, units).ok_or_else(|| refused(FileNeeds::PlaceInInches(axis)))?);
        }
        let mut after = Vec::new();
        if !to.is_empty() {
            after.push(Op::StraightTraverse(Move { to, said: true }));
        }
        if distance == Some(Distance::Incremental) {
            after.push(Op::SetDistanceMode(Distance::Incremental));
        }
        if change.needs_feed {
            let feed = change.feed.ok_or_else(|| refused(FileNeeds::Feed))?;
            after.push(Op::SetFeedRate(Expr::Num(feed)));
        }
        if change.needs_speed {
            let speed = change.speed.ok_or_else(|| refused(FileNeeds::Speed))?;
            after.push(Op::SetSpindleSpeed(Expr::Num(speed)));
        }
        stmts.extend(after.into_iter().map(|op| Stmt::new(Span::default(), op)));
        Ok(stmts)
    }

    /// The end of a file that is not the last: at rest, as at the tool change of the whole program.
    fn end_of_file(&self, modes: &Modes) -> Result<Vec<u8>, Uncut> {
        let mut stmts = up(modes.units);
        let footer = self.job.machines.layout().footer;
        stmts.extend(footer.iter().map(|line| Stmt::new(Span::default(), Op::Comment(line.as_str().into()))));
        stmts.push(Stmt::new(Span::default(), Op::ProgramEnd));
        self.written(&stmts, Some(modes))
    }

    /// Statements as text of the target: at the start of a program, or inside one with these active modes.
    fn written(&self, stmts: &[Stmt], within: Option<&Modes>) -> Result<Vec<u8>, Uncut> {
        let layout = Layout { numbering: Numbering::Off, ..self.job.layout.clone() };
        let mut writer = Writer::new(self.job.to.clone(), layout);
        writer.set_form(self.job.machines.form());
        if let Some(modes) = within {
            writer.stands_alone(modes, false, "");
        }
        let (mut text, mut found) = (Vec::new(), Vec::new());
        writer.write(stmts, &Modes::default(), &mut text, &mut found);
        if within.is_some() && stmts.iter().any(|stmt| stmt.op == Op::ProgramEnd) {
            writer.finish(&mut text, &mut found);
        }
        found.retain(|diagnostic| diagnostic.fault.gravity() == Gravity::Error);
        if found.is_empty() { Ok(text) } else { Err(Uncut::Found(found)) }
    }

    /// The codes of work offsets, each once.
    fn codes_of(&self, offsets: &[u16]) -> Vec<&str> {
        let mut codes: Vec<&str> = Vec::new();
        for number in offsets {
            let row = self.job.to.dialect.code_for(Meaning::SetOriginOffsets(*number));
            codes.extend(row.map(|row| row.code.as_str()).filter(|code| !codes.contains(code)));
        }
        codes
    }

    /// The files with their heads. `hash` is the hash of the source.
    ///
    /// # Errors
    /// The anonymous files cannot be written.
    pub(super) fn files_per_tool(&mut self, head: &Head, hash: &[u8; 32]) -> io::Result<Vec<ToolFile>> {
        let cut = self.per_tool.take().map(|own| own.cut).unwrap_or_default();
        let count = cut.len();
        let mut files = Vec::new();
        for (at, Cut { tool, offsets, lines, text, .. }) in cut.into_iter().enumerate() {
            let mut head = Head { lines: self.head_lines_of(hash, Some(tool)), ..head.clone() };
            head.lines.push(file_line(tool, at + 1, count, lines));
            if self.job.head {
                let by_tool = |d: &Diagnostic| matches!(d.fault, Fault::LengthByHand { tool: own } if tool == Some(own.into()));
                let begins = match tool {
                    Some(_) if self.diagnostics.iter().any(by_tool) => Begins::ZeroSet,
                    Some(_) => Begins::ZeroKept,
                    None => Begins::InSpindle,
                };
                head.lines.push(begin_line(begins, &self.codes_of(&offsets)));
            }
            let mut own = Vec::new();
            // The program name is reported once.
            self.writer.head(&head, &mut own, &mut Vec::new());
            let job = self.job;
            self.check(|_| Verifier::new(job).head(&own));
            let mut output = Output::new();
            output.set_head(own);
            output.push(&text)?;
            files.push(ToolFile { tool, number: at + 1, count, lines, output });
        }
        Ok(files)
    }
}

/// Why ncc writes no files.
enum Uncut {
    /// The file cannot state a fact that it depends on.
    Refused { at: usize, needs: FileNeeds },
    /// The writer refuses its start or its end.
    Found(Vec<Diagnostic>),
    /// A file does not do the same as its part of the whole: an internal error.
    Differs { at: usize, difference: String },
}

/// Spindle and coolant off, and Z to machine zero, as in the tool change by hand.
fn up(units: Option<Units>) -> Vec<Stmt> {
    let mut to = Point::default();
    if let Some(zero) = place(0, Axis::Z, units) {
        to.set(Axis::Z, zero);
    }
    let ops = [
        Op::StopSpindleTurning,
        Op::CoolantOff,
        Op::UseMachineCoordinates { length: false },
        Op::StraightTraverse(Move { to, said: true }),
    ];
    // Two blocks, so that spindle and coolant are off before Z moves, whatever the order within a block.
    let joined = |(at, op)| Stmt { joined: at % 2 > 0, ..Stmt::new(Span::default(), op) };
    ops.into_iter().enumerate().map(joined).collect()
}

/// Refuses a file because of a fact that the first move after its tool change needs.
fn refused(change: &Change, needs: FileNeeds) -> Uncut {
    Uncut::Refused { at: change.next_move.unwrap_or(change.block.start), needs }
}

/// The positions on which the first move after a tool change depends. Refuses an unknown one.
fn places(change: &Change) -> Result<Vec<(Axis, Nanos)>, Uncut> {
    let relied_on = Axis::ALL.into_iter().filter(|axis| change.unstated[*axis as usize]);
    let known = |axis: Axis| {
        let at = change.position[axis as usize].ok_or_else(|| refused(change, FileNeeds::Place(axis)))?;
        Ok((axis, at))
    };
    relied_on.map(known).collect()
}

/// The comment in the block of a tool change.
fn remark(change: &Change) -> impl Iterator<Item = Stmt> + '_ {
    change.remark.iter().map(|text| Stmt::new(Span::default(), Op::Comment(text.clone())))
}

/// A position as a word in the active unit; `None` if it is not exact in inches.
fn place(at: Nanos, axis: Axis, units: Option<Units>) -> Option<Coord> {
    let value = match (axis.is_rotary(), units) {
        (true, _) => Num::from_nanos(at, EXACT, Unit::Degree),
        (false, Some(Units::Inch)) => {
            let tenths = at.checked_mul(10).filter(|tenths| tenths % 254 == 0)?;
            Num::from_nanos(tenths / 254, EXACT, Unit::Inch)
        }
        (false, _) => Num::from_nanos(at, EXACT, Unit::Mm),
    };
    Some(Coord { value: Expr::Num(value.trimmed()), distance: Fact::Known(Distance::Absolute) })
}

/// The text of a file while it is built.
#[derive(Default)]
struct Text {
    text: Vec<u8>,
    bodies: Vec<Range<u32>>,
}

impl Text {
    /// Text of the whole program.
    fn body(&mut self, whole: &[u8], range: Range<usize>) {
        let begins = self.text.len() as u32;
        self.text.extend_from_slice(&whole[range]);
        self.bodies.push(begins..self.text.len() as u32);
    }

    /// Text that the whole program does not contain.
    fn joint(&mut self, text: &[u8]) {
        if !self.text.is_empty() && self.text.last() != Some(&b'\n') {
            self.text.push(b'\n');
        }
        self.text.extend_from_slice(text);
    }
}

impl PerTool {
    /// Assigns the source lines to the files, if the tool changes follow one another in the source.
    ///
    /// # Errors
    /// Reading the source.
    fn number_lines(&mut self, source: &mut dyn Readable, text: &[u8], job: &Job) -> io::Result<()> {
        let last_line = text.len().saturating_sub(1);
        // The first file starts at its tool change. A tool change in a loop or a subprogram has no lines.
        let first = self.cut.first().map(|cut| cut.begins[1]);
        let begins = first.into_iter().chain(self.cut.iter().skip(1).map(|cut| cut.begins[0]));
        let places = self.sources_of(text, begins.chain([last_line]));
        let places: Vec<u32> = places.iter().map(|span| span.start).collect();
        if places.iter().any(|place| job.called.as_ref().is_some_and(|called| called.file(*place).is_some()))
        {
            return Ok(());
        }
        let lines = Lines::find(source, places.clone())?;
        let numbers: Option<Vec<u64>> =
            places.iter().map(|place| lines.line(*place).map(|line| line.number)).collect();
        let Some(numbers) = numbers.filter(|all| all.is_sorted_by(|a, b| a < b)) else { return Ok(()) };
        let (count, mut first) = (self.cut.len(), 1);
        for ((at, cut), next) in self.cut.iter_mut().enumerate().zip(numbers.iter().skip(1)) {
            let last = if at + 1 == count { *next } else { next - 1 };
            cut.lines = Some((first, last));
            first = *next;
        }
        Ok(())
    }
}
