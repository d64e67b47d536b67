//! A law: whatever the legaliser makes of a program, the machine does the same.
//!
//! Programs are generated: moves, cycles of every kind, holes, patterns, offsets and arcs, absolute
//! and incremental, some blocks under a skip level. They are legalised for targets that can say
//! much, little and nothing, as a whole and block by block, and executed before and after.

use ncc_ir::canon::{Axis, Distance, Fact, FeedMode, Modes, Plane, ReturnLevel, Turn, Units};
use ncc_ir::caps::{Caps, LengthsOf};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, ONE, Unit};
use ncc_ir::program::cycle::{Along, Approach, Clearance, Cycle, CycleKind, First, Pattern, Row};
use ncc_ir::program::{
    Arc, ArcForm, Centre, CentreFrom, Coord, Frame, FrameSlot, FrameStep, Move, Op, Point, Procedure,
    Program, RepeatBlocks, Shape, Slot, Stmt,
};
use ncc_ir::source::Span;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, TestError, TestRng, TestRunner};

use super::{Told, apply, builtin, in_pieces, refused, same_events};

fn mm(tenths: i64) -> Num {
    Num { mantissa: tenths, scale: 1, point: true, unit: Unit::Mm }
}

fn coord(low: i64, high: i64) -> impl Strategy<Value = Coord> {
    (low..high, prop::bool::weighted(0.3)).prop_map(|(tenths, incremental)| Coord {
        value: mm(tenths).into(),
        distance: Fact::Known(if incremental { Distance::Incremental } else { Distance::Absolute }),
    })
}

fn point(axes: &'static [Axis]) -> impl Strategy<Value = Move> {
    let words = prop::collection::vec((select(axes), coord(-300, 300)), 1..=axes.len());
    (words, any::<bool>()).prop_map(|(words, said)| {
        let mut to = Point::default();
        for (axis, word) in words {
            to.set(axis, word);
        }
        Move { to, said }
    })
}

fn seconds() -> impl Strategy<Value = Expr> {
    (1i64..30).prop_map(|t| Num { mantissa: t, scale: 1, point: true, unit: Unit::Second }.into())
}

fn kind() -> impl Strategy<Value = CycleKind> {
    let clearance =
        || prop_oneof![Just(Clearance::Parameter), (1i64..20).prop_map(|t| Clearance::Stated(mm(t).into()))];
    let pause = || prop::option::of(seconds());
    let first = || prop::option::of((5i64..90).prop_map(|t| Expr::from(mm(t))));
    let less = || prop::option::of((0i64..20).prop_map(|t| Expr::from(mm(t))));
    prop_oneof![
        3 => Just(CycleKind::Drill),
        1 => seconds().prop_map(|dwell| CycleKind::DrillDwell { dwell }),
        1 => (10i64..80, clearance(), first(), less(), [pause(), pause(), pause()]).prop_map(
            |(peck, clearance, first, less, [pause, settle, dwell])| {
                let first = if less.is_some() { Some(mm(peck + 7).into()) } else { first };
                CycleKind::DrillPeck { peck: mm(peck).into(), first, less, clearance, pause, settle, dwell }
            }
        ),
        1 => (10i64..80, clearance(), first(), less(), [pause(), pause()], any::<bool>()).prop_map(
            |(peck, lift, first, less, [pause, dwell], lift_at_feed)| {
                let first = if less.is_some() { Some(mm(peck + 7).into()) } else { first };
                CycleKind::DrillBreak { peck: mm(peck).into(), first, less, lift, lift_at_feed, pause, dwell }
            }
        ),
        1 => (pause(), prop::option::of(100i64..900), any::<bool>()).prop_map(|(dwell, out, to_level)| {
            CycleKind::Bore { dwell, feed_out: out.map(|f| mm(f).into()), to_level }
        }),
    ]
}

