//! What controls do besides the names of codes, where two lists of events are laid side by side: what the one switches by
//! itself, the other may say in words, as long as nothing is cut.

use crate::plain::{Happening, Plain};

/// Whether coolant is switched by a word, where the other control did the same by itself, or this one had.
pub(crate) fn switched(event: &Plain, other: &Plain) -> bool {
    matches!(event.what, Happening::Coolant)
        && (event.by_itself.coolant || other.by_itself.coolant && event.coolant == other.coolant)
}

/// Whether it is a cut.
pub(crate) fn cuts(what: Happening) -> bool {
    matches!(what, Happening::Feed | Happening::Arc { .. } | Happening::Thread { .. } | Happening::Probe(..))
}

/// The same without spindle and coolant where nothing is cut.
pub fn of_cuts(list: &[Plain]) -> Vec<Plain> {
    let kept = list.iter().filter(|event| event.what != Happening::Coolant);
    let bare = |event: &Plain| match cuts(event.what) {
        true => *event,
        false => Plain { speed: 0.0, surface: None, coolant: (false, false), ..*event },
    };
    kept.map(bare).collect()
}

/// What the second control alone has done by itself is as the first one has it, as long as nothing is cut.
pub(crate) fn passed_over(a: &Plain, b: &Plain) -> Plain {
    let mut b = *b;
    if cuts(b.what) {
        return b;
    }
    if b.by_itself.spindle && !a.by_itself.spindle {
        (b.speed, b.surface) = (a.speed, a.surface);
    }
    if b.by_itself.coolant && !a.by_itself.coolant {
        b.coolant = a.coolant;
    }
    if b.by_itself.z && !a.by_itself.z || a.by_itself.z && !b.by_itself.z_moved {
        b.at[2] = a.at[2];
    }
    b
}

/// The same as if the control stayed where the program has put it: what it does by itself for a tool change is undone.
pub fn without_way_up(list: Vec<Plain>) -> Vec<Plain> {
    let (mut kept, mut z): (Vec<Plain>, Option<f64>) = (Vec::new(), None);
    for mut event in list {
        if event.by_itself.moves {
            z = kept.last().map(|last: &Plain| last.at[2]);
            continue;
        }
        match z {
            Some(z) if event.by_itself.z => event.at[2] = z,
            _ => z = None,
        }
        kept.push(event);
    }
    kept
}
