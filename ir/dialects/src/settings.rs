//! A dialect with the choices made for its options.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use ncc_exec::Increments;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::Units;
use ncc_ir::caps::Caps;
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::geometry::arc_solver::{ArcRule, MOST_SHORT};
use ncc_ir::program::cycle::Approach;

use crate::Quantity;
use crate::caps::{ANGLE_RANGE, TURN};
use crate::cycles::{AskedDwell, CycleRow, DWELLS, DwellWord};
use crate::derive;
use crate::power_on::{PowerOnFact, UnitsName};
use crate::repeats::REPEAT_COUNT;
use crate::schema::{Dialect, UNKNOWN};
use crate::stored::SystemRow;

/// Option of a dictionary: the approach to the holes of a cycle. Its value `retract` is
/// [`Approach::RetractFirst`], any other one the dictionary's own way.
pub const CYCLE_APPROACH: &str = "cycle_approach";

/// Option of a dictionary: what tapping is without a code that makes it rigid, `chuck` or `rigid`.
pub const TAPPING: &str = "tapping";

/// Option of a dictionary: what becomes of the dwell of a rigid tapping cycle, during which spindle and drilling axis stand.
pub const TAP_DWELL: &str = "tap_dwell";

/// Value of [`TAP_DWELL`]: it is left out, and reported.
pub const LEFT_OUT: &str = "left-out";

/// Option of a dictionary whose dwells count by a point: what a dwell counts that is computed, `seconds` or
/// `milliseconds`.
pub const COMPUTED_DWELL: &str = "computed_dwell";

/// Option of a dictionary: where the block-skip switch stands, `switch` (either way), `on` or `off`.
pub const BLOCK_SKIP: &str = "block_skip";

/// Option of a dictionary: what a dimension without a decimal point counts, `increment` (the least one) or `calculator`.
pub const DECIMAL_POINT: &str = "decimal_point";

/// Value of [`DECIMAL_POINT`]: whole units.
pub const CALCULATOR: &str = "calculator";

/// Value of [`DECIMAL_POINT`]: whole units for a feed, least increments for everything else.
pub const INTEGER_FEED: &str = "integer-feed";

/// Option of a dictionary: by which of two codes of distance in one block the words of a return to a reference point are
/// read, the `last` one or the `first`.
pub const RETURN_DISTANCE: &str = "return_distance";

/// Value of [`RETURN_DISTANCE`]: the first one.
pub const RETURN_FIRST: &str = "first";

/// Value of [`RETURN_DISTANCE`]: the last one.
pub const RETURN_LAST: &str = "last";

/// Option of a dictionary: how deep calls may go within one another.
pub const CALL_DEPTH: &str = "call_depth";

/// Option of a dictionary: how deep calls of macros may go within one another, those of subprograms not counted.
pub const MACRO_DEPTH: &str = "macro_depth";

/// Option of a dictionary: what a cycle's code does in a block with G00 or G01: it drills, or the motion cancels it.
pub const CYCLE_BESIDE_MOTION: &str = "cycle_beside_motion";

/// Value of [`CYCLE_BESIDE_MOTION`]: the hole is drilled.
pub const MOTION_DRILLED: &str = "drilled";

/// Value of [`CYCLE_BESIDE_MOTION`]: the axes move by the code of motion, and no cycle is active.
pub const MOTION_CANCELS: &str = "cancelled";

/// Option of a dictionary: whether a tool is changed before or after the axes of its block move.
pub const CHANGE_IN_BLOCK: &str = "change_in_block";

/// Value of that option: the block's axes move first.
pub const AFTER_MOTION: &str = "after-motion";

/// Option of a dictionary: what a tool change is on a control that has none, [`BY_HAND`], [`FILE_PER_TOOL`] or refused; or
/// a code of a variant.
pub const TOOL_CHANGE: &str = "tool_change";

/// Value of [`TOOL_CHANGE`]: a block of its own that stops the program.
pub const BY_HAND: &str = "manual";

/// Value of [`TOOL_CHANGE`]: a program of its own for each use of a tool.
pub const FILE_PER_TOOL: &str = "file-per-tool";

/// Option of a dictionary: from where the words of an arc's centre are measured where the program has not said it, from
/// the `start` of the arc or from program `zero`.
pub const ARC_CENTRES: &str = "arc_centres";

