//! Straight-line programs of canonical functions, one call a line: `reference/canon.md` for the
//! functions, their own description for the print (`_` for an axis that stays, `/` for block skip,
//! numbers of work offsets and length entries; NIST's own forms of both beside them, and centimetres).

use super::{Corner, Halt, Machine, Per, Setup, Spindle, What};

/// Runs a program.
///
/// # Errors
/// The program is wrong, or out of scope.
pub fn run(text: &[u8], setup: Setup) -> Result<Machine, Halt> {
    let mut m = Machine::new(setup);
    let mut centimetres = false;
    // These hold at the start of every such text.
    (m.inch, m.absolute, m.plane) = (false, true, 17);
    for (index, line) in String::from_utf8_lossy(text).lines().enumerate() {
        m.line = index + 1;
        let line = line.trim();
        let (level, line) = match line.strip_prefix('/') {
            None => (0, line),
            Some(rest) => {
                let digits = rest.chars().take_while(char::is_ascii_digit).count();
                (rest[..digits].parse().unwrap_or(1), rest[digits..].trim_start())
            }
        };
        if line.is_empty() || (level > 0 && m.setup.skip[level]) {
            continue;
        }
        let Some((name, rest)) = line.split_once('(') else { return m.halt("no call") };
        if name == "COMMENT" || name == "MESSAGE" {
            if name == "MESSAGE" {
                m.record(if rest == "\"\")" { What::MessageCleared } else { What::Message });
            }
            continue;
        }
        let Some(arguments) = rest.strip_suffix(')') else { return m.halt("no closing bracket") };
        let arguments: Vec<&str> = arguments.split(',').map(str::trim).filter(|a| !a.is_empty()).collect();
        if let ("USE_LENGTH_UNITS", [unit]) = (name, &arguments[..]) {
            centimetres = *unit == "CANON_UNITS_CM";
        }
        if call(&mut m, name, &arguments, centimetres)? {
            return Ok(m);
        }
    }
    m.record(What::TextEnd);
    Ok(m)
}

fn number(m: &Machine, text: &str) -> Result<f64, Halt> {
    text.parse().or_else(|_| m.halt(format!("no number: {text}")))
}

fn only(m: &Machine, arguments: &[&str]) -> Result<f64, Halt> {
    match arguments {
        [one] => number(m, one),
        _ => m.halt("one number is needed"),
    }
}

