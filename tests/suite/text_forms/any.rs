//! Generated programs: every kind of node, for the laws of the text forms.

use ncc_ir::canon::*;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Element, Expr, Function, Many, Node, Numbers, Scope, Target, Unary, Var};
use ncc_ir::program::cycle::*;
use ncc_ir::program::*;
use ncc_ir::source::Span;
use proptest::option::of;
use proptest::prelude::*;
use proptest::sample::select;

fn unit() -> impl Strategy<Value = Unit> {
    select(vec![Unit::One, Unit::Mm, Unit::Inch, Unit::Entry, Unit::Degree, Unit::Second])
}

pub(super) fn num() -> impl Strategy<Value = Num> {
    let mantissa = prop_oneof![Just(0), -20i64..20, any::<i64>(), -99_999_999i64..99_999_999];
    (mantissa, 0u8..=18, any::<bool>(), unit()).prop_map(|(mantissa, scale, point, unit)| Num {
        mantissa,
        scale: if point { scale } else { 0 },
        point,
        unit,
    })
}

pub(super) fn text() -> impl Strategy<Value = Text> {
    prop_oneof!["[a-z]{0,5}", any::<String>(), "[\"\\\\\n\r\t#{}& ]{0,6}"].prop_map(Text::from)
}

fn name() -> impl Strategy<Value = Text> {
    prop_oneof!["[0-9]{1,4}".prop_map(Text::from), text()]
}

fn var() -> impl Strategy<Value = Var> {
    (name(), 0..4).prop_map(|(name, kind)| match kind {
        0 => Var::Local(name),
        1 => Var::Common(name),
        2 => Var::Retentive(name),
        _ => Var::System(System::named(&name)),
    })
}

fn binary() -> impl Strategy<Value = Binary> {
    use Binary::*;
    select(vec![
        Add,
        Subtract,
        Multiply,
        Divide,
        Modulo,
        Power,
        Equal,
        NotEqual,
        Less,
        LessOrEqual,
        Greater,
        GreaterOrEqual,
        And,
        Or,
        Xor,
    ])
}

fn function() -> impl Strategy<Value = Function> {
    use Function::*;
    select(vec![
        Sin, Cos, Tan, Asin, Acos, Atan2, Sqrt, Abs, Round, RoundTo, RoundUp, Floor, Ceiling, Truncate, Ln,
        Exp, Min, Max, Remainder, Given, Near, NearRatio, BitAnd, BitOr, BitXor,
    ])
}

pub(super) fn expr() -> impl Strategy<Value = Expr> {
    let leaf = prop_oneof![
        4 => num().prop_map(Expr::Num),
        1 => var().prop_map(|v| Expr::Node(Box::new(Node::Var(v)))),
        1 => Just(Expr::Node(Box::new(Node::Vacant))),
    ];
    leaf.prop_recursive(4, 12, 3, |inner| {
        let unary = select(vec![Unary::Negate, Unary::Not]);
        prop_oneof![
            (unary, inner.clone()).prop_map(|(o, a)| Node::Unary(o, a)),
            (binary(), inner.clone(), inner.clone()).prop_map(|(o, a, b)| Node::Binary(o, a, b)),
            (function(), prop::collection::vec(inner.clone(), 0..3)).prop_map(|(f, a)| Node::Call(f, a)),
            (many(), prop::collection::vec(inner, 1..3)).prop_map(|(of, mut at)| {
                if matches!(of, Many::Numbered(_)) {
                    at.truncate(1);
                }
                Node::Element(Element { of, at })
            }),
        ]
        .prop_map(|node| Expr::Node(Box::new(node)))
    })
}

/// What a variable holds.
fn holds() -> impl Strategy<Value = Type> {
    select(vec![Type::Real, Type::Int, Type::Bool])
}

fn declare() -> impl Strategy<Value = Declare> {
    let sizes = prop::collection::vec(1u32..9, 0..3);
    (var(), holds(), sizes, prop::collection::vec(of(expr()), 0..3))
        .prop_map(|(var, kind, sizes, initial)| Declare { var, kind, sizes: sizes.into(), initial })
}

