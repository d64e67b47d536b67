//! Words: which address letters there are, what their words are, and how numbers are read and written.

use serde::Deserialize;

/// Kinds of quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Coordinates, radii, pecks.
    Length,
    /// Degrees.
    Angle,
    /// Feed.
    Feed,
    /// Spindle speed, rev/min.
    Speed,
    /// Seconds.
    Seconds,
    /// Milliseconds, always a whole number.
    Milliseconds,
    /// A whole number.
    Integer,
    /// A pure number.
    Factor,
}

/// How numbers of one kind are read and written.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NumberRules {
    /// Digits after the point that the control resolves, in mm, degrees or seconds.
    pub decimals: u8,
    /// The same, in inches; `None` if the unit makes no difference.
    pub decimals_inch: Option<u8>,
    /// Most digits that are written, at most 9; 8 if nothing is stated.
    pub digits: Option<u8>,
    /// What a number without a point counts.
    pub bare: Bare,
    /// Digits that a bare number is shifted by when it counts increments, in mm.
    pub increment: u8,
    /// The same, in inches.
    pub increment_inch: Option<u8>,
    /// Whether the point is written.
    pub point: PointRule,
    /// Whether a sign may be written.
    pub unsigned: bool,
}

/// What a number without a decimal point counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bare {
    /// Whole units, surely.
    #[default]
    Units,
    /// Whole units, as a working choice that is reported.
    UnitsUnsure,
    /// Least increments, unless the option `decimal_point` says otherwise; reported.
    Increments,
}

/// When a decimal point is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PointRule {
    /// Always: `X0.`
    Always,
    /// Always, but a zero that was written without stays so: `Z0`.
    ExceptZero,
    /// Only before digits: `F186`, `F12.5`.
    #[default]
    WhereNeeded,
    /// Never; the value is a whole number.
    Never,
}

/// An address letter.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Address {
    /// The letter.
    pub letter: char,
    /// What its word is, where no code of the block gives it another use.
    pub role: Role,
    /// What its number is.
    pub quantity: Quantity,
    /// Whether the row is confirmed.
    #[serde(default = "yes")]
    pub sure: bool,
    /// What the word does where no code of the block uses it, if that is not translated: the name
    /// by which it is refused.
    #[serde(default)]
    pub refuse: Option<String>,
    /// Whether the value may be a name in quotation marks.
    #[serde(default)]
    pub named: bool,
    /// Whether a point after a whole number is read where the quantity has none: no source says what the control does
    /// with it, and it can mean nothing else. Each program with one is reported.
    #[serde(default)]
    pub point_read: bool,
    /// Whether it is confirmed that entry 0 of a table is none.
    #[serde(default = "yes")]
    pub zero_sure: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// A coordinate of the axis of the same letter.
    Axis,
    /// The centre of an arc along X, Y, Z.
    CentreX,
    /// See [`Role::CentreX`].
    CentreY,
    /// See [`Role::CentreX`].
    CentreZ,
    /// The radius of an arc.
    Radius,
    /// Feed.
    Feed,
    /// Spindle speed.
    Speed,
    /// Tool number: selects.
    Tool,
    /// Entry of the length table, used by a code of the block.
    LengthEntry,
    /// Entry of the length table, applied by the word itself.
    Corrector,
    /// Entry of the radius table.
    RadiusEntry,
    /// Edge of the tool in the spindle: its length.
    ToolEdge,
    /// Number of a subprogram: calls it.
    Call,
    /// Only a parameter of codes that name it.
    Parameter,
}

pub(crate) fn yes() -> bool {
    true
}

/// What to do instead of something that is refused, where a name and a manual do not suffice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RefusalHelp {
    /// Post a pocket as moves: the control computes its path.
    Pocket,
    /// Delete the blocks that set and read a timer.
    Timer,
    /// Probe with a code that stops if nothing is touched.
    Probe,
}
