//! `pleach grow`, `pleach species`, `pleach params`, as a user runs them.

use pleach_tests::Dir;

const STATS: [&str; 15] = [
    "species",
    "generator",
    "seed",
    "stems",
    "bezier_points",
    "length_total_m",
    "length_mean_m",
    "radius_mean_m",
    "leaves",
    "blossoms",
    "height_m",
    "crown_width_x_m",
    "crown_width_y_m",
    "lowest_branch_m",
    "leaf_area_m2",
];

#[test]
fn statistics_have_the_names_that_scripts_rely_on() {
    let json = Dir::new().run(["grow", "quaking_aspen", "--seed", "3", "--stats-only", "--json"]).json();
    for name in STATS {
        assert!(json.get(name).is_some(), "`{name}` is missing in {json}");
    }
    assert_eq!(json["species"], "quaking_aspen");
    assert_eq!(json["seed"], 3);
    assert_eq!(json["stems"].as_array().unwrap().len(), 3);
    assert_eq!(json["stems"][0], 1);
    assert!(json["leaves"].as_u64().unwrap() > 10_000);
}

#[test]
fn a_tree_is_written_as_skeleton_and_picture() {
    let dir = Dir::new();
    let run = dir.run(["grow", "acer", "--seed", "2", "--size", "64"]);
    assert!(run.ok().contains("acer (seed 2)"));
    let text = std::fs::read_to_string(dir.path("acer-2.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let stems = json["stems"].as_array().unwrap();
    assert_eq!(stems[0]["kind"], "trunk");
    let knots = stems[0]["knots"].as_array().unwrap();
    assert_eq!(knots.len(), stems[0]["handles_in"].as_array().unwrap().len());
    assert_eq!(knots[0].as_array().unwrap().len(), 4, "x, y, z, radius");
    assert!(!json["leaves"]["list"].as_array().unwrap().is_empty());
    let picture = image::open(dir.path("acer-2.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (64, 64));
    let names: Vec<_> = std::fs::read_dir(dir.path("")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(names.len(), 2, "nothing else is written: {names:?}");
}

#[test]
fn one_file_is_written_where_one_is_named() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "palm", "-o", "palm.json"]).ok();
    assert!(dir.path("palm.json").exists() && !dir.path("palm-1.png").exists());
    dir.run(["grow", "palm", "-o", "palm.xyz"]).fails(1, &[".xyz", ".json", ".png"]);
}

#[test]
fn absurd_ranges_of_seeds_are_refused() {
    let dir = Dir::new();
    let run = dir.run(["grow", "acer", "--seeds", "0..1000000000000", "--stats-only"]);
    run.fails(1, &["--seeds 0..1000000000000", "1000000000000 trees", "at most 1000000000", "smaller range"]);
    let run = dir.run(["grow", "acer", "--seeds", "0..1000001", "-o", "forest/"]);
    run.fails(1, &["1000001 trees", "at most 1000000 are written"]);
    assert!(!dir.path("forest").exists());
}

/// A reader gets the first lines long before the last tree is grown.
#[test]
fn lines_of_seeds_come_as_they_are_made() {
    use std::io::BufRead as _;
    let dir = Dir::new();
    let many = ["grow", "acer", "--seeds", "0..100000000", "--stats-only", "--json", "--threads", "2"];
    let mut child = dir.command(many).stdout(std::process::Stdio::piped()).spawn().unwrap();
    let lines = std::io::BufReader::new(child.stdout.take().unwrap()).lines();
    let first: Vec<String> = lines.take(5).map(Result::unwrap).collect();
    // Nobody reads on: the program ends.
    assert!(child.wait().unwrap().success());
    let five = dir.run(["grow", "acer", "--seeds", "0..5", "--stats-only", "--json"]).ok();
    assert_eq!(first, five.lines().collect::<Vec<_>>());
}

#[test]
fn many_seeds_come_in_order_and_do_not_depend_on_threads() {
    let dir = Dir::new();
    let run = |threads: &str| {
        dir.run(["grow", "acer", "--seeds", "5..25", "--stats-only", "--json", "--threads", threads]).ok()
    };
    let (one, two, eight) = (run("1"), run("2"), run("8"));
    assert_eq!(one, two);
    assert_eq!(one, eight);
    let seeds: Vec<u64> = one
        .lines()
        .map(|l| serde_json::from_str::<serde_json::Value>(l).unwrap()["seed"].as_u64().unwrap())
        .collect();
    assert_eq!(seeds, (5..25).collect::<Vec<_>>());
    let summary = dir.run(["grow", "acer", "--seeds", "0..5", "--stats-only"]).ok();
    assert!(summary.contains("5 trees") && summary.contains("mean"), "{summary}");
}

#[test]
fn a_big_tree_is_the_same_on_any_number_of_threads() {
    let dir = Dir::new();
    let skeleton = |threads: &str, name: &str| {
        let _ = dir.run(["grow", "black_oak", "--no-leaves", "-o", name, "--threads", threads]).ok();
        std::fs::read(dir.path(name)).unwrap()
    };
    assert!(skeleton("1", "one.json") == skeleton("3", "three.json"));
}

#[test]
fn a_printed_species_grows_the_same_tree() {
    let dir = Dir::new();
    for name in ["weeping_willow", "bamboo", "sphere_tree"] {
        let text = dir.run(["species", name, "--seed", "4"]).ok();
        let file = dir.file("copy.toml", &text);
        let copy = dir.run(["grow", file.to_str().unwrap(), "--stats-only", "--json"]).json();
        let original = dir.run(["grow", name, "--seed", "4", "--stats-only", "--json"]).json();
        assert_eq!(copy, original);
    }
}

#[test]
fn species_and_parameters_are_listed() {
    let dir = Dir::new();
    let table = dir.run(["species"]).ok();
    assert!(table.lines().count() >= 21 && table.contains("quaking_aspen"), "{table}");
    assert!(dir.run(["species", "--json"]).json().as_array().unwrap().len() >= 20);
    let table = dir.run(["params"]).ok();
    assert!(table.contains("down_angle_v[4]"), "{table}");
    let one = dir.run(["params", "rotate"]).ok();
    for word in ["flagged", "-360..360", "°", "Appendix C", "branches"] {
        assert!(one.contains(word), "{one}");
    }
    assert_eq!(dir.run(["params", "shape", "--json"]).json()["choices"][7], "tend_flame");
    dir.run(["params", "rotat"]).fails(1, &["did you mean `rotate`?"]);
}

#[test]
fn help_has_examples() {
    let dir = Dir::new();
    for command in ["grow", "species", "params", "silhouette", "score", "fit", "experiment"] {
        let help = dir.run([command, "--help"]).ok();
        assert!(help.contains("Examples:"), "{command}\n{help}");
    }
}
