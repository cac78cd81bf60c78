//! `pleach fit` with several goals, as a user runs it.

use pleach_tests::Dir;
use serde_json::Value;
use std::path::Path;

/// Three small goals.
fn goals(dir: &Dir) {
    std::fs::create_dir(dir.path("goals")).unwrap();
    for name in ["acer", "palm", "small_pine"] {
        let out = format!("goals/{name}.png");
        let _ = dir.run(["silhouette", name, "--seed", "3", "--size", "140", "-o", &out]).ok();
    }
}

const FIT: [&str; 9] = ["fit", "--size", "140", "--from", "acer", "--free", "crown", "--evaluations", "20"];
const ALL: [&str; 3] = ["goals/acer.png", "goals/palm.png", "goals/small_pine.png"];

fn fit<'a>(goals: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [&FIT[..], goals, more].concat()
}

/// Rows of a summary as cells, the heading first; without the columns that depend on the clock.
fn table(path: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    let mut rows: Vec<Vec<String>> =
        reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let time = rows[0].iter().position(|name| name.starts_with("wall_")).unwrap();
    assert!(rows[0][time..].iter().all(|name| name.starts_with("wall_")), "time comes last: {text}");
    for row in &mut rows {
        assert_eq!(row.len(), time + 2, "{text}");
        row.truncate(time);
    }
    rows
}

fn column(table: &[Vec<String>], name: &str) -> Vec<String> {
    let at = table[0].iter().position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
    table[1..].iter().map(|row| row[at].clone()).collect()
}

#[test]
fn each_goal_has_a_folder_and_a_row() {
    let dir = Dir::new();
    goals(&dir);
    let run = dir.run(fit(&ALL, &["--out", "runs", "--json"]));
    let summaries: Vec<Value> = run.ok().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let progress = run.stderr();
    for (i, name) in ["acer", "palm", "small_pine"].iter().enumerate() {
        assert_eq!(summaries[i]["species"], *name);
        assert_eq!(summaries[i]["goal"], ALL[i]);
        assert!(progress.contains(&format!("[{}/3] goals/{name}.png: likeness 0.", i + 1)), "{progress}");
    }
    assert_eq!(progress.lines().count(), 3, "one line per goal: {progress}");
    let rows = table(&dir.path("runs/summary.csv"));
    assert_eq!(column(&rows, "goal"), ALL);
    assert_eq!(column(&rows, "state"), ["finished"; 3]);
    assert_eq!(column(&rows, "evaluations"), ["20"; 3]);
    assert_eq!(column(&rows, "iou")[1], format!("{:.6}", summaries[1]["iou"].as_f64().unwrap()));

    // A goal of a batch is fitted as it is alone.
    let _ = dir.run(fit(&ALL[1..2], &["--out", "alone"])).ok();
    let best = |folder: &str| std::fs::read(dir.path(folder).join("best.toml")).unwrap();
    assert!(best("runs/palm") == best("alone"));

    // Nothing is left to do, and nothing is done.
    let again = dir.run(fit(&ALL, &["--out", "runs", "--resume"]));
    assert!(again.ok().contains("runs/summary.csv"));
    assert_eq!(again.stderr().matches("finished before").count(), 3, "{again}");
    assert_eq!(table(&dir.path("runs/summary.csv")), rows);
}

/// What is finished counts only for a batch that asks for the same.
#[test]
fn a_batch_is_not_resumed_with_other_options() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.run(fit(&ALL[..1], &["--out", "runs", "--shard", "1/1"])).ok();
    let before = std::fs::read(dir.path("runs/acer/summary.json")).unwrap();
    let resume = |more: &[&'static str]| {
        dir.run([fit(&ALL[..2], &["--out", "runs", "--resume"]), more.to_vec()].concat())
    };
    let cases: [(&[&str], &str); 6] = [
        (&["--seed", "2"], "--seed was 1 and is 2"),
        (&["--evaluations", "30"], "--evaluations was 20 and is 30"),
        (&["--objective", "iou"], "--objective was balance and is iou"),
        (&["--optimizer", "hewitt"], "--optimizer was evolution and is hewitt"),
        (&["--free", "leaves"], "--free was crown and is crown leaves"),
        (&["--timeout", "1m"], "--timeout was nothing and is 60s"),
    ];
    for (more, difference) in cases {
        resume(more).fails(1, &["runs/acer", difference, "--overwrite", "--out"]);
    }
    assert!(!dir.path("runs/palm").exists(), "nothing is begun");
    assert!(before == std::fs::read(dir.path("runs/acer/summary.json")).unwrap());
    // Those that decide nothing are free, and defaults that are spelled out are the same.
    let run = resume(&["--threads", "1", "--verbose", "--seed", "1", "--objective", "balance"]);
    let _ = run.ok();
    assert_eq!(run.stderr().matches("finished before").count(), 1, "{run}");
}

