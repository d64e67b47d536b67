//! A code that calls a block of its own program: no text that is written has one, so it is read in the place of the code
//! that calls a program.

use super::proof::{Bench, Said, Tried, in_place};

/// Reads a call of a block, which stands where the called program begins: that is what is called then.
pub fn read(bench: &Bench, said: &Said, other: &str, code: &str) -> Tried {
    let (program, sign) = (bench.dialect.program.number, bench.dialect.block.number.unwrap_or(' '));
    let head = |line: &str| {
        let number = line.strip_prefix(program?)?.parse::<u32>().ok().filter(|n| *n > 0)?;
        Some(format!("{sign}{number}"))
    };
    let put = |text: String| {
        let first = text.lines().position(|line| head(line).is_some());
        let lines = text.lines().enumerate().map(|(at, line)| {
            let begins = head(line).filter(|_| Some(at) != first);
            begins.unwrap_or_else(|| line.to_owned()) + "\n"
        });
        in_place(&lines.collect::<String>(), other, code).unwrap_or(text)
    };
    bench.reads_as(said, &said.say, put, |line| {
        let Some(name) = line.split('"').nth(1).filter(|name| name.starts_with(sign)) else {
            return Some(line);
        };
        let called = line.replace(&format!("\"{name}\""), &name[1..]).replace(", shared", "");
        (!line.contains("LABEL")).then_some(called)
    })
}
