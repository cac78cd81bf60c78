//! Many workers at one batch: on one shard, killed in the middle, given bad lists, on a full disk.

use pleach_tests::{Dir, Run, read, results, root, tool, wait_for};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

const FIT: [&str; 9] =
    ["fit", "--size", "48", "--from", "palm", "--evaluations", "12", "--individual", "off"];

/// Small goals, called by their numbers from 1, and a list of them.
fn goals(dir: &Dir, count: usize) {
    std::fs::create_dir(dir.path("goals")).unwrap();
    let mut list = "file\n".to_owned();
    for seed in 1..=count {
        let (seed, out) = (seed.to_string(), format!("goals/{seed}.png"));
        let _ = dir.run(["silhouette", "palm", "--seed", &seed, "--size", "48", "-o", &out]).ok();
        list.push_str(&out);
        list.push('\n');
    }
    let _ = dir.file("goals.csv", list);
}

fn fit<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&FIT[..], more].concat()
}

fn spawn(dir: &Dir, args: &[&str]) -> Child {
    dir.command(args).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

fn ended(child: Child) -> Run {
    let output: Output = child.wait_with_output().unwrap();
    Run::new("a worker".to_owned(), output)
}

/// A table without the columns that depend on the clock, which come last.
fn table(path: &Path) -> String {
    let text = String::from_utf8(read(path)).unwrap();
    text.lines().map(|row| row.rsplitn(3, ',').last().unwrap().to_owned() + "\n").collect()
}

/// Goals of two folders hold the same bits.
#[track_caller]
fn assert_same(dir: &Dir, one: &str, other: &str, count: usize) {
    for goal in 1..=count {
        let read = |folder: &str| results(&dir.path(folder).join(goal.to_string()));
        assert!(read(one) == read(other), "goal {goal} differs");
    }
}

#[test]
fn a_list_that_is_wrong_is_refused_before_work_begins() {
    let dir = Dir::new();
    goals(&dir, 2);
    let cases = [
        ("height\n3\n", "goals.csv:1: expected a header with the column `file`"),
        ("goals/1.png\ngoals/2.png\n", "`goals/1.png` is not a column"),
        ("file,height\ngoals/1.png\n", "goals.csv:2: the row has 1 cell, expected 2"),
        (
            "file\ngoals/1.png\ngoals/2.png\ngoals/1.png\n",
            "goals.csv:4: goals/1.png is listed twice, first in line 2",
        ),
        (
            "file,heihgt\ngoals/1.png,3\n",
            "`heihgt` is not a column of a list of goals, did you mean `height`?",
        ),
        ("file,height (cm)\ngoals/1.png,300\n", "`height (cm)` is not a column"),
        ("file;height\ngoals/1.png;3,5\ngoals/2.png;3.5\n", "goals.csv:3: `height` is `3.5`, with a point"),
        ("file\ngoals/1.png\nother/1.png\n", "would both be fitted into runs/1"),
        ("file\n..\n", "has no file name"),
        ("file\ngoals/...png\n", "has no file name"),
        ("file\ngoals/..png\n", "has no file name"),
        ("file\n", "lists no goal"),
        ("", "expected a header"),
    ];
    for (text, words) in cases {
        let _ = dir.file("goals.csv", text);
        dir.run(fit(&["--list", "goals.csv", "--out", "runs"])).fails(1, &[words]);
        dir.run(["collect", "runs", "--list", "goals.csv"]).fails(1, &["error: "]);
    }
    for shard in ["9/8", "0/8", "1/0"] {
        dir.run(fit(&["goals/1.png", "--shard", shard])).fails(2, &["I/N with I from 1 to N"]);
    }
    assert!(!dir.path("runs").exists());
}

/// Goals may lie anywhere, run folders lie in `--out`.
#[test]
fn goals_outside_of_a_lists_folder_have_run_folders_inside_of_out() {
    let dir = Dir::new();
    goals(&dir, 2);
    std::fs::create_dir_all(dir.path("deep/list")).unwrap();
    let absolute = dir.path("goals/2.png").display().to_string();
    let _ = dir.file("deep/list/goals.csv", format!("file\n../../goals/1.png\n{absolute}\n"));
    let before = std::fs::read_dir(dir.path("")).unwrap().count();
    let _ = dir.run(fit(&["--list", "deep/list/goals.csv", "--out", "runs"])).ok();
    assert!(dir.path("runs/1/best.toml").exists() && dir.path("runs/2/best.toml").exists());
    assert_eq!(std::fs::read_dir(dir.path("")).unwrap().count(), before + 1, "only runs is new");
    assert_eq!(std::fs::read_dir(dir.path("deep/list")).unwrap().count(), 1);
    let _ = dir.run(["collect", "runs", "--list", "deep/list/goals.csv"]).ok();
}

/// Of two workers on one shard each goal is fitted by one; both end well, with the table of one.
#[test]
#[cfg(unix)]
fn two_workers_on_one_shard_lose_nothing_and_do_nothing_twice() {
    let dir = Dir::new();
    goals(&dir, 3);
    let run = |out: &'static str| {
        fit(&["--list", "goals.csv", "--evaluations", "300", "--out", out, "--resume", "--shard", "1/1"])
    };
    let _ = dir.run(run("alone")).ok();
    let first = spawn(&dir, &run("both"));
    wait_for(&dir.path("both/1/checkpoint"));
    let second = spawn(&dir, &run("both"));
    let said: Vec<String> = [first, second]
        .into_iter()
        .map(|child| {
            let run = ended(child);
            let _ = run.ok();
            run.stderr()
        })
        .collect();
    assert!(
        said[1].contains("[1/3] goals/1.png: another pleach fits it; looked at again at the end"),
        "{said:?}"
    );
    for goal in ["1/3] goals/1", "2/3] goals/2", "3/3] goals/3"] {
        let fitted = format!("[{goal}.png: likeness");
        let count: usize = said.iter().map(|text| text.matches(&fitted).count()).sum();
        assert_eq!(count, 1, "{goal} is fitted once: {said:?}");
    }
    assert_same(&dir, "alone", "both", 3);
    assert_eq!(table(&dir.path("both/summary-1-of-1.csv")), table(&dir.path("alone/summary-1-of-1.csv")));
    let _ = dir.run(["collect", "both", "--list", "goals.csv"]).ok();
}

