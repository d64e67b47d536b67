//! Questions: facts of a source's control that the program does not state and that change its cut.
//!
//! A fact is asked only if its two values, executed, make two different cuts of this program. `find` takes the
//! facts that a reading has assumed, runs the source under both values (`race`), and keeps those that differ.
//!
//! ```text
//! G43 H1 Z100     → is Z100 100 mm or 0.1 mm?   answer: `--from-option decimal_point=…`
//! ```
//!
//! A program that touches no such fact is not read again. Not here: the words (`render::questions`), and what a
//! verb does with a question.

pub mod question;
pub mod race;

use std::io::{self, SeekFrom};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::{
    ARC_CENTRES, CALCULATOR, CYCLE_BESIDE_MOTION, DECIMAL_POINT, Dialect, FROM_START, FROM_ZERO,
    INTEGER_FEED, MOTION_CANCELS, MOTION_DRILLED, RETURN_DISTANCE, RETURN_FIRST, RETURN_LAST, Settings,
};
use ncc_frontends::{BareNumber, Batch};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Units;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, ModeName};
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::source::Span;

use self::race::{Difference, Finish, GENERATED, MICROMETRE, Measure, PLAIN, TENTH, race};
use crate::job::{Job, Outcome};
use crate::problem::Problem;
use crate::render::questions as words;
use crate::source::chunks::{Chunk, Chunks};
use crate::source::{Readable, Source};

pub use self::question::{Answer, Fact, Made, Policy, Question, Reading, Shown};

/// Option of the behaviour [`Behaviour::ToolWithChange`].
const TOOL_WITH_CHANGE: &str = "tool_with_change";

/// Option of the behaviour [`Behaviour::RotaryTurn`].
const ROTARY_TURN: &str = "rotary_turn";

/// Value of the option `decimal_point`: least increments.
const INCREMENT: &str = "increment";

/// A fact that is open, with the readings to be tried.
struct Candidate {
    fact: Fact,
    /// Where the reading relies on it first.
    span: Span,
    answers: [Answer; 2],
    /// The source under each value.
    settings: [Settings; 2],
    /// Which of them is ncc's own.
    taken: usize,
    /// The result of each, where the text itself shows it.
    shown: Option<[Shown; 2]>,
}

impl Candidate {
    /// The results of both readings, as far as the text shows them.
    fn shown(&self) -> [Shown; 2] {
        self.shown.clone().unwrap_or([Shown::Nothing, Shown::Nothing])
    }
}

/// The questions of a source, from the most dangerous one. `diagnostics` are those of its reading, in which the facts
/// that it assumes stand; `sound` is whether nothing was refused there.
///
/// # Errors
/// Reading the source.
pub fn find(
    job: &Job,
    source: &mut dyn Readable,
    diagnostics: &[Diagnostic],
    sound: bool,
) -> io::Result<Vec<Question>> {
    let mut questions = Vec::new();
    for candidate in candidates(job, diagnostics) {
        let jobs = candidate.settings.clone().map(|from| Job { from, ..job.clone() });
        questions.extend(decide(&candidate, [&jobs[0], &jobs[1]], source, sound)?);
    }
    questions.sort_by_key(|question| question.fact);
    Ok(questions)
}

/// The questions of a text, which is read for it.
///
/// # Errors
/// As of `find`; a text in memory gives none.
pub fn of_text(job: &Job, text: &[u8]) -> io::Result<Vec<Question>> {
    let (mut reader, mut batch) = (job.reader(true), Batch::default());
    reader.read(text, 0, &mut batch);
    reader.finish(&mut batch);
    let sound = batch.diagnostics.iter().all(|d| d.fault.gravity() != Gravity::Error);
    find(job, &mut io::Cursor::new(text), &batch.diagnostics, sound)
}

/// All that a translation asks, from the most dangerous question: those with two readings of the source, and the turns
/// of rotary axes that it refuses because nobody states how the machines turn them.
pub fn of_translation(job: &Job, outcome: &Outcome) -> Vec<Question> {
    let mut all = outcome.questions.clone();
    all.extend(outcome.diagnostics.iter().filter_map(|diagnostic| turn(job, diagnostic)));
    all.sort_by_key(|question| question.fact);
    all
}

