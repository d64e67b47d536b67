//! The path of a tool's centre, judged by nothing but distances: contours of lines and arcs are made by
//! chance, the pass writes the path, and every point of it must be at the radius from the contour, on the
//! right side, and never nearer.
//!
//! The judge knows neither corners nor rules. Points are held against the leg that they belong to and its
//! neighbours: the pass does not promise more, as controls do not.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::sync::Arc as Shared;

use ncc_dialects::builtin;
use ncc_driver::job::Failure;
use ncc_ir::canon::{AXES, Distance, Fact, Modes, Plane, Side, Turn, Units};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::num::{Num, ONE, Unit};
use ncc_ir::program::{
    Arc, Centre, CentreFrom, Coord, CutterRadius, Move, Op, Point, Procedure, Program, Stmt, Turns,
};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_machines::Profile;
use ncc_passes::{Compensating, PASSES, Target};
use ncc_tests::expect::Failures;
use ncc_tests::{corpus, translate};

type Spot = [f64; 2];

/// How far a point may be off: the pass writes thousandths, and so are the contours written.
const OFF: f64 = 0.006;

/// A leg of a contour or of a path.
#[derive(Clone, Copy, Debug)]
struct Leg {
    from: Spot,
    to: Spot,
    /// Centre, and whether it goes counter-clockwise.
    about: Option<(Spot, bool)>,
}

fn distance(a: Spot, b: Spot) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn direction(from: Spot, to: Spot) -> f64 {
    (to[1] - from[1]).atan2(to[0] - from[0])
}

impl Leg {
    /// How far its arc turns, counter-clockwise positive.
    fn turns(&self, centre: Spot, ccw: bool) -> f64 {
        let by = direction(centre, self.to) - direction(centre, self.from);
        match ccw {
            true => by.rem_euclid(TAU),
            false => -((-by).rem_euclid(TAU)),
        }
    }

