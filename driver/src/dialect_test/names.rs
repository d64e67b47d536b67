//! Words of several letters.

use ncc_dialects::{FrameWord, Meaning, NameMeaning, NameRole, NameRow};

use super::calls::cycle;
use super::proof::must_show;
use super::proof::{Bench, Said, Tried, in_place, refusal};
use super::row::Row;
use super::statements::{corner, said};
use crate::render::dictionary::dictionary;

/// The rows of the words of several letters.
pub fn rows(bench: &Bench, rows: &mut Vec<Row>) {
    for row in &bench.dialect.name {
        if let Some(name) = &row.refuse {
            let word = &row.name;
            let texts = [
                (word.clone(), ""),
                (format!("{word}=1"), ""),
                (format!("{word}(1)"), ""),
                (format!("G1 X1 {word}=1"), ""),
                (format!("G1 X={word}(1)"), ""),
                (format!("G1 X1 {word}"), ""),
                (format!("{word} PASS"), ""),
                (format!("G1 A={word}(1)"), ""),
            ];
            rows.push(refusal(bench, "name", word, &texts, name, row.sure));
            continue;
        }
        let tried = match (row.means, row.role) {
            (Some(meaning), _) => meant(bench, row, meaning),
            // Written corner by corner.
            (None, Some(NameRole::RoundCorners)) => {
                let said = corner("ROUND_CORNER");
                let put = |text: String| {
                    text.replace("RND=", &format!("{}=", row.name))
                        .replace(" Y40", &format!(" Y40 {}=0", row.name))
                };
                must_show(bench.reads(&said, &said.say, put), &row.name).read_only()
            }
            (None, Some(role)) => must_show(bench.both_ways(&address(role)), &row.name),
            (None, None) => continue,
        };
        rows.push(tried.row("name", row.name.clone(), row.sure));
    }
}

fn meant(bench: &Bench, row: &NameRow, meaning: NameMeaning) -> Tried {
    let d = bench.dialect;
    let said = match meaning {
        NameMeaning::Code(meaning) => said(d, meaning, &row.name).into_iter().next().unwrap_or_default(),
        NameMeaning::SetFrame(word) => Said::new(format!("SET_FRAME({})", step(word))),
        NameMeaning::AddFrame(word) => Said::new(format!("ADD_FRAME({})", step(word))),
        NameMeaning::TurnRotaryAxis(way) => {
            Said::new(format!("TURN_ROTARY_AXES(C {}) & said STRAIGHT_TRAVERSE(C 90.5deg)", way.name()))
        }
        NameMeaning::ArcThrough => Said::new("said ARC_THROUGH(XY, X 19mm, Y 12mm, through(X 9mm, Y 2mm))"),
        NameMeaning::ArcTangent => {
            Said::new("said ARC_TANGENT(XY, X 19mm, Y 12mm, tangent)").after("said STRAIGHT_FEED(X 9mm)")
        }
        NameMeaning::CallModal => {
            let start = cycle(d, "drill");
            Said {
                after: "END_CYCLE()".to_owned(),
                ..Said::new(format!("{start}\nHOLE(X 10mm)\nHOLE(X 20mm)"))
            }
        }
        NameMeaning::Message => Said::new("MESSAGE(\"Turn the part over\")"),
        NameMeaning::RepeatBlock => Said::new("REPEAT_BLOCKS(\"PASS\" to \"PASS\", times 4)")
            .after("LABEL(\"PASS\") & said STRAIGHT_TRAVERSE(X 1mm)\nsaid STRAIGHT_TRAVERSE(X 2mm)"),
        NameMeaning::EndOfRepeat => return end_of_repeat(bench, row),
        NameMeaning::RepeatBlocks => Said::new("REPEAT_BLOCKS(\"PASS\", times 4)")
            .after("LABEL(\"PASS\") & said STRAIGHT_TRAVERSE(X 1mm)\nsaid STRAIGHT_TRAVERSE(X 2mm)"),
    };
    let names = d.name.iter().find(|n| n.write && n.means == Some(meaning)).map(|n| n.name.as_str());
    let codes = match meaning {
        NameMeaning::Code(Meaning::NoEffect) => None,
        NameMeaning::Code(meaning) => d.code_for(meaning).map(|c| c.code.as_str()),
        _ => None,
    };
    let written = match meaning {
        NameMeaning::Code(Meaning::NoEffect) => Some(row.name.as_str()),
        _ => codes.or(names),
    };
    match written {
        Some(word) if word == row.name => must_show(bench.both_ways(&said), &row.name),
        Some(other) => {
            let put = |text: String| in_place(&text, other, &row.name).unwrap_or(text);
            must_show(bench.reads(&said, &said.say, put), &row.name).read_only()
        }
        None => Tried::failure(dictionary("none-written").text("meaning", row.name.as_str())),
    }
}

