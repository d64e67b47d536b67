//! Control of the tool's tip, and planes in space.

use super::super::Halt;
use super::Control;
use super::text::Token;

impl Control {
    /// Such a statement.
    pub(super) fn five_axes(&mut self, name: &str, a: &[Token]) -> Result<(), Halt> {
        match name {
            "USE_TOOL_CENTRE_POINT" => {
                let on = self.word(a)? == "on";
                self.m.use_tip(on)
            }
            "ORIENT_TOOL_AXIS" => match a {
                [] => self.m.stand_upright(),
                [Token::Name(way)] if way == "minus" || way == "plus" => self.m.stand_upright(),
                _ => self.m.halt("another way of turning the tool"),
            },
            _ => self.set_tilt(a),
        }
    }

    /// `X 1mm, about Z 0deg X 30deg Z 0deg`
    fn set_tilt(&mut self, a: &[Token]) -> Result<(), Halt> {
        let (mut zero, mut turns, mut angles) = ([0.0; 3], [(0, 0.0); 3], None);
        let mut rest = a;
        loop {
            rest = match rest {
                [] => break,
                [Token::Sign(','), rest @ ..] => rest,
                [Token::Name(about), rest @ ..] if about == "about" && angles.is_none() => {
                    angles = Some(0);
                    rest
                }
                [Token::Name(axis), Token::Number(value, unit), rest @ ..] => {
                    let Some(axis) = ["X", "Y", "Z"].iter().position(|own| own == axis) else {
                        return self.m.halt("another axis of a plane");
                    };
                    match &mut angles {
                        None => zero[axis] = self.base(*value, unit),
                        Some(count @ 0..=2) => {
                            turns[*count] = (axis, *value);
                            *count += 1;
                        }
                        Some(_) => return self.m.halt("more turns than three"),
                    }
                    rest
                }
                _ => return self.m.halt("another word of a plane"),
            };
        }
        match angles {
            Some(3) => self.m.set_plane(zero, turns),
            _ => self.m.halt("a plane without its turns"),
        }
    }
}
