//! ncc-simulate: stock removal.
//!
//! A [`Simulation`] takes the moves of a program one by one, in workpiece coordinates, and keeps how high the material
//! stands in every cell of a grid ([`HeightMap`]), which move was the last to cut there, what each move removed, and what
//! went wrong ([`Alarm`]). It can go to the state after any move, in both directions.
//!
//! ```text
//! a block 100 × 60 × 20 mm, a flat end mill of 10 mm, G1 X50. at Z-2.    a slot, 2 mm deep; 500 mm³ a length of 25 mm
//! ```
//!
//! A height map has one height a cell. What T-slot cutters, lollipops and tools that stand on a tilted plane take under what
//! stays is kept besides ([`Hollows`]).
//!
//! Not here: reading programs, executing and timing them, files, pictures, any dialect's name.

mod alarm;
mod band;
mod cut;
mod cutting;
mod faces;
mod history;
mod hollows;
mod isometric;
mod leaning;
mod level_arc;
mod line;
mod map;
mod mesh;
mod moves;
mod picture;
mod pixels;
mod rows;
mod simulation;
mod slices;
mod stock;
mod surface;
mod sweep;
mod tool;
mod under;

pub use alarm::{Alarm, AlarmKind};
pub use cut::Removed;
pub use faces::{Face, Side, covered, faces};
pub use hollows::{Hollows, without};
pub use map::{Grid, HeightMap};
pub use mesh::{Triangle, mesh, rasterise};
pub use moves::{Axes, Move, Way, turned, turned_back};
pub use picture::{Look, draw};
pub use pixels::{COLOURS, Picture, RAW};
pub use simulation::{Setup, Simulation};
pub use stock::{Fixture, Stock};
pub use tool::{Cutter, CutterFault, Shape, Tool};
