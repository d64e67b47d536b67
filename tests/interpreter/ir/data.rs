//! Values put into tables: `SET_OFFSET_DATA(1, added, X 1mm)`, `SET_TOOL_DATA(3, length, 120mm)`.

use super::Control;
use super::text::Token;
use crate::Halt;

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
        if a.iter().any(|t| matches!(t, Token::Name(n) if n == "kept")) {
            self.hold_entry(entry);
        }
        match which.as_str() {
            "x-offset" | "y-offset" if added => self.m.halt("an offset along X or Y that is added"),
            "x-offset" => {
                self.m.store_aside(entry, [Some(value), None]);
                Ok(())
            }
            "y-offset" => {
                self.m.store_aside(entry, [None, Some(value)]);
                Ok(())
            }
            "length" | "length-wear" => self.m.store_length(entry, value, wear, added),
            _ => {
                self.m.store_radius(entry, value, wear, added);
                Ok(())
            }
        }
    }

    fn hold_entry(&mut self, entry: u32) {
        if self.edge.is_none_or(|(tool, edge)| edge == 1 && tool == Some(entry)) {
            if self.edge.take().is_some() {
                self.m.entry = entry;
            }
            self.m.hold_entry(entry);
        }
    }

    /// `MEASURE_TOOL(1, X 0mm)`, `MEASURE_TOOL(1, offset 9, Z 0mm)`: called up where it stands, the tool reads the words.
    pub(super) fn measure_tool(&mut self, a: &[Token]) -> Result<(), Halt> {
        let Some(Token::Number(entry, _)) = a.first() else { return self.m.halt("an entry") };
        let entry = *entry as u32;
        let fixture = match a.get(3) {
            Some(Token::Number(offset, _)) if matches!(a.get(2), Some(Token::Name(n)) if n == "offset") => {
                Some(*offset as u32)
            }
            _ => None,
        };
        let offset = fixture.unwrap_or(self.m.offset);
        if self.m.turn_of(offset) != 0.0 || self.chain() != super::Frame::NONE {
            return self.m.halt("a tool measured in a frame that turns");
        }
        let shift = if fixture.is_some() { [0.0; 6] } else { self.m.slots.shift() };
        let zero = self.m.zero_of(offset);
        let by = ["X", "Y", "Z"].map(|axis| self.after(a, axis));
        let of = |axis: usize| by[axis].map(|word| self.m.at[axis] - zero[axis] - shift[axis] - word);
        let (x, y, z) = (of(0), of(1), of(2));
        self.hold_entry(entry);
        if x.is_some() || y.is_some() {
            let [own_x, own_y] = self.m.aside_of(entry);
            self.m.store_aside(entry, [x.or(Some(own_x)), y.or(Some(own_y))]);
        }
        match z {
            Some(z) => self.m.store_length(entry, z - self.m.wear_of(entry), false, false),
            None => Ok(()),
        }
    }
}
