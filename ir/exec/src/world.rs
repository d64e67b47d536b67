//! Worlds: what execution needs to know that no program says.
//!
//! A world is an explicit argument, never ambient. Verification makes several, distinct and
//! non-round, so that a lost work offset or a swapped length entry shows in machine coordinates.

use std::collections::BTreeMap;

use crate::Increments;
use crate::maps::Renaming;
use ncc_ir::behaviour::Behaviours;
use ncc_ir::canon::{AXES, Distance, FeedMode, Modes, Motion, PathMode, Plane, ReturnLevel, Units};
use ncc_ir::compensated::Refused;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::expr::system::Kept;
use ncc_ir::geometry::arc_solver::ArcRule;
use ncc_ir::program::{ReferencePoint, ToolValue};

/// One state of the machine and its tables before the program starts.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// Which of the generated worlds this is; 0 is the plain one.
    pub seed: u32,
    /// Modes at power-on. Every fact is known to a world.
    pub power_on: Modes,
    /// How corners are taken at power-on, where the control compared lacks it; `None` is as
    /// the control at hand does.
    pub path: Option<PathMode>,
    /// Where the axes stand, in machine coordinates.
    pub start: [Nanos; AXES],
    /// The control's own clearance of the peck-drilling cycle, in millimetres.
    pub peck_clearance: Nanos,
    /// The control's own lift of the chip-breaking cycle, in millimetres.
    pub break_lift: Nanos,
    /// How far the machine retracts by itself from where a probe has touched, in millimetres: nothing, but for a
    /// control that only plays its machine.
    pub backs_off: Nanos,
    /// Whether the length of the tool in the spindle is that of the last tool change, and none before the first,
    /// whatever number the program has set for it since: so on a control that only plays its machine.
    pub length_by_change: bool,
    /// Whether the operator sets the zero of Z by each tool that is put in: it goes up by the tool's length at the change.
    /// The length of the tool in the spindle is nothing then, if the program has named it; that of another one is what it
    /// was.
    pub zeroed_by_tool: bool,
    /// Whether a code of what the feed counts ends the feed even where it counts that already.
    pub feed_ends_with_mode: bool,
    /// Whether a boring cycle that stops the spindle is an error of the control unless the spindle turns, and a tapping
    /// cycle unless it turns as the tap goes in.
    pub cycles_need_spindle: bool,
    /// Cutter radius compensation of the active side may be switched on again: the next move in the plane goes onto the
    /// contour again.
    pub compensation_again: bool,
    /// Under cutter radius compensation a block that goes nowhere is one without a move in the plane, and no more.
    pub looks_over_blocks: bool,
    /// Which arcs the control accepts.
    pub arcs: ArcRule,
    /// What the control refuses while cutter radius compensation is on.
    pub refused_compensated: Refused,
    /// What codes of the control do besides their names.
    pub behaviours: Behaviours,
    /// The least increments of the control, where digits below them may not count.
    pub increments: Option<Increments>,
    /// Whether the operator's switch for optional stops is on.
    pub optional_stop: bool,
    /// Angle at which the spindle stops where nothing else is stated, degrees.
    pub orientation: Nanos,
    /// Direction in which the control shifts a tool off the wall of a bore.
    pub bore_shift: Sideways,
    /// By how much all work offsets are shifted, as somebody has set the machine up: not at all, but where programs of
    /// two controls are compared.
    pub external: [Nanos; AXES],
    /// What is known of its tables; the rest is the world's own.
    pub tables: Tables,
    /// What is called otherwise here than in the world of the same seed that it is compared with:
    /// the same tool, by another number, has the same length.
    pub renaming: Renaming,
}

/// A direction along an axis of the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sideways {
    /// Along the plane's second axis; else the first.
    pub second: bool,
    /// Towards minus.
    pub minus: bool,
}

impl Sideways {
    /// All four, each with its name.
    pub const ALL: [(&'static str, Sideways); 4] = [
        ("+1", Sideways { second: false, minus: false }),
        ("-1", Sideways { second: false, minus: true }),
        ("+2", Sideways { second: true, minus: false }),
        ("-2", Sideways { second: true, minus: true }),
    ];

    /// Its name: the sign, and which axis of the plane.
    pub const fn name(self) -> &'static str {
        match (self.second, self.minus) {
            (false, false) => "+1",
            (false, true) => "-1",
            (true, false) => "+2",
            (true, true) => "-2",
        }
    }
}

/// Marks what the other machine does not have: no value there is like it.
const FOREIGN: u32 = 1 << 24;

