//! Lowering of points by radius and angle, in a mode of their own: while it is on, the words of the
//! plane's axes are radius and angle about program zero.
//!
//! A radius that is an increment is about where the tool is; from where its angle is counted no
//! source says, and it is refused. So is a word that is missing or an increment where something other
//! than a polar point has moved the plane's axes last: it would count from where the tool is.

use ncc_dialects::{Meaning, Quantity};
use ncc_ir::canon::{Axis, Distance, Fact, Motion, Plane};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::geometry::polar;
use ncc_ir::program::{Centre, Coord, Move, Op, Polar, PoleFrom, PoleWords, SetPole};
use ncc_ir::source::Span;
use ncc_ir::unsupported::PolarUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::Word;
use crate::word::block_words::Code;
use crate::word::lower::Lower;
use crate::word::word_state::AxisWords;

impl Lower {
    /// The code of the mode, or of its end.
    pub(in crate::word) fn polar_words(&mut self, code: &Code, on: bool, out: &mut Batch) {
        let is_on = matches!(self.state.words, AxisWords::Polar { .. });
        if on != is_on && self.now.skip.is_some() {
            return self.no_polar(code.row.code.as_str(), PolarUnsupported::SkippedBlock, code.span, out);
        }
        if !on {
            self.state.words = AxisWords::Cartesian;
            self.now.silent = true;
            return;
        }
        let Fact::Known(plane) = self.plane(code.span, out) else {
            return self.no_polar(code.row.code.as_str(), PolarUnsupported::UnknownPlane, code.span, out);
        };
        if is_on {
            self.now.silent = true;
            return;
        }
        self.state.words = AxisWords::Polar { plane, follows: false };
        let at = PoleWords::Along(Box::default());
        let set = SetPole { plane: Fact::Known(plane), from: PoleFrom::Zero, at };
        self.push(code.span, Op::SetPole(Box::new(set)), out);
    }

    /// A straight move whose block has radius, angle and centre of its end; `false` if it has not.
    pub(in crate::word) fn polar_line(
        &mut self,
        said: bool,
        block: Span,
        words: &mut crate::word::block_words::Words,
        src: Source,
        out: &mut Batch,
    ) -> bool {
        let Some([radius, angle]) = self.settings.dialect.polar.letters() else { return false };
        let motion = self.state.modes.motion.value();
        if words.get(radius).is_none() || words.get(angle).is_none() {
            return false;
        }
        if !matches!(motion, Some(Motion::Traverse | Motion::Feed)) || self.has_axis_word(words) {
            return false;
        }
        let Fact::Known(plane) = self.plane(block, out) else { return false };
        let (first, second, _) = plane.axes();
        let centre = [first, second].map(|axis| self.roles.centre[axis as usize]);
        if centre.iter().any(|letter| words.get(*letter).is_none()) {
            return false;
        }
        if self.distance(block, out) != Fact::Known(Distance::Absolute) {
            let code = char::from(radius).to_string().into();
            let what = PolarUnsupported::Increments.into();
            self.fault(Fault::NotSupported { code, what }, block, out);
            [radius, angle].into_iter().chain(centre).for_each(|letter| _ = words.take(letter));
            return true;
        }
        if motion == Some(Motion::Feed) {
            self.rely_on_feed(block, out);
        }
        let mut value = |letter: u8, quantity: Quantity| {
            let word = words.take(letter)?;
            let num = self.number(&word, quantity, src, out)?;
            if letter == radius && num.mantissa < 0 {
                return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
            }
            Some(Expr::Num(num))
        };
        let mut along: [Option<Expr>; 3] = Default::default();
        for (axis, letter) in [first, second].into_iter().zip(centre) {
            along[axis as usize] = value(letter, Quantity::Length);
        }
        let (length, turned) = (value(radius, Quantity::Length), value(angle, Quantity::Angle));
        let (Some(length), Some(turned)) = (length, turned) else { return true };
        self.rely_on_frames(false, block, out);
        let plane = Fact::Known(plane);
        let at = PoleWords::Along(Box::new(along));
        self.push(block, Op::SetPole(Box::new(SetPole { plane, from: PoleFrom::Zero, at })), out);
        let word = |value| Some(Coord { value, distance: Fact::Known(Distance::Absolute) });
        let to = Move { said, ..Move::default() };
        let op = if motion == Some(Motion::Feed) { Op::StraightFeed(to) } else { Op::StraightTraverse(to) };
        let polar = Polar { plane, radius: word(length), angle: word(turned), along: false, op };
        self.push(block, Op::Polar(Box::new(polar)), out);
        true
    }

