//! What a machine's options make of the same words: fixed, from the sources that the options' rows name, and
//! without a look at the rows.

use ncc_exec::{Event, Kind};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_tests::plain;
use ncc_tests::translate::{execute, job, read_as, rendered, settings, translate};

/// What a Fanuc with a choice makes of a program in the plain world.
///
/// # Errors
/// It is refused.
fn made(option: &str, value: &str, text: &str) -> Result<Vec<Event>, String> {
    let mut settings = settings("fanuc");
    settings.choose(option, value).expect("an option");
    let program = read_as(settings, text.as_bytes())?;
    execute(&program, &plain::world(0), 0)
}

/// How deep the tool stands in its dwells, and how long they are, seconds in nanos.
fn dwells(events: &[Event]) -> Vec<(Nanos, Nanos)> {
    let dwell = |event: &Event| match event.kind {
        Kind::Dwell(time) => Some((event.end[2], time)),
        _ => None,
    };
    events.iter().filter_map(dwell).collect()
}

/// P of a G83 and a G73 is half a second at the bottom of each hole, once and not at each peck, or nothing; it is
/// kept for the cycles behind it all the same, and is theirs.
#[test]
fn p_of_pecks_dwells_or_not() {
    for code in ["G83", "G73"] {
        let text = format!(
            "%\nO0001\nG21 G17 G90 G98 G54\nS900 M3\nG0 X0. Y0. Z20.\n\
             {code} X5. Z-9. R2. Q4. P500 F80.\nX10. Z-11.\nG82 X15. Z-3.\nG80\nM5\nM30\n%\n"
        );
        let half = ONE / 2;
        let spot = (-3 * ONE, half);
        let holes = |value| made("peck_dwell", value, &text).map(|events| dwells(&events));
        assert_eq!(holes("dwell"), Ok(vec![(-9 * ONE, half), (-11 * ONE, half), spot]), "{code}");
        assert_eq!(holes("ignored"), Ok(vec![spot]), "{code}");
        let refused = holes("refused").expect_err("a refusal");
        assert!(
            refused.contains("DwellByOption { letter: 'P', option: \"peck_dwell\" }"),
            "{code}: {refused}"
        );
    }
}

/// P of a G81 and a G85 is a dwell at the bottom, or nothing; it is the later G82's all the same. What a G82 has left is
/// nobody's question.
#[test]
fn p_of_drilling_dwells_or_not() {
    let text = |code: &str, first: &str| {
        format!(
            "%\nO0001\nG21 G17 G90 G98 G54\nS900 M3\nG0 X0. Y0. Z20.\n\
             {first}{code} X5. Z-9. R2. P500 F80.\nX10. Z-11.\nG82 X15. Z-3.\nG80\nM5\nM30\n%\n"
        )
    };
    let (half, spot) = (ONE / 2, (-3 * ONE, ONE / 2));
    for code in ["G81", "G85"] {
        let holes = |value| made("drill_dwell", value, &text(code, "")).map(|events| dwells(&events));
        assert_eq!(holes("dwell"), Ok(vec![(-9 * ONE, half), (-11 * ONE, half), spot]), "{code}");
        assert_eq!(holes("ignored"), Ok(vec![spot]), "{code}");
        let refused = holes("refused").expect_err("a refusal");
        assert!(
            refused.contains("DwellByOption { letter: 'P', option: \"drill_dwell\" }"),
            "{code}: {refused}"
        );
        let left = text(code, "G82 X1. Z-1. R2. P500 F80.\n").replacen(" P500 F80.\nX10.", " F80.\nX10.", 1);
        let holes = made("drill_dwell", "refused", &left).map(|events| dwells(&events));
        assert_eq!(holes, Ok(vec![(-ONE, half), spot]), "{code}");
    }
}

/// The letter that the option names is the angle, and no other one; S is a speed on a machine where it is none.
#[test]
fn the_letter_of_the_spindles_angle() {
    const OPTION: &str = "orient_word";
    for value in ["none", "R", "P", "S"] {
        // R counts thousandths where it has no point.
        for (letter, word) in [("R", "R90."), ("P", "P90"), ("S", "S90")] {
            let text = format!("%\nO0001\nG21 G17 G90 G54\nS900\nM19 {word}\nM3\nG1 X1. F100.\nM30\n%\n");
            let said = format!("{letter} by the option {value}");
            let events = match made(OPTION, value, &text) {
                Ok(events) => events,
                Err(refused) => {
                    let name = format!("AngleByOption {{ letter: '{letter}', option: \"{OPTION}\" }}");
                    assert!(value != letter && letter != "S" && refused.contains(&name), "{said}: {refused}");
                    continue;
                }
            };
            let angles: Vec<Option<Nanos>> = events
                .iter()
                .filter_map(|event| match event.kind {
                    Kind::Orient(angle) => Some(Some(angle)),
                    _ => None,
                })
                .collect();
            let speed = events.iter().find(|event| event.kind == Kind::Feed).map(|feed| feed.state.speed);
            match value == letter {
                true => assert_eq!((angles, speed), (vec![Some(90 * ONE)], Some(900 * ONE)), "{said}"),
                false => {
                    assert_eq!(letter, "S", "{said}");
                    assert_eq!(speed, Some(90 * ONE), "{said}");
                    assert_ne!(angles, [Some(90 * ONE)], "{said}");
                }
            }
        }
    }
}

/// It is written by that letter, and refused where the option names none.
#[test]
fn the_angle_is_written_by_its_letter() {
    let text = "%\nO0001\nG21 G17 G90 G54\nT1 M06\nM19 P90\nG00 Z5.\nM30\n%\n";
    for (value, word) in
        [("none", None), ("R", Some("M19 R90.")), ("P", Some("M19 P90")), ("S", Some("M19 S90"))]
    {
        let mut job = job("haas", "fanuc", "angle.nc");
        job.head = false;
        job.to.choose("orient_word", value).expect("an option");
        let (outcome, written) = translate(&job, text.as_bytes());
        let written = String::from_utf8_lossy(&written).into_owned();
        let said = rendered(&job, "angle.nc", text.as_bytes(), &outcome.diagnostics);
        match word {
            Some(word) => assert!(written.contains(word), "{value}\n{written}{said}"),
            None => {
                assert!(outcome.release.is_err() && said.contains("has no oriented spindle stop"), "{said}")
            }
        }
    }
}

/// Whether the block of G66.1 is a call itself, with the words that stand there.
#[test]
fn the_block_that_says_the_calls() {
    let text = "%\nO0001\nG21 G17 G90 G54 G94\nS900 M3\nG0 Z5.\nG66.1 P2 X1.\nX2.\nX3.\nG67\nM30\nO0002\nG0 X#24\nM99\n%\n";
    for (value, ways) in [("calls", vec![1, 2, 3]), ("silent", vec![2, 3])] {
        let events = made("own_block_call", value, text).expect("a program");
        let x: Vec<Nanos> = events
            .iter()
            .filter(|event| event.kind == Kind::Traverse)
            .map(|event| event.end[0] / ONE)
            .collect();
        assert_eq!(x[1..], ways[..], "{value}");
    }
}
