//! Rooms: an engine each, of one user, bounded in number, bytes and age.
//!
//! A room may be lost: it is too old, or its place is needed. The page then puts its files again, so nothing but time is
//! lost with it. A room that somebody uses is never taken away.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use ncc_engine::Engine;

use crate::Limits;
use crate::http::Problem;

/// Copies of its outputs that an engine holds: the outputs, and the part that they show with its stages.
const COPIES: u64 = 3;

/// The content of a room.
#[derive(Default)]
pub(super) struct Inside {
    pub(super) engine: Engine,
    /// Bytes of each file.
    sizes: BTreeMap<String, u64>,
    /// Digests of the programs of a folder, by their names.
    pub(super) called: BTreeMap<String, String>,
}

impl Inside {
    /// Puts a file.
    pub(super) fn put(&mut self, name: &str, bytes: Vec<u8>) {
        self.sizes.insert(name.to_owned(), bytes.len() as u64);
        self.engine.put(name, bytes);
    }

    /// Bytes of all files but this one.
    pub(super) fn others(&self, name: &str) -> u64 {
        self.sizes.iter().filter(|(own, _)| *own != name).map(|(own, bytes)| own.len() as u64 + bytes).sum()
    }

    /// Bytes of all that it holds.
    fn bytes(&self) -> u64 {
        let outputs: u64 = self.engine.outputs().map(|(_, bytes)| bytes.len() as u64).sum();
        self.others("") + COPIES * outputs
    }
}

/// A room.
pub(super) struct Room {
    /// Requests of a room follow each other.
    pub(super) inside: Arc<tokio::sync::Mutex<Inside>>,
    bytes: AtomicU64,
    used: Mutex<Instant>,
}

impl Room {
    fn new() -> Room {
        Room { inside: Arc::default(), bytes: AtomicU64::new(0), used: Mutex::new(Instant::now()) }
    }

    fn used(&self) -> Instant {
        *self.used.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether nobody but the list has it, and no work runs in it.
    fn is_idle(self: &Arc<Room>) -> bool {
        Arc::strong_count(self) == 1
    }

    fn bytes(&self) -> u64 {
        self.bytes.load(Ordering::Relaxed)
    }
}

/// The user of a room, and its name.
type Key = (String, String);

/// All rooms of this process.
pub(crate) struct Rooms {
    all: Mutex<BTreeMap<Key, Arc<Room>>>,
    most: usize,
    most_of_user: usize,
    /// Bytes of one room, and of all.
    largest: [u64; 2],
    age: Duration,
    moves: usize,
}

impl Rooms {
    pub(crate) fn new(limits: &Limits) -> Rooms {
        Rooms {
            all: Mutex::default(),
            most: limits.rooms,
            most_of_user: limits.rooms_of_user,
            largest: [limits.room_bytes, limits.rooms_bytes],
            age: limits.room_age,
            moves: limits.moves,
        }
    }

    /// The room of a user.
    ///
    /// # Errors
    /// It is not there, or not there any more.
    pub(super) fn of(&self, user: &str, room: &str) -> Result<Arc<Room>, Problem> {
        self.with(|all| {
            let found = all.get(&(user.to_owned(), room.to_owned())).cloned();
            let found = found.ok_or_else(|| {
                Problem::absent("there is no such room, or it has been given up")
                    .help("PUT it and its files again")
            })?;
            *found.used.lock().unwrap_or_else(PoisonError::into_inner) = Instant::now();
            Ok(found)
        })
    }

    /// Makes a room; one that is there stays.
    ///
    /// # Errors
    /// The name is none, or all rooms are in use.
    pub(super) fn open(&self, user: &str, room: &str) -> Result<(), Problem> {
        if !ncc_studio::is_room(room) {
            return Err(Problem::request("a room has a name of 1 to 64 letters, digits and `-`"));
        }
        self.with(|all| {
            let key = (user.to_owned(), room.to_owned());
            if all.contains_key(&key) {
                return Ok(());
            }
            let of_user = all.keys().filter(|(own, _)| own == user).count();
            let has_place = (of_user < self.most_of_user || drop_oldest(all, |(own, _)| own == user))
                && (all.len() < self.most || drop_oldest(all, |_| true));
            if !has_place {
                return Err(Problem::busy("all rooms are in use"));
            }
            all.insert(key, Arc::new(Room::new()));
            Ok(())
        })
    }

    /// Lets go of a room.
    pub(super) fn close(&self, user: &str, room: &str) {
        self.with(|all| {
            all.remove(&(user.to_owned(), room.to_owned()));
        });
    }