fn cycle() -> impl Strategy<Value = Op> {
    let level = prop_oneof![Just(ReturnLevel::Initial), Just(ReturnLevel::Retract)];
    let approach = proptest::sample::select(Approach::ALL.to_vec());
    let plane = prop_oneof![8 => Just(Plane::Xy), 1 => Just(Plane::Zx), 1 => Just(Plane::Yz)];
    let feed = prop::option::of((100i64..3000).prop_map(|f| Expr::from(mm(f))));
    let planes = prop::option::weighted(0.3, coord(0, 300));
    (kind(), plane, coord(-100, 100), 1i64..200, any::<bool>(), (level, planes), approach, feed).prop_map(
        |(kind, plane, retract, below, incremental, (level, return_plane), approach, feed)| {
            let (tenths, distance) = match (&retract.value, retract.distance, incremental) {
                (Expr::Num(n), Fact::Known(Distance::Absolute), false) => {
                    (n.mantissa - below, Distance::Absolute)
                }
                _ => (-below, Distance::Incremental),
            };
            let depth = Coord { value: mm(tenths).into(), distance: Fact::Known(distance) };
            Op::StartCycle(Box::new(Cycle {
                kind,
                plane: Fact::Known(plane),
                retract,
                reference: None,
                depth,
                return_level: Fact::Known(level),
                return_plane,
                approach,
                feed,
            }))
        },
    )
}

fn pattern() -> impl Strategy<Value = Op> {
    let pair = || (coord(-200, 200), coord(-200, 200)).prop_map(|(a, b)| [a, b]);
    let degrees = |d: i64| Expr::from(Num::int(d, Unit::Degree));
    let circle = (prop::option::of(pair()), pair(), -180i64..180, 1u32..6).prop_map(
        move |(centre, first, step, count)| Pattern::Circle {
            centre,
            first: First::At(first),
            step: degrees(step),
            count,
        },
    );
    let polar = (prop::option::of(pair()), 1i64..200, [-180i64..180, -180i64..180], 1u32..6).prop_map(
        move |(centre, radius, [angle, step], count)| Pattern::Circle {
            centre,
            first: First::Polar { radius: mm(radius).into(), angle: degrees(angle) },
            step: degrees(step),
            count,
        },
    );
    let line = (prop::option::of(pair()), -180i64..180, [0i64..50, -50i64..50], 1u32..6).prop_map(
        move |(start, angle, [offset, pitch], count)| Pattern::Line {
            start,
            angle: degrees(angle),
            offset: mm(offset).into(),
            pitch: mm(pitch).into(),
            count,
        },
    );
    let list = prop::collection::vec(pair(), 1..5).prop_map(|pairs| {
        let point = |[x, y]: [Coord; 2]| {
            let mut to = Point::default();
            to.set(Axis::X, x);
            to.set(Axis::Y, y);
            to
        };
        Pattern::List(pairs.into_iter().map(point).collect())
    });
    let grid =
        (-50i64..50, 1u32..4, -50i64..50, 1u32..4, any::<bool>(), prop::option::of(pair()), -90i64..90)
            .prop_map(move |(x, nx, y, ny, serpentine, start, angle)| Pattern::Grid {
                start,
                columns: Row { along: Along::Axis(Axis::X), pitch: mm(x).into(), count: nx },
                rows: Row {
                    along: if angle < 0 { Along::Axis(Axis::Y) } else { Along::Angle(degrees(angle)) },
                    pitch: mm(y).into(),
                    count: ny,
                },
                serpentine,
            });
    prop_oneof![circle, polar, line, list, grid].prop_map(|p| Op::Pattern(Box::new(p)))
}

/// A half circle, flat or as a helix, with whole turns before.
fn arc() -> impl Strategy<Value = Op> {
    (1i64..100, any::<bool>(), prop::option::of(coord(-50, 50)), 0u32..3).prop_map(
        |(radius, cw, z, turns)| {
            let mut to = Point::default();
            let distance = Fact::Known(Distance::Incremental);
            to.set(Axis::X, Coord { value: mm(2 * radius).into(), distance });
            if let Some(z) = z {
                to.set(Axis::Z, z);
            }
            Op::ArcFeed(Box::new(Arc {
                plane: Fact::Known(Plane::Xy),
                turn: if cw { Turn::Clockwise } else { Turn::Counterclockwise },
                to,
                centre: Centre::Point {
                    words: [Some(mm(radius).into()), None, None],
                    from: CentreFrom::Start,
                },
                turns: turns.into(),
                said: true,
            }))
        },
    )
}

