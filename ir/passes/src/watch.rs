//! Who looks on while a program is rewritten: each pass says its name when it has run, and shows the statements as they
//! are then. Tests hold the order by it, and `--print-after` prints it. Trials of a pass that are thrown away are seen as well.

use std::cell::{Cell, RefCell};

use ncc_ir::program::{Program, Stmt};

/// Called with the name of a pass and the statements after it, of each procedure by itself.
pub type Look = Box<dyn FnMut(&'static str, &[Stmt])>;

thread_local! {
    static LOOK: RefCell<Option<Look>> = const { RefCell::new(None) };
    static SEEN: Cell<bool> = const { Cell::new(false) };
}

/// Looks on until it is dropped.
#[derive(Debug)]
pub struct Watch(());

/// Has `look` called after each pass on this thread.
#[must_use]
pub fn watch(look: Look) -> Watch {
    LOOK.with_borrow_mut(|own| *own = Some(look));
    SEEN.set(true);
    Watch(())
}

/// Does something that nobody looks on at: a translation that is thrown away whole.
pub fn unwatched<T>(work: impl FnOnce() -> T) -> T {
    let seen = SEEN.replace(false);
    let done = work();
    SEEN.set(seen);
    done
}

impl Drop for Watch {
    fn drop(&mut self) {
        SEEN.set(false);
        LOOK.with_borrow_mut(|own| *own = None);
    }
}

/// A pass has run on these statements.
#[inline]
pub fn ran(pass: &'static str, stmts: &[Stmt]) {
    if SEEN.get() {
        show(pass, stmts);
    }
}

/// A pass has run on a program that is kept whole.
#[inline]
pub fn ran_whole(pass: &'static str, program: &Program) {
    if SEEN.get() {
        program.procedures.iter().for_each(|procedure| show(pass, &procedure.body));
    }
}

#[cold]
fn show(pass: &'static str, stmts: &[Stmt]) {
    LOOK.with_borrow_mut(|look| {
        if let Some(look) = look {
            look(pass, stmts);
        }
    });
}
