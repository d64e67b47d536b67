//! What computed words of packed moves have in common: all but their numbers.
//!
//! ```text
//! Z[-0.025+#1]  Z[-0.164+#1]    one shape, □ + #1
//! ```
//!
//! Not here: how words are packed (`packing`).

use crate::expr::num::{Num, Unit};
use crate::expr::{Binary, Expr, Function, Node, Unary, Var};

/// Most numbers of a shape.
pub const MOST_NUMBERS: usize = 8;

/// Largest mantissa that is packed.
pub(super) const MOST: u64 = 1 << 56;

/// Whether a number is among those that are packed.
pub(super) fn packs_num(num: Num) -> bool {
    num.mantissa.unsigned_abs() < MOST && num.scale < 16
}

/// What a computed word says: steps may write the same expression in another way in each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordRole {
    /// Where an axis goes.
    Axis,
    /// The feed.
    Feed,
}

/// The shape of computed words.
#[derive(Clone, Debug, PartialEq)]
pub struct WordShape {
    role: WordRole,
    expr: Expr,
    numbers: usize,
}

impl WordShape {
    /// The shape of an expression; `None` where it is a literal, or more than sums, differences, products and quotients
    /// of variables and of numbers without a unit, and their rounding to some digits. How many digits is of the shape.
    pub fn of(role: WordRole, expr: &Expr) -> Option<WordShape> {
        let mut numbers = 0;
        let packs = matches!(expr, Expr::Node(_)) && is_plain(expr, &mut numbers);
        (packs && numbers <= MOST_NUMBERS).then(|| WordShape { role, expr: expr.clone(), numbers })
    }

    /// What such a word says.
    pub fn role(&self) -> WordRole {
        self.role
    }

    /// How many numbers such a word has.
    pub fn numbers(&self) -> usize {
        self.numbers
    }

    /// One of such words; its numbers mean nothing.
    pub fn expr(&self) -> &Expr {
        &self.expr
    }

    /// Whether a word is such a one.
    pub fn fits(&self, role: WordRole, word: &Expr) -> bool {
        self.role == role && is_alike(&self.expr, word)
    }

    /// The word with these numbers.
    pub fn with(&self, numbers: &[Num]) -> Expr {
        filled(&self.expr, &mut numbers.iter().copied())
    }

    /// The shape of a word that stands for one of this shape: `None` where not all of its numbers are the same.
    pub fn become_of(&self, from: &Expr, to: &Expr) -> Option<WordShape> {
        let there = WordShape::of(self.role, to)?;
        (self.fits(self.role, from) && numbers_of(from).eq(&numbers_of(to))).then_some(there)
    }
}

/// Whether an expression has a shape, as [`WordShape::of`] says.
pub fn has_shape(expr: &Expr) -> bool {
    let mut numbers = 0;
    matches!(expr, Expr::Node(_)) && is_plain(expr, &mut numbers) && numbers <= MOST_NUMBERS
}

/// Adds the numbers of an expression to their number.
fn is_plain(expr: &Expr, numbers: &mut usize) -> bool {
    match expr {
        Expr::Num(num) => {
            *numbers += 1;
            num.unit == Unit::One && packs_num(*num)
        }
        Expr::Node(node) => match &**node {
            Node::Var(Var::Local(_) | Var::Common(_) | Var::Retentive(_)) => true,
            Node::Unary(Unary::Negate, a) => is_plain(a, numbers),
            Node::Binary(Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide, a, b) => {
                is_plain(a, numbers) && is_plain(b, numbers)
            }
            Node::Call(Function::RoundTo, all) => {
                matches!(&all[..], [a, Expr::Num(_)] if is_plain(a, numbers))
            }
            Node::Var(Var::System(_))
            | Node::Element(_)
            | Node::Vacant
            | Node::Unary(Unary::Not, _)
            | Node::Binary(..)
            | Node::Call(..) => false,
        },
    }
}

fn is_alike(one: &Expr, other: &Expr) -> bool {
    match (one, other) {
        (Expr::Num(_), Expr::Num(_)) => true,
        (Expr::Node(one), Expr::Node(other)) => match (&**one, &**other) {
            (Node::Var(one), Node::Var(other)) => one == other,
            (Node::Unary(f, a), Node::Unary(g, b)) => f == g && is_alike(a, b),
            (Node::Binary(f, a, b), Node::Binary(g, c, d)) => f == g && is_alike(a, c) && is_alike(b, d),
            (Node::Call(f, own), Node::Call(g, other)) => match (&own[..], &other[..]) {
                ([a, to], [b, digits]) => f == g && to == digits && is_alike(a, b),
                _ => false,
            },
            _ => false,
        },
        _ => false,
    }
}

/// Shows the numbers of an expression that has a shape, the first one first.
pub fn each_number(expr: &Expr, seen: &mut dyn FnMut(Num)) {
    match expr {
        Expr::Num(num) => seen(*num),
        Expr::Node(node) => match &**node {
            Node::Unary(_, a) => each_number(a, seen),
            Node::Binary(_, a, b) => {
                each_number(a, seen);
                each_number(b, seen);
            }
            Node::Call(Function::RoundTo, all) => all.iter().take(1).for_each(|a| each_number(a, seen)),
            Node::Var(_) | Node::Element(_) | Node::Vacant | Node::Call(..) => {}
        },
    }
}

fn numbers_of(expr: &Expr) -> Vec<Num> {
    let mut all = Vec::new();
    each_number(expr, &mut |num| all.push(num));
    all
}

fn filled(shape: &Expr, numbers: &mut impl Iterator<Item = Num>) -> Expr {
    match shape {
        Expr::Num(own) => Expr::Num(numbers.next().unwrap_or(*own)),
        Expr::Node(node) => Expr::Node(Box::new(match &**node {
            Node::Unary(f, a) => Node::Unary(*f, filled(a, numbers)),
            Node::Binary(f, a, b) => {
                let a = filled(a, numbers);
                Node::Binary(*f, a, filled(b, numbers))
            }
            Node::Call(f, all) => {
                let (rounded, digits) = all.split_at(1.min(all.len()));
                let rounded = rounded.iter().map(|a| filled(a, numbers));
                Node::Call(*f, rounded.chain(digits.iter().cloned()).collect())
            }
            node => node.clone(),
        })),
    }
}
