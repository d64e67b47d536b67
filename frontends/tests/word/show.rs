//! A short rendering of statements for tests. `X1.5` is absolute, `X+=1.5` incremental, `X?1.5`
//! whatever is active; a unit stands after a number unless it is millimetres or a pure number.

use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Along, Clearance, Cycle, CycleKind, First, Pattern};
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Move, Op, Point, Stmt};

pub(super) fn stmt(stmt: &Stmt) -> String {
    let mut line = String::new();
    if stmt.joined {
        line += "& ";
    }
    if let Some(level) = stmt.skip {
        line += &format!("/{level} ");
    }
    if let Some(number) = stmt.number {
        line += &format!("N{number} ");
    }
    line += &op(&stmt.op);
    if let Some(comment) = &stmt.comment {
        line += &format!(" ({comment})");
    }
    line
}

fn op(op: &Op) -> String {
    match op {
        Op::Comment(text) => format!("({text})"),
        Op::StraightTraverse(m) => format!("TRAVERSE{}", movement(m)),
        Op::StraightFeed(m) => format!("FEED{}", movement(m)),
        Op::Position(m) => format!("POSITION{}", movement(m)),
        Op::Hole(m) => format!("HOLE{}", movement(m)),
        Op::ArcFeed(a) => arc(a),
        Op::StartCycle(c) => cycle(c),
        Op::Pattern(p) => pattern(p),
        Op::SetFeedRate(e) => format!("F{}", expr(e)),
        Op::SetSpindleSpeed(e) => format!("S{}", expr(e)),
        Op::SelectTool(e) => format!("T{}", expr(e)),
        Op::UseToolLengthOffset(e) => format!("LENGTH {}", expr(e)),
        Op::Dwell(e) => format!("DWELL {}", expr(e)),
        Op::Call(c) => format!("CALL {} x{}", c.name, c.times),
        other => format!("{other:?}"),
    }
}

fn movement(m: &Move) -> String {
    format!("{}{}", if m.said { "!" } else { "" }, point(&m.to))
}

fn point(p: &Point) -> String {
    let words = Axis::ALL.iter().filter_map(|&a| Some((a, p.get(a)?)));
    words.map(|(a, c)| format!(" {}{}", char::from(a.letter()), coord(c))).collect()
}

fn coord(c: &Coord) -> String {
    let mark = match c.distance {
        Fact::Known(Distance::Absolute) => "",
        Fact::Known(Distance::Incremental) => "+=",
        Fact::Entry => "?",
    };
    format!("{mark}{}", expr(&c.value))
}

fn expr(e: &Expr) -> String {
    e.literal().map_or_else(|| format!("{e:?}"), number)
}

fn number(n: Num) -> String {
    let sign = if n.mantissa < 0 { "-" } else { "" };
    let digits = format!("{:0width$}", n.mantissa.unsigned_abs(), width = usize::from(n.scale) + 1);
    let (whole, part) = digits.split_at(digits.len() - usize::from(n.scale));
    let point = if n.point { "." } else { "" };
    let unit = match n.unit {
        Unit::One | Unit::Mm => "",
        Unit::Inch => "in",
        Unit::Entry => "u",
        Unit::Degree => "deg",
        Unit::Second => "s",
    };
    format!("{sign}{whole}{point}{part}{unit}")
}

fn fact<T: std::fmt::Debug>(f: &Fact<T>) -> String {
    match f {
        Fact::Known(value) => format!("{value:?}"),
        Fact::Entry => "?".into(),
    }
}

fn arc(a: &Arc) -> String {
    let centre = match &a.centre {
        Centre::Radius(r) => format!("R{}", expr(r)),
        Centre::Point { words, from } => {
            let from = if *from == CentreFrom::Zero { "=" } else { "" };
            let letters = words.iter().zip("IJK".chars());
            letters
                .filter_map(|(w, l)| Some(format!("{l}{from}{}", expr(w.as_ref()?))))
                .collect::<Vec<_>>()
                .join(" ")
        }
    };
    let said = if a.said { "!" } else { "" };
    format!("ARC{said} {} {:?}{} {centre}", fact(&a.plane), a.turn, point(&a.to))
}

fn cycle(c: &Cycle) -> String {
    let kind = match &c.kind {
        CycleKind::Drill => String::new(),
        CycleKind::DrillDwell { dwell } => format!(" dwell {}", expr(dwell)),
        CycleKind::DrillPeck { peck, clearance, dwell, .. } => {
            assert_eq!((clearance, dwell), (&Clearance::Parameter, &None));
            format!(" peck {}", expr(peck))
        }
        CycleKind::DrillBreak { peck, lift, dwell, .. } => {
            assert_eq!((lift, dwell), (&Clearance::Parameter, &None));
            format!(" break {}", expr(peck))
        }
        other @ (CycleKind::Tap(_) | CycleKind::FineBore(_) | CycleKind::BoreStop(_)) => {
            format!(" {other:?}")
        }
        CycleKind::Bore { dwell, .. } => {
            dwell.as_ref().map_or(String::new(), |d| format!(" dwell {}", expr(d)))
        }
    };
    let feed = c.feed.as_ref().map_or(String::new(), |f| format!(" F{}", expr(f)));
    let (plane, level) = (fact(&c.plane), fact(&c.return_level));
    format!(
        "CYCLE {}{kind} {plane} R{} Z{} {level} {:?}{feed}",
        c.kind.name(),
        coord(&c.retract),
        coord(&c.depth),
        c.approach
    )
}

fn pattern(p: &Pattern) -> String {
    match p {
        Pattern::Circle { centre, first, step, count } => {
            let centre = centre.as_ref().map_or("here".into(), |[x, y]| format!("{} {}", coord(x), coord(y)));
            let First::At([x, y]) = first else { return "POLAR".into() };
            format!("CIRCLE {count} from {} {} step {} about {centre}", coord(x), coord(y), expr(step))
        }
        Pattern::Line { .. } => "LINE".into(),
        Pattern::List(points) => format!("LIST {}", points.len()),
        Pattern::Grid { columns, rows, serpentine, .. } => {
            let row = |r: &ncc_ir::program::cycle::Row| match &r.along {
                Along::Axis(axis) => format!("{}x{axis:?}{}", r.count, expr(&r.pitch)),
                Along::Angle(angle) => format!("{}@{}:{}", r.count, expr(angle), expr(&r.pitch)),
            };
            format!("GRID {} {}{}", row(columns), row(rows), if *serpentine { " serpentine" } else { "" })
        }
    }
}
