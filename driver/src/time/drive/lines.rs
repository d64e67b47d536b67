//! Lines of a table with their times: the first that goes in a way as a statement, those behind it along their way.
//!
//! ```text
//! G1 X5. F100.    a step of the control makes an event of it
//! X6.             the same event, elsewhere
//! ```
//!
//! Not here: when that is so ([`Exec::way_along`](ncc_exec::Exec::way_along)).

use std::io;
use std::rc::Rc;

use ncc_exec::{Event, Kind};
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::rows::Rows;
use ncc_ir::source::Span;
use ncc_time::{Act, Place};

use super::super::reach::{reach, turned};
use super::{Drive, Said, Tip};

impl<'d> Drive<'d> {
    /// Executes lines, which have nothing of what is noted of statements but that they are blocks.
    pub(super) fn lines(&mut self, mut lines: Rows, text: &[u8]) -> io::Result<()> {
        self.course.blocks += lines.len() as u64;
        if self.errors > 0 || lines.is_empty() {
            return Ok(());
        }
        self.assume(self.batch.assumed);
        let mut stmts = Vec::new();
        while !lines.is_empty() {
            let (first, behind) = lines.split(1);
            stmts.clear();
            first.unpack(&mut stmts);
            for stmt in &stmts {
                self.line = None;
                if let Err(refusal) = self.statement(stmt, text)? {
                    self.take(refusal);
                    return Ok(());
                }
            }
            let along = match self.line.take() {
                Some(last) => self.along(behind, &last, text)?,
                None => 0,
            };
            lines = behind.split(along).1;
        }
        Ok(())
    }

    /// Goes along the lines that make the same event as the last one, and passes it on for each; gives how many they are.
    fn along(&mut self, lines: Rows, last: &Event, text: &[u8]) -> io::Result<usize> {
        let mut made = std::mem::take(&mut self.along);
        made.clear();
        let way = self.exec.way_along(lines, last, |row, _, end| made.push((row.span(), row.axes(), *end)));
        if let Some(way) = &way {
            self.exec.go_along(way);
        }
        for (span, axes, end) in &made {
            let (place, mut said) = self.place(*span, text);
            // Words of rows are absolute.
            said.tip.stated = std::array::from_fn(|axis| axes >> axis & 1 == 1);
            self.follow_along(place.line);
            said.executed = self.executed();
            self.event(Event { span: *span, end: *end, ..last.clone() }, place, said);
        }
        self.along = made;
        self.deliver()?;
        Ok(way.map_or(0, |way| way.lines()))
    }

    /// Where a statement stands.
    pub(super) fn place(&mut self, span: Span, text: &[u8]) -> (Place, Said) {
        let line = self.blocks.number_of(text, span.start).unwrap_or(0);
        let block = if self.wants_blocks { self.blocks.text_of(text, span.start) } else { None };
        let block = block.unwrap_or_else(|| Rc::clone(&self.nothing));
        (Place { line, span }, Said { block, executed: self.executed(), ..Said::default() })
    }

    /// What leads to where the tip is, as the control has it now.
    fn tip(&self, said: Tip) -> Tip {
        let (tool, zero) = (self.exec.tool_adds(), self.exec.in_program(&[0; AXES]));
        let zero = [0, 1, 2].map(|axis| -zero[axis] - tool[axis]);
        Tip { tool, zero, offset: self.exec.offset_in_force(), ..said }
    }

    /// Passes an event on, with what its block says.
    pub(super) fn event(&mut self, mut event: Event, place: Place, said: Said) {
        if matches!(event.kind, Kind::Attribute(_)) {
            // A remark between two blocks of a rounded corner moves nothing: the control stands before the corner.
            event.end = self.last;
        }
        let act = Act::of(event, self.last, &self.exec, place);
        self.moves(&act);
        self.last = act.event.end;
        let arc = matches!(act.event.kind, Kind::Arc { .. });
        let reach = if arc && self.wants_reach { reach(&act, &self.exec) } else { None };
        let turned = if arc && self.wants_turns { turned(&act, &self.exec) } else { None };
        let (reach, turned) = (reach.map(Box::new), turned.map(Box::new));
        let tip = match self.wants_tip {
            true => self.tip(said.tip),
            false => said.tip,
        };
        self.said.push_back(Said { reach, turned, tip, ..said });
        if let Some(longest) = &mut self.beside {
            longest.push(&act);
        }
        self.clock.push(act);
    }
}

