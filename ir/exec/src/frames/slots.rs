//! The slots of the coordinate chain between program and work offset, and what they amount to.
//!
//! From the machine towards the program: G92 shift, local shift, rotation, scale, mirror, and
//! the chain of frames. The centre of a rotation is scaled and mirrored like any point, an odd number of
//! mirrors in its plane turns its sense round, its angle is not scaled (FANUC B-63944EN-2, p. 211).
//!
//! For execution and for passes alike. Not here: what a dialect forbids inside a frame.

use crate::frames::chain::Chain;
use ncc_ir::canon::{AXES, Distance, Fact, Plane};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE, Unit};
use ncc_ir::program::{Coord, FrameSlot, FrameStep, Slot};

/// An active rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// In which plane.
    pub plane: Plane,
    /// Along the two axes of the plane.
    pub centre: [Nanos; 2],
    /// By how much, degrees.
    pub angle: Nanos,
}

/// Factors active.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Along X, Y and Z.
    pub centre: [Nanos; 3],
    /// The factor of each.
    pub factors: [Nanos; 3],
}

/// A G92 shift that is not active and comes back as it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Suspended {
    origin: [Option<Nanos>; AXES],
    /// Whether what an earlier program left over was active with it.
    left_over: bool,
}

/// What all slots hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Frames {
    /// G92 shift, of axes of which a program has said it; the others have what was left over.
    pub origin: [Option<Nanos>; AXES],
    /// A G92 shift that is not active.
    pub suspended: Option<Suspended>,
    /// The local shift.
    pub local: [Nanos; AXES],
    /// The rotation.
    pub rotation: Option<Rotation>,
    /// The factors.
    pub scale: Option<Scale>,
    /// Places at which axes are mirrored.
    pub mirror: [Option<Nanos>; 3],
    /// Frames chained freely.
    pub steps: Chain,
}

/// What a statement that fills a slot must know of the control.
pub trait Present {
    /// What it says of what it does not know.
    type Unknown;
    /// The plane of a statement.
    fn plane(&self, plane: Fact<Plane>) -> Result<Plane, Self::Unknown>;
    /// A literal's value.
    fn value(&self, value: &Expr) -> Result<Nanos, Self::Unknown>;
    /// How a word is measured.
    fn distance(&self, word: &Coord) -> Result<Distance, Self::Unknown>;
    /// Where an axis stands in the work offset with the G92 shift; all of them are asked for
    /// where a frame mixes them.
    fn work(&self, axis: usize) -> Result<Nanos, Self::Unknown>;
    /// A value that no control takes.
    fn out_of_range(&self) -> Self::Unknown;
}

impl Frames {
    /// Nothing in any slot.
    pub const NONE: Frames = Frames {
        origin: [None; AXES],
        suspended: None,
        local: [0; AXES],
        rotation: None,
        scale: None,
        mirror: [None; 3],
        steps: Chain::NONE,
    };

    /// What the slots amount to, without the G92 shift.
    pub fn chain(&self) -> Chain {
        if (self.rotation, self.scale, self.mirror) == (None, None, [None; 3]) && self.local == [0; AXES] {
            return self.steps.clone();
        }
        let mut chain = Chain::NONE;
        let steps = self.slot_steps();
        for step in &steps {
            // All of it is known and has been looked at before.
            let _ = chain.add(step, |plane| Ok(plane.or(Plane::Xy)), known, || ());
        }
        chain.then(&self.steps)
    }

    /// Where a point goes by scale and mirror.
    fn scaled_and_mirrored(&self, mut p: [Nanos; 3]) -> [Nanos; 3] {
        for (p, line) in p.iter_mut().zip(self.mirror) {
            if let Some(line) = line {
                *p = 2 * line - *p;
            }
        }
        if let Some(scale) = &self.scale {
            for ((p, centre), factor) in p.iter_mut().zip(scale.centre).zip(scale.factors) {
                let away = (*p - centre) as f64 * factor as f64 / ONE as f64;
                *p = centre + away.round() as Nanos;
            }
        }
        p
    }

