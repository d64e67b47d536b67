//! Moves at random, at few levels and places: whatever is folded, the machine does the same.

use ncc_ir::canon::{Axis, Distance, Plane, Units};
use ncc_ir::caps::{CircleStart, ReturnsTo};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Approach, absolute};
use ncc_ir::program::{Move, Op, Point, Procedure, Program, Stmt};
use ncc_ir::source::Span;
use ncc_passes::Target;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::law::{apply, everything, same, structure};

/// Programs tried.
const CASES: u32 = 600;

fn mm(mantissa: i64) -> Num {
    Num { mantissa, scale: 0, point: true, unit: Unit::Mm }
}

fn to(words: &[(Axis, i64)]) -> Move {
    let mut to = Point::default();
    for (axis, at) in words {
        to.set(*axis, absolute(mm(*at)));
    }
    Move { to, said: true }
}

/// A statement; moves along Z are the most.
fn statement() -> impl Strategy<Value = Op> {
    let level = || select(&[-6i64, -4, -3, -1, 2, 2, 2, 5, 5][..]);
    let place = || select(&[0i64, 10, 20, 30][..]);
    prop_oneof![
        8 => level().prop_map(|z| Op::StraightTraverse(to(&[(Axis::Z, z)]))),
        8 => level().prop_map(|z| Op::StraightFeed(to(&[(Axis::Z, z)]))),
        4 => place().prop_map(|x| Op::StraightTraverse(to(&[(Axis::X, x)]))),
        3 => (place(), place()).prop_map(|(x, y)| Op::StraightTraverse(to(&[(Axis::X, x), (Axis::Y, y)]))),
        1 => (place(), level()).prop_map(|(x, z)| Op::StraightTraverse(to(&[(Axis::X, x), (Axis::Z, z)]))),
        1 => place().prop_map(|x| Op::StraightFeed(to(&[(Axis::X, x)]))),
        1 => Just(Op::Dwell(Num { mantissa: 5, scale: 1, point: true, unit: Unit::Second }.into())),
        2 => select(&[100i64, 200][..]).prop_map(|f| Op::SetFeedRate(mm(f).into())),
        1 => select(vec![Op::Comment("SO".into()), Op::FloodOn, Op::CoolantOff, Op::SetDistanceMode(Distance::Absolute)]),
        1 => place().prop_map(|x| Op::Position(to(&[(Axis::X, x)]))),
    ]
}

/// Something like a hole: aside, down, a cut or two, out.
fn hole() -> impl Strategy<Value = Vec<Op>> {
    let place = || select(&[0i64, 10, 20, 30][..]);
    let down = select(&[2i64, 2, 5][..]);
    let strokes = prop::collection::vec((select(&[-3i64, -4, -6][..]), select(&[2i64, 2, -1, 5][..])), 1..3);
    let back = prop::bool::weighted(0.3);
    (place(), down, strokes, back, select(&[2i64, 5][..])).prop_map(|(x, down, strokes, back, out)| {
        let rapid = |z| Op::StraightTraverse(to(&[(Axis::Z, z)]));
        let mut ops = vec![Op::StraightTraverse(to(&[(Axis::X, x)])), rapid(down)];
        for (bottom, up) in strokes {
            let cut = |z| Op::StraightFeed(to(&[(Axis::Z, z)]));
            ops.extend([cut(bottom), if back { cut(up) } else { rapid(up) }]);
        }
        ops.push(rapid(out));
        ops
    })
}

/// Some of it comes several times, as holes do.
fn program() -> impl Strategy<Value = Program> {
    let block = (statement(), prop::bool::weighted(0.02), prop::bool::weighted(0.1));
    let holes = hole().prop_map(|ops| ops.into_iter().map(|op| (op, false, false)).collect());
    let blocks = prop_oneof![prop::collection::vec(block, 1..7), holes];
    let piece = (blocks, 1usize..4);
    prop::collection::vec(piece, 1..10).prop_map(|pieces| {
        let start = [
            Op::UseLengthUnits(Units::Mm),
            Op::SetDistanceMode(Distance::Absolute),
            Op::SelectPlane(Plane::Xy),
            Op::SetFeedRate(mm(50).into()),
            Op::StraightTraverse(to(&[(Axis::X, 0), (Axis::Y, 0), (Axis::Z, 5)])),
        ];
        let mut body: Vec<Stmt> = start.into_iter().map(|op| Stmt::new(Span::default(), op)).collect();
        for (blocks, times) in pieces {
            for _ in 0..times {
                for (op, skipped, joined) in &blocks {
                    let mut stmt = Stmt::new(Span::default(), op.clone());
                    stmt.skip = skipped.then_some(2);
                    stmt.joined = *joined && !skipped && body.last().is_some_and(|last| last.skip.is_none());
                    body.push(stmt);
                }
            }
        }
        body.push(Stmt::new(Span::default(), Op::ProgramEnd));
        let main = Procedure { body, ..Procedure::default() };
        Program { procedures: vec![main], ..Program::default() }
    })
}

/// Targets that return to levels, that state planes, that raise first and begin patterns where the
/// tool stands.
fn targets() -> Vec<Target> {
    let all = everything(3);
    let mut planes = all.clone();
    planes.caps.holes.returns = ReturnsTo::Plane;
    planes.caps.holes.circle_start = CircleStart::Polar;
    let mut raises = all.clone();
    raises.caps.holes.approach = Some(Approach::RaiseFirst);
    raises.caps.holes.returns = ReturnsTo::Level;
    raises.caps.holes.pattern_start = false;
    raises.caps.holes.pattern_angle = false;
    raises.caps.holes.circle_start = CircleStart::Cartesian;
    raises.caps.holes.list_upto = 0;
    let mut retracts = raises.clone();
    retracts.caps.holes.approach = Some(Approach::RetractFirst);
    vec![all, planes, raises, retracts]
}

#[test]
fn whatever_is_folded_is_the_same() {
    let config = Config { cases: CASES, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let passes: [&[&str]; 3] =
        [&["fold-cycles", "fold-patterns"], &["drop-redundant"], &["drop-redundant", "fold-cycles"]];
    let folded = std::cell::Cell::new(0);
    let result = runner.run(&program(), |before| {
        let mut alone = before.clone();
        apply(&["fold-cycles"], &mut alone, &everything(3)).map_err(TestCaseError::fail)?;
        folded.set(folded.get() + u32::from(!structure(&alone).is_empty()));
        for target in targets() {
            for names in passes {
                let mut after = before.clone();
                apply(names, &mut after, &target).map_err(TestCaseError::fail)?;
                same(&before, &after, 3).map_err(|e| TestCaseError::fail(format!("{names:?}: {e}")))?;
            }
        }
        Ok(())
    });
    println!("{CASES} programs, of which {} had cycles folded", folded.get());
    assert!(folded.get() * 5 > CASES, "too few have holes");
    if let Err(fault) = result {
        panic!("{fault}");
    }
}
