//! What a fit does to the files that are there: nothing finished is lost, and no two fits are mixed.

use pleach_tests::{Dir, wait_for, wait_for_progress};
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// Two small goals of one stem in two folders, and a third of another.
fn goals(dir: &Dir) {
    for (species, file) in [("acer", "a/tree.png"), ("palm", "b/tree.png"), ("acer", "acer.png")] {
        std::fs::create_dir_all(dir.path(file).parent().unwrap()).unwrap();
        let _ = dir.run(["silhouette", species, "--seed", "3", "--size", "140", "-o", file]).ok();
    }
}

const FIT: [&str; 8] = ["fit", "--size", "140", "--from", "acer", "--free", "crown", "--threads=2"];

fn fit<'a>(goal: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&FIT[..], &[goal], more].concat()
}

/// Every file below `folder` with its content.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(here) = waiting.pop() {
        for entry in std::fs::read_dir(&here).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                waiting.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().display().to_string();
                let _ = all.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    all
}

fn summary(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

/// The result without what depends on the clock.
fn result(folder: &Path) -> (Vec<u8>, Vec<u8>, Vec<u8>, Value) {
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let evaluations = summary(folder)["evaluations"].clone();
    (read("best.toml"), read("best.png"), read("parameters.csv"), evaluations)
}

fn spawn(dir: &Dir, args: &[&str]) -> Child {
    dir.command(args).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    let status = std::process::Command::new("kill").args([name, &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

#[test]
fn a_refused_command_changes_no_file() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.run(fit("acer.png", &["--evaluations", "30", "--out", "run"])).ok();
    let before = files(&dir.path("run"));
    let refused: [(&[&str], &str); 7] = [
        (&["--evaluations", "30", "--free", "brances"], "did you mean `branches`?"),
        (&["--evaluations", "30", "--fix", "brances"], "did you mean `branches`?"),
        (&["--evaluations", "30", "--optimizer", "newton"], "newton"),
        (&["--evaluations", "40"], "--evaluations was 30 and is 40"),
        (&["--evaluations", "30", "--seed", "2"], "--overwrite"),
        (&["--evaluations", "30", "--view", "90=none.png"], "none.png"),
        (&["--evaluations", "40", "--resume"], "--overwrite instead of --resume"),
    ];
    for (more, word) in refused {
        dir.run(fit("acer.png", &[more, &["--out", "run"]].concat())).fails(1, &[word]);
        assert!(files(&dir.path("run")) == before, "{more:?}");
    }
    let beauty = ["--evaluations", "30", "--objective", "beauty", "--out", "run"];
    dir.run(fit("acer.png", &beauty)).fails(2, &["beauty"]);
    assert!(files(&dir.path("run")) == before);
    // Nor does one that has nothing to do.
    let again = dir.run(fit("acer.png", &["--evaluations", "30", "--resume", "--out", "run"]));
    assert!(again.ok().is_empty() && again.stderr().contains("--continue"), "{again}");
    let again = dir.run(fit("acer.png", &["--evaluations", "30", "--resume", "--out", "run", "--json"]));
    assert_eq!(serde_json::from_str::<Value>(&again.ok()).unwrap(), summary(&dir.path("run")));
    assert!(files(&dir.path("run")) == before, "a finished fit is left as it is");
    // A refused command does not leave a folder behind.
    dir.run(fit("acer.png", &["--free", "brances", "--out", "new/run"])).fails(1, &["brances"]);
    dir.run(fit("missing.png", &["--out", "new/run"])).fails(1, &["missing.png"]);
    assert!(!dir.path("new").exists());
}

#[test]
fn a_batch_with_a_mistake_in_it_loses_nothing() {
    let dir = Dir::new();
    goals(&dir);
    let batch = |more: &[&'static str]| {
        let args = ["acer.png", "b/tree.png", "--evaluations", "20", "--out", "runs"];
        dir.run([&FIT[..], &args[..], more].concat())
    };
    let _ = batch(&[]).ok();
    let before = files(&dir.path("runs/tree"));
    for more in [&["--free", "brances"][..], &["--free", "brances", "--overwrite"], &["--fix", "brances"]] {
        batch(more).fails(1, &["did you mean `branches`?"]);
    }
    assert!(files(&dir.path("runs/tree")) == before);
    batch(&["--seed", "2"]).fails(1, &["--seed was 1 and is 2"]);
    assert!(files(&dir.path("runs/tree")) == before);
    // What cannot be known before is told in the row of its goal.
    let _ = dir.file("broken.png", "no picture");
    let broken = ["broken.png", "--evaluations", "20", "--out", "runs", "--shard", "1/1"];
    dir.run([&FIT[..], &broken[..]].concat()).fails(1, &["1 of 1 goals failed"]);
    let table = std::fs::read_to_string(dir.path("runs/summary-1-of-1.csv")).unwrap();
    assert!(table.contains("broken.png,failed,") && table.contains("is not a picture"), "{table}");
}

#[test]
fn a_summary_says_what_it_is_of_and_is_replaced_only_by_the_same() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.run(fit("a/tree.png", &["--evaluations", "30", "--out", "run"])).ok();
    let found = summary(&dir.path("run"));
    assert_eq!(found["goal"], "a/tree.png");
    assert_eq!(found["goal_sha256"].as_str().unwrap().len(), 64);
    let before = files(&dir.path("run"));
    let other = dir.run(fit("b/tree.png", &["--evaluations", "30", "--out", "run"]));
    other.fails(1, &["its goal was a/tree.png and is b/tree.png", "--overwrite"]);
    // A picture that is held out has no part in the search, and what is said of it does.
    let held_out = |direction: &str| {
        let picture = format!("{direction}=acer.png");
        let options = ["--evaluations", "30", "--out", "held-out", "--holdout-view", picture.as_str()];
        dir.run(fit("acer.png", &options))
    };
    let _ = held_out("45").ok();
    held_out("90").fails(1, &["--holdout-view was 45=acer.png and is 90=acer.png", "--overwrite"]);
    assert!(files(&dir.path("run")) == before);

    // The same once more loses nothing, nor is the same picture from another place.
    std::fs::rename(dir.path("a/tree.png"), dir.path("a/moved.png")).unwrap();
    let _ = dir.run(fit("a/moved.png", &["--evaluations", "30", "--out", "run"])).ok();
    assert_eq!(summary(&dir.path("run"))["goal"], "a/moved.png");
    // And what was asked for is done; a note of somebody else stays.
    let _ = dir.file("run/notes.txt", "mine");
    let _ = dir.run(fit("b/tree.png", &["--evaluations", "30", "--out", "run", "--overwrite"])).ok();
    assert_eq!(summary(&dir.path("run"))["goal"], "b/tree.png");
    assert!(dir.path("run/notes.txt").exists() && !dir.path("run/unfinished").exists());
}

/// While a new fit runs, and if it is interrupted, the old result stands; the new one is beside it.
#[test]
#[cfg(unix)]
fn files_of_two_fits_never_stand_side_by_side() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.run(fit("acer.png", &["--evaluations", "30", "--out", "run"])).ok();
    let before = files(&dir.path("run"));
    let long = ["--evaluations", "4000", "--out", "run", "--size", "96", "--overwrite"];
    let often = ["--checkpoint-every", "10ms"];
    let stopped = spawn(&dir, &fit("b/tree.png", &[&long[..], &often].concat()));
    wait_for_progress(&dir.path("run/unfinished/checkpoint"));
    signal(&stopped, "-TERM");
    let output = stopped.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(message.contains("--resume"), "{message}");
    let mut after = files(&dir.path("run"));
    after.retain(|name, _| !name.starts_with("unfinished/"));
    assert!(after == before, "{:?}", after.keys());
    assert_eq!(summary(&dir.path("run/unfinished"))["finished"], false);

    // Neither result is overwritten by accident.
    dir.run(fit("acer.png", &["--evaluations", "30", "--out", "run"])).fails(1, &["unfinished", "--resume"]);
    // Gone on with, the new one takes the place of the old one, with all its files.
    let resume = ["--evaluations", "4000", "--out", "run", "--size", "96", "--resume"];
    let _ = dir.run(fit("b/tree.png", &resume)).ok();
    let _ = dir.run(fit("b/tree.png", &[&long[..2], &["--size", "96", "--out", "whole"]].concat())).ok();
    assert!(result(&dir.path("run")) == result(&dir.path("whole")));
    let names = |folder: &str| files(&dir.path(folder)).into_keys().collect::<Vec<_>>();
    assert_eq!(names("run"), names("whole"));
}

/// Killed at any moment while a result is replaced: what is there is the old one or the new one.
#[test]
#[ignore = "nightly: the fit is begun sixteen times"]
#[cfg(unix)]
fn a_kill_while_a_result_is_replaced_loses_neither() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.run(fit("acer.png", &["--evaluations", "20", "--out", "old"])).ok();
    let args = ["--evaluations", "12", "--out", "run", "--overwrite"];
    let started = Instant::now();
    let _ = dir.run(fit("b/tree.png", &["--evaluations", "12", "--out", "new"])).ok();
    let took = started.elapsed();
    let (old, new) = (result(&dir.path("old")), result(&dir.path("new")));
    let mut both = [0, 0];
    for part in 0..16 {
        let _ = std::fs::remove_dir_all(dir.path("run"));
        std::fs::create_dir(dir.path("run")).unwrap();
        for (name, content) in files(&dir.path("old")) {
            std::fs::write(dir.path("run").join(name), content).unwrap();
        }
        let mut child = spawn(&dir, &fit("b/tree.png", &args));
        std::thread::sleep(took.mul_f64(0.5 + 0.6 * f64::from(part) / 16.0));
        let _ = child.kill();
        let _ = child.wait();
        if dir.path("run/unfinished").exists() {
            // Whatever a next command would do first.
            let _ = dir.run(fit("b/tree.png", &["--evaluations", "12", "--out", "run", "--resume"]));
        }
        let found = result(&dir.path("run"));
        assert!(found == old || found == new, "part {part}");
        both[usize::from(found == new)] += 1;
    }
    assert!(both[0] + both[1] == 16, "{both:?}");
}

