//! Events in their plainest form, so that the second interpreter's, the compiler's and those of a
//! book can be laid side by side. Millimetres, degrees, seconds, machine coordinates.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::rc::Rc;

use ncc_exec::world::World;
use ncc_exec::{Compensation, Event, Kind, Stored, by_control};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{
    Distance, FeedMode, Modes, Motion, PathMode, Plane, ReturnLevel, Side, Spindle as Turning, SpindleMode,
    Turn, Units,
};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::expr::system::Kept;
use ncc_ir::program::{ReferencePoint, ToolValue};

use crate::besides::{Unsaid, cuts, switched};
pub use crate::corners::Corners;
use crate::interpreter::setup::Counted;
use crate::interpreter::{
    self, Beside, ByItself, Corner, Kinematics, Machine, Per, PowerOn, Setup, Spindle, What,
};

/// An event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plain {
    /// What happened.
    pub what: Happening,
    /// Where the axes stand after it.
    pub at: [f64; 6],
    /// Feed of a cutting move, else 0.
    pub feed: f64,
    /// What it counts.
    pub per: Per,
    /// How the corner at a move's end is taken; unsaid of anything else.
    pub corner: Corner,
    /// Tool in the spindle.
    pub tool: Option<i64>,
    /// Speed of a turning spindle, negative counter-clockwise; 0 while it stands.
    pub speed: f64,
    /// Of a turning spindle whose speed is a surface's: the machine's X of the middle, and the highest rev/min.
    pub surface: Option<(f64, Option<f64>)>,
    /// Flood, mist.
    pub coolant: (bool, bool),
    /// Cutter radius compensation.
    pub beside: Option<Beside>,
    /// Whether points are those of the tool's tip, and of a tilted plane.
    pub five: [bool; 2],
    /// What the control has done by itself.
    pub by_itself: ByItself,
    /// Whether the feed is the time of this very move.
    pub timed: bool,
}

/// What happened.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Happening {
    Traverse,
    Feed,
    /// Centre on the two axes of the plane; degrees, positive counter-clockwise.
    Arc {
        normal: usize,
        centre: [f64; 2],
        sweep: f64,
        radius: f64,
    },
    /// In step with the spindle: millimetres in a turn, and whether a chuck makes good the rest.
    Thread {
        pitch: f64,
        chuck: bool,
    },
    /// How far at most, away from a contact, and whether finding nothing is an error.
    Probe([f64; 6], bool, bool),
    /// The spindle stopped at an angle, degrees.
    Orient(f64),
    Dwell(f64),
    ToolChange,
    Coolant,
    /// Its name, hashed.
    MachineFunction(u64),
    /// A value put into a table: which, which entry, and what it holds now.
    Data(&'static str, u32, [f64; 6]),
    /// A working plane: its zero, then its axes; or none.
    Plane(Option<[[f64; 3]; 4]>),
    /// The tool turned upright on it.
    Upright,
    Stop,
    Alarm,
    OptionalStop,
    End,
    BeginsAgain,
    /// The text is over, and the program has not said that it ends.
    TextEnd,
    Message,
    /// The operator is shown nothing any more.
    MessageCleared,
    /// What was written to a device.
    Output(u64),
}

/// How far two lists may be apart.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// End points, mm or degrees.
    pub place: f64,
    /// Feeds, mm/min.
    pub feed: f64,
    /// How corners are held together.
    pub corners: Corners,
    /// Whether what F counts on arcs beside a contour is held together: the second control has words for it.
    pub arcs: bool,
}

/// Whether a dialect has words for what F counts on arcs beside a contour.
pub fn says_arcs(dialect: &str) -> bool {
    matches!(dialect, "siemens" | "ir")
}

impl Tolerance {
    /// Both computed from the same numbers.
    pub const SAME: Tolerance = Tolerance { place: 2e-6, feed: 1e-6, corners: Corners::All, arcs: true };
    /// Rounded to three digits in mm, or four in inches.
    pub const ROUNDED: Tolerance = Tolerance { place: 0.002, feed: 0.002, corners: Corners::All, arcs: true };
}

