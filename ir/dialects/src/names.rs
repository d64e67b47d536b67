//! Words of several letters, and cycles and patterns that are called by name with arguments in
//! parentheses.
//!
//! Not here: what a call's arguments amount to, which is lowering; and rows for letters.

use std::fmt;
use std::str::FromStr;

use ncc_ir::canon::RotaryWay;
use serde::Deserialize;

use crate::meaning::Meaning;
use crate::words::{Quantity, RefusalHelp};

/// A word of several letters: `TRANS`, `SUPA`, `CR`. It has a meaning of its own, or it is an
/// address with a value after `=`, or it is refused by a name.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NameRow {
    /// The word, in capitals. In a data file, a row may name several that are one, parted by a
    /// blank; the loader makes a row of each.
    pub name: String,
    /// What it means.
    #[serde(default)]
    pub means: Option<NameMeaning>,
    /// What its value is, if it is an address.
    #[serde(default)]
    pub role: Option<NameRole>,
    /// What the value counts.
    #[serde(default)]
    pub quantity: Option<Quantity>,
    /// The name by which it is refused.
    #[serde(default)]
    pub refuse: Option<String>,
    /// Where it is refused, what to do instead.
    #[serde(default)]
    pub help: Option<RefusalHelp>,
    /// Its modal group, shared with the codes; empty for one-shots and addresses.
    #[serde(default)]
    pub group: String,
    /// Whether empty brackets after a word that is refused say nothing: they return to the basic setting, which is
    /// active wherever nothing else has been stated.
    #[serde(default)]
    pub empty_brackets: bool,
    /// Whether the value 0 of an address that is refused says nothing: it is the basic setting.
    #[serde(default)]
    pub zero_is_none: bool,
    /// Whether arguments belong to a word without an effect, which go with it as they are written.
    #[serde(default)]
    pub arguments: bool,
    /// Whether it is written when several words mean the same.
    #[serde(default = "crate::words::yes")]
    pub write: bool,
    /// Whether the row is confirmed.
    #[serde(default = "crate::words::yes")]
    pub sure: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

/// What a word of several letters means: what a code can mean, or one of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(try_from = "String")]
pub enum NameMeaning {
    /// As a code.
    Code(Meaning),
    /// `SET_FRAME`: replaces the chain of frames; alone, it clears the chain.
    SetFrame(FrameWord),
    /// `ADD_FRAME`: appends to the chain of frames; alone, it clears the chain.
    AddFrame(FrameWord),
    /// `ARC_THROUGH`: motion, arc through an intermediate point.
    ArcThrough,
    /// `ARC_TANGENT`: motion, arc that goes on in the direction of the block before.
    ArcTangent,
    /// `CALL modal`: calls what follows after every block with path motion; alone, it ends that.
    CallModal,
    /// `MESSAGE`: text for the operator.
    Message,
    /// `REPEAT_BLOCKS`
    RepeatBlocks,
    /// `REPEAT_BLOCKS one`: of one block alone.
    RepeatBlock,
    /// `TURN_ROTARY_AXES`: before the parentheses of an angle, in which direction its axis goes there.
    TurnRotaryAxis(RotaryWay),
    /// `END_OF_REPEAT`: a label up to which blocks are repeated that no label is named for.
    EndOfRepeat,
}

/// What a word for a frame does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are those of `ncc_ir::program::FrameStep`.
pub enum FrameWord {
    Translate,
    Rotate,
    Scale,
    Mirror,
}

impl FrameWord {
    const ALL: [(FrameWord, &'static str); 4] = [
        (FrameWord::Translate, "translate"),
        (FrameWord::Rotate, "rotate"),
        (FrameWord::Scale, "scale"),
        (FrameWord::Mirror, "mirror"),
    ];

    fn named(name: &str) -> Option<FrameWord> {
        FrameWord::ALL.into_iter().find(|(_, n)| *n == name).map(|(word, _)| word)
    }

    const fn name(self) -> &'static str {
        FrameWord::ALL[self as usize].1
    }
}

impl TryFrom<String> for NameMeaning {
    type Error = String;

    fn try_from(text: String) -> Result<NameMeaning, String> {
        text.parse()
    }
}

impl fmt::Display for NameMeaning {
    /// As a data file spells it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NameMeaning::Code(meaning) => meaning.fmt(f),
            NameMeaning::SetFrame(word) => write!(f, "SET_FRAME {}", word.name()),
            NameMeaning::AddFrame(word) => write!(f, "ADD_FRAME {}", word.name()),
            NameMeaning::ArcThrough => f.write_str("ARC_THROUGH"),
            NameMeaning::ArcTangent => f.write_str("ARC_TANGENT"),
            NameMeaning::CallModal => f.write_str("CALL modal"),
            NameMeaning::Message => f.write_str("MESSAGE"),
            NameMeaning::RepeatBlocks => f.write_str("REPEAT_BLOCKS"),
            NameMeaning::RepeatBlock => f.write_str("REPEAT_BLOCKS one"),
            NameMeaning::TurnRotaryAxis(RotaryWay::Shortest) => f.write_str("TURN_ROTARY_AXES shortest"),
            NameMeaning::TurnRotaryAxis(RotaryWay::Positive) => f.write_str("TURN_ROTARY_AXES positive"),
            NameMeaning::TurnRotaryAxis(RotaryWay::Negative) => f.write_str("TURN_ROTARY_AXES negative"),
            NameMeaning::EndOfRepeat => f.write_str("END_OF_REPEAT"),
        }
    }
}

