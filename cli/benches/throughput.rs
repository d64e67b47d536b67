//! Throughput of each stage and of whole translations, in bytes and blocks of source a second, on
//! one thread. Compare figures of one run only: the ratio of two rows says more than either.

use std::io::Cursor;

use divan::Bencher;
use divan::counter::{BytesCount, ItemsCount};
use ncc_backends::{Layout, Writer};
use ncc_dialects::{Settings, builtin};
use ncc_driver::job::Job;
use ncc_driver::translate::translate;
use ncc_exec::Exec;
use ncc_exec::world::World;
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::Modes;

mod workload;
use workload::Workload;

/// Bytes of a workload. Long enough that the program's head does not count.
const BYTES: u64 = 4_000_000;

fn main() {
    divan::main();
}

/// A workload in memory.
fn text(kind: Workload) -> Vec<u8> {
    let mut text = Vec::with_capacity(BYTES as usize + 4096);
    kind.write(BYTES, &mut text).expect("memory can be written");
    text
}

fn settings(id: &str) -> Settings {
    Settings::new(builtin(id).expect("a built-in dialect"))
}

fn job(from: &str, to: &str, verify: bool) -> Job {
    Job { verify, ..Job::new(settings(from), settings(to), "workload.nc") }
}

/// Pieces of whole lines, as the pipeline makes them.
fn pieces(text: &[u8]) -> Vec<&[u8]> {
    let mut rest = text;
    let mut found = Vec::new();
    while !rest.is_empty() {
        let cut = rest.len().min(64 * 1024);
        let end = rest[..cut].iter().rposition(|&b| b == b'\n').map_or(rest.len(), |at| at + 1);
        let (piece, after) = rest.split_at(end);
        found.push(piece);
        rest = after;
    }
    found
}

fn counted<'a, 'b>(bencher: Bencher<'a, 'b>, text: &[u8]) -> Bencher<'a, 'b> {
    let blocks = text.iter().filter(|&&b| b == b'\n').count();
    bencher.counter(BytesCount::of_slice(text)).counter(ItemsCount::new(blocks))
}

/// Lexing, parsing and lowering.
#[divan::bench(args = Workload::ALL)]
fn read(bencher: Bencher<'_, '_>, kind: Workload) {
    let text = text(kind);
    let parts = pieces(&text);
    counted(bencher, &text).bench_local(|| {
        let mut reader = Reader::new(settings("fanuc"), true);
        let mut batch = Batch::default();
        let mut base = 0;
        for part in &parts {
            reader.read(part, base, &mut batch);
            base += part.len() as u32;
            batch.stmts.clear();
        }
        batch.diagnostics.len()
    });
}

/// Execution in one world of statements that were read before.
#[divan::bench(args = Workload::ALL)]
fn execute(bencher: Bencher<'_, '_>, kind: Workload) {
    let text = text(kind);
    let mut reader = Reader::new(settings("fanuc"), true);
    let mut batch = Batch::default();
    reader.read(&text, 0, &mut batch);
    let world = World::generate(1, &Modes::default());
    counted(bencher, &text).bench_local(|| {
        let mut exec = Exec::new(&world, 0);
        exec.assume(&batch.assumed);
        let mut events = Vec::new();
        let mut total = 0;
        for stmts in batch.stmts.chunks(2000) {
            for stmt in stmts {
                exec.step(stmt, &mut events).expect("a workload can be executed");
            }
            total += events.len();
            events.clear();
        }
        total
    });
}

/// Writing of statements that were read before.
#[divan::bench(args = Workload::ALL)]
fn write(bencher: Bencher<'_, '_>, kind: Workload) {
    let text = text(kind);
    let mut reader = Reader::new(settings("fanuc"), true);
    let mut batch = Batch::default();
    reader.read(&text, 0, &mut batch);
    let mut out = Vec::new();
    counted(bencher, &text).bench_local(|| {
        let mut writer = Writer::new(settings("fanuc"), Layout::default());
        let mut found = Vec::new();
        let mut total = 0;
        for stmts in batch.stmts.chunks(2000) {
            writer.write(stmts, &batch.assumed, &mut out, &mut found);
            total += out.len();
            out.clear();
        }
        total
    });
}

/// The whole, Fanuc to Fanuc, verified.
#[divan::bench(args = Workload::ALL)]
fn translate_verified(bencher: Bencher<'_, '_>, kind: Workload) {
    whole(bencher, kind, "fanuc", true);
}

/// The whole, Fanuc to Fanuc, not verified.
#[divan::bench(args = Workload::ALL)]
fn translate_unverified(bencher: Bencher<'_, '_>, kind: Workload) {
    whole(bencher, kind, "fanuc", false);
}

/// The whole, Fanuc to Mach-9, verified.
#[divan::bench(args = Workload::ALL)]
fn translate_to_mach9(bencher: Bencher<'_, '_>, kind: Workload) {
    whole(bencher, kind, "mach9", true);
}

/// The whole, Fanuc to Sinumerik, verified.
#[divan::bench(args = Workload::ALL)]
fn translate_to_siemens(bencher: Bencher<'_, '_>, kind: Workload) {
    whole(bencher, kind, "siemens", true);
}

/// The whole, Sinumerik to Sinumerik, verified.
#[divan::bench(args = Workload::ALL)]
fn translate_siemens(bencher: Bencher<'_, '_>, kind: Workload) {
    from_siemens(bencher, kind, "siemens");
}

/// The whole, Sinumerik to Fanuc, verified.
#[divan::bench(args = Workload::ALL)]
fn translate_siemens_to_fanuc(bencher: Bencher<'_, '_>, kind: Workload) {
    from_siemens(bencher, kind, "fanuc");
}

/// A workload as a Sinumerik program, with block numbers as the original has them.
fn from_siemens(bencher: Bencher<'_, '_>, kind: Workload, to: &str) {
    let mut job = job("fanuc", "siemens", false);
    job.layout.numbering = ncc_backends::Numbering::Keep;
    let mut made = translate(&job, &mut Cursor::new(text(kind))).expect("reading from memory");
    let text = made.output.to_vec().expect("an output in memory");
    all(bencher, &text, &self::job("siemens", to, true));
}

/// The whole, Fanuc to canonical functions, verified.
#[divan::bench(args = Workload::ALL)]
fn translate_to_canon(bencher: Bencher<'_, '_>, kind: Workload) {
    whole(bencher, kind, "canon", true);
}

fn whole(bencher: Bencher<'_, '_>, kind: Workload, to: &str, verify: bool) {
    all(bencher, &text(kind), &job("fanuc", to, verify));
}

fn all(bencher: Bencher<'_, '_>, text: &[u8], job: &Job) {
    counted(bencher, text).bench_local(|| {
        let outcome = translate(job, &mut Cursor::new(text)).expect("reading from memory");
        assert!(outcome.release.is_ok(), "{:?}", outcome.diagnostics.first());
        outcome.output.bytes()
    });
}
