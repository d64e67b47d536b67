//! The command line of `ncc why`.

use std::path::PathBuf;

use clap::Args;

use crate::args::typed::Format;

const EXAMPLES: &str = "\
Examples:
  ncc mach9 to fanuc part.cn -o part.nc --map part.nc.map.json
  ncc why part.nc:12                          where line 12 comes from
  ncc why part.nc:12 --format json            the same for machines
  ncc why part.nc:12 --map maps/part.json     by a map of another name
  ncc why part.nc:12 --from-source part.cn    without a map, by translating part.cn again

Exit code: 0 done; 1 a file is not the one that the map was made of; 2 wrong usage; 4 a file could
not be read.";

/// `ncc why`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Why {
    /// A program that ncc has written, and the number of a line in it
    #[arg(value_name = "OUT:LINE", value_parser = place)]
    pub place: (PathBuf, usize),
    /// The map of the program [default: OUT.map.json]
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// The source [default: the file that the map names]; where there is no map, it is translated again
    #[arg(long, value_name = "SRC")]
    pub from_source: Option<PathBuf>,
    /// Dialect of the source, where it is translated again [default: auto]
    #[arg(long, value_name = "DIALECT", requires = "from_source")]
    pub from: Option<String>,
    /// Dialect of the program, where the source is translated again [default: auto]
    #[arg(long, value_name = "DIALECT", requires = "from_source")]
    pub to: Option<String>,
    /// For people, or as JSON [default: human]
    #[arg(
        long,
        value_name = "human|json",
        value_enum,
        default_value_t = Format::Human,
        hide_possible_values = true,
        hide_default_value = true
    )]
    pub format: Format,
}

fn place(text: &str) -> Result<(PathBuf, usize), String> {
    let wrong = || "write the file and the number of a line, such as part.nc:214".to_owned();
    let (path, line) = text.rsplit_once(':').ok_or_else(wrong)?;
    match line.parse::<usize>() {
        Ok(line) if line > 0 && !path.is_empty() => Ok((PathBuf::from(path), line)),
        Ok(_) | Err(_) => Err(wrong()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_a_file_and_a_line() {
        assert_eq!(place("a.nc:214"), Ok((PathBuf::from("a.nc"), 214)));
        assert_eq!(place("C:\\a.nc:1"), Ok((PathBuf::from("C:\\a.nc"), 1)));
        for wrong in ["a.nc", "a.nc:", "a.nc:0", "a.nc:-1", ":3", "a.nc:x", ""] {
            assert!(place(wrong).is_err(), "{wrong}");
        }
    }
}
