//! The command line as clap sees it, after `sugar` has rewritten `A to B FILE` to the verb.
//!
//! Values are parsed here as far as that needs no file; what they mean together is `run`'s matter.

pub mod common_args;
pub mod sugar;
pub mod typed;

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use ncc_backends::Numbering;
use ncc_ir::diag::Verdict;
use ncc_ir::expr::num::Num;
use ncc_passes::Pass;

use crate::args::common_args::{Lines, StartPosition, Verbosity};
use crate::args::typed::Assumed;
use crate::args::typed::MCode;
use crate::args::typed::{Color, Format, Style, UnitsArg, call_left_out, numbering, pair};

/// `ncc` and its verbs.
#[derive(Debug, Parser)]
#[command(
    name = "ncc",
    version,
    max_term_width = 100,
    about = "Translates CNC part programs from one control's language into another's, and shows that \
             the machine makes the same cut.",
    override_usage = "ncc [OPTIONS] A to B FILE\n       ncc <COMMAND>",
    after_help = TOP_EXAMPLES,
    subcommand_required = true,
    arg_required_else_help = true,
    disable_help_subcommand = true
)]
pub struct Cli {
    /// A dictionary of your own; its name can then be used as any dialect's [may be repeated]
    #[arg(long, global = true, value_name = "FILE")]
    pub dialect: Vec<PathBuf>,
    /// Look for called programs in this folder, in files named as the control's custom is: O1234.nc,
    /// POCKET.SPF [may be repeated]
    #[arg(short = 'I', long = "include", global = true, value_name = "DIR")]
    pub include: Vec<PathBuf>,
    /// Go on where a program has two readings, with ncc's own; head and report name the questions first.
    /// `--assume milling`: read every program as a milling program too, even one that looks like a lathe's
    #[arg(
        long,
        global = true,
        value_name = "WHAT",
        value_enum,
        num_args = 0..=1,
        require_equals = true,
        hide_possible_values = true,
        // Last of what is accepted.
        display_order = 999
    )]
    pub assume: Option<Option<Assumed>>,
    /// The unit of lengths of a source that never states it
    #[arg(long, global = true, value_name = "mm|inch", value_enum, hide_possible_values = true)]
    pub units: Option<UnitsArg>,
    /// What becomes of an M code that the source's dialect does not know: `M31=drop` leaves it out,
    /// `M31=carry` writes it unchanged, `M31=M88` writes another one
    #[arg(long, global = true, value_name = "CODE=WHAT", value_parser = MCode::read)]
    pub m_code: Vec<MCode>,
    /// Leave out all calls of a program that is not at hand, with their arguments: `RAPORT=drop`,
    /// `9810=drop`; `M165=drop` those by a code of the machine
    #[arg(long, global = true, value_name = "NAME=drop", value_parser = call_left_out)]
    pub call: Vec<String>,
    /// Ignore `ncc.toml`, the project file that states machines of programs
    #[arg(long, global = true)]
    pub no_config: bool,
    /// Start the programs that dictionaries of your own name for custom functions (`[functions]`): they can do whatever
    /// you can
    #[arg(long, global = true)]
    pub run_functions: bool,
    /// Colour of the messages; `auto` is if stderr is a terminal and NO_COLOR is not set
    #[arg(
        long,
        global = true,
        value_name = "auto|always|never",
        value_enum,
        default_value_t = Color::Auto,
        hide_possible_values = true,
        hide_default_value = true,
        help_heading = "What is reported",
        // After what the verbs ask of their own.
        display_order = 1000
    )]
    pub color: Color,
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

const TOP_EXAMPLES: &str = "\
Examples:
  ncc mach9 to fanuc part.cn               print the program for the other control
  ncc mach9 to fanuc part.cn -o part.nc    write it to a file
  ncc mach9 -> fanuc part.cn               the same, into a file named `fanuc`
  ncc auto to canon part.nc                recognise the source; list the moves
  ncc to siemens part.nc                   where `ncc.toml` names the machine of the program
  ncc explain NC0107                       what a message means, and what to do

`ncc A to B FILE`, `ncc A:B FILE` and the arrow are short for `ncc translate --from A --to B FILE`;
all options of `ncc translate --help` can be given with them.

The translated program goes to stdout, everything else to stderr. Exit code: 0 done and verified;
1 the program has errors or is not for a mill, or something would be lost; 2 wrong usage;
3 verification failed and nothing is released; 4 a file could not be read or written;
130 interrupted by ctrl-C, and nothing is written.
Of `ncc diff` and `ncc verify`: 1 the programs differ, or a certificate does not hold; 5 they could not be compared.";

