//! Two texts line by line, as far as a comparison has come: neither is in memory as a whole, nor is a long line.
//!
//! ```text
//! equal lines         counted; only the last ones are kept
//! different lines     kept as positions in the file, with the lines around them
//! ```
//!
//! Not here: what a line says (`text`), and which lines are paired (`edits`).

use std::collections::{HashMap, VecDeque};
use std::io::{self, Read, SeekFrom};

use ncc_driver::source::Readable;
use sha2::{Digest, Sha256};

use super::edits::Lists;

/// Bytes of a block by which another one is found to say the same; of a longer one, its hash.
const LONGEST_KEY: usize = 256;
/// Bytes of a line after which what it says need not be held.
const LONGEST_HELD: usize = 16 * 1024;
/// Bytes that are read at once.
const PAGE: usize = 1 << 16;

/// The words of a block, or their hash where the block is long.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Key {
    Text(Box<[u8]>),
    Hash([u8; 32]),
}

impl Key {
    fn of(said: &[u8]) -> Key {
        if said.len() <= LONGEST_KEY {
            Key::Text(said.into())
        } else {
            Key::Hash(Sha256::digest(said).into())
        }
    }
}

/// The position of a line in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// Its number, from 1.
    pub(crate) number: u64,
    /// Its first byte.
    pub(crate) start: u64,
    /// Its bytes without its end.
    pub(crate) length: u64,
}

/// Writes the words of a line that count to the buffer; `false` skips the line.
pub(crate) type Say<'s> = Box<dyn Fn(&[u8], &mut Vec<u8>) -> bool + 's>;

/// One text.
pub(crate) struct Lines<'f> {
    file: &'f mut dyn Readable,
    /// Reduces a line to the words that count; absent where all of it counts.
    say: Option<Say<'f>>,
    page: Vec<u8>,
    /// Bytes of the page that are used.
    used: usize,
    /// Place of the page's end.
    end: u64,
    /// Lines so far, those that count for nothing too.
    number: u64,
    /// Whether its first line ends with CR LF.
    pub(crate) crlf: bool,
    /// Lines that were read and not passed.
    ahead: VecDeque<(Place, Key)>,
    /// How many were passed.
    passed: usize,
    /// The last of them.
    behind: VecDeque<Place>,
    /// So many of the next are kept.
    keeps: usize,
    /// Reported lines and the lines around them, by index.
    kept: HashMap<usize, Place>,
}

impl<'f> Lines<'f> {
    /// A text from its beginning on.
    ///
    /// # Errors
    /// Reading it.
    pub(crate) fn new(file: &'f mut dyn Readable, say: Option<Say<'f>>) -> io::Result<Lines<'f>> {
        file.seek(SeekFrom::Start(0))?;
        Ok(Lines {
            file,
            say,
            page: Vec::new(),
            used: 0,
            end: 0,
            number: 0,
            crlf: false,
            ahead: VecDeque::new(),
            passed: 0,
            behind: VecDeque::new(),
            keeps: 0,
            kept: HashMap::new(),
        })
    }

    /// The place of a line that differs, or of one around it.
    pub(crate) fn place(&self, index: usize) -> Option<Place> {
        self.kept.get(&index).copied()
    }

    /// The first bytes of a line.
    ///
    /// # Errors
    /// Reading it.
    pub(crate) fn text(&mut self, place: Place, most: usize) -> io::Result<Vec<u8>> {
        let mut text = Vec::new();
        self.file.seek(SeekFrom::Start(place.start))?;
        (&mut *self.file).take(place.length.min(most as u64)).read_to_end(&mut text)?;
        Ok(text)
    }

    /// Bytes that are at hand; none at the end.
    fn fill(&mut self) -> io::Result<bool> {
        if self.used < self.page.len() {
            return Ok(true);
        }
        self.file.seek(SeekFrom::Start(self.end))?;
        self.page.clear();
        self.used = 0;
        (&mut *self.file).take(PAGE as u64).read_to_end(&mut self.page)?;
        self.end += self.page.len() as u64;
        Ok(!self.page.is_empty())
    }

    /// Reads the next line that counts; `false` at the end.
    fn read_line(&mut self) -> io::Result<bool> {
        let (mut line, mut said) = (Vec::new(), Vec::new());
        loop {
            if !self.fill()? {
                return Ok(false);
            }
            let start = self.end - (self.page.len() - self.used) as u64;
            let (mut length, mut long) = (0u64, None::<Sha256>);
            line.clear();
            while self.fill()? {
                let rest = self.page.get(self.used..).unwrap_or_default();
                let end = memchr::memchr(b'\n', rest);
                let part = rest.get(..end.unwrap_or(rest.len())).unwrap_or_default();
                length += part.len() as u64;
                line.extend_from_slice(part);
                self.used += part.len() + usize::from(end.is_some());
                if end.is_some() {
                    break;
                }
                if self.say.is_none() && line.len() > LONGEST_HELD {
                    // The last byte may belong to the line's end.
                    let last = line.pop();
                    long.get_or_insert_default().update(&line);
                    line.clear();
                    line.extend(last);
                }
            }
            let cr = line.last() == Some(&b'\r');
            self.crlf |= cr && self.number == 0;
            self.number += 1;
            if cr {
                line.pop();
                length -= 1;
            }
            let place = Place { number: self.number, start, length };
            let key = match (&self.say, long) {
                (_, Some(mut long)) => {
                    long.update(&line);
                    Key::Hash(long.finalize().into())
                }
                (None, None) => Key::of(&line),
                (Some(say), None) => {
                    said.clear();
                    if !say(&line, &mut said) {
                        continue;
                    }
                    Key::of(&said)
                }
            };
            self.ahead.push_back((place, key));
            return Ok(true);
        }
    }

    /// Passes so many lines; those that differ are kept, with so many before and after them.
    fn pass(&mut self, count: usize, alike: bool, around: usize) {
        if !alike {
            for (at, place) in self.behind.iter().rev().enumerate() {
                self.kept.insert(self.passed - 1 - at, *place);
            }
        }
        for (place, _) in self.ahead.drain(..count) {
            if !alike || self.keeps > 0 {
                self.kept.insert(self.passed, place);
            }
            self.keeps = self.keeps.saturating_sub(1);
            self.behind.push_back(place);
            if self.behind.len() > around {
                self.behind.pop_front();
            }
            self.passed += 1;
        }
        if !alike {
            self.keeps = around;
        }
    }
}

