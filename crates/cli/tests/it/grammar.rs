//! `pleach grammar`, and species that have one, as a user would run them.

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

/// What is wrong is refused at once, with its place and a caret.
#[test]
fn bad_grammars_are_refused_quickly() {
    let dir = Dir::new();
    let doubling = "steps: 64\naxiom: F\nF -> FF\n";
    let nan = "steps: 3\naxiom: F(-1)\nF(x) -> F(sqrt(x))\n";
    let cases: [(&str, &str, &[&str]); 13] = [
        ("", "1:1", &["the grammar has no axiom"]),
        ("\n\n  # nothing\n", "1:1", &["the grammar has no axiom"]),
        (&format!("axiom: F{}", "[".repeat(100_000)), "1:73", &["nested more than 64 deep", "^"]),
        (&format!("axiom: F({}", "(".repeat(100_000)), "1:74", &["nested more than 64 deep", "^"]),
        ("param for = 1 in 0..2\naxiom: F", "1:7", &["`for` is taken", "^^^"]),
        ("axiom: F\nconst let = 1", "2:7", &["`let` is taken", "^^^"]),
        ("axiom: F\nF(sin) -> F(1)", "2:3", &["`sin` is taken", "^^^"]),
        ("module in\naxiom: F", "1:8", &["`in` is taken", "^^"]),
        ("axiom: F\nF -(-1)-> F -2-> G", "2:5", &["is -1", "allowed is 0 to 1", "^^"]),
        ("param a = 5 in 0..1\naxiom: F", "1:7", &["`a` is 5", "allowed is 0 to 1", "^"]),
        (doubling, "3:1", &["more than 20000000 symbols", "`F`", "^^^^^^^"]),
        (nan, "3:11", &["is NaN, which is not finite", "`F(x)`", "^^^^"]),
        ("axiom: F(1/(2-2))", "1:10", &["division by zero", "^^^"]),
    ];
    for (text, place, told) in cases {
        std::fs::write(dir.path("bad.lsys"), text).unwrap();
        let started = std::time::Instant::now();
        let run = dir.run(["grammar", "bad.lsys", "--derive", "64"]);
        run.fails(1, &[told, &[&format!("bad.lsys:{place}")]].concat());
        assert!(started.elapsed().as_secs() < 20, "{place}: {:?}", started.elapsed());
    }
    // A hundred megabytes, of which one is read.
    let large = "F".repeat(1 << 20).repeat(100);
    std::fs::write(dir.path("large.lsys"), format!("axiom: {large}")).unwrap();
    let started = std::time::Instant::now();
    dir.run(["grammar", "large.lsys"]).fails(1, &["bytes or more, at most 1048576", "large.lsys:1:1"]);
    assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
    std::fs::write(dir.path("bytes.lsys"), b"axiom: F\nF -> \xff").unwrap();
    dir.run(["grammar", "bytes.lsys"]).fails(1, &["bytes.lsys:2:6", "0xff is not UTF-8"]);
}

#[test]
fn mistakes_in_a_species_file_are_drawn_where_they_stand() {
    let dir = Dir::new();
    let text = "generator = \"lsystem\"\nsize = 12\ngrammar = '''\nscale: size\nparam size = 1 in 0..2\naxiom: F[+F\nF -> Q(foo)\n'''\n";
    std::fs::write(dir.path("bad.toml"), text).unwrap();
    let told = [
        "bad.toml:6:9: `[` is not closed: there is no `]`",
        "6 | axiom: F[+F",
        "  |         ^",
        "brackets pair up within one successor",
        "bad.toml:7:8: `foo` is not a known name",
        "7 | F -> Q(foo)",
        "  |        ^^^",
    ];
    dir.run(["grow", "bad.toml", "--stats-only"]).fails(1, &told);
    std::fs::write(dir.path("bad.toml"), text.replace("F[+F", "F").replace("Q(foo)", "FF")).unwrap();
    let told = ["bad.toml:2:8: `size` is 12, which is out of range", "2 | size = 12", "  |        ^^"];
    dir.run(["grow", "bad.toml", "--stats-only"]).fails(1, &told);
    std::fs::write(dir.path("acer.toml"), "levels = 9\n").unwrap();
    dir.run(["grow", "acer.toml"]).fails(1, &["acer.toml:1:10: `levels` is 9", "1 | levels = 9", "^"]);
}

#[test]
fn grammars_of_other_programs_are_translated_and_derived() {
    let dir = Dir::new();
    let lpy = "R = 2\nAxiom: _(0.1);(2)A(8)\nderivation length: 2\nproduction:\nA(s) --> F(s)[+(85)A(s/R)]\nendlsystem\n";
    let _ = dir.file("bush.lpy", lpy);
    let run = dir.run(["grammar", "bush.lpy", "--from", "lpy", "--derive", "2"]);
    assert!(run.stderr().contains("left out are colours and shapes: ;"), "{run}");
    assert_eq!(run.ok().trim(), "!(0.1)F(8)[+(85)F(4)[+(85)A(2)]]");
    let cpfg =
        "#define N 1\nLsystem: 1\nderivation length: N\nAxiom: X\nX --> F[+X]/* left */F\nendlsystem\n";
    let _ = dir.file("plant.l", cpfg);
    let normal = dir.run(["grammar", "plant.l", "--from", "cpfg"]).ok();
    assert!(normal.contains("const N = 1") && normal.contains("X -> F[+X]F"), "{normal}");
    let _ = dir.file("code.lpy", "Axiom: A\nimport math\n");
    dir.run(["grammar", "code.lpy", "--from", "lpy"])
        .fails(1, &["code.lpy:2:1", "`import math`", "no code is run"]);
    let _ = dir.file("odd.lpy", "Axiom: A\n\nA --> F(\n");
    dir.run(["grammar", "odd.lpy", "--from", "lpy"]).fails(1, &["odd.lpy:3:"]);
}
