//! The answers for one program and its set-up, written into a project file: all else of the file stays as it is, to the
//! byte.
//!
//! ```text
//! part.nc, fanuc, decimal_point = calculator    →    [[programs]]
//!                                                    files = "part.nc"
//!                                                    [programs.machine]
//!                                                    dialect = "fanuc"
//!                                                    options = { decimal_point = "calculator" }
//! ```
//!
//! A comment above a key or behind its value stays when the value changes; it goes with a key that is taken out.
//! A row that is about other programs too is the user's, and is left as it is. Not here: where the file is.

use std::collections::BTreeMap;

use ncc_dialects::Dialect;
use ncc_machines::project::{NAME, Programs, Project};
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value, value};

use crate::problem::{Exit, Problem, problem};
use crate::simulate::described::Shaped;
use crate::simulate::tooling;

/// Finds a dialect by its name.
pub type Known<'k> = &'k dyn Fn(&str) -> Option<&'static Dialect>;

/// What is answered of one side.
#[derive(Clone, Copy, Debug)]
pub struct Side<'a> {
    /// The dialect of the control.
    pub dialect: &'a str,
    /// The machine's profile, if one is named.
    pub machine: Option<&'a str>,
    /// Options of the dialect.
    pub options: &'a BTreeMap<String, String>,
}

/// The set-up of a program, as far as it is stated again: `None` leaves a key as it is, an empty value takes it out.
#[derive(Clone, Copy, Debug, Default)]
pub struct SetUp<'a> {
    /// The raw part, as the command line has it.
    pub stock: Option<&'a str>,
    /// What holds it, likewise.
    pub fixtures: Option<&'a [String]>,
    /// Z of the table, mm.
    pub table: Option<Option<f64>>,
    /// Tools, as the command line has them. `4=` takes the shape of tool 4 out of the file.
    pub tools: &'a [String],
}

fn refused(form: &'static str, program: &str) -> Problem {
    Problem::of(Exit::Refused, &problem(form).text("program", program).text("file", NAME), None)
}

/// The refusal where several dialects fit: the row would choose one of them without the user.
pub fn undecided(program: &str) -> Problem {
    refused("project-undecided", program)
}

/// That a project file names a file that is not at hand.
pub fn absent(name: &str) -> Problem {
    let message = problem("project-absent").text("name", name).text("file", NAME);
    Problem::of(Exit::File, &message, None)
}

/// The name of a program as a pattern that matches nothing else.
fn pattern(program: &str) -> String {
    let plain = |letter: char| match letter {
        '*' | '?' | '[' | ']' | '{' | '}' => format!("[{letter}]"),
        letter => letter.to_string(),
    };
    program.chars().map(plain).collect()
}

/// What a project file says of a program, if it does.
///
/// # Errors
/// The file has faults, or two of its rows are about the program.
pub fn row(text: &str, program: &str, known: Known<'_>) -> Result<Option<Programs>, Problem> {
    let faulty = || refused("project-faulty", program);
    let mut project = Project::parse(text, known).map_err(|_| faulty())?;
    Ok(project.row(program).map_err(|_| faulty())?.map(|at| project.rows.swap_remove(at)))
}

