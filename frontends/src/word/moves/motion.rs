//! Lowering of moves: lines, arcs and bare axis words.
//!
//! Not here: holes, which are cycles' business.

use ncc_dialects::{ARC_WITHOUT_CENTRE, Meaning, Quantity, STRAIGHT_LINE};
use ncc_ir::canon::{Axis, Distance, Fact, Motion, Plane, Turn};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::{Expr, Function, Node, Unary};
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Move, Op, Point, Turns};
use ncc_ir::source::Span;
use ncc_ir::unsupported::MoveUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::words::{Value, Word};
use crate::word::block_words::{Code, Words, motion_of};
use crate::word::lower::Lower;
use crate::word::word_state::CycleState;

/// Most turns of one arc.
const MOST_TURNS: u32 = 9999;

impl Lower {
    /// The code that ends a cycle.
    pub(in crate::word) fn end_cycle(&mut self, end: &Code, out: &mut Batch) {
        self.push(end.span, Op::EndCycle, out);
        self.state.after_cycle |= self.state.cycle != CycleState::None;
        self.state.cycle = CycleState::None;
        self.state.no_motion |= self.settings.dialect.cycles.ends_motion;
        self.state.rigid = None;
        self.now.cycle_ended = true;
    }

    /// Codes of motion, cycles and patterns, with the block's axis words.
    pub(in crate::word) fn motion_codes(
        &mut self,
        codes: &[Code],
        dwell: bool,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let find = |wanted: fn(Meaning) -> bool| codes.iter().find(|c| wanted(c.meaning));
        let beside =
            codes.iter().find(|c| matches!(motion_of(c.meaning), Some(Motion::Traverse | Motion::Feed)));
        let cycle = find(|m| m == Meaning::StartCycle)
            .filter(|cycle| !beside.is_some_and(|motion| self.cancels(motion, cycle, words, src, out)));
        let pattern = find(|m| m == Meaning::Pattern);
        if let Some(end) = find(|m| m == Meaning::EndCycle).filter(|_| !self.now.cycle_ended) {
            self.end_cycle(end, out);
        }
        let motion = codes.iter().find_map(|c| Some((c, motion_of(c.meaning)?)));
        if let Some((code, motion)) = motion {
            // With a cycle's code after it, it only says what is active when the cycle is over.
            let excluded = pattern.or_else(|| cycle.filter(|c| c.at < code.at));
            if let Some(other) = excluded {
                let fault = Fault::CodesExclude { first: src.text(other.span), second: src.text(code.span) };
                self.now.failed = true;
                out.diagnostics.push(Diagnostic { fault, span: code.span, related: vec![other.span] });
            }
            if cycle.is_none() && pattern.is_none() {
                if matches!(self.state.cycle, CycleState::Active(_)) {
                    self.push(code.span, Op::EndCycle, out);
                }
                self.state.cycle = CycleState::None;
                self.state.rigid = None;
            }
            let lead = self.state.lead;
            let before = self.state.modes.motion;
            self.set_motion(motion);
            self.said_motion(motion, before, code.span);
            self.state.after_cycle = false;
            if matches!(code.meaning, Meaning::SynchronisedFeed(_)) {
                (self.state.thread, self.state.lead) = (Some(code.row), lead);
            }
        }
        if let (Some(cycle), Some(pattern)) = (cycle, pattern) {
            let fault = Fault::CodesExclude { first: src.text(cycle.span), second: src.text(pattern.span) };
            return self.fault(fault, pattern.span, out);
        }
        let machine = find(|m| matches!(m, Meaning::UseMachineCoordinates { .. }));
        let reference = find(|m| matches!(m, Meaning::GoToReference { .. }));
        if let Some(code) = find(|m| matches!(m, Meaning::Detour(_))) {
            let other = cycle.or(pattern).or(machine).or(reference).or(motion.map(|(code, _)| code));
            if let Some(other) = other {
                let fault = Fault::CodesExclude { first: src.text(code.span), second: src.text(other.span) };
                return self.fault(fault, other.span, out);
            }
            return self.by_detour(code, block, words, src, out);
        }
        if let (Some(code), Some(_)) = (machine, self.state.thread) {
            let what = MoveUnsupported::MachineInThread.into();
            return self.fault(Fault::NotSupported { code: src.text(code.span), what }, code.span, out);
        }
        if let Some(code) = machine.or(reference) {
            let other = cycle.or(pattern).or(machine.and(reference));
            if let Some(other) = other.filter(|other| other.at != code.at) {
                let fault = Fault::CodesExclude { first: src.text(code.span), second: src.text(other.span) };
                return self.fault(fault, other.span, out);
            }
            return self.machine_move(code, motion.is_some(), block, words, src, out);
        }
        if let Some(code) = find(|m| matches!(m, Meaning::StraightProbe(_))) {
            if let Some(other) = cycle.or(pattern) {
                let fault = Fault::CodesExclude { first: src.text(code.span), second: src.text(other.span) };
                return self.fault(fault, other.span, out);
            }
            return self.probe(code, block, words, src, out);
        }
        if let Some((code, motion)) = motion
            && let Some(word) = self.needed_with(code, motion, words)
        {
            let fault = Fault::WordMissing { code: src.text(code.span), word: word.into() };
            return self.fault(fault, code.span, out);
        }
        match (cycle, pattern) {
            (Some(code), _) => self.start_cycle(code, dwell, block, words, src, out),
            (None, Some(code)) => self.pattern(code, block, words, src, out),
            (None, None) => match &self.state.cycle {
                CycleState::Active(_) => self.in_cycle(dwell, block, words, src, out),
                CycleState::None | CycleState::Lost if dwell && !self.moves_behind_dwell() => {}
                CycleState::Lost => self.position(block, words, src, out),
                CycleState::None => self.plain_motion(motion.is_some(), block, words, src, out),
            },
        }
    }

