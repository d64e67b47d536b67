//! Cutter radius compensation, as far as it can be seen without the tool's radius: on which side of
//! the contour the tool goes, in which plane, and where the control finds the radius.
//!
//! Not here: the path of the tool's centre.

use super::{Halt, Machine, Place, What};

/// The tool goes beside the contour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Beside {
    /// To its left, as the machine sees it.
    pub left: bool,
    /// 17, 18, 19.
    pub plane: u32,
    /// Entry of the table with the radius; edge 1 of a tool is the entry of its number, and other edges
    /// are no entry.
    pub entry: Option<u32>,
    /// The diameter that the program states, in hundredths of a micrometre; then there is no entry.
    pub diameter: Option<i64>,
    /// On an arc: F is the speed along the contour, not that of the tool centre.
    pub on_contour: bool,
    /// G41 or G42 stood again before this move, without G40 (808D turning, p. 121; 15i-MB, p. 430): the contour is left at a
    /// right angle and begun anew.
    pub again: bool,
}

/// What F is the speed of on arcs beside a contour (808D milling, p. 79, of CFC and CFTCP; CFIN as it is remembered).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ArcFeed {
    /// The tool centre: Fanuc, Haas, LinuxCNC, CFTCP.
    #[default]
    Centre,
    /// The contour: CFC, with which a Sinumerik begins.
    Contour,
    /// The contour where the tool is inside of the arc, else the centre: CFIN.
    Inner,
}

impl Machine {
    /// Compensation on; `reversed` says whether frames make left right.
    ///
    /// # Errors
    /// It is on already, or has no radius.
    pub fn go_beside(&mut self, left: bool, reversed: bool, entry: Option<u32>) -> Result<(), Halt> {
        if self.beside.is_some() {
            return self.halt("compensation switched on while it is on");
        }
        if entry == Some(0) {
            return self.halt("compensation by no radius");
        }
        self.beside = Some(Beside {
            left: left != reversed,
            plane: self.plane,
            entry,
            diameter: None,
            on_contour: false,
            again: false,
        });
        self.lead = true;
        Ok(())
    }

    /// The same on a control that takes the active code again.
    ///
    /// # Errors
    /// Another side, plane or radius, or none.
    pub fn go_beside_again(&mut self, left: bool, reversed: bool, entry: Option<u32>) -> Result<(), Halt> {
        let (side, plane) = (left != reversed, self.plane);
        match &mut self.beside {
            Some(on) if (on.left, on.plane, on.entry) == (side, plane, entry) => {
                (on.again, self.lead) = (true, true);
                Ok(())
            }
            _ => self.go_beside(left, reversed, entry),
        }
    }

    /// The move that begins the contour anew has been recorded.
    pub(super) fn begun(&mut self) {
        if let Some(beside) = self.beside.as_mut().filter(|_| !self.lead) {
            beside.again = false;
        }
    }

    /// Compensation on by a diameter in millimetres; less than nothing is the other side.
    ///
    /// # Errors
    /// It is on already.
    pub fn go_beside_by(&mut self, left: bool, reversed: bool, diameter: f64) -> Result<(), Halt> {
        self.go_beside(left != (diameter < 0.0), reversed, None)?;
        let diameter = Some((diameter.abs() * 1e5).round() as i64);
        self.beside = self.beside.map(|beside| Beside { diameter, ..beside });
        Ok(())
    }

    /// How the tool goes beside the contour in an event, with what F counts in it.
    pub(super) fn fed(&self, beside: Option<Beside>, what: &What) -> Option<Beside> {
        let of_arc = |left: bool| match (what, self.feeds.arcs) {
            (What::Arc { .. }, ArcFeed::Contour) => true,
            // The middle of an arc that goes to the left is on its left.
            (What::Arc { sweep, .. }, ArcFeed::Inner) => left == (*sweep > 0.0),
            _ => false,
        };
        beside.map(|beside| Beside {
            on_contour: of_arc(beside.left),
            again: beside.again && !self.lead,
            ..beside
        })
    }

    /// Compensation off.
    pub fn go_on(&mut self) {
        // Where nothing was compensated yet, nothing is left either.
        self.lead = self.beside.is_some() && !self.lead || self.beside.is_none() && self.lead;
        self.beside = None;
    }

    /// An arc leads neither onto a contour nor off it.
    ///
    /// # Errors
    /// It would have to.
    pub fn lead_arc(&self) -> Result<(), Halt> {
        if self.lead { self.halt("an arc onto a compensated contour, or off it") } else { Ok(()) }
    }

    /// A straight move: one in the plane leads onto the contour, or off it.
    pub fn lead_straight(&mut self, to: Place) {
        let (first, second, _) = self.axes();
        if self.at[first] != to[first] || self.at[second] != to[second] {
            self.lead = false;
        }
    }
}
