//! Jumps made into branches and loops, for a target that has none.
//!
//! A jump back makes a loop of what it goes over; a jump ahead, in a branch, makes what it goes over the branch's
//! other branch. What jumps out of a loop leaves it; where it goes further than after the loop, or from within a
//! branch, a variable of its own says so, and after the loop or the IF the jump is made by that. Nothing is
//! executed in another order, or twice. A jump into the middle of a loop goes to its head, and on from there. One that a switch may skip stays.

mod labels;

use std::collections::{BTreeMap, BTreeSet};

use self::labels::{at_place, labels, of_stmt, position, position_from, targets, times, without_labels};
use crate::flow::control_forms::conditions::opposite;
use crate::flow::control_forms::ends_elsewhere;
use crate::flow::control_forms::names::Names;
use ncc_ir::expr::{Binary, Expr, Node, Target, Var};
use ncc_ir::program::{Control, Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;

/// Most steps that are taken for a procedure.
const MOST_STEPS: u32 = 20_000;

/// Makes the jumps of a procedure, of which the labels have one name each, into structures.
pub(super) fn structure_jumps(procedure: &mut Procedure, names: &mut Names, word: bool) {
    if targets(&procedure.body).is_empty() {
        return;
    }
    let mut structures = Structures { names, word, steps: 0, open: 0 };
    let body = std::mem::take(&mut procedure.body);
    procedure.body = structures.list(body, &BTreeSet::new());
    let left = targets(&procedure.body);
    without_labels(&mut procedure.body, &left);
    turn_round(&mut procedure.body, word);
}

/// Puts statements in the place of jumps that are in no loop within, by their labels.
fn replace(body: &mut Vec<Stmt>, with: &mut dyn FnMut(&Text, Span) -> Option<Vec<Stmt>>) {
    let mut out = Vec::with_capacity(body.len());
    for mut stmt in std::mem::take(body) {
        if let Op::Goto(name) = &stmt.op
            && stmt.skip.is_none()
            && let Some(own) = with(name, stmt.span)
        {
            let begins = out.len();
            out.extend(own);
            if let Some(first) = out.get_mut(begins) {
                (first.number, first.joined) = (stmt.number, stmt.joined);
            }
            if let Some(last) = out.last_mut().filter(|last| last.comment.is_none()) {
                last.comment = stmt.comment.take();
            }
            continue;
        }
        if let Op::Control(control) = &mut stmt.op
            && let Control::If { then, otherwise, .. } = &mut **control
        {
            replace(then, with);
            replace(otherwise, with);
        }
        out.push(stmt);
    }
    *body = out;
}

/// Whether a body leaves its turn, or its loop, itself.
fn has(body: &[Stmt], is: fn(&Op) -> bool) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Control(control) => match &**control {
            Control::If { then, otherwise, .. } => has(then, is) || has(otherwise, is),
            _ => false,
        },
        op => is(op),
    })
}

struct Structures<'n> {
    names: &'n mut Names,
    /// Whether the opposite of a number has a word.
    word: bool,
    steps: u32,
    /// Loops that are open.
    open: u32,
}

