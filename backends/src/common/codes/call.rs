//! Codes of calls and of dwells in blocks of their own.

use ncc_dialects::Meaning;

use super::{Code, Dwell, Finder};

/// A call's words: the number, and the count where it has a letter of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CallCode {
    pub code: Code,
    pub number: u8,
    pub count: Option<u8>,
}

impl Finder {
    pub(super) fn call(&self, meaning: Meaning) -> Option<CallCode> {
        let row = self.dialect.code_for(meaning)?;
        let mut words = row.words.bytes();
        Some(CallCode { code: self.code(meaning)?, number: words.next()?, count: words.next() })
    }

    pub(super) fn dwell_code(&self) -> Option<(Code, Dwell)> {
        let row = self.dialect.code_for(Meaning::Dwell)?;
        Some((self.code(Meaning::Dwell)?, self.dwell(*row.dwell.first()?)?))
    }

    pub(super) fn dwells(&self) -> Vec<Dwell> {
        let row = self.dialect.code_for(Meaning::Dwell);
        row.map_or(&[][..], |row| &row.dwell).iter().filter_map(|word| self.dwell(*word)).collect()
    }
}
