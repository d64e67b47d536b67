//! Starts programs of the user for custom functions (`[functions]` of a dictionary), where `--run-functions` allows it.
//!
//! ```text
//! python3 functions/g200.py ncc-function-x/blocks.json ncc-function-x/answer.json
//! ```
//!
//! A program runs in the folder of its dictionary, with the environment of ncc, without input, and with its standard output
//! thrown away. It ends with its time limit, with too much output, and with Ctrl-C. On Unix it is the first of a group of
//! processes, which end with it. Not here: what the files have in them (`ncc_driver::functions`).

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use ncc_driver::functions::{Failed, Program, StartProgram, no_folder};
use ncc_exec::halt;
use ncc_ir::unsupported::FunctionFailure;

/// Longest time between two looks at a program.
const LOOK: Duration = Duration::from_millis(20);

/// Most bytes of its standard error that are shown.
const SHOWN: u64 = 2_000;

/// Starts programs as processes of this computer.
#[derive(Debug)]
pub(super) struct Processes;

impl StartProgram for Processes {
    fn start(&self, program: &Program, input: &[u8]) -> Result<Vec<u8>, Failed> {
        let unwritten = |e: io::Error| (no_folder(&e), Box::default());
        // Only the user may look into it, and it goes with its last use.
        let folder = tempfile::Builder::new().prefix("ncc-function-").tempdir().map_err(unwritten)?;
        let [blocks, answer, said] =
            ["blocks.json", "answer.json", "stderr"].map(|name| folder.path().join(name));
        fs::write(&blocks, input).map_err(unwritten)?;
        let errors = File::create(&said).map_err(unwritten)?;
        let shown = |why: FunctionFailure| (why, shown(&said).into_boxed_str());
        let mut command = command(program);
        command.args([&blocks, &answer]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(errors);
        let mut child = command
            .spawn()
            .map_err(|e| (FunctionFailure::NotStarted { reason: e.to_string().into() }, Box::default()))?;
        let status = wait(&mut child, program, &[&answer, &said]).map_err(shown)?;
        match status.code() {
            Some(0) => read(&answer, program.most_bytes).map_err(shown),
            Some(code) => Err(shown(FunctionFailure::Ended { code: code.into() })),
            None => Err(shown(FunctionFailure::Killed)),
        }
    }
}

/// The command of a program, without its files.
fn command(program: &Program) -> Command {
    let (name, arguments) = program.command.split_first().map_or(("", &[][..]), |(name, rest)| (name, rest));
    // A path counts from the folder of the dictionary. A bare name is looked for where the system looks for programs.
    let path = Path::new(name);
    let name = if path.components().count() > 1 { program.folder.join(path) } else { PathBuf::from(name) };
    let mut command = Command::new(name);
    command.args(arguments).current_dir(program.folder);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command
}

/// Waits for a program to end, and ends it where it may not go on.
fn wait(child: &mut Child, program: &Program, written: &[&Path]) -> Result<ExitStatus, FunctionFailure> {
    let begun = Instant::now();
    let mut look = Duration::from_millis(1);
    let limit = program.most_bytes;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(status),
            Ok(None) => {}
            Err(e) => {
                end(child);
                return Err(FunctionFailure::NotStarted { reason: e.to_string().into() });
            }
        }
        let large = |file: &&Path| fs::metadata(file).is_ok_and(|of| of.len() > limit.into());
        let why = if halt::is_asked() {
            FunctionFailure::Interrupted
        } else if begun.elapsed() >= program.time_limit {
            FunctionFailure::TimeLimit { seconds: program.time_limit.as_secs() as u32 }
        } else if written.iter().any(large) {
            FunctionFailure::TooLarge { limit }
        } else {
            std::thread::sleep(look);
            look = (look * 2).min(LOOK);
            continue;
        };
        end(child);
        return Err(why);
    }
}

/// Ends a program, and on Unix what it has started.
fn end(child: &mut Child) {
    #[cfg(unix)]
    {
        // The child has not been waited for, so that its number is nobody else's.
        let group = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw);
        if let Some(group) = group {
            let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
        }
    }
    // It may have ended by itself.
    let _ = child.kill();
    let _ = child.wait();
}

/// The answer, if it is a plain file of at most so many bytes.
fn read(answer: &Path, limit: u32) -> Result<Vec<u8>, FunctionFailure> {
    let of = fs::symlink_metadata(answer).map_err(|_| FunctionFailure::NoOutput)?;
    if !of.is_file() {
        return Err(FunctionFailure::NoFile);
    }
    let mut bytes = Vec::new();
    let read = File::open(answer).and_then(|file| file.take(u64::from(limit) + 1).read_to_end(&mut bytes));
    match read {
        Ok(_) if bytes.len() > limit as usize => Err(FunctionFailure::TooLarge { limit }),
        Ok(_) => Ok(bytes),
        Err(_) => Err(FunctionFailure::NoFile),
    }
}

/// The end of what a program has written to its standard error.
fn shown(said: &Path) -> String {
    let mut bytes = Vec::new();
    let end = File::open(said).and_then(|mut file| {
        let len = file.metadata()?.len();
        file.seek(SeekFrom::Start(len.saturating_sub(SHOWN)))?;
        file.take(SHOWN).read_to_end(&mut bytes)
    });
    let text = String::from_utf8_lossy(&bytes);
    end.map_or(String::new(), |_| text.trim().to_owned())
}
