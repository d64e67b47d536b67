//! Statements of programs that compute: assignments, branches, loops, jumps, and calls with arguments.
//!
//! Each stands in a block of its own. A block that is jumped to keeps its number; another one gets a number that no
//! other block has. Loops have the number of their depth.
//!
//! Not here: expressions (`common::formula`), and which structures the target has (`computes`).

use std::collections::{BTreeMap, BTreeSet, HashMap};

use ncc_ir::canon::{Modes, Units};
use ncc_ir::computed::computed_call::computed_call;
use ncc_ir::computed::computed_code::computed_code;
use ncc_ir::computed::computes::LETTERS;
use ncc_ir::diag::Fault;
use ncc_ir::expr::units::Said;
use ncc_ir::expr::{Expr, Function, Node, Target, Var};
use ncc_ir::lack::FlowLack;
use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::{Call, Control, Op, Program, Stmt, Text};
use ncc_ir::run_time::{RunTimeFlow, RunTimeWord};
use ncc_ir::source::Span;

use super::modal_call::AtMoves;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::{cannot, cannot_compute};
use crate::common::formula::{literal, number_of};
use crate::common::packed::packed;
use crate::common::words::HIGHEST_NUMBER;
use crate::word::Writer;

/// Most calls by one word.
const MOST_TIMES: u32 = 9999;

/// What of a program that computes the writer must know before its statements.
#[derive(Clone, Debug, Default)]
pub(crate) struct Computing {
    /// Whether the program computes at all: then a call has its caller's variables, or its own.
    variables: bool,
    /// Parameters of procedures, by name.
    parameters: BTreeMap<Text, Vec<Var>>,
    /// Numbers of the blocks of the procedure at hand that are jumped to.
    numbers: BTreeMap<Text, u32>,
    /// Loops that are open.
    open: u8,
}

impl Writer {
    /// Takes what calls need to know of the procedures of a program that computes.
    pub(crate) fn know(&mut self, program: &Program, entries: HashMap<u32, Modes>) {
        let procedures = program.procedures.as_slice();
        self.words.is_kept(entries);
        self.computing.variables = true;
        self.words.facts.metric = Said::by(program).only() == Some(Units::Mm);
        self.words.own_values = self
            .dialect
            .named_values()
            .filter(|(row, ..)| row.counts(&self.words.settings))
            .map(|(_, number, value)| (number, value))
            .collect();
        let known = procedures.iter().skip(1).map(|p| (p.name.clone(), p.parameters.clone()));
        self.computing.parameters = known.collect();
        if self.has_o_words() {
            self.know_o_words(procedures);
        }
    }

    /// Whether the program computes when it runs.
    pub(in crate::word) fn computes(&self) -> bool {
        self.computing.variables
    }

    /// Parameters of a procedure.
    pub(in crate::word) fn parameters_of(&self, name: &str) -> Vec<Var> {
        self.computing.parameters.get(name).cloned().unwrap_or_default()
    }

    /// Gives every block of a procedure that is jumped to its number.
    pub(crate) fn number_jumps(&mut self, body: &[Stmt]) {
        self.computing.numbers.clear();
        self.computing.open = 0;
        let mut found = Jumps::default();
        found.body(body);
        let mut next = found.numbers.last().copied().filter(|n| *n < 90_000).unwrap_or(0) / 10 * 10;
        let mut seen = BTreeSet::new();
        for (name, own) in &found.labels {
            if !found.targets.contains(name) || self.computing.numbers.contains_key(name) {
                continue;
            }
            let own = own.filter(|n| *n > 0 && seen.insert(*n));
            let number = own.unwrap_or_else(|| {
                let free = (next / 10 + 1..).map(|n| n * 10).chain(1..=HIGHEST_NUMBER);
                let free = free.filter(|n| *n <= HIGHEST_NUMBER).find(|n| !found.numbers.contains(n));
                next = free.unwrap_or(HIGHEST_NUMBER);
                found.numbers.insert(next);
                next
            });
            self.computing.numbers.insert(name.clone(), number);
        }
        self.words.numbers.jumps = !self.computing.numbers.is_empty();
    }

