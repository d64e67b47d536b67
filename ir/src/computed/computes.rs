//! What of a program that computes a target can say, and which place of a program it cannot.
//!
//! Not here: how it spells it, and what only the digits of its words can tell (the back-end's).

mod refusal;

use crate::alarms::Alarms;
use crate::computed::computed_code::computed_code;
use crate::computed::computed_entry::{ComputedEntry, computed_entry, is_about_entries};
use crate::expr::num::{Num, Unit};
use crate::expr::system::System;
use crate::expr::{Binary, Expr, Function, Node, Numbers, Scope, Var};
use crate::program::{Control, Op, Stmt, Text};

/// A statement of programs that compute which not every language has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComputeFeature {
    /// [`Op::Goto`].
    Jump,
    /// [`Op::Declare`] of a single value.
    Declare,
    /// [`Op::Declare`] of an array, and its elements.
    Array,
    /// Variables whose number is computed ([`Many::Numbered`](crate::expr::Many::Numbered)).
    Numbered,
    /// [`Control::Loop`].
    Endless,
    /// [`Control::Until`].
    Until,
    /// [`Control::For`].
    Count,
    /// [`Control::Repeat`] of a number that is computed.
    Times,
    /// [`Op::Leave`].
    Leave,
    /// [`Op::NextTurn`].
    NextTurn,
    /// [`Op::MessageOf`].
    Values,
    /// [`Op::Output`].
    Output,
    /// [`Op::Alarm`].
    Alarm,
    /// [`Op::ProgramStop`] with [`Op::Message`] before it in its block.
    Stop,
    /// What [`crate::computed::computed_call`] finds.
    CallOf,
    /// What [`crate::computed::computed_code`] finds of codes.
    CodeOf,
    /// What [`crate::computed::computed_entry`] finds, where it only reads table entries.
    EntriesRead,
    /// What [`crate::computed::computed_entry`] finds, where it sets a place of a table.
    EntriesSet,
    /// [`crate::program::Attribute`] of a procedure.
    Attributes,
}

/// Of which numbers a control has a remainder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Remainders {
    /// Of any.
    #[default]
    OfAny,
    /// Of those alone that are whole by their types ([`crate::expr::types`]).
    Typed,
    /// Of whole ones, which it makes of others first, in a way that is not known for sure.
    MadeWhole,
}

/// How arguments are passed to the variables of the called program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Handed {
    /// Each letter is a variable of its own, by its number: `A` is 1, `X` is 24.
    #[default]
    Letters,
    /// One after the other: the first one is variable 1.
    Places,
    /// By the names in the head of what is called.
    Names,
}

/// Letters of the arguments that are variables of a call, in the order in which they are written; those of `I`, `J`
/// and `K` in their own (B-63684EN, custom macro, argument specification I).
pub const LETTERS: [(u8, u32); 21] = [
    (b'A', 1),
    (b'B', 2),
    (b'C', 3),
    (b'I', 4),
    (b'J', 5),
    (b'K', 6),
    (b'D', 7),
    (b'E', 8),
    (b'F', 9),
    (b'H', 11),
    (b'M', 13),
    (b'Q', 17),
    (b'R', 18),
    (b'S', 19),
    (b'T', 20),
    (b'U', 21),
    (b'V', 22),
    (b'W', 23),
    (b'X', 24),
    (b'Y', 25),
    (b'Z', 26),
];

/// Variables that have names.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Named {
    /// With what the names of those begin that all programs see; without, only those of a call have names.
    pub common: Option<Text>,
    /// Whether they are written in capitals; else in small letters.
    pub capitals: bool,
    /// How many letters or underlines they begin with.
    pub letters: usize,
    /// Characters that they have besides letters, digits and the underline.
    pub also: Text,
    /// Most characters.
    pub longest: usize,
    /// What no variable can be called, in capitals.
    pub reserved: Vec<Text>,
}

