//! What each pass remembers from piece to piece of a program: one value of its own type, which no other pass knows.

use std::any::Any;
use std::fmt::Debug;

/// What a pass can remember.
trait State: Any + Debug {
    fn copied(&self) -> Box<dyn State>;
}

impl<S: Any + Debug + Clone> State for S {
    fn copied(&self) -> Box<dyn State> {
        Box::new(self.clone())
    }
}

/// What all passes remember. A pass that has not been here yet remembers its type's default.
#[derive(Debug, Default)]
pub(crate) struct States(Vec<Box<dyn State>>);

impl Clone for States {
    fn clone(&self) -> States {
        States(self.0.iter().map(|state| (**state).copied()).collect())
    }
}

impl States {
    /// What a pass remembers, to be changed.
    pub(crate) fn state_mut<S: Any + Debug + Clone + Default>(&mut self) -> &mut S {
        let at = self.0.iter().position(|state| is::<S>(&**state)).unwrap_or_else(|| {
            self.0.push(Box::new(S::default()));
            self.0.len() - 1
        });
        let state: &mut dyn Any = &mut *self.0[at];
        state.downcast_mut().expect("the state at the place of its type")
    }

    /// Asks for what a pass remembers.
    pub(crate) fn ask<S: Any + Debug + Clone + Default, A>(&self, ask: impl FnOnce(&S) -> A) -> A {
        match self.0.iter().find_map(|state| (&**state as &dyn Any).downcast_ref()) {
            Some(state) => ask(state),
            None => ask(&S::default()),
        }
    }

    /// Puts in what a pass is to remember.
    pub(crate) fn put<S: Any + Debug + Clone + Default>(&mut self, state: S) {
        *self.state_mut() = state;
    }

    /// Has a pass forget everything.
    pub(crate) fn forget<S: Any + Debug + Clone + Default>(&mut self) {
        self.0.retain(|state| !is::<S>(&**state));
    }
}

/// Whether a state is of this type.
fn is<S: Any>(state: &dyn State) -> bool {
    (state as &dyn Any).is::<S>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, Default, PartialEq)]
    struct Holes(u32);

    #[derive(Clone, Debug, Default, PartialEq)]
    struct Threads(u32);

    #[test]
    fn each_pass_has_a_state_of_its_own() {
        let mut states = States::default();
        assert_eq!(states.ask(|holes: &Holes| holes.0), 0);
        states.state_mut::<Holes>().0 = 3;
        states.put(Threads(5));
        let copy = states.clone();
        states.state_mut::<Holes>().0 += 1;
        assert_eq!((states.ask(|h: &Holes| h.0), states.ask(|t: &Threads| t.0)), (4, 5));
        assert_eq!(copy.ask(|h: &Holes| h.0), 3);
        states.forget::<Holes>();
        assert_eq!((states.ask(|h: &Holes| h.0), states.ask(|t: &Threads| t.0)), (0, 5));
    }
}
