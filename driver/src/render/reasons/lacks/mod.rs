//! The words of what a target lacks: one file a wing of `ncc_ir::lack`.

mod arcs;
mod compensation;
mod corners;
mod feeds;
mod flow;
mod frames;
mod holes;
mod lengths;
mod machine;
mod modes;
mod operator;
mod patterns;
mod polar;
mod spindle;
mod tables;
mod threads;
mod tools;
mod words;

use std::borrow::Cow;

use ncc_ir::lack::Lack;

/// What the target lacks, as a message names it after "no words for this".
pub(crate) fn text(lack: &Lack) -> Cow<'static, str> {
    match lack {
        Lack::Holes(lack) => holes::text(lack),
        Lack::Patterns(lack) => patterns::text(lack),
        Lack::Threads(lack) => threads::text(lack),
        Lack::Arcs(lack) => arcs::text(lack).into(),
        Lack::Corners(lack) => corners::text(lack).into(),
        Lack::Compensation(lack) => compensation::text(lack),
        Lack::Frames(lack) => frames::text(lack),
        Lack::Machine(lack) => machine::text(lack).into(),
        Lack::Tools(lack) => tools::text(lack),
        Lack::Lengths(lack) => lengths::text(lack),
        Lack::Tables(lack) => tables::text(lack),
        Lack::Modes(lack) => modes::text(lack),
        Lack::Feeds(lack) => feeds::text(lack).into(),
        Lack::Spindle(lack) => spindle::text(lack).into(),
        Lack::Flow(lack) => flow::text(lack),
        Lack::Operator(lack) => operator::text(lack),
        Lack::Words(lack) => words::text(lack),
        Lack::Polar(lack) => polar::text(lack).into(),
    }
}
