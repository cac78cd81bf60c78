//! The files of a crate use each other in one direction: no file uses, by way of others, one that uses it.
//!
//! A module and the files of its own folder may do so: a parent puts together what its children do, and they use
//! what it declares for all of them. A circle within a folder therefore counts only if it is one without the
//! parents' uses of what is below them, and a circle that leaves the folder counts always.

use crate::uses::{Crate, Edges};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Circles that are allowed: the crate, its files, and why. No files: any circles of that crate.
const KNOWN: &[(&str, &[&str], &str)] = &[
    (
        "experiments",
        &["kinds.rs", "robustness/areas/experiments.rs", "robustness/mod.rs"],
        "the experiment that spoils files spoils, among others, files of experiments",
    ),
    (
        "python",
        &["species.rs", "tree.rs"],
        "a species grows trees, and a tree has a species: that is the interface",
    ),
    (
        "tree",
        &["param/checked.rs", "param/space.rs"],
        "values of a space, and the space that checks them: two halves",
    ),
    (
        "weber-penn",
        &["params/active.rs", "params/table.rs"],
        "the activity of a row is a function of the model, and the rows make the model",
    ),
];

/// The circles that count.
fn circles(files: &Crate, edges: &Edges) -> Vec<BTreeSet<usize>> {
    let mut counted = Vec::new();
    for circle in closed(edges) {
        let within = |&&root: &&usize| circle.iter().all(|&file| file == root || files.is_below(file, root));
        if circle.iter().any(|root| within(&root)) {
            let inside = |(from, to): &(usize, usize)| {
                circle.contains(from) && circle.contains(to) && !files.is_below(*to, *from)
            };
            let rest = edges.iter().filter(|(edge, _)| inside(edge));
            counted.extend(closed(&rest.map(|(edge, names)| (*edge, names.clone())).collect()));
        } else {
            counted.push(circle);
        }
    }
    counted
}