/// Tables of one machine, as far as somebody has stated them. Generated worlds have none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tables {
    /// Zero of work offsets (1 is the first), in machine coordinates, axis by axis.
    pub work_offsets: BTreeMap<u16, [Option<Nanos>; AXES]>,
    /// By how many degrees work offsets are turned about Z, in nanos; where nobody has said it they are not.
    pub work_turns: BTreeMap<u16, Nanos>,
    /// Lengths of tools, in nanos of a millimetre: entries of the length table, and edge 1 of the tool
    /// with that number. 0 is no tool.
    pub lengths: BTreeMap<u32, Nanos>,
    /// How much of the length of an entry is wear.
    pub wears: BTreeMap<u32, Nanos>,
    /// Offsets of tools along X and Y by their entries; where nobody has said them there are none.
    pub offsets: BTreeMap<u32, [Nanos; 2]>,
    /// Radii of tools by their entries, without wear, in nanos of a millimetre.
    pub radii: BTreeMap<u32, Nanos>,
    /// Wear of those radii; where nobody has stated it there is none.
    pub radius_wears: BTreeMap<u32, Nanos>,
    /// Reference points, in machine coordinates, axis by axis.
    pub references: BTreeMap<ReferencePoint, [Option<Nanos>; AXES]>,
    /// Lengths of edges that are no entry on this control and one on the other, by tool and edge.
    pub named_lengths: BTreeMap<(i64, u32), Nanos>,
    /// That entry, as both worlds of a comparison know it: the radius of the edge is that of this entry.
    pub named_entries: BTreeMap<(i64, u32), u32>,
    /// The entry that edge 1 of a tool has, where it is not the tool's number.
    pub edge_entries: BTreeMap<u32, u32>,
}

impl Tables {
    /// The radius that an entry makes a contour compensated by, if it is known.
    pub fn radius(&self, entry: u32) -> Option<Nanos> {
        let wear = self.radius_wears.get(&entry).copied().unwrap_or(0);
        self.radii.get(&entry).and_then(|radius| radius.checked_add(wear))
    }

    /// Puts a radius or its wear into the table; what is added to an unknown radius stays unknown.
    pub fn set_radius(&mut self, entry: u32, which: ToolValue, added: bool, value: Nanos) {
        let (table, unsaid) = match which {
            ToolValue::Radius => (&mut self.radii, None),
            ToolValue::RadiusWear => (&mut self.radius_wears, Some(0)),
            ToolValue::Length | ToolValue::LengthWear | ToolValue::OffsetX | ToolValue::OffsetY => return,
        };
        let before = table.get(&entry).copied().or(unsaid);
        let now = if added { before.and_then(|before| before.checked_add(value)) } else { Some(value) };
        match now {
            Some(now) => table.insert(entry, now),
            None => table.remove(&entry),
        };
    }
}

impl World {
    /// The world of a seed (1, 2, …) for a control of which `fixed` facts always hold at power-on.
    /// Every other fact differs from world to world, so that a program which leaves it unsaid is
    /// not the same program in all of them.
    pub fn generate(seed: u32, fixed: &Modes) -> World {
        let odd_one = seed % 2 == 1;
        let pick = |a, b| if odd_one { a } else { b };
        let power_on = Modes {
            motion: fixed.motion.or(Some(if odd_one { Motion::Feed } else { Motion::Traverse })),
            distance: fixed.distance.or(Some(if odd_one {
                Distance::Incremental
            } else {
                Distance::Absolute
            })),
            units: fixed.units.or(Some(if odd_one { Units::Inch } else { Units::Mm })),
            plane: fixed.plane.or(Some(if odd_one { Plane::Yz } else { Plane::Zx })),
            feed_mode: fixed.feed_mode.or(Some(if odd_one {
                FeedMode::PerRevolution
            } else {
                FeedMode::PerMinute
            })),
            return_level: fixed.return_level.or(Some(if odd_one {
                ReturnLevel::Initial
            } else {
                ReturnLevel::Retract
            })),
            work_offset: fixed.work_offset.or(Some(pick(5, 3) as u16)),
            length_offset: fixed.length_offset.or(Some(pick(91, 92))),
            no_origin_shift: fixed.no_origin_shift.or(Some(false)),
        };
        let mut world = World {
            seed,
            power_on,
            path: None,
            start: [0; AXES],
            peck_clearance: 0,
            backs_off: 0,
            length_by_change: false,
            zeroed_by_tool: false,
            feed_ends_with_mode: false,
            cycles_need_spindle: false,
            compensation_again: false,
            looks_over_blocks: false,
            arcs: ArcRule::default(),
            refused_compensated: Refused::default(),
            behaviours: Behaviours::default(),
            increments: None,
            optional_stop: false,
            break_lift: 0,
            orientation: 0,
            bore_shift: Sideways { second: odd_one, minus: seed / 2 % 2 == 1 },
            external: [0; AXES],
            tables: Tables::default(),
            renaming: Renaming::default(),
        };
        world.start = std::array::from_fn(|axis| world.odd(50_000 + axis as u32, 400));
        world.peck_clearance = ONE / 2 + world.odd(60_000, 1).abs() / 2;
        world.break_lift = ONE / 2 + world.odd(60_001, 1).abs() / 2;
        world.orientation = world.odd(60_002, 180).abs();
        world
    }

