//! A message before its words: an entry of `messages/`, the values in it, and which helps of it are shown.
//!
//! ```text
//! messages/NC0106/en.ftl    NC0106 = `{ $letter }` without a number
//!                               .label = { $source } does not read this as zero
//!                               .help = if you mean zero, write `{ $letter }0`
//! Message::new(106).text("letter", "X")    "`X` without a number"
//! ```
//!
//! The form is Fluent's: a headline, and attributes for the label, the further places (`related`), the helps, and the
//! phrase in the summary (`account`). A code may have several entries: `NC0225-units` has the form `units`, and
//! `NC0501-Arcs-Radius` is for the reason `Lack::Arcs(ArcsLack::Radius)`. Another language is another file in the folder
//! of the code. Not here: which entry and which values a fault has (`facts`,
//! `advice`).

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use fluent_bundle::{FluentArgs, FluentBundle, FluentResource, FluentValue};
use ncc_ir::reason::{Reason, Values};
use serde::Serialize;

use super::files::FILES;
use crate::render::text::plain;

/// A file of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Home {
    /// Those of a code.
    Code(u16),
    /// Those of a part of the output, which belong to no code.
    Part(Part),
}

/// A part of the output with words of its own: the name of its folder and of its entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Part {
    /// Words that accompany a message of any code.
    Common,
    /// Facts of a control that ncc assumes.
    ControlFact,
    /// What rows of a dictionary mean, where no manual confirms them.
    Meaning,
    /// The tables of a dictionary.
    Dialect,
    /// Faults of dictionaries, and what their test says.
    Dictionary,
    /// The result of a comparison of two programs.
    Difference,
    /// Events of an execution.
    Event,
    /// The comment that opens an emitted program.
    Head,
    /// Signs of a dialect in a program.
    Guess,
    /// Kinds of texts that are no milling programs.
    Looks,
    /// Problems before any block is read.
    Problem,
    /// Questions, and what their answers make of a program.
    Question,
    /// Why block numbers cannot be changed.
    Renumber,
    /// Why a name stays.
    Rename,
    /// Facts of a machine profile, and the result of its test.
    Machine,
    /// Files for one tool each.
    PerTool,
    /// The account of a simulation.
    Simulate,
    /// Values in words.
    Spelled,
    /// The account of a translation.
    Summary,
    /// Assumptions of `ncc time`.
    Time,
    /// The text of `ncc verify`.
    Verify,
    /// Checks that `ncc check` left out, with the reason.
    Unchecked,
}

impl Part {
    fn name(self) -> &'static str {
        match self {
            Part::Common => "common",
            Part::ControlFact => "control-fact",
            Part::Meaning => "meaning",
            Part::Dialect => "dialect",
            Part::Dictionary => "dictionary",
            Part::Difference => "difference",
            Part::Event => "event",
            Part::Head => "head",
            Part::Guess => "guess",
            Part::Looks => "looks",
            Part::Problem => "problem",
            Part::Question => "question",
            Part::Renumber => "renumber",
            Part::Rename => "rename",
            Part::Machine => "machine",
            Part::PerTool => "per-tool",
            Part::Simulate => "simulate",
            Part::Spelled => "spelled",
            Part::Summary => "summary",
            Part::Time => "time",
            Part::Unchecked => "unchecked",
            Part::Verify => "verify",
        }
    }

    fn words(self) -> &'static str {
        match self {
            Part::Common => include_str!("../../../messages/common/en.ftl"),
            Part::ControlFact => include_str!("../../../messages/control-fact/en.ftl"),
            Part::Meaning => include_str!("../../../messages/meaning/en.ftl"),
            Part::Dialect => include_str!("../../../messages/dialect/en.ftl"),
            Part::Dictionary => include_str!("../../../messages/dictionary/en.ftl"),
            Part::Difference => include_str!("../../../messages/difference/en.ftl"),
            Part::Event => include_str!("../../../messages/event/en.ftl"),
            Part::Head => include_str!("../../../messages/head/en.ftl"),
            Part::Guess => include_str!("../../../messages/guess/en.ftl"),
            Part::Looks => include_str!("../../../messages/looks/en.ftl"),
            Part::Problem => include_str!("../../../messages/problem/en.ftl"),
            Part::Question => include_str!("../../../messages/question/en.ftl"),
            Part::Renumber => include_str!("../../../messages/renumber/en.ftl"),
            Part::Rename => include_str!("../../../messages/rename/en.ftl"),
            Part::Machine => include_str!("../../../messages/machine/en.ftl"),
            Part::PerTool => include_str!("../../../messages/per-tool/en.ftl"),
            Part::Simulate => include_str!("../../../messages/simulate/en.ftl"),
            Part::Spelled => include_str!("../../../messages/spelled/en.ftl"),
            Part::Summary => include_str!("../../../messages/summary/en.ftl"),
            Part::Time => include_str!("../../../messages/time/en.ftl"),
            Part::Unchecked => include_str!("../../../messages/unchecked/en.ftl"),
            Part::Verify => include_str!("../../../messages/verify/en.ftl"),
        }
    }
}