    /// The point at a part of its way.
    fn at(&self, part: f64) -> Spot {
        match self.about {
            None => [0, 1].map(|i| self.from[i] + part * (self.to[i] - self.from[i])),
            Some((centre, ccw)) => {
                let angle = direction(centre, self.from) + part * self.turns(centre, ccw);
                let first = distance(centre, self.from);
                let radius = first + part * (distance(centre, self.to) - first);
                [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
            }
        }
    }

    /// How near a point is.
    fn distance(&self, p: Spot) -> f64 {
        let ends = distance(p, self.from).min(distance(p, self.to));
        match self.about {
            None => {
                let (way, off) =
                    ([0, 1].map(|i| self.to[i] - self.from[i]), [0, 1].map(|i| p[i] - self.from[i]));
                let length = way[0].hypot(way[1]);
                let along = (way[0] * off[0] + way[1] * off[1]) / length;
                let aside = (way[0] * off[1] - way[1] * off[0]) / length;
                if (0.0..=length).contains(&along) { aside.abs() } else { ends }
            }
            Some((centre, ccw)) => {
                let toward = direction(centre, p) - direction(centre, self.from);
                let toward = if ccw { toward } else { -toward }.rem_euclid(TAU);
                let within = toward <= self.turns(centre, ccw).abs();
                let radius = distance(centre, self.from);
                if within { (distance(centre, p) - radius).abs().min(ends) } else { ends }
            }
        }
    }

    /// Whether a point is on its left.
    fn has_on_left(&self, p: Spot) -> bool {
        match self.about {
            None => {
                let (way, off) =
                    ([0, 1].map(|i| self.to[i] - self.from[i]), [0, 1].map(|i| p[i] - self.from[i]));
                way[0] * off[1] - way[1] * off[0] > 0.0
            }
            Some((centre, ccw)) => (distance(centre, p) < distance(centre, self.from)) == ccw,
        }
    }
}

/// A contour made by chance, its first leg the way onto it. `away` has it turn from the tool only.
fn contour(chance: &mut fastrand::Rng, left: bool, away: bool) -> Vec<Leg> {
    let round = |p: Spot| p.map(|v| (v * 1000.0).round() / 1000.0);
    let mut at = round([chance.f64() * 20.0, chance.f64() * 20.0]);
    let mut heading = chance.f64() * TAU;
    let start = round([at[0] - 60.0 * heading.cos(), at[1] - 60.0 * heading.sin()]);
    let mut legs = vec![Leg { from: start, to: at, about: None }];
    for _ in 0..chance.usize(2..9) {
        // Not so far towards the tool that the legs beside each other meet again.
        let most = if away { 0.0 } else { 1.3 };
        let turn = match chance.usize(0..5) {
            // Legs that go on in one direction.
            0 => 0.0,
            _ => -2.0 + chance.f64() * (2.0 + most),
        };
        heading += if left { turn } else { -turn };
        let (to, about) = if chance.bool() {
            let length = 12.0 + chance.f64() * 40.0;
            (round([at[0] + length * heading.cos(), at[1] + length * heading.sin()]), None)
        } else {
            let ccw = if away { !left } else { chance.bool() };
            let (radius, by) = (9.0 + chance.f64() * 30.0, 0.4 + chance.f64() * 0.8);
            let side = if ccw { PI / 2.0 } else { -PI / 2.0 };
            let centre =
                round([at[0] + radius * (heading + side).cos(), at[1] + radius * (heading + side).sin()]);
            let end = direction(centre, at) + if ccw { by } else { -by };
            let radius = distance(centre, at);
            heading += if ccw { by } else { -by };
            let to = round([centre[0] + radius * end.cos(), centre[1] + radius * end.sin()]);
            (to, Some((centre, ccw)))
        };
        legs.push(Leg { from: at, to, about });
        at = to;
    }
    legs
}

fn number(mm: f64) -> Num {
    Num::from_nanos((mm * 1000.0).round() as i64 * (ONE / 1000), 9, Unit::Mm)
}

fn point(to: Spot) -> Point {
    let mut point = Point::default();
    for (axis, mm) in to.into_iter().enumerate() {
        point.axes[axis] =
            Some(Coord { value: number(mm).into(), distance: Fact::Known(Distance::Absolute) });
    }
    point
}

/// The program of a contour; each leg is at the place of its number.
fn program(legs: &[Leg], side: Side, diameter: f64) -> Program {
    let radius = CutterRadius::Diameter(number(diameter).into());
    let mut body = vec![Stmt::new(Span::new(0, 0), Op::StartCutterRadiusCompensation { side, radius })];
    for (at, leg) in legs.iter().enumerate() {
        let op = match leg.about {
            None => Op::StraightFeed(Move { to: point(leg.to), said: true }),
            Some((centre, ccw)) => {
                let words = [Some(number(centre[0]).into()), Some(number(centre[1]).into()), None];
                Op::ArcFeed(Box::new(Arc {
                    plane: Fact::Known(Plane::Xy),
                    turn: if ccw { Turn::Counterclockwise } else { Turn::Clockwise },
                    to: point(leg.to),
                    centre: Centre::Point { words, from: CentreFrom::Zero },
                    turns: Turns::NONE,
                    said: true,
                }))
            }
        };
        body.push(Stmt::new(Span::new(at as u32, at as u32 + 1), op));
    }
    body.push(Stmt::new(Span::new(0, 0), Op::StopCutterRadiusCompensation));
    Program { procedures: vec![Procedure { body, ..Procedure::default() }], ..Program::default() }
}

/// The path that the pass writes: legs with the number of the contour's leg that they belong to.
fn path(legs: &[Leg], side: Side, diameter: f64) -> Result<Vec<(usize, Leg)>, Diagnostic> {
    let mut program = program(legs, side, diameter);
    let modes = Modes {
        units: Some(Units::Mm),
        plane: Some(Plane::Xy),
        distance: Some(Distance::Absolute),
        ..Modes::default()
    };
    let mut position = [Some(0); AXES];
    for (axis, mm) in legs[0].from.into_iter().enumerate() {
        position[axis] = number(mm).nanos(false);
    }
    let mut at = Tracker { position, ..Tracker::new(modes) };
    let target = Target { decimals: 3, compensating: Compensating::default(), ..Target::default() };
    let pass = PASSES.iter().find(|pass| pass.name == "expand-compensation").expect("the pass");
    let mut found = Vec::new();
    pass.alone.expect("a pass that runs alone")(&mut program, &target, &at, &mut found);
    if let Some(refused) = found.into_iter().find(|d| d.fault.gravity() == Gravity::Error) {
        return Err(refused);
    }
    let here = |at: &Tracker| [0, 1].map(|axis| at.position[axis].expect("known") as f64 / ONE as f64);
    let mut path = Vec::new();
    for stmt in &program.procedures[0].body {
        let (from, centre) = (
            here(&at),
            match &stmt.op {
                Op::ArcFeed(arc) => {
                    let centre = at.centre(arc).expect("a centre").map(|c| c as f64 / ONE as f64);
                    Some((centre, arc.turn == Turn::Counterclockwise))
                }
                _ => None,
            },
        );
        at.apply(&stmt.op);
        path.push((stmt.span.start as usize, Leg { from, to: here(&at), about: centre }));
    }
    Ok(path)
}

/// What is wrong with a path, if anything.
fn judged(legs: &[Leg], path: &[(usize, Leg)], left: bool, radius: f64) -> Result<(), String> {
    for (own, leg) in path.iter().filter(|(own, _)| *own > 0) {
        let near = &legs[own.saturating_sub(1).max(1)..(own + 2).min(legs.len())];
        for step in 0..=40 {
            let p = leg.at(f64::from(step) / 40.0);
            let nearest = near.iter().map(|leg| leg.distance(p)).fold(f64::MAX, f64::min);
            if (nearest - radius).abs() > OFF {
                return Err(format!("leg {own}, {leg:?}: {p:?} is {nearest} away and not {radius}"));
            }
            // Beside the leg itself, and not before its beginning or behind its end.
            let beside = legs[*own].distance(p) < radius + OFF;
            let ends = distance(p, legs[*own].from).min(distance(p, legs[*own].to)) < radius + OFF;
            if beside && !ends && legs[*own].has_on_left(p) != left {
                return Err(format!("leg {own}, {leg:?}: {p:?} is on the wrong side"));
            }
        }
    }
    Ok(())
}

#[test]
fn every_point_of_the_path_is_at_the_radius() {
    let (mut made, mut refused) = (0, 0);
    for seed in 0..4000 {
        let mut chance = fastrand::Rng::with_seed(seed);
        let (left, away) = (chance.bool(), seed % 4 == 0);
        let legs = contour(&mut chance, left, away);
        let radius = 0.5 + (chance.f64() * 40.0).round() / 10.0;
        let side = if left { Side::Left } else { Side::Right };
        match path(&legs, side, 2.0 * radius) {
            Ok(path) => {
                made += 1;
                // The way onto the contour ends beside its end, at the radius.
                let entry = path.first().expect("a way onto the contour").1;
                let ends = legs[0].distance(entry.to);
                assert!(ends > radius - OFF || path.len() > 1, "seed {seed}: {entry:?}");
                if let Err(wrong) = judged(&legs, &path, left, radius) {
                    panic!("seed {seed}, {side:?} by {radius}: {wrong}\n{legs:#?}\n{path:#?}");
                }
            }
            Err(why) => {
                assert!(matches!(why.fault, Fault::ContourUnreachable { .. }), "seed {seed}: {why:?}");
                assert!(!away, "seed {seed}, {side:?} by {radius}: {why:?}\n{legs:#?}");
                refused += 1;
            }
        }
    }
    println!("{made} paths judged, {refused} contours refused");
    assert!(made > 2 * refused, "{made} paths, {refused} refused");
}

/// A machine on which every tool has a diameter.
fn machine(dialect: &str) -> Shared<Profile> {
    let tools: String = (1..100).map(|n| format!("[[tool]]\nnumber = {n}\ndiameter = 6\n")).collect();
    let text = format!("id = \"shop\"\ntitle = \"\"\ndialect = \"{dialect}\"\n{tools}");
    Shared::new(Profile::parse(&text, &builtin).expect("a profile"))
}

/// Every contour of the corpus, worked out for every dialect: verified, or refused for a reason that is
/// listed here.
#[test]
fn contours_of_the_corpus_are_worked_out_for_every_dialect() {
    let pass = PASSES.iter().find(|pass| pass.name == "expand-compensation").expect("the pass");
    let (mut released, mut refused, mut failures) = (0, BTreeMap::new(), Failures::default());
    for from in ["mach9", "fanuc", "haas", "siemens", "linuxcnc", "canon", "ir"] {
        for program in corpus::of(from) {
            if !program.file.contains("compensation") {
                continue;
            }
            for to in ["mach9", "fanuc", "haas", "siemens", "linuxcnc", "canon", "ir"] {
                let mut job = translate::job(from, to, &program.file);
                job.passes = vec![pass];
                job.head = false;
                job.machines.from = Some(machine(from));
                let (outcome, text) = translate::translate(&job, &program.text);
                let codes = translate::stopping(&job, &outcome);
                match outcome.release {
                    Ok(()) => {
                        released += 1;
                        let text = String::from_utf8_lossy(&text);
                        let left = ["G41", "G42", "START_CUTTER"].iter().any(|code| text.contains(code));
                        if left || outcome.verified.is_none_or(|v| v.events == 0) {
                            failures.add(format!("{} to {to}", program.file), text.into_owned());
                        }
                    }
                    Err(Failure::Refused) => _ = refused.insert(format!("{} to {to}", program.file), codes),
                    Err(Failure::VerificationFailed) => {
                        let mut why = outcome.diagnostics.iter().map(|d| format!("{:?}", d.fault));
                        failures
                            .add(format!("{} to {to}", program.file), why.next_back().unwrap_or_default());
                    }
                }
            }
        }
    }
    println!("{released} released; refused: {refused:#?}");
    failures.finish();
    assert!(released >= 40, "{released} released, {refused:?}");
}
