//! From a side to records: its program executed in the worlds of a comparison.

use std::io;
use std::ops::ControlFlow;

use ncc_diff::record::{Batch, Recorder, WORLDS};
use ncc_exec::Exec;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Distance, Fact};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::rows::Rows;
use ncc_ir::program::{Op, Point, Stmt};

use super::stream::{Control, Course, Made, Stage, Takes, stream_lines, worlds};
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
    let recorder = Recorder::new([[0; AXES]; 1 + WORLDS]);
    let mut feed = Feed { recorder, take, broken_off: false };
    let Side { source, job } = side;
    let course = stream_lines(job, &mut source.file, controls, &mut feed)?;
    if !feed.broken_off {
        let _ = (feed.take)(feed.recorder.take());
    }
    Ok(course)
}

/// Makes records of what a program makes, and hands them out.
struct Feed<'f> {
    recorder: Recorder,
    take: &'f mut dyn FnMut(Batch) -> ControlFlow<()>,
    broken_off: bool,
}

impl Takes for Feed<'_> {
    fn made(&mut self, made: Made) -> ControlFlow<()> {
        let [plain, one, two] = made.controls else { return ControlFlow::Break(()) };
        let incremental = match made.stage {
            Stage::Start => {
                self.recorder.stand([&plain.exec, &one.exec, &two.exec].map(Exec::machine));
                return ControlFlow::Continue(());
            }
            Stage::Stmt(stmt) => incremental(stmt),
            Stage::End => false,
        };
        self.recorder.record(&plain.exec, [&plain.events, &one.events, &two.events], incremental);
        if self.recorder.waiting() < PIECE {
            return ControlFlow::Continue(());
        }
        let goes_on = (self.take)(self.recorder.take());
        self.broken_off = goes_on.is_break();
        goes_on
    }

    fn lines(&mut self, lines: Rows, controls: &mut [Control]) -> usize {
        let [plain, one, two] = controls else { return 0 };
        let last = |control: &Control| match control.events.as_slice() {
            [event] => Some(event.clone()),
            _ => None,
        };
        let along = |control: &Control| {
            last(control).is_some_and(|last| control.exec.goes_along_with(&plain.exec, &last))
        };
        let (Some(last), true, true) = (last(plain), along(one), along(two)) else { return 0 };
        let stand = [&plain.exec, &one.exec, &two.exec].map(Exec::machine);
        let Some(mut record) = self.recorder.goes_on(last.span.start, stand) else { return 0 };
        let way = plain.exec.way_along(lines, &last, |row, _, end| record(row.span().start, end));
        drop(record);
        let Some(way) = way else { return 0 };
        for control in [&mut *plain, &mut *one, &mut *two] {
            control.exec.go_along(&way);
        }
        self.recorder.stand([&plain.exec, &one.exec, &two.exec].map(Exec::machine));
        way.lines()
    }
}

/// Whether a statement measures from where the tool is.
fn incremental(stmt: &Stmt) -> bool {
    let measured =
        |to: &Point| to.axes.iter().flatten().any(|word| word.distance == Fact::Known(Distance::Incremental));
    match &stmt.op {
        Op::StraightFeed(to) | Op::StraightTraverse(to) | Op::Position(to) | Op::Hole(to) => measured(&to.to),
        Op::ArcFeed(arc) => measured(&arc.to),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machines::pair::Machines;
    use crate::source::Source;
    use crate::source::spliced::{CHANGES, behind_a_piece};
    use crate::source::spool::Spool;
    use ncc_dialects::{Settings as Options, builtin};
    use ncc_diff::record::{Record, Style};

    fn recorded(text: &str) -> (Vec<Record>, Vec<Style>, bool) {
        let settings = Options::new(builtin("fanuc").expect("a built-in dialect"));
        let machines = Machines { from: None, to: None };
        let mut side = Side::of(Source::of(Spool::of(text.into()), "a"), settings, machines, None);
        let (mut all, mut styles) = (Vec::new(), Vec::new());
        let course = records(&mut side, Settings::default(), &mut |batch| {
            all.extend(batch.records);
            styles.extend(batch.styles);
            ControlFlow::Continue(())
        });
        (all, styles, course.expect("memory").refused)
    }

    /// Lines of tables leave the records that statements leave: blocks under a level of block skip that is off are such.
    #[test]
    fn lines_of_tables_are_recorded_as_statements() {
        let line = |n: usize| match n % 11 {
            0 => format!("G1 X{n}. F{}.", 100 + n % 3),
            4 => format!("G0 Z{n}."),
            5 => format!("G1 Z-0.{n:04}"),
            7 => "X1. Y2.".to_owned(),
            8 => "X1.".to_owned(),
            _ => format!("X{n}.5 Y-{n}.25"),
        };
        let lines: Vec<String> = (0..3_000).map(line).collect();
        let heads = [
            "G21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nG0 X0. Y0. S500 M3\nG43 H1 Z50.\n",
            "G21 G17 G90 G95 G40 G49 G80\nG55\nT1 M6\nS500 M3\nG0 X0.\n",
            "G20 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nS500 M3\nG0 X0. Y0. Z0.\nG1 Z-0.1 F9.\n",
            "G21 G17 G90 G94 G40 G49 G80\nG54\n",
        ];
        for head in heads {
            let program = |skip: &str| {
                let lines: Vec<String> = lines.iter().map(|line| format!("{skip}{line}")).collect();
                format!("%\nO1\n{head}{}\nM5\nM30\n%\n", lines.join("\n"))
            };
            let [(tables, styles, refused), (statements, styles_there, _)] =
                ["", "/"].map(|skip| recorded(&program(skip)));
            assert!(!refused);
            assert_eq!(styles, styles_there, "{head}");
            assert_eq!(tables.len(), statements.len(), "{head}");
            for (one, other) in tables.iter().zip(&statements) {
                let mut one = *one;
                one.at = other.at;
                assert_eq!(one, *other, "{head}");
            }
            assert!(tables.len() > 2_000);
        }
    }

    /// So are those that begin a piece behind a block that changes what they hang on, or where each world has the machine.
    #[test]
    fn lines_of_tables_are_recorded_as_statements_behind_changes() {
        let head = "G21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nG0 X0. Y0. S500 M3\nG43 H1 Z50.\nG1 X0. F100.\n";
        let rows: [&[&str]; 3] = [
            &["G1 X1.", "X2.", "X3. Z5.", "Y4.", "Y4.", "X5. Y1. F90.", "G0 X1.", "Z7.", "Z8."],
            &["G1 X1. F9.", "X2. F9.", "X3. F8."],
            &["G0 X1.", "X2.", "Y3. Z1.", "G1 X1."],
        ];
        for (block, rows) in CHANGES.into_iter().flat_map(|block| rows.map(|rows| (block, rows))) {
            let [tables, statements] = ["", "/"].map(|skip| {
                let rows: Vec<String> = rows.iter().map(|row| format!("{skip}{row}")).collect();
                recorded(&behind_a_piece(head, block, &rows))
            });
            assert_eq!((&tables.1, tables.2), (&statements.1, statements.2), "{block} {rows:?}");
            let few = tables.0.len().min(statements.0.len());
            assert!(few > 500 || tables.2, "{block} {rows:?}");
            for (one, other) in tables.0.iter().zip(&statements.0) {
                let mut one = *one;
                one.at = other.at;
                assert_eq!(one, *other, "{block} {rows:?}");
            }
        }
    }
}
