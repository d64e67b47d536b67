//! What a project file answers for a program, as head, report and certificate name it.

use serde::{Deserialize, Serialize};

use crate::render::messages::message::{Message, Part};

/// What is active of a project file, for head, report and certificate.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Used {
    /// Its path, from the working folder.
    pub file: String,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
    /// What it answers, in the order of its keys.
    pub answers: Vec<Answer>,
    /// What options of the call go before, a sentence each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overridden: Vec<String>,
    /// Profiles that it names, as they are found.
    #[serde(skip)]
    pub profiles: Vec<String>,
}

/// A fact of a project file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// Its key in the row: `machine`, `machine.power_on.units`.
    pub key: String,
    /// Its value.
    pub value: String,
    /// The line in which it stands, from 1.
    pub line: usize,
}

impl Used {
    /// Its name, its hash and what it answers, in a line.
    pub fn line(&self) -> String {
        format!("{}: {}", self.title().join(" sha256 "), self.facts())
    }

    /// Its name without folders, and the first digits of its hash.
    pub fn title(&self) -> [&str; 2] {
        let name = self.file.rsplit(['/', '\\']).next().unwrap_or_default();
        [name, self.sha256.get(..8).unwrap_or_default()]
    }

    /// What it answers.
    pub fn facts(&self) -> String {
        let facts: Vec<String> =
            self.answers.iter().map(|answer| format!("{} = {}", answer.key, answer.value)).collect();
        if facts.is_empty() {
            return Message::part(Part::Summary, "no-answers").headline();
        }
        facts.join("; ")
    }
}
