//! `pleach collect`, as a user runs it after several workers.

use pleach_tests::{Dir, Run, read};
use serde_json::Value;
use std::path::Path;

/// Four small goals, and a list of them.
fn goals(dir: &Dir) {
    std::fs::create_dir(dir.path("goals")).unwrap();
    for seed in ["1", "2", "3", "4"] {
        let out = format!("goals/{seed}.png");
        let _ = dir.run(["silhouette", "palm", "--seed", seed, "--size", "48", "-o", &out]).ok();
    }
    let _ = dir.file("goals.csv", "file,height\ngoals/1.png,5\ngoals/2.png,\ngoals/3.png,7\ngoals/4.png,\n");
}

const FIT: [&str; 9] =
    ["fit", "--size", "48", "--from", "palm", "--evaluations", "12", "--individual", "off"];

fn fit(dir: &Dir, more: &[&str]) -> Run {
    dir.run([&FIT[..], more].concat())
}

fn shard(dir: &Dir, out: &str, shard: &str) -> Run {
    fit(dir, &["--list", "goals.csv", "--out", out, "--resume", "--shard", shard])
}

/// A table without the columns that depend on the clock, which come last.
fn table(path: &Path) -> String {
    let text = String::from_utf8(read(path)).unwrap();
    let at = text.lines().next().unwrap().split(',').position(|name| name.starts_with("wall_")).unwrap();
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    let rows = reader.records().map(|row| row.unwrap().iter().take(at).collect::<Vec<_>>().join(",") + "\n");
    rows.collect()
}

fn report(run: &Run) -> Value {
    serde_json::from_str(&run.stdout()).unwrap()
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let _ = std::fs::copy(&path, to.join(path.file_name().unwrap())).unwrap();
    }
}

#[test]
fn shards_give_the_table_of_one_run() {
    let dir = Dir::new();
    goals(&dir);
    let _ = fit(&dir, &["--list", "goals.csv", "--out", "whole"]).ok();
    // Of the very same folders it is the very same table.
    let _ = dir.run(["collect", "whole", "--list", "goals.csv", "-o", "same.csv"]).ok();
    assert!(read(&dir.path("same.csv")) == read(&dir.path("whole/summary.csv")));

    // Workers in folders of their own, as on nodes with disks of their own.
    let _ = shard(&dir, "parts/a", "1/3").ok();
    let _ = shard(&dir, "parts/b", "2/3").ok();
    let _ = shard(&dir, "parts/b", "3/3").ok();
    for more in
        [&["--list", "goals.csv"][..], &["goals/1.png", "goals/2.png", "goals/3.png", "goals/4.png"], &[]]
    {
        let run = dir.run([&["collect", "parts", "-o", "all.csv"], more].concat());
        assert!(run.ok().contains("4 of 4 goals finished"), "{run}");
        assert_eq!(table(&dir.path("all.csv")), table(&dir.path("whole/summary.csv")), "{more:?}");
    }
    // To standard output, the report goes out of its way.
    let run = dir.run(["collect", "parts", "-o", "-"]);
    assert!(run.ok().starts_with("goal,state,") && run.stderr().contains("4 of 4 goals"), "{run}");
    assert_eq!(dir.run(["collect", "parts", "--list", "goals.csv", "--array"]).ok().trim(), "");
}

#[test]
fn what_is_missing_unfinished_or_failed_is_named() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.file("goals/2.png", "no picture");
    shard(&dir, "runs", "2/4").fails(1, &["1 of 1 goals failed"]);
    let _ = shard(&dir, "runs", "1/4").ok();
    // What a worker leaves that was killed in the middle.
    std::fs::create_dir(dir.path("runs/3")).unwrap();
    let _ = dir.file("runs/3/checkpoint", "pleach-checkpoint 6 weber-penn/evolution 0 00000000\n");
    // What is only called so is nobody's run.
    std::fs::create_dir_all(dir.path("runs/source/checkpoint")).unwrap();
    std::fs::create_dir(dir.path("runs/notes")).unwrap();
    let _ = dir.file("runs/notes/checkpoint", "something");

    let run = dir.run(["collect", "runs", "--list", "goals.csv", "-o", "all.csv"]);
    run.fails(1, &["of 4 goals 1 missing, 1 unfinished, 1 failed"]);
    let text = run.stdout();
    for words in [
        "1 of 4 goals finished",
        "missing: goals/4.png",
        "unfinished: goals/3.png: runs/3",
        "failed: goals/2.png: ",
    ] {
        assert!(text.contains(words), "`{words}`\n{run}");
    }
    assert!(text.contains("is not a picture"), "the reason of the worker: {run}");
    let all = table(&dir.path("all.csv"));
    assert!(all.contains("goals/1.png,finished") && all.contains("goals/2.png,failed"), "{all}");
    assert_eq!(all.lines().count(), 3, "{all}");

    let array = |more: &[&str]| {
        dir.run([&["collect", "runs", "--list", "goals.csv", "--array"], more].concat()).stdout()
    };
    assert_eq!(array(&[]).trim(), "2-4");
    assert_eq!(array(&["--shards", "2"]).trim(), "1-2");
    assert_eq!(array(&["--shards", "3"]).trim(), "1-3", "goals 2 and 3 are in shards 2 and 3, goal 4 in 1");
    dir.run(["collect", "runs", "--array"]).fails(1, &["--list"]);
    dir.run(["collect", "runs", "--shards", "0", "--array"]).fails(2, &["--shards"]);
    dir.run(["collect", "runs", "--list", "goals.csv", "--shards", "3"]).fails(2, &["--array"]);

    let found = report(&dir.run(["collect", "runs", "--list", "goals.csv", "--json"]));
    assert_eq!((&found["complete"], &found["finished"]), (&false.into(), &1.into()));
    assert_eq!(found["missing"][0]["number"], 4);
    assert_eq!(found["unfinished"][0]["folder"], "runs/3");

    // Mended and gone on with, by another division into shards, nothing is left to say.
    let _ = dir.run(["silhouette", "palm", "--seed", "2", "--size", "48", "-o", "goals/2.png"]).ok();
    std::fs::remove_file(dir.path("runs/3/checkpoint")).unwrap();
    let _ = shard(&dir, "runs", "1/1").ok();
    let run = dir.run(["collect", "runs", "--list", "goals.csv"]);
    assert!(run.ok().contains("4 of 4 goals finished"), "{run}");
}

