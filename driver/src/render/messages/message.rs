//! A message before its words: an entry of `messages/`, the values in it, and which helps of it are shown.
//!
//! ```text
//! messages/NC0106/en.ftl    NC0106 = `{ $letter }` without a number
//!                               .label = { $source } does not read this as zero
//!                               .help = if you mean zero, write `{ $letter }0`
//! Message::new(106).text("letter", "X")    "`X` without a number"
//! ```
//!
//! The form is Fluent's: a headline, and attributes for the label, the further places (`related`), the helps and the
//! phrase in the account (`account`). A code
//! may have several entries, told apart by a form: `NC0225-units`. Another language is another file in the folder of
//! the code. Not here: which entry and which values a fault has (`facts`, `advice`).

use std::collections::BTreeMap;

use fluent_bundle::{FluentArgs, FluentBundle, FluentResource, FluentValue};
use serde::Serialize;

/// In place of a code: words that belong to no code.
const COMMON: u16 = 0;

macro_rules! entries {
    ($($code:literal)*) => {
        /// The entries of each code.
        pub(crate) const ENTRIES: &[(u16, &str)] =
            &[$(($code, include_str!(concat!("../../../messages/NC0", stringify!($code), "/en.ftl")))),*];
    };
}

entries! {
    101 102 103 104 105 106 107 108 109 110 111 112 113 114 115
    201 202 203 204 205 206 207 208 209 210 211 212 213 214 215 216 217 218 219 220 221 222 223 224 225 226
    227 228 229 230 231 232 233 234 235 236 237 238 240 241 250
    301 302 303 304 305 306 307 308 309 310 311 312 313 320 321 322 323 324 325 326 327 328 329 330 331 332
    336 337 338 339 340 342 343 345 346 350
    401 402 403 404 405 406 407 408 409 410 411 412 413 414 415 416 417 418 419 420 421 422 423 424 425 426 427
    430 431 432 433 440 442 443 444 450
    501 502 503 504 505 506 507 508 509 510 520 521 522 523
    601 602 603 604 605 606 607 608 609 610
    701 702 703 704 705 706 707 708 709 710 711 712 713 714 715 716 717 718 719
    801 802 803 804 805 806 807 808 809 810 811 812 813 814
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

/// A message: its code, which of the code's entries, and the values in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Message {
    code: u16,
    form: &'static str,
    values: Vec<(&'static str, Value)>,
}

impl Message {
    /// The only or the first entry of a code.
    pub(crate) fn new(code: u16) -> Message {
        Message { code, form: "", values: Vec::new() }
    }

    /// Words that belong to no code: `common-also`.
    pub(crate) fn common(form: &'static str) -> Message {
        Message::new(COMMON).form(form)
    }

    /// The entry of this form: `units` for `NC0225-units`.
    #[must_use]
    pub(crate) fn form(mut self, form: &'static str) -> Message {
        self.form = form;
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
        match (self.code, self.form) {
            (COMMON, form) => format!("common-{form}"),
            (code, "") => format!("NC{code:04}"),
            (code, form) => format!("NC{code:04}-{form}"),
        }
    }

    /// Its values by their names, without the backquotes of quoted text, for programs that make words of their own.
    pub(crate) fn values(&self) -> BTreeMap<&'static str, Value> {
        let bare = |value: &Value| match value {
            Value::Text(text) => Value::Text(text.trim_matches('`').to_owned()),
            Value::Count(count) => Value::Count(*count),
        };
        self.values.iter().map(|(name, value)| (*name, bare(value))).collect()
    }

    /// The headline.
    pub(crate) fn headline(&self) -> String {
        Opened::new(self).words(None, &[]).unwrap_or_default()
    }

    /// The words at the place.
    pub(crate) fn label(&self) -> String {
        Opened::new(self).words(Some("label"), &[]).unwrap_or_default()
    }

    /// The phrase in the account of a translation: the entry's `account`, or its headline.
    pub(crate) fn account(&self) -> String {
        Opened::new(self).words(Some("account"), &[]).unwrap_or_else(|| self.headline())
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
                debug_assert!(words.is_some(), "NC{:04} has no {attribute}", self.code);
                words
            }
        };
        named.into_iter().filter_map(words).collect()
    }
}

/// A message with the entries of its code.
struct Opened<'m> {
    message: &'m Message,
    bundle: FluentBundle<FluentResource>,
}

impl Opened<'_> {
    fn new(message: &Message) -> Opened<'_> {
        Opened { message, bundle: bundle(message.code) }
    }

    /// The words of an attribute, or of the headline, if the entry has it.
    fn words(&self, attribute: Option<&str>, own: &[(&'static str, Value)]) -> Option<String> {
        let id = self.message.entry();
        let entry = self.bundle.get_message(&id);
        debug_assert!(entry.is_some(), "messages/ has no {id}");
        let pattern = match attribute {
            None => entry?.value()?,
            Some(attribute) => entry?.get_attribute(attribute)?.value(),
        };
        let mut values = FluentArgs::new();
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

/// The entries of a code, ready to be formatted. A file that does not parse has the entries before its fault.
fn bundle(code: u16) -> FluentBundle<FluentResource> {
    let text = match code {
        COMMON => include_str!("../../../messages/common/en.ftl"),
        _ => ENTRIES.iter().find(|(known, _)| *known == code).map_or("", |(_, text)| *text),
    };
    let parsed = FluentResource::try_new(text.to_owned());
    debug_assert!(parsed.is_ok(), "messages/NC{code:04}/en.ftl does not parse");
    let language = "en".parse().unwrap_or_default();
    let mut bundle = FluentBundle::new(vec![language]);
    bundle.set_use_isolating(false);
    let added = bundle.add_resource(parsed.unwrap_or_else(|(resource, _)| resource));
    debug_assert!(added.is_ok(), "messages/NC{code:04}/en.ftl has an entry twice");
    bundle
}
