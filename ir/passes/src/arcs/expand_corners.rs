//! `expand-corners`: corners that the target lacks are written as arcs and lines.
//!
//! The moves on both sides get shorter: the first ends where the corner begins, the second begins where it
//! ends. Computed points are rounded to the target's digits. A corner that must be expanded and whose
//! moves are not known from the program alone is refused, and so is one that has no next move.

use crate::arcs::arc_form;
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::{ARC, CORNER, FRAME};
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{EXACT, Rebuild, at as exact_word, is_absolute, rounded, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, CornerShape, Fact, Plane};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::corner::{self, CornerFault, Inserted, Leg};
use ncc_ir::lack::CornersLack;
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Arc, Centre, CentreFrom, Move, Op, Point, Program, Stmt, Turns};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_ir::unexecuted::NoCorner;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "expand-corners",
    about: "writes rounded and chamfered corners as arcs and lines",
    alone: Some(run),
    step: Step::to_the_end(
        Moment::Placing,
        |_, p| p.needs(CORNER),
        |l, p| {
            let (found, whole) = (p.diags.len(), p.needs(FRAME));
            let keep = if whole { Keep::None } else { Keep::Sayable };
            expand_corners(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<ExpandCornersState>(),
                &l.target,
                keep,
                p.diags,
            );
            // They are arcs, which their moves need not be, and their words are measured from zero.
            let written = p.diags[found..].iter().any(|d| matches!(d.fault, Fault::CornerExpanded));
            p.needs |= if written { l.lacks & ARC } else { 0 };
        },
        |l, stmts, diags| l.states.state_mut::<ExpandCornersState>().flush(stmts, diags),
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExpandCornersState {
    /// Statements from the last corner on whose next move has not come.
    held: Vec<Stmt>,
    /// The state before them.
    before: Option<Walk>,
}

impl ExpandCornersState {
    /// Whether a corner waits for its next move.
    pub(crate) fn is_busy(&self) -> bool {
        !self.held.is_empty()
    }

    /// A corner without a next move.
    pub(crate) fn flush(&mut self, body: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
        let corner = self.held.iter().find(|stmt| matches!(stmt.op, Op::Corner { .. }));
        if let Some(stmt) = corner {
            diags.push(Diagnostic::new(no_next(), stmt.span));
        }
        body.append(&mut self.held);
        self.before = None;
    }
}

fn no_next() -> Fault {
    Fault::NoCorner { why: NoCorner::NoNextMove }
}

fn cannot(lack: CornersLack) -> Fault {
    Fault::lacks(lack)
}

/// Writes them out.
pub(crate) fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        let mut state = ExpandCornersState::default();
        expand_corners(body, walk, &mut state, target, Keep::Sayable, diags);
        state.flush(body, diags);
    });
}

/// Which corners stay words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keep {
    /// What the target supports.
    Sayable,
    /// None; their points keep all digits, because another pass works on them.
    None,
}

/// A corner on its way.
struct Corner {
    /// Where its statement stands among those made.
    word: usize,
    shape: CornerShape,
    size: Expr,
    span: Span,
}

/// A move after which a corner is.
struct Before {
    corner: Corner,
    /// Where it stands among those made.
    place: usize,
    /// What is known of it.
    leg: Option<(Plane, Leg)>,
    /// The same, before corners took of it.
    known: Known,
    /// Where it began in the program, before corners took of it.
    start: [Nanos; 2],
    bent: bool,
}

/// The same for one piece of a body. What waits for its next move stays.
pub(crate) fn expand_corners(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut ExpandCornersState,
    target: &Target,
    keep: Keep,
    diags: &mut Vec<Diagnostic>,
) {
    let mut input = std::mem::take(&mut state.held);
    input.append(body);
    let mut own = state.before.take().unwrap_or_else(|| walk.clone());
    let waits = waiting(&input);
    state.held = input.split_off(waits);
    let mut made = Rebuild::new(input.len());
    let mut pass = Corners { target, keep, asked: None, before: None, diags };
    for stmt in input {
        pass.statement(stmt, &mut own, &mut made);
    }
    if !state.held.is_empty() {
        state.before = Some(own);
    }
    *body = made.out;
}