    /// Makes place for so many bytes that a room shall hold.
    ///
    /// # Errors
    /// They are too many for it, or all rooms together hold too much.
    pub(super) fn reserve(&self, room: &Arc<Room>, bytes: u64) -> Result<(), Problem> {
        let [one, together] = self.largest;
        if bytes > one {
            return Err(Problem::too_large(one));
        }
        self.with(|all| {
            loop {
                let others = all.values().filter(|own| !Arc::ptr_eq(own, room)).map(|own| own.bytes());
                if others.sum::<u64>() + bytes <= together {
                    room.bytes.store(bytes, Ordering::Relaxed);
                    return Ok(());
                }
                // The room itself is in use.
                if !drop_oldest(all, |_| true) {
                    return Err(Problem::busy("the rooms hold too much"));
                }
            }
        })
    }

    /// Counts what a room holds after a request. One that holds too much is given up.
    pub(super) fn count(&self, room: &Arc<Room>, inside: &Inside) {
        if self.reserve(room, inside.bytes()).is_err() {
            self.with(|all| all.retain(|_, own| !Arc::ptr_eq(own, room)));
        }
    }

    /// Number of rooms.
    pub(super) fn len(&self) -> usize {
        self.with(|all| all.len())
    }

    /// Moves of a program at most, where its path is asked for.
    pub(crate) fn moves(&self) -> usize {
        self.moves
    }

    /// The longest time for which a room is kept without use.
    pub(super) fn age(&self) -> Duration {
        self.age
    }

    /// Does something with the rooms that are not too old.
    fn with<T>(&self, does: impl FnOnce(&mut BTreeMap<Key, Arc<Room>>) -> T) -> T {
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|_, room| !room.is_idle() || room.used().elapsed() <= self.age);
        does(&mut all)
    }
}

/// Drops the room that has not been used for the longest time, of those that nobody uses; whether there was one.
fn drop_oldest(all: &mut BTreeMap<Key, Arc<Room>>, of: impl Fn(&Key) -> bool) -> bool {
    let idle = all.iter().filter(|(key, room)| of(key) && room.is_idle());
    let oldest = idle.min_by_key(|(_, room)| room.used()).map(|(key, _)| key.clone());
    oldest.is_some_and(|key| all.remove(&key).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rooms(most: usize, most_of_user: usize, largest: [u64; 2]) -> Rooms {
        Rooms { all: Mutex::default(), most, most_of_user, largest, age: Duration::from_secs(3600), moves: 9 }
    }

    #[test]
    fn the_oldest_room_of_a_user_makes_place() {
        let rooms = rooms(3, 2, [100, 100]);
        for (user, room) in [("ana", "a"), ("bob", "x"), ("ana", "b")] {
            rooms.open(user, room).expect("a room");
        }
        // Both of ana's have been used; `a` was used last.
        rooms.of("ana", "b").expect("a room");
        rooms.of("ana", "a").expect("a room");
        rooms.open("ana", "c").expect("a room");
        assert!(rooms.of("ana", "b").is_err());
        assert!(rooms.of("ana", "a").is_ok() && rooms.of("bob", "x").is_ok());
        assert!(rooms.of("bob", "a").is_err(), "a room is its user's alone");
    }

    #[test]
    fn a_room_in_use_is_never_taken_away() {
        let rooms = rooms(2, 2, [100, 100]);
        rooms.open("ana", "a").expect("a room");
        rooms.open("ana", "b").expect("a room");
        let [a, b] = ["a", "b"].map(|room| rooms.of("ana", room).expect("a room"));
        assert!(rooms.open("ana", "c").is_err() && rooms.open("bob", "c").is_err());
        drop(b);
        rooms.open("bob", "c").expect("the place of b");
        assert!(rooms.of("ana", "b").is_err());
        drop(a);
    }

    #[test]
    fn bytes_have_their_limits() {
        let rooms = rooms(9, 9, [60, 100]);
        for room in ["a", "b"] {
            rooms.open("ana", room).expect("a room");
        }
        let a = rooms.of("ana", "a").expect("a room");
        assert!(rooms.reserve(&a, 61).is_err());
        rooms.reserve(&a, 60).expect("place");
        let b = rooms.of("ana", "b").expect("a room");
        assert!(rooms.reserve(&b, 41).is_err(), "a is in use");
        drop(a);
        rooms.reserve(&b, 41).expect("the place of a");
        assert!(rooms.of("ana", "a").is_err());
        let mut inside = Inside::default();
        inside.put("name", vec![0; 60]);
        rooms.count(&b, &inside);
        assert!(rooms.of("ana", "b").is_err(), "it holds too much");
    }
}
