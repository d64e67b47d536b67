//! How the words of a dictionary are found: by their meaning, checked by reading them back.

use ncc_dialects::{
    CodeRow, Dialect, DwellWord, Meaning, OrientWords, PatternRow, Quantity, Role, Settings, Thread,
};
use ncc_ir::canon::{FeedMode, PathMode, Side, SpindleMode};
use ncc_ir::caps::CycleForm;
use ncc_ir::program::{FrameSlot, Probe, ReferencePoint};

use super::super::number::Format;
use super::{
    AdviceCode, CircleCode, Code, CycleCode, DataCode, Dwell, FrameCodes, GridCode, LONGEST, Letter,
    ProbeCode,
};

/// Looks rows up, and gives every modal group a bit.
pub(super) struct Finder {
    pub(super) dialect: &'static Dialect,
    pub(super) groups: Vec<&'static str>,
    /// The row of a code of several work offsets, of which a word of the block says one.
    pub(super) counted_offsets: Option<&'static CodeRow>,
}

impl Finder {
    pub(super) fn code(&self, meaning: Meaning) -> Option<Code> {
        self.row(&self.dialect.code_for(meaning)?.code, meaning)
    }

    /// The code of a row, if its number reads back to the meaning.
    pub(super) fn row(&self, code: &str, meaning: Meaning) -> Option<Code> {
        let letter = *code.as_bytes().first()?;
        let (whole, tenth) = code.get(1..)?.split_once('.').unwrap_or((&code[1..], "0"));
        let tenths = whole.parse::<u32>().ok()? * 10 + tenth.parse::<u32>().ok()?;
        let row = self.dialect.code_row(letter, tenths)?;
        if row.means != Some(meaning) || !row.write || code.len() > 8 {
            return None;
        }
        let group = self.groups.iter().position(|g| *g == row.group).filter(|_| !row.group.is_empty());
        let mut text = [0; LONGEST];
        text[..code.len()].copy_from_slice(code.as_bytes());
        Some(Code {
            text,
            len: code.len() as u8,
            letter: 0,
            group: group.map_or(0, |g| 1 << g.min(63)),
            unsure: (!row.sure).then_some(meaning),
        })
    }

    /// The code of a work offset; one of several that share a code has a word that says which.
    pub(super) fn origin(&self, number: u16) -> Option<Code> {
        if let Some(code) = self.code(Meaning::SetOriginOffsets(number)).filter(|code| code.letter == 0)
            && self.counted_offsets.is_none_or(|row| row.code.as_bytes() != code.text())
        {
            return Some(code);
        }
        let row = self.counted_offsets?;
        let Some(first @ Meaning::SetOriginOffsets(from)) = row.means else { return None };
        let which = number.checked_sub(from).filter(|n| *n < row.count.unwrap_or(0))? + 1;
        let letter = row.words.bytes().next()?;
        let mut code = self.row(&row.code, first)?;
        let blank = if self.dialect.block.blanks { " " } else { "" };
        let word = format!("{blank}{}{which}", letter as char);
        let len = usize::from(code.len);
        code.text.get_mut(len..len + word.len())?.copy_from_slice(word.as_bytes());
        (code.len, code.letter) = ((len + word.len()) as u8, letter);
        Some(code)
    }

    fn format(&self, quantity: Quantity) -> Format {
        let counts = matches!(quantity, Quantity::Integer);
        let rules = self.dialect.numbers(quantity);
        Format::new(rules, counts).rounding(rules, quantity)
    }

    pub(super) fn letter(&self, letter: char, quantity: Quantity) -> Option<Letter> {
        let letter = u8::try_from(letter).ok().filter(u8::is_ascii_uppercase)?;
        Some(Letter { letter, format: self.format(quantity) })
    }

    pub(super) fn role(&self, role: Role) -> Option<Letter> {
        let row = self.dialect.address.iter().find(|a| a.role == role)?;
        self.letter(row.letter, row.quantity)
    }

