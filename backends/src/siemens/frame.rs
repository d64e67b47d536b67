//! Emits the words of frames, and of moves in machine coordinates.
//!
//! ```text
//! FrameStep::Rotate { XY, 30° }, added      AROT RPL=30
//! FrameStep::Translate without a value      TRANS            clears the chain of frames
//! ```
//!
//! Each word of a frame has a block of its own. The words are in the dictionary. Not here: which frames the target
//! accepts (`frames` in the passes).

use ncc_dialects::{Dialect, FrameWord, Meaning, NameMeaning, NameRole, NameRow, Quantity};
use ncc_ir::canon::Axis;
use ncc_ir::diag::Fault;
use ncc_ir::lack::{FramesLack, MachineLack};
use ncc_ir::program::{Frame, FrameStep};
use ncc_ir::source::Span;

use super::{Sink, Writer};
use crate::common::block::{Need, Rank};
use crate::common::fault::cannot;
use crate::common::setting::Inserted;

/// Axes that can be scaled and mirrored.
const LINEAR: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

impl Writer {
    fn frame_word(&self, added: bool, word: FrameWord) -> Result<&'static str, Fault> {
        let meaning = if added { NameMeaning::AddFrame(word) } else { NameMeaning::SetFrame(word) };
        let row = self.dialect.name_for(meaning).ok_or_else(|| cannot(FramesLack::Frame))?;
        Ok(&row.name)
    }

    /// Clears the chain of frames.
    pub(super) fn clear_frames(&mut self, sink: &mut Sink) -> Result<(), Fault> {
        let word = self.frame_word(false, FrameWord::Translate)?;
        self.alone(word, sink)
    }

    /// One frame: it replaces the chain, or is added to it.
    pub(super) fn frame(&mut self, frame: &Frame, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let (word, values) = match &frame.step {
            FrameStep::Translate(words) => {
                let mut values = Vec::new();
                for (axis, value) in Axis::ALL.into_iter().zip(words.iter()) {
                    if let Some(value) = value {
                        let name = (axis.letter() as char).to_string();
                        let quantity = if axis.is_rotary() { Quantity::Angle } else { Quantity::Length };
                        let letter = self.letter(&name, quantity);
                        values.push(self.lettered(&name, &letter, value, span, sink)?);
                    }
                }
                (FrameWord::Translate, values)
            }
            FrameStep::Rotate { plane, angle } => {
                let row = self.dialect.name_with(NameRole::PlaneAngle);
                let row = row.ok_or_else(|| cannot(FramesLack::Rotation))?;
                let mut inserted = Inserted::default();
                self.words.need_plane(*plane, &mut inserted)?;
                self.words.admit_with(Need::new(Rank::Setting), inserted, sink)?;
                let letter = self.letter(&row.name, row.quantity.unwrap_or(Quantity::Angle));
                let angle = self.value(&letter, angle, span, sink)?;
                (FrameWord::Rotate, vec![format!("{}={angle}", row.name)])
            }
            FrameStep::Scale(words) => {
                let mut values = Vec::new();
                for (axis, value) in LINEAR.into_iter().zip(words.iter()) {
                    if let Some(value) = value {
                        let name = (axis.letter() as char).to_string();
                        let letter = self.letter(&name, Quantity::Factor);
                        values.push(self.lettered(&name, &letter, value, span, sink)?);
                    }
                }
                (FrameWord::Scale, values)
            }
            FrameStep::Mirror(axes) => {
                let mirrored = LINEAR.into_iter().zip(axes).filter(|(_, mirrored)| **mirrored);
                let values = mirrored.map(|(axis, _)| format!("{}0", axis.letter() as char)).collect();
                (FrameWord::Mirror, values)
            }
        };
        match (values.is_empty(), frame.added) {
            // Each of these words without a value clears the chain.
            (true, true) => Ok(()),
            (true, false) => self.clear_frames(sink),
            (false, added) => {
                let word = self.frame_word(added, word)?;
                self.alone(&format!("{word} {}", values.join(" ")), sink)
            }
        }
    }

    /// The next move is in machine coordinates. `length`: the tool length counts in them.
    pub(super) fn in_machine(&mut self, length: bool) -> Result<(), Fault> {
        if machine_row(self.dialect, length).is_none() {
            return Err(cannot(match length {
                true => MachineLack::WithToolLength,
                false => MachineLack::CoordinatesWithoutLength,
            }));
        }
        self.raw = true;
        Ok(())
    }

    /// The word of a move in machine coordinates. A dictionary has one such word: with the tool length, or without.
    pub(super) fn machine_word(&self) -> Result<&'static str, Fault> {
        let row = [true, false].into_iter().find_map(|length| machine_row(self.dialect, length));
        Ok(&row.ok_or_else(|| cannot(MachineLack::CoordinatesCode))?.name)
    }
}

/// The row of the word for machine coordinates. `length`: the tool length counts in them.
fn machine_row(dialect: &'static Dialect, length: bool) -> Option<&'static NameRow> {
    dialect.name_for(NameMeaning::Code(Meaning::UseMachineCoordinates { length, rapid: false }))
}