/// A world in the second interpreter's terms.
pub fn setup(world: &World, skip: u16) -> Setup {
    let (offsets, lengths, edges, wears) = (world.clone(), world.clone(), world.clone(), world.clone());
    let (points, stored, counts, radii) = (world.clone(), world.clone(), world.clone(), world.clone());
    let by_hand = world.clone();
    let named = Rc::new(RefCell::new(BTreeMap::new()));
    let (known, called) = (named.clone(), named.clone());
    Setup {
        start: world.start.map(mm),
        work_offset: Box::new(move |number| offsets.work_offset(number as u16).map(mm)),
        length: Box::new(move |entry| match entry {
            // Of the tool that was there at the start, on a control whose tools have lengths.
            u32::MAX => mm(lengths.edge_length(-1, 1)),
            _ if lengths.zeroed_by_tool => 0.0,
            entry => mm(lengths.tool_length(entry)),
        }),
        diameter: Box::new(move |entry| mm(radii.tool_radius(entry).map_or(0, |radius| 2 * radius))),
        wear: Box::new(move |entry| mm(wears.length_wear(entry))),
        edge_length: Box::new(move |tool, edge| {
            let own = |tool| known.borrow().get(&tool).copied().unwrap_or(i64::from(tool));
            mm(if edges.zeroed_by_tool && tool.is_some() {
                0
            } else {
                edges.edge_length(tool.map_or(-1, own), edge)
            })
        }),
        put_in: Box::new(move |tool| {
            let own = called.borrow().get(&tool).copied().unwrap_or(i64::from(tool));
            mm(if by_hand.zeroed_by_tool { by_hand.edge_length(own, 1) } else { 0 })
        }),
        named_tool: Box::new(move |name| {
            let tool = ncc_exec::named_tool(name);
            named.borrow_mut().insert(by_name(tool), tool);
            by_name(tool)
        }),
        skip: std::array::from_fn(|level| skip >> level & 1 == 1),
        peck_clearance: mm(world.peck_clearance),
        break_lift: mm(world.break_lift),
        reference: Box::new(move |point| points.reference(ReferencePoint::Further(point as u8)).map(mm)),
        stored: Box::new(move |point| stored.reference(ReferencePoint::Stored(point as u8)).map(mm)),
        counted: Box::new(move |what, of| {
            let what = match what {
                Counted::Made => Kept::Parts,
                Counted::Wanted => Kept::PartsWanted,
                Counted::Second => Kept::PartsAgain,
                Counted::Fed => Kept::FeedTime,
                Counted::InSpindle => Kept::ToolTime,
                Counted::Limit => Kept::UsesAllowed,
                Counted::Used => Kept::Uses,
            };
            f64::from(counts.kept(what, of as u16))
        }),
        touched: mm(world.touched()),
        bore_shift: (usize::from(world.bore_shift.second), if world.bore_shift.minus { -1.0 } else { 1.0 }),
        rotary_radius: world.rotary_radius(),
        codes_at_start: [None; 2],
        waiting_tool: world.behaviours.does(Behaviour::ToolWithChange),
        line_without_centre: false,
        length_suppressed: false,
        length_moves: world.behaviours.does(Behaviour::LengthWithoutAxis),
        orientation: mm(world.orientation),
        kinematics: Kinematics {
            tip: world.kinematic_shift(true).map(mm),
            plane: world.kinematic_shift(false).map(mm),
            upright: world.oriented().map(|rotary| rotary.map(mm)),
        },
        power_on: PowerOn {
            return_initial: world.power_on.return_level != Some(ReturnLevel::Retract),
            ..PowerOn::default()
        },
        left: Default::default(),
        last_digits_up: false,
    }
}

/// The plain world (0) or a generated one, with the usual modes at power-on: those that both
/// interpreters take for granted.
pub fn world(seed: u32) -> World {
    let power_on = Modes {
        motion: Some(Motion::Traverse),
        distance: Some(Distance::Absolute),
        units: Some(Units::Mm),
        plane: Some(Plane::Xy),
        feed_mode: Some(FeedMode::PerMinute),
        return_level: Some(ReturnLevel::Initial),
        work_offset: Some(1),
        length_offset: Some(0),
        no_origin_shift: Some(true),
    };
    World { power_on, ..World::generate(seed, &Modes::default()) }
}

