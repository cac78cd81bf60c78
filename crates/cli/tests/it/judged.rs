//! What `pleach fit` says of its result: references, verdict, next step, times, leaves.

use pleach_tests::{Dir, small, target};
use serde_json::Value;

fn summary(dir: &Dir, run: &str) -> Value {
    serde_json::from_slice(&std::fs::read(dir.path(run).join("summary.json")).unwrap()).unwrap()
}

#[test]
fn a_fit_says_whether_it_is_good_and_what_to_do_next() {
    let dir = Dir::new();
    let goal = target("acer.png");
    let report = dir.run(small(&goal, "my run", &["--evaluations", "200"])).ok();
    let summary = summary(&dir, "my run");
    let number = |at: &str| summary.pointer(at).and_then(Value::as_f64).unwrap_or_else(|| panic!("{at}"));
    let (same, other) =
        (number("/references/same_species/likeness"), number("/references/other_species/likeness"));
    assert!(same > other + 0.2, "{summary}");
    for at in
        ["/references/same_species/iou", "/references/best_ellipse/likeness", "/references/best_ellipse/iou"]
    {
        assert!((0.0..=1.0).contains(&number(at)), "{at}");
    }
    // The verdict follows from the references and the fresh seeds by the documented rule.
    let share =
        (number("/fresh_seeds/likeness/mean") - other) / (same - other).max(pleach_fit::MIN_VERDICT_SPAN);
    assert!((number("/verdict/share") - share).abs() < 1e-9);
    let kind = serde_json::to_value(pleach_fit::KindVerdict::from_share(share)).unwrap();
    assert_eq!(summary["verdict"]["kind"], kind);

    let line = |start: &str| {
        let found = report.lines().find(|line| line.starts_with(start));
        found.unwrap_or_else(|| panic!("no `{start}` in\n{report}"))
    };
    assert!(line("verdict  ").contains(&pleach_fit::KindVerdict::from_share(share).to_string()));
    // What the summary names, as commands.
    let steps = summary["next"].as_array().unwrap();
    assert!(!steps.is_empty() && line("next     ").contains(": pleach "), "{report}");
    assert!(report.contains("'my run"), "{report}");
    assert!(line("for this goal, about: ").contains(&format!("another tree of the species {same:.2}")));
    assert!(line("16 other seeds: ").contains("(an empty picture "));
    assert!(line("200 trees in ").contains(" trees/s) by `evolution`"));
    assert!(line("search ").contains(", judging "));

    // Times are told apart, and the first two are the whole that `--timeout` is of.
    let parts = number("/first_guess_seconds") + number("/search_seconds");
    assert!((number("/seconds") - parts).abs() < 1e-9 && number("/judging_seconds") > 0.0);
    // One tree is one tree.
    let one = dir.run(small(&goal, "one", &["--evaluations", "1"])).ok();
    assert!(one.lines().any(|line| line.starts_with("1 tree in ")), "{one}");
}

#[test]
fn the_history_has_likeness_whatever_is_made_small() {
    let dir = Dir::new();
    let goal = target("acer.png");
    for objective in ["balance", "iou"] {
        let more = ["--evaluations", "120", "--objective", objective];
        let _ = dir.run(small(&goal, objective, &more)).ok();
        let history = std::fs::read_to_string(dir.path(objective).join("history.csv")).unwrap();
        let mut lines = history.lines();
        let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
        let at = columns.iter().position(|name| *name == "likeness").unwrap();
        assert_eq!(columns.last(), Some(&"elapsed_s"), "time stays the last column");
        let values: Vec<f64> = lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect();
        assert!(values.len() > 1 && values.iter().all(|value| (0.01..=1.0).contains(value)), "{values:?}");
    }
}

/// Nothing is touched and nothing guessed for a request that cannot be carried out.
#[test]
fn a_wrong_request_is_told_before_anything_is_done() {
    let dir = Dir::new();
    let goal = target("acer.png");
    let fit =
        |more: &[&str]| dir.run([&["fit", &goal, "--out", "run", "--evaluations", "10"], more].concat());
    fit(&["--free", "brances"]).fails(1, &["`brances`", "did you mean `branches`"]);
    fit(&["--fix", "level:9"]).fails(1, &["`level:9`"]);
    fit(&["--set", "step=-1"]).fails(1, &["step=-1", "expected a number from 0.000001 to 1"]);
    fit(&["--set", "children=1e9"]).fails(1, &["children=1e9", "expected a whole number from 1 to 100000"]);
    fit(&["--leaves", "on", "--no-leaves"]).fails(2, &["--no-leaves"]);
    assert!(!dir.path("run").exists());
}

#[test]
fn whether_a_goal_has_leaves_is_seen_and_said() {
    let dir = Dir::new();
    let draw = |name: &str, more: &[&str]| {
        let args = ["silhouette", "acer", "--seed", "21", "--size", "96", "-o", name];
        let _ = dir.run([&args[..], more].concat()).ok();
    };
    draw("leafy.png", &[]);
    draw("bare.png", &["--no-leaves"]);
    let fit = |goal: &str, out: &str, more: &[&str]| {
        let args = ["fit", goal, "--out", out, "--size", "64", "--evaluations", "20", "--individual", "off"];
        let run = dir.run([&args[..], more].concat());
        let _ = run.ok();
        (summary(&dir, out), run.stderr())
    };
    let (bare, said) = fit("bare.png", "a", &["--generator", "weber-penn"]);
    assert_eq!((&bare["leaves"], &bare["leaves_detected"]), (&false.into(), &true.into()));
    assert!(said.contains("a bare tree, so no leaves are grown (--leaves on grows them)"), "{said}");
    let (leafy, said) = fit("leafy.png", "b", &["--generator", "weber-penn"]);
    assert_eq!((&leafy["leaves"], &leafy["leaves_detected"]), (&true.into(), &true.into()));
    assert!(!said.contains("bare"), "{said}");
    // What is said is done.
    let (on, _) = fit("bare.png", "c", &["--from", "acer"]);
    assert_eq!((&on["leaves"], &on["leaves_detected"]), (&true.into(), &false.into()));
    let (off, _) = fit("leafy.png", "d", &["--from", "acer", "--leaves", "off"]);
    assert_eq!(off["leaves"], false);
    let (old, _) = fit("leafy.png", "e", &["--from", "acer", "--no-leaves"]);
    assert_eq!(old["leaves"], false);
}
