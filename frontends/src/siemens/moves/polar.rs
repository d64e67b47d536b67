//! Lowering of poles, and of points by radius and angle about them.
//!
//! Refused, because no source says what is meant: an angle without `AC` or `IC` under G91, polar
//! words beside coordinates of the plane, a pole from before a change of the plane or of frames, the
//! caller's pole, and an arc about a pole whose place the text does not say.

use ncc_dialects::{NameRole, Quantity};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Plane};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Centre, CentreFrom, Coord, Op, Point, Polar, PoleFrom, PoleWords, SetPole};
use ncc_ir::source::Span;
use ncc_ir::unsupported::PolarUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::block_words::{Code, Given, Words};
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::Pole;

const ROLES: [NameRole; 2] = [NameRole::PolarRadius, NameRole::PolarAngle];

/// The polar words of a block.
#[derive(Debug)]
pub(in crate::siemens) struct PolarWords {
    radius: Option<Coord>,
    angle: Option<Coord>,
    /// A line by its angle.
    along: bool,
    span: Span,
}

impl Words {
    /// Whether a polar word is left.
    pub(in crate::siemens) fn has_polar(&self) -> bool {
        ROLES.iter().chain(&[NameRole::LineAngle]).any(|role| self.named(*role).is_some())
    }

    /// Whether words of axes or polar words are left.
    pub(in crate::siemens) fn has_point(&self) -> bool {
        self.has_any(b"XYZABC") || self.has_polar()
    }
}

impl Lower {
    /// `G110`, `G111`, `G112`: a block of its own.
    pub(in crate::siemens) fn pole(
        &mut self,
        code: Code,
        from: PoleFrom,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        if let Some(other) = words.codes.iter().find(|c| c.span != code.span).copied() {
            return self.not_supported(code.name, PolarUnsupported::PoleBesideCodes, other.span, out);
        }
        let Some(plane) = self.known_plane(code.span, out) else { return };
        if from == PoleFrom::Pole && self.state.pole == Pole::Lost {
            return self.not_supported(code.name, PolarUnsupported::PoleFromUnknown, code.span, out);
        }
        let (first, second, _) = plane.axes();
        let mut along: [Option<Expr>; 3] = Default::default();
        for axis in [first, second] {
            let Some(given) = words.take(axis.letter()) else { continue };
            if given.distance.is_some() {
                return self.not_supported(
                    &src.text(given.span),
                    PolarUnsupported::PoleDistance,
                    given.span,
                    out,
                );
            }
            along[axis as usize] = self.amount(given, Quantity::Length, src, out);
        }
        let literal = |axis: Axis| match &along[axis as usize] {
            Some(word) => word.literal(),
            None => Some(Num::int(0, Unit::Mm)),
        };
        let mut at =
            literal(first).zip(literal(second)).map(|(a, b)| [a, b]).filter(|_| from == PoleFrom::Zero);
        let given = ROLES.map(|role| words.take_named(role));
        let words_at = match given {
            [None, None] => PoleWords::Along(Box::new(along)),
            [Some(radius), Some(angle)] if along.iter().all(Option::is_none) => {
                if let Some(qualified) = [radius, angle].into_iter().find(|g| g.distance.is_some()) {
                    let text = src.text(qualified.span);
                    return self.not_supported(&text, PolarUnsupported::PoleDistance, qualified.span, out);
                }
                at = None;
                let radius = self.number(radius, Quantity::Length, src, out);
                let angle = self.number(angle, Quantity::Angle, src, out);
                let Some((radius, angle)) = radius.zip(angle) else { return };
                if radius.mantissa < 0 {
                    return self.not_supported(code.name, PolarUnsupported::NegativeRadius, code.span, out);
                }
                PoleWords::Polar { radius: Expr::Num(radius), angle: Expr::Num(angle) }
            }
            _ => return self.not_supported(code.name, PolarUnsupported::PoleIncomplete, code.span, out),
        };
        self.rely_on_frames(false, code.span, out);
        self.state.pole = Pole::Said(plane, at);
        let set = SetPole { plane: Fact::Known(plane), from, at: words_at };
        self.push(code.span, Op::SetPole(Box::new(set)), out);
    }