/// A number for a tool with a name.
fn by_name(tool: i64) -> u32 {
    tool as u32 | 1 << 31
}

/// A world in which the peck clearance and the lift of chip breaking are those that are taken for granted
/// of a dialect's control where a cycle is written out, and holes are left to the level with which it starts.
pub fn of_dialect(world: World, dialect: &str) -> World {
    let linuxcnc = dialect == "linuxcnc";
    let by = if linuxcnc || dialect == "mach3" { ONE / 1000 * 254 } else { ONE };
    let level = if linuxcnc { ReturnLevel::Retract } else { ReturnLevel::Initial };
    let power_on = Modes { return_level: Some(level), ..world.power_on };
    behaving(&World { peck_clearance: by, break_lift: by, power_on, ..world }, dialect)
}

/// The same with what codes do besides their names on a dialect's control.
pub fn behaving(world: &World, dialect: &str) -> World {
    let behaviours = ncc_dialects::builtin(dialect).map(|d| d.behaviours()).unwrap_or_default();
    World { behaviours, ..world.clone() }
}

fn mm(nanos: Nanos) -> f64 {
    nanos as f64 / 1e9
}

/// The second interpreter's events.
pub fn of_machine(machine: &Machine, start: [f64; 6]) -> Vec<Plain> {
    let mut list = Vec::new();
    let mut from = start;
    for event in &machine.events {
        let what = match event.what {
            What::Traverse => Happening::Traverse,
            What::Feed => Happening::Feed,
            What::Arc { normal, centre, sweep } => {
                let (first, second) = [(1, 2), (2, 0), (0, 1)][normal];
                let centre = [centre[first], centre[second]];
                let radius = (from[first] - centre[0]).hypot(from[second] - centre[1]);
                Happening::Arc { normal, centre, sweep, radius }
            }
            What::Thread(pitch, chuck) => Happening::Thread { pitch, chuck },
            What::Probe(to, away, error) => Happening::Probe(to, away, error),
            What::Orient(angle) => Happening::Orient(angle),
            What::Gear(0) => Happening::MachineFunction(hash_of("automatic spindle gear")),
            What::Gear(number) => Happening::MachineFunction(hash_of(&format!("spindle gear {number}"))),
            What::Through(on) => {
                let to = if on { "on" } else { "off" };
                Happening::MachineFunction(hash_of(&format!("coolant through the spindle {to}")))
            }
            What::Dwell(seconds) => Happening::Dwell(seconds),
            What::Tool(_) => Happening::ToolChange,
            What::Coolant(..) => Happening::Coolant,
            What::Message => Happening::Message,
            What::MessageCleared => Happening::MessageCleared,
            What::Alarm => Happening::Alarm,
            What::Data(table, entry, values) => Happening::Data(table, entry, values),
            What::Plane(plane) => Happening::Plane(plane),
            What::Upright => Happening::Upright,
            What::Stop => Happening::Stop,
            What::OptionalStop => Happening::OptionalStop,
            What::End => Happening::End,
            What::BeginsAgain => Happening::BeginsAgain,
            What::TextEnd => Happening::TextEnd,
            // The spindle's state shows in the events that follow.
            What::Spindle(_) => continue,
        };
        from = event.machine;
        let cutting = matches!(what, Happening::Feed | Happening::Probe(..) | Happening::Arc { .. });
        let moves = cutting || matches!(what, Happening::Traverse | Happening::Thread { .. });
        let speed = event.speed.unwrap_or(0.0);
        push(
            &mut list,
            start,
            Plain {
                what,
                at: event.machine,
                feed: match what {
                    Happening::Thread { pitch, .. } => pitch * speed,
                    _ if cutting => event.feed.unwrap_or(0.0),
                    _ => 0.0,
                },
                per: if cutting { event.per } else { Per::Minute },
                corner: if moves { event.corner } else { Corner::Unsaid },
                tool: event.tool.map(i64::from),
                speed: match event.spindle {
                    Spindle::Stopped => 0.0,
                    Spindle::Clockwise => speed,
                    Spindle::Counterclockwise => -speed,
                },
                surface: event.surface.filter(|_| event.spindle != Spindle::Stopped),
                coolant: event.coolant,
                beside: event.beside,
                five: event.five,
                by_itself: event.by_itself,
                timed: event.timed,
            },
        );
    }
    list
}

