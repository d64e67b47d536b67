//! `machine-numbers`: puts the target machine's numbers of tools, entries of the length table, work
//! offsets and programs in.
//!
//! It goes by [`Maps`] and knows no machine. What the program uses and an active map does not have
//! is refused where it stands, and so is a number that is computed; nothing is passed on by chance.
//! It cannot be asked for by name: a program is renumbered once, when it goes from one machine to another.

use crate::pass::Pass;
use std::collections::{BTreeMap, BTreeSet};

use ncc_exec::maps::Maps;
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::{FlowLack, FramesLack, Lack, LengthsLack, ToolsLack};
use ncc_ir::program::kinds::{conduct, drilling, miscellaneous, modes, moves, polar, variables};
use ncc_ir::program::numbered::Numbered;
use ncc_ir::program::{CutterRadius, Data, Op, Program, ProgramName, Stmt, Text, ToolLength};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const TOOL_NAMES: Pass = Pass::named(
    "tool-names",
    "puts the target machine's numbers in for names of tools, in a program that computes",
    None,
);

/// This pass.
pub(crate) const PASS: Pass = Pass::named(
    "machine-numbers",
    "puts the target machine's numbers of tools, lengths and offsets in",
    None,
);

/// What bears no number of tools, lengths, work offsets or programs.
macro_rules! unnumbered {
    () => {
        miscellaneous!()
            | conduct!()
            | modes!()
            | moves!()
            | Op::ChangeTool
            | Op::UseToolEdge { .. }
            | Op::ClearFrame(_)
            | Op::SetFrame(_)
            | Op::SetSlot(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_)
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::UseMachineCoordinates { .. }
            | Op::GoToReference(_)
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::SetFeedRate(_)
            | Op::Position(_)
            | polar!()
            | drilling!()
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | Op::Return
            | Op::RepeatBlocks(_)
            | variables!()
            | Op::Goto(_)
            | Op::Label(_)
            | Op::Leave
            | Op::NextTurn
    };
}

/// The pass at work on a program that comes in pieces.
#[derive(Clone, Debug, Default)]
pub struct Renumbering {
    maps: Maps,
    /// What was put in: kind, the source's number or name, the target's.
    used: BTreeSet<(Numbered, Text, Text)>,
    /// What was refused.
    reported: BTreeSet<(Numbered, u32)>,
}

impl Renumbering {
    /// By these maps.
    pub fn new(maps: Maps) -> Renumbering {
        Renumbering { maps, ..Renumbering::default() }
    }

    /// Everything that was put in so far, each once: kind, the source's number or name, the target's.
    pub fn used(&self) -> &BTreeSet<(Numbered, Text, Text)> {
        &self.used
    }

    /// Whether any of these statements has a number that a map is about.
    pub fn touches(&self, stmts: &[Stmt]) -> bool {
        !self.maps.is_empty() && stmts.iter().any(|stmt| self.concerns(&stmt.op))
    }

    fn concerns(&self, op: &Op) -> bool {
        match op {
            Op::SelectTool(_) => self.maps.tools.is_some(),
            Op::SelectToolByName(name) => self.maps.tool_names.contains_key(name),
            Op::UseToolLengthOffset(_) => self.maps.entries.is_some(),
            Op::UseToolLength(length) => {
                self.maps.entries.is_some() && matches!(**length, ToolLength::AddedEntry(_))
            }
            miscellaneous!() if matches!(op, Op::StartCutterRadiusCompensation { .. }) => {
                self.maps.entries.is_some()
            }
            Op::SetOriginOffsets(_) => self.maps.offsets.is_some(),
            Op::SetData(data) => match **data {
                Data::Offset { .. } => self.maps.offsets.is_some(),
                Data::Tool { .. } => self.maps.entries.is_some(),
                Data::Measured { offset, .. } => {
                    self.maps.entries.is_some() || offset.is_some() && self.maps.offsets.is_some()
                }
                Data::ToolInSpindle(_) => self.maps.tools.is_some(),
                Data::Position(_) => false,
            },
            Op::Call(_) => !self.maps.programs.is_empty() || self.maps.programs_in_force,
            Op::Control(control) => control.bodies().flatten().any(|s| self.concerns(&s.op)),
            unnumbered!() => false,
        }
    }

    /// Facts that were assumed, in the target's numbers.
    pub fn modes(&self, assumed: &Modes) -> Modes {
        self.maps.modes(assumed)
    }

    /// Refuses facts that were assumed and that the target has no number for. `at` is where
    /// the program is that relies on them.
    pub fn check_modes(&mut self, assumed: &Modes, at: Span, diags: &mut Vec<Diagnostic>) {
        if let Some(number) = assumed.work_offset {
            self.put(Numbered::WorkOffset, u32::from(number), at, diags);
        }
        if let Some(number) = assumed.length_offset {
            self.put(Numbered::LengthEntry, number, at, diags);
        }
    }

