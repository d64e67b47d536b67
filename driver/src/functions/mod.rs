//! Custom functions that programs of the user process (`[functions]` of a dictionary): blocks as files, after the interface
//! that the case study gives every such program (Aguiar 2023, ch. 3.2).
//!
//! ```text
//! G200 X10. R4.    [{"gcode":"G200 X10. R4.","function_name":"G200", … "parameters":{"x":10.0,"r":4.0}}]
//! the answer       [{… "function_name":"STRAIGHT_FEED", … "x1":10.0, … "feed":100.0, … "parameters":{}}]
//! ```
//!
//! A program is started once for each input: what it has answered holds for the whole run of ncc, so that all executions of
//! a program, and both sides of a comparison, mean the same. Not here: how a program is started. Whoever may do that hands
//! over a [`StartProgram`]; the command line alone has one, and without it functions are refused.

mod answer;

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::io;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use ncc_dialects::{FunctionAnswer, FunctionCall, GivenBlock, RunFunctions};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::unsupported::FunctionFailure;
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};

use crate::time::payload::{Block, Rotary, read_blocks};

/// Longest answer of a program, in bytes: 10,000 blocks of the usual 400 bytes, ten times.
pub const MOST_BYTES: u32 = 40_000_000;

/// The reason for a missing answer, and the end of the program's standard error.
pub type Failed = (FunctionFailure, Box<str>);

/// A program of the user, as it is to be started.
#[derive(Clone, Copy, Debug)]
pub struct Program<'p> {
    /// The program and its arguments; two paths follow them.
    pub command: &'p [String],
    /// The folder in which it runs.
    pub folder: &'p Path,
    /// The time after which it is ended.
    pub time_limit: Duration,
    /// Most bytes that it may answer with.
    pub most_bytes: u32,
}

/// Starts programs of the user.
pub trait StartProgram: Debug + Send + Sync {
    /// Starts a program with a file that has these bytes, and gives those of the file that it writes.
    ///
    /// # Errors
    /// It cannot be started, fails, takes too long, or writes no file that can be read.
    fn start(&self, program: &Program, input: &[u8]) -> Result<Vec<u8>, Failed>;
}

/// A call that was answered: the SHA-256 of the answer's bytes, and the statements made of it.
#[derive(Clone, Debug)]
struct Answered {
    sha256: [u8; 32],
    made: Result<FunctionAnswer, Failed>,
}

/// Makes statements of the blocks of one dialect's functions.
#[derive(Debug)]
pub struct Functions {
    starter: Box<dyn StartProgram>,
    /// By the SHA-256 of the call.
    answers: Mutex<BTreeMap<[u8; 32], Answered>>,
}

impl Functions {
    /// Functions whose programs are started so.
    pub fn new(starter: Box<dyn StartProgram>) -> Functions {
        Functions { starter, answers: Mutex::default() }
    }

    fn answers(&self) -> MutexGuard<'_, BTreeMap<[u8; 32], Answered>> {
        self.answers.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl RunFunctions for Functions {
    fn run(&self, call: &FunctionCall) -> Result<FunctionAnswer, Failed> {
        let unwritten = |e: serde_json::Error| (no_folder(&e.into()), Box::default());
        let input = input(call.blocks).map_err(unwritten)?;
        let key = key(call, &input);
        if let Some(known) = self.answers().get(&key) {
            return known.made.clone();
        }
        let program = Program {
            command: &call.row.command,
            folder: &call.row.folder,
            time_limit: Duration::from_secs(call.row.time_limit.into()),
            most_bytes: MOST_BYTES,
        };
        // Not under the lock: of two threads with one input, the first answer counts.
        let output = self.starter.start(&program, &input);
        let sha256 = output.as_ref().map_or([0; 32], |bytes| Sha256::digest(bytes).into());
        let made = output.and_then(|bytes| made(call, &bytes).map_err(|why| (why, Box::default())));
        if let Err((FunctionFailure::Interrupted, _)) = &made {
            return made;
        }
        self.answers().entry(key).or_insert(Answered { sha256, made }).made.clone()
    }

    fn digest(&self) -> Option<[u8; 32]> {
        let answers = self.answers();
        let mut digest = Sha256::new();
        for (key, answered) in &*answers {
            digest.update(key);
            digest.update(answered.sha256);
        }
        (!answers.is_empty()).then(|| digest.finalize().into())
    }
}

/// A failure to write the file for a program.
pub fn no_folder(error: &io::Error) -> FunctionFailure {
    FunctionFailure::NoFolder { reason: error.to_string().into() }
}

/// The statements of an answer.
fn made(call: &FunctionCall, bytes: &[u8]) -> Result<FunctionAnswer, FunctionFailure> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(FunctionFailure::Empty);
    }
    if bytes.contains(&0) || std::str::from_utf8(bytes).is_err() {
        return Err(FunctionFailure::NotText);
    }
    let blocks = read_blocks(bytes).map_err(|unread| FunctionFailure::NotBlocks {
        line: unread.line,
        column: unread.column,
        reason: unread.reason.into(),
    })?;
    if blocks.len() > call.row.most_blocks as usize {
        return Err(FunctionFailure::TooMany { most: call.row.most_blocks });
    }
    answer::statements(call, &blocks)
}

/// A digest of all that an answer depends on: the function, its program, its input, and the active modes.
fn key(call: &FunctionCall, input: &[u8]) -> [u8; 32] {
    let mut digest = Sha256::new();
    // Two functions may have one command, relative to dictionaries in two folders.
    for part in std::iter::once(call.name).chain(call.row.command.iter().map(String::as_str)) {
        digest.update(part);
        digest.update([0]);
    }
    digest.update(format!("{:?} {:?}\n", call.units, call.plane));
    digest.update(input);
    digest.finalize().into()
}

/// The file that a program gets: a list of blocks, one a line.
fn input(blocks: &[GivenBlock]) -> serde_json::Result<Vec<u8>> {
    let mut out = b"[".to_vec();
    for (at, block) in blocks.iter().enumerate() {
        out.extend_from_slice(if at > 0 { b",\n" } else { b"\n" });
        serde_json::to_writer(&mut out, &given(block))?;
    }
    out.extend_from_slice(b"\n]\n");
    Ok(out)
}

/// A block of the source, in the form of the payload.
fn given(block: &GivenBlock) -> Block<'_> {
    let [x, y, z, a, b, c] = block.position.map(units);
    let parameters =
        block.parameters.iter().map(|(letter, value)| (letter.to_string(), Value::from(units(*value))));
    Block {
        gcode: block.gcode.as_str().into(),
        function_name: block.function_name.as_str().into(),
        x0: x,
        y0: y,
        z0: z,
        x1: x,
        y1: y,
        z1: z,
        rotary: block.rotary.then_some(Rotary { a0: a, b0: b, c0: c, a1: a, b1: b, c1: c }),
        cut_offset: block.cut_offset,
        feed: units(block.feed),
        speed: units(block.speed),
        tool: block.tool,
        dx: 0.0,
        dy: 0.0,
        dz: 0.0,
        distance: 0.0,
        time: 0.0,
        timestamp: 0.0,
        parameters: Map::from_iter(parameters),
    }
}

/// Base units of nanos, to a millionth.
fn units(nanos: Nanos) -> f64 {
    (nanos as f64 / ONE as f64 * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests;
