//! Lines of one shape, which have the same rows: a long program has a few shapes, and each of them many times.
//!
//! ```text
//! X0.148 Y-99.8    the shape X0.0 Y-0.0: letters, signs and points as they stand, each number of a word as one 0
//! G1 X5. F100      the shape G1 X0. F0: the number of a code says which it is
//! ```
//!
//! Only lines of words that begin behind a blank have one, each of a capital and a number: of a name, its digits are part.
//! Longer numbers than the lexers may take at once are left to these.
//!
//! Not here: which rows a line has (`rows`).

/// Bytes of the longest shape.
const LONGEST: usize = 48;

/// Most digits one behind the other.
const DIGITS: usize = 7;

/// How many shapes are kept.
const KEPT: usize = 64;

/// The shape of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    bytes: [u8; LONGEST],
    len: usize,
    hash: usize,
}

impl Shape {
    /// The shape of a line, if it has one.
    pub(super) fn of(line: &[u8]) -> Option<Shape> {
        let mut shape = Shape { bytes: [0; LONGEST], len: 0, hash: 0 };
        let (mut before, mut digits, mut code) = (b' ', 0, false);
        for &byte in line {
            let shown = match byte {
                b'0'..=b'9' => {
                    digits += 1;
                    if digits > DIGITS {
                        return None;
                    }
                    let same = digits > 1 && !code;
                    before = byte;
                    if same {
                        continue;
                    }
                    if code { byte } else { b'0' }
                }
                b'A'..=b'Z' if before == b' ' => {
                    code = matches!(byte, b'G' | b'M');
                    byte
                }
                b'.' | b'-' | b' ' | b'\r' | b'\n' => byte,
                _ => return None,
            };
            if !byte.is_ascii_digit() {
                (before, digits) = (byte, 0);
            }
            *shape.bytes.get_mut(shape.len)? = shown;
            shape.len += 1;
            shape.hash = shape.hash.wrapping_mul(31).wrapping_add(usize::from(shown));
        }
        Some(shape)
    }
}

/// Rows of shapes that were met.
#[derive(Debug)]
pub(super) struct Shapes {
    kept: Vec<Option<(Shape, Vec<usize>)>>,
}

impl Shapes {
    pub(super) fn new() -> Shapes {
        Shapes { kept: vec![None; KEPT] }
    }

    /// The rows of a shape, if it is known.
    pub(super) fn rows(&self, shape: &Shape) -> Option<&[usize]> {
        let (known, rows) = self.kept.get(shape.hash % KEPT)?.as_ref()?;
        (known == shape).then_some(rows.as_slice())
    }

    /// Keeps the rows of a shape, in the place of another one.
    pub(super) fn keep(&mut self, shape: Shape, rows: &[usize]) {
        if let Some(kept) = self.kept.get_mut(shape.hash % KEPT) {
            *kept = Some((shape, rows.to_vec()));
        }
    }
}