    /// Puts the target's numbers in further statements of a body.
    pub fn renumber(&mut self, stmts: &mut [Stmt], diags: &mut Vec<Diagnostic>) {
        if self.maps.is_empty() {
            return;
        }
        for stmt in stmts {
            let at = stmt.span;
            match &mut stmt.op {
                Op::SelectTool(tool) if self.maps.tools.is_some() => {
                    self.put_in(tool, Numbered::Tool, at, diags);
                }
                Op::SelectToolByName(name) => {
                    // Without a number it stays as it is, and who lacks it refuses it.
                    if let Some(number) = self.number_of(name) {
                        stmt.op = Op::SelectTool(Expr::int(number));
                    }
                }
                Op::UseToolLength(length) => {
                    if let (ToolLength::AddedEntry(entry), true) =
                        (&mut **length, self.maps.entries.is_some())
                    {
                        self.put_in(entry, Numbered::LengthEntry, at, diags);
                    }
                }
                Op::UseToolLengthOffset(entry) if self.maps.entries.is_some() => {
                    self.put_in(entry, Numbered::LengthEntry, at, diags);
                }
                Op::StartCutterRadiusCompensation { radius: CutterRadius::Entry(entry), .. }
                    if self.maps.entries.is_some() =>
                {
                    self.put_in(entry, Numbered::LengthEntry, at, diags);
                }
                Op::SetOriginOffsets(offset) => {
                    let put = self.put(Numbered::WorkOffset, u32::from(*offset), at, diags);
                    if let Some(number) = put.and_then(|n| u16::try_from(n).ok()) {
                        *offset = number;
                    }
                }
                Op::SetData(data) => match &mut **data {
                    Data::Offset { offset, .. } => {
                        let put = self.put(Numbered::WorkOffset, u32::from(*offset), at, diags);
                        if let Some(number) = put.and_then(|n| u16::try_from(n).ok()) {
                            *offset = number;
                        }
                    }
                    Data::Measured { entry, offset, .. } => {
                        if self.maps.entries.is_some()
                            && let Some(number) = self.put(Numbered::LengthEntry, *entry, at, diags)
                        {
                            *entry = number;
                        }
                        if let Some(offset) = offset
                            && let Some(put) = self.put(Numbered::WorkOffset, u32::from(*offset), at, diags)
                            && let Ok(number) = u16::try_from(put)
                        {
                            *offset = number;
                        }
                    }
                    Data::Tool { entry, .. } if self.maps.entries.is_some() => {
                        if let Some(number) = self.put(Numbered::LengthEntry, *entry, at, diags) {
                            *entry = number;
                        }
                    }
                    Data::ToolInSpindle(tool) if self.maps.tools.is_some() => {
                        self.put_in(tool, Numbered::Tool, at, diags);
                    }
                    Data::Tool { .. } | Data::ToolInSpindle(_) | Data::Position(_) => {}
                },
                Op::Call(call) => {
                    if let Some(name) = self.maps.program(&call.name) {
                        call.name = name.clone();
                    }
                }
                Op::Control(control) => {
                    for body in control.bodies_mut() {
                        self.renumber(body, diags);
                    }
                }
                Op::SelectTool(_) | Op::UseToolLengthOffset(_) | unnumbered!() => {}
            }
        }
    }

    /// Puts in the numbers of tools that are called by name, and nothing else: before anything is found out that holds on
    /// all paths, so that the tool in the spindle is known by its number in loops too. Where tools have other numbers
    /// there, nothing is done yet.
    pub fn tool_names(&mut self, program: &mut Program) {
        if self.maps.tools.is_some() || self.maps.tool_names.is_empty() {
            return;
        }
        for procedure in &mut program.procedures {
            self.name_tools(&mut procedure.body);
        }
    }

    fn name_tools(&mut self, stmts: &mut [Stmt]) {
        for stmt in stmts {
            match &mut stmt.op {
                Op::SelectToolByName(name) => {
                    if let Some(number) = self.number_of(name) {
                        stmt.op = Op::SelectTool(Expr::int(number));
                    }
                }
                Op::Control(control) => control.bodies_mut().for_each(|body| self.name_tools(body)),
                _ => {}
            }
        }
    }

    /// The target's number of a tool that is called by name, if it has one.
    fn number_of(&mut self, name: &mut Text) -> Option<i64> {
        let number = *self.maps.tool_names.get(name)?;
        let text = number.to_string().into();
        self.used.insert((Numbered::Tool, std::mem::take(name), text));
        Some(i64::from(number))
    }

