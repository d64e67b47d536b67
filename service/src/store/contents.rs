//! Bytes, kept once whoever has them, by their SHA-256.
//!
//! They come and go in pieces, so that a large program is never in memory as a whole. Without its digest a content is being
//! received; what has been left so for a day is thrown away when the store is opened.

use sha2::{Digest, Sha256};

use super::documents::now;
use super::session::{Session, values};
use super::{Store, StoreError, hex};

/// Bytes of a piece at most.
pub(crate) const PIECE: usize = 1 << 20;

/// Time limit of the reception of a content, seconds.
const DAY: i64 = 86_400;

/// A content that is there as a whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Content {
    pub(super) id: i64,
    /// SHA-256 in hexadecimal digits.
    pub(crate) sha256: String,
    /// Its length.
    pub(crate) bytes: u64,
}

/// A content that is being received.
#[derive(Debug, Default)]
pub(crate) struct Receiving {
    id: Option<i64>,
    pieces: u32,
    bytes: u64,
    digest: Sha256,
    /// Bytes that are not written yet.
    rest: Vec<u8>,
}

impl Receiving {
    /// Bytes so far.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Row of the pieces that are written so far.
    pub(crate) fn aside(&self) -> Option<i64> {
        self.id
    }

    /// Takes bytes, and says whether a piece is full: then [`Store::put_aside`] is called.
    pub(crate) fn take(&mut self, bytes: &[u8]) -> bool {
        self.digest.update(bytes);
        self.bytes += bytes.len() as u64;
        self.rest.extend_from_slice(bytes);
        self.rest.len() >= PIECE
    }
}

impl Store {
    /// Writes the whole pieces of what has been received.
    pub(crate) fn put_aside(&self, receiving: &mut Receiving) -> Result<(), StoreError> {
        let whole = receiving.rest.len() / PIECE * PIECE;
        self.database.write(|to| write(to, receiving, whole))
    }

    /// Throws away what has been written of a content that is not wanted ([`Receiving::aside`]).
    pub(crate) fn forget(&self, aside: Option<i64>) -> Result<(), StoreError> {
        let Some(id) = aside else { return Ok(()) };
        self.database.write(|to| {
            to.change("DELETE FROM content WHERE id = $1 AND sha256 IS NULL", values![id])?;
            Ok(())
        })
    }

    /// A piece of a content, or none behind the last one.
    pub(crate) fn piece(&self, content: &Content, number: u32) -> Result<Option<Vec<u8>>, StoreError> {
        self.database.read(|from| {
            let piece = from.maybe_row(
                "SELECT bytes FROM content_piece WHERE content = $1 AND number = $2",
                values![content.id, number],
            )?;
            piece.map(|mut row| row.bytes(0)).transpose()
        })
    }

    /// A content as a whole.
    pub(crate) fn whole(&self, content: &Content) -> Result<Vec<u8>, StoreError> {
        let mut whole = Vec::with_capacity(usize::try_from(content.bytes).unwrap_or_default());
        // One after the other: all pieces at once would be in memory besides the whole.
        let mut number = 0;
        while (whole.len() as u64) < content.bytes {
            let lost = || StoreError::Database(format!("piece {number} of a content is lost"));
            whole.extend_from_slice(&self.piece(content, number)?.ok_or_else(lost)?);
            number += 1;
        }
        Ok(whole)
    }

    /// Throws away what was never received as a whole.
    pub(super) fn tidy(&self) -> Result<(), StoreError> {
        let before = now() - DAY;
        self.database.write(|to| {
            to.change("DELETE FROM content WHERE sha256 IS NULL AND begun < $1", values![before])?;
            Ok(())
        })
    }
}

/// Writes so many of the bytes that have been received. All pieces but the last are full, so that a byte is found by its number.
fn write(to: &dyn Session, receiving: &mut Receiving, bytes: usize) -> Result<(), StoreError> {
    let id = match receiving.id {
        Some(id) => id,
        None => to
            .row(
                "INSERT INTO content (sha256, bytes, begun) VALUES (NULL, 0, $1) RETURNING id",
                values![now()],
            )?
            .int(0)?,
    };
    let mut pieces = receiving.pieces;
    for bytes in receiving.rest[..bytes].chunks(PIECE) {
        to.change(
            "INSERT INTO content_piece (content, number, bytes) VALUES ($1, $2, $3)",
            values![id, pieces, bytes],
        )?;
        pieces += 1;
    }
    (receiving.id, receiving.pieces) = (Some(id), pieces);
    receiving.rest.drain(..bytes);
    Ok(())
}

/// The content that has been received: the one that is there already, or else this one.
pub(super) fn settle(to: &dyn Session, mut receiving: Receiving) -> Result<Content, StoreError> {
    let sha256 = hex(&std::mem::take(&mut receiving.digest).finalize());
    let there = to.maybe_row("SELECT id FROM content WHERE sha256 = $1", values![&sha256])?;
    let bytes = receiving.bytes;
    if let Some(mut there) = there {
        let id = there.int(0)?;
        if let Some(own) = receiving.id {
            to.change("DELETE FROM content WHERE id = $1", values![own])?;
        }
        return Ok(Content { id, sha256, bytes });
    }
    let rest = receiving.rest.len();
    write(to, &mut receiving, rest)?;
    // It has been thrown away if it took longer than a day.
    let id = receiving.id.ok_or(StoreError::Absent)?;
    let length = i64::try_from(bytes).unwrap_or(i64::MAX);
    let known =
        to.change("UPDATE content SET sha256 = $1, bytes = $2 WHERE id = $3", values![&sha256, length, id])?;
    if known == 1 { Ok(Content { id, sha256, bytes }) } else { Err(StoreError::Absent) }
}
