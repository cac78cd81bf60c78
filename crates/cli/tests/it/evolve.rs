//! `pleach fit --evolve-rules`, as a user runs it.

use pleach_tests::{Dir, read, results};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// A small goal that a grammar has grown.
fn goal(dir: &Dir) {
    let _ = dir.run(["silhouette", "grammar_pine", "--seed", "3", "--size", "64", "-o", "goal.png"]).ok();
}

fn fit<'a>(out: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["fit", "goal.png", "--out", out, "--size", "64", "--evolve-rules"], more].concat()
}

#[test]
fn a_grammar_is_found_from_nothing_and_grows_with_other_seeds() {
    let dir = Dir::new();
    goal(&dir);
    let run = dir.run(fit("run", &["--evaluations", "1500"]));
    let said = run.ok();
    assert!(said.contains("the grammar, of ") && said.contains("\naxiom:"), "{said}");
    for file in ["best.toml", "best.png", "overlay.png", "render.png", "history.csv", "parameters.csv"] {
        assert!(dir.path("run").join(file).is_file(), "{file}");
    }
    let summary: serde_json::Value = serde_json::from_slice(&read(&dir.path("run/summary.json"))).unwrap();
    assert_eq!((&summary["generator"], &summary["optimizer"]), (&"lsystem".into(), &"rules".into()));
    assert_eq!(summary["objective"], "overlap");
    let grammar = summary["grammar"].as_str().unwrap();
    assert!(said.contains(grammar) && summary["grammar_length"].as_u64().unwrap() > 20);
    assert!(String::from_utf8(read(&dir.path("run/best.toml"))).unwrap().contains(grammar));
    let first = summary["iou"].as_f64().unwrap();
    assert!(first > 0.4, "IoU {first}");
    assert_eq!(summary["fresh_seeds"]["count"], 16);
    let _ = dir.run(["grow", "run/best.toml", "--seed", "77", "-o", "tree.glb"]).ok();
    // The file of the grammar alone is one that `pleach grammar` takes.
    let _ = dir.file("found.lsystem", grammar);
    let _ = dir.run(["grammar", "found.lsystem", "--check"]).ok();
}

#[test]
fn threads_change_nothing_and_seeds_do() {
    let dir = Dir::new();
    goal(&dir);
    let run = |out: &str, more: &[&str]| {
        let _ = dir.run([fit(out, &["--evaluations", "200"]), more.to_vec()].concat()).ok();
        results(&dir.path(out))
    };
    let one = run("one", &["--threads", "1"]);
    assert!(one == run("four", &["--threads", "4"]));
    assert!(one != run("other", &["--threads", "4", "--seed", "2"]));
}

#[test]
fn a_grammar_that_is_given_is_where_it_starts() {
    let dir = Dir::new();
    goal(&dir);
    let args = ["--from", "grammar_pine", "--evaluations", "60", "--objective", "balance"];
    let _ = dir.run(fit("run", &args)).ok();
    let summary: serde_json::Value = serde_json::from_slice(&read(&dir.path("run/summary.json"))).unwrap();
    assert_eq!(summary["objective"], "balance", "what is said counts");
    let species = String::from_utf8(read(&dir.path("run/best.toml"))).unwrap();
    // Its parameters are those of the start.
    assert!(species.contains("param needles = 40 in 0..200"), "{species}");
    assert!(species.contains("\nneedles = "), "{species}");
}

#[cfg(unix)]
#[test]
fn a_killed_search_goes_on_to_the_same_bits() {
    let dir = Dir::new();
    goal(&dir);
    let long = ["--evaluations", "800", "--checkpoint-every", "50ms"];
    let _ = dir.run(fit("whole", &long)).ok();
    let mut child =
        dir.command(fit("parts", &long)).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let checkpoint = dir.path("parts/checkpoint");
    let started = Instant::now();
    // More than what is written before the first tree.
    while !std::fs::metadata(&checkpoint).is_ok_and(|file| file.len() > 20_000) {
        assert!(started.elapsed() < Duration::from_secs(60), "no checkpoint within a minute");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    let _ = child.wait();
    assert!(checkpoint.exists(), "the search was long enough to be killed");
    // An ordinary fit is another search.
    dir.run(["fit", "goal.png", "--out", "parts", "--size", "64", "--evaluations", "800", "--resume"])
        .fails(1, &["another run"]);
    let _ = dir.run([fit("parts", &long), vec!["--resume"]].concat()).ok();
    assert!(results(&dir.path("whole")) == results(&dir.path("parts")));
}

#[test]
#[ignore = "nightly: six searches"]
fn the_commands_of_the_page_run() {
    let dir = Dir::new();
    let page = read(&pleach_tests::root().join("docs/grammars.md"));
    let page = String::from_utf8(page).unwrap();
    let section = page.split("## Evolving rules").nth(1).unwrap().split("\n## ").next().unwrap();
    let commands: Vec<&str> = section.lines().filter_map(|line| line.strip_prefix("pleach ")).collect();
    assert_eq!(commands.len(), 2);
    let targets = format!("{}/", pleach_tests::root().join("targets").display());
    for command in commands {
        let command = command.replace("targets/", &targets);
        let _ = dir.run(command.split(' ').chain(["--size", "48", "--evaluations", "250"])).ok();
    }
    let _ = dir.run(["grow", "runs/european_larch/best.toml", "--seed", "7", "-o", "larch.glb"]).ok();
}

#[test]
fn what_cannot_be_together_is_refused() {
    let dir = Dir::new();
    goal(&dir);
    let refused: [(&[&str], i32, &str); 6] = [
        (&["--optimizer", "cma"], 2, "--optimizer"),
        (&["--set", "prior=0"], 2, "--set"),
        (&["--generator", "weber-penn"], 1, "--generator lsystem"),
        (&["--generator", "auto"], 1, "--generator lsystem"),
        (&["--from", "palm"], 1, "weber-penn"),
        (&["--free", "lenght"], 1, "lenght"),
    ];
    for (more, code, word) in refused {
        dir.run(fit("run", more)).fails(code, &[word]);
        assert!(!dir.path("run").exists(), "{more:?}");
    }
}
