//! Cycles and patterns that are called by name with arguments.

use ncc_dialects::{CallKind, CallRow, Dialect, ParameterRole};

use super::cycles::approach;
use super::proof::must_show;
use super::proof::{Bench, Said, refusal};
use super::row::Row;

/// The rows of the calls.
pub fn rows(bench: &Bench, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    for row in &d.call {
        let mut call = None;
        for (what, say) in said(d, row) {
            let before = if row.kind.cycles().is_empty() { cycle(d, "drill") } else { String::new() };
            let after = "END_CYCLE()".to_owned();
            let tried = must_show(bench.both_ways(&Said { before, after, ..Said::new(say) }), &row.name);
            let line = tried.written.iter().find(|line| line.contains(&row.name)).cloned();
            call = call.or(line.filter(|_| tried.failed.is_none()));
            let name = if what.is_empty() { row.name.clone() } else { format!("{} {what}", row.name) };
            rows.push(tried.row("call", name, row.sure));
        }
        let Some(call) = call else { continue };
        for (at, parameter) in row.parameters.iter().enumerate() {
            let Some(name) = &parameter.refuse else { continue };
            let value = (7..).find(|v| !parameter.neutral.contains(v)).unwrap_or(7);
            let Some(text) = with_argument(&call, &row.name, at, value) else { continue };
            let before = if row.kind.cycles().is_empty() { cycle(d, "drill") } else { String::new() };
            let label = format!("{} {}", row.name, parameter.name);
            let name = format!("{}: {name}", parameter.name);
            rows.push(refusal(bench, "call", &label, &[(text, before.as_str())], &name, row.sure));
        }
    }
}

/// The call with an argument at a place.
fn with_argument(call: &str, name: &str, at: usize, value: i64) -> Option<String> {
    let open = call.find(&format!("{name}("))? + name.len() + 1;
    let close = open + call[open..].find(')')?;
    let mut arguments: Vec<String> = call[open..close].split(',').map(str::to_owned).collect();
    if arguments.len() <= at {
        arguments.resize(at + 1, String::new());
    }
    arguments[at] = value.to_string();
    Some(format!("{}{}{}", &call[..open], arguments.join(","), &call[close..]))
}

/// A cycle of the kind, in the text form.
pub(super) fn cycle(d: &Dialect, kind: &str) -> String {
    let way = approach(d);
    format!("START_CYCLE({kind}, XY, retract 3mm, depth -12mm, return entry, return-plane 20mm, {way})")
}

/// The same, with a reference plane of its own below the retract plane.
fn above(cycle: &str) -> String {
    cycle.replace("retract 3mm", "retract 3mm, reference 1mm")
}

/// Statements that need the call, and what of it they show.
fn said(d: &Dialect, row: &CallRow) -> Vec<(&'static str, String)> {
    let has = |role| row.place(role).is_some();
    let holes = |kind: &str| format!("{}\nHOLE(X 10mm)\nHOLE(X 20mm)", cycle(d, kind));
    let way = approach(d);
    let one = |say: &str| vec![("", say.to_owned())];
    match row.kind {
        CallKind::Drill => vec![("", holes("drill")), ("above", above(&holes("drill")))],
        CallKind::DrillDwell => vec![("", holes("drill-dwell(dwell 0.4s)"))],
        CallKind::DrillPeck => {
            // All strokes count from the reference plane.
            let strokes = |kind: &str| above(&holes(kind));
            let mut all = vec![
                ("clearing", strokes("drill-peck(peck 5mm, clearance 0.6mm, first 7mm)")),
                ("breaking", strokes("drill-break(peck 5mm, lift 1mm, at-feed, first 7mm)")),
            ];
            if has(ParameterRole::Dwell) {
                all.push((
                    "dwells",
                    strokes(
                        "drill-peck(peck 5mm, clearance 0.6mm, first 7mm, pause 0.5s, settle 1s, dwell 0.5s)",
                    ),
                ));
            }
            all
        }
        CallKind::Tap => {
            let tap = "tap(clockwise, pitch 1.25mm, dwell 0.5s, after clockwise)";
            vec![("", holes(tap)), ("left", holes(&tap.replace("clockwise", "counterclockwise")))]
        }
        CallKind::TapRigid => {
            let tap = "tap-rigid(clockwise, pitch 1.25mm, dwell 0.5s, after clockwise)";
            let speed = |tap: &str| format!("SET_SPINDLE_SPEED(500)\n{}", holes(tap));
            vec![("", speed(tap)), ("left", speed(&tap.replace("clockwise", "counterclockwise")))]
        }
        CallKind::BoreFine => vec![(
            "",
            holes(
                "bore-fine(shift along (X -0.2mm, Y 0.3mm, Z 0.1mm), after stopped, clockwise, dwell 0.5s, angle 45deg)",
            ),
        )],
        CallKind::BoreStop if has(ParameterRole::Dwell) => {
            vec![("", holes("bore-stop(after stopped, counterclockwise, dwell 0.5s, program-stop)"))]
        }
        CallKind::BoreStop => vec![("", holes("bore-stop(after stopped, clockwise, program-stop)"))],
        CallKind::Bore if !has(ParameterRole::FeedIn) => vec![("", holes("bore(dwell 0.5s)"))],
        CallKind::Bore => vec![(
            "",
            holes("bore(dwell 0.5s, feed-out 140mm)")
                .replace(&format!("{way})"), &format!("{way}, feed 70mm)")),
        )],
        CallKind::Line => {
            one("LINE_PATTERN(start (10mm, 30mm), angle 30deg, offset 5mm, pitch 11.5mm, count 4)")
        }
        CallKind::Circle => one(
            "CIRCLE_PATTERN(centre (10mm, -2mm), first (radius 30mm, angle 15deg), step 22.5deg, count 5)",
        ),
        CallKind::Grid => {
            one("RECTANGULAR_LAYOUT(start (3mm, 4mm), columns (X, 15mm, 5), rows (Y, 10mm, 3), serpentine)")
        }
        CallKind::List => one("POSITION_LIST((X 12mm, Y 8mm), (X 37.5mm, Y 8mm), (X 44mm, Y 21.25mm))"),
    }
}