fn hash_of(name: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    name.hash(&mut hasher);
    hasher.finish()
}

/// The compiler's events.
pub fn of_events(events: &[Event], start: [f64; 6]) -> Vec<Plain> {
    let mut list = Vec::new();
    let mut from = start;
    for event in events {
        let at = event.end.map(mm);
        let what = match &event.kind {
            Kind::Traverse => Happening::Traverse,
            Kind::Feed => Happening::Feed,
            Kind::Arc { plane, turn, full, centre } => {
                let (normal, first, second) = match plane {
                    Plane::Xy => (2, 0, 1),
                    Plane::Zx => (1, 2, 0),
                    Plane::Yz => (0, 1, 2),
                };
                let centre = centre.map(mm);
                let angle = |p: [f64; 6]| (p[second] - centre[1]).atan2(p[first] - centre[0]).to_degrees();
                let partial = if *full { 360.0 } else { (angle(at) - angle(from)).rem_euclid(360.0) };
                let sweep = match turn {
                    Turn::Counterclockwise => partial,
                    Turn::Clockwise if *full => -360.0,
                    Turn::Clockwise => partial - 360.0,
                };
                let radius = (from[first] - centre[0]).hypot(from[second] - centre[1]);
                Happening::Arc { normal, centre, sweep, radius }
            }
            Kind::Synchronised { pitch, chuck } => Happening::Thread { pitch: mm(*pitch), chuck: *chuck },
            Kind::Probe { to, probe } => Happening::Probe(to.map(mm), probe.away, probe.error),
            Kind::Orient(angle) => Happening::Orient(mm(*angle)),
            Kind::Dwell(seconds) => Happening::Dwell(mm(*seconds)),
            Kind::ToolChange => Happening::ToolChange,
            Kind::Coolant => Happening::Coolant,
            Kind::MachineFunction(name) => Happening::MachineFunction(hash_of(name)),
            Kind::Data(stored) => {
                let alone = |value: Nanos| [mm(value), 0.0, 0.0, 0.0, 0.0, 0.0];
                match **stored {
                    Stored::Offset(offset, zero, 0) => Happening::Data("zero", offset, zero.map(mm)),
                    Stored::Offset(offset, mut zero, turn) => {
                        // A turned zero has its angle in the place of C's.
                        zero[5] = turn;
                        Happening::Data("turned zero", offset, zero.map(mm))
                    }
                    Stored::Position(place, at) => Happening::Data("position", u32::from(place), at.map(mm)),
                    Stored::Tool(tool) => Happening::Data("tool", tool, [0.0; 6]),
                    Stored::Length(entry, length) => Happening::Data("length", entry, alone(length)),
                    Stored::Value(entry, which, added, value) => {
                        let table = match (which == ToolValue::RadiusWear, added) {
                            _ if which == ToolValue::OffsetX => "offset along X",
                            _ if which == ToolValue::OffsetY => "offset along Y",
                            (false, false) => "radius",
                            (false, true) => "radius, added",
                            (true, false) => "wear of the radius",
                            (true, true) => "wear of the radius, added",
                        };
                        Happening::Data(table, entry, alone(value))
                    }
                }
            }
            Kind::Tilt(None) => Happening::Plane(None),
            Kind::Tilt(Some(plane)) => {
                let column = |k: usize| plane.axes.map(|row| row[k]);
                Happening::Plane(Some([plane.origin.map(mm), column(0), column(1), column(2)]))
            }
            Kind::OrientToolAxis(_) => Happening::Upright,
            Kind::ProgramStop => Happening::Stop,
            Kind::OptionalProgramStop => Happening::OptionalStop,
            Kind::ProgramEnd => Happening::End,
            Kind::BeginAgain => Happening::BeginsAgain,
            Kind::Message(text) if text.is_empty() => Happening::MessageCleared,
            Kind::Message(_) => Happening::Message,
            Kind::Output(written) => Happening::Output(hash_of(&format!("{written:?}"))),
            Kind::Alarm(..) => Happening::Alarm,
            Kind::TextEnd => Happening::TextEnd,
            // The events under test are never narrated.
            Kind::Attribute(_) => continue,
        };
        from = at;
        let cutting = matches!(what, Happening::Feed | Happening::Probe(..) | Happening::Arc { .. });
        let moves = cutting || matches!(what, Happening::Traverse | Happening::Thread { .. });
        let corner = match event.state.path {
            None => Corner::Unsaid,
            Some(PathMode::ExactStop) => Corner::Stop,
            Some(PathMode::ExactPath) => Corner::Through,
            Some(_) => Corner::Rounded,
        };
        let per = match event.state.feed_mode {
            FeedMode::PerMinute => Per::Minute,
            FeedMode::PerRevolution => Per::Turn,
            FeedMode::InverseTime => Per::Move,
        };
        let speed = mm(event.state.speed);
        push(
            &mut list,
            start,
            Plain {
                what,
                at,
                feed: mm(event.rate),
                per: if cutting { per } else { Per::Minute },
                corner: if moves { corner } else { Corner::Unsaid },
                tool: match event.state.tool {
                    -1 => None,
                    named @ ..-1 => Some(i64::from(by_name(named))),
                    tool => Some(tool),
                },
                speed: match event.state.spindle {
                    Turning::Stopped => 0.0,
                    Turning::Clockwise => speed,
                    Turning::Counterclockwise => -speed,
                },
                surface: (event.state.spindle != Turning::Stopped
                    && event.state.spindle_mode == SpindleMode::Surface)
                    .then(|| (mm(event.state.centre), limit(event.state.limit))),
                coolant: (event.state.flood, event.state.mist),
                beside: beside(&event.state.compensation),
                five: [event.state.tip, event.state.tilted],
                by_itself: ByItself {
                    spindle: event.state.by_control & by_control::SPINDLE != 0,
                    coolant: event.state.by_control & by_control::COOLANT != 0,
                    z: event.state.by_control & by_control::Z != 0,
                    moves: event.state.by_control & by_control::MOVE != 0,
                    z_moved: event.state.by_control & by_control::Z_AT_START == 0,
                },
                timed: event.state.by_control & by_control::TIMED != 0,
            },
        );
    }
    list
}