/// A value in a message.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// Text, as it is shown.
    Text(String),
    /// A count, by which the words of an entry may differ.
    Count(u64),
}

/// A help of a message, with values of its own besides those of the message.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Help {
    /// An attribute of the message's entry.
    Entry(&'static str, Vec<(&'static str, Value)>),
    /// Words that are made elsewhere.
    Words(String),
}

impl Help {
    /// A help without values of its own.
    pub(crate) fn new(attribute: &'static str) -> Help {
        Help::Entry(attribute, Vec::new())
    }

    /// The same with a text in it.
    #[must_use]
    pub(crate) fn text(mut self, name: &'static str, text: impl Into<String>) -> Help {
        if let Help::Entry(_, values) = &mut self {
            values.push((name, Value::Text(text.into())));
        }
        self
    }
}

/// A message: its file, which of its entries, and the values in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Message {
    home: Home,
    form: &'static str,
    /// The reason of a refusal, which has an entry of its own.
    reason: Option<String>,
    values: Vec<(&'static str, Value)>,
    /// Codes that its helps may show: they belong to the reader's control, not to the fault.
    typed: Vec<(&'static str, String)>,
}

impl Message {
    /// The only or the first entry of a code.
    pub(crate) fn new(code: u16) -> Message {
        Message { home: Home::Code(code), form: "", reason: None, values: Vec::new(), typed: Vec::new() }
    }

    /// Words that belong to no code: `common-also-line`.
    pub(crate) fn part(part: Part, form: &'static str) -> Message {
        Message { home: Home::Part(part), form, reason: None, values: Vec::new(), typed: Vec::new() }
    }

    /// What a row of a dictionary means, by its meaning with hyphens for blanks: `START_CYCLE-drill`.
    pub(crate) fn meaning(row: String) -> Message {
        Message { reason: Some(row), ..Message::part(Part::Meaning, "") }
    }

    /// Words that go with messages of any code.
    pub(crate) fn common(form: &'static str) -> Message {
        Message::part(Part::Common, form)
    }

    /// The entry of this form: `units` for `NC0225-units`.
    #[must_use]
    pub(crate) fn form(mut self, form: &'static str) -> Message {
        self.form = form;
        self
    }

    /// The entry of this reason, with the values of its fields: `Arcs-Radius`.
    #[must_use]
    pub(crate) fn reason(mut self, reason: &impl Reason) -> Message {
        let mut values = Values::new();
        reason.values(&mut values);
        self.reason = Some(reason.name());
        values.into_iter().fold(self, |message, (name, text)| message.text(name, plain(&text)))
    }

    /// With codes that its helps may show.
    #[must_use]
    pub(crate) fn typed(mut self, codes: impl IntoIterator<Item = (&'static str, String)>) -> Message {
        self.typed.extend(codes);
        self
    }

    /// With a text in it.
    #[must_use]
    pub(crate) fn text(mut self, name: &'static str, text: impl Into<String>) -> Message {
        self.values.push((name, Value::Text(text.into())));
        self
    }

    /// With a count in it, by which its words may differ.
    #[must_use]
    pub(crate) fn count(mut self, name: &'static str, count: impl Into<u64>) -> Message {
        self.values.push((name, Value::Count(count.into())));
        self
    }

    /// The name of its entry: `NC0225-units`.
    pub(crate) fn entry(&self) -> String {
        match (self.home, &self.reason, self.form) {
            (Home::Part(part), Some(reason), _) => format!("{}-{reason}", part.name()),
            (Home::Part(part), None, form) => format!("{}-{form}", part.name()),
            (Home::Code(code), Some(reason), _) => format!("NC{code:04}-{reason}"),
            (Home::Code(code), None, "") => format!("NC{code:04}"),
            (Home::Code(code), None, form) => format!("NC{code:04}-{form}"),
        }
    }

    /// Its values by their names, for programs that make words of their own.
    pub(crate) fn values(&self) -> BTreeMap<&'static str, Value> {
        self.values.iter().cloned().collect()
    }

    /// The headline.
    pub(crate) fn headline(&self) -> String {
        Opened::new(self).words(None, &[]).unwrap_or_default()
    }

    /// The words at the place.
    pub(crate) fn label(&self) -> String {
        Opened::new(self).words(Some("label"), &[]).unwrap_or_default()
    }

    /// The words of an attribute of its entry.
    pub(crate) fn attribute(&self, name: &str) -> String {
        Opened::new(self).words(Some(name), &[]).unwrap_or_default()
    }

    /// The phrase in the account of a translation: the entry's `account`, or its headline.
    pub(crate) fn account(&self) -> String {
        Opened::new(self).words(Some("account"), &[]).unwrap_or_else(|| self.headline())
    }

    /// Whether the entry has this attribute itself.
    #[cfg(test)]
    pub(crate) fn has(&self, attribute: &str) -> bool {
        let opened = Opened::new(self);
        opened.bundle.get_message(&self.entry()).is_some_and(|entry| entry.get_attribute(attribute).is_some())
    }

    /// The words at further places, if the entry has some.
    pub(crate) fn related(&self) -> Option<String> {
        Opened::new(self).words(Some("related"), &[])
    }

    /// The words at a second further place, if the entry has some.
    pub(crate) fn related_2(&self) -> Option<String> {
        Opened::new(self).words(Some("related-2"), &[])
    }

    /// The helps: those that are named, or else the entry's `help` if it has one.
    pub(crate) fn helps(&self, named: Option<Vec<Help>>) -> Vec<String> {
        let opened = Opened::new(self);
        let Some(named) = named else {
            return opened.words(Some("help"), &[]).into_iter().collect();
        };
        let words = |help| match help {
            Help::Words(words) => Some(words),
            Help::Entry(attribute, own) => {
                let words = opened.words(Some(attribute), &own);
                debug_assert!(words.is_some(), "{} has no {attribute}", self.entry());
                words
            }
        };
        named.into_iter().filter_map(words).collect()
    }
}

/// A message with the entries of its code.
struct Opened<'m> {
    message: &'m Message,
    bundle: Rc<FluentBundle<FluentResource>>,
}

