//! Passes, each alone and as the legaliser picks them: a program before and after.
//!
//! `passes/<pass>/<case>.ir` holds the program, `---`, what the pass makes of it, and if it reports
//! anything another `---` and the reports. Lines `#! …` before the program say what the pass is told:
//! `target ID OPTION=VALUE` (the capabilities of a dialect; without, a target that can say nothing), `start X0 Y0`
//! (where the axes stand), `clearance 1.0` and `lift 0.5` (the parameters of peck drilling and of chip
//! breaking, mm), `tools 3:7`, `entries`, `offsets`, `programs` (maps to another machine's numbers),
//! `edge-entries 7:27` (entries of its tools), `radii 5:4.0` (by entries, mm), `interpreter yes` (contours as
//! LinuxCNC's interpreter goes beside them), `can tool-edges=yes` (a capability that is other than the target's; `no`, `either`;
//! so are statements of programs that compute, `leave=yes`). In the folder
//! `legaliser` the passes are picked by the target.
//!
//! Besides the text, every case that is not refused is executed before and after, in two worlds:
//! the events must be the same.

mod control;
mod law;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ncc_backends::{Layout, ir::Writer};
use ncc_dialects::{Settings, builtin};
use ncc_exec::maps::{Maps, Renaming};
use ncc_exec::verify::{Comparison, Resolution};
use ncc_exec::world::World;
use ncc_exec::{Event, Exec, Progress, Runner};
use ncc_frontends::{Batch, ir::Reader};
use ncc_ir::canon::{AXES, Axis, Distance, FeedMode, Modes, Motion, Plane, ReturnLevel, Units};
use ncc_ir::caps::{Caps, LengthsOf, ReturnsTo};
use ncc_ir::computed::computes::{ComputeFeature, Computes};
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::expr::num::{Nanos, Num, ONE, Unit};
use ncc_ir::geometry::offset_path::Rules;
use ncc_ir::program::{Lines, Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;
use ncc_passes::flow::control_forms;
use ncc_passes::flow::unused_labels;
use ncc_passes::holes::cycle_plane_check;
use ncc_passes::tools::machine_numbers::Renumbering;
use ncc_passes::values::exact_comparisons;
use ncc_passes::{Legaliser, PASSES, Target};
use ncc_tests::expect::{self, Failures};

/// What a pass is told.
struct Told {
    target: Target,
    start: [Option<Nanos>; AXES],
    maps: Maps,
    /// Whether compensation is worked out before as well.
    beside: bool,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("passes")
}

fn told(text: &str) -> Result<Told, String> {
    let mut told = Told {
        target: Target { decimals: 3, ..Target::default() },
        start: [None; AXES],
        maps: Maps::default(),
        beside: false,
    };
    for line in text.lines().filter_map(|l| l.strip_prefix("#! ")) {
        let (what, value) = line.split_once(' ').ok_or("a directive has a value")?;
        match what {
            "target" => {
                let (id, chosen) = value.split_once(' ').unwrap_or((value, ""));
                let mut settings = Settings::new(builtin(id).ok_or("no such dialect")?);
                for choice in chosen.split(' ').filter(|choice| !choice.is_empty()) {
                    let (option, value) = choice.split_once('=').ok_or("an option is written NAME=VALUE")?;
                    settings.choose(option, value).map_err(|e| format!("{e:?}"))?;
                }
                told.target.caps = settings.caps();
            }
            "clearance" => told.target.peck_clearance = Some(length(value)?),
            "lift" => told.target.break_lift = Some(length(value)?),
            "start" => {
                for word in value.split(' ') {
                    let axis = Axis::from_letter(word.as_bytes()[0]).ok_or("no axis")?;
                    told.start[axis as usize] = Some(decimal(&word[1..])?);
                }
            }
            "tools" => told.maps.tools = Some(numbers(value)?),
            "entries" => told.maps.entries = Some(numbers(value)?),
            "offsets" => {
                let short = |n: u32| u16::try_from(n).map_err(|e| e.to_string());
                let rows = numbers(value)?.into_iter().map(|(a, b)| Ok((short(a)?, short(b)?)));
                told.maps.offsets = Some(rows.collect::<Result<_, String>>()?);
            }
            "programs" => {
                let pairs = value.split(' ').map(|pair| pair.split_once(':').ok_or("a pair has a colon"));
                let rows = pairs.map(|pair| pair.map(|(a, b)| (a.into(), b.into())));
                told.maps.programs = rows.collect::<Result<_, _>>()?;
            }
            "programs-in-force" => told.maps.programs_in_force = value == "yes",
            "radii" => {
                let rows = value.split(' ').map(|pair| {
                    let (entry, radius) = pair.split_once(':').ok_or("a pair has a colon")?;
                    Ok((entry.parse().map_err(|e| format!("{e}"))?, decimal(radius)?))
                });
                told.target.compensating.radii = rows.collect::<Result<_, String>>()?;
            }
            "interpreter" => {
                told.target.compensating.rules = Rules::INTERPRETER;
                told.target.compensating.known = true;
            }
            "edge-entries" => told.target.edge_entries = numbers(value)?,
            "further-edges" => {
                let rows = value.split(' ').map(|row| {
                    let number = |text: &str| text.parse::<u32>().map_err(|e| e.to_string());
                    let (edge, entry) = row.split_once(':').ok_or("an edge has a colon")?;
                    let (tool, edge) = edge.split_once('.').ok_or("an edge has a point")?;
                    Ok(((number(tool)?, number(edge)?), number(entry)?))
                });
                told.target.further_edges = rows.collect::<Result<_, String>>()?;
            }
            "program-numbers" => told.target.program_numbers = numbers(value)?.into_keys().collect(),
            "can" => value.split(' ').try_for_each(|one| can(&mut told.target.caps, one))?,
            _ => return Err(format!("unknown directive {what}")),
        }
    }
    Ok(told)
}

/// Changes a capability: `tool-edges=yes`.
fn can(caps: &mut Caps, what: &str) -> Result<(), String> {
    let (name, value) = what.split_once('=').ok_or("a capability has a value")?;
    let either = || match value {
        "yes" => Ok(Some(true)),
        "no" => Ok(Some(false)),
        "either" => Ok(None),
        _ => Err(format!("{value} is no answer")),
    };
    let says = || Ok::<bool, String>(either()? == Some(true));
    match name {
        "tool-edges" => {
            caps.tools.lengths_of = match either()? {
                None => LengthsOf::Either,
                Some(true) => LengthsOf::Edges,
                Some(false) => LengthsOf::Entries,
            }
        }
        "return-planes" => caps.holes.returns = either()?.map(ReturnsTo::only).unwrap_or_default(),
        "frames" => caps.frames.chain = says()?,
        "local-shift" => caps.frames.local_shift = says()?,
        "rotation" => caps.frames.rotation = says()?,
        "scale" => caps.frames.scale = says()?,
        "mirror" => caps.frames.mirror = says()?,
        "machine-coordinates" => caps.machine.coordinates = says()?,
        "arc-forms" => caps.arcs.forms = says()?,
        "repeats" => caps.flow.repeats = says()?,
        "repeat-blocks" => caps.flow.repeat_blocks = says()?,
        "blocks" => computes(caps)?.blocks = says()?,
        "opposite" => computes(caps)?.opposite = says()?,
        "loops" => computes(caps)?.loops = value.parse().map_err(|e| format!("{value}: {e}"))?,
        "jump" => statement(caps, ComputeFeature::Jump, says()?)?,
        "endless" => statement(caps, ComputeFeature::Endless, says()?)?,
        "leave" => statement(caps, ComputeFeature::Leave, says()?)?,
        "next-turn" => statement(caps, ComputeFeature::NextTurn, says()?)?,
        "until" => statement(caps, ComputeFeature::Until, says()?)?,
        _ => return Err(format!("no capability {name}")),
    }
    Ok(())
}

/// What the target computes with.
fn computes(caps: &mut Caps) -> Result<&mut Computes, String> {
    caps.flow.computes.as_mut().map(Arc::make_mut).ok_or_else(|| "a target that does not compute".into())
}

fn statement(caps: &mut Caps, statement: ComputeFeature, has: bool) -> Result<(), String> {
    let computes = computes(caps)?;
    computes.statements.retain(|own| *own != statement);
    computes.statements.extend(has.then_some(statement));
    Ok(())
}

/// Pairs of numbers: `3:7 4:3`.
fn numbers(text: &str) -> Result<BTreeMap<u32, u32>, String> {
    let number = |text: &str| text.parse::<u32>().map_err(|e| format!("{text}: {e}"));
    let pair = |pair: &str| {
        let (a, b) = pair.split_once(':').ok_or("a pair has a colon")?;
        Ok((number(a)?, number(b)?))
    };
    text.split(' ').map(pair).collect()
}

/// The way back of maps that are one to one.
fn back(maps: &Maps) -> Renaming {
    fn turned<T: Ord + Copy>(map: &Option<BTreeMap<T, T>>) -> Option<BTreeMap<T, T>> {
        map.as_ref().map(|map| map.iter().map(|(a, b)| (*b, *a)).collect())
    }
    Renaming {
        tools: turned(&maps.tools),
        entries: turned(&maps.entries),
        offsets: turned(&maps.offsets),
        ..Renaming::default()
    }
}

fn decimal(text: &str) -> Result<Nanos, String> {
    let mm: f64 = text.parse().map_err(|e| format!("{text}: {e}"))?;
    Ok((mm * ONE as f64).round() as Nanos)
}

fn length(text: &str) -> Result<Num, String> {
    Ok(Num::from_nanos(decimal(text)?, 9, Unit::Mm))
}

fn read(text: &str) -> Result<Program, String> {
    let settings = Settings::new(builtin("ir").ok_or("no ir")?);
    let mut reader = Reader::new(settings, false);
    let mut batch = Batch::default();
    reader.read(text.as_bytes(), 0, &mut batch);
    reader.finish(&mut batch);
    if let Some(found) = batch.diagnostics.first() {
        let (start, end) = (found.span.start as usize, found.span.end as usize);
        return Err(format!("{:?} at {:?}", found.fault, text.get(start..end)));
    }
    let mut procedures = vec![Procedure { body: batch.stmts, ..Procedure::default() }];
    procedures.append(&mut batch.procedures);
    Ok(Program { name: batch.name, assumed: batch.assumed, procedures })
}

fn write(program: &Program) -> Result<String, String> {
    let settings = Settings::new(builtin("ir").ok_or("no ir")?);
    let mut writer = Writer::new(settings, Layout::default());
    let (mut out, mut diags) = (Vec::new(), Vec::new());
    for (at, procedure) in program.procedures.iter().enumerate() {
        match at {
            0 => writer.write(&procedure.body, &program.assumed, &mut out, &mut diags),
            _ => writer.procedure(procedure, &mut out, &mut diags),
        }
    }
    writer.finish(&mut out, &mut diags);
    String::from_utf8(out).map_err(|e| e.to_string())
}

/// A report in a line: code, what it says, and the source that it points at.
fn report(found: &Diagnostic, text: &str) -> String {
    let place = text.get(found.span.start as usize..found.span.end as usize).unwrap_or("?");
    format!("NC{:04} {:?} at {}\n", found.fault.code(), found.fault, place.trim())
}

fn refused(diags: &[Diagnostic]) -> bool {
    diags.iter().any(|d| d.fault.gravity() == Gravity::Error)
}

/// The folder of cases of the pass that is in no list.
const NUMBERS: &str = "machine-numbers";

/// Those of the passes that programs go through which compute.
const COMPUTING: [&str; 4] = ["control-forms", "exact-comparisons", "passed-labels", "planes-checked"];

fn apply(pass: &str, program: &mut Program, told: &Told) -> Result<Vec<Diagnostic>, String> {
    let mut diags = Vec::new();
    if pass == "legaliser" {
        let mut legaliser = legaliser(told);
        legaliser.run_program(program, &mut diags);
        return Ok(diags);
    }
    if pass == NUMBERS {
        Renumbering::new(told.maps.clone()).run(program, &mut diags);
        return Ok(diags);
    }
    if let (true, Some(computes)) = (COMPUTING.contains(&pass), &told.target.caps.flow.computes) {
        match pass {
            "control-forms" => control_forms::run(program, computes),
            "passed-labels" => unused_labels::run(program),
            "planes-checked" => {
                let alarm = computes.planes_alarm.ok_or("a target whose cycles check their planes")?;
                cycle_plane_check::run(program, alarm, told.target.decimals);
            }
            _ => exact_comparisons::run(program, computes, &mut diags),
        }
        return Ok(diags);
    }
    let pass = PASSES.iter().find(|p| p.name == pass).ok_or("a folder is named after a pass")?;
    let entry = Tracker { modes: program.assumed, position: told.start, ..Tracker::default() };
    pass.alone.expect("a pass that runs alone")(program, &told.target, &entry, &mut diags);
    Ok(diags)
}

/// Every file under `passes/`, with its pass.
fn cases() -> Vec<(String, PathBuf)> {
    let entries = |path: &Path| -> Vec<PathBuf> {
        let read = fs::read_dir(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let mut all: Vec<_> = read.filter_map(|e| e.ok().map(|e| e.path())).collect();
        all.sort();
        all
    };
    let folders = entries(&folder());
    let name = |p: &Path| p.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    folders.iter().flat_map(|f| entries(f).into_iter().map(|c| (name(f), c))).collect()
}

#[test]
fn before_and_after() {
    let mut failures = Failures::default();
    for (pass, path) in cases() {
        failures.check(path.display(), case(&pass, &path));
    }
    failures.finish();
}

fn case(pass: &str, path: &Path) -> Result<(), String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let before_text = text.split("---\n").next().unwrap_or_default();
    let mut told = told(before_text)?;
    told.beside = pass == "expand-compensation";
    let before = read(before_text)?;
    let mut after = before.clone();
    let diags = apply(pass, &mut after, &told)?;
    let mut actual = format!("{before_text}---\n{}", write(&after)?);
    if !diags.is_empty() {
        actual.push_str("---\n");
        actual.extend(diags.iter().map(|d| report(d, before_text)));
    }
    expect::file(path, actual.as_bytes())?;
    // A message that is dropped is an event less: it is reported, and stops a translation.
    if refused(&diags) || diags.iter().any(|d| d.fault == Fault::MessageDropped) {
        return Ok(());
    }
    same_events(&before, &after, &told)?;
    if pass == "legaliser" && before.procedures.len() == 1 {
        let pieces = in_pieces(&before, &told).ok_or("refused block by block")?;
        same_events(&before, &pieces, &told).map_err(|e| format!("block by block: {e}"))?;
    }
    Ok(())
}

fn legaliser(told: &Told) -> Legaliser {
    let target = &told.target;
    let mut legaliser = Legaliser::new(&target.caps, target.decimals, target.peck_clearance);
    legaliser.set_break_lift(target.break_lift);
    legaliser.stand_at(&told.start);
    legaliser
}

/// The legaliser's work on a program that comes block by block, unless it is refused.
fn in_pieces(before: &Program, told: &Told) -> Option<Program> {
    let mut legaliser = legaliser(told);
    let mut after = before.clone();
    after.procedures[0].body.clear();
    let mut diags = Vec::new();
    let mut out = Vec::new();
    let mut piece: Vec<Stmt> = Vec::new();
    let mut rest = before.procedures[0].body.iter().cloned().peekable();
    let mut whole = false;
    while let Some(stmt) = rest.next() {
        // From there on readers keep a program whole.
        whole |= matches!(&stmt.op, Op::SynchronisedFeed(m) if !m.back);
        piece.push(stmt);
        if rest.peek().is_none_or(|next| !next.joined && !whole) {
            let lines = Lines::from_statements(&piece);
            legaliser.run(&mut piece, &before.assumed, lines, &mut diags);
            out.append(&mut piece);
        }
    }
    legaliser.finish(&mut out, &mut diags);
    after.procedures[0].body = out;
    (!refused(&diags)).then_some(after)
}

/// Levels of block skip that occur in a program.
fn levels(program: &Program) -> Vec<u16> {
    let all = program.procedures.iter().flat_map(|p| &p.body).filter_map(|s| s.skip);
    let bits = all.fold(0u16, |bits, level| bits | 1 << level);
    if bits == 0 { vec![0] } else { vec![0, bits] }
}

fn same_events(before: &Program, after: &Program, told: &Told) -> Result<(), String> {
    for seed in [1, 2] {
        for skip in levels(before) {
            let mut world = world(seed, before, told);
            for ((tool, edge), entry) in &told.target.further_edges {
                let (edge, length) = ((i64::from(*tool), *edge), world.tool_length(*entry));
                world.tables.named_lengths.insert(edge, length);
                world.tables.named_entries.insert(edge, *entry);
            }
            let mut a = Machine::new(before, &world, skip, told);
            if told.beside {
                a.exec.compute_compensation(told.target.compensating.rules);
            }
            let on_after = if skip == 0 { 0 } else { skip | 1 << 1 };
            let mut there = world.clone();
            there.renaming = back(&told.maps);
            there.tables.edge_entries.clone_from(&told.target.edge_entries);
            there.power_on = told.maps.modes(&world.power_on);
            // Edge 1 of a tool is the entry of its number before, and another one after.
            if !told.target.edge_entries.is_empty() {
                let mut entries: BTreeMap<u32, u32> = (1..100).map(|n| (n, n)).collect();
                entries.extend(told.target.edge_entries.iter().map(|(tool, entry)| (*entry, *tool)));
                there.renaming.entries = Some(entries);
            }
            let mut b = Machine::new(after, &there, on_after, told);
            let resolution =
                Resolution { mm: 3, inch: 4, degree: 3, feed: 3, feed_inch: 4, second: 3, speed: 0 };
            let mut comparison = Comparison::new(resolution, a.exec.machine());
            comparison.rename_tools(there.renaming.tools.clone(), &there.renaming.tool_names);
            let (mut source, mut target) = (a.run()?, b.run()?);
            comparison
                .advance(&mut source, &mut target, true)
                .map_err(|d| format!("world {seed}, skip {skip:b}: {d:?}"))?;
        }
    }
    Ok(())
}

/// A world in which what the program takes for granted holds.
fn world(seed: u32, program: &Program, told: &Told) -> World {
    let usual = Modes {
        motion: Some(Motion::Traverse),
        distance: Some(Distance::Absolute),
        units: Some(Units::Mm),
        plane: Some(Plane::Xy),
        feed_mode: Some(FeedMode::PerMinute),
        return_level: Some(ReturnLevel::Retract),
        work_offset: Some(program.assumed.work_offset.unwrap_or(1)),
        length_offset: Some(0),
        no_origin_shift: Some(true),
    };
    let mut world = World::generate(seed, &usual);
    world.tables.radii.clone_from(&told.target.compensating.radii);
    if let Some(clearance) = told.target.peck_clearance.and_then(|n| n.nanos(false)) {
        world.peck_clearance = clearance;
    }
    if let Some(lift) = told.target.break_lift.and_then(|n| n.nanos(false)) {
        world.break_lift = lift;
    }
    world
}

struct Machine<'p> {
    exec: Exec,
    runner: Runner<'p>,
}

impl<'p> Machine<'p> {
    fn new(program: &'p Program, world: &World, skip: u16, told: &Told) -> Machine<'p> {
        let mut exec = Exec::new(world, skip);
        exec.assume(&program.assumed);
        exec.stand_at(&told.start);
        Machine { exec, runner: Runner::new(program) }
    }

    fn run(&mut self) -> Result<Vec<Event>, String> {
        let mut events = Vec::new();
        loop {
            match self.runner.run(&mut self.exec, usize::MAX, &mut events) {
                Ok(Progress::Done) => return Ok(events),
                Ok(Progress::More) => {}
                Err(found) => return Err(format!("not executed: {:?}", found.fault)),
            }
        }
    }
}

/// A fault of these tests would be a pass that no case is made for.
#[test]
fn every_pass_has_a_case() {
    let cases = cases();
    let alone = PASSES.iter().filter(|pass| pass.alone.is_some());
    for pass in alone.map(|pass| pass.name).chain([NUMBERS]).chain(COMPUTING) {
        assert!(cases.iter().any(|(name, _)| name == pass), "no case for {pass}");
    }
}
