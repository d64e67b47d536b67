//! Pieces of a program that go along lines alone: most of most programs, so that what never concerns them is not asked
//! of each of their statements.

use super::{Op, Stmt};
use crate::canon::{Axis, Distance};

/// A piece that goes along lines in X, Y and Z, by words that are not incremental of themselves, and states feeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lines {
    /// Axes that have words, a bit each.
    pub axes: u16,
}

impl Lines {
    /// Whether an axis has a word.
    pub const fn names(self, axis: Axis) -> bool {
        self.axes >> axis as usize & 1 == 1
    }

    /// What statements are, if they are nothing but that.
    pub fn from_statements(stmts: &[Stmt]) -> Option<Lines> {
        let mut axes = 0;
        for stmt in stmts {
            let to = match &stmt.op {
                Op::StraightFeed(to) | Op::StraightTraverse(to) => &to.to,
                Op::SetFeedRate(_) | Op::Comment(_) | Op::Blank => continue,
                _ => return None,
            };
            if stmt.skip.is_some() {
                return None;
            }
            for (axis, word) in to.axes.iter().enumerate() {
                let Some(word) = word else { continue };
                if axis >= Axis::A as usize || word.distance.known() == Some(Distance::Incremental) {
                    return None;
                }
                axes |= 1 << axis;
            }
        }
        Some(Lines { axes })
    }
}