/// An arc in another form.
fn arc_form() -> impl Strategy<Value = Op> {
    let turn = || any::<bool>().prop_map(|cw| if cw { Turn::Clockwise } else { Turn::Counterclockwise });
    let degrees = |d: i64| Expr::from(Num::int(d, Unit::Degree));
    let about = || [prop::option::of(coord(-100, 100)), prop::option::of(coord(-100, 100))];
    let centre = |[i, j]: [Option<Coord>; 2]| Box::new([i, j, None]);
    let shape = prop_oneof![
        (turn(), 1i64..359).prop_map(move |(turn, a)| Shape::Angle { turn, angle: degrees(a) }),
        (turn(), 1i64..359, about()).prop_map(move |(turn, a, c)| {
            Shape::AngleAbout { turn, angle: degrees(a), centre: centre(c) }
        }),
        (turn(), about()).prop_map(move |(turn, c)| Shape::Mixed { turn, centre: centre(c) }),
        point(&[Axis::X, Axis::Y]).prop_map(|m| Shape::Through(Box::new(m.to))),
        Just(Shape::Tangent),
    ];
    let to = (point(&[Axis::X, Axis::Y]), prop::option::of(coord(-50, 50)), any::<bool>());
    (shape, to, 0u32..2).prop_map(|(shape, (m, z, end), turns)| {
        let ends = end && !matches!(shape, Shape::AngleAbout { .. } | Shape::Mixed { .. });
        let mut to = if ends { m.to } else { Point::default() };
        if let (Some(z), false) = (z, matches!(shape, Shape::Through(_))) {
            to.set(Axis::Z, z);
        }
        Op::ArcForm(Box::new(ArcForm { plane: Fact::Known(Plane::Xy), to, shape, turns, said: true }))
    })
}

/// A step of the chain of frames, or its end.
fn frame() -> impl Strategy<Value = Op> {
    let length = || prop::option::of((-300i64..300).prop_map(|t| Expr::from(mm(t))));
    let factor = || {
        let tenths = prop_oneof![Just(5i64), Just(20), Just(13)];
        prop::option::of(tenths.prop_map(|t| Num { unit: Unit::One, ..mm(t) }.into()))
    };
    let angle = prop_oneof![3 => -180i64..180, 2 => select(&[0i64, 90, 180, -90][..])];
    let step = prop_oneof![
        3 => [length(), length(), length()].prop_map(|[x, y, z]| {
            FrameStep::Translate(Box::new([x, y, z, None, None, None]))
        }),
        2 => angle.prop_map(|a| FrameStep::Rotate {
            plane: Fact::Known(Plane::Xy),
            angle: Num::int(a, Unit::Degree).into(),
        }),
        1 => factor().prop_map(|f| FrameStep::Scale(Box::new([f.clone(), f, None]))),
        1 => [factor(), factor(), factor()].prop_map(|f| FrameStep::Scale(Box::new(f))),
        1 => [any::<bool>(), any::<bool>()].prop_map(|[x, y]| FrameStep::Mirror([x, y, false])),
    ];
    let set = (step, any::<bool>()).prop_map(|(step, added)| Op::SetFrame(Box::new(Frame { added, step })));
    let slots =
        vec![FrameSlot::Chain, FrameSlot::Local, FrameSlot::Rotation, FrameSlot::Scale, FrameSlot::Mirror];
    prop_oneof![3 => set, 3 => slot(), 2 => select(slots).prop_map(Op::ClearFrame)]
}

/// What fills a slot of the coordinate chain.
fn slot() -> impl Strategy<Value = Op> {
    let length = || prop::option::of((-300i64..300).prop_map(|t| Expr::from(mm(t))));
    let words = move || [length(), length(), length()];
    let factor = || {
        let tenths = prop_oneof![Just(5i64), Just(20), Just(13)];
        prop::option::of(tenths.prop_map(|t| Num { unit: Unit::One, ..mm(t) }.into()))
    };
    let shift = |axes: [Option<Expr>; 3]| {
        let [x, y, z] = axes;
        Box::new([x, y, z, None, None, None])
    };
    let angle = prop_oneof![3 => -180i64..180, 2 => select(&[0i64, 90, 180, -90][..])];
    let slot = prop_oneof![
        3 => words().prop_map(move |axes| Slot::Shift { origin: false, axes: shift(axes) }),
        3 => (words(), angle).prop_map(|(centre, angle)| Slot::Rotation {
            plane: Fact::Known(Plane::Xy),
            centre: Box::new(centre),
            angle: Coord {
                value: Num::int(angle, Unit::Degree).into(),
                distance: Fact::Known(Distance::Absolute),
            },
        }),
        1 => (words(), factor()).prop_map(|(centre, f)| Slot::Scale {
            centre: Box::new(centre),
            factors: Box::new([f.clone(), f, None]),
        }),
        1 => words().prop_map(|lines| Slot::Mirror(Box::new(lines))),
        1 => any::<[bool; 2]>().prop_map(|[x, y]| Slot::NoMirror([x, y, false])),
    ];
    let position = words().prop_map(move |axes| Op::SetPosition(shift(axes)));
    let aside = any::<bool>().prop_map(Op::UseOriginShift);
    prop_oneof![15 => slot.prop_map(|slot| Op::SetSlot(Box::new(slot))), 3 => position, 2 => aside]
}