/// The sets of files that use each other in a circle.
fn closed(edges: &Edges) -> Vec<BTreeSet<usize>> {
    let reached = |from: usize| {
        let (mut found, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(at) = open.pop() {
            for (_, to) in edges.keys().filter(|(user, _)| *user == at) {
                if found.insert(*to) {
                    open.push(*to);
                }
            }
        }
        found
    };
    let files: BTreeSet<usize> = edges.keys().map(|(from, _)| *from).collect();
    let reached: Vec<(usize, BTreeSet<usize>)> =
        files.into_iter().map(|file| (file, reached(file))).collect();
    let mut circles = Vec::new();
    for (file, there) in &reached {
        let back = |(other, here): &&(usize, BTreeSet<usize>)| there.contains(other) && here.contains(file);
        let circle: BTreeSet<usize> = reached.iter().filter(back).map(|(other, _)| *other).collect();
        if circle.first() == Some(file) {
            circles.push(circle);
        }
    }
    circles
}

/// The files of a circle and the names that tie it.
fn describe(files: &Crate, edges: &Edges, circle: &BTreeSet<usize>) -> String {
    let mut text = format!("{} files in a circle:\n", circle.len());
    for ((from, to), names) in edges {
        if circle.contains(from) && circle.contains(to) {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let _ = writeln!(text, "  {} → {}: {}", files.file(*from), files.file(*to), names.join(", "));
        }
    }
    text
}

#[test]
fn files_of_a_crate_use_each_other_in_one_direction() {
    let crates = pleach_tests::root().join("crates");
    let mut faults = String::new();
    let mut met = BTreeSet::new();
    let mut names: Vec<String> = std::fs::read_dir(&crates)
        .expect("the folder of the crates")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name of UTF-8"))
        .collect();
    names.sort();
    for name in &names {
        let files = Crate::read(&crates.join(name).join("src"));
        let edges = files.edges();
        for circle in circles(&files, &edges) {
            let these: BTreeSet<&str> = circle.iter().map(|&file| files.file(file)).collect();
            let known = KNOWN.iter().position(|(of, known, _)| {
                of == name && (known.is_empty() || known.iter().copied().eq(these.iter().copied()))
            });
            match known {
                Some(entry) => {
                    met.insert(entry);
                }
                None => {
                    let _ = writeln!(faults, "crates/{name}/src: {}", describe(&files, &edges, &circle));
                }
            }
        }
    }
    for (i, (name, known, _)) in KNOWN.iter().enumerate() {
        if !met.contains(&i) {
            let _ = writeln!(
                faults,
                "crates/{name}/src: no such circle any more, take it off the list: {known:?}"
            );
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

/// The circles of a crate, by names of files.
fn circles_of(files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let files = Crate::new(files.iter().copied());
    let of = |circle: &BTreeSet<usize>| circle.iter().map(|&file| files.file(file).to_owned()).collect();
    circles(&files, &files.edges()).iter().map(of).collect()
}

#[test]
fn a_circle_is_found_however_its_paths_are_written() {
    let uses_a = [
        "use crate::a::A;",
        "use crate::{a::{A as Other, B}, c};",
        "use super::a::A;",
        "use crate::a; fn f(x: a::A) {}",
        "use super::a::*;",
        "fn f() { let x = crate::a::A::new(); }",
        "fn f() { assert!(super::a::B == 1); }",
        "use crate::A;",
        "mod within { use super::super::a::A; }",
    ];
    let lib = "mod a; mod b; mod c; pub use a::A;";
    let a = "use crate::b::C; pub struct A; pub struct B;";
    for uses in uses_a {
        let b = format!("{uses} pub struct C;");
        let files = [("lib.rs", lib), ("a.rs", a), ("b.rs", &b), ("c.rs", "use crate::a::A;")];
        assert_eq!(circles_of(&files), [["a.rs", "b.rs"]], "{uses}");
    }
    let long =
        [("lib.rs", ""), ("a.rs", "use crate::b::C; struct A;"), ("b.rs", "use crate::c::D; struct C;")];
    let end = [("c.rs", "use crate::a::A; struct D;")];
    assert_eq!(circles_of(&[&long[..], &end].concat()), [["a.rs", "b.rs", "c.rs"]]);
}

#[test]
fn what_is_no_use_makes_no_circle() {
    let no_uses = [
        "// use crate::a::A;",
        "/// See [`A`](crate::a::A).",
        "const TEXT: &str = \"use crate::a::A;\";",
        "#[cfg(test)] mod tests { use crate::a::A; }",
        "#[cfg(test)] use crate::a::A;",
        "use other::a::A;",
        "pub use crate::a::A;",
        "fn f(x: X) { x.a(); }",
    ];
    for no_use in no_uses {
        let b = format!("{no_use}\npub struct C;");
        let files = [("lib.rs", ""), ("a.rs", "use crate::b::C; pub struct A;"), ("b.rs", &b)];
        assert!(circles_of(&files).is_empty(), "{no_use}");
    }
}

#[test]
fn a_module_and_its_own_folder_are_no_circle() {
    let parent = "mod x; mod y; struct Z; fn f() -> x::X { y::Y }";
    let child = ("p/x.rs", "use super::Z; pub struct X;");
    let files = [("lib.rs", "mod p;"), ("p/mod.rs", parent), child, ("p/y.rs", "pub struct Y;")];
    assert!(circles_of(&files).is_empty());
    let files = [("lib.rs", "mod p;"), ("p.rs", parent), child, ("p/y.rs", "pub struct Y;")];
    assert!(circles_of(&files).is_empty());
    // Two children are.
    let child = ("p/x.rs", "use super::Z; use super::y::Y; pub struct X;");
    let files =
        [("lib.rs", "mod p;"), ("p/mod.rs", parent), child, ("p/y.rs", "use super::x::X; pub struct Y;")];
    assert_eq!(circles_of(&files), [["p/x.rs", "p/y.rs"]]);
    // So is a way out of the folder and back.
    let child = ("p/x.rs", "use crate::q::Q; pub struct X;");
    let files = [
        ("lib.rs", "mod p; mod q;"),
        ("p/mod.rs", parent),
        child,
        ("q.rs", "use crate::p::Z; pub struct Q;"),
    ];
    assert_eq!(circles_of(&files), [["p/mod.rs", "p/x.rs", "q.rs"]]);
    // The crate's root is no such parent.
    let files =
        [("lib.rs", "mod a; struct Z; fn f() -> a::A { a::A }"), ("a.rs", "use crate::Z; pub struct A;")];
    assert_eq!(circles_of(&files), [["lib.rs", "a.rs"]]);
}

#[test]
fn a_parent_that_hands_names_on_uses_them_where_its_code_does() {
    let hands_on = "mod x; pub use x::X; pub(super) use x::Y;";
    let circle = |code: &str, child: &str| {
        let parent = format!("{hands_on} pub struct Z; {code}");
        let files = [("lib.rs", "mod p; mod q;"), ("p/mod.rs", &parent), ("p/x.rs", child)];
        circles_of(&[&files[..], &[("q.rs", "use crate::p::Z; pub struct Q;")]].concat())
    };
    let child = "use crate::q::Q; pub struct X; pub struct Y;";
    assert!(circle("", child).is_empty());
    assert_eq!(circle("fn f() -> X { X }", child), [["p/mod.rs", "p/x.rs", "q.rs"]]);
    // A child that takes its sibling's name from the parent uses the sibling.
    let x = ("p/x.rs", "use super::y::W; pub struct X;");
    assert_eq!(
        circles_of(&[("p/mod.rs", hands_on), x, ("p/y.rs", "use super::X; pub struct W;")]),
        [["p/x.rs", "p/y.rs"]]
    );
}

#[test]
fn modules_of_tests_are_left_out() {
    let circle = |attribute: &str| {
        let a = format!("{attribute} mod tests; pub struct A;");
        let tests = ("a/tests.rs", "use crate::b::B; use super::A;");
        let b = ("b.rs", "use crate::a::tests::T; pub struct B;");
        circles_of(&[("lib.rs", "mod a; mod b;"), ("a/mod.rs", &a), tests, b])
    };
    assert!(circle("#[cfg(test)]").is_empty());
    assert!(circle("#[cfg(all(test, unix))]").is_empty());
    assert_eq!(circle("#[cfg(unix)]"), [["a/tests.rs", "b.rs"]]);
}
