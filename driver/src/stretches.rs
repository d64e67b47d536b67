//! Long stretches of straight moves of a program that is kept whole: packed as they are read, with statements of them left
//! in front and behind that stand for them.
//!
//! ```text
//! 100,000 moves    some moves | LINES of the rest | some moves
//! ```
//!
//! Those in front have each kind of word that the stretch has: a step that would change one of its moves changes one of
//! them, too, which is looked for ([`stand`]). Those behind say each axis, and the feed, that it says: what follows the tool
//! may go past it.
//!
//! What is computed has a shape (`Z[0.5+#1]` is □ + #1). Steps may say a shape in another way, as variables have other names
//! there: then those that stand for the stretch have shown how, each of them in the same way and with the same numbers, and
//! the stretch's words are said so, too ([`reshape`]).
//!
//! Not here: how moves are packed ([`ncc_ir::program::packing`]), where a stretch begins and ends (`packer`), and which kinds
//! of words there are (`kinds`).

mod kinds;
mod packer;

use std::sync::Arc;

use ncc_ir::expr::Expr;
use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::shapes::{WordRole, WordShape};
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::source::Span;

pub(crate) use self::kinds::Words;
use self::packer::PROBES;
pub(crate) use self::packer::{Packer, pack};

/// Moves of a stretch of which fewer are not worth it.
pub const SHORTEST: usize = 64;

/// A stretch that is packed, and what stands for it.
#[derive(Debug)]
pub(crate) struct Stretch {
    lines: Arc<PackedLines>,
    before: Vec<Stmt>,
    behind: Vec<Stmt>,
}

/// The stretches of a body, and what stands for each.
pub(crate) fn stretches(body: &[Stmt]) -> Vec<Stretch> {
    let places = body.iter().enumerate().filter_map(|(at, stmt)| match &stmt.op {
        Op::Lines(lines) => Some((at, lines)),
        _ => None,
    });
    let stretch = |(at, lines): (usize, &Arc<PackedLines>)| {
        let before = body[at.saturating_sub(lines.probes())..at].to_vec();
        let behind = body[at + 1..body.len().min(at + 1 + PROBES)].to_vec();
        Stretch { lines: Arc::clone(lines), before, behind }
    };
    places.map(stretch).collect()
}

/// Whether moves of a body are packed of which words are computed.
pub(crate) fn computes_packed(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| matches!(&stmt.op, Op::Lines(lines) if !lines.shapes().is_empty()))
}

/// Puts the moves of packed stretches in their places again.
pub(crate) fn unpack(body: &mut Vec<Stmt>) {
    if body.iter().any(|stmt| matches!(stmt.op, Op::Lines(_))) {
        let packed = std::mem::take(body);
        for stmt in packed {
            match &stmt.op {
                Op::Lines(lines) => body.extend(lines.unpack()),
                _ => body.push(stmt),
            }
        }
    }
}

/// A program with all of its moves.
pub(crate) fn unpacked(program: &Program) -> Program {
    let mut program = program.clone();
    program.procedures.iter_mut().for_each(|procedure| unpack(&mut procedure.body));
    program
}

/// What the shapes of one stretch have become.
pub(crate) type Reshaped = Vec<WordShape>;

/// Whether all stretches are in a body, in their order, and what stands for each is as it was but for the shapes of what
/// is computed; what became of the shapes of each stretch.
pub(crate) fn stand(stretches: &[Stretch], body: &[Stmt]) -> Option<Vec<Reshaped>> {
    let places = body.iter().enumerate().filter_map(|(at, stmt)| match &stmt.op {
        Op::Lines(lines) => Some((at, lines)),
        _ => None,
    });
    let mut left = stretches.iter();
    let mut all = Vec::new();
    for (at, lines) in places {
        let own = left.next().filter(|own| own.lines.are_moves_of(lines) && !lines.are_increments())?;
        let before = at.checked_sub(own.before.len()).map(|from| &body[from..at])?;
        let behind = body.get(at + 1..at + 1 + own.behind.len())?;
        let mut became = Became { lines, shapes: Vec::new() };
        let own_stmts = own.before.iter().chain(&own.behind);
        if !own_stmts.zip(before.iter().chain(behind)).all(|(own, other)| became.is_same(own, other)) {
            return None;
        }
        all.push(own.lines.shapes().iter().map(|shape| became.of(shape)).collect::<Option<_>>()?);
    }
    left.next().is_none().then_some(all)
}

