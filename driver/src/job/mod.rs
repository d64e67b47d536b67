//! The request and the result of a translation: the face of the pipeline towards the
//! command line, and towards tests that call it without a process.
//!
//! ```text
//! Job::new(from, to, "part.nc")    what is asked for
//! Outcome { output, diagnostics, … }    what came of it
//! ```
//!
//! Not here: how it is done (`translate`), how it is reported (`render`), where it goes (`release`).

pub mod initial_variables;
pub mod options;
pub mod parameters;
pub mod project_answers;
pub mod project_file;
pub mod start;

use std::collections::BTreeSet;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::Arc;

use ncc_backends::Layout;
use ncc_dialects::{BLOCK_WITHOUT_WAY, Dialect, FILE_PER_TOOL, LOOKED_OVER, Settings, TOOL_CHANGE};
use ncc_exec::maps::{Maps, Renaming};
use ncc_exec::named_tool;
use ncc_frontends::Reader;
use ncc_ir::behaviour::{Behaviour, Behaviours, Concern};
use ncc_ir::canon::{AXES, AdviceKind};
use ncc_ir::diag::{Diagnostic, Fault, Gravity, Verdict};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::geometry::arc_feed::ArcFeed;
use ncc_ir::geometry::offset_path::Rules;
use ncc_ir::program::Text;
use ncc_ir::program::numbered::Numbered;
use ncc_machines::reading::{Place, Side};
use ncc_passes::modes::side_effects::SideEffects;
use ncc_passes::{Compensating, Pass};

use crate::job::initial_variables::InitialVariables;
use crate::job::project_answers::Used;
use crate::machines::pair::Machines;
use crate::problem::Exit;
use crate::questions::question::{Policy, Question};
use crate::source::called_files::Called;
use crate::source::chunks::PIECE;
use crate::source::include_path;
use crate::source::spool::Spool;
pub use crate::stretches::SHORTEST as SHORTEST_STRETCH;

/// The pass that writes the tool centre path.
const EXPAND_COMPENSATION: &str = "expand-compensation";

/// A translation to be done.
#[derive(Clone, Debug)]
pub struct Job {
    /// The dialect of the source, with its options.
    pub from: Settings,
    /// The dialect of the output, with its options.
    pub to: Settings,
    /// The machines of both sides, as far as profiles of them were given.
    pub machines: Machines,
    /// How the output is laid out.
    pub layout: Layout,
    /// Passes that the source's program goes through first, in this order.
    pub passes: Vec<&'static Pass>,
    /// Whether long-hand holes and lists of positions are folded into cycles and patterns; `None`
    /// where the source is a list of events that has no other form.
    pub fold: Option<bool>,
    /// Whether the output is read back and compared. Without, its head says UNVERIFIED.
    pub verify: bool,
    /// Whether the output opens with the comment that names source, hash and assumptions.
    pub head: bool,
    /// Where the axes stand in program coordinates before the first block, as stated by the user
    /// (millimetres or degrees, in nanos); `None` is not known.
    pub start: [Option<Nanos>; AXES],
    /// What the source's variables may be given before it begins.
    pub given: InitialVariables,
    /// Values of variables at the start, as the user states them. The output sets them itself.
    pub values: Vec<(String, Num)>,
    /// The program number of the output, where the target has one.
    pub program_number: Option<u32>,
    /// Name of the source for the head and the report: a file name without folders, or `-`.
    pub source_name: String,
    /// Files of called programs, which stand behind the source's own text.
    pub called: Option<Called>,
    /// The project file that counts for the source.
    pub project: Option<Arc<Used>>,
    /// Assumptions about the source that the user stated, such as `--assume milling`.
    pub assumed: Vec<Diagnostic>,
    /// Numbers of tools that the source calls by name and no profile numbers, for a target without names.
    pub numbered_tools: Vec<(Text, u32)>,
    /// Entries of the target's length table for edges of the source's tools other than the first.
    pub further_edges: Vec<FurtherEdge>,
    /// Most steps and blocks of a program that `--pass flatten` executes, where it is only tried.
    pub tried_upto: Option<u32>,
    /// Other dialects that explain the source's text as well as its own: where it was recognised, and not named.
    pub rivals: Vec<&'static Dialect>,
    /// The handling of questions: facts that change the cut and that the program does not state.
    pub questions: Policy,
    /// Bytes of the source that go through the steps at once; no line may be longer. What comes of it does not depend on it.
    pub piece: usize,
    /// Straight moves one behind the other of which fewer are not packed in a program that is kept whole. What comes of it
    /// does not depend on it.
    pub shortest_stretch: usize,
    /// Whether a long program is verified on the thread that translates it: where other programs are translated beside it.
    /// What comes of it does not depend on it.
    pub one_thread: bool,
    /// Whether lines of a program that streams are read as tables. What comes of it does not depend on it.
    pub tables: bool,
    /// Verdicts that stop a translation by themselves, and shall not.
    pub allow: Vec<Verdict>,
    /// Verdicts that would not stop a translation, and shall.
    pub deny: Vec<Verdict>,
}