/// Where the statements begin that belong to corners whose next move is not among them: the block of the
/// first corner of such a chain.
fn waiting(stmts: &[Stmt]) -> usize {
    let mut open: Option<usize> = None;
    let mut asked = false;
    let mut block = 0;
    for (at, stmt) in stmts.iter().enumerate() {
        if !stmt.joined {
            block = at;
        }
        match stmt.op.unwrapped() {
            Op::Corner { .. } => {
                asked = true;
                open = open.or(Some(block));
            }
            op if is_move(op) => {
                if !asked {
                    open = None;
                }
                asked = false;
            }
            op if corner::may_stand_between(op) => {}
            _ => (open, asked) = (None, false),
        }
    }
    open.unwrap_or(stmts.len())
}

fn is_move(op: &Op) -> bool {
    matches!(
        op,
        Op::StraightFeed(_) | Op::StraightTraverse(_) | Op::ArcFeed(_) | Op::ArcForm(_) | Op::Position(_)
    )
}

/// A move as far as it is known, and whether its words have the centre.
type Known = Option<(Plane, Leg, bool)>;

struct Corners<'p> {
    target: &'p Target,
    keep: Keep,
    asked: Option<Corner>,
    before: Option<Before>,
    diags: &'p mut Vec<Diagnostic>,
}

