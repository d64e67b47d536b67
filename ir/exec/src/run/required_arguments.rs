//! What a main procedure must be given before it begins: a subprogram that is executed by itself has parameters.

use crate::run::term::{Names, Place};
use ncc_ir::expr::Var;
use ncc_ir::program::Program;
use ncc_ir::source::Span;

/// Parameters of the main procedure that are read, each with where it is kept and the place where the program begins.
pub(crate) fn required_arguments(program: &Program, names: &Names) -> Vec<(Var, Place, Span)> {
    let Some(main) = program.procedures.first().filter(|main| !main.parameters.is_empty()) else {
        return Vec::new();
    };
    let at = main.body.first().map_or(Span::default(), |stmt| stmt.span);
    let all = names.all();
    let place = |own: &Var| all.iter().find(|(var, _)| var == own).map(|(_, place)| *place);
    main.parameters.iter().filter_map(|own| Some((own.clone(), place(own)?, at))).collect()
}
