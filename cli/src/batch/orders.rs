//! The order of each program of a batch: one for all, or one for each row of the project files.
//!
//! Programs of one batch have one target; their machines, options and folders of outputs may differ.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::Dialect;
use ncc_driver::problem::Problem;

use super::gather::{Gathered, Reason, identity};
use crate::args::Translate;
use crate::project::{self, InForce};
use crate::registry::DialectRegistry;
use crate::target_options::TargetOptions;

/// The orders of a batch.
#[derive(Debug)]
pub(super) struct Orders {
    all: Vec<One>,
    /// The order of each program.
    of: Vec<usize>,
}

/// An order, and the folder of its outputs.
type One = Result<(TargetOptions, PathBuf), Problem>;

impl Orders {
    /// Those of the programs that were found. `plain` is the order without a project file, `folder` that of `-o`.
    ///
    /// # Errors
    /// A project file has faults; no program has an order; targets differ.
    pub(super) fn of(
        args: &Translate,
        plain: Result<TargetOptions, Problem>,
        folder: Option<&Path>,
        found: &Gathered,
        known: &DialectRegistry,
        told: &mut dyn WriteColor,
    ) -> Result<Orders, Problem> {
        let rows = found.items.iter().map(|item| project::row(&item.path, false, known, told));
        let rows = rows.collect::<Result<Vec<_>, _>>()?;
        let placed = |order: TargetOptions| {
            let folder = folder.or(order.folder(args)).map(Path::to_owned);
            folder.map(|folder| (order, folder)).ok_or_else(|| where_to(args))
        };
        let mut seen: Vec<Option<Arc<InForce>>> = Vec::new();
        let mut orders = Orders { all: Vec::new(), of: Vec::new() };
        let mut plain = Some(plain);
        for row in rows {
            let same = |other: &Option<Arc<InForce>>| match (other, &row) {
                (Some(other), Some(row)) => Arc::ptr_eq(other, row),
                (None, None) => true,
                (Some(_), None) | (None, Some(_)) => false,
            };
            let at = match seen.iter().position(same) {
                Some(at) => at,
                None => {
                    let order = match (&row, plain.take_if(|_| row.is_none())) {
                        (None, Some(plain)) => plain,
                        (row, _) => TargetOptions::find(args, known, row.as_deref(), told),
                    };
                    orders.all.push(order.and_then(placed));
                    seen.push(row);
                    seen.len() - 1
                }
            };
            orders.of.push(at);
        }
        let targets: Vec<&'static Dialect> = orders.orders().map(|(order, _)| order.to.dialect).collect();
        let Some((target, others)) = targets.split_first() else {
            return match orders.all.into_iter().find_map(Result::err) {
                Some(problem) => Err(problem),
                None => plain
                    .unwrap_or_else(|| Err(where_to(args)))
                    .and_then(placed)
                    .map(|order| Orders { all: vec![Ok(order)], of: Vec::new() }),
            };
        };
        if let Some(other) = others.iter().find(|other| other.id != target.id) {
            return Err(Problem::usage(
                format!("the programs are for two targets, {} and {}", target.id, other.id),
                "translate them apart, or name one: --to DIALECT",
            ));
        }
        Ok(orders)
    }

    /// The order of a program, with the folder of its outputs.
    pub(super) fn at(&self, program: usize) -> Option<&(TargetOptions, PathBuf)> {
        self.all.get(*self.of.get(program)?)?.as_ref().ok()
    }

    /// Programs without an order, and why.
    pub(super) fn refused(&self) -> impl Iterator<Item = (usize, Problem)> {
        let of = |(program, at): (usize, &usize)| Some((program, self.all.get(*at)?.as_ref().err()?.clone()));
        self.of.iter().enumerate().filter_map(of)
    }

    /// Every order.
    pub(super) fn orders(&self) -> impl Iterator<Item = &(TargetOptions, PathBuf)> {
        self.all.iter().flatten()
    }

    /// The target.
    pub(super) fn target(&self) -> Option<&'static Dialect> {
        self.orders().next().map(|(order, _)| order.to.dialect)
    }

    /// Leaves out what was found in the folders of outputs.
    pub(super) fn leave_outputs(&mut self, found: &mut Gathered) {
        let folders: Vec<_> = self.orders().filter_map(|(_, folder)| identity(folder)).collect();
        let mut of = std::mem::take(&mut self.of).into_iter();
        let items = std::mem::take(&mut found.items);
        for item in items {
            let at = of.next().unwrap_or_default();
            let depth = item.below.components().count();
            let mut above = item.path.ancestors().skip(1).take(depth);
            if above.any(|folder| identity(folder).is_some_and(|own| folders.contains(&own))) {
                found.leave(item.path.clone(), Reason::OutputFolder);
            } else {
                found.items.push(item);
                self.of.push(at);
            }
        }
    }
}

/// The usage error of a batch that names no folder for its outputs.
pub(super) fn where_to(args: &Translate) -> Problem {
    let several = several(args);
    Problem::usage(format!("{several}: no output folder"), "name a folder for the outputs: -o FOLDER")
}

/// Names the program of a command, or says how many files and folders it names.
pub(super) fn several(args: &Translate) -> String {
    match args.files.as_slice() {
        [one] => one.display().to_string(),
        files => format!("{} files and folders", files.len()),
    }
}
