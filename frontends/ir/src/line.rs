//! One line of the `ir` text: what the grammar makes of it, and the checks that it leaves to us.
//!
//! Not here: how lines nest.

use ncc_ir::canon::{AXES, AdviceKind, Axis, Modes, PathMode, RotaryWay, SpindleMode};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Expr, Node, Numbers, Scope, Var};
use ncc_ir::program::{
    Advice, Coord, Data, Op, PathControl, Point, Procedure, ProgramName, Shape, Stmt, Text, ToolLength,
    ToolValue, Type,
};
use ncc_ir::source::Span;
use ncc_ir::syntax::{Expected, Ranged};

use crate::word::{LexFault, Literal};

/// A line. Spans count from its start.
#[derive(Debug)]
pub enum Line {
    /// Nothing but a note.
    Empty,
    /// The version of the text form.
    Version(u32),
    /// The program's name.
    Program(ProgramName),
    /// Facts assumed.
    Assumed(Modes),
    /// Opens a procedure.
    Procedure(Procedure),
    /// Statements of one block.
    Stmts {
        /// Whether they belong to the block of the line before.
        joined: bool,
        /// The statements.
        items: Vec<Stmt>,
        /// Whether the body of the last one follows.
        begins: bool,
    },
    /// Closes a body.
    End,
    /// Closes a body and opens the other branch.
    Else,
}

/// The head of a procedure; types are said of its first parameters, or of none.
pub(crate) fn procedure(name: Text, title: Option<Text>, parameters: Vec<(Option<Type>, Var)>) -> Procedure {
    let kinds = parameters.iter().map_while(|(kind, _)| *kind).collect();
    let parameters = parameters.into_iter().map(|(_, var)| var).collect();
    Procedure { name, title, parameters, kinds, ..Procedure::default() }
}

/// Why a line that has the form of one is refused.
#[derive(Debug)]
pub(crate) enum Refusal {
    /// A stretch of text that is no word.
    Word(usize, usize, LexFault),
    /// More words than a line may have.
    TooLong,
    /// A fault of the meaning.
    Meaning(usize, usize, Fault),
}

/// Coordinates along the plane's two axes.
pub(crate) type Pair = [Coord; 2];

/// Words of a centre that say each from where they are measured.
pub(crate) type About = [Option<Coord>; 3];

type Parsed<T> = Result<T, lalrpop_util::ParseError<usize, crate::lexer::Token, Refusal>>;

fn refuse<T>(l: usize, r: usize, fault: Fault) -> Parsed<T> {
    Err(lalrpop_util::ParseError::User { error: Refusal::Meaning(l, r, fault) })
}

/// A span within the line; a line is far shorter than 4 GiB.
pub(crate) fn span(l: usize, r: usize) -> Span {
    Span::new(l as u32, r as u32)
}

/// A block-skip level: a mark alone is level 1.
pub(crate) fn skip(level: Option<Literal>, l: usize, r: usize) -> Parsed<u8> {
    match level.map_or(Some(1), Literal::plain) {
        Some(level @ 0..=10) => Ok(level as u8),
        _ => refuse(l, r, Fault::OutOfRange { word: Ranged::SkipLevel }),
    }
}

/// A number with its sign.
pub(crate) fn number(n: Literal, negative: bool, l: usize, r: usize) -> Parsed<Num> {
    match n.signed(negative) {
        Some(n) => Ok(n),
        None => refuse(l, r, Fault::OutOfRange { word: "number".into() }),
    }
}

/// A whole number without unit.
pub(crate) fn whole_number<T: TryFrom<u64>>(n: Literal, l: usize, r: usize) -> Parsed<T> {
    match n.plain().and_then(|n| T::try_from(n).ok()) {
        Some(n) => Ok(n),
        None => refuse(l, r, Fault::OutOfRange { word: "whole number".into() }),
    }
}

/// A name that is a number.
pub(crate) fn name(n: Literal, l: usize, r: usize) -> Parsed<Text> {
    match n.plain() {
        Some(n) => Ok(n.to_string().into()),
        None => refuse(l, r, Fault::OutOfRange { word: "name".into() }),
    }
}

/// A way of taking corners by its name.
pub(crate) fn path(
    name: &str,
    lengths: Vec<Expr>,
    merged: Option<Expr>,
    l: usize,
    r: usize,
) -> Parsed<PathControl> {
    let names = PathMode::ALL.map(|(_, name)| name);
    let Some(mode) = PathMode::named(name) else { return no_name(name, &names, l, r) };
    let mut lengths = lengths.into_iter();
    let control = PathControl { mode, within: lengths.next(), rapids: lengths.next(), merged };
    match lengths.next() {
        Some(_) => refuse(l, r, Fault::WordUnused { word: "a third length".into() }),
        None => Ok(control),
    }
}