thread_local! {
    /// The files that were read before: a report formats some of them thousands of times.
    static READ: RefCell<BTreeMap<Home, Rc<FluentBundle<FluentResource>>>> = const { RefCell::new(BTreeMap::new()) };
}

impl Opened<'_> {
    fn new(message: &Message) -> Opened<'_> {
        let read = |home| {
            READ.with_borrow_mut(|all| all.entry(home).or_insert_with(|| Rc::new(bundle(home))).clone())
        };
        Opened { message, bundle: read(message.home) }
    }

    /// The words of an attribute, or of the headline, if the entry has it.
    fn words(&self, attribute: Option<&str>, own: &[(&'static str, Value)]) -> Option<String> {
        let id = self.message.entry();
        let entry = self.bundle.get_message(&id);
        // A user's dictionary may have rows of which no words are known.
        let optional = matches!(self.message.home, Home::Part(Part::Meaning));
        debug_assert!(optional || entry.is_some(), "messages/ has no {id}");
        let pattern = match attribute {
            None => entry?.value()?,
            Some(attribute) => match entry?.get_attribute(attribute) {
                Some(attribute) => attribute.value(),
                // The first entry of the code has the label and help of reasons without their own.
                None => {
                    let (Home::Code(code), Some(_)) = (self.message.home, &self.message.reason) else {
                        return None;
                    };
                    let first = format!("NC{code:04}");
                    self.bundle.get_message(&first)?.get_attribute(attribute)?.value()
                }
            },
        };
        let mut values = FluentArgs::new();
        for (name, code) in &self.message.typed {
            values.set(*name, code.as_str());
        }
        for (name, value) in self.message.values.iter().chain(own) {
            match value {
                Value::Text(text) => values.set(*name, text.as_str()),
                Value::Count(count) => values.set(*name, FluentValue::from(*count)),
            }
        }
        let mut faults = Vec::new();
        let words = self.bundle.format_pattern(pattern, Some(&values), &mut faults);
        debug_assert!(faults.is_empty(), "{id}, {attribute:?}: {faults:?}");
        Some(words.into_owned())
    }
}

/// The entries of a file, ready to be formatted. A file that does not parse has the entries before its fault.
fn bundle(home: Home) -> FluentBundle<FluentResource> {
    let text = match home {
        Home::Part(part) => part.words(),
        Home::Code(code) => FILES.iter().find(|files| files.code == code).map_or("", |files| files.words),
    };
    let parsed = FluentResource::try_new(text.to_owned());
    debug_assert!(parsed.is_ok(), "the words of {home:?} do not parse");
    let language = "en".parse().unwrap_or_default();
    let mut bundle = FluentBundle::new(vec![language]);
    bundle.set_use_isolating(false);
    let added = bundle.add_resource(parsed.unwrap_or_else(|(resource, _)| resource));
    debug_assert!(added.is_ok(), "the words of {home:?} have an entry twice");
    bundle
}
