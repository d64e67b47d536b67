//! What of a program that computes a target can say, and which place of a program it cannot.
//!
//! Not here: how it spells it, and what only the digits of its words can tell (the back-end's).

use std::collections::HashMap;

use crate::alarms::Alarms;
use crate::computed::call_of::call_of;
use crate::computed::code_of::code_of;
use crate::computed::entry_of::{EntryOf, entry_of, is_about_entries};
use crate::diag::{Diagnostic, Fault};
use crate::expr::num::{Num, Unit};
use crate::expr::system::System;
use crate::expr::{Binary, Element, Expr, Function, Many, Node, Numbers, Scope, Target, Unary, Var};
use crate::program::arguments;
use crate::program::{Control, Op, Output, Piece, Procedure, Program, Stmt, Text};
use crate::source::Span;

/// Most calls without variables of their own, one within another, that are looked into.
const MOST_SHARED: u32 = 16;

/// A statement of programs that compute which not every language has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// [`Op::Goto`].
    Jump,
    /// [`Op::Declare`] of a single value.
    Declare,
    /// [`Op::Declare`] of an array, and its elements.
    Array,
    /// Variables whose number is computed ([`Many::Numbered`]).
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
    /// What [`crate::computed::call_of`] finds.
    CallOf,
    /// What [`crate::computed::code_of`] finds of codes.
    CodeOf,
    /// What [`crate::computed::entry_of`] finds, where it only reads places of tables.
    EntriesRead,
    /// What [`crate::computed::entry_of`] finds, where it sets a place of a table.
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

/// How arguments come to the variables of what is called.
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
    /// To how many digits behind the point a number is looked at that must be whole, where that is not exactly so.
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
    /// Those of them that are places of tables, each with the control's number of it.
    pub entries: Vec<(System, i64)>,
    /// Whether a condition is worth 1 or 0 wherever a number can stand.
    pub worth: bool,
    /// Whether programs with variables of their own have names.
    pub named_programs: bool,
    /// What stands before a variable's name in a program.
    pub mark: Text,
    /// Statements that not every language has.
    pub statements: Vec<Said>,
    /// Operators.
    pub operators: Vec<Binary>,
    /// Functions.
    pub functions: Vec<Function>,
    /// Values of the control's own that have a name, of one or of several in a sum.
    pub values: Vec<Expr>,
    /// With what the names of its variables begin; behind it they are numbers.
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
    /// Whether the opposite of a condition can be said.
    pub opposite: bool,
    /// Whether comparisons find real numbers equal that are nearly so.
    pub near: bool,
    /// Whether blocks in loops and behind labels say every fact that is known there.
    pub restates: bool,
    /// Whether a decision can be about any blocks; else about one jump or one assignment.
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
    pub fn has(&self, statement: Said) -> bool {
        self.statements.contains(&statement)
    }

    /// Whether a decision can be about these statements without blocks of its own.
    pub fn decides(&self, then: &[Stmt]) -> bool {
        match then {
            [only] if matches!(only.op, Op::Goto(_) | Op::Assign(..)) => true,
            [only] if matches!(only.op, Op::Alarm(_)) => self.has(Said::Alarm),
            then => self.has(Said::Stop) && stops(then),
        }
    }

    /// Places of tables by a computed number, as the target says them in one statement, if these decisions are such and it
    /// does.
    pub fn entry_of<'c>(&self, control: &'c Control) -> Option<EntryOf<'c>> {
        let entry = entry_of(&code_of(control)?, &self.entries)?;
        let said = if entry.sets.is_empty() { Said::EntriesRead } else { Said::EntriesSet };
        self.has(said).then_some(entry)
    }

    /// Whether decisions about one number are one statement of the target's: a code, or places of its tables.
    pub fn says_number(&self, control: &Control) -> bool {
        let Some(code) = code_of(control) else { return false };
        match is_about_entries(&code) {
            true => self.entry_of(control).is_some(),
            false => self.has(Said::CodeOf),
        }
    }

    /// Whether a variable can be said.
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

    /// Whether variables that have numbers can all be said, by the same numbers.
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

    /// The first call with variables of its own that stands within more others than the target takes; what calls
    /// itself may do so any number of times.
    pub fn too_deep(&self, program: &Program) -> Option<Diagnostic> {
        struct Depth<'p> {
            program: &'p Program,
            places: HashMap<&'p str, usize>,
            /// What was found in a procedure with so many calls left of both kinds.
            known: HashMap<(usize, u32, u32), Option<Span>>,
        }
        fn down(depth: &mut Depth, body: &[Stmt], left: u32, shared: u32) -> Option<Span> {
            body.iter().find_map(|stmt| match &stmt.op {
                Op::Control(control) => control.bodies().find_map(|body| down(depth, body, left, shared)),
                Op::Call(call) => {
                    let own = !call.shared || !call.arguments.is_empty();
                    let left = left.checked_sub(u32::from(own));
                    match (left, depth.places.get(&*call.name).copied()) {
                        (None, _) => Some(stmt.span),
                        (Some(left), Some(place)) => {
                            let shared = shared.checked_sub(u32::from(!own))?;
                            if let Some(found) = depth.known.get(&(place, left, shared)) {
                                return *found;
                            }
                            let program = depth.program;
                            let found = down(depth, &program.procedures[place].body, left, shared);
                            depth.known.insert((place, left, shared), found);
                            found
                        }
                        (Some(_), None) => None,
                    }
                }
                _ => None,
            })
        }
        if self.calls == 0 {
            return None;
        }
        let most = u32::from(self.calls);
        let mut depth = Depth { program, places: program.by_name(), known: HashMap::new() };
        let at = program
            .procedures
            .iter()
            .find_map(|procedure| down(&mut depth, &procedure.body, most, MOST_SHARED))?;
        Some(refuse("a call with variables of its own within so many others", at))
    }

    /// The first place that cannot be said.
    pub fn refusal<'c>(&'c self, program: &'c Program) -> Option<Diagnostic> {
        let references = match self.handed {
            Handed::Names => program.procedures.iter().flat_map(|procedure| &procedure.parameters).collect(),
            Handed::Letters | Handed::Places => Vec::new(),
        };
        let look = Look { computes: self, references };
        program.procedures.iter().find_map(|procedure| look.procedure(procedure).err())
    }
}

