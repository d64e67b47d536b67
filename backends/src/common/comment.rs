//! Comments in the characters that a control shows.
//!
//! Where these are capitals alone, `ncc_ir::transliterate` says what the text becomes. Nothing that could end a comment or a
//! program comes through.

use ncc_dialects::CommentRules;
use ncc_ir::transliterate::in_capitals;

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
}

impl Comments {
    pub(crate) fn new(rules: &CommentRules) -> Comments {
        Comments {
            open: rules.open.clone(),
            close: rules.close.clone(),
            upper_ascii: rules.upper_ascii,
            signs: rules.signs.clone(),
            longest: rules.longest,
            active: rules
                .active
                .iter()
                .chain(&rules.logs)
                .chain([&rules.message])
                .filter(|w| !w.is_empty())
                .cloned()
                .collect(),
            message: rules.message.clone(),
            shown: String::new(),
        }
    }

    /// Appends a message to the operator to `line`. Returns whether it reads otherwise than the text.
    pub(crate) fn message(&mut self, text: &str, line: &mut Vec<u8>) -> bool {
        self.show(text);
        for part in [&self.open, &self.message, &self.shown, &self.close] {
            line.extend_from_slice(part.as_bytes());
        }
        self.shown != text
    }

    /// Appends a comment to `line`, and to `after`, one line each, what is too long for it.
    /// Returns whether it reads otherwise than the text.
    pub(crate) fn write(&mut self, text: &str, line: &mut Vec<u8>, after: &mut Vec<u8>, eol: &[u8]) -> bool {
        self.show(text);
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

    /// The text as the control shows it.
    fn show(&mut self, text: &str) {
        self.shown.clear();
        if self.upper_ascii {
            return in_capitals(text, &self.signs, &mut self.shown);
        }
        for c in text.chars() {
            let closes = !self.close.is_empty() && (self.open.contains(c) || self.close.contains(c));
            self.shown.push(if c.is_control() || closes { ' ' } else { c });
        }
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
