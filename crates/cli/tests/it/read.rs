//! `pleach read`, and what a fit says of its goal.

use crate::mask::photograph;
use pleach_tests::{Dir, read, small};
use serde_json::Value;

/// The keys that scripts are promised.
const KEYS: [&str; 14] = [
    "feet",
    "feet_confidence",
    "trunk",
    "lean_deg",
    "lean_deg_confidence",
    "first_fork",
    "bare_height",
    "bare_height_confidence",
    "crown",
    "asymmetry",
    "gap_share",
    "leaves",
    "leaves_confidence",
    "mask_confidence",
];

#[test]
fn a_table_a_drawing_and_json_say_what_is_in_a_picture() {
    let dir = Dir::new();
    let _ = dir.run(["silhouette", "acer", "--seed", "3", "--size", "256", "-o", "goal.png"]).ok();
    let table = dir.run(["read", "goal.png", "-o", "out"]).ok();
    for words in ["one trunk", "of the height", "in leaf", "confidence"] {
        assert!(table.contains(words), "`{words}` is not in {table}");
    }
    let found: Value = serde_json::from_slice(&read(&dir.path("out/reading.json"))).unwrap();
    for key in KEYS {
        assert!(found.get(key).is_some(), "`{key}` is missing in {found}");
    }
    assert_eq!(found["feet"].as_array().unwrap().len(), 1);
    assert_eq!(found["crown"]["left"].as_array().unwrap().len(), 33);
    assert_eq!(found["mask_confidence"], Value::Null);
    assert_eq!(image::open(dir.path("out/reading.png")).unwrap().width(), 256);
    assert!(!dir.path("out/mask.png").exists(), "it is no photograph");
    // The same from standard input, and on other threads.
    let json = dir.run(["read", "goal.png", "--json", "--threads", "1"]).json();
    assert_eq!(json, found);
    assert_eq!(dir.run(["read", "goal.png", "--json", "--threads", "3"]).json(), found);
}

#[test]
fn a_photograph_is_masked_first_and_wood_may_be_shown() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let found = dir.run(["read", "photo.png", "-o", "out", "--json"]).json();
    assert!(found["mask_confidence"].as_f64().unwrap() > 0.0 && dir.path("out/mask.png").exists());
    let boxed = dir.run(["read", "photo.png", "--box", "2,2,150,156", "--json"]).json();
    assert_eq!(boxed["feet"].as_array().unwrap().len(), 1, "{boxed}");
    // The wood of a tree is what it has without leaves.
    for (name, more) in [("all.png", None), ("wood.png", Some("--no-leaves"))] {
        let args = ["silhouette", "acer", "--seed", "2", "--size", "200", "-o", name];
        let _ = dir.run(args.into_iter().chain(more)).ok();
    }
    let plain = dir.run(["read", "all.png", "--json"]).json();
    let wood = dir.run(["read", "all.png", "--wood", "wood.png", "--json"]).json();
    // The outline is the silhouette's, though its middle is where the wood has its foot.
    let width = |found: &Value| {
        let side = |name: &str| found["crown"][name][24].as_f64().unwrap();
        side("left") + side("right")
    };
    assert!((width(&plain) - width(&wood)).abs() < 1e-9);
    assert_ne!(plain["trunk"], wood["trunk"], "wood shows where the crown hides it");
    dir.run(["read", "all.png", "--wood", "photo.png"]).fails(1, &["wood", "one size"]);
}

#[test]
fn what_cannot_be_read_is_refused_in_words() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let read = |more: &[&str]| dir.run([&["read", "photo.png", "-o", "x"], more].concat());
    read(&["--box", "10,10,500,20"]).fails(1, &["beyond the picture"]);
    read(&["--box", "10,10,0,20"]).fails(1, &["--box", "0 × 20"]);
    read(&["--box", "10,10"]).fails(2, &["4 whole numbers"]);
    read(&["--include", "900,1"]).fails(1, &["900,1", "outside"]);
    read(&["--mask", "truth.png", "--box", "1,1,20,20"]).fails(1, &["--box", "leave out"]);
    read(&["--wood", "none.png"]).fails(1, &["none.png"]);
    dir.run(["read", "none.png"]).fails(1, &["none.png"]);
    assert!(!dir.path("x").exists(), "nothing is written");
}

/// A clump of canes is not of the kind of a tree, however alike they are.
#[test]
fn a_fit_says_in_what_its_tree_differs_from_the_goal() {
    let dir = Dir::new();
    let _ = dir.run(["silhouette", "acer", "--seed", "3", "--size", "256", "-o", "goal.png"]).ok();
    // A start with other trunks, which are not free.
    let more = ["--from", "bamboo", "--free", "leaves", "--evaluations", "4"];
    let said = dir.run(small("goal.png", "run", &more)).ok();
    let summary: Value = serde_json::from_slice(&read(&dir.path("run/summary.json"))).unwrap();
    let first = &summary["readings"]["differences"][0];
    assert!(said.contains(first["words"].as_str().unwrap()), "{said}");
    let goal: Value = serde_json::from_slice(&read(&dir.path("run/reading.json"))).unwrap();
    assert_eq!(summary["readings"]["goal"], goal);
    assert!(dir.path("run/reading.png").exists());
    let kind = summary["verdict"]["kind"].as_str().unwrap();
    assert_ne!(kind, "of-its-kind", "{said}");
}

