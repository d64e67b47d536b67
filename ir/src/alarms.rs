//! Alarms of a program as another control shows them: by a number of its own, or by their text alone.
//!
//! A number that the control has stays. Else it is counted from the first that it has (`10` is 65010 on a control with
//! alarms from 65000), or is what its last three digits are (65010 is 10). One that no number had gets the first above
//! zero. Where alarms have no numbers, the number stands before the text. The text stays, in the letters that the
//! control has, as far as it has place for it.
//!
//! Not here: what stands for characters that a control does not show (`transliterate`).

use crate::program::Text;
use crate::transliterate::in_capitals;

/// How a control says the alarms of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Alarms {
    /// Its numbers, from and to; without, alarms have no number.
    pub numbers: Option<[u32; 2]>,
    /// The signs that its texts have beside capitals, digits and the blank; without, all characters.
    pub signs: Option<Text>,
    /// How many characters of a text it shows; without, all.
    pub longest: Option<usize>,
}

/// An alarm as a message names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AlarmName {
    /// By its number.
    Number(i64),
    /// By its text, without a number.
    Text(Box<str>),
}

/// An alarm, and the alarm of the target in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AlarmMapped {
    /// The alarm of the source.
    pub from: AlarmName,
    /// The alarm of the target.
    pub to: AlarmName,
    /// The text that the target shows, if that is shorter.
    pub text: Option<Box<str>>,
}

impl Alarms {
    /// A text for the operator in the characters of this control.
    pub fn shown(&self, text: &str) -> Text {
        let Some(signs) = &self.signs else { return text.into() };
        let mut shown = String::new();
        in_capitals(text, signs, &mut shown);
        shown.into()
    }

    /// What an alarm is on this control; nothing where it has no number for it.
    pub fn said(&self, number: Option<i64>, text: &str) -> Option<(Option<i64>, Text)> {
        let shown = |text: &str| {
            let text = self.shown(text).to_string();
            match self.longest.and_then(|most| text.char_indices().nth(most)) {
                Some((end, _)) => text[..end].trim_end().to_owned(),
                None => text,
            }
        };
        let Some([from, to]) = self.numbers.map(|range| range.map(i64::from)) else {
            return Some((
                None,
                match (number, text) {
                    (None, text) => shown(text),
                    (Some(number), "") => number.to_string(),
                    (Some(number), text) => format!("{number} {}", shown(text)),
                }
                .into(),
            ));
        };
        let has = |n: &i64| (from..=to).contains(n);
        let own = match number {
            None => Some(from.max(1)),
            Some(number) if has(&number) => Some(number),
            Some(number) if (0..1000).contains(&number) => Some(from + number),
            Some(number) => Some(number % 1000),
        };
        own.filter(has).map(|own| (Some(own), shown(text).into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_alarm_has_the_number_and_the_text_of_the_other_control() {
        let mill = Alarms { numbers: Some([0, 200]), signs: Some(".=".into()), longest: Some(12) };
        let other = Alarms { numbers: Some([65_000, 66_999]), signs: None, longest: None };
        let texts = Alarms { numbers: None, signs: None, longest: None };
        let of = |alarms: &Alarms, number, text| alarms.said(number, text).map(|(n, t)| (n, t.to_string()));
        assert_eq!(of(&other, Some(10), "TOO WIDE"), Some((Some(65_010), "TOO WIDE".into())));
        assert_eq!(of(&mill, Some(65_010), "too wide"), Some((Some(10), "TOO WIDE".into())));
        assert_eq!(of(&mill, Some(101), ""), Some((Some(101), String::new())));
        assert_eq!(of(&mill, Some(5), "Too wide?"), Some((Some(5), "TOO WIDE.".into())));
        assert_eq!(of(&mill, Some(5), "twelve signs"), Some((Some(5), "TWELVE SIGNS".into())));
        assert_eq!(of(&mill, Some(5), "the bore is too wide"), Some((Some(5), "THE BORE IS".into())));
        assert_eq!(of(&mill, Some(65_201), ""), None);
        assert_eq!(of(&mill, None, "no size"), Some((Some(1), "NO SIZE".into())));
        assert_eq!(of(&other, None, "no size"), Some((Some(65_000), "no size".into())));
        assert_eq!(of(&texts, Some(10), "TOO WIDE"), Some((None, "10 TOO WIDE".into())));
        assert_eq!(of(&texts, Some(7), ""), Some((None, "7".into())));
        assert_eq!(of(&texts, None, "no size"), Some((None, "no size".into())));
    }
}