/// The number of a stored position.
pub(crate) fn stored(place: Literal, l: usize, r: usize) -> Parsed<u8> {
    match place.plain() {
        Some(place @ 1..=2) => Ok(place as u8),
        _ => refuse(l, r, Fault::OutOfRange { word: Ranged::StoredPosition }),
    }
}

/// What a spindle speed counts, by its name.
pub(crate) fn spindle(name: &str, l: usize, r: usize) -> Parsed<SpindleMode> {
    match name {
        "turns" => Ok(SpindleMode::Turns),
        "surface" => Ok(SpindleMode::Surface),
        _ => no_name(name, &["turns", "surface"], l, r),
    }
}

/// Advice by the names of its kind and its value.
pub(crate) fn advice(kind: &str, value: &str, amount: Option<Expr>, l: usize, r: usize) -> Parsed<Advice> {
    let names = AdviceKind::ALL.map(|(_, name)| name);
    let Some(kind) = AdviceKind::named(kind) else { return no_name(kind, &names, l, r) };
    match kind.value(value) {
        None => no_name(value, kind.values(), l, r),
        Some(_) if amount.is_some() && !kind.has_amount() => {
            refuse(l, r, Fault::WordUnused { word: "amount".into() })
        }
        Some(value) => Ok(Advice { kind, value, amount }),
    }
}

fn no_name<T>(found: &str, names: &[&str], l: usize, r: usize) -> Parsed<T> {
    let expected = Expected::OneOf(names.join(", ").into());
    refuse(l, r, Fault::Syntax { found: found.into(), expected })
}

/// The axis words of a move.
pub(crate) fn point(words: Vec<(Axis, Coord)>, l: usize, r: usize) -> Parsed<Point> {
    let mut point = Point::default();
    for (axis, coord) in words {
        if point.get(axis).is_some() {
            return refuse(l, r, Fault::WordTwice { letter: axis.letter() as char });
        }
        point.set(axis, coord);
    }
    Ok(point)
}

/// The words of a centre.
pub(crate) fn centre(words: Vec<(usize, Expr)>, l: usize, r: usize) -> Parsed<[Option<Expr>; 3]> {
    let mut all = [None, None, None];
    for (axis, value) in words {
        if all[axis].replace(value).is_some() {
            return refuse(l, r, Fault::WordTwice { letter: char::from(b"IJK"[axis]) });
        }
    }
    Ok(all)
}

/// The words of a centre that say each from where they are measured.
pub(crate) fn places(words: Vec<(usize, Coord)>, l: usize, r: usize) -> Parsed<[Option<Coord>; 3]> {
    let mut all = [None, None, None];
    for (axis, word) in words {
        if all[axis].replace(word).is_some() {
            return refuse(l, r, Fault::WordTwice { letter: char::from(b"IJK"[axis]) });
        }
    }
    Ok(all)
}

/// A value of the table of tools.
pub(crate) fn tool_data(entry: u32, which: ToolValue, [added, kept]: [bool; 2], value: Expr) -> Op {
    Op::SetData(Box::new(Data::Tool { entry, which, added, kept, value }))
}

/// Offsets of a tool by where the axes stand.
pub(crate) fn measured(
    entry: u32,
    offset: Option<u16>,
    words: Vec<(Axis, Expr)>,
    l: usize,
    r: usize,
) -> Parsed<Op> {
    let [x, y, z] = along(words, l, r)?;
    let words = Box::new([x, y, z, None, None, None]);
    Ok(Op::SetData(Box::new(Data::Measured { entry, offset, words })))
}

/// Offsets of a tool that are in no table.
pub(crate) fn offsets(added: bool, words: Vec<(Axis, Expr)>, l: usize, r: usize) -> Parsed<Op> {
    let [x, y, z] = along(words, l, r)?;
    let words = Box::new([x, y, z, None, None, None]);
    Ok(Op::UseToolLength(Box::new(ToolLength::Offsets { added, words })))
}

/// Values along axes, of which there are the first `N`.
pub(crate) fn along<const N: usize>(
    words: Vec<(Axis, Expr)>,
    l: usize,
    r: usize,
) -> Parsed<[Option<Expr>; N]> {
    let mut all = [const { None }; N];
    for (axis, value) in words {
        match all.get_mut(axis as usize) {
            None => {
                return refuse(
                    l,
                    r,
                    Fault::WordUnused { word: char::from(axis.letter()).to_string().into() },
                );
            }
            Some(place) if place.is_some() => {
                return refuse(l, r, Fault::WordTwice { letter: axis.letter() as char });
            }
            Some(place) => *place = Some(value),
        }
    }
    Ok(all)
}

