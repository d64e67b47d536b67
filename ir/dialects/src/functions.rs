//! Custom functions that programs of the user process (`[functions]` of a dictionary), after the hash table
//! `function_dict` of the case study (Aguiar 2023, ch. 3.2).
//!
//! ```text
//! [functions.G200]
//! command = ["python3", "functions/g200.py"]
//! ```
//!
//! A reader gathers the blocks, and whoever may start programs makes statements of them ([`RunFunctions`]). Not here: the
//! form of the blocks in a file, and how a program is started.

use std::fmt::Debug;
use std::ops::{Deref, RangeInclusive};
use std::path::PathBuf;
use std::sync::Arc;

use ncc_ir::canon::{AXES, Plane, Units};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Op;
use ncc_ir::unsupported::FunctionFailure;
use serde::Deserialize;

/// Time limits that a function may have, in seconds.
pub(crate) const TIME_LIMITS: RangeInclusive<u32> = 1..=600;

/// Numbers of blocks that an answer may be limited to.
pub(crate) const BLOCKS: RangeInclusive<u32> = 1..=100_000;

/// A custom function, and the program that processes its blocks.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FunctionRow {
    /// The program and its arguments, each a text; no shell reads them. ncc adds two: the path of the file with the blocks,
    /// and that of the file for the answer. The program runs in the folder of the dictionary.
    pub command: Vec<String>,
    /// The code that ends the function, of a function that has all blocks from its own to that one at once; without, each
    /// block by itself.
    #[serde(default)]
    pub until: Option<String>,
    /// Seconds after which ncc ends the program, 1 to 600; 10 if nothing is stated.
    #[serde(default = "usual_time")]
    pub time_limit: u32,
    /// Most blocks of an answer, 1 to 100000; 10000 if nothing is stated.
    #[serde(default = "usual_blocks")]
    pub most_blocks: u32,
    /// The file that says the row, by its place among the files that were read: no key of a dictionary.
    #[serde(skip)]
    pub file: Option<usize>,
    /// The folder of that file, as whoever reads files has it: no key of a dictionary.
    #[serde(skip)]
    pub folder: PathBuf,
}

impl FunctionRow {
    /// The program with its arguments, for people.
    pub fn program(&self) -> String {
        self.command.join(" ")
    }
}

fn usual_time() -> u32 {
    10
}

fn usual_blocks() -> u32 {
    10_000
}

/// A block that a program gets, before processing.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenBlock {
    /// The block of the source.
    pub gcode: String,
    /// The function's own name; `START_CYCLE`, `HOLE` or `END_CYCLE` of blocks that are handed over together.
    pub function_name: String,
    /// Position at the call, in program coordinates. Rotary axes are zero where the program has moved none.
    pub position: [Nanos; AXES],
    /// Whether the program has moved a rotary axis.
    pub rotary: bool,
    /// Active entry of the length table; `None` if it is not known.
    pub cut_offset: Option<u32>,
    /// Active feed, nanos of mm/min; 0 if none is known.
    pub feed: Nanos,
    /// Active spindle speed, nanos of rev/min; 0 if none is known.
    pub speed: Nanos,
    /// Tool in the spindle; 0 if none is known.
    pub tool: i64,
    /// The words of the block but its codes: letter in lower case, and value in nanos of mm, degrees or seconds. Words of
    /// axes are end points from program zero. Of a letter that the dictionary does not have, the number as it is written.
    pub parameters: Vec<(char, Nanos)>,
}

/// Blocks of a function, and what is active where it is called.
#[derive(Clone, Copy, Debug)]
pub struct FunctionCall<'c> {
    /// The name of the function.
    pub name: &'c str,
    /// Its row.
    pub row: &'c FunctionRow,
    /// The unit in which the statements have lengths.
    pub units: Units,
    /// The active plane.
    pub plane: Plane,
    /// One block, or those from the function's own to the one that ends it.
    pub blocks: &'c [GivenBlock],
}

/// The statements that a program has made of the blocks, in blocks of their own; each with the place of the given block
/// that it belongs to. They name every coordinate absolutely.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FunctionAnswer {
    /// Operations of each block.
    pub blocks: Vec<(usize, Vec<Op>)>,
}

/// Makes statements of the blocks of custom functions.
pub trait RunFunctions: Debug + Send + Sync {
    /// Has a program process blocks.
    ///
    /// # Errors
    /// The program fails, or ncc cannot take its answer; with what the program has written to its standard error.
    fn run(&self, call: &FunctionCall) -> Result<FunctionAnswer, (FunctionFailure, Box<str>)>;

    /// The SHA-256 of all that programs were given and have answered so far; `None` if none was started.
    fn digest(&self) -> Option<[u8; 32]>;
}

/// The one who runs the functions of a dialect.
#[derive(Clone, Debug)]
pub struct FunctionHost(Arc<dyn RunFunctions>);

impl FunctionHost {
    /// This one.
    pub fn new(host: Arc<dyn RunFunctions>) -> FunctionHost {
        FunctionHost(host)
    }
}

impl Deref for FunctionHost {
    type Target = dyn RunFunctions;

    fn deref(&self) -> &Self::Target {
        &*self.0
    }
}