    /// The same for a program that is kept whole: names of its subprograms too.
    pub fn run(&mut self, program: &mut Program, diags: &mut Vec<Diagnostic>) {
        if self.maps.is_empty() {
            return;
        }
        program.assumed = self.maps.modes(&program.assumed);
        program.name = self.name(&program.name);
        let mut seen: BTreeMap<Text, Span> = BTreeMap::new();
        for (at, procedure) in program.procedures.iter_mut().enumerate() {
            if at > 0 {
                let place = procedure.body.first().map_or(Span::default(), |s| s.span);
                self.rename(&mut procedure.name, &mut procedure.title, place, diags);
                match seen.get(&procedure.name) {
                    Some(first) => {
                        let fault = Fault::ProgramTwice { name: procedure.name.clone() };
                        diags.push(Diagnostic { related: vec![*first], ..Diagnostic::new(fault, place) });
                    }
                    None => {
                        seen.insert(procedure.name.clone(), place);
                    }
                }
            }
            self.renumber(&mut procedure.body, diags);
        }
    }

    /// A subprogram's name; one that becomes a number stays as the title, if there is none.
    fn rename(&mut self, name: &mut Text, title: &mut Option<Text>, at: Span, diags: &mut Vec<Diagnostic>) {
        let number = name.parse::<u32>().ok();
        let Some(new) = self.maps.program(name).cloned() else {
            if let Some(number) = number.filter(|_| self.maps.programs_in_force) {
                self.refuse(Numbered::Program, number, at, diags);
            }
            return;
        };
        let old = std::mem::replace(name, new.clone());
        if number.is_none() {
            title.get_or_insert_with(|| old.clone());
        }
        if old != new {
            self.used.insert((Numbered::Program, old, new));
        }
    }

    /// The name of the program itself: by number, or by title where it has none. One without a row
    /// keeps it, since it calls nothing.
    pub fn name(&mut self, name: &ProgramName) -> ProgramName {
        let own: Option<Text> = match (name.number, &name.title) {
            (Some(number), _) => Some(number.to_string().into()),
            (None, title) => title.clone(),
        };
        let Some(own) = own else { return name.clone() };
        let Some(new) = self.maps.program(&own).cloned() else { return name.clone() };
        if own != new {
            self.used.insert((Numbered::Program, own, new.clone()));
        }
        match new.parse() {
            Ok(number) => ProgramName { number: Some(number), title: name.title.clone() },
            Err(_) => ProgramName { number: None, title: Some(new) },
        }
    }

    /// Puts a number in the place of a literal one.
    fn put_in(&mut self, value: &mut Expr, what: Numbered, at: Span, diags: &mut Vec<Diagnostic>) {
        let number = value.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
        let Some(number) = number else {
            let lack: Lack = match what {
                Numbered::Tool => ToolsLack::ComputedTool.into(),
                Numbered::LengthEntry => LengthsLack::ComputedByName.into(),
                Numbered::WorkOffset => FramesLack::ComputedWorkOffset.into(),
                Numbered::Program => FlowLack::ComputedCall.into(),
            };
            diags.push(Diagnostic::new(Fault::lacks(lack), at));
            return;
        };
        if let Some(new) = self.put(what, number, at, diags).filter(|new| *new != number) {
            *value = Expr::int(i64::from(new));
        }
    }

    /// The target's number, noted or refused.
    fn put(&mut self, what: Numbered, number: u32, at: Span, diags: &mut Vec<Diagnostic>) -> Option<u32> {
        let (in_force, new) = match what {
            Numbered::Tool => (self.maps.tools.is_some(), self.maps.tool(number)),
            Numbered::LengthEntry => (self.maps.entries.is_some(), self.maps.entry(number)),
            Numbered::WorkOffset => {
                let offset = u16::try_from(number).ok().and_then(|n| self.maps.offset(n));
                (self.maps.offsets.is_some(), offset.map(u32::from))
            }
            Numbered::Program => (false, Some(number)),
        };
        match new {
            Some(new) if in_force && (number, new) != (0, 0) => {
                self.used.insert((what, number.to_string().into(), new.to_string().into()));
            }
            Some(_) => {}
            None => self.refuse(what, number, at, diags),
        }
        new
    }

    /// Refuses a number, once.
    fn refuse(&mut self, what: Numbered, number: u32, at: Span, diags: &mut Vec<Diagnostic>) {
        // The tool with the number of an entry has been refused: so is its length.
        let with_tool = what == Numbered::LengthEntry && self.reported.contains(&(Numbered::Tool, number));
        if self.reported.insert((what, number)) && !with_tool {
            let name = self.maps.unmatched.get(&(what, number)).cloned();
            diags.push(Diagnostic::new(Fault::NotInMap { what, number, name }, at));
        }
    }
}