/// The text of a project file with the answers for one program; `text` is empty where there is no file yet. Without `from`
/// the row's machine stays as it is.
///
/// # Errors
/// The file has faults, or what it says of the program is about others too, or cannot hold the answers.
pub fn answered(
    text: &str,
    program: &str,
    from: Option<&Side>,
    to: Option<&Side>,
    set_up: &SetUp,
    known: Known<'_>,
) -> Result<String, Problem> {
    let faulty = || refused("project-faulty", program);
    let mut document: DocumentMut = text.parse().map_err(|_| faulty())?;
    let at = match text.trim().is_empty() {
        true => None,
        false => {
            let project = Project::parse(text, known).map_err(|_| faulty())?;
            project.row(program).map_err(|_| faulty())?
        }
    };
    let programs = document.entry("programs").or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    let programs = programs.as_array_of_tables_mut().ok_or_else(faulty)?;
    let own = pattern(program);
    let row = match at {
        Some(at) => programs.get_mut(at).ok_or_else(faulty)?,
        None => {
            let mut row = Table::new();
            row.insert("files", value(own.as_str()));
            programs.push(row);
            programs.get_mut(programs.len().saturating_sub(1)).ok_or_else(faulty)?
        }
    };
    if row.get("files").and_then(Item::as_str).is_none_or(|files| !files.eq_ignore_ascii_case(&own)) {
        return Err(refused("project-shared", program));
    }
    for (key, side) in [("machine", from), ("to", to)] {
        let Some(side) = side else { continue };
        put(row, key, side).map_err(|form| refused(form, program))?;
    }
    put_set_up(row, set_up);
    if !set_up.tools.is_empty() {
        put_tools(row, set_up.tools).map_err(|()| refused("project-named", program))?;
    }
    let written = with_endings_of(text, &document.to_string());
    // It says of the program what it should, and is sound.
    match Project::parse(&written, known).map(|project| project.row(program)) {
        Ok(Ok(Some(_))) => Ok(written),
        Ok(_) | Err(_) => Err(faulty()),
    }
}

/// Text with LF alone, with the line endings and the byte order mark of the text that it comes from: the TOML encoder
/// drops both. Lines that are the same at the start and at the end keep their own, those between have that of the first.
fn with_endings_of(text: &str, written: &str) -> String {
    let mark = if text.starts_with('\u{feff}') { "\u{feff}" } else { "" };
    let old: Vec<&str> = text.trim_start_matches('\u{feff}').split_inclusive('\n').collect();
    let new: Vec<&str> = written.split_inclusive('\n').collect();
    let is_same =
        |(old, new): &(&&str, &&str)| old.trim_end_matches(['\r', '\n']) == new.trim_end_matches('\n');
    let head = old.iter().zip(&new).take_while(is_same).count();
    let rest = old[head..].iter().rev().zip(new[head..].iter().rev());
    let tail = rest.take_while(is_same).count();
    let ending = if old.first().is_some_and(|line| line.ends_with("\r\n")) { "\r\n" } else { "\n" };
    let between = &new[head..new.len() - tail];
    let between: String = between.iter().map(|line| line.replace('\n', ending)).collect();
    [mark, &old[..head].concat(), &between, &old[old.len() - tail..].concat()].concat()
}

/// Puts a value at a key; blanks and comments around key and value stay.
fn set(table: &mut dyn TableLike, key: &str, own: impl Into<Value>) {
    let mut own = own.into();
    match table.get_mut(key) {
        Some(Item::Value(old)) => {
            *own.decor_mut() = old.decor().clone();
            *old = own;
        }
        Some(Item::Table(old)) => {
            let around = old.decor().clone();
            if let Some(behind) = around.suffix() {
                own.decor_mut().set_suffix(behind.clone());
            }
            table.insert(key, Item::Value(own));
            if let (Some(mut key), Some(above)) = (table.key_mut(key), around.prefix()) {
                key.leaf_decor_mut().set_prefix(above.clone());
            }
        }
        _ => drop(table.insert(key, Item::Value(own))),
    }
}

/// Puts an empty table at a key of a row, with the comments of the value that was there.
fn set_table(row: &mut Table, key: &str) {
    let mut own = Table::new();
    if let Some((name, Item::Value(old))) = row.get_key_value(key) {
        if let Some(above) = name.leaf_decor().prefix().and_then(|above| above.as_str()) {
            own.decor_mut().set_prefix(format!("\n{above}"));
        }
        if let Some(behind) = old.decor().suffix() {
            own.decor_mut().set_suffix(behind.clone());
        }
    }
    row.insert(key, Item::Table(own));
}

/// What answers have of a machine.
const ANSWERS: [&str; 2] = ["dialect", "options"];