impl Structures<'_> {
    /// A list of statements; where it ends is where the labels of `behind` are.
    fn list(&mut self, stmts: Vec<Stmt>, behind: &BTreeSet<Text>) -> Vec<Stmt> {
        self.steps += 1;
        if self.steps > MOST_STEPS || targets(&stmts).is_empty() {
            return stmts;
        }
        let mut out = Vec::with_capacity(stmts.len());
        let inner = stmts;
        for at in 0..inner.len() {
            let mut stmt = inner[at].clone();
            let here = at_place(&inner, at + 1, behind);
            let mut turns = false;
            if let Op::Control(control) = &mut stmt.op {
                turns = !matches!(**control, Control::If { .. });
                let behind = if turns { BTreeSet::new() } else { here.clone() };
                for body in control.bodies_mut() {
                    let own = std::mem::take(body);
                    *body = if turns { self.turns(own) } else { self.list(own, &behind) };
                }
            }
            if turns { self.escapes(stmt, &here, &mut out) } else { out.push(stmt) }
        }
        self.backward(&mut out, behind);
        self.forward(&mut out, behind);
        out
    }

    /// The body of a loop.
    fn turns(&mut self, body: Vec<Stmt>) -> Vec<Stmt> {
        self.open += 1;
        let mut body = self.list(body, &BTreeSet::new());
        let words = [Op::Leave, Op::NextTurn].map(|word| (self.place(&word), word));
        replace(&mut body, &mut |name, span| {
            let (_, word) = words.iter().find(|(place, _)| place == name)?;
            Some(vec![Stmt::new(span, word.clone())])
        });
        self.open -= 1;
        body
    }

    /// Where a word goes that leaves the innermost loop, or its turn: no label of a program has this name.
    fn place(&self, word: &Op) -> Text {
        format!("{} {}", word.name(), self.open).into()
    }

    /// Makes jumps of the words that leave a loop, or its turn, where another loop comes between.
    fn words_as_jumps(&self, body: &mut [Stmt]) {
        for stmt in body {
            match &mut stmt.op {
                Op::Leave | Op::NextTurn => stmt.op = Op::Goto(self.place(&stmt.op)),
                Op::Control(control) => {
                    if let Control::If { then, otherwise, .. } = &mut **control {
                        self.words_as_jumps(then);
                        self.words_as_jumps(otherwise);
                    }
                }
                _ => {}
            }
        }
    }

    fn flag(&mut self) -> Var {
        self.names.counter("LEFT")
    }

    /// A loop out of which there are jumps: to where it is left, or further.
    fn escapes(&mut self, mut stmt: Stmt, here: &BTreeSet<Text>, out: &mut Vec<Stmt>) {
        let span = stmt.span;
        let mut further: Vec<Text> = Vec::new();
        let Op::Control(control) = &mut stmt.op else { return out.push(stmt) };
        let jumps = targets(control.bodies().next().map_or(&[][..], |body| body));
        let beyond = jumps.iter().any(|name| !here.contains(name));
        if jumps.is_empty() || stmt.skip.is_some() {
            return out.push(stmt);
        }
        let flag = beyond.then(|| self.flag());
        for body in control.bodies_mut() {
            replace(body, &mut |name, span| {
                let leave = Stmt::new(span, Op::Leave);
                if here.contains(name) {
                    return Some(vec![leave]);
                }
                let at = further.iter().position(|own| own == name).unwrap_or_else(|| {
                    further.push(name.clone());
                    further.len() - 1
                });
                Some(vec![assign(span, flag.as_ref()?, at as i64 + 1), leave])
            });
        }
        if let Some(flag) = &flag {
            let mut first = assign(span, flag, 0);
            (first.number, first.joined) = (stmt.number.take(), std::mem::take(&mut stmt.joined));
            out.push(first);
        }
        out.push(stmt);
        if let Some(flag) = &flag {
            for (at, name) in further.into_iter().enumerate() {
                out.push(when_set(span, flag, at as i64 + 1, name));
            }
        }
    }

    /// Jumps back make loops.
    fn backward(&mut self, list: &mut Vec<Stmt>, behind: &BTreeSet<Text>) {
        loop {
            // The last statement from which there are jumps to each label.
            let mut sources: BTreeMap<Text, usize> = BTreeMap::new();
            for (at, stmt) in list.iter().enumerate() {
                sources.extend(of_stmt(stmt).into_iter().map(|name| (name, at)));
            }
            let found = list.iter().enumerate().find_map(|(at, stmt)| {
                let Op::Label(name) = &stmt.op else { return None };
                let last = sources.get(name).filter(|last| **last >= at)?;
                Some((at, *last, name.clone()))
            });
            let Some((first, last, name)) = found else { return };
            self.steps += 1;
            // What a switch may skip is no jump for sure.
            let region = &list[first + 1..=last];
            if self.steps > MOST_STEPS || skipped(list) {
                return;
            }
            let inside = labels(region);
            let outside: BTreeSet<Text> =
                list[..=first].iter().chain(&list[last + 1..]).flat_map(of_stmt).collect();
            if self.tested_first(list, first, last, &name) {
                continue;
            }
            let entries: Vec<Text> = inside.intersection(&outside).cloned().collect();
            if !entries.is_empty() {
                self.by_the_head(list, first, last, &name, &entries);
                continue;
            }
            let rest = list.split_off(last + 1);
            let mut body = list.split_off(first + 1);
            let span = body.first().map_or(Span::default(), |stmt| stmt.span);
            if let Some(first) = body.first_mut() {
                first.joined = false;
            }
            self.words_as_jumps(&mut body);
            replace(&mut body, &mut |to, span| (*to == name).then(|| vec![Stmt::new(span, Op::NextTurn)]));
            if !ends_elsewhere(&body) {
                body.push(Stmt::new(span, Op::Leave));
            }
            let here = at_place(&rest, 0, behind);
            let body = self.turns(body);
            let mut turned = Stmt::new(span, Op::Control(Box::new(Control::Loop { body })));
            let mut made = Vec::new();
            // Where it is left is what its jumps out of it go to.
            let plain = |op: &mut Op, word| {
                if let Op::Control(control) = op
                    && let Control::Loop { body } = &mut **control
                {
                    **control = with_condition(std::mem::take(body), word);
                }
            };
            let jumps = !of_stmt(&turned).is_empty();
            if !jumps {
                plain(&mut turned.op, self.word);
                made.push(turned);
            } else {
                self.escapes(turned, &here, &mut made);
                let word = self.word;
                made.iter_mut().for_each(|stmt| plain(&mut stmt.op, word));
            }
            list.extend(made);
            list.extend(rest);
        }
    }

    /// A loop whose test stands after its body and is jumped to from right before it: the test comes first.
    fn tested_first(&mut self, list: &mut Vec<Stmt>, first: usize, last: usize, head: &Text) -> bool {
        let entry = match first.checked_sub(1).map(|before| &list[before]) {
            Some(Stmt { op: Op::Goto(to), skip: None, .. }) => to.clone(),
            _ => return false,
        };
        let tested = position(list, &entry) == Some(last - 1) && last > first + 1;
        let sources =
            |name: &Text, body: &[Stmt]| body.iter().filter(|stmt| of_stmt(stmt).contains(name)).count();
        let within = sources(&entry, &list[first..=last]);
        if !tested || sources(&entry, list) != within + 1 || sources(head, list) != 1 {
            return false;
        }
        let Op::Control(control) = &list[last].op else { return false };
        let condition = match &**control {
            Control::If { condition, then, otherwise }
                if otherwise.is_empty() && matches!(&then[..], [one] if one.op == Op::Goto(head.clone())) =>
            {
                opposite(condition, self.word)
            }
            _ => return false,
        };
        let span = list[last].span;
        let over = self.names.label("OVER");
        let then = vec![Stmt::new(span, Op::Goto(over.clone()))];
        let test = Control::If { condition, then, otherwise: Vec::new() };
        let test = Stmt::new(span, Op::Control(Box::new(test)));
        let comment = list[last].comment.take();
        list[last] = Stmt { comment, ..Stmt::new(span, Op::Goto(head.clone())) };
        list.insert(last + 1, Stmt::new(span, Op::Label(over)));
        // What goes on with the next turn goes to the test, which is the head now.
        let mut body: Vec<Stmt> = list.splice(first + 1..=last, []).collect();
        replace(&mut body, &mut |to, span| {
            (*to == entry).then(|| vec![Stmt::new(span, Op::Goto(head.clone()))])
        });
        if let Some(first) = body.first_mut() {
            first.joined = false;
        }
        body.insert(0, test);
        list.splice(first + 1..first + 1, body);
        let jump = list.remove(first - 1);
        list[first - 1].number = list[first - 1].number.or(jump.number);
        true
    }

    /// Jumps into the middle of a loop go to its head, and on from there, as a variable says.
    fn by_the_head(
        &mut self,
        list: &mut Vec<Stmt>,
        first: usize,
        last: usize,
        head: &Text,
        entries: &[Text],
    ) {
        let flag = self.names.counter("ENTRY");
        let span = list[first].span;
        let rest = list.split_off(last + 1);
        let region = list.split_off(first + 1);
        let number = |name: &Text| entries.iter().position(|own| own == name).map(|at| at as i64 + 1);
        let outside = |mut body: Vec<Stmt>| {
            replace(&mut body, &mut |name, span| {
                let goto = Stmt::new(span, Op::Goto(head.clone()));
                Some(vec![assign(span, &flag, number(name)?), goto])
            });
            body
        };
        let before = outside(std::mem::take(list));
        let rest = outside(rest);
        list.push(assign(span, &flag, 0));
        list.extend(before);
        let ways = entries.iter().enumerate();
        list.extend(ways.map(|(at, name)| when_set(span, &flag, at as i64 + 1, name.clone())));
        let mut begins = true;
        for mut stmt in region {
            let entry = matches!(&stmt.op, Op::Label(name) if entries.contains(name));
            if std::mem::take(&mut begins) {
                stmt.joined = false;
            }
            let span = stmt.span;
            list.push(stmt);
            if entry {
                begins = true;
                list.push(assign(span, &flag, 0));
            }
        }
        list.extend(rest);
    }

    /// Jumps ahead make the other branches of IFs.
    fn forward(&mut self, list: &mut Vec<Stmt>, behind: &BTreeSet<Text>) {
        while self.put_in(list) {}
        let mut at = 0;
        while at < list.len() {
            self.steps += 1;
            if self.steps > MOST_STEPS {
                return;
            }
            if list[at].skip.is_some() || of_stmt(&list[at]).is_empty() {
                at += 1;
                continue;
            }
            let done = match &list[at].op {
                Op::Goto(name) => {
                    let name = name.clone();
                    self.over_dead(list, at, &name, behind)
                }
                Op::Control(control) if matches!(**control, Control::If { .. }) => {
                    self.decision(list, at, behind)
                }
                _ => false,
            };
            // A branch is looked at again, until it has no jumps.
            at += usize::from(!done);
        }
    }

    /// Blocks to which nothing comes but one jump are put in its place.
    fn put_in(&mut self, list: &mut Vec<Stmt>) -> bool {
        self.steps += 1;
        let all: BTreeSet<Text> = targets(list);
        let found = (1..list.len()).find_map(|at| {
            let Op::Label(name) = &list[at].op else { return None };
            let jumps = |body: &[Stmt]| body.iter().map(|stmt| times(stmt, name)).sum::<usize>();
            let alone = ends_elsewhere(&list[..at]) && jumps(&list[..at]) == 1 && jumps(&list[at..]) == 0;
            let targeted = |stmt: &Stmt| matches!(&stmt.op, Op::Label(own) if all.contains(own));
            let end = at + 1 + list[at + 1..].iter().position(targeted).unwrap_or(list.len() - at - 1);
            let behind = match list.get(end).map(|stmt| &stmt.op) {
                Some(Op::Label(behind)) => Some(behind.clone()),
                _ => None,
            };
            let over = behind.is_some() || ends_elsewhere(&list[at + 1..end]);
            (alone && over).then(|| (at, end, name.clone(), behind))
        });
        let Some((at, end, name, behind)) = found.filter(|_| self.steps <= MOST_STEPS) else { return false };
        let mut blocks: Vec<Stmt> = list.splice(at..end, []).collect();
        let span = blocks[0].span;
        if !ends_elsewhere(&blocks) {
            blocks.extend(behind.map(|behind| Stmt::new(span, Op::Goto(behind))));
        }
        let mut blocks = Some(blocks);
        replace(list, &mut |to, _| if *to == name { blocks.take() } else { None });
        true
    }

    /// A jump: what it goes over is never executed, unless something else jumps there.
    fn over_dead(&mut self, list: &mut Vec<Stmt>, at: usize, name: &Text, behind: &BTreeSet<Text>) -> bool {
        let end = match position_from(list, at, name) {
            Some(end) if end > at => end,
            None if behind.contains(name) => list.len(),
            _ => return false,
        };
        let inside = labels(&list[at + 1..end]);
        if !inside.is_empty() {
            let reached: BTreeSet<Text> = list[..at].iter().chain(&list[end..]).flat_map(of_stmt).collect();
            if inside.iter().any(|label| reached.contains(label)) {
                return false;
            }
        }
        let mut place = 0;
        list.retain(|stmt| {
            let gone = (at..end).contains(&place) && !matches!(stmt.op, Op::Comment(_));
            place += 1;
            !gone
        });
        true
    }

    /// An IF with a jump in a branch.
    fn decision(&mut self, list: &mut Vec<Stmt>, at: usize, behind: &BTreeSet<Text>) -> bool {
        let here = at_place(list, at + 1, behind);
        let span = list[at].span;
        let Op::Control(control) = &mut list[at].op else { return false };
        let Control::If { then, otherwise, .. } = &mut **control else { return false };
        // To right after it.
        for branch in [&mut *then, &mut *otherwise] {
            *branch = self.list(std::mem::take(branch), &here);
        }
        let ends = |branch: &[Stmt]| match branch.last() {
            Some(Stmt { op: Op::Goto(name), skip: None, .. }) => Some(name.clone()),
            _ => None,
        };
        let ends = [ends(then), ends(otherwise)];
        let jumps = [targets(then), targets(otherwise)];
        if jumps.iter().all(BTreeSet::is_empty) {
            return true;
        }
        // The nearer one first.
        let mut ways: Vec<(usize, usize)> = Vec::new();
        for (branch, name) in ends.iter().enumerate() {
            let Some(name) = name else { continue };
            match position_from(list, at, name) {
                Some(end) if end > at => ways.push((end, branch)),
                None if behind.contains(name) => ways.push((list.len(), branch)),
                _ => {}
            }
        }
        ways.sort_unstable();
        for (end, branch) in ways {
            let inside = labels(&list[at + 1..end]);
            if !inside.is_empty() {
                let mut reached: BTreeSet<Text> =
                    list[..at].iter().chain(&list[end..]).flat_map(of_stmt).collect();
                reached.extend(jumps[branch].iter().cloned());
                if inside.iter().any(|label| reached.contains(label)) {
                    continue;
                }
            }
            let moved: Vec<Stmt> = list.drain(at + 1..end).collect();
            let Op::Control(control) = &mut list[at].op else { return false };
            let Control::If { then, otherwise, .. } = &mut **control else { return false };
            let [jumping, other] = if branch == 0 { [then, otherwise] } else { [otherwise, then] };
            let jump = jumping.pop();
            if let (Some(comment), Some(last)) = (jump.and_then(|jump| jump.comment), jumping.last_mut()) {
                last.comment.get_or_insert(comment);
            }
            other.extend(moved);
            return true;
        }
        // From within a branch: said by a variable, and made after the IF.
        let known: BTreeSet<Text> = labels(list).into_iter().chain(behind.iter().cloned()).collect();
        let here = |name: &Text| known.contains(name) && position(list, name).is_none_or(|to| to > at);
        let found: Vec<Text> = jumps.iter().flatten().filter(|name| here(name)).cloned().collect();
        if found.is_empty() {
            return false;
        }
        let flag = self.flag();
        let end = self.names.label("OVER");
        let Op::Control(control) = &mut list[at].op else { return false };
        let ends_here = BTreeSet::from([end.clone()]);
        let mut left = 0;
        for body in control.bodies_mut() {
            replace(body, &mut |name, span| {
                let number = found.iter().position(|own| own == name)? as i64 + 1;
                let goto = Stmt::new(span, Op::Goto(end.clone()));
                Some(vec![assign(span, &flag, number), goto])
            });
            *body = self.list(std::mem::take(body), &ends_here);
            left += usize::from(targets(body).contains(&end));
        }
        if left > 0 {
            return false;
        }
        let mut first = assign(span, &flag, 0);
        (first.number, first.joined) = (list[at].number.take(), std::mem::take(&mut list[at].joined));
        let mut seen = BTreeSet::new();
        let jumps = found.iter().enumerate().filter(|(_, name)| seen.insert((*name).clone()));
        let jumps: Vec<Stmt> =
            jumps.map(|(number, name)| when_set(span, &flag, number as i64 + 1, name.clone())).collect();
        list.splice(at + 1..at + 1, jumps);
        list.insert(at, first);
        true
    }
}

