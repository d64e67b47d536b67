//! A program cut: its moves through the kernel, and what each tool did.

use ncc_exec::halt;
use ncc_ir::source::Span;
use ncc_simulate::{Alarm, Fixture, Setup, Simulation, Stock, Way};

use super::path::Path;
use super::raw;
use super::tooling::Fitted;
use super::unsimulated::Unsimulated;

/// What is set up on the machine.
#[derive(Clone, Debug)]
pub struct Bench {
    /// The raw part, where it is known.
    pub stock: Option<Stock>,
    /// Whether it is a guess: it always is where it is not known.
    pub guessed: bool,
    /// What holds it.
    pub fixtures: Vec<Fixture>,
    /// Z of the table, mm.
    pub table: Option<f64>,
    /// Cells along the longer side of the part.
    pub cells: usize,
}

/// Why a program is not cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uncut {
    /// The kernel cannot do what it does here.
    Unsimulated(Unsimulated, Span),
    /// It cuts nothing, so that no raw part can be guessed.
    NoCut,
    /// The host asked the work to stop, before the move of a line.
    Halted(u32),
}

/// So many moves are cut between two looks at whether the work shall stop.
const STRETCH: usize = 64;

/// What a tool did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worked {
    /// What it removed, mm³.
    pub volume: f64,
    /// Seconds of moves at feed.
    pub cutting: f64,
    /// Greatest depth that a move of it removed at a place, mm.
    pub depth: f64,
}

/// A program that was cut.
#[derive(Debug)]
pub struct CutProgram {
    /// The part, its moves, its alarms.
    pub simulation: Simulation,
    /// The rest of what is known of the moves; the moves themselves are the simulation's.
    pub path: Path,
    /// The tools, by their places.
    pub tools: Vec<Fitted>,
    /// What each did.
    pub worked: Vec<Worked>,
}

/// Cuts a program.
///
/// # Errors
/// As [`Uncut`] says.
pub fn cut(mut path: Path, tools: Vec<Fitted>, bench: Bench) -> Result<CutProgram, Uncut> {
    if let Some((why, span)) = path.unsimulated {
        return Err(Uncut::Unsimulated(why, span));
    }
    let guessed = bench.guessed || bench.stock.is_none();
    let stock = bench.stock.or_else(|| raw::guess(&path, &tools)).ok_or(Uncut::NoCut)?;
    let mut simulation = Simulation::new(Setup {
        stock,
        guessed,
        cells: bench.cells,
        tools: tools.iter().map(|tool| tool.tool.clone()).collect(),
        fixtures: bench.fixtures,
        table: bench.table,
        start: path.start,
        tilts: path.tilts.clone(),
    });
    let mut worked = vec![Worked::default(); tools.len()];
    // The kernel keeps them.
    for (at, (own, begin)) in std::mem::take(&mut path.moves).into_iter().zip(&path.begins).enumerate() {
        if at % STRETCH == 0 && halt::is_asked() {
            return Err(Uncut::Halted(own.line));
        }
        simulation.push(own);
        let removed = simulation.removed()[simulation.shown() - 1];
        let work = &mut worked[own.tool];
        work.volume += f64::from(removed.volume);
        work.depth = work.depth.max(f64::from(removed.depth));
        if matches!(own.way, Way::Feed | Way::Arc { .. }) {
            work.cutting += own.time - begin;
        }
    }
    Ok(CutProgram { simulation, path, tools, worked })
}

impl CutProgram {
    /// The tools of another program, with those of this one where their numbers are the same: guesses too, so that only the
    /// moves of both differ.
    pub fn shared_tools(&self, other: &Path, mut fitted: Vec<Fitted>) -> Vec<Fitted> {
        for (used, own) in other.tools.iter().zip(&mut fitted) {
            if let Some(at) = self.path.tools.iter().position(|tool| tool.number == used.number) {
                *own = self.tools[at].clone();
            }
        }
        fitted
    }

    /// What was removed in all, mm³.
    pub fn volume(&self) -> f64 {
        self.worked.iter().map(|own| own.volume).sum()
    }

    /// The alarms.
    pub fn alarms(&self) -> &[Alarm] {
        self.simulation.alarms()
    }

    /// Whether there is an alarm that does not rest on a guess.
    pub fn has_sure_alarms(&self) -> bool {
        self.alarms().iter().any(|alarm| !alarm.guessed)
    }

    /// How many moves are over at a moment, seconds on the clock.
    pub fn moves_at(&self, time: f64) -> usize {
        self.simulation.moves().partition_point(|own| own.time <= time)
    }

    /// How many moves are over when a line of the source has been carried out for the first time: of one without a move,
    /// before the next line that has one.
    pub fn moves_behind_line(&self, line: u32) -> usize {
        let moves = self.simulation.moves();
        let Some(first) = moves.iter().position(|own| own.line == line) else {
            let next = moves.iter().map(|own| own.line).filter(|own| *own > line).min();
            return next
                .and_then(|next| moves.iter().position(|own| own.line == next))
                .unwrap_or(moves.len());
        };
        let end = moves[first..].iter().position(|own| own.line != line);
        first + end.unwrap_or(moves.len() - first)
    }

    /// The tools that cut with less than two cells in radius, which a grid does not show well, and how many cells there
    /// would have to be along the longer side.
    pub fn coarse(&self) -> Option<(Vec<i64>, usize)> {
        let grid = self.simulation.map().grid;
        let radius = |own: &Fitted| own.tool.cutter.radius();
        let thin: Vec<&Fitted> = self.tools.iter().filter(|own| radius(own) < 2.0 * grid.cell).collect();
        let least = thin.iter().map(|own| radius(own)).reduce(f64::min)?;
        let side = grid.cell * grid.cells[0].max(grid.cells[1]) as f64;
        Some((thin.iter().map(|own| own.tool.number).collect(), (2.0 * side / least).ceil() as usize))
    }
}