    /// A shift of program zero that an earlier program left, where there is one.
    pub fn left_over_shift(&self) -> [Nanos; AXES] {
        std::array::from_fn(|axis| self.odd(70_000 + axis as u32, 20))
    }

    /// The same world, all work offsets of which are shifted: what does not reckon with it shows.
    #[must_use]
    pub fn with_external(mut self) -> World {
        self.external = std::array::from_fn(|axis| self.odd(140_000_000 + axis as u32, 30));
        self
    }

    /// Zero of a work offset (1 is the first), as its table has it: in machine coordinates, but for the external offset.
    pub fn work_offset(&self, number: u16) -> [Nanos; AXES] {
        let stated = self.tables.work_offsets.get(&number);
        let renamed = self.offset_number(number);
        std::array::from_fn(|axis| match stated.and_then(|offset| offset[axis]) {
            Some(stated) => stated,
            None if self.seed == 0 => 0,
            None => self.odd(renamed * 8 + axis as u32, 190),
        })
    }

    /// By how much a work offset is turned about Z, degrees in nanos.
    pub fn work_turn(&self, number: u16) -> Nanos {
        self.tables.work_turns.get(&number).copied().unwrap_or(0)
    }

    /// A work offset by the number that both worlds of a comparison know it by.
    pub fn offset_number(&self, number: u16) -> u32 {
        match &self.renaming.offsets {
            None => u32::from(number),
            Some(map) => map.get(&number).map_or(u32::from(number) | FOREIGN, |n| u32::from(*n)),
        }
    }

    /// An entry of the table of tools by the number that both worlds of a comparison know it by.
    pub fn entry_number(&self, entry: u32) -> u32 {
        renamed(&self.renaming.entries, entry)
    }

    /// A tool by the number that both worlds of a comparison know it by.
    pub fn tool_number(&self, tool: u32) -> u32 {
        renamed(&self.renaming.tools, tool)
    }

    /// A reference point, in machine coordinates.
    pub fn reference(&self, point: ReferencePoint) -> [Nanos; AXES] {
        let stated = self.tables.references.get(&point);
        let index = match point {
            ReferencePoint::Home => 0,
            ReferencePoint::Further(n) => 16 + u32::from(n),
            ReferencePoint::Fixed(n) => 32 + u32::from(n),
            ReferencePoint::Stored(n) => 48 + u32::from(n),
        };
        std::array::from_fn(|axis| match stated.and_then(|point| point[axis]) {
            Some(stated) => stated,
            None if self.seed == 0 || point == ReferencePoint::Home => 0,
            None => self.odd(80_000 + index * 8 + axis as u32, 90),
        })
    }

    /// The radius at which rotary axes count in the feed, millimetres, where it is set on the machine; the plain world
    /// does not say.
    pub fn rotary_radius(&self) -> Option<f64> {
        (self.seed != 0).then(|| 20.0 + self.odd(150_000_000, 60).abs() as f64 / ONE as f64)
    }

    /// How far apart the zeros of the tool tip (`true`), or of a tilted plane, and of the linear axes are:
    /// nobody knows but the machine.
    pub fn kinematic_shift(&self, tip: bool) -> [Nanos; 3] {
        let first = if tip { 120_000 } else { 120_008 };
        std::array::from_fn(|axis| if self.seed == 0 { 0 } else { self.odd(first + axis as u32, 60) })
    }

    /// Where the rotary axes A, B and C stand when the tool stands upright on a tilted plane, degrees; the
    /// plain world does not say.
    pub fn oriented(&self) -> Option<[Nanos; 3]> {
        (self.seed != 0).then(|| std::array::from_fn(|axis| self.odd(120_016 + axis as u32, 90)))
    }