    pub(super) fn dwell(&self, word: DwellWord) -> Option<Dwell> {
        let milliseconds = word.quantity == Quantity::Milliseconds;
        Some(Dwell { word: self.letter(word.letter, word.quantity)?, milliseconds })
    }

    pub(super) fn cycles(&self, settings: &Settings) -> Vec<CycleCode> {
        let rows = self.dialect.cycle.iter();
        rows.filter_map(|row| {
            Some(CycleCode {
                kind: row.kind.clone(),
                code: self.row(&row.code, Meaning::StartCycle)?,
                depth: self.letter(row.depth, Quantity::Length)?,
                retract: self.letter(row.retract, Quantity::Length)?,
                dwell: match settings.dwell(row) {
                    Some(word) => Some(self.dwell(word)?),
                    None => None,
                },
                shrinking: match row.shrinking {
                    Some([first, less, least]) => Some([
                        self.letter(first, Quantity::Length)?,
                        self.letter(less, Quantity::Length)?,
                        self.letter(least, Quantity::Length)?,
                    ]),
                    None => None,
                },
                asked: row.dwell_by.as_ref().map(|by| by.option.as_str()),
                hand: row.hand.map(ncc_dialects::Hand::turn),
                form: CycleForm::Control(row.own()),
                to_level: row.feed_to_level,
                dwell_needed: row.dwell_needed,
                own_pause: row.pause.is_some(),
                from_return: row.from_return,
                peck: match row.peck.or(row.shift) {
                    Some(letter) => Some(self.letter(letter, Quantity::Length)?),
                    None => None,
                },
            })
        })
        .collect()
    }

    pub(super) fn circle(&self) -> Option<CircleCode> {
        self.dialect.pattern.iter().find_map(|row| match row {
            PatternRow::Circle { code, first, centre, step, count, .. } => Some(CircleCode {
                code: self.row(code, Meaning::Pattern)?,
                first: self.pair(*first, Quantity::Length)?,
                centre: self.pair(*centre, Quantity::Length)?,
                step: self.letter(*step, Quantity::Angle)?,
                count: self.letter(*count, Quantity::Integer)?,
            }),
            PatternRow::Grid { .. } => None,
        })
    }

    pub(super) fn grid(&self) -> Option<GridCode> {
        self.dialect.pattern.iter().find_map(|row| match row {
            PatternRow::Grid { code, pitch, counts, serpentine, .. } => Some(GridCode {
                code: self.row(code, Meaning::Pattern)?,
                pitch: self.pair(*pitch, Quantity::Length)?,
                counts: self.pair(*counts, Quantity::Integer)?,
                serpentine: *serpentine,
            }),
            PatternRow::Circle { .. } => None,
        })
    }

    pub(super) fn threads(&self) -> Vec<(Thread, Code, Vec<Letter>)> {
        let feed = self.dialect.letter_for(Role::Feed);
        let lead = |letter: char| {
            let mut rules = self.dialect.numbers(Quantity::Length);
            // Fractions of an inch as leads in millimetres, and both as fine as pitches are compared.
            rules.decimals += 3;
            rules.decimals_inch = rules.decimals_inch.map(|decimals| decimals + 4);
            match Some(letter) == feed {
                true => self.letter(letter, Quantity::Feed),
                false => Some(Letter {
                    format: Format::new(rules, false),
                    ..self.letter(letter, Quantity::Length)?
                }),
            }
        };
        let rows = self.dialect.code.iter();
        rows.filter_map(|row| {
            let Some(meaning @ Meaning::SynchronisedFeed(thread)) = row.means else { return None };
            let letters = row.words.chars().filter_map(lead).collect();
            Some((thread, self.row(&row.code, meaning)?, letters))
        })
        .collect()
    }

    pub(super) fn spindle_modes(&self) -> Vec<(SpindleMode, Option<FeedMode>, Code)> {
        let rows = self.dialect.code.iter();
        rows.filter_map(|row| {
            let Some(meaning @ Meaning::SetSpindleMode(mode)) = row.means else { return None };
            Some((mode, row.feed_mode.map(FeedMode::from), self.row(&row.code, meaning)?))
        })
        .collect()
    }

