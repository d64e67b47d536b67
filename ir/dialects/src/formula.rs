//! Expressions of a control: its variables, operators and functions, read from `[formula]` of a dialect file.
//!
//! ```text
//! #1=ATAN[#2]/[#3]    fanuc        R1=ATAN2(R2,R3)    siemens
//! ```
//!
//! Not here: parsing (`ncc_frontends`), emitting (`ncc_backends`), and the capabilities that passes read (`caps`).

use std::collections::BTreeMap;

use ncc_ir::computed::computes::{ComputeFeature, Handed, Named, Remainders};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Function, Var};
use serde::Deserialize;

/// Table `[formula]` of a dialect. ncc refuses each operator and function that is missing here.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FormulaRules {
    /// Optional statements that the control has.
    pub statements: Vec<Statement>,
    /// Operators, each with its word: `+`, `MOD`, `EQ`.
    pub operators: BTreeMap<Operator, String>,
    /// Functions written in front of their arguments, each with its word.
    pub functions: BTreeMap<FunctionName, String>,
    /// Functions of two values with the word between them, all in brackets: `(R1 B_AND 7)`. They bind less tightly
    /// than sums and more tightly than `and`.
    pub between: BTreeMap<FunctionName, String>,
    /// Numbers for which the operator `modulo` gives the remainder. ncc expands the remainder of other numbers.
    pub remainders: RemainderRule,
    /// Operators in groups of equal priority, the tightest first.
    pub priority: Vec<Vec<Operator>>,
    /// Opening bracket: `[` or `(`.
    pub open: String,
    /// Closing bracket.
    pub close: String,
    /// Whether several arguments share one pair of brackets: `ATAN2(a,b)`. Otherwise each has its brackets:
    /// `ATAN[a]/[b]`.
    pub together: bool,
    /// Mark before the name of a variable: `#`.
    pub variable: String,
    /// Marks around the computed number of a variable and around array indices: `[` and `]` of `R[R1+1]`. The control
    /// rounds such a number to a whole one.
    pub index: Option<[String; 2]>,
    /// The empty variable: `#0`. `None` if the control has none.
    pub vacant: Option<String>,
    /// Letter before the number of a numbered variable: `R` of `R101`.
    pub prefix: String,
    /// Sign between an address and an expression: `=` of `X=R1+2`. Empty if the control wants brackets: `X[#1+2.]`.
    pub behind: String,
    /// Word that negates a condition: `NOT`.
    pub not: Option<String>,
    /// Text that negates a condition in brackets where conditions are numbers: `EQ 0` on LinuxCNC.
    pub not_behind: Option<String>,
    /// Operator for a remainder that is never negative: `MOD` on LinuxCNC.
    pub remainder: Option<String>,
    /// Function that tests whether a named variable has a value: `EXISTS`.
    pub exists: Option<String>,
    /// Tolerance of comparisons, as decimal text: `0.000001`. `None` compares exactly.
    pub equal_within: Option<String>,
    /// Decimals to which a computed number must be whole, in words that count and in computed variable numbers.
    pub whole: Option<u8>,
    /// Opening and closing sign of a name: `<>` of `#<name>`.
    pub name_signs: String,
    /// Whether newer series read `POW[a,b]` as a power. ncc does not emit it.
    pub power: bool,
    /// Whether comparisons treat nearly equal real numbers as equal.
    pub near: bool,
    /// Whether a word rounds a computed value to its least increment.
    pub rounds: bool,
    /// Whether blocks in loops and after labels repeat all known modes. Otherwise they rely on the active modes.
    pub restates: bool,
    /// Whether a branch can hold blocks, with an ELSE part. Otherwise it holds one jump or one assignment.
    pub blocks: bool,
    /// Ranges of local variable numbers, first and last.
    pub local: Vec<[u32; 2]>,
    /// Ranges of common variable numbers that the control clears at switch-off.
    pub common: Vec<[u32; 2]>,
    /// Ranges of common variable numbers that the control keeps at switch-off.
    pub retentive: Vec<[u32; 2]>,
    /// Greatest nesting depth of loops, and of branches that hold blocks.
    pub loops: u8,
    /// Greatest nesting depth of calls with local variables; 0 if unknown.
    pub calls: u8,
    /// Greatest nesting depth of brackets.
    pub brackets: u8,
    /// Alarm numbers that a program can raise, first and last.
    pub alarms: Option<[u32; 2]>,
    /// Greatest length of the text of an alarm or of a stop with a message, in characters.
    pub alarm_text: usize,
    /// Greatest number of digits in a value written to a device, before and after the point.
    pub output_digits: u8,
    /// Whether the program must open a device before it writes to it.
    pub output_opened: bool,
    /// Whether AND, OR and XOR work bit by bit between numbers.
    pub bits: bool,
    /// Whether each repetition of a call starts with the same arguments and empty local variables. Otherwise ncc
    /// calls a program with local variables only once.
    pub arguments_again: bool,
    /// How arguments are passed to the variables of the called program.
    pub parameters: Handing,
    /// Variables with names.
    pub named: Option<VariableNames>,
    /// The manual and its page, or another source.
    pub source: String,
}