    /// The local shift, rotation, scale and mirror as steps of a chain, the outermost first.
    pub fn slot_steps(&self) -> Vec<FrameStep> {
        let length = |nanos: Nanos| Some(Expr::Num(ncc_ir::expr::num::Num::from_nanos(nanos, 9, Unit::Mm)));
        let degrees = |nanos: Nanos| Expr::Num(ncc_ir::expr::num::Num::from_nanos(nanos, 9, Unit::Degree));
        let factor = |nanos: Nanos| Some(Expr::Num(ncc_ir::expr::num::Num::from_nanos(nanos, 9, Unit::One)));
        let mut steps = Vec::new();
        let shift = |by: [Nanos; AXES], steps: &mut Vec<FrameStep>| {
            if by == [0; AXES] {
                return;
            }
            let words = std::array::from_fn(|i| match by[i] {
                0 => None,
                by if i >= 3 => Some(degrees(by)),
                by => length(by),
            });
            steps.push(FrameStep::Translate(Box::new(words)));
        };
        shift(self.local, &mut steps);
        if let Some(rotation) = &self.rotation {
            let (f, s, _) = rotation.plane.axes();
            let mut centre = [0; 3];
            (centre[f as usize], centre[s as usize]) = (rotation.centre[0], rotation.centre[1]);
            let placed = self.scaled_and_mirrored(centre);
            let mut by = [0; AXES];
            (by[f as usize], by[s as usize]) = (placed[f as usize], placed[s as usize]);
            let odd = self.mirror[f as usize].is_some() != self.mirror[s as usize].is_some();
            let angle = if odd { -rotation.angle } else { rotation.angle };
            shift(by, &mut steps);
            steps.push(FrameStep::Rotate { plane: Fact::Known(rotation.plane), angle: degrees(angle) });
            shift(by.map(|v| -v), &mut steps);
        }
        if let Some(scale) = &self.scale {
            let by: [Nanos; AXES] =
                std::array::from_fn(|i| if i < 3 && scale.factors[i] != ONE { scale.centre[i] } else { 0 });
            let factors = std::array::from_fn(|i| {
                (scale.factors[i] != ONE).then(|| factor(scale.factors[i])).flatten()
            });
            shift(by, &mut steps);
            steps.push(FrameStep::Scale(Box::new(factors)));
            shift(by.map(|v| -v), &mut steps);
        }
        if self.mirror != [None; 3] {
            let by: [Nanos; AXES] =
                std::array::from_fn(|i| if i < 3 { self.mirror[i].unwrap_or(0) } else { 0 });
            shift(by, &mut steps);
            steps.push(FrameStep::Mirror(self.mirror.map(|line| line.is_some())));
            shift(by.map(|v| -v), &mut steps);
        }
        steps
    }

    /// Fills a slot.
    ///
    /// # Errors
    /// What `now` does not know.
    pub fn set<P: Present>(&mut self, slot: &Slot, now: &P) -> Result<(), P::Unknown> {
        match slot {
            Slot::Shift { origin, axes } => {
                for (i, word) in axes.iter().enumerate() {
                    let Some(word) = word else { continue };
                    let value = now.value(word)?;
                    if *origin {
                        self.suspended = None;
                        self.origin[i] = Some(value);
                    } else {
                        self.local[i] = value;
                    }
                }
            }
            Slot::Rotation { plane, centre, angle } => {
                let plane = now.plane(*plane)?;
                let (f, s, _) = plane.axes();
                let before = self.rotation.take();
                let centre = [f, s].map(|axis| self.place_of(axis as usize, centre, now));
                let [Ok(f), Ok(s)] = centre else {
                    let [f, s] = centre;
                    return f.and(s).map(|_| ());
                };
                let mut value = now.value(&angle.value)?;
                if now.distance(angle)? == Distance::Incremental {
                    value += before.map_or(0, |before| before.angle);
                }
                self.rotation = (value != 0).then_some(Rotation { plane, centre: [f, s], angle: value });
            }
            Slot::Scale { centre, factors } => {
                self.scale = None;
                let mut scale = Scale { centre: [0; 3], factors: [ONE; 3] };
                for i in 0..3 {
                    if let Some(factor) = &factors[i] {
                        scale.factors[i] = now.value(factor)?;
                        if scale.factors[i] <= 0 {
                            return Err(now.out_of_range());
                        }
                    }
                    if scale.factors[i] != ONE {
                        scale.centre[i] = self.place_of(i, centre, now)?;
                    }
                }
                self.scale = (scale.factors != [ONE; 3]).then_some(scale);
            }
            Slot::Mirror(lines) => {
                for (mirror, line) in self.mirror.iter_mut().zip(lines.iter()) {
                    if let Some(line) = line {
                        *mirror = Some(now.value(line)?);
                    }
                }
            }
            Slot::NoMirror(axes) => {
                for (mirror, over) in self.mirror.iter_mut().zip(axes) {
                    if *over {
                        *mirror = None;
                    }
                }
            }
            // A tilted plane is kept apart (`tilt`).
            Slot::Tilt(_) => {}
        }
        Ok(())
    }

