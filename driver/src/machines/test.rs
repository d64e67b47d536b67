//! `ncc machines test`: programs written for a machine, and read back.
//!
//! The form and the sense of a profile have been checked when it was read. Here a small program is
//! translated for the machine, verified, and translated once more from the machine to itself.

use std::io::Cursor;
use std::sync::Arc;

use codespan_reporting::term::termcolor::Buffer;
use ncc_backends::Layout;
use ncc_dialects::{Settings, builtin};
use ncc_machines::Profile;
use ncc_machines::reading::Side;

use super::machine;
use super::pair::Machines;
use crate::job::Job;
use crate::questions::Policy;
use crate::render::About;
use crate::render::messages::message::Message;
use crate::render::{Loudness, human};
use crate::translate::translate;

/// What most programs have.
const SAMPLE: &str = include_str!("sample.ir");

/// What was tested, for people, and whether all of it passed.
pub fn test(profile: &Profile) -> (String, bool) {
    let mut text = super::show::headline(profile);
    let mut passed = true;
    let form = machine("passed").text("what", machine("form").headline());
    text.push_str(&format!("  {}\n", form.headline()));
    let mut report = |what: &Message, result: Result<u64, String>| {
        let what = what.headline();
        let line = match &result {
            Ok(events) => machine("passed-events").text("events", events.to_string()),
            Err(_) => machine("failed"),
        };
        text.push_str(&format!("  {}\n", line.text("what", what).headline()));
        if let Err(why) = result {
            passed = false;
            why.lines().for_each(|line| text.push_str(&format!("          {line}\n")));
        }
    };
    let to = Machines { from: None, to: Some(Arc::new(profile.clone())) };
    let Some(ir) = builtin("ir") else { return (text, false) };
    let written = translated(SAMPLE, Settings::new(ir), to.clone());
    report(&machine("sample"), written.as_ref().map(|(events, _)| *events).map_err(Clone::clone));
    if let Ok((_, written)) = written {
        // The sample's numbers are of this machine already.
        let own = Machines { from: Some(Arc::new(ncc_machines::nameless(profile))), to: to.to.clone() };
        let again = translated(&written, profile.settings(), own);
        report(&machine("itself"), again.map(|(events, _)| events));
    }
    let codes: Vec<(&str, &str)> = functions(profile).collect();
    if !codes.is_empty() {
        let wanted: String = codes.iter().map(|(_, name)| format!("MACHINE_FUNCTION({name:?})\n")).collect();
        let sample = SAMPLE.replace("SET_SPINDLE_SPEED", &format!("{wanted}SET_SPINDLE_SPEED"));
        let written = translated(&sample, Settings::new(ir), to);
        let each = written.and_then(|(events, text)| {
            let stands = |code: &str| text.lines().any(|line| line.split(' ').next_back() == Some(code));
            match codes.iter().find(|(code, _)| !stands(code)) {
                Some((code, name)) => {
                    Err(machine("not-written").text("name", *name).text("code", *code).headline())
                }
                None => Ok(events),
            }
        });
        report(&machine("codes").text("number", codes.len().to_string()), each);
    }
    let other = ncc_machines::counterpart(profile, ir);
    let (tools, offsets) = (other.schema.tool.len(), other.schema.work_offset.len());
    if tools + offsets > 0 {
        let machines = Machines { from: Some(Arc::new(other)), to: Some(Arc::new(profile.clone())) };
        let written = translated(&of_names(tools, offsets), Settings::new(ir), machines);
        let form = match (tools, offsets) {
            (_, 0) => "tools",
            (0, _) => "offsets",
            (_, _) => "tools-and-offsets",
        };
        let what = machine(form).count("tools", tools as u64).count("offsets", offsets as u64);
        report(&what, written.map(|(events, _)| events));
    }
    (text, passed)
}

/// A program that uses so many tools and work offsets, numbered from 1.
fn of_names(tools: usize, offsets: usize) -> String {
    let mut used: String = (1..=tools)
        .map(|n| {
            format!(
                "SELECT_TOOL({n}) & CHANGE_TOOL()\nUSE_TOOL_LENGTH_OFFSET({n}) & said STRAIGHT_TRAVERSE(Z {n}.mm)\n"
            )
        })
        .collect();
    used.extend(
        (1..=offsets)
            .map(|n| format!("SET_ORIGIN_OFFSETS({n})\nsaid STRAIGHT_TRAVERSE(X {n}.mm, Y 0.mm, Z 50.mm)\n")),
    );
    let without = |line: &&str| {
        let tool = line.contains("SELECT_TOOL") || line.contains("USE_TOOL_LENGTH_OFFSET");
        !(tools > 0 && tool || offsets > 0 && line.contains("SET_ORIGIN_OFFSETS"))
    };
    let mut text = String::new();
    for line in SAMPLE.lines().filter(without) {
        // Where tools or zeros have no names, the sample's own stay.
        if line.starts_with("SET_SPINDLE_SPEED") {
            text.push_str(&used);
        }
        text.push_str(line);
        text.push('\n');
    }
    text
}

/// The M codes of the machine with their functions.
fn functions(profile: &Profile) -> impl Iterator<Item = (&str, &str)> {
    let rows = profile.schema.m_code.iter().map(|row| row.get_ref());
    rows.filter_map(|row| Some((row.code.value.as_deref()?, row.function.value.as_deref()?)))
}

/// Translates a text for the target machine; gives the number of events and the text, or what is
/// wrong.
fn translated(text: &str, from: Settings, machines: Machines) -> Result<(u64, String), String> {
    let Some(to) = &machines.to else { return Err("no machine".to_owned()) };
    let to = machines.settings(Side::To, to.dialect);
    let layout = Layout { numbering: machines.numbering(), crlf: false };
    let job = Job { machines, layout, head: false, questions: Policy::Skip, ..Job::new(from, to, "sample") };
    let cannot = |error: std::io::Error| error.to_string();
    let mut outcome = translate(&job, &mut std::io::Cursor::new(text.as_bytes())).map_err(cannot)?;
    if outcome.release.is_err() {
        let mut source = Cursor::new(text.as_bytes());
        let mut about = About { job: &job, name: "sample", source: &mut source };
        let mut told = Buffer::no_color();
        human::print(&mut told, &mut about, &outcome.diagnostics, Loudness::Quiet).map_err(cannot)?;
        return Err(String::from_utf8_lossy(told.as_slice()).into_owned());
    }
    let events = outcome.verified.map_or(0, |v| v.events);
    let written = outcome.output.to_vec().map_err(cannot)?;
    let written = match String::from_utf8(written) {
        Ok(text) => text,
        Err(error) => error.into_bytes().iter().map(|b| char::from(*b)).collect(),
    };
    Ok((events, written))
}