/// An edge of a tool other than the first, and the entry of the target's length table that has its length.
#[derive(Clone, Debug, PartialEq)]
pub struct FurtherEdge {
    /// The tool's name on the source's control, where it is called so.
    pub name: Option<Text>,
    /// Its number there.
    pub own: u32,
    /// Its number on the target's control.
    pub number: u32,
    /// The edge, from 2 to 9.
    pub edge: u32,
    /// The entry.
    pub entry: u32,
}

impl FurtherEdge {
    /// The tool as execution of the source knows it.
    pub fn in_source(&self) -> i64 {
        self.name.as_deref().map_or(i64::from(self.own), named_tool)
    }
}

impl Job {
    /// A translation as it is done where nothing else is asked for: no machines, no passes, no program
    /// number, nothing known of where the axes stand; verified, and with a head.
    pub fn new(from: Settings, to: Settings, source_name: impl Into<String>) -> Job {
        Job {
            from,
            to,
            machines: Machines::default(),
            layout: Layout::default(),
            passes: Vec::new(),
            fold: None,
            verify: true,
            head: true,
            start: [None; AXES],
            given: InitialVariables::default(),
            values: Vec::new(),
            program_number: None,
            source_name: source_name.into(),
            called: None,
            project: None,
            assumed: Vec::new(),
            numbered_tools: Vec::new(),
            further_edges: Vec::new(),
            tried_upto: None,
            rivals: Vec::new(),
            questions: Policy::default(),
            piece: PIECE,
            shortest_stretch: SHORTEST_STRETCH,
            one_thread: false,
            tables: true,
            allow: Vec::new(),
            deny: Vec::new(),
        }
    }

    /// A reader for the source, which is known by its file's name; with `assume` as of [`Reader::new`].
    pub fn reader(&self, assume: bool) -> Reader {
        let mut reader = Reader::new(self.from.clone(), assume);
        reader.named(&self.source_name);
        reader
    }

    /// Whether the source's control looks over a block without a way on a compensated contour.
    pub fn looks_over_blocks(&self) -> bool {
        self.from.get(BLOCK_WITHOUT_WAY) == LOOKED_OVER
    }

    /// The target's numbers of what the source calls by its own.
    pub fn maps(&self) -> Maps {
        let mut maps = self.machines.maps(self.to.dialect);
        maps.tool_names.extend(self.numbered_tools.iter().cloned());
        maps.further_edges =
            self.further_edges.iter().map(|own| ((own.number, own.edge), own.entry)).collect();
        maps
    }

    /// The way back, for a judge of what was written.
    pub fn renaming(&self) -> Renaming {
        let mut renaming = self.machines.renaming();
        // One that the maps have no number for, as its length has another, got one here.
        renaming.tool_names.retain(|_, name| !self.numbered_tools.iter().any(|(own, _)| own == name));
        renaming.tool_names.extend(self.numbered_tools.iter().map(|(name, number)| (*number, name.clone())));
        renaming
    }

    /// Whether long-hand text is folded. A list of events is, unless the target is one as well.
    pub fn folds(&self) -> bool {
        let (from, to) = (&self.from.dialect.caps, &self.to.dialect.caps);
        !to.flat && self.fold.unwrap_or(from.flat)
    }

    /// Whether the output is for a control of another kind than the source's. The text forms are no
    /// control: what they hold is still the source's.
    pub fn between_controls(&self) -> bool {
        let to = self.to.dialect;
        self.from.dialect.id != to.id && !to.can.everything && !to.can.flat
    }

