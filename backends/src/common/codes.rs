//! The words of a dictionary, looked up once.
//!
//! A row counts only if its word reads back to the same meaning, so every code here was found by
//! its meaning and checked by its number. Not here: when a word is written.

mod call;
mod cycle;

pub(crate) use call::CallCode;
pub(crate) use cycle::{CircleCode, CycleCode, GridCode};
use ncc_dialects::{Dialect, DwellWord, Meaning, OrientWords, PatternRow, Quantity, Role, Settings, Thread};
use ncc_ir::canon::{
    AdviceKind, Axis, Distance, FeedMode, PathMode, Plane, ReturnLevel, Side, SpindleMode, Turn, Units,
};
use ncc_ir::caps::CycleForm;
use ncc_ir::program::{CentreFrom, Detour, FrameSlot, Probe, ReferencePoint};

use super::data::DataCode;
use super::number::Format;

/// Longest code, with a word that belongs to it.
const LONGEST: usize = 12;

/// A G or M code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Code {
    text: [u8; LONGEST],
    len: u8,
    /// Letter of a word that belongs to it; 0 for none.
    pub letter: u8,
    /// One bit for its modal group, 0 for a one-shot.
    pub group: u64,
    /// What it means, if no source confirms it.
    pub unsure: Option<Meaning>,
}

impl Code {
    /// The text of a code without a word, with what fills it up, and its length.
    #[inline]
    pub(crate) fn padded(&self) -> (&[u8; 8], usize) {
        (self.text.first_chunk().unwrap_or(&[0; 8]), usize::from(self.len))
    }

    pub(crate) fn text(&self) -> &[u8] {
        &self.text[..usize::from(self.len)]
    }

    /// Whether it is a G code.
    pub(crate) fn is_g(&self) -> bool {
        self.text[0] == b'G'
    }
}

/// An address letter and the form of its numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Letter {
    pub letter: u8,
    pub format: Format,
}

/// A word that says how long to dwell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dwell {
    pub word: Letter,
    pub milliseconds: bool,
}

/// The code of advice.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AdviceCode {
    pub kind: AdviceKind,
    /// Its value; without, a word of the block says it.
    pub value: Option<u8>,
    pub code: Code,
    /// Letter of that word, and the number for on.
    pub word: Option<(u8, u32)>,
    /// Letter of the length that belongs to it.
    pub amount: Option<Letter>,
}

/// The code of a probing move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProbeCode {
    pub code: Code,
    /// Whether it stays in force.
    pub stays: bool,
    /// Whether its block must say a feed.
    pub own_feed: bool,
}

/// Codes that fill slots of the coordinate chain, with the letters of their own words.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FrameCodes {
    pub local: Option<Code>,
    pub origin: Option<Code>,
    pub position: Option<Code>,
    pub rotation: Option<(Code, Letter)>,
    pub no_rotation: Option<Code>,
    /// One factor for all axes, or one for each.
    pub scale: Option<(Code, Letter, [Letter; 3])>,
    pub no_scale: Option<Code>,
    pub mirror: Option<Code>,
    pub no_mirror: Option<Code>,
    /// A tilted plane with the letters of its turns and the axes about which they are, and the tool turned upright on it.
    pub tilt: Option<(Code, [Letter; 3], [Axis; 3])>,
    pub upright: Option<Code>,
}

