//! `polar-circles` and `cartesian-circles`: the first hole of a circle is given by its radius and
//! angle, or by its position.
//!
//! Only where the holes are the same to half the target's least increment; else a circle stays
//! as it is.

use crate::holes::expand_patterns;
use crate::pass::Pass;
use crate::support::walk::each_body;
use crate::target::Target;
use ncc_ir::caps::{Caps, CircleStart, HoleCaps};
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::Program;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const POLAR: Pass =
    Pass::named("polar-circles", "gives the first hole of a circle by radius and angle", Some(polar));

/// This pass.
pub(crate) const CARTESIAN: Pass =
    Pass::named("cartesian-circles", "gives the first hole of a circle by its position", Some(cartesian));

/// By radius and angle.
pub fn polar(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    convert(program, target, entry, true, diags);
}

/// By position.
pub fn cartesian(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    convert(program, target, entry, false, diags);
}

fn convert(
    program: &mut Program,
    target: &Target,
    entry: &Tracker,
    polar: bool,
    diags: &mut Vec<Diagnostic>,
) {
    // A target that can say every pattern, but circles in one form only.
    let holes = HoleCaps {
        circles: true,
        circle_start: CircleStart::only(polar),
        lines: true,
        list_upto: u32::MAX,
        grid_upto: u32::MAX,
        pattern_start: true,
        pattern_angle: true,
        pattern_here: true,
        ..HoleCaps::default()
    };
    let caps = Caps { holes, ..Caps::default() };
    let target = Target { caps, ..target.clone() };
    each_body(program, entry, |body, walk| expand_patterns::reform(body, walk, &target, diags));
}