const TRANSLATE_EXAMPLES: &str = "\
Examples:
  ncc translate --from mach9 --to fanuc part.cn -o part.nc
  ncc mach9 to fanuc part.cn --number 10:10 --eol crlf
  ncc mach9 to canon part.cn --start X-9,Y15.588,Z3 --from-option o_word=ignore
  ncc auto to fanuc - --report part.json < part.cn
  ncc mach9 to fanuc a.cn b.cn folder -o out/     several, into a folder

`ncc dialects` lists the dialects, `ncc dialects show mach9` the options and what is unconfirmed.";

/// The verbs.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Translate a program, and verify the result [short: A to B FILE]
    Translate(Box<Translate>),
    /// Write `ncc.toml`: which machines the programs of a folder are for, with what is to be answered
    Init(Box<crate::project::args::Init>),
    /// Show what `ncc.toml` states of a program, and in which line
    Config(crate::project::args::Config),
    /// List the dialects, or show one: its words, options, sources
    Dialects(Dialects),
    /// How long a program takes on a machine, and when everything in it happens
    Time(Box<crate::time::args::Time>),
    /// Execute programs and tell what is wrong with them, before they meet a machine
    Check(Box<crate::check::args::Check>),
    /// Lay programs out in their dialect, and show that they still say the same
    Fmt(Box<crate::fmt::args::Fmt>),
    /// Draw what a program does over time, or the way of its tool, as SVG or HTML
    Plot(Box<crate::plot::args::Plot>),
    /// Cut the part: what each tool removes, collisions, pictures, the part as a body
    Simulate(Box<crate::simulate::args::Simulate>),
    /// Edit, see, cut and translate programs in the browser, on this computer
    #[cfg(feature = "studio")]
    Studio(Studio),
    /// Programs, their documents and outputs over HTTP, kept in a database
    #[cfg(feature = "serve")]
    Serve(Box<crate::serve::Serve>),
    /// Do two programs make the same cut? As strictly as a translation is verified; certificates
    Verify(Box<crate::review::args::Verify>),
    /// Do two programs make the same cut? If not, what differs?
    Diff(Box<crate::review::diff::args::Diff>),
    /// The same as a driver for git, which calls it with seven arguments
    GitDiff(crate::review::diff::args::GitDiff),
    /// Print what a program does, one line an event, for git's own diff
    GitTextconv(crate::review::args::Textconv),
    /// Where a line of a translated program comes from, by which words, and what is active there
    Why(crate::provenance::args::Why),
    /// List the machines, show a profile, or test one
    Machines(crate::machines::args::Machines),
    /// List the facts about both machines that a translation depends on, and ask for them
    Doctor(Box<crate::doctor::args::Doctor>),
    /// List the rewriting passes, in the order in which they are run
    Passes,
    /// Explain a message by its code
    Explain(Explain),
    /// Print completions for a shell
    Completions(Completions),
    /// Print the manual page of ncc, or of a verb
    Man(Man),
}

/// `ncc studio`.
#[cfg(feature = "studio")]
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  ncc studio                   the programs of this folder
  ncc studio part.nc           one program: it is saved back, and read again where another program changes it

The page is served to this computer alone (127.0.0.1), to whoever has its address. Ctrl-C ends it.")]
pub struct Studio {
    /// A program, or a folder of programs
    #[arg(value_name = "FILE|FOLDER", default_value = ".")]
    pub programs: PathBuf,
    /// The port [default: any that is free]
    #[arg(long, value_name = "PORT", default_value = "0", hide_default_value = true)]
    pub port: u16,
    /// Print the address, and leave it to the user to open it
    #[arg(long)]
    pub no_open: bool,
}

