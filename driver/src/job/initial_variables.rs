//! `--args FILE` and `--value NAME=NUMBER`: the values that a program may be given by its caller, or by whoever set its
//! variables before.
//!
//! A TOML file with a table `[variables]`: a number, a list of numbers, or `from` and `to`, with `vacant = true` where
//! there may be no value at all. Names are as the program has them.
//!
//! Not here: which of them a run gets (`verify_run/whole`), and values of the control's own.

use std::collections::BTreeMap;

use ncc_exec::Runner;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::expr::value::Value;
use serde::Deserialize;

use crate::problem::{Exit, Problem, problem};
use crate::render::messages::message::Help;

/// What variables may be given, by their names without signs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InitialVariables(BTreeMap<String, Values>);

/// The values that one may be given.
#[derive(Clone, Debug, PartialEq)]
struct Values {
    kind: Kind,
    vacant: bool,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Among(Vec<f64>),
    Between { from: f64, to: f64, step: f64 },
}

impl Values {
    /// The value, if there is one alone.
    fn only(&self) -> Option<f64> {
        match &self.kind {
            _ if self.vacant => None,
            Kind::Among(values) => match values[..] {
                [value] => Some(value),
                _ => None,
            },
            Kind::Between { from, to, .. } => (from == to).then_some(*from),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    variables: BTreeMap<String, Row>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Row {
    Always(f64),
    Among(Vec<f64>),
    Table(Table),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(default)]
    among: Vec<f64>,
    from: Option<f64>,
    to: Option<f64>,
    /// How far values between them are apart, counted from `from`.
    step: Option<f64>,
    #[serde(default)]
    vacant: bool,
}

/// How far values are apart where the file does not say it.
const STEP: f64 = 0.001;

/// A name without the signs that stand around it: `#101`, `#<depth>`, `R5`.
fn plain(name: &str) -> String {
    name.trim_start_matches('#').trim_start_matches('<').trim_end_matches('>').to_ascii_lowercase()
}

/// Reads `--value`: the name of a variable and its value at the start, `#500=12.5`, `_td=0.25`, `R5=3`; `None` where its
/// assignments are left out, `EVENT=drop`.
///
/// # Errors
/// It is not of this form.
pub fn value(text: &str) -> Result<(String, Option<Num>), String> {
    let form = || problem("value-form").headline();
    let (name, number) = text.split_once('=').ok_or_else(form)?;
    if number == "drop" && !plain(name).is_empty() {
        return Ok((plain(name), None));
    }
    let (whole, behind) = number.split_once('.').unwrap_or((number, ""));
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let unsigned = whole.strip_prefix('-').unwrap_or(whole);
    let fits = digits(unsigned) && digits(behind) && behind.len() <= 9 && unsigned.len() + behind.len() > 0;
    let mantissa = format!("{whole}{behind}").parse::<i64>().ok().filter(|_| fits && !plain(name).is_empty());
    let mantissa = mantissa.ok_or_else(form)?;
    // Nine digits at most.
    let scale = behind.len() as u8;
    Ok((plain(name), Some(Num { mantissa, scale, point: scale > 0, unit: Unit::One })))
}

/// A decimal with at most nine digits after the point, in nanos.
pub fn decimal(text: &str) -> Option<Nanos> {
    let (negative, digits) = match text.as_bytes().first()? {
        b'-' => (true, &text[1..]),
        b'+' => (false, &text[1..]),
        _ => (false, text),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let all = [whole, fraction].concat();
    if all.is_empty() || fraction.len() > 9 || !all.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let mantissa: i64 = all.parse().ok()?;
    let num = Num {
        mantissa: if negative { -mantissa } else { mantissa },
        scale: fraction.len() as u8,
        point: true,
        unit: Unit::Mm,
    };
    num.nanos(false)
}

impl InitialVariables {
    /// Takes what the command line says of a variable.
    pub fn put(&mut self, name: &str, value: Num) {
        let number = value.mantissa as f64 / 10_f64.powi(value.scale.into());
        self.0.insert(plain(name), Values { kind: Kind::Among(vec![number]), vacant: false });
    }

    /// Reads the text of a file of this name.
    ///
    /// # Errors
    /// It is not of this form.
    pub fn of_file(name: &str, text: &str) -> Result<InitialVariables, Problem> {
        InitialVariables::parse(text).map_err(|reason| {
            let message = problem("variables").text("file", name).text("reason", reason);
            Problem::of(Exit::File, &message, Some(vec![Help::new("help"), Help::new("help-or")]))
        })
    }

    /// Reads a text.
    ///
    /// # Errors
    /// It is not of this form, in words.
    pub fn parse(text: &str) -> Result<InitialVariables, String> {
        let file: File = toml::from_str(text).map_err(|error| error.to_string().trim_end().to_owned())?;
        let rows = file.variables.into_iter().map(|(name, row)| {
            let wrong = |reason: &str| {
                Err(problem("variable").text("variable", &name).text("reason", reason).headline())
            };
            let (kind, vacant) = match row {
                Row::Always(value) => (Kind::Among(vec![value]), false),
                Row::Among(values) => (Kind::Among(values), false),
                Row::Table(Table { among, from: None, to: None, step: None, vacant }) => {
                    (Kind::Among(among), vacant)
                }
                Row::Table(Table { among, from: Some(from), to: Some(to), step, vacant })
                    if among.is_empty() =>
                {
                    (Kind::Between { from, to, step: step.unwrap_or(STEP) }, vacant)
                }
                Row::Table(_) => return wrong("apart"),
            };
            match &kind {
                Kind::Among(values) if values.is_empty() && !vacant => return wrong("no-value"),
                Kind::Among(values) if values.iter().any(|v| !v.is_finite()) => return wrong("no-number"),
                Kind::Between { from, to, step }
                    if !(from <= to && *step > 0.0 && (to - from).is_finite()) =>
                {
                    return wrong("range");
                }
                Kind::Among(_) | Kind::Between { .. } => {}
            }
            Ok((plain(&name), Values { kind, vacant }))
        });
        rows.collect::<Result<_, String>>().map(InitialVariables)
    }

    /// All but one of them.
    pub(crate) fn without(mut self, name: &str) -> InitialVariables {
        self.0.remove(&plain(name));
        self
    }

    /// Whether anything is said of a variable.
    pub fn says(&self, name: &str) -> bool {
        self.0.contains_key(&plain(name))
    }

    /// Whether a variable is said to have no value, always or in some runs.
    pub fn may_be_vacant(&self, name: &str) -> bool {
        let nothing = |kind: &Kind| matches!(kind, Kind::Among(values) if values.is_empty());
        self.0.get(&plain(name)).is_some_and(|values| values.vacant || nothing(&values.kind))
    }

    /// The names of which something is stated.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Whether a name of the file is that of a variable.
    pub fn is_name(&self, name: &str, variable: &str) -> bool {
        name == plain(variable)
    }

    /// The value of a variable that is said to have one alone.
    pub fn only(&self, name: &str) -> Option<f64> {
        self.0.get(&plain(name))?.only()
    }

    /// Reads a file that says one value of each variable, for a program that is executed once.
    ///
    /// # Errors
    /// As of [`InitialVariables::of_file`], and of a variable with several values.
    pub fn one_of_file(name: &str, text: &str) -> Result<InitialVariables, Problem> {
        let given = InitialVariables::of_file(name, text)?;
        match given.0.iter().find(|(_, values)| values.only().is_none()) {
            Some((variable, _)) => {
                let message = problem("several-values").text("file", name).text("variable", variable);
                Err(Problem::of(Exit::Usage, &message, None))
            }
            None => Ok(given),
        }
    }

    /// Gives a run of a program what variables are said to have alone.
    pub fn start(&self, runner: &mut Runner) {
        if !self.0.is_empty() {
            runner.give(&mut |var| self.only(&var.name()).map(Value::Number));
        }
    }

    /// The value of a variable in one of many runs: first the lowest, then the highest, then no value, then any by
    /// chance. `None` within is no value at all.
    pub fn value(&self, name: &str, set: u32, chance: u64) -> Option<Option<f64>> {
        let Values { kind, vacant } = self.0.get(&plain(name))?;
        if *vacant && (set == 2 || set > 3 && chance.is_multiple_of(4)) {
            return Some(None);
        }
        // The lowest bits have decided about having a value.
        let chance = chance >> 2;
        Some(match kind {
            Kind::Among(values) if values.is_empty() => None,
            Kind::Among(values) => {
                let at = if set < 2 { set as usize } else { chance as usize };
                Some(values[at % values.len()])
            }
            Kind::Between { from, to, step } => {
                let steps = ((to - from) / step).floor().max(0.0);
                Some(match set {
                    0 => *from,
                    1 => *to,
                    _ => (from + step * (chance % (steps as u64 + 1)) as f64).min(*to),
                })
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "[variables]\n\"#1\" = { from = 1, to = 3, step = 1 }\nR5 = 12.5\n\"#<depth>\" = [0, 2.5]\n\
                        \"#7\" = { among = [4], vacant = true }\n";

    #[test]
    fn values_are_of_the_file() {
        let given = InitialVariables::parse(FILE).unwrap();
        for set in 0..50 {
            for chance in 0..50 {
                let value = |name| given.value(name, set, chance);
                assert!(matches!(value("1"), Some(Some(n)) if [1.0, 2.0, 3.0].contains(&n)));
                assert_eq!(value("R5"), Some(Some(12.5)));
                assert!(matches!(value("depth"), Some(Some(n)) if [0.0, 2.5].contains(&n)));
                assert!(matches!(value("7"), Some(None | Some(4.0))));
                assert_eq!(value("2"), None);
            }
        }
        assert_eq!((given.value("1", 0, 9), given.value("1", 1, 9)), (Some(Some(1.0)), Some(Some(3.0))));
        assert_eq!(given.value("7", 2, 1), Some(None));
        assert_eq!((given.only("r5"), given.only("1"), given.only("7")), (Some(12.5), None, None));
    }

    #[test]
    fn values_are_of_the_command_line() {
        let mut given = InitialVariables::default();
        for (text, name, value) in
            [("#500=-1.25", "500", -1.25), ("#<_td>=.5", "_td", 0.5), ("R5=3", "r5", 3.0)]
        {
            let (own, number) = self::value(text).unwrap();
            assert_eq!(own, name);
            given.put(&own, number.unwrap());
            assert_eq!(given.only(name), Some(value), "{text}");
        }
        assert_eq!(self::value("EVENT=drop"), Ok(("event".to_owned(), None)));
        for wrong in
            ["500", "=1", "=drop", "500=", "500=x", "500=1e3", "500=1.2.3", "500=--1", "500=1.1234567890"]
        {
            assert!(self::value(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn another_form_is_told() {
        for wrong in [
            "",
            "[variables]\n\"#1\" = \"two\"\n",
            "[variables]\n\"#1\" = []\n",
            "[variables]\n\"#1\" = { from = 1 }\n",
            "[variables]\n\"#1\" = { from = 2, to = 1 }\n",
            "[variables]\n\"#1\" = { from = 1, to = 2, step = 0 }\n",
            "[variables]\n\"#1\" = { from = 1, to = 2, among = [1] }\n",
            "[variables]\n\"#1\" = nan\n",
            "[other]\n",
        ] {
            assert!(InitialVariables::parse(wrong).is_err(), "{wrong}");
        }
    }
}
