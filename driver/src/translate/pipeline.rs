//! The way from what was read to what is released: one list of steps, for a piece of a program that streams and for a
//! program that is kept whole. What a step does to the one and to the other stands beside one another.
//!
//! A piece holds no label, call or variable, so that most steps leave it alone; but its source is compared while the rest
//! of the program is not yet read, which is why it is folded first of all.

mod flattened;

use std::collections::{BTreeSet, HashMap};
use std::io;

use ncc_exec::are_arcs;
use ncc_ir::canon::Modes;
use ncc_ir::computed::free_variables::free_variables;
use ncc_ir::diag::{Diagnostic, Gravity};
use ncc_ir::program::valid::{anything, computing, leads_nowhere, returns_alone};
use ncc_ir::program::{Lines, Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;
use ncc_machines::reading::Told;
use ncc_passes::Touch;
use ncc_passes::flow::restored_modes::left_out;
use ncc_passes::flow::unused_labels;
use ncc_passes::frames::machine_cuts;
use ncc_passes::leave_out_values;
use ncc_passes::modes::word_distance;
use ncc_passes::support::mode_analysis::Known;
use ncc_passes::values::variables::renamed::Renamed;
use ncc_passes::watch::{ran, ran_whole};

use super::parametric::{self, target};
use super::rewrite::FLATTEN;
use super::snapshot::Snapshot;
use super::translation::Translation;
use super::writing::Said;
use crate::stretches::{
    Packer, Places, Stretch, Words, computes_packed, pack, reshape, stand, stretches, unpack,
};
use crate::translate::rewrite::{self, Folder};

/// What goes through the steps at once.
enum Part {
    /// Some blocks of a program that streams.
    Piece(Piece),
    /// A program that is kept whole, from its first label, call, loop or variable on.
    Kept(Box<Kept>),
}

/// Some blocks on their way.
struct Piece {
    stmts: Vec<Stmt>,
    /// Whether the source ends after them.
    over: bool,
    /// The blocks as they were read, where a pass changes them.
    original: Option<Vec<Stmt>>,
    /// What the passes do to them.
    touch: Touch,
    /// Whether the source's statements are executed, though no pass has changed any.
    executed: bool,
    /// Set where they are nothing but straight moves.
    lines: Option<Lines>,
    /// The modes that were assumed of the source, in the numbers of the target machine.
    target_modes: Modes,
    found: Vec<Diagnostic>,
}

impl Piece {
    fn new(stmts: Vec<Stmt>, over: bool) -> Piece {
        let (lines, target_modes) = (None, Modes::default());
        let (touch, executed) = (Touch::Changes, false);
        Piece { stmts, over, original: None, touch, executed, lines, target_modes, found: Vec::new() }
    }
}

/// A kept program on its way.
struct Kept {
    /// As it was read.
    source: Program,
    program: Program,
    /// What is known where something is computed; absent where nothing is, or the target's text says all of it.
    computed: Option<Computed>,
    /// Which of the source's variables became which.
    renamed: Renamed,
    /// The modes that were assumed of the source, in the numbers of the target machine.
    target_modes: Modes,
    /// What the steps from the passes that were asked for on have found.
    found: Vec<Diagnostic>,
    /// What the writer is to know of one that computes, once, before any of it is written: the places of words with a
    /// distance mode of their own, and the modes where stretches of blocks begin.
    for_writer: Option<(BTreeSet<u32>, HashMap<u32, Modes>)>,
}

impl Kept {
    fn new(source: Program) -> Kept {
        let (renamed, target_modes, found) = (Renamed::default(), Modes::default(), Vec::new());
        let program = source.clone();
        Kept { source, program, computed: None, renamed, target_modes, found, for_writer: None }
    }
}

/// What is known of a program that computes.
#[derive(Default)]
struct Computed {
    facts: Known,
    /// Places of words that count in another distance mode than their block's.
    own_distance: BTreeSet<u32>,
    /// The modes active at the start of each basic block.
    entry_modes: HashMap<u32, Modes>,
}

/// A step has refused the program; why is reported already.
struct Refused;

impl Translation<'_> {
    /// A piece of the source.
    pub(super) fn piece(&mut self, text: &[u8], base: u32) -> io::Result<()> {
        if self.takes_tables() {
            self.reader.read_to_table(text, base, &mut self.batch);
        } else {
            self.reader.read(text, base, &mut self.batch);
        }
        self.take_diagnostics();
        // What the target computes is looked at by execution; what is kept already is not looked at again and again.
        if !self.batch.whole {
            self.batch.whole = machine_cuts::computes(&self.batch.stmts, self.legaliser.caps());
        }
        if self.batch.whole || !self.job.passes.is_empty() {
            self.batch.unpack_table();
            if self.packs() {
                let settled = self.reader.settled(&self.batch);
                self.packer.pack(&mut self.batch.stmts, settled);
            }
            return Ok(());
        }
        self.count();
        self.verify_beside();
        self.tabled()?;
        if self.batch.stmts.is_empty() { Ok(()) } else { self.streamed(false) }
    }

    /// The end of the source.
    pub(super) fn end(&mut self) -> io::Result<()> {
        if self.batch.whole && self.packs() {
            let settled = self.reader.settled(&self.batch);
            let packer =
                std::mem::replace(&mut self.packer, Packer::new(self.job.shortest_stretch, Words::All));
            packer.finish(&mut self.batch.stmts, settled);
        }
        self.reader.finish(&mut self.batch);
        // Of subprograms all moves are there.
        self.batch.procedures.iter_mut().for_each(|procedure| unpack(&mut procedure.body));
        self.take_diagnostics();
        if self.errors > 0 {
            return Ok(());
        }
        self.count();
        if self.batch.whole || !self.job.passes.is_empty() {
            let source = self.kept();
            return self.send_kept(source);
        }
        self.streamed(true)?;
        self.end_stream()
    }

    /// Sends what was read of a program that streams.
    fn streamed(&mut self, over: bool) -> io::Result<()> {
        let mut part = Part::Piece(Piece::new(std::mem::take(&mut self.batch.stmts), over));
        let sent = self.send(&mut part);
        if let Part::Piece(Piece { mut stmts, .. }) = part {
            // Its memory serves the next piece.
            stmts.clear();
            self.batch.stmts = stmts;
        }
        sent
    }

    /// Sends a program that is kept whole, with its stretches of straight moves packed as far as the steps leave them as
    /// they are; where they do not, with all of its moves.
    fn send_kept(&mut self, mut source: Program) -> io::Result<()> {
        if self.packs_flattened() {
            return self.send_flattened(source);
        }
        let stretches = if self.packs() { self.pack(&mut source) } else { Vec::new() };
        if !stretches.is_empty() {
            let before = Snapshot::of(self);
            let mut part = Part::Kept(Box::new(Kept::new(source.clone())));
            if self.rewrite(&mut part).is_ok() && self.leaves(&stretches, &mut part, (&before, 0)) {
                self.write(&mut part);
                return self.release(&mut part);
            }
            drop((part, stretches));
            before.restore(self);
            source.procedures.first_mut().into_iter().for_each(|main| unpack(&mut main.body));
        }
        self.send(&mut Part::Kept(Box::new(Kept::new(source))))
    }

    /// Whether long stretches of moves are packed.
    fn packs(&self) -> bool {
        self.job.passes.is_empty() && self.folder.is_none()
    }

    /// Packs what is not packed of the main procedure, and gives its stretches.
    fn pack(&self, source: &mut Program) -> Vec<Stretch> {
        // Variables that are not set are given values from among the program's numbers.
        let open = !free_variables(source).is_empty();
        let Some(Procedure { body, .. }) = source.procedures.first_mut() else { return Vec::new() };
        if open && computes_packed(body) {
            unpack(body);
        }
        pack(body, self.job.shortest_stretch, if open { Words::Literal } else { Words::All });
        stretches(body)
    }

    /// Whether the steps have left stretches as they are, and told nothing of a move that stands for one: since `before`,
    /// and after so many of the part's own diagnostics. Says what stretches compute as it is stated beside them.
    fn leaves(&self, stretches: &[Stretch], part: &mut Part, (before, found): (&Snapshot, usize)) -> bool {
        let Part::Kept(kept) = part else { return false };
        let told = self.diagnostics.iter().skip(before.diagnostics()).chain(kept.found.iter().skip(found));
        let places = Places::of(stretches);
        if told.into_iter().any(|found| places.concern(found.span)) {
            return false;
        }
        let main = kept.program.procedures.first_mut();
        let main = main.map(|main| main.body.as_mut_slice()).unwrap_or_default();
        let Some(shapes) = stand(stretches, main) else { return false };
        reshape(main, shapes);
        true
    }

    /// Sends a part through all the steps; not further than to one that refuses it.
    fn send(&mut self, part: &mut Part) -> io::Result<()> {
        match self.rewrite(part) {
            Ok(()) => {
                self.write(part);
                self.release(part)
            }
            Err(Refused) => Ok(()),
        }
    }

    /// All steps before the text, in their order.
    fn rewrite(&mut self, part: &mut Part) -> Result<(), Refused> {
        self.rewrite_source(part)?;
        self.rewrite_for_target(part)
    }

    /// The steps up to the passes that are asked for.
    fn rewrite_source(&mut self, part: &mut Part) -> Result<(), Refused> {
        self.begin(part)?;
        self.write_side_effects(part);
        self.say_computed(part)?;
        self.run_asked_passes(part)
    }

    /// The steps after them.
    fn rewrite_for_target(&mut self, part: &mut Part) -> Result<(), Refused> {
        if let Part::Kept(kept) = part {
            self.legaliser.frame_increments(&mut kept.program, false, &mut kept.found);
            self.unless_refused(&mut kept.found)?;
        }
        self.put_machine_numbers(part);
        self.legalise(part)
    }

    /// The program that is kept, put together from all that was read.
    fn kept(&mut self) -> Program {
        let mut read = std::mem::take(&mut self.batch.stmts);
        let body = match self.folder.as_mut().map(Folder::held) {
            Some(mut held) => {
                held.append(&mut read);
                held
            }
            // There is one of them in memory, not two.
            None => read,
        };
        let mut procedures = vec![self.batch.main(body)];
        procedures.append(&mut self.batch.procedures);
        let name = self.batch.name.clone();
        let source = self.by_itself(Program { name, assumed: self.batch.assumed, procedures });
        self.with_parameters(source)
    }

    /// Folds a piece where that is asked for, and keeps what was read where a later step changes it. Sees that a kept
    /// program leads nowhere but into itself, and sets the variables that the user states.
    fn begin(&mut self, part: &mut Part) -> Result<(), Refused> {
        match part {
            Part::Piece(piece) => {
                if self.errors > 0 {
                    return Err(Refused);
                }
                let Piece { stmts, over, found, .. } = piece;
                let assumed = self.batch.assumed;
                let unfolded = self.folder.as_mut().map(|folder| folder.piece(stmts, &assumed, *over, found));
                self.state_given(stmts);
                let renumbers = self.renumbering.touches(stmts);
                piece.target_modes = self.modes_in_target(stmts, &assumed, found);
                let lines = Lines::from_statements(stmts);
                piece.lines = lines;
                let plain = lines.is_some_and(|lines| self.side_effects.passes(lines));
                let switches = !plain && self.side_effects.touches(stmts);
                let changes = unfolded.is_some() || renumbers || switches;
                let touch = if changes {
                    Touch::Changes
                } else {
                    self.legaliser.touches(stmts, lines, &piece.target_modes)
                };
                piece.touch = touch;
                piece.original = (touch == Touch::Changes).then(|| unfolded.unwrap_or_else(|| stmts.clone()));
            }
            Part::Kept(kept) => {
                let unknown = leads_nowhere(&kept.source);
                if !unknown.is_empty() {
                    self.take(unknown, Told::Reader);
                    return Err(Refused);
                }
                if self.job.from.dialect.program.macro_b {
                    unused_labels::run(&mut kept.program);
                    ran_whole("unused-labels", &kept.program);
                }
                let found = parametric::begin_with(self.job, &mut kept.program);
                self.take(found, Told::Writer);
            }
        }
        Ok(())
    }

    /// Writes what codes of the source's control do besides their names. In a kept program also what counts from the active frame,
    /// and what the target has no device for.
    fn write_side_effects(&mut self, part: &mut Part) {
        match part {
            Part::Piece(Piece { stmts, lines, found, .. }) => {
                if !lines.is_some_and(|lines| self.side_effects.passes(lines)) {
                    self.side_effects.write_effects(stmts, found);
                    ran("side-effects", stmts);
                }
            }
            Part::Kept(kept) => {
                let program = &mut kept.program;
                let mut found = Vec::new();
                self.side_effects.run(&mut program.procedures, &mut found);
                ran_whole("side-effects", program);
                if returns_alone(&kept.source).is_some() {
                    self.legaliser.nothing_before();
                }
                self.legaliser.frame_increments(program, !self.job.passes.is_empty(), &mut found);
                self.take(found, Told::Writer);
                if !self.job.to.dialect.can.everything {
                    let mut told = left_out(program, &self.job.to.caps());
                    parametric::alarms(self.job, program, &mut told);
                    self.take(told, Told::Writer);
                }
            }
        }
    }

    /// Says what a kept program computes as the target computes. A piece computes nothing.
    fn say_computed(&mut self, part: &mut Part) -> Result<(), Refused> {
        let Part::Kept(kept) = part else { return Ok(()) };
        self.computes = anything(&kept.source).is_some() && !self.executes_computed();
        if !self.computes {
            return Ok(());
        }
        let program = &mut kept.program;
        self.renumbering.tool_names(program);
        ran_whole("tool-names", program);
        let caps = self.job.to.caps();
        // What is folded or rewritten by name must be known when it is.
        let plainly = self.job.passes.is_empty() && self.folder.is_none();
        let computes = caps.flow.computes.as_deref().filter(|_| plainly);
        let mut found = Vec::new();
        let mut computed = Computed::default();
        if let Some(computes) = computes {
            leave_out_values(program, &caps, &mut found);
            ran_whole("leave-out-values", program);
            let entry = self.legaliser.entry();
            (computed.facts, kept.renamed) =
                parametric::legalise_parametric(self.job, program, computes, entry, &mut found);
            if word_distance::others(program, &computed.facts).is_empty() {
                computed.entry_modes = computed.facts.modes();
            }
            if self.job.from.caps().modes.word_distance {
                computed.own_distance = word_distance::places(program, &computed.facts);
                if !caps.modes.word_distance
                    && let Err(refusal) = word_distance::refused(&computed.own_distance, program)
                {
                    found.push(refusal);
                }
            }
        }
        found.extend(computing(program, computes).filter(|_| !refuses(&found)));
        kept.computed = Some(computed);
        if refuses(&found) {
            self.take(found, Told::Reader);
            return Err(Refused);
        }
        self.take_parameters(&found);
        self.take(found, Told::Writer);
        Ok(())
    }

    /// Runs the passes that are asked for by name, and those that fold, over a kept program. (A piece is folded as it
    /// begins; other passes that are asked for keep a program whole.)
    fn run_asked_passes(&mut self, part: &mut Part) -> Result<(), Refused> {
        let Part::Kept(kept) = part else { return Ok(()) };
        if self.is_refused_alone(&kept.source) {
            return Err(Refused);
        }
        let Kept { program, found, .. } = &mut **kept;
        program.procedures.first_mut().into_iter().for_each(|main| self.state_given(&mut main.body));
        let start = Tracker { position: self.job.start, modes: self.batch.assumed, ..Tracker::default() };
        let entry = self.folder.as_ref().map_or(&start, |folder| &folder.entry);
        let mut passes = self.job.passes.clone();
        if self.folder.is_some() {
            passes.extend(rewrite::folds(self.job.from.dialect.caps.flat));
        }
        match self.packs_flattened() {
            true => rewrite::flatten(program, &target(self.job), entry, found, self.job.shortest_stretch),
            false => rewrite::run(&passes, program, &target(self.job), entry, found),
        }
        Ok(())
    }

    /// Puts the target machine's numbers of tools, offsets and programs in.
    fn put_machine_numbers(&mut self, part: &mut Part) {
        match part {
            Part::Piece(Piece { stmts, original, found, .. }) => {
                if original.is_some() {
                    self.renumbering.renumber(stmts, found);
                    ran("machine-numbers", stmts);
                }
            }
            Part::Kept(kept) => {
                let Kept { program, target_modes, found, .. } = &mut **kept;
                let main = program.procedures.first().map(|main| main.body.as_slice()).unwrap_or_default();
                let assumed = self.batch.assumed;
                *target_modes = self.modes_in_target(main, &assumed, found);
                self.renumbering.run(program, found);
                ran_whole("machine-numbers", program);
            }
        }
    }

    /// Brings the part within what the target can say. The source of a piece is executed here, as what the passes assume
    /// holds for it as well.
    fn legalise(&mut self, part: &mut Part) -> Result<(), Refused> {
        match part {
            Part::Piece(Piece { stmts, original, touch, executed, lines, target_modes, found, .. }) => {
                self.legaliser.run_touching(stmts, target_modes, (*lines, *touch), found);
                // Lines and arcs that all passes have left as they were are compared as they are written.
                if original.as_ref() == Some(stmts) {
                    if stmts.iter().all(goes_straight) {
                        (*original, *touch) = (None, Touch::Passes);
                        self.take_parameters(found);
                    } else if are_arcs(stmts) {
                        (*original, *touch) = (None, Touch::JudgesArcs);
                    }
                }
                if let Some(original) = original {
                    self.take_parameters(found);
                    self.execute_source(original);
                } else if *touch == Touch::JudgesArcs {
                    self.take_parameters(found);
                    *executed = self.execute_arcs(stmts);
                }
            }
            Part::Kept(kept) => {
                let Kept { program, found, computed, source, for_writer, .. } = &mut **kept;
                match computed.take() {
                    Some(Computed { facts, own_distance, entry_modes }) => {
                        self.legaliser.run_computing(program, &facts, found);
                        *for_writer = Some((own_distance, entry_modes));
                        self.unless_refused(found)?;
                    }
                    None => {
                        let entry_modes = parametric::entry_modes(program, self.legaliser.entry());
                        self.writer.know_modes(program, entry_modes);
                        self.legaliser.run_program(program, found);
                    }
                }
                parametric::calls_and_jumps(self.job, [source, program], found);
                let subprograms = program.procedures.iter().skip(1);
                self.numbers = subprograms.filter_map(|p| p.name.parse().ok()).collect();
                self.take_parameters(found);
            }
        }
        Ok(())
    }

    /// Writes the part in the target's words.
    fn write(&mut self, part: &mut Part) {
        let found = match part {
            Part::Piece(Piece { stmts, target_modes, found, .. }) => {
                self.write_main(stmts, target_modes, found);
                found
            }
            Part::Kept(kept) => {
                let Kept { program, target_modes, found, for_writer, .. } = &mut **kept;
                if let Some((own_distance, entry_modes)) = for_writer.take() {
                    self.writer.know(program, &own_distance, entry_modes);
                }
                let mut procedures = program.procedures.iter();
                if let Some(main) = procedures.next() {
                    self.write_main(&main.body, target_modes, found);
                    self.foot(target_modes, found);
                }
                for procedure in procedures {
                    self.writer.procedure(procedure, &mut self.text, found);
                }
                self.writer.finish(&mut self.text, found);
                found
            }
        };
        let found = std::mem::take(found);
        self.take(found, Told::Writer);
    }

    /// Reads the text back, compares what both sides do, and passes the text on.
    fn release(&mut self, part: &mut Part) -> io::Result<()> {
        let assumed = self.batch.assumed;
        match part {
            Part::Piece(Piece { stmts, original, touch, executed, .. }) => {
                let said = match (original, touch) {
                    (Some(_), _) => Said::Otherwise,
                    (None, Touch::JudgesArcs) => Said::Arcs(stmts, *executed),
                    (None, _) => Said::Lines(stmts),
                };
                self.release_text(&assumed, said)
            }
            Part::Kept(kept) => {
                // It is written; what is verified is its text.
                kept.program = Program::default();
                self.release_kept(&kept.source, &kept.renamed)
            }
        }
    }

    /// Whether what comes after reading takes everything that is computed: a target that can say everything, as
    /// it is; or the pass that executes it.
    pub(super) fn executes_computed(&self) -> bool {
        match self.job.passes.first() {
            Some(pass) => pass.name == FLATTEN,
            None => self.job.to.dialect.can.everything && self.folder.is_none(),
        }
    }

    /// Takes what was found, and goes no further, where there is an error in it.
    fn unless_refused(&mut self, found: &mut Vec<Diagnostic>) -> Result<(), Refused> {
        if !refuses(found) {
            return Ok(());
        }
        let found = std::mem::take(found);
        self.take(found, Told::Writer);
        Err(Refused)
    }
}

/// Whether a statement goes straight, states a feed, or does nothing.
fn goes_straight(stmt: &Stmt) -> bool {
    matches!(
        stmt.op,
        Op::StraightFeed(_)
            | Op::StraightTraverse(_)
            | Op::Position(_)
            | Op::SetFeedRate(_)
            | Op::Comment(_)
            | Op::Blank
    )
}

/// Whether there is an error in what was found.
fn refuses(found: &[Diagnostic]) -> bool {
    found.iter().any(|diagnostic| diagnostic.fault.gravity() == Gravity::Error)
}
