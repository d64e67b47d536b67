//! The form of a dictionary.
//!
//! Every row that gives a word a meaning names its `source`; `sure = false` marks what no manual or
//! measurement confirms, and ncc reports it for each program that uses such a row.

use crate::words::{Address, NumberRules, Quantity, Role};
use std::collections::BTreeMap;

use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::caps::Caps;
use serde::Deserialize;

use crate::behaviours::BehaviourRow;
use crate::codes::{CodeIndex, CodeRow};
use crate::corners::CornerRules;
use crate::cycles::{CycleRow, CycleRules, PatternRow};
use crate::formula::FormulaRules;
use crate::functions::{FunctionHost, FunctionRow};
use crate::meaning::Meaning;
use crate::names::{CallRow, NameRow, ParameterRole};
use crate::power_on::{PathName, PowerOn, SafeStart};
use crate::repeats::{PolarRules, RepeatRules};
use crate::stored::{DataRow, SystemRow};
use crate::variants::VariantRow;

/// A dialect's dictionary.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dialect {
    /// Its name on the command line.
    pub id: String,
    /// What it is, for people.
    pub title: String,
    /// The dialect that it builds on: what this file does not say is as that one has it.
    #[serde(default)]
    pub base: Option<String>,
    /// A dialect of which this one is about a part: a text that both explain is taken for one of that, and where the two
    /// readings differ the user is asked.
    #[serde(default)]
    pub part_of: Option<String>,
    /// Which reader and writer it has; the base's, if it builds on one.
    pub family: Family,
    /// Usual file extensions, the first one for writing; without the dot.
    #[serde(default)]
    pub extensions: Vec<String>,
    /// Sources that rows name by a short tag.
    #[serde(default)]
    pub sources: BTreeMap<String, String>,
    /// The frame of a program.
    #[serde(default)]
    pub program: ProgramRules,
    /// Comments.
    #[serde(default)]
    pub comment: CommentRules,
    /// Blocks.
    #[serde(default)]
    pub block: BlockRules,
    /// Numbers, by kind of quantity.
    #[serde(default)]
    pub number: BTreeMap<Quantity, NumberRules>,
    /// Address letters.
    #[serde(default)]
    pub address: Vec<Address>,
    /// Arcs.
    #[serde(default)]
    pub arc: ArcRules,
    /// Rounded and chamfered corners, of a control that has letters for them.
    #[serde(default)]
    pub corner: CornerRules,
    /// Blocks that are executed again, of a control that has letters for that.
    #[serde(default)]
    pub repeat: RepeatRules,
    /// Points by radius and angle, of a control that has letters for them.
    #[serde(default)]
    pub polar: PolarRules,
    /// What a program computes with, of a control that has variables.
    #[serde(default)]
    pub formula: FormulaRules,
    /// What all canned cycles share.
    #[serde(default)]
    pub cycles: CycleRules,
    /// Canned cycles.
    #[serde(default)]
    pub cycle: Vec<CycleRow>,
    /// Patterns of positions.
    #[serde(default)]
    pub pattern: Vec<PatternRow>,
    /// G and M codes.
    #[serde(default)]
    pub code: Vec<CodeRow>,
    /// Tables that a program puts values into.
    #[serde(default)]
    pub data: Vec<DataRow>,
    /// What a program can ask of the control, by number or name of a parameter.
    #[serde(default)]
    pub system: Vec<SystemRow>,
    /// Words of several letters.
    #[serde(default)]
    pub name: Vec<NameRow>,
    /// Cycles and patterns that are called by name with arguments.
    #[serde(default)]
    pub call: Vec<CallRow>,
    /// State at power-on.
    #[serde(default)]
    pub power_on: PowerOn,
    /// What a written program states before its first event, in this order.
    #[serde(default)]
    pub safe_start: Vec<SafeStart>,
    /// Parameters that the sources do not settle, each with a default.
    #[serde(default)]
    pub option: Vec<OptionRow>,
    /// What codes do besides their names.
    #[serde(default)]
    pub behaviour: Vec<BehaviourRow>,
    /// Rows that hold where options are chosen so.
    #[serde(default)]
    pub variant: Vec<VariantRow>,
    /// Custom functions that programs of the user process, by their codes.
    #[serde(default)]
    pub functions: BTreeMap<String, FunctionRow>,
    /// Capabilities that follow from no other row.
    #[serde(default)]
    pub can: Can,
    /// Runs the programs of `functions`; `None` where nobody has agreed to that: no key of a dictionary.
    #[serde(skip)]
    pub function_host: Option<FunctionHost>,
    /// Capabilities, all of them; filled by the loader.
    #[serde(skip)]
    pub caps: Caps,
    /// Rows of `code` by letter and number; filled by the loader.
    #[serde(skip)]
    pub index: CodeIndex,
}

