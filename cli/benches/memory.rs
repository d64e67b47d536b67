//! Peak memory and speed of the finished program on long files: `cargo bench --bench memory`.
//!
//! Each row is a process of its own, translating a file of 50 MB, then of 500 MB (`NCC_MEMORY_MB`
//! names other sizes, with commas). The peak is read from the running process (Linux only).

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

mod workload;
use workload::Workload;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sizes = std::env::var("NCC_MEMORY_MB").unwrap_or_else(|_| "50,500".to_owned());
    let folder = tempfile::tempdir()?;
    let mut report = std::io::stdout().lock();
    writeln!(report, "{:<12} {:>6} {:>9} {:>11}  exit", "workload", "MB", "MB/s", "peak MiB")?;
    for size in sizes.split(',') {
        let megabytes: u64 = size.trim().parse()?;
        for kind in Workload::ALL {
            let source = folder.path().join("source.nc");
            let mut file = BufWriter::new(File::create(&source)?);
            kind.write(megabytes * 1_000_000, &mut file)?;
            file.flush()?;
            let start = Instant::now();
            let mut child = Command::new(env!("CARGO_BIN_EXE_ncc"))
                .args(["translate", "--from", "fanuc", "--to", "fanuc", "--quiet", "-o"])
                .arg(folder.path().join("output.nc"))
                .arg(&source)
                .stdout(Stdio::null())
                .spawn()?;
            let mut peak = 0;
            let status = loop {
                peak = peak.max(peak_kib(child.id()).unwrap_or(0));
                if let Some(status) = child.try_wait()? {
                    break status;
                }
                std::thread::sleep(Duration::from_millis(5));
            };
            let speed = megabytes as f64 / start.elapsed().as_secs_f64();
            let code = status.code().unwrap_or(-1);
            writeln!(
                report,
                "{:<12} {megabytes:>6} {speed:>9.1} {:>11.1}  {code}",
                kind,
                peak as f64 / 1024.0
            )?;
        }
    }
    Ok(())
}

/// High-water mark of a running process' memory, in KiB.
fn peak_kib(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}
