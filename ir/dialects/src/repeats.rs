//! Words that execute blocks again, by their block numbers, and words of points by radius and angle.

use serde::Deserialize;

/// Repetition of blocks by a block of its own, whose words name the first block, the last one and the
/// repeat count: `H90 E240 L25`. Whether the count includes the first time is asked of the option
/// `repeat_count`: `again`, or `total`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RepeatRules {
    /// Letter of the number of the first block; `None` if there is no such repetition.
    pub first: Option<char>,
    /// Letter of the number of the last block.
    pub last: Option<char>,
    /// Letter of the count.
    pub times: Option<char>,
    /// The manual and its page, or another source.
    pub source: String,
}

/// Option of a dialect: whether the count of a repetition includes the first time.
pub const REPEAT_COUNT: &str = "repeat_count";

impl RepeatRules {
    /// The letters of first block, last block and count, of a control that has them.
    pub fn letters(&self) -> Option<[u8; 3]> {
        let letter = |c: Option<char>| c.filter(char::is_ascii_uppercase).map(|c| c as u8);
        Some([letter(self.first)?, letter(self.last)?, letter(self.times)?])
    }
}

/// Ends of moves by radius and angle. With letters, of straight moves about a centre in the same block:
/// `G1 R30. C45. I0. J0.`; the centre's words are those of arcs, and count from program zero; all four words
/// stand in the block. With the signs `@` and `^`, of any move about program zero in the XY plane:
/// `G1 @30 ^45`; a word that is missing, or an increment, counts from where the tool is. Read alone: what
/// is written are coordinates.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PolarRules {
    /// Letter of the radius; `None` if there are no such points.
    pub radius: Option<char>,
    /// Letter of the angle, counter-clockwise from the first axis of the plane.
    pub angle: Option<char>,
    /// The manual and its page, or another source.
    pub source: String,
}

impl PolarRules {
    /// The letters of radius and angle, of a control that has them.
    pub fn letters(&self) -> Option<[u8; 2]> {
        let letter = |c: Option<char>| c.filter(char::is_ascii_uppercase).map(|c| c as u8);
        Some([letter(self.radius)?, letter(self.angle)?])
    }

    /// The signs of radius and angle, of a control that has signs for them.
    pub fn signs(&self) -> Option<[u8; 2]> {
        let sign = |c: Option<char>| c.filter(|c| matches!(c, '@' | '^')).map(|c| c as u8);
        Some([sign(self.radius)?, sign(self.angle)?])
    }
}