fn beside(compensation: &Compensation) -> Option<Beside> {
    Some(Beside {
        left: compensation.side? == Side::Left,
        plane: match compensation.plane {
            Plane::Xy => 17,
            Plane::Zx => 18,
            Plane::Yz => 19,
        },
        // Above that it is an edge that is no entry.
        entry: Some(compensation.radius).filter(|radius| radius >> 30 == 0),
        on_contour: compensation.on_contour,
        again: compensation.again,
        diameter: (compensation.radius >> 30 == 1).then_some(i64::from(compensation.radius & !(1 << 30))),
    })
}

/// The highest speed of the spindle, rev/min.
fn limit(thousandths: u32) -> Option<f64> {
    (thousandths != u32::MAX).then(|| f64::from(thousandths) / 1000.0)
}

/// Adds an event, unless it is a straight move that goes nowhere, or a dwell of no time.
fn push(list: &mut Vec<Plain>, start: [f64; 6], event: Plain) {
    let from = list.last().map_or(start, |last| last.at);
    let still = from.iter().zip(event.at).all(|(a, b)| (a - b).abs() < 1e-9);
    let nothing = matches!(event.what, Happening::Dwell(seconds) if seconds == 0.0);
    if !(nothing || still && matches!(event.what, Happening::Traverse | Happening::Feed)) {
        list.push(event);
    }
}