impl FromStr for NameMeaning {
    type Err = String;

    fn from_str(text: &str) -> Result<NameMeaning, String> {
        let frame = |name| FrameWord::named(name).ok_or_else(|| format!("no frame: {text}"));
        Ok(match text.split_once(' ').unwrap_or((text, "")) {
            ("SET_FRAME", name) => NameMeaning::SetFrame(frame(name)?),
            ("ADD_FRAME", name) => NameMeaning::AddFrame(frame(name)?),
            ("ARC_THROUGH", "") => NameMeaning::ArcThrough,
            ("ARC_TANGENT", "") => NameMeaning::ArcTangent,
            ("CALL", "modal") => NameMeaning::CallModal,
            ("MESSAGE", "") => NameMeaning::Message,
            ("REPEAT_BLOCKS", "") => NameMeaning::RepeatBlocks,
            ("REPEAT_BLOCKS", "one") => NameMeaning::RepeatBlock,
            ("TURN_ROTARY_AXES", "shortest") => NameMeaning::TurnRotaryAxis(RotaryWay::Shortest),
            ("TURN_ROTARY_AXES", "positive") => NameMeaning::TurnRotaryAxis(RotaryWay::Positive),
            ("TURN_ROTARY_AXES", "negative") => NameMeaning::TurnRotaryAxis(RotaryWay::Negative),
            ("END_OF_REPEAT", "") => NameMeaning::EndOfRepeat,
            _ => NameMeaning::Code(text.parse()?),
        })
    }
}

/// What the value of a named address is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NameRole {
    /// Radius of an arc, negative for more than 180 degrees.
    Radius,
    /// Opening angle of an arc.
    OpeningAngle,
    /// Full turns of an arc beyond the first.
    Turns,
    /// Intermediate point of an arc along X.
    ThroughX,
    /// Along Y.
    ThroughY,
    /// Along Z.
    ThroughZ,
    /// Angle of a rotation in the active plane.
    PlaneAngle,
    /// Distance before a corner where rounding begins.
    Rounding,
    /// The same in rapids.
    RoundingInRapids,
    /// Length from the pole.
    PolarRadius,
    /// Angle about the pole.
    PolarAngle,
    /// The angle of a line, of which one coordinate of the plane says where it ends.
    LineAngle,
    /// Highest speed of the spindle.
    SpindleLimit,
    /// Angle at which the spindle is stopped.
    SpindleAngle,
    /// Radius that rounds the corner after the block's move.
    RoundCorner,
    /// The same for every move from here on; 0 ends it.
    RoundCorners,
    /// How far before the corner after the block's move its chamfer begins.
    ChamferCorner,
    /// Length of that chamfer.
    ChamferCornerByLength,
}

/// A cycle or a pattern that is called by name with arguments.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CallRow {
    /// Its name, in capitals.
    pub name: String,
    /// What it is.
    pub kind: CallKind,
    /// Its parameters in the order of the arguments. Trailing arguments may be left out.
    pub parameters: Vec<Parameter>,
    /// Whether the control begins at the end, or corner, that is nearest to where the tool is;
    /// the order of the holes is that of the parameters only if the tool stands at the first.
    #[serde(default)]
    pub order_by_position: bool,
    /// Whether the row is confirmed.
    #[serde(default = "crate::words::yes")]
    pub sure: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

/// What a call is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CallKind {
    /// Cycle `drill`.
    Drill,
    /// Cycle `drill-dwell`.
    DrillDwell,
    /// Cycle `drill-peck` or `drill-break`, by [`ParameterRole::Way`].
    DrillPeck,
    /// Cycle `bore`.
    Bore,
    /// Cycle `tap`.
    Tap,
    /// Cycle `tap-rigid`.
    TapRigid,
    /// Cycle `bore-fine`.
    BoreFine,
    /// Cycle `bore-stop`.
    BoreStop,
    /// Pattern on a straight line.
    Line,
    /// Pattern on a circle.
    Circle,
    /// Pattern in rows, every second one backwards.
    Grid,
    /// Pattern of positions one after another.
    List,
}

impl CallKind {
    /// Cycles of the neutral program that it can say, by their names.
    pub const fn cycles(self) -> &'static [&'static str] {
        match self {
            CallKind::Drill => &["drill"],
            CallKind::DrillDwell => &["drill-dwell"],
            CallKind::DrillPeck => &["drill-peck", "drill-break"],
            CallKind::Bore => &["bore"],
            CallKind::Tap => &["tap"],
            CallKind::TapRigid => &["tap-rigid"],
            CallKind::BoreFine => &["bore-fine"],
            CallKind::BoreStop => &["bore-stop"],
            CallKind::Line | CallKind::Circle | CallKind::Grid | CallKind::List => &[],
        }
    }
}

