//! The words of reasons: hole patterns.

use std::borrow::Cow;

use ncc_ir::lack::PatternsLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Pattern => "a pattern of holes",
        L::CircleByRadius => "a bolt circle by radius",
        L::Line => "a line of holes",
        L::List => "a list of positions",
        L::ListLength { most } => return format!("a list of more than {most} positions").into(),
        L::GridFromPosition => "a grid from a stated position",
        L::Circle => "a bolt circle",
        L::CircleAboutTool => "a bolt circle about where the tool stands",
        L::CircleByFirstHole => "a bolt circle by its first hole",
        L::CircleInOnePlace => "a bolt circle whose holes are in one place",
        L::Grid => "a grid of holes",
        L::GridOrder => "a grid in this order",
        L::GridOneDirection => "a grid with all its rows in one direction",
        L::GridNotSquare => "a grid whose rows do not stand square to the left of its columns",
        L::LineAwayFromStart => "a line of holes that begins behind its start",
        L::RowAxis => "a row along another axis than those of the plane",
    })
}
