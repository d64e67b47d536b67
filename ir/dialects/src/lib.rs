//! ncc-dialects: the words of each control, and their meaning.
//!
//! A dialect is a dictionary: a data file with a row for each word of the control, its meaning in the
//! neutral program, and its source. Front-ends and back-ends read the same rows, from word to meaning
//! and from meaning to word, so that they cannot drift apart. ncc never translates a word that the
//! dictionary lacks or refuses.
//!
//! ```text
//! [[code]]
//! code = "G83"
//! cycle = "drill-peck"
//! source = "the manual and its page"
//! ```
//!
//! Not here: lexing, lowering and layout.
mod behaviours;
mod caps;
mod check;
mod codes;
mod corners;
mod cycles;
mod derive;
mod fault;
mod formula;
mod functions;
mod load;
mod lookup;
mod meaning;
mod names;
mod power_on;
mod repeats;
mod schema;
mod settings;
mod stored;
mod variants;
mod words;

pub use behaviours::{BehaviourRow, Sureness};
pub use caps::ANGLE_RANGE;
pub use check::unknown::{UnknownKind, UnknownWord, near};
pub use codes::*;
pub use corners::{CornerRules, CornerWord};
pub use cycles::*;
pub use fault::{DialectError, DialectFault, Place, RowFault, Text, Unreadable};
pub use formula::{FormulaRules, FunctionName, Operator, RemainderRule, Statement};
pub use functions::{FunctionAnswer, FunctionCall, FunctionHost, FunctionRow, GivenBlock, RunFunctions};
pub use load::{builtin, builtin_ids, builtin_sha256, builtin_text, builtins, load, load_one, parse, renew};
pub use meaning::{Meaning, Thread};
pub use names::*;
pub use power_on::*;
pub use repeats::{PolarRules, REPEAT_COUNT, RepeatRules};
pub use schema::*;
pub use settings::{
    AFTER_MOTION, ARC_CENTRES, ARC_TOLERANCE, ARC_TOLERANCE_INCH, ARC_TOLERANCE_PART, ARC_WITHOUT_CENTRE,
    AT_ZERO, BLOCK_SKIP, BLOCK_WITHOUT_WAY, BORE_SHIFT, BREAK_LIFT, BY_HAND, CALCULATOR, CALL_DEPTH,
    CHANGE_IN_BLOCK, COMPUTED_DWELL, CYCLE_APPROACH, CYCLE_BESIDE_MOTION, DECIMAL_POINT, DWELL_UNIT,
    FILE_PER_TOOL, FIRST_TOOL, FROM_START, FROM_ZERO, FURTHER_POINT, INTEGER_FEED, LEFT_OUT, LOOKED_OVER,
    MACHINE_LENGTH, MACHINE_UNITS, MACHINE_WITHOUT_AXIS, MACRO_DEPTH, MOTION_CANCELS, MOTION_DRILLED,
    NO_RADIUS, NOTHING, PATH_TOLERANCE, PECK_CLEARANCE, PROGRAM_NAMES, RADIUS_UNSAID, REPEAT_WORD,
    RETURN_DISTANCE, RETURN_FIRST, RETURN_LAST, SPINDLE_ANGLE, STORED_POSITION, STRAIGHT_LINE, SettingError,
    Settings, TAP_DWELL, TAPPING, TOOL_CHANGE,
};
pub use stored::{DataKind, DataRow, RADIUS_DATA, SystemRow, SystemTerm, ValueName, ValueWord, VariableName};

pub use variants::{VariantBlock, VariantCan, VariantRow};
pub use words::{Address, Bare, NumberRules, PointRule, Quantity, RefusalHelp, Role};
