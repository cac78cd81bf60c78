//! `pleach grammar`, and species that have one, as a user would run them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach_tests::Dir;

#[test]
fn a_grammar_is_printed_derived_and_drawn() {
    let dir = Dir::new();
    std::fs::write(dir.path("plant.lsys"), "axiom:X\nsteps:2\nangle:20\nX-->F[+X]F[-X]+X\nF-->FF\n").unwrap();
    let printed = dir.run(["grammar", "plant.lsys"]).ok();
    assert!(printed.starts_with("dialect: abop\nsteps: 2\nangle: 20\naxiom: X\nX -> F[+X]F[-X]+X\nF -> FF"));
    std::fs::write(dir.path("again.lsys"), &printed).unwrap();
    assert_eq!(dir.run(["grammar", "again.lsys"]).ok(), printed);
    assert_eq!(dir.run(["grammar", "plant.lsys", "--derive", "1"]).ok().trim(), "F[+X]F[-X]+X");
    let _ = dir.run(["grammar", "plant.lsys", "--svg", "plant.svg"]).ok();
    let drawing = std::fs::read_to_string(dir.path("plant.svg")).unwrap();
    assert!(drawing.starts_with("<svg") && drawing.contains("<path"), "{drawing}");
    let _ = dir.run(["grammar", "plant.lsys", "--check"]).ok();
}

#[test]
fn mistakes_are_shown_in_their_places() {
    let dir = Dir::new();
    std::fs::write(dir.path("bad.lsys"), "axiom: F[+F\nF(x) -> F(x*y)\n").unwrap();
    let told = ["2 mistakes", "bad.lsys:1:9", "bad.lsys:2:13", "`y` is not a known name"];
    dir.run(["grammar", "bad.lsys", "--check"]).fails(1, &told);
    std::fs::write(dir.path("zero.lsys"), "axiom: F(0)\nF(x) -> F(1/x)\n").unwrap();
    let told = ["step 1", "division by zero in the rule for `F(x)`", "zero.lsys:2:11"];
    dir.run(["grammar", "zero.lsys", "--derive", "3"]).fails(1, &told);
    dir.run(["grammar", "acer.toml"]).fails(1, &["acer.toml"]);
}

#[test]
fn species_with_grammars_grow_like_others() {
    let dir = Dir::new();
    let list = dir.run(["species"]).ok();
    assert!(list.contains("hewitt_quaking_aspen") && list.contains("abop_ternary_a"), "{list}");
    let _ = dir.run(["silhouette", "steen_tree", "-o", "steen.png", "--size", "64"]).ok();
    let _ = dir.run(["grow", "hewitt_palm", "--seed", "3", "-o", "palm.obj"]).ok();
    // A file that was printed grows the same tree.
    std::fs::write(dir.path("palm.toml"), dir.run(["species", "hewitt_palm"]).ok()).unwrap();
    let _ = dir.run(["grow", "palm.toml", "--seed", "3", "-o", "again.obj"]).ok();
    let vertices = |name: &str| {
        let text = std::fs::read_to_string(dir.path(name)).unwrap();
        text.lines().filter(|line| line.starts_with("v ")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(vertices("palm.obj").len() > 1000);
    assert!(vertices("palm.obj") == vertices("again.obj"));
}
