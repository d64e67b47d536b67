//! Rewrites the short forms of `ncc translate --from A --to B FILE` before clap reads the arguments.
//!
//! ```text
//! ncc A to B FILE    ncc A:B FILE    ncc A -> B FILE    →    ncc translate --from A --to B FILE
//! ncc to B FILE                                         →    ncc translate --to B FILE
//! ```
//!
//! Arrows are `->`, `=>` and `→`, with or without blanks. clap would read `->` as an option. A POSIX shell reads the
//! `>` of an unquoted arrow as a redirection: `mach9 -> fanuc part.cn` becomes `mach9 - part.cn`, with stdout in a
//! file `fanuc`. This module only recognises such a torn arrow. Not here: joining it, which depends on stdout (`run`).

use std::ffi::OsString;

use clap::{CommandFactory, Subcommand};

use crate::args::typed::{ARROWS, is_name};
use crate::args::{Cli, Verb};

/// The arguments after the rewrite.
#[derive(Debug, PartialEq, Eq)]
pub enum Said {
    /// Arguments for clap. The program name is first.
    Plain(Vec<OsString>),
    /// An arrow that lost its `>` to the shell.
    Arrow {
        /// The dialect before the arrow.
        from: String,
        /// The arrow as it was typed: `->` or `=>`.
        typed: &'static str,
        /// All other arguments, without the program name.
        rest: Vec<OsString>,
    },
}

/// Rewrites the arguments; the program name is first. Arguments without a short form come back unchanged.
pub fn rewrite(arguments: Vec<OsString>) -> Said {
    let arguments = assumed(arguments);
    let Some(at) = first_positional(&arguments) else {
        return Said::Plain(arguments);
    };
    let word = |i: usize| arguments.get(i).and_then(|a| a.to_str()).unwrap_or("");
    let first = word(at);
    if Verb::has_subcommand(first) {
        return Said::Plain(arguments);
    }
    let without =
        |count: usize| -> Vec<OsString> { [&arguments[1.min(at)..at], &arguments[at + count..]].concat() };
    let translate = |from: &str, to: &str, rest: Vec<OsString>| {
        let mut all: Vec<OsString> = vec![arguments[0].clone(), "translate".into()];
        all.extend(["--from", from, "--to", to].map(OsString::from));
        all.extend(rest);
        Said::Plain(all)
    };
    if let Some((from, to)) = glued(first) {
        return translate(from, to, without(1));
    }
    if first == ARROWS[0] && is_name(word(at + 1)) {
        let mut all: Vec<OsString> = vec![arguments[0].clone(), "translate".into()];
        all.extend(["--to", word(at + 1)].map(OsString::from));
        all.extend(without(2));
        return Said::Plain(all);
    }
    if is_name(first) {
        let second = word(at + 1);
        let third = word(at + 2);
        if ARROWS.contains(&second) && !third.is_empty() {
            return translate(first, third, without(3));
        }
        // Typing mistakes such as `mach9 ->fanuc` have only one meaning.
        if let Some(to) = ARROWS[1..].iter().find_map(|a| second.strip_prefix(a)).filter(|to| is_name(to)) {
            return translate(first, to, without(2));
        }
        if let Some(typed) = torn(second) {
            return Said::Arrow { from: first.to_owned(), typed, rest: without(2) };
        }
    }
    if let Some(from) = ARROWS[1..].iter().find_map(|a| first.strip_suffix(a)).filter(|from| is_name(from))
        && is_name(word(at + 1))
    {
        return translate(from, word(at + 1), without(2));
    }
    if let Some((from, typed)) = first.split_at_checked(first.len().saturating_sub(1))
        && let Some(typed) = torn(typed)
        && is_name(from)
    {
        return Said::Arrow { from: from.to_owned(), typed, rest: without(1) };
    }
    Said::Plain(arguments)
}

/// Joins `--assume milling` into one argument. The value is optional, so clap reads it only after `=`.
fn assumed(arguments: Vec<OsString>) -> Vec<OsString> {
    let mut all: Vec<OsString> = Vec::with_capacity(arguments.len());
    let mut options = true;
    for argument in arguments {
        options &= argument != "--";
        match all.last_mut().filter(|last| options && *last == "--assume") {
            Some(last) if argument == "milling" => *last = "--assume=milling".into(),
            Some(_) | None => all.push(argument),
        }
    }
    all
}

/// The arrow of which the shell left only `-` or `=`.
fn torn(rest: &str) -> Option<&'static str> {
    match rest {
        "-" => Some("->"),
        "=" => Some("=>"),
        _ => None,
    }
}