fn piece() -> impl Strategy<Value = Piece> {
    prop_oneof![
        text().prop_map(Piece::Text),
        (expr(), 0u8..=9, any::<bool>()).prop_map(|(value, digits, short)| Piece::Value {
            value,
            digits,
            short,
            places: 0,
        }),
        (expr(), 0u8..=9, 1u8..=9).prop_map(|(value, digits, places)| Piece::Value {
            value,
            digits,
            short: false,
            places,
        }),
    ]
}

/// Many variables, of which one is meant.
fn many() -> impl Strategy<Value = Many> {
    let scope = select(vec![Scope::Local, Scope::Common, Scope::Retentive]);
    let prefix = select(vec!["", "R"]);
    let numbers = (scope, prefix, 0u32..100, 0u32..100).prop_map(|(scope, prefix, from, to)| Numbers {
        scope,
        prefix: prefix.into(),
        from,
        to,
    });
    prop_oneof![
        (var(), prop::collection::vec(1u32..9, 1..3))
            .prop_map(|(var, sizes)| Many::Array { var, sizes: sizes.into() }),
        prop::collection::vec(numbers, 1..3).prop_map(|all| Many::Numbered(all.into())),
    ]
}

fn fact<T: Clone + std::fmt::Debug + 'static>(values: Vec<T>) -> impl Strategy<Value = Fact<T>> {
    of(select(values)).prop_map(Fact::from)
}

fn distances() -> Vec<Distance> {
    vec![Distance::Absolute, Distance::Incremental]
}

fn planes() -> Vec<Plane> {
    vec![Plane::Xy, Plane::Zx, Plane::Yz]
}

fn levels() -> Vec<ReturnLevel> {
    vec![ReturnLevel::Initial, ReturnLevel::Retract]
}

fn units() -> Vec<Units> {
    vec![Units::Mm, Units::Inch]
}

fn feed_modes() -> Vec<FeedMode> {
    vec![FeedMode::PerMinute, FeedMode::PerRevolution, FeedMode::InverseTime]
}

fn turn() -> impl Strategy<Value = Turn> {
    select(vec![Turn::Clockwise, Turn::Counterclockwise])
}

fn coord() -> BoxedStrategy<Coord> {
    (expr(), fact(distances())).prop_map(|(value, distance)| Coord { value, distance }).boxed()
}

fn point() -> BoxedStrategy<Point> {
    prop::collection::vec(of(coord()), 6)
        .prop_map(|axes| {
            let mut point = Point::default();
            for (axis, coord) in Axis::ALL.into_iter().zip(axes) {
                point.axes[axis as usize] = coord;
            }
            point
        })
        .boxed()
}

fn moves() -> BoxedStrategy<Move> {
    (point(), any::<bool>()).prop_map(|(to, said)| Move { to, said }).boxed()
}

fn centre() -> BoxedStrategy<Centre> {
    prop_oneof![
        expr().prop_map(Centre::Radius),
        (of(expr()), of(expr()), of(expr()), any::<bool>()).prop_map(|(i, j, k, start)| Centre::Point {
            words: [i, j, k],
            from: if start { CentreFrom::Start } else { CentreFrom::Zero },
        }),
    ]
    .boxed()
}