/// `ncc translate`.
#[derive(Debug, Args)]
#[command(
    override_usage = "ncc [OPTIONS] A to B FILE\n       ncc translate --from A --to B [OPTIONS] FILE",
    after_help = TRANSLATE_EXAMPLES
)]
pub struct Translate {
    /// Dialect of the source, or `auto` to recognise it [default: that of `ncc.toml`]
    #[arg(long, value_name = "DIALECT", help_heading = "What to translate")]
    pub from: Option<String>,
    /// Dialect to translate into [default: that of `ncc.toml`]
    #[arg(long, value_name = "DIALECT", help_heading = "What to translate")]
    pub to: Option<String>,
    /// The machine that the program was written for: a profile by its name or file, which names the
    /// dialect too
    #[arg(long, value_name = "MACHINE", help_heading = "What to translate")]
    pub machine_from: Option<String>,
    /// The machine to translate for
    #[arg(long, value_name = "MACHINE", help_heading = "What to translate")]
    pub machine_to: Option<String>,
    /// The program; `-` for stdin. Several, and folders of programs, go into a folder: -o FOLDER
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Set an option of the source's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What to translate")]
    pub from_option: Vec<(String, String)>,
    /// Set an option of the target's dictionary
    #[arg(long, value_name = "NAME=VALUE", value_parser = pair, help_heading = "What to translate")]
    pub to_option: Vec<(String, String)>,
    /// Where it begins.
    #[command(flatten, next_help_heading = "What to translate")]
    pub standing: StartPosition,
    /// What variables may be given before the program begins, by a caller or an operator: a TOML file
    #[arg(long, value_name = "FILE", help_heading = "What to translate")]
    pub args: Option<PathBuf>,
    /// State what a variable holds at the start that the program reads and never sets: `_td=0.25`, `500=12`; the
    /// output sets it. `#4120=2` and `#4111=2` are the T and H code active on a Fanuc. On a Sinumerik it may be one that no program defines (GUD); `NAME=drop` leaves the assignments of
    /// such a one out [may be repeated]
    #[arg(long, value_name = "NAME=NUMBER", value_parser = ncc_driver::job::initial_variables::value, help_heading = "What to translate")]
    pub value: Vec<(String, Option<Num>)>,

    /// Send the program through a pass first; `ncc passes` lists them [may be repeated]
    #[arg(long, value_name = "NAME", value_parser = pass, help_heading = "What to translate")]
    pub pass: Vec<&'static Pass>,
    /// 0 keeps the source's structure; 1 folds long-hand holes into cycles, and positions into
    /// patterns [default: 0; 1 from canon]
    #[arg(
        short = 'O',
        value_name = "LEVEL",
        value_parser = clap::value_parser!(u8).range(0..=1),
        help_heading = "What to translate"
    )]
    pub optimise: Option<u8>,

    /// Write the program to this file instead of stdout, or of the folder of `ncc.toml`; it appears whole or not at all. In a folder,
    /// the file is named as the machine's profile has it
    #[arg(short, long, value_name = "FILE", help_heading = "How the result looks")]
    pub output: Option<PathBuf>,
    /// Write subprograms to files of their own, in the folder of -o: `L300.SPF`, `O0300.nc` [default: of
    /// several programs, where the control keeps them so, as a Sinumerik does]
    #[arg(long, conflicts_with = "no_split", help_heading = "How the result looks")]
    pub split: bool,
    /// Write a program and its subprograms as one text
    #[arg(long, help_heading = "How the result looks")]
    pub no_split: bool,
    /// Programs that are translated at the same time [default: the machine's cores]
    #[arg(
        short,
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..),
        help_heading = "What to translate"
    )]
    pub jobs: Option<u16>,
    /// Block numbers: none, those of the source, or new ones [default: off]
    #[arg(
        long,
        value_name = "off|keep|FIRST:STEP",
        value_parser = numbering,
        help_heading = "How the result looks"
    )]
    pub number: Option<Numbering>,
    /// Its lines.
    #[command(flatten, next_help_heading = "How the result looks")]
    pub lines: Lines,
    /// Program number, where the target has one; of several programs, the first one's, counted up
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=99_999_999),
        help_heading = "How the result looks"
    )]
    pub program_number: Option<u32>,
    /// Leave out the comment at the top that names source, hash and assumptions
    #[arg(long, conflicts_with = "no_verify", help_heading = "How the result looks")]
    pub no_head: bool,

    /// How canon is written: rs274 lists the calls as LinuxCNC's stand-alone interpreter prints them,
    /// compensated contours by the tool centre path; it is a listing, and no program
    /// [default: plain]
    #[arg(
        long,
        value_name = "plain|rs274",
        value_enum,
        default_value_t = Style::Plain,
        hide_possible_values = true,
        hide_default_value = true,
        help_heading = "How the result looks"
    )]
    pub style: Style,

    /// Put the line of the source at the end of each line of the result, as a comment with its number;
    /// only where it is another one than that of the line before
    #[arg(long, help_heading = "How the result looks")]
    pub annotate: bool,

    /// Let these verdicts pass: changed, manual, dropped
    #[arg(
        long,
        value_name = "LIST",
        value_delimiter = ',',
        value_parser = verdicts(),
        hide_possible_values = true,
        help_heading = "What is accepted"
    )]
    pub allow: Vec<Verdict>,
    /// Let these verdicts stop the translation too: assumed, expanded, within-tolerance, reformatted
    #[arg(
        long,
        value_name = "LIST",
        value_delimiter = ',',
        value_parser = verdicts(),
        hide_possible_values = true,
        help_heading = "What is accepted"
    )]
    pub deny: Vec<Verdict>,
    /// Do not verify; the result says UNVERIFIED at its top
    #[arg(long, help_heading = "What is accepted")]
    pub no_verify: bool,

    /// Write everything that is known of the translation to this file, as JSON
    #[arg(long, value_name = "FILE", help_heading = "What is reported")]
    pub report: Option<PathBuf>,
    /// Write to this file where every line of the result comes from, as JSON; `ncc why` reads it, by
    /// itself if it has the name of the result and `.map.json`
    #[arg(long, value_name = "FILE", conflicts_with = "no_verify", help_heading = "What is reported")]
    pub map: Option<PathBuf>,
    /// Print the program in between on stderr, each time that a pass has run: its name, or `all`
    #[arg(long, value_name = "PASS", value_parser = crate::print_after::name, help_heading = "What is reported")]
    pub print_after: Option<String>,
    /// How much ncc reports.
    #[command(flatten)]
    pub telling: Verbosity,
    /// Messages for people, or as JSON, one object a line; of several programs, one document on stdout
    /// [default: human]
    #[arg(
        long,
        value_name = "human|json",
        value_enum,
        default_value_t = Format::Human,
        hide_possible_values = true,
        hide_default_value = true,
        help_heading = "What is reported"
    )]
    pub format: Format,
}