/// The question of a rotary turn that was refused, if an option can answer it.
fn turn(job: &Job, diagnostic: &Diagnostic) -> Option<Question> {
    let Fault::RotaryTurnOpen { axis, by, or } = diagnostic.fault else { return None };
    let way = Behaviour::RotaryTurn;
    let (source, target) = (job.source_behaviours(), job.target_behaviours());
    let (from, to) = (source.is_open(way), target.is_open(way));
    let [number, shortest, ..] = way.values() else { return None };
    let own = way.values().get(usize::from(source.get(way)));
    let reading = |value: &'static str, by: Nanos| Reading {
        answer: Answer::OfMachines { option: ROTARY_TURN, value, from, to },
        taken: own == Some(&value),
        result: Shown::Turn(axis, by),
    };
    let readings = [reading(number, by), reading(shortest, or)];
    (from || to).then_some(Question { fact: Fact::RotaryTurn, span: diagnostic.span, readings })
}

/// Tells in one line of the questions of a source that a verb answers with ncc's readings.
///
/// # Errors
/// Reading the source.
pub fn note(
    job: &Job,
    source: &mut Source,
    diagnostics: &[Diagnostic],
    sound: bool,
    err: &mut dyn WriteColor,
) -> Result<(), Problem> {
    let found = find(job, &mut source.file, diagnostics, sound);
    let found = found.map_err(|e| Problem::file("read", &source.shown, &e))?;
    if !found.is_empty() {
        // What cannot be reported changes nothing about what is done.
        let _ = writeln!(err, "{}: {}", source.shown, words::note(&found));
    }
    Ok(())
}

/// The facts that are open, and touched.
fn candidates(job: &Job, diagnostics: &[Diagnostic]) -> Vec<Candidate> {
    let mut all: Vec<Candidate> = job.rivals.iter().map(|rival| control(job, rival)).collect();
    let units = |d: &&Diagnostic| matches!(d.fault, Fault::AssumedMode { fact: ModeName::Units, .. });
    if let Some(assumed) = diagnostics.iter().find(units) {
        all.extend(lengths(job, assumed.span));
    }
    let bare = |d: &&Diagnostic| matches!(d.fault, Fault::AssumedBareNumber { .. });
    if let Some(assumed) = diagnostics.iter().find(bare) {
        all.extend(points(job, assumed.span));
    }
    all.extend(diagnostics.iter().filter_map(|diagnostic| of_diagnostic(job, diagnostic)));
    all
}

/// The control: that which was recognised, or one that explains the text as well.
fn control(job: &Job, rival: &'static Dialect) -> Candidate {
    let mut other = Settings::new(rival);
    // The units are a question of their own.
    if let Some(row) = &job.from.dialect.power_on.units {
        other.state_units(row.value.into());
    }
    for option in rival.option.iter().filter(|option| job.from.is_chosen(&option.name)) {
        // A value that the rival does not take is none of its.
        let _ = other.choose(&option.name, job.from.get(&option.name));
    }
    Candidate {
        fact: Fact::Control,
        span: Span::default(),
        answers: [Answer::From(&job.from.dialect.id), Answer::From(&rival.id)],
        settings: [job.from.clone(), other],
        taken: 0,
        shown: None,
    }
}

/// The units of lengths.
fn lengths(job: &Job, span: Span) -> Option<Candidate> {
    let row = job.from.dialect.power_on.units.as_ref().filter(|row| !row.of_the_machine)?;
    let own: Units = row.value.into();
    let both = [Units::Mm, Units::Inch];
    let settings = both.map(|units| {
        let mut settings = job.from.clone();
        settings.state_units(units);
        settings
    });
    let taken = usize::from(own == Units::Inch);
    Some(Candidate {
        fact: Fact::Units,
        span,
        answers: both.map(Answer::Units),
        settings,
        taken,
        shown: None,
    })
}

/// What numbers without a decimal point count.
fn points(job: &Job, span: Span) -> Option<Candidate> {
    // One that was stated as whole units for feeds alone has said the rest too.
    let open = !job.from.is_chosen(DECIMAL_POINT);
    (open && job.from.takes(DECIMAL_POINT, INCREMENT)).then_some(())?;
    let own = job.from.get(DECIMAL_POINT);
    let answer = |value: &'static str| match job.from.takes(DECIMAL_POINT, value) {
        true => Answer::Option(DECIMAL_POINT, value),
        false => Answer::WritePoints,
    };
    let settings = [INCREMENT, CALCULATOR].map(|value| {
        let mut settings = job.from.clone();
        settings.suppose(DECIMAL_POINT, value);
        settings
    });
    let taken = usize::from(own == CALCULATOR);
    let answers = [INCREMENT, CALCULATOR].map(answer);
    Some(Candidate { fact: Fact::DecimalPoint, span, answers, settings, taken, shown: None })
}

