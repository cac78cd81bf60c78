//! `pleach blend`, as a user would run it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach_tests::Dir;

/// The lines of a species file that hold values.
fn values(text: &str) -> Vec<&str> {
    text.lines().filter(|l| l.contains('=') && !l.starts_with(['#', 'n', 'd'])).collect()
}

#[test]
fn the_ends_are_the_species_themselves() {
    let dir = Dir::new();
    for (name, at) in [("quaking_aspen", "0"), ("palm", "1")] {
        let itself = dir.run(["species", name]).ok();
        for how in [&["--at", at][..], &["--at", at, "--straight"], &["--at", at, "--layout", "looks"]] {
            let blend = dir.run([&["blend", "quaking_aspen", "palm"], how].concat()).ok();
            assert_eq!(values(&blend), values(&itself), "{how:?}");
        }
    }
}

#[test]
fn a_blend_is_a_species_that_grows() {
    let dir = Dir::new();
    let run =
        dir.run(["blend", "quaking_aspen", "silver_birch", "--straight", "--at", "0.5", "-o", "mix.toml"]);
    assert!(run.ok().contains("0.5 quaking_aspen, 0.5 silver_birch"), "{run}");
    let text = std::fs::read_to_string(dir.path("mix.toml")).unwrap();
    assert!(text.contains("name = \"mix\"") && text.contains("ratio_power = 1.35\n"), "{text}");
    let stats = dir.run(["grow", "mix.toml", "--seed", "1", "--stats-only", "--json"]).json();
    let height = stats["height_m"].as_f64().unwrap();
    assert!((8.0..30.0).contains(&height), "{height}");
}

#[test]
fn weights_take_parts_of_names() {
    let report = |args: &[&str]| Dir::new().run([&["blend", "--json"], args].concat()).json();
    let three = report(&["--weights", "aspen=1,birch=2,black_oak=1", "--straight"]);
    assert_eq!(three["weights"]["silver_birch"], 0.5);
    assert_eq!(three["weights"]["black_oak"], 0.25);
    let same = report(&["--weights", "aspen=10,birch=20,oak=10", "--straight"]);
    assert_eq!(same["weights"], three["weights"]);
    let all_on_one = report(&["--weights", "palm=3"]);
    assert_eq!(all_on_one["weights"]["palm"], 1.0);
}

#[test]
fn a_point_of_the_map_is_a_tree_and_outside_it_is_said() {
    let dir = Dir::new();
    let inside = dir.run(["blend", "--point", "0.2,-0.1", "--json"]).json();
    assert_eq!((inside["extrapolated"].as_bool(), inside["outside"].as_f64()), (Some(false), Some(0.0)));
    let run = dir.run(["blend", "--point", "-5,0", "-o", "far.toml"]);
    let _ = run.ok();
    assert!(run.stderr().contains("extrapolated"), "{run}");
    assert!(std::fs::read_to_string(dir.path("far.toml")).unwrap().contains("# Extrapolated"));
    let _ = dir.run(["grow", "far.toml", "--stats-only", "--json"]).json();
}

#[test]
fn steps_are_a_row_and_files() {
    let dir = Dir::new();
    let _ = dir.run(["blend", "palm", "acer", "--straight", "--steps", "5", "-o", "row"]).ok();
    let row = image::open(dir.path("row/row.png")).unwrap();
    assert_eq!(row.width(), 5 * 200 + 8);
    let first = std::fs::read_to_string(dir.path("row/1.toml")).unwrap();
    assert_eq!(values(&first), values(&dir.run(["species", "palm"]).ok()));
    let last = std::fs::read_to_string(dir.path("row/5.toml")).unwrap();
    assert_eq!(values(&last), values(&dir.run(["species", "acer"]).ok()));
}

#[test]
fn the_dissertations_way_is_kept() {
    let dir = Dir::new();
    let raw = dir.run(["blend", "palm", "acer", "--features", "raw", "--at", "0"]).ok();
    assert_ne!(values(&raw), values(&dir.run(["species", "palm"]).ok()), "two axes do not hold a palm");
}

#[test]
fn own_files_blend_with_built_in_species() {
    let dir = Dir::new();
    let text = dir
        .run(["species", "silver_birch"])
        .ok()
        .replace("silver_birch", "mine")
        .replace("g_scale = 20", "g_scale = 40");
    let file = dir.file("mine.toml", text);
    let blend = dir.run(["blend", file.to_str().unwrap(), "sassafras", "--straight", "--json"]).json();
    assert_eq!((&blend["weights"]["mine"], &blend["weights"]["sassafras"]), (&0.5.into(), &0.5.into()));
}

#[test]
fn blends_that_cannot_be() {
    let dir = Dir::new();
    let fails =
        |args: &[&str], code: i32, words: &[&str]| dir.run([&["blend"], args].concat()).fails(code, words);
    fails(&["quaking_aspn", "palm"], 1, &["did you mean `quaking_aspen`"]);
    fails(&["palm", "acer", "--at", "2"], 2, &["2 is not between the two species"]);
    fails(&["palm", "acer", "--at", "-0.5"], 2, &["not between"]);
    fails(&["palm", "acer", "--at", "half"], 2, &["from 0 to 1"]);
    fails(&["palm", "palm"], 1, &["same parameters", "nothing between them"]);
    fails(&["palm"], 2, &["<TO>"]);
    fails(&[], 2, &["--weights"]);
    fails(&["--weights", "palm=-1,acer=2"], 2, &["palm=-1", "0 or more"]);
    fails(&["--weights", "palm=0,acer=0"], 2, &["all weights are 0"]);
    fails(&["--weights", "palm"], 2, &["NAME=SHARE"]);
    fails(&["--weights", "palm=nan"], 2, &["0 or more"]);
    fails(&["--weights", "plam=1"], 1, &["did you mean `palm`"]);
    fails(&["--weights", "black=1"], 1, &["black_tupelo or black_oak"]);
    fails(&["--point", "here"], 2, &["X,Y"]);
    fails(&["--point", "nan,0"], 2, &["X,Y"]);
    fails(&["palm", "acer", "-o", "mix.png"], 1, &["mix.png", ".toml"]);
    fails(&["palm", "acer", "--steps", "1", "-o", "row"], 2, &["2..=101"]);
    fails(&["palm", "acer", "--steps", "5"], 2, &["--out"]);
    assert!(!dir.path("mix.png").exists());
}
