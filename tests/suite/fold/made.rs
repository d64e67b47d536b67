//! Programs of cycles and patterns from a seed: what a programmer or a CAM system could mean.
//!
//! Every plain cycle has at least two holes; clearances are less than a stroke; the
//! tool comes from the retract plane or above; a pattern begins where the tool stands only if that
//! place is written. So each of them can be seen in its moves.

use ncc_ir::canon::{Axis, Distance, Fact, Plane, ReturnLevel, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Along, Approach, Clearance, Cycle, CycleKind, First, Pattern, Row};
use ncc_ir::program::{Coord, Move, Op, Point, Procedure, Program, Stmt};
use ncc_ir::source::Span;

/// Numbers that look random and follow from a seed (SplitMix64).
pub(super) struct Chance(u64);

impl Chance {
    pub(super) fn new(seed: u64) -> Chance {
        let mut chance = Chance(seed ^ 0x5851_f42d_4c95_7f2d);
        // Neighbouring seeds must not give neighbouring numbers.
        Chance(chance.next() ^ seed.rotate_left(32))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from `low` to `high`, both included.
    pub(super) fn between(&mut self, low: i64, high: i64) -> i64 {
        low + (self.next() % (high - low + 1) as u64) as i64
    }

    /// Whether something happens that does so `percent` of the time.
    pub(super) fn percent(&mut self, percent: i64) -> bool {
        self.between(1, 100) <= percent
    }

    pub(super) fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.between(0, from.len() as i64 - 1) as usize]
    }
}

/// A program in the making.
struct Maker {
    chance: Chance,
    unit: Unit,
    plane: Plane,
    body: Vec<Stmt>,
    /// Level of the drilling axis, in hundredths.
    level: i64,
    decimals: u8,
    /// Whether the tool stands where a word says.
    written: bool,
}

/// The program of a seed, with steps of circles that so many digits can say.
pub(super) fn program(seed: u64, decimals: u8) -> Program {
    let mut chance = Chance::new(seed);
    let unit = if chance.percent(15) { Unit::Inch } else { Unit::Mm };
    let plane = if chance.percent(85) { Plane::Xy } else { chance.pick(&[Plane::Zx, Plane::Yz]) };
    let mut maker = Maker { chance, unit, plane, body: Vec::new(), level: 0, decimals, written: true };
    maker.program();
    let main = Procedure { body: maker.body, ..Procedure::default() };
    Program { procedures: vec![main], ..Program::default() }
}

impl Maker {
    fn say(&mut self, op: Op) {
        let mut stmt = Stmt::new(Span::default(), op);
        if self.chance.percent(3) {
            stmt.number = Some(self.chance.between(1, 9999) as u32);
        }
        self.body.push(stmt);
    }

    /// A length with so many digits after the point.
    fn length(&mut self, low: i64, high: i64, scale: u8) -> Num {
        let tens = 10i64.pow(u32::from(scale));
        let mantissa = self.chance.between(low * tens, high * tens);
        Num { mantissa, scale, point: true, unit: self.unit }.trimmed()
    }

    fn hundredths(&self, mantissa: i64) -> Num {
        Num { mantissa, scale: 2, point: true, unit: self.unit }.trimmed()
    }

    fn digits(&mut self) -> u8 {
        self.chance.pick(&[0, 0, 1, 1, 2, 3])
    }

