//! Two programs that stream, executed in step by one thread while two others read: what both say in the same words, in
//! one state of both controls, is executed once.
//!
//! ```text
//! source: G0 X0 | G1 X5 F100 | X6 | X7      output: G90 G0 X0 | G1 X5 F100 | X6 | X7
//!         compared event by event           as soon as both are in one state: lines of both at once
//! ```
//!
//! Why that proves the same as two executions: [`Exec::agrees_on_lines`] holds all against each other that plain lines
//! hang on, and [`same_plain`] that they are the same lines; then both make the same events, and reach one state again.
//! So a translation is verified, too ([`Verifier::piece`](crate::verify_run::Verifier::piece)). A comparison that passes
//! over something for what one control has done by itself goes on event by event until that is settled.
//!
//! Whatever ends a comparison early is left to `pair`, which compares both programs again: a difference, a refusal, a
//! program that is kept whole.

use std::io;

use ncc_exec::verify::{Comparison, counts_from_there, same_plain};
use ncc_exec::{Event, Exec};
use ncc_ir::canon::Modes;
use ncc_ir::program::Stmt;

use super::plan::Plan;
use crate::job::Job;
use crate::review::stream::{Course, Reading, Unsaid, Waiting, read};
use crate::side::Side;
use crate::side_by_side::{self, Pieces, Take};

/// Pieces that the reader of a side may be ahead.
const AHEAD: usize = 4;
/// Statements after which controls that were in different states are looked at again, at the most.
const MOST_PATIENCE: usize = 256;

/// The comparisons of two programs that both make the same of, from first to last; `None` where anything else came of them.
///
/// # Errors
/// Reading the programs.
pub(super) fn once(
    sides: &mut [Side; 2],
    plan: &Plan,
    skip: [u16; 2],
) -> io::Result<Option<Vec<Comparison>>> {
    let [Side { source, job }, Side { source: output, job: job_of_output }] = sides;
    let jobs: [&Job; 2] = [job, job_of_output];
    let first = |take: Take<Reading>| read(jobs[0], &mut source.file, Unsaid::Taken, take);
    let second = |take: Take<Reading>| read(jobs[1], &mut output.file, plan.unsaid, take);
    let mut both = InStep::new(plan, skip);
    let (over, courses) = side_by_side::run(first, second, AHEAD, |pieces| both.go(jobs, pieces));
    let (Some(()), [Some(first), Some(second)]) = (over, courses) else { return Ok(None) };
    let (first, second) = (first?, second?);
    let read = |course: &Course| !course.refused && !course.whole;
    let runs = both.runs.into_iter();
    Ok((read(&first) && read(&second)).then(|| runs.map(|run| run.comparison).collect()))
}

/// One world.
struct Run {
    controls: [Exec; 2],
    /// Events that are not compared yet.
    events: [Vec<Event>; 2],
    comparison: Comparison,
}

impl Run {
    /// Whether rows of a table make the same events on both controls, with nothing left to compare before them.
    fn agrees_on_rows(&self) -> bool {
        let [source, target] = &self.controls;
        self.comparison.is_settled() && source.agrees_on_rows(target)
    }

    /// Whether these lines make the same events on both controls.
    fn agrees_on(&self, lines: &[Stmt], absolute: bool) -> bool {
        let [source, target] = &self.controls;
        let absolute = absolute && source.counts_absolute() && target.counts_absolute();
        let switches = |stmt: &Stmt| stmt.skip.is_none() || source.skips(stmt) == target.skips(stmt);
        self.comparison.is_settled()
            && source.agrees_on_lines(target)
            && (absolute || source.counts_alike(target, lines))
            && lines.iter().all(switches)
    }
}

struct InStep {
    runs: Vec<Run>,
    waiting: [Waiting; 2],
    /// What is known of the output that it does not say.
    unsaid: Unsaid,
    /// Steps before the states of the controls are looked at again, and how many there will be the next time.
    waits: usize,
    patience: usize,
}

impl InStep {
    fn new(plan: &Plan, skip: [u16; 2]) -> InStep {
        let controls = plan.controls(0, skip[0]).into_iter().zip(plan.controls(1, skip[1]));
        let run = |((source, target), comparison)| Run {
            controls: [source, target],
            events: Default::default(),
            comparison,
        };
        let runs = controls.zip(plan.comparisons()).map(run).collect();
        InStep { runs, waiting: Default::default(), unsaid: plan.unsaid, waits: 0, patience: 1 }
    }