/// Runs a call; true at the end of the program.
fn call(m: &mut Machine, name: &str, a: &[&str], centimetres: bool) -> Result<bool, Halt> {
    let unit = match (m.inch, centimetres) {
        (true, _) => 25.4,
        (false, true) => 10.0,
        (false, false) => 1.0,
    };
    match (name, a) {
        ("CLEAR_ORIGIN_SHIFT", []) => {}
        ("STOP_CUTTER_RADIUS_COMPENSATION", []) => m.go_on(),
        ("START_CUTTER_RADIUS_COMPENSATION", [side @ ("CANON_SIDE_LEFT" | "CANON_SIDE_RIGHT"), entry]) => {
            let entry = number(m, entry)? as u32;
            m.go_beside(*side == "CANON_SIDE_LEFT", false, Some(entry))?;
        }
        (
            "START_CUTTER_RADIUS_COMPENSATION",
            [side @ ("CANON_SIDE_LEFT" | "CANON_SIDE_RIGHT"), "CANON_DIAMETER", diameter],
        ) => {
            let diameter = number(m, diameter)? * unit;
            m.go_beside_by(*side == "CANON_SIDE_LEFT", false, diameter)?;
        }
        ("SET_FEED_MODE", ["CANON_PER_MINUTE"]) => m.count_feed(Per::Minute),
        ("SET_FEED_MODE", ["CANON_PER_REVOLUTION"]) => m.count_feed(Per::Turn),
        ("SET_FEED_MODE", ["CANON_INVERSE_TIME"]) => m.count_feed(Per::Move),
        ("EXACT_STOP", []) => m.stop_once = true,
        ("SET_MOTION_CONTROL_MODE", ["CANON_EXACT_STOP"]) => m.corners = Corner::Stop,
        ("SET_MOTION_CONTROL_MODE", ["CANON_EXACT_PATH"]) => m.corners = Corner::Through,
        ("SET_MOTION_CONTROL_MODE", ["CANON_CONTINUOUS", ..]) => m.corners = Corner::Rounded,
        ("ORIENT_SPINDLE", []) => m.orient(None),
        ("ORIENT_SPINDLE", _) => {
            let angle = only(m, a)?;
            m.orient(Some(angle));
        }
        ("USE_LENGTH_UNITS", ["CANON_UNITS_MM" | "CANON_UNITS_CM"]) => m.inch = false,
        ("USE_LENGTH_UNITS", ["CANON_UNITS_INCHES"]) => m.inch = true,
        ("SELECT_PLANE", ["CANON_PLANE_XY"]) => m.plane = 17,
        ("SELECT_PLANE", ["CANON_PLANE_XZ"]) => m.plane = 18,
        ("SELECT_PLANE", ["CANON_PLANE_YZ"]) => m.plane = 19,
        // NIST's own: the origin at a point in machine coordinates.
        ("SET_ORIGIN_OFFSETS", _) if a.len() == 3 || a.len() == 6 => {
            let mut zero = [None; 6];
            for (axis, value) in a.iter().enumerate() {
                zero[axis] = Some(number(m, value)? * if axis < 3 { unit } else { 1.0 });
            }
            m.store_zero(1, zero, false);
            m.use_offset(1);
        }
        ("SET_TRAVERSE_RATE", _) => drop(only(m, a)?),
        ("SET_ORIGIN_OFFSETS", _) => {
            let offset = only(m, a)? as u32;
            m.use_offset(offset);
        }
        ("SET_FEED_RATE", _) => {
            let unit = if m.per == Per::Move { 1.0 } else { unit };
            m.feed = Some(only(m, a)? * unit);
        }
        ("SET_SPINDLE_MODE", ["CANON_TURNS_PER_MINUTE"]) => m.count_speed(false),
        ("SET_SPINDLE_MODE", ["CANON_SURFACE_SPEED"]) => m.count_speed(true),
        ("LIMIT_SPINDLE_SPEED", _) => m.fastest = Some(only(m, a)?),
        ("SET_SPINDLE_SPEED", _) => {
            let speed = only(m, a)?;
            m.say_speed(speed);
        }
        ("SELECT_TOOL", _) => m.selected = Some(only(m, a)? as u32),
        ("CHANGE_TOOL", []) => m.change_tool()?,
        ("CHANGE_TOOL", _) => {
            let tool = only(m, a)? as u32;
            if m.selected != Some(tool) {
                return m.halt("another tool was selected");
            }
            m.change_tool()?;
        }
        ("USE_TOOL_LENGTH_OFFSET", [length]) if length.contains('.') => {
            let length = number(m, length)? * unit;
            m.use_stated_length(length, false);
        }
        ("USE_TOOL_LENGTH_OFFSET", _) => {
            let entry = only(m, a)? as u32;
            m.use_length(entry);
        }
        ("START_SPINDLE_CLOCKWISE", []) => m.turn(Spindle::Clockwise),
        ("START_SPINDLE_COUNTERCLOCKWISE", []) => m.turn(Spindle::Counterclockwise),
        ("STOP_SPINDLE_TURNING", []) => m.turn(Spindle::Stopped),
        ("FLOOD_ON", []) => m.cool(true, m.coolant.1),
        ("MIST_ON", []) => m.cool(m.coolant.0, true),
        ("COOLANT_OFF", []) => m.cool(false, false),
        ("DWELL", _) => {
            let seconds = only(m, a)?;
            m.record(What::Dwell(seconds));
        }
        ("STRAIGHT_TRAVERSE" | "STRAIGHT_FEED", _) if a.len() == 3 || a.len() == 6 => {
            let to = place(m, a, [0, 1, 2, 3, 4, 5], unit)?;
            match name {
                "STRAIGHT_TRAVERSE" => m.traverse(to),
                // A move that goes nowhere needs no feed.
                _ if m.feed.is_none() && to == m.at => {}
                _ => m.straight(to)?,
            }
            m.begin_block();
        }
        ("ARC_FEED", [end_1, end_2, centre_1, centre_2, rotation, along, rotary @ ..])
            if rotary.is_empty() || rotary.len() == 3 =>
        {
            let (first, second, normal) = m.axes();
            let mut ends = vec![*end_1, *end_2, *along];
            ends.extend(rotary);
            let centre =
                (number(m, centre_1)? * unit + m.shift(first), number(m, centre_2)? * unit + m.shift(second));
            let rotation = number(m, rotation)?;
            if rotation == 0.0 || rotation.fract() != 0.0 {
                return m.halt("an arc of no turn, or of a part of one");
            }
            let to = place(m, &ends, [first, second, normal, 3, 4, 5], unit)?;
            m.arc_of_turns(to, centre, rotation < 0.0, rotation.abs() as u32 - 1)?;
            m.begin_block();
        }
        ("ADVISE", _) => {}
        ("MACHINE_FUNCTION", [name]) => {
            let Some(what) = super::function(name.trim_matches('"')) else { return m.halt("a function") };
            m.record(what);
        }
        ("PROGRAM_STOP", []) => m.record(What::Stop),
        ("OPTIONAL_PROGRAM_STOP", []) => m.record(What::OptionalStop),
        ("BEGIN_AGAIN", []) => {
            m.record(What::BeginsAgain);
            return Ok(true);
        }
        ("PROGRAM_END", []) => {
            m.record(What::End);
            return Ok(true);
        }
        _ => return m.halt(format!("the call {name} with {} arguments", a.len())),
    }
    Ok(false)
}

/// A place of which each argument names an axis; `_` stays.
fn place(m: &mut Machine, arguments: &[&str], axes: [usize; 6], unit: f64) -> Result<super::Place, Halt> {
    let mut words = [None; 6];
    for (argument, axis) in arguments.iter().zip(axes) {
        if *argument != "_" {
            let unit = if axis < 3 { unit } else { 1.0 };
            words[axis] = Some(number(m, argument)? * unit);
        }
    }
    m.target(words)
}