    /// Side effects of codes on the source's control. A list of events cannot say machine zero. It holds only the
    /// program's own moves.
    pub fn source_behaviours(&self) -> Behaviours {
        let mut source = self.from.behaviours();
        if self.to.dialect.can.flat {
            source.set(Behaviour::ZAtChange, 0, false);
        }
        source
    }

    /// Side effects of codes on the target's control. A target that lacks machine zero is assumed to move Z
    /// there at a tool change, as the source's control does. An open fact stays open.
    pub fn target_behaviours(&self) -> Behaviours {
        let mut target = self.to.behaviours();
        if self.to.dialect.can.everything || self.to.dialect.can.flat {
            // A text form is no control that would keep anything.
            for behaviour in Behaviour::ALL.iter().filter(|one| one.concern() == Concern::AtEnd) {
                target.set(*behaviour, self.from.behaviours().get(*behaviour), false);
            }
        }
        let change = Behaviour::ZAtChange;
        if self.takes_way_up() && !self.to.dialect.can.flat {
            target.set(change, self.from.behaviours().get(change), target.is_open(change));
        }
        target
    }

    /// Whether the source's control moves Z to machine zero at a tool change, and the target lacks that: it
    /// is assumed to do the same, or, a list of events, leaves it out. Nothing is known there of the target's Z.
    pub fn takes_way_up(&self) -> bool {
        let caps = &self.to.dialect.caps;
        let says = caps.machine.references.home || caps.machine.coordinates;
        let change = Behaviour::ZAtChange;
        self.from.behaviours().surely(change) && !self.to.behaviours().does(change) && !says
    }

    /// The pass that writes side effects of codes as words.
    pub fn side_effects(&self) -> SideEffects {
        let all =
            SideEffects::new(self.source_behaviours(), self.target_behaviours(), self.from.fine_increments());
        let all = if self.takes_way_up() { all.with_way_up_taken() } else { all };
        // A change by hand is a block that moves Z, and no control's own doing.
        let by_hand = [&self.from, &self.to].iter().any(|side| side.dialect.can.change_by_hand);
        let all = if by_hand { all.with_words_at_change() } else { all };
        let says = |value| self.to.dialect.caps.advises(AdviceKind::CompensatedFeed, value);
        match (0..AdviceKind::CompensatedFeed.values().len() as u8).all(says) {
            true => all.with_arc_feed(),
            false => all,
        }
    }

    /// Whether cutter radius compensation is computed, so that the output has none.
    pub fn works_compensation_out(&self) -> bool {
        self.passes.iter().any(|pass| pass.name == EXPAND_COMPENSATION)
    }

    /// How it is computed: as the source's control does it, by the tools of the source's machine.
    pub fn compensating(&self) -> Compensating {
        let known = self.from.dialect.can.contour_left_at_once;
        Compensating {
            rules: if known { Rules::INTERPRETER } else { Rules::NEAR },
            known,
            radii: self.machines.from.as_ref().map(|machine| machine.tables().radii).unwrap_or_default(),
            listing: false,
            arc_feed: ArcFeed::from_behaviours(&self.source_behaviours()),
            feed_decimals: self.to.dialect.caps.modes.feed_decimals,
        }
    }

    /// Whether a verdict stops this translation. What is denied stops even if it is allowed.
    pub fn stops(&self, verdict: Verdict) -> bool {
        self.deny.contains(&verdict) || (verdict.stops() && !self.allow.contains(&verdict))
    }

    /// Whether a diagnostic stops this translation.
    pub fn refuses(&self, diagnostic: &Diagnostic) -> bool {
        match diagnostic.fault.gravity() {
            Gravity::Error => true,
            Gravity::Warning => false,
            Gravity::Verdict(verdict) => self.stops(verdict),
        }
    }
}

