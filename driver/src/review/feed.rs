//! From a side to records: its program executed in the worlds of a comparison.

use std::io;
use std::ops::ControlFlow;

use ncc_diff::record::{Batch, Recorder, WORLDS};
use ncc_exec::Exec;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Distance, Fact};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Op, Point, Stmt};

use super::stream::{Course, Made, Stage, stream, worlds};
use crate::side::Side;

/// Records of a piece.
const PIECE: usize = 8192;

/// How a side is executed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings {
    /// Block-skip switches that are on: bit n is level n.
    pub skip: u16,
    /// Messages make no events where one side's control has none: whether those of program stops do.
    pub mute: Option<bool>,
    /// The control's own parameters of cycles.
    pub clearances: [Option<Nanos>; 2],
    /// Side effects that both controls are taken to have, with the switch for optional stops on; `None`: each has its own.
    pub besides: Option<Besides>,
}

/// Values for spindle, coolant and Z at stops, tool changes and the end of a program.
pub type Besides = [(Behaviour, u8); 7];

/// Executes a side and hands out its records, piece by piece; `take` may break off.
///
/// # Errors
/// Reading the source.
pub fn records(
    side: &mut Side,
    settings: Settings,
    take: &mut dyn FnMut(Batch) -> ControlFlow<()>,
) -> io::Result<Course> {
    let mut worlds = worlds(&side.job, settings.clearances);
    if let Some(besides) = settings.besides {
        for world in &mut worlds {
            besides.iter().for_each(|(behaviour, value)| world.behaviours.set(*behaviour, *value, false));
            world.optional_stop = true;
        }
    }
    let controls: Vec<Exec> = worlds
        .iter()
        .map(|world| {
            let mut exec = Exec::new(world, settings.skip);
            exec.narrate();
            exec.every_move();
            if let Some(but_stops) = settings.mute {
                exec.mute(but_stops);
            }
            exec
        })
        .collect();
    let mut recorder = Recorder::new([[0; AXES]; 1 + WORLDS]);
    let mut broken_off = false;
    let Side { source, job } = side;
    let course = stream(job, &mut source.file, controls, &mut |made: Made| {
        let [plain, one, two] = made.controls else { return ControlFlow::Break(()) };
        let incremental = match made.stage {
            Stage::Start => {
                recorder.stand([&plain.exec, &one.exec, &two.exec].map(Exec::machine));
                return ControlFlow::Continue(());
            }
            Stage::Stmt(stmt) => incremental(stmt),
            Stage::End => false,
        };
        recorder.record(&plain.exec, [&plain.events, &one.events, &two.events], incremental);
        if recorder.waiting() < PIECE {
            return ControlFlow::Continue(());
        }
        let goes_on = take(recorder.take());
        broken_off = goes_on.is_break();
        goes_on
    })?;
    if !broken_off {
        let _ = take(recorder.take());
    }
    Ok(course)
}

/// Whether a statement measures from where the tool stands.
fn incremental(stmt: &Stmt) -> bool {
    let measured =
        |to: &Point| to.axes.iter().flatten().any(|word| word.distance == Fact::Known(Distance::Incremental));
    match &stmt.op {
        Op::StraightFeed(to) | Op::StraightTraverse(to) | Op::Position(to) | Op::Hole(to) => measured(&to.to),
        Op::ArcFeed(arc) => measured(&arc.to),
        _ => false,
    }
}