/// Puts a side into a row. A profile that is named has its options in itself. Facts of a machine that the row states, tools
/// above all, are never dropped for a name.
fn put(row: &mut Table, key: &str, side: &Side) -> Result<(), &'static str> {
    let stated = row.get(key).and_then(Item::as_table_like);
    if let Some(machine) = side.machine {
        if !side.options.is_empty() {
            return Err("project-named");
        }
        if stated.is_some_and(|own| own.iter().any(|(key, _)| !ANSWERS.contains(&key))) {
            return Err("project-machine-stated");
        }
        set(row, key, machine);
        return Ok(());
    }
    if stated.is_none() {
        set_table(row, key);
    }
    let own = row.get_mut(key).and_then(Item::as_table_like_mut).ok_or("project-named")?;
    set(own, "dialect", side.dialect);
    let options: InlineTable =
        side.options.iter().map(|(name, chosen)| (name.as_str(), chosen.as_str())).collect();
    match side.options.is_empty() {
        true => drop(own.remove("options")),
        false => set(own, "options", options),
    }
    Ok(())
}

fn put_set_up(row: &mut Table, set_up: &SetUp) {
    let mut put = |key: &str, own: Option<Value>| match own {
        Some(own) => set(row, key, own),
        None => drop(row.remove(key)),
    };
    if let Some(stock) = set_up.stock {
        put("stock", (!stock.is_empty()).then(|| stock.into()));
    }
    if let Some(fixtures) = set_up.fixtures {
        let all: Array = fixtures.iter().map(String::as_str).collect();
        put("fixtures", (!fixtures.is_empty()).then(|| all.into()));
    }
    if let Some(table) = set_up.table {
        put("table", table.map(Value::from));
    }
}

/// What a row of a tool has of its shape.
const SHAPE: [&str; 9] =
    ["shape", "diameter", "corner", "angle", "end_diameter", "flute", "shank", "holder", "holder_from"];

