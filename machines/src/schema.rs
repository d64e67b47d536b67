//! The form of a profile: its tables, their keys, and what each takes.
//!
//! Every key may be left out or empty (`""`): not stated. Units are in the keys' descriptions;
//! lengths are millimetres and rates millimetres a minute, whatever unit the programs use.
//! A key that is not here is an error, and so is a value that its key does not take.

use std::collections::BTreeMap;

use ncc_dialects::{DistanceName, FeedModeName, MotionName, PlaneName, ReturnLevelName, UnitsName};
use serde::Deserialize;
use serde::de::Unexpected;
use toml::Spanned;

use crate::fact::Fact;
use crate::table::{Row, Stated, Table, Tell, Words, kebab, table};
use crate::takes::Takes;

/// A profile as its file has it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Schema {
    /// Its name on the command line. A profile in a file of its own has one.
    #[serde(default = "unnamed")]
    pub id: Spanned<String>,
    /// What it is, for people. A profile in a file of its own has one.
    #[serde(default)]
    pub title: String,
    /// The dialect of its control.
    pub dialect: Spanned<String>,
    /// Whether it stands for a kind of machine, not for one that somebody has measured.
    #[serde(default)]
    pub typical: bool,
    /// Anything else that a reader should know.
    #[serde(default)]
    pub notes: String,
    /// Sources that facts name by a short tag.
    #[serde(default)]
    pub sources: BTreeMap<Spanned<String>, String>,
    /// Options of the dialect's dictionary.
    #[serde(default)]
    pub options: BTreeMap<Spanned<String>, Fact<Choice>>,
    /// Rows of the dialect's dictionary, and other readings of it: whether it is so on this machine.
    /// A program that relies on what is not so is refused.
    #[serde(default)]
    pub confirmed: BTreeMap<Spanned<String>, Fact<bool>>,
    /// State at power-on.
    #[serde(default)]
    pub power_on: PowerOn,
    /// Rates along the path.
    #[serde(default)]
    pub rates: Rates,
    /// Times.
    #[serde(default)]
    pub times: Times,
    /// The spindle.
    #[serde(default)]
    pub spindle: Spindle,
    /// Axes.
    #[serde(default)]
    pub axis: Vec<Spanned<AxisRow>>,
    /// Tools.
    #[serde(default)]
    pub tool: Vec<Spanned<ToolRow>>,
    /// Edges of tools other than the first.
    #[serde(default)]
    pub edge: Vec<Spanned<EdgeRow>>,
    /// Work offsets.
    #[serde(default)]
    pub work_offset: Vec<Spanned<WorkOffsetRow>>,
    /// Programs.
    #[serde(default)]
    pub program: Vec<Spanned<ProgramRow>>,
    /// M codes of this machine.
    #[serde(default)]
    pub m_code: Vec<Spanned<MCodeRow>>,
    /// What variables of this machine's control hold.
    #[serde(default)]
    pub value: Vec<Spanned<ValueRow>>,
    /// The shop's choices for emitted programs.
    #[serde(default)]
    pub emit: Emit,
}

impl Schema {
    /// Every table with fixed keys, in the order of the schema; of those that may stand several
    /// times, each.
    pub(crate) fn rows(&self) -> Vec<Row> {
        fn row<T: Table>(table: &T) -> Row {
            Row { head: T::HEAD, about: T::ABOUT, facts: table.stated() }
        }
        let s = self;
        let mut rows = vec![row(&s.power_on), row(&s.rates), row(&s.times), row(&s.spindle)];
        rows.extend(s.axis.iter().map(|a| row(a.get_ref())));
        rows.extend(s.tool.iter().map(|t| row(t.get_ref())));
        rows.extend(s.edge.iter().map(|e| row(e.get_ref())));
        rows.extend(s.work_offset.iter().map(|w| row(w.get_ref())));
        rows.extend(s.program.iter().map(|p| row(p.get_ref())));
        rows.extend(s.m_code.iter().map(|m| row(m.get_ref())));
        rows.extend(s.value.iter().map(|v| row(v.get_ref())));
        rows.push(row(&s.emit));
        rows
    }

    /// Every fact: those of its tables, and those of options and rows of the dictionary.
    pub(crate) fn facts(&self) -> Vec<Stated> {
        let options = self.options.values().map(|choice| choice.tell("options"));
        let confirmed = self.confirmed.values().map(|yes| yes.tell("confirmed"));
        options.chain(confirmed).chain(self.rows().into_iter().flat_map(|row| row.facts)).collect()
    }
}

fn unnamed() -> Spanned<String> {
    Spanned::new(0..0, String::new())
}

