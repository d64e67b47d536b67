//! A small judge of SVG: it refuses what a browser would, and gives the elements.

use std::collections::BTreeMap;

/// An element, with the text right within it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Element {
    pub(crate) name: String,
    pub(crate) attributes: BTreeMap<String, String>,
    pub(crate) text: String,
}

impl Element {
    /// An attribute that has to be there.
    pub(crate) fn get(&self, name: &str) -> &str {
        self.attributes.get(name).unwrap_or_else(|| panic!("{}: no {name}", self.name))
    }

    /// A number that has to be there, units.
    pub(crate) fn number(&self, name: &str) -> f64 {
        self.get(name).parse().unwrap_or_else(|_| panic!("{name}: {}", self.get(name)))
    }
}

/// Points of the pieces of a path that has M and l alone, units.
pub(crate) fn pieces(d: &str) -> Vec<Vec<(i32, i32)>> {
    let mut all: Vec<Vec<(i32, i32)>> = Vec::new();
    for piece in d.split('M').skip(1) {
        let apart = piece.replace('-', " -").replace('l', " ");
        let numbers: Vec<i32> =
            apart.split_whitespace().map(|n| n.parse().expect("a whole number")).collect();
        let mut at = (0, 0);
        let points = numbers.chunks_exact(2).map(|to| {
            at = (at.0 + to[0], at.1 + to[1]);
            at
        });
        all.push(points.collect());
    }
    all
}

/// The elements of a document in their order.
///
/// # Panics
/// Where it is not well-formed.
pub(crate) fn elements(document: &str) -> Vec<Element> {
    let mut all: Vec<Element> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut rest = document;
    while let Some(at) = rest.find('<') {
        let (text, tag) = rest.split_at(at);
        match open.last() {
            Some(inner) => all[*inner].text.push_str(&plain(text)),
            None => assert_eq!(text.trim(), "", "text outside of elements"),
        }
        let (tag, after) = tag[1..].split_once('>').expect("a tag ends");
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            let element = open.pop().map(|at| all[at].name.clone());
            assert_eq!(element.as_deref(), Some(name), "the element that ends");
            continue;
        }
        assert!(!open.is_empty() || all.is_empty(), "two roots");
        let (tag, empty) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
        all.push(element(tag));
        if !empty {
            open.push(all.len() - 1);
        }
    }
    assert!(open.is_empty(), "{open:?} do not end");
    assert_eq!(rest.trim(), "");
    all
}

/// A name and attributes, each with its quotes.
fn element(tag: &str) -> Element {
    let name = tag.split_whitespace().next().unwrap_or_default().to_owned();
    assert!(!name.is_empty() && name.bytes().all(|b| b.is_ascii_lowercase()), "{tag:?}");
    let mut attributes = BTreeMap::new();
    let mut rest = tag[name.len()..].trim();
    while !rest.is_empty() {
        let (key, value) = rest.split_once("=\"").unwrap_or_else(|| panic!("an attribute: {rest:?}"));
        let (value, after) = value.split_once('"').unwrap_or_else(|| panic!("a quote: {rest:?}"));
        let twice = attributes.insert(key.to_owned(), plain(value)).is_some();
        assert!(!twice, "{key} twice: {tag}");
        rest = after.trim_start();
    }
    Element { name, attributes, text: String::new() }
}

/// What text means.
fn plain(text: &str) -> String {
    assert!(!text.contains('>') && !text.chars().any(|c| c < ' ' && c != '\n'), "{text:?}");
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('&') {
        out.push_str(&rest[..at]);
        let (name, after) = rest[at + 1..].split_once(';').expect("an entity ends");
        out.push(match name {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            other => panic!("entity {other}"),
        });
        rest = after;
    }
    out + rest
}
