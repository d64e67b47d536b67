//! The machine file of the case study: `machine.json` (Aguiar 2023, table 10).
//!
//! ```text
//! { "name": "romi", "tool_change_time": 7, "max_feed": 15000, "start_spindle_time": 2 }
//! ```
//!
//! Times are seconds; `max_feed` is the rate of rapids along their straight line, mm/min. A stop of the spindle takes
//! the time of a start (table 11). The file names no control, so it serves to time programs, and not to translate them. Not
//! here: profiles, which state more.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use crate::fact::Fact;
use crate::profile::{Profile, inside};
use crate::shipped::find;
use crate::takes::Takes;
use crate::wrong::{ProfileError, Wrong};

/// The shipped machine of the case study. Its control stands for the one that the file does not name
/// ([`Profile::any_control`]).
const STUDY: &str = "romi-discovery-4022";

/// Source of its facts.
const SOURCE: &str = "machine.json";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: String,
    tool_change_time: Option<f64>,
    max_feed: Option<f64>,
    start_spindle_time: Option<f64>,
}

impl Profile {
    /// Reads the case study's machine file, for the times of a program.
    ///
    /// # Errors
    /// It is no JSON, has another field, or a value that its field does not take.
    pub fn parse_machine_json(text: &str) -> Result<Profile, Vec<ProfileError>> {
        let file: File = serde_json::from_str(text).map_err(|error| vec![form(&error, text)])?;
        let Some(study) = find(STUDY) else { return Err(Vec::new()) };
        let mut profile = Profile { any_control: true, ..Profile::empty(study.dialect) };
        let (mut wrong, schema) = (Vec::new(), &mut profile.schema);
        schema.id = Spanned::new(key(text, "name"), file.name.clone());
        schema.title = file.name;
        let mut fact = |name: &'static str, value: Option<f64>, takes: Takes| {
            let span = key(text, name);
            let fits = |value: f64| if takes == Takes::AboveZero { value > 0.0 } else { value >= 0.0 };
            if value.is_some_and(|value| !fits(value)) {
                wrong.push(ProfileError::new(Wrong::Takes { key: name, takes }, span.clone()));
            }
            Fact { value, source: SOURCE.to_owned(), span, ..Fact::default() }
        };
        schema.times.tool_change = fact("tool_change_time", file.tool_change_time, Takes::FromZero);
        schema.rates.rapid = fact("max_feed", file.max_feed, Takes::AboveZero);
        schema.times.spindle_start = fact("start_spindle_time", file.start_spindle_time, Takes::FromZero);
        schema.times.spindle_stop = schema.times.spindle_start.clone();
        wrong.sort_by_key(|error| error.span.start);
        if wrong.is_empty() { Ok(profile) } else { Err(wrong) }
    }
}

/// The place of a field's name in the text.
fn key(text: &str, name: &str) -> Range<usize> {
    let quoted = format!("\"{name}\"");
    text.find(&quoted).map_or(0..0, |start| start..start + quoted.len())
}

/// What the reader of the form says, at its place.
fn form(error: &serde_json::Error, text: &str) -> ProfileError {
    let reason = error.to_string();
    let end = reason.rfind(" at line ").unwrap_or(reason.len());
    let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    let at = before + error.column().saturating_sub(1);
    let span = inside(at..at + 1, text);
    ProfileError::new(Wrong::Form { message: reason[..end].to_owned() }, span)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE_10: &str =
        r#"{ "name": "romi", "tool_change_time": 7, "max_feed": 15000, "start_spindle_time": 2 }"#;

    fn read(text: &str) -> Result<Profile, Vec<ProfileError>> {
        Profile::parse_machine_json(text)
    }

    #[test]
    fn table_10_is_the_shipped_machine() {
        let profile = read(TABLE_10).expect("a profile");
        let shipped = crate::find("romi-discovery-4022").expect("shipped");
        assert_eq!((profile.id(), profile.any_control), ("romi", true));
        assert_eq!(profile.machine(), shipped.machine());
    }

    #[test]
    fn what_is_left_out_is_not_stated() {
        let machine = read(r#"{"name": "a"}"#).expect("a profile").machine();
        assert_eq!((machine.rapid_rate, machine.tool_change, machine.spindle_stop), (None, None, None));
    }

    #[test]
    fn faults_have_their_place() {
        let one = |text: &str| {
            let wrong = read(text).expect_err("a fault");
            let [ProfileError { wrong, span, .. }] = &wrong[..] else { panic!("{wrong:?}") };
            let said = match wrong {
                Wrong::Form { message } => message.clone(),
                Wrong::Takes { key, takes } => format!("{key} {takes:?}"),
                other => panic!("{other:?}"),
            };
            (said, text[..span.start].lines().count(), text[span.clone()].to_owned())
        };
        let (said, line, _) = one("{ \"name\": \"a\",\n  \"tool_change\": 7 }");
        assert!(said.contains("`tool_change`") && said.contains("`tool_change_time`, `max_feed`"), "{said}");
        assert_eq!(line, 2);
        assert_eq!(
            one("{ \"name\": \"a\", \"max_feed\": 0 }"),
            ("max_feed AboveZero".into(), 1, "\"max_feed\"".into())
        );
        assert_eq!(one("{ \"max_feed\": 1 }").0, "missing field `name`");
        assert!(one("{ \"name\": \"é\", \"max_feed\": \"é\" }").0.starts_with("invalid type: string"));
        one("");
        one("{\"name\": \"é");
    }
}
