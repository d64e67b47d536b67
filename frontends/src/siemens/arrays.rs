//! Arrays that a subprogram takes from its caller by `VAR`: a variable for each element.
//!
//! ```text
//! PROC STEP(VAR REAL AT[2])        STEP.AT.0 and STEP.AT.1, which the call sets and gives back
//! AT[1]=AT[0]+1
//! ```
//!
//! Refused by name: elements whose index is computed. Not here: what calls hand over (`parameters`).

use ncc_ir::diag::Fault;
use ncc_ir::expr::{Element, Expr, Node, Var};

use super::computing::array;
use super::formula::Typed;
use super::lower::Lower;
use super::tree::{Address, Expr as Tree, Place};
use crate::Batch;
use crate::word::Source;

/// Where an element is kept of an array that is the caller's own.
pub(super) fn element_of(reference: &Var, at: &[u32]) -> Var {
    let mut name = reference.name().to_string();
    at.iter().for_each(|at| name.push_str(&format!(".{at}")));
    Var::Common(name.into())
}

/// The indices of all elements of an array, the last one fastest.
pub(super) fn all_indices(sizes: &[u32]) -> Vec<Vec<u32>> {
    let more = |all: Vec<Vec<u32>>, size: &u32| {
        let with = |at: Vec<u32>| (0..*size).map(move |next| [&at[..], &[next]].concat());
        all.into_iter().flat_map(with).collect()
    };
    sizes.iter().fold(vec![Vec::new()], more)
}

impl Lower {
    /// A variable of the caller, or the element of an array of its own; `None` if it is refused (reported).
    pub(super) fn of_caller(
        &mut self,
        var: Var,
        sizes: &[u32],
        place: &Place,
        src: Source,
        out: &mut Batch,
    ) -> Option<Var> {
        if sizes.is_empty() {
            return Some(var);
        }
        let mut found = Vec::with_capacity(sizes.len());
        for (at, size) in self.indices(place, src, out)?.iter().zip(sizes) {
            let Some(at) = at.literal() else {
                let what = "computed index of an array that is the caller's own";
                self.not_supported(&src.text(place.span), what, place.span, out);
                return None;
            };
            match at.whole().and_then(|at| u32::try_from(at).ok()).filter(|at| at < size) {
                Some(at) => found.push(at),
                None => {
                    return self.refuse(Fault::OutOfRange { word: src.text(place.span) }, place.span, out);
                }
            }
        }
        Some(element_of(&var, &found))
    }

    /// The elements of an array that an argument names as a whole.
    pub(super) fn whole_array(&self, value: &Tree, src: Source) -> Option<(Box<[u32]>, Vec<Typed>)> {
        let Tree::Place(place) = value else { return None };
        let Address::Name(name) = place.address else { return None };
        let name = src.text(name).to_ascii_uppercase();
        let variable = self.variables.get(&*name)?;
        if variable.sizes.is_empty() || !place.index.is_empty() {
            return None;
        }
        let element = |at: Vec<u32>| {
            let node = match &variable.reference {
                Some(own) => Node::Var(element_of(own, &at)),
                None => {
                    let at = at.into_iter().map(|at| Expr::int(i64::from(at))).collect();
                    Node::Element(Element { of: array(&name, &variable.sizes), at })
                }
            };
            Typed::new(node, variable.kind)
        };
        Some((variable.sizes.clone(), all_indices(&variable.sizes).into_iter().map(element).collect()))
    }
}
