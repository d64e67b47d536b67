//! The test set-ups in which source and output are executed: the same machine, as each of the two controls has it.

use std::collections::BTreeMap;

use ncc_exec::named_tool;
use ncc_exec::world::World;
use ncc_ir::canon::Modes;

use super::controls::fixed;
use crate::job::Job;

/// The test set-up of a seed, for the source's control and for the target's.
pub fn worlds_of(job: &Job, seed: u32) -> [World; 2] {
    let (from, to) = (fixed(job.from.dialect), fixed(job.to.dialect));
    let renaming = job.renaming();
    let own_entries = match (&renaming.tools, &job.machines.from) {
        (Some(_), Some(machine)) => machine.tables().edge_entries,
        (None, _) | (_, None) => BTreeMap::new(),
    };
    let mut source = World::generate(seed, &from).with_external();
    source.behaviours = job.source_behaviours();
    source.feed_ends_with_mode = job.from.dialect.can.feed_ends_with_mode;
    source.cycles_need_spindle = job.from.dialect.can.cycles_need_spindle;
    source.compensation_again = job.from.dialect.caps.compensation.again;
    source.looks_over_blocks = job.looks_over_blocks();
    source.arcs = job.from.arc_rule();
    source.refused_compensated = job.from.dialect.caps.compensation.refused;
    source.tables.edge_entries = own_entries;
    source.tables.radii = job.compensating().radii;
    source.increments = job.from.fine_increments();
    let mut target = World::generate(seed, &to).with_external();
    target.increments = job.to.fine_increments();
    target.behaviours = job.target_behaviours();
    target.feed_ends_with_mode = job.to.dialect.can.feed_ends_with_mode;
    target.cycles_need_spindle = job.to.dialect.can.cycles_need_spindle;
    // Between two controls ncc refuses it. Other output is read by the source's rule.
    target.compensation_again = source.compensation_again;
    target.arcs = job.to.arc_rule();
    target.refused_compensated = job.to.dialect.caps.compensation.refused;
    target.tables.edge_entries.clone_from(&renaming.edge_entries);
    target.renaming = renaming;
    // If one side changes tools by hand, the operator sets the zero of Z for each tool.
    source.zeroed_by_tool = job.from.dialect.can.change_by_hand || job.to.dialect.can.change_by_hand;
    target.zeroed_by_tool = source.zeroed_by_tool;
    let named = &target.renaming.tool_names;
    let first = named.iter().map(|(n, name)| ((named_tool(name), 1), target.edge_entry(*n)));
    let further = job.further_edges.iter().map(|edge| ((edge.in_source(), edge.edge), edge.entry));
    let entries: Vec<((i64, u32), u32)> = first.chain(further).collect();
    let tables = &mut source.tables;
    tables.named_lengths = entries.iter().map(|(edge, entry)| (*edge, target.tool_length(*entry))).collect();
    tables.named_entries = entries.iter().map(|(edge, entry)| (*edge, target.entry_number(*entry))).collect();
    // A control without a path mode code has one path mode.
    let caps = &job.to.dialect.caps;
    let path = caps.modes.only_path.filter(|mode| !caps.says_path(*mode));
    (source.path, target.path) = (path, path);
    same_at_power_on(&source, &mut target, &from, &to);
    [source, target]
}

/// Modes that neither program sets keep their power-on value. Where numbers differ, the target's work offset and
/// length entry at power-on get numbers that no program uses.
fn same_at_power_on(source: &World, target: &mut World, from: &Modes, to: &Modes) {
    if let (Some(map), Some(own), None, None) =
        (&mut target.renaming.offsets, source.power_on.work_offset, from.work_offset, to.work_offset)
    {
        map.insert(u16::MAX, own);
        target.power_on.work_offset = Some(u16::MAX);
    }
    if let (Some(map), Some(own), None, None) =
        (&mut target.renaming.entries, source.power_on.length_offset, from.length_offset, to.length_offset)
    {
        map.insert(u32::MAX, own);
        target.power_on.length_offset = Some(u32::MAX);
    }
}