/// How arguments are passed to the variables of the called program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Handing {
    /// Each address sets a variable by number: `A` sets #1 (custom macros).
    #[default]
    Letters,
    /// By position: the first argument sets variable 1.
    Places,
    /// By the parameter names in the head of the called program.
    Names,
}

/// Rules for names of variables. Local variables have names; common variables only if `common` is set.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VariableNames {
    /// First character of the name of a common variable: `_` on LinuxCNC.
    pub common: Option<String>,
    /// Whether ncc writes names in capitals. Otherwise it writes small letters.
    pub capitals: bool,
    /// Number of letters or underscores at the start of a name.
    pub letters: usize,
    /// Characters allowed besides letters, digits and the underscore.
    pub also: String,
    /// Greatest length, in characters.
    pub longest: usize,
    /// Reserved words that are not in the dictionary.
    pub reserved: Vec<String>,
    /// The manual and its page, or another source.
    pub source: String,
}

/// An optional statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Statement {
    /// A jump to a block.
    Jump,
    /// A declaration of a variable with its type.
    Declare,
    /// An array.
    Array,
    /// A variable whose number is computed.
    Numbered,
    /// A loop without an end.
    Endless,
    /// A loop that tests its condition after each iteration.
    Until,
    /// A loop with a counter variable.
    Count,
    /// A loop with a computed repeat count.
    Times,
    /// A jump out of the surrounding loop.
    Leave,
    /// A jump to the next iteration of a loop.
    NextTurn,
    /// A message that shows computed values.
    Values,
    /// An alarm that the program raises.
    Alarm,
    /// Output of text to a device.
    Output,
    /// A stop with a message.
    Stop,
    /// A call with a computed program number or repeat count.
    CallOf,
    /// A code whose number comes from a variable that holds an active code.
    CodeOf,
    /// Read access to table entries by a computed number.
    EntriesRead,
    /// Write access to table entries by a computed number.
    EntriesSet,
    /// Attributes of a whole subprogram.
    Attributes,
}

impl From<Statement> for ComputeFeature {
    fn from(statement: Statement) -> ComputeFeature {
        match statement {
            Statement::Jump => ComputeFeature::Jump,
            Statement::Declare => ComputeFeature::Declare,
            Statement::Array => ComputeFeature::Array,
            Statement::Numbered => ComputeFeature::Numbered,
            Statement::Endless => ComputeFeature::Endless,
            Statement::Until => ComputeFeature::Until,
            Statement::Count => ComputeFeature::Count,
            Statement::Times => ComputeFeature::Times,
            Statement::Leave => ComputeFeature::Leave,
            Statement::NextTurn => ComputeFeature::NextTurn,
            Statement::Values => ComputeFeature::Values,
            Statement::Alarm => ComputeFeature::Alarm,
            Statement::Output => ComputeFeature::Output,
            Statement::Stop => ComputeFeature::Stop,
            Statement::CallOf => ComputeFeature::CallOf,
            Statement::CodeOf => ComputeFeature::CodeOf,
            Statement::EntriesRead => ComputeFeature::EntriesRead,
            Statement::EntriesSet => ComputeFeature::EntriesSet,
            Statement::Attributes => ComputeFeature::Attributes,
        }
    }
}

/// An operator with two operands, as a dialect file names it: `not-equal`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // As [`Binary`].
pub enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
    Power,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    And,
    Or,
    Xor,
}

/// A function, as a dialect file names it: `bit-and`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // As [`Function`].
pub enum FunctionName {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan2,
    Sqrt,
    Abs,
    Round,
    RoundUp,
    Truncate,
    Floor,
    Ceiling,
    Min,
    Max,
    Ln,
    Exp,
    BitAnd,
    BitOr,
    BitXor,
}

impl From<Operator> for Binary {
    fn from(operator: Operator) -> Binary {
        match operator {
            Operator::Add => Binary::Add,
            Operator::Subtract => Binary::Subtract,
            Operator::Multiply => Binary::Multiply,
            Operator::Divide => Binary::Divide,
            Operator::Modulo => Binary::Modulo,
            Operator::Power => Binary::Power,
            Operator::Equal => Binary::Equal,
            Operator::NotEqual => Binary::NotEqual,
            Operator::Less => Binary::Less,
            Operator::LessOrEqual => Binary::LessOrEqual,
            Operator::Greater => Binary::Greater,
            Operator::GreaterOrEqual => Binary::GreaterOrEqual,
            Operator::And => Binary::And,
            Operator::Or => Binary::Or,
            Operator::Xor => Binary::Xor,
        }
    }
}