/// An orange tree stays orange, whatever species it looks like.
#[test]
fn colours_and_season_of_a_cut_out_become_those_of_the_result() {
    let dir = Dir::new();
    let args = ["render", "acer", "--seed", "2", "--size", "256", "--season", "autumn"];
    let _ = dir
        .run([&args[..], &["--background", "transparent", "--ground", "none", "-o", "tree.png"]].concat())
        .ok();
    let found = dir.run(["read", "tree.png", "--json"]).json();
    assert_eq!(found["colors"]["season"], "autumn", "{}", found["colors"]);
    assert!(found["colors"]["leaf"].as_str().unwrap().starts_with('#'));
    let fit = |out: &str, more: &[&str]| {
        let args = [&["--evaluations", "4", "--from", "hill_cherry"], more].concat();
        let _ = dir.run(small("tree.png", out, &args)).ok();
        String::from_utf8(read(&dir.path(out).join("best.toml"))).unwrap()
    };
    let pictured = fit("pictured", &[]);
    // What the species says of its leaves in autumn.
    let its_own = "autumn = \"#c75a2a\"";
    assert!(pictured.contains("season = \"autumn\"") && !pictured.contains(its_own), "{pictured}");
    let kept = fit("kept", &["--appearance", "species"]);
    assert!(!kept.contains("season = \"autumn\"") && kept.contains(its_own), "{kept}");
}

/// What a person sees better than the reading does.
#[test]
fn a_reading_is_corrected_by_flags_and_by_its_file() {
    let dir = Dir::new();
    let _ = dir.run(["silhouette", "acer", "--seed", "3", "--size", "256", "-o", "goal.png"]).ok();
    let read_with = |more: &[&str]| dir.run([&["read", "goal.png", "--json"], more].concat());
    let plain = read_with(&[]).json();
    let _ = dir.run(["read", "goal.png", "-o", "out"]).ok();
    assert_eq!(read_with(&["--reading", "out/reading.json"]).json(), plain, "as it was written");
    let said =
        read_with(&["--trunks", "2", "--lean", "-8", "--bare-height", "0.3", "--first-fork", "none"]).json();
    assert_eq!((said["feet"].as_array().unwrap().len(), &said["feet_confidence"]), (2, &1.0.into()));
    assert_eq!((&said["lean_deg"], &said["lean_deg_confidence"]), (&(-8.0).into(), &1.0.into()));
    assert_eq!((&said["bare_height"], &said["first_fork"]), (&0.3.into(), &Value::Null));
    let wide = read_with(&["--trunk-width", "0.2"]).json();
    let is_wide = |foot: &Value| foot["width"] == 0.2;
    assert!(wide["feet"].as_array().unwrap().iter().any(is_wide), "{wide}");
    assert_eq!(
        (&wide["width_confidence"], &wide["feet_confidence"]),
        (&1.0.into(), &plain["feet_confidence"])
    );
    // A flag before the file.
    let text = String::from_utf8(read(&dir.path("out/reading.json"))).unwrap();
    let mut edited: Value = serde_json::from_str(&text).unwrap();
    edited["bare_height"] = 0.25.into();
    edited["lean_deg"] = 5.into();
    let _ = dir.file("edited.json", edited.to_string());
    let found = read_with(&["--reading", "edited.json", "--lean", "6"]).json();
    assert_eq!((&found["bare_height"], &found["bare_height_confidence"]), (&0.25.into(), &1.0.into()));
    assert_eq!((&found["lean_deg"], &found["feet"]), (&6.0.into(), &plain["feet"]));
    for (more, expected) in [
        (["--trunks", "0"], "expected a whole number from 1 to 64"),
        (["--trunk-width", "0"], "expected heights of the tree from 0.001 to 2"),
        (["--lean", "100"], "expected degrees from -90 to 90"),
        (["--bare-height", "1.5"], "expected a number from 0 to 1"),
        (["--first-fork", "low"], "expected a number from 0 to 1"),
    ] {
        read_with(&more).fails(2, &[expected]);
    }
    let _ = dir.file("wrong.json", "{ \"leaning\": 3 }");
    read_with(&["--reading", "wrong.json"]).fails(1, &["wrong.json is not a reading", "`leaning`"]);
    read_with(&["--reading", "none.json"]).fails(1, &["none.json"]);
    read_with(&["--reading", "goal.png"]).fails(1, &["goal.png"]);
}

/// A search does not start from palms where a person sees branches down to the ground.
#[test]
fn a_first_guess_passes_over_what_contradicts_a_correction() {
    let dir = Dir::new();
    let _ = dir.run(["silhouette", "palm", "--seed", "3", "--size", "256", "-o", "goal.png"]).ok();
    let bare_heights = |out: &str, more: &[&str]| {
        let args = [&["--from", "auto", "--evaluations", "4"], more].concat();
        let _ = dir.run(small("goal.png", out, &args)).ok();
        let summary: Value = serde_json::from_slice(&read(&dir.path(out).join("summary.json"))).unwrap();
        ["goal", "kind"].map(|of| summary["readings"][of]["bare_height"].as_f64().unwrap())
    };
    let [goal, fit] = bare_heights("as-read", &[]);
    assert!(goal > 0.5 && fit > 0.5, "{goal} {fit}");
    let [goal, corrected] = bare_heights("corrected", &["--bare-height", "0.05"]);
    assert!(goal == 0.05 && corrected < fit - 0.1, "{goal} {corrected}, {fit} as read");
    // A list says it of one goal.
    let _ = dir.file("goals.csv", "file,trunks,lean,bare_height\ngoal.png,1,-4,0.1\n");
    let args = ["fit", "--list", "goals.csv", "--from", "palm", "--out", "listed", "--evaluations", "4"];
    let _ = dir.run([&args[..], &["--individual", "off"]].concat()).ok();
    let goal: Value = serde_json::from_slice(&read(&dir.path("listed/goal/reading.json"))).unwrap();
    assert_eq!((&goal["bare_height"], &goal["lean_deg"]), (&0.1.into(), &(-4.0).into()));
}
