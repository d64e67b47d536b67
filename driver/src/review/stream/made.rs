//! What a program does, statement by statement, as it is given to its taker.

use std::ops::ControlFlow;

use ncc_exec::{Event, Exec};
use ncc_ir::program::Stmt;
use ncc_ir::program::rows::Rows;

/// A control in a world, and what the last statement made in it.
#[derive(Clone, Debug)]
pub struct Control {
    /// The control.
    pub exec: Exec,
    /// Events of the last statement.
    pub events: Vec<Event>,
}

/// How far an execution is.
#[derive(Clone, Copy)]
pub enum Stage<'s> {
    /// Nothing has been executed; the tools stand where they start.
    Start,
    /// A statement that made events in one world at least.
    Stmt(&'s Stmt),
    /// The text is over.
    End,
}

/// What the controls did in one statement.
pub struct Made<'m> {
    /// How far the program is.
    pub stage: Stage<'m>,
    /// The controls, in the order in which they were given, after it.
    pub controls: &'m [Control],
}

/// Takes what a program makes.
pub trait Takes {
    /// The start, a statement, or the end; it may break off.
    fn made(&mut self, made: Made) -> ControlFlow<()>;

    /// Executes the first of these lines together, as many as go on like the line that was taken last, and takes what they
    /// do. Gives how many they are; the rest are executed as statements.
    fn lines(&mut self, lines: Rows, controls: &mut [Control]) -> usize;
}

/// Takes what statements make.
pub(super) struct OfStatements<'t>(pub(super) &'t mut dyn FnMut(Made) -> ControlFlow<()>);

impl Takes for OfStatements<'_> {
    fn made(&mut self, made: Made) -> ControlFlow<()> {
        (self.0)(made)
    }

    fn lines(&mut self, _: Rows, _: &mut [Control]) -> usize {
        0
    }
}
