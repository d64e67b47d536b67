//! Lowering of moves in machine coordinates and to reference points.
//!
//! Refused: both while a cycle is active, arcs and increments in machine coordinates, and
//! points that the machine may have elsewhere than its option says.

use ncc_dialects::{AT_ZERO, FURTHER_POINT, MACHINE_WITHOUT_AXIS, Meaning, NOTHING, STORED_POSITION};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Motion};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::program::{Coord, Move, Op, Point, Reference, ReferencePoint};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;
use ncc_ir::unsupported::left_out::LeftOut;

use crate::batch::Batch;
use crate::common::Source;
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;

impl Lower {
    /// A block with the code of such a move.
    pub(in crate::word) fn machine_move(
        &mut self,
        code: &Code,
        said: bool,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let text = || code.row.code.as_str().into();
        let what = MoveUnsupported::MachineInCycle.into();
        self.without_cycle(Fault::NotSupported { code: text(), what }, code.span, out);
        self.check_shut(code, out);
        let number = match code.row.words.chars().next() {
            Some(letter) => match words.take(letter as u8) {
                Some(word) => self.read_whole(&word, src, out),
                None => Some(2),
            },
            None => None,
        };
        let to = self.words_of_axes(words, src, out);
        match code.meaning {
            Meaning::UseMachineCoordinates { .. } => self.in_machine(code, said, to, block, out),
            Meaning::GoToReference { point, keeps_length } => {
                self.reference_move(code, point, keeps_length, number, to, block, out);
            }
            _ => {}
        }
    }

    /// The axis words that are left; what they count from is not looked at.
    fn words_of_axes(&mut self, words: &mut Words, src: Source, out: &mut Batch) -> Point {
        let mut to = Point::default();
        for axis in Axis::ALL {
            let Some(row) = self.axis_row(axis) else { continue };
            if let Some(word) = words.take(axis.letter()) {
                let distance = match self.now.return_distance {
                    Some(distance) => Fact::Known(distance),
                    None => self.distance(word.span, out),
                };
                if let Some(value) = self.amount(&word, row.quantity, words, src, out) {
                    to.set(axis, Coord { value, distance });
                }
            }
        }
        to
    }

    /// The linear axes, and the rotary ones that the text has named so far: others stay where they are, if there are any.
    fn axes_at_hand(&self) -> [bool; AXES] {
        let named = |axis: Axis| self.rotary_named >> (axis.letter() - b'A') & 1 == 1;
        Axis::ALL.map(|axis| self.axis_row(axis).is_some() && (!axis.is_rotary() || named(axis)))
    }

    fn in_machine(&mut self, code: &Code, said: bool, to: Point, block: Span, out: &mut Batch) {
        let Meaning::UseMachineCoordinates { length, rapid } = code.meaning else { return };
        if to.is_empty() && out.refused_within(block) {
            // An axis word stands there, and was refused.
            return;
        }
        if to.is_empty() && self.settings.get(MACHINE_WITHOUT_AXIS) == NOTHING {
            let what = LeftOut::WithoutAxis { code: code.row.code.as_str().into() };
            return out.report(Fault::CodeLeftOut { what }, code.span);
        }
        let mut refuse = |what: MoveUnsupported| {
            self.fault(Fault::not_supported(code.row.code.as_str(), what), code.span, out);
        };
        if to.is_empty() {
            return refuse(MoveUnsupported::MachineNoAxis);
        }
        if to.axes.iter().flatten().any(|word| word.distance == Fact::Known(Distance::Incremental)) {
            return refuse(MoveUnsupported::MachineIncrement);
        }
        // Where such a move is always a rapid, none need have been stated before.
        let motion = match rapid && !said {
            true => None,
            false => match self.motion(block, out) {
                Err(()) => return,
                Ok(motion) => motion,
            },
        };
        let feeds = match motion {
            Some(Motion::Feed) if rapid && said => {
                let code_text = code.row.code.as_str().into();
                let what = MoveUnsupported::MachineFeed.into();
                return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
            }
            _ if rapid => false,
            Some(Motion::Traverse) => false,
            Some(Motion::Feed) => true,
            Some(Motion::Arc(_) | Motion::Cycle) | None => {
                let code_text = code.row.code.as_str().into();
                let what = MoveUnsupported::MachineNoMotion.into();
                return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
            }
        };
        if feeds {
            self.rely_on_feed(block, out);
            // A control that goes there rapidly alone says it in the work offset.
            self.rely_on_frames(to.get(Axis::Z).is_some(), block, out);
        }
        self.push(code.span, Op::UseMachineCoordinates { length }, out);
        if to.get(Axis::Z).is_some_and(|word| word.distance == Fact::Known(Distance::Absolute)) {
            // Z is at a place of the machine, whatever the length.
            self.state.level_open = false;
        }
        let to = Move { to, said };
        self.push(block, if feeds { Op::StraightFeed(to) } else { Op::StraightTraverse(to) }, out);
    }

    #[allow(clippy::too_many_arguments)] // All that a block says of its move.
    fn reference_move(
        &mut self,
        code: &Code,
        point: ReferencePoint,
        keeps_length: bool,
        number: Option<u32>,
        mut via: Point,
        block: Span,
        out: &mut Batch,
    ) {
        let code_text = || code.row.code.as_str().into();
        let mut axes: [bool; AXES] = std::array::from_fn(|axis| via.axes[axis].is_some());
        if via.is_empty() {
            axes = match point {
                ReferencePoint::Stored(_) => Axis::ALL.map(|axis| self.axis_row(axis).is_some()),
                _ if code.row.alone_all_axes => self.axes_at_hand(),
                _ => {
                    let word = "X".into();
                    return self.fault(Fault::WordMissing { code: code_text(), word }, code.span, out);
                }
            };
        }
        let point = match (point, number) {
            (ReferencePoint::Further(0), Some(n @ 2..=4)) => ReferencePoint::Further(n as u8),
            (ReferencePoint::Further(0), _) => {
                let fault = Fault::OutOfRange { word: code.row.words.as_str().into() };
                return self.fault(fault, code.span, out);
            }
            (point, _) => point,
        };
        if point == ReferencePoint::Home && self.option("reference_point", code.span, out) == "elsewhere" {
            let what = MoveUnsupported::ReferenceElsewhere.into();
            return self.fault(Fault::NotSupported { code: code_text(), what }, code.span, out);
        }
        // A point whose place is stated is that place, which every control supports.
        let stated = match point {
            ReferencePoint::Stored(_) => self.settings.get(STORED_POSITION),
            ReferencePoint::Further(_) => self.settings.get(FURTHER_POINT),
            ReferencePoint::Home | ReferencePoint::Fixed(_) => "",
        };
        let point = if stated == AT_ZERO { ReferencePoint::Home } else { point };
        // From where it stands, an axis goes nowhere first.
        for word in &mut via.axes {
            let stays = |w: &Coord| {
                w.distance == Fact::Known(Distance::Incremental)
                    && w.value.literal().is_some_and(Num::is_zero)
            };
            if word.as_ref().is_some_and(stays) {
                *word = None;
            }
        }
        if !via.is_empty() {
            self.rely_on_frames(via.get(Axis::Z).is_some(), block, out);
        }
        self.push(block, Op::GoToReference(Box::new(Reference { point, axes, via, keeps_length })), out);
    }
}
