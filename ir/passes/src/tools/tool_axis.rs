//! `tool-axis`: tool centre point control, and tilted working planes, in the target's form.
//!
//! Some controls apply the tool's length with the word that switches control of its tip on, and drop both
//! with one word; others say the two apart. A plane's turns are stated about Z, X and Z, or about three
//! different axes: the same plane is found by sums with quarter and half turns where they do, otherwise from the
//! directions of its axes, to a billionth of a degree, which the target's digits round. What the kinematics of the two machines have to agree about is reported
//! once.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::TOOL_AXIS;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::Target;
use ncc_exec::TiltedPlane;
use ncc_ir::canon::{Axis, Modes};
use ncc_ir::caps::{TiltForm, TipForm};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::lack::{FramesLack, Lack, ToolsLack};
use ncc_ir::program::kinds::{conduct, drilling, flow, miscellaneous, modes, moves, polar, variables};
use ncc_ir::program::{FrameSlot, Op, Program, Slot, Stmt, Tilt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "tool-axis",
    about: "writes tool centre point control and tilted planes in the target's form",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(TOOL_AXIS),
        |l, p| {
            convert_axis_lengths(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<ToolAxisState>(),
                &l.target,
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ToolAxisState {
    tip: Known,
    tilt: Known,
    /// How many lengths that come next were stated already with the word before them.
    pair: u32,
    /// The work offset that was stated already, before the word that it stands after in the source.
    offset: Option<u16>,
    /// Whether each was reported.
    reported: [bool; 2],
}

/// Whether something is active.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Now {
    #[default]
    Off,
    On,
    Unknown,
}

/// What is known of something that can be on. At the start it is off.
#[derive(Clone, Copy, Debug, Default)]
struct Known {
    now: Now,
    /// Whether a program was met that switches it on.
    met: bool,
    /// Whether an end of it was left out where it was not known to be off.
    left_out: bool,
}

impl Known {
    fn is_off(self) -> bool {
        self.now == Now::Off
    }

    fn is_on(self) -> bool {
        self.now == Now::On
    }

    /// Notes that it is switched, in a block that may be skipped or not.
    fn set(&mut self, to: Now, skipped: bool) {
        self.now = if skipped && self.now != to { Now::Unknown } else { to };
        self.met |= to == Now::On;
    }

    /// After a call, or at the start of what is called.
    fn lose(&mut self) {
        self.now = Now::Unknown;
    }

    /// Notes that an end is left out; later it cannot have been on.
    fn leave_out(&mut self) {
        self.left_out |= !self.is_off();
    }
}

impl ToolAxisState {
    /// Whether lengths are this pass's business too.
    pub(crate) fn is_busy(&self) -> bool {
        self.tip.met
    }

    /// Whether the length at hand was stated already.
    fn has_said_length(&mut self) -> bool {
        let said = self.pair > 0;
        self.pair = self.pair.saturating_sub(1);
        said
    }

    /// Control of the tip is switched on or off.
    fn switch_tip(
        &mut self,
        stmt: Stmt,
        behind: Behind,
        before: &Modes,
        target: &Target,
        made: &mut Rebuild,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Lack> {
        let Op::UseToolCentrePoint(on) = stmt.op else { return Ok(()) };
        let form = target.caps.tools.tip;
        if on && form == TipForm::None {
            return Err(ToolsLack::TipControl.into());
        }
        if on && self.tip.left_out {
            return Err(ToolsLack::TipAfterUnknownEnd.into());
        }
        let needless = match (form, on) {
            (TipForm::None, _) => true,
            (TipForm::WithLength, true) => self.tip.is_on(),
            // Where no program before has switched it on, none can be on.
            (TipForm::WithLength, false) => self.tip.is_off() || !self.tip.met,
            (TipForm::Apart | TipForm::Any, _) => false,
        };
        if needless && !on {
            self.tip.leave_out();
        }
        if on && target.other_control && !std::mem::replace(&mut self.reported[0], true) {
            diags.push(Diagnostic::new(Fault::AssumedTip, stmt.span));
        }
        self.tip.set(if on { Now::On } else { Now::Off }, stmt.skip.is_some());
        if needless {
            made.leave_out(stmt);
        } else if form == TipForm::WithLength {
            with_length(stmt, on, behind, before, self, made)?;
        } else {
            made.push(stmt);
        }
        Ok(())
    }

    /// A tilted plane is set, where the tool is swivelled to it at a place after or is not.
    fn set_tilt(
        &mut self,
        stmt: Stmt,
        oriented: Option<Oriented>,
        target: &Target,
        made: &mut Rebuild,
        diags: &mut Vec<Diagnostic>,
    ) -> Result<(), Lack> {
        let form = target.caps.frames.tilt;
        let said = match &stmt.op {
            Op::SetSlot(slot) if let Slot::Tilt(tilt) = &**slot => {
                if form == TiltForm::None {
                    return Err(FramesLack::TiltedPlane.into());
                }
                if self.tilt.left_out {
                    return Err(FramesLack::TiltAfterUnknownEnd.into());
                }
                said_as(tilt, form)?
            }
            _ => {
                made.push(stmt);
                return Ok(());
            }
        };
        self.tilt.set(Now::On, stmt.skip.is_some());
        if target.other_control && !std::mem::replace(&mut self.reported[1], true) {
            diags.push(Diagnostic::new(Fault::AssumedTilt, stmt.span));
        }
        let set = Op::SetSlot(Box::new(Slot::Tilt(Box::new(said))));
        match oriented {
            Some(at) if form == TiltForm::AxisByAxis => {
                made.replace(stmt, [(true, set), (true, at.op())]);
            }
            Some(_) | None => made.push(Stmt { op: set, ..stmt }),
        }
        Ok(())
    }

    /// At the start of another body.
    pub(crate) fn start_over(&mut self) {
        self.tip.lose();
        self.tilt.lose();
        (self.pair, self.offset) = (0, None);
    }
}

/// Whether it is a length that is stated.
pub(crate) fn is_length(op: &Op) -> bool {
    matches!(op, Op::UseToolLengthOffset(_))
}

/// Says them as the target does.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = ToolAxisState::default();
    let mut first = true;
    each_body(program, entry, |body, walk| {
        if !std::mem::replace(&mut first, false) {
            state.start_over();
        }
        convert_axis_lengths(body, walk, &mut state, target, diags);
    });
}

/// The same for one piece of a body.
pub(crate) fn convert_axis_lengths(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut ToolAxisState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let caps = &target.caps;
    let said_behind = said_behind(body);
    let oriented = orientations_behind(body);
    let mut at = 0;
    rebuild(body, |stmt, made: &mut Rebuild| {
        let place = at;
        at += 1;
        walk.enter(stmt.skip);
        let span = stmt.span;
        let before = walk.at.modes;
        walk.step(&stmt);
        let mut refuse = |lack: Lack| {
            diags.push(Diagnostic::new(Fault::lacks(lack), span));
        };
        let skipped = stmt.skip.is_some();
        match &stmt.op {
            Op::UseToolCentrePoint(_) => {
                let behind = said_behind.get(place).copied().unwrap_or_default();
                if let Err(lack) = state.switch_tip(stmt, behind, &before, target, made, diags) {
                    diags.push(Diagnostic::new(Fault::lacks(lack), span));
                }
            }
            Op::UseToolLengthOffset(entry) if caps.tools.tip == TipForm::WithLength && state.tip.met => {
                let entry = number(entry);
                if state.has_said_length() {
                    return made.leave_out(stmt);
                }
                if state.tip.is_off() {
                    return made.push(stmt);
                }
                if entry.is_some() && entry == before.length_offset && state.tip.is_on() {
                    return made.leave_out(stmt);
                }
                refuse(ToolsLack::LengthUnderTip.into());
            }
            // The one active is stated again; a control may take no such word there.
            Op::SetOriginOffsets(n) if caps.tools.tip == TipForm::WithLength && !state.tip.is_off() => {
                let said = [state.offset.take(), before.work_offset].contains(&Some(*n));
                match said && state.tip.is_on() {
                    true => made.leave_out(stmt),
                    false => made.push(stmt),
                }
            }
            Op::SetSlot(_) => {
                let oriented = oriented.get(place).copied().flatten();
                if let Err(lack) = state.set_tilt(stmt, oriented, target, made, diags) {
                    diags.push(Diagnostic::new(Fault::lacks(lack), span));
                }
            }
            Op::ClearFrame(FrameSlot::Tilt) => {
                let needless = match caps.frames.tilt {
                    TiltForm::None => true,
                    TiltForm::Euler => state.tilt.is_off() || !state.tilt.met,
                    TiltForm::AxisByAxis | TiltForm::Any => false,
                };
                if needless {
                    state.tilt.leave_out();
                }
                state.tilt.set(Now::Off, skipped);
                if needless { made.leave_out(stmt) } else { made.push(stmt) }
            }
            Op::OrientToolAxis(_) => match caps.frames.tilt {
                TiltForm::None => refuse(FramesLack::AxisOntoTilt.into()),
                TiltForm::AxisByAxis if oriented.iter().flatten().any(|o| o.place == place) => {
                    made.leave_out(stmt);
                }
                TiltForm::AxisByAxis => refuse(FramesLack::AxisApartFromTilt.into()),
                TiltForm::Euler => made.push(Stmt { op: Op::OrientToolAxis(None), ..stmt }),
                TiltForm::Any => made.push(stmt),
            },
            flow!() => {
                state.tip.lose();
                state.tilt.lose();
                made.push(stmt);
            }
            Op::UseToolLengthOffset(_)
            | Op::UseToolLength(_)
            | Op::UseToolEdge { .. }
            | Op::SelectTool(_)
            | Op::SelectToolByName(_)
            | Op::ChangeTool
            | Op::SetOriginOffsets(_)
            | Op::ClearFrame(_)
            | Op::SetFrame(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_)
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::UseMachineCoordinates { .. }
            | Op::GoToReference(_)
            | Op::SetData(_)
            | Op::SetFeedRate(_)
            | Op::Position(_)
            | drilling!()
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | miscellaneous!()
            | conduct!()
            | modes!()
            | moves!()
            | polar!() => made.push(stmt),
        }
    });
}

/// Control of the tip where the length is stated with it: the length that belongs to the word stands after
/// it, and what is active is stated again where no other comes.
fn with_length(
    stmt: Stmt,
    on: bool,
    behind: Behind,
    before: &Modes,
    state: &mut ToolAxisState,
    made: &mut Rebuild,
) -> Result<(), Lack> {
    let length = |entry: u32| Op::UseToolLengthOffset(Expr::int(i64::from(entry)));
    let op = stmt.op.clone();
    if stmt.skip.is_some() {
        return Err(ToolsLack::TipSkipped.into());
    }
    if let Some(own) = behind.offset.filter(|own| on && before.work_offset != Some(*own)) {
        state.offset = Some(own);
        made.push(Stmt::new(stmt.span, Op::SetOriginOffsets(own)));
    }
    match (on, behind.length) {
        (true, Some(entry @ 1..)) | (false, Some(entry @ 0)) => {
            state.pair = behind.lengths;
            made.replace(stmt, [(true, op), (true, length(entry))]);
        }
        (true, None) => match before.length_offset {
            Some(entry @ 1..) => {
                made.replace(stmt, [(true, op), (true, length(entry))]);
            }
            Some(0) | None => return Err(ToolsLack::TipLengthUnknown.into()),
        },
        (true, Some(0)) => return Err(ToolsLack::TipWithoutLength.into()),
        // The word that ends it takes the length away too.
        (false, Some(_)) => made.replace(stmt, [(true, op), (true, length(0))]),
        (false, None) => match before.length_offset {
            Some(0) => made.replace(stmt, [(true, op), (true, length(0))]),
            Some(entry) => made.replace(stmt, [(true, op), (true, length(0)), (false, length(entry))]),
            None => return Err(ToolsLack::TipEndLengthUnknown.into()),
        },
    }
    Ok(())
}

fn number(entry: &Expr) -> Option<u32> {
    entry.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok())
}

/// What is stated after a word that switches control of the tip, before anything moves.
#[derive(Clone, Copy, Debug, Default)]
struct Behind {
    /// The last length; the others before it are never used.
    length: Option<u32>,
    /// How many lengths.
    lengths: u32,
    /// The work offset.
    offset: Option<u16>,
}

/// For each statement that switches control of the tip: what is stated after it before anything moves. Blocks under block skip
/// end what is looked at.
fn said_behind(body: &[Stmt]) -> Vec<Behind> {
    if !body.iter().any(|stmt| matches!(stmt.op, Op::UseToolCentrePoint(_))) {
        return Vec::new();
    }
    let mut behind = vec![Behind::default(); body.len()];
    let mut next = Behind::default();
    for (place, stmt) in body.iter().enumerate().rev() {
        match &stmt.op {
            _ if stmt.skip.is_some() => next = Behind::default(),
            Op::UseToolLengthOffset(entry) => match (next.lengths, number(entry)) {
                (0, entry) => (next.length, next.lengths) = (entry, u32::from(entry.is_some())),
                (_, Some(_)) => next.lengths += 1,
                (_, None) => (next.length, next.lengths) = (None, 0),
            },
            Op::SetOriginOffsets(own) => next.offset = next.offset.or(Some(*own)),
            Op::UseToolCentrePoint(_) => {
                if let Some(behind) = behind.get_mut(place) {
                    *behind = next;
                }
                next = Behind::default();
            }
            miscellaneous!() | conduct!() | modes!() | Op::SetFeedRate(_) => {}
            _ => next = Behind::default(),
        }
    }
    behind
}

/// Where the tool is swivelled to a plane that was set before.
#[derive(Clone, Copy, Debug)]
struct Oriented {
    place: usize,
    toward: Option<ncc_ir::program::Toward>,
}

impl Oriented {
    fn op(self) -> Op {
        Op::OrientToolAxis(self.toward)
    }
}

/// For each statement that sets a tilted plane: where the tool is swivelled to it, if nothing happens
/// between.
fn orientations_behind(body: &[Stmt]) -> Vec<Option<Oriented>> {
    if !body.iter().any(|stmt| matches!(stmt.op, Op::OrientToolAxis(_))) {
        return Vec::new();
    }
    let mut behind = vec![None; body.len()];
    let mut next: Option<(Oriented, Option<u8>)> = None;
    for (place, stmt) in body.iter().enumerate().rev() {
        match &stmt.op {
            Op::OrientToolAxis(toward) => next = Some((Oriented { place, toward: *toward }, stmt.skip)),
            Op::SetSlot(_) => {
                if let Some(behind) = behind.get_mut(place) {
                    *behind = next.filter(|next| next.1 == stmt.skip).map(|next| next.0);
                }
                next = None;
            }
            Op::Comment(_) | Op::Blank | Op::NoEffect(_) => {}
            _ => next = None,
        }
    }
    behind
}

/// Turns about axes, one after the other, in nanos of a degree; none is 0.
type Turns = Vec<(Axis, Nanos)>;

const QUARTER: Nanos = 90 * ONE;
const HALF: Nanos = 180 * ONE;

/// The same plane in the target's form.
fn said_as(tilt: &Tilt, form: TiltForm) -> Result<Tilt, FramesLack> {
    let fits = |about: &[Axis; 3]| match form {
        TiltForm::None => false,
        TiltForm::Euler => *about == [Axis::Z, Axis::X, Axis::Z],
        TiltForm::AxisByAxis => about[0] != about[1] && about[1] != about[2] && about[0] != about[2],
        TiltForm::Any => true,
    };
    if fits(&tilt.about) {
        return Ok(tilt.clone());
    }
    let mut turns = Turns::new();
    for (about, angle) in tilt.about.iter().zip(&tilt.angles) {
        let angle = angle.literal().and_then(|n| n.nanos(false)).ok_or(FramesLack::TiltByComputedAngles)?;
        turns.push((*about, angle));
    }
    let found = match form {
        TiltForm::Euler => about_z_x_z(&turns),
        TiltForm::AxisByAxis => axis_by_axis(&turns),
        TiltForm::None | TiltForm::Any => None,
    };
    let (about, angles) = found.unwrap_or_else(|| by_directions(&turns, form));
    let angles = angles.map(|angle| Expr::Num(Num::from_nanos(angle, 9, Unit::Degree)));
    Ok(Tilt { origin: tilt.origin.clone(), about, angles })
}

/// Turns without those of nothing, neighbours about one axis together, each of less than a whole turn.
fn together(turns: &[(Axis, Nanos)]) -> Turns {
    let mut out = Turns::new();
    for (about, angle) in turns {
        let before = match out.last() {
            Some((last, before)) if last == about => *before,
            Some(_) | None => 0,
        };
        if out.last().is_some_and(|(last, _)| last == about) {
            out.pop();
        }
        let angle = (before + angle) % (2 * HALF);
        let angle = match () {
            () if angle > HALF => angle - 2 * HALF,
            () if angle <= -HALF => angle + 2 * HALF,
            () => angle,
        };
        if angle != 0 {
            out.push((*about, angle));
        }
    }
    out
}

/// Turns laid out on three axes in a given order.
fn laid_out(turns: &[(Axis, Nanos)], order: [Axis; 3]) -> Option<[Nanos; 3]> {
    let mut angles = [0; 3];
    let mut at = 0;
    for (about, angle) in turns {
        let place = order.iter().enumerate().skip(at).find(|(_, axis)| *axis == about)?.0;
        *angles.get_mut(place)? = *angle;
        at = place + 1;
    }
    Some(angles)
}

/// A turn about Y is one about X, a quarter of a turn round Z.
fn about_z_x_z(turns: &[(Axis, Nanos)]) -> Option<([Axis; 3], [Nanos; 3])> {
    let order = [Axis::Z, Axis::X, Axis::Z];
    let turns = together(turns);
    let without_y: Turns = turns
        .iter()
        .flat_map(|(about, angle)| match about {
            Axis::Y => vec![(Axis::Z, QUARTER), (Axis::X, *angle), (Axis::Z, -QUARTER)],
            _ => vec![(*about, *angle)],
        })
        .collect();
    [turns, together(&without_y)].iter().find_map(|turns| Some((order, laid_out(turns, order)?)))
}

/// What stands between two turns about Z that make quarters or halves of a turn is one about X or Y.
fn axis_by_axis(turns: &[(Axis, Nanos)]) -> Option<([Axis; 3], [Nanos; 3])> {
    use Axis::{X, Y, Z};
    const ORDERS: [[Axis; 3]; 6] = [[X, Y, Z], [Z, Y, X], [Z, X, Y], [X, Z, Y], [Y, X, Z], [Y, Z, X]];
    let turns = together(turns);
    let mut ways = vec![turns.clone()];
    if let [(Z, i), (X, j), (Z, k)] = turns[..] {
        let way = |turns: &[(Axis, Nanos)]| together(turns);
        ways.extend(match (i, j, k) {
            (_, _, k) if k == -QUARTER => Some(way(&[(Z, i - QUARTER), (Y, j)])),
            (_, _, k) if k == QUARTER => Some(way(&[(Z, i + QUARTER), (Y, -j)])),
            (_, _, k) if k == HALF => Some(way(&[(Z, i + HALF), (X, -j)])),
            (i, ..) if i == QUARTER => Some(way(&[(Y, j), (Z, k + QUARTER)])),
            (i, ..) if i == -QUARTER => Some(way(&[(Y, -j), (Z, k - QUARTER)])),
            (i, ..) if i == HALF => Some(way(&[(X, -j), (Z, k + HALF)])),
            (_, j, _) if j == HALF => Some(way(&[(Z, i - k), (X, HALF)])),
            _ => None,
        });
    }
    ways.iter().find_map(|turns| ORDERS.iter().find_map(|order| Some((*order, laid_out(turns, *order)?))))
}

/// The turns about Z, X and Z, or about X, Y and Z, that lead to the same directions. Where the first and the
/// last turn are about one line, the one that stands for both is the last of the former, the first of the latter.
fn by_directions(turns: &[(Axis, Nanos)], form: TiltForm) -> ([Axis; 3], [Nanos; 3]) {
    let mut three = [(Axis::Z, 0); 3];
    for (turn, given) in three.iter_mut().zip(turns) {
        *turn = *given;
    }
    let [x, y, z] = TiltedPlane::turned([0; 3], three).axes;
    // Below this the line of nodes is lost in the directions' last digits.
    const NONE: f64 = 1e-9;
    let (about, angles) = match form {
        TiltForm::Euler => {
            let lean = x[2].hypot(y[2]);
            let angles = match lean < NONE {
                true => [0.0, if z[2] < 0.0 { std::f64::consts::PI } else { 0.0 }, (-x[1]).atan2(x[0])],
                false => [x[2].atan2(-y[2]), lean.atan2(z[2]), z[0].atan2(z[1])],
            };
            ([Axis::Z, Axis::X, Axis::Z], angles)
        }
        TiltForm::AxisByAxis | TiltForm::None | TiltForm::Any => {
            let level = x[0].hypot(x[1]);
            let lean = x[2].atan2(level);
            let angles = match level < NONE {
                true => [z[1].atan2(y[1]), lean, 0.0],
                false => [(-y[2]).atan2(z[2]), lean, (-x[1]).atan2(x[0])],
            };
            ([Axis::X, Axis::Y, Axis::Z], angles)
        }
    };
    (about, angles.map(|angle: f64| (angle.to_degrees() * ONE as f64).round() as Nanos))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(about: [Axis; 3], angles: [Nanos; 3]) -> TiltedPlane {
        let mut turns = [(Axis::X, 0); 3];
        for (place, turn) in turns.iter_mut().enumerate() {
            *turn = (about[place], angles[place]);
        }
        TiltedPlane::turned([0; 3], turns)
    }

    #[test]
    fn a_plane_in_another_form_is_the_same_plane() {
        use Axis::{X, Y, Z};
        let orders = [[X, Y, Z], [Z, Y, X], [Z, X, Y], [X, Z, Y], [Y, X, Z], [Y, Z, X]];
        let angles = [-180, -137, -90, -30, 0, 12, 45, 90, 118, 180];
        let (mut to_euler, mut to_axes) = (0, 0);
        let by_directions = |about: [Axis; 3], angles: [Nanos; 3]| {
            let turns: Turns = about.into_iter().zip(angles).collect();
            for form in [TiltForm::Euler, TiltForm::AxisByAxis] {
                let (other, found) = by_directions(&turns, form);
                let same = plane(about, angles).is_same(&plane(other, found), 0, 1);
                assert!(same, "{about:?} {angles:?} as {other:?} {found:?}");
            }
        };
        for i in angles {
            for j in angles {
                for k in angles {
                    let angles = [i * ONE, j * ONE, k * ONE];
                    let turns = |about: [Axis; 3]| std::array::from_fn::<_, 3, _>(|n| (about[n], angles[n]));
                    for about in orders {
                        by_directions(about, angles);
                        if let Some((other, found)) = about_z_x_z(&turns(about)) {
                            to_euler += 1;
                            let same = plane(about, angles).is_same(&plane(other, found), 0, 1);
                            assert!(same, "{about:?} {i} {j} {k} as {found:?}");
                        }
                    }
                    let about = [Z, X, Z];
                    by_directions(about, angles);
                    if let Some((other, found)) = axis_by_axis(&turns(about)) {
                        to_axes += 1;
                        let same = plane(about, angles).is_same(&plane(other, found), 0, 1);
                        assert!(same, "{about:?} {i} {j} {k} as {other:?} {found:?}");
                    }
                }
            }
        }
        assert!(to_euler > 300 && to_axes > 600, "{to_euler} {to_axes}");
    }

    #[test]
    fn turns_are_about_the_axes_that_those_before_have_made() {
        // About Z by 90 and the new X, which is the old Y, by 90: the plane's Z lies along the old X.
        let made = plane([Axis::Z, Axis::X, Axis::Z], [QUARTER, QUARTER, 0]);
        let third: [f64; 3] = std::array::from_fn(|row| made.axes[row][2]);
        assert!((third[0] - 1.0).abs() < 1e-12 && third[1].abs() < 1e-12, "{third:?}");
    }
}
