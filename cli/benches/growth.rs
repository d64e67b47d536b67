//! How cost grows with the size of a program: each row at 1, 4 and 16 times a size. Where the second and third take more
//! than about 4 and 16 times as long as the first, something is looked for in all that came before.

use std::fmt::Write as _;
use std::io::Cursor;
use std::path::Path;

use divan::Bencher;
use ncc::files::open;
use ncc_dialects::{Settings, builtin};
use ncc_driver::job::Job;
use ncc_driver::translate::translate;

/// The sizes, as multiples of a row's own.
const TIMES: [usize; 3] = [1, 4, 16];

fn main() {
    divan::main();
}

fn settings(id: &str) -> Settings {
    Settings::new(builtin(id).expect("a built-in dialect"))
}

fn measure(bencher: Bencher<'_, '_>, from: &str, to: &str, text: &str) {
    let job = Job::new(settings(from), settings(to), "growth");
    bencher.bench_local(|| {
        let outcome = translate(&job, &mut Cursor::new(text)).expect("reading from memory");
        assert!(outcome.release.is_ok(), "{:?}", outcome.diagnostics.first());
        outcome.output.bytes()
    });
}

/// A Fanuc program that calls `count` others, and those programs.
fn calls(count: usize) -> (String, Vec<String>) {
    let mut main = "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\nG00 X0.\n".to_owned();
    let numbers = 2..count + 2;
    numbers.clone().for_each(|n| _ = writeln!(main, "M98 P{n}"));
    let subs = numbers.map(|n| format!("O{n}\nG90 G17 G00 X{}.\nG01 X{}. F100.\nM99\n", n % 50, n % 7));
    (main + "M30\n", subs.collect())
}

/// Subprograms: 75, 300 and 1,200.
#[divan::bench(args = TIMES)]
fn subprograms_to_siemens(bencher: Bencher<'_, '_>, times: usize) {
    let (main, subs) = calls(75 * times);
    measure(bencher, "fanuc", "siemens", &format!("{main}{}%\n", subs.concat()));
}

/// Programs in files of their own: 188, 752 and 3,008.
#[divan::bench(args = TIMES, sample_count = 10)]
fn files_by_include(bencher: Bencher<'_, '_>, times: usize) {
    let folder = tempfile::tempdir().expect("a folder");
    let (main, subs) = calls(188 * times);
    let path = folder.path().join("main.nc");
    std::fs::write(&path, main + "%\n").expect("a file");
    for (at, sub) in subs.iter().enumerate() {
        let name = folder.path().join(format!("O{:04}.nc", at + 2));
        std::fs::write(name, format!("%\n{sub}%\n")).expect("a file");
    }
    let settings = settings("fanuc");
    let gathered = |path: &Path| {
        let mut source = open(path).expect("a file");
        ncc_driver::source::include_path::load_subprograms(
            &mut source,
            &settings,
            &[folder.path().to_owned()],
            &ncc::files::Disk,
        )
        .expect("files");
        source.called.map_or(0, |called| called.files.len())
    };
    bencher.bench_local(|| assert_eq!(gathered(&path), subs.len()));
}

/// Variables with names, of a LinuxCNC: 625, 2,500 and 10,000.
#[divan::bench(args = TIMES, sample_count = 10)]
fn named_variables(bencher: Bencher<'_, '_>, times: usize) {
    let mut text = "G21 G17 G90 G94 G54\n".to_owned();
    (0..625 * times).for_each(|n| _ = writeln!(text, "#<_v{n}>={}\nG0 X#<_v{n}>", n % 9));
    measure(bencher, "linuxcnc", "linuxcnc", &(text + "M2\n"));
}

/// Variables of a Sinumerik that are declared: 1,000, 4,000 and 16,000.
#[divan::bench(args = TIMES, sample_count = 10)]
fn declared_variables(bencher: Bencher<'_, '_>, times: usize) {
    let mut text = String::new();
    (0..1000 * times).for_each(|n| _ = writeln!(text, "DEF REAL WERT{n}"));
    text += "G710 G17 G90 G94 G54\nG0 X1\n";
    (0..10 * times).for_each(|n| _ = writeln!(text, "WERT{}=1\nG0 X=WERT{}", n * 100, n * 100));
    measure(bencher, "siemens", "siemens", &(text + "M30\n"));
}