#[test]
fn what_is_there_twice_or_made_otherwise_is_named() {
    let dir = Dir::new();
    goals(&dir);
    let _ = shard(&dir, "runs", "1/1").ok();
    let collect = |more: &[&str]| dir.run([&["collect", "runs", "--list", "goals.csv"], more].concat());
    let _ = collect(&["-o", "before.csv"]).ok();

    // Another worker's result of the second goal, and somebody's copy of the third.
    copy(&dir.path("runs/2"), &dir.path("runs/late/2"));
    copy(&dir.path("runs/3"), &dir.path("runs/backup"));
    let run = collect(&["-o", "all.csv"]);
    run.fails(1, &["2 twice"]);
    let text = run.stdout();
    assert!(text.contains("twice: goals/2.png: runs/2: runs/late/2"), "{run}");
    assert!(text.contains("twice: goals/3.png: runs/3: runs/backup"), "{run}");
    assert!(read(&dir.path("all.csv")) == read(&dir.path("before.csv")), "each is in the table once");
    dir.run(["collect", "runs"]).fails(1, &["2 twice"]);
    for folder in ["runs/late", "runs/backup"] {
        std::fs::remove_dir_all(dir.path(folder)).unwrap();
    }

    // One of another seed; the heights of the list are no fault.
    let _ = fit(&dir, &["goals/4.png", "--seed", "7", "--overwrite", "--out", "runs/4"]).ok();
    let run = collect(&[]);
    run.fails(1, &["1 with other options"]);
    assert!(
        run.stdout().contains("with other options: goals/4.png: runs/4: --seed is 7, and 1 in most"),
        "{run}"
    );

    // A goal that is another picture now.
    let _ = fit(&dir, &["goals/4.png", "--overwrite", "--out", "runs/4"]).ok();
    std::fs::copy(dir.path("goals/2.png"), dir.path("goals/1.png")).unwrap();
    let run = collect(&[]);
    run.fails(1, &["1 with other options"]);
    assert!(run.stdout().contains("goals/1.png is another picture now"), "{run}");
    assert!(!run.stdout().contains("twice"), "one picture under two names is wanted twice: {run}");

    // Folders of other goals are told of, and not in the table.
    let _ = dir.file("goals.csv", "file\ngoals/2.png\ngoals/3.png\n");
    let run = collect(&["-o", "all.csv"]);
    assert!(run.ok().contains("2 run folders are of no goal that was asked for"), "{run}");
    assert_eq!(table(&dir.path("all.csv")).lines().count(), 3);
}

#[test]
fn what_cannot_be_collected_is_refused() {
    let dir = Dir::new();
    goals(&dir);
    dir.run(["collect", "runs"]).fails(1, &["cannot read the folder runs"]);
    std::fs::create_dir(dir.path("runs")).unwrap();
    dir.run(["collect", "runs"]).fails(1, &["runs holds no run folder"]);
    dir.run(["collect", "goals.csv"]).fails(1, &["goals.csv"]);
    dir.run(["collect", "runs", "goals/1.png", "--list", "goals.csv"]).fails(2, &["--list"]);
    dir.run(["collect", "runs", "a/1.png", "b/1.png"]).fails(1, &["a/1.png", "b/1.png"]);
    dir.run(["collect"]).fails(2, &["RUNS"]);
    // With a list, an empty folder is one in which everything is missing.
    dir.run(["collect", "runs", "--list", "goals.csv"]).fails(1, &["4 missing"]);
    // A table that is not ours is left alone; one that cannot be read is told of.
    let _ = shard(&dir, "runs", "1/1").ok();
    let _ = dir.file("runs/summary.csv", "a,b\n1,2\n");
    let _ = dir.run(["collect", "runs", "--list", "goals.csv"]).ok();
    let _ = dir.file("runs/summary.csv", "goal,state,reason\n1,2\n");
    dir.run(["collect", "runs", "--list", "goals.csv"]).fails(1, &["cannot read runs/summary.csv"]);
    std::fs::remove_file(dir.path("runs/summary.csv")).unwrap();
    // A spoilt summary is of a fit that has to be made again.
    let _ = dir.file("runs/1/summary.json", "{");
    dir.run(["collect", "runs", "--list", "goals.csv", "-o", "no/such/all.csv"])
        .fails(1, &["no/such/all.csv"]);
    dir.run(["collect", "runs", "--list", "goals.csv"]).fails(1, &["1 unfinished"]);
}