/// Axes that are turned round.
pub(crate) fn mirrored(axes: &[Axis], l: usize, r: usize) -> Parsed<[bool; 3]> {
    let mut all = [false; 3];
    for axis in axes {
        match all.get_mut(*axis as usize) {
            None => {
                return refuse(
                    l,
                    r,
                    Fault::WordUnused { word: char::from(axis.letter()).to_string().into() },
                );
            }
            Some(turned) => *turned = true,
        }
    }
    Ok(all)
}

/// Axes that are named.
pub(crate) fn axes(named: &[Axis], l: usize, r: usize) -> Parsed<[bool; AXES]> {
    let mut all = [false; AXES];
    for axis in named {
        if std::mem::replace(&mut all[*axis as usize], true) {
            return refuse(l, r, Fault::WordTwice { letter: axis.letter() as char });
        }
    }
    Ok(all)
}

/// A move whose point can be polar.
pub(crate) fn polar(op: Op, l: usize, r: usize) -> Parsed<Op> {
    match ncc_ir::geometry::polar::end_of(&op) {
        Some(_) => Ok(op),
        None => refuse(l, r, Fault::Syntax { found: op.name().into(), expected: Expected::PointOfPlane }),
    }
}

/// The direction in which rotary axes turn, each at most once.
pub(crate) fn rotary_ways(
    first: (Axis, RotaryWay),
    rest: Vec<(Axis, RotaryWay)>,
    l: usize,
    r: usize,
) -> Parsed<Op> {
    let mut directions = [None; 3];
    for (axis, way) in std::iter::once(first).chain(rest) {
        let place = match axis {
            Axis::A => 0,
            Axis::B => 1,
            Axis::C => 2,
            Axis::X | Axis::Y | Axis::Z => {
                let found = char::from(axis.letter()).to_string().as_str().into();
                return refuse(l, r, Fault::Syntax { found, expected: Expected::RotaryAxis });
            }
        };
        if directions[place].replace(way).is_some() {
            return refuse(l, r, Fault::WordTwice { letter: axis.letter() as char });
        }
    }
    Ok(Op::TurnRotaryAxes(directions))
}

/// A move that can be stated by its angle.
pub(crate) fn straight(op: Op, l: usize, r: usize) -> Parsed<Op> {
    match op {
        Op::StraightTraverse(_) | Op::StraightFeed(_) => Ok(op),
        _ => refuse(l, r, Fault::Syntax { found: op.name().into(), expected: Expected::StraightMove }),
    }
}

/// The number of a reference point.
pub(crate) fn point_number(n: u32, least: u8, most: u8, l: usize, r: usize) -> Parsed<u8> {
    match u8::try_from(n) {
        Ok(n) if (least..=most).contains(&n) => Ok(n),
        Ok(_) | Err(_) => refuse(l, r, Fault::OutOfRange { word: Ranged::PointNumber }),
    }
}

/// Variables whose names are numbers: from one to another.
pub(crate) fn numbers(first: &Var, to: u32, l: usize, r: usize) -> Parsed<Numbers> {
    let scope = match first {
        Var::Local(_) => Some(Scope::Local),
        Var::Common(_) => Some(Scope::Common),
        Var::Retentive(_) => Some(Scope::Retentive),
        Var::System(_) => None,
    };
    let name = first.name();
    let (prefix, from) = name.split_at(name.trim_end_matches(|c: char| c.is_ascii_digit()).len());
    match (scope, from.parse()) {
        (Some(scope), Ok(from)) => Ok(Numbers { scope, prefix: prefix.into(), from, to }),
        (_, _) => refuse(l, r, Fault::BadNumber { text: name.into() }),
    }
}

/// The shape of an arc, which must be the one of its function.
pub(crate) fn shape(form: &'static str, shape: Shape, l: usize, r: usize) -> Parsed<Shape> {
    if shape.name() == form {
        Ok(shape)
    } else {
        refuse(l, r, Fault::Syntax { found: shape.name().into(), expected: form.into() })
    }
}

/// An expression of two operands.
pub(crate) fn binary(operator: Binary, a: Expr, b: Expr) -> Expr {
    Expr::Node(Box::new(Node::Binary(operator, a, b)))
}

/// Facts of two lists; the later one counts.
pub(crate) fn with(known: Modes, more: Modes) -> Modes {
    more.or(known)
}
