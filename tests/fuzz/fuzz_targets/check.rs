//! The first byte picks the dialect, the second the form and whether there is a machine, the rest is the
//! program. Whatever it says, it is checked, and every finding is at a place of the text.
#![no_main]

use std::sync::LazyLock;

use clap::Parser;
use libfuzzer_sys::fuzz_target;
use ncc::args::{Cli, Verb};
use ncc::check::args::{Check, Form};
use ncc::check::of_text;
use ncc_dialects::{Settings, builtin, builtins};
use ncc_machines::Profile;
use serde_json::Value;

/// A small machine, which no program keeps within.
const MACHINE: &str = include_str!("../../check/machine.toml");

static PROFILE: LazyLock<Profile> = LazyLock::new(|| Profile::parse(MACHINE, &builtin).expect("a profile"));

fn asked(form: Form, skip: u8) -> Check {
    let skip = format!("--skip={}", skip % 10 + 1);
    let cli = Cli::try_parse_from(["ncc", "check", "-v", &skip, "--rapid-plane", "2", "text"]);
    let Verb::Check(check) = cli.expect("a command line").verb else { panic!("another verb") };
    Check { format: form, ..*check }
}

fuzz_target!(|data: &[u8]| {
    let [from, choice, text @ ..] = data else { return };
    let dialects: Vec<_> = builtins().collect();
    let dialect = dialects[usize::from(*from) % dialects.len()];
    let profile = (choice & 0x80 != 0).then(|| &*PROFILE);
    let found = |form: Form| {
        let check = asked(form, *choice);
        of_text(&check, Settings::new(dialect), profile, text).expect("anonymous files")
    };
    match choice % 3 {
        0 => {
            found(Form::Text);
        }
        1 => {
            let _: Value = serde_json::from_slice(&found(Form::Sarif)).expect("JSON");
        }
        _ => {
            let document: Value = serde_json::from_slice(&found(Form::Json)).expect("JSON");
            let lines = text.split(|byte| *byte == b'\n').count() as u64;
            for finding in document["programs"][0]["findings"].as_array().expect("a list") {
                let line = finding["place"]["line"].as_u64().expect("a line");
                assert!((1..=lines).contains(&line), "{finding}");
            }
        }
    }
});