    /// Executes and compares all that comes from both sides; `None` where they differ or one is refused.
    fn go(&mut self, jobs: [&Job; 2], mut from: [Pieces<Reading>; 2]) -> Option<()> {
        loop {
            for side in [0, 1] {
                while self.waiting[side].is_empty() && !self.waiting[side].over {
                    match from[side]() {
                        Some(reading) => self.take(side, jobs[side], reading),
                        None => self.end(side)?,
                    }
                }
            }
            if self.waiting.iter().all(|side| side.over) {
                return Some(());
            }
            if !self.pass()? {
                self.step()?;
            }
        }
    }

    fn take(&mut self, side: usize, job: &Job, reading: Reading) {
        let assumed = reading.assumed;
        let stood = self.waiting[side].take(reading);
        let facts: Option<Modes> = match &self.unsaid {
            Unsaid::Only(facts) if side == 1 => Some(*facts),
            Unsaid::Only(_) | Unsaid::Taken => None,
        };
        for control in self.runs.iter_mut().map(|run| &mut run.controls[side]) {
            control.assume(&assumed);
            facts.iter().for_each(|facts| control.assume(facts));
            if !stood {
                control.stand_at(&job.start);
                job.tool_at_start().into_iter().for_each(|tool| control.hold_tool(tool));
            }
        }
    }

    /// The text of a side is over.
    fn end(&mut self, side: usize) -> Option<()> {
        self.waiting[side].over = true;
        for run in &mut self.runs {
            run.controls[side].no_open_corner().ok()?;
            run.controls[side].end_of_text(&mut run.events[side]);
        }
        self.compare()
    }

    /// Lets lines pass that both sides say next, in one state of their controls; whether there are any.
    fn pass(&mut self) -> Option<bool> {
        if self.waits > 0 {
            self.waits -= 1;
            return Some(false);
        }
        let nothing_left = |run: &Run| run.events.iter().all(Vec::is_empty);
        if !self.runs.iter().all(nothing_left) {
            return Some(false);
        }
        if self.pass_rows()? {
            return Some(true);
        }
        Waiting::unpack(&mut self.waiting);
        let [said, read] = self.waiting.each_ref().map(Waiting::rest);
        let same = said.iter().zip(read).take_while(|(a, b)| same_plain(a, b)).count();
        if same == 0 {
            return Some(false);
        }
        let lines = &said[..same];
        let absolute = !lines.iter().any(counts_from_there);
        if !self.runs.iter().all(|run| run.agrees_on(lines, absolute)) {
            self.waits = self.patience;
            self.patience = (2 * self.patience).min(MOST_PATIENCE);
            return Some(false);
        }
        self.patience = 1;
        for Run { controls: [source, target], comparison, .. } in &mut self.runs {
            let events = source.pass(lines).ok()?;
            target.follow(source);
            target.has_moved(lines);
            comparison.pass(events, source.machine());
        }
        self.waiting.iter_mut().for_each(|side| side.pass(same));
        Some(true)
    }

    /// Lets lines of tables pass that both sides say next, in one state of their controls; whether there are any.
    fn pass_rows(&mut self) -> Option<bool> {
        let [said, read] = self.waiting.each_ref().map(Waiting::rows);
        let same = said.said_by(read);
        if same == 0 || !self.runs.iter().all(Run::agrees_on_rows) {
            return Some(false);
        }
        let lines = said.split(same).0;
        let Some(mut valued) = self.runs.first().and_then(|run| run.controls[0].value_rows(lines)) else {
            return Some(false);
        };
        for Run { controls: [source, target], comparison, .. } in &mut self.runs {
            let events = source.pass_rows(lines, &mut valued).ok()?;
            target.follow(source);
            comparison.pass(events, source.machine());
        }
        self.waiting.iter_mut().for_each(|side| side.pass_rows(same));
        Some(true)
    }

    /// Executes the next statement of the side that is behind, and compares.
    fn step(&mut self) -> Option<()> {
        Waiting::unpack(&mut self.waiting);
        let ahead = |run: &Run| run.events[0].len() > run.events[1].len();
        let side = match self.waiting.each_ref().map(|side| side.over) {
            [true, _] => 1,
            [false, true] => 0,
            [false, false] => usize::from(self.runs.iter().any(ahead)),
        };
        let waiting = &mut self.waiting[side];
        let stmt = waiting.rest().first()?;
        let mut silent = true;
        for run in &mut self.runs {
            run.controls[side].step(stmt, &mut run.events[side]).ok()?;
            silent &= run.events[side].is_empty();
        }
        waiting.pass(1);
        if silent { Some(()) } else { self.compare() }
    }

