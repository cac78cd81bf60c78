//! This very tree: fits that end with draws of single stems, and files that have them.

use pleach_tests::{Dir, read, target, wait_for};

fn fit<'a>(goal: &'a str, out: &'a str, evaluations: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let start = ["--size", "140", "--from", "acer", "--tree-seed", "5", "--evaluations", evaluations];
    [&["fit", goal, "--out", out], &start[..], more].concat()
}

fn text(dir: &Dir, file: &str) -> String {
    String::from_utf8(read(&dir.path(file))).unwrap()
}

#[test]
fn a_fit_ends_with_the_kind_and_with_this_very_tree() {
    let (dir, goal) = (Dir::new(), target("acer.png"));
    let run = dir.run(fit(&goal, "run", "40", &["--individual", "64trees"]));
    let said = run.ok();
    assert!(
        said.contains("the kind") && said.contains("this very tree") && said.contains("of its stems"),
        "{said}"
    );
    for file in ["individual.toml", "individual.png", "overlay-individual.png", "individual-render.png"] {
        assert!(dir.path("run").join(file).is_file(), "{file}");
    }
    let summary: serde_json::Value = serde_json::from_slice(&read(&dir.path("run/summary.json"))).unwrap();
    let one = &summary["individual"];
    assert!(one["cost"].as_f64().unwrap() < one["cost_before"].as_f64().unwrap(), "{one}");
    assert_eq!(one["trees"], 64);
    let rows = text(&dir, "run/individual.toml").lines().filter(|line| line.starts_with("  [\"0")).count();
    assert_eq!(one["stems"], rows);

    // Everything that takes a species takes it: its own seed is the tree, others are the kind's.
    let svg = |species: &str, seed: &[&str], out: &str| {
        let args = [&["grow", species, "-o", out][..], seed].concat();
        let _ = dir.run(args).ok();
        read(&dir.path(out))
    };
    let own = svg("run/individual.toml", &[], "own.ply");
    assert_ne!(own, svg("run/best.toml", &[], "kind.ply"));
    assert_eq!(own, svg("run/individual.toml", &["--seed", "5"], "one.ply"));
    let other = svg("run/individual.toml", &["--seed", "9"], "other.ply");
    assert_eq!(other, svg("run/best.toml", &["--seed", "9"], "kind9.ply"));
    let _ = dir.run(["render", "run/individual.toml", "-o", "one.png", "--size", "140"]).ok();
    let _ = dir.run(["grow", "run/individual.toml", "--lod", "2", "-o", "lod.glb"]).ok();
    let _ = dir.run(["grow", "run/individual.toml", "--wind", "-o", "wind.glb"]).ok();
    let score = dir.run(["silhouette", "run/individual.toml", "-o", "s.png"]);
    let _ = score.ok();
    // A fit may start from it.
    let _ =
        dir.run(["fit", &goal, "--from", "run/individual.toml", "--evaluations", "5", "--size", "140"]).ok();
}

#[test]
fn several_trees_on_one_goal_have_files_and_a_sheet() {
    let (dir, goal) = (Dir::new(), target("acer.png"));
    let several = ["--individual", "48trees", "--individuals", "3"];
    let said = dir.run(fit(&goal, "run", "40", &several)).ok();
    assert!(said.contains("3 trees lie on the goal") && said.contains("individuals.png"), "{said}");
    let summary: serde_json::Value = serde_json::from_slice(&read(&dir.path("run/summary.json"))).unwrap();
    let trees = summary["individuals"]["trees"].as_array().unwrap();
    assert_eq!(trees.len(), 3);
    let shared = summary["individuals"]["side_blurred_iou"].as_f64().unwrap();
    assert!((0.05..0.95).contains(&shared), "{shared}");
    let mut texts = Vec::new();
    for file in ["run/individual.toml", "run/individual-2.toml", "run/individual-3.toml"] {
        let file = file.to_owned();
        let _ = dir.run(["grow", &file, "--stats-only"]).ok();
        texts.push(text(&dir, &file));
    }
    assert!(texts[0] != texts[1] && texts[1] != texts[2]);
    assert!(read(&dir.path("run/individuals.png")).starts_with(b"\x89PNG"));
    // A shorter list takes the place of all of it.
    let _ = dir.run(fit(&goal, "run", "40", &["--individual", "16trees", "--overwrite"])).ok();
    assert!(!dir.path("run/individual-2.toml").exists() && !dir.path("run/individuals.png").exists());

    dir.run(fit(&goal, "x", "40", &["--individuals", "0"])).fails(2, &["1..=64"]);
    let none = ["--individual", "off", "--individuals", "2"];
    dir.run(fit(&goal, "x", "40", &none)).fails(1, &["--individuals", "off"]);
}

