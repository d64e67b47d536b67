//! A text that is there as a whole, cut into pieces of whole lines, so that what is read of it can be taken in between.

use std::ops::Range;

use ncc_ir::program::Stmt;

/// After how many bytes, and what is done with the statements there, of which so many are settled.
pub type Shown<'s> = (usize, &'s mut dyn FnMut(&mut Vec<Stmt>, usize));

/// The pieces of a text: of so many bytes, or as many as the last line needs.
pub(crate) fn pieces(text: &[u8], bytes: usize) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut from = 0;
    std::iter::from_fn(move || {
        let rest = text.get(from..).filter(|rest| !rest.is_empty())?;
        let least = rest.len().min(bytes);
        let end = memchr::memchr(b'\n', &rest[least..]).map_or(rest.len(), |at| least + at + 1);
        let piece = from..from + end;
        from = piece.end;
        Some(piece)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_the_text_cut_at_line_ends() {
        for text in [String::new(), "X1\n".into(), "X1\n".repeat(200), "X1\n".repeat(90) + "X2"] {
            let cut: Vec<_> = pieces(text.as_bytes(), 100).collect();
            assert!(cut.iter().all(|piece| piece.end == text.len() || text[..piece.end].ends_with('\n')));
            assert_eq!(cut.iter().map(|piece| &text[piece.clone()]).collect::<String>(), text);
            assert!(cut.iter().all(|piece| piece.len() < 104));
        }
    }
}
