//! Kinds of words in straight moves: the properties that passes may test.
//!
//! A pass that changes one move must change all moves of its kind alike. `G1 X1.5` and `G1 X2.5` are of one kind;
//! `G1 Y2.5` is another one. Not here: the moves that represent a long run of moves (`stretches`).

use ncc_ir::canon::{Axis, Distance};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::packing::packs;
use ncc_ir::program::shapes::{WordRole, WordShape, each_number};
use ncc_ir::program::{Op, Stmt};

/// Limit for kinds of computed words in a run of moves: each word is compared with all of them.
const MOST_COMPUTED: usize = 256;

/// The words that may be packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Words {
    /// Literal numbers only.
    Literal,
    /// Literal numbers and expressions.
    All,
}

impl Words {
    pub(super) fn packs(self, stmt: &Stmt) -> bool {
        packs(stmt) && (self == Words::All || !computes(stmt))
    }
}

/// The kinds found in a run of moves.
#[derive(Debug, Default)]
pub(super) struct Kinds {
    bits: u32,
    shapes: Vec<WordShape>,
    /// Kinds of computed words: index in `shapes`, kinds of the numbers (8 bits each), and the most decimals of any
    /// number.
    computed: Vec<(usize, u64, u8)>,
}

impl Kinds {
    /// Adds the kinds of a move. True if one of them is new.
    pub(super) fn has_more(&mut self, stmt: &Stmt) -> bool {
        let own = bits(stmt);
        let mut more = own & !self.bits != 0;
        self.bits |= own;
        match &stmt.op {
            Op::StraightFeed(to) | Op::StraightTraverse(to) => {
                for word in to.to.axes.iter().flatten().filter(|word| matches!(word.value, Expr::Node(_))) {
                    more |= self.has_more_words(WordRole::Axis, &word.value);
                }
            }
            Op::SetFeedRate(feed @ Expr::Node(_)) => more |= self.has_more_words(WordRole::Feed, feed),
            _ => {}
        }
        more
    }

    /// Whether the limit [`MOST_COMPUTED`] is reached, so that packing no longer pays.
    pub(super) fn is_full(&self) -> bool {
        self.computed.len() >= MOST_COMPUTED
    }

    fn has_more_words(&mut self, role: WordRole, word: &Expr) -> bool {
        let shape = self.shapes.iter().position(|shape| shape.fits(role, word)).unwrap_or_else(|| {
            self.shapes.extend(WordShape::of(role, word));
            self.shapes.len().saturating_sub(1)
        });
        let (mut numbers, mut digits) = (0, 0);
        each_number(word, &mut |num| {
            numbers = numbers << 8 | kind_of(num);
            digits = num.scale.max(digits);
        });
        match self.computed.iter_mut().find(|(own, kinds, _)| (*own, *kinds) == (shape, numbers)) {
            Some((_, _, most)) => digits > std::mem::replace(most, digits.max(*most)),
            None => {
                self.computed.push((shape, numbers, digits));
                true
            }
        }
    }
}

/// Kind of a number, in eight bits: bit 0 has a point, 1 is negative, 2 is zero, 3 is 1 or -1.
fn kind_of(num: Num) -> u64 {
    let bit = |has: bool, bit: u64| if has { bit } else { 0 };
    let one = 10_u64.checked_pow(u32::from(num.scale));
    bit(num.point, 1)
        | bit(num.mantissa < 0, 1 << 1)
        | bit(num.mantissa == 0, 1 << 2)
        | bit(Some(num.mantissa.unsigned_abs()) == one, 1 << 3)
}

/// Whether an axis word or the feed is an expression.
pub(super) fn computes(stmt: &Stmt) -> bool {
    match &stmt.op {
        Op::StraightFeed(to) | Op::StraightTraverse(to) => {
            to.to.axes.iter().flatten().any(|word| matches!(word.value, Expr::Node(_)))
        }
        Op::SetFeedRate(feed) => matches!(feed, Expr::Node(_)),
        _ => false,
    }
}

/// Properties of a statement that passes may test, one bit each: axes, distance modes and units. Expressions add
/// their axis and distance mode only.
pub(super) fn bits(stmt: &Stmt) -> u32 {
    let (words, feed) = match &stmt.op {
        Op::StraightFeed(to) => (&to.to, true),
        Op::StraightTraverse(to) => (&to.to, false),
        Op::SetFeedRate(Expr::Node(_)) => return 1 << 6 | 1 << 16,
        _ => return 1 << 6 | 1 << 17,
    };
    let mut bits = 0;
    for (axis, word) in words.axes[..Axis::A as usize].iter().enumerate() {
        let Some(word) = word else { continue };
        bits |= if feed { 1 } else { 8 } << axis;
        bits |= match word.distance.known() {
            None => 1 << 7,
            Some(Distance::Absolute) => 1 << 8,
            Some(Distance::Incremental) => 1 << 9,
        };
        if let Expr::Num(num) = &word.value {
            bits |= 1 << (10 + num.unit as u32);
        }
    }
    bits
}