/// Puts tools into the machine of a row; a profile that is named has its own.
fn put_tools(row: &mut Table, tools: &[String]) -> Result<(), ()> {
    let machine = row.get_mut("machine").and_then(Item::as_table_mut).ok_or(())?;
    let all = machine.entry("tool").or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    let all = all.as_array_of_tables_mut().ok_or(())?;
    for text in tools {
        let (number, shape) = text.split_once('=').ok_or(())?;
        let number: i64 = number.parse().map_err(|_| ())?;
        let is_own = |tool: &Table| tool.get("number").and_then(Item::as_integer) == Some(number);
        let at = all.iter().position(is_own);
        if shape.is_empty() {
            let Some(at) = at else { continue };
            let tool = all.get_mut(at).ok_or(())?;
            SHAPE.iter().for_each(|key| drop(tool.remove(key)));
            if tool.len() == 1 {
                all.remove(at);
            }
            continue;
        }
        let (_, described) = tooling::stated(text).map_err(|_| ())?;
        let tool = match at {
            Some(at) => all.get_mut(at).ok_or(())?,
            None => {
                let mut tool = Table::new();
                tool.insert("number", value(number));
                all.push(tool);
                all.get_mut(all.len().saturating_sub(1)).ok_or(())?
            }
        };
        let named = shape.split(',').next().unwrap_or_default();
        set(tool, "shape", named);
        let of_shape = |of: fn(&Shaped) -> Option<f64>| described.shape.as_ref().and_then(of);
        for (key, length) in [
            ("diameter", described.diameter),
            ("corner", of_shape(|own| own.corner)),
            ("angle", of_shape(|own| own.angle)),
            ("end_diameter", of_shape(|own| own.end_diameter)),
            ("flute", described.flute),
            ("shank", described.shank),
            ("holder", described.holder),
            ("holder_from", described.holder_from),
        ] {
            match length {
                Some(length) => set(tool, key, length),
                None => drop(tool.remove(key)),
            }
        }
    }
    if all.is_empty() {
        machine.remove("tool");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use ncc_dialects::builtin;

    use super::*;

    fn written(text: &str, chosen: &[(&str, &str)]) -> Result<String, Problem> {
        let none = BTreeMap::new();
        let options: BTreeMap<String, String> =
            chosen.iter().map(|(name, own)| ((*name).to_owned(), (*own).to_owned())).collect();
        let from = Side { dialect: "fanuc", machine: None, options: &options };
        let to = Side { dialect: "siemens", machine: None, options: &none };
        answered(text, "part.nc", Some(&from), Some(&to), &SetUp::default(), &builtin)
    }

    /// Of no side, with a set-up.
    fn set_up(text: &str, set_up: &SetUp) -> Result<String, Problem> {
        answered(text, "part.nc", None, None, set_up, &builtin)
    }

    const ROW: &str = "[[programs]]\nfiles = \"part.nc\"\n\n[programs.machine]\ndialect = \"fanuc\"\n\
        options = { decimal_point = \"calculator\" }\n\n[programs.to]\ndialect = \"siemens\"\n";

    #[test]
    fn a_new_file_has_a_row_for_the_program() {
        assert_eq!(written("", &[("decimal_point", "calculator")]).as_deref(), Ok(ROW));
    }

    #[test]
    fn all_else_stays_and_what_is_taken_back_goes() {
        let other = "# ours\n[[programs]]\nfiles = \"old/*.nc\" # these\nmachine = \"haas-vf2\"\n";
        let both = written(other, &[("decimal_point", "calculator")]).expect("written");
        assert_eq!(both, format!("{other}\n{ROW}"));
        let back = written(&both, &[]).expect("written");
        assert_eq!(back, both.replace("options = { decimal_point = \"calculator\" }\n", ""));
    }

    #[test]
    fn a_row_of_several_programs_and_a_file_with_faults_are_left_alone() {
        let shared = "[[programs]]\nfiles = \"*.nc\"\nmachine = \"haas-vf2\"\n";
        for text in [shared, "[[programs]\n", "[[programs]]\nfiles = 7\n"] {
            assert!(written(text, &[]).is_err(), "{text}");
        }
    }

    #[test]
    fn a_set_up_is_put_in_and_taken_out() {
        let fixtures = ["D20 X5 Y5 Z0:10".to_owned()];
        let own = SetUp {
            stock: Some("X0:10 Y0:10 Z-5:0"),
            fixtures: Some(&fixtures),
            table: Some(Some(-20.5)),
            tools: &[],
        };
        let text = set_up("", &own).expect("written");
        assert_eq!(
            text,
            "[[programs]]\nfiles = \"part.nc\"\nstock = \"X0:10 Y0:10 Z-5:0\"\nfixtures = [\"D20 X5 Y5 Z0:10\"]\n\
             table = -20.5\n"
        );
        let own = row(&text, "part.nc", &builtin).expect("sound").expect("a row");
        assert_eq!(own.table.map(toml::Spanned::into_inner), Some(-20.5));
        let none = SetUp { stock: Some(""), fixtures: Some(&[]), table: Some(None), tools: &[] };
        assert_eq!(set_up(&text, &none).as_deref(), Ok("[[programs]]\nfiles = \"part.nc\"\n"));
        assert!(row(&text, "other.nc", &builtin).is_ok_and(|row| row.is_none()));
    }

    #[test]
    fn tools_go_into_the_machine_of_the_row() {
        let tools = |all: &[&str]| all.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
        let text = written("", &[]).expect("written");
        let put = |text: &str, all: &[&str]| set_up(text, &SetUp { tools: &tools(all), ..SetUp::default() });
        let with = put(&text, &["4=drill,6.8,angle=118", "5=flat,10"]).expect("written");
        let rows = "\n[[programs.machine.tool]]\nnumber = 4\nshape = \"drill\"\ndiameter = 6.8\nangle = 118.0\n\
            \n[[programs.machine.tool]]\nnumber = 5\nshape = \"flat\"\ndiameter = 10.0\n";
        assert!(with.contains(rows), "{with}");
        let other = put(&with, &["4=ball,8", "5="]).expect("written");
        assert!(
            other.contains("number = 4\nshape = \"ball\"\ndiameter = 8.0\n") && !other.contains("number = 5")
        );
        assert_eq!(put(&other, &["4="]).as_deref(), Ok(text.as_str()));
        let named = "[[programs]]\nfiles = \"part.nc\"\nmachine = \"haas-vf2\"\n";
        assert!(put(named, &["4=ball,8"]).is_err());
    }

    #[test]
    fn a_length_that_a_stated_tool_lacks_goes() {
        let row = "[[programs]]\nfiles = \"part.nc\"\n[programs.machine]\ndialect = \"fanuc\"\n\
            [[programs.machine.tool]]\nnumber = 1\nname = \"ours\"\nshape = \"bull-nose\"\ndiameter = 10.0\n\
            corner = 2.0\nflute = 20.0\nshank = 10.0\nholder = 40.0\nholder_from = 50.0\n";
        let own = SetUp { tools: &["1=bull-nose,10,corner=2".to_owned()], ..SetUp::default() };
        let (kept, _) = row.split_once("flute").expect("a flute");
        assert_eq!(set_up(row, &own).as_deref(), Ok(kept));
    }

    /// A name in the place of a machine's table would take with it what the table states.
    #[test]
    fn a_machine_that_is_stated_is_not_dropped_for_a_name() {
        let none = BTreeMap::new();
        let named = Side { dialect: "haas", machine: Some("haas-vf2"), options: &none };
        let put = |text: &str| answered(text, "part.nc", Some(&named), None, &SetUp::default(), &builtin);
        let told = |text: &str| put(text).map_err(|problem| problem.message);
        let tool = "\n[[programs.machine.tool]]\nnumber = 1\nshape = \"ball\"\ndiameter = 8.0\n";
        let refused = refused("project-machine-stated", "part.nc").message;
        assert_eq!(told(&format!("{ROW}{tool}")), Err(refused));
        let text = "[[programs]]\nfiles = \"part.nc\"\n# the old one\n[programs.machine] # now\ndialect = \"haas\"\n";
        let name = "[[programs]]\nfiles = \"part.nc\"\n# the old one\nmachine = \"haas-vf2\" # now\n";
        assert_eq!(put(text).as_deref(), Ok(name));
    }

    #[test]
    fn comments_and_line_endings_stay() {
        let fixtures = ["D20 X5 Y5 Z0:10".to_owned()];
        let own = SetUp {
            stock: Some("X0:9 Y0:9 Z-5:0"),
            fixtures: Some(&fixtures),
            table: Some(Some(-20.5)),
            tools: &["1=ball,8".to_owned()],
        };
        let text = "# ours\n[[programs]]\nfiles = \"part.nc\"\n# sawn\nstock  = \"X0:8 Y0:8 Z-5:0\" # roughly\n\
            # held by\nfixtures = [ \"vise.stl\" ] # the vice\ntable = -15.5  # vice\n\n# the mill\n[programs.machine]\n\
            dialect = \"fanuc\"\n[[programs.machine.tool]]\nnumber = 1\n# new\nshape = \"flat\" # ground\n\
            diameter = 6.0 # worn\n# the end\n";
        let changed = [
            ("X0:8 Y0:8", "X0:9 Y0:9"),
            ("[ \"vise.stl\" ]", "[\"D20 X5 Y5 Z0:10\"]"),
            ("-15.5", "-20.5"),
            ("flat", "ball"),
            ("6.0", "8.0"),
        ];
        let new = changed.iter().fold(text.to_owned(), |text, (from, to)| text.replace(from, to));
        assert_eq!(set_up(text, &own).as_deref(), Ok(new.as_str()));
        let [text, new] = [text, &new].map(|text| text.replace('\n', "\r\n"));
        assert_eq!(set_up(&text, &own).as_deref(), Ok(new.as_str()));
        // Each line has its own ending; a new line has that of the first.
        let table = SetUp { table: Some(Some(2.5)), ..SetUp::default() };
        let mixed = "\u{feff}# ours\n[[programs]]\r\nfiles = \"part.nc\"\r\ntable = 1.5\r\n# the end\r\n";
        let new = mixed.replace("1.5\r\n", "2.5\n");
        assert_eq!(set_up(mixed, &table).as_deref(), Ok(new.as_str()));
        let named = "[[programs]]\nfiles = \"part.nc\"\n# the mill\nmachine = \"haas-vf2\" # bought\n";
        let stated = written(named, &[]).expect("written");
        assert!(
            stated.contains("\n# the mill\n[programs.machine] # bought\ndialect = \"fanuc\"\n"),
            "{stated}"
        );
    }
}
