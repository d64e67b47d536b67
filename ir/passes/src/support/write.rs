//! What passes write: numbers made from positions, and blocks of which statements come and go.

use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::expr::num::{Nanos, Num, POW10, Unit};
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Coord, Move, Op, Point, Stmt};
use ncc_ir::source::Span;

/// Digits with which every length is exact that a program can write.
pub(crate) const EXACT: u8 = 9;

/// The literal nearest to a position, with at most `decimals` (0 to 9) digits after the point, half
/// away from zero.
pub(crate) fn rounded(nanos: Nanos, decimals: u8, unit: Unit) -> Num {
    match unit {
        Unit::Inch => {
            // A literal of nine digits after the point is finer than a nano, and none.
            let decimals = decimals.min(EXACT - 1);
            let value = i128::from(nanos) * 10 * i128::from(POW10[decimals as usize]);
            let inch = 254 * 1_000_000_000_i128;
            let half = if value < 0 { -inch / 2 } else { inch / 2 };
            // At most nine digits more than nanos have, divided by 254: fits.
            let mantissa = ((value + half) / inch) as i64;
            Num { mantissa, scale: decimals, point: true, unit }.trimmed()
        }
        Unit::One | Unit::Mm | Unit::Entry | Unit::Degree | Unit::Second => {
            Num::from_nanos(nanos, decimals, unit)
        }
    }
}

/// The literal of a position, with all its digits.
pub(crate) fn exact(nanos: Nanos, unit: Unit) -> Num {
    rounded(nanos, EXACT, unit)
}

/// The unit of an axis where lengths are in `length`.
pub(crate) fn unit_of(axis: Axis, length: Unit) -> Unit {
    if axis.is_rotary() { Unit::Degree } else { length }
}

/// An absolute word with a known position.
pub(crate) fn at(nanos: Nanos, axis: Axis, length: Unit) -> Coord {
    absolute(exact(nanos, unit_of(axis, length)))
}

/// Whether a word is surely measured from program zero.
pub(crate) fn is_absolute(coord: &Coord, in_force: Option<Distance>) -> bool {
    coord.distance.known().or(in_force) == Some(Distance::Absolute)
}

/// The same word, said to be absolute.
pub(crate) fn as_absolute(coord: &Coord) -> Coord {
    Coord { value: coord.value.clone(), distance: Fact::Known(Distance::Absolute) }
}

/// A point with one word.
pub(crate) fn only(axis: Axis, coord: Coord) -> Point {
    let mut to = Point::default();
    to.set(axis, coord);
    to
}

/// A rapid.
pub(crate) fn traverse(to: Point) -> Op {
    Op::StraightTraverse(Move { to, said: true })
}

/// A cut.
pub(crate) fn cut(to: Point) -> Op {
    Op::StraightFeed(Move { to, said: true })
}

/// Statements made from others, block by block: numbers and comments stay with their blocks.
#[derive(Debug)]
pub(crate) struct Rebuild {
    /// What has been made.
    pub(crate) out: Vec<Stmt>,
    /// Whether the present block has a statement.
    open: bool,
    /// Number of the present block, as long as it has no statement.
    number: Option<u32>,
}

impl Rebuild {
    /// Into a vector of this capacity.
    pub(crate) fn new(capacity: usize) -> Rebuild {
        Rebuild { out: Vec::with_capacity(capacity), open: false, number: None }
    }

    /// Whether the block of the statement passed on last, if it is joined to one, has statements.
    pub(crate) fn is_open(&self) -> bool {
        self.open
    }

    /// The statements of the block that is open, the last one first.
    pub(crate) fn block_mut(&mut self) -> impl Iterator<Item = &mut Stmt> {
        let first = (0..self.out.len()).rev().find(|at| !self.out[*at].joined).unwrap_or(0);
        self.out[first..].iter_mut().rev()
    }

    /// Passes a statement on.
    pub(crate) fn push(&mut self, mut stmt: Stmt) {
        if !stmt.joined {
            self.number = None;
        } else if !self.open {
            stmt.joined = false;
            stmt.number = self.number.take();
        }
        self.open = true;
        self.out.push(stmt);
    }

    /// Leaves a statement out; its block keeps number and comment.
    pub(crate) fn leave_out(&mut self, stmt: Stmt) {
        if !stmt.joined {
            self.open = false;
            self.number = stmt.number;
        }
        let Some(comment) = stmt.comment else { return };
        match self.out.last_mut() {
            Some(last) if self.open => last.comment = Some(comment),
            _ => {
                let mut alone = Stmt::new(stmt.span, Op::Comment(*comment));
                alone.number = self.number.take();
                alone.skip = stmt.skip;
                self.out.push(alone);
                self.open = true;
            }
        }
    }

    /// Puts other statements in the place of one that is a block without number, comment and skip mark: `made` says of each
    /// whether it stands in the block of the one before, and has at least one.
    pub(crate) fn blocks(&mut self, span: Span, made: impl IntoIterator<Item = (bool, Op)>) {
        let first = self.out.len();
        for (with_last, op) in made {
            let joined = with_last && self.out.len() > first;
            self.out.push(Stmt { joined, ..Stmt::new(span, op) });
        }
        (self.open, self.number) = (true, None);
    }

    /// Puts other statements in a statement's place: `made` says of each whether it stands in the
    /// block of the one before. The block's comment goes to the first block made.
    pub(crate) fn replace(&mut self, stmt: Stmt, made: impl IntoIterator<Item = (bool, Op)>) {
        let Stmt { span, number, skip, joined, comment, op: _ } = stmt;
        let mut made = made.into_iter().peekable();
        if made.peek().is_none() {
            let op = Op::Blank;
            return self.leave_out(Stmt { span, number, skip, joined, comment, op });
        }
        if !joined {
            self.open = false;
            self.number = number;
        }
        let number = if self.open { None } else { self.number.take() };
        let first = self.out.len();
        let mut first_block = true;
        let mut comment = comment;
        while let Some((with_last, op)) = made.next() {
            let mut new = Stmt::new(span, op);
            new.skip = skip;
            if self.out.len() == first {
                new.joined = with_last && self.open;
                new.number = if new.joined { None } else { number };
            } else {
                new.joined = with_last;
            }
            let ends = made.peek().is_none_or(|next| !next.0);
            if first_block && ends {
                new.comment = comment.take();
                first_block = false;
            }
            self.out.push(new);
        }
        self.open = true;
    }
}

/// Runs a pass over a body: each statement goes to `each`, which passes on what becomes of it.
pub(crate) fn rebuild(body: &mut Vec<Stmt>, mut each: impl FnMut(Stmt, &mut Rebuild)) {
    let input = std::mem::take(body);
    let mut made = Rebuild::new(input.len());
    for stmt in input {
        each(stmt, &mut made);
    }
    *body = made.out;
}
