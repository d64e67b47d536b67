//! What a translation is ordered to be, as far as that is the same for every program of a command: the
//! machines of both sides, the target with its options, and the source's dialect where it is named.
//!
//! Not here: the programs themselves, and where their translations go (`run`, `batch`).

use std::path::Path;
use std::sync::Arc;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_backends::Layout;
use ncc_dialects::{Dialect, Settings};
use ncc_driver::job::Job;
use ncc_driver::job::initial_variables::{self, InitialVariables};
use ncc_driver::job::options::{choose, state_units};
use ncc_driver::job::start;
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::Problem;
use ncc_driver::provenance::annotate;
use ncc_driver::questions::Policy;
use ncc_driver::source::chunks::PIECE;
use ncc_ir::expr::num::Num;
use ncc_machines::reading::Side;

use crate::args::Translate;
use crate::args::typed::Eol;
use crate::machines::agreed;
use crate::project::{InForce, Settled, Sides, Stated, settle};
use crate::registry::DialectRegistry;
use crate::registry::recognised::INTO_WHAT;
use crate::{files, m_codes};

/// What all programs of a command have in common.
#[derive(Debug)]
pub(crate) struct TargetOptions {
    /// The machines of both sides.
    pub(crate) machines: Machines,
    /// The target, with what was chosen of it.
    pub(crate) to: Settings,
    /// What variables may be given.
    given: InitialVariables,
    /// Their values at the start, from the command line and the profile.
    values: Vec<(String, Num)>,
    /// The dialect of the sources; `None` if it is to be recognised.
    pub(crate) named: Option<&'static Dialect>,
    /// The same with what was chosen of it. What a profile states is put in once: it is kept for good.
    from: Option<Settings>,
    /// What is known of all sources.
    known: DialectRegistry,
    /// The row of a project file that counts for the sources.
    pub(crate) settled: Option<Settled>,
}

impl TargetOptions {
    /// What the command line says. Faults of profiles are reported.
    ///
    /// # Errors
    /// A dialect or a machine is missing, unknown or at odds with the other; an option is none of the
    /// dialect's.
    pub(crate) fn find(
        args: &Translate,
        known: &DialectRegistry,
        row: Option<&InForce>,
        told: &mut dyn WriteColor,
    ) -> Result<TargetOptions, Problem> {
        let settled = row.map(|row| settle(row, Sides::Written, &stated(args), None, known)).transpose()?;
        let mut machines = crate::machines::find_both(
            args.machine_from.as_deref(),
            args.machine_to.as_deref(),
            known,
            told,
        )?;
        if let Some(settled) = &settled {
            machines.from = machines.from.or_else(|| settled.machine.clone());
            machines.to = machines.to.or_else(|| settled.to.clone());
        }
        let to = args.to.as_deref().map(|id| known.dialect(id)).transpose()?;
        let to = agreed(to, machines.to.as_deref(), "to")?;
        let to = to.ok_or_else(|| Problem::usage("translate into what?", INTO_WHAT))?;
        if args.from.is_none() && machines.from.is_none() {
            return Err(Problem::usage(
                "translate from what?",
                "name a dialect: --from mach9; or have it recognised: --from auto; \
                 or name a machine: --machine-from MACHINE; or in `ncc.toml`, which `ncc init` writes",
            ));
        }
        let mut to = choose(machines.settings(Side::To, to), &args.to_option)?;
        m_codes::state(&mut to, Side::To, known)?;
        if args.annotate && !annotate::can(to.dialect) {
            return Err(Problem::usage(
                format!("{} has no comments that could stand at the end of a line", to.dialect.id),
                "leave --annotate out; --map FILE says where every line comes from",
            ));
        }
        let named =
            args.from.as_deref().filter(|id| *id != "auto").map(|id| known.dialect(id)).transpose()?;
        let named = agreed(named, machines.from.as_deref(), "from")?;
        let from = named.map(|from| choose(machines.settings(Side::From, from), &args.from_option));
        let mut from = from.transpose()?;
        if let Some(from) = &mut from {
            state_units(from, known.units())?;
            m_codes::state(from, Side::From, known)?;
        }
        let read = |path| files::text(path).and_then(|(name, text)| InitialVariables::of_file(&name, &text));
        let mut given = args.args.as_deref().map(read).transpose()?.unwrap_or_default();
        let mut stated = args.value.clone();
        for (name, holds) in machines.from.iter().flat_map(|profile| profile.values()) {
            let own = initial_variables::value(&format!("{name}={holds}")).ok();
            stated.extend(own.filter(|(name, _)| !args.value.iter().any(|(own, _)| own == name)));
        }
        let values: Vec<(String, Num)> =
            stated.into_iter().filter_map(|(name, holds)| Some((name, holds?))).collect();
        values.iter().for_each(|(name, value)| given.put(name, *value));
        Ok(TargetOptions { from, machines, to, given, values, named, known: known.clone(), settled })
    }

    /// The folder of outputs, where a project file names it and the command line nothing.
    pub(crate) fn folder(&self, args: &Translate) -> Option<&Path> {
        self.settled.as_ref().filter(|_| args.output.is_none())?.output.as_deref()
    }

    /// Line ends, as far as they are the same for all.
    pub(crate) fn eol(&self, args: &Translate) -> Eol {
        args.lines.eol.unwrap_or(crate::machines::eol(&self.machines))
    }

    /// The translation of one program in the dialect that is named or was recognised.
    ///
    /// # Errors
    /// An option is none of the recognised dialect's.
    pub(crate) fn job(
        &self,
        args: &Translate,
        from: &'static Dialect,
        source_name: &str,
        crlf: bool,
    ) -> Result<Job, Problem> {
        let from = match &self.from {
            Some(settings) => settings.clone(),
            None => {
                let mut own = choose(self.machines.settings(Side::From, from), &args.from_option)?;
                state_units(&mut own, self.known.units())?;
                m_codes::state(&mut own, Side::From, &self.known)?;
                own
            }
        };
        let mut from = from;
        for (name, value) in &self.values {
            value.whole_number().into_iter().for_each(|value| from.state_value(name, value));
        }
        Ok(Job {
            from,
            to: self.to.clone(),
            layout: Layout { numbering: args.number.unwrap_or(self.machines.numbering()), crlf },
            machines: self.machines.clone(),
            passes: args.pass.clone(),
            fold: args.optimise.map(|level| level > 0),
            verify: !args.no_verify,
            head: !args.no_head,
            start: args.standing.start.unwrap_or_default(),
            given: self.given.clone(),
            values: self.values.clone(),
            program_number: args.program_number,
            source_name: source_name.to_owned(),
            called: None,
            project: self.settled.as_ref().map(|settled| Arc::clone(&settled.used)),
            assumed: start::assumed(&args.standing.start.unwrap_or_default()),
            numbered_tools: Vec::new(),
            further_edges: Vec::new(),
            tried_upto: None,
            rivals: Vec::new(),
            questions: if self.known.assumes() { Policy::Assume } else { Policy::Ask },
            allow: args.allow.clone(),
            piece: PIECE,
            shortest_stretch: ncc_driver::job::SHORTEST_STRETCH,
            one_thread: false,
            tables: true,
            deny: args.deny.clone(),
        })
    }
}

/// Both sides, as the command line states them.
fn stated(args: &Translate) -> Stated<'_> {
    Stated {
        from: args.from.as_deref(),
        machine: args.machine_from.as_deref(),
        from_options: &args.from_option,
        to: args.to.as_deref(),
        machine_to: args.machine_to.as_deref(),
        to_options: &args.to_option,
        output: args.output.as_deref(),
    }
}