/// Which reader and writer a dialect has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// Letters and numbers.
    Word,
    /// The canonical functions.
    Canon,
    /// The text form of the IR.
    Ir,
    /// Words and names in blocks, with a grammar of its own.
    Sinumerik,
}

/// A variable that no program defines: one of the control's definition files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElsewhereRow {
    /// Its name, in capitals.
    pub name: String,
    /// Its assignments have no effect on the cut, and are left out.
    pub left_out: bool,
}

/// The frame of a program's text.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ProgramRules {
    /// A line that stands before and after the program, such as `%`; empty for none.
    pub frame: String,
    /// Letter of the program number; `None` if the text has none.
    pub number: Option<char>,
    /// Another character that may stand for that letter when reading.
    pub number_also: Option<char>,
    /// Whether the main program is written without a number, and the number is a comment.
    pub unnumbered_main: bool,
    /// Whether the number 0 of the main program stands for one that it gets at the control.
    pub zero_unnumbered: bool,
    /// Whether the control skips text before the mark: the leader of a tape, with feed (zero bytes).
    pub leader: bool,
    /// Whether a mark after the end of a program counts for nothing where none stands before it.
    pub mark_behind_end: bool,
    /// A line that counts for nothing wherever it stands, such as `%`; empty for none. It is not written.
    pub ignored: String,
    /// Whether a call writes the number with the least digits as well, because it is a name.
    pub padded_calls: bool,
    /// Least digits of a written program number.
    pub number_digits: usize,
    /// Whether a program may have a name in place of a number: `<PART-1>`, called by the same after the code of a
    /// call. `<O12>` is the program with that number.
    pub names: bool,
    /// Whether the comment after the number is a title.
    pub title: bool,
    /// Whether further programs in the text are subprograms.
    pub subprograms: bool,
    /// Whether the control has variables, expressions and jumps (macro language). Where there are none,
    /// their signs are no words at all.
    pub macros: bool,
    /// Whether they mean what those of a custom macro B mean: then they are read; else they are refused.
    pub macro_b: bool,
    /// Whether they are those of RS274/NGC with O words: parameters with numbers and names, `o100 sub`,
    /// `o<name> call`, `o110 while [...]`. Then they are read; else they are refused.
    pub o_words: bool,
    /// Words that make the control's own flow of a block that begins with the program number: `sub`,
    /// `call`, `while`. Such a block is refused.
    pub flow: Vec<String>,
    /// Digits of the program number in a call word that packs the count in front; 0 if it does not.
    pub packed_call_digits: u32,
    /// Whether a return that names a block goes on there in its own program; else it returns, to that block of the
    /// caller.
    pub returns_within: bool,
    /// Whether a return in the main program has it begin again, for ever; else that is refused.
    pub begins_again: bool,
    /// Names of the files in which called programs are looked for, without what stands after the point, in
    /// this order: `{}` is the program's name, `{4}` its number with at least so many digits.
    pub called: Vec<String>,
    /// The extension of files that hold a subprogram alone, without the dot, where the control knows them by it.
    pub sub_extension: Option<String>,
    /// Programs whose calls are left out, as the user states: no key of a dictionary.
    #[serde(skip)]
    pub calls_left_out: Vec<String>,
    /// Variables of definition files, in capitals, as the user states them: no key of a dictionary.
    #[serde(skip)]
    pub variables_elsewhere: Vec<ElsewhereRow>,
    /// The manual and its page, or another source.
    pub source: String,
}

impl ProgramRules {
    /// Letter of the main program's number, where it is written.
    pub fn main_number(&self) -> Option<char> {
        self.number.filter(|_| !self.unnumbered_main)
    }
}

