//! The account of a comparison, as data: what every form of output lays out.
//!
//! Not here: how it is made (`tell`), and its words (`wording`).

use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;

/// The result of a comparison.
#[derive(Clone, Debug)]
pub struct Account {
    /// `motion` or `text`.
    pub level: &'static str,
    /// Names of both programs.
    pub names: [String; 2],
    /// Their dialects.
    pub dialects: [String; 2],
    /// Whether nothing differs.
    pub equal: bool,
    /// In one line, in the words of a reviewer.
    pub summary: String,
    /// Events, or blocks, that agree.
    pub same: u64,
    /// What has no partner, on either side.
    pub unmatched: [u64; 2],
    /// Worlds in which programs were executed; 0 of texts.
    pub worlds: u32,
    /// Settings of the block-skip switches.
    pub settings: usize,
    /// Within how much lengths are the same, mm.
    pub tolerance: f64,
    /// What the reader must know of the comparison.
    pub notes: Vec<String>,
    /// The differences, in the order of the first program.
    pub differences: Vec<Difference>,
    /// Differences that are counted only.
    pub left_out: u64,
}

/// A difference.
#[derive(Clone, Debug)]
pub struct Difference {
    /// Its kind, a stable name.
    pub kind: &'static str,
    /// What it is.
    pub title: String,
    /// Before and after, if it is a value.
    pub values: Option<[String; 2]>,
    /// By how much it is off, X to C, nanos.
    pub offset: Option<[Nanos; AXES]>,
    /// Tool, if it is known.
    pub tool: Option<i64>,
    /// Moves of both sides.
    pub moves: [u64; 2],
    /// Holes of both sides.
    pub holes: [u64; 2],
    /// Block-skip levels that are on when it shows.
    pub skip: Vec<u8>,
    /// Blocks of both sides.
    pub blocks: [Vec<Block>; 2],
    /// Whether there are further ones.
    pub more: [bool; 2],
    /// Whether blocks at the same index belong together.
    pub paired: bool,
    /// Where a side has nothing, the block before it.
    pub beside: [Option<Block>; 2],
}

/// A block of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its line.
    pub line: u64,
    /// Its text.
    pub text: String,
}
