//! Tools as CAM systems describe them in comments.
//!
//! ```text
//! T4 D=10. CR=0. TAPER=118deg - ZMIN=-5. - drill    posts of Autodesk: D and CR in the unit of the program
//! T5 | 10. FLAT ENDMILL | DIA.- 10.                 posts of Mastercam, in several layouts
//! FRESA 12mm                                        a heading before a tool change, by hand: a shape and a diameter
//! ```
//!
//! These forms are those of public programs. `TAPER` is the full angle of a drill's point, and of other tools the angle
//! between axis and side, as the libraries of that maker have it. Not here: what is not said (`tooling`).

use super::described::{Described, Shaped};
use ncc_machines::schema::ShapeName;

/// Words for shapes, in capitals; the first that a comment has counts. Words in other languages are read by `CR` alone.
const SHAPES: &[(&str, ShapeName)] = &[
    ("LOLLIPOP", ShapeName::Lollipop),
    ("T-SLOT", ShapeName::TSlot),
    ("T SLOT", ShapeName::TSlot),
    ("TSLOT", ShapeName::TSlot),
    ("WOODRUFF", ShapeName::TSlot),
    ("KEYSEAT", ShapeName::TSlot),
    ("BALL", ShapeName::Ball),
    ("BULL", ShapeName::BullNose),
    ("CHAMFER", ShapeName::Chamfer),
    ("ENGRAV", ShapeName::Chamfer),
    ("TAPER MILL", ShapeName::Taper),
    ("TAPERED MILL", ShapeName::Taper),
    ("DRILL", ShapeName::Drill),
    ("CENTR", ShapeName::Drill),
    ("SPOT", ShapeName::Drill),
    ("SINK", ShapeName::Drill),
    ("BROCA", ShapeName::Drill),
    ("FURA", ShapeName::Drill),
    ("BOHR", ShapeName::Drill),
    ("ESFERIC", ShapeName::Ball),
    ("KUGEL", ShapeName::Ball),
    ("MILL", ShapeName::Flat),
    ("FRES", ShapeName::Flat),
    ("FRAES", ShapeName::Flat),
    ("FRÄS", ShapeName::Flat),
    ("REAM", ShapeName::Flat),
    ("TAP", ShapeName::Flat),
    ("BOR", ShapeName::Flat),
];

/// The number of a tool, and what a comment says of it; lengths in the unit of the program.
pub fn read(comment: &str) -> Option<(i64, Described)> {
    let text = comment.to_ascii_uppercase();
    let tool = number_of(&text)?;
    // `DIA. OFF.` is an entry of a table.
    let diameter = value(&text, "D=").or_else(|| value(&text.replace("DIA. OFF", ""), "DIA"))?;
    let corner = value(&text, "CR=");
    let taper = value(&text, "TAPER=");
    // `TAPER=` is none of the words.
    let words = text.replace("TAPER=", "");
    let named = SHAPES.iter().find(|(word, _)| words.contains(word)).map(|(_, shape)| *shape);
    let shape = match (named, corner) {
        (
            Some(
                shape @ (ShapeName::Chamfer
                | ShapeName::Taper
                | ShapeName::Drill
                | ShapeName::Lollipop
                | ShapeName::TSlot),
            ),
            _,
        ) => Some(shape),
        (_, Some(corner)) if corner > 0.0 && corner * 2.0 >= diameter => Some(ShapeName::Ball),
        (_, Some(corner)) if corner > 0.0 => Some(ShapeName::BullNose),
        // A taper on a tool without a name may be a drill's point or a mill's side.
        (None, Some(_)) if taper.is_some() => None,
        (None, Some(_)) => Some(ShapeName::Flat),
        (named, _) => named,
    };
    let shape = shape.map(|name| Shaped {
        name,
        corner: corner.filter(|_| matches!(name, ShapeName::BullNose | ShapeName::Taper)),
        angle: match name {
            ShapeName::Chamfer => taper.map(|half| 2.0 * half),
            ShapeName::Drill | ShapeName::Taper => taper,
            ShapeName::Flat
            | ShapeName::Ball
            | ShapeName::BullNose
            | ShapeName::Lollipop
            | ShapeName::TSlot => None,
        },
        end_diameter: None,
    });
    let diameter = Some(diameter).filter(|diameter| *diameter > 0.0)?;
    Some((tool, Described { shape, diameter: Some(diameter), ..Described::default() }))
}