/// Compares two lists.
///
/// # Errors
/// The first difference, with what stands around it.
pub fn compare(expected: &[Plain], actual: &[Plain], within: Tolerance) -> Result<(), String> {
    let (mut index, mut at) = (0, 0);
    // Words that stop the spindle for an optional stop are passed over until something is cut: the speed there.
    let mut optional = None;
    let mut unsaid = Unsaid::default();
    while index < expected.len() || at < actual.len() {
        let (mut at_stop, mut still) = (optional, None);
        let fault = match (expected.get(index), actual.get(at)) {
            (Some(a), Some(b)) => {
                at_stop = if a.what == Happening::OptionalStop { Some(a.speed) } else { optional };
                still = at_stop.filter(|_| !cuts(a.what));
                let turns_on = still.is_some_and(|was: f64| (was < 0.0) == (a.speed < 0.0));
                let b = if turns_on && b.speed == 0.0 {
                    Plain { speed: a.speed, surface: a.surface, ..*b }
                } else {
                    *b
                };
                let off = still.is_some() && b.coolant == (false, false);
                let b = if off { Plain { coolant: a.coolant, ..b } } else { b };
                difference(a, &unsaid.passed_over(a, &b, within.place), within)
            }
            _ => Some("one list is shorter"),
        };
        let Some(fault) = fault else {
            if let (Some(a), Some(b)) = (expected.get(index), actual.get(at)) {
                unsaid.after(a, b);
            }
            (index, at, optional) = (index + 1, at + 1, still);
            continue;
        };
        // Coolant that a word switches here, and the control by itself there; and its way up to a tool change.
        if let (Some(a), Some(b)) = (expected.get(index), actual.get(at)) {
            if switched(a, b) {
                index += 1;
                continue;
            }
            let for_stop = b.what == Happening::Coolant && at_stop.is_some();
            if switched(b, a) || b.by_itself.moves || for_stop {
                at += 1;
                continue;
            }
            if a.by_itself.moves && !b.by_itself.z_moved {
                index += 1;
                continue;
            }
        }
        // From where the one control has gone up, back to where the other one stands.
        let back = |list: &[Plain], at: usize, other: Option<&Plain>| {
            let (event, before) = (list.get(at)?, list.get(at.checked_sub(1)?)?);
            let returns = event.what == Happening::Traverse && before.by_itself.z && !event.by_itself.z;
            let near = |x: f64, y: f64| (x - y).abs() <= within.place;
            Some(returns && event.at.iter().zip(other?.at).all(|(x, y)| near(*x, y)))
        };
        let stood = index.checked_sub(1).and_then(|index| expected.get(index));
        // Or the first one goes to where the other control has gone up by itself.
        let up = at.checked_sub(1).and_then(|at| actual.get(at)).filter(|event| event.by_itself.z);
        if let (Some(a), Some(up)) = (expected.get(index), up)
            && a.what == Happening::Traverse
            && a.at.iter().zip(up.at).all(|(x, y)| (x - y).abs() <= within.place)
        {
            index += 1;
            continue;
        }
        if back(actual, at, stood) == Some(true) {
            at += 1;
            continue;
        }
        // Moves that rounding has brought to nothing vanish.
        if stands(expected, index, within) {
            index += 1;
            continue;
        }
        if stands(actual, at, within) {
            at += 1;
            continue;
        }
        let around = |list: &[Plain], index: usize| {
            (index.saturating_sub(2)..(index + 2).min(list.len()))
                .map(|i| format!("  {} {i:4} {}\n", if i == index { ">" } else { " " }, show(&list[i])))
                .collect::<String>()
        };
        return Err(format!(
            "event {index}: {fault}\n expected\n{} actual\n{}",
            around(expected, index),
            around(actual, at)
        ));
    }
    Ok(())
}

/// Whether an event is a straight move to where the machine stands, to half of what is looked at.
fn stands(list: &[Plain], index: usize, within: Tolerance) -> bool {
    let (Some(event), Some(before)) = (list.get(index), index.checked_sub(1).and_then(|at| list.get(at)))
    else {
        return false;
    };
    let straight = matches!(event.what, Happening::Traverse | Happening::Feed);
    straight && event.at.iter().zip(before.at).all(|(now, was)| (now - was).abs() <= within.place / 2.0)
}