/// A parameter of a call.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Its name in the maker's manual.
    pub name: String,
    /// What it is; without, an argument must be one of `neutral`, or is refused by `refuse`.
    #[serde(default)]
    pub role: Option<ParameterRole>,
    /// What it counts.
    #[serde(default)]
    pub quantity: Option<Quantity>,
    /// Values that change nothing; 0 and an empty argument count always.
    #[serde(default)]
    pub neutral: Vec<i64>,
    /// What is written for it where nothing is to be stated and an argument follows; else it is empty.
    #[serde(default)]
    pub write: Option<i64>,
    /// What another value does.
    #[serde(default)]
    pub refuse: Option<String>,
    /// Whether it is confirmed what its values mean.
    #[serde(default = "crate::words::yes")]
    pub sure: bool,
}

/// What an argument is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ParameterRole {
    /// Plane to which the tool returns, absolute.
    ReturnPlane,
    /// Reference plane, absolute; empty is 0.
    ReferencePlane,
    /// Safety distance above the reference plane, unsigned; empty is 0.
    SafetyDistance,
    /// Bottom, absolute.
    Depth,
    /// Bottom below the reference plane, unsigned; goes before the absolute one.
    RelativeDepth,
    /// Dwell at the bottom; of pecks, after each of them.
    Dwell,
    /// First depth, absolute.
    FirstDepth,
    /// First depth below the reference plane, unsigned.
    RelativeFirstDepth,
    /// Least depth of a peck where each is less than the one before; of pecks that are all alike it says nothing.
    LeastPeck,
    /// Dwell above the hole before each further peck.
    Settle,
    /// 0 breaks the chip, 1 clears it; of a grid 0 is all its positions, 1 those of its border.
    Way,
    /// The cycle's own plane: 0 the active one, 1 XY, 2 ZX, 3 YZ.
    WorkingPlane,
    /// Ones: how the depth is stated, 0 by its argument, 1 below the reference plane, 2 absolute. The rest must be one
    /// of `neutral`.
    DepthMode,
    /// A text that the input form shows, on which the hole does not depend.
    FormText,
    /// How far up to break the chip; empty or 0 is 1 mm.
    Lift,
    /// Dwell at the bottom; empty or 0 is as after each peck.
    LastDwell,
    /// Clearance above the last depth; empty or 0 is the control's own rule.
    Clearance,
    /// Feed into the hole.
    FeedIn,
    /// Feed out of it.
    FeedOut,
    /// Sense of the spindle: 3 or 4, as the codes of the machine.
    Sense,
    /// What the spindle does after the hole: 3, 4 or 5.
    After,
    /// Sense of the spindle on the way out of a thread: 3 or 4; 0 by itself.
    Back,
    /// Whether a thread is cut with an encoder (0), with feed and speed (1), or with a pitch and
    /// without an encoder (11).
    Encoder,
    /// Pitch of a thread by its nominal size in the metric series; negative for the left hand.
    ThreadSize,
    /// Pitch of a thread; negative for the left hand.
    ThreadPitch,
    /// Unit of the pitch: 0 as active, 1 millimetres.
    PitchUnit,
    /// Speed into the hole.
    Speed,
    /// Speed out of it; empty or 0 is the same.
    SpeedOut,
    /// Angle at which the spindle stops.
    Orientation,
    /// How far off the wall along the plane's first axis.
    ShiftFirst,
    /// Along its second axis.
    ShiftSecond,
    /// Along the drilling axis.
    ShiftNormal,
    /// Centre or start along the plane's first axis, absolute.
    First,
    /// Along its second axis.
    Second,
    /// Radius.
    Radius,
    /// Angle of the first hole, of the line, or of the rows; empty is 0.
    Angle,
    /// Angle from hole to hole; 0 or empty shares a full circle out.
    Step,
    /// Number of holes.
    Count,
    /// Distance of the first hole from the start.
    Offset,
    /// Distance from hole to hole.
    Pitch,
    /// Distance from column to column.
    ColumnPitch,
    /// Distance from row to row.
    RowPitch,
    /// Number of columns: holes of a row.
    Columns,
    /// Number of rows.
    Rows,
    /// A digit for each position: 1 absolute, 2 incremental along the first axis.
    FirstFlags,
    /// Along the second axis.
    SecondFlags,
    /// A position along the first axis; there are several such parameters.
    PointFirst,
    /// Along the second axis.
    PointSecond,
}

impl CallRow {
    /// Place of the parameter with a role, from 0.
    pub fn place(&self, role: ParameterRole) -> Option<usize> {
        self.parameters.iter().position(|p| p.role == Some(role))
    }
}

#[cfg(test)]
mod tests {
    use super::NameMeaning;

    #[test]
    fn every_meaning_of_a_name_is_written_as_it_is_read() {
        for row in crate::builtins().flat_map(|d| &d.name) {
            if let Some(meaning) = row.means {
                assert_eq!(meaning.to_string().parse::<NameMeaning>(), Ok(meaning));
            }
        }
    }
}