/// `timeout` sends its signal twice at once; that is one request.
#[test]
#[cfg(unix)]
fn two_signals_at_once_are_one_request() {
    let dir = Dir::new();
    goals(&dir);
    for (round, second) in ["-TERM", "-INT", "-TERM"].into_iter().enumerate() {
        let out = format!("run{round}");
        let args = ["--evaluations", "100000", "--out", &out, "--size", "96", "--checkpoint-every", "10ms"];
        let stopped = spawn(&dir, &fit("b/tree.png", &args));
        wait_for_progress(&dir.path(&out).join("checkpoint"));
        signal(&stopped, "-TERM");
        std::thread::sleep(Duration::from_millis(10));
        signal(&stopped, second);
        let output = stopped.wait_with_output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(130), "{message}");
        assert!(message.contains("--resume"), "{message}");
        assert!(dir.path(&out).join("best.toml").exists());
    }
    // In the first guess there is nothing to keep, and nothing is left.
    let child = spawn(&dir, &["fit", "b/tree.png", "--out", "guess"]);
    wait_for(&dir.path("guess/lock"));
    std::thread::sleep(Duration::from_millis(200));
    signal(&child, "-TERM");
    signal(&child, "-TERM");
    let output = child.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(message.contains("no file was changed"), "{message}");
    assert!(!dir.path("guess").exists());
}

