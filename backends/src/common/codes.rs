//! The words of a dictionary, looked up once.
//!
//! A row counts only if its word reads back to the same meaning, so every code here was found by
//! its meaning and checked by its number. Not here: when a word is written.

mod call;
mod cycle;
mod finder;

pub(crate) use call::CallCode;
pub(crate) use cycle::{CircleCode, CycleCode, GridCode};
use finder::Finder;
use ncc_dialects::{DataRow, Meaning, OrientWords, Quantity, Role, Settings, Thread};
use ncc_ir::canon::{
    AdviceKind, Axis, Distance, FeedMode, PathMode, Plane, ReturnLevel, Side, SpindleMode, Turn, Units,
};
use ncc_ir::program::{CentreFrom, Detour, FrameSlot, Probe, ReferencePoint, ToolValue};

use super::number::Format;

/// Longest code, with a word that belongs to it.
const LONGEST: usize = 12;

/// A G or M code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Code {
    text: [u8; LONGEST],
    len: u8,
    /// Letter of a word that belongs to it; 0 for none.
    pub letter: u8,
    /// One bit for its modal group, 0 for a one-shot.
    pub group: u64,
    /// What it means, if no source confirms it.
    pub unsure: Option<Meaning>,
}

impl Code {
    /// The text of a code without a word, with what fills it up, and its length.
    #[inline]
    pub(crate) fn padded(&self) -> (&[u8; 8], usize) {
        (self.text.first_chunk().unwrap_or(&[0; 8]), usize::from(self.len))
    }

    pub(crate) fn text(&self) -> &[u8] {
        &self.text[..usize::from(self.len)]
    }

    /// Whether it is a G code.
    pub(crate) fn is_g(&self) -> bool {
        self.text[0] == b'G'
    }
}

/// An address letter and the form of its numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Letter {
    pub letter: u8,
    pub format: Format,
}

/// A table that values are put into.
#[derive(Clone, Debug)]
pub(crate) struct DataCode {
    pub row: &'static DataRow,
    pub code: Code,
    /// Letter and number that say which table.
    pub select: (u8, u32),
    /// Letter of the entry.
    pub entry: u8,
    /// The word that turns a work offset.
    pub turn: Option<Letter>,
    /// Words of values of tools.
    pub values: Vec<(ToolValue, Letter)>,
}

/// A word that says how long to dwell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dwell {
    pub word: Letter,
    pub milliseconds: bool,
}

/// The code of advice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AdviceCode {
    pub kind: AdviceKind,
    /// Its value; without, a word of the block says it.
    pub value: Option<u8>,
    pub code: Code,
    /// Letter of that word, and the number for on.
    pub word: Option<(u8, u32)>,
    /// Letter of the length that belongs to it.
    pub amount: Option<Letter>,
}

/// The code of a probing move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProbeCode {
    pub code: Code,
    /// Whether it stays active.
    pub stays: bool,
    /// Whether its block must say a feed.
    pub own_feed: bool,
}

/// Codes that fill slots of the coordinate chain, with the letters of their own words.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FrameCodes {
    pub local: Option<Code>,
    pub origin: Option<Code>,
    pub position: Option<Code>,
    pub rotation: Option<(Code, Letter)>,
    pub no_rotation: Option<Code>,
    /// One factor for all axes, or one for each.
    pub scale: Option<(Code, Letter, [Letter; 3])>,
    pub no_scale: Option<Code>,
    pub mirror: Option<Code>,
    pub no_mirror: Option<Code>,
    /// A tilted plane with the letters of its turns and the axes about which they are, and the tool turned upright on it.
    pub tilt: Option<(Code, [Letter; 3], [Axis; 3])>,
    pub upright: Option<Code>,
}