    fn no_polar(&mut self, code: &str, what: PolarUnsupported, at: Span, out: &mut Batch) {
        self.fault(Fault::not_supported(code, what), at, out);
    }

    /// Refuses a code whose words are coordinates, or that leads where the mode is another.
    pub(in crate::word) fn check_polar(&mut self, code: &Code, out: &mut Batch) {
        let leaves = match code.meaning {
            Meaning::SelectPlane(plane) => {
                !matches!(self.state.words, AxisWords::Polar { plane: p, .. } if p == plane)
            }
            Meaning::SetShift(_)
            | Meaning::SetPosition
            | Meaning::SetRotation
            | Meaning::SetScale
            | Meaning::SetMirror
            | Meaning::ClearMirror
            | Meaning::ClearFrame(_)
            | Meaning::UseOriginShift(_)
            | Meaning::SetOriginOffsets(_)
            | Meaning::UseMachineCoordinates { .. }
            | Meaning::GoToReference { .. }
            | Meaning::StraightProbe(_)
            | Meaning::Detour(_)
            | Meaning::Pattern
            | Meaning::Call
            | Meaning::Return => true,
            _ => false,
        };
        if leaves && matches!(self.state.words, AxisWords::Polar { .. }) {
            let what = PolarUnsupported::WhileActive.into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
        }
    }

    /// What the word of an axis counts.
    pub(in crate::word) fn quantity_of(&self, axis: Axis, quantity: Quantity) -> Quantity {
        match self.state.words {
            AxisWords::Polar { plane, .. } if plane.axes().1 == axis => Quantity::Angle,
            AxisWords::Polar { .. } | AxisWords::Cartesian => quantity,
        }
    }

    /// Adds a move, to a polar point where its words are polar.
    pub(in crate::word) fn push_move(&mut self, span: Span, op: Op, src: Source, out: &mut Batch) {
        match self.state.words {
            AxisWords::Cartesian if self.now.polar != [None; 2] => self.push_signed(span, op, src, out),
            AxisWords::Cartesian => self.push(span, op, out),
            AxisWords::Polar { plane, follows } => self.push_polar(plane, follows, span, op, out),
        }
    }

    #[cold]
    fn push_polar(&mut self, plane: Plane, follows: bool, span: Span, mut op: Op, out: &mut Batch) {
        let (first, second, _) = plane.axes();
        let Some(to) = polar::end(&mut op) else {
            return self.push(span, op, out);
        };
        let radius = to.axes[first as usize].take();
        let angle = to.axes[second as usize].take();
        if radius.is_none() && angle.is_none() {
            return self.push(span, op, out);
        }
        let refuse = |what: PolarUnsupported| Fault::not_supported("G16", what);
        let adds = |word: &Option<ncc_ir::program::Coord>| {
            word.as_ref().is_some_and(|word| word.distance != Fact::Known(Distance::Absolute))
        };
        if adds(&radius) {
            return self.fault(refuse(PolarUnsupported::RadiusFromTool), span, out);
        }
        if !follows && (radius.is_none() || angle.is_none() || adds(&angle)) {
            return self.fault(refuse(PolarUnsupported::WordFromTool), span, out);
        }
        let negative = radius.as_ref().and_then(|r| r.value.literal()).is_some_and(|n| n.mantissa < 0);
        if negative {
            return self.fault(refuse(PolarUnsupported::NegativeRadius), span, out);
        }
        match &op {
            Op::Position(_) => {
                return self.fault(refuse(PolarUnsupported::HoleOfCaller), span, out);
            }
            Op::ArcFeed(arc) if !matches!(arc.centre, Centre::Radius(_)) => {
                return self.fault(refuse(PolarUnsupported::CentreArc), span, out);
            }
            _ => {}
        }
        self.state.words = AxisWords::Polar { plane, follows: true };
        let polar = Polar { plane: Fact::Known(plane), radius, angle, along: false, op };
        self.push(span, Op::Polar(Box::new(polar)), out);
    }

