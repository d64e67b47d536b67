//! What a control computes with: its variables, and the words of its operators and functions.

use std::collections::BTreeMap;

use ncc_ir::computed::computes::{ComputeFeature, Handed, Named, Remainders};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Function, Var};
use serde::Deserialize;

/// Words of the language in which a program computes (`[program] macro_b`), each by its meaning; what is
/// missing here is refused.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FormulaRules {
    /// Statements that not every language has.
    pub statements: Vec<Statement>,
    /// Operators.
    pub operators: BTreeMap<Operator, String>,
    /// Functions.
    pub functions: BTreeMap<FunctionName, String>,
    /// Functions of two values whose word stands between them, in brackets with them: `(R1 B_AND 7)`. They bind less
    /// tightly than sums and more tightly than `and`.
    pub between: BTreeMap<FunctionName, String>,
    /// Of which numbers the remainder's operator is one: of any; of those that are whole by their types; of whole ones,
    /// which the control makes of others first, in a way that is not known for sure. Of others it is written as what it
    /// is.
    pub remainders: RemainderRule,
    /// Operators in groups that bind alike, the tightest first.
    pub priority: Vec<Vec<Operator>>,
    /// The brackets.
    pub open: String,
    /// The closing ones.
    pub close: String,
    /// Whether the arguments of a function of several stand in one pair of brackets, with commas between:
    /// `ATAN2(a,b)`; else each in its own with a division sign between: `ATAN[a]/[b]`.
    pub together: bool,
    /// What stands before the name of a variable.
    pub variable: String,
    /// What stands around the number of a variable that is computed, and around the indices of an array: `[` and `]` of
    /// `R[R1+1]`. The control rounds what is not whole there.
    pub index: Option<[String; 2]>,
    /// What stands for no value at all, of a control that has such a thing.
    pub vacant: Option<String>,
    /// With what the names of variables begin that others know by their numbers alone: `R` of `R101`.
    pub prefix: String,
    /// What stands between a letter and what is computed; without, it is a variable or in brackets.
    pub behind: String,
    /// The word for the opposite of a condition.
    pub not: Option<String>,
    /// What stands after a condition in brackets to make its opposite, of a control whose conditions are numbers.
    pub not_behind: Option<String>,
    /// The operator of a remainder that is never negative.
    pub remainder: Option<String>,
    /// The word for whether a variable with a name has a value.
    pub exists: Option<String>,
    /// How far apart two numbers are, as a decimal, that comparisons do not find equal; without, the least bit.
    pub equal_within: Option<String>,
    /// To how many digits after the point a number is looked at that must be whole: in words that count, and of a
    /// variable whose number is computed.
    pub whole: Option<u8>,
    /// Between which signs a name stands.
    pub name_signs: String,
    /// Whether newer series read a power as a function of two values, `POW[a,b]`; none is written so.
    pub power: bool,
    /// Whether comparisons find real numbers equal that are nearly so.
    pub near: bool,
    /// Whether a word rounds what is computed for it to its increment.
    pub rounds: bool,
    /// Whether blocks in loops and after labels are written with every fact that is known there, since the words of
    /// another language lead to them; else as they are, with what is active.
    pub restates: bool,
    /// Whether a branch is about blocks of its own, and can have others where it does not hold; else about one jump
    /// or one assignment.
    pub blocks: bool,
    /// Numbers of variables, from and to, that live as long as a call.
    pub local: Vec<[u32; 2]>,
    /// Of those that all programs see, until the control is switched off.
    pub common: Vec<[u32; 2]>,
    /// Of those that are kept when it is.
    pub retentive: Vec<[u32; 2]>,
    /// How deep loops can stand in one another, and branches with them whose blocks are their own.
    pub loops: u8,
    /// How deep calls with variables of their own can; 0 is not known.
    pub calls: u8,
    /// How deep brackets can.
    pub brackets: u8,
    /// Numbers of alarms that a program can give, from and to.
    pub alarms: Option<[u32; 2]>,
    /// How many characters the text of an alarm, or of a stop with a message, can have.
    pub alarm_text: usize,
    /// How many digits a value that is written to a device can have, before the point and after it.
    pub output_digits: u8,
    /// Whether a device must be opened before anything is written to it.
    pub output_opened: bool,
    /// Whether the words that join conditions work bit by bit where they stand between numbers.
    pub bits: bool,
    /// Whether a call that is made several times begins each of them with the same arguments and no other
    /// variables; else a program with variables of its own is called once.
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
    /// Each letter is a variable of its own, by its number (custom macros).
    #[default]
    Letters,
    /// One after the other: the first one is variable 1.
    Places,
    /// By the names in the head of what is called.
    Names,
}

