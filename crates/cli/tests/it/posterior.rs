//! What a picture says about the numbers of its tree, and trees around a species, as a user would ask for them.

use pleach_tests::{Dir, read, target};
use serde_json::Value;

fn rows(dir: &Dir, file: &str) -> Vec<Vec<String>> {
    let text = String::from_utf8(read(&dir.path(file))).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn a_fit_tells_how_sure_it_is() {
    let (dir, goal) = (Dir::new(), target("palm.png"));
    let fit = |out: &str, threads: &str| {
        let start = ["fit", &goal, "--out", out, "--size", "64", "--from", "palm", "--evaluations", "5"];
        let asked = ["--individual", "off", "--posterior", "150", "--threads", threads];
        dir.run([&start[..], &asked].concat()).ok()
    };
    let said = fit("one", "1");
    assert!(said.contains("learnt from 150 trees around palm: the picture tells something about"), "{said}");
    assert!(said.contains("posterior.png"), "{said}");
    let _ = fit("two", "2");
    for file in ["posterior.csv", "posterior-1.toml", "posterior-8.toml"] {
        assert_eq!(read(&dir.path("one").join(file)), read(&dir.path("two").join(file)), "{file}");
    }
    assert!(dir.path("one/posterior.png").is_file());
    let table = rows(&dir, "one/posterior.csv");
    assert_eq!(table[0][..3], ["parameter", "shrunk", "prior_low"]);
    let summary: Value = serde_json::from_slice(&read(&dir.path("one/summary.json"))).unwrap();
    let known = &summary["posterior"];
    assert_eq!((&known["trees"], &known["is_familiar"]), (&150.into(), &true.into()), "{known}");
    assert_eq!(known["numbers"].as_array().unwrap().len() + 1, table.len());
    // The trees grow.
    let _ = dir.run(["grow", "one/posterior-1.toml", "-o", "tree.obj"]).ok();
    // A fit of the same goal without it leaves nothing of it.
    let again = ["fit", &goal, "--out", "one", "--size", "64", "--from", "palm", "--evaluations", "5"];
    let _ = dir.run([&again[..], &["--individual", "off", "--overwrite"]].concat()).ok();
    assert!(!dir.path("one/posterior.csv").exists() && !dir.path("one/posterior-1.toml").exists());
}

#[test]
fn a_picture_of_another_tree_is_strange() {
    let (dir, goal) = (Dir::new(), target("weeping_willow.png"));
    let start = ["fit", &goal, "--out", "run", "--size", "64", "--from", "palm", "--evaluations", "5"];
    let said = dir.run([&start[..], &["--individual", "off", "--posterior", "150"]].concat()).ok();
    assert!(said.contains("unlike those of trees around palm: these intervals cannot be trusted"), "{said}");
}

#[test]
fn wrong_numbers_of_trees_are_refused_before_anything_is_grown() {
    let (dir, goal) = (Dir::new(), target("palm.png"));
    for trees in ["0", "99", "20001", "many"] {
        dir.run(["fit", &goal, "--posterior", trees]).fails(2, &["--posterior"]);
    }
    let rules = ["fit", &goal, "--generator", "lsystem", "--evolve-rules", "--posterior", "200"];
    dir.run(rules).fails(1, &["--posterior", "rules"]);
}

#[test]
fn samples_are_trees_around_a_species() {
    let dir = Dir::new();
    let sample = |out: &str, more: &[&str]| {
        let _ = dir.run([&["sample", "palm", "-n", "5", "-o", out], more].concat()).ok();
        rows(&dir, &format!("{out}/samples.csv"))
    };
    let table = sample("a", &[]);
    assert_eq!((table.len(), &table[0][..2]), (6, &["file".to_owned(), "tree_seed".to_owned()][..]));
    assert_eq!(table, sample("b", &["--threads", "1"]), "the same on any number of threads");
    assert_ne!(table, sample("c", &["--seed", "2"]));
    assert!(dir.path("a/samples.png").is_file());
    let _ = dir.run(["grow", "a/3.toml", "-o", "tree.obj"]).ok();
    // Only what is free varies.
    let column = |table: &[Vec<String>], name: &str| {
        let place = table[0].iter().position(|cell| cell == name).unwrap();
        table[1..].iter().map(|row| row[place].clone()).collect::<Vec<_>>()
    };
    let some = sample("d", &["--free", "ratio"]);
    let all_equal = |cells: &[String]| cells.windows(2).all(|pair| pair[0] == pair[1]);
    assert!(all_equal(&column(&some, "length[1]")) && !all_equal(&column(&some, "ratio")));
}

#[test]
fn samples_that_cannot_be_are_refused() {
    let dir = Dir::new();
    for (code, args, says) in [
        (2, &["palm", "--spread", "-1"][..], "not a number from 0 to 10"),
        (2, &["palm", "--spread", "nan"], "not a number from 0 to 10"),
        (2, &["palm", "-n", "0"], "0"),
        (1, &["plam"], "palm"),
        (1, &["palm", "--free", "ratoi"], "ratio"),
        (1, &["palm", "--free", "ratio", "--fix", "ratio"], "varies"),
    ] {
        dir.run([&["sample", "-o", "x"], args].concat()).fails(code, &[says]);
    }
    assert!(!dir.path("x").exists());
}
