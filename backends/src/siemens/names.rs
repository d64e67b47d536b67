//! Names of subprograms and labels in the control's letters.
//!
//! A name that the control can have stays; any other one is changed, always to the same.

use std::collections::{BTreeMap, BTreeSet};

use ncc_ir::diag::Fault;

/// Longest name of a program.
const LONGEST: usize = 24;

/// Longest name of a variable (PGA: 31 characters).
const LONGEST_VARIABLE: usize = 31;

/// Words of the language that no dictionary has, and no variable or program can be.
const WORDS: [&str; 67] = [
    "IF", "ELSE", "ENDIF", "LOOP", "ENDLOOP", "FOR", "TO", "ENDFOR", "WHILE", "ENDWHILE", "REPEAT",
    "REPEATB", "UNTIL", "CASE", "OF", "DEFAULT", "GOTO", "GOTOC", "GOTOF", "GOTOB", "GOTOS", "CALL", "BLOCK",
    "PCALL", "EXTCALL", "ISOCALL", "MCALL", "DEF", "EXTERN", "PROC", "VAR", "DEFINE", "AS", "REAL", "INT",
    "BOOL", "CHAR", "STRING", "AXIS", "FRAME", "DIV", "MOD", "NOT", "B_NOT", "B_AND", "B_XOR", "B_OR", "AND",
    "XOR", "OR", "AC", "IC", "DC", "ACP", "ACN", "QU", "WHEN", "WHENEVER", "FROM", "EVERY", "DO", "REDEF",
    "TRUE", "FALSE", "RET", "SET", "REP",
];

/// A name as it is written.
pub(super) struct Name {
    /// The name.
    pub(super) text: String,
    /// What is reported of it: once, if it is not the program's own.
    pub(super) changed: Option<Fault>,
}

/// Names of one text.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    programs: Kind,
    labels: Kind,
    variables: Kind,
    /// Names of programs, that no variable has.
    reserved: BTreeSet<String>,
}

/// Names of one kind: a label may have the name of a program.
#[derive(Clone, Debug, Default)]
struct Kind {
    /// By the source's name.
    made: BTreeMap<Box<str>, String>,
    /// The names that were made.
    taken: BTreeSet<String>,
}

impl Names {
    /// The name for a subprogram.
    pub(super) fn program(&mut self, name: &str) -> Name {
        self.programs.unique(name, program(name))
    }

    /// The name for a label.
    pub(super) fn label(&mut self, name: &str) -> Name {
        self.labels.unique(name, identifier(name, "L_"))
    }

    /// The name for a variable of the unit at hand; `taken` are words of the language.
    pub(super) fn variable(&mut self, name: &str, taken: &dyn Fn(&str) -> bool) -> Name {
        let mut wanted = named(name, "V_", LONGEST_VARIABLE);
        let programs = |text: &str| self.reserved.contains(text);
        if taken(&wanted) || WORDS.contains(&wanted.as_str()) || programs(&wanted) {
            wanted = named(&format!("V_{wanted}"), "", LONGEST_VARIABLE);
        }
        self.variables.unique(name, wanted)
    }

    /// The variables of another unit begin.
    pub(super) fn new_variables(&mut self) {
        self.variables = Kind::default();
    }

    /// No variable has the name of a program.
    pub(super) fn reserve(&mut self, program_name: &str) {
        self.reserved.insert(program(program_name));
    }

    /// The name for the main program, which no subprogram may have.
    pub(super) fn main(&self, name: &str) -> String {
        let name = identifier(name, "P_");
        let taken = self.programs.taken.contains(&name);
        if taken { format!("{}_MAIN", cut(&name, LONGEST - 5)) } else { name }
    }

    /// Whether a label of that name has been written.
    pub(super) fn has_label(&self, name: &str) -> bool {
        self.labels.made.contains_key(name)
    }
}

impl Kind {
    fn unique(&mut self, name: &str, wanted: String) -> Name {
        if let Some(made) = self.made.get(name) {
            return Name { text: made.clone(), changed: None };
        }
        let mut text = wanted.clone();
        let mut more = 2;
        while self.taken.contains(&text) {
            text = format!("{}_{more}", cut(&wanted, LONGEST - 4));
            more += 1;
        }
        self.made.insert(name.into(), text.clone());
        self.taken.insert(text.clone());
        let changed = (!text.eq_ignore_ascii_case(name))
            .then(|| Fault::NameChanged { from: name.into(), to: text.as_str().into() });
        Name { text, changed }
    }
}

/// The name of a program: `L12` by number, else one that begins with two letters.
fn program(name: &str) -> String {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    match name.strip_prefix(['L', 'l']) {
        _ if digits(name) => {
            let number = name.trim_start_matches('0');
            format!("L{}", cut(if number.is_empty() { "0" } else { number }, 7))
        }
        Some(number) if digits(number) => format!("L{number}"),
        Some(_) | None => {
            let own = identifier(name, "P_");
            // A word of the language calls nothing.
            if WORDS.contains(&own.as_str()) { identifier(&format!("P_{own}"), "P_") } else { own }
        }
    }
}

/// Capitals, digits and underlines that begin with two letters or underlines.
fn identifier(name: &str, prefix: &str) -> String {
    named(name, prefix, LONGEST)
}

fn named(name: &str, prefix: &str, longest: usize) -> String {
    let mut made: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() || c == '_' { c.to_ascii_uppercase() } else { '_' })
        .collect();
    let begins = made.len() >= 2 && made.bytes().take(2).all(|b| b.is_ascii_uppercase() || b == b'_');
    if !begins {
        made.insert_str(0, prefix);
    }
    cut(&made, longest).to_owned()
}

fn cut(text: &str, longest: usize) -> &str {
    text.get(..longest).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::Names;

    #[test]
    fn names_stay_where_the_control_can_have_them() {
        let mut names = Names::default();
        for name in ["L12", "L012", "SLOT_STEP", "__X"] {
            assert_eq!(names.program(name).text, name);
        }
        assert_eq!(names.program("1001").text, "L1001");
        assert_eq!(names.program("pocket").text, "POCKET");
        assert_eq!(names.program("B 7").text, "B_7");
        assert_eq!(names.program("7-B").text, "P_7_B");
        assert_eq!(names.label("120").text, "L_120");
    }

    #[test]
    fn two_names_never_become_one() {
        let mut names = Names::default();
        assert_eq!(names.program("L12").text, "L12");
        assert_eq!(names.program("12").text, "L12_2");
        assert_eq!(names.program("0012").text, "L12_3");
        assert_eq!(names.program("12").text, "L12_2");
        // A label may have the name of a program.
        assert_eq!(names.label("POCKET").text, "POCKET");
        assert_eq!(names.program("POCKET").text, "POCKET");
    }
}
