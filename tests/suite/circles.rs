//! Files of a crate form no circle: where one file names another, that one names it neither directly nor through others.
//!
//! A file names another by a path from `crate`, `super` or `self`, in a `use` or in an expression. In the rooms of `STRICT` a
//! path from the name of a child counts as well, and so does what the root of the crate holds. A file that names what
//! its child has, while the child names what the file has, is a circle too: what both need belongs into a file below them.
//! Tests within a file and comments do not count.

use std::collections::{BTreeMap, BTreeSet};

use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

use crate::rooms::leaves;
use crate::tidy::{code, files, text};

/// Crates, by their folders.
const ROOMS: &[&str] = &[
    "analysis/check",
    "analysis/diff",
    "analysis/plot",
    "analysis/simulate",
    "analysis/time",
    "backends",
    "cli",
    "driver",
    "engine",
    "frontends",
    "frontends/ir",
    "ir",
    "ir/dialects",
    "ir/exec",
    "ir/passes",
    "machines",
];

/// Rooms in which a file that uses its own children, and the root of the crate, count as any other file.
const STRICT: &[&str] = &[
    "analysis/check",
    "analysis/diff",
    "analysis/plot",
    "analysis/simulate",
    "analysis/time",
    "cli",
    "engine",
    "frontends",
    "frontends/ir",
    "ir/dialects",
    "machines",
];

/// The path of a module from its crate's root; that of the root is empty.
type Module = Vec<String>;

/// Which modules a module names, each with the path by which it does.
type Graph = BTreeMap<Module, BTreeMap<Module, String>>;

/// The module that a source file is, by its path under `src`.
fn module(path: &str) -> Module {
    let mut parts: Module = path.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    let last = parts.last().map(String::as_str).unwrap_or_default();
    if last == "mod" || parts.len() == 1 && ["lib", "main"].contains(&last) {
        parts.pop();
    }
    parts
}

/// Code without its tests, and without the paths of `pub(in …)`, which name no item.
fn product(source: &str) -> String {
    let source = source.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let mut parts = source.split("pub(in ");
    let mut out = parts.next().unwrap_or_default().to_owned();
    parts.for_each(|part| out.push_str(part.split_once(')').map_or(part, |(_, rest)| rest)));
    code(&out, false)
}

/// The modules that a `use` tree or a single path names, from a module on.
fn named_from(start: &Module, tree: &str) -> Vec<Module> {
    let mut paths = BTreeSet::new();
    leaves(tree, "", &mut paths);
    let module = |path: &String| {
        let mut module = start.clone();
        for part in path.split("::") {
            match part {
                "" | "self" => {}
                "super" => drop(module.pop()),
                part => module.push(part.to_owned()),
            }
        }
        module
    };
    paths.iter().map(module).collect()
}

/// The paths from the root that the code of a module names by the names of its children. What it offers further by
/// `pub use` it does not need itself.
fn named_by_children(own: &Module, code: &str, modules: &BTreeSet<Module>) -> Vec<Module> {
    let children = modules.iter().filter(|module| module.len() == own.len() + 1 && module.starts_with(own));
    let mut found = Vec::new();
    for name in children.filter_map(|child| child.last()) {
        for (at, _) in code.match_indices(&format!("{name}::")) {
            let before = code[..at].chars().next_back().unwrap_or(' ');
            let line = code[..at].rsplit('\n').next().unwrap_or_default();
            let offered = line.starts_with("pub use ") || line.starts_with("pub(crate) use ");
            if !offered && !before.is_ascii_alphanumeric() && !['_', '$', ':'].contains(&before) {
                found.extend(named_from(own, &code[at..]));
            }
        }
    }
    found
}

/// The paths from the root that the code of a module names.
fn named(own: &Module, code: &str) -> Vec<Module> {
    let parent: Module = own.iter().take(own.len().saturating_sub(1)).cloned().collect();
    let mut found = Vec::new();
    for (word, start) in [("crate::", &Module::new()), ("super::", &parent), ("self::", own)] {
        for (at, _) in code.match_indices(word) {
            let before = code[..at].chars().next_back().unwrap_or(' ');
            // `$crate` is another crate's, and within a path it has been looked at with what is before it.
            if !before.is_ascii_alphanumeric() && !['_', '$', ':'].contains(&before) {
                found.extend(named_from(start, &code[at + word.len()..]));
            }
        }
    }
    found
}

/// Which file names which, from sources by their paths under `src`.
fn graph(sources: &[(String, String)], strict: bool) -> Graph {
    let modules: BTreeSet<Module> = sources.iter().map(|(path, _)| module(path)).collect();
    let mut graph = Graph::new();
    for (path, source) in sources {
        let own = module(path);
        let mut names = BTreeMap::new();
        let code = product(source);
        let by_children = if strict { named_by_children(&own, &code, &modules) } else { Vec::new() };
        for path in named(&own, &code).into_iter().chain(by_children) {
            // The longest beginning of it that is a file; the root alone is no name of a file.
            let known = (usize::from(!strict)..=path.len()).rev().map(|long| path[..long].to_vec());
            if let Some(other) = known.into_iter().find(|part| modules.contains(part))
                && other != own
            {
                names.entry(other).or_insert_with(|| path.join("::"));
            }
        }
        graph.insert(own, names);
    }
    graph
}