fn cycle() -> BoxedStrategy<Cycle> {
    let kind = prop_oneof![
        Just(CycleKind::Drill),
        expr().prop_map(|dwell| CycleKind::DrillDwell { dwell }),
        ([of(expr()), of(expr()), of(expr()), of(expr()), of(expr()), of(expr())], expr()).prop_map(
            |([clearance, first, less, pause, settle, dwell], peck)| CycleKind::DrillPeck {
                peck,
                first,
                less,
                clearance: clearance.map_or(Clearance::Parameter, Clearance::Stated),
                pause,
                settle,
                dwell,
            }
        ),
        ([of(expr()), of(expr()), of(expr()), of(expr()), of(expr())], expr(), any::<bool>()).prop_map(
            |([lift, first, less, pause, dwell], peck, lift_at_feed)| CycleKind::DrillBreak {
                peck,
                first,
                less,
                lift: lift.map_or(Clearance::Parameter, Clearance::Stated),
                lift_at_feed,
                pause,
                dwell,
            }
        ),
        (of(expr()), of(expr()), any::<bool>()).prop_map(|(dwell, feed_out, to_level)| CycleKind::Bore {
            dwell,
            feed_out,
            to_level
        }),
        (turn(), pitch(), any::<[bool; 2]>(), [of(expr()), of(expr()), of(expr())], select(spindles()))
            .prop_map(|(turn, pitch, [chuck, to_level], [dwell, back, settle], after)| CycleKind::Tap(
                Box::new(Tap { turn, pitch, chuck, dwell, back, settle, after, to_level })
            )),
        (of(turn()), of(expr()), of(expr()), shift(), of(select(spindles()))).prop_map(
            |(turn, dwell, angle, shift, after)| CycleKind::FineBore(Box::new(FineBore {
                turn,
                dwell,
                angle,
                shift,
                after
            }))
        ),
        (of(turn()), of(expr()), any::<bool>(), of(select(spindles()))).prop_map(
            |(turn, dwell, stop, after)| CycleKind::BoreStop(BoreStop { turn, dwell, stop, after })
        ),
    ];
    let approach = select(Approach::ALL.to_vec());
    let levels_of = (coord(), of(coord()), coord());
    (kind, fact(planes()), levels_of, fact(levels()), of(coord()), approach, of(expr()))
        .prop_map(|(kind, plane, (retract, reference, depth), return_level, return_plane, approach, feed)| {
            Cycle { kind, plane, retract, reference, depth, return_level, return_plane, approach, feed }
        })
        .boxed()
}

fn spindles() -> Vec<Spindle> {
    vec![Spindle::Stopped, Spindle::Clockwise, Spindle::Counterclockwise]
}

fn pitch() -> BoxedStrategy<Pitch> {
    of(expr()).prop_map(|pitch| pitch.map_or(Pitch::Feed, Pitch::Stated)).boxed()
}

fn shift() -> BoxedStrategy<Shift> {
    prop_oneof![
        expr().prop_map(Shift::Parameter),
        [of(expr()), of(expr()), of(expr())].prop_map(Shift::Stated),
    ]
    .boxed()
}

fn row() -> BoxedStrategy<Row> {
    let along = prop_oneof![select(Axis::ALL.to_vec()).prop_map(Along::Axis), expr().prop_map(Along::Angle)];
    (along, expr(), any::<u32>()).prop_map(|(along, pitch, count)| Row { along, pitch, count }).boxed()
}

fn first() -> BoxedStrategy<First> {
    prop_oneof![
        [coord(), coord()].prop_map(First::At),
        (expr(), expr()).prop_map(|(radius, angle)| First::Polar { radius, angle }),
    ]
    .boxed()
}

fn shape() -> BoxedStrategy<Shape> {
    let about = || [of(coord()), of(coord()), of(coord())].prop_map(Box::new);
    prop_oneof![
        (turn(), expr()).prop_map(|(turn, angle)| Shape::Angle { turn, angle }),
        (turn(), expr(), about()).prop_map(|(turn, angle, centre)| Shape::AngleAbout { turn, angle, centre }),
        (turn(), about()).prop_map(|(turn, centre)| Shape::Mixed { turn, centre }),
        point().prop_map(|via| Shape::Through(Box::new(via))),
        Just(Shape::Tangent),
    ]
    .boxed()
}

fn frame() -> BoxedStrategy<Frame> {
    let step = prop_oneof![
        prop::collection::vec(of(expr()), AXES).prop_map(|words| {
            let mut by = [const { None }; AXES];
            by.iter_mut().zip(words).for_each(|(by, word)| *by = word);
            FrameStep::Translate(Box::new(by))
        }),
        (fact(planes()), expr()).prop_map(|(plane, angle)| FrameStep::Rotate { plane, angle }),
        [of(expr()), of(expr()), of(expr())].prop_map(|by| FrameStep::Scale(Box::new(by))),
        any::<[bool; 3]>().prop_map(FrameStep::Mirror),
    ];
    (any::<bool>(), step).prop_map(|(added, step)| Frame { added, step }).boxed()
}