impl Named {
    /// A name in the target's characters, for a variable that all programs see or for one of a call.
    pub fn adapted(&self, name: &str, common: bool) -> Text {
        let known = |c: char| c.is_ascii_alphanumeric() || c == '_' || self.also.contains(c);
        let fits = |c: char| if known(c) { c } else { '_' };
        let mut made: String = name.chars().map(fits).collect();
        let global = self.common.as_deref();
        if !common && let Some(global) = global.filter(|global| made.starts_with(global)) {
            made.drain(..global.len());
        }
        let begins = |made: &str| {
            let first = made.bytes().take(self.letters);
            made.len() >= self.letters && first.into_iter().all(|b| b.is_ascii_alphabetic() || b == b'_')
        };
        let reserved = |made: &str| self.reserved.iter().any(|word| word.eq_ignore_ascii_case(made));
        if made.is_empty() || !begins(&made) || reserved(&made) {
            made.insert_str(0, "V_");
        }
        if common && let Some(global) = global.filter(|global| !made.starts_with(global)) {
            made.insert_str(0, global);
        }
        made.truncate(self.longest.max(1));
        if self.capitals {
            made.make_ascii_uppercase()
        } else {
            made.make_ascii_lowercase()
        }
        made.into()
    }
}

/// Real numbers that are apart by no more than this part of the greater one are the same where a control's comparisons
/// find those equal that are nearly so: 10^-12.
pub const NEARLY: Num = Num { mantissa: 1, scale: 12, point: true, unit: Unit::One };

/// What a target computes with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Computes {
    /// Variables with names, if it has such.
    pub named: Option<Named>,
    /// How arguments are handed over.
    pub handed: Handed,
    /// Whether a call can have its caller's own variables.
    pub shares: bool,
    /// Whether there is a word for whether a variable with a name has a value.
    pub exists: bool,
    /// How far apart two numbers are that comparisons do not find equal, where that is more than the least bit.
    pub equal_within: Option<Num>,
    /// To how many digits after the point a number is looked at that must be whole, where that is not exactly so.
    pub whole: Option<u8>,
    /// Its alarms, if a program can give such.
    pub alarms: Option<Alarms>,
    /// With how many digits a value stands in a message where zeros at its end are not left out; in these messages only
    /// variables stand.
    pub values_in_full: Option<u8>,
    /// Whether a device must be opened before anything is written to it.
    pub output_opened: bool,
    /// The alarm with which the control ends a program of which a cycle's planes do not lie one above the other.
    pub planes_alarm: Option<i64>,
    /// Values of the control's own that a program can ask for.
    pub system: Vec<System>,
    /// Those of them that are table entries, each with the control's number of it.
    pub entries: Vec<(System, i64)>,
    /// Whether a condition is worth 1 or 0 wherever a number can stand.
    pub worth: bool,
    /// Whether programs with variables of their own have names.
    pub named_programs: bool,
    /// What stands before a variable's name in a program.
    pub mark: Text,
    /// Statements that not every language has.
    pub statements: Vec<ComputeFeature>,
    /// Operators.
    pub operators: Vec<Binary>,
    /// Functions.
    pub functions: Vec<Function>,
    /// Values of the control's own that have a name, of one or of several in a sum.
    pub values: Vec<Expr>,
    /// With what the names of its variables begin; after it they are numbers.
    pub prefix: Text,
    /// Of which numbers it has a remainder.
    pub remainders: Remainders,
    /// Whether a variable can have no value at all, which is another thing than zero.
    pub vacant: bool,
    /// Whether words round what is computed for them to their increment.
    pub rounds: bool,
    /// To how many digits words of lengths do, in mm, or degrees, and in inches.
    pub increments: [u8; 2],
    /// Whether the angles of an arc sine and an arc tangent lie from 0 to a turn, as the machine may be set.
    pub turn: bool,
    /// Whether the opposite of a condition can be stated.
    pub opposite: bool,
    /// Whether comparisons find real numbers equal that are nearly so.
    pub near: bool,
    /// Whether blocks in loops and after labels say every fact that is known there.
    pub restates: bool,
    /// Whether a branch can be about any blocks; else about one jump or one assignment.
    pub blocks: bool,
    /// Numbers of variables, from and to, that live as long as a call.
    pub local: Vec<[u32; 2]>,
    /// Of those that all programs see.
    pub common: Vec<[u32; 2]>,
    /// Of those that are kept when the control is off.
    pub retentive: Vec<[u32; 2]>,
    /// How deep loops can stand in one another.
    pub loops: u8,
    /// How deep calls with variables of their own can; 0 is not known.
    pub calls: u8,
    /// Whether a program can be called several times, each time with variables of its own and the same arguments.
    pub arguments_again: bool,
    /// Whether a program can be called with arguments, and with variables of its own.
    pub arguments: bool,
}