/// The modules that a module leads to.
fn reach<'g>(graph: &'g Graph, from: &'g Module) -> BTreeSet<&'g Module> {
    let mut found = BTreeSet::new();
    let mut open = vec![from];
    while let Some(next) = open.pop() {
        let fresh = graph.get(next).into_iter().flat_map(BTreeMap::keys).filter(|other| found.insert(*other));
        open.extend(fresh.collect::<Vec<_>>());
    }
    found
}

/// The circles of a graph: each a set of modules that all lead to one another.
fn circles(graph: &Graph) -> BTreeSet<BTreeSet<&Module>> {
    let reached: BTreeMap<&Module, BTreeSet<&Module>> =
        graph.keys().map(|module| (module, reach(graph, module))).collect();
    let circle = |module: &Module| -> BTreeSet<&Module> {
        let others = reached.get(module).into_iter().flatten();
        others.copied().filter(|other| reached.get(other).is_some_and(|back| back.contains(module))).collect()
    };
    graph.keys().map(circle).filter(|circle| !circle.is_empty()).collect()
}

/// A circle in words: each file with those of the circle that it names.
fn described(circle: &BTreeSet<&Module>, graph: &Graph) -> String {
    let mut out = format!("a circle of {} files", circle.len());
    for module in circle {
        for (other, path) in graph.get(*module).into_iter().flatten().filter(|(m, _)| circle.contains(m)) {
            out.push_str(&format!("\n    {} names {path} of {}", module.join("/"), other.join("/")));
        }
    }
    out
}

#[test]
fn files_form_no_circles() {
    let mut failures = Failures::default();
    for room in ROOMS {
        let src = root().join(room).join("src");
        let all = files(&format!("{room}/src"), &[".rs"]);
        assert!(!all.is_empty(), "{room} has no files");
        let all = all.iter().filter(|path| !path.ends_with("tests.rs"));
        let sources: Vec<(String, String)> = all
            .map(|path| {
                let name = path.strip_prefix(&src).expect("a file of the crate").to_string_lossy();
                (name.replace('\\', "/"), text(path))
            })
            .collect();
        let graph = graph(&sources, STRICT.contains(room));
        circles(&graph).iter().for_each(|circle| failures.add(room, described(circle, &graph)));
    }
    failures.finish();
}

#[test]
fn circles_are_found() {
    let sources = |all: &[(&str, &str)]| -> Vec<(String, String)> {
        all.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect()
    };
    let count = |all: &[(&str, &str)]| -> Vec<usize> {
        let graph = graph(&sources(all), false);
        circles(&graph).iter().map(BTreeSet::len).collect()
    };
    // A parent and its child; by way of a third file; in an expression.
    assert_eq!(count(&[("a.rs", "use self::b::B;"), ("a/b.rs", "use super::A;")]), [2]);
    assert_eq!(
        count(&[
            ("a.rs", "use crate::{c, d::{self, b2::X}};"),
            ("c.rs", "use crate::d::D;"),
            ("d/mod.rs", "fn f() -> u8 { crate::a::g() }"),
            ("d/b2.rs", "use super::super::c::C;"),
        ]),
        [4]
    );
    // One direction alone; a test, a comment, a visibility; the root, which all may name.
    let tests = "use crate::b::B;\n#[cfg(test)]\nmod tests {\n    use crate::c::C;\n}\n";
    assert!(count(&[("a.rs", tests), ("b.rs", "// crate::a::A"), ("c.rs", "use crate::a::A;")]).is_empty());
    assert!(count(&[("a.rs", "use self::b::B;"), ("a/b.rs", "pub(in crate::a) struct B;")]).is_empty());
    assert!(count(&[("lib.rs", "use crate::a::A;"), ("a.rs", "use crate::Target;")]).is_empty());
    // Where the root and children count: a file that uses what a child has, which uses what the file has.
    let strict = |all: &[(&str, &str)]| -> Vec<usize> {
        let graph = graph(&sources(all), true);
        circles(&graph).iter().map(BTreeSet::len).collect()
    };
    let child = [("a.rs", "mod b;\nuse b::B;"), ("a/b.rs", "use super::A;")];
    assert_eq!((count(&child), strict(&child)), (Vec::new(), vec![2]));
    let root = [("lib.rs", "use crate::a::A;"), ("a.rs", "use crate::Target;")];
    assert_eq!(strict(&root), [2]);
    assert!(strict(&[("lib.rs", "pub use a::A;"), ("a.rs", "use crate::Target;")]).is_empty());
}