impl From<FunctionName> for Function {
    fn from(name: FunctionName) -> Function {
        match name {
            FunctionName::Sin => Function::Sin,
            FunctionName::Cos => Function::Cos,
            FunctionName::Tan => Function::Tan,
            FunctionName::Asin => Function::Asin,
            FunctionName::Acos => Function::Acos,
            FunctionName::Atan2 => Function::Atan2,
            FunctionName::Sqrt => Function::Sqrt,
            FunctionName::Abs => Function::Abs,
            FunctionName::Round => Function::Round,
            FunctionName::RoundUp => Function::RoundUp,
            FunctionName::Truncate => Function::Truncate,
            FunctionName::Floor => Function::Floor,
            FunctionName::Ceiling => Function::Ceiling,
            FunctionName::Min => Function::Min,
            FunctionName::Max => Function::Max,
            FunctionName::Ln => Function::Ln,
            FunctionName::Exp => Function::Exp,
            FunctionName::BitAnd => Function::BitAnd,
            FunctionName::BitOr => Function::BitOr,
            FunctionName::BitXor => Function::BitXor,
        }
    }
}

/// [`Remainders`], as a dialect file names them: `made-whole`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // As [`Remainders`].
pub enum RemainderRule {
    #[default]
    OfAny,
    Typed,
    MadeWhole,
}

impl From<RemainderRule> for Remainders {
    fn from(rule: RemainderRule) -> Remainders {
        match rule {
            RemainderRule::OfAny => Remainders::OfAny,
            RemainderRule::Typed => Remainders::Typed,
            RemainderRule::MadeWhole => Remainders::MadeWhole,
        }
    }
}

impl From<Handing> for Handed {
    fn from(handing: Handing) -> Handed {
        match handing {
            Handing::Letters => Handed::Letters,
            Handing::Places => Handed::Places,
            Handing::Names => Handed::Names,
        }
    }
}

impl FormulaRules {
    /// Rules for names of variables, with all reserved words: those of the dictionary (`words`), of operators and
    /// of functions. `None` if the control has no named variables.
    pub(crate) fn with_names<'d>(&'d self, words: impl Iterator<Item = &'d str>) -> Option<Named> {
        let rules = self.named.as_ref()?;
        let own =
            self.functions.values().chain(self.operators.values()).chain(&rules.reserved).chain(&self.not);
        let all = own.map(String::as_str).chain(words).map(|word| word.to_ascii_uppercase().into());
        Some(Named {
            common: rules.common.as_deref().map(Into::into),
            capitals: rules.capitals,
            letters: rules.letters,
            also: rules.also.as_str().into(),
            longest: rules.longest,
            reserved: all.collect(),
        })
    }

    /// Tolerance of comparisons. `None` compares exactly.
    pub fn tolerance(&self) -> Option<Num> {
        let (whole, rest) = self.equal_within.as_deref()?.split_once('.')?;
        let mantissa = format!("{whole}{rest}").parse().ok()?;
        Some(Num { mantissa, scale: u8::try_from(rest.len()).ok()?, point: true, unit: Unit::One })
    }

    /// Word of an operator; `None` if the control lacks it.
    pub fn operator(&self, operator: Binary) -> Option<&str> {
        self.operators.iter().find(|(own, _)| Binary::from(**own) == operator).map(|(_, word)| word.as_str())
    }

    /// Word of a function written in front of its arguments; `None` if the control lacks it.
    pub fn function(&self, function: Function) -> Option<&str> {
        word(&self.functions, function)
    }

    /// Word of a function written between its two values; `None` if the control lacks it.
    pub fn between(&self, function: Function) -> Option<&str> {
        word(&self.between, function)
    }

    /// Whether the control has a function, by its word or as a bitwise operator.
    pub fn has(&self, function: Function) -> bool {
        self.function(function).is_some()
            || self.between(function).is_some()
            || self.by_bits(function).is_some()
    }

    /// Operator that also computes a bitwise function: AND for `BitAnd`. `None` if it works on conditions only.
    pub fn by_bits(&self, function: Function) -> Option<Binary> {
        let operator = match function {
            Function::BitAnd => Binary::And,
            Function::BitOr => Binary::Or,
            Function::BitXor => Binary::Xor,
            _ => return None,
        };
        (self.bits && self.operator(operator).is_some()).then_some(operator)
    }

    /// The local or common variable of a number; `None` outside their ranges.
    pub fn variable(&self, number: u32) -> Option<Var> {
        let among = |ranges: &[[u32; 2]]| ranges.iter().any(|[from, to]| (*from..=*to).contains(&number));
        let name = || number.to_string().into();
        match () {
            () if among(&self.local) => Some(Var::Local(name())),
            () if among(&self.common) => Some(Var::Common(name())),
            () if among(&self.retentive) => Some(Var::Retentive(name())),
            () => None,
        }
    }
}

fn word(words: &BTreeMap<FunctionName, String>, function: Function) -> Option<&str> {
    words.iter().find(|(own, _)| Function::from(**own) == function).map(|(_, word)| word.as_str())
}