/// Every word that can be written. `None` where the dialect has none.
#[derive(Clone, Debug)]
pub(crate) struct Codes {
    pub traverse: Option<Code>,
    pub feed: Option<Code>,
    pub arcs: [Option<Code>; 2],
    /// Threads, with the letters of their leads: one for all axes, or one for each.
    pub threads: Vec<(Thread, Code, Vec<Letter>)>,
    pub dwell: Option<(Code, Dwell)>,
    pub units: [Option<Code>; 2],
    pub distance: [Option<Code>; 2],
    pub plane: [Option<Code>; 3],
    pub feed_mode: [Option<Code>; 3],
    /// What a speed counts, and what a feed counts by the same code, where it says that as well.
    pub spindle_modes: Vec<(SpindleMode, Option<FeedMode>, Code)>,
    /// The code beside which the speed word is the highest speed.
    pub speed_limit: Option<Code>,
    /// The letter of the highest speed in the block of a surface speed.
    pub surface_limit: Option<Letter>,
    pub level: [Option<Code>; 2],
    /// By number of the work offset, less one.
    pub origins: Vec<Option<Code>>,
    /// No work offset.
    pub no_origin: Option<Code>,
    pub no_shift: Option<Code>,
    /// A G92 shift suspended, and restored.
    pub origin_shift: [Option<Code>; 2],
    /// What fills the slots of the coordinate chain.
    pub frames: FrameCodes,
    /// Applies a length with tool centre point control.
    pub tip: Option<Code>,
    pub no_compensation: Option<Code>,
    /// To the left, to the right.
    pub compensation: [Option<Code>; 2],
    /// The same by the diameter, and its word.
    pub compensation_by_diameter: [Option<(Code, Letter)>; 2],
    /// Entry of the table that has the radius.
    pub radius_entry: Option<Letter>,
    /// Whether compensation is by the tool's own entry where none is named.
    pub own_radius: bool,
    /// Machine coordinates without the tool's length, and with it.
    pub machine: [Option<Code>; 2],
    /// To reference points, with the letter that names a further one.
    pub references: Vec<(ReferencePoint, Code, Option<Letter>)>,
    /// Probing moves, each with whether its code stays active as a motion's does.
    pub probes: Vec<(Probe, ProbeCode)>,
    pub detours: [Option<Code>; 2],
    /// Tables that values are put into.
    pub tables: Vec<DataCode>,
    /// A length by its value: in place of the active one, added to it.
    pub stated_length: [Option<Code>; 2],
    /// Where the axes stand as stored position 1, 2.
    pub store_position: [Option<Code>; 2],
    /// The code that says the number of the tool in the spindle, and its word.
    pub tool_number: Option<(Code, Letter)>,
    pub length: Option<Code>,
    /// Whether it stands without a number, for the tool in the spindle.
    pub own_length: bool,
    pub no_length: Option<Code>,
    /// Centres are measured from the start point.
    pub centre_from_start: Option<Code>,
    /// Letter of an arc's turns.
    pub turns: Option<Letter>,
    pub end_cycle: Option<Code>,
    pub spindle_clockwise: Option<Code>,
    pub spindle_counterclockwise: Option<Code>,
    pub spindle_stop: Option<Code>,
    /// Makes the tapping cycle activated next a rigid one.
    pub rigid_tapping: Option<Code>,
    /// Stop of the spindle at the control's own angle, and the words of another one.
    pub orient: Option<Code>,
    pub orient_words: Option<&'static OrientWords>,
    pub orient_angles: Vec<Letter>,
    /// The code that rounds corners with a word that says how far from the path, and that word.
    pub path_within: Option<(Code, Letter)>,
    /// The letter of its second word, within which moves are made one.
    pub path_merged: Option<Letter>,
    /// Ways of taking corners, in the order of [`PathMode::ALL`].
    pub path: [Option<Code>; 11],
    pub exact_stop: Option<Code>,
    /// Points by radius and angle: off, on.
    pub polar: [Option<Code>; 2],
    pub advice: Vec<AdviceCode>,
    pub change_tool: Option<Code>,
    /// Functions of the machine, by name.
    pub machine_functions: Vec<(&'static str, Code)>,
    pub flood: Option<Code>,
    pub mist: Option<Code>,
    pub coolant_off: Option<Code>,
    pub stop: Option<Code>,
    pub optional_stop: Option<Code>,
    pub end: Option<Code>,
    pub again: Option<Code>,
    pub call: Option<CallCode>,
    /// A call with arguments.
    pub macro_call: Option<CallCode>,
    /// The same after every move, and the end of that.
    pub calls_at_moves: Option<(CallCode, Code)>,
    /// All words of a dwell in a block of its own.
    pub dwells: Vec<Dwell>,
    pub back: Option<Code>,
    pub no_effect: Vec<(String, Code)>,
    pub cycles: Vec<CycleCode>,
    pub circle: Option<CircleCode>,
    pub grid: Option<GridCode>,
    /// In the order of [`Axis::ALL`].
    pub axes: [Option<Letter>; 6],
    pub centre: [Option<Letter>; 3],
    pub radius: Option<Letter>,
    pub feed_word: Option<Letter>,
    pub speed: Option<Letter>,
    pub tool: Option<Letter>,
    /// Entry of the length table, for a code of the block.
    pub entry: Option<Letter>,
    /// Entry of the length table, applied by the word itself.
    pub corrector: Option<Letter>,
}

impl Codes {
    pub(crate) fn new(settings: &Settings) -> Codes {
        let dialect = settings.dialect;
        let mut groups: Vec<&str> = dialect.code.iter().map(|row| row.group.as_str()).collect();
        groups.sort_unstable();
        groups.dedup();
        let find = Finder { dialect, groups, counted_offsets: dialect.counted_offsets() };
        let code = |meaning| find.code(meaning);
        let last = match dialect.caps.frames.work_offsets {
            u16::MAX => 0,
            last => last,
        };
        let axis = |axis: Axis| {
            let row = dialect.address_row(axis.letter()).filter(|row| row.role == Role::Axis)?;
            find.letter(row.letter, row.quantity)
        };
        Codes {
            traverse: code(Meaning::StraightTraverse),
            feed: code(Meaning::StraightFeed),
            arcs: [Turn::Clockwise, Turn::Counterclockwise].map(|t| code(Meaning::ArcFeed(t))),
            threads: find.threads(),
            dwell: find.dwell_code(),
            units: [Units::Mm, Units::Inch].map(|u| code(Meaning::UseLengthUnits(u))),
            distance: [Distance::Absolute, Distance::Incremental].map(|d| code(Meaning::SetDistanceMode(d))),
            plane: [Plane::Xy, Plane::Zx, Plane::Yz].map(|p| code(Meaning::SelectPlane(p))),
            feed_mode: [FeedMode::PerMinute, FeedMode::PerRevolution, FeedMode::InverseTime]
                .map(|f| code(Meaning::SetFeedMode(f))),
            spindle_modes: find.spindle_modes(),
            speed_limit: find.speed_limit(),
            surface_limit: find.surface_limit(),
            level: [ReturnLevel::Initial, ReturnLevel::Retract].map(|l| code(Meaning::SetReturnLevel(l))),
            origins: (1..=last).map(|n| find.origin(n)).collect(),
            no_origin: code(Meaning::SetOriginOffsets(0)),
            no_shift: code(Meaning::ClearFrame(FrameSlot::Shift)),
            origin_shift: [false, true].map(|on| code(Meaning::UseOriginShift(on))),
            frames: find.frames(),
            tip: code(Meaning::UseToolCentrePoint(true)),
            no_compensation: code(Meaning::StopCutterRadiusCompensation),
            compensation: [Side::Left, Side::Right].map(|s| code(Meaning::StartCutterRadiusCompensation(s))),
            compensation_by_diameter: find.by_diameter(),
            radius_entry: find.role(Role::RadiusEntry),
            own_radius: dialect.caps.compensation.radii.tool,
            machine: find.machine(),
            references: find.references(),
            probes: find.probes(),
            detours: Detour::ALL.map(|detour| code(Meaning::Detour(detour))),
            tables: find.tables(),
            stated_length: [false, true].map(|added| code(Meaning::UseToolLength { added })),
            store_position: [1, 2].map(|place| code(Meaning::StorePosition(place))),
            tool_number: find.tool_number(),
            length: code(Meaning::UseToolLengthOffset),
            own_length: dialect.code_for(Meaning::UseToolLengthOffset).is_some_and(|row| row.own_tool),
            no_length: code(Meaning::CancelToolLengthOffset).or_else(|| find.no_edge()),
            centre_from_start: code(Meaning::SetCentreMode(CentreFrom::Start)),
            turns: dialect.arc.turns.and_then(|letter| find.letter(letter, Quantity::Integer)),
            end_cycle: code(Meaning::EndCycle),
            spindle_clockwise: code(Meaning::StartSpindleClockwise),
            spindle_counterclockwise: code(Meaning::StartSpindleCounterclockwise),
            spindle_stop: code(Meaning::StopSpindleTurning),
            rigid_tapping: code(Meaning::RigidTapping),
            orient: code(Meaning::OrientSpindle),
            orient_words: find.orient_words(),
            orient_angles: find.orient_angles(),
            path_within: find.path_within(),
            path_merged: find.path_merged(),
            path: PathMode::ALL.map(|(mode, _)| code(Meaning::SetMotionControlMode(mode))),
            exact_stop: code(Meaning::ExactStop),
            polar: [false, true].map(|on| code(Meaning::PolarWords(on))),
            advice: find.advice(),
            change_tool: code(Meaning::ChangeTool),
            machine_functions: find.machine_functions(),
            flood: code(Meaning::FloodOn),
            mist: code(Meaning::MistOn),
            coolant_off: code(Meaning::CoolantOff),
            stop: code(Meaning::ProgramStop),
            optional_stop: code(Meaning::OptionalProgramStop),
            end: code(Meaning::ProgramEnd),
            again: code(if dialect.program.begins_again { Meaning::Return } else { Meaning::BeginAgain }),
            call: find.call(Meaning::Call),
            macro_call: find.call(Meaning::CallMacro),
            calls_at_moves: find.call(Meaning::CallMacroAtMoves).zip(code(Meaning::EndCallsAtMoves)),
            dwells: find.dwells(),
            back: code(Meaning::Return),
            no_effect: find.no_effect(),
            cycles: find.cycles(settings),
            circle: find.circle(),
            grid: find.grid(),
            axes: Axis::ALL.map(axis),
            centre: [Role::CentreX, Role::CentreY, Role::CentreZ].map(|r| find.role(r)),
            radius: find.role(Role::Radius),
            feed_word: find.role(Role::Feed),
            speed: find.role(Role::Speed),
            tool: find.role(Role::Tool),
            entry: find.role(Role::LengthEntry),
            corrector: find.role(Role::Corrector),
        }
    }

    /// The code by which a speed counts this, where a feed counts that.
    pub(crate) fn spindle_mode(&self, mode: SpindleMode, feed: Option<FeedMode>) -> Option<Code> {
        let fits = |(of, with, _): &&(SpindleMode, Option<FeedMode>, Code)| {
            *of == mode && (with.is_none() || *with == feed)
        };
        self.spindle_modes.iter().find(fits).map(|(.., code)| *code)
    }

    /// Whether codes of what a speed counts say what a feed counts.
    pub(crate) fn spindle_with_feed(&self) -> bool {
        self.spindle_modes.iter().any(|(_, feed, _)| feed.is_some())
    }

    /// The code of a word without effect.
    pub(crate) fn code_without_effect(&self, name: &str) -> Option<Code> {
        self.no_effect.iter().find(|(own, _)| own == name).map(|(_, code)| *code)
    }

    /// The row of a cycle: of its kind, with a word for the dwell if and only if there is one.
    pub(crate) fn cycle(&self, kind: &str, dwell: bool) -> Option<&CycleCode> {
        self.cycles.iter().find(|c| c.kind == kind && c.dwell.is_some() == dwell)
    }
}
