//! `ncc dialects test`: the built-in dictionaries hold, and faulty ones are found out.
//!
//! `tests/dialects/<name>.toml` is a dictionary beside `<name>.expected`, the failures of its test and the
//! summary, or what is said of a file that is no dictionary. `UPDATE_EXPECT=1` writes them.

use ncc::registry::DialectRegistry;
use ncc_dialects::Family;
use ncc_driver::dialect_test;
use ncc_tests::corpus;
use ncc_tests::expect::{self, Failures};

#[test]
fn built_in_dictionaries_read_back() {
    let mut failures = Failures::default();
    for dialect in ncc_dialects::builtins() {
        let rows = dialect_test::test(dialect);
        if rows.iter().any(|row| row.failed.is_some()) {
            failures.add(&dialect.id, dialect_test::table(dialect, &rows, false));
        }
        // Every row of the dictionary has its line.
        let has = |table: &str, row: &str| {
            rows.iter().any(|r| r.table == table && (r.row == row || r.row.split(' ').next() == Some(row)))
        };
        if !matches!(dialect.family, Family::Canon | Family::Ir) {
            for (table, row) in dialect
                .code
                .iter()
                .filter(|c| {
                    c.means.is_none_or(|m| {
                        let name = m.to_string();
                        !matches!(
                            name.as_str(),
                            "START_CYCLE"
                                | "PATTERN"
                                | "CALL_MACRO"
                                | "CALL_MACRO_AT_MOVES"
                                | "CALL_MACRO_AT_BLOCKS"
                                | "END_CALLS_AT_MOVES"
                        )
                    })
                })
                .map(|c| ("code", c.code.clone()))
                .chain(dialect.cycle.iter().map(|c| ("cycle", c.code.clone())))
                .chain(dialect.data.iter().map(|d| ("data", d.name.clone())))
                .chain(dialect.pattern.iter().map(|c| ("pattern", c.code().to_owned())))
                .chain(dialect.name.iter().map(|n| ("name", n.name.clone())))
                .chain(dialect.call.iter().map(|c| ("call", c.name.clone())))
                .filter(|(table, row)| !has(table, row))
            {
                failures.add(&dialect.id, format!("{table} {row} is not tested"));
            }
        }
        println!("{}: {} rows", dialect.id, rows.len());
    }
    failures.finish();
}

#[test]
fn faulty_dictionaries_are_found_out() {
    let mut failures = Failures::default();
    let mut files = 0;
    let folder = corpus::root().join("tests/dialects");
    for path in corpus::files(&folder).into_iter().filter(|p| p.extension().is_some_and(|e| e == "toml")) {
        files += 1;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut known = DialectRegistry::built_in();
        let text = match known.add(std::slice::from_ref(&path), None) {
            Ok(loaded) => {
                let rows = dialect_test::test(loaded[0]);
                let failed = rows.iter().filter(|row| row.failed.is_some()).count();
                if (failed == 0) != stem.starts_with("good-") {
                    failures.add(&stem, format!("{failed} rows fail"));
                }
                dialect_test::table(loaded[0], &rows, false)
            }
            Err(problem) => {
                let place = path.display().to_string();
                let message = problem.message.replace(&place, &format!("{stem}.toml"));
                format!("{message}\n  help: {}\n", problem.help.join("\n  help: "))
            }
        };
        failures.check(&stem, expect::file(&path.with_extension("expected"), text.as_bytes()));
    }
    assert!(files >= 12, "{files} dictionaries");
    failures.finish();
}