/// `ncc dialects`.
#[derive(Debug, Args)]
pub struct Dialects {
    /// What about them; without, a list.
    #[command(subcommand)]
    pub what: Option<DialectsWhat>,
}

/// `ncc dialects show`.
#[derive(Debug, Subcommand)]
pub enum DialectsWhat {
    /// Show a dialect: every row with its meaning and source
    Show {
        /// Its name, as `ncc dialects` lists it
        id: String,
    },
    /// Show that every word of a dictionary reads back to the meaning it was written for
    Test {
        /// Names of dialects, or files of dictionaries
        #[arg(value_name = "FILE|ID", required = true)]
        what: Vec<PathBuf>,
        /// List every row, also those that pass
        #[arg(short, long)]
        verbose: bool,
        /// List failures and the counts only, as without it
        #[arg(short, long, conflicts_with = "verbose")]
        quiet: bool,
    },
    /// Print a commented dictionary to begin with, which builds on another dialect
    New {
        /// Its name, such as `shop`
        id: String,
        /// The dialect that it builds on
        #[arg(long, value_name = "DIALECT")]
        base: String,
    },
    /// Print the form of a dictionary: every table and field
    Schema,
}

/// `ncc explain`.
#[derive(Debug, Args)]
pub struct Explain {
    /// The code of a message, such as NC0107
    pub code: String,
}

/// `ncc completions`.
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}

/// `ncc man`.
#[derive(Debug, Args)]
pub struct Man {
    /// A verb, such as `translate`; without one, the page of ncc
    pub verb: Option<String>,
}

fn pass(name: &str) -> Result<&'static Pass, String> {
    ncc_driver::translate::rewrite::pass(name)
        .ok_or_else(|| "there is no such pass; `ncc passes` lists them".to_owned())
}

fn verdicts() -> impl TypedValueParser<Value = Verdict> {
    PossibleValuesParser::new(Verdict::ALL.map(Verdict::name))
        .map(|name| Verdict::ALL.into_iter().find(|v| v.name() == name).unwrap_or(Verdict::Exact))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clap_agrees_with_itself() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn no_dialect_bears_the_name_of_a_verb() {
        use clap::CommandFactory;
        let command = Cli::command();
        for dialect in ncc_dialects::builtins() {
            let id = dialect.id.as_str();
            let verb = command.get_subcommands().any(|verb| verb.get_name() == id);
            assert!(!verb && !["auto", "help", "to"].contains(&id), "{id}");
            assert!(crate::args::typed::is_name(id), "{id} cannot be written in `A:B`");
        }
    }
}