/// Where a line stands, the axes that it names, bit by bit, and where it ends in the machine.
pub(super) type Made = (Span, u8, [Nanos; AXES]);

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_exec::world::Tables;
    use ncc_time::{Machine, Model, Timed};

    use super::super::{Plan, Said, Sink, Stage, Unwatched, drive};
    use super::*;
    use crate::job::Job;
    use crate::source::Source;
    use crate::source::spliced::{CHANGES, behind_a_piece};
    use crate::source::spool::Spool;

    #[derive(Default)]
    struct Kept(Vec<Timed>);

    impl Sink for Kept {
        fn wants_bounds(&self) -> bool {
            true
        }

        fn function(&mut self, timed: &Timed, _: &Said) -> io::Result<()> {
            let mut timed = timed.clone();
            (timed.act.event.span, timed.act.place.span) = (Span::default(), Span::default());
            self.0.push(timed);
            Ok(())
        }
    }

    /// All functions, how many blocks there are, and the bounds of the whole; whether it was refused.
    fn timed(text: &str, model: Model, centre: bool) -> (Vec<Timed>, u64, Option<[f64; 2]>, bool) {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        let job = Job::new(settings.clone(), settings, "a.nc");
        let mut plan = Plan {
            job: &job,
            machine: Machine::default(),
            tables: Tables::default(),
            parameters: [None; 2],
            model,
            skip: 0,
            start_time: 10.0,
            stage: Stage::After,
            centre,
        };
        plan.machine.rapid_rate = Some(9_000.0);
        let mut kept = Kept::default();
        let mut source = Source::of(Spool::of(text.into()), "a.nc");
        let course = drive(&plan, &mut source, &mut kept, &mut Unwatched).expect("memory");
        (kept.0, course.blocks, course.bounds, course.refused)
    }

    /// Lines of tables are reported with the times of statements: blocks under a level of block skip that is off are such.
    #[test]
    fn lines_of_tables_have_the_times_of_statements() {
        let line = |n: usize| match n % 11 {
            0 => format!("G1 X{n}. F{}.", 100 + n % 3),
            4 => format!("G0 Z{n}."),
            5 => format!("G1 Z-0.{n:04}"),
            7 => "X1. Y2.".to_owned(),
            8 => "X1.".to_owned(),
            _ => format!("X{n}.5 Y-{n}.25"),
        };
        let lines: Vec<String> = (0..4_000).map(line).collect();
        for head in [
            "G21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nG0 X0. Y0. S500 M3\nG43 H1 Z50.\n",
            "G21 G17 G90 G95 G40 G49 G80\nG55\nT1 M6\nS500 M3\nG0 X0.\n",
            "G20 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nS500 M3\nG0 X0. Y0. Z0.\nG1 Z-0.1 F9.\n",
            "G21 G17 G90 G94 G40 G49 G80\nG54\n",
        ] {
            for (model, centre) in [(Model::Ideal, true), (Model::Ideal, false), (Model::Trapezoidal, true)] {
                let program = |skip: &str| {
                    let lines: Vec<String> = lines.iter().map(|line| format!("{skip}{line}")).collect();
                    format!("%\nO1\n{head}{}\nM5\nM30\n%\n", lines.join("\n"))
                };
                let [tables, statements] = ["", "/"].map(|skip| timed(&program(skip), model, centre));
                assert_eq!(tables.0.len(), statements.0.len(), "{head}");
                for (one, other) in tables.0.iter().zip(&statements.0) {
                    assert_eq!(one, other, "{head}");
                }
                assert_eq!((tables.1, tables.2), (statements.1, statements.2), "{head}");
                assert!(tables.0.len() > 2_000 && !tables.3 && !statements.3);
            }
        }
    }

    /// A remark between the blocks of a rounded corner takes the control nowhere.
    #[test]
    fn a_remark_before_a_corner_moves_nothing() {
        let program = |remark: &str| {
            format!(
                "%\nO1\nG21 G17 G90 G94 G40 G49 G80 G54\nT1 M6\nS500 M3\nG0 X0. Y0. Z0.\nG1 X40. F100. ,R1.\n{remark}\
                 G3 X20. Y20. R20. ,R2.\nG1 Y0.\nM30\n%\n"
            )
        };
        let [plain, remarked] =
            ["", "(BOTH ENDS)\n"].map(|remark| timed(&program(remark), Model::Ideal, true));
        let moves = |all: &[Timed]| -> Vec<_> {
            let moves = all.iter().filter(|timed| timed.act.event.kind.moves().is_some());
            moves.map(|timed| (timed.act.from, timed.act.event.end, timed.duration)).collect()
        };
        assert!(moves(&plain.0).len() > 5 && !plain.3 && !remarked.3);
        assert_eq!(moves(&plain.0), moves(&remarked.0));
    }

    /// So are those that begin a piece behind a block that changes what they hang on.
    #[test]
    fn lines_of_tables_have_the_times_of_statements_behind_changes() {
        let head = "G21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nG0 X0. Y0. S500 M3\nG43 H1 Z50.\nG1 X0. F100.\n";
        let rows: [&[&str]; 3] = [
            &["G1 X1.", "X2.", "X3. Z5.", "Y4.", "Y4.", "X5. Y1. F90.", "G0 X1.", "Z7.", "Z8."],
            &["G1 X1. F9.", "X2. F9.", "X3. F8."],
            &["G0 X1.", "X2.", "Y3. Z1.", "G1 X1."],
        ];
        for (block, rows) in CHANGES.into_iter().flat_map(|block| rows.map(|rows| (block, rows))) {
            let [tables, statements] = ["", "/"].map(|skip| {
                let rows: Vec<String> = rows.iter().map(|row| format!("{skip}{row}")).collect();
                timed(&behind_a_piece(head, block, &rows), Model::Trapezoidal, true)
            });
            assert_eq!(tables.3, statements.3, "{block} {rows:?}");
            assert!(tables.0.len() > 500 || tables.3, "{block} {rows:?}");
            for (one, other) in tables.0.iter().zip(&statements.0) {
                assert_eq!(one, other, "{block} {rows:?}");
            }
            if !tables.3 {
                assert_eq!(
                    (tables.0.len(), tables.1, tables.2),
                    (statements.0.len(), statements.1, statements.2)
                );
            }
        }
    }
}