/// Families whose stems have addresses, through their contract.
#[test]
fn trees_of_other_families_have_one_too() {
    let dir = Dir::new();
    for species in ["coffey_winter_oak", "stylised_oak"] {
        let goal = format!("{species}.png");
        let _ = dir.run(["silhouette", species, "--seed", "7", "-o", &goal, "--size", "140"]).ok();
        let args =
            ["fit", &goal, "--out", species, "--size", "140", "--from", species, "--evaluations", "20"];
        let _ = dir.run([&args[..], &["--individual", "48trees"]].concat()).ok();
        let summary: serde_json::Value =
            serde_json::from_slice(&read(&dir.path(species).join("summary.json"))).unwrap();
        let one = &summary["individual"];
        assert!(one["cost"].as_f64().unwrap() < one["cost_before"].as_f64().unwrap(), "{species}: {one}");
        let file = format!("{species}/individual.toml");
        let _ = dir.run(["grow", &file, "-o", "one.glb"]).ok();
    }
}

#[test]
fn nobody_has_to_have_one() {
    let (dir, goal) = (Dir::new(), target("acer.png"));
    let said = dir.run(fit(&goal, "run", "40", &["--individual", "off"])).ok();
    assert!(!said.contains("this very tree") && !dir.path("run/individual.toml").exists(), "{said}");
    let summary: serde_json::Value = serde_json::from_slice(&read(&dir.path("run/summary.json"))).unwrap();
    assert!(summary["individual"].is_null());
    // Grammars have no stems with addresses, and nothing is said of it.
    let grammar =
        ["fit", &goal, "--out", "g", "--size", "140", "--from", "grammar_acer", "--evaluations", "5"];
    let _ = dir.run(grammar).ok();
    assert!(!dir.path("g/individual.toml").exists());
    // But of one that was asked for.
    let grammar = [&grammar[..], &["--out", "h"]].concat();
    for asked in [["--individuals", "3"], ["--individual", "9trees"]] {
        dir.run([&grammar[..], &asked].concat()).fails(1, &["lsystem cannot be sampled again", "leave out"]);
    }
    let evolved = ["fit", &goal, "--out", "h", "--evolve-rules", "--evaluations", "5", "--individuals", "3"];
    dir.run(evolved).fails(1, &["evolved grammars cannot be sampled again", "leave out"]);
    let off = [&grammar[..], &["--individual", "off"]].concat();
    let _ = dir.run(off).ok();
    assert!(!dir.path("h/individual.toml").exists());
}

#[test]
fn threads_change_nothing_and_a_fit_that_is_searched_on_has_one_again() {
    let (dir, goal) = (Dir::new(), target("acer.png"));
    let on = |threads: &str| {
        let _ = dir.run(fit(&goal, threads, "40", &["--individual", "24trees", "--threads", threads])).ok();
        read(&dir.path(threads).join("individual.toml"))
    };
    let one = on("1");
    assert_eq!(one, on("2"));
    assert_eq!(one, on("8"));
    let individual = ["--individual", "24trees"];
    let _ = dir.run(fit(&goal, "1", "20", &[&individual[..], &["--continue"]].concat())).ok();
    let _ = dir.run(fit(&goal, "60", "60", &individual)).ok();
    assert_eq!(text(&dir, "1/individual.toml"), text(&dir, "60/individual.toml"));
}

/// Killed while the tree is searched, it goes on to the same tree.
#[test]
#[cfg(unix)]
fn a_killed_run_ends_in_the_same_tree() {
    let (dir, goal) = (Dir::new(), target("acer.png"));
    let more = ["--individual", "600trees"];
    let _ = dir.run(fit(&goal, "whole", "40", &more)).ok();
    let mut killed = dir.command(fit(&goal, "parts", "40", &more)).spawn().unwrap();
    // The search of 40 trees is over long before; what is killed is what comes after it.
    wait_for(&dir.path("parts/checkpoint"));
    std::thread::sleep(std::time::Duration::from_millis(300));
    killed.kill().unwrap();
    let _ = killed.wait();
    assert!(!dir.path("parts/summary.json").exists(), "it was killed before its end");
    let _ = dir.run(fit(&goal, "parts", "40", &[&more[..], &["--resume"]].concat())).ok();
    assert_eq!(text(&dir, "whole/individual.toml"), text(&dir, "parts/individual.toml"));
}