/// Says the words of stretches in their new shapes.
pub(crate) fn reshape(body: &mut [Stmt], shapes: Vec<Reshaped>) {
    let mut shapes = shapes.into_iter();
    for stmt in body {
        if let Op::Lines(lines) = &mut stmt.op
            && let Some(shapes) = shapes.next()
            && lines.shapes() != shapes
        {
            Arc::make_mut(lines).reshape(shapes);
        }
    }
}

/// What shapes have become in the statements that stand for a stretch.
struct Became<'l> {
    lines: &'l PackedLines,
    shapes: Vec<[WordShape; 2]>,
}

impl Became<'_> {
    /// Whether a statement is as it was, but for what became of its shapes, which is the same wherever they are.
    fn is_same(&mut self, own: &Stmt, other: &Stmt) -> bool {
        let mut own = own.clone();
        self.lines.settle_as_these(&mut own);
        if let (Op::StraightFeed(from), Op::StraightFeed(to))
        | (Op::StraightTraverse(from), Op::StraightTraverse(to)) = (&mut own.op, &other.op)
        {
            for (from, to) in from.to.axes.iter_mut().zip(&to.to.axes) {
                let (Some(from), Some(to)) = (from, to) else { continue };
                if matches!(from.value, Expr::Node(_)) {
                    if !self.became(WordRole::Axis, &from.value, &to.value) {
                        return false;
                    }
                    from.value = to.value.clone();
                }
            }
        }
        if let (Op::SetFeedRate(from @ Expr::Node(_)), Op::SetFeedRate(to)) = (&mut own.op, &other.op) {
            if !self.became(WordRole::Feed, from, to) {
                return false;
            }
            *from = to.clone();
        }
        own.op == other.op && own.skip == other.skip && own.joined == other.joined
    }

    /// Whether a word has become this, with the same numbers, as all of its shape have.
    fn became(&mut self, role: WordRole, from: &Expr, to: &Expr) -> bool {
        let Some(own) = WordShape::of(role, from) else { return from == to };
        let Some(new) = own.become_of(from, to) else { return false };
        match self.shapes.iter().find(|[own, _]| own.fits(role, from)) {
            Some([_, known]) => known.fits(role, to),
            None => {
                self.shapes.push([own, new]);
                true
            }
        }
    }

    fn of(&self, shape: &WordShape) -> Option<WordShape> {
        let found = self.shapes.iter().find(|[own, _]| own.fits(shape.role(), shape.expr()));
        found.map(|[_, new]| new.clone())
    }
}

/// The places of those that stand for stretches.
#[derive(Debug)]
pub(crate) struct Places {
    /// Where they begin and end, by where they begin; each end is the furthest of those so far.
    spans: Vec<(u32, u32)>,
}

impl Places {
    pub(crate) fn of(stretches: &[Stretch]) -> Places {
        let all = stretches.iter().flat_map(|stretch| stretch.before.iter().chain(&stretch.behind));
        let mut spans: Vec<(u32, u32)> = all.map(|stmt| (stmt.span.start, stmt.span.end)).collect();
        spans.sort_unstable();
        let mut furthest = 0;
        for (_, end) in &mut spans {
            furthest = furthest.max(*end);
            *end = furthest;
        }
        Places { spans }
    }

    /// Whether a place is in one of them.
    pub(crate) fn concern(&self, at: Span) -> bool {
        let before = self.spans.partition_point(|(start, _)| *start <= at.start);
        before.checked_sub(1).is_some_and(|last| at.start < self.spans[last].1)
    }
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_exec::world::World;
    use ncc_exec::{Exec, Runner};
    use ncc_frontends::{Batch, Reader};
    use ncc_ir::canon::{Distance, Fact};
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::expr::{Node, Var};
    use ncc_ir::program::{Procedure, Program};

    use super::kinds::bits as bits_of;
    use super::*;
    use ncc_ir::program::packing::packs;

    fn read(text: &str) -> Vec<Stmt> {
        let mut reader = Reader::new(Settings::new(builtin("fanuc").expect("a built-in dialect")), true);
        let mut batch = Batch::default();
        reader.read(text.as_bytes(), 0, &mut batch);
        batch.stmts
    }

    const HEAD: &str = "G21 G17 G90 G94 G54\nG00 X0. Y0. Z5.\nG01 Z-1. F100.\n";