/// IFs of which only the other branch is left.
fn turn_round(body: &mut [Stmt], word: bool) {
    for stmt in body {
        let Op::Control(control) = &mut stmt.op else { continue };
        control.bodies_mut().for_each(|body| turn_round(body, word));
        if let Control::If { condition, then, otherwise } = &mut **control
            && then.is_empty()
            && !otherwise.is_empty()
        {
            *condition = opposite(condition, word);
            std::mem::swap(then, otherwise);
        }
    }
}

fn assign(span: Span, to: &Var, value: i64) -> Stmt {
    Stmt::new(span, Op::Assign(Target::Var(to.clone()), Expr::int(value)))
}

/// A jump that is made if a variable says so.
fn when_set(span: Span, flag: &Var, number: i64, label: Text) -> Stmt {
    let value = Expr::Node(Box::new(Node::Var(flag.clone())));
    let condition = Expr::binary(Binary::Equal, value, Expr::int(number));
    let then = vec![Stmt::new(span, Op::Goto(label))];
    Stmt::new(span, Op::Control(Box::new(Control::If { condition, then, otherwise: Vec::new() })))
}

/// Whether a switch may skip a jump, or a branch with one.
fn skipped(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| {
        let within = match &stmt.op {
            Op::Control(control) => control.bodies().any(|body| skipped(body)),
            _ => false,
        };
        within || stmt.skip.is_some() && !of_stmt(stmt).is_empty()
    })
}