fn along<const N: usize>() -> BoxedStrategy<Box<[Option<Expr>; N]>> {
    prop::collection::vec(of(expr()), N)
        .prop_map(|words| {
            let mut by = [const { None }; N];
            by.iter_mut().zip(words).for_each(|(by, word)| *by = word);
            Box::new(by)
        })
        .boxed()
}

fn linear() -> impl Strategy<Value = Axis> {
    select(vec![Axis::X, Axis::Y, Axis::Z])
}

fn slot() -> BoxedStrategy<Slot> {
    prop_oneof![
        (any::<bool>(), along()).prop_map(|(origin, axes)| Slot::Shift { origin, axes }),
        (fact(planes()), along(), coord()).prop_map(|(plane, centre, angle)| Slot::Rotation {
            plane,
            centre,
            angle
        }),
        (along(), along()).prop_map(|(centre, factors)| Slot::Scale { centre, factors }),
        along().prop_map(Slot::Mirror),
        any::<[bool; 3]>().prop_map(Slot::NoMirror),
        ([of(expr()), of(expr()), of(expr())], [linear(), linear(), linear()], [expr(), expr(), expr()])
            .prop_map(|(origin, about, angles)| Slot::Tilt(Box::new(Tilt { origin, about, angles }))),
    ]
    .boxed()
}

fn pattern() -> BoxedStrategy<Pattern> {
    prop_oneof![
        (of([coord(), coord()]), first(), expr(), any::<u32>())
            .prop_map(|(centre, first, step, count)| Pattern::Circle { centre, first, step, count }),
        (of([coord(), coord()]), expr(), expr(), expr(), any::<u32>()).prop_map(
            |(start, angle, offset, pitch, count)| Pattern::Line { start, angle, offset, pitch, count }
        ),
        prop::collection::vec(point(), 0..4).prop_map(Pattern::List),
        (of([coord(), coord()]), row(), row(), any::<bool>()).prop_map(
            |(start, columns, rows, serpentine)| Pattern::Grid { start, columns, rows, serpentine }
        ),
    ]
    .boxed()
}

/// Values of tables.
fn data() -> impl Strategy<Value = Data> {
    let modes = select(vec![DataMode::Set, DataMode::Add, DataMode::Here]);
    let words = || prop::option::of(expr());
    prop_oneof![
        (any::<u16>(), modes, [words(), words(), words(), words(), words(), words()], words()).prop_map(
            |(offset, mode, words, turn)| Data::Offset { offset, mode, words: Box::new(words), turn }
        ),
        (1u8..=2).prop_map(Data::Position),
        expr().prop_map(Data::ToolInSpindle),
        (any::<u32>(), select(ToolValue::ALL.to_vec()), any::<[bool; 2]>(), expr())
            .prop_map(|(entry, which, [added, kept], value)| Data::Tool { entry, which, added, kept, value }),
        (any::<u32>(), prop::option::of(any::<u16>()), words(), words(), expr()).prop_map(
            |(entry, offset, x, y, z)| {
                let words = Box::new([x, y, Some(z), None, None, None]);
                Data::Measured { entry, offset, words }
            }
        ),
    ]
}

/// Moves to points of the machine.
fn reference() -> impl Strategy<Value = Reference> {
    let points = prop_oneof![
        Just(ReferencePoint::Home),
        (2u8..=4).prop_map(ReferencePoint::Further),
        (1u8..=4).prop_map(ReferencePoint::Fixed),
        (1u8..=2).prop_map(ReferencePoint::Stored),
    ];
    let axes = any::<[bool; 6]>().prop_map(|mut axes| {
        axes[2] |= axes == [false; 6];
        axes
    });
    (points, axes, point(), any::<bool>()).prop_map(|(point, axes, via, keeps_length)| Reference {
        point,
        axes,
        via,
        keeps_length,
    })
}