    fn compare(&mut self) -> Option<()> {
        let over = self.waiting.each_ref().map(|side| side.over);
        for Run { events: [source, target], comparison, .. } in &mut self.runs {
            comparison.advance(source, target, false).ok()?;
            // What is left of one side when the other is over must be nothing.
            if over[0] && source.is_empty() || over[1] && target.is_empty() {
                comparison.advance(source, target, true).ok()?;
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};

    use super::*;
    use crate::machines::pair::Machines;
    use crate::review::verify::pair::{Verdict, compare};
    use crate::source::Source;
    use crate::source::spliced::behind_a_piece;
    use crate::source::spool::Spool;

    const HEAD: &str = "G21 G17 G90 G94 G40 G49 G80\nG54\nT1 M6\nG0 X0. Y0. S500 M3\nG43 H1 Z50.\n";

    fn lines(count: usize) -> Vec<String> {
        let line = |n: usize| match n % 5 {
            0 => format!("G1 X{n}. F{}.", 100 + n),
            1 => format!("X{n}.5 Y-{n}.25"),
            2 => format!("/2 Z-0.{n:03}"),
            3 => "G91 X0.5 Y0.5\nG90".to_owned(),
            _ => format!("G0 Z5. (LINE {n})"),
        };
        (5..5 + count).map(line).collect()
    }

    fn program(head: &str, lines: &[String]) -> String {
        format!("%\nO1\n{head}{}\nM5\nM30\n%\n", lines.join("\n"))
    }

    /// The verdict, and how many events were compared.
    fn compared(texts: [&str; 2]) -> (Verdict, u64) {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        let machines = || Machines { from: None, to: None };
        let side = |text: &str| {
            Side::of(Source::of(Spool::of(text.into()), "a"), settings.clone(), machines(), None)
        };
        let found = compare(&mut texts.map(side), 0).expect("memory");
        (found.verdict, found.events)
    }

    /// What passes is counted as what is compared; the number of events is the same where a subprogram, which is called
    /// last, keeps both programs whole.
    #[test]
    fn lines_that_pass_are_counted() {
        let lines = lines(40);
        let text = program(HEAD, &lines);
        let (verdict, events) = compared([&text, &text]);
        assert_eq!(verdict, Verdict::Equal);
        let other = text.replace("O1\n", "O1\n(OTHER)\nG80\n");
        assert_eq!(compared([&text, &other]), (Verdict::Equal, events));
        let called = text.replace("M5\n", "M98 P2\nM5\n").replace("M30\n%", "M30\nO2\nM99\n%");
        assert_eq!(compared([&called, &called]), (Verdict::Equal, events));
    }

    /// Other lines for one of those.
    fn others(n: usize) -> Vec<String> {
        match n % 5 {
            0 => vec![format!("G1 X{n}.001 F{}.", 100 + n), format!("G1 X{n}. F{}.", 200 + n)],
            1 => vec![format!("X{n}.5 Y-{n}.26"), format!("G0 X{n}.5 Y-{n}.25"), format!("X{n}.5")],
            2 => vec![format!("Z-0.{n:03}"), format!("/2 Z0.{n:03}"), format!("/2 Y-0.{n:03}")],
            3 => vec!["G91 X0.5 Y0.6\nG90".to_owned(), "G90 X0.5 Y0.5".to_owned()],
            _ => vec![format!("G0 Z5.1 (LINE {n})"), "G0 Z5.\nX-1.".to_owned()],
        }
    }

    /// Whichever line is another one, the programs are different.
    #[test]
    fn a_line_that_says_something_else_does_not_pass() {
        let all = lines(20);
        let text = program(HEAD, &all);
        for at in 0..all.len() {
            for line in others(at + 5) {
                let mut other = all.clone();
                other[at].clone_from(&line);
                let verdict = compared([&text, &program(HEAD, &other)]).0;
                assert_eq!(verdict, Verdict::Different, "{} as {line}", all[at]);
            }
        }
    }

    /// Plain lines of several pieces, which are read as tables.
    fn many_lines() -> Vec<String> {
        let line = |n: usize| match n % 9 {
            0 => format!("G1 X{n}. F{}.", 100 + n),
            4 => format!("G0 Z{n}."),
            5 => format!("G1 Z-0.{n:04}"),
            _ => format!("X{n}.5 Y-{n}.25"),
        };
        (0..3_000).map(line).collect()
    }

    /// Those of tables are counted too, wherever the pieces of both texts end.
    #[test]
    fn lines_of_tables_are_counted() {
        let lines = many_lines();
        let text = program(HEAD, &lines);
        let (verdict, events) = compared([&text, &text]);
        assert_eq!(verdict, Verdict::Equal);
        let skipped: Vec<String> = lines.iter().map(|line| format!("{line} (A REMARK)")).collect();
        for other in [
            text.replacen("O1\n", "O1\n(OTHER)\nG80\n", 1),
            text.replacen("\nX1000", "\n(A REMARK)\nX1000", 1),
            text.replace("\nX", "\nN7 X"),
            program(HEAD, &skipped),
        ] {
            assert_eq!(compared([&text, &other]), (Verdict::Equal, events));
            assert_eq!(compared([&other, &text]), (Verdict::Equal, events));
        }
    }

    /// Whichever line of a table is another one, the programs are different; and so they are where they are in another
    /// state before all of them.
    #[test]
    fn lines_of_tables_that_say_something_else_do_not_pass() {
        let lines = many_lines();
        let text = program(HEAD, &lines);
        for at in (1_000..lines.len()).step_by(211) {
            let fed = match lines[at].contains('F') {
                true => lines[at].replacen(" F", " F9", 1),
                false => format!("{} F7.", lines[at]),
            };
            for line in [lines[at].replacen('.', "1.", 1), fed, "G0 Z7.5".to_owned()] {
                let mut other = lines.clone();
                other[at].clone_from(&line);
                let verdict = compared([&text, &program(HEAD, &other)]).0;
                assert_eq!(verdict, Verdict::Different, "{} as {line}", lines[at]);
            }
        }
        for (from, to) in
            [("S500", "S600"), ("G54", "G55"), ("H1", "H2"), ("G21", "G20"), ("G94", "G95"), ("M3", "M4")]
        {
            let other = program(&HEAD.replacen(from, to, 1), &lines);
            assert_ne!(compared([&text, &other]).0, Verdict::Equal, "{from} as {to}");
        }
    }

    /// Lines of a table are something else to a control in another state, where just the block before them, which makes
    /// nothing by itself, has brought it there.
    #[test]
    fn lines_of_tables_do_not_pass_in_another_state() {
        let lines = ["X1. Y1.", "X2. Y1.", "Y2. Z-1.", "X1.5"].map(str::to_owned);
        let head = format!("{HEAD}G1 X0. F100.\n");
        let text = behind_a_piece(&head, "G54", &lines);
        assert_eq!(compared([&text, &text]).0, Verdict::Equal);
        for block in
            ["S600", "G55", "G95", "G91", "G20", "G52 X1.", "F50.", "M4", "G49", "G54\nG68 X0. Y0. R30."]
        {
            let other = behind_a_piece(&head, block, &lines);
            assert_ne!(compared([&text, &other]).0, Verdict::Equal, "{block}");
            assert_ne!(compared([&other, &text]).0, Verdict::Equal, "{block}");
        }
    }

    /// The same lines are something else to a control in another state.
    #[test]
    fn lines_do_not_pass_in_another_state() {
        let lines = ["G1 X10. F100.", "X20. Y5.", "Y6.", "X7. Z-1.", "G0 Z50."].map(str::to_owned);
        let text = program(HEAD, &lines);
        for (from, to) in [
            ("G54", "G55"),
            ("S500", "S600"),
            ("M3", "M4"),
            ("T1", "T2"),
            ("H1", "H2"),
            ("G21", "G20"),
            ("G94", "G95"),
            ("M3\\n", "M3 M8\\n"),
            ("G43 H1 Z50.", "Z50."),
            ("G43 H1 Z50.", "G43 H1 Z50.\\nG68 X0. Y0. R30."),
            ("G43 H1 Z50.", "G43 H1 Z50.\\nG52 X1."),
        ] {
            let (from, to) = (from.replace("\\n", "\n"), to.replace("\\n", "\n"));
            let other = program(&HEAD.replacen(&from, &to, 1), &lines);
            assert_ne!(other, text);
            assert_ne!(compared([&text, &other]).0, Verdict::Equal, "{from} as {to}");
        }
    }
}