/// Every word that can be written. `None` where the dialect has none.
#[derive(Clone, Debug)]
pub(crate) struct Codes {
    pub traverse: Option<Code>,
    pub feed: Option<Code>,
    pub arcs: [Option<Code>; 2],
    /// Threads, with the letters of their leads: one for all axes, or one for each.
    pub threads: Vec<(Thread, Code, Vec<Letter>)>,
    pub dwell: Option<(Code, Dwell)>,
    pub units: [Option<Code>; 2],
    pub distance: [Option<Code>; 2],
    pub plane: [Option<Code>; 3],
    pub feed_mode: [Option<Code>; 3],
    /// What a speed counts, and what a feed counts by the same code, where it says that as well.
    pub spindle_modes: Vec<(SpindleMode, Option<FeedMode>, Code)>,
    /// The code beside which the speed word is the highest speed.
    pub speed_limit: Option<Code>,
    /// The letter of the highest speed in the block of a surface speed.
    pub surface_limit: Option<Letter>,
    pub level: [Option<Code>; 2],
    /// By number of the work offset, less one.
    pub origins: Vec<Option<Code>>,
    /// No work offset.
    pub no_origin: Option<Code>,
    pub no_shift: Option<Code>,
    /// A shift of the origin suspended, and taken up again.
    pub origin_shift: [Option<Code>; 2],
    /// What fills the slots of the coordinate chain.
    pub frames: FrameCodes,
    /// Takes up a length with control of the tool's tip.
    pub tip: Option<Code>,
    pub no_compensation: Option<Code>,
    /// To the left, to the right.
    pub compensation: [Option<Code>; 2],
    /// The same by the diameter, and its word.
    pub compensation_by_diameter: [Option<(Code, Letter)>; 2],
    /// Entry of the table that has the radius.
    pub radius_entry: Option<Letter>,
    /// Whether compensation is by the tool's own entry where none is named.
    pub own_radius: bool,
    /// Machine coordinates without the tool's length, and with it.
    pub machine: [Option<Code>; 2],
    /// To points of the machine, with the letter that names a further one.
    pub references: Vec<(ReferencePoint, Code, Option<Letter>)>,
    /// Probing moves, each with whether its code stays in force as a motion's does.
    pub probes: Vec<(Probe, ProbeCode)>,
    pub detours: [Option<Code>; 2],
    /// Tables that values are put into.
    pub tables: Vec<DataCode>,
    /// A length by its value: in place of the one in force, added to it.
    pub stated_length: [Option<Code>; 2],
    /// Where the axes stand as stored position 1, 2.
    pub store_position: [Option<Code>; 2],
    /// The code that says the number of the tool in the spindle, and its word.
    pub tool_number: Option<(Code, Letter)>,
    pub length: Option<Code>,
    /// Whether it stands without a number, for the tool in the spindle.
    pub own_length: bool,
    pub no_length: Option<Code>,
    /// Centres are measured from the start point.
    pub centre_from_start: Option<Code>,
    /// Letter of an arc's turns.
    pub turns: Option<Letter>,
    pub end_cycle: Option<Code>,
    pub spindle_clockwise: Option<Code>,
    pub spindle_counterclockwise: Option<Code>,
    pub spindle_stop: Option<Code>,
    /// Makes the tapping cycle called up next a rigid one.
    pub rigid_tapping: Option<Code>,
    /// Stop of the spindle at the control's own angle, and the words of another one.
    pub orient: Option<Code>,
    pub orient_words: Option<&'static OrientWords>,
    pub orient_angles: Vec<Letter>,
    /// The code that rounds corners with a word that says how far from the path, and that word.
    pub path_within: Option<(Code, Letter)>,
    /// The letter of its second word, within which moves are made one.
    pub path_merged: Option<Letter>,
    /// Ways of taking corners, in the order of [`PathMode::ALL`].
    pub path: [Option<Code>; 11],
    pub exact_stop: Option<Code>,
    /// Points by radius and angle: off, on.
    pub polar: [Option<Code>; 2],
    pub advice: Vec<AdviceCode>,
    pub change_tool: Option<Code>,
    /// Functions of the machine, by name.
    pub machine_functions: Vec<(&'static str, Code)>,
    pub flood: Option<Code>,
    pub mist: Option<Code>,
    pub coolant_off: Option<Code>,
    pub stop: Option<Code>,
    pub optional_stop: Option<Code>,
    pub end: Option<Code>,
    pub again: Option<Code>,
    pub call: Option<CallCode>,
    /// A call with arguments.
    pub macro_call: Option<CallCode>,
    /// The same behind every move, and the end of that.
    pub calls_at_moves: Option<(CallCode, Code)>,
    /// All words of a dwell in a block of its own.
    pub dwells: Vec<Dwell>,
    pub back: Option<Code>,
    pub no_effect: Vec<(String, Code)>,
    pub cycles: Vec<CycleCode>,
    pub circle: Option<CircleCode>,
    pub grid: Option<GridCode>,
    /// In the order of [`Axis::ALL`].
    pub axes: [Option<Letter>; 6],
    pub centre: [Option<Letter>; 3],
    pub radius: Option<Letter>,
    pub feed_word: Option<Letter>,
    pub speed: Option<Letter>,
    pub tool: Option<Letter>,
    /// Entry of the length table, for a code of the block.
    pub entry: Option<Letter>,
    /// Entry of the length table, taken up by the word itself.
    pub corrector: Option<Letter>,
}

/// Looks rows up, and gives every modal group a bit.
struct Finder {
    dialect: &'static Dialect,
    groups: Vec<&'static str>,
}

impl Finder {
    fn code(&self, meaning: Meaning) -> Option<Code> {
        self.row(&self.dialect.code_for(meaning)?.code, meaning)
    }

