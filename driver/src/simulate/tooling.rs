//! The tools of a program: what a user or a profile states, what comments say, and guesses for the rest.

use std::collections::BTreeMap;

use ncc_machines::Profile;
use ncc_machines::schema::ShapeName;
use ncc_simulate::{Cutter, CutterFault, Shape, Tool};

use super::described::{Described, Shaped};
use super::path::{Path, Used};

/// Diameter of a mill of which nothing is known, mm.
const MILL: f64 = 10.0;
/// Diameter of a drill of which nothing is known, mm.
const DRILL: f64 = 6.0;
/// Angle of a drill's point of which nothing is known, degrees: the usual one of twist drills (DIN 1897).
const POINT: f64 = 118.0;
/// Full angle of a chamfer mill of which nothing is known, degrees.
const CHAMFER: f64 = 90.0;
/// Angle between axis and side of a taper of which nothing is known, degrees.
const TAPER: f64 = 5.0;
/// Thickness of the disc of a T-slot cutter of which nothing is known, in parts of its diameter: those of DIN 851 have from
/// 0.38 to 0.5.
const DISC: f64 = 0.44;
/// Length of what cuts for a taper without one, mm: it bounds how wide it is above.
const LONG: f64 = 100.0;

/// Where a tool's diameter comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Known {
    /// The user states it.
    Stated,
    /// The machine's profile does.
    Profile,
    /// A comment in this line says it.
    Comment(u32),
    /// It is a guess.
    Guess,
}

/// A tool of a program.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Its shape, as the kernel has it.
    pub shape: Shape,
    /// Its diameter, mm.
    pub diameter: f64,
    /// Where its diameter comes from.
    pub known: Known,
    /// Whether its shape or a part of that is a guess.
    pub shape_guessed: bool,
    /// The tool for the kernel.
    pub tool: Tool,
}

/// A tool that has no cutter.
#[derive(Clone, Debug, PartialEq)]
pub struct NoCutter {
    /// Its number.
    pub number: i64,
    /// Why.
    pub fault: CutterFault,
}

/// The tools of a program, in the order of [`Path::tools`]. `stated` are the user's.
///
/// # Errors
/// A description that is no tool.
pub fn tools(
    path: &Path,
    stated: &BTreeMap<i64, Described>,
    profile: Option<&Profile>,
) -> Result<Vec<Fitted>, NoCutter> {
    path.tools.iter().map(|used| fit(used, path, stated.get(&used.number), profile)).collect()
}

/// Stated tools that a program does not have.
pub fn unused<'s>(path: &'s Path, stated: &'s BTreeMap<i64, Described>) -> impl Iterator<Item = i64> + 's {
    stated.keys().copied().filter(|number| path.tools.iter().all(|used| used.number != *number))
}

fn fit(
    used: &Used,
    path: &Path,
    stated: Option<&Described>,
    profile: Option<&Profile>,
) -> Result<Fitted, NoCutter> {
    let only = path.tools.len() == 1 && path.remarks.len() == 1 && used.number < 0;
    let remark = match only {
        // A program of one tool need not name it by a number.
        true => path.remarks.values().next(),
        false => path.remarks.get(&used.number),
    };
    let rows = [
        stated.cloned().map(|own| (own, Known::Stated)),
        profile.and_then(|profile| of_profile(profile, used.number)).map(|own| (own, Known::Profile)),
        remark.map(|own| (own.described.clone(), Known::Comment(own.line))),
    ];
    let rows: Vec<_> = rows.into_iter().flatten().collect();
    let known = rows.iter().find(|(own, _)| own.diameter.is_some()).map_or(Known::Guess, |(_, known)| *known);
    let own = rows.iter().fold(Described::default(), |own, (other, _)| own.or(other));
    let holes = used.across == 0 && used.along > 0 && !used.threads;
    let guess = if holes { ShapeName::Drill } else { ShapeName::Flat };
    let said = own.shape.clone();
    let shaped =
        said.clone().unwrap_or(Shaped { name: guess, corner: None, angle: None, end_diameter: None });
    let diameter = own.diameter.filter(|diameter| *diameter > 0.0);
    let diameter = diameter.unwrap_or(if holes { DRILL } else { MILL });
    let (shape, sure) = shape(&shaped, &own, diameter);
    let no_cutter = |fault| NoCutter { number: used.number, fault };
    let shank = own.shank.map(|diameter| diameter / 2.0);
    let flute = match shape {
        Shape::TSlot => Some(own.flute.unwrap_or(diameter * DISC)),
        // The ball ends where the neck is as thick.
        Shape::Lollipop => shank.map(|neck| {
            let radius = diameter / 2.0;
            radius + (radius * radius - neck * neck).max(0.0).sqrt()
        }),
        _ => own.flute,
    };
    let is_on_neck = matches!(shape, Shape::TSlot | Shape::Lollipop);
    if let Some(neck) = own.shank.filter(|neck| is_on_neck && *neck >= diameter) {
        return Err(no_cutter(CutterFault::Neck { neck, diameter }));
    }
    let cutter = Cutter::new(&shape, diameter, flute.unwrap_or(LONG)).map_err(no_cutter)?;
    // A heading by hand may be about the part.
    let by_heading = matches!(known, Known::Comment(_)) && remark.is_some_and(|own| own.heading);
    let shape_guessed = said.is_none() || !sure || by_heading;
    Ok(Fitted {
        tool: Tool {
            number: used.number,
            cutter,
            flute,
            shank,
            holder: own.holder.zip(own.holder_from).map(|(diameter, from)| [diameter / 2.0, from]),
            guessed: shape_guessed || known == Known::Guess,
        },
        shape,
        diameter,
        known,
        shape_guessed,
    })
}

