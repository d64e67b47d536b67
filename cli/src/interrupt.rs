//! Ctrl-C, and what else asks a process to end: the run says where the program was, nothing is written, and the exit
//! code is 130.
//!
//! A run of a program stops by itself ([`ncc_exec::halt`]), and so does the reading of a source (`chunks`). What takes
//! long besides is ended after `GRACE`, but never while a file is being put in its place.

use std::io::{self, Write};
use std::sync::{RwLock, RwLockReadGuard};
use std::time::Duration;

use ncc_driver::problem::Exit;
use ncc_driver::source::halted::heed;
use ncc_exec::halt;

/// How long work that does not look at the request may go on.
const GRACE: Duration = Duration::from_millis(1500);

/// Held by what puts files in their places, and by the end of the process.
static PLACING: RwLock<()> = RwLock::new(());

/// Has the signals of this process answered from now on. Where that cannot be, they end it as they always do.
pub fn listen() {
    let _ = ctrlc::set_handler(|| {
        halt::ask();
        std::thread::sleep(GRACE);
        // One that died while it held the lock is over as well.
        let _placing = PLACING.write();
        let _ = writeln!(io::stderr(), "error: interrupted; no file is half written");
        std::process::exit(i32::from(Exit::Interrupted as u8));
    });
}

/// Lets a file be put in its place: the process does not end before the guard is gone.
///
/// # Errors
/// The process is to stop: nothing may be written any more.
pub(crate) fn placing() -> io::Result<RwLockReadGuard<'static, ()>> {
    let guard = PLACING.read().unwrap_or_else(|broken| broken.into_inner());
    heed(None)?;
    Ok(guard)
}