/// Both texts.
pub(crate) struct Both<'l, 'f> {
    pub(crate) texts: &'l mut [Lines<'f>; 2],
    /// Lines around a difference that are kept.
    pub(crate) around: usize,
}

impl Lists for Both<'_, '_> {
    fn read_ahead(&mut self, side: usize, wanted: usize) -> io::Result<usize> {
        let lines = &mut self.texts[side];
        while lines.ahead.len() < wanted && lines.read_line()? {}
        Ok(lines.ahead.len())
    }

    fn first_are_same(&self) -> bool {
        let [a, b] = self.texts.each_ref().map(|lines| lines.ahead.front().map(|(_, key)| key));
        a == b
    }

    fn ids(&self, [n, m]: [usize; 2]) -> [Vec<u32>; 2] {
        let mut known: HashMap<&Key, u32> = HashMap::new();
        let [a, b] = &*self.texts;
        [(a, n), (b, m)].map(|(lines, count)| {
            let keys = lines.ahead.iter().take(count);
            keys.map(|(_, key)| {
                let next = known.len() as u32;
                *known.entry(key).or_insert(next)
            })
            .collect()
        })
    }

    fn pass(&mut self, counts: [usize; 2], alike: bool) {
        for (lines, count) in self.texts.iter_mut().zip(counts) {
            lines.pass(count, alike, self.around);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    fn all(text: &[u8]) -> (Vec<(Place, Key)>, bool) {
        let mut file = Cursor::new(text.to_vec());
        let mut lines = Lines::new(&mut file, None).expect("memory");
        while lines.read_line().expect("memory") {}
        (lines.ahead.into(), lines.crlf)
    }

    #[test]
    fn lines_are_found_wherever_pages_end() {
        for long in [0, 3, LONGEST_KEY, LONGEST_HELD, PAGE - 6, PAGE - 5, PAGE - 4, PAGE, 3 * PAGE + 7] {
            let line = vec![b'X'; long];
            let text = [b"G0\r\n", &line[..], b"\r\n\n", &line[..], b"\nM30"].concat();
            let (found, crlf) = all(&text);
            assert!(crlf);
            let said: Vec<&[u8]> = found
                .iter()
                .map(|(place, _)| &text[place.start as usize..(place.start + place.length) as usize])
                .collect();
            assert_eq!(said, [b"G0", &line[..], b"", &line[..], b"M30"], "{long}");
            let numbers: Vec<u64> = found.iter().map(|(place, _)| place.number).collect();
            assert_eq!(numbers, [1, 2, 3, 4, 5]);
            assert_eq!(found[1].1, Key::of(&line), "{long}");
            assert_eq!(found[3].1, Key::of(&line), "{long}");
        }
        assert_eq!(all(b"").0, []);
        assert_eq!(all(b"\n").0.len(), 1);
    }

    #[test]
    fn what_differs_is_kept_with_what_is_around_it() {
        let mut files = [0, 1].map(|_| Cursor::new(b"0\n1\n2\n3\n4\n5\n6\n7\n".to_vec()));
        let [a, b] = files.each_mut().map(|file| Lines::new(file, None).expect("memory"));
        let mut texts = [a, b];
        let mut both = Both { texts: &mut texts, around: 2 };
        assert_eq!(both.read_ahead(0, 9).ok(), Some(8));
        assert_eq!(both.read_ahead(1, 9).ok(), Some(8));
        both.pass([3, 3], true);
        both.pass([1, 0], false);
        both.pass([4, 4], true);
        let kept = |side: usize| (0..8).filter(|at| texts[side].place(*at).is_some()).collect::<Vec<_>>();
        assert_eq!(kept(0), [1, 2, 3, 4, 5]);
        assert_eq!(kept(1), [1, 2, 3, 4]);
        let place = texts[0].place(3).expect("kept");
        assert_eq!((place.number, texts[0].text(place, 9).ok()), (4, Some(b"3".to_vec())));
    }
}
