//! Rows of G and M codes, and how they are found by their numbers.
//!
//! Not here: what a meaning is (`meaning`), and whether rows fit together (`check`).

use crate::fault::RowFault;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, DefaultHasher};

use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Axis;
use serde::Deserialize;

use crate::cycles::DwellWord;
use crate::meaning::Meaning;
use crate::names::{NameMeaning, NameRow};
use crate::power_on::FeedModeName;
use crate::words::{Address, Quantity, RefusalHelp, yes};

/// A G or M code.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct CodeRow {
    /// The code as it is written: `G01`, `M6`.
    pub code: String,
    /// The number of the last code, if the row stands for several work offsets in sequence, each
    /// with the next number: `G505` up to 599. The loader makes a row of each.
    #[serde(default)]
    pub upto: Option<u16>,
    /// How many work offsets the code has, if a word of the block says which of them: the word's 1 is
    /// the one that the row means. Its letter is the first of `words`.
    #[serde(default)]
    pub count: Option<u16>,
    /// Of a function of the machine, whether it comes after the move of its block; else a block with a move is
    /// refused.
    #[serde(default)]
    pub after_move: bool,
    /// What it means; without, it is refused by `refuse`.
    #[serde(default)]
    pub means: Option<Meaning>,
    /// The name by which it is refused.
    #[serde(default)]
    pub refuse: Option<String>,
    /// Where it is refused, what to do instead.
    #[serde(default)]
    pub help: Option<RefusalHelp>,
    /// Its modal group: two codes of a group exclude each other in a block. Empty for one-shots.
    #[serde(default)]
    pub group: String,
    /// Whether it is passed over in a block with another code of its group; said twice, it counts once.
    #[serde(default)]
    pub passed_over: bool,
    /// Another code of this control, as which the user has this one read: no key of a dictionary.
    #[serde(skip)]
    pub read_as: Option<String>,
    /// Whether a return to a reference point without axis words is one of all axes at once: X, Y, Z, and of the rotary
    /// axes those that the text has named before.
    #[serde(default)]
    pub alone_all_axes: bool,
    /// Letters of its own words, besides those that stand for themselves.
    #[serde(default)]
    pub words: String,
    /// Of a tilted plane by angles, the axes about which they turn, one after the other, each as the turns before
    /// have left it: `ZXZ`. The angles are those of `words`.
    #[serde(default)]
    pub turns: String,
    /// Letters whose numbers name blocks: of the program that it stands in, and in a return of the one
    /// that has called it, unless returns go on within their own (`returns_within`). In a call they are what is called,
    /// up to its return; of a call that names a program, where it names none. They may be words of a code that is refused.
    #[serde(default)]
    pub blocks: String,
    /// Whether the code is one of other machines than the dictionary is about, so that a text which has
    /// it is hardly written for one of these.
    #[serde(default)]
    pub other_machine: bool,
    /// Whether a length offset, or a radius, without its word is that of the tool in the spindle.
    #[serde(default)]
    pub own_tool: bool,
    /// Whether entry 0 of a table is refused, because the control takes another one.
    #[serde(default)]
    pub no_entry_zero: bool,
    /// Whether its block must say a feed.
    #[serde(default)]
    pub own_feed: bool,
    /// Whether a code of units leaves the feed in the machine's basic system.
    #[serde(default)]
    pub feed_stays: bool,
    /// What a feed counts from here on, where a code of the spindle's speed says that as well; such codes and
    /// those of the feed are of one group, and each of either ends the other.
    #[serde(default)]
    pub feed_mode: Option<FeedModeName>,
    /// Of a code that takes axis words, whether the speed word beside it is the highest speed of the spindle
    /// where no axis has one.
    #[serde(default)]
    pub limits_speed: bool,
    /// Of a code by which a speed counts a surface's, the letter of the highest speed of the spindle, which
    /// counts until the next such code: without its word there is none.
    #[serde(default)]
    pub limit: Option<char>,
    /// Of a stop of the spindle, its words.
    #[serde(default)]
    pub orient: Option<OrientWords>,
    /// Letter and unit of a dwell, the first one for writing.
    #[serde(default)]
    pub dwell: Vec<DwellWord>,
    /// Of advice that a word of the block switches, the number that switches it on; 0 switches it off.
    #[serde(default)]
    pub on: Option<u32>,
    /// Whether the control refuses it while cutter radius compensation is on, and if so, whether in one block it acts
    /// after the codes of compensation (and is refused beside the one that switches it on) or before them.
    #[serde(default)]
    pub refused_under_compensation: Option<BesideCompensation>,
    /// Whether it is written when several codes mean the same.
    #[serde(default = "yes")]
    pub write: bool,
    /// Whether the row is confirmed.
    #[serde(default = "yes")]
    pub sure: bool,
    /// The manual and its page, or another source.
    pub source: String,
}