/// Words of headings that name a tool, whole; the first that a heading has counts.
const HEADINGS: &[(&str, ShapeName)] = &[
    ("BALL", ShapeName::Ball),
    ("ESFERICA", ShapeName::Ball),
    ("ESFÉRICA", ShapeName::Ball),
    ("KUGELFRÄSER", ShapeName::Ball),
    ("DRILL", ShapeName::Drill),
    ("BROCA", ShapeName::Drill),
    ("FURACAO", ShapeName::Drill),
    ("FURAÇÃO", ShapeName::Drill),
    ("BOHRER", ShapeName::Drill),
    ("MILL", ShapeName::Flat),
    ("ENDMILL", ShapeName::Flat),
    ("FRESA", ShapeName::Flat),
    ("FRAESER", ShapeName::Flat),
    ("FRÄSER", ShapeName::Flat),
];

/// Words of headings that give a number another meaning than that of a diameter.
const NO_DIAMETER: &[&str] = &[
    "DEEP",
    "DEPTH",
    "LONG",
    "LENGTH",
    "WIDE",
    "THICK",
    "STOCK",
    "BLOCK",
    "HOLES",
    "PROFUNDIDADE",
    "TIEF",
    "LANG",
];

/// What a heading says of the tool that is put in behind it, in mm: what it is, and a number with `mm`. It may be about the
/// part all the same, so that it is no more than a guess.
pub fn heading(comment: &str) -> Option<Described> {
    let text = comment.to_uppercase();
    let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric() && c != '.').collect();
    if NO_DIAMETER.iter().any(|word| words.contains(word)) {
        return None;
    }
    let name = HEADINGS.iter().find(|(word, _)| words.contains(word)).map(|(_, shape)| *shape);
    // A diameter alone is one of a tool where it is said of one.
    let of_tool = ["BIT", "CUTTER", "TOOL"].iter().any(|word| words.contains(word));
    if name.is_none() && !of_tool {
        return None;
    }
    let before = |at: usize| {
        let text = text[..at].trim_end();
        let digits = text.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.' || c == ',').len();
        text[digits..].replace(',', ".").parse().ok()
    };
    let diameter: f64 = text.match_indices("MM").find_map(|(at, _)| before(at))?;
    let shape = name.map(|name| Shaped { name, corner: None, angle: None, end_diameter: None });
    (diameter > 0.0).then(|| Described { shape, diameter: Some(diameter), ..Described::default() })
}

/// The number behind the first `T` that begins a word: `T4`, `T04`, `TOOL - 4`, `T 4`.
fn number_of(text: &str) -> Option<i64> {
    let bytes = text.as_bytes();
    let begins = |at: usize| at == 0 || !bytes[at - 1].is_ascii_alphanumeric();
    (0..bytes.len()).filter(|at| bytes[*at] == b'T' && begins(*at)).find_map(|at| {
        let rest = &text[at + 1..];
        let rest = rest.strip_prefix("OOL").unwrap_or(rest);
        let rest = rest.trim_start_matches([' ', '-', '#', ':']);
        let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        rest[..digits].parse().ok()
    })
}

