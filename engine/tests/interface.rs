//! The C interface, as a host goes through it.
#![expect(unsafe_code, reason = "memory crosses the interface")]

use ncc_engine::interface::{ncc_alloc, ncc_back, ncc_clear, ncc_put, ncc_run};

/// Memory of the engine with this text.
fn filled(text: &[u8]) -> (*mut u8, usize) {
    let at = ncc_alloc(text.len());
    // SAFETY: the engine has just made so much room.
    unsafe { at.copy_from_nonoverlapping(text.as_ptr(), text.len()) };
    (at, text.len())
}

/// An output by its number; `None` if there is none.
fn back(number: usize) -> Option<String> {
    let mut bytes = 0;
    // SAFETY: `bytes` may be written, and nothing is called before the text is copied.
    let text = unsafe {
        let at = ncc_back(number, &mut bytes);
        (!at.is_null()).then(|| std::slice::from_raw_parts(at, bytes).to_vec())
    };
    text.map(|text| String::from_utf8_lossy(&text).into_owned())
}

#[test]
fn a_file_goes_in_and_outputs_come_back() {
    let request = br#"{ "verb": "translate", "file": "part.nc", "from": "haas", "to": "siemens" }"#;
    let ((name, name_bytes), (at, bytes)) =
        (filled(b"part.nc"), filled(b"G21 G90 G17 G40\nG00 Z50.\nG00 X10. Y5.\nM30\n"));
    // SAFETY: all is memory of the engine, with its lengths, and handed over once.
    let run = |request: &[u8]| unsafe {
        let (at, bytes) = filled(request);
        ncc_run(at, bytes)
    };
    // SAFETY: as above.
    unsafe { ncc_put(name, name_bytes, at, bytes) };
    assert_eq!(run(request), 0);
    let list = back(0).unwrap_or_default();
    assert!(list.starts_with(r#"[["output","#), "{list}");
    assert!(back(1).is_some_and(|text| text.ends_with("M30\n")));
    assert!(back(3).is_some_and(|text| text.contains("verified")));
    assert_eq!(back(4), None);
    // No text at all is a request as well, which is refused.
    assert_eq!(run(b""), 2);
    ncc_clear();
    assert_eq!(run(request), 4);
}
