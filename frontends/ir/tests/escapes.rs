//! Escapes of quoted texts.

use ncc_ir_text::unquote;

#[test]
fn escapes() {
    assert_eq!(unquote(r#""plain Ç""#).as_deref(), Some("plain Ç"));
    assert_eq!(unquote(r#""a \"b\" \\ \n\u{1}c""#).as_deref(), Some("a \"b\" \\ \n\u{1}c"));
    assert_eq!(unquote(r#""\q""#), None);
    assert_eq!(unquote(r#""\u{110000}""#), None);
    assert_eq!(unquote(r#""\u{41""#), None);
}