impl Corners<'_> {
    fn statement(&mut self, mut stmt: Stmt, walk: &mut Walk, made: &mut Rebuild) {
        walk.enter(stmt.skip);
        match &stmt.op {
            Op::Corner { shape, size } => {
                let (shape, size, span) = (*shape, size.clone(), stmt.span);
                made.push(stmt);
                self.asked = Some(Corner { word: made.out.len() - 1, shape, size, span });
                return;
            }
            op if is_move(op.unwrapped()) && (self.asked.is_some() || self.before.is_some()) => {
                let result = self.passed(&mut stmt, walk, made);
                if let Err(fault) = result {
                    self.diags.push(Diagnostic::new(fault, stmt.span));
                    (self.asked, self.before) = (None, None);
                }
                return made.push(stmt);
            }
            op => {
                let open = self.asked.as_ref().or(self.before.as_ref().map(|before| &before.corner));
                if let Some(corner) = open
                    && !corner::may_stand_between(op)
                {
                    self.diags.push(Diagnostic::new(no_next(), corner.span));
                    (self.asked, self.before) = (None, None);
                }
            }
        }
        walk.step(&stmt);
        made.push(stmt);
    }

    /// A move with a corner before it, after it or both.
    fn passed(&mut self, stmt: &mut Stmt, walk: &mut Walk, made: &mut Rebuild) -> Result<(), Fault> {
        let bent = matches!(stmt.op.unwrapped(), Op::ArcFeed(_) | Op::ArcForm(_));
        let before = self.before.take();
        let whole = leg(stmt, walk, self.target.caps.arcs.forms);
        let written = before.as_ref().is_some_and(|before| !self.says(before, bent, &whole, walk));
        let mut known = whole.map(|(plane, leg, _)| (plane, leg));
        let after = {
            let mut after = walk.at.clone();
            after.apply(&stmt.op);
            after
        };
        let start = known.map_or([0; 2], |(_, leg)| leg.from);
        if let Some(before) = before {
            let found = before.leg.zip(known).map(|((_, a), (_, b))| {
                let size = walk.at.nanos(&before.corner.size).ok_or_else(unknown)?;
                corner::between(&a, &b, before.corner.shape, size).map_err(CornerFault::fault)
            });
            match (found.transpose()?, written) {
                (None, true) => return Err(unknown()),
                (Some(Some(inserted)), true) => {
                    if made.out[before.corner.word..].iter().any(|s| s.skip != stmt.skip) {
                        return Err(cannot(CornersLack::BesideSkippedBlock));
                    }
                    let Some((plane, _)) = known else { return Err(unknown()) };
                    self.write(&before, &inserted, plane, walk, made)?;
                    self.shorten(stmt, plane, &inserted, walk)?;
                    if let Some((_, leg)) = &mut known {
                        leg.from = inserted.to;
                    }
                }
                // Nothing is put between moves that are tangent.
                (Some(None), true) => {
                    take_out(made, before.corner.word);
                    self.diags.push(Diagnostic::new(Fault::CornerExpanded, before.corner.span));
                }
                (Some(Some(inserted)), false) => {
                    if let Some((_, leg)) = &mut known {
                        leg.from = inserted.to;
                    }
                }
                (Some(None) | None, false) => {}
            }
        }
        if let Some(mut corner) = self.asked.take() {
            // What was put in before has moved the statements on.
            if let Some(word) = made.out.iter().rposition(|s| matches!(s.op, Op::Corner { .. })) {
                corner.word = word;
            }
            let place = made.out.len();
            self.before = Some(Before { corner, place, leg: known, known: whole, start, bent });
        }
        walk.at = after;
        Ok(())
    }

    /// Whether the target says a corner between these two moves as it is.
    fn says(&self, before: &Before, bent: bool, after: &Known, walk: &Walk) -> bool {
        let caps = &self.target.caps.moves.corners;
        let word = match before.corner.shape {
            CornerShape::Round => caps.round,
            CornerShape::Leg => caps.leg,
            CornerShape::Length => caps.length,
        };
        let decimals = self.target.decimals_in(walk.unit());
        let fine = before.corner.size.literal().is_some_and(|n| n.trimmed().scale <= decimals);
        // Between rounded points a corner would lie elsewhere.
        let unit = walk.unit();
        let exact = |at: &Nanos| rounded(*at, decimals.min(EXACT), unit).nanos(false) == Some(*at);
        let whole = |known: &Known| match known {
            None => true,
            Some((_, leg, centre)) => {
                let centre = leg.bend.filter(|_| *centre).map(|(_, centre)| centre).unwrap_or_default();
                leg.from.iter().chain(&leg.to).chain(&centre).all(exact)
            }
        };
        self.keep == Keep::Sayable
            && word
            && fine
            && (caps.arcs || !before.bent && !bent)
            && whole(&before.known)
            && whole(after)
    }

    fn decimals(&self, walk: &Walk) -> u8 {
        match self.keep {
            Keep::Sayable => self.target.decimals_in(walk.unit()).min(EXACT),
            Keep::None => EXACT,
        }
    }

    /// The words of a place in the plane, and the place that they say.
    fn words(&self, at: [Nanos; 2], walk: &Walk) -> [(ncc_ir::expr::num::Num, Nanos); 2] {
        let (unit, decimals) = (walk.unit(), self.decimals(walk));
        at.map(|at| {
            let num = rounded(at, decimals, unit);
            (num, num.nanos(false).unwrap_or(at))
        })
    }

    /// Shortens the move before the corner, and writes the corner after it.
    fn write(
        &mut self,
        before: &Before,
        inserted: &Inserted,
        plane: Plane,
        walk: &Walk,
        made: &mut Rebuild,
    ) -> Result<(), Fault> {
        let (first, second, _) = plane.axes();
        let from = self.words(inserted.from, walk);
        let Some(op) = made.out.get_mut(before.place).map(|stmt| &mut stmt.op) else { return Err(unknown()) };
        let straight = matches!(op, Op::StraightFeed(_));
        let to = end(op).ok_or_else(unknown)?;
        for (i, axis) in [first, second].into_iter().enumerate() {
            if !straight || to.get(axis).is_some() || inserted.from[i] != before.start[i] {
                to.set(axis, absolute(from[i].0));
            }
        }
        let mut end = Point::default();
        for (axis, (word, _)) in [first, second].into_iter().zip(self.words(inserted.to, walk)) {
            end.set(axis, absolute(word));
        }
        let op = match inserted.bend {
            None => Op::StraightFeed(Move { to: end, said: true }),
            Some((turn, centre)) => Op::ArcFeed(Box::new(Arc {
                plane: Fact::Known(plane),
                turn,
                to: end,
                centre: self.centre(centre, inserted.from, plane, walk),
                turns: Turns::NONE,
                said: true,
            })),
        };
        let skip = made.out[before.place].skip;
        let new = Stmt { skip, ..Stmt::new(before.corner.span, op) };
        made.out.insert(before.place + 1, new);
        if let Some(next) = made.out.get_mut(before.place + 2) {
            next.joined = false;
        }
        take_out(made, before.corner.word);
        self.diags.push(Diagnostic::new(Fault::CornerExpanded, before.corner.span));
        Ok(())
    }

    /// A centre, from a start that is rounded.
    fn centre(&self, centre: [Nanos; 2], start: [Nanos; 2], plane: Plane, walk: &Walk) -> Centre {
        let (first, second, _) = plane.axes();
        let (unit, decimals) = (walk.unit(), self.decimals(walk));
        let mut words: [Option<Expr>; 3] = [None, None, None];
        for (i, axis) in [first, second].into_iter().enumerate() {
            let from = self.words(start, walk)[i].1;
            words[axis as usize] =
                Some(rounded(centre[i].wrapping_sub(from), decimals, unit_of(axis, unit)).into());
        }
        Centre::Point { words, from: CentreFrom::Start }
    }

    /// Lets the move after the corner begin where that ends.
    fn shorten(&self, stmt: &mut Stmt, plane: Plane, inserted: &Inserted, walk: &Walk) -> Result<(), Fault> {
        let unit = walk.unit();
        let (first, second, _) = plane.axes();
        let target = end(&mut stmt.op).map(|to| walk.at.target(to)).ok_or_else(unknown)?;
        if let Op::ArcFeed(arc) = &mut stmt.op {
            let centre = walk.at.centre(arc).ok_or_else(unknown)?;
            arc.centre = self.centre(centre, inserted.to, plane, walk);
        }
        let bent = matches!(stmt.op, Op::ArcFeed(_));
        let Some(to) = end(&mut stmt.op) else { return Err(unknown()) };
        let added = to.axes.iter().flatten().any(|word| !is_absolute(word, walk.at.modes.distance));
        for axis in Axis::ALL {
            let in_plane = axis == first || axis == second;
            let needed = bent && in_plane || to.get(axis).is_some() && added;
            if !needed {
                continue;
            }
            // One block, one way of measuring.
            let at = target[axis as usize].ok_or_else(unknown)?;
            to.set(axis, exact_word(at, axis, unit));
        }
        Ok(())
    }
}

