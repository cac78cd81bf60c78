//! `pleach blend`, as a user would run it.

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
        let map = "--across-the-map";
        for how in [
            &["--at", at][..],
            &["--at", at, "--straight"],
            &["--at", at, map],
            &["--at", at, map, "--layout", "looks"],
        ] {
            let blend = dir.run([&["blend", "quaking_aspen", "palm"], how].concat()).ok();
            assert_eq!(values(&blend), values(&itself), "{how:?}");
        }
    }
}

#[test]
fn half_and_half_is_half_and_half() {
    let dir = Dir::new();
    let weights = |args: &[&str]| dir.run([&["blend", "--json"], args].concat()).json()["weights"].clone();
    let both = serde_json::json!({"quaking_aspen": 0.5, "silver_birch": 0.5});
    assert_eq!(weights(&["quaking_aspen", "silver_birch"]), both);
    assert_eq!(weights(&["quaking_aspen", "silver_birch", "--at", "0.5", "--straight"]), both);
    assert_eq!(weights(&["--weights", "quaking_aspen=3,silver_birch=3"]), both);
    // Across the map there is more in it than the two.
    let across = weights(&["quaking_aspen", "silver_birch", "--across-the-map"]);
    assert!(across.as_object().unwrap().len() > 2, "{across}");
    // Which of two is named first does not matter half way.
    let blend = |a: &str, b: &str| dir.run(["blend", a, b]).ok();
    assert_eq!(values(&blend("palm", "acer")), values(&blend("acer", "palm")));
}

#[test]
fn colours_are_blended_and_written() {
    let dir = Dir::new();
    let bark = |args: &[&str]| {
        let text = dir.run([&["blend"], args].concat()).ok();
        let line = text.lines().find(|line| line.starts_with("bark = ")).unwrap_or_else(|| panic!("{text}"));
        u8::from_str_radix(&line[9..11], 16).unwrap()
    };
    let reds = ["0", "0.25", "0.75", "1"].map(|at| bark(&["black_oak", "silver_birch", "--at", at]));
    assert!(reds.is_sorted() && reds[0] == 0x55 && reds[1] > 0x55 && reds[2] < reds[3], "{reds:x?}");
    assert!((0x56..0xd9).contains(&bark(&["--weights", "black_oak=1,silver_birch=1"])));
    assert!((0x40..0xe0).contains(&bark(&["--point", "0.2,-0.1"])));
    // The table of a given file takes part, under whatever name.
    let text = dir.run(["species", "black_oak"]).ok();
    let text = text.replace("name = \"black_oak\"", "name = \"red\"").replace("#554c43", "#ff0000");
    let text = text.replace("furrowed", "ringed").replace("g_scale = 10", "g_scale = 12");
    let _ = dir.file("red.toml", text);
    let blend = dir.run(["blend", "red.toml", "acer", "--at", "0"]).ok();
    assert!(blend.contains("bark = \"#ff0000\"\nbark_pattern = \"ringed\""), "{blend}");
    assert!(bark(&["red.toml", "acer", "--at", "0.3"]) > 0xa0);
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
    let three = report(&["--weights", "aspen=1,birch=2,black_oak=1"]);
    let expected = serde_json::json!({"quaking_aspen": 0.25, "silver_birch": 0.5, "black_oak": 0.25});
    assert_eq!(three["weights"], expected);
    let same = report(&["--weights", "aspen=10,birch=20,black_oak=10", "--straight"]);
    assert_eq!(same["weights"], three["weights"]);
    // Everywhere a word means the same species, or none.
    let dir = Dir::new();
    assert_eq!(dir.run(["species", "aspen"]).ok(), dir.run(["species", "quaking_aspen"]).ok());
    for args in [&["blend", "--weights", "oak=1,palm=1"][..], &["species", "oak"], &["blend", "oak", "palm"]]
    {
        dir.run(args).fails(1, &["`oak` may be black_oak or cambridge_oak"]);
    }
    // Species beyond the fifteen have shares too.
    assert_eq!(report(&["--weights", "cambridge_oak=1,palm=1"])["weights"]["cambridge_oak"], 0.5);
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
    // However far it is, numbers are short.
    let run = dir.run(["blend", "--point=1e300,1e300", "-o", "farther.toml"]);
    let _ = run.ok();
    let text = std::fs::read_to_string(dir.path("farther.toml")).unwrap();
    assert!(text.lines().chain(run.stderr().lines()).all(|line| line.len() < 130), "{run}\n{text}");
    let run = dir.run(["blend", "palm", "acer", "--at=1e300"]);
    run.fails(2, &["1e300 is not between"]);
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
    let raw = dir.run(["blend", "palm", "acer", "--across-the-map", "--features", "raw", "--at", "0"]).ok();
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
    fails(&["--weights", "foo=1"], 1, &["error: no species and no file is called `foo`", "pleach species"]);
    fails(&["--weights", "black=1"], 1, &["black_tupelo or black_oak"]);
    fails(&["--weights", "palm=1,acer=1", "--across-the-map"], 2, &["--across-the-map", "--weights"]);
    fails(&["palm", "acer", "--straight", "--across-the-map"], 2, &["--straight"]);
    for option in [&["--layout", "looks"][..], &["--all"], &["--only", "palm,acer,apple"]] {
        fails(&[&["palm", "acer"], option].concat(), 1, &[option[0], "--across-the-map"]);
    }
    fails(&["palm", "acer", "--steps", "3", "-o", "-"], 1, &["standard output", "folder"]);
    fails(&["--point", "here"], 2, &["X,Y"]);
    fails(&["--point", "nan,0"], 2, &["X,Y"]);
    fails(&["palm", "acer", "-o", "mix.png"], 1, &["mix.png", ".toml"]);
    fails(&["palm", "acer", "--steps", "1", "-o", "row"], 2, &["2..=101"]);
    fails(&["palm", "acer", "--steps", "5"], 2, &["--out"]);
    assert!(!dir.path("mix.png").exists());
}

#[test]
fn standard_output_and_folders_are_taken_by_their_signs() {
    let dir = Dir::new();
    let printed = dir.run(["blend", "palm", "acer"]).ok();
    assert!(printed.starts_with("# A blend: 0.5 palm, 0.5 acer\n"), "{printed}");
    assert_eq!(dir.run(["blend", "palm", "acer", "-o", "-"]).ok(), printed);
    let _ = dir.run(["blend", "palm", "acer", "-o", "dir.with.dots/", "--name", "between"]).ok();
    let text = std::fs::read_to_string(dir.path("dir.with.dots/between.toml")).unwrap();
    assert!(text.contains("name = \"between\""), "{text}");
    assert!(!dir.path("-").exists());
}

#[test]
fn a_copy_of_a_built_in_species_blends_under_its_name() {
    let dir = Dir::new();
    let text = dir.run(["species", "silver_birch"]).ok().replace("g_scale = 20", "g_scale = 40");
    let _ = dir.file("mine.toml", text);
    let _ = dir.run(["blend", "mine.toml", "acer"]).ok();
    dir.run(["blend", "mine.toml", "silver_birch"])
        .fails(1, &["two species are called `silver_birch`", "`name`"]);
}
