//! Tilted planes of a program: where the tip is on the part while its points are those of a plane.
//!
//! ```text
//! G68.2 X20. Y0 Z-5. I0 J30. K0    X'6 Y'8 Z'-12 of the plane are X26 Y12.9 Z-11.4 of the part; the tool leans by 30°
//! G53.1                            here it is turned upright on the plane
//! ```
//!
//! No program says where the tip is when rotary axes have turned the tool or the part: the kinematics are the machine's. So
//! ncc does not know it from there on, until the program has stated X, Y and Z of the plane, and again after the plane, until it
//! has stated those of the part. Nothing is cut until then, except that a tool of which only the height is not known comes straight
//! down from as high as it ever is on the plane.

use ncc_exec::{Event, Movement, TiltedPlane};
use ncc_ir::canon::{AXES, Turn};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_simulate::{Axes, Move, Way, turned, turned_back};

use super::unsimulated::Unsimulated;
use crate::time::drive::Tip;

const Z: usize = 2;

/// A plane that is no more tilted than this is not: of its directions.
const LEVEL: f64 = 1e-12;

/// The active plane.
#[derive(Debug)]
struct Plane {
    axes: Axes,
    /// Its zero, in coordinates of the machine without a tool, mm.
    zero: [f64; 3],
    /// Where zero of the program lies without it, in the same coordinates.
    program: [f64; 3],
    /// Where the rotary axes stood when the tool was turned upright on it; `None` before that.
    upright: Option<[Nanos; 3]>,
    /// Whether the tool is upright on it.
    is_upright: bool,
    /// Its number among [`Planes::tilts`], from 1; 0 until the tool moves on it.
    tilt: u16,
    /// Which of its coordinates of the tip are known.
    known: [bool; 3],
    /// Where the tip is, along its axes.
    at: [f64; 3],
    /// The greatest Z that is known.
    top: f64,
    /// Moves that end at a Z that ncc does not know, and their X and Y.
    highs: Vec<(usize, [f64; 2])>,
}

/// Where a move ends on the part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) way: Way,
    /// In coordinates of the machine without a tool, mm; so is the centre of an arc, along the axes of its plane.
    pub(super) end: [f64; 3],
    pub(super) tilt: u16,
    /// Why it cannot be simulated, if it cuts.
    pub(super) why: Option<Unsimulated>,
    /// Whether its height is not known.
    pub(super) high: bool,
}

/// All planes of a program.
#[derive(Debug, Default)]
pub(super) struct Planes {
    /// Axes of the tilted planes on which an upright tool moves.
    pub(super) tilts: Vec<Axes>,
    now: Option<Plane>,
    /// Which of X, Y and Z ncc does not know after a plane.
    pub(super) lost: [bool; 3],
    /// Whether a plane has turned the tool, or the part, and nothing has turned it back.
    turned: bool,
    /// Whether a plane without angles has turned it back: that all rotary axes are at zero then is an assumption. A rotary table
    /// may keep its angle where the tool is parallel to its axis.
    pub(super) straightened: bool,
    /// Rotary axes that the program has stated so far, and those stated since it was turned.
    stated: [[bool; 3]; 2],
}

impl Planes {
    /// A plane becomes active; `at` is where the tip is.
    pub(super) fn set(&mut self, plane: &TiltedPlane, tip: &Tip, at: [f64; 3], moves: &mut [Move]) {
        self.clear(moves);
        let axes = plane.axes;
        let program = tip.zero.map(mm);
        let zero: [f64; 3] = std::array::from_fn(|n| program[n] + mm(plane.origin[n]));
        let at = turned_back(&axes, std::array::from_fn(|n| at[n] - zero[n]));
        self.now = Some(Plane {
            axes,
            zero,
            program,
            upright: None,
            is_upright: false,
            tilt: 0,
            known: [false; 3],
            at,
            top: f64::NEG_INFINITY,
            highs: Vec::new(),
        });
    }

    /// The plane is over; the moves on it whose height ncc does not know are as high as it ever is there.
    pub(super) fn clear(&mut self, moves: &mut [Move]) {
        let Some(plane) = self.now.take() else { return };
        self.lost = [true; 3];
        for (n, [x, y]) in &plane.highs {
            let top = if plane.top.is_finite() { plane.top } else { plane.at[Z] };
            moves[*n].end = plane.place([*x, *y, top]);
        }
    }

    /// The tool is turned upright on the plane.
    pub(super) fn orient(&mut self, event: &Event) {
        let Some(plane) = &mut self.now else { return };
        plane.upright = Some(rotary(&event.end));
        plane.is_upright = true;
        plane.known = [false; 3];
        self.straightened |= self.turned && plane.is_straight();
        self.turned = !plane.is_straight();
        self.stated[1] = [false; 3];
    }

    /// Notes what a block states of rotary axes.
    pub(super) fn note(&mut self, tip: &Tip, event: &Event, upright: [Nanos; 3]) {
        for (axis, upright) in upright.into_iter().enumerate() {
            if tip.stated[3 + axis] {
                self.stated[0][axis] = true;
                self.stated[1][axis] = event.end[3 + axis] == upright;
            }
        }
        if self.turned
            && self.now.is_none()
            && self.stated[1] == self.stated[0]
            && self.stated[1] != [false; 3]
        {
            self.turned = false;
        }
    }