    /// Whether a block of this label is jumped to.
    pub(crate) fn is_jumped_to(&self, op: &Op) -> bool {
        matches!(op, Op::Label(name) if self.computing.numbers.contains_key(name))
    }

    /// A block that is jumped to begins; any other label is none.
    pub(crate) fn jump_label(&mut self, name: &str, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let Some(number) = self.computing.numbers.get(name).copied() else { return Ok(()) };
        self.flow(stmt, sink)?;
        self.words.numbers.waiting = Some(number);
        self.words.block.number = None;
        self.forget();
        Ok(())
    }

    /// The label of a block without words.
    pub(crate) fn number_alone(&mut self, sink: &mut Sink) {
        if !self.words.numbers.jumps || !self.words.block.is_empty() {
            return;
        }
        if let (Some(number), Some(letter)) = (self.words.numbers.waiting.take(), self.dialect.block.number) {
            self.words.block.text(Part::Label, &format!("{}{number}", char::from(letter as u8)));
            self.words.block.number = None;
            self.words.numbers.bare = true;
            self.words.flush(false, sink);
            self.words.numbers.bare = false;
        }
    }

    /// What comes next goes another way: what waits is written, and the block is one of its own.
    pub(in crate::word) fn flow(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.call_up_now(stmt, sink)?;
        if !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        Ok(())
    }

    pub(in crate::word) fn statement_alone(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        if !self.has_o_words() && !self.words.block.is_empty() {
            // It counts when what stands before it has been read.
            self.words.flush(false, sink);
            self.words.split = true;
        }
        self.words.admit(&Need::new(Rank::Alone), sink)?;
        self.words.block.text(Part::Tail, text);
        Ok(())
    }

    /// A value for a variable.
    pub(crate) fn assign(
        &mut self,
        to: &Target,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        if self.has_o_words()
            && let Target::Var(var) = to
            && self.o_result(var, value)?
        {
            return Ok(());
        }
        let text = self.assignment(to, value, span, sink)?;
        // What another language sets when its block is over stands after the block here.
        if !self.has_o_words() && !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        self.statement_alone(&text, sink)
    }

    pub(in crate::word) fn assignment(
        &mut self,
        to: &Target,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        self.words.spelling(None)?;
        self.variable_changes(to, span, sink)?;
        let value = match value {
            // Where a value is no sum without brackets.
            Expr::Node(_) if self.has_o_words() => self.words.behind(value, None, span, sink)?,
            _ => self.words.expression(value, span, sink)?,
        };
        Ok(self.sets(&self.words.spelling(None)?.target(to)?, &value))
    }

    /// A text in which something is set to something.
    pub(in crate::word) fn sets(&self, to: &str, value: &str) -> String {
        let blank = if self.dialect.block.blanks { " " } else { "" };
        format!("{to}{blank}={blank}{value}")
    }

    /// A variable gets another value: what was stated with it is not what the same words would say now. A cycle that
    /// is computed from it is activated before.
    fn variable_changes(&mut self, to: &Target, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if !self.held.as_ref().is_some_and(|held| held.reads(to)) {
            return Ok(());
        }
        self.call_up_now(&Stmt::new(span, Op::Blank), sink)?;
        if self.held.as_ref().is_some_and(|held| !held.in_text) {
            return Err(cannot_compute(RunTimeWord::CycleAssignment));
        }
        self.held = None;
        Ok(())
    }

    /// A jump.
    pub(crate) fn go_to(&mut self, label: &str, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.words.spelling(None)?;
        self.flow(stmt, sink)?;
        let text = self.jump(label)?;
        self.statement_alone(&text, sink)
    }

    /// The number of the block that a label is.
    pub(in crate::word) fn number_of_label(&self, label: &str) -> Option<u32> {
        self.computing.numbers.get(label).copied()
    }