/// The condition of a branch that does nothing but this.
fn only(stmt: Option<&Stmt>, is: fn(&Op) -> bool) -> Option<&Expr> {
    let stmt = stmt.filter(|stmt| stmt.skip.is_none() && stmt.comment.is_none())?;
    let Op::Control(control) = &stmt.op else { return None };
    match &**control {
        Control::If { condition, then, otherwise } if otherwise.is_empty() => {
            matches!(&then[..], [one] if is(&one.op) && one.comment.is_none()).then_some(condition)
        }
        _ => None,
    }
}

/// An endless loop, by the condition under which it is left first or last.
fn with_condition(mut body: Vec<Stmt>, word: bool) -> Control {
    if body.last().is_some_and(|last| last.op == Op::NextTurn && last.comment.is_none()) {
        body.pop();
    }
    let leaves = |op: &Op| *op == Op::Leave;
    let again = |op: &Op| *op == Op::NextTurn;
    if let Some(condition) = only(body.first(), leaves) {
        let condition = opposite(condition, word);
        body.remove(0);
        return Control::While { condition, body };
    }
    if let Some(condition) = only(body.last(), leaves) {
        let condition = condition.clone();
        if !has(&body, again) {
            body.pop();
            return Control::Until { condition, body };
        }
    }
    if body.last().is_some_and(|last| last.op == Op::Leave && last.comment.is_none())
        && let Some(condition) = only(body.iter().nth_back(1), again)
    {
        let condition = opposite(condition, word);
        if !has(&body[..body.len() - 2], again) {
            body.truncate(body.len() - 2);
            return Control::Until { condition, body };
        }
        let then = vec![Stmt::new(body[0].span, Op::Leave)];
        body.truncate(body.len() - 2);
        let span = then[0].span;
        let leave = Control::If { condition, then, otherwise: Vec::new() };
        body.push(Stmt::new(span, Op::Control(Box::new(leave))));
    }
    Control::Loop { body }
}
