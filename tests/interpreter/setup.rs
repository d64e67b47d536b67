//! What the control knows that no program says: its tables, its switches, its modes at power-on.

use super::next_run::Left;
use super::{Kinematics, Place};

/// What the control knows that the program does not say.
pub struct Setup {
    /// Where the axes stand, in machine coordinates.
    pub start: Place,
    /// Zero of each work offset, in machine coordinates; 1 is the first.
    pub work_offset: Box<dyn Fn(u32) -> Place>,
    /// Length of each entry of the tool table; 0 is none.
    pub length: Box<dyn Fn(u32) -> f64>,
    /// Diameter of each entry, millimetres.
    pub diameter: Box<dyn Fn(u32) -> f64>,
    /// How much of the length is wear.
    pub wear: Box<dyn Fn(u32) -> f64>,
    /// Length of an edge of a tool, on a control whose tools have edges; `None` is a tool that was
    /// in the spindle at power-on and that nothing is known of. Edge 0 is none.
    pub edge_length: Box<dyn Fn(Option<u32>, u32) -> f64>,
    /// How far up the operator moves the zero of Z when a tool is put in, where tools are changed by hand.
    pub put_in: Box<dyn Fn(u32) -> f64>,
    /// A number for a tool with a name, which no tool has that is called by number.
    pub named_tool: Box<dyn Fn(&str) -> u32>,
    /// Block-skip switches, by level; place 0 is not used, place 10 is a Sinumerik's `/1`.
    pub skip: [bool; 11],
    /// A Fanuc's parameter 5115, millimetres.
    pub peck_clearance: f64,
    /// A Fanuc's parameter 5114, millimetres.
    pub break_lift: f64,
    /// The second, third and fourth reference point, in machine coordinates.
    pub reference: Box<dyn Fn(u32) -> Place>,
    /// The positions that a LinuxCNC goes to by G28 (1) and G30 (2), in machine coordinates.
    pub stored: Box<dyn Fn(u32) -> Place>,
    /// What the machine has counted of something with a number, or of all (0).
    pub counted: Box<dyn Fn(Counted, u32) -> f64>,
    /// How much of a probing move's way is gone when the probe says so.
    pub touched: f64,
    /// Where a Fanuc shifts a tool off the wall of a bore: which axis of the plane, and its sign.
    pub bore_shift: (usize, f64),
    /// The radius of the rotary axes that is set on a Haas (settings 34 and 79), millimetres.
    pub rotary_radius: Option<f64>,
    /// The T and the H code in force when a program of a Fanuc begins; the tool of that T is in the spindle.
    pub codes_at_start: [Option<u32>; 2],
    /// Whether M06 with a T in its block puts in the tool that waits, on a Fanuc (the builder's choice).
    pub waiting_tool: bool,
    /// A Fanuc's parameter 3403#5 (CIR) at 0: an arc without centre and radius is a straight line.
    pub line_without_centre: bool,
    /// A Fanuc's parameter 5006#6 (TOS) at 0: a length without an axis word moves Z.
    pub length_moves: bool,
    /// A Sinumerik's machine datum 10760 at 1: G53, G153 and SUPA leave the tool's length out.
    pub length_suppressed: bool,
    /// Where M19 stops the spindle, degrees.
    pub orientation: f64,
    /// How the machine is built, as far as it shows.
    pub kinematics: Kinematics,
    /// Modes at power-on.
    pub power_on: PowerOn,
    /// Whether powers, for LinuxCNC, and what words round, for a Fanuc, come out a little greater, by less than a control
    /// promises: what then goes elsewhere hangs on the last digits of its numbers.
    pub last_digits_up: bool,
    /// What the program that ran before has left.
    pub left: Left,
}

/// What a machine counts by itself.
#[derive(Clone, Copy, Debug)]
pub enum Counted {
    /// Parts that were made.
    Made,
    /// Parts that are wanted, on a Fanuc.
    Wanted,
    /// Ends of programs by a Haas's second count.
    Second,
    /// Seconds at feed of a tool.
    Fed,
    /// Seconds of a tool in the spindle.
    InSpindle,
    /// Uses of a tool before it is worn.
    Limit,
    /// Its uses.
    Used,
}

/// Modes at power-on.
#[derive(Clone, Copy, Debug)]
pub struct PowerOn {
    /// Inches.
    pub inch: bool,
    /// Absolute words.
    pub absolute: bool,
    /// 17, 18, 19.
    pub plane: u32,
    /// Work offset.
    pub offset: u32,
    /// Length entry.
    pub entry: u32,
    /// G98 on a Fanuc.
    pub return_initial: bool,
    /// Motion code on a Fanuc: 0 to 3.
    pub motion: u32,
    /// Tool in the spindle, on a control whose tools have edges; or where tools are put in by hand.
    pub tool: Option<u32>,
    /// Edge of that tool.
    pub edge: u32,
}

impl Default for PowerOn {
    fn default() -> PowerOn {
        PowerOn {
            inch: false,
            absolute: true,
            plane: 17,
            offset: 1,
            entry: 0,
            return_initial: true,
            motion: 0,
            tool: None,
            edge: 0,
        }
    }
}

impl Setup {
    /// Everything zero and all switches off: machine coordinates are program coordinates.
    pub fn plain() -> Setup {
        Setup {
            start: [0.0; 6],
            work_offset: Box::new(|_| [0.0; 6]),
            length: Box::new(|_| 0.0),
            diameter: Box::new(|_| 0.0),
            wear: Box::new(|_| 0.0),
            named_tool: Box::new(|_| 1 << 31),
            edge_length: Box::new(|_, _| 0.0),
            put_in: Box::new(|_| 0.0),
            skip: [false; 11],
            peck_clearance: 1.0,
            break_lift: 1.0,
            reference: Box::new(|_| [0.0; 6]),
            stored: Box::new(|_| [0.0; 6]),
            counted: Box::new(|_, _| 0.0),
            touched: 1.0,
            bore_shift: (0, 1.0),
            rotary_radius: None,
            codes_at_start: [None; 2],
            waiting_tool: false,
            line_without_centre: false,
            length_moves: false,
            length_suppressed: false,
            orientation: 0.0,
            kinematics: Kinematics { tip: [0.0; 3], plane: [0.0; 3], upright: None },
            power_on: PowerOn::default(),
            last_digits_up: false,
            left: Left::default(),
        }
    }
}