    /// The polar words of a block, if it has any; `Err` if they are refused (reported).
    pub(in crate::siemens) fn polar_words(
        &mut self,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Result<Option<PolarWords>, ()> {
        if let Some(given) = words.take_named(NameRole::LineAngle) {
            return self.line_angle(given, words, src, out).map(Some);
        }
        let [radius, angle] = ROLES.map(|role| words.take_named(role));
        let Some(span) = radius.or(angle).map(|given| given.span) else {
            return Ok(None);
        };
        let refuse = |lower: &mut Lower, what: PolarUnsupported, at: Span, out: &mut Batch| {
            lower.not_supported(&src.text(at), what, at, out);
            Err(())
        };
        if self.state.pole == Pole::Lost {
            return refuse(self, PolarUnsupported::UnknownPole, span, out);
        }
        if radius.is_some_and(|given| given.distance == Some(Distance::Incremental)) {
            return refuse(self, PolarUnsupported::RadiusIncrement, span, out);
        }
        if radius.is_some_and(|given| given.digits.mantissa < 0) {
            return refuse(self, PolarUnsupported::NegativeRadius, span, out);
        }
        let distance = match angle {
            Some(Given { distance: Some(distance), .. }) => distance,
            Some(given) => match self.distance(given.span, out) {
                Fact::Known(Distance::Absolute) => Distance::Absolute,
                Fact::Known(Distance::Incremental) => {
                    return refuse(self, PolarUnsupported::AngleUnderG91, given.span, out);
                }
                // G91, which leaves it open, may be active.
                Fact::Entry => {
                    self.fault(Fault::EntryFactNeeded { fact: ModeName::Distance }, given.span, out);
                    return Err(());
                }
            },
            None => Distance::Absolute,
        };
        let mut coord = |lower: &mut Lower, given, quantity, distance| {
            let value = lower.amount(given, quantity, src, out)?;
            Some(Coord { value, distance: Fact::Known(distance) })
        };
        let radius = radius.and_then(|given| coord(self, given, Quantity::Length, Distance::Absolute));
        let angle = angle.and_then(|given| coord(self, given, Quantity::Angle, distance));
        Ok(Some(PolarWords { radius, angle, along: false, span }))
    }

    /// The angle of a line, from the first axis of the plane.
    fn line_angle(
        &mut self,
        given: Given,
        words: &Words,
        src: Source,
        out: &mut Batch,
    ) -> Result<PolarWords, ()> {
        let span = given.span;
        let what = match () {
            () if words.has_polar() => PolarUnsupported::AngleBesidePolar,
            () if given.distance.is_some() => PolarUnsupported::LineAngleDistance,
            () => {
                let value = self.amount(given, Quantity::Angle, src, out).ok_or(())?;
                let angle = Coord { value, distance: Fact::Known(Distance::Absolute) };
                return Ok(PolarWords { radius: None, angle: Some(angle), along: true, span });
            }
        };
        self.not_supported(&src.text(span), what, span, out);
        Err(())
    }

    /// Adds a move, to the polar point of the block's words if it has any.
    pub(in crate::siemens) fn push_to(
        &mut self,
        polar: Option<PolarWords>,
        block: Span,
        mut op: Op,
        out: &mut Batch,
    ) {
        let Some(PolarWords { radius, angle, along, span }) = polar else {
            return self.push(block, op, out);
        };
        let Some(plane) = self.known_plane(block, out) else { return };
        let (first, second, _) = plane.axes();
        let names = |to: &Point| to.get(first).is_some() || to.get(second).is_some();
        let text = "AP RP";
        if along {
            return self.push_along(angle, plane, span, block, op, out);
        }
        match ncc_ir::geometry::polar::end(&mut op) {
            None => return self.not_supported(text, PolarUnsupported::OfFunction, span, out),
            Some(to) if names(to) => {
                let what = PolarUnsupported::BesideCoordinates;
                return self.not_supported(text, what, span, out);
            }
            Some(_) => {}
        }
        if let Pole::Said(own, _) = self.state.pole
            && own != plane
        {
            return self.not_supported(text, PolarUnsupported::PoleOfOtherPlane, span, out);
        }
        if self.state.pole == Pole::Unsaid {
            self.state.pole = Pole::Said(plane, Some([Num::int(0, Unit::Mm); 2]));
        }
        self.rely_on_frames(false, block, out);
        self.stand.forget();
        let polar = Polar { plane: Fact::Known(plane), radius, angle, along: false, op };
        self.push(block, Op::Polar(Box::new(polar)), out);
    }

    /// A line by its angle, to the one word of the plane that its block has.
    fn push_along(
        &mut self,
        angle: Option<Coord>,
        plane: Plane,
        span: Span,
        block: Span,
        op: Op,
        out: &mut Batch,
    ) {
        let (first, second, _) = plane.axes();
        let to = match &op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) => &m.to,
            _ => return self.not_supported("ANG", PolarUnsupported::AngleOfNoLine, span, out),
        };
        let what = match (to.get(first), to.get(second)) {
            (None, None) => PolarUnsupported::LineOfTwoBlocks,
            (Some(_), Some(_)) => PolarUnsupported::LineOverdefined,
            (Some(_), None) | (None, Some(_)) => {
                self.rely_on_frames(false, block, out);
                self.stand.forget();
                let plane = Fact::Known(plane);
                let polar = Polar { plane, radius: None, angle, along: true, op };
                return self.push(block, Op::Polar(Box::new(polar)), out);
            }
        };
        self.not_supported("ANG", what, span, out);
    }

    /// The centre of an arc about the pole, if the text says where that is.
    pub(in crate::siemens) fn about_pole(
        &mut self,
        polar: &PolarWords,
        block: Span,
        out: &mut Batch,
    ) -> Option<Centre> {
        if polar.along {
            self.not_supported("ANG", PolarUnsupported::AngleOfNoLine, polar.span, out);
            return None;
        }
        let plane = self.known_plane(block, out)?;
        let at = match self.state.pole {
            Pole::Unsaid => Some([Num::int(0, Unit::Mm); 2]),
            Pole::Said(_, at) => at,
            Pole::Lost => None,
        };
        let Some(at) = at else {
            self.not_supported("AP RP", PolarUnsupported::ArcAboutPole, polar.span, out);
            return None;
        };
        let (first, second, _) = plane.axes();
        let mut words: [Option<Expr>; AXES / 2] = Default::default();
        for (axis, num) in [first, second].into_iter().zip(at) {
            words[axis as usize] = Some(Expr::Num(num));
        }
        Some(Centre::Point { words, from: CentreFrom::Zero })
    }
}