fn refuse(what: impl Into<Text>, at: Span) -> Diagnostic {
    Diagnostic::new(Fault::Computes { what: what.into() }, at)
}

/// Whether an endless body can be left, as far as its statements tell. What has no end cannot be verified.
fn ends(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Goto(_)
        | Op::Return
        | Op::ProgramEnd
        | Op::BeginAgain
        | Op::Call(_)
        | Op::Alarm(_)
        | Op::Leave => true,
        Op::Control(control) => control.bodies().any(|body| ends(body)),
        _ => false,
    })
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

/// The name of an operator or a function, as in the text form.
fn called(of: &impl std::fmt::Debug) -> String {
    format!("{of:?}").to_lowercase()
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

struct Look<'c> {
    computes: &'c Computes,
    /// Parameters, where the head of a program can say that one is the caller's variable itself.
    references: Vec<&'c Var>,
}

impl Look<'_> {
    fn procedure(&self, procedure: &Procedure) -> Result<(), Diagnostic> {
        let at = procedure.body.first().map_or(Span::default(), |stmt| stmt.span);
        procedure.parameters.iter().try_for_each(|parameter| self.variable(parameter, at))?;
        self.body(&procedure.body, 0)
    }

    fn body(&self, body: &[Stmt], loops: u8) -> Result<(), Diagnostic> {
        body.iter().try_for_each(|stmt| self.stmt(stmt, loops))
    }

    fn stmt(&self, stmt: &Stmt, loops: u8) -> Result<(), Diagnostic> {
        let at = stmt.span;
        match &stmt.op {
            Op::Declare(declare) => {
                match declare.sizes.is_empty() {
                    true => self.has(Said::Declare, "a variable that is made known", at)?,
                    false => self.has(Said::Array, "an array", at)?,
                }
                self.variable(&declare.var, at)?;
                declare.initial.iter().flatten().try_for_each(|value| self.expr(value, at))
            }
            Op::Leave => self.has(Said::Leave, "a loop that is left", at),
            Op::NextTurn => self.has(Said::NextTurn, "a turn of a loop that is left", at),
            Op::Goto(_) => self.has(Said::Jump, "a jump", at),
            Op::MessageOf(pieces) => {
                self.has(Said::Values, "a message with values in it", at)?;
                self.pieces(pieces, at)
            }
            Op::Output(output) => {
                self.has(Said::Output, "output to a device", at)?;
                if let Output::Line(pieces) = &**output { self.pieces(pieces, at) } else { Ok(()) }
            }
            Op::Alarm(alarm) => {
                self.has(Said::Alarm, "an alarm", at)?;
                alarm.number.iter().try_for_each(|number| self.expr(number, at))
            }
            Op::Assign(to, value) => {
                match to {
                    Target::Var(var) => self.variable(var, at)?,
                    Target::Element(element) => self.element(element, at)?,
                }
                self.expr(value, at)
            }
            Op::Control(control) => self.control(control, stmt, loops),
            Op::Call(call) => {
                if (!call.arguments.is_empty() || !call.shared) && !self.computes.arguments {
                    return Err(refuse("a call with variables of its own", at));
                }
                let own = !call.arguments.is_empty() || !call.shared;
                if own && call.times > 1 && !self.computes.arguments_again {
                    return Err(refuse("a call with variables of its own that is made several times", at));
                }
                call.arguments.iter().try_for_each(|argument| self.expr(argument, at))
            }
            op if arguments::computed(op) => {
                arguments::each(&mut op.clone(), &mut |argument, _| match argument.expr() {
                    Some(expr) => self.expr(expr, at),
                    None => Ok(()),
                })
            }
            _ => Ok(()),
        }
    }

    fn control(&self, control: &Control, stmt: &Stmt, loops: u8) -> Result<(), Diagnostic> {
        let at = stmt.span;
        let deeper = || match loops < self.computes.loops {
            true if stmt.skip.is_some() => Err(refuse("a loop that can be skipped", at)),
            true => Ok(loops + 1),
            false => Err(refuse("a loop within so many others", at)),
        };
        if self.computes.has(Said::CallOf)
            && let Some(call) = call_of(control)
        {
            return call.number.into_iter().chain(call.times).try_for_each(|value| self.expr(value, at));
        }
        if self.computes.says_number(control)
            && let Some(code) = code_of(control)
        {
            self.expr(code.number, at)?;
            // What each of them says is of one form.
            let first = code.codes.first().filter(|(_, op)| matches!(op, Op::Assign(..) | Op::SetData(_)));
            return first.map_or(Ok(()), |(_, op)| self.stmt(&Stmt::new(at, (*op).clone()), loops));
        }
        match control {
            Control::While { condition, body } => {
                self.expr(condition, at)?;
                self.body(body, deeper()?)
            }
            Control::Loop { body } if !ends(body) => Err(refuse("a loop that has no end", at)),
            Control::Loop { body } => {
                self.has(Said::Endless, "a loop without a condition", at)?;
                self.body(body, deeper()?)
            }
            Control::Until { condition, body } => {
                self.has(Said::Until, "a loop that is tested behind each turn", at)?;
                self.body(body, deeper()?)?;
                self.expr(condition, at)
            }
            Control::If { condition, then, otherwise } => {
                self.expr(condition, at)?;
                if self.computes.blocks {
                    if stmt.skip.is_some() {
                        return Err(refuse("a decision that can be skipped", at));
                    }
                    return control.bodies().try_for_each(|body| self.body(body, loops));
                }
                match &otherwise[..] {
                    [] if self.computes.decides(then) => self.body(then, loops),
                    _ => Err(refuse("a decision about more than one statement", at)),
                }
            }
            Control::Repeat { times, body } if times.literal().is_some() => self.body(body, loops),
            Control::Repeat { times, body } => {
                self.has(Said::Times, "a loop that is repeated a computed number of times", at)?;
                self.expr(counted(times), at)?;
                self.body(body, deeper()?)
            }
            Control::For { variable, from, to, step, body } => {
                self.has(Said::Count, "a loop that counts", at)?;
                self.variable(variable, at)?;
                [from, to, step].into_iter().try_for_each(|value| self.expr(value, at))?;
                self.body(body, deeper()?)
            }
        }
    }

    fn has(&self, statement: Said, what: &str, at: Span) -> Result<(), Diagnostic> {
        if self.computes.has(statement) { Ok(()) } else { Err(refuse(what, at)) }
    }

    fn element(&self, element: &Element, at: Span) -> Result<(), Diagnostic> {
        match &element.of {
            Many::Array { var, .. } => {
                self.has(Said::Array, "an array", at)?;
                self.variable(var, at)?;
            }
            Many::Numbered(numbers) => {
                self.has(Said::Numbered, "a variable whose number is computed", at)?;
                if !numbers.iter().all(|range| self.computes.says_all(range)) {
                    return Err(refuse("a variable whose number is computed, of other variables", at));
                }
            }
        }
        element.at.iter().try_for_each(|index| self.expr(index, at))
    }

    fn variable(&self, var: &Var, at: Span) -> Result<(), Diagnostic> {
        match var {
            _ if self.computes.says(var) || self.references.contains(&var) => Ok(()),
            Var::System(_) => Err(refuse(format!("the system variable {}", var.name()), at)),
            Var::Local(name) | Var::Common(name) | Var::Retentive(name) => {
                Err(refuse(format!("the variable {name}"), at))
            }
        }
    }

    fn pieces(&self, pieces: &[Piece], at: Span) -> Result<(), Diagnostic> {
        pieces.iter().try_for_each(|piece| match piece {
            Piece::Text(_) => Ok(()),
            Piece::Value { value, .. } => self.expr(value, at),
        })
    }

    fn expr(&self, expr: &Expr, at: Span) -> Result<(), Diagnostic> {
        let Expr::Node(node) = expr else { return Ok(()) };
        match &**node {
            _ if self.computes.values.contains(expr) => Ok(()),
            Node::Var(var) => self.variable(var, at),
            Node::Vacant if !self.computes.vacant => Err(refuse("no value at all", at)),
            Node::Vacant => Ok(()),
            Node::Element(element) => self.element(element, at),
            Node::Unary(Unary::Negate, a) => self.expr(a, at),
            Node::Unary(Unary::Not, a) if self.computes.opposite => self.expr(a, at),
            Node::Unary(Unary::Not, _) => Err(refuse("the opposite of a condition", at)),
            Node::Binary(Binary::NotEqual, Expr::Node(a), Expr::Node(b))
                if self.computes.exists && matches!(**b, Node::Vacant) =>
            {
                match &**a {
                    Node::Var(var @ Var::Local(name)) if self.computes.is_name(name, false) => {
                        self.variable(var, at)
                    }
                    Node::Var(var @ Var::Common(name)) if self.computes.is_name(name, true) => {
                        self.variable(var, at)
                    }
                    _ => Err(refuse("whether a variable without a name has a value", at)),
                }
            }
            Node::Binary(operator, a, b) => {
                if !self.computes.operators.contains(operator) {
                    return Err(refuse(format!("the operator {}", called(operator)), at));
                }
                self.expr(a, at)?;
                self.expr(b, at)
            }
            Node::Call(function, arguments) => {
                // What rounds to digits does so for a word, whose own rounding that may be.
                let own =
                    *function == Function::RoundTo || *function == Function::NearRatio && self.computes.near;
                if !own && !self.computes.functions.contains(function) {
                    return Err(refuse(format!("the function {}", called(function)), at));
                }
                arguments.iter().try_for_each(|argument| self.expr(argument, at))
            }
        }
    }
}
