//! Five C functions: the engine of a host that shares memory with it, such as a page with WebAssembly.
//!
//! | function | does |
//! |---|---|
//! | [`ncc_alloc`] | memory of so many bytes, for the host to fill |
//! | [`ncc_put`] | a file: its name and its bytes |
//! | [`ncc_run`] | a request; gives the code |
//! | [`ncc_back`] | an output by its number; 0 is the list of the others, as JSON |
//! | [`ncc_clear`] | lets go of all files and outputs |
//!
//! There is one engine for each thread of the host. Memory that was handed over by [`ncc_put`] or [`ncc_run`] is the
//! engine's; memory that [`ncc_back`] points at holds until the next call but that one.

use std::cell::RefCell;

use crate::Engine;

thread_local! {
    static ENGINE: RefCell<State> = RefCell::default();
}

#[derive(Default)]
struct State {
    engine: Engine,
    /// Names and lengths of the outputs.
    list: Vec<u8>,
}

/// Memory of so many bytes, for the host to fill and to hand over.
#[unsafe(no_mangle)]
pub extern "C" fn ncc_alloc(bytes: usize) -> *mut u8 {
    Box::into_raw(vec![0_u8; bytes].into_boxed_slice()).cast()
}

/// Takes back memory that the host has filled.
///
/// # Safety
/// `at` is from [`ncc_alloc`] with the same `bytes`, and was not handed over before.
unsafe fn taken(at: *mut u8, bytes: usize) -> Vec<u8> {
    // SAFETY: as the caller promises, this is a boxed slice of this length that nobody else has.
    unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(at, bytes)) }.into_vec()
}

/// Keeps a file. Both pieces of memory are the engine's from then on.
///
/// # Safety
/// Both are from [`ncc_alloc`] with these lengths, and were not handed over before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ncc_put(name: *mut u8, name_bytes: usize, at: *mut u8, bytes: usize) {
    // SAFETY: as of this function.
    let (name, text) = unsafe { (taken(name, name_bytes), taken(at, bytes)) };
    ENGINE.with_borrow_mut(|state| state.engine.put(&String::from_utf8_lossy(&name), text));
}

/// Does a request; gives the code. The memory is the engine's from then on.
///
/// # Safety
/// It is from [`ncc_alloc`] with this length, and was not handed over before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ncc_run(at: *mut u8, bytes: usize) -> u32 {
    // SAFETY: as of this function.
    let request = unsafe { taken(at, bytes) };
    ENGINE.with_borrow_mut(|state| {
        let code = state.engine.run(&String::from_utf8_lossy(&request));
        let list: Vec<_> = state.engine.outputs().map(|(name, bytes)| (name, bytes.len())).collect();
        state.list = serde_json::to_vec(&list).unwrap_or_default();
        u32::from(code)
    })
}

/// Where an output is, and into `bytes` how long it is; null if there is none of that number. Number 0 is the list of
/// the others, pairs of name and length as JSON.
///
/// # Safety
/// `bytes` points at a `usize` that may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ncc_back(number: usize, bytes: *mut usize) -> *const u8 {
    ENGINE.with_borrow(|state| {
        let found = match number {
            0 => Some(state.list.as_slice()),
            number => state.engine.outputs().nth(number - 1).map(|(_, bytes)| bytes),
        };
        // SAFETY: as of this function.
        unsafe { bytes.write(found.map_or(0, <[u8]>::len)) };
        found.map_or(std::ptr::null(), <[u8]>::as_ptr)
    })
}

/// Lets go of all files and outputs.
#[unsafe(no_mangle)]
pub extern "C" fn ncc_clear() {
    ENGINE.with_borrow_mut(|state| *state = State::default());
}
