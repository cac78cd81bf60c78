//! Species that are grown without leaves, and species that lose theirs.

use pleach_tests::{Dir, Run, read, target};

/// How many leaves `pleach grow` counts.
fn leaves(run: &Run) -> u64 {
    run.json()["leaves"].as_u64().unwrap()
}

/// The species file of an acer with these lines in the place of those that begin alike.
fn acer(dir: &Dir, lines: &[&str]) -> String {
    let text = dir.run(["species", "acer"]).ok();
    let key = |line: &str| line.split(" = ").next().unwrap().to_owned();
    let kept = text.lines().filter(|line| !lines.iter().any(|other| key(other) == key(line)));
    [lines.join("\n"), kept.collect::<Vec<_>>().join("\n")].join("\n")
}

#[test]
fn a_species_file_may_say_that_its_trees_are_bare() {
    let dir = Dir::new();
    let _ = dir.file("bare.toml", acer(&dir, &["bare = true"]));
    let grow =
        |more: &[&str]| leaves(&dir.run([&["grow", "bare.toml", "--stats-only", "--json"], more].concat()));
    assert_eq!(grow(&[]), 0);
    assert!(grow(&["--leafy"]) > 100);
    let picture = |command: &str, species: &str, more: &[&str]| {
        let args = [&[command, species, "--size", "96", "-o", "p.png"], more].concat();
        let _ = dir.run(args).ok();
        read(&dir.path("p.png"))
    };
    for command in ["render", "silhouette"] {
        let bare = picture(command, "acer", &["--no-leaves"]);
        assert!(picture(command, "bare.toml", &[]) == bare, "{command}");
        assert!(picture(command, "bare.toml", &["--leafy"]) == picture(command, "acer", &[]), "{command}");
        dir.run([command, "acer", "--leafy", "--no-leaves"]).fails(2, &["--leafy"]);
    }
    let mesh = |species: &str, more: &[&str]| {
        let _ = dir.run([&["grow", species, "-o", "m.stl"], more].concat()).ok();
        read(&dir.path("m.stl"))
    };
    assert!(mesh("bare.toml", &[]) == mesh("acer", &["--no-leaves"]));
    assert!(mesh("bare.toml", &["--leaves", "simple"]) == mesh("acer", &["--leaves", "simple"]));
}

#[test]
fn the_key_is_listed_shown_and_checked() {
    let dir = Dir::new();
    let _ = dir.file("bare.toml", acer(&dir, &["bare = true"]));
    assert!(dir.run(["params"]).ok().contains("bare"));
    assert!(dir.run(["species", "bare.toml"]).ok().contains("\nbare = true\n"));
    assert!(!dir.run(["species", "acer"]).ok().contains("bare ="));
    assert_eq!(dir.run(["species", "bare.toml", "--json"]).json()["bare"], true);
    let _ = dir.file("wrong.toml", acer(&dir, &["bare = 1"]));
    dir.run(["grow", "wrong.toml"]).fails(1, &["`bare` is a number, expected true or false"]);
}

#[test]
fn a_bare_fit_writes_species_that_grow_bare() {
    let dir = Dir::new();
    let _ = dir.run(["silhouette", "acer", "--seed", "3", "--no-leaves", "--size", "96", "-o", "g.png"]).ok();
    let fit = |goal: &str, out: &str, more: &[&str]| {
        let args = ["fit", goal, "--out", out, "--size", "140", "--from", "acer", "--tree-seed", "5"];
        let _ = dir.run([&args[..], &["--evaluations", "20", "--individual", "32trees"], more].concat()).ok();
    };
    fit("g.png", "winter", &["--leaves", "off"]);
    for file in ["winter/best.toml", "winter/individual.toml"] {
        assert!(String::from_utf8(read(&dir.path(file))).unwrap().contains("\nbare = true\n"), "{file}");
        assert_eq!(leaves(&dir.run(["grow", file, "--stats-only", "--json"])), 0, "{file}");
    }
    // A fit with leaves writes none, though it begins from a bare species.
    fit(&target("acer.png"), "summer", &["--leaves", "on", "--from", "winter/best.toml"]);
    assert!(!String::from_utf8(read(&dir.path("summer/best.toml"))).unwrap().contains("bare ="));
}

#[test]
fn a_level_that_never_grows_takes_the_leaves_with_it_and_that_is_told() {
    let dir = Dir::new();
    let lines =
        ["levels = 4", "length = [1, 0.8, 0.6, 0]", "length_v = [0, 0, 0, 0]", "branches = [1, 20, 10, 5]"];
    let _ = dir.file("lost.toml", acer(&dir, &lines));
    let said = |args: &[&str]| {
        let run = dir.run([args, &["-o", "p.png"]].concat());
        let _ = run.ok();
        run.stderr()
    };
    for command in ["grow", "render", "silhouette"] {
        let told = said(&[command, "lost.toml"]);
        for words in ["`length[3]` is 0", "no leaves", "raise it, or lower `levels` to 3"] {
            assert_eq!(told.matches(words).count(), 1, "{command}: {told}");
        }
        assert!(!said(&[command, "lost.toml", "--no-leaves"]).contains("length[3]"), "{command}");
        assert!(!said(&["--quiet", command, "lost.toml"]).contains("length[3]"), "{command}");
        assert!(!said(&[command, "acer"]).contains("no leaves"), "{command}");
    }
    let run = dir.run(["grow", "lost.toml", "--seeds", "1..4", "--stats-only"]);
    assert!(run.code() == 0 && run.stderr().matches("`length[3]`").count() == 1, "{run}");
}