/// An interrupted first guess leaves a finished fit as it was.
#[test]
#[cfg(unix)]
fn a_first_guess_that_is_interrupted_changes_no_file() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.run(fit("acer.png", &["--evaluations", "30", "--out", "run"])).ok();
    let before = files(&dir.path("run"));
    for name in ["-TERM", "-KILL"] {
        let mut child = spawn(&dir, &["fit", "b/tree.png", "--out", "run", "--overwrite"]);
        wait_for(&dir.path("run/lock"));
        std::thread::sleep(Duration::from_millis(200));
        signal(&child, name);
        let _ = child.wait().unwrap();
        let mut after = files(&dir.path("run"));
        // A killed process cannot remove its lock file, which stops nobody.
        assert_eq!(after.remove("lock").is_some(), name == "-KILL");
        assert!(after == before, "{name}");
    }
    let _ = dir.run(fit("acer.png", &["--evaluations", "30", "--out", "run"])).ok();
    assert!(!dir.path("run/lock").exists());
}

#[test]
fn one_fit_at_a_time_writes_to_a_folder() {
    let dir = Dir::new();
    goals(&dir);
    let mut first = spawn(&dir, &fit("b/tree.png", &["--evaluations", "100000000", "--out", "run"]));
    wait_for(&dir.path("run/checkpoint"));
    for more in [&["--overwrite"][..], &["--resume"]] {
        let args = [&["--evaluations", "20", "--out", "run"], more].concat();
        dir.run(fit("acer.png", &args)).fails(1, &["another pleach", "process", "run"]);
    }
    // A batch fits its other goals first, and this one when its folder is free.
    std::fs::rename(dir.path("a/tree.png"), dir.path("a/run.png")).unwrap();
    let args = fit("a/run.png", &["acer.png", "--evaluations", "20", "--out", ".", "--overwrite"]);
    let mut batch = spawn(&dir, &args);
    let said = BufReader::new(batch.stderr.take().unwrap());
    let mut lines = said.lines().map(Result::unwrap);
    assert!(lines.any(|line| line.starts_with("[1/2] a/run.png: another pleach fits it")));
    assert!(lines.any(|line| line.starts_with("[2/2] acer.png: likeness")));
    assert!(first.try_wait().unwrap().is_none(), "the first fit has a long way to go");
    let _ = first.kill();
    let _ = first.wait();
    assert!(lines.any(|line| line.starts_with("[1/2] a/run.png: likeness")));
    assert!(batch.wait().unwrap().success());
    // A killed run does not keep its folder.
    let _ = dir.run(fit("acer.png", &["--evaluations", "20", "--out", "run", "--overwrite"])).ok();
}