/// What became of a translation, whether its output may be used or not.
#[derive(Debug)]
pub struct Outcome {
    /// What was found, in the order in which it was found. Spans are places in the source.
    pub diagnostics: Vec<Diagnostic>,
    /// What was found so often that the rest of it is counted.
    pub counted: Vec<Counted>,
    /// The number that the output has as a program, if it has one.
    pub program_number: Option<u32>,
    /// Numbers that were put in for the target's machine: what, the source's number or name, and the
    /// target's.
    pub renumbered: BTreeSet<(Numbered, Text, Text)>,
    /// Which facts of the machines the assumptions among them rest on.
    pub rests: Vec<Rest>,
    /// Facts that the program does not state and that change its cut, the most dangerous first. They stop the
    /// translation, or were answered with ncc's own readings.
    pub questions: Vec<Question>,
    /// What a user types so that a refused program that computes goes through as straight blocks, if it does.
    pub straight: Option<Straight>,
    /// What the verification covered; `None` if it was not asked for or did not reach its end.
    pub verified: Option<Verified>,
    /// Whether the output may be used, and if not, why.
    pub release: Result<(), Failure>,
    /// The output. Empty or unfinished, and not to be used, if it is not released.
    pub output: Output,
    /// The output as a file for each use of a tool, in the order in which they are run; empty unless the target's options
    /// ask for that, and for a program without a tool change.
    pub files: Vec<ToolFile>,
    /// How many constructs came through with each verdict, in the order of [`Verdict::ALL`].
    pub counts: [u64; Verdict::ALL.len()],
    /// SHA-256 of the source's bytes.
    pub source_sha256: [u8; 32],
    /// Length of the source.
    pub source_bytes: u64,
    /// Blocks read from the source.
    pub blocks: u64,
}

/// What may be found in every block of a long program ([`Fault::is_of_a_word`]).
#[derive(Clone, Debug)]
pub struct Counted {
    /// The first of it.
    pub fault: Fault,
    /// How many are among the diagnostics.
    pub kept: u64,
    /// How many more there are.
    pub more: u64,
}

/// Of one code, so many diagnostics are kept; of very many, the number is enough.
const MOST_KEPT: u64 = 10_000;

impl Counted {
    /// Counts one more; whether it is kept.
    pub fn keeps(all: &mut Vec<Counted>, fault: &Fault) -> bool {
        if !fault.is_of_a_word() {
            return true;
        }
        let Some(own) = all.iter_mut().find(|own| own.fault.code() == fault.code()) else {
            all.push(Counted { fault: fault.clone(), kept: 1, more: 0 });
            return true;
        };
        let keeps = own.kept < MOST_KEPT;
        *(if keeps { &mut own.kept } else { &mut own.more }) += 1;
        keeps
    }
}

/// Whether the options of a target ask for a file for each use of a tool.
pub fn file_per_tool(to: &Settings) -> bool {
    to.dialect.can.change_by_hand && to.get(TOOL_CHANGE) == FILE_PER_TOOL
}

impl Failure {
    /// Its exit code.
    pub fn exit(self) -> Exit {
        match self {
            Failure::Refused => Exit::Refused,
            Failure::VerificationFailed => Exit::VerificationFailed,
        }
    }
}

impl Outcome {
    /// Whether open questions alone stop the translation.
    pub fn is_asked(&self, job: &Job) -> bool {
        self.release == Err(Failure::Refused)
            && !self.questions.is_empty()
            && !self.diagnostics.iter().any(|diagnostic| job.refuses(diagnostic))
    }

    /// Codes of which more were found than are kept, and how many more.
    pub fn further(&self) -> impl Iterator<Item = (String, u64)> {
        let more = self.counted.iter().filter(|counted| counted.more > 0);
        more.map(|counted| (format!("NC{:04}", counted.fault.code()), counted.more))
    }

    /// The exit code, by whether the output may be used.
    pub fn exit(&self) -> Exit {
        self.release.map_or_else(Failure::exit, |()| Exit::Done)
    }

    /// The name of the output's file; that of a standalone subprogram, for a control that finds them by their
    /// files, is the one by which its callers look for it.
    pub fn file_name(&self, machines: &Machines, to: &Dialect, source: &str) -> String {
        let called = self.output.called().and_then(|name| include_path::file_of(to, name));
        called.unwrap_or_else(|| machines.file_name(to, source, self.program_number))
    }

    /// How many constructs came through with a verdict.
    pub fn count(&self, verdict: Verdict) -> u64 {
        self.counts[verdict as usize]
    }
}