fn pole() -> impl Strategy<Value = Op> {
    let words = prop_oneof![
        (of(expr()), of(expr()), of(expr())).prop_map(|(x, y, z)| PoleWords::Along(Box::new([x, y, z]))),
        (expr(), expr()).prop_map(|(radius, angle)| PoleWords::Polar { radius, angle }),
    ];
    let from = select(vec![PoleFrom::Zero, PoleFrom::Here, PoleFrom::Pole]);
    (fact(planes()), from, words)
        .prop_map(|(plane, from, at)| Op::SetPole(Box::new(SetPole { plane, from, at })))
}

fn radius() -> impl Strategy<Value = CutterRadius> {
    prop_oneof![
        expr().prop_map(CutterRadius::Entry),
        expr().prop_map(CutterRadius::Diameter),
        select(vec![CutterRadius::Tool, CutterRadius::InForce]),
    ]
}

/// A statement's operation that has no body.
fn simple() -> BoxedStrategy<Op> {
    let bare = select(vec![
        Op::Blank,
        Op::StopCutterRadiusCompensation,
        Op::ChangeTool,
        Op::StartSpindleClockwise,
        Op::StartSpindleCounterclockwise,
        Op::StopSpindleTurning,
        Op::FloodOn,
        Op::MistOn,
        Op::CoolantOff,
        Op::EndCycle,
        Op::ProgramStop,
        Op::OptionalProgramStop,
        Op::ProgramEnd,
        Op::BeginAgain,
        Op::Return,
        Op::ExactStop,
        Op::TurnRotaryAxes([Some(RotaryWay::Shortest), None, Some(RotaryWay::Negative)]),
        Op::TurnRotaryAxes([None, Some(RotaryWay::Positive), None]),
        Op::SetSpindleMode(SpindleMode::Turns),
        Op::SetSpindleMode(SpindleMode::Surface),
        Op::UseMachineCoordinates { length: true },
        Op::UseMachineCoordinates { length: false },
        Op::Detour(Detour::OneSide),
        Op::Detour(Detour::Intermediate),
        Op::Probe(Probe { away: false, error: false }),
        Op::Probe(Probe { away: true, error: false }),
        Op::Probe(Probe { away: false, error: true }),
        Op::Probe(Probe { away: true, error: true }),
        Op::UseOriginShift(true),
        Op::UseOriginShift(false),
        Op::UseToolCentrePoint(true),
        Op::UseToolCentrePoint(false),
        Op::OrientToolAxis(None),
        Op::OrientToolAxis(Some(Toward::Minus)),
        Op::OrientToolAxis(Some(Toward::Plus)),
    ]);
    let setting = prop_oneof![
        select(units()).prop_map(Op::UseLengthUnits),
        select(distances()).prop_map(Op::SetDistanceMode),
        select(planes()).prop_map(Op::SelectPlane),
        select(feed_modes()).prop_map(Op::SetFeedMode),
        select(levels()).prop_map(Op::SetReturnLevel),
        any::<u16>().prop_map(Op::SetOriginOffsets),
        select(FrameSlot::ALL.to_vec()).prop_map(Op::ClearFrame),
        frame().prop_map(|frame| Op::SetFrame(Box::new(frame))),
        slot().prop_map(|slot| Op::SetSlot(Box::new(slot))),
        along().prop_map(Op::SetPosition),
        data().prop_map(|data| Op::SetData(Box::new(data))),
        reference().prop_map(|reference| Op::GoToReference(Box::new(reference))),
        (expr(), any::<bool>()).prop_map(|(edge, said)| Op::UseToolEdge { edge, said }),
        (select(vec![Side::Left, Side::Right]), radius())
            .prop_map(|(side, radius)| Op::StartCutterRadiusCompensation { side, radius }),
    ];
    let valued = prop_oneof![
        expr().prop_map(Op::SetFeedRate),
        expr().prop_map(Op::SetSpindleSpeed),
        expr().prop_map(Op::LimitSpindleSpeed),
        (select(PathMode::ALL.to_vec()), of(expr()), of(expr()), of(expr())).prop_map(
            |((mode, _), within, rapids, merged)| {
                let rapids = rapids.filter(|_| within.is_some());
                Op::SetMotionControlMode(Box::new(PathControl { mode, within, rapids, merged }))
            }
        ),
        (select(AdviceKind::ALL.to_vec()), 0u8..6, of(expr())).prop_map(|((kind, _), value, amount)| {
            let (value, amount) = (value % kind.values().len() as u8, amount.filter(|_| kind.has_amount()));
            Op::Advise(Box::new(Advice { kind, value, amount }))
        }),
        expr().prop_map(Op::SelectTool),
        expr().prop_map(Op::UseToolLengthOffset),
        (expr(), 0..5).prop_map(|(value, which)| {
            Op::UseToolLength(Box::new(match which {
                0 => ToolLength::Value(value),
                1 => ToolLength::Added(value),
                2 => ToolLength::AddedEntry(value),
                _ => {
                    let words = Box::new([None, Some(value), None, None, None, None]);
                    ToolLength::Offsets { added: which == 3, words }
                }
            }))
        }),
        expr().prop_map(Op::Dwell),
        (select(CornerShape::ALL.to_vec()), expr()).prop_map(|(shape, size)| Op::Corner { shape, size }),
    ];
    let motion = prop_oneof![
        moves().prop_map(Op::StraightTraverse),
        moves().prop_map(Op::StraightFeed),
        moves().prop_map(Op::Position),
        (fact(planes()), of(coord()), of(coord()), moves(), 0u8..4).prop_map(
            |(plane, radius, angle, to, kind)| {
                let op = match kind {
                    0 => Op::StraightTraverse(to),
                    1 => Op::StraightFeed(to),
                    2 => Op::Hole(to),
                    _ => Op::Position(to),
                };
                Op::Polar(Box::new(Polar { plane, radius, angle, along: false, op }))
            }
        ),
        pole(),
        (fact(planes()), coord(), moves(), any::<bool>()).prop_map(|(plane, angle, to, cuts)| {
            let op = if cuts { Op::StraightFeed(to) } else { Op::StraightTraverse(to) };
            Op::Polar(Box::new(Polar { plane, radius: None, angle: Some(angle), along: true, op }))
        }),
        (point(), pitch(), any::<bool>(), of(turn()), any::<bool>()).prop_map(
            |(to, pitch, chuck, turn, back)| Op::SynchronisedFeed(Box::new(Synchronised {
                to,
                pitch,
                chuck,
                turn,
                back
            }))
        ),
        of(expr()).prop_map(Op::OrientSpindle),
        moves().prop_map(Op::Hole),
        (fact(planes()), turn(), point(), centre(), 0u32..3, any::<bool>()).prop_map(
            |(plane, turn, to, centre, turns, said)| Op::ArcFeed(Box::new(Arc {
                plane,
                turn,
                to,
                centre,
                turns: turns.into(),
                said
            }))
        ),
        (fact(planes()), point(), shape(), 0u32..3, any::<bool>()).prop_map(
            |(plane, to, shape, turns, said)| Op::ArcForm(Box::new(ArcForm {
                plane,
                to,
                shape,
                turns,
                said
            }))
        ),
        cycle().prop_map(|c| Op::StartCycle(Box::new(c))),
        pattern().prop_map(|p| Op::Pattern(Box::new(p))),
    ];
    let other = prop_oneof![
        text().prop_map(Op::Comment),
        text().prop_map(Op::NoEffect),
        text().prop_map(Op::Message),
        text().prop_map(Op::MachineFunction),
        text().prop_map(Op::SelectToolByName),
        name().prop_map(Op::Goto),
        name().prop_map(Op::Label),
        (var(), expr()).prop_map(|(v, e)| Op::Assign(v.into(), e)),
        (many(), expr(), expr()).prop_map(|(of, index, e)| {
            Op::Assign(Target::Element(Box::new(Element { of, at: vec![index] })), e)
        }),
        declare().prop_map(|declare| Op::Declare(Box::new(declare))),
        prop::collection::vec(piece(), 0..3).prop_map(|pieces| Op::MessageOf(pieces.into())),
        prop::collection::vec(piece(), 0..3)
            .prop_map(|pieces| Op::Output(Box::new(Output::Line(pieces.into())))),
        select(vec![Output::Open, Output::Close]).prop_map(|output| Op::Output(Box::new(output))),
        (of(expr()), text()).prop_map(|(number, text)| Op::Alarm(Box::new(Alarm { number, text }))),
        Just(Op::Leave),
        Just(Op::NextTurn),
        (name(), 0u32..4, prop::collection::vec(expr(), 0..3), any::<bool>()).prop_map(
            |(name, times, arguments, shared)| Op::Call(Box::new(Call { name, times, arguments, shared }))
        ),
    ];
    prop_oneof![bare, setting, valued, motion, other].boxed()
}