#[test]
fn what_cannot_be_written_is_told_before_the_search() {
    let dir = Dir::new();
    goals(&dir);
    std::fs::create_dir_all(dir.path("run/best.toml")).unwrap();
    let started = dir.run(fit("acer.png", &["--evaluations", "100000000", "--out", "run"]));
    started.fails(1, &["best.toml is a folder"]);
    let _ = dir.file("file", "");
    dir.run(fit("acer.png", &["--out", "file"])).fails(1, &["file"]);
    dir.run(fit("acer.png", &["--out", "file/run"])).fails(1, &["file/run"]);
}

/// The folder is removed in the middle of a search: the result is written all the same.
#[test]
#[cfg(unix)]
fn a_folder_that_vanishes_is_made_again() {
    let dir = Dir::new();
    goals(&dir);
    let child = spawn(&dir, &fit("b/tree.png", &["--evaluations", "2500", "--out", "run", "--size", "96"]));
    wait_for(&dir.path("run/checkpoint"));
    std::fs::remove_dir_all(dir.path("run")).unwrap();
    let output = child.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{message}");
    assert_eq!(summary(&dir.path("run"))["finished"], true);
}

/// Nobody reads what a fit prints, or it cannot be written: the fit is finished all the same.
#[test]
#[cfg(target_os = "linux")]
fn closed_or_full_output_ends_no_worse() {
    let dir = Dir::new();
    goals(&dir);
    let program = pleach_tests::program().display().to_string();
    for (out, redirect, code) in
        [("closed", "| true", 0), ("full", "> /dev/full", 1), ("none", ">&- 2>&-", 1)]
    {
        let args = fit("acer.png", &["--evaluations", "30", "--out", out]).join(" ");
        let script = format!("{program} {args} {redirect}");
        let run = std::process::Command::new("sh")
            .args(["-c", &script])
            .current_dir(dir.path(""))
            .output()
            .unwrap();
        assert!(run.status.code() == Some(code) || out == "none", "{out}: {run:?}");
        assert_eq!(summary(&dir.path(out))["finished"], true, "{out}");
        assert!(!dir.path(out).join("checkpoint").exists(), "{out}");
        // So the same command is not refused.
        let _ = dir.run(fit("acer.png", &["--evaluations", "30", "--out", out])).ok();
    }
}