/// Comments.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CommentRules {
    /// What opens one.
    pub open: String,
    /// What closes one; empty if the line's end does.
    pub close: String,
    /// A sign besides, after which the rest of the line is a comment; only read.
    pub line: String,
    /// How a comment begins that is a message to the operator: `MSG,`. Capitals and small letters are
    /// the same.
    pub message: String,
    /// How comments begin that show their text as well, and put values of parameters into it: one without
    /// a `#` is a message, another is refused.
    pub shown: Vec<String>,
    /// How a comment begins that ends the program with an alarm, and its text; empty for none.
    pub alarm: String,
    /// How comments begin that write to a file and do nothing else: they are plain comments in the output.
    pub logs: Vec<String>,
    /// How comments begin that do something else, which is not translated.
    pub active: Vec<String>,
    /// Whether only capitals, digits and simple signs can be shown.
    pub upper_ascii: bool,
    /// Characters besides capitals, digits and the blank that can be shown, where `upper_ascii`.
    pub signs: String,
    /// Longest comment when writing, in characters; 0 for no limit. Longer ones are continued.
    pub longest: usize,
    /// The manual and its page, or another source.
    pub source: String,
}

/// Blocks.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BlockRules {
    /// Whether words are written with blanks between them.
    pub blanks: bool,
    /// A sign that may end a block when reading, before the line's end; empty for none.
    pub end: String,
    /// Whether a letter without a number means zero.
    pub omitted_zero: bool,
    /// Whether a number may have any digits after its point: those that no control resolves are rounded, and reported.
    pub any_digits: bool,
    /// Most G codes in a block; 0 for no limit.
    pub g_codes: u8,
    /// Most M codes in a block; 0 for no limit.
    pub m_codes: u8,
    /// Letter of the block number.
    pub number: Option<char>,
    /// Whether the block number can only be the first word.
    pub number_first: bool,
    /// Whether a feed counts in the units that were active before the block, also if the block
    /// changes them.
    pub feed_before_units: bool,
    /// Whether a block can have a dwell and a straight move, which comes after it.
    pub dwell_before_move: bool,
    /// Whether the spindle and the coolant are switched off before the block's move; else after it.
    pub off_before_move: bool,
    /// Whether a tool change comes before the move of its block, whatever their order in the text. Elsewhere that is
    /// the machine's: the change gets a block of its own when writing, and an option says what it does when reading.
    pub change_first: bool,
    /// What marks a block with block skip; empty if there is no such thing.
    pub skip: String,
    /// Highest skip level that can be written after the mark; 1 means the mark alone. Where the
    /// plain mark is the digit 0, level 10 is the digit 1.
    pub skip_levels: u8,
    /// Whether a word can say by itself that it is absolute or incremental: `X=IC(5)`.
    pub qualifiers: bool,
    /// Whether the skip rows are confirmed.
    pub skip_unsure: bool,
    /// Longest block when reading, in bytes.
    pub longest: u32,
    /// Most characters of a block without blanks and comments, of a control that counts these; 0 for no such limit.
    pub longest_bare: u32,
    /// The manual and its page, or another source.
    pub source: String,
}

/// Arcs.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ArcRules {
    /// Whether centre words are measured from program zero; else from the start point.
    pub centre_absolute: bool,
    /// Whether a third axis makes a helix.
    pub helix: bool,
    /// Whether an arc must have a word of its end in its plane, so that a full circle has one too.
    pub end_needed: bool,
    /// Whether a word of the centre along the third axis is passed over; else it is refused as one without use.
    pub centre_outside_ignored: bool,
    /// The same of such a word that is zero (`K0` in the XY plane).
    pub centre_outside_zero: bool,
    /// Letter of the number of turns, the first one, full or not, counted.
    pub turns: Option<char>,
    /// Whether a centre from program zero needs both its words; else one that is missing is zero.
    pub centre_complete: bool,
    /// Difference of the radii at start and end, in mm, that is always accepted; 0 is the control's own way, which is not
    /// known, unless `zero_untested`. The option `arc_tolerance` states another.
    pub tolerance: f64,
    /// The same in a program in inches, in inches; `None` if it is the same length. Option `arc_tolerance_inch`.
    pub tolerance_inch: Option<f64>,
    /// A difference up to this part of a radius is accepted too; 0 is none. Option `arc_tolerance_part`.
    pub relative: f64,
    /// Whether that is a part of the larger radius; else of the one at the start.
    pub relative_to_larger: bool,
    /// A difference above so many times the tolerance is never accepted; 0 is no such limit.
    pub limit: u32,
    /// Whether a tolerance of 0 means that the control does not test the radii.
    pub zero_untested: bool,
    /// Least radius at either end, in mm; 0 is a millionth.
    pub least_radius: f64,
    /// By how much half the chord may exceed a stated radius, in mm; `None` is the tolerance.
    pub short_radius: Option<f64>,
    /// The manual and its page, or another source.
    pub source: String,
}

