//! Packs stretches of straight moves as they are read, so that few statements are in memory at once.
//!
//! ```text
//! some moves | LINES, which grow | those that say all again | what is read next
//! ```
//!
//! Where the moves behind a stretch have another kind of word, it is over, and those behind it begin the next one, so that
//! the kinds of both stand in front of that.

use std::sync::Arc;

use ncc_ir::canon::Axis;
use ncc_ir::program::packing::Packing;
use ncc_ir::program::{Op, Stmt};

use super::kinds::{Kinds, Words};

/// Moves in front that may be changed, as they are the first.
const LEAD: usize = 4;

/// Moves on each side that must not be.
pub(super) const PROBES: usize = 4;

/// Moves behind, where the stretch is short.
const SHORT_TAIL: usize = 512;

/// Bytes of a stretch after which another one begins.
const MOST_BYTES: usize = 1 << 20;

/// Packs the stretches of a body that is put together one statement after the other.
#[derive(Debug)]
pub(crate) struct Packer {
    shortest: usize,
    words: Words,
    /// Where the statements begin that may be packed yet.
    from: usize,
    /// Whether those behind that were looked at, and more of them are needed.
    needs_more: bool,
    open: Option<OpenStretch>,
}

/// A stretch to which more may be added: its statement stands before [`Packer::from`].
#[derive(Debug)]
struct OpenStretch {
    probes: u32,
    known: Kinds,
    packing: Packing,
    /// Up to where the kinds of the statements behind are known.
    looked: usize,
}

/// What comes of looking at the statements that are there.
enum Found {
    /// Nothing can be stated before more are read.
    Wait,
    /// Look further.
    Further,
}

impl Packer {
    /// For stretches of so many moves or more.
    pub(crate) fn new(shortest: usize, words: Words) -> Packer {
        Packer { shortest, words, from: 0, needs_more: false, open: None }
    }

    /// How many statements are looked at together, as long as more are read.
    fn at_once(&self) -> usize {
        self.shortest.saturating_mul(self.shortest)
    }

    /// Packs what is long enough of the first `settled` statements, behind which others will follow.
    pub(crate) fn pack(&mut self, body: &mut Vec<Stmt>, settled: usize) {
        let settled = settled.min(body.len());
        let enough = self.at_once().saturating_mul(if self.needs_more { 2 } else { 1 });
        if settled.saturating_sub(self.from) >= enough {
            self.go(body, settled, false);
        }
    }

    /// Packs the rest of the first `settled` statements.
    pub(crate) fn finish(mut self, body: &mut Vec<Stmt>, settled: usize) {
        let behind = body.len() - settled.min(body.len());
        let mut to = self.from;
        loop {
            to = to.saturating_add(self.at_once()).max(self.from);
            let settled = body.len() - behind;
            self.go(body, to.min(settled), to >= settled);
            if to >= settled {
                return self.close(body);
            }
            to -= settled - (body.len() - behind);
        }
    }

    fn go(&mut self, body: &mut Vec<Stmt>, mut settled: usize, over: bool) {
        while self.from < settled {
            let before = body.len();
            let found = match &self.open {
                Some(_) => self.extend(body, settled, over),
                None => self.begin(body, settled, over),
            };
            settled -= before - body.len();
            if matches!(found, Found::Wait) {
                break;
            }
        }
    }

    /// Adds to the open stretch.
    fn extend(&mut self, body: &mut Vec<Stmt>, settled: usize, over: bool) -> Found {
        let at_once = self.at_once();
        let Some(open) = &mut self.open else { return Found::Further };
        let mut end = open.looked.max(self.from);
        while end < settled && self.words.packs(&body[end]) && !open.known.has_more(&body[end]) {
            end += 1;
        }
        let ends = over || end < settled || open.packing.len() > MOST_BYTES;
        let tail = tail(body, self.from, end);
        let late = end - tail > SHORT_TAIL.max(at_once);
        open.looked = end;
        if !(ends || late) && tail == self.from {
            return Found::Wait;
        }
        let packed = self.take(body, tail);
        if ends || late || !packed {
            self.close(body);
        }
        if ends || late { Found::Further } else { Found::Wait }
    }

    /// Packs the statements from `from` on to `to`; `false` where not all of them can be.
    fn take(&mut self, body: &mut Vec<Stmt>, to: usize) -> bool {
        let Some(open) = &mut self.open else { return false };
        let many = body[self.from..to].iter().take_while(|stmt| open.packing.push(stmt)).count();
        let all = many == to - self.from;
        body.drain(self.from..self.from + many);
        open.looked = open.looked.saturating_sub(many);
        all
    }

    /// The open stretch is over: its statement is complete.
    fn close(&mut self, body: &mut [Stmt]) {
        let Some(OpenStretch { probes, packing, .. }) = self.open.take() else { return };
        if let Some(stmt) = self.from.checked_sub(1).and_then(|at| body.get_mut(at)) {
            stmt.op = Op::Lines(Arc::new(packing.finish(probes)));
        }
    }

