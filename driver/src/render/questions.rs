//! Questions in words: what is asked, both results in numbers, and what answers it.
//!
//! ```text
//! question[NC0303]: is Z100 100 mm or 0.1 mm?
//!   7 │ G43 H1 Z100 M8        answer: `--from-option decimal_point=calculator` (100 mm) or `=increment` (0.1 mm)
//! ```

use std::io;

use codespan_reporting::term::termcolor::{Color, ColorSpec, WriteColor};
use ncc_dialects::DECIMAL_POINT;
use ncc_ir::canon::{FeedMode, Units};
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use serde::Serialize;

use super::about::{About, Told};
use super::json::JsonPlace;
use super::messages::message::{Message, Part};
use super::numbers::signed;
use super::source::Excerpt;
use super::spelled::{Counted, return_path};
use super::text::{plain, plain_upto};
use crate::questions::question::{Answer, Fact, Made, Question, Reading, Shown};

/// So much of a line is shown before its answer, in characters.
const LINE: usize = 40;

/// Lines are filled up with blanks to so many characters.
const COLUMN: usize = 20;

/// A question in words.
#[derive(Debug, Serialize)]
pub struct Asked {
    /// `NC0303`.
    pub code: String,
    /// `question`.
    pub severity: &'static str,
    /// What is asked.
    pub question: String,
    /// Where both readings differ first.
    pub place: JsonPlace,
    /// Both answers.
    pub answers: [AskedAnswer; 2],
    /// The line, as it is shown.
    #[serde(skip)]
    line: String,
    /// The file of a called program that it stands in.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
}

/// An answer in words.
#[derive(Debug, Serialize)]
pub struct AskedAnswer {
    /// The option of the command line that gives it; `null` where the program itself must say it.
    pub option: Option<String>,
    /// What the program makes with it.
    pub result: Option<String>,
    /// Whether it is ncc's own reading.
    pub taken: bool,
}

impl Asked {
    /// The question of a refusal that an option takes back, in the words of the refusal.
    pub fn of_refusal(told: &Told, answers: [AskedAnswer; 2]) -> Asked {
        Asked {
            code: told.code.clone(),
            severity: "question",
            question: told.message.clone(),
            place: told.place.clone().into(),
            answers,
            line: String::new(),
            file: None,
        }
    }
}

/// Questions in words, in their order.
///
/// # Errors
/// Reading the source.
pub fn ask(about: &mut About, questions: &[Question]) -> io::Result<Vec<Asked>> {
    let called = about.job.called.as_ref();
    let mut lines =
        super::source::Lines::find(about.source, questions.iter().map(|q| q.span.start).collect())?;
    lines.own_numbers(called);
    let mut all = Vec::new();
    for question in questions {
        let file = called.and_then(|called| called.file(question.span.start));
        let name = file.map_or(about.name, |file| file.name.as_str());
        let excerpt = Excerpt::read(about.source, &lines, name, &[question.span])?;
        let text = excerpt.snippet(&lines, question.span).to_owned();
        let (line, column) = excerpt.location(&lines, question.span.start).unwrap_or((1, 1));
        let answers = question.readings.each_ref().map(|reading| AskedAnswer {
            option: option(&reading.answer),
            result: result(&reading.result),
            taken: reading.taken,
        });
        all.push(Asked {
            code: format!("NC{:04}", question.fact.code()),
            severity: "question",
            question: headline(question, &text),
            place: JsonPlace {
                start: question.span.start,
                end: question.span.end,
                line,
                column,
                end_column: column + text.chars().count() as u64,
                text,
                label: Message::part(Part::Question, "label").headline(),
            },
            answers,
            line: excerpt.line(&lines, question.span.start).to_owned(),
            file: file.map(|file| file.name.clone()),
        });
    }
    Ok(all)
}