/// What a worker was fitting when it was killed, another ends, to the same bits.
#[test]
#[cfg(unix)]
fn a_worker_that_waits_takes_over_from_one_that_is_killed() {
    let dir = Dir::new();
    goals(&dir, 1);
    let run = |out: &'static str| {
        fit(&["--list", "goals.csv", "--evaluations", "2000", "--out", out, "--resume", "--shard", "1/1"])
    };
    let _ = dir.run(run("alone")).ok();
    let mut first = spawn(&dir, &run("both"));
    wait_for(&dir.path("both/1/checkpoint"));
    let second = spawn(&dir, &run("both"));
    wait_for(&dir.path("both/summary-1-of-1.csv"));
    std::thread::sleep(Duration::from_millis(300));
    first.kill().unwrap();
    let _ = first.wait();
    let second = ended(second);
    let _ = second.ok();
    assert_same(&dir, "alone", "both", 1);

    // One that waits stops when it is asked to.
    let mut first = spawn(&dir, &run("again"));
    wait_for(&dir.path("again/1/checkpoint"));
    let second = spawn(&dir, &run("again"));
    std::thread::sleep(Duration::from_millis(300));
    assert!(Command::new("kill").args(["-TERM", &second.id().to_string()]).status().unwrap().success());
    let second = ended(second);
    second.fails(130, &["0 of 1 goals are done", "--resume"]);
    let _ = first.kill();
    let _ = first.wait();
}

/// A limit on the size of files stands for a full disk: pictures are larger than tables.
#[test]
#[cfg(unix)]
fn a_full_disk_fails_a_goal_and_loses_none() {
    let dir = Dir::new();
    goals(&dir, 2);
    let command = |out: &str| fit(&["--list", "goals.csv", "--resume", "--out"]).join(" ") + " " + out;
    let script = format!("trap '' XFSZ; ulimit -f 16; exec \"$0\" {}", command("runs"));
    let mut shell = Command::new("sh");
    let output =
        shell.current_dir(dir.path("")).args(["-c", &script]).arg(pleach_tests::program()).output().unwrap();
    let run = Run::new(script, output);
    run.fails(1, &["[1/2] goals/1.png: failed: cannot write runs/1/", "2 of 2 goals failed"]);
    assert!(!dir.path("runs/1/summary.json").exists(), "what is not whole is no result");
    let temporary = |folder: &str| {
        let entries = std::fs::read_dir(dir.path(folder)).unwrap();
        entries.filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|e| e == "tmp")).count()
    };
    assert_eq!(temporary("runs/1") + temporary("runs"), 0, "no half file is left");
    dir.run(["collect", "runs", "--list", "goals.csv"]).fails(1, &["of 2 goals"]);

    // With room again, the same command ends as if there had always been some.
    let _ = dir.run(command("runs").split(' ')).ok();
    let _ = dir.run(command("whole").split(' ')).ok();
    assert_same(&dir, "runs", "whole", 2);
    let _ = dir.run(["collect", "runs", "--list", "goals.csv"]).ok();
}

