//! `--print-after`: the program in between, in the text form, each time that a pass has run.

use std::io::{self, Write};

use ncc_backends::{Layout, Writer};
use ncc_dialects::{Settings, builtin};
use ncc_ir::canon::Modes;
use ncc_passes::PASSES;
use ncc_passes::watch::{Watch, watch};

/// All passes.
const ALL: &str = "all";

/// What the command line takes: the name of a pass, or `all`.
///
/// # Errors
/// There is no such pass.
pub(crate) fn name(text: &str) -> Result<String, String> {
    match text == ALL || PASSES.iter().any(|pass| pass.name == text) {
        true => Ok(text.to_owned()),
        false => Err("there is no such pass; `ncc passes` lists them".to_owned()),
    }
}

/// Prints on stderr the program after a pass, as long as the watch lives. A program that streams is shown in its pieces,
/// a procedure by itself; so are trials that give nothing.
pub(crate) fn print_after(wanted: String) -> Watch {
    watch(Box::new(move |pass, stmts| {
        let Some(form) = builtin("ir").filter(|_| wanted == ALL || wanted == pass) else { return };
        let mut text = format!("# after {pass}\n").into_bytes();
        let mut writer = Writer::new(Settings::new(form), Layout::default());
        let mut found = Vec::new();
        writer.write(stmts, &Modes::default(), &mut text, &mut found);
        writer.finish(&mut text, &mut found);
        // What cannot be reported changes nothing about what is done.
        let _ = io::stderr().lock().write_all(&text);
    }))
}
