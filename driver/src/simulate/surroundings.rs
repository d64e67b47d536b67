//! What lies around a part on its machine: zeros of the work offsets, the travel of the axes.
//!
//! Both are known only as far as a profile states where the zeros are: without that, the part lies nowhere on the machine.

use ncc_dialects::Dialect;
use ncc_machines::Profile;

use super::path::Path;
use crate::render::spelled;

/// What is known around a part; lengths in mm, coordinates of the part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// The zero of each work offset that is used and known, by the word that the dialect has for it. The one in which the
    /// program cuts first is in the origin.
    pub zeros: Vec<(String, [f64; 3])>,
    /// How far X, Y and Z of the machine go: the least and the greatest coordinates of the spindle's nose.
    pub travel: Option<[[f64; 3]; 2]>,
}

impl Surroundings {
    /// Of the moves of a program in a dialect, on a machine.
    pub fn of(path: &Path, dialect: &Dialect, profile: Option<&Profile>) -> Surroundings {
        let known = |zero: &[Option<f64>; 3]| Some([zero[0]?, zero[1]?, zero[2]?]);
        let datum = path.zeros.get(path.datum).and_then(known);
        let zero = |at: usize| match (at == path.datum, datum) {
            (true, _) => Some([0.0; 3]),
            (false, Some(datum)) => {
                known(&path.zeros[at]).map(|zero| [0, 1, 2].map(|axis| zero[axis] - datum[axis]))
            }
            (false, None) => None,
        };
        let named = |number: u16| spelled::work_offset(number, [dialect; 2]);
        let zeros =
            path.offsets.iter().enumerate().filter_map(|(at, number)| Some((named(*number), zero(at)?)));
        let travel = datum.zip(profile).and_then(|(datum, profile)| {
            let axes = profile.machine().axes;
            let ends = [axes[0].travel?, axes[1].travel?, axes[2].travel?];
            Some([0, 1].map(|end: usize| [0, 1, 2].map(|axis: usize| ends[axis][end] - datum[axis])))
        });
        Surroundings { zeros: zeros.collect(), travel }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The travel of a machine and the zeros lie around the zero of the first cut, where a profile states that one.
    #[test]
    fn zeros_and_travel_are_told_in_coordinates_of_the_part() {
        let dialect = ncc_dialects::builtin("fanuc").expect("a built-in dialect");
        let profile = ncc_machines::find("fanuc-vmc");
        let path = Path {
            offsets: vec![1, 2, 3],
            zeros: vec![
                [Some(-500.0), Some(-200.0), Some(-300.0)],
                [Some(-400.0), Some(-200.0), Some(-310.0)],
                [None; 3],
            ],
            ..Path::default()
        };
        let around = Surroundings::of(&path, dialect, profile);
        let zeros = [("G54".to_owned(), [0.0; 3]), ("G55".to_owned(), [100.0, 0.0, -10.0])];
        assert_eq!(around.zeros, zeros);
        assert_eq!(around.travel, Some([[-500.0, -300.0, -200.0], [500.0, 200.0, 300.0]]));
        let unstated = Path { zeros: vec![[None; 3]; 3], ..path };
        let around = Surroundings::of(&unstated, dialect, profile);
        assert_eq!((around.zeros.len(), around.travel), (1, None));
    }
}