/// 60 trees and then 40 more are the same fit as 100 trees.
#[test]
fn a_finished_fit_can_be_continued() {
    let dir = Dir::new();
    goals(&dir);
    let run = |out: &str, more: &[&str]| dir.run(fit("b/tree.png", &[&["--out", out], more].concat()));
    let _ = run("parts", &["--evaluations", "60"]).ok();
    let first = result(&dir.path("parts"));
    let _ = run("parts", &["--evaluations", "40", "--continue"]).ok();
    let _ = run("whole", &["--evaluations", "100"]).ok();
    assert!(result(&dir.path("parts")) == result(&dir.path("whole")));
    assert!(result(&dir.path("parts")) != first);
    assert_eq!(summary(&dir.path("parts"))["options"], summary(&dir.path("whole"))["options"]);

    run("none", &["--evaluations", "40", "--continue"]).fails(1, &["no finished fit"]);
    run("parts", &["--evaluations", "40", "--continue", "--seed", "2"]).fails(1, &["seed"]);
    run("parts", &["--continue", "--resume"]).fails(2, &["--continue"]);
    assert!(result(&dir.path("parts")) == result(&dir.path("whole")));
    std::fs::remove_file(dir.path("parts/search-state")).unwrap();
    run("parts", &["--evaluations", "40", "--continue"])
        .fails(1, &["search-state", "--from parts/best.toml"]);
}

/// Interrupted while it is continued, the finished fit stands, and the same command goes on.
#[test]
#[cfg(unix)]
fn an_interrupted_continuation_goes_on() {
    let dir = Dir::new();
    goals(&dir);
    let args = |out: &'static str, count: &'static str, more: &[&'static str]| {
        fit("b/tree.png", &[&["--out", out, "--size", "96", "--evaluations", count], more].concat())
    };
    let _ = dir.run(args("parts", "100", &[])).ok();
    let before = result(&dir.path("parts"));
    let stopped = spawn(&dir, &args("parts", "3000", &["--continue"]));
    wait_for(&dir.path("parts/unfinished/checkpoint"));
    std::thread::sleep(Duration::from_millis(200));
    signal(&stopped, "-INT");
    let output = stopped.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(String::from_utf8_lossy(&output.stderr).contains("the same command goes on"));
    assert!(result(&dir.path("parts")) == before);
    let _ = dir.run(args("parts", "3000", &["--continue"])).ok();
    let _ = dir.run(args("whole", "3100", &[])).ok();
    assert!(result(&dir.path("parts")) == result(&dir.path("whole")));
}

/// Pictures and the history are there while the search runs.
#[test]
#[cfg(unix)]
fn a_running_fit_can_be_watched() {
    let dir = Dir::new();
    goals(&dir);
    let mut child = spawn(&dir, &fit("b/tree.png", &["--evaluations", "100000000", "--out", "run"]));
    let names = ["best.toml", "best.png", "overlay.png", "render.png", "history.csv"];
    for name in names {
        wait_for(&dir.path("run").join(name));
    }
    assert!(child.try_wait().unwrap().is_none(), "it runs");
    let render = image::open(dir.path("run/render.png")).unwrap().to_rgb8();
    assert!(render.pixels().any(|p| p.0 != render.get_pixel(0, 0).0), "something is drawn");
    signal(&child, "-INT");
    let _ = child.wait();
    let _ = dir.run(["grow", "run/best.toml", "--stats-only"]).ok();
}