/// The kernel's shape, and whether nothing of it is a guess.
fn shape(own: &Shaped, tool: &Described, diameter: f64) -> (Shape, bool) {
    match own.name {
        ShapeName::Lollipop => (Shape::Lollipop, true),
        ShapeName::TSlot => (Shape::TSlot, tool.flute.is_some()),
        ShapeName::Flat => (Shape::Flat, true),
        ShapeName::Ball => (Shape::Ball, true),
        ShapeName::BullNose => {
            (Shape::BullNose { corner: own.corner.unwrap_or(diameter / 10.0) }, own.corner.is_some())
        }
        ShapeName::Drill => (Shape::Drill { point: own.angle.unwrap_or(POINT) }, own.angle.is_some()),
        ShapeName::Chamfer => (
            Shape::Chamfer { tip: own.end_diameter.unwrap_or(0.0), angle: own.angle.unwrap_or(CHAMFER) },
            own.angle.is_some(),
        ),
        ShapeName::Taper => (
            Shape::Taper { corner: own.corner.unwrap_or(0.0), angle: own.angle.unwrap_or(TAPER) },
            own.angle.is_some(),
        ),
    }
}

/// What a machine's profile says of a tool.
fn of_profile(profile: &Profile, number: i64) -> Option<Described> {
    let number = u32::try_from(number).ok()?;
    let row = profile
        .schema
        .tool
        .iter()
        .map(toml::Spanned::get_ref)
        .find(|row| row.number.get() == Some(number))?;
    Some(Described {
        shape: row.shape.get().map(|name| Shaped {
            name,
            corner: row.corner.get(),
            angle: row.angle.get(),
            end_diameter: row.end_diameter.get(),
        }),
        diameter: row.diameter.get(),
        flute: row.flute.get(),
        shank: row.shank.get(),
        holder: row.holder.get(),
        holder_from: row.holder_from.get(),
    })
}

/// Why a text states no tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoTool {
    /// It is not of the form.
    Form,
    /// A length that means nothing without another one: a shank without flutes, a holder without a place.
    Incomplete,
    /// A value that no tool has.
    Value,
}

/// The largest length or angle of a tool, mm or degrees.
const LARGEST: f64 = 10_000.0;

/// Reads how a user states a tool: its number or `start`, its shape, its diameter in mm, and what a profile's row may have.
///
/// ```text
/// 4=drill,10,angle=118,flute=60
/// ```
///
/// # Errors
/// As [`NoTool`] says.
pub fn stated(text: &str) -> Result<(i64, Described), NoTool> {
    let (number, rest) = text.split_once('=').ok_or(NoTool::Form)?;
    let number = match number.trim() {
        "start" => -1,
        number => {
            let number: u32 = number.trim_start_matches(['T', 't']).parse().map_err(|_| NoTool::Form)?;
            i64::from(number)
        }
    };
    let mut parts = rest.split(',').map(str::trim);
    let name = match parts.next().unwrap_or_default() {
        "flat" => ShapeName::Flat,
        "ball" => ShapeName::Ball,
        "bull-nose" => ShapeName::BullNose,
        "drill" => ShapeName::Drill,
        "chamfer" => ShapeName::Chamfer,
        "taper" => ShapeName::Taper,
        "lollipop" => ShapeName::Lollipop,
        "t-slot" => ShapeName::TSlot,
        _ => return Err(NoTool::Form),
    };
    let above_zero = |text: &str| {
        let value: f64 = text.parse().map_err(|_| NoTool::Form)?;
        if value > 0.0 && value <= LARGEST { Ok(value) } else { Err(NoTool::Value) }
    };
    let mut shaped = Shaped { name, corner: None, angle: None, end_diameter: None };
    let diameter = above_zero(parts.next().ok_or(NoTool::Form)?)?;
    let mut own = Described { diameter: Some(diameter), ..Described::default() };
    for part in parts {
        let (key, value) = part.split_once('=').ok_or(NoTool::Form)?;
        // What a shape does not have says nothing of it.
        let place = match (key.trim(), name) {
            ("corner", ShapeName::BullNose | ShapeName::Taper) => &mut shaped.corner,
            ("angle", ShapeName::Drill | ShapeName::Chamfer | ShapeName::Taper) => &mut shaped.angle,
            ("end_diameter", ShapeName::Chamfer) => &mut shaped.end_diameter,
            ("flute", _) => &mut own.flute,
            ("shank", _) => &mut own.shank,
            ("holder", _) => &mut own.holder,
            ("holder_from", _) => &mut own.holder_from,
            _ => return Err(NoTool::Form),
        };
        if place.replace(above_zero(value.trim())?).is_some() {
            return Err(NoTool::Form);
        }
    }
    let whole = (own.shank.is_none() || own.flute.is_some() || name == ShapeName::Lollipop)
        && own.holder.is_some() == own.holder_from.is_some();
    own.shape = Some(shaped);
    if whole { Ok((number, own)) } else { Err(NoTool::Incomplete) }
}