/// Statements that stand together.
fn ops() -> impl Strategy<Value = Vec<Op>> {
    let raw = point(&[Axis::X, Axis::Y, Axis::Z]).prop_map(|mut m| {
        for word in m.to.axes.iter_mut().flatten() {
            word.distance = Fact::Known(Distance::Absolute);
        }
        vec![Op::UseMachineCoordinates { length: true }, Op::StraightTraverse(m)]
    });
    prop_oneof![30 => op().prop_map(|op| vec![op]), 1 => raw]
}

fn op() -> impl Strategy<Value = Op> {
    const ALL: &[Axis] = &[Axis::X, Axis::Y, Axis::Z];
    const ASIDE: &[Axis] = &[Axis::X, Axis::Y];
    prop_oneof![
        3 => point(ALL).prop_map(Op::StraightTraverse),
        2 => point(ALL).prop_map(Op::StraightFeed),
        4 => cycle(),
        8 => point(ASIDE).prop_map(Op::Hole),
        2 => pattern(),
        1 => Just(Op::EndCycle),
        1 => (0i64..4).prop_map(|n| Op::UseToolLengthOffset(Expr::int(n))),
        1 => (0i64..2).prop_map(|n| Op::UseToolEdge { edge: Expr::int(n), said: true }),
        1 => (1i64..4).prop_map(|n| Op::SelectTool(Expr::int(n))),
        1 => Just(Op::ChangeTool),
        1 => (100i64..3000).prop_map(|f| Op::SetFeedRate(mm(f).into())),
        1 => arc(),
        1 => arc_form(),
        1 => frame(),
        1 => Just(Op::StartSpindleClockwise),
        1 => Just(Op::Comment("A COMMENT".into())),
    ]
}

fn program() -> impl Strategy<Value = Program> {
    let skip = prop_oneof![8 => Just(None), 1 => Just(Some(1)), 1 => Just(Some(2))];
    let block = (prop::collection::vec(ops(), 1..3), skip, prop::option::of(1u32..999), any::<bool>());
    let again = prop::option::weighted(0.1, (0usize..14, 1usize..14, 1u32..3));
    (prop::collection::vec(block, 1..14), again).prop_map(|(blocks, again)| {
        let first = [Op::SetFeedRate(mm(1000).into()), Op::SelectTool(Expr::int(1))]
            .map(|op| Stmt::new(Span::default(), op));
        let mut body = Vec::from(first);
        let count = blocks.len();
        for (k, (ops, skip, number, comment)) in blocks.into_iter().enumerate() {
            if let Some((from, length, times)) = again {
                let (from, to) = (from % count, (from % count + length).min(count - 1));
                let repeat = || RepeatBlocks { from: "A".into(), to: None, times: Expr::int(times.into()) };
                let marks = [(from, Op::Label("A".into())), (to, Op::RepeatBlocks(Box::new(repeat())))];
                let here = marks.into_iter().filter(|(at, _)| *at == k && from < to);
                body.extend(here.map(|(_, op)| Stmt::new(Span::default(), op)));
            }
            let ops: Vec<Op> = ops.into_iter().flatten().collect();
            let last = ops.len() - 1;
            for (at, op) in ops.into_iter().enumerate() {
                let mut stmt = Stmt::new(Span::default(), op);
                stmt.skip = skip;
                stmt.joined = at > 0;
                stmt.number = number.filter(|_| at == 0);
                stmt.comment = (comment && at == last).then(|| Box::new("REMARK".into()));
                body.push(stmt);
            }
        }
        body.push(Stmt::new(Span::default(), Op::ProgramEnd));
        let assumed = Modes {
            distance: Some(Distance::Absolute),
            units: Some(Units::Mm),
            plane: Some(Plane::Xy),
            feed_mode: Some(FeedMode::PerMinute),
            work_offset: Some(1),
            length_offset: Some(0),
            ..Modes::default()
        };
        let procedures = vec![Procedure { body, ..Procedure::default() }];
        Program { assumed, procedures, ..Program::default() }
    })
}