/// A parameter that the sources do not settle.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OptionRow {
    /// Its name: `g25_xy`.
    pub name: String,
    /// The choices; empty if any number is one.
    #[serde(default)]
    pub values: Vec<String>,
    /// The working choice.
    pub default: String,
    /// What it decides.
    pub doc: String,
    /// The manual and its page, or another source.
    pub source: String,
}

/// Capabilities that follow from no other row.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Can {
    /// A length offset must stand in a block with a Z word.
    pub offset_with_z: bool,
    /// A length offset takes effect at once and moves nothing: the tool stands at another Z. An incremental
    /// Z, a cycle, or a new zero of Z before the next absolute one is then not what it is on a control that
    /// takes the length up with the next Z, and is refused.
    pub length_at_once: bool,
    /// A change of units within a program is written in a block of its own.
    pub units_alone: bool,
    /// A code of what the feed counts ends the feed even where it counts that already: the next cut needs a new one.
    pub feed_ends_with_mode: bool,
    /// A boring cycle that stops the spindle is an error of the control unless the spindle turns, and a tapping cycle unless
    /// it turns as the tap goes in.
    pub cycles_need_spindle: bool,
    /// G41 or G42 of the active side may be programmed again without G40: the contour before it ends at a right angle to
    /// its last move, and the block goes on from there in the control's own way. Of other controls it is an error.
    pub compensation_again: bool,
    /// Cutter radius compensation goes as LinuxCNC's interpreter does it: a corner of less than 0.05 rad is
    /// neither gone round nor cut short, and the first move after the contour leads to the programmed point of the
    /// plane even if it has words of none of its axes. Of others it is assumed that every corner is gone
    /// round, and that the first move with such words leads there, where the path has to be computed.
    pub contour_left_at_once: bool,
    /// Canned cycles are driven through every point, whatever path mode is active (LinuxCNC's G61): no corner of
    /// theirs is rounded. It counts for times alone.
    pub cycles_in_exact_path: bool,
    /// Plain rounding of corners (G64) goes as far from the path as the acceleration asks for, without a tolerance. Else
    /// it is bounded, by a setting or by the lag of the axes.
    pub rounds_freely: bool,
    /// Every structure is expanded, every axis named.
    pub flat: bool,
    /// Grids are written only up to this many columns and rows.
    pub grid_upto: u32,
    /// Circles are written only with the centre at program zero and under the tool.
    pub circle_centre_at_zero_only: bool,
    /// A subprogram's positions may depend on the modes of its caller.
    pub inherits_motion: bool,
    /// How corners are always taken, if there is no word for it.
    pub only_path: Option<PathName>,
    /// A length, and its end, are commands of axes: neither a move nor the word of another axis stands beside them.
    pub length_alone: bool,
    /// A tool is changed by hand, where the option `tool_change` is `manual`: a block of its own stops the spindle,
    /// switches coolant off, goes to machine zero along Z, names the tool and stops the program. Where it is
    /// `file-per-tool`, each use of a tool is a program of its own. The control knows no lengths of tools: the operator
    /// sets the zero of Z by the tool that is put in.
    pub change_by_hand: bool,
    /// No other zero may be set while a rotation, factors or a mirror are active, and no mirror inside
    /// a rotation or factors.
    pub frames_shut: bool,
    /// Any structure of the IR can be carried (the text form).
    pub everything: bool,
}

/// The value of an option that leaves a behaviour open.
pub const UNKNOWN: &str = "unknown";