/// An end of a repetition that no label is named for: read in place of one that is named.
fn end_of_repeat(bench: &Bench, row: &NameRow) -> Tried {
    let said = Said::new("REPEAT_BLOCKS(\"PASS\" to \"ENDLABEL_1\", times 4)").after(
        "LABEL(\"PASS\") & said STRAIGHT_TRAVERSE(X 1mm)\nLABEL(\"ENDLABEL_1\") & said STRAIGHT_TRAVERSE(X 2mm)",
    );
    let put = |text: String| {
        let end = format!("{}:", row.name);
        text.replace("ENDLABEL_1:", &end).replace(" ENDLABEL_1", "")
    };
    must_show(bench.reads(&said, &said.say, put), &row.name).read_only()
}

fn step(word: FrameWord) -> &'static str {
    match word {
        FrameWord::Translate => "translate, X 10mm, Y -5.5mm, Z 2mm",
        FrameWord::Rotate => "rotate, XY, 30deg",
        FrameWord::Scale => "scale, X 0.5, Y 0.5",
        FrameWord::Mirror => "mirror, X",
    }
}

/// A statement that needs a named address.
fn address(role: NameRole) -> Said {
    let through = "said ARC_THROUGH(XY, X 19mm, Y 12mm, through(X 9mm, Y 2mm))";
    Said::new(match role {
        NameRole::Radius => "said ARC_FEED(XY, clockwise, X 13mm, Y 14mm, radius -10mm)",
        NameRole::OpeningAngle => "said ARC_BY_ANGLE(XY, X 13mm, Y 14mm, clockwise, angle 120.5deg)",
        NameRole::Turns => {
            "said ARC_FEED(XY, clockwise, X 19mm, Y 12mm, Z 30mm, centre(start, I 6mm, J 8mm), turns 2)"
        }
        NameRole::ThroughX | NameRole::ThroughY => through,
        NameRole::ThroughZ => {
            return Said::new("said ARC_THROUGH(ZX, X 19mm, Z 30mm, through(X 9mm, Z 45mm))")
                .after("SELECT_PLANE(ZX)");
        }
        NameRole::Rounding => "SET_MOTION_CONTROL_MODE(\"distance\", 0.5mm)",
        NameRole::RoundingInRapids => "SET_MOTION_CONTROL_MODE(\"distance\", 0.5mm, 1.25mm)",
        NameRole::PolarRadius | NameRole::PolarAngle => {
            "POLAR(XY, radius 12.5mm, angle 30.25deg) said STRAIGHT_FEED()"
        }
        NameRole::LineAngle => "POLAR(XY, along 30.25deg) said STRAIGHT_FEED(X 50mm)",
        NameRole::SpindleLimit => "LIMIT_SPINDLE_SPEED(2500)",
        NameRole::SpindleAngle => "ORIENT_SPINDLE(45deg)",
        NameRole::RoundCorner => return corner("ROUND_CORNER"),
        NameRole::ChamferCorner => return corner("CHAMFER_CORNER"),
        NameRole::ChamferCornerByLength => return corner("CHAMFER_CORNER_BY_LENGTH"),
        NameRole::RoundCorners => return corner("ROUND_CORNER"),
        NameRole::PlaneAngle => "SET_FRAME(rotate, XY, 12.5deg)",
    })
}