/// A fact of which an option of the dialect decides, with its two values and what they make.
fn of_option(
    job: &Job,
    fact: Fact,
    span: Span,
    option: &'static str,
    values: [&'static str; 2],
    shown: [Shown; 2],
) -> Option<Candidate> {
    values.iter().all(|value| job.from.takes(option, value)).then_some(())?;
    let settings = values.map(|value| {
        let mut settings = job.from.clone();
        settings.suppose(option, value);
        settings
    });
    let answers = values.map(|value| Answer::Option(option, value));
    // Each reading is ncc's own that is first: the usual value of a behaviour, the default of an option.
    Some(Candidate { fact, span, answers, settings, taken: 0, shown: Some(shown) })
}

/// A fact that a diagnostic of the reading tells, with both readings.
fn of_diagnostic(job: &Job, diagnostic: &Diagnostic) -> Option<Candidate> {
    match &diagnostic.fault {
        Fault::AssumedReturn { code, words, zero, last } => {
            let path =
                |absolute| Shown::Path { code: code.clone(), words: words.clone(), zero: *zero, absolute };
            let values = [RETURN_LAST, RETURN_FIRST];
            let shown = [path(*last), path(!*last)];
            of_option(job, Fact::ReturnPath, diagnostic.span, RETURN_DISTANCE, values, shown)
        }
        Fault::AssumedCycle { cycle, motion } => {
            let shown = [true, false].map(|drills| Shown::Hole {
                cycle: cycle.clone(),
                motion: motion.clone(),
                drills,
            });
            let values = [MOTION_DRILLED, MOTION_CANCELS];
            of_option(job, Fact::CycleBesideMotion, diagnostic.span, CYCLE_BESIDE_MOTION, values, shown)
        }
        Fault::AssumedToolChange { named, waiting } => {
            let [first, second] = Behaviour::ToolWithChange.values() else { return None };
            let shown = [*named, *waiting].map(|tool| Shown::Made(Made::Tool(i64::from(tool))));
            of_option(job, Fact::ToolChange, diagnostic.span, TOOL_WITH_CHANGE, [*first, *second], shown)
        }
        Fault::AssumedOption { option, .. } if **option == *ARC_CENTRES => {
            let values = [FROM_START, FROM_ZERO];
            of_option(
                job,
                Fact::Centres,
                diagnostic.span,
                ARC_CENTRES,
                values,
                [Shown::Nothing, Shown::Nothing],
            )
        }
        _ => None,
    }
}

/// Runs both readings; a question if they make two different cuts.
fn decide(
    candidate: &Candidate,
    jobs: [&Job; 2],
    source: &mut dyn Readable,
    sound: bool,
) -> io::Result<Option<Question>> {
    let length = match candidate.fact {
        Fact::Control
        | Fact::Units
        | Fact::Centres
        | Fact::ReturnPath
        | Fact::ToolChange
        | Fact::CycleBesideMotion
        | Fact::RotaryTurn => MICROMETRE,
        Fact::DecimalPoint => TENTH,
    };
    let cuts = matches!(candidate.fact, Fact::Control | Fact::ToolChange);
    let watch = candidate.fact == Fact::DecimalPoint;
    let measure = Measure { length, cuts };
    let finish = match candidate.fact {
        Fact::Units | Fact::DecimalPoint | Fact::ToolChange | Fact::CycleBesideMotion | Fact::RotaryTurn => {
            race(jobs, source, measure, PLAIN, watch)?
        }
        // Where the radii of its arcs fit one reading alone, the text itself has said it; the other is refused there.
        Fact::Centres => match race(jobs, source, measure, PLAIN, watch)? {
            Finish::Apart(difference) if matches!(difference.made[1], Made::Refused(_)) => return Ok(None),
            other => other,
        },
        // In the plain world the zero of the part is that of the machine.
        Fact::ReturnPath => race(jobs, source, measure, GENERATED, watch)?,
        // Lengths and offsets are nothing in the plain world, in which numbers can be shown.
        Fact::Control => match race(jobs, source, measure, GENERATED, watch)? {
            Finish::Apart(difference) if is_refused(&difference) || !reads(jobs[1], source)? => {
                return Ok(None);
            }
            Finish::Apart(difference) => match race(jobs, source, measure, PLAIN, watch)? {
                Finish::Apart(plain) if !is_refused(&plain) => Finish::Apart(plain),
                Finish::Same | Finish::Unknown(_) | Finish::Apart(_) => hidden(Finish::Apart(difference)),
            },
            other => other,
        },
    };
    let (span, shown) = match finish {
        Finish::Same => return Ok(None),
        Finish::Apart(difference) => match candidate.fact {
            Fact::DecimalPoint => in_words(candidate, &difference),
            Fact::Control | Fact::Units | Fact::Centres => (difference.at, difference.made.map(made)),
            Fact::ReturnPath | Fact::ToolChange | Fact::CycleBesideMotion | Fact::RotaryTurn => {
                (candidate.span, candidate.shown())
            }
        },
        Finish::Unknown(bare) => match candidate.fact {
            // What cannot be executed here may be by a caller.
            Fact::Units
            | Fact::ReturnPath
            | Fact::ToolChange
            | Fact::CycleBesideMotion
            | Fact::RotaryTurn
                if sound =>
            {
                (candidate.span, candidate.shown())
            }
            Fact::DecimalPoint if sound => match bare.iter().find(|bare| matters(bare)) {
                Some(bare) => (bare.span, values(bare)),
                None => return Ok(None),
            },
            Fact::Control
            | Fact::Units
            | Fact::DecimalPoint
            | Fact::Centres
            | Fact::ReturnPath
            | Fact::ToolChange
            | Fact::CycleBesideMotion
            | Fact::RotaryTurn => {
                return Ok(None);
            }
        },
    };
    // The greater value is shown first.
    let order = if candidate.fact == Fact::DecimalPoint { [1, 0] } else { [0, 1] };
    // A control that can read F alone in whole units offers that for a feed.
    let of_feed = |at: usize| {
        let feed = matches!(shown[at], Shown::Word { feed: true, .. });
        feed && candidate.answers[at] == Answer::WritePoints
            && jobs[0].from.takes(DECIMAL_POINT, INTEGER_FEED)
    };
    let reading = |at: usize| Reading {
        answer: match of_feed(at) {
            true => Answer::Option(DECIMAL_POINT, INTEGER_FEED),
            false => candidate.answers[at].clone(),
        },
        taken: candidate.taken == at,
        result: shown[at].clone(),
    };
    Ok(Some(Question { fact: candidate.fact, span, readings: order.map(reading) }))
}

/// A difference of which the numbers are those of a made-up world.
fn hidden(finish: Finish) -> Finish {
    match finish {
        Finish::Apart(mut difference) => {
            let numbers = |made: Made| match made {
                Made::End(..) | Made::Centre(..) => Made::Otherwise,
                other => other,
            };
            difference.made = difference.made.map(numbers);
            Finish::Apart(difference)
        }
        other => other,
    }
}

fn is_refused(difference: &Difference) -> bool {
    difference.made.iter().any(|made| matches!(made, Made::Refused(_)))
}

fn made(made: Made) -> Shown {
    match made {
        Made::Otherwise => Shown::Nothing,
        made => Shown::Made(made),
    }
}

/// The number without a point that makes a difference, and its two values; else what the machine does.
fn in_words(candidate: &Candidate, difference: &Difference) -> (Span, [Shown; 2]) {
    let feed = matches!(difference.made[0], Made::Feed(..));
    let own =
        |bare: &&BareNumber| bare.span.start >= difference.at.start && bare.feed == feed && matters(bare);
    let before = |bare: &&BareNumber| bare.feed == feed && matters(bare);
    let found = difference.bare.iter().find(own).or_else(|| difference.bare.iter().rev().find(before));
    match found {
        Some(bare) => (bare.span, values(bare)),
        None if difference.at == Span::default() => (candidate.span, difference.made.map(made)),
        None => (difference.at, difference.made.map(made)),
    }
}

fn values(bare: &BareNumber) -> [Shown; 2] {
    [bare.read, bare.with_point].map(|value| Shown::Word { value: value.trimmed(), feed: bare.feed })
}

/// Whether a number without a point is another one with it: by more than a tenth of a millimetre, or as a feed.
fn matters(bare: &BareNumber) -> bool {
    let nanos = |num: Num| num.nanos(false).unwrap_or(Nanos::MAX);
    bare.feed || nanos(bare.read).abs_diff(nanos(bare.with_point)) > TENTH.unsigned_abs()
}

/// Whether a source can be read to its end.
fn reads(job: &Job, source: &mut dyn Readable) -> io::Result<bool> {
    source.seek(SeekFrom::Start(0))?;
    let (mut reader, mut batch) = (job.reader(true), Batch::default());
    let mut chunks = Chunks::new(source);
    let refused = |batch: &Batch| batch.diagnostics.iter().any(|d| d.fault.gravity() == Gravity::Error);
    loop {
        match chunks.take()? {
            Chunk::Lines(base, range) => reader.read(chunks.text(range), base, &mut batch),
            Chunk::TooLong(..) => return Ok(false),
            Chunk::End => break,
        }
        if refused(&batch) {
            return Ok(false);
        }
        batch.diagnostics.clear();
        if !batch.whole {
            batch.stmts.clear();
        }
    }
    reader.finish(&mut batch);
    Ok(!refused(&batch))
}