    /// What is packed and unpacked is as it was, and what is behind a stretch says all that it says.
    #[test]
    fn what_stands_behind_a_stretch_says_all_of_it() {
        let mut text = HEAD.to_owned();
        for n in 0..3000 {
            let feed = if n % 50 == 0 { format!(" F{}.", 100 + n) } else { String::new() };
            let z = if n % 40 == 3 { format!(" Z-{}.", n % 9) } else { String::new() };
            let rapid = if n == 1500 { "G00 Z5.\nX3.\nG01 Z-1.\n" } else { "" };
            text += &format!("{rapid}X{n}.5 Y{}.{z}{feed}\n", n % 7);
        }
        let own = read(&text);
        let mut body = own.clone();
        pack(&mut body, SHORTEST, Words::All);
        let stretches = stretches(&body);
        assert!(stretches.len() >= 2 && body.len() < own.len() / 4, "{} {}", stretches.len(), body.len());
        assert!(stand(&stretches, &body).is_some());
        for (at, stmt) in body.iter().enumerate() {
            let Op::Lines(lines) = &stmt.op else { continue };
            let all: Vec<Stmt> = lines.unpack().collect();
            let said = |stmts: &[Stmt]| stmts.iter().fold(0, |bits, stmt| bits | bits_of(stmt) & 0x7F);
            let axes = |bits: u32| bits & 7 | bits >> 3 & 7 | bits & 1 << 6;
            let behind = body[at + 1..].iter().take_while(|stmt| !matches!(stmt.op, Op::Lines(_)));
            let behind: Vec<Stmt> = behind.take_while(|stmt| packs(stmt)).cloned().collect();
            assert_eq!(axes(said(&all)) & !axes(said(&behind)), 0);
            assert_eq!(said(&all) & !said(&body[..at]), 0);
        }
        unpack(&mut body);
        assert_eq!(body, own);
    }

    /// Increments are no stretch, whether the text says that they are or what is active where it is executed.
    #[test]
    fn increments_are_not_packed() {
        let moves: String = (0..200).map(|n| format!("X{n}.5\n")).collect();
        let mut body = read(&format!("{HEAD}G91\n{moves}"));
        pack(&mut body, SHORTEST, Words::All);
        assert!(stretches(&body).is_empty());
        let mut body = read(&format!("{HEAD}{moves}"));
        let words = body.iter_mut().filter_map(|stmt| match &mut stmt.op {
            Op::StraightFeed(to) => Some(to.to.axes.iter_mut().flatten()),
            _ => None,
        });
        words.flatten().for_each(|word| word.distance = Fact::Entry);
        pack(&mut body, SHORTEST, Words::All);
        let stretches = stretches(&body);
        assert!(!stretches.is_empty() && stand(&stretches, &body).is_some());
        for stmt in &mut body {
            match &mut stmt.op {
                Op::Lines(lines) => Arc::make_mut(lines).settle(None, Some(Distance::Incremental)),
                Op::StraightFeed(to) => to.to.axes.iter_mut().flatten().for_each(|word| {
                    word.distance = Fact::Known(Distance::Incremental);
                }),
                _ => {}
            }
        }
        assert!(stand(&stretches, &body).is_none());
    }

    #[test]
    fn a_change_beside_a_stretch_is_seen() {
        let moves: String = (0..200).map(|n| format!("X{n}.5\n")).collect();
        let mut body = read(&format!("{HEAD}{moves}"));
        pack(&mut body, SHORTEST, Words::All);
        let stretches = stretches(&body);
        let at = body.iter().position(|stmt| matches!(stmt.op, Op::Lines(_))).expect("a stretch");
        for place in [at - 1, at + 1] {
            let mut other = body.clone();
            other[place].op = Op::Blank;
            assert!(stand(&stretches, &other).is_none());
        }
        body.remove(at);
        assert!(stand(&stretches, &body).is_none());
    }

    /// Moves and feeds by what is computed, of three shapes; the feed has one that an axis has too.
    fn computed() -> String {
        let word = |n: u32| match n % 3 {
            0 => format!("Y[#2-{}.]", n % 7),
            1 => format!("F[#1+{}.]", n % 50 + 200),
            _ => "F#3".to_owned(),
        };
        (0..300).map(|n| format!("X[#1+{n}.5]{}\n", word(n))).collect()
    }