impl CodeRow {
    /// The axes about which the angles of a tilted plane turn; `None` if there are not three of them.
    pub fn turns_about(&self) -> Option<[Axis; 3]> {
        let linear = |letter| Axis::from_letter(letter).filter(|axis| !axis.is_rotary());
        let axes: Vec<Axis> = self.turns.bytes().filter_map(linear).collect();
        axes.try_into().ok().filter(|_| self.turns.len() == 3 && self.words.len() == 3)
    }
}

/// When a code acts that is refused under cutter radius compensation, in a block with a code of compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BesideCompensation {
    /// Before it.
    Before,
    /// After it.
    After,
}

/// Words of a stop of the spindle at an angle.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct OrientWords {
    /// The angle, the first one for writing.
    pub angle: Vec<AngleWord>,
    /// The option that says which of these letters it is on the machine at hand.
    #[serde(default)]
    pub option: Option<String>,
    /// Letter of the time to wait for it, in seconds. Where there is one, it and the angle must be stated.
    #[serde(default)]
    pub wait: Option<char>,
    /// Letter of the sense in which the spindle turns to it: 0 is the shorter way, and any other is refused.
    #[serde(default)]
    pub turn: Option<char>,
}

/// A word that says at which angle.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AngleWord {
    /// Its letter.
    pub letter: char,
    /// An angle, or a whole number of degrees.
    pub quantity: Quantity,
}

/// Rows of `code` by number: G and M codes in tenths (`G5.1` is 51).
#[derive(Clone, Debug, Default)]
pub struct CodeIndex {
    /// G codes.
    pub g: Vec<Option<u16>>,
    /// M codes.
    pub m: Vec<Option<u16>>,
    /// Rows of `address` by letter, A first.
    pub letter: [Option<u8>; 26],
    /// Rows of `code` that are written, by what they mean; of several, the first.
    pub meaning: RowsBy<Meaning>,
    /// Rows of `name` that are written, by what they mean; of several, the first.
    pub name_meaning: RowsBy<NameMeaning>,
    /// Rows of `option` that state what a code does besides its name.
    pub behaviour: Vec<(u16, Behaviour)>,
}

/// Rows of a table by a value of theirs.
pub type RowsBy<K> = HashMap<K, u16, BuildHasherDefault<DefaultHasher>>;

impl CodeIndex {
    /// Puts a row of `code` in by its number.
    pub(crate) fn put_code(&mut self, at: usize, row: &CodeRow) -> Result<(), RowFault> {
        let (letter, number) = tenths(&row.code).ok_or(RowFault::NoCode)?;
        let table = match letter {
            b'G' => &mut self.g,
            b'M' => &mut self.m,
            _ => return Err(RowFault::NeitherGNorM),
        };
        if table.len() <= number {
            table.resize(number + 1, None);
        }
        match table[number].replace(at as u16) {
            Some(_) => Err(RowFault::Twice),
            None => Ok(()),
        }
    }

    /// Puts a row of `address` in by its letter.
    pub(crate) fn put_letter(&mut self, at: usize, row: &Address) -> Result<(), RowFault> {
        let slot = self.letter.get_mut((row.letter as usize).wrapping_sub(65)).ok_or(RowFault::NoLetter)?;
        match slot.replace(at as u8) {
            Some(_) => Err(RowFault::Twice),
            None => Ok(()),
        }
    }

    /// Finds the rows by what they mean.
    pub(crate) fn find_meanings(&mut self, codes: &[CodeRow], names: &[NameRow]) {
        self.meaning.clear();
        self.name_meaning.clear();
        for (at, row) in codes.iter().enumerate().filter(|(_, row)| row.write) {
            if let Some(means) = row.means {
                self.meaning.entry(means).or_insert(at as u16);
            }
        }
        for (at, row) in names.iter().enumerate().filter(|(_, row)| row.write) {
            if let Some(means) = row.means {
                self.name_meaning.entry(means).or_insert(at as u16);
            }
        }
    }
}

/// Letter of a code, and tenths of its number: `G5.1` is 51.
pub(crate) fn tenths(code: &str) -> Option<(u8, usize)> {
    let letter = *code.as_bytes().first()?;
    let (whole, tenth) = code.get(1..)?.split_once('.').unwrap_or((code.get(1..)?, "0"));
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if !digits(whole) || !digits(tenth) || tenth.len() > 1 {
        return None;
    }
    let number = whole.parse::<usize>().ok()?.checked_mul(10)? + tenth.parse::<usize>().ok()?;
    (number < 100_000).then_some((letter, number))
}