    fn program(&mut self) {
        self.say(Op::UseLengthUnits(if self.unit == Unit::Inch { Units::Inch } else { Units::Mm }));
        self.say(Op::SetDistanceMode(Distance::Absolute));
        self.say(Op::SelectPlane(self.plane));
        self.say(Op::StartSpindleClockwise);
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let at = absolute(self.hundredths(3000));
            self.go(&[(axis, at)], false);
        }
        self.level = 3000;
        for _ in 0..self.chance.between(1, 4) {
            self.job();
        }
        self.say(Op::ProgramEnd);
    }

    fn go(&mut self, words: &[(Axis, Coord)], feed: bool) {
        let mut to = Point::default();
        for (axis, word) in words {
            to.set(*axis, word.clone());
        }
        let m = Move { to, said: true };
        self.say(if feed { Op::StraightFeed(m) } else { Op::StraightTraverse(m) });
    }

    fn feed(&mut self) -> Expr {
        self.length(20, 900, 0).into()
    }

    fn seconds(&mut self) -> Expr {
        Num { mantissa: self.chance.between(1, 30), scale: 1, point: true, unit: Unit::Second }
            .trimmed()
            .into()
    }

    fn place(&mut self) -> [Coord; 2] {
        let scale = self.digits();
        [(); 2].map(|()| absolute(self.length(-150, 150, scale)))
    }

    /// Some milling or positioning, then a cycle or several.
    fn job(&mut self) {
        let (first, second, normal) = self.plane.axes();
        if self.chance.percent(40) {
            self.say(Op::Comment("NEXT".into()));
        }
        if self.chance.percent(30) {
            let feed = self.feed();
            self.say(Op::SetFeedRate(feed));
            let [x, y] = self.place();
            self.go(&[(first, x), (second, y)], true);
        }
        self.level = self.chance.between(10, 80) * 50;
        let level = absolute(self.hundredths(self.level));
        self.go(&[(normal, level)], false);
        let [x, y] = self.place();
        self.go(&[(first, x), (second, y)], false);
        self.written = true;
        for _ in 0..self.chance.pick(&[1, 1, 1, 2]) {
            self.cycle();
            if self.chance.percent(80) {
                self.say(Op::EndCycle);
            }
        }
    }

    fn cycle(&mut self) {
        // The tool stands at `level` or, after a cycle that goes on, at its retract plane.
        let retract = self.level - 50 * self.chance.between(0, 8);
        let retract = retract.min(self.level).max(50);
        let (kind, deep) = self.kind();
        let level = self.chance.pick(&[ReturnLevel::Retract, ReturnLevel::Initial]);
        // A cycle with another feed on the way out states the one in.
        let two = matches!(kind, CycleKind::Bore { feed_out: Some(_), .. });
        let feed = (two || self.chance.percent(80)).then(|| self.feed());
        if feed.is_none() {
            let feed = self.feed();
            self.say(Op::SetFeedRate(feed));
        }
        let plain = matches!(kind, CycleKind::Drill);
        let relative = self.chance.percent(15);
        let depth = if relative { -deep } else { retract - deep };
        let distance = Fact::Known(if relative { Distance::Incremental } else { Distance::Absolute });
        let approach = self.chance.pick(&[Approach::PlaneFirst, Approach::RaiseFirst, Approach::ClearFirst]);
        self.say(Op::StartCycle(Box::new(Cycle {
            kind,
            plane: Fact::Known(self.plane),
            retract: absolute(self.hundredths(retract)),
            depth: Coord { value: self.hundredths(depth).into(), distance },
            return_level: Fact::Known(level),
            return_plane: None,
            reference: None,
            approach,
            feed,
        })));
        if level == ReturnLevel::Retract {
            self.level = retract;
        }
        let items = self.chance.pick(&[1, 1, 2, 3]);
        for item in 0..items {
            if item > 0 {
                // Two that touch could be read as one; a programmer tells them apart as well.
                self.say(Op::Comment("THEN".into()));
            }
            match self.chance.between(0, 9) {
                0..=1 => self.positions(plain),
                2..=4 => self.circle(),
                5..=6 => self.line(),
                7..=8 => self.grid(),
                _ => self.list(),
            }
            self.written = matches!(self.body.last().map(|stmt| &stmt.op), Some(Op::Hole(_)));
        }
    }

    /// How a hole is made, and how deep it is in hundredths.
    fn kind(&mut self) -> (CycleKind, i64) {
        let deep = self.chance.between(20, 400) * 10;
        let dwell = |maker: &mut Maker| maker.chance.percent(30).then(|| maker.seconds());
        let kind = match self.chance.between(0, 9) {
            0..=2 => CycleKind::Drill,
            3 => CycleKind::DrillDwell { dwell: self.seconds() },
            4..=5 => {
                let (peck, first, back) = self.strokes(deep);
                let settle = dwell(self);
                let (pause, dwell) = (dwell(self), dwell(self));
                CycleKind::DrillPeck {
                    peck,
                    first,
                    less: None,
                    clearance: Clearance::Stated(back),
                    pause,
                    settle,
                    dwell,
                }
            }
            6..=7 => {
                let (peck, first, back) = self.strokes(deep);
                let (pause, dwell) = (dwell(self), dwell(self));
                let lift_at_feed = self.chance.percent(40);
                let lift = Clearance::Stated(back);
                CycleKind::DrillBreak { peck, first, less: None, lift, lift_at_feed, pause, dwell }
            }
            _ => {
                let feed_out = self.chance.percent(30).then(|| self.feed());
                CycleKind::Bore { dwell: dwell(self), feed_out, to_level: false }
            }
        };
        (kind, deep)
    }

    /// Depth of a peck and of the first one, and how far above a bottom the next begins.
    fn strokes(&mut self, deep: i64) -> (Expr, Option<Expr>, Expr) {
        let peck = self.chance.between(deep / 8, deep * 3 / 4).max(4);
        let first = self.chance.percent(40).then(|| self.chance.between(deep / 6, deep * 3 / 4).max(4));
        let back = self.chance.between(1, peck.min(first.unwrap_or(peck)) / 2);
        let length = |n: i64| Expr::from(self.hundredths(n));
        (length(peck), first.map(length), length(back))
    }

    fn positions(&mut self, plain: bool) {
        let (first, second, _) = self.plane.axes();
        let least = if plain { 2 } else { 1 };
        for _ in 0..self.chance.between(least, 6) {
            let [x, y] = self.place();
            let mut to = Point::default();
            to.set(first, x);
            to.set(second, y);
            self.say(Op::Hole(Move { to, said: false }));
        }
    }

    /// Where a pattern begins, or its centre; where the tool stands only if that is a written place.
    fn start(&mut self) -> Option<[Coord; 2]> {
        let there = !self.written || self.chance.percent(60);
        there.then(|| self.place())
    }

    fn angle(&mut self, low: i64, high: i64) -> Num {
        let scale = self.chance.pick(&[0, 0, 0, 1, 2]);
        let tens = 10i64.pow(u32::from(scale));
        let mantissa = self.chance.between(low * tens, high * tens);
        Num { mantissa, scale, point: true, unit: Unit::Degree }.trimmed()
    }

    fn circle(&mut self) {
        let count = self.chance.between(3, 24);
        let exact = |n: i64| 360 * 10i64.pow(u32::from(self.decimals)) % n == 0;
        let whole = self.chance.percent(60) && (self.decimals > 3 || exact(count));
        let nano = 1_000_000_000;
        let step = if whole {
            Num { mantissa: (360 * nano + count / 2) / count, scale: 9, point: true, unit: Unit::Degree }
                .trimmed()
        } else {
            let least = 360 / count / 4;
            self.angle(least.max(2), (360 / count).max(3))
        };
        let turn = if self.chance.percent(50) { 1 } else { -1 };
        let step = Num { mantissa: step.mantissa * turn, ..step };
        let scale = self.digits();
        let radius = self.length(8, 90, scale);
        let centre = self.start();
        let angle = if self.chance.percent(50) {
            Num::int(self.chance.between(0, 11) * 30, Unit::Degree)
        } else {
            self.angle(0, 359)
        };
        let first = match &centre {
            // At a position: above the centre or beside it.
            Some([x, y]) if self.chance.percent(40) => {
                let sum = |c: &Coord| Coord { value: plus(&c.value, radius).into(), ..c.clone() };
                First::At(if self.chance.percent(50) { [sum(x), y.clone()] } else { [x.clone(), sum(y)] })
            }
            Some(_) | None => First::Polar { radius: radius.into(), angle: angle.into() },
        };
        let count = count as u32;
        self.say(Op::Pattern(Box::new(Pattern::Circle { centre, first, step: step.into(), count })));
    }

    fn line(&mut self) {
        let start = self.start();
        let angle = if self.chance.percent(50) {
            Num::int(self.chance.between(0, 3) * 90, Unit::Degree)
        } else {
            self.angle(0, 359)
        };
        let offset = if self.chance.percent(70) { self.hundredths(0) } else { self.length(1, 20, 1) };
        let scale = self.digits();
        let pitch = self.length(2, 40, scale);
        let count = self.chance.between(3, 12) as u32;
        self.say(Op::Pattern(Box::new(Pattern::Line {
            start,
            angle: angle.into(),
            offset: offset.into(),
            pitch: pitch.into(),
            count,
        })));
    }

    fn grid(&mut self) {
        let (first, second, _) = self.plane.axes();
        let start = self.start();
        let row = |maker: &mut Maker, along: Along| {
            let scale = maker.digits();
            let pitch = maker.length(3, 40, scale);
            let sign = if maker.chance.percent(70) { 1 } else { -1 };
            let pitch = Num { mantissa: pitch.mantissa * sign, ..pitch };
            Row { along, pitch: pitch.into(), count: maker.chance.between(2, 6) as u32 }
        };
        let (columns, rows) = match self.chance.between(0, 9) {
            0..=6 => (row(self, Along::Axis(first)), row(self, Along::Axis(second))),
            7..=8 => {
                let angle = self.angle(1, 89);
                let across =
                    Num { mantissa: angle.mantissa + 90 * 10i64.pow(u32::from(angle.scale)), ..angle };
                (row(self, Along::Angle(angle.into())), row(self, Along::Angle(across.into())))
            }
            _ => {
                let angle = self.angle(20, 160);
                (row(self, Along::Axis(first)), row(self, Along::Angle(angle.into())))
            }
        };
        let serpentine = self.chance.percent(50);
        self.say(Op::Pattern(Box::new(Pattern::Grid { start, columns, rows, serpentine })));
    }

    fn list(&mut self) {
        let (first, second, _) = self.plane.axes();
        let points = (0..self.chance.between(3, 8)).map(|_| {
            let [x, y] = self.place();
            let mut to = Point::default();
            to.set(first, x);
            to.set(second, y);
            to
        });
        let points = points.collect();
        self.say(Op::Pattern(Box::new(Pattern::List(points))));
    }
}

fn absolute(value: Num) -> Coord {
    ncc_ir::program::cycle::absolute(value)
}

/// The sum of two lengths of one unit.
fn plus(a: &Expr, b: Num) -> Num {
    let a = a.literal().unwrap_or(Num::int(0, b.unit));
    let scale = a.scale.max(b.scale);
    let at = |n: Num| n.mantissa * 10i64.pow(u32::from(scale - n.scale));
    Num { mantissa: at(a) + at(b), scale, point: true, unit: b.unit }.trimmed()
}
