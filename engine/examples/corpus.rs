//! Runs the corpus through the engine: a line of JSON for each request, with the code and a hash of every output. Another
//! build of the engine must print the same: `engine/compare.mjs` compares one in WebAssembly.
//!
//! ```text
//! cargo run --release -p ncc-engine --example corpus -- corpus > requests.ndjson
//! ```

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use ncc_engine::Engine;
use serde_json::json;
use sha2::{Digest, Sha256};

/// The targets of each program.
const TARGETS: [&str; 3] = ["fanuc", "siemens", "linuxcnc"];

fn main() -> io::Result<()> {
    let corpus = env::args().nth(1).unwrap_or_else(|| "corpus".to_owned());
    let mut folders: Vec<PathBuf> = entries(Path::new(&corpus))?;
    folders.retain(|folder| folder.is_dir());
    let mut out = io::stdout().lock();
    for folder in folders {
        let dialect = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if ncc_dialects::builtin(&dialect).is_none() {
            continue;
        }
        for path in entries(&folder)?.into_iter().filter(|path| path.is_file()) {
            program(&path, &dialect, &mut out)?;
        }
    }
    Ok(())
}

fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut all: Vec<PathBuf> =
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?;
    all.sort();
    Ok(all)
}

/// All requests about a program.
fn program(path: &Path, dialect: &str, out: &mut impl io::Write) -> io::Result<()> {
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = fs::read(path)?;
    let mut requests: Vec<_> = TARGETS
        .iter()
        .filter(|target| **target != dialect)
        .map(|to| json!({ "verb": "translate", "file": file, "from": dialect, "to": to }))
        .collect();
    let one = json!({ "file": file, "from": dialect });
    requests.push(json!({ "verb": "translate", "file": file, "to": "canon", "assume": true }));
    requests.push(json!({ "verb": "check", "file": file, "from": dialect }));
    requests.push(json!({ "verb": "time", "file": file, "from": dialect, "machine": "romi-discovery-4022" }));
    requests.push(json!({ "verb": "diff", "a": one, "b": one }));
    requests.push(json!({ "verb": "verify", "a": one, "b": one }));
    requests.push(json!({ "verb": "simulate", "file": file, "from": dialect, "cells": 160 }));
    for request in requests {
        let mut engine = Engine::default();
        engine.put(&file, text.clone());
        let code = engine.run(&request.to_string());
        let outputs: BTreeMap<_, _> = engine.outputs().map(|(name, bytes)| (name, hex(bytes))).collect();
        let line = json!({ "path": path, "request": request, "code": code, "outputs": outputs });
        writeln!(out, "{line}")?;
    }
    Ok(())
}

fn hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