fn difference(a: &Plain, b: &Plain, within: Tolerance) -> Option<&'static str> {
    let near = |x: f64, y: f64, by: f64| (x - y).abs() <= by;
    let same_kind = match (a.what, b.what) {
        (
            Happening::Arc { normal, centre, sweep, radius },
            Happening::Arc { normal: n, centre: c, sweep: s, .. },
        ) => {
            // A degree of sweep is as long as the radius makes it.
            let slack = (within.place * 4.0 / radius.max(0.001)).to_degrees();
            normal == n
                && near(centre[0], c[0], within.place * 2.0)
                && near(centre[1], c[1], within.place * 2.0)
                && near(sweep, s, slack)
        }
        (Happening::Probe(x, away, error), Happening::Probe(y, off, or_error)) => {
            (away, error) == (off, or_error) && x.iter().zip(y).all(|(x, y)| near(*x, y, within.place))
        }
        (Happening::Dwell(x), Happening::Dwell(y)) => near(x, y, 0.0006),
        // A pitch by feed and speed has no end of digits; where it is a word, it has six.
        (Happening::Thread { pitch: x, chuck: c }, Happening::Thread { pitch: y, chuck: d }) => {
            c == d && near(x, y, 0.000_000_6)
        }
        (Happening::Data(a, n, x), Happening::Data(b, m, y)) => {
            a == b && n == m && x.iter().zip(y).all(|(x, y)| near(*x, y, within.place))
        }
        (Happening::Orient(x), Happening::Orient(y)) => near(x, y, 0.0006),
        (Happening::Plane(Some(x)), Happening::Plane(Some(y))) => {
            x.as_flattened().iter().zip(y.as_flattened()).all(|(x, y)| near(*x, *y, within.place))
        }
        (x, y) => x == y,
    };
    if !same_kind {
        return Some("another kind of event, or another arc or dwell");
    }
    if !a.at.iter().zip(b.at).all(|(x, y)| near(*x, y, within.place)) {
        return Some("another end point");
    }
    // F of such a move has few digits.
    let feeds = if a.timed || b.timed { (0.0053 * a.feed).max(within.feed) } else { within.feed };
    if a.per != b.per || !near(a.feed, b.feed, feeds) {
        return Some("another feed");
    }
    let told = |corner: Corner| match (within.corners, corner) {
        (Corners::Nothing, _) => Corner::Unsaid,
        (Corners::StopOrRounded, Corner::Through) => Corner::Stop,
        (_, corner) => corner,
    };
    if told(a.corner) != told(b.corner) {
        return Some("another corner");
    }
    if a.tool != b.tool || a.coolant != b.coolant || !near(a.speed, b.speed, 1e-6) {
        return Some("another tool, spindle or coolant");
    }
    let about = |of: &Plain| of.surface.map_or([f64::MAX; 2], |(x, most)| [x, most.unwrap_or(f64::MAX)]);
    if !about(a).iter().zip(about(b)).all(|(x, y)| near(*x, y, within.place)) {
        return Some("another surface speed: in turns, about another X, or with another limit");
    }
    let held = |beside: Beside| Beside { on_contour: beside.on_contour && within.arcs, ..beside };
    if a.beside.map(held) != b.beside.map(held) {
        return Some("another cutter radius compensation");
    }
    if a.five != b.five {
        return Some("points of another kind: of the tool's tip, or of a plane in space");
    }
    None
}

/// An event on a line.
pub fn show(event: &Plain) -> String {
    let at = event.at.map(|v| format!("{v:.4}")).join(" ");
    format!(
        "{:?} at {at} F{} {:?} corner {:?} T{:?} S{} {:?} coolant {:?} {:?}",
        event.what,
        event.feed,
        event.per,
        event.corner,
        event.tool,
        event.speed,
        event.surface,
        event.coolant,
        event.beside
    )
}

/// Runs the second interpreter on a program of a dialect that it knows.
///
/// # Errors
/// It stopped, and why.
pub fn second(dialect: &str, text: &[u8], setup: Setup) -> Result<Machine, String> {
    let run = match dialect {
        "mach9" => interpreter::mach9::run(text, setup),
        "fanuc" => interpreter::fanuc::run(text, setup),
        "haas" => interpreter::fanuc::run_haas(text, setup),
        "canon" => interpreter::canon::run(text, setup),
        "ir" => interpreter::ir::run(text, setup),
        "siemens" => interpreter::siemens::run(text, setup),
        "linuxcnc" => interpreter::linuxcnc::run(text, setup),
        "grbl" => interpreter::grbl::run(text, setup),
        "grblhal" => interpreter::grbl::run_hal(text, setup),
        "mach3" => interpreter::mach3::run(text, setup),
        other => return Err(format!("no second interpreter for {other}")),
    };
    run.map_err(|halt| format!("line {}: {}", halt.line, halt.why))
}
