//! Measured trees, through the program.

use pleach_tests::Dir;

#[test]
fn a_skeleton_that_was_written_is_drawn_measured_and_exported() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--no-leaves", "-o", "a.swc"]).ok();
    let _ = dir.run(["grow", "acer", "-o", "a.csv"]).ok();
    let of = |species: &str| dir.run(["grow", species, "--stats-only", "--json", "--no-leaves"]).json();
    let grown = of("acer");
    // As a spreadsheet of another country saves it.
    let csv = std::fs::read_to_string(dir.path("a.csv")).unwrap();
    let _ = dir.file(
        "b.csv",
        csv.replace(',', ";").replace('.', ",").replace("start,", "start_").replace("axis,", "axis_"),
    );
    for name in ["a.swc", "a.csv", "b.csv"] {
        let read = of(name);
        assert_eq!(read["stems"], grown["stems"], "{name}");
        let length = |value: &serde_json::Value| value["height_m"].as_f64().unwrap();
        assert!((length(&read) / length(&grown) - 1.0).abs() < 0.01, "{name}");
        for out in ["a.glb", "a-2.png", "a.json", "a-2.swc", "a-2.csv", "a.mtg"] {
            let _ = dir.run(["grow", name, "-o", out]).ok();
            assert!(std::fs::metadata(dir.path(out)).unwrap().len() > 1000, "{name}: {out}");
        }
        let _ = dir.run(["render", name, "-o", "shaded.png", "--size", "64"]).ok();
        let _ = dir.run(["silhouette", name, "-o", "flat.png"]).ok();
    }
    // Read and written once more, nothing changes any more.
    let _ = dir.run(["grow", "a.swc", "-o", "once.swc"]).ok();
    let _ = dir.run(["grow", "once.swc", "-o", "twice.swc"]).ok();
    let text = |name: &str| std::fs::read_to_string(dir.path(name)).unwrap();
    assert_eq!(text("once.swc"), text("twice.swc"));
}

#[test]
fn what_a_measured_tree_cannot_be_used_for_says_so() {
    let dir = Dir::new();
    let _ = dir.file("cycle.swc", "1 1 0 0 0 1 -1\n2 1 0 0 1 1 3\n3 1 0 0 2 1 2\n");
    let run = dir.run(["render", "cycle.swc"]);
    assert_eq!(run.code(), 1, "{run}");
    assert!(run.stderr().contains("cycle.swc:2: the row is above itself"), "{run}");
    let _ = dir.file("tree.swc", "1 5 0 0 0 0.1 -1\n2 5 0 0 1 0.1 1\n3 5 0 0.2 2 0.05 2\n");
    let _ = dir.run(["silhouette", "tree.swc", "-o", "goal.png"]).ok();
    for (arguments, message) in [
        (&["species", "tree.swc"][..], "is one tree and has no species file"),
        (&["fit", "goal.png", "--from", "tree.swc", "-o", "run"], "no parameter is free: nothing to search"),
        (&["blend", "tree.swc", "acer", "-o", "it.toml"], "only species of one generator"),
        (&["sample", "tree.swc", "-o", "samples"], "no number of tree varies"),
        (&["dataset", "tree.swc", "-o", "data"], "no number of tree varies"),
        (&["import", "tree.swc"], "is not a species of another program"),
    ] {
        let run = dir.run(arguments);
        assert_eq!(run.code(), 1, "{run}");
        assert!(run.stderr().contains(message), "{run}");
    }
    let run = dir.run(["grow", "tree.swc", "--stats-only", "--max-stems", "0"]);
    assert!(run.stderr().contains("more than 0 stems"), "{run}");
}