/// The program of one use of a tool, which is run by itself.
#[derive(Debug)]
pub struct ToolFile {
    /// The tool's number; `None` is the tool in the spindle.
    pub tool: Option<i64>,
    /// Its place among the files, from 1.
    pub number: usize,
    /// How many files there are.
    pub count: usize,
    /// First and last line of the source, where its tool changes follow one another.
    pub lines: Option<(u64, u64)>,
    /// Its text.
    pub output: Output,
}

impl ToolFile {
    /// Its name, by that of the whole: `part.nc` gives `part-2-T5.nc`. Names sort in the order of execution.
    pub fn name(&self, whole: &str) -> String {
        let digits = self.count.to_string().len();
        let (stem, extension) = match whole.rsplit_once('.') {
            Some((stem, extension)) if !stem.is_empty() => (stem, format!(".{extension}")),
            Some(_) | None => (whole, String::new()),
        };
        let tool = self.tool.map(|tool| format!("-T{tool}")).unwrap_or_default();
        format!("{stem}-{:0digits$}{tool}{extension}", self.number)
    }
}

/// A fact of a machine that an assumption rests on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rest {
    /// Which of the diagnostics.
    pub diagnostic: usize,
    /// Whose fact.
    pub side: Side,
    /// Its place in a profile.
    pub place: Place,
}

/// What a verification covered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verified {
    /// Generated worlds in which both programs were executed.
    pub worlds: u32,
    /// Settings of the block-skip switches that were tried in each; 1 for a program without.
    pub skip_settings: u32,
    /// Events compared, over all worlds and settings.
    pub events: u64,
}

/// Why an output is not released.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The program has errors, a loss is not allowed, or a question is open: exit code 1.
    Refused,
    /// Source and output were not shown to do the same: exit code 3.
    VerificationFailed,
}

/// How a refused program that computes can be translated: executed, and written as the resulting blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Straight {
    /// With `--pass flatten`.
    Flattened,
    /// The same, with the block-skip switch stated, on or off.
    Switch,
    /// The same, where the control ignores blocks without motion.
    WithoutMotion,
}

/// An output: its head, which can be written only when all the rest is known, and the rest.
#[derive(Debug)]
pub struct Output {
    /// What it is called by, where it is a standalone subprogram.
    called: Option<Text>,
    head: Vec<u8>,
    body: Spool,
    body_bytes: u64,
}

impl Output {
    /// An output without anything in it.
    pub fn new() -> Output {
        Output { called: None, head: Vec::new(), body: Spool::default(), body_bytes: 0 }
    }

    /// Says that it is a subprogram by itself, and what it is called by.
    pub fn set_called(&mut self, name: Text) {
        self.called = Some(name);
    }

    /// What it is called by, where it is a standalone subprogram.
    pub fn called(&self) -> Option<&str> {
        self.called.as_deref()
    }

    /// Adds to the body.
    ///
    /// # Errors
    /// The temporary file cannot be made or written.
    pub fn push(&mut self, text: &[u8]) -> io::Result<()> {
        self.body.write_all(text)?;
        self.body_bytes += text.len() as u64;
        Ok(())
    }

    /// Sets the text that goes before the body.
    pub fn set_head(&mut self, head: Vec<u8>) {
        self.head = head;
    }

    /// Lines of the text that goes before the body.
    pub fn head_lines(&self) -> usize {
        memchr::memchr_iter(b'\n', &self.head).count()
    }

    /// Length of the whole.
    pub fn bytes(&self) -> u64 {
        self.head.len() as u64 + self.body_bytes
    }

    /// Writes the whole, head first. May be called again.
    ///
    /// # Errors
    /// Reading the temporary file, or writing to `into`.
    pub fn write_to(&mut self, into: &mut dyn Write) -> io::Result<()> {
        into.write_all(&self.head)?;
        self.body.seek(SeekFrom::Start(0))?;
        let mut piece = vec![0; 1 << 16];
        loop {
            match self.body.read(&mut piece)? {
                0 => return Ok(()),
                n => into.write_all(&piece[..n])?,
            }
        }
    }

    /// The whole, in memory.
    ///
    /// # Errors
    /// Reading the temporary file.
    pub fn to_vec(&mut self) -> io::Result<Vec<u8>> {
        let mut all = Vec::with_capacity(self.bytes() as usize);
        self.write_to(&mut all)?;
        Ok(all)
    }
}

impl Default for Output {
    fn default() -> Output {
        Output::new()
    }
}
