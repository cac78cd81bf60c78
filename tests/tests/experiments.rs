//! A slice of every experiment against its committed results.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach_tests::Dir;

fn check(name: &str, slice: &[&str]) {
    let folder = pleach_tests::root().join("experiments").join(name);
    let args = [&["experiment", "check", folder.to_str().unwrap()], slice].concat();
    let run = Dir::new().run(&args);
    let agreed: usize = run.ok().split(' ').next().unwrap().parse().unwrap();
    assert!(agreed > 0, "{run}");
}

#[test]
fn hewitt_ga() {
    check("hewitt-ga", &["--repetitions", "1", "--evaluations", "500"]);
}

#[test]
fn generation_time() {
    check("generation-time", &["--repetitions", "2"]);
}

#[test]
fn blend() {
    check("blend", &["--repetitions", "1"]);
}

#[test]
fn treefit() {
    check("treefit", &["--repetitions", "2", "--evaluations", "100"]);
}

#[test]
fn needle() {
    check("needle", &["--repetitions", "2"]);
}

#[test]
fn complexity() {
    check("complexity", &["--repetitions", "3"]);
}

#[test]
fn likeness() {
    check("likeness", &["--repetitions", "1"]);
}

#[test]
fn changed_results_are_found() {
    let dir = Dir::new();
    let folder = pleach_tests::root().join("experiments/complexity");
    let spec = std::fs::read_to_string(folder.join("experiment.toml")).unwrap();
    let results = std::fs::read_to_string(folder.join("results.csv")).unwrap();
    let _ = dir.file("experiment.toml", spec);
    let line = results.lines().nth(1).unwrap();
    let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
    cells[3].push('1');
    let _ = dir.file("results.csv", results.replace(line, &cells.join(",")));
    dir.run(["experiment", "check", ".", "--repetitions", "1"]).fails(1, &["no row like"]);
}
