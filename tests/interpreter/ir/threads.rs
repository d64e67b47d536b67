//! Threads of the neutral program: by a pitch, or by feed and speed; with the sense in which the control
//! turns the spindle; back again; with a chuck.

use super::super::{Halt, Spindle};
use super::Control;
use super::text::{Token, split};

impl Control {
    pub(super) fn thread(&mut self, a: &[Token]) -> Result<(), Halt> {
        let mut point = Vec::new();
        let (mut turn, mut back, mut chuck) = (None, false, false);
        for part in split(a) {
            let [Token::Name(name), ..] = part else { return self.m.halt("a thread") };
            match name.as_str() {
                "pitch" => {}
                "chuck" => chuck = true,
                "back" => back = true,
                "clockwise" => turn = Some(Spindle::Clockwise),
                "counterclockwise" => turn = Some(Spindle::Counterclockwise),
                _ => point.push(part.to_vec()),
            }
        }
        let [point] = &point[..] else { return self.m.halt("a thread along several axes") };
        let (to, _) = self.target(point)?;
        let to = self.machine(to);
        self.cycle = None;
        let pitch = self.after(a, "pitch");
        match (turn, back, chuck, pitch) {
            (None, false, true, None) => self.m.chuck_thread(to),
            (None, false, false, Some(lead)) => self.m.cut_thread(to, lead),
            (None, true, false, Some(lead)) => self.m.tap_and_back(to, lead),
            (Some(turn), false, false, Some(lead)) => self.m.turned_thread(to, lead, turn),
            _ => self.m.halt("a thread in another form"),
        }
    }
}
