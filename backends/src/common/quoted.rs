//! Texts in quotation marks, and numbers, as `canon` and `ir` write them.

use ncc_ir::expr::num::Num;

/// Writes a text between quotation marks; gives back whether a character had to be written
/// otherwise: `"`, `\` and control characters are.
pub(crate) fn quote(text: &str, out: &mut Vec<u8>) -> bool {
    let mut changed = false;
    out.push(b'"');
    for c in text.chars() {
        let escape: &[u8] = match c {
            '"' => b"\\\"",
            '\\' => b"\\\\",
            '\n' => b"\\n",
            '\r' => b"\\r",
            '\t' => b"\\t",
            // The line and paragraph separators end a line for some readers.
            c if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') => {
                out.extend_from_slice(format!("\\u{{{:x}}}", u32::from(c)).as_bytes());
                changed = true;
                continue;
            }
            c => {
                out.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
                continue;
            }
        };
        out.extend_from_slice(escape);
        changed = true;
    }
    out.push(b'"');
    changed
}

/// Writes a whole number.
#[inline]
pub(crate) fn write_whole(mut value: u64, out: &mut Vec<u8>) {
    let mut digits = [0u8; 20];
    let mut at = digits.len();
    loop {
        at -= 1;
        digits[at] = b'0' + (value % 10) as u8;
        value /= 10;
        if value == 0 {
            break;
        }
    }
    out.extend_from_slice(&digits[at..]);
}

/// Writes a decimal with its digits, and its point if it has one; the unit is the caller's.
#[inline]
pub(crate) fn decimal(n: Num, out: &mut Vec<u8>) {
    if n.mantissa < 0 {
        out.push(b'-');
    }
    let mut value = n.mantissa.unsigned_abs();
    if !n.point {
        return write_whole(value, out);
    }
    // 20 digits at most, as many zeros as the scale asks for, and the point.
    let scale = usize::from(n.scale.min(18));
    let mut digits = [b'0'; 40];
    let mut at = digits.len();
    for _ in 0..scale {
        at -= 1;
        digits[at] = b'0' + (value % 10) as u8;
        value /= 10;
    }
    at -= 1;
    digits[at] = b'.';
    loop {
        at -= 1;
        digits[at] = b'0' + (value % 10) as u8;
        value /= 10;
        if value == 0 {
            break;
        }
    }
    out.extend_from_slice(&digits[at..]);
}

#[cfg(test)]
mod tests {
    use ncc_ir::expr::num::{Num, Unit};

    fn written(mantissa: i64, scale: u8, point: bool) -> String {
        let mut out = Vec::new();
        super::decimal(Num { mantissa, scale, point, unit: Unit::One }, &mut out);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn decimals_keep_their_digits() {
        assert_eq!(written(0, 0, false), "0");
        assert_eq!(written(0, 0, true), "0.");
        assert_eq!(written(0, 2, true), "0.00");
        assert_eq!(written(-5, 1, true), "-0.5");
        assert_eq!(written(-15, 0, true), "-15.");
        assert_eq!(written(15588, 3, true), "15.588");
        assert_eq!(written(1, 18, true), "0.000000000000000001");
        assert_eq!(written(i64::MIN, 0, false), "-9223372036854775808");
        assert_eq!(written(i64::MIN, 18, true), "-9.223372036854775808");
    }

    #[test]
    fn quotes_and_control_characters_are_escaped() {
        let mut out = Vec::new();
        assert!(!super::quote("FURAÇÃO 3mm :", &mut out));
        assert!(super::quote("a \"b\"\\\n\u{1}", &mut out));
        assert_eq!(String::from_utf8(out).unwrap(), r#""FURAÇÃO 3mm :""a \"b\"\\\n\u{1}""#);
    }
}
