//! Values for what a program reads and has not set: the same in both programs, by the variables' names.
//! They are made of the numbers of the program itself, so that both sides of its branches run. A local variable may have none.

use ncc_ir::computed::free_variables::{free_variables, literals};
use ncc_ir::expr::Var;
use ncc_ir::expr::value::Value;
use ncc_ir::program::{Program, Type};
use ncc_ir::source::Span;
use ncc_passes::values::assumption_check::Assumption;
use ncc_passes::values::variables::renamed::Renamed;

use crate::job::initial_variables::InitialVariables as Stated;

/// What another program has left in a variable.
const LEFT_THERE: f64 = -791.3;

/// Values that any variable may have.
const FIRST: [f64; 8] = [1.0, 2.5, 10.0, -4.0, 30.0, 0.0, 100.0, -12.5];

/// What may be assumed of a source's numbers, alone and together.
pub(super) const READINGS: [&[Assumption]; 7] = [
    &[Assumption::Apart],
    &[Assumption::NotNegative],
    &[Assumption::Together],
    &[Assumption::Apart, Assumption::NotNegative],
    &[Assumption::Apart, Assumption::Together],
    &[Assumption::NotNegative, Assumption::Together],
    &[Assumption::Apart, Assumption::NotNegative, Assumption::Together],
];

/// Values for what a program reads and has not set.
pub struct Given<'g> {
    pub(super) open: Vec<(Var, Span)>,
    /// Parameters of the main procedure, and what they hold: each has a value, which a call has converted.
    parameters: Vec<(Var, Type)>,
    /// What is stated of them.
    pub(super) stated: &'g Stated,
    /// What is tried first: the numbers of the program, and those beside them.
    pool: Vec<f64>,
    /// What the output calls the source's variables.
    pub(super) renamed: Renamed,
    /// Whether the output computes: then a difference is looked at with the source in the other [`READINGS`].
    pub(super) read_otherwise: bool,
    /// Whether the output's comparisons find equal what is nearly so, and the source's do not.
    pub(super) near: bool,
}

impl<'g> Given<'g> {
    pub(super) fn new(source: &Program, stated: &'g Stated) -> Given<'g> {
        let open = free_variables(source);
        let mut pool = FIRST.to_vec();
        if !open.is_empty() {
            let own = literals(source);
            pool.extend(own.iter().flat_map(|n| [*n, n - 1.0, n + 1.0, n / 2.0]).take(4096));
        }
        let main = source.procedures.first().into_iter();
        let parameters = main.flat_map(|main| {
            let kinds = main.kinds.iter().copied().chain(std::iter::repeat(Type::Real));
            main.parameters.iter().cloned().zip(kinds)
        });
        let parameters = parameters.collect();
        Given {
            open,
            parameters,
            stated,
            pool,
            renamed: Renamed::default(),
            read_otherwise: false,
            near: false,
        }
    }

    /// The value of a variable in a set: in the first one, a local variable has none.
    pub fn value(&self, var: &Var, seed: u32, set: u32) -> Option<Value> {
        if !self.open.iter().any(|(open, _)| open == var) {
            return None;
        }
        let parameter = self.parameters.iter().find(|(own, _)| own == var).map(|(_, kind)| *kind);
        let local = matches!(var, Var::Local(_)) && parameter.is_none();
        let name = var.name();
        let hash = name.bytes().chain(seed.to_le_bytes()).chain(set.to_le_bytes());
        let hash =
            hash.fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
        let hash = mixed(hash);
        let converted = |value: f64| {
            Value::Number(match parameter {
                Some(Type::Int) => value.round(),
                Some(Type::Bool) => f64::from(u8::from(value != 0.0)),
                Some(Type::Real) | None => value,
            })
        };
        if let Some(value) = self.stated.value(&name, set, hash) {
            return Some(value.map_or(Value::Vacant, converted));
        }
        // In every second set all of them are given, else some are not.
        if local && (set == 0 || set.is_multiple_of(2) && hash.is_multiple_of(4)) {
            return Some(Value::Vacant);
        }
        let among = if set % 3 == 1 { FIRST.len() } else { self.pool.len() };
        Some(converted(self.pool[(mixed(hash) >> 20) as usize % among]))
    }
}

impl Given<'_> {
    /// The value of one of the output's variables: that of the source's. What the source does not have, or leaves to
    /// be set first, holds something there, where a control has no empty variables.
    pub fn value_there(&self, var: &Var, seed: u32, set: u32) -> Option<Value> {
        let source = self.renamed.source(var).unwrap_or(var);
        let own = self.value(source, seed, set);
        match var {
            Var::Common(_) if own.is_none() && self.renamed.filled() => Some(Value::Number(LEFT_THERE)),
            _ => own,
        }
    }
}

/// Bits well mixed (splitmix64).
fn mixed(n: u64) -> u64 {
    let n = n.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let n = (n ^ n >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let n = (n ^ n >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    n ^ n >> 31
}
