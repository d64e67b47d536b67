//! Comments in the characters that a control shows.
//!
//! Letters become capitals, accents and other alphabets are transliterated, signs are replaced by
//! those that the dictionary lists. Nothing that could end a comment or a program comes through.

use ncc_dialects::CommentRules;

/// Writes comments; keeps its memory between them.
#[derive(Clone, Debug)]
pub(crate) struct Comments {
    open: String,
    close: String,
    upper_ascii: bool,
    signs: String,
    longest: usize,
    /// How comments begin that do something.
    active: Vec<String>,
    message: String,
    shown: String,
    /// Whether what was written last is the dash for an opening bracket: the number behind it is not negative.
    bracket: bool,
}

impl Comments {
    pub(crate) fn new(rules: &CommentRules) -> Comments {
        Comments {
            open: rules.open.clone(),
            close: rules.close.clone(),
            upper_ascii: rules.upper_ascii,
            signs: rules.signs.clone(),
            longest: rules.longest,
            active: rules.active.iter().chain([&rules.message]).filter(|w| !w.is_empty()).cloned().collect(),
            message: rules.message.clone(),
            shown: String::new(),
            bracket: false,
        }
    }

    /// Appends a message to the operator to `line`. Returns whether it reads otherwise than the text.
    pub(crate) fn message(&mut self, text: &str, line: &mut Vec<u8>) -> bool {
        self.shown.clear();
        self.bracket = false;
        for c in text.chars() {
            self.show(c);
        }
        for part in [&self.open, &self.message, &self.shown, &self.close] {
            line.extend_from_slice(part.as_bytes());
        }
        self.shown != text
    }

    /// Appends a comment to `line`, and to `after`, one line each, what is too long for it.
    /// Returns whether it reads otherwise than the text.
    pub(crate) fn write(&mut self, text: &str, line: &mut Vec<u8>, after: &mut Vec<u8>, eol: &[u8]) -> bool {
        self.shown.clear();
        self.bracket = false;
        for c in text.chars() {
            self.show(c);
        }
        if self.active.iter().any(|word| begins(&self.shown, word)) {
            // What was only read elsewhere must not do anything here.
            self.shown.insert(0, '.');
        }
        let mut changed = self.shown != text;
        let mut rest = self.shown.as_str();
        let mut first = true;
        loop {
            let (piece, next) = cut(rest, self.longest);
            let to = if first { &mut *line } else { &mut *after };
            // One blank parts the sign from the text, if there is one.
            let text = !piece.is_empty() && !piece.starts_with(' ');
            let open = if text { &self.open } else { self.open.trim_end() };
            to.extend_from_slice(open.as_bytes());
            to.extend_from_slice(piece.as_bytes());
            to.extend_from_slice(self.close.as_bytes());
            if !first {
                after.extend_from_slice(eol);
            }
            let Some(next) = next else {
                return changed;
            };
            rest = next;
            first = false;
            changed = true;
        }
    }

    /// Whether a text is written as it is.
    pub(crate) fn keeps(&mut self, text: &str) -> bool {
        let mut line = Vec::new();
        let mut after = Vec::new();
        !self.write(text, &mut line, &mut after, b"") && after.is_empty()
    }

    /// Whether a line has a message to the operator.
    pub(crate) fn shows_message(&self, line: &[u8]) -> bool {
        let sign = format!("{}{}", self.open, self.message);
        !self.message.is_empty() && line.windows(sign.len()).any(|part| part == sign.as_bytes())
    }

    fn show(&mut self, c: char) {
        if std::mem::take(&mut self.bracket) && (c.is_ascii_digit() || c == '.') {
            self.shown.push(' ');
        }
        if !self.upper_ascii {
            let closes = !self.close.is_empty() && (self.open.contains(c) || self.close.contains(c));
            self.shown.push(if c.is_control() || closes { ' ' } else { c });
            return;
        }
        if self.shows(c) {
            return self.shown.push(c);
        }
        if c.is_ascii_lowercase() {
            return self.shown.push(c.to_ascii_uppercase());
        }
        let instead = stand_in(c);
        if instead.chars().all(|c| self.shows(c)) {
            self.bracket = matches!(c, '(' | '[' | '{');
            self.shown.push_str(instead);
        } else {
            self.shown.push(' ');
        }
    }

    fn shows(&self, c: char) -> bool {
        c.is_ascii_uppercase() || c.is_ascii_digit() || c == ' ' || self.signs.contains(c)
    }
}

