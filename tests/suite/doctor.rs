//! The facts that a translation rests on: every assumption that can be told has a place in a profile,
//! and a profile that states it silences it.

use std::collections::BTreeMap;
use std::sync::Arc;

use ncc_dialects::builtin;
use ncc_driver::job::Job;
use ncc_driver::machines::pair::Machines;
use ncc_ir::diag::{Fault, Gravity, Verdict};
use ncc_machines::Profile;
use ncc_machines::reading::{Place, Side, quoted};
use ncc_tests::corpus;
use ncc_tests::expect::Failures;
use ncc_tests::translate::{job, translate};

/// What was taken for granted, as a profile would state it.
fn value(place: &Place, fault: &Fault, job: &Job, side: Side) -> String {
    let settings = if side == Side::From { &job.from } else { &job.to };
    match (place, fault) {
        (Place::Confirmed(_), _) => "true".to_owned(),
        (Place::Option(option), _) => format!("{:?}", settings.get(option)),
        (Place::PowerOn("no_origin_shift"), _) => "true".to_owned(),
        (Place::PowerOn("length_offset"), _) => "0".to_owned(),
        (Place::PowerOn("work_offset"), Fault::AssumedWorkOffset { offset }) => offset.to_string(),
        (Place::PowerOn("work_offset"), Fault::AssumedMode { value, .. }) => value.to_string(),
        (Place::PowerOn(key), _) => {
            let row = &settings.dialect.power_on;
            let word = |value: &dyn std::fmt::Debug| format!("{:?}", format!("{value:?}").to_lowercase());
            match *key {
                "units" => word(&row.units.as_ref().expect("a row").value),
                "distance" => word(&row.distance.as_ref().expect("a row").value),
                "plane" => word(&row.plane.as_ref().expect("a row").value),
                "return_level" => word(&row.return_level.as_ref().expect("a row").value),
                "motion" => word(&row.motion.as_ref().expect("a row").value),
                _ => "\"per-minute\"".to_owned(),
            }
        }
        (Place::Code(_) | Place::Function(_) | Place::Name(..) | Place::Number(..), _) => "\"\"".to_owned(),
    }
}

/// A profile that states what was taken for granted.
fn stated(dialect: &str, facts: &BTreeMap<Place, String>) -> Result<Arc<Profile>, String> {
    let mut text = format!("id = \"x\"\ntitle = \"\"\ndialect = \"{dialect}\"\n");
    for (place, value) in facts {
        let (table, key) = match place {
            Place::PowerOn(key) => ("power_on", (*key).to_owned()),
            Place::Option(key) => ("options", quoted(key)),
            Place::Confirmed(key) => ("confirmed", quoted(key)),
            Place::Code(_) | Place::Function(_) | Place::Name(..) | Place::Number(..) => continue,
        };
        text.push_str(&format!("{table}.{key} = {value}\n"));
    }
    Profile::parse(&text, &builtin).map(Arc::new).map_err(|wrong| format!("{wrong:?}\n{text}"))
}

#[test]
fn every_assumption_of_the_corpus_can_be_stated_and_is_none_any_more() {
    let mut failures = Failures::default();
    let (mut programs, mut facts) = (0, 0);
    for from in ["mach9", "fanuc", "siemens"] {
        for path in corpus::files(&corpus::root().join("corpus").join(from)) {
            let text = std::fs::read(&path).expect("a program");
            for to in ["mach9", "fanuc", "siemens"] {
                let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                let what = format!("{from}/{file} to {to}");
                let mut job = job(from, to, &file);
                let mut known: BTreeMap<Side, BTreeMap<Place, String>> = BTreeMap::new();
                // A fact that is stated may show another one behind it.
                for round in 0..3 {
                    let (outcome, _) = translate(&job, &text);
                    if outcome.release.is_err() {
                        if round > 0 {
                            failures.add(
                                &what,
                                format!("refused once stated: {known:?} {:?}", outcome.diagnostics),
                            );
                        }
                        break;
                    }
                    programs += usize::from(round == 0);
                    let assumed: Vec<&Fault> = outcome
                        .diagnostics
                        .iter()
                        .map(|d| &d.fault)
                        .filter(|fault| fault.gravity() == Gravity::Verdict(Verdict::Assumed))
                        .collect();
                    if assumed.is_empty() {
                        break;
                    }
                    if round == 2 || outcome.rests.is_empty() {
                        failures.add(&what, format!("still assumed: {assumed:?}"));
                        break;
                    }
                    for rest in &outcome.rests {
                        let fault = &outcome.diagnostics[rest.diagnostic].fault;
                        let value = value(&rest.place, fault, &job, rest.side);
                        known.entry(rest.side).or_default().insert(rest.place.clone(), value);
                        facts += 1;
                    }
                    let side = |side, dialect| stated(dialect, known.get(&side).unwrap_or(&BTreeMap::new()));
                    let (a, b) = (side(Side::From, from), side(Side::To, to));
                    let (Some(a), Some(b)) = (failures.check(&what, a), failures.check(&what, b)) else {
                        break;
                    };
                    (job.from, job.to) = (a.settings(), b.settings());
                    job.machines = Machines { from: Some(a), to: Some(b) };
                }
            }
        }
    }
    println!("{programs} translations, {facts} facts");
    assert!(programs > 100 && facts > 300, "{programs} translations, {facts} facts");
    failures.finish();
}