/// Prints questions, the most dangerous first.
///
/// # Errors
/// Reading the source, or writing.
pub fn print(out: &mut dyn WriteColor, about: &mut About, questions: &[Question]) -> io::Result<()> {
    let asked = ask(about, questions)?;
    let wide = asked.iter().map(|asked| asked.place.line.to_string().len()).max().unwrap_or(1);
    for asked in asked {
        out.set_color(ColorSpec::new().set_fg(Some(Color::Magenta)).set_bold(true).set_intense(true))?;
        write!(out, "question[{}]", asked.code)?;
        out.reset()?;
        writeln!(out, ": {}", asked.question)?;
        let file = asked.file.as_ref().map(|file| format!("{}:", plain(file))).unwrap_or_default();
        let line = plain_upto(asked.line.trim(), LINE);
        let answers = answers(&asked.answers);
        writeln!(out, "  {file}{:wide$} │ {line:COLUMN$}  answer: {answers}", asked.place.line)?;
    }
    Ok(())
}

/// One line for a verb that goes on: which reading it takes.
pub fn note(questions: &[Question]) -> String {
    let own: Vec<String> = questions
        .iter()
        .map(|question| {
            let other = question.readings.iter().find(|reading| !reading.taken);
            let other = other.and_then(|reading| option(&reading.answer));
            let other = other.map(|option| format!(" (else `{option}`)")).unwrap_or_default();
            format!("{}{other}", taken(question))
        })
        .collect();
    Message::part(Part::Question, "readings-taken").text("readings", own.join("; ")).headline()
}

/// ncc's own reading, in the few words that fit a program's head.
pub fn taken(question: &Question) -> String {
    match (&question.taken().answer, question.fact) {
        (Answer::From(dialect), _) => format!("control = {dialect}"),
        (Answer::Units(units), _) => format!("units = {}", name(*units)),
        (Answer::Option(option, value), _) => format!("{option} = {value}"),
        (Answer::OfMachines { option, value, .. }, _) => format!("{option} = {value}"),
        (Answer::WritePoints, _) => format!("{DECIMAL_POINT} = calculator"),
    }
}

fn headline(question: &Question, text: &str) -> String {
    let [first, second] = question.readings.each_ref();
    let asked = |form| Message::new(question.fact.code()).form(form);
    let both = |form, one: String, two: String| asked(form).text("one", one).text("two", two);
    let results = (result(&first.result), result(&second.result));
    let message = match (question.fact, &first.answer, &second.answer) {
        (Fact::Control, Answer::From(own), Answer::From(other)) => {
            both("question", (*own).to_owned(), (*other).to_owned())
        }
        (Fact::DecimalPoint, ..) => match results {
            (Some(one), Some(two)) if is_word(first) => {
                both("question-word", one, two).text("word", plain_upto(text, 20))
            }
            _ => asked("question"),
        },
        (Fact::ReturnPath, ..) => match (&first.result, results) {
            (Shown::Path { code, .. }, (Some(one), Some(two))) => {
                both("question-path", one, two).text("code", plain(code))
            }
            _ => asked("question"),
        },
        (Fact::CycleBesideMotion, ..) => match &first.result {
            Shown::Hole { cycle, motion, .. } => {
                asked("question-hole").text("cycle", plain(cycle)).text("motion", plain(motion))
            }
            _ => asked("question"),
        },
        (Fact::ToolChange, ..) => match (&first.result, &second.result) {
            (Shown::Made(Made::Tool(named)), Shown::Made(Made::Tool(waiting))) => {
                both("question-tools", named.to_string(), waiting.to_string())
            }
            _ => asked("question"),
        },
        (Fact::RotaryTurn, ..) => match [&first.result, &second.result] {
            [Shown::Turn(axis, by), Shown::Turn(_, or)] => Message::new(question.fact.code())
                .text("axis", char::from(axis.letter()))
                .text("by", signed(*by))
                .text("or", signed(*or)),
            _ => asked("question"),
        },
        (Fact::Centres, ..) => asked("question"),
        // The user has named the control. The unit is still open.
        (Fact::Units | Fact::Control, ..) => Message::new(Fact::Units.code()).form("question"),
    };
    message.headline()
}

fn is_word(reading: &Reading) -> bool {
    matches!(reading.result, Shown::Word { .. })
}

