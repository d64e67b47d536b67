//! The arguments of a subprogram that is executed alone: its main procedure has parameters.
//!
//! ```text
//! O9010 with X#24    (#24, its slot, the start of the program)
//! ```

use crate::run::term::{Names, Place};
use ncc_ir::expr::Var;
use ncc_ir::program::Program;
use ncc_ir::source::Span;

/// Each parameter of the main procedure that the program reads: its variable, its slot, and the span of the first
/// statement. Empty for a main procedure without parameters.
pub(crate) fn required_arguments(program: &Program, names: &Names) -> Vec<(Var, Place, Span)> {
    let Some(main) = program.procedures.first().filter(|main| !main.parameters.is_empty()) else {
        return Vec::new();
    };
    let at = main.body.first().map_or(Span::default(), |stmt| stmt.span);
    let all = names.all();
    let place = |own: &Var| all.iter().find(|(var, _)| var == own).map(|(_, place)| *place);
    main.parameters.iter().filter_map(|own| Some((own.clone(), place(own)?, at))).collect()
}