/// Value of [`ARC_CENTRES`]: the start of the arc.
pub const FROM_START: &str = "start";

/// Value of [`ARC_CENTRES`]: program zero.
pub const FROM_ZERO: &str = "zero";

/// Option of a dictionary: what the words of dwells count, `seconds` or `milliseconds`.
pub const DWELL_UNIT: &str = "dwell_unit";

/// Option of a dictionary: where a position that is stored in the control is: `zero`, the machine's zero.
pub const STORED_POSITION: &str = "stored_position";

/// Option of a dictionary: where the second and further reference points are: `zero`, the machine's zero.
pub const FURTHER_POINT: &str = "further_point";

/// Option of a dictionary: whether the tool's length counts in a block of machine coordinates.
pub const MACHINE_LENGTH: &str = "machine_length";

/// Option of a dictionary: what cutter radius compensation does where no entry of a radius has been programmed.
pub const RADIUS_UNSAID: &str = "radius_without_d";

/// Value of [`RADIUS_UNSAID`]: the moves go without compensation.
pub const NO_RADIUS: &str = "none";

/// Option of a dictionary: what machine coordinates do in a block without an axis word.
pub const MACHINE_WITHOUT_AXIS: &str = "g53_without_axis";

/// Value of [`MACHINE_WITHOUT_AXIS`]: no axis moves.
pub const NOTHING: &str = "nothing";

/// Value of these options: the machine's zero.
pub const AT_ZERO: &str = "zero";

/// Option of a dictionary: number of the tool that waits at the start of the program for the first M06; 0 is none.
pub const FIRST_TOOL: &str = "first_tool";

/// Option of a dictionary: what a block without a way does to a compensated contour.
pub const BLOCK_WITHOUT_WAY: &str = "block_without_way";

/// Value of [`BLOCK_WITHOUT_WAY`]: the control looks over it, to the next move in the plane.
pub const LOOKED_OVER: &str = "looked-over";

/// Option of a dictionary: clearance of its peck cycle.
pub const PECK_CLEARANCE: &str = "peck_clearance";

/// Option of a dictionary: lift of its chip-breaking cycle.
pub const BREAK_LIFT: &str = "break_lift";

/// Name of the option that says in which unit a machine keeps its own lengths.
pub const MACHINE_UNITS: &str = "machine_units";

/// Option of a dictionary: the letter of the number of repetitions in a cycle's block.
pub const REPEAT_WORD: &str = "repeat_word";

/// Option of a dictionary: how subprograms with a name are written, by `numbers` or by `names`.
pub const PROGRAM_NAMES: &str = "program_names";

/// Option of a dictionary: what an arc without centre and radius is.
pub const ARC_WITHOUT_CENTRE: &str = "arc_without_centre";

/// Value of [`ARC_WITHOUT_CENTRE`]: a straight line to the end point.
pub const STRAIGHT_LINE: &str = "line";

/// Option of a dictionary: the difference of an arc's radii at start and end that the control accepts, in mm.
pub const ARC_TOLERANCE: &str = "arc_tolerance";

/// Option of a dictionary: the same in a program in inches, in inches.
pub const ARC_TOLERANCE_INCH: &str = "arc_tolerance_inch";

/// Option of a dictionary: the part of a radius up to which that difference is accepted too.
pub const ARC_TOLERANCE_PART: &str = "arc_tolerance_part";

/// Option of a dictionary: how far from the path plain rounding of corners goes on this machine, in mm; 0 is not stated.
pub const PATH_TOLERANCE: &str = "path_tolerance";

/// Option: which way a fine boring cycle takes the tool off the wall, by the sign and the first or second axis of the
/// plane.
pub const BORE_SHIFT: &str = "bore_shift";

/// Option: the angle at which the spindle stops where nothing else is stated, in degrees.
pub const SPINDLE_ANGLE: &str = "spindle_angle";

/// A dialect and the values of its options.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The dictionary, as the options make it.
    pub dialect: &'static Dialect,
    /// The dictionary as it was before any option was chosen.
    plain: &'static Dialect,
    /// The units at power-on, as they are stated for this run.
    units: Option<Units>,
    chosen: BTreeMap<String, String>,
    /// Whole numbers that variables hold at the start, as the user states them, by their names.
    values: BTreeMap<String, i64>,
}