    /// The code of a row, if its number reads back to the meaning.
    fn row(&self, code: &str, meaning: Meaning) -> Option<Code> {
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
    fn origin(&self, number: u16) -> Option<Code> {
        if let Some(code) = self.code(Meaning::SetOriginOffsets(number)).filter(|code| code.letter == 0)
            && self.dialect.counted_offsets().is_none_or(|row| row.code.as_bytes() != code.text())
        {
            return Some(code);
        }
        let row = self.dialect.counted_offsets()?;
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

    fn letter(&self, letter: char, quantity: Quantity) -> Option<Letter> {
        let letter = u8::try_from(letter).ok().filter(u8::is_ascii_uppercase)?;
        Some(Letter { letter, format: self.format(quantity) })
    }

    fn role(&self, role: Role) -> Option<Letter> {
        let row = self.dialect.address.iter().find(|a| a.role == role)?;
        self.letter(row.letter, row.quantity)
    }

    fn dwell(&self, word: DwellWord) -> Option<Dwell> {
        let milliseconds = word.quantity == Quantity::Milliseconds;
        Some(Dwell { word: self.letter(word.letter, word.quantity)?, milliseconds })
    }

    fn cycles(&self, settings: &Settings) -> Vec<CycleCode> {
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

    fn circle(&self) -> Option<CircleCode> {
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

    fn grid(&self) -> Option<GridCode> {
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

    fn threads(&self) -> Vec<(Thread, Code, Vec<Letter>)> {
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

    fn spindle_modes(&self) -> Vec<(SpindleMode, Option<FeedMode>, Code)> {
        let rows = self.dialect.code.iter();
        rows.filter_map(|row| {
            let Some(meaning @ Meaning::SetSpindleMode(mode)) = row.means else { return None };
            Some((mode, row.feed_mode.map(FeedMode::from), self.row(&row.code, meaning)?))
        })
        .collect()
    }

    fn speed_limit(&self) -> Option<Code> {
        let row = self
            .dialect
            .code
            .iter()
            .find(|row| row.limits_speed && row.means == Some(Meaning::SetPosition))?;
        self.row(&row.code, row.means?)
    }

    fn orient_words(&self) -> Option<&'static OrientWords> {
        self.dialect.code_for(Meaning::OrientSpindle)?.orient.as_ref()
    }

    fn orient_angles(&self) -> Vec<Letter> {
        let words = self.orient_words().map_or(&[][..], |words| &words.angle);
        words.iter().filter_map(|word| self.letter(word.letter, word.quantity)).collect()
    }

    fn surface_limit(&self) -> Option<Letter> {
        let letter = self.dialect.code_for(Meaning::SetSpindleMode(SpindleMode::Surface))?.limit?;
        self.letter(letter, Quantity::Speed)
    }

    fn frames(&self) -> FrameCodes {
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

    fn tables(&self) -> Vec<DataCode> {
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
    fn no_edge(&self) -> Option<Code> {
        let letter = self.role(Role::ToolEdge)?.letter;
        let mut text = [0; LONGEST];
        text[..2].copy_from_slice(&[letter, b'0']);
        Some(Code { text, len: 2, letter: 0, group: 0, unsure: None })
    }
}

impl Codes {
    pub(crate) fn new(settings: &Settings) -> Codes {
        let dialect = settings.dialect;
        let mut groups: Vec<&str> = dialect.code.iter().map(|row| row.group.as_str()).collect();
        groups.sort_unstable();
        groups.dedup();
        let find = Finder { dialect, groups };
        let code = |meaning| find.code(meaning);
        let last = match dialect.caps.frames.work_offsets {
            u16::MAX => 0,
            last => last,
        };
        let axis = |axis: Axis| {
            let row = dialect.address_row(axis.letter()).filter(|row| row.role == Role::Axis)?;
            find.letter(row.letter, row.quantity)
        };
        Codes {
            traverse: code(Meaning::StraightTraverse),
            feed: code(Meaning::StraightFeed),
            arcs: [Turn::Clockwise, Turn::Counterclockwise].map(|t| code(Meaning::ArcFeed(t))),
            threads: find.threads(),
            dwell: find.dwell_code(),
            units: [Units::Mm, Units::Inch].map(|u| code(Meaning::UseLengthUnits(u))),
            distance: [Distance::Absolute, Distance::Incremental].map(|d| code(Meaning::SetDistanceMode(d))),
            plane: [Plane::Xy, Plane::Zx, Plane::Yz].map(|p| code(Meaning::SelectPlane(p))),
            feed_mode: [FeedMode::PerMinute, FeedMode::PerRevolution, FeedMode::InverseTime]
                .map(|f| code(Meaning::SetFeedMode(f))),
            spindle_modes: find.spindle_modes(),
            speed_limit: find.speed_limit(),
            surface_limit: find.surface_limit(),
            level: [ReturnLevel::Initial, ReturnLevel::Retract].map(|l| code(Meaning::SetReturnLevel(l))),
            origins: (1..=last).map(|n| find.origin(n)).collect(),
            no_origin: code(Meaning::SetOriginOffsets(0)),
            no_shift: code(Meaning::ClearFrame(FrameSlot::Shift)),
            origin_shift: [false, true].map(|on| code(Meaning::UseOriginShift(on))),
            frames: find.frames(),
            tip: code(Meaning::UseToolCentrePoint(true)),
            no_compensation: code(Meaning::StopCutterRadiusCompensation),
            compensation: [Side::Left, Side::Right].map(|s| code(Meaning::StartCutterRadiusCompensation(s))),
            compensation_by_diameter: [Side::Left, Side::Right].map(|s| {
                let letter = find.role(Role::RadiusEntry)?.letter;
                let letter = find.letter(char::from(letter), Quantity::Length)?;
                Some((code(Meaning::StartCompensationByDiameter(s))?, letter))
            }),
            radius_entry: find.role(Role::RadiusEntry),
            own_radius: dialect.caps.compensation.radii.tool,
            machine: [false, true].map(|length| {
                let either = [false, true].into_iter();
                either.filter_map(|rapid| code(Meaning::UseMachineCoordinates { length, rapid })).next()
            }),
            references: dialect
                .code
                .iter()
                .filter_map(|row| {
                    let meaning = row.means?;
                    let Meaning::GoToReference { point, .. } = meaning else { return None };
                    let letter = row.words.chars().next();
                    let letter = letter.and_then(|l| find.letter(l, Quantity::Integer));
                    Some((point, find.row(&row.code, meaning)?, letter))
                })
                .collect(),
            probes: dialect
                .code
                .iter()
                .filter_map(|row| {
                    let Some(meaning @ Meaning::StraightProbe(probe)) = row.means else { return None };
                    let feed = dialect.code_for(Meaning::StraightFeed);
                    let stays = feed.is_some_and(|feed| feed.group == row.group);
                    let code = find.row(&row.code, meaning)?;
                    Some((probe, ProbeCode { code, stays, own_feed: row.own_feed }))
                })
                .collect(),
            detours: Detour::ALL.map(|detour| code(Meaning::Detour(detour))),
            tables: find.tables(),
            stated_length: [false, true].map(|added| code(Meaning::UseToolLength { added })),
            store_position: [1, 2].map(|place| code(Meaning::StorePosition(place))),
            tool_number: dialect.code_for(Meaning::SetToolNumber).and_then(|row| {
                let letter = find.letter(row.words.chars().next()?, Quantity::Integer)?;
                Some((code(Meaning::SetToolNumber)?, letter))
            }),
            length: code(Meaning::UseToolLengthOffset),
            own_length: dialect.code_for(Meaning::UseToolLengthOffset).is_some_and(|row| row.own_tool),
            no_length: code(Meaning::CancelToolLengthOffset).or_else(|| find.no_edge()),
            centre_from_start: code(Meaning::SetCentreMode(CentreFrom::Start)),
            turns: dialect.arc.turns.and_then(|letter| find.letter(letter, Quantity::Integer)),
            end_cycle: code(Meaning::EndCycle),
            spindle_clockwise: code(Meaning::StartSpindleClockwise),
            spindle_counterclockwise: code(Meaning::StartSpindleCounterclockwise),
            spindle_stop: code(Meaning::StopSpindleTurning),
            rigid_tapping: code(Meaning::RigidTapping),
            orient: code(Meaning::OrientSpindle),
            orient_words: find.orient_words(),
            orient_angles: find.orient_angles(),
            path_within: dialect
                .code_for(Meaning::SetMotionControlMode(PathMode::Continuous))
                .and_then(|row| row.words.chars().next())
                .and_then(|letter| {
                    let code = code(Meaning::SetMotionControlMode(PathMode::Continuous))?;
                    Some((code, find.letter(letter, Quantity::Length)?))
                }),
            path_merged: dialect
                .code_for(Meaning::SetMotionControlMode(PathMode::Continuous))
                .and_then(|row| find.letter(row.words.chars().nth(1)?, Quantity::Length)),
            path: PathMode::ALL.map(|(mode, _)| code(Meaning::SetMotionControlMode(mode))),
            exact_stop: code(Meaning::ExactStop),
            polar: [false, true].map(|on| code(Meaning::PolarWords(on))),
            advice: dialect
                .code
                .iter()
                .filter_map(|row| match row.means {
                    Some(meaning @ Meaning::Advise(kind, value)) if row.write => {
                        let letter = row.words.bytes().next().filter(|_| value.is_none());
                        let word = letter.map(|letter| (letter, row.on.unwrap_or(1)));
                        let amount = row.words.chars().nth(1).filter(|_| kind.has_amount());
                        let amount = amount.and_then(|letter| find.letter(letter, Quantity::Length));
                        Some(AdviceCode { kind, value, code: find.row(&row.code, meaning)?, word, amount })
                    }
                    _ => None,
                })
                .collect(),
            change_tool: code(Meaning::ChangeTool),
            machine_functions: dialect
                .code
                .iter()
                .filter_map(|row| match row.means {
                    Some(meaning @ Meaning::MachineFunction(name)) if row.write => {
                        Some((name, find.row(&row.code, meaning)?))
                    }
                    _ => None,
                })
                .collect(),
            flood: code(Meaning::FloodOn),
            mist: code(Meaning::MistOn),
            coolant_off: code(Meaning::CoolantOff),
            stop: code(Meaning::ProgramStop),
            optional_stop: code(Meaning::OptionalProgramStop),
            end: code(Meaning::ProgramEnd),
            again: code(if dialect.program.begins_again { Meaning::Return } else { Meaning::BeginAgain }),
            call: find.call(Meaning::Call),
            macro_call: find.call(Meaning::CallMacro),
            calls_at_moves: find.call(Meaning::CallMacroAtMoves).zip(code(Meaning::EndCallsAtMoves)),
            dwells: find.dwells(),
            back: code(Meaning::Return),
            no_effect: dialect
                .code
                .iter()
                .filter(|row| row.means == Some(Meaning::NoEffect))
                .filter_map(|row| Some((row.code.clone(), find.row(&row.code, Meaning::NoEffect)?)))
                .collect(),
            cycles: find.cycles(settings),
            circle: find.circle(),
            grid: find.grid(),
            axes: Axis::ALL.map(axis),
            centre: [Role::CentreX, Role::CentreY, Role::CentreZ].map(|r| find.role(r)),
            radius: find.role(Role::Radius),
            feed_word: find.role(Role::Feed),
            speed: find.role(Role::Speed),
            tool: find.role(Role::Tool),
            entry: find.role(Role::LengthEntry),
            corrector: find.role(Role::Corrector),
        }
    }

    /// The code by which a speed counts this, where a feed counts that.
    pub(crate) fn spindle_mode(&self, mode: SpindleMode, feed: Option<FeedMode>) -> Option<Code> {
        let fits = |(of, with, _): &&(SpindleMode, Option<FeedMode>, Code)| {
            *of == mode && (with.is_none() || *with == feed)
        };
        self.spindle_modes.iter().find(fits).map(|(.., code)| *code)
    }

    /// Whether codes of what a speed counts say what a feed counts.
    pub(crate) fn spindle_with_feed(&self) -> bool {
        self.spindle_modes.iter().any(|(_, feed, _)| feed.is_some())
    }

    /// The row of a cycle: of its kind, with a word for the dwell if and only if there is one.
    pub(crate) fn cycle(&self, kind: &str, dwell: bool) -> Option<&CycleCode> {
        self.cycles.iter().find(|c| c.kind == kind && c.dwell.is_some() == dwell)
    }
}