fn unknown() -> Fault {
    cannot(CornersLack::PlacesAtRunTime)
}

/// The end of a move.
fn end(op: &mut Op) -> Option<&mut Point> {
    match op {
        Op::StraightFeed(m) => Some(&mut m.to),
        Op::ArcFeed(arc) => Some(&mut arc.to),
        _ => None,
    }
}

/// What is known of a move; an arc in another form becomes one by its centre where the target has none.
fn leg(stmt: &mut Stmt, walk: &Walk, forms: bool) -> Known {
    if let Op::ArcForm(arc) = &stmt.op
        && !forms
        && let Ok((op, _)) = arc_form::ArcFormState::default().by_centre(arc, walk, EXACT)
    {
        stmt.op = op;
    }
    let (plane, bend, to) = match &stmt.op {
        Op::StraightFeed(m) => (walk.at.modes.plane?, None, &m.to),
        Op::ArcFeed(arc) if arc.turns.is_none() => {
            let centre = walk.at.centre(arc)?;
            (walk.at.plane(arc.plane)?, Some((arc.turn, centre)), &arc.to)
        }
        _ => return None,
    };
    let (first, second, _) = plane.axes();
    let end = walk.at.target(to);
    let from = [walk.at.position[first as usize]?, walk.at.position[second as usize]?];
    let to = [end[first as usize]?, end[second as usize]?];
    let centred = matches!(&stmt.op, Op::ArcFeed(arc) if matches!(arc.centre, Centre::Point { .. }));
    (from != to).then_some((plane, Leg { from, to, bend }, centred))
}

/// Takes the word of a corner out; its block keeps its number.
fn take_out(made: &mut Rebuild, at: usize) {
    let word = made.out.remove(at);
    if let Some(next) = made.out.get_mut(at)
        && !word.joined
        && next.joined
    {
        next.joined = false;
        next.number = word.number;
    }
}
