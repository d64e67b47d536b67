//! ncc-ir: what a part program says, without the name of any control.
//!
//! A part program is a text for one control. The same cut is another text on the next machine. Between both stands a
//! [`Program`](program::Program): what the text *says*, in words that belong to no control. Front-ends make it, passes
//! rewrite it, back-ends write it as another text. What the machine *does* when it runs is another representation, events
//! in machine coordinates, and another crate (`ncc-exec`). Verification holds the two sides of a translation together
//! there, and never here.
//!
//! # A program
//!
//! A program is a list of procedures; the first one is the main program. A procedure is a list of statements
//! ([`Stmt`](program::Stmt)). A statement is one canonical machining function, by NIST's names, or a cycle, a pattern of
//! holes, control, or an assignment ([`Op`](program::Op)). This is a whole program in the text form, which any pass can
//! be shown in:
//!
//! ```ir
//! ncc-ir 1
//! program "PLATE"
//! assumed(no-origin-shift true)
//! USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute) & SET_FEED_MODE(per-minute)
//! SET_ORIGIN_OFFSETS(1)
//! SELECT_TOOL(2) & CHANGE_TOOL()
//! USE_TOOL_LENGTH_OFFSET(2)
//! SET_SPINDLE_SPEED(1200) & START_SPINDLE_CLOCKWISE()
//! said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm)
//! said STRAIGHT_TRAVERSE(Z 2.mm)
//! SET_FEED_RATE(150.mm) & said STRAIGHT_FEED(Z -1.5mm)
//! STRAIGHT_FEED(X 40.mm)
//! said STRAIGHT_TRAVERSE(Z 50.mm) & STOP_SPINDLE_TURNING()
//! PROGRAM_END()
//! ```
//!
//! Each line is a block of the source; `&` joins the statements of one block ([`Stmt::joined`](program::Stmt::joined)).
//! A back-end keeps blocks together where its control can. `said` notes that the block itself has the motion code.
//!
//! # Places
//!
//! Every statement knows the bytes of the source that it comes from ([`Span`](source::Span)). A statement that a pass
//! makes has the place of what it is made from. A diagnostic is a [`Fault`](diag::Fault) with such a place; its words are
//! made elsewhere.
//!
//! # Numbers and units
//!
//! A literal is an exact decimal with its unit: a mantissa, digits after the point, and whether a point was written
//! ([`Num`](expr::num::Num)). `10.mm` and `10.0mm` are the same length in other digits, and a back-end that can keep the
//! digits does. Binary floats live in [`geometry`] and in the arithmetic of controls alone.
//!
//! | unit | is |
//! |---|---|
//! | `mm`, `in` | a length, also a feed per minute or per revolution |
//! | `u` | a length in the unit that is active at the entry of the procedure: nobody has said it on the way |
//! | `deg` | an angle |
//! | `s` | a time |
//! | none | a pure number: speed in rev/min, counts, numbers of tools and offsets |
//!
//! Positions that are compared are whole nanometres or billionths of a degree ([`Nanos`](expr::num::Nanos)).
//!
//! An argument may be computed when the program runs. Then it is an expression ([`expr`]), and whoever needs a literal
//! asks for one (`Expr::literal`) and refuses where there is none.
//!
//! # Positions
//!
//! Axis words are those of the program: in its own frame, X to C, an axis without a word stays where it is. A word says
//! itself how it is measured. An incremental word is `X inc 5.mm`:
//!
//! ```ir
//! ncc-ir 1
//! program "STEP"
//! assumed(no-origin-shift true)
//! USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(incremental) & SET_FEED_MODE(per-minute)
//! SET_ORIGIN_OFFSETS(1)
//! USE_TOOL_LENGTH_OFFSET(1)
//! said STRAIGHT_TRAVERSE(X inc 5.mm, Y inc -2.5mm)
//! PROGRAM_END()
//! ```
//!
//! Nobody has to know the distance mode to read a move: a pass that reorders statements may rely on the words. The mode is
//! kept as well (`SET_DISTANCE_MODE`), since a text has to state it.
//!
//! # `Known` and `Entry`
//!
//! A fact on which a statement depends is a [`Fact`](canon::Fact): `Known` if the procedure has said it on every path to
//! the statement, `Entry` if it is whatever holds where the procedure begins. `X 5.u` in a subprogram is such a length:
//! the caller has said `G20` or `G21`. Front-ends never guess. A fact that the main program relies on and never says is
//! assumed from the dictionary, noted in [`Program::assumed`](program::Program::assumed), and reported.
//!
//! A pass that needs an `Entry` fact has three ways: it finds the value at all callers, it has a copy of the procedure
//! made for each value, or it refuses the statement by name.
//!
//! # Order within a block
//!
//! Words of a block act in an order that controls fix. A front-end makes statements in the order in which things happen,
//! and a back-end relies on it:
//!
//! 1. settings: units, plane, distance, feed mode, frames;
//! 2. feed and speed;
//! 3. tool: select, then change; spindle and coolant on;
//! 4. dwell; tool lengths and cutter radius;
//! 5. the motion, the cycle or the holes;
//! 6. spindle and coolant off; stops; the end.
//!
//! Some statements are about the motion that follows in their block, and are over with it: `USE_MACHINE_COORDINATES`,
//! `EXACT_STOP`, `PROBE`, `DETOUR`, `TURN_ROTARY_AXES`, and the corner after it. Between such a statement and its motion
//! nothing may be put that moves, and no pass may separate them into two blocks. A block with block skip carries its
//! level on each of its statements.
//!
//! # Cycles and patterns
//!
//! `START_CYCLE` calls a cycle up and makes no hole. `HOLE` makes one with the active cycle, `END_CYCLE` ends it. A
//! cycle holds all that it needs: plane, levels, depth, feed. A pattern is one statement with all its positions, in the
//! order in which they are drilled.
//!
//! ```ir
//! ncc-ir 1
//! program "HOLES"
//! assumed(no-origin-shift true)
//! USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute) & SET_FEED_MODE(per-minute) & END_CYCLE()
//! SET_ORIGIN_OFFSETS(1)
//! SELECT_TOOL(2) & CHANGE_TOOL()
//! USE_TOOL_LENGTH_OFFSET(2)
//! SET_SPINDLE_SPEED(3183) & START_SPINDLE_CLOCKWISE()
//! said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm)
//! said STRAIGHT_TRAVERSE(Z 25.mm)
//! SET_RETURN_LEVEL(retract) & START_CYCLE(drill, XY, retract 2.mm, depth -12.mm, return retract, plane-first, feed 191.mm) & said HOLE(X 10.mm, Y 10.mm)
//! HOLE(X 30.mm)
//! END_CYCLE()
//! PROGRAM_END()
//! ```
//!
//! # Frames
//!
//! Between the program's words and the machine stands a chain: scale and mirror, rotation, shifts, the work offset, the
//! tilted plane. Each is a named slot ([`FrameSlot`](program::FrameSlot)), and a statement fills or clears one. A frame is
//! never worked into coordinates by a front-end: a rotation by 30 degrees stays one until a pass finds that the target has none.
//!
//! # Control
//!
//! A program that computes has jumps, loops, branches and assignments, with bodies of statements of their own. What a
//! condition reads are variables of the text or of the control. Which of two ways is taken nobody knows here; execution
//! finds out (`ncc-exec`), and a pass has to be right for both.
//!
//! # What a pass may rely on, and what it owes
//!
//! It may rely on: words that say how they are measured; blocks in the order above; cycles with all that they need; facts
//! that are `Known` being known on every path. It may not rely on: where the axes stand, unless the tracker
//! ([`track::Tracker`]) says so; a mode after a label, a call or a skipped block.
//!
//! It owes: the same events in every world; the place of the source on each statement; a diagnostic for whatever is not as
//! it was, by its verdict; and where it can do none of that, a refusal at the place.
//!
//! A writer may rely on a program within its target's capabilities ([`caps::Caps`]): what they do not have does not occur.
//! It matches on all functions, without a catch-all, so that a new one cannot be forgotten.
//!
//! # What else is here
//!
//! [`canon`] has the vocabulary of the functions, [`behaviour`] what codes do besides their name, [`computed`] what a
//! target computes with, [`rank`] what a user has to do about a diagnostic, [`operator_text`] messages and alarms.
//!
//! Not here: what the machine does (`ncc-exec`), rewriting (`ncc-passes`), how a control spells it (`ncc-dialects`). This
//! crate names no dialect, reads no file and prints nothing.

pub mod alarms;
pub mod behaviour;
pub mod canon;
pub mod caps;
pub mod compensated;
pub mod computed;
pub mod control_fact;
pub mod diag;
pub mod expr;
pub mod geometry;
pub mod lack;
pub mod operator_text;
pub mod program;
pub mod rank;
pub mod reason;
pub mod run_time;
pub mod source;
pub mod syntax;
pub mod track;
pub mod transliterate;
pub mod unexecuted;
pub mod unsupported;