/// The value of an option: a number or a word.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice(pub String);

impl<'de> Deserialize<'de> for Choice {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Choice, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Any {
            Whole(i64),
            Number(f64),
            Text(String),
        }
        let any = Any::deserialize(deserializer);
        let any = any.map_err(|_| {
            let expected = Takes::NumberOrWord.expected();
            serde::de::Error::invalid_type(Unexpected::Other("value"), &expected)
        })?;
        Ok(Choice(match any {
            Any::Whole(number) => number.to_string(),
            Any::Number(number) => number.to_string(),
            Any::Text(text) => text,
        }))
    }
}

impl Words for Choice {
    fn words(&self) -> String {
        self.0.clone()
    }
}

macro_rules! words {
    ($( $(#[doc = $about:literal])+ $name:ident { $( $(#[doc = $doc:literal])+ $variant:ident ),* } )*) => { $(
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum $name { $( $(#[doc = $doc])+ $variant ),* }

        impl Words for $name {
            fn words(&self) -> String {
                kebab(&format!("{self:?}"))
            }
        }
    )* };
}

words! {
    /// The function that takes the time of a tool change.
    ChangeOn {
        /// The change itself.
        Change,
        /// The selection of the tool.
        Select
    }
    /// Block numbers of emitted programs.
    BlockNumbers {
        /// None.
        Off,
        /// Those of the source.
        Keep,
        /// New ones.
        New
    }
    /// Line ends of emitted programs.
    LineEnds {
        /// Those of the source's first line.
        Keep,
        /// LF.
        Lf,
        /// CR LF.
        Crlf
    }
    /// Characters of emitted programs.
    Characters {
        /// ASCII without small letters.
        Capitals,
        /// ASCII.
        Ascii,
        /// ISO 8859-1.
        Latin1,
        /// All.
        Utf8
    }
    /// The shape of what cuts.
    ShapeName {
        /// A flat end.
        Flat,
        /// A ball.
        Ball,
        /// A flat end with round corners.
        BullNose,
        /// A point.
        Drill,
        /// A cone.
        Chamfer,
        /// A cone that grows upwards from an end with or without round corners.
        Taper,
        /// A ball on a thinner neck.
        Lollipop,
        /// A disc on a thinner neck.
        TSlot
    }
    /// What an M code does to the cut.
    Effect {
        /// Nothing.
        None
    }
    /// Blocks of a tool change.
    ToolChangeForm {
        /// Selection and change in one block.
        OneBlock,
        /// In two.
        TwoBlocks
    }
    /// Names of files.
    FileName {
        /// The source's name.
        Source,
        /// The program's number.
        ProgramNumber
    }
}

macro_rules! names_of_the_dictionary {
    ($($name:ty),*) => { $(
        impl Words for $name {
            fn words(&self) -> String {
                kebab(&format!("{self:?}"))
            }
        }
    )* };
}

names_of_the_dictionary!(UnitsName, DistanceName, PlaneName, FeedModeName, ReturnLevelName, MotionName);

table! {
    /// What is active when a program starts. A fact that is stated here holds and
    /// is no assumption.
    PowerOn "[power_on]" {
        /// Unit of length.
        units: UnitsName = Takes::OneOf(&["mm", "inch"]);
        /// From where words are measured.
        distance: DistanceName = Takes::OneOf(&["absolute", "incremental"]);
        /// Plane of arcs.
        plane: PlaneName = Takes::OneOf(&["xy", "zx", "yz"]);
        /// What F counts.
        feed_mode: FeedModeName = Takes::OneOf(&["per-minute", "per-revolution", "inverse-time"]);
        /// Where canned cycles leave the tool (G98 or G99).
        return_level: ReturnLevelName = Takes::OneOf(&["initial", "retract"]);
        /// What a block with axis words alone does.
        motion: MotionName = Takes::OneOf(&["traverse", "feed"]);
        /// Work offset; on a control that lacks it, the one of other controls that its only zero stands for (1 is G54).
        work_offset: u32 = Takes::Whole;
        /// Entry of the length table; 0 is none.
        length_offset: u32 = Takes::Whole;
        /// Whether no G92 shift is left over from an earlier program.
        no_origin_shift: bool = Takes::OneOf(&["true", "false"]);
    }
}

table! {
    /// Rates along the path.
    Rates "[rates]" {
        /// Rate of a rapid along its straight line, mm/min; where not stated, the axes' rates decide.
        rapid: f64 = Takes::AboveZero;
        /// Highest feed, mm/min.
        max_feed: f64 = Takes::AboveZero;
        /// How far the path may leave a corner, mm; 0 is an exact stop in every corner. A length that the program states wins over it.
        path_tolerance: f64 = Takes::FromZero;
        /// Whether every move ends in a stop, in a straight line too. A path mode that the program states wins over it.
        exact_stop: bool = Takes::OneOf(&["true", "false"]);
        /// Blocks with a move that the control knows beyond the one that it carries out; where not stated, the whole path.
        look_ahead: u32 = Takes::WholeAboveZero;
    }
}

table! {
    /// Times, in seconds.
    Times "[times]" {
        /// A tool change.
        tool_change: f64 = Takes::FromZero;
        /// The function that takes it.
        tool_change_on: ChangeOn = Takes::OneOf(&["change", "select"]);
        /// Until the spindle turns at its speed.
        spindle_start: f64 = Takes::FromZero;
        /// Until it stands.
        spindle_stop: f64 = Takes::FromZero;
        /// An M function, besides what it does.
        m_function: f64 = Takes::FromZero;
        /// Least time of a block with a move: what the control needs to prepare the next one.
        block: f64 = Takes::FromZero;
    }
}

table! {
    /// The spindle.
    Spindle "[spindle]" {
        /// Highest speed, rev/min.
        max_speed: f64 = Takes::AboveZero;
        /// Change of its speed, rev/min per second.
        acceleration: f64 = Takes::AboveZero;
    }
}

table! {
    /// An axis.
    AxisRow "[[axis]]" {
        /// Its letter.
        letter: String = Takes::OneOf(&["X", "Y", "Z", "A", "B", "C"]);
        /// Least and greatest machine coordinate, mm or degrees.
        travel: [f64; 2] = Takes::LowAndHigh;
        /// Rate in rapids, mm/min or degrees/min.
        rapid: f64 = Takes::AboveZero;
        /// Highest feed, mm/min or degrees/min.
        max_feed: f64 = Takes::AboveZero;
        /// Acceleration, mm/s² or degrees/s².
        acceleration: f64 = Takes::AboveZero;
        /// Jerk, mm/s³ or degrees/s³.
        jerk: f64 = Takes::AboveZero;
    }
}

table! {
    /// A tool.
    ToolRow "[[tool]]" {
        /// Its number.
        number: u32 = Takes::Whole;
        /// Its name, the same word on every machine: tools of two machines that have one name are one tool.
        name: String = Takes::Text;
        /// The entry of the length table that has its length; where not stated, the one with the tool's number. Not on a control whose tools have edges.
        length_entry: u32 = Takes::WholeAboveZero;
        /// Its length, mm: what that entry has, and edge 1 on a control whose tools have edges.
        length: f64 = Takes::Between { least: 0, most: 1_000_000 };
        /// The entry of the table of radii that has half of its diameter; where not stated, the one that has its length.
        radius_entry: u32 = Takes::WholeAboveZero;
        /// Its diameter, mm.
        diameter: f64 = Takes::FromZero;
        /// The shape of what cuts: of end mills, face mills, reamers and taps `flat`, `ball` or `bull-nose`; of drills, spot drills and countersinks `drill`; `chamfer` of a cone that ends flat or in a point; `taper` of an end mill that grows upwards; `lollipop` of a ball on a thinner neck, `t-slot` of a disc on one, as thick as `flute` says. Where not stated, a simulation guesses it.
        shape: ShapeName = Takes::OneOf(&["flat", "ball", "bull-nose", "drill", "chamfer", "taper", "lollipop", "t-slot"]);
        /// Radius of the corners of a bull nose or a taper, mm.
        corner: f64 = Takes::FromZero;
        /// Full angle of the point of a drill or of a chamfer mill; of a taper the angle between axis and side. Degrees.
        angle: f64 = Takes::AboveZero;
        /// Diameter of the end of a chamfer mill, mm; where not stated, it ends in a point.
        end_diameter: f64 = Takes::FromZero;
        /// Length of what cuts, from the tip, mm.
        flute: f64 = Takes::AboveZero;
        /// Diameter of the shank above the flutes, mm; it counts with `flute`, and is the neck of a lollipop or T-slot cutter.
        shank: f64 = Takes::AboveZero;
        /// Diameter of the holder, mm; it counts with `holder_from`.
        holder: f64 = Takes::AboveZero;
        /// How high above the tip the holder begins, mm.
        holder_from: f64 = Takes::AboveZero;
        /// Its place in the magazine.
        pocket: u32 = Takes::Whole;
    }
}

table! {
    /// An edge of a tool other than the first, of a program for a control whose tools have edges: which entry of this
    /// machine's length table has its length and its radius. Without a row it gets a free one, which is reported.
    EdgeRow "[[edge]]" {
        /// The tool's number on this machine.
        tool: u32 = Takes::WholeAboveZero;
        /// Its edge on the other machine.
        edge: u32 = Takes::WholeBetween { least: 2, most: 9 };
        /// The entry.
        length_entry: u32 = Takes::WholeAboveZero;
    }
}

table! {
    /// A work offset: program zero in machine coordinates.
    WorkOffsetRow "[[work_offset]]" {
        /// Its number; 1 is G54.
        number: u32 = Takes::WholeAboveZero;
        /// Its name, the same word on every machine: `vice-left`.
        name: String = Takes::Text;
        /// Along X, mm.
        x: f64 = Takes::Between { least: -1_000_000, most: 1_000_000 };
        /// Along Y, mm.
        y: f64 = Takes::Between { least: -1_000_000, most: 1_000_000 };
        /// Along Z, mm.
        z: f64 = Takes::Between { least: -1_000_000, most: 1_000_000 };
        /// About X, degrees.
        a: f64 = Takes::Between { least: -1_000_000, most: 1_000_000 };
        /// About Y, degrees.
        b: f64 = Takes::Between { least: -1_000_000, most: 1_000_000 };
        /// About Z, degrees.
        c: f64 = Takes::Between { least: -1_000_000, most: 1_000_000 };
    }
}

table! {
    /// A program that machines know by a common name: a row says that the program with this number is
    /// called so.
    ProgramRow "[[program]]" {
        /// Its number; on a control that calls by number, of at most as many digits as it has.
        number: u32 = Takes::WholeAboveZero;
        /// Its name: what a control calls it that calls by name. Small letters count as capitals.
        name: String = Takes::ProgramName;
    }
}

table! {
    /// An M code that this machine has and its dialect has not, or refuses. It is carried from one machine to
    /// another where both name the same function, and left out where it has no effect on the cut.
    MCodeRow "[[m_code]]" {
        /// The code as it is written; a row without it says nothing.
        code: String = Takes::MCode;
        /// Its function, the same word on every machine: `chip-conveyor-on`.
        function: String = Takes::FunctionName;
        /// In place of a function: that it has no effect on the cut. It is left out of a translation, and reported.
        effect: Effect = Takes::OneOf(&["none"]);
        /// Seconds that it takes.
        seconds: f64 = Takes::FromZero;
    }
}

table! {
    /// What a variable holds when a program starts, that programs of this machine read and never set. The output sets it
    /// itself, and it is reported.
    ValueRow "[[value]]" {
        /// The variable, as programs have it: `500`, `_tool_diameter`, `R5`.
        name: String = Takes::Text;
        /// What it holds.
        holds: f64 = Takes::Between { least: -1_000_000, most: 1_000_000 };
    }
}

table! {
    /// How programs for this machine are written.
    Emit "[emit]" {
        /// Whether blanks stand between words.
        blanks: bool = Takes::OneOf(&["true", "false"]);
        /// Block numbers.
        block_numbers: BlockNumbers = Takes::OneOf(&["off", "keep", "new"]);
        /// The first of new block numbers.
        first_number: u32 = Takes::WholeBetween { least: 0, most: 99_999 };
        /// The step of new block numbers.
        number_step: u32 = Takes::WholeBetween { least: 1, most: 99_999 };
        /// Digits after the point of lengths in mm: at most those that the control has. What is finer is rounded, and reported.
        decimals: u32 = Takes::Whole;
        /// The same, of lengths in inches.
        decimals_inch: u32 = Takes::Whole;
        /// Line ends.
        line_ends: LineEnds = Takes::OneOf(&["keep", "lf", "crlf"]);
        /// Characters.
        characters: Characters = Takes::OneOf(&["capitals", "ascii", "latin1", "utf8"]);
        /// Lines of comment at the beginning, after the one that ncc writes.
        header: Vec<String> = Takes::Lines;
        /// Lines of comment before the end of the program.
        footer: Vec<String> = Takes::Lines;
        /// Whether a tool is selected and changed in one block or in two.
        tool_change: ToolChangeForm = Takes::OneOf(&["one-block", "two-blocks"]);
        /// What a file is named by, where `-o` names a folder.
        file_name: FileName = Takes::OneOf(&["source", "program-number"]);
        /// Extension of files, without the dot.
        extension: String = Takes::Extension;
        /// Whether names of files are in capitals.
        upper_case: bool = Takes::OneOf(&["true", "false"]);
    }
}