    /// What a control with O words stops for want of, in a block with such a code alone: there it is no mode for the
    /// blocks that follow (LinuxCNC's `convert_arc`: R I J K words all missing for arc; `enhance_block`: all axes
    /// missing with motion code, but for G0 to G3).
    fn needed_with(&self, code: &Code, motion: Motion, words: &Words) -> Option<&'static str> {
        if !self.settings.dialect.program.o_words || self.has_axis_word(words) {
            return None;
        }
        match motion {
            _ if matches!(code.meaning, Meaning::SynchronisedFeed(_)) => Some("Z"),
            Motion::Arc(_) if !self.has_arc_word(words) => Some("I, J, K or R"),
            Motion::Arc(_) | Motion::Traverse | Motion::Feed | Motion::Cycle => None,
        }
    }

    /// Axis words outside cycles.
    fn plain_motion(&mut self, said: bool, block: Span, words: &mut Words, src: Source, out: &mut Batch) {
        if self.polar_line(said, block, words, src, out) {
            return;
        }
        let arc_now = matches!(self.state.modes.motion.value(), Some(Motion::Arc(_)));
        if !(self.has_axis_word(words) || arc_now && self.has_arc_word(words)) {
            return;
        }
        if let Some(row) = self.state.thread {
            return self.thread(row, block, words, src, out);
        }
        match self.motion(block, out) {
            Err(()) => self.give_up(words),
            Ok(None | Some(Motion::Cycle)) => self.position(block, words, src, out),
            Ok(Some(Motion::Traverse)) => {
                let to = self.point(None, block, words, src, out);
                self.push_move(block, Op::StraightTraverse(Move { to, said }), src, out);
            }
            Ok(Some(Motion::Feed)) => {
                self.rely_on_feed(block, out);
                self.corner(words, src, out);
                let to = self.point(None, block, words, src, out);
                self.push_move(block, Op::StraightFeed(Move { to, said }), src, out);
            }
            Ok(Some(Motion::Arc(turn))) => {
                self.rely_on_feed(block, out);
                self.corner(words, src, out);
                self.arc(turn, said, block, words, src, out);
            }
        }
    }

    /// A refused block: its words are not blamed as well.
    fn give_up(&mut self, words: &mut Words) {
        self.now.failed = true;
        for axis in Axis::ALL {
            words.take(axis.letter());
        }
    }

    /// Axis words that do whatever is active when the program runs.
    fn position(&mut self, block: Span, words: &mut Words, src: Source, out: &mut Batch) {
        if self.has_axis_word(words) {
            if self.state.level_changed {
                // A cycle that its caller has activated has the level that was active there.
                let what = MoveUnsupported::HoleAfterLevel.into();
                self.fault(Fault::NotSupported { code: src.text(block), what }, block, out);
            }
            self.bare_words(block, out);
            let to = self.point(None, block, words, src, out);
            self.push_move(block, Op::Position(Move { to, said: false }), src, out);
        }
    }

    /// Whether an axis word is left, or one for a point by radius and angle.
    pub(in crate::word) fn has_axis_word(&self, words: &Words) -> bool {
        words.has_any(self.roles.axes) || self.now.polar != [None; 2]
    }

    /// Whether the block of a dwell can have a straight move, and one is active.
    fn moves_behind_dwell(&self) -> bool {
        let straight = matches!(self.state.modes.motion.value(), Some(Motion::Traverse | Motion::Feed));
        self.settings.dialect.block.dwell_before_move && straight && self.state.cycle == CycleState::None
    }

    fn has_arc_word(&self, words: &Words) -> bool {
        let roles = &self.roles;
        roles.centre.iter().chain([&roles.radius]).any(|&letter| words.get(letter).is_some())
    }

    /// A move at feed relies on a feed.
    pub(in crate::word) fn rely_on_feed(&mut self, block: Span, out: &mut Batch) {
        if let Some(feed) = self.state.cycle_feed.take() {
            self.push(block, Op::SetFeedRate(Expr::Num(feed)), out);
        }
        if self.state.modes.feed == Know::Unsaid && !self.watch {
            if self.sub.is_some() || self.main_ending.ends || !self.settings.dialect.program.macro_b {
                return self.fault(Fault::NoFeed, block, out);
            }
            // The end of the text says whether it has a caller, which has stated a feed.
            self.main_ending.feed = Some(block);
            self.state.modes.feed = Know::Callers;
        }
    }

    /// The axis words that are left, but for one axis.
    pub(in crate::word) fn point(
        &mut self,
        without: Option<u8>,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Point {
        let mut to = Point::default();
        for axis in Axis::ALL {
            let letter = axis.letter();
            if Some(letter) == without || words.get(letter).is_none() {
                continue;
            }
            let Some(row) = self.axis_row(axis) else {
                continue;
            };
            if let Some(word) = words.take(letter) {
                if let Value::Computed(place) = word.value
                    && (self.state.unplaced != 0 || self.level_open())
                    && !self.settings.dialect.program.o_words
                    && may_be_left_out(&words.exprs[usize::from(place)])
                {
                    // Whether the word is there at all must be known. A parameter without a value
                    // is an error where words cannot go; what is computed has one.
                    self.fault(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out);
                    continue;
                }
                let distance = self.distance(word.span, out);
                let quantity = self.quantity_of(axis, row.quantity);
                if let Some(value) = self.amount(&word, quantity, words, src, out) {
                    to.set(axis, Coord { value, distance });
                }
            }
        }
        let with_z = to.get(Axis::Z).is_some() || without.is_some();
        self.rely_on_frames(with_z, block, out);
        if self.state.unplaced != 0 {
            self.place_first(&to, block, out);
        }
        if self.level_open() {
            let absolute = |word: &Coord| word.distance == Fact::Known(Distance::Absolute);
            match to.get(Axis::Z) {
                Some(word) if absolute(word) && without.is_none() => self.state.level_open = false,
                None if without.is_none() => {}
                // Whether it is a way, the run of the program knows, and execution refuses that.
                Some(word)
                    if word.distance == Fact::Entry
                        && without.is_none()
                        && (out.whole || self.computes_anything()) =>
                {
                    self.state.level_open = false;
                }
                Some(_) | None => self.refuse_level(block, out),
            }
        }
        to
    }

    /// Whether the tool stands at another Z than the statements say, since its length is another.
    pub(in crate::word) fn level_open(&self) -> bool {
        self.state.level_open && self.settings.dialect.can.length_at_once
    }

    /// Refuses what depends on where that is.
    pub(in crate::word) fn refuse_level(&mut self, block: Span, out: &mut Batch) {
        let row = self.settings.dialect.code_for(Meaning::UseToolLengthOffset);
        let code = row.map_or("", |row| row.code.as_str()).into();
        let what = MoveUnsupported::LengthWithoutZ.into();
        self.fault(Fault::NotSupported { code, what }, block, out);
    }

    fn arc(&mut self, turn: Turn, said: bool, block: Span, words: &mut Words, src: Source, out: &mut Batch) {
        let rules = &self.settings.dialect.arc;
        let plane = self.plane(block, out);
        let to = self.point(None, block, words, src, out);
        if let (Fact::Known(plane), false) = (plane, rules.helix) {
            let normal = plane.axes().2;
            if to.get(normal).is_some() {
                let code = char::from(normal.letter()).to_string().into();
                let what = MoveUnsupported::HelixAxis.into();
                self.fault(Fault::NotSupported { code, what }, block, out);
            }
        }
        if let (Fact::Known(plane), true, false) = (plane, rules.end_needed, self.now.failed) {
            let (first, second, _) = plane.axes();
            if to.get(first).is_none() && to.get(second).is_none() {
                let row = self.settings.dialect.code_for(Meaning::ArcFeed(turn));
                let code = row.map_or("", |row| row.code.as_str()).into();
                let word =
                    format!("{} or {}", char::from(first.letter()), char::from(second.letter())).into();
                return self.fault(Fault::WordMissing { code, word }, block, out);
            }
        }
        let turns = self.turns(words, src, out);
        let radius = words.take(self.roles.radius);
        let mut centre = [None, None, None];
        for (place, letter) in self.roles.centre.into_iter().enumerate() {
            // The word along the normal is left, and blamed as one that nothing uses.
            if matches!(plane, Fact::Known(p) if p.axes().2 as usize == place) {
                let zero = |word: Word| matches!(word.value, Value::Number(n) if n.mantissa == 0);
                if rules.centre_outside_ignored
                    || rules.centre_outside_zero && words.get(letter).is_some_and(zero)
                {
                    words.take(letter);
                }
                continue;
            }
            if let Some(word) = words.take(letter) {
                centre[place] = self.amount(&word, Quantity::Length, words, src, out);
            }
        }
        let by_centre = centre.iter().any(Option::is_some);
        let centre = match radius {
            Some(word) if by_centre => {
                return self.fault(Fault::ArcCentreAndRadius, word.span, out);
            }
            Some(word) => {
                if no_way(plane, &to) && self.now.polar == [None; 2] {
                    self.fault(Fault::ArcRadiusNoWay, block, out);
                }
                match self.amount(&word, Quantity::Length, words, src, out) {
                    Some(value) => Centre::Radius(value),
                    None => return,
                }
            }
            None if by_centre => {
                let Some(from) = self.centre_from(block, out) else { return };
                let complete = rules.centre_complete && from == CentreFrom::Zero;
                if let (Fact::Known(plane), true, false) = (plane, complete, self.now.failed) {
                    let (first, second, _) = plane.axes();
                    if let Some(axis) = [first, second].into_iter().find(|a| centre[*a as usize].is_none()) {
                        let word = char::from(self.roles.centre[axis as usize]).to_string().into();
                        let code = "G90.1".into();
                        return self.fault(Fault::WordMissing { code, word }, block, out);
                    }
                }
                Centre::Point { words: centre, from }
            }
            None if self.now.failed => return,
            None if self.settings.get(ARC_WITHOUT_CENTRE) == STRAIGHT_LINE => {
                return self.push_move(block, Op::StraightFeed(Move { to, said: true }), src, out);
            }
            None => return self.fault(Fault::ArcWithoutCentre, block, out),
        };
        let arc = Arc { plane, turn, to, centre, turns, said };
        self.push_move(block, Op::ArcFeed(Box::new(arc)), src, out);
    }

    /// Turns of an arc beyond the first, partial one.
    fn turns(&mut self, words: &mut Words, src: Source, out: &mut Batch) -> Turns {
        let Some(word) = words.take(self.roles.turns) else { return Turns::NONE };
        if let Value::Computed(_) = word.value {
            let all = self.amount(&word, Quantity::Integer, words, src, out);
            return all.map_or(Turns::NONE, Turns::of_all);
        }
        match self.read_whole(&word, src, out) {
            Some(turns @ 1..=MOST_TURNS) => Turns::from(turns - 1),
            Some(_) => {
                self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
                Turns::NONE
            }
            None => Turns::NONE,
        }
    }

    /// Whether words are incremental where the dialect's cycles are not known to take them.
    pub(in crate::word) fn incremental_unknown(&self, distance: Fact<Distance>) -> bool {
        distance == Fact::Known(Distance::Incremental) && !self.settings.dialect.cycles.incremental
    }
}

/// Whether an arc by radius has no end point in its plane.
fn no_way(plane: Fact<Plane>, to: &Point) -> bool {
    match plane {
        Fact::Known(plane) => {
            let (first, second, _) = plane.axes();
            to.get(first).is_none() && to.get(second).is_none()
        }
        Fact::Entry => to.is_empty(),
    }
}

/// Whether a word is left out where a variable was never set: one that is a variable, or its opposite. In arithmetic
/// such a variable is zero (16-C, custom macro, undefined variables).
fn may_be_left_out(value: &Expr) -> bool {
    let Expr::Node(node) = value else { return false };
    match &**node {
        Node::Unary(Unary::Negate, a) => may_be_left_out(a),
        Node::Call(Function::Round | Function::RoundTo, all) => all.first().is_none_or(may_be_left_out),
        Node::Var(_) | Node::Vacant | Node::Element(_) => true,
        Node::Unary(Unary::Not, _) | Node::Binary(..) | Node::Call(..) => false,
    }
}
