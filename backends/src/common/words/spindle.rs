//! What a speed counts, and stops of the spindle at an angle.
//!
//! Not here: a code that says both what a speed and what a feed counts, for two statements at once.

use ncc_ir::canon::SpindleMode;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::{FeedsLack, SpindleLack};
use ncc_ir::program::Stmt;
use ncc_ir::source::Span;

use super::Words;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Code;
use crate::common::fault::cannot;

/// The option that says whose coordinate is the radius of a surface speed.
const AXIS: &str = "surface_axis";

/// The option that says how long a stop of the spindle at an angle is waited for, seconds.
const WAIT: &str = "orient_wait";

/// What the text has said of surface speeds.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Surfaces {
    /// Whether any was active so far.
    pub(crate) met: bool,
    /// Whether any limit was.
    pub(crate) limited: bool,
    /// Whether any has no limit in its block, where that is the place for it.
    pub(crate) unlimited: bool,
    /// A code whose speed must follow it in its block.
    waits: Option<Span>,
    /// A limit that is to be stated with the surface speed that follows.
    pub(crate) unsaid: Option<Span>,
}

impl Words {
    /// The code by which a speed counts turns a minute. None is needed where a control has no other way, and
    /// where a code of the feed says so: both are of one group there, and it is active already.
    pub(super) fn turns_code(&self) -> Result<Option<Code>, Fault> {
        let Some(code) = self.codes.spindle_mode(SpindleMode::Turns, self.active.feed_mode) else {
            return match self.surfaces.met {
                true => Err(cannot(SpindleLack::SurfaceSpeedEnd)),
                false => Ok(None),
            };
        };
        let surface = self.surfaces.met && self.active.spindle_mode != Some(SpindleMode::Turns);
        let said = self.codes.spindle_with_feed() && self.block.says(code.group) && !surface;
        Ok((!said).then_some(code))
    }

    /// Whether a code of the feed must say that the speed is still a surface's.
    pub(super) fn surface_joins_feed(&self) -> Result<bool, Fault> {
        match self.active.spindle_mode {
            _ if !self.surfaces.met || !self.codes.spindle_with_feed() => Ok(false),
            Some(mode) => Ok(mode == SpindleMode::Surface),
            None => Err(cannot(FeedsLack::ModeUnderUnknownSpeed)),
        }
    }

    /// The speed of the block is a surface's.
    pub(super) fn surface_speed(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let code = self.codes.spindle_mode(SpindleMode::Surface, self.active.feed_mode);
        let code = code.ok_or_else(|| cannot(SpindleLack::SurfaceSpeed))?;
        let mut need = Need::new(Rank::Setting).code(Some(code));
        let limit = match self.codes.surface_limit {
            None => None,
            Some(letter) => match self.active.limit {
                Some(limit) => {
                    self.surfaces.unsaid = None;
                    need = need.letter(letter.letter);
                    Some((letter.letter, self.value(&letter, &Expr::Num(limit), stmt.span, sink)?))
                }
                None if self.surfaces.limited => {
                    return Err(cannot(SpindleLack::LimitUnknown));
                }
                None => {
                    self.surfaces.unlimited = true;
                    None
                }
            },
        };
        self.admit(&need, sink)?;
        self.block.code(Part::Mode, &code);
        if let Some((letter, value)) = limit {
            self.block.word(Part::Mode, letter, value);
        }
        self.surface_in_force(stmt.span, sink);
        Ok(())
    }

    /// Notes that the text has said a surface speed, whose speed is to follow.
    pub(crate) fn surface_in_force(&mut self, span: Span, sink: &mut Sink) {
        self.rely(AXIS, span, sink);
        self.active.spindle_mode = Some(SpindleMode::Surface);
        self.surfaces.met = true;
        self.surfaces.waits = Some(span);
    }

    /// Tells of a surface speed whose speed does not stand in its block.
    pub(super) fn surface_with_speed(&mut self, sink: &mut Sink) {
        if let Some(span) = self.surfaces.waits.take()
            && self.codes.speed.is_none_or(|speed| !self.block.has(speed.letter))
        {
            sink.report(cannot(SpindleLack::SurfaceWithoutSpeed), span);
        }
    }

    /// A stop of the spindle, at the control's own angle or at another one.
    pub(super) fn orient(&mut self, angle: Option<&Expr>, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let code = self.codes.orient.ok_or_else(|| cannot(SpindleLack::OrientedStop))?;
        let words = self.codes.orient_words;
        let wait = words.and_then(|words| words.wait);
        let mut need = Need::new(Rank::SpindleOn).code(Some(code));
        let Some(angle) = angle else {
            if wait.is_some() {
                return Err(cannot(SpindleLack::OwnAngle));
            }
            self.admit(&need, sink)?;
            self.block.code(Part::Tail, &code);
            return Ok(());
        };
        // On some machines a choice says which letter it is.
        let chosen = words.and_then(|words| words.option.as_deref()).map(|option| self.settings.get(option));
        if self.tracker.cycle.is_some() && self.dialect.cycles.retained_by_all() {
            // The cycles have the letter too; whether theirs changes with it, no source tells.
            return Err(cannot(SpindleLack::OrientedStopInCycle));
        }
        let counts = |letter: u8| chosen.is_none_or(|chosen| chosen.as_bytes() == [letter]);
        let letter = self.codes.orient_angles.iter().find(|letter| counts(letter.letter)).copied();
        let letter = letter.ok_or_else(|| cannot(SpindleLack::OrientedStop))?;
        let value = self.value(&letter, angle, span, sink)?;
        need = need.letter(letter.letter);
        if let Some(wait) = wait {
            need = need.letter(wait as u8);
            self.rely(WAIT, span, sink);
        }
        self.admit(&need, sink)?;
        self.block.code(Part::Tail, &code);
        self.block.word(Part::Tail, letter.letter, value);
        if let Some(wait) = wait {
            let text = format!("{wait}{}", self.settings.get(WAIT));
            self.block.text(Part::Tail, &text);
        }
        Ok(())
    }
}