/// A shard whose process is killed is tried again.
#[test]
#[ignore = "nightly: nine fits"]
#[cfg(unix)]
fn gnu_parallel_tries_a_killed_shard_again() {
    const GOALS: usize = 4;
    let dir = Dir::new();
    let probe = "test \"$(seq 2 | parallel --will-cite --keep-order --retries 3 --joblog log echo {} | tr -d '\n')\" = 12";
    let needs = "GNU parallel (Debian: apt-get install parallel)";
    if !tool::is_usable(needs, Command::new("bash").current_dir(dir.path("")).args(["-c", probe])) {
        return;
    }
    goals(&dir, GOALS);
    let options = [&FIT[1..], &["--evaluations", "500"]].concat();
    let _ = dir.run([&["fit", "--list", "goals.csv", "--out", "whole"], &options[..]].concat()).ok();
    // The first fit of the second shard is killed in the middle.
    let _ = dir.file(
        "killed",
        "#!/bin/sh\ncase \"$*\" in\n*2/4*) mkdir once 2>/dev/null && {\n  \"$REAL\" \"$@\" & pid=$!\n  \
         until [ -e runs/2/checkpoint ]; do sleep 0.01; done\n  kill -KILL $pid; exit 1; } ;;\nesac\n\
         exec \"$REAL\" \"$@\"\n",
    );
    assert!(Command::new("chmod").arg("+x").arg(dir.path("killed")).status().unwrap().success());
    let mut script = Command::new(root().join("docs/cluster/parallel.sh"));
    script.current_dir(dir.path("")).env("REAL", pleach_tests::program()).env("PLEACH", "./killed");
    let run =
        Run::new("parallel.sh".to_owned(), script.arg(GOALS.to_string()).args(&options).output().unwrap());
    let _ = run.ok();
    assert!(dir.path("once").exists(), "one was killed");
    let _ = dir.run(["collect", "runs", "--list", "goals.csv"]).ok();
    assert_same(&dir, "runs", "whole", GOALS);
}

/// A server, two workers and forty goals; one worker is killed in the middle and another comes.
#[test]
#[cfg(unix)]
#[ignore = "nightly: forty goals are fitted twice"]
fn hyperqueue_loses_nothing_when_a_worker_is_killed() {
    const GOALS: usize = 40;
    // All that the scripts take from it.
    let probe = "from hyperqueue import Client, Job\nfrom hyperqueue.ffi.cluster import Cluster";
    let needs = "HyperQueue for python3 (pip install hyperqueue)";
    if !tool::is_usable(needs, Command::new("python3").args(["-c", probe])) {
        return;
    }
    let dir = Dir::new();
    goals(&dir, GOALS);
    let whole = fit(&["--list", "goals.csv", "--out", "whole"]);
    let _ = dir.run(&whole).ok();
    let mut script = Command::new("python3");
    script.current_dir(dir.path("")).arg(root().join("tests/cluster/kill_a_worker.py")).arg(root());
    script.arg(pleach_tests::program()).arg("runs").args(&FIT[1..]);
    let run = Run::new("kill_a_worker.py".to_owned(), script.output().unwrap());
    assert!(run.ok().contains("one worker killed"), "{run}");

    let run = dir.run(["collect", "runs", "--list", "goals.csv", "-o", "all.csv"]);
    assert!(run.ok().contains("40 of 40 goals finished"), "{run}");
    assert_eq!(table(&dir.path("all.csv")), table(&dir.path("whole/summary.csv")));
    assert_same(&dir, "runs", "whole", GOALS);
    let folders = std::fs::read_dir(dir.path("runs")).unwrap();
    assert_eq!(folders.filter(|entry| entry.as_ref().unwrap().path().is_dir()).count(), GOALS);
}