fn stmts(op: BoxedStrategy<Op>) -> impl Strategy<Value = Vec<Stmt>> {
    let stmt = (op, of(any::<u32>()), of(1u8..=9), any::<bool>(), of(text())).prop_map(
        |(op, number, skip, joined, comment)| Stmt {
            span: Span::default(),
            number,
            skip,
            joined,
            comment: comment.map(Box::new),
            op,
        },
    );
    prop::collection::vec(stmt, 0..6)
}

/// The body of a procedure.
pub(super) fn body() -> impl Strategy<Value = Vec<Stmt>> {
    let op = simple().prop_recursive(3, 20, 4, |inner| {
        let body = || stmts(inner.clone());
        prop_oneof![
            2 => inner.clone(),
            1 => (expr(), body()).prop_map(|(times, body)| control(Control::Repeat { times, body })),
            1 => body().prop_map(|body| control(Control::Loop { body })),
            1 => (expr(), body()).prop_map(|(condition, body)| control(Control::While { condition, body })),
            1 => (expr(), body()).prop_map(|(condition, body)| control(Control::Until { condition, body })),
            1 => (var(), expr(), expr(), expr(), body())
                .prop_map(|(variable, from, to, step, body)| control(Control::For { variable, from, to, step, body })),
            1 => (expr(), body(), body())
                .prop_map(|(condition, then, otherwise)| control(Control::If { condition, then, otherwise })),
        ]
    });
    stmts(op.boxed())
}

