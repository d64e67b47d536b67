//! A map whose copies share what is the same in them: facts about variables that are kept for every statement, of
//! which each changes one. A copy costs nothing, and a change costs a small part of the map.
//!
//! Not here: an order of the entries.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::rc::Rc;

/// Leaves of a map, among which its entries are spread by their keys.
const LEAVES: usize = 256;

type Leaf<K, V> = Rc<Vec<(K, V)>>;

/// The map.
#[derive(Clone, Debug)]
pub(crate) struct SharedMap<K, V>(Option<Rc<Vec<Leaf<K, V>>>>);

impl<K, V> Default for SharedMap<K, V> {
    fn default() -> Self {
        SharedMap(None)
    }
}

fn leaf_of<Q: Hash + ?Sized>(key: &Q) -> usize {
    let mut hasher = DefaultHasher::new();
    key.hash(&mut hasher);
    hasher.finish() as usize % LEAVES
}

impl<K: Clone + Eq + Hash, V: Clone + PartialEq> SharedMap<K, V> {
    /// The value of a key.
    pub(crate) fn get<Q: Hash + Eq + ?Sized>(&self, key: &Q) -> Option<&V>
    where
        K: std::borrow::Borrow<Q>,
    {
        let leaf = &self.0.as_ref()?[leaf_of(key)];
        leaf.iter().find(|(own, _)| own.borrow() == key).map(|(_, value)| value)
    }

    fn leaf(&mut self, at: usize) -> &mut Vec<(K, V)> {
        let leaves = self.0.get_or_insert_with(|| Rc::new(vec![Leaf::default(); LEAVES]));
        Rc::make_mut(&mut Rc::make_mut(leaves)[at])
    }

    /// Gives a key a value.
    pub(crate) fn insert(&mut self, key: K, value: V) {
        let leaf = self.leaf(leaf_of(&key));
        match leaf.iter_mut().find(|(own, _)| *own == key) {
            Some((_, own)) => *own = value,
            None => leaf.push((key, value)),
        }
    }

    /// Takes a key out.
    pub(crate) fn remove(&mut self, key: &K) {
        if self.get(key).is_some() {
            self.leaf(leaf_of(key)).retain(|(own, _)| own != key);
        }
    }

    /// Takes all out.
    pub(crate) fn clear(&mut self) {
        self.0 = None;
    }

    /// All entries, in no order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &(K, V)> {
        self.0.iter().flat_map(|leaves| leaves.iter().flat_map(|leaf| leaf.iter()))
    }

    /// Leaves those that are wanted.
    pub(crate) fn retain(&mut self, mut wanted: impl FnMut(&K, &V) -> bool) {
        if self.iter().all(|(key, value)| wanted(key, value)) {
            return;
        }
        for at in 0..LEAVES {
            let all = self.0.as_ref().is_none_or(|leaves| leaves[at].iter().all(|(k, v)| wanted(k, v)));
            if !all {
                self.leaf(at).retain(|(key, value)| wanted(key, value));
            }
        }
    }

    /// Brings another map in: `with` gets the values of a key in both. Leaves that both share stay as they are, so that
    /// it must keep values that are the same, and those that neither has.
    pub(crate) fn join(
        &mut self,
        other: &SharedMap<K, V>,
        with: impl Fn(Option<&V>, Option<&V>) -> Option<V>,
    ) {
        if let (Some(own), Some(other)) = (&self.0, &other.0)
            && Rc::ptr_eq(own, other)
        {
            return;
        }
        for at in 0..LEAVES {
            let [own, theirs] = [&*self, other].map(|map| map.0.as_ref().map(|leaves| &leaves[at]));
            let same = match (own, theirs) {
                (Some(own), Some(theirs)) => Rc::ptr_eq(own, theirs),
                (None, None) => true,
                (Some(one), None) | (None, Some(one)) => one.is_empty(),
            };
            if same {
                continue;
            }
            let entries = |leaf: Option<&Leaf<K, V>>| leaf.map(|leaf| leaf.to_vec()).unwrap_or_default();
            let (own, theirs) = (entries(own), entries(theirs));
            let find = |of: &[(K, V)], key: &K| of.iter().find(|(k, _)| k == key).map(|(_, v)| v.clone());
            let mut joined = Vec::with_capacity(own.len());
            for (key, value) in &own {
                let value = with(Some(value), find(&theirs, key).as_ref());
                joined.extend(value.map(|value| (key.clone(), value)));
            }
            for (key, value) in theirs.iter().filter(|(key, _)| find(&own, key).is_none()) {
                joined.extend(with(None, Some(value)).map(|value| (key.clone(), value)));
            }
            if joined != own {
                *self.leaf(at) = joined;
            }
        }
    }
}

impl<K: Clone + Eq + Hash, V: Clone + PartialEq> PartialEq for SharedMap<K, V> {
    fn eq(&self, other: &Self) -> bool {
        let same = |own: &Leaf<K, V>, theirs: &Leaf<K, V>| {
            Rc::ptr_eq(own, theirs)
                || own.len() == theirs.len() && own.iter().all(|entry| theirs.contains(entry))
        };
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(one), None) | (None, Some(one)) => one.iter().all(|leaf| leaf.is_empty()),
            (Some(own), Some(theirs)) => {
                Rc::ptr_eq(own, theirs)
                    || own.iter().zip(theirs.iter()).all(|(own, theirs)| same(own, theirs))
            }
        }
    }
}

impl<K: Clone + Eq + Hash, V: Clone + PartialEq> FromIterator<(K, V)> for SharedMap<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(entries: I) -> Self {
        let mut map = SharedMap::default();
        map.extend(entries);
        map
    }
}

impl<K: Clone + Eq + Hash, V: Clone + PartialEq> Extend<(K, V)> for SharedMap<K, V> {
    fn extend<I: IntoIterator<Item = (K, V)>>(&mut self, entries: I) {
        entries.into_iter().for_each(|(key, value)| self.insert(key, value));
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn copies_do_not_change_each_other() {
        let mut map: SharedMap<u32, u32> = (0..2000).map(|n| (n, n)).collect();
        let before = map.clone();
        assert_eq!(map, before);
        map.insert(7, 8);
        map.remove(&9);
        assert_eq!((before.get(&7), before.get(&9)), (Some(&7), Some(&9)));
        assert_eq!((map.get(&7), map.get(&9)), (Some(&8), None));
        assert_ne!(map, before);
        map.insert(7, 7);
        map.insert(9, 9);
        assert_eq!(map, before);
        map.clear();
        assert_eq!(map, SharedMap::default());
    }

    #[test]
    fn joins_as_plain_maps_do() {
        let (own, other) = ((0..1500).map(|n| (n, n % 3)), (500..2000).map(|n| (n, n % 2)));
        let both = |a: Option<&u32>, b: Option<&u32>| match (a, b) {
            (Some(a), Some(b)) => (a == b).then_some(*a),
            (one, two) => one.or(two).copied(),
        };
        let mut map: SharedMap<u32, u32> = own.clone().collect();
        map.join(&other.clone().collect(), both);
        let (own, other): (BTreeMap<u32, u32>, BTreeMap<u32, u32>) = (own.collect(), other.collect());
        let plain: BTreeMap<u32, u32> =
            (0..2000).filter_map(|n| Some((n, both(own.get(&n), other.get(&n))?))).collect();
        assert_eq!(map.iter().cloned().collect::<BTreeMap<u32, u32>>(), plain);
        map.retain(|key, _| key % 5 == 0);
        assert_eq!(map.iter().count(), plain.keys().filter(|key| *key % 5 == 0).count());
    }
}