    /// Why a cut without a plane cannot be simulated.
    pub(super) fn refuses_beside(&self) -> Option<Unsimulated> {
        match (self.turned, self.lost != [false; 3]) {
            (true, _) => Some(Unsimulated::Leaning),
            (false, true) => Some(Unsimulated::Unplaced),
            (false, false) => None,
        }
    }

    /// Whether a block states coordinates that ncc did not know.
    pub(super) fn finds(&self, tip: &Tip) -> bool {
        (0..3).any(|axis| match &self.now {
            Some(plane) => tip.stated[axis] && !plane.known[axis],
            None => tip.stated[axis] && self.lost[axis],
        })
    }

    /// Notes which coordinates are known again without a plane; gives whether X and Y are, before and after.
    pub(super) fn find(&mut self, tip: &Tip) -> bool {
        let before = self.lost[..2] == [false; 2];
        for axis in 0..3 {
            self.lost[axis] &= !(tip.stated[axis] || tip.of_machine[axis]);
        }
        before && self.lost[..2] == [false; 2]
    }

    /// Where a move on the plane goes. `adds`: what the tool adds; `number`: of the move, from 0; `sweep`: of an arc.
    pub(super) fn place(
        &mut self,
        event: &Event,
        movement: Movement,
        (tip, adds): (&Tip, [Nanos; 3]),
        (number, sweep): (usize, f64),
    ) -> Option<Placed> {
        let plane = self.now.as_mut()?;
        let before = plane.known;
        if tip.of_machine != [false; 3] {
            // Along which axes of the plane those of the machine go, its kinematics alone say.
            plane.known = [false; 3];
        } else {
            (0..3).for_each(|axis| plane.known[axis] |= tip.stated[axis]);
        }
        let along = |machine: Nanos, axis: usize| mm(machine - adds[axis]) - plane.program[axis];
        let at = [0, 1, 2].map(|n| if plane.known[n] { along(event.end[n], n) } else { plane.at[n] });
        let [was_known, known] = [before, plane.known].map(|known| known == [true; 3]);
        let comes_down = before[..2] == [true; 2] && known && movement == Movement::Rapid;
        // The kernel has no moves of a tool that is not upright on its plane, nor of one that a rotary axis turns.
        let was_upright = plane.is_upright;
        plane.is_upright = plane.upright == Some(rotary(&event.end));
        let mut way = match movement {
            _ if !(was_upright && plane.is_upright) => Way::Away,
            Movement::Rapid if was_known && known || comes_down => Way::Rapid,
            Movement::Feed if was_known && known => Way::Feed,
            Movement::Arc { plane: of, turn, centre, .. } if was_known && known => {
                let (first, second, normal) = of.axes();
                let of = [first, second, normal].map(|axis| axis as usize);
                let sense = if turn == Turn::Counterclockwise { 1.0 } else { -1.0 };
                let back = turned_back(&plane.axes, plane.zero);
                let centre = [0, 1].map(|n| along(centre[n], of[n]) + back[of[n]]);
                Way::Arc { plane: of.map(|axis| axis as u8), centre, sweep: sense * sweep }
            }
            Movement::Rapid | Movement::Feed | Movement::Arc { .. } => Way::Away,
        };
        let is_arc_of_another_plane = matches!(way, Way::Arc { plane: [_, _, 0 | 1], .. });
        let mut why = match plane.upright {
            None => Some(Unsimulated::Tilted),
            Some(upright) if upright != rotary(&event.end) => Some(Unsimulated::Rotary),
            Some(_) if !(was_known && known) => Some(Unsimulated::Unplaced),
            Some(_) => None,
        };
        let mut tilt = 0;
        if plane.is_upright && (plane.axes[2][2] < 1.0 - LEVEL || is_arc_of_another_plane) {
            if plane.tilt == 0 {
                plane.tilt = number_of(&plane.axes, &mut self.tilts);
            }
            tilt = plane.tilt;
            if tilt == 0 {
                why = why.or(Some(Unsimulated::Tilted));
            }
        } else if let Way::Arc { centre, .. } = &mut way {
            // Upright, an arc is one of X and Y of the part.
            let [x, y, _] = turned(&plane.axes, [centre[0], centre[1], 0.0]);
            *centre = [x, y];
        }
        let high = plane.known == [true, true, false];
        if high {
            plane.highs.push((number, [at[0], at[1]]));
        } else if known {
            plane.top = plane.top.max(at[Z]);
        }
        plane.at = at;
        Some(Placed { way, end: plane.place(at), tilt, why, high })
    }
}

/// The number of a plane among others, from 1, put to them where it is new; 0 where there are too many.
fn number_of(axes: &Axes, all: &mut Vec<Axes>) -> u16 {
    let known = all.iter().position(|own| own == axes);
    let number = u16::try_from(known.unwrap_or(all.len()) + 1).unwrap_or(0);
    if known.is_none() && number != 0 {
        all.push(*axes);
    }
    number
}

impl Plane {
    /// A place along its axes, in coordinates of the machine without a tool.
    fn place(&self, at: [f64; 3]) -> [f64; 3] {
        let at = turned(&self.axes, at);
        std::array::from_fn(|n| self.zero[n] + at[n])
    }

    /// Whether it is turned by nothing.
    fn is_straight(&self) -> bool {
        (0..3).all(|n| self.axes[n][n] > 1.0 - LEVEL)
    }
}

fn rotary(axes: &[Nanos; AXES]) -> [Nanos; 3] {
    [axes[3], axes[4], axes[5]]
}

pub(super) fn mm(nanos: Nanos) -> f64 {
    nanos as f64 / ONE as f64
}
