//! A short rendering of statements for tests. `X1.5` is absolute, `X+=1.5` incremental, `X?1.5`
//! whatever is active; a unit stands after a number unless it is millimetres or a pure number.

use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Along, Clearance, Cycle, CycleKind, First, Pattern};
use ncc_ir::program::{
    Arc, ArcForm, Centre, CentreFrom, Coord, Frame, FrameStep, Move, Op, Point, Shape, Stmt,
};

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
        Op::ArcForm(a) => arc_form(a),
        Op::SetFrame(f) => frame(f),
        Op::Label(name) => format!("{name}:"),
        Op::Message(text) => format!("MSG {text:?}").replace('"', "'"),
        Op::UseToolEdge { edge, said } => format!("EDGE{} {}", if *said { "!" } else { "" }, expr(edge)),
        Op::RepeatBlocks(r) => {
            let to = r.to.as_ref().map_or(String::new(), |to| format!(" to {to}"));
            format!("REPEAT {}{to} x{}", r.from, expr(&r.times))
        }
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
    let turns =
        if !a.turns.is_none() { format!(" turns {}", a.turns.number().unwrap_or(0)) } else { String::new() };
    format!("ARC{said} {} {:?}{} {centre}{turns}", fact(&a.plane), a.turn, point(&a.to))
}

fn arc_form(a: &ArcForm) -> String {
    let about = |words: &[Option<Coord>; 3]| -> String {
        let letters = words.iter().zip("IJK".chars());
        letters.filter_map(|(w, l)| Some(format!(" {l}{}", coord(w.as_ref()?)))).collect()
    };
    let shape = match &a.shape {
        Shape::Angle { turn, angle } => format!("{turn:?} by {}", expr(angle)),
        Shape::AngleAbout { turn, angle, centre } => {
            format!("{turn:?} by {} about{}", expr(angle), about(centre))
        }
        Shape::Mixed { turn, centre } => format!("{turn:?} about{}", about(centre)),
        Shape::Through(via) => format!("through{}", point(via)),
        Shape::Tangent => "tangent".into(),
    };
    let said = if a.said { "!" } else { "" };
    let turns = if a.turns > 0 { format!(" turns {}", a.turns) } else { String::new() };
    format!("ARC{said} {}{} {shape}{turns}", fact(&a.plane), point(&a.to))
}

fn frame(f: &Frame) -> String {
    let words = |words: &[Option<Expr>]| -> String {
        let axes = words.iter().zip("XYZABC".chars());
        axes.filter_map(|(w, l)| Some(format!(" {l}{}", expr(w.as_ref()?)))).collect()
    };
    let step = match &f.step {
        FrameStep::Translate(by) => format!("SHIFT{}", words(&by[..])),
        FrameStep::Rotate { plane, angle } => format!("TURN {} {}", fact(plane), expr(angle)),
        FrameStep::Scale(by) => format!("SCALE{}", words(&by[..])),
        FrameStep::Mirror(axes) => {
            let named: String = axes.iter().zip("XYZ".chars()).filter_map(|(m, l)| m.then_some(l)).collect();
            format!("MIRROR {named}")
        }
    };
    format!("{}{step}", if f.added { "+" } else { "" })
}

fn cycle(c: &Cycle) -> String {
    let option =
        |name: &str, e: &Option<Expr>| e.as_ref().map_or(String::new(), |e| format!(" {name} {}", expr(e)));
    let stated = |c: &Clearance| match c {
        Clearance::Stated(e) => expr(e),
        Clearance::Parameter => "?".into(),
        Clearance::FromReturn => "return".into(),
    };
    let kind = match &c.kind {
        CycleKind::Drill => String::new(),
        CycleKind::DrillDwell { dwell } => format!(" dwell {}", expr(dwell)),
        CycleKind::DrillPeck { peck, first, less: _, clearance, pause, settle, dwell } => format!(
            " {}{} ahead {}{}{}{}",
            expr(peck),
            option("first", first),
            stated(clearance),
            option("pause", pause),
            option("settle", settle),
            option("dwell", dwell)
        ),
        CycleKind::DrillBreak { peck, first, less: _, lift, lift_at_feed, pause, dwell } => format!(
            " {}{} lift{} {}{}{}",
            expr(peck),
            option("first", first),
            if *lift_at_feed { "" } else { " rapid" },
            stated(lift),
            option("pause", pause),
            option("dwell", dwell)
        ),
        other @ (CycleKind::Tap(_) | CycleKind::FineBore(_) | CycleKind::BoreStop(_)) => {
            format!(" {other:?}")
        }
        CycleKind::Bore { dwell, feed_out, .. } => option("dwell", dwell) + &option("out", feed_out),
    };
    let feed = option("F", &c.feed).replace("F ", "F");
    let back = c.return_plane.as_ref().map_or("?".into(), coord);
    format!(
        "CYCLE {}{kind} {} R{} Z{} back {back}{feed}",
        c.kind.name(),
        fact(&c.plane),
        coord(&c.retract),
        coord(&c.depth),
    )
}

fn pattern(p: &Pattern) -> String {
    let pair = |words: &Option<[Coord; 2]>| {
        words.as_ref().map_or("here".into(), |[x, y]| format!("{} {}", coord(x), coord(y)))
    };
    match p {
        Pattern::Circle { centre, first, step, count } => {
            let first = match first {
                First::At([x, y]) => format!("{} {}", coord(x), coord(y)),
                First::Polar { radius, angle } => format!("{} at {}", expr(radius), expr(angle)),
            };
            format!("CIRCLE {count} about {} radius {first} step {}", pair(centre), expr(step))
        }
        Pattern::Line { start, angle, offset, pitch, count } => format!(
            "LINE {count} from {} at {} offset {} pitch {}",
            pair(start),
            expr(angle),
            expr(offset),
            expr(pitch)
        ),
        Pattern::List(points) => format!("LIST{}", points.iter().map(|p| point(p) + ";").collect::<String>()),
        Pattern::Grid { start, columns, rows, serpentine } => {
            let row = |r: &ncc_ir::program::cycle::Row| match &r.along {
                Along::Axis(axis) => format!("{}x{axis:?}{}", r.count, expr(&r.pitch)),
                Along::Angle(angle) => format!("{}@{}:{}", r.count, expr(angle), expr(&r.pitch)),
            };
            let way = if *serpentine { " serpentine" } else { "" };
            format!("GRID from {} {} {}{way}", pair(start), row(columns), row(rows))
        }
    }
}
