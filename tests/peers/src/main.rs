//! Parses a program with the crate `gcode` and prints how many blocks it has; `.ci/peers` measures that.

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which program?")?;
    let text = std::fs::read_to_string(path)?;
    match gcode::parse(&text) {
        Ok(program) => println!("{} blocks", program.blocks.len()),
        Err(found) => println!("{found:?}"),
    }
    Ok(())
}