/// Whether a text begins with a word, blanks and the size of letters apart.
fn begins(text: &str, word: &str) -> bool {
    let mut rest = text.chars().filter(|c| !c.is_whitespace());
    word.chars().all(|c| rest.next().is_some_and(|r| r.eq_ignore_ascii_case(&c)))
}

/// The first piece of a text, at a blank if there is one in its second half, and what remains.
fn cut(text: &str, longest: usize) -> (&str, Option<&str>) {
    let Some((end, _)) = text.char_indices().nth(longest).filter(|_| longest > 0) else {
        return (text, None);
    };
    match text[..end].rfind(' ').filter(|at| *at > end / 2) {
        Some(at) => (&text[..at], Some(&text[at + 1..])),
        None => (&text[..end], Some(&text[end..])),
    }
}

/// What stands for a character that a control with capitals alone cannot show. Signs first, then
/// Latin letters with accents (Latin-1, Latin Extended-A), Greek and Cyrillic.
pub(crate) fn stand_in(c: char) -> &'static str {
    match c {
        '(' | '[' | '{' => "-",
        ')' | ']' | '}' => "",
        '%' => " PCT",
        '#' => "NO.",
        '&' => "+",
        '@' => "AT",
        ';' => ",",
        '!' | '?' => ".",
        '<' => " LT ",
        '>' => " GT ",
        '\\' | '|' => "/",
        '~' | '–' | '—' | '‐' | '‑' | '−' | '·' | '•' => "-",
        '\'' | '`' | '´' | '’' | '‘' => "",
        '"' | '“' | '”' | '„' | '«' | '»' | '^' | '$' | '\t' | '\u{a0}' => " ",
        '…' => "...",
        '°' | 'º' => " DEG",
        'ª' => "A",
        '±' => "+-",
        '×' => "X",
        '÷' => "/",
        '¹' => "1",
        '²' => "2",
        '³' => "3",
        '¼' => "1/4",
        '½' => "1/2",
        '¾' => "3/4",
        'µ' | 'μ' => "U",
        'À'..='Ã' | 'Å' | 'à'..='ã' | 'å' | 'Ā'..='ą' => "A",
        'Ä' | 'ä' | 'Æ' | 'æ' => "AE",
        'Ç' | 'ç' | 'Ć'..='č' => "C",
        'Ð' | 'ð' | 'Ď'..='đ' => "D",
        'È'..='Ë' | 'è'..='ë' | 'Ē'..='ě' => "E",
        'Ĝ'..='ģ' => "G",
        'Ĥ'..='ħ' => "H",
        'Ì'..='Ï' | 'ì'..='ï' | 'Ĩ'..='ı' => "I",
        'Ĳ' | 'ĳ' => "IJ",
        'Ĵ' | 'ĵ' => "J",
        'Ķ'..='ĸ' => "K",
        'Ĺ'..='ł' => "L",
        'Ñ' | 'ñ' | 'Ń'..='ŋ' => "N",
        'Ò'..='Õ' | 'Ø' | 'ò'..='õ' | 'ø' | 'Ō'..='ő' => "O",
        'Ö' | 'ö' | 'Œ' | 'œ' => "OE",
        'Ŕ'..='ř' => "R",
        'ß' | 'ẞ' => "SS",
        'Ś'..='š' | 'Ș' | 'ș' => "S",
        'Þ' | 'þ' => "TH",
        'Ţ'..='ŧ' | 'Ț' | 'ț' => "T",
        'Ù'..='Û' | 'ù'..='û' | 'Ũ'..='ų' => "U",
        'Ü' | 'ü' => "UE",
        'Ŵ' | 'ŵ' => "W",
        'Ý' | 'ý' | 'ÿ' | 'Ŷ'..='Ÿ' => "Y",
        'Ź'..='ž' => "Z",
        _ => other_alphabet(c),
    }
}

