//! What a dictionary says of the state at power-on and of the safe start, and how it spells modes.

use ncc_ir::canon::{Distance, FeedMode, PathMode, Plane, ReturnLevel, Units};
use ncc_ir::program::CentreFrom;
use ncc_ir::program::cycle::Approach;
use serde::Deserialize;

/// State at power-on: what is assumed of a program that does not say.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[allow(missing_docs)] // The names are those of `ncc_ir::canon::Modes`.
pub struct PowerOn {
    pub units: Option<PowerOnFact<UnitsName>>,
    pub distance: Option<PowerOnFact<DistanceName>>,
    pub plane: Option<PowerOnFact<PlaneName>>,
    pub feed_mode: Option<PowerOnFact<FeedModeName>>,
    pub return_level: Option<PowerOnFact<ReturnLevelName>>,
    pub motion: Option<PowerOnFact<MotionName>>,
    pub work_offset: Option<PowerOnFact<u16>>,
    pub length_offset: Option<PowerOnFact<u32>>,
    pub no_origin_shift: Option<PowerOnFact<bool>>,
    /// How corners are taken by a program that never says it.
    pub path: Option<PowerOnFact<PathStart>>,
    /// From where the words of a centre are measured, where codes say it.
    pub centre: Option<PowerOnFact<CentreName>>,
}

/// A fact at power-on.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PowerOnFact<T> {
    /// What it is.
    pub value: T,
    /// Whether every such machine has it so; else it is one parameter's usual value, and a
    /// program that relies on it gets an assumption.
    #[serde(default)]
    pub always: bool,
    /// Of units: whether the sources know it of the machine, though not as its state at power-on, so that a program
    /// which never states them is not asked about them.
    #[serde(default)]
    pub of_the_machine: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

/// How a control takes corners that no program speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PathStart {
    /// Every block ends in an exact stop (G60 of a Sinumerik, G61 of others).
    ExactStop,
    /// Corners are rounded by the lag of the axes, a fraction of a millimetre at usual feeds (G64 of a Fanuc).
    Rounded,
    /// Corners are rounded up to a limit that a setting has.
    Within,
    /// Corners are rounded as far as the acceleration asks for, without a tolerance, rapids too (G64 of LinuxCNC).
    Blended,
}

impl PathStart {
    /// Its name in a dictionary.
    pub const fn name(self) -> &'static str {
        match self {
            PathStart::ExactStop => "exact-stop",
            PathStart::Rounded => "rounded",
            PathStart::Within => "within",
            PathStart::Blended => "blended",
        }
    }
}

/// What a written program states before its first event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // The names are those of `ncc_ir::canon::Modes`.
pub enum SafeStart {
    Units,
    Plane,
    Distance,
    FeedMode,
    NoCompensation,
    NoLengthOffset,
    NoCycle,
    /// In a block of its own.
    WorkOffset,
    /// Words of a centre from the start point.
    Centre,
}

macro_rules! names {
    ($( $(#[$doc:meta])* $name:ident => $target:ty { $($variant:ident),* } )*) => { $(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        #[allow(missing_docs)]
        pub enum $name { $($variant),* }

        impl From<$name> for $target {
            fn from(name: $name) -> $target {
                match name { $($name::$variant => <$target>::$variant),* }
            }
        }
    )* };
}

names! {
    /// A [`Units`] in a data file.
    UnitsName => Units { Mm, Inch }
    /// A [`Distance`] in a data file.
    DistanceName => Distance { Absolute, Incremental }
    /// A [`Plane`] in a data file.
    PlaneName => Plane { Xy, Zx, Yz }
    /// A [`FeedMode`] in a data file.
    FeedModeName => FeedMode { PerMinute, PerRevolution, InverseTime }
    /// A [`ReturnLevel`] in a data file.
    ReturnLevelName => ReturnLevel { Initial, Retract }
    /// An [`Approach`] in a data file.
    ApproachName => Approach { PlaneFirst, RaiseFirst, RetractFirst, ClearFirst }
    /// A [`PathMode`] in a data file.
    PathName => PathMode { ExactStop, ExactPath, Continuous }
    /// A [`CentreFrom`] in a data file.
    CentreName => CentreFrom { Start, Zero }
    /// A motion in a data file.
    MotionName => ncc_ir::canon::Motion { Traverse, Feed }
}

#[allow(clippy::derivable_impls)] // The macro makes the type.
impl Default for ApproachName {
    fn default() -> ApproachName {
        ApproachName::RaiseFirst
    }
}