/// Blocks are whole: the first statement of each is not joined, the others are under its skip level,
/// a comment stands last.
fn well_formed(body: &[Stmt]) -> Result<(), String> {
    for (at, pair) in body.windows(2).enumerate() {
        let [a, b] = pair else { continue };
        if b.joined && a.skip != b.skip {
            return Err(format!("statement {at}: one block under two skip levels"));
        }
        if b.joined && (b.number.is_some() || a.comment.is_some()) {
            return Err(format!("statement {at}: a number or comment in the midst of a block"));
        }
    }
    match body.first() {
        Some(first) if first.joined => Err("the first statement is joined to nothing".into()),
        _ => Ok(()),
    }
}

/// A program as a control reads it of which a tool change makes edge 1 active, unless its block names
/// another.
fn as_read_back(mut program: Program, caps: &Caps) -> Program {
    if caps.tools.lengths_of != LengthsOf::Edges {
        return program;
    }
    for procedure in &mut program.procedures {
        let mut at = 0;
        while at < procedure.body.len() {
            let block = 1 + procedure.body[at + 1..].iter().take_while(|s| s.joined).count();
            let names = |s: &Stmt| matches!(s.op, Op::UseToolEdge { .. });
            if procedure.body[at].op == Op::ChangeTool && !procedure.body[at..at + block].iter().any(names) {
                let change = &mut procedure.body[at];
                let mut edge = Stmt::new(change.span, Op::UseToolEdge { edge: Expr::int(1), said: false });
                (edge.skip, edge.joined, edge.comment) = (change.skip, true, change.comment.take());
                procedure.body.insert(at + 1, edge);
            }
            at += 1;
        }
    }
    program
}

#[test]
fn the_machine_does_the_same() {
    let mut targets =
        ["canon", "mach9", "fanuc", "siemens", "siemens"].map(|id| (id, builtin(id).unwrap().caps.clone()));
    targets[4].1.frames.chain = false;
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(2000);
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 20_000, ..Config::default() };
    let counts = std::cell::RefCell::new([[0u32; 2]; 5]);
    let start = prop_oneof![3 => Just([Some(0), Some(0), Some(20 * ONE)]), 1 => Just([None; 3])];
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(Default::default()))
        .run(&(program(), start), |(program, start)| {
            for (at, (id, caps)) in targets.iter().enumerate() {
                let mut told = Told {
                    target: super::Target {
                        caps: caps.clone(),
                        decimals: 3,
                        peck_clearance: Some(mm(10)),
                        break_lift: Some(mm(7)),
                        ..super::Target::default()
                    },
                    start: [None; 6],
                    maps: super::Maps::default(),
                    beside: false,
                };
                told.start[..3].copy_from_slice(&start);
                // What the source's own control could not execute proves nothing.
                if same_events(&program, &program, &told).is_err() {
                    continue;
                }
                counts.borrow_mut()[at][0] += 1;
                let mut after = program.clone();
                let diags = apply("legaliser", &mut after, &told).map_err(TestCaseError::fail)?;
                if refused(&diags) {
                    continue;
                }
                counts.borrow_mut()[at][1] += 1;
                let show = |e: String| {
                    let text = super::write(&program).unwrap_or_default();
                    let made = super::write(&after).unwrap_or_default();
                    TestCaseError::fail(format!("{id}: {e}\n{text}---\n{made}"))
                };
                well_formed(&after.procedures[0].body).map_err(show)?;
                let read = as_read_back(after.clone(), caps);
                same_events(&program, &read, &told).map_err(show)?;
                // Less is known of a piece than of the whole: more may be refused.
                let repeats = |s: &Stmt| matches!(s.op, Op::RepeatBlocks(_));
                if program.procedures[0].body.iter().any(repeats) {
                    // Such a program is kept whole.
                    continue;
                }
                let Some(pieces) = in_pieces(&program, &told) else { continue };
                well_formed(&pieces.procedures[0].body).map_err(show)?;
                let pieces = as_read_back(pieces, caps);
                same_events(&program, &pieces, &told).map_err(show)?;
            }
            Ok(())
        })
        .unwrap_or_else(|e| match e {
            // The program is in the reason, as text.
            TestError::Fail(reason, _) | TestError::Abort(reason) => panic!("{reason}"),
        });
    // A law that refuses everything is none.
    let counts = counts.into_inner();
    let [tried, said] = [0, 1].map(|i| counts.iter().map(|c| c[i]).sum::<u32>());
    assert!(said * 4 > tried && said > cases / 4, "of {counts:?} programs could be said");
    for ((id, _), [tried, said]) in targets.iter().zip(counts) {
        assert!(said * 20 > tried, "{id}: {said} of {tried} programs could be said");
    }
}