/// Splits `A:B`, `A->B`, `A=>B` or `A→B` into its two names.
fn glued(word: &str) -> Option<(&str, &str)> {
    ["->", "=>", "→", ":"]
        .iter()
        .filter_map(|sign| word.split_once(sign))
        .find(|(from, to)| is_name(from) && is_name(to))
}

/// Index of the first argument that is neither an option nor the value of one. `None` after `--`.
fn first_positional(arguments: &[OsString]) -> Option<usize> {
    let mut at = 1;
    while let Some(argument) = arguments.get(at) {
        let Some(text) = argument.to_str() else { return Some(at) };
        if text == "--" {
            return None;
        }
        if !text.starts_with('-') || text == "-" {
            return Some(at);
        }
        let command = Cli::command();
        let translate = command.find_subcommand("translate")?;
        let mut options = translate.get_arguments().chain(command.get_arguments());
        let option = options.find(|a| {
            a.get_long().is_some_and(|long| text.strip_prefix("--") == Some(long))
                || a.get_short().is_some_and(|short| text.strip_prefix('-') == Some(&short.to_string()))
        });
        let apart = |o: &clap::Arg| o.get_action().takes_values() && !o.is_require_equals_set();
        at += if option.is_some_and(apart) { 2 } else { 1 };
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(line: &str) -> Said {
        rewrite(std::iter::once("ncc").chain(line.split(' ')).map(OsString::from).collect())
    }

    fn plain(line: &str) -> String {
        match said(line) {
            Said::Plain(all) => all[1..].iter().map(|a| a.to_str().unwrap()).collect::<Vec<_>>().join(" "),
            Said::Arrow { .. } => panic!("{line}: taken for a torn arrow"),
        }
    }

    #[test]
    fn sugar_is_the_verb() {
        let verb = "translate --from mach9 --to fanuc p.cn";
        for line in [
            "mach9 to fanuc p.cn",
            "mach9 -> fanuc p.cn",
            "mach9 => fanuc p.cn",
            "mach9 → fanuc p.cn",
            "mach9:fanuc p.cn",
            "mach9->fanuc p.cn",
            "mach9=>fanuc p.cn",
            "mach9→fanuc p.cn",
            "mach9-> fanuc p.cn",
            "mach9 ->fanuc p.cn",
            "translate --from mach9 --to fanuc p.cn",
        ] {
            assert_eq!(plain(line), verb, "{line}");
        }
        assert_eq!(
            plain("-q --eol crlf mach9 to fanuc -o x p.cn"),
            "translate --from mach9 --to fanuc -q --eol crlf -o x p.cn"
        );
    }

    #[test]
    fn what_is_assumed_is_one_argument() {
        let verb = "translate --from mach9 --to fanuc --assume=milling p.cn";
        assert_eq!(plain("--assume milling mach9 to fanuc p.cn"), verb);
        assert_eq!(plain("--assume=milling mach9 to fanuc p.cn"), verb);
        assert_eq!(plain("time --assume milling p.cn"), "time --assume=milling p.cn");
        assert_eq!(plain("time -- --assume milling"), "time -- --assume milling");
    }

    #[test]
    fn a_source_that_a_project_file_names_is_left_out() {
        assert_eq!(plain("to siemens p.nc"), "translate --to siemens p.nc");
        assert_eq!(plain("-q to siemens -o x p.nc"), "translate --to siemens -q -o x p.nc");
        assert_eq!(plain("to"), "to");
    }

    #[test]
    fn what_is_no_sugar_stays() {
        for line in
            ["--help", "explain NC0101", "prog.cn", "C:prog.cn", "-- mach9 to fanuc", "mach9", "mach9 to"]
        {
            assert_eq!(plain(line), line);
        }
    }

    #[test]
    fn a_torn_arrow_is_recognised() {
        let arrow = |typed, rest: &[&str]| Said::Arrow {
            from: "mach9".into(),
            typed,
            rest: rest.iter().map(OsString::from).collect(),
        };
        assert_eq!(said("mach9 - p.cn"), arrow("->", &["p.cn"]));
        assert_eq!(said("mach9- p.cn"), arrow("->", &["p.cn"]));
        assert_eq!(said("mach9 = p.cn"), arrow("=>", &["p.cn"]));
        assert_eq!(said("-q mach9 - p.cn"), arrow("->", &["-q", "p.cn"]));
    }
}
