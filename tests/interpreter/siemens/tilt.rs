//! TRAORI and TRAFOOF, and CYCLE800 where it sets a plane by turns about three axes and turns the tool; before that
//! it may retract to the machine's zero, along Z or along Z and then X and Y.

use super::super::Halt;
use super::text::Argument;
use super::{Control, Words};

impl Control<'_> {
    /// Whether the block is one of these.
    pub(super) fn five_axes(&mut self, w: &Words) -> Result<bool, Halt> {
        let bare = w.letters.is_empty() && w.named.is_empty();
        let name = match (w.call, &w.names[..]) {
            (Some((name, _)), []) => name,
            (None, [name]) => name,
            _ => return Ok(false),
        };
        match (name, w.call.map(|call| call.1)) {
            ("TRAORI" | "TRAFOOF", None) if bare => self.m.use_tip(name == "TRAORI")?,
            ("TRAORI", Some([Argument::Number(n, _)])) if bare && *n == 1.0 => self.m.use_tip(true)?,
            ("CYCLE800", Some(arguments)) if bare && self.modal.is_none() => self.swivel(arguments)?,
            ("TRAORI" | "TRAFOOF" | "CYCLE800", _) => {
                return self.m.halt(format!("{name}, and what stands beside it"));
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn swivel(&mut self, arguments: &[Argument]) -> Result<(), Halt> {
        if arguments.iter().all(|argument| matches!(argument, Argument::Empty)) {
            return self.m.leave_plane();
        }
        let mut values = [0.0; 16];
        for (place, argument) in arguments.iter().enumerate() {
            match argument {
                Argument::Number(n, _) if place < 16 => values[place] = *n,
                Argument::Empty => {}
                Argument::Text if place == 1 => {}
                _ => return self.m.halt("another argument of CYCLE800"),
            }
        }
        // An optimised direction, minus or plus: the side is the stated one, as is taken for granted.
        let optimised = match values[2] as i64 {
            0 => 0.0,
            100_000 => -1.0,
            200_000 => 1.0,
            _ => return self.m.halt("a status of CYCLE800"),
        };
        if optimised * values[13] < 0.0 {
            return self.m.halt("CYCLE800 of two directions");
        }
        let nothing = [10, 11, 12].iter().all(|place| values[*place] == 0.0);
        if !nothing || arguments.len() < 14 || ![0.0, 1.0].contains(&values[15]) {
            return self.m.halt("CYCLE800 that does more than set a plane");
        }
        let mode = self.whole(values[3])?;
        let axis = |bits: u32| (mode >> bits & 3) as usize;
        let axes = [axis(0), axis(2), axis(4)];
        if mode > 63 || axes.contains(&0) || axes[0] + axes[1] + axes[2] != 6 || axes == [2; 3] {
            return self.m.halt("CYCLE800 in another way of stating angles");
        }
        let retracts: &[&[usize]] = match values[0] {
            0.0 => &[],
            1.0 if values[13] != 0.0 => &[&[2]],
            2.0 if values[13] != 0.0 => &[&[2], &[0, 1]],
            _ => return self.m.halt("CYCLE800 that retracts along the tool, or turns no axis"),
        };
        self.m.leave_plane()?;
        for axes in retracts {
            let mut to = self.m.at;
            for &axis in *axes {
                to[axis] = 0.0;
                self.m.settled[axis] = false;
            }
            self.m.traverse(to);
        }
        let unit = self.unit();
        let zero = [values[4] * unit, values[5] * unit, values[6] * unit];
        let turns = std::array::from_fn(|k| (axes[k] - 1, values[7 + k]));
        if self.frame != super::Frame::NONE {
            return self.m.halt("CYCLE800 in a frame");
        }
        self.m.set_plane(zero, turns)?;
        if values[13] != 0.0 {
            self.m.stand_upright()?;
        }
        Ok(())
    }
}