#[test]
fn mistakes_are_told_with_their_places() {
    let dir = Dir::new();
    let head = "generator = \"weber-penn\"\ntree_seed = 1\n[individual]\n";
    let cases: [(&str, &[&str]); 9] = [
        ("stems = [[\"0/x\", 1, 0.0, 0.0, 1.0]]", &["4:11", "0/12/f1"]),
        ("stems = [[\"0/1\", 1, 0.0, 0.0]]", &["4:10", "5"]),
        ("stems = [[\"0/1\", 1.5, 0.0, 0.0, 1.0]]", &["fraction"]),
        ("stems = [[\"0/1\", -1, 0.0, 0.0, 1.0]]", &["-1"]),
        ("stems = [[\"0/1\", 1, 181, 0.0, 1.0]]", &["181", "180"]),
        ("stems = [[\"0/1\", 1, 0.0, nan, 1.0]]", &["NaN"]),
        ("stems = [[\"0/1\", 1, 0, 0, 0]]", &["0.1"]),
        ("stems = [[\"0/1\", 1, 0, 0, 1], [\"0/1\", 2, 0, 0, 1]]", &["twice"]),
        ("stem = []", &["stem", "stems"]),
    ];
    for (line, words) in cases {
        let _ = dir.file("bad.toml", format!("{head}{line}\n"));
        dir.run(["grow", "bad.toml", "-o", "x.ply"]).fails(1, words);
    }
    let head = "generator = \"space-colonization\"\ntree_seed = 1\n[individual]\n";
    let cases: [(&str, &[&str]); 9] = [
        ("crown = 3", &["4:9", "an array of pictures"]),
        ("crown = [[0, 0.1, 0]]", &["4:10", "expected 4"]),
        ("crown = [[0, 0.1, 0, [\"00\"]]]", &["nothing in it"]),
        ("crown = [[0, 0.1, 0, [\"0a9\"]]]", &["digits", "256"]),
        ("crown = [[0, 0, 0, [\"9\"]]]", &["0.002"]),
        ("trunk = [[0, 1]]", &["has no crown"]),
        ("crown = [[0, 0.1, 0, [\"9\"]]]\ntrunk = [[0, 1], [0, 0.5]]", &["5:22", "allowed is 1 to 10"]),
        ("crown_seed = 1.5", &["fraction"]),
        ("crwn = []", &["did you mean `crown`"]),
    ];
    for (line, words) in cases {
        let _ = dir.file("bad.toml", format!("{head}{line}\n"));
        dir.run(["grow", "bad.toml", "-o", "x.ply"]).fails(1, words);
    }
    let _ = dir.file("bad.toml", "[individual]\nstems = [[\"0/1\", 1, 0, 0, 1]]\n");
    dir.run(["grow", "bad.toml", "-o", "x.ply"]).fails(1, &["tree_seed"]);
    let _ = dir.file(
        "bad.toml",
        "generator = \"least-cost-path\"\ntree_seed = 1\n[individual]\nstems = [[\"0\", 1, 0, 0, 1]]\n",
    );
    dir.run(["grow", "bad.toml", "-o", "x.ply"]).fails(1, &["addresses", "least-cost-path"]);
    // A stem that the tree does not have changes nothing.
    let _ = dir.file("odd.toml", format!("{head}stems = [[\"0/99999/f3\", 1, 0, 0, 1]]\n"));
    let _ = dir.run(["grow", "odd.toml", "-o", "x.ply"]).ok();

    let goal = target("acer.png");
    for (given, words) in [("soon", "off"), ("0trees", "400trees"), ("-1s", "off")] {
        let option = format!("--individual={given}");
        dir.run(["fit", &goal, &option]).fails(2, &[words]);
    }
    dir.run(["fit", &goal, "--individual", "60s"]).fails(1, &["--timeout"]);
}