    pub(super) fn speed_limit(&self) -> Option<Code> {
        let row = self
            .dialect
            .code
            .iter()
            .find(|row| row.limits_speed && row.means == Some(Meaning::SetPosition))?;
        self.row(&row.code, row.means?)
    }

    pub(super) fn orient_words(&self) -> Option<&'static OrientWords> {
        self.dialect.code_for(Meaning::OrientSpindle)?.orient.as_ref()
    }

    pub(super) fn orient_angles(&self) -> Vec<Letter> {
        let words = self.orient_words().map_or(&[][..], |words| &words.angle);
        words.iter().filter_map(|word| self.letter(word.letter, word.quantity)).collect()
    }

    pub(super) fn surface_limit(&self) -> Option<Letter> {
        let letter = self.dialect.code_for(Meaning::SetSpindleMode(SpindleMode::Surface))?.limit?;
        self.letter(letter, Quantity::Speed)
    }

    pub(super) fn frames(&self) -> FrameCodes {
        let words = |meaning| {
            let row = self.dialect.code_for(meaning);
            let letters = row.map_or(&[][..], |row| row.words.as_bytes());
            let angles = matches!(meaning, Meaning::SetRotation | Meaning::SetTilt);
            let quantity = if angles { Quantity::Angle } else { Quantity::Factor };
            letters.iter().filter_map(|l| self.letter(*l as char, quantity)).collect::<Vec<_>>()
        };
        let scale = match words(Meaning::SetScale)[..] {
            [all, x, y, z, ..] => Some((all, [x, y, z])),
            _ => None,
        };
        let angle = words(Meaning::SetRotation).first().copied();
        let tilt = match words(Meaning::SetTilt)[..] {
            [first, second, third, ..] => Some([first, second, third]),
            _ => None,
        };
        FrameCodes {
            local: self.code(Meaning::SetShift(false)),
            origin: self.code(Meaning::SetShift(true)),
            position: self.code(Meaning::SetPosition),
            rotation: self.code(Meaning::SetRotation).zip(angle),
            no_rotation: self.code(Meaning::ClearFrame(FrameSlot::Rotation)),
            scale: self.code(Meaning::SetScale).zip(scale).map(|(code, (all, each))| (code, all, each)),
            no_scale: self.code(Meaning::ClearFrame(FrameSlot::Scale)),
            mirror: self.code(Meaning::SetMirror),
            no_mirror: self.code(Meaning::ClearMirror),
            tilt: self.code(Meaning::SetTilt).zip(tilt).and_then(|(code, letters)| {
                Some((code, letters, self.dialect.code_for(Meaning::SetTilt)?.turns_about()?))
            }),
            upright: self.code(Meaning::OrientToolAxis),
        }
    }

    pub(super) fn tables(&self) -> Vec<DataCode> {
        let rows = self.dialect.data.iter();
        rows.filter_map(|row| {
            let (code, letter, number) = row.selected()?;
            let values = row.values.iter();
            Some(DataCode {
                row,
                code: self.row(code, Meaning::SetData)?,
                select: (letter, number),
                entry: u8::try_from(row.entry).ok()?,
                turn: row.turns.and_then(|letter| self.letter(letter, Quantity::Angle)),
                values: values
                    .filter_map(|v| Some((v.of.into(), self.letter(v.letter, Quantity::Length)?)))
                    .collect(),
            })
        })
        .collect()
    }

    fn pair(&self, letters: [char; 2], quantity: Quantity) -> Option<[Letter; 2]> {
        Some([self.letter(letters[0], quantity)?, self.letter(letters[1], quantity)?])
    }

    /// Edge 0 of the tool is no length.
    pub(super) fn no_edge(&self) -> Option<Code> {
        let letter = self.role(Role::ToolEdge)?.letter;
        let mut text = [0; LONGEST];
        text[..2].copy_from_slice(&[letter, b'0']);
        Some(Code { text, len: 2, letter: 0, group: 0, unsure: None })
    }

    pub(super) fn by_diameter(&self) -> [Option<(Code, Letter)>; 2] {
        [Side::Left, Side::Right].map(|s| {
            let letter = self.role(Role::RadiusEntry)?.letter;
            let letter = self.letter(char::from(letter), Quantity::Length)?;
            Some((self.code(Meaning::StartCompensationByDiameter(s))?, letter))
        })
    }

    pub(super) fn machine(&self) -> [Option<Code>; 2] {
        [false, true].map(|length| {
            let either = [false, true].into_iter();
            either.filter_map(|rapid| self.code(Meaning::UseMachineCoordinates { length, rapid })).next()
        })
    }

    pub(super) fn references(&self) -> Vec<(ReferencePoint, Code, Option<Letter>)> {
        self.dialect
            .code
            .iter()
            .filter_map(|row| {
                let meaning = row.means?;
                let Meaning::GoToReference { point, .. } = meaning else { return None };
                let letter = row.words.chars().next();
                let letter = letter.and_then(|l| self.letter(l, Quantity::Integer));
                Some((point, self.row(&row.code, meaning)?, letter))
            })
            .collect()
    }

    pub(super) fn probes(&self) -> Vec<(Probe, ProbeCode)> {
        self.dialect
            .code
            .iter()
            .filter_map(|row| {
                let Some(meaning @ Meaning::StraightProbe(probe)) = row.means else { return None };
                let feed = self.dialect.code_for(Meaning::StraightFeed);
                let stays = feed.is_some_and(|feed| feed.group == row.group);
                let code = self.row(&row.code, meaning)?;
                Some((probe, ProbeCode { code, stays, own_feed: row.own_feed }))
            })
            .collect()
    }

    pub(super) fn tool_number(&self) -> Option<(Code, Letter)> {
        self.dialect.code_for(Meaning::SetToolNumber).and_then(|row| {
            let letter = self.letter(row.words.chars().next()?, Quantity::Integer)?;
            Some((self.code(Meaning::SetToolNumber)?, letter))
        })
    }

    pub(super) fn path_within(&self) -> Option<(Code, Letter)> {
        self.dialect
            .code_for(Meaning::SetMotionControlMode(PathMode::Continuous))
            .and_then(|row| row.words.chars().next())
            .and_then(|letter| {
                let code = self.code(Meaning::SetMotionControlMode(PathMode::Continuous))?;
                Some((code, self.letter(letter, Quantity::Length)?))
            })
    }

    pub(super) fn path_merged(&self) -> Option<Letter> {
        self.dialect
            .code_for(Meaning::SetMotionControlMode(PathMode::Continuous))
            .and_then(|row| self.letter(row.words.chars().nth(1)?, Quantity::Length))
    }

    pub(super) fn advice(&self) -> Vec<AdviceCode> {
        self.dialect
            .code
            .iter()
            .filter_map(|row| match row.means {
                Some(meaning @ Meaning::Advise(kind, value)) if row.write => {
                    let letter = row.words.bytes().next().filter(|_| value.is_none());
                    let word = letter.map(|letter| (letter, row.on.unwrap_or(1)));
                    let amount = row.words.chars().nth(1).filter(|_| kind.has_amount());
                    let amount = amount.and_then(|letter| self.letter(letter, Quantity::Length));
                    Some(AdviceCode { kind, value, code: self.row(&row.code, meaning)?, word, amount })
                }
                _ => None,
            })
            .collect()
    }

    pub(super) fn machine_functions(&self) -> Vec<(&'static str, Code)> {
        self.dialect
            .code
            .iter()
            .filter_map(|row| match row.means {
                Some(meaning @ Meaning::MachineFunction(name)) if row.write => {
                    Some((name, self.row(&row.code, meaning)?))
                }
                _ => None,
            })
            .collect()
    }

    pub(super) fn no_effect(&self) -> Vec<(String, Code)> {
        self.dialect
            .code
            .iter()
            .filter(|row| row.means == Some(Meaning::NoEffect))
            .filter_map(|row| Some((row.code.clone(), self.row(&row.code, Meaning::NoEffect)?)))
            .collect()
    }
}
