//! Settings: units, plane, distance, feed mode, return level, work offset, and what is switched
//! off. Written where the source says them, also if redundant.

use ncc_ir::canon::{Distance, Fact, FeedMode, Modes, Plane, SpindleMode, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::lack::{FeedsLack, FramesLack, HolesLack, Lack, ModesLack};
use ncc_ir::program::Coord;
use ncc_ir::source::Span;

use super::Words;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Code;
use crate::common::fault::cannot;
use crate::common::setting::{Inserted, Setting};

fn said(code: Option<Code>, lack: impl Into<Lack>) -> Result<Option<Code>, Fault> {
    code.map(Some).ok_or_else(|| cannot(lack))
}

impl Words {
    /// The code of a setting; `None` in `Ok` where the target needs no word for it, because it has
    /// that one state alone.
    pub(crate) fn setting(&self, setting: Setting) -> Result<Option<Code>, Fault> {
        let codes = &self.codes;
        match setting {
            Setting::Units(u) => said(codes.units[u as usize], ModesLack::Units),
            Setting::Distance(Distance::Absolute) => said(codes.distance[0], ModesLack::Absolute),
            Setting::Distance(Distance::Incremental) => said(codes.distance[1], ModesLack::Incremental),
            Setting::Plane(p) => said(codes.plane[p as usize], ModesLack::Plane),
            Setting::FeedMode(f) if self.surface_joins_feed()? => {
                let lack = FeedsLack::UnderSurfaceSpeed;
                said(codes.spindle_mode(SpindleMode::Surface, Some(f)), lack)
            }
            Setting::FeedMode(f) => match codes.feed_mode[f as usize] {
                Some(code) => Ok(Some(code)),
                None if self.only_feed_mode() == Some(f) => Ok(None),
                None => Err(cannot(match f {
                    FeedMode::PerMinute => FeedsLack::PerMinute,
                    FeedMode::PerRevolution => FeedsLack::PerRevolution,
                    FeedMode::InverseTime => FeedsLack::InverseTime,
                })),
            },
            Setting::Level(l) => match codes.level[l as usize] {
                Some(code) => Ok(Some(code)),
                // Where the level is fixed, the cycle itself carries it.
                None if self.dialect.cycles.return_level.is_some() => Ok(None),
                // Where there are no cycles, nothing returns.
                None if self.dialect.caps.holes.cycles.is_empty() => Ok(None),
                // Where every call of a cycle states its plane, there is none.
                None if self.dialect.states_return_planes() => Ok(None),
                None => Err(cannot(HolesLack::ReturnLevel)),
            },
            Setting::Origin(n) => {
                let code = match usize::from(n).checked_sub(1) {
                    Some(at) => codes.origins.get(at).copied().flatten(),
                    None => codes.no_origin,
                };
                match code {
                    Some(code) => Ok(Some(code)),
                    // A control with one work offset lacks it.
                    None if self.dialect.caps.frames.work_offsets == 0 => Ok(None),
                    None => Err(cannot(FramesLack::WorkOffset { offset: n })),
                }
            }
            // Without a word for it, none can be on: no statement that is written sets one.
            Setting::NoShift => Ok(codes.no_shift),
            Setting::NoCompensation => Ok(codes.no_compensation),
            Setting::NoLength => Ok(codes.no_length),
            Setting::NoCycle => Ok(codes.end_cycle),
            Setting::Turns => self.turns_code(),
        }
    }

    /// The feed mode of a control that has only one.
    fn only_feed_mode(&self) -> Option<FeedMode> {
        self.dialect.power_on.feed_mode.as_ref().filter(|f| f.always).map(|f| f.value.into())
    }

    /// Writes a setting in its place.
    pub(crate) fn write_setting(&mut self, setting: Setting, sink: &mut Sink) -> Result<(), Fault> {
        if let Some(code) = self.setting(setting)? {
            self.admit(&Need::new(Rank::Setting).code(Some(code)), sink)?;
            self.block.code(Part::Mode, &code);
        }
        self.now_in_force(setting);
        Ok(())
    }

    /// Before control goes another way, the distance mode of the program is active again: the text may have put in
    /// another one, as in `G91 G28 Z0`.
    /// `apart`: in a block of its own, which is not the one that is jumped to.
    pub(crate) fn restore_distance(&mut self, apart: bool, sink: &mut Sink) -> Result<(), Fault> {
        let own = self.tracker.modes.distance.or(self.facts.entry).or(self.facts.replaced);
        match own.filter(|_| self.active.our_distance && self.active.distance != own) {
            Some(own) => {
                let number = self.block.number.take_if(|_| apart);
                self.write_setting(Setting::Distance(own), sink)?;
                if apart {
                    self.flush(false, sink);
                    self.split = true;
                    self.block.number = number;
                }
                Ok(())
            }
            None => Ok(()),
        }
    }

    /// Notes a setting that the text states, or need not state.
    pub(crate) fn now_in_force(&mut self, setting: Setting) {
        match setting {
            Setting::Units(u) => {
                if self.active.units != Some(u) {
                    self.active.feed = None;
                }
                self.active.units = Some(u);
                self.units_stated[u as usize] = true;
            }
            Setting::Distance(d) => {
                self.active.distance = Some(d);
                self.active.our_distance = false;
            }
            Setting::Plane(p) => {
                self.active.plane = Some(p);
                self.active.our_plane = false;
            }
            Setting::FeedMode(f) => {
                if self.active.feed_mode != Some(f) {
                    self.active.feed = None;
                }
                self.active.feed_mode = Some(f);
            }
            Setting::Level(l) => {
                self.active.level = Some(l);
                self.active.our_level = false;
            }
            Setting::Turns => self.active.spindle_mode = Some(SpindleMode::Turns),
            // The code of a cycle's end leaves the motion to be stated again.
            Setting::NoCycle => self.active.motion = None,
            Setting::Origin(_) | Setting::NoShift | Setting::NoCompensation | Setting::NoLength => {}
        }
    }

    /// Takes over facts that the source assumed, where this control has them at its own
    /// power-on as well and nothing in the text can have changed them.
    pub(crate) fn take_for_granted(&mut self, assumed: &Modes) {
        if self.lost {
            return;
        }
        let power_on = &self.dialect.power_on;
        fn both<T: Copy + PartialEq>(force: &mut Option<T>, assumed: Option<T>, here: Option<T>) {
            if force.is_none() && assumed.is_some() && assumed == here {
                *force = assumed;
            }
        }
        if self.dialect.safe_start.is_empty() {
            let force = &mut self.active;
            both(&mut force.units, assumed.units, power_on.units.as_ref().map(|f| f.value.into()));
            both(&mut force.distance, assumed.distance, power_on.distance.as_ref().map(|f| f.value.into()));
            both(&mut force.plane, assumed.plane, power_on.plane.as_ref().map(|f| f.value.into()));
        }
        self.assumed = *assumed;
    }

    /// The distance mode that coordinates need, put in if it is not active.
    ///
    /// # Errors
    /// Absolute and incremental words together, or words in the source's own mode where the text
    /// has another.
    pub(crate) fn need_distance<'a>(
        &mut self,
        coords: impl Iterator<Item = &'a Coord>,
        inserted: &mut Inserted,
    ) -> Result<(), Fault> {
        let mut wanted = None;
        let mut inherits = false;
        // Words that say their own distance need nothing put in, once a mode is active.
        let qualifiers = self.dialect.block.qualifiers;
        let in_force = self.says_distance || self.active.distance.is_some();
        for coord in coords {
            match coord.distance {
                Fact::Known(_) if qualifiers && (in_force || wanted.is_some()) => {}
                Fact::Known(d) if wanted.is_some_and(|w| w != d) => {
                    return Err(cannot(ModesLack::MixedDistances));
                }
                Fact::Known(d) => wanted = Some(d),
                Fact::Entry => inherits = true,
            }
        }
        if inherits && (self.active.our_distance || (wanted.is_some() && wanted != self.active.distance)) {
            return Err(cannot(ModesLack::DistanceUnknown));
        }
        if let Some(d) = wanted.filter(|d| self.active.distance != Some(*d)) {
            inserted.distance = self.setting(Setting::Distance(d))?;
            if !self.active.our_distance {
                self.facts.replaced = self.active.distance;
            }
            self.active.distance = Some(d);
            self.active.our_distance = true;
        }
        Ok(())
    }

    /// What a word of another distance mode than the active one is marked by, on a control whose
    /// words can be marked.
    pub(crate) fn qualifier(&self, distance: Fact<Distance>) -> Option<&'static str> {
        match distance {
            Fact::Known(d) if self.dialect.block.qualifiers && self.active.distance != Some(d) => {
                Some(match d {
                    Distance::Absolute => "AC",
                    Distance::Incremental => "IC",
                })
            }
            Fact::Known(_) | Fact::Entry => None,
        }
    }

    /// The plane that a statement needs, put in if it is not active.
    pub(crate) fn need_plane(&mut self, plane: Fact<Plane>, inserted: &mut Inserted) -> Result<(), Fault> {
        match plane {
            Fact::Known(p) if self.active.plane != Some(p) => {
                inserted.plane = self.setting(Setting::Plane(p))?;
                self.active.plane = Some(p);
                self.active.our_plane = true;
                Ok(())
            }
            Fact::Entry if self.active.our_plane => Err(cannot(ModesLack::PlaneUnknown)),
            Fact::Known(_) | Fact::Entry => Ok(()),
        }
    }

    /// Writes the codes put in for a statement in blocks of their own, before it.
    pub(crate) fn modes_before(&mut self, inserted: Inserted, sink: &mut Sink) -> Result<(), Fault> {
        for mode in [inserted.plane, inserted.distance].into_iter().flatten() {
            self.admit(&Need::new(Rank::Setting).code(Some(mode)), sink)?;
            self.block.code(Part::Mode, &mode);
            self.flush(false, sink);
        }
        Ok(())
    }

    /// Makes room for a statement together with the codes put in for it.
    pub(crate) fn admit_with(
        &mut self,
        need: Need,
        inserted: Inserted,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let together = need.code(inserted.distance).code(inserted.plane);
        let codes = [inserted.plane, inserted.distance];
        if self.block.possible(&together) {
            self.admit(&together, sink)?;
            codes.iter().flatten().for_each(|code| self.block.code(Part::Mode, code));
            return Ok(());
        }
        for code in codes.into_iter().flatten() {
            self.admit(&Need::new(Rank::Setting).code(Some(code)), sink)?;
            self.block.code(Part::Mode, &code);
        }
        self.admit(&need, sink)
    }

    /// Checks that a literal's unit is the active one in the text.
    pub(crate) fn check_unit(&mut self, n: Num, span: Span) -> Result<(), Fault> {
        let units = match n.unit {
            Unit::Mm => Units::Mm,
            Unit::Inch => Units::Inch,
            Unit::One | Unit::Entry | Unit::Degree | Unit::Second => return Ok(()),
        };
        let other = match units {
            Units::Mm => Units::Inch,
            Units::Inch => Units::Mm,
        };
        let known = match self.active.units {
            Some(in_force) => in_force == units,
            // Not known here, but the text states one unit and never another.
            None => self.units_stated[units as usize] && !self.units_stated[other as usize],
        };
        if !known && !n.is_zero() {
            return Err(match units {
                Units::Mm => cannot(ModesLack::MillimetresUnknown),
                Units::Inch => cannot(ModesLack::InchesUnknown),
            });
        }
        if self.active.units.is_none() {
            self.units_relied.get_or_insert((units, span));
        }
        Ok(())
    }
}