    /// Along one axis, the place that a word names, or where the tool is.
    fn place_of<P: Present>(
        &self,
        axis: usize,
        words: &[Option<Expr>; 3],
        now: &P,
    ) -> Result<Nanos, P::Unknown> {
        match &words[axis] {
            Some(word) => now.value(word),
            None => {
                let chain = self.chain();
                let mut at = [0; AXES];
                for (i, at) in at.iter_mut().enumerate() {
                    if i == axis || i < 3 && chain.turn().is_some() {
                        *at = now.work(i)?;
                    }
                }
                Ok(chain.unplace(&at)[axis])
            }
        }
    }

    /// Gives the present point coordinates by the G92 shift. `shift` is what there is of it.
    ///
    /// # Errors
    /// What `now` does not know; a frame that turns, mirrors or scales is out of range.
    pub fn set_position<P: Present>(
        &mut self,
        axes: &[Option<Expr>; AXES],
        shift: &[Nanos; AXES],
        now: &P,
    ) -> Result<(), P::Unknown> {
        if self.is_turned() {
            return Err(now.out_of_range());
        }
        for (i, word) in axes.iter().enumerate() {
            if let Some(word) = word {
                self.local[i] = 0;
                let own = self.steps.shift()[i];
                self.suspended = None;
                self.origin[i] = Some(shift[i] + now.work(i)? - own - now.value(word)?);
            }
        }
        Ok(())
    }

    /// No G92 shift is active from here on, until [`Frames::resume`]; a shift that is suspended
    /// already stays so. `left_over` says whether one of an earlier program is active.
    pub fn suspend(&mut self, left_over: bool) {
        let origin = std::mem::replace(&mut self.origin, [None; AXES]);
        if left_over || origin != [None; AXES] {
            self.suspended = Some(Suspended { origin, left_over });
        }
    }

    /// The number kept of a shift that is suspended.
    pub fn suspended_shift(&self, axis: usize) -> Option<Nanos> {
        self.suspended.as_ref().map(|suspended| suspended.origin[axis].unwrap_or(0))
    }

    /// The G92 shift is again what it was when it was suspended; without one, nothing changes.
    /// `true` says that what an earlier program left over is active again.
    pub fn resume(&mut self) -> bool {
        let Some(Suspended { origin, left_over }) = self.suspended.take() else { return false };
        self.origin = origin;
        left_over
    }

    /// Whether it does more than to move the origin.
    pub fn is_turned(&self) -> bool {
        self.rotation.is_some()
            || self.scale.is_some()
            || self.mirror != [None; 3]
            || self.steps.turn().is_some()
    }

    /// Empties a slot.
    pub fn clear(&mut self, slot: FrameSlot) {
        match slot {
            FrameSlot::Shift => (self.origin, self.suspended) = ([None; AXES], None),
            FrameSlot::Local => self.local = [0; AXES],
            FrameSlot::Rotation => self.rotation = None,
            FrameSlot::Scale => self.scale = None,
            FrameSlot::Mirror => self.mirror = [None; 3],
            FrameSlot::Chain => self.steps = Chain::NONE,
            FrameSlot::Polar | FrameSlot::Tilt => {}
        }
    }
}

/// A literal of a step that was made here.
fn known(value: &Expr) -> Result<Nanos, ()> {
    value.literal().and_then(|n| n.nanos(false)).ok_or(())
}