#[test]
fn a_goal_that_fails_is_named_and_the_others_go_on() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.file("goals/broken.png", "no picture");
    let goals = ["goals/acer.png", "goals/broken.png", "goals/missing.png", "goals/palm.png"];
    let run = dir.run(fit(&goals, &["--out", "runs"]));
    run.fails(
        1,
        &["[2/4] goals/broken.png: failed: ", "2 of 4 goals failed: goals/broken.png, goals/missing.png"],
    );
    assert!(dir.path("runs/palm/best.toml").exists());
    let rows = table(&dir.path("runs/summary.csv"));
    assert_eq!(column(&rows, "state"), ["finished", "failed", "failed", "finished"]);

    // Once mended, only what failed is fitted.
    std::fs::copy(dir.path("goals/acer.png"), dir.path("goals/broken.png")).unwrap();
    std::fs::copy(dir.path("goals/acer.png"), dir.path("goals/missing.png")).unwrap();
    let run = dir.run(fit(&goals, &["--out", "runs", "--resume"]));
    let _ = run.ok();
    assert_eq!(run.stderr().matches("finished before").count(), 2, "{run}");
    let rows = table(&dir.path("runs/summary.csv"));
    assert_eq!(column(&rows, "state"), ["finished"; 4]);
}

#[test]
fn shards_together_are_the_whole() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.run(fit(&ALL, &["--out", "parts", "--shard", "1/2"])).ok();
    let _ = dir.run(fit(&ALL, &["--out", "parts", "--shard", "2/2"])).ok();
    let first = table(&dir.path("parts/summary-1-of-2.csv"));
    let second = table(&dir.path("parts/summary-2-of-2.csv"));
    assert_eq!(column(&first, "goal"), [ALL[0], ALL[2]]);
    assert_eq!(column(&second, "goal"), [ALL[1]]);
    assert!(!dir.path("parts/summary.csv").exists());
    // More shards than goals: one without work is not a failure.
    let _ = dir.run(fit(&ALL, &["--out", "parts", "--shard", "4/4"])).ok();
    assert_eq!(table(&dir.path("parts/summary-4-of-4.csv")).len(), 1);
}

#[test]
fn what_cannot_be_a_batch_is_refused_before_work_begins() {
    let dir = Dir::new();
    goals(&dir);
    std::fs::create_dir(dir.path("more")).unwrap();
    let twice = fit(&["goals/acer.png", "more/acer.jpg"], &["--out", "runs"]);
    dir.run(twice).fails(1, &["goals/acer.png", "more/acer.jpg", "runs/acer"]);
    dir.run(fit(&ALL, &["--mask", "goals/acer.png"])).fails(1, &["--mask", "one goal", "auto"]);
    dir.run(fit(&ALL, &["--from", "acre"])).fails(1, &["acre", "did you mean"]);
    for wrong in ["0/2", "3/2", "x"] {
        dir.run(fit(&ALL, &["--shard", wrong])).fails(2, &["I/N with I from 1 to N"]);
    }
    dir.run(["fit"]).fails(2, &["GOAL"]);
    assert!(!dir.path("runs").exists());

    // Unfinished fits are not overwritten by accident.
    std::fs::create_dir_all(dir.path("runs/palm")).unwrap();
    let _ = dir.file("runs/palm/checkpoint", "something");
    dir.run(fit(&ALL, &["--out", "runs"])).fails(1, &["runs/palm", "unfinished", "--resume", "--overwrite"]);
    assert!(!dir.path("runs/acer").exists());
    // A spoiled checkpoint fails its goal, not the others.
    let spoiled = dir.run(fit(&ALL, &["--out", "runs", "--resume"]));
    spoiled.fails(1, &["[2/3] goals/palm.png: failed", "checkpoint", "1 of 3 goals failed"]);
    assert!(dir.path("runs/small_pine/best.toml").exists());
    let _ = dir.run(fit(&ALL, &["--out", "runs", "--overwrite"])).ok();
}

/// Asked to stop in the middle of the second goal, a batch says how to go on, and gone on with it ends
/// as if it had not been stopped.
#[test]
#[cfg(unix)]
fn a_stopped_batch_goes_on_where_it_was() {
    use std::process::Stdio;
    let dir = Dir::new();
    goals(&dir);
    let long = |out: &'static str| {
        fit(&ALL[..2], &["--out", out, "--size", "96", "--evaluations", "1200", "--seed", "2"])
    };
    let mut child = dir.command(long("parts")).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while !dir.path("parts/palm/checkpoint").exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-TERM", &id]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(message.contains("1 of 2 goals are done") && message.contains("--resume"), "{message}");
    assert_eq!(column(&table(&dir.path("parts/summary.csv")), "goal"), ["goals/acer.png"]);

    let resumed = dir.run([long("parts"), vec!["--resume"]].concat());
    let _ = resumed.ok();
    assert!(resumed.stderr().contains("[1/2] goals/acer.png: finished before"), "{resumed}");
    let _ = dir.run(long("whole")).ok();
    for file in ["palm/best.toml", "palm/best.png", "acer/best.toml"] {
        let read = |folder: &str| std::fs::read(dir.path(folder).join(file)).unwrap();
        assert!(read("parts") == read("whole"), "{file}");
    }
    assert_eq!(table(&dir.path("parts/summary.csv")), table(&dir.path("whole/summary.csv")));
}