    /// Says local variables as ones that all programs see.
    fn renamed(stmt: &mut Stmt) {
        fn rename(expr: &mut Expr) {
            if let Expr::Node(node) = expr
                && let Node::Var(var @ Var::Local(_)) = &mut **node
            {
                *var = Var::Common(format!("R{}", var.name()).into());
            }
            expr.parts_mut().for_each(rename);
        }
        match &mut stmt.op {
            Op::StraightFeed(to) => to.to.axes.iter_mut().flatten().for_each(|word| rename(&mut word.value)),
            Op::SetFeedRate(feed) => rename(feed),
            _ => {}
        }
    }

    /// What is done to the words in front is done to all of them, as if they had been there.
    #[test]
    fn a_stretch_is_said_in_the_shapes_beside_it() {
        let mut body = read(&format!("{HEAD}{}", computed()));
        let mut own = body.clone();
        pack(&mut body, SHORTEST, Words::All);
        let stretches = stretches(&body);
        assert!(stretches.len() == 1 && body.len() < own.len() / 2, "{} {}", stretches.len(), body.len());
        body.iter_mut().chain(&mut own).for_each(renamed);
        let shapes = stand(&stretches, &body).expect("the same moves");
        reshape(&mut body, shapes);
        unpack(&mut body);
        assert_eq!(body, own);
        // The source's are as they were.
        assert!(stretches[0].lines.unpack().any(|stmt| reads_local(&stmt)));
        let mut literals = read(&format!("{HEAD}{}", computed()));
        pack(&mut literals, SHORTEST, Words::Literal);
        assert!(super::stretches(&literals).is_empty());
    }

    fn reads_local(stmt: &Stmt) -> bool {
        let mut other = stmt.clone();
        renamed(&mut other);
        other != *stmt
    }

    /// One of its shapes that is stated in two ways, or with another number, is a change.
    #[test]
    fn shapes_that_are_not_said_alike_are_seen() {
        let mut body = read(&format!("{HEAD}{}", computed()));
        pack(&mut body, SHORTEST, Words::All);
        let stretches = stretches(&body);
        let at = body.iter().position(|stmt| matches!(stmt.op, Op::Lines(_))).expect("a stretch");
        for place in [at - 1, at + 1] {
            let mut other = body.clone();
            renamed(&mut other[place]);
            assert!(stand(&stretches, &other).is_none());
            let mut other = body.clone();
            let Op::StraightFeed(to) = &mut other[place].op else { panic!("a move") };
            let word = to.to.axes[0].as_mut().expect("its X");
            let numbered = WordShape::of(WordRole::Axis, &word.value).expect("a shape");
            word.value = numbered.with(&[Num { scale: 1, point: true, ..Num::int(1, Unit::One) }]);
            assert!(stand(&stretches, &other).is_none());
        }
    }

    /// Packed moves are executed as all of them are: to the same events, and to the same fault in the same place.
    #[test]
    fn packed_moves_are_worth_what_their_words_are() {
        let events = |before: &str, moves: &str, packs: bool| {
            let mut body = read(&format!("{HEAD}{before}{moves}"));
            if packs {
                pack(&mut body, SHORTEST, Words::All);
            }
            assert_eq!(!stretches(&body).is_empty(), packs);
            let procedures = vec![Procedure { body, ..Procedure::default() }];
            let program = Program { procedures, ..Program::default() };
            let world = World::generate(1, &program.assumed);
            let (mut exec, mut runner, mut events) =
                (Exec::new(&world, 0), Runner::new(&program), Vec::new());
            let came = runner.run(&mut exec, usize::MAX, &mut events);
            (events, came)
        };
        let none = ["", "#1=1.\n", "#1=1.2345\n#2=-3.00051\n", "#3=70.5\n"];
        let faulty = ["#1=1E14\n#2=1.\n", "#1=-240.\n#3=9.\n", "#3=0.\n", "#3=-1.\n"];
        let moves = computed();
        for before in none.into_iter().chain(faulty) {
            assert_eq!(events(before, &moves, true), events(before, &moves, false), "{before}");
        }
        let (all, came) = events("#1=2.\n#2=7.\n", &moves, true);
        assert!(all.len() > 290 && came.is_ok());
        // An inverse time has no unit of length.
        let timed: String = (0..300).map(|n| format!("X{n}.5 F[#2+{}.]\n", n % 9 + 1)).collect();
        for modes in ["G93\n", "G20\nG93\n", "G20\n"] {
            let before = format!("{modes}#2=0.25\n");
            let packed = events(&before, &timed, true);
            assert!(packed.0.len() > 290 && packed.1.is_ok(), "{modes}");
            assert_eq!(packed, events(&before, &timed, false), "{modes}");
        }
    }
}