    /// Looks for the next stretch.
    fn begin(&mut self, body: &mut Vec<Stmt>, settled: usize, over: bool) -> Found {
        self.needs_more = false;
        let run = body[self.from..settled].iter().take_while(|stmt| self.words.packs(stmt)).count();
        let run_end = self.from + run;
        let more = run_end == settled && !over;
        let probed = self.from + LEAD;
        let mut start = probed + PROBES;
        if start.saturating_add(self.shortest) > run_end {
            if more {
                return Found::Wait;
            }
            self.from = run_end + 1;
            return Found::Further;
        }
        let mut known = Kinds::default();
        body[probed..start].iter().for_each(|stmt| {
            known.has_more(stmt);
        });
        let (mut end, mut other) = (start, false);
        while end < run_end {
            if known.has_more(&body[end]) {
                if end - start >= self.shortest {
                    other = true;
                    break;
                }
                if known.is_full() {
                    self.from = end + 1;
                    return Found::Further;
                }
                start = end + 1;
            }
            end += 1;
        }
        while start < end && body[start].joined {
            start += 1;
        }
        let goes_on = more && !other;
        let first_end = end;
        loop {
            let tail = tail(body, start, end);
            if tail < start.saturating_add(self.shortest) {
                if goes_on && first_end - self.from < 2 * self.at_once() {
                    self.needs_more = true;
                    return Found::Wait;
                }
                // The next one begins behind what is stated seldom.
                self.from = tail + 1;
                return Found::Further;
            }
            if end - tail <= SHORT_TAIL.max((end - start) / 8) {
                let goes_on = goes_on && end == first_end;
                return self.open(body, [probed, start, tail], known, goes_on);
            }
            // What is stated seldom begins the next stretch.
            end = tail;
        }
    }

    /// Begins a stretch: what stands for it in front begins at the first place, what is packed is between the other two.
    fn open(
        &mut self,
        body: &mut Vec<Stmt>,
        [probed, start, tail]: [usize; 3],
        known: Kinds,
        goes_on: bool,
    ) -> Found {
        let place = Stmt::new(body[start].span, Op::Blank);
        let first = std::mem::replace(&mut body[start], place);
        let mut packing = Packing::default();
        let probes = (start - probed) as u32;
        if !packing.push(&first) {
            // More than can be packed.
            body[start] = first;
            self.from = tail;
            return Found::Further;
        }
        self.from = start + 1;
        self.open = Some(OpenStretch { probes, known, packing, looked: self.from });
        if self.take(body, tail) && goes_on {
            return Found::Wait;
        }
        self.close(body);
        Found::Further
    }
}

/// Where the moves begin that say all again that those before `end` say.
fn tail(body: &[Stmt], start: usize, end: usize) -> usize {
    let mut last = [None; 4];
    for (at, stmt) in body[..end].iter().enumerate().skip(start) {
        match &stmt.op {
            Op::StraightFeed(to) | Op::StraightTraverse(to) => {
                let axes = to.to.axes[..Axis::A as usize].iter().enumerate();
                axes.filter(|(_, word)| word.is_some()).for_each(|(axis, _)| last[axis] = Some(at));
            }
            _ => last[3] = Some(at),
        }
    }
    let least = last.into_iter().flatten().min().unwrap_or(end);
    let mut tail = least.min(end.saturating_sub(PROBES)).max(start);
    while tail > start && body[tail].joined {
        tail -= 1;
    }
    tail
}

/// Packs the stretches of a body that is there, of so many moves or more.
pub(crate) fn pack(body: &mut Vec<Stmt>, shortest: usize, words: Words) {
    let mut packer = Packer::new(shortest, words);
    let all = std::mem::take(body);
    for stmt in all {
        body.push(stmt);
        packer.pack(body, usize::MAX);
    }
    packer.finish(body, usize::MAX);
}

#[cfg(test)]
mod tests {
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::{Batch, Reader};

    use super::super::{SHORTEST, stretches, unpack};
    use super::*;

    fn body(text: &str) -> Vec<Stmt> {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        let (mut reader, mut batch) = (Reader::new(settings, true), Batch::default());
        reader.read(text.as_bytes(), 0, &mut batch);
        reader.finish(&mut batch);
        batch.stmts
    }

    /// Looking at each word of one beside all kinds before it took minutes where each line has its own variable.
    #[test]
    fn moves_of_too_many_kinds_are_left_and_those_behind_are_packed() {
        let other: String = (0..400).map(|n| format!("G01 X#{}\n", 500 + n)).collect();
        let same: String = (0..1_000).map(|n| format!("X[#500+{n}.5]\n")).collect();
        let read = body(&format!("{other}{same}"));
        let mut packed = read.clone();
        pack(&mut packed, SHORTEST, Words::All);
        let many: Vec<usize> =
            stretches(&packed).iter().map(|stretch| stretch.lines.unpack().count()).collect();
        assert!(matches!(many[..], [many] if many > 700), "{many:?}");
        unpack(&mut packed);
        assert_eq!(packed, read);

        let mut kinds = Kinds::default();
        let full = read.iter().position(|stmt| {
            kinds.has_more(stmt);
            kinds.is_full()
        });
        assert!(full.is_some_and(|many| many < 400), "{full:?}");
    }
}
