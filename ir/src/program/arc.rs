//! Arcs, as a program gives them: by centre or radius, or in a form that must be computed first.
//!
//! Not here: what they amount to (`round`).

use super::{Coord, Point};
use crate::canon::{Fact, Plane, Turn};
use crate::diag::Fault;
use crate::expr::num::{Num, Unit};
use crate::expr::{Binary, Expr, Node};
use crate::run_time::RunTimeValue;
use crate::syntax::Ranged;

/// An arc or helix.
#[derive(Clone, Debug, PartialEq)]
pub struct Arc {
    /// Its plane.
    pub plane: Fact<Plane>,
    /// Its sense.
    pub turn: Turn,
    /// End point; words outside the plane make it a helix. No words in the plane, or an end equal
    /// to the start, make a full circle (with [`Centre::Point`]).
    pub to: Point,
    /// Its centre.
    pub centre: Centre,
    /// Full turns made beyond the first, partial one.
    pub turns: Turns,
    /// Whether the block itself says the motion code.
    pub said: bool,
}

/// Full turns of an arc beyond the first, partial one: a number from 0, or what is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Turns(pub Expr);

impl From<u32> for Turns {
    fn from(number: u32) -> Turns {
        Turns(Expr::int(number.into()))
    }
}

impl Turns {
    /// No turn but the first.
    pub const NONE: Turns = Turns(Expr::Num(Num { mantissa: 0, scale: 0, point: false, unit: Unit::One }));

    /// Of an arc with so many in all, as computed.
    pub fn of_all(all: Expr) -> Turns {
        Turns(Expr::Node(Box::new(Node::Binary(Binary::Subtract, all, Expr::int(1)))))
    }

    /// The number, unless it is computed or none.
    pub fn number(&self) -> Option<u32> {
        self.0.literal().and_then(Num::whole_number).and_then(|number| u32::try_from(number).ok())
    }

    /// The number, for those who need it.
    ///
    /// # Errors
    /// Only the run of the program knows it; it is below 0, or not whole.
    pub fn count(&self) -> Result<u32, Fault> {
        self.number().ok_or_else(|| match &self.0 {
            Expr::Num(_) => Fault::OutOfRange { word: Ranged::Turns },
            Expr::Node(_) => Fault::computes(RunTimeValue::ComputedTurns),
        })
    }

    /// Whether the arc surely ends within its first turn.
    pub fn is_none(&self) -> bool {
        self.number() == Some(0)
    }

    /// How many there are in all.
    pub fn all(&self) -> Expr {
        match &self.0 {
            Expr::Node(node) => match &**node {
                Node::Binary(Binary::Subtract, all, one) if *one == Expr::int(1) => all.clone(),
                _ => Expr::Node(Box::new(Node::Binary(Binary::Add, self.0.clone(), Expr::int(1)))),
            },
            Expr::Num(_) => Expr::int(i64::from(self.number().unwrap_or(0)) + 1),
        }
    }
}

/// How an arc's centre is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Centre {
    /// Words along X, Y and Z; only the two of the plane count. A missing one is 0 from
    /// [`CentreFrom::Start`], and an error from [`CentreFrom::Zero`].
    Point {
        /// The words (I, J, K).
        words: [Option<Expr>; 3],
        /// From where they are measured.
        from: CentreFrom,
    },
    /// By radius: positive makes an arc of at most 180°, negative of more.
    Radius(Expr),
}

/// From where the words of a centre are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CentreFrom {
    /// From the start point of the arc.
    Start,
    /// From program zero.
    Zero,
}

/// An arc given so that its centre, its end or its sense must be computed: not by centre or radius.
#[derive(Clone, Debug, PartialEq)]
pub struct ArcForm {
    /// Its plane.
    pub plane: Fact<Plane>,
    /// End point; words outside the plane make it a helix.
    pub to: Point,
    /// What gives it its shape.
    pub shape: Shape,
    /// Full turns made beyond the first, partial one.
    pub turns: u32,
    /// Whether the block itself says the motion code.
    pub said: bool,
}

/// What gives an arc its shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Opening angle in degrees, more than 0 and less than 360, to the end point.
    Angle {
        /// Its sense.
        turn: Turn,
        /// The angle.
        angle: Expr,
    },
    /// Opening angle about a centre: the end point follows, and has no words in the plane.
    AngleAbout {
        /// Its sense.
        turn: Turn,
        /// The angle.
        angle: Expr,
        /// Words along X, Y and Z, each from where its distance says: from program zero
        /// (absolute) or the start of the arc (incremental). A missing one is the start's.
        centre: Box<[Option<Coord>; 3]>,
    },
    /// Centre with words some of which are from program zero and some from the start.
    Mixed {
        /// Its sense.
        turn: Turn,
        /// As of [`Shape::AngleAbout`].
        centre: Box<[Option<Coord>; 3]>,
    },
    /// Through a point between start and end.
    Through(Box<Point>),
    /// Goes on in the direction in which the move before ended.
    Tangent,
}

impl Shape {
    /// The upper-case name in text of an arc in this form.
    pub const fn name(&self) -> &'static str {
        match self {
            Shape::Angle { .. } => "ARC_BY_ANGLE",
            Shape::AngleAbout { .. } => "ARC_ABOUT_BY_ANGLE",
            Shape::Mixed { .. } => "ARC_ABOUT",
            Shape::Through(_) => "ARC_THROUGH",
            Shape::Tangent => "ARC_TANGENT",
        }
    }
}