#[test]
fn a_list_of_goals_gives_each_its_options() {
    let dir = Dir::new();
    goals(&dir);
    let _ = dir.file(
        "a/goals.csv",
        // As a spreadsheet of another country saves it.
        b"\xef\xbb\xbfFile;Height (m);View;Ground Row;Leaves;Remark;\r\ntree.png;12,5;90;60,0;;;\r\n../acer.png;;;;off;old, sick;\r\n;;;;;;\r\n",
    );
    let list = |more: &[&'static str]| {
        dir.run([&FIT[..], &["--list", "a/goals.csv", "--evaluations", "20", "--out", "runs"], more].concat())
    };
    let run = list(&["--height", "7"]);
    let _ = run.ok();
    assert!(run.stderr().contains("columns that are not read: `Remark`"), "{run}");
    let (tree, acer) = (summary(&dir.path("runs/tree")), summary(&dir.path("runs/acer")));
    assert_eq!((&tree["height_m"], &acer["height_m"]), (&12.5.into(), &7.0.into()));
    assert_eq!((&tree["options"]["view"], &tree["options"]["leaves"]), (&"90".into(), &"auto".into()));
    assert_eq!((&acer["options"]["leaves"], &acer["leaves"]), (&"off".into(), &false.into()));
    assert_eq!(tree["options"]["ground_row"], 60.0);
    // Sizes in metres, for tables.
    let table = std::fs::read_to_string(dir.path("runs/summary.csv")).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (header, row) = (lines.next().unwrap(), lines.next().unwrap());
    let cell = |name: &str| row[header.iter().position(|n| *n == name).unwrap()].parse::<f64>().unwrap();
    let grown = dir.run(["grow", "runs/tree/best.toml", "--stats-only", "--json"]).json();
    assert!((cell("height_m") - grown["height_m"].as_f64().unwrap()).abs() < 1e-5, "{table}");
    assert!(cell("crown_width_m") > 0.5 && cell("stem_diameter_m") > 0.01, "{table}");
    assert!(cell("crown_base_m") < cell("height_m"));

    let wrong = [
        ("height\n3\n", "`file`"),
        ("file,heihgt\nx.png,3\n", "`heihgt`"),
        ("file,height\ntree.png,-3\n", "goals.csv:2: height: `-3`"),
        ("file,height\n,3\n", "goals.csv:2: `file` is empty"),
        ("file,height\ntree.png\n", "goals.csv:2: the row has 1 cell, expected 2"),
        ("file\n", "no goal"),
        ("file,view\ntree.png,90=x.png\n", "further pictures"),
    ];
    for (text, word) in wrong {
        let _ = dir.file("a/goals.csv", text);
        list(&[]).fails(1, &["goals.csv", word]);
    }
}

/// A goal whose name is not UTF-8 has a run folder whose species file can be named as an argument.
#[test]
#[cfg(target_os = "linux")]
fn names_that_are_not_utf8_end_in_usable_ones() {
    use std::os::unix::ffi::OsStrExt as _;
    let dir = Dir::new();
    goals(&dir);
    let odd = std::ffi::OsStr::from_bytes(b"tr\xffee.png");
    std::fs::copy(dir.path("acer.png"), dir.path("").join(odd)).unwrap();
    let args = FIT.iter().map(std::ffi::OsStr::new).chain([odd, "--evaluations".as_ref(), "20".as_ref()]);
    let _ = dir.run(args).ok();
    let folder = std::fs::read_dir(dir.path("runs")).unwrap().next().unwrap().unwrap().path();
    let _ = dir.run(["grow", folder.join("best.toml").to_str().unwrap(), "--stats-only"]).ok();
}