fn answers(both: &[AskedAnswer; 2]) -> String {
    let one = |answer: &AskedAnswer| {
        let option = match &answer.option {
            Some(option) => format!("`{option}`"),
            None => Message::part(Part::Question, "answer-points").headline(),
        };
        match &answer.result {
            Some(result) => format!("{option} ({result})"),
            None => option,
        }
    };
    let first = one(&both[0]);
    // The second one leaves out what both begin with.
    let shared = |option: &String| option.split_once('=').map(|(name, _)| name.len());
    let short = match (&both[0].option, &both[1].option) {
        (Some(a), Some(b)) => {
            shared(a).filter(|n| shared(b) == Some(*n) && a[..*n] == b[..*n]).map(|n| b[n..].to_owned())
        }
        (None, _) | (_, None) => None,
    };
    let second = AskedAnswer {
        option: short.or_else(|| both[1].option.clone()),
        result: both[1].result.clone(),
        taken: both[1].taken,
    };
    format!("{first} or {}", one(&second))
}

fn option(answer: &Answer) -> Option<String> {
    match answer {
        Answer::From(dialect) => Some(format!("--from {dialect}")),
        Answer::Units(units) => Some(format!("--units {}", name(*units))),
        Answer::Option(option, value) => Some(format!("--from-option {option}={value}")),
        Answer::WritePoints => None,
        Answer::OfMachines { option, value, from, to } => {
            let sides = [("from", *from), ("to", *to)].into_iter().filter(|(_, asked)| *asked);
            let all: Vec<String> =
                sides.map(|(side, _)| format!("--{side}-option {option}={value}")).collect();
            Some(all.join(" "))
        }
    }
}

fn name(units: Units) -> &'static str {
    match units {
        Units::Mm => "mm",
        Units::Inch => "inch",
    }
}

/// What a reading makes, in numbers.
fn result(shown: &Shown) -> Option<String> {
    let made = |form| Message::part(Part::Question, form);
    let message = match shown {
        Shown::Nothing | Shown::Made(Made::Otherwise) => return None,
        Shown::Word { value, feed } => return Some(word(*value, *feed)),
        Shown::Turn(axis, by) => {
            made("result-turn").text("axis", char::from(axis.letter())).text("by", signed(*by))
        }
        Shown::Hole { cycle, drills: true, .. } => made("result-drills").text("cycle", plain(cycle)),
        Shown::Hole { cycle, motion, drills: false } => {
            made("result-moves").text("motion", plain(motion)).text("cycle", plain(cycle))
        }
        Shown::Path { words, zero, absolute, .. } => {
            return Some(return_path(
                words,
                *zero,
                if *absolute { Counted::OfPart } else { Counted::FromHere },
            ));
        }
        Shown::Made(what) => match *what {
            Made::End(axis, at) => {
                let form = if matches!(axis.letter(), b'A'..=b'C') { "result-angle" } else { "result-end" };
                made(form).text("axis", char::from(axis.letter())).text("at", decimal(at))
            }
            Made::Centre(axis, at) => {
                made("result-centre").text("axis", char::from(axis.letter())).text("at", decimal(at))
            }
            Made::Feed(rate, mode) => made(match mode {
                FeedMode::PerMinute => "result-feed-per-minute",
                FeedMode::PerRevolution => "result-feed-per-revolution",
                FeedMode::InverseTime => "result-inverse-time-feed",
            })
            .text("rate", decimal(rate)),
            Made::Dwell(time) => made("result-dwell").text("time", decimal(time)),
            Made::Spindle(true) => made("result-spindle-on"),
            Made::Spindle(false) => made("result-spindle-off"),
            Made::Tool(number) => made("result-tool").text("number", number.to_string()),
            Made::Refused(code) => made("result-refused").text("code", format!("NC{code:04}")),
            Made::Otherwise => return None,
        },
    };
    Some(message.headline())
}

fn word(value: Num, feed: bool) -> String {
    let sign = if value.mantissa < 0 { "-" } else { "" };
    let digits = format!("{:0width$}", value.mantissa.unsigned_abs(), width = usize::from(value.scale) + 1);
    let (whole, part) = digits.split_at(digits.len() - usize::from(value.scale));
    let point = if part.is_empty() { "" } else { "." };
    let unit = match value.unit {
        Unit::One | Unit::Entry => "",
        Unit::Mm => " mm",
        Unit::Inch => " inch",
        Unit::Degree => " degrees",
        Unit::Second => " s",
    };
    format!("{sign}{whole}{point}{part}{unit}{}", if feed { "/min" } else { "" })
}

/// Nanos as a decimal of at most four digits after the point.
fn decimal(nanos: Nanos) -> String {
    let text = format!("{:.4}", nanos as f64 / ONE as f64);
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}
