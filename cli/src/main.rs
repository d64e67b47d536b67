//! The binary `ncc`. Everything it does is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    ncc::interrupt::listen();
    ncc::files::scratch::use_files();
    ExitCode::from(ncc::run::run(std::env::args_os().collect()) as u8)
}
