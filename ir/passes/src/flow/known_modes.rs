//! `codes-put-back`, `codes-without-alarms`, `deep-calls`, `known-facts`: computed codes, deep calls, and modes where paths
//! of a program that computes join.
//!
//! ```text
//! IF [#1 EQ 2] GOTO 10 / G91 / N10 X5.    G90 or G91 is stated at N10, where both paths join
//! ```
//!
//! Not here: the analysis itself (`support::mode_analysis`).

use ncc_ir::computed::computed_code;
use ncc_ir::computed::computes::ComputeFeature;

use crate::frames::computed_frames;
use crate::modes::word_distance;
use crate::pass::Pass;
use crate::support::mode_analysis;

/// Saved and restored modes become codes, if the target cannot save modes.
pub(crate) const CODES_PUT_BACK: Pass = Pass::parametric(
    "codes-put-back",
    "puts modes that a program saves and puts back into words, where the target cannot save them",
    |own, _| own.others && !own.target.has(ComputeFeature::CodeOf),
    |program, own, _| mode_analysis::put_back(program, &own.entry, own.target),
);

/// Keeps computed codes to those that the target has.
pub(crate) const CODES: Pass = Pass::parametric(
    "codes-without-alarms",
    "takes computed codes without the alarm for those that are none",
    |_, _| true,
    |program, own, _| {
        let target = own.target;
        for procedure in &mut program.procedures {
            computed_code::without_alarms(&mut procedure.body, &|control| target.says_number(control));
        }
    },
);

/// Limits the depth of calls to the target's.
pub(crate) const DEPTH: Pass = Pass::parametric(
    "deep-calls",
    "refuses calls that go deeper within one another than the target takes",
    |own, _| own.source.calls != own.target.calls,
    |program, own, found| found.extend(own.target.too_deep(program)),
);

/// Writes the modes again where paths merge.
pub(crate) const KNOWN_FACTS: Pass = Pass::parametric(
    "known-facts",
    "states modes again where paths of a program that computes merge",
    |own, program| {
        let restates = own.target.restates && !own.keeps_words || computed_frames::behind_control(program);
        restates || own.source.blocks != own.target.blocks
    },
    |program, own, _| {
        if own.target.restates && !own.keeps_words || computed_frames::behind_control(program) {
            own.known = mode_analysis::run(program, &own.entry, own.others);
            return;
        }
        // Loops and branches of another dialect have bodies; their statements stay as they are.
        own.known = mode_analysis::run(&mut program.clone(), &own.entry, true);
        // If the target's words have no distance mode of their own, the mode after such a word is written again.
        let measures = own.word_distance && !own.caps.modes.word_distance;
        if measures && !word_distance::places(program, &own.known).is_empty() {
            own.known = mode_analysis::run(program, &own.entry, true);
        }
    },
);
