//! Lowering of the transformation that keeps the tool tip where it is, and of swivelled planes.
//!
//! A plane is read where its call sets it again, by turns about three different axes one after the other, and
//! turns the tool towards a stated side or not at all. Before it turns the tool it may retract along Z, or along
//! Z and then along X and Y: to where is data of the machine, which is taken to be its zero (an option, told).
//! Refused: further transformations and their parameters, planes that are added, other ways of stating
//! angles, a second shift, a status that is about the other direction than the stated one, and retracting along the tool, whose way follows from the limits of the axes.

use ncc_dialects::Quantity;
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr as Value;
use ncc_ir::program::{FrameSlot, Op, Point, Reference, ReferencePoint, Slot, Tilt, Toward};
use ncc_ir::source::Span;
use ncc_ir::unsupported::FrameUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::text::decode;
use crate::siemens::block_words::Given;
use crate::siemens::lower::Lower;
use crate::siemens::siemens_state::ModalCall;
use crate::siemens::spindles::number;
use crate::siemens::text::tree::Expr;

/// Places of the arguments of a swivelled plane.
const RETRACT: usize = 0;
const RECORD: usize = 1;
const ADDED: usize = 2;
const MODE: usize = 3;
const ZERO: [usize; 3] = [4, 5, 6];
const ANGLES: [usize; 3] = [7, 8, 9];
const SECOND_SHIFT: [usize; 3] = [10, 11, 12];
const DIRECTION: usize = 13;
const PLANE: usize = 15;

impl Lower {
    /// `TRAORI(1)`, `TRAFOOF()`.
    pub(in crate::siemens) fn transformation(
        &mut self,
        name: &str,
        span: Span,
        on: bool,
        arguments: &[Option<Expr>],
        out: &mut Batch,
    ) {
        let first = on && arguments.len() == 1 && number(arguments.first()) == Some(1);
        if !arguments.is_empty() && !first {
            return self.not_supported(name, FrameUnsupported::TransformationParameters, span, out);
        }
        self.stand.forget();
        self.push(span, Op::UseToolCentrePoint(on), out);
    }

    /// `CYCLE800(0,"",0,57,0,0,0,30,0,0,0,0,0,-1)`; without arguments the plane is taken back.
    pub(in crate::siemens) fn swivel(
        &mut self,
        name: &str,
        span: Span,
        arguments: &[Option<Expr>],
        src: Source,
        out: &mut Batch,
    ) {
        if !matches!(self.state.cycle, ModalCall::None) {
            return self.not_supported(name, FrameUnsupported::SwivelInCycle, span, out);
        }
        self.stand.forget();
        self.state.pole.lose();
        if arguments.iter().all(Option::is_none) {
            self.tilt.ends(self.state.modes.tilt);
            self.state.modes.tilt = Know::Said(false);
            return self.push(span, Op::ClearFrame(FrameSlot::Tilt), out);
        }
        if let Some(what) = refused(arguments) {
            return self.not_supported(name, what, span, out);
        }
        if !self.swivel_record(arguments.get(RECORD), src, out) {
            return self.not_supported(name, FrameUnsupported::SwivelKinematics, span, out);
        }
        let about = number(arguments.get(MODE)).and_then(order_of);
        let Some(about) = about else {
            return self.not_supported(name, FrameUnsupported::SwivelAngles, span, out);
        };
        let toward = match number(arguments.get(DIRECTION)) {
            Some(-1) => Some(Toward::Minus),
            Some(0) => None,
            Some(1) => Some(Toward::Plus),
            Some(_) | None => {
                return self.not_supported(name, FrameUnsupported::SwivelDirection, span, out);
            }
        };
        let optimised = match number(arguments.get(ADDED)).unwrap_or(0) {
            0 => None,
            100_000 => Some(Toward::Minus),
            _ => Some(Toward::Plus),
        };
        if optimised.is_some() && toward.is_some() {
            if optimised != toward {
                let what = FrameUnsupported::SwivelOtherStatus;
                return self.not_supported(name, what, span, out);
            }
            if self.option("swivel_side", span, out) == "other" {
                let what = FrameUnsupported::SwivelOtherSide;
                return self.not_supported(name, what, span, out);
            }
        }
        let retracts: &[&[Axis]] = match number(arguments.get(RETRACT)) {
            None => &[],
            Some(0) => &[],
            Some(1) => &[&[Axis::Z]],
            Some(2) => &[&[Axis::Z], &[Axis::X, Axis::Y]],
            Some(_) => {
                return self.not_supported(name, FrameUnsupported::SwivelRetractTool, span, out);
            }
        };
        if !retracts.is_empty() && toward.is_none() {
            return self.not_supported(name, FrameUnsupported::SwivelRetractOnly, span, out);
        }
        let origin = ZERO.map(|place| self.swivel_value(arguments, place, Quantity::Length, src, out));
        let angles = ANGLES.map(|place| self.swivel_value(arguments, place, Quantity::Angle, src, out));
        let ([Some(x), Some(y), Some(z)], [Some(a), Some(b), Some(c)]) = (origin, angles) else { return };
        if self.tilt.ends(self.state.modes.tilt) {
            self.push(span, Op::ClearFrame(FrameSlot::Tilt), out);
        }
        if !self.tilt.starts() {
            return self.not_supported(name, FrameUnsupported::SwivelAgain, span, out);
        }
        self.state.modes.tilt = Know::Said(true);
        if !retracts.is_empty() && self.option("swivel_retract", span, out) == "elsewhere" {
            let what = FrameUnsupported::SwivelRetractElsewhere;
            return self.not_supported(name, what, span, out);
        }
        for axes in retracts {
            let mut goes = [false; AXES];
            axes.iter().for_each(|axis| goes[*axis as usize] = true);
            let (point, via) = (ReferencePoint::Home, Point::default());
            let to = Reference { point, axes: goes, via, keeps_length: true };
            self.push(span, Op::GoToReference(Box::new(to)), out);
        }
        let tilt = Tilt { origin: [Some(x), Some(y), Some(z)], about, angles: [a, b, c] };
        self.push(span, Op::SetSlot(Box::new(Slot::Tilt(Box::new(tilt)))), out);
        if toward.is_some() {
            self.push(span, Op::OrientToolAxis(toward), out);
        }
    }