    fn jump(&self, label: &str) -> Result<String, Fault> {
        let number = self.computing.numbers.get(label);
        let number = number.ok_or_else(|| Fault::LabelUnknown { name: label.into() })?;
        let blank = if self.dialect.block.blanks { " " } else { "" };
        Ok(format!("GOTO{blank}{number}"))
    }

    /// A branch or a loop.
    pub(crate) fn control(&mut self, control: &Control, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.words.spelling(None)?;
        let computes = self.dialect.caps.flow.computes.as_ref();
        if let Some(entry) = computes.and_then(|computes| computes.computed_entry(control)) {
            return self.entry_of_number(&entry, stmt, sink);
        }
        if self.has_o_words() {
            return self.o_structure(control, stmt, sink);
        }
        if let Some(call) = computed_call(control).filter(|_| self.dialect.program.macro_b) {
            return self.computed_call(&call, stmt, sink);
        }
        if let Some(code) = computed_code(control).filter(|_| self.dialect.program.macro_b) {
            return self.code_of_variable(&code, stmt, sink);
        }
        match control {
            Control::If { condition, then, otherwise } => match (&then[..], &otherwise[..]) {
                ([Stmt { op: Op::Message(text), .. }, stop], []) => {
                    self.stop_text = Some(text.clone());
                    self.decide(condition, stop, stmt, sink)
                }
                ([only], []) => self.decide(condition, only, stmt, sink),
                _ => Err(cannot_compute(RunTimeFlow::DecisionStatements)),
            },
            Control::While { condition, body } => self.turns(Some(condition), body, stmt, sink),
            Control::Loop { body } => self.turns(None, body, stmt, sink),
            Control::Repeat { .. } => Err(cannot_compute(RunTimeFlow::LoopTimes)),
            Control::For { .. } => Err(cannot_compute(RunTimeFlow::LoopCounts)),
            Control::Until { .. } => Err(cannot_compute(RunTimeFlow::LoopTestedAfter)),
        }
    }

    fn decide(&mut self, condition: &Expr, then: &Stmt, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let blank = if self.dialect.block.blanks { " " } else { "" };
        let text = if let Op::Goto(label) = &then.op {
            self.flow(stmt, sink)?;
            let condition = self.words.condition(condition, stmt.span, sink)?;
            format!("IF{blank}{condition}{blank}{}", self.jump(label)?)
        } else if let Op::Assign(to, value) = &then.op {
            let condition = self.words.condition(condition, stmt.span, sink)?;
            let assignment = self.assignment(to, value, stmt.span, sink)?;
            format!("IF{blank}{condition}{blank}THEN{blank}{assignment}")
        } else if let Op::Alarm(alarm) = &then.op {
            let condition = self.words.condition(condition, stmt.span, sink)?;
            format!("IF{blank}{condition}{blank}THEN{blank}{}", self.alarm_setting(alarm, stmt, sink)?)
        } else if let Op::ProgramStop = &then.op {
            let condition = self.words.condition(condition, stmt.span, sink)?;
            format!("IF{blank}{condition}{blank}THEN{blank}{}", self.stop_setting(stmt, sink)?)
        } else {
            return Err(cannot_compute(RunTimeFlow::DecisionStatement));
        };
        self.statement_alone(&text, sink)
    }