    /// How much of the length of an entry is wear.
    pub fn length_wear(&self, entry: u32) -> Nanos {
        match self.tables.wears.get(&entry) {
            Some(stated) => *stated,
            None if self.seed == 0 => 0,
            None => self.odd(renamed(&self.renaming.entries, entry).wrapping_mul(8).wrapping_add(3), 1),
        }
    }

    /// How much of a probing move's way is gone when the probe triggers, in billionths; in the plain world, all.
    pub fn touched(&self) -> Nanos {
        if self.seed == 0 { ONE } else { ONE / 2 + self.odd(130_000, 100) / 400 }
    }

    /// What the machine keeps count of by itself, of something with a number or of all; in the plain world, nothing yet.
    pub fn kept(&self, what: Kept, of: u16) -> u32 {
        let index = 140_000 + what as u32 * 1000 + u32::from(of);
        if self.seed == 0 { 0 } else { (self.odd(index, 3000) / ONE).unsigned_abs() as u32 }
    }

    /// Length of an entry of the tool-length table, in millimetres; entry 0 is none.
    pub fn tool_length(&self, entry: u32) -> Nanos {
        match self.tables.lengths.get(&entry) {
            _ if entry == 0 => 0,
            Some(stated) => *stated,
            None => self.own_length(renamed(&self.renaming.entries, entry)),
        }
    }

    /// Radius of an entry of the table of tools, wear counted in, as a program reads it there; entry 0 has none. `None`
    /// is what a program has added to a radius that nobody knows.
    pub fn tool_radius(&self, entry: u32) -> Option<Nanos> {
        match self.tables.radius(entry) {
            _ if entry == 0 => Some(0),
            Some(stated) => Some(stated),
            None if self.tables.radius_wears.contains_key(&entry) => None,
            None if self.seed == 0 => Some(0),
            None => {
                let index = renamed(&self.renaming.entries, entry).wrapping_mul(8).wrapping_add(4);
                Some(3 * ONE / 2 + self.odd(index.wrapping_add(150_000), 1))
            }
        }
    }

    /// Offsets of an entry along X and Y.
    pub fn tool_offsets(&self, entry: u32) -> [Nanos; 2] {
        self.tables.offsets.get(&entry).copied().unwrap_or_default()
    }

    /// The entry of the length table that edge 1 of a tool has.
    pub fn edge_entry(&self, tool: u32) -> u32 {
        self.tables.edge_entries.get(&tool).copied().unwrap_or(tool)
    }

    /// Length of an edge of a tool, in millimetres; -1 is the tool that was in the spindle at the
    /// start. Edge 1 is an entry of the table, in general the one with the tool's number.
    pub fn edge_length(&self, tool: i64, edge: u32) -> Nanos {
        let known = u32::try_from(tool);
        // A tool with a name has a length of its own.
        let entry = known.unwrap_or(if tool == -1 { 97 } else { tool as u32 | FOREIGN });
        match edge {
            0 => 0,
            _ if self.tables.named_lengths.contains_key(&(tool, edge)) => {
                self.tables.named_lengths[&(tool, edge)]
            }
            1 if entry != 0 && known.is_ok() => self.tool_length(self.edge_entry(entry)),
            1 if entry != 0 => self.own_length(entry),
            _ if self.seed == 0 => 0,
            _ => {
                let tool = if known.is_ok() { renamed(&self.renaming.tools, entry) } else { entry };
                let index = tool.wrapping_mul(10).wrapping_add(edge).wrapping_mul(8);
                40 * ONE + self.odd(index.wrapping_add(100_000), 35)
            }
        }
    }

    /// A length that no table states.
    fn own_length(&self, entry: u32) -> Nanos {
        if self.seed == 0 { 0 } else { 40 * ONE + self.odd(entry.wrapping_mul(8).wrapping_add(7), 35) }
    }

    /// A value between -range and range mm that looks like no other: to six decimals, so that no
    /// rounding of a program can meet it by chance.
    fn odd(&self, index: u32, range: i64) -> Nanos {
        let mut h = u64::from(self.seed) << 32 | u64::from(index);
        h = (h ^ (h >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        h = (h ^ (h >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
        h ^= h >> 33;
        let micro = (h % (2_000_000 * range as u64)) as i64 - 1_000_000 * range;
        (micro | 1) * 1000
    }
}

/// What another machine calls a number, or a number that is none of its own.
fn renamed(map: &Option<BTreeMap<u32, u32>>, number: u32) -> u32 {
    match map {
        None => number,
        Some(map) => map.get(&number).copied().unwrap_or(number | FOREIGN),
    }
}