/// Variables with names. Local variables have them; common variables only with `common`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VariableNames {
    /// With what the names of those begin that all programs see.
    pub common: Option<String>,
    /// Whether they are written in capitals.
    pub capitals: bool,
    /// How many letters or underlines they begin with.
    pub letters: usize,
    /// Characters that they have besides letters, digits and the underline.
    pub also: String,
    /// Most characters.
    pub longest: usize,
    /// Words beyond those of the dictionary that no variable can be called.
    pub reserved: Vec<String>,
    /// The manual and its page, or another source.
    pub source: String,
}

/// A statement that not every language has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Statement {
    /// A jump to a block.
    Jump,
    /// A variable is made known with its type.
    Declare,
    /// Several variables under one name.
    Array,
    /// A variable whose number is computed.
    Numbered,
    /// A loop without an end.
    Endless,
    /// A loop that ends where a condition holds after it.
    Until,
    /// A loop over a variable that counts.
    Count,
    /// A loop as often as a computed number says.
    Times,
    /// The way out of the loops around it.
    Leave,
    /// The way to the next iteration of a loop.
    NextTurn,
    /// A message with what is computed in it.
    Values,
    /// An alarm of the program's own.
    Alarm,
    /// Text for a device.
    Output,
    /// A stop with a message.
    Stop,
    /// A call of which the number, or the repeat count, is computed.
    CallOf,
    /// A code of which the number is a variable's, which has it from the active codes.
    CodeOf,
    /// Table entries that are read by a computed number.
    EntriesRead,
    /// Table entries that are set by a computed number.
    EntriesSet,
    /// What is said of a subprogram as a whole.
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

/// An operator with two operands.
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

/// A function.
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

/// As [`Remainders`].
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
    /// Variables with names, which the words of the dictionary cannot be.
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

    /// How far apart two numbers are that comparisons do not find equal.
    pub fn tolerance(&self) -> Option<Num> {
        let (whole, rest) = self.equal_within.as_deref()?.split_once('.')?;
        let mantissa = format!("{whole}{rest}").parse().ok()?;
        Some(Num { mantissa, scale: u8::try_from(rest.len()).ok()?, point: true, unit: Unit::One })
    }

    /// The word of an operator.
    pub fn operator(&self, operator: Binary) -> Option<&str> {
        self.operators.iter().find(|(own, _)| Binary::from(**own) == operator).map(|(_, word)| word.as_str())
    }

    /// The word of a function.
    pub fn function(&self, function: Function) -> Option<&str> {
        word(&self.functions, function)
    }

    /// The word of a function that stands between its values.
    pub fn between(&self, function: Function) -> Option<&str> {
        word(&self.between, function)
    }

    /// Whether there is a function, by a word of its own or by that of an operator.
    pub fn has(&self, function: Function) -> bool {
        self.function(function).is_some()
            || self.between(function).is_some()
            || self.by_bits(function).is_some()
    }

    /// The operator whose word is that of a function of whole numbers, bit by bit, too.
    pub fn by_bits(&self, function: Function) -> Option<Binary> {
        let operator = match function {
            Function::BitAnd => Binary::And,
            Function::BitOr => Binary::Or,
            Function::BitXor => Binary::Xor,
            _ => return None,
        };
        (self.bits && self.operator(operator).is_some()).then_some(operator)
    }

    /// The variable of a number, if it is one of a program's own.
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
