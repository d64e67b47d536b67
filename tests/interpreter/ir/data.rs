//! Values put into tables: `SET_OFFSET_DATA(1, added, X 1mm)`, `SET_TOOL_DATA(3, length, 120mm)`.

use super::Control;
use super::text::Token;
use crate::interpreter::Halt;

impl Control {
    pub(super) fn offset_data(&mut self, a: &[Token]) -> Result<(), Halt> {
        let Some(Token::Number(offset, _)) = a.first() else { return self.m.halt("a work offset's number") };
        let offset = *offset as u32;
        let says = |word: &str| a.iter().any(|t| matches!(t, Token::Name(n) if n == word));
        let mut values = ["X", "Y", "Z", "A", "B", "C"].map(|axis| self.after(a, axis));
        if says("here") {
            if self.m.slots.shift() != [0.0; 6] || self.chain() != super::Frame::NONE {
                return self.m.halt("a work offset by the position, under a frame");
            }
            let length = self.shift()[2] - self.m.zero_of(self.m.offset)[2];
            for (axis, value) in values.iter_mut().enumerate() {
                let length = if axis == 2 { length } else { 0.0 };
                *value = value.map(|value| self.m.at[axis] - length - value);
            }
        }
        let turn = self.after(a, "turned");
        if says("here") && turn.unwrap_or(self.m.turn_of(offset)) != 0.0 {
            return self.m.halt("a turned work offset by the position");
        }
        match turn {
            _ if says("added") => self.m.store_zero(offset, values, true),
            None if self.m.turn_of(offset) == 0.0 => self.m.store_zero(offset, values, false),
            turn => {
                let turn = turn.unwrap_or(self.m.turn_of(offset));
                self.m.store_turned_zero(offset, values, turn);
            }
        }
        Ok(())
    }

    pub(super) fn tool_data(&mut self, a: &[Token]) -> Result<(), Halt> {
        let (Some(Token::Number(entry, _)), Some(Token::Name(which))) = (a.first(), a.get(2)) else {
            return self.m.halt("an entry, and which value of it");
        };
        let (entry, added) = (*entry as u32, matches!(a.get(4), Some(Token::Name(n)) if n == "added"));
        let Some(Token::Number(value, unit)) = a.last() else { return self.m.halt("a value") };
        let value = self.base(*value, unit);
        let wear = which.ends_with("-wear");
        match which.as_str() {
            "length" | "length-wear" => self.m.store_length(entry, value, wear, added),
            _ => {
                self.m.store_radius(entry, value, wear, added);
                Ok(())
            }
        }
    }
}