    fn turns(
        &mut self,
        condition: Option<&Expr>,
        body: &[Stmt],
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        if self.computing.open >= self.dialect.formula.loops {
            return Err(cannot_compute(RunTimeFlow::LoopDepth));
        }
        if stmt.skip.is_some() {
            return Err(cannot_compute(RunTimeFlow::LoopSkipped));
        }
        self.flow(stmt, sink)?;
        let number = self.computing.open + 1;
        let blank = if self.dialect.block.blanks { " " } else { "" };
        let head = match condition {
            Some(condition) => {
                format!("WHILE{blank}{}{blank}DO{number}", self.words.condition(condition, stmt.span, sink)?)
            }
            None => format!("DO{number}"),
        };
        self.statement_alone(&head, sink)?;
        let split = self.words.split;
        self.words.flush(false, sink);
        self.words.block_written(sink.out);
        // Its beginning is come to from its end as well.
        self.forget();
        self.computing.open = number;
        self.body(body, sink);
        self.computing.open = number - 1;
        self.open_block(&Stmt::new(stmt.span, Op::Blank));
        self.words.split = split;
        if let Some(trace) = &mut self.words.trace {
            trace.enter(std::slice::from_ref(stmt));
        }
        self.forget();
        self.statement_alone(&format!("END{number}"), sink)
    }

    /// Whether a program is called that has variables of its own.
    pub(crate) fn calls_with_variables(&self, call: &Call) -> bool {
        !call.arguments.is_empty() || self.computing.variables && !call.shared
    }

    /// A call with variables of its own.
    pub(crate) fn macro_call(&mut self, call: &Call, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        self.words.spelling(None)?;
        if self.has_o_words() {
            return self.o_call(call, stmt, sink);
        }
        let words = match self.at_moves {
            AtMoves::Begins => self.words.codes.calls_at_moves.map(|(call, _)| call),
            AtMoves::None | AtMoves::Within => self.words.codes.macro_call,
        };
        let words = words.ok_or_else(|| cannot_compute(RunTimeFlow::CallArguments))?;
        self.flow(stmt, sink)?;
        let number = self.program_number(&call.name)?;
        let least = if self.dialect.program.padded_calls { self.dialect.program.number_digits } else { 0 };
        let arguments = self.arguments(call, stmt.span, sink)?;
        let mut need = Need::new(Rank::Alone).code(Some(words.code)).letter(words.number);
        let count = match (call.times, words.count) {
            (0, _) => return Err(cannot(FlowLack::CallNoTimes)),
            (1, _) => None,
            (2..=MOST_TIMES, Some(letter)) if self.dialect.formula.arguments_again => Some(letter),
            (2..=MOST_TIMES, _) => {
                return Err(cannot_compute(RunTimeFlow::CallOwnAgain));
            }
            _ => return Err(Fault::TargetRange { word: call.times.to_string().into() }),
        };
        if let Some(letter) = count {
            need = need.letter(letter);
        }
        self.words.admit(&need, sink)?;
        self.words.block.code(Part::Tail, &words.code);
        self.words.block.digits(Part::Tail, words.number, &format!("{number:0least$}"));
        if let Some(letter) = count {
            self.words.block.digits(Part::Tail, letter, &call.times.to_string());
        }
        for (letter, text) in arguments {
            self.words.block.digits(Part::Tail, letter, &text);
        }
        self.forget();
        Ok(())
    }

    /// The words of a call's arguments.
    fn arguments(&mut self, call: &Call, span: Span, sink: &mut Sink) -> Result<Vec<(u8, String)>, Fault> {
        let mut given: BTreeMap<u32, &Expr> = BTreeMap::new();
        let parameters = self.computing.parameters.get(&call.name).cloned().unwrap_or_default();
        if parameters.len() < call.arguments.len() {
            return Err(cannot_compute(RunTimeFlow::CallMoreArguments));
        }
        for (parameter, value) in parameters.iter().zip(&call.arguments) {
            let vacant = matches!(value, Expr::Node(node) if **node == Node::Vacant);
            let number = number_of(parameter, &self.dialect.formula.prefix)?
                .parse()
                .ok()
                .filter(|_| matches!(parameter, Var::Local(_)));
            let number = number.ok_or_else(|| cannot_compute(RunTimeFlow::ArgumentNotLocal))?;
            if !vacant {
                given.insert(number, value);
            }
        }
        let places: Vec<u32> = given.keys().copied().collect();
        let letters = letters_for(&places).ok_or_else(|| cannot_compute(RunTimeFlow::ArgumentLetters))?;
        letters
            .into_iter()
            .filter_map(|(letter, place)| Some((letter, *given.get(&place)?)))
            .map(|(letter, value)| Ok((letter, self.argument(letter, value, span, sink)?)))
            .collect()
    }

