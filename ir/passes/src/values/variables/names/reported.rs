//! Tells which variables are called otherwise in the target.

use std::collections::HashSet;

use super::Plan;
use crate::values::variables::inventory::number_of;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Var;
use ncc_ir::program::Program;

/// Most variables that are reported.
const MOST_TOLD: usize = 40;

impl<'c> Plan<'c> {
    /// Tells which variables are called otherwise, once.
    pub(in crate::values::variables) fn tell(&self, program: &Program, diags: &mut Vec<Diagnostic>) {
        let mut reported: Vec<String> = Vec::new();
        let (from, to) = (&self.from.mark, &self.computes.mark);
        let mut done: HashSet<(usize, &Var)> = HashSet::new();
        for (at, inventory) in self.inventories.iter().enumerate() {
            let parameters = self.parameters[at].iter();
            for old in parameters.chain(inventory.seen.iter().map(|seen| &seen.var)) {
                let root = self.roots[at];
                let (new, of) = match (self.locals[root].get(old), self.common.get(old)) {
                    (Some(new), _) => (new, root),
                    (None, Some(new)) => (new, 0),
                    (None, None) => continue,
                };
                let other = match number_of(old, self.from) {
                    Some(n) => number_of(new, self.computes) != Some(n),
                    None => !old.name().eq_ignore_ascii_case(&new.name()),
                };
                if other && done.insert((of, old)) {
                    let whose =
                        if of == 0 { String::new() } else { format!(" of {}", program.procedures[of].name) };
                    reported.push(format!("{from}{}{whose} is {to}{}", old.name(), new.name()));
                }
            }
        }
        if reported.is_empty() {
            return;
        }
        let more = reported.len().saturating_sub(MOST_TOLD);
        reported.truncate(MOST_TOLD);
        if more > 0 {
            reported.push(format!("and {more} more"));
        }
        let first = self
            .inventories
            .iter()
            .flat_map(|inventory| &inventory.seen)
            .map(|seen| seen.at)
            .min_by_key(|at| at.start);
        let map = reported.join(", ").into();
        diags.push(Diagnostic::new(Fault::VariablesRenamed { map }, first.unwrap_or_default()));
    }
}
