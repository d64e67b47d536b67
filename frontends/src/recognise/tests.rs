//! Each sign by a small program, and what must never be taken for one.

use super::signs::{Kind, Pattern, SIGNS, System};
use super::{BEGINNING, Finding, recognise};

fn found(text: &str) -> Option<Finding> {
    recognise(&text.replace(" / ", "\n").into_bytes())
}

fn kind(text: &str) -> Option<Kind> {
    found(text).map(|finding| finding.kind)
}

/// A block without is not looked at for them.
#[test]
fn every_sign_that_is_no_word_has_two_letters_side_by_side() {
    for sign in SIGNS {
        if let Pattern::Name(text) | Pattern::Begins(text) | Pattern::Says(text) = sign.shape {
            let spelled = text.as_bytes().windows(2).any(|pair| pair.iter().all(u8::is_ascii_uppercase));
            assert!(spelled, "{text}");
        }
    }
}

#[test]
fn labels_fit_and_rows_name_their_source() {
    for sign in SIGNS {
        assert!(sign.label.chars().count() <= 60, "{}", sign.label);
        assert!((1..=3).contains(&sign.weight) && !sign.source.is_empty(), "{}", sign.label);
    }
}

#[test]
fn every_pattern_is_one_that_can_be_met() {
    for sign in SIGNS {
        let letters = |text: &str| {
            let mut words = text.split(' ');
            words.all(|w| w == "only" || w.trim_start_matches('!').as_bytes()[0].is_ascii_uppercase())
        };
        match sign.shape {
            Pattern::Block(text) => assert!(letters(text), "{text}"),
            // Lines are compared in capitals.
            Pattern::Name(text) | Pattern::Begins(text) | Pattern::Says(text) => {
                assert_eq!(text, text.to_ascii_uppercase());
            }
            Pattern::Course(_) => {}
        }
    }
}

#[test]
fn lathes() {
    let head = "G21 G40 G99 / T0303 / G97 S800 M03 / G00 X32. Z5. / ";
    for (text, system) in [
        (format!("{head}G92 X29.5 Z-20. F1.5 / X29.1"), None),
        (format!("{head}G90 X45. Z-30. F0.2 / X42."), None),
        (format!("{head}G94 X20. Z0. F0.2 / Z-1."), None),
        ("G50 S2500 / G96 S180 M03 / G01 X40. F0.25".to_owned(), None),
        ("G97 S500 M03 / G00 X22. Z5. / G92 X19.4 Z-20. F1.5 / X19. / X18.6 / M30".to_owned(), None),
        ("G95 G97 S700 M3 / G0 X30. Z2. / G77 X26. Z-15. F0.2 / X24.".to_owned(), Some(System::FanucB)),
        ("G00 X30. Z2. / G71 P10 Q20 U0.4 W0.1 D1.5 F0.2".to_owned(), Some(System::Haas)),
        ("G0 X30 Z2 / DIAMON / LIMS=3000 / G96 S200".to_owned(), Some(System::Sinumerik)),
        ("G7 G90 / G0 X20 Z2 / G76 P1.5 Z-20 I-1 J0.2 K0.9".to_owned(), Some(System::LinuxCnc)),
    ] {
        let finding = found(&text).unwrap_or_else(|| panic!("{text}"));
        assert_eq!((finding.kind, finding.system), (Kind::Lathe, system), "{text}: {finding:?}");
    }
}

#[test]
fn others() {
    for (text, kind_of_it) in [
        ("0 BEGIN PGM A MM / 1 TOOL CALL 4 Z S2000 / 2 L X+10 Y+5 R0 FMAX M3", Kind::Heidenhain),
        ("%PLATE G71 * / N10 G30 G17 X+0 Y+0 Z-20 *", Kind::Heidenhain),
        ("$PART.MIN% / G15 H1 / G0 X0 Y0", Kind::Okuma),
        ("G0 X80 Z5 / NLAP1 G81 / G1 X20 / G80 / G85 NLAP1 D2 F0.3", Kind::Okuma),
        ("UNo. UNIT DIA DEPTH / 1 DRILLING 8.5 20", Kind::Mazatrol),
        ("G92 X0 Y0 / M80 M82 M84 / E1221 G42 H1 G01 X5. Y0", Kind::WireEdm),
        (";FLAVOR:Marlin / M104 S205 / G1 X5 Y5 E0.4", Kind::Printer),
        ("The vice stands on the left side of the table.", Kind::Text),
    ] {
        assert_eq!(kind(text), Some(kind_of_it), "{text}: {:?}", found(text));
    }
}

#[test]
fn mills_are_left_alone() {
    for text in [
        "G21 G17 G90 / T1 M06 / G90 X45. Z-30. F200. / X42. Y3.",
        "G20 G98 G17 / T101 M6 / G43 H1 Z1. / G81 X1. Z-0.5 R0.1 F3.5 / X2. / X3.",
        "G21 G90 / T12 M06 / G43 H12 Z10. / G76 X5. Z-8. R2. Q0.1 P300 F60. / X15.",
        "G21 / G92 X0 Y0 Z0 / G1 X5 Y5 F300",
        "G65 P9010 U5. W2. X1. Z3. F0.2 / M30",
        "G50 X0 Y0 / G0 X1 Y1",
        "G18 / G0 X0 Z5 / G1 X10 Z-2 F300 / X20 Z-3",
        "(TURN THE PART OVER) / G0 X1 Z5",
        "",
        "%",
        "(a comment alone)",
        "PROC POCKET / CALL _NAME ERROR CALL OTHER ; all that is called here / M17",
        "G21 G98 G95 / G0 X5. Z5. / G1 Z-3. F0.2 / G97 S500",
        "ncc-ir 1",
    ] {
        assert_eq!(found(text), None, "{text}");
    }
}

#[test]
fn a_y_speaks_against_one_sign_but_not_against_many() {
    assert_eq!(kind("G21 / G50 S2000 / G1 X5. Y5. F300."), None);
    let turned = "G50 S2000 / G28 U0 W0 / G71 P10 Q20 U0.4 W0.1 F0.2 / M30 / G1 X5. Y5. F300.";
    assert_eq!(kind(turned), Some(Kind::Lathe));
}

#[test]
fn doubt_is_told_apart_from_certainty() {
    assert!(!found("G0 X5. Z5. / G32 Z-10. F1.5").expect("a lathe").certain);
    assert!(found("G50 S2000 / G96 S180 / G0 X5. Z5. / G32 Z-10. F1.5").expect("a lathe").certain);
}

#[test]
fn the_place_is_that_of_the_sign() {
    let text = "\u{feff}O1\r\nN5 G21\r\nN10 G50 S2500 (LIMIT)\r\n";
    let place = recognise(text.as_bytes()).expect("a lathe").decisive.place;
    assert_eq!(&text[place], "G50 S2500");
}

#[test]
fn only_the_beginning_is_weighed() {
    let mut text = "G1 X1. Z1. F300.\n".repeat(BEGINNING / 17 + 1).into_bytes();
    text.extend(b"G50 S2000\n");
    assert_eq!(recognise(&text), None);
}