fn other_alphabet(c: char) -> &'static str {
    match c {
        'А' | 'а' | 'Α' | 'α' => "A",
        'Б' | 'б' | 'Β' | 'β' => "B",
        'В' | 'в' => "V",
        'Г' | 'г' | 'Γ' | 'γ' => "G",
        'Д' | 'д' | 'Δ' | 'δ' => "D",
        'Е' | 'е' | 'Э' | 'э' | 'Ε' | 'ε' => "E",
        'Ё' | 'ё' => "YO",
        'Ж' | 'ж' => "ZH",
        'З' | 'з' | 'Ζ' | 'ζ' => "Z",
        'И' | 'и' | 'Ι' | 'ι' | 'Η' | 'η' => "I",
        'Й' | 'й' | 'Ы' | 'ы' | 'Υ' | 'υ' => "Y",
        'К' | 'к' | 'Κ' | 'κ' => "K",
        'Л' | 'л' | 'Λ' | 'λ' => "L",
        'М' | 'м' | 'Μ' => "M",
        'Н' | 'н' | 'Ν' | 'ν' => "N",
        'О' | 'о' | 'Ο' | 'ο' | 'Ω' | 'ω' => "O",
        'П' | 'п' | 'Π' | 'π' => "P",
        'Р' | 'р' | 'Ρ' | 'ρ' => "R",
        'С' | 'с' | 'Σ' | 'σ' | 'ς' => "S",
        'Т' | 'т' | 'Τ' | 'τ' => "T",
        'У' | 'у' => "U",
        'Ф' | 'ф' | 'Φ' | 'φ' => "F",
        'Х' | 'х' | 'Χ' | 'χ' => "KH",
        'Ц' | 'ц' => "TS",
        'Ч' | 'ч' => "CH",
        'Ш' | 'ш' => "SH",
        'Щ' | 'щ' => "SHCH",
        'Ъ' | 'ъ' | 'Ь' | 'ь' => "",
        'Ю' | 'ю' => "YU",
        'Я' | 'я' => "YA",
        'Θ' | 'θ' => "TH",
        'Ξ' | 'ξ' => "X",
        'Ψ' | 'ψ' => "PS",
        '⌀' | '∅' => "D",
        c if c.is_control() => " ",
        // Something was here: a reader of the comment is to see that.
        _ => "*",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn capitals(longest: usize) -> Comments {
        Comments::new(&CommentRules {
            open: "(".into(),
            close: ")".into(),
            upper_ascii: true,
            signs: ".,=_-+/*:".into(),
            longest,
            ..CommentRules::default()
        })
    }

    fn written(comments: &mut Comments, text: &str) -> (String, String, bool) {
        let (mut line, mut after) = (Vec::new(), Vec::new());
        let changed = comments.write(text, &mut line, &mut after, b"\n");
        (String::from_utf8(line).expect("text"), String::from_utf8(after).expect("text"), changed)
    }

    #[test]
    fn accents_become_capitals() {
        let mut c = capitals(60);
        assert_eq!(written(&mut c, "FURAÇÃO 3mm :"), ("(FURACAO 3MM :)".into(), "".into(), true));
        assert_eq!(written(&mut c, "FACEAMENTO:"), ("(FACEAMENTO:)".into(), "".into(), false));
        assert!(written(&mut c, "mm").2);
        assert_eq!(written(&mut c, "Größe ÄÖÜ Łódź").0, "(GROESSE AEOEUE LODZ)");
        assert_eq!(written(&mut c, "сверло Ø8").0, "(SVERLO O8)");
        assert_eq!(written(&mut c, "日").0, "(*)");
    }

    #[test]
    fn nothing_ends_the_comment_or_the_program() {
        let mut c = capitals(60);
        assert_eq!(written(&mut c, "FACE (TOP) 50%").0, "(FACE -TOP 50 PCT)");
        assert_eq!(written(&mut c, "UP (5 MM) [-3] ( 2)(").0, "(UP - 5 MM --3 - 2-)");
        assert_eq!(written(&mut c, "7").0, "(7)");
        assert_eq!(written(&mut c, "A\nB;C").0, "(A B,C)");
        assert_eq!(written(&mut c, "").0, "()");
    }

    #[test]
    fn long_comments_go_on() {
        let mut c = capitals(10);
        assert_eq!(written(&mut c, "ONE TWO THREE"), ("(ONE TWO)".into(), "(THREE)\n".into(), true));
        assert_eq!(written(&mut c, "ABCDEFGHIJKL"), ("(ABCDEFGHIJ)".into(), "(KL)\n".into(), true));
    }

    #[test]
    fn a_comment_to_the_end_of_the_line_keeps_its_characters() {
        let mut c = Comments::new(&CommentRules { open: ";".into(), ..CommentRules::default() });
        assert_eq!(written(&mut c, "FURAÇÃO (3mm)"), (";FURAÇÃO (3mm)".into(), "".into(), false));
        assert_eq!(written(&mut c, "A\rB"), (";A B".into(), "".into(), true));
    }
}