    /// The record of the machine's kinematics is taken to be its only one; `false` if it is deselected.
    fn swivel_record(&mut self, record: Option<&Option<Expr>>, src: Source, out: &mut Batch) -> bool {
        let Some(Some(record)) = record else { return true };
        let Expr::Text(span) = record else { return false };
        let bytes = src.bytes(*span);
        let name = decode(bytes.get(1..bytes.len().saturating_sub(1)).unwrap_or_default());
        if !name.is_empty() && self.first_time("swivel-record") {
            let assumption = ControlFact::SwivelRecord { name: name.as_ref().into() };
            out.report(Fault::AssumedFact { fact: assumption }, *span);
        }
        *name != *"0"
    }

    /// A number among the arguments; an empty one is 0.
    fn swivel_value(
        &mut self,
        arguments: &[Option<Expr>],
        place: usize,
        quantity: Quantity,
        src: Source,
        out: &mut Batch,
    ) -> Option<Value> {
        let zero = || Value::Num(ncc_ir::expr::num::Num::int(0, ncc_ir::expr::num::Unit::Mm));
        match arguments.get(place) {
            None | Some(None) if quantity == Quantity::Angle => {
                Some(Value::Num(ncc_ir::expr::num::Num::int(0, ncc_ir::expr::num::Unit::Degree)))
            }
            None | Some(None) => Some(zero()),
            Some(Some(Expr::Number(digits, span))) => {
                let given = Given { digits: *digits, distance: None, way: None, computed: None, span: *span };
                self.number(given, quantity, src, out).map(Value::Num)
            }
            Some(Some(other)) => {
                let span = other.span();
                self.fault(Fault::MacroLanguage { what: src.text(span) }, span, out);
                None
            }
        }
    }
}

/// What of the arguments nobody here can say.
fn refused(arguments: &[Option<Expr>]) -> Option<FrameUnsupported> {
    let is_zero = |place: usize| match arguments.get(place) {
        None | Some(None) => true,
        Some(Some(Expr::Number(digits, _))) => digits.mantissa == 0,
        Some(Some(_)) => false,
    };
    let plane = matches!(number(arguments.get(PLANE)), Some(0 | 1)) || is_zero(PLANE);
    match () {
        () if arguments.len() > PLANE + 1 || !plane => Some(FrameUnsupported::SwivelPlane),
        () if !matches!(arguments.get(RETRACT), None | Some(None | Some(Expr::Number(..)))) => {
            Some(FrameUnsupported::SwivelRetractComputed)
        }
        () if !is_zero(ADDED) && !matches!(number(arguments.get(ADDED)), Some(100_000 | 200_000)) => {
            Some(FrameUnsupported::SwivelAdded)
        }
        () if !SECOND_SHIFT.iter().all(|place| is_zero(*place)) => Some(FrameUnsupported::SwivelShift),
        () => None,
    }
}

/// The order of turns of a number: two bits each, the first turn lowest, X 1, Y 2, Z 3.
fn order_of(mode: i64) -> Option<[Axis; 3]> {
    let axis = |bits: i64| match bits & 3 {
        1 => Some(Axis::X),
        2 => Some(Axis::Y),
        3 => Some(Axis::Z),
        _ => None,
    };
    let about = [axis(mode)?, axis(mode >> 2)?, axis(mode >> 4)?];
    let different = about[0] != about[1] && about[1] != about[2] && about[0] != about[2];
    (different && mode >> 6 == 0).then_some(about)
}
