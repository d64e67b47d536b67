//! What variables are called in the target, and how finely its words say what is computed.

use ncc_ir::expr::Var;

/// Variables of the main procedure, and those that all procedures see: what each is called in the target.
#[derive(Clone, Debug, Default)]
pub struct Renamed {
    /// The source's and the target's.
    pub(super) pairs: Vec<(Var, Var)>,
    /// Whether one that is not among them has some value in the target, whatever the source has.
    pub(super) filled: bool,
}

impl Renamed {
    /// The source's variable after one of the target's.
    pub fn source(&self, target: &Var) -> Option<&Var> {
        self.pairs.iter().find(|(_, new)| new == target).map(|(old, _)| old)
    }

    /// What the target calls one of the source's variables.
    pub fn target<'v>(&'v self, source: &'v Var) -> &'v Var {
        self.pairs.iter().find(|(old, _)| old == source).map_or(source, |(_, new)| new)
    }

    /// Whether what the target reads and has not set is something, never nothing.
    pub fn filled(&self) -> bool {
        self.filled
    }
}

/// Digits of the target's lengths.
#[derive(Clone, Copy, Debug)]
pub struct Digits {
    /// After the point, in mm; in inches it has one more.
    pub decimals: u8,
    /// To which its words round what is computed, in mm or degrees, and in inches.
    pub increments: [u8; 2],
    /// To which words of seconds do; none where its dwell has one word alone, of which what is computed may count
    /// seconds or milliseconds.
    pub seconds: Option<u8>,
}