    /// An argument; with a point, it counts what it says, whatever its letter.
    fn argument(&mut self, letter: u8, value: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        let Some(n) = value.literal() else {
            if rounds(value) {
                // To which digits it would round there, no manual says.
                return Err(cannot_compute(RunTimeFlow::ArgumentRounded));
            }
            return self.words.behind(value, None, span, sink);
        };
        let mut text = String::new();
        literal(n, n.point || !b"DHMST".contains(&letter), &mut text);
        Ok(text)
    }
}

/// Whether anything in an expression is rounded to a whole number.
fn rounds(e: &Expr) -> bool {
    e.has(&|node| matches!(node, Node::Call(Function::Round, _)))
}

/// The letters by which these variables are given values, in their order: a letter each, or with `I`, `J` and `K` in
/// further sets; `None` if there are no such letters.
fn letters_for(places: &[u32]) -> Option<Vec<(u8, u32)>> {
    let own = |place: &u32| LETTERS.iter().find(|(_, own)| own == place).copied();
    if places.iter().all(|place| own(place).is_some()) {
        return Some(LETTERS.iter().filter(|(_, own)| places.contains(own)).copied().collect());
    }
    let mut found: Vec<(u8, u32)> = Vec::new();
    for place in places {
        found.push(match place {
            1..=3 => own(place)?,
            4..=33 => (b"IJK"[(*place as usize - 4) % 3], *place),
            _ => return None,
        });
    }
    // Read again, they must be the same variables.
    let (mut set, mut last) = (0, None);
    let same = found.iter().filter(|(_, place)| *place > 3).all(|(letter, place)| {
        let within = u32::from(letter - b'I');
        set += u32::from(last.is_some_and(|last| within <= last));
        last = Some(within);
        4 + 3 * set + within == *place
    });
    same.then_some(found)
}

/// Labels and jumps of a procedure.
#[derive(Default)]
struct Jumps {
    /// Labels, each with the number of its block.
    labels: Vec<(Text, Option<u32>)>,
    targets: BTreeSet<Text>,
    numbers: BTreeSet<u32>,
}

impl Jumps {
    fn body(&mut self, body: &[Stmt]) {
        for stmt in body {
            self.numbers.extend(stmt.number);
            self.numbers
                .extend(packed(stmt).into_iter().flat_map(PackedLines::unpack).filter_map(|s| s.number));
            if let Op::Label(name) = &stmt.op {
                self.labels.push((name.clone(), stmt.number));
            } else if let Op::Goto(name) = &stmt.op {
                self.targets.insert(name.clone());
            } else if let Op::Control(control) = &stmt.op {
                control.bodies().for_each(|body| self.body(body));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spelt(places: &[u32]) -> Option<String> {
        let letters = letters_for(places)?;
        Some(letters.into_iter().map(|(letter, _)| char::from(letter)).collect())
    }

    #[test]
    fn arguments_have_the_letters_that_name_their_variables() {
        assert_eq!(spelt(&[1, 4, 5, 24]).as_deref(), Some("AIJX"));
        assert_eq!(spelt(&[26, 24, 18]).as_deref(), Some("RXZ"));
        // Tenth and twelfth have no letter of their own: further sets of I, J and K.
        assert_eq!(spelt(&[4, 7, 10]).as_deref(), Some("III"));
        assert_eq!(spelt(&[1, 4, 5, 6, 7, 8, 9, 10]).as_deref(), Some("AIJKIJKI"));
        // A set of which nothing is given cannot be passed over.
        assert_eq!(spelt(&[4, 10]), None);
        assert_eq!(spelt(&[10]), None);
        assert_eq!(spelt(&[4, 8, 12]), None);
        assert_eq!(spelt(&[34]), None);
    }
}