/// The number behind a name: `D=10.`, `DIA.- 2.5`, `DIA. 10`.
fn value(text: &str, name: &str) -> Option<f64> {
    let at = text.match_indices(name).map(|(at, _)| at).find(|at| {
        // `CORRECTION D=` names no other thing than `D=`; `ID=` does.
        !text[..*at].ends_with(|c: char| c.is_ascii_alphanumeric())
    })?;
    let rest = &text[at + name.len()..];
    // The point behind `DIA` is of the word, one before a digit of the number.
    let point = rest.strip_prefix('.').filter(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()));
    let rest = point.unwrap_or(rest).trim_start_matches(['=', ' ', ':', '-']);
    let mut end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
    // A comma with digits on both sides is a point in many countries.
    let behind = rest[end..].strip_prefix(',').unwrap_or_default();
    let digits = behind.len() - behind.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    if end > 0 && digits > 0 && !rest[..end].contains('.') {
        end += 1 + digits;
    }
    rest[..end].replace(',', ".").trim_end_matches('.').parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_of_cam_systems_describe_tools() {
        let shape = |text: &str| {
            let (tool, own) = read(text)?;
            let shape = own.shape.as_ref().map(|shape| (shape.name, shape.corner, shape.angle));
            Some((tool, own.diameter?, shape))
        };
        let cases = [
            ("T1  D=6. CR=0. - ZMIN=3. - FLAT END MILL", 1, 6.0, Some((ShapeName::Flat, None, None))),
            ("T3  D=2 CR=1 - ZMIN=-17.75 - ball end mill", 3, 2.0, Some((ShapeName::Ball, None, None))),
            (
                "T1 D=2. CR=0.125 - ZMIN=5.99 - FACE MILL",
                1,
                2.0,
                Some((ShapeName::BullNose, Some(0.125), None)),
            ),
            (
                "T1  D=2. CR=0. TAPER=118DEG - ZMIN=-17.601 - DRILL",
                1,
                2.0,
                Some((ShapeName::Drill, None, Some(118.0))),
            ),
            (
                "T3  D=3.175 CR=0. TAPER=45DEG - ZMIN=-0.5 - CHAMFER MILL",
                3,
                3.175,
                Some((ShapeName::Chamfer, None, Some(90.0))),
            ),
            (
                "T2 D=0.2362 CR=0. - ZMIN=0. - fresa con punta plana",
                2,
                0.2362,
                Some((ShapeName::Flat, None, None)),
            ),
            ("T7 D=4. CR=0. TAPER=60deg - punta", 7, 4.0, None),
            ("T5    DRILL2_5         DIA.- 2.5", 5, 2.5, Some((ShapeName::Drill, None, None))),
            (
                "T02 ID=002  DIA-0.5000                   1/2 ENDMILL",
                2,
                0.5,
                Some((ShapeName::Flat, None, None)),
            ),
            ("T10 D=.5 CR=0. CENTER CUTTING END MILL", 10, 0.5, Some((ShapeName::Flat, None, None))),
            ("T11 D=8,5 CR=0,5 - end mill", 11, 8.5, Some((ShapeName::BullNose, Some(0.5), None))),
            ("T12 D=10, CR=0, drill", 12, 10.0, Some((ShapeName::Drill, None, None))),
            ("T13 D=16. CR=0. - T-slot mill", 13, 16.0, Some((ShapeName::TSlot, None, None))),
            ("T14 D=10. CR=5. - lollipop mill", 14, 10.0, Some((ShapeName::Lollipop, None, None))),
            ("TOOL - 2 DIA. OFF. - 2 LEN. - 2 DIA. - 10.", 2, 10.0, None),
        ];
        for (text, tool, diameter, own) in cases {
            assert_eq!(shape(text), Some((tool, diameter, own)), "{text}");
        }
        let headings = [
            ("REBAIXO FRESA 12mm", Some((ShapeName::Flat, 12.0))),
            ("FURAÇÃO 3mm :", Some((ShapeName::Drill, 3.0))),
            ("Bohrer 6,8 mm", Some((ShapeName::Drill, 6.8))),
            ("FACEAMENTO:", None),
            ("FRESA", None),
            ("12mm", None),
            ("MILL 0mm", None),
            ("SLOT MILLED 40MM LONG", None),
            ("ALL DIMENSIONS IN MILLIMETERS, STOCK 25MM", None),
            ("POCKET 12MM DEEP WITH 1/4 ENDMILL", None),
            ("ZERO AT CENTRE OF THE 50MM BLOCK", None),
            ("DRILL 4 HOLES 30MM DEEP, D=8.5", None),
            ("Bohrung 8mm", None),
        ];
        for (text, own) in headings {
            let read = heading(text).map(|own| (own.shape.map(|shape| shape.name), own.diameter));
            assert_eq!(read, own.map(|(name, diameter)| (Some(name), Some(diameter))), "{text}");
        }
        for (text, diameter) in
            [("Bit diameter: 3.0mm", 3.0), ("Cutter: 31.75mm", 31.75), ("TOOL DIAMETER: 2.0 mm", 2.0)]
        {
            let own = Described { diameter: Some(diameter), ..Described::default() };
            assert_eq!(heading(text), Some(own), "{text}");
        }
        for text in
            ["", "T", "TOOL CHANGE", "T1 ROUGHING", "D=10.", "DIAMETER 10", "T4 D=", "T4 D=0.", "TEXT D=5"]
        {
            assert_eq!(shape(text), None, "{text}");
        }
    }
}