fn control(c: Control) -> Op {
    Op::Control(Box::new(c))
}

fn modes() -> impl Strategy<Value = Modes> {
    let motion = prop_oneof![
        Just(Motion::Traverse),
        Just(Motion::Feed),
        turn().prop_map(Motion::Arc),
        Just(Motion::Cycle)
    ];
    (
        of(motion),
        of(select(distances())),
        of(select(units())),
        of(select(planes())),
        of(select(feed_modes())),
        of(select(levels())),
        of(any::<u16>()),
        of(any::<u32>()),
        of(any::<bool>()),
    )
        .prop_map(
            |(motion, distance, units, plane, feed_mode, return_level, work_offset, length_offset, s)| {
                Modes {
                    motion,
                    distance,
                    units,
                    plane,
                    feed_mode,
                    return_level,
                    work_offset,
                    length_offset,
                    no_origin_shift: s,
                }
            },
        )
}

/// A whole program.
pub(super) fn program() -> impl Strategy<Value = Program> {
    let procedure = (
        name(),
        of(text()),
        prop::collection::vec(var(), 0..3),
        prop::collection::vec(holds(), 0..3),
        prop::sample::subsequence(
            vec![Attribute::GivesBack, Attribute::RunsThrough, Attribute::NotShown],
            0..=3,
        ),
        body(),
    )
        .prop_map(|(name, title, parameters, kinds, attributes, body)| {
            let kinds = kinds.into_iter().take(parameters.len()).collect();
            Procedure { name, title, parameters, kinds, attributes, body }
        });
    let name = (of(any::<u32>()), of(text())).prop_map(|(number, title)| ProgramName { number, title });
    (name, modes(), body(), prop::collection::vec(procedure, 0..3)).prop_map(|(name, assumed, main, subs)| {
        let mut procedures = vec![Procedure { body: main, ..Procedure::default() }];
        procedures.extend(subs);
        Program { name, assumed, procedures }
    })
}