impl Dialect {
    /// What codes do besides their names, as the rows have it.
    pub fn behaviours(&self) -> Behaviours {
        let mut all = Behaviours::default();
        for row in &self.behaviour {
            if let Some((behaviour, value)) = row.meaning() {
                all.set(behaviour, value, row.open);
                let others = row.others.iter().filter_map(|name| behaviour.value(name));
                all.set_others(behaviour, others.fold(0, |bits, value| bits | 1 << value));
            }
        }
        all
    }

    /// The row of a behaviour.
    pub fn behaviour_row(&self, behaviour: Behaviour) -> Option<&BehaviourRow> {
        self.behaviour.iter().find(|row| row.name == behaviour.name())
    }

    /// The row of a G or M code given in tenths.
    #[inline]
    pub fn code_row(&self, letter: u8, tenths: u32) -> Option<&CodeRow> {
        let table = if letter == b'G' { &self.index.g } else { &self.index.m };
        table.get(tenths as usize).copied().flatten().map(|row| &self.code[row as usize])
    }

    /// The row that is written for a meaning.
    pub fn code_for(&self, meaning: Meaning) -> Option<&CodeRow> {
        self.index.meaning.get(&meaning).map(|at| &self.code[usize::from(*at)])
    }

    /// The row of a code of several work offsets, of which a word of the block says one.
    pub fn counted_offsets(&self) -> Option<&CodeRow> {
        self.code.iter().find(|row| row.write && row.count.is_some())
    }

    /// The row of an address letter.
    #[inline]
    pub fn address_row(&self, letter: u8) -> Option<&Address> {
        let at = letter.checked_sub(b'A')?;
        self.index.letter.get(at as usize).copied().flatten().map(|row| &self.address[row as usize])
    }

    /// Whether calls of cycles state the plane to which they return.
    pub fn states_return_planes(&self) -> bool {
        self.call.iter().any(|row| row.place(ParameterRole::ReturnPlane).is_some())
    }

    /// Whether the control rounds corners from power-on.
    pub fn starts_rounding(&self) -> bool {
        self.power_on.path.as_ref().is_some_and(|path| path.value != crate::power_on::PathStart::ExactStop)
    }

    /// The letter that has a role.
    pub fn letter_for(&self, role: Role) -> Option<char> {
        self.address.iter().find(|a| a.role == role).map(|a| a.letter)
    }

    /// The number rules of a quantity.
    pub fn numbers(&self, quantity: Quantity) -> NumberRules {
        self.number.get(&quantity).copied().unwrap_or_default()
    }

    /// The cycle row of a code.
    pub fn cycle_row(&self, code: &str) -> Option<&CycleRow> {
        self.cycle.iter().find(|row| row.code == code)
    }

    /// The pattern row of a code.
    pub fn pattern_row(&self, code: &str) -> Option<&PatternRow> {
        self.pattern.iter().find(|row| row.code() == code)
    }

    /// The row of a word of several letters, which must be in capitals.
    pub fn name_row(&self, name: &str) -> Option<&NameRow> {
        self.name.iter().find(|row| row.name == name)
    }

    /// The custom function of a G or M code given in tenths, with its name.
    pub fn function(&self, letter: u8, tenths: u32) -> Option<(&str, &FunctionRow)> {
        let found = self.functions.iter().find(|(name, _)| is_code(name, letter, tenths));
        found.map(|(name, row)| (name.as_str(), row))
    }

    /// The custom function whose blocks a G or M code given in tenths ends, with its name.
    pub fn function_ended(&self, letter: u8, tenths: u32) -> Option<(&str, &FunctionRow)> {
        let ends = |row: &FunctionRow| row.until.as_ref().is_some_and(|code| is_code(code, letter, tenths));
        self.functions.iter().find(|(_, row)| ends(row)).map(|(name, row)| (name.as_str(), row))
    }

    /// The row of a call, whose name must be in capitals.
    pub fn call_row(&self, name: &str) -> Option<&CallRow> {
        self.call.iter().find(|row| row.name == name)
    }
}

/// Whether a name is the code of a letter and a number in tenths.
fn is_code(name: &str, letter: u8, tenths: u32) -> bool {
    crate::codes::tenths(name) == Some((letter, tenths as usize))
}