    /// A word of a sign for radius or angle.
    pub(in crate::word) fn polar_sign(&mut self, word: &Word, out: &mut Batch) {
        let own = self.settings.dialect.polar.signs().and_then(|s| s.iter().position(|s| *s == word.letter));
        let Some(place) = own else { return };
        if self.now.polar[place].replace(*word).is_some() {
            self.fault(Fault::WordTwice { letter: char::from(word.letter) }, word.span, out);
        }
    }

    /// Such words that no move has taken.
    pub(in crate::word) fn check_polar_signs(&mut self, src: Source, out: &mut Batch) {
        for word in std::mem::take(&mut self.now.polar).into_iter().flatten() {
            self.fault(Fault::WordUnused { word: src.text(word.span) }, word.span, out);
        }
    }

    /// Adds a move whose end is stated by signs for radius and angle about program zero. A word that is missing
    /// or an increment counts from where the tool is: where that is a polar point, from its words.
    #[cold]
    fn push_signed(&mut self, span: Span, mut op: Op, src: Source, out: &mut Batch) {
        let [radius, angle] = std::mem::take(&mut self.now.polar);
        let Some(first) = radius.or(angle) else { return };
        let refuse = |lower: &mut Lower, what: PolarUnsupported, out: &mut Batch| {
            lower.no_polar(&src.text(first.span), what, first.span, out);
        };
        if self.plane(span, out) != Fact::Known(Plane::Xy) {
            return refuse(self, PolarUnsupported::OtherPlane, out);
        }
        let by_cycle = matches!(op, Op::Hole(_));
        if matches!(op, Op::Position(_)) {
            return refuse(self, PolarUnsupported::OfCallersCycle, out);
        }
        let plain =
            polar::end(&mut op).is_some_and(|to| to.get(Axis::X).is_none() && to.get(Axis::Y).is_none());
        if !plain {
            return refuse(self, PolarUnsupported::BesideXY, out);
        }
        let Fact::Known(distance) = self.distance(span, out) else {
            return refuse(self, PolarUnsupported::UnknownDistance, out);
        };
        let adds = distance == Distance::Incremental;
        if adds && by_cycle {
            return refuse(self, PolarUnsupported::HoleIncrements, out);
        }
        if (adds || radius.is_none() || angle.is_none()) && !self.state.follows_polar {
            return refuse(self, PolarUnsupported::CountFromTool, out);
        }
        let mut value = |word: Option<Word>, quantity: Quantity| match word {
            None => Some(None),
            Some(word) => self.number(&word, quantity, src, out).map(Some),
        };
        let (Some(length), Some(turned)) = (value(radius, Quantity::Length), value(angle, Quantity::Angle))
        else {
            return;
        };
        if !adds && length.is_some_and(|length| length.mantissa < 0) {
            return refuse(self, PolarUnsupported::WithNegativeRadius, out);
        }
        let follows = match length {
            None => self.state.follows_polar,
            Some(length) => length.mantissa > 0,
        };
        let plane = Fact::Known(Plane::Xy);
        if !self.state.follows_polar {
            let at = PoleWords::Along(Box::default());
            self.push(span, Op::SetPole(Box::new(SetPole { plane, from: PoleFrom::Zero, at })), out);
        }
        let word = |value: Num| Coord { value: Expr::Num(value), distance: Fact::Known(distance) };
        let (radius, angle) = (length.map(word), turned.map(word));
        self.push(span, Op::Polar(Box::new(Polar { plane, radius, angle, along: false, op })), out);
        self.state.follows_polar = follows;
    }
}