/// An option that the dialect does not have, or a value that the option does not take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SettingError {
    /// No option of that name.
    NoOption(String),
    /// The option takes other values.
    NoValue {
        /// The option.
        option: String,
        /// What it takes; empty if any number from 0.
        values: Vec<String>,
    },
}

/// Most digits after the point of a number that an option takes.
const MOST_DIGITS: usize = 9;

/// Whether a text is a number from 0, in digits with or without a point: what options in numbers are.
fn is_amount(text: &str) -> bool {
    let (whole, part) = text.split_once('.').unwrap_or((text, ""));
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    digits(whole)
        && digits(part)
        && part.len() <= MOST_DIGITS
        && text.parse::<f64>().is_ok_and(f64::is_finite)
}

impl Settings {
    /// The dialect with the working choice for every option.
    pub fn new(dialect: &'static Dialect) -> Settings {
        Settings { dialect, plain: dialect, units: None, chosen: BTreeMap::new(), values: BTreeMap::new() }
    }

    /// Puts another dictionary in the place of this one: the same with rows of the user's.
    pub fn change(&mut self, with: impl FnOnce(&'static Dialect) -> &'static Dialect) {
        self.plain = with(self.plain);
        self.derive();
    }

    /// Finds the dictionary again as the options make it.
    fn derive(&mut self) {
        self.dialect = derive::chosen(self.plain, |option| self.get(option).to_owned());
        if self.get(DWELL_UNIT) == "milliseconds" && self.is_chosen(DWELL_UNIT) {
            self.dialect = in_milliseconds(self.dialect);
        }
        if let Some(units) = self.units {
            self.dialect = with_units(self.dialect, units);
        }
    }

    /// Chooses a value.
    ///
    /// # Errors
    /// The dialect has no such option, or it does not take the value.
    pub fn choose(&mut self, option: &str, value: &str) -> Result<(), SettingError> {
        let row = self.dialect.option.iter().find(|o| o.name == option);
        let row = row.ok_or_else(|| SettingError::NoOption(option.to_owned()))?;
        let fits = match row.values.is_empty() {
            true => is_amount(value),
            false => row.values.iter().any(|v| v == value),
        };
        if !fits {
            return Err(SettingError::NoValue { option: option.to_owned(), values: row.values.clone() });
        }
        self.chosen.insert(option.to_owned(), value.to_owned());
        self.derive();
        Ok(())
    }

    /// States the whole number that a variable holds at the start, by its name without signs: `8`, `_td`.
    pub fn state_value(&mut self, name: &str, value: i64) {
        self.values.insert(name.to_owned(), value);
    }

    /// The whole number that a variable is stated to hold at the start.
    pub fn stated_value(&self, name: &str) -> Option<i64> {
        self.values.get(name).copied()
    }

    /// The same of the variable by which a program asks this of the control, and the variable's name.
    pub fn stated_of(&self, asked: &System) -> Option<(String, i64)> {
        if self.values.is_empty() {
            return None;
        }
        let name = self.variable_of(asked)?;
        let value = self.stated_value(&name)?;
        Some((name, value))
    }

    /// The name, without signs, of the variable by which a program asks this of the control.
    pub fn variable_of(&self, asked: &System) -> Option<String> {
        let rows = self.dialect.system.iter().filter(|row| row.counts(self));
        rows.flat_map(SystemRow::says).find(|(says, _)| says == asked).map(|(_, name)| name.to_string())
    }

    /// Whether such a number is stated of any variable.
    pub fn states_values(&self) -> bool {
        !self.values.is_empty()
    }

    /// Whether the dictionary has this value for an option.
    pub fn takes(&self, option: &str, value: &str) -> bool {
        let mut rows = self.dialect.option.iter().filter(|row| row.name == option);
        rows.any(|row| row.values.iter().any(|own| own == value))
    }

    /// Chooses a value for an option of which the dictionary may not take it: to see what a program would be under it.
    pub fn suppose(&mut self, option: &str, value: &str) {
        self.chosen.insert(option.to_owned(), value.to_owned());
    }

    /// States the units at power-on, as a profile does: a fact of the machine, which is not assumed. Gives `false`
    /// where every such control has others.
    pub fn state_units(&mut self, units: Units) -> bool {
        if let Some(row) = self.dialect.power_on.units.as_ref().filter(|row| row.always) {
            return Units::from(row.value) == units;
        }
        self.units = Some(units);
        self.derive();
        true
    }

    /// How deep calls may go within one another by this option: at most on any such control, and on each of them. `None`
    /// where the dictionary does not say it.
    pub fn call_depth(&self, option: &str) -> Option<[u32; 2]> {
        let row = self.dialect.option.iter().find(|row| row.name == option)?;
        let chosen = self.chosen.get(option).and_then(|value| value.parse().ok());
        let all = || row.values.iter().filter_map(|value| value.parse().ok());
        chosen.map(|chosen| [chosen; 2]).or_else(|| Some([all().max()?, all().min()?]))
    }

    /// The value of an option: the chosen one, else the working choice; empty if there is no such
    /// option.
    pub fn get(&self, option: &str) -> &str {
        match self.chosen.get(option) {
            Some(value) => value,
            None => self.dialect.option.iter().find(|o| o.name == option).map_or("", |o| &o.default),
        }
    }

    /// The approach to the holes of a cycle.
    pub fn approach(&self) -> Approach {
        match self.get(CYCLE_APPROACH) {
            "retract" => Approach::RetractFirst,
            _ => self.dialect.cycles.approach.into(),
        }
    }

    /// The word of a cycle's dwell, if it has one as the options are.
    pub fn dwell(&self, row: &CycleRow) -> Option<DwellWord> {
        let asked = row.dwell_by.as_ref().filter(|asked| self.get(&asked.option) == DWELLS);
        row.dwell.or_else(|| asked.map(AskedDwell::word))
    }

    /// The letter of the number of repetitions in a cycle's block: the option's, else the dictionary's own.
    pub fn repeat_word(&self) -> Option<char> {
        self.get(REPEAT_WORD).chars().next().or(self.dialect.cycles.repeat)
    }

    /// Which arcs the control accepts, as the options are.
    pub fn arc_rule(&self) -> ArcRule {
        let rules = &self.dialect.arc;
        let stated = |option, otherwise: f64| self.get(option).parse::<f64>().unwrap_or(otherwise);
        let nanos = |mm: f64| (mm * ONE as f64).round() as Nanos;
        let mm = stated(ARC_TOLERANCE, rules.tolerance);
        let inch = match rules.tolerance_inch {
            Some(inch) => stated(ARC_TOLERANCE_INCH, inch) * 25.4,
            None => mm,
        };
        let tolerance = match (mm == 0.0, rules.zero_untested) {
            (true, true) => None,
            (true, false) => ArcRule::default().tolerance,
            (false, _) => Some([nanos(mm), nanos(inch)]),
        };
        ArcRule {
            tolerance,
            relative: nanos(stated(ARC_TOLERANCE_PART, rules.relative)),
            of_larger: rules.relative_to_larger,
            limit: i64::from(rules.limit),
            least: nanos(rules.least_radius).max(ArcRule::UNTESTED.least),
            short: match rules.short_radius {
                Some(short) => [nanos(short).min(MOST_SHORT); 2],
                None => tolerance.unwrap_or([MOST_SHORT; 2]).map(|t| t.min(MOST_SHORT)),
            },
        }
    }

    /// Whether a subprogram with a name is written by it.
    pub fn writes_names(&self) -> bool {
        self.dialect.program.names && self.get(PROGRAM_NAMES) == "names"
    }

    /// Whether a tool change leaves the spindle stopped, as the control or this machine has it.
    pub fn change_stops_spindle(&self) -> bool {
        self.behaviours().surely(Behaviour::SpindleAtChange)
    }

    /// What codes do besides their names, as the control or this machine has it.
    pub fn behaviours(&self) -> Behaviours {
        let mut all = self.dialect.caps.behaviours;
        for (at, behaviour) in &self.dialect.index.behaviour {
            let row = &self.dialect.option[usize::from(*at)];
            let value = self.chosen.get(&row.name).unwrap_or(&row.default);
            if value != UNKNOWN
                && self.dialect.caps.behaviours.is_open(*behaviour)
                && let Some(value) = behaviour.value(value)
            {
                all.set(*behaviour, value, false);
            }
        }
        all
    }

    /// The value of an option that takes a length, mm.
    pub fn length(&self, option: &str) -> Option<Num> {
        let text = self.get(option);
        let (whole, part) = text.split_once('.').unwrap_or((text, ""));
        let mantissa: i64 = format!("{whole}{part}").parse().ok()?;
        (part.len() < 10)
            .then(|| Num { mantissa, scale: part.len() as u8, point: true, unit: Unit::Mm }.trimmed())
    }

    /// The least increments of the control, where digits below them may not count.
    pub fn fine_increments(&self) -> Option<Increments> {
        let behaviours = self.behaviours();
        if !behaviours.does(Behaviour::FineDigits) && !behaviours.is_open(Behaviour::FineDigits) {
            return None;
        }
        let lengths = self.dialect.numbers(Quantity::Length);
        let inch = lengths.increment_inch.unwrap_or(lengths.increment);
        let degree = self.dialect.numbers(Quantity::Angle).increment;
        Some(Increments { mm: lengths.increment, inch, degree })
    }

    /// What the dialect can say, as its options are.
    pub fn caps(&self) -> Caps {
        let mut caps = self.dialect.caps.clone();
        if let Some(approach) = &mut caps.holes.approach {
            *approach = self.approach();
        }
        let asked = |row: &&CycleRow| row.dwell.is_none() && self.dwell(row).is_some();
        for row in self.dialect.cycle.iter().filter(asked) {
            let same = caps.holes.cycles.iter_mut().filter(|cap| cap.kind == row.kind);
            same.for_each(|cap| cap.dwell = true);
        }
        if self.writes_names() {
            caps.flow.call_digits = 0;
        }
        let turn = self.get(ANGLE_RANGE) == TURN;
        if let Some(computes) = caps.flow.computes.as_mut().filter(|computes| computes.turn != turn) {
            Arc::make_mut(computes).turn = turn;
        }
        caps.behaviours = self.behaviours();
        caps.tools.change_stops_spindle = self.change_stops_spindle();
        caps.flow.repeat_count_known = self.is_chosen(REPEAT_COUNT);
        caps.arcs.rule = self.arc_rule();
        caps
    }

    /// Whether the user chose it, so that relying on it is no assumption of ours.
    pub fn is_chosen(&self, option: &str) -> bool {
        self.chosen.contains_key(option)
    }
}

/// A dictionary of which all dwells in seconds count milliseconds. Each is made once and lives as long as the process.
fn in_milliseconds(dialect: &'static Dialect) -> &'static Dialect {
    static MADE: Mutex<Vec<(&'static Dialect, &'static Dialect)>> = Mutex::new(Vec::new());
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, derived)) = made.iter().find(|(own, _)| std::ptr::eq(*own, dialect)) {
        return derived;
    }
    let mut derived = dialect.clone();
    let count = |quantity: &mut Quantity| {
        if *quantity == Quantity::Seconds {
            *quantity = Quantity::Milliseconds;
        }
    };
    for row in &mut derived.code {
        row.dwell.iter_mut().for_each(|word| count(&mut word.quantity));
    }
    for row in &mut derived.cycle {
        row.dwell.iter_mut().for_each(|word| count(&mut word.quantity));
    }
    derived.address.iter_mut().for_each(|row| count(&mut row.quantity));
    let derived: &'static Dialect = Box::leak(Box::new(derived));
    made.push((dialect, derived));
    derived
}

/// A dictionary of which the units at power-on are stated. Each is made once and lives as long as the process.
fn with_units(dialect: &'static Dialect, units: Units) -> &'static Dialect {
    static MADE: Mutex<Vec<(&'static Dialect, Units, &'static Dialect)>> = Mutex::new(Vec::new());
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let found = made.iter().find(|(own, stated, _)| std::ptr::eq(*own, dialect) && *stated == units);
    if let Some((.., derived)) = found {
        return derived;
    }
    let value = match units {
        Units::Mm => UnitsName::Mm,
        Units::Inch => UnitsName::Inch,
    };
    let mut derived = dialect.clone();
    derived.power_on.units =
        Some(PowerOnFact { value, always: true, of_the_machine: false, source: "command line".to_owned() });
    let derived: &'static Dialect = Box::leak(Box::new(derived));
    made.push((dialect, units, derived));
    derived
}

impl SystemRow {
    /// Whether it counts, as options are chosen.
    pub fn counts(&self, settings: &Settings) -> bool {
        self.option.is_empty() || settings.get(&self.option) == self.when
    }
}