impl Computes {
    /// Whether there is such a statement.
    pub fn has(&self, statement: ComputeFeature) -> bool {
        self.statements.contains(&statement)
    }

    /// Whether a branch can be about these statements without blocks of its own.
    pub fn decides(&self, then: &[Stmt]) -> bool {
        match then {
            [only] if matches!(only.op, Op::Goto(_) | Op::Assign(..)) => true,
            [only] if matches!(only.op, Op::Alarm(_)) => self.has(ComputeFeature::Alarm),
            then => self.has(ComputeFeature::Stop) && stops(then),
        }
    }

    /// Table entries by a computed number, as the target says them in one statement, if these branches are such and it
    /// does.
    pub fn computed_entry<'c>(&self, control: &'c Control) -> Option<ComputedEntry<'c>> {
        let entry = computed_entry(&computed_code(control)?, &self.entries)?;
        let said =
            if entry.sets.is_empty() { ComputeFeature::EntriesRead } else { ComputeFeature::EntriesSet };
        self.has(said).then_some(entry)
    }

    /// Whether branches for one number are one statement of the target's: a code, or entries of its tables.
    pub fn says_number(&self, control: &Control) -> bool {
        let Some(code) = computed_code(control) else { return false };
        match is_about_entries(&code) {
            true => self.computed_entry(control).is_some(),
            false => self.has(ComputeFeature::CodeOf),
        }
    }

    /// Whether a variable can be stated.
    pub fn says(&self, var: &Var) -> bool {
        let among = |ranges: &[[u32; 2]], name: &str| {
            let name = name.strip_prefix(&*self.prefix).unwrap_or_default();
            let number: Option<u32> = name.parse().ok();
            number.is_some_and(|n| {
                n.to_string() == name && ranges.iter().any(|[from, to]| (*from..=*to).contains(&n))
            })
        };
        match var {
            Var::Local(name) => among(&self.local, name) || self.is_name(name, false),
            Var::Common(name) => among(&self.common, name) || self.is_name(name, true),
            Var::Retentive(name) => among(&self.retentive, name),
            Var::System(system) => self.system.contains(system),
        }
    }

    /// Whether variables that have numbers can all be stated, by the same numbers.
    fn says_all(&self, range: &Numbers) -> bool {
        let ranges = match range.scope {
            Scope::Local => &self.local,
            Scope::Common => &self.common,
            Scope::Retentive => &self.retentive,
        };
        *range.prefix == *self.prefix
            && ranges.iter().any(|[from, to]| *from <= range.from && range.to <= *to)
    }

    /// Whether it is a name that a variable can have, of a call or of all programs; letters count as the same, large
    /// or small.
    pub fn is_name(&self, name: &str, common: bool) -> bool {
        let Some(named) = &self.named else { return false };
        let plain = Named { reserved: Vec::new(), ..named.clone() };
        (!common || named.common.is_some()) && *plain.adapted(name, common) == *name
    }
}

/// Whether statements are a stop of the program, with a message or without.
fn stops(body: &[Stmt]) -> bool {
    match body {
        [stop] => matches!(stop.op, Op::ProgramStop),
        [message, stop] => {
            matches!((&message.op, &stop.op), (Op::Message(_), Op::ProgramStop)) && stop.joined
        }
        _ => false,
    }
}

/// What a number of turns is rounded from, and held above none, as the control does by itself.
pub fn counted(times: &Expr) -> &Expr {
    if let Expr::Node(node) = times
        && let Node::Call(Function::Max, both) = &**node
        && let [Expr::Node(rounded), Expr::Num(least)] = &both[..]
        && least.is_zero()
        && let Node::Call(Function::Round, inner) = &**rounded
        && let [inner] = &inner[..]
    {
        return inner;
    }
    times
}
