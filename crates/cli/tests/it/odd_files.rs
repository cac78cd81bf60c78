//! Links, pipes and left-over files in run folders; names that terminals and spreadsheets obey.

#![cfg(unix)]

use pleach_tests::{Dir, small, wait_for_progress};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};

fn goal(dir: &Dir, name: &str) {
    let _ = dir.run(["silhouette", "acer", "--seed", "3", "--size", "140", "-o", "goal.png"]).ok();
    std::fs::rename(dir.path("goal.png"), dir.path(name)).unwrap();
}

fn pipe(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn what_is_not_a_lock_file_is_refused_and_left_alone() {
    let dir = Dir::new();
    goal(&dir, "acer.png");
    let victim = dir.file("victim", "precious");
    std::fs::create_dir(dir.path("run")).unwrap();
    let lock = dir.path("run/lock");
    let refused = |what: &str| {
        for more in [&[][..], &["--resume"], &["--overwrite"]] {
            let run = dir.run(small("acer.png", "run", &[&["--evaluations", "5"], more].concat()));
            run.fails(1, &["run/lock", what, "expected a file"]);
            assert_eq!(names(&dir.path("run")), ["lock"]);
        }
    };
    symlink("../victim", &lock).unwrap();
    refused("is a link");
    assert_eq!(std::fs::read(victim).unwrap(), b"precious");
    std::fs::remove_file(&lock).unwrap();
    symlink("../nowhere", &lock).unwrap();
    refused("is a link");
    assert!(!dir.path("nowhere").exists());
    std::fs::remove_file(&lock).unwrap();
    pipe(&lock);
    refused("is a pipe");
    std::fs::remove_file(&lock).unwrap();
    std::fs::create_dir(&lock).unwrap();
    refused("is a folder");
    // What a killed run left there is a file, and stops nobody.
    std::fs::remove_dir(&lock).unwrap();
    let _ = dir.file("run/lock", "4294967295 0");
    let _ = dir.run(small("acer.png", "run", &["--evaluations", "5"])).ok();
    assert!(!lock.exists());
}

#[test]
fn a_stage_that_is_a_link_is_refused_and_its_files_stay() {
    let dir = Dir::new();
    goal(&dir, "acer.png");
    let fit = |more: &[&str]| dir.run(small("acer.png", "run", &[&["--evaluations", "5"], more].concat()));
    let _ = fit(&[]).ok();
    let before = names(&dir.path("run"));
    std::fs::create_dir(dir.path("other")).unwrap();
    for name in ["best.toml", "history.csv", "swap-complete"] {
        let _ = dir.file(&format!("other/{name}"), "precious");
    }
    symlink("../other", dir.path("run/unfinished")).unwrap();
    for more in [&["--overwrite"][..], &["--continue"], &[]] {
        fit(more).fails(1, &["run/unfinished is a link, expected a folder"]);
    }
    for name in names(&dir.path("other")) {
        assert_eq!(std::fs::read(dir.path("other").join(name)).unwrap(), b"precious");
    }
    std::fs::remove_file(dir.path("run/unfinished")).unwrap();
    assert_eq!(names(&dir.path("run")), before);
    let _ = fit(&["--overwrite"]).ok();
    assert_eq!(names(&dir.path("run")), before);
}

/// A link under the name of a result is replaced; a pipe is neither read nor waited for.
#[test]
fn results_never_go_where_a_link_leads() {
    let dir = Dir::new();
    goal(&dir, "acer.png");
    let victim = dir.file("victim", "precious");
    std::fs::create_dir(dir.path("run")).unwrap();
    symlink("../victim", dir.path("run/best.toml")).unwrap();
    let fit = |more: &[&str]| dir.run(small("acer.png", "run", &[&["--evaluations", "5"], more].concat()));
    let _ = fit(&[]).ok();
    assert_eq!(std::fs::read(victim).unwrap(), b"precious");
    assert!(!dir.path("run/best.toml").is_symlink());
    for name in ["summary.json", "checkpoint", "history.csv"] {
        let path = dir.path("run").join(name);
        let _ = std::fs::remove_file(&path);
        pipe(&path);
        fit(&["--overwrite"]).fails(1, &[name, "is a pipe"]);
        std::fs::remove_file(path).unwrap();
    }
    // A search does not go on from what somebody else put there.
    symlink("../victim", dir.path("run/checkpoint")).unwrap();
    fit(&["--resume"]).fails(1, &["checkpoint is a link"]);
}

#[test]
fn what_a_killed_run_left_half_written_goes() {
    let dir = Dir::new();
    goal(&dir, "acer.png");
    let fit = |more: &[&'static str]| small("acer.png", "run", more);
    let mut killed = dir.command(fit(&["--evaluations", "100000000"]));
    let mut killed = killed.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    wait_for_progress(&dir.path("run/checkpoint"));
    killed.kill().unwrap();
    let _ = killed.wait().unwrap();
    // As a kill in the middle of a write leaves them.
    let halves = ["checkpoint.aB3dE6.tmp", "summary.json.000000.tmp", "overlay-2.png.zzzzzz.tmp"];
    let others = ["notes.aB3dE6.tmp", "checkpoint.tmp", "checkpoint.toolong1.tmp", "best.toml.aB-dE6.tmp"];
    let leave = |folder: &str| {
        halves.iter().chain(&others).for_each(|name| drop(dir.file(&format!("{folder}/{name}"), "half")));
    };
    let check = |folder: &str| {
        let names = names(&dir.path(folder));
        assert!(halves.iter().all(|name| !names.contains(&(*name).to_owned())), "{names:?}");
        assert!(others.iter().all(|name| names.contains(&(*name).to_owned())), "{names:?}");
    };
    leave("run");
    let mut resumed = dir.command(fit(&["--evaluations", "100000000", "--resume", "--timeout", "1"]));
    let _ = resumed.output().unwrap();
    check("run");
    leave("run");
    std::fs::create_dir_all(dir.path("run/unfinished")).unwrap();
    leave("run/unfinished");
    let _ = dir.run(fit(&["--evaluations", "20", "--overwrite"])).ok();
    check("run");
    check("run/unfinished");
}

/// A name that a terminal obeys is escaped wherever it is shown, and one that a spreadsheet would run, or
/// that breaks a line, is a cell that does neither. `collect` reads it back.
#[test]
fn names_of_files_are_shown_and_never_obeyed() {
    let dir = Dir::new();
    let odd = ["a\u{1b}[31mred.png", "=1+1.png", "two\nlines.png", "bidi\u{202e}gnp.png", "-x.png"];
    for name in odd {
        goal(&dir, name);
    }
    let _ = dir.file("\u{1b}[2Jbroken.png", "no picture");
    let is_tame = |text: &str| {
        assert!(!text.chars().any(|c| c.is_control() && c != '\n' || c == '\u{202e}'), "{text:?}");
    };
    let fit = |goals: &[&str]| {
        let options = ["fit", "--size", "32", "--evaluations", "5", "--from", "acer", "--individual", "off"];
        dir.run([&options[..], &["--out", "runs", "--"], goals].concat())
    };
    let run = fit(&[&odd[..], &["\u{1b}[2Jbroken.png"]].concat());
    is_tame(&run.stdout());
    is_tame(&run.stderr());
    run.fails(1, &["[1/6] a\\u{1b}[31mred.png: ", "[3/6] two\\u{a}lines.png: ", "1 of 6 goals failed"]);
    let table = std::fs::read_to_string(dir.path("runs/summary.csv")).unwrap();
    is_tame(&table);
    let cells: Vec<&str> = table.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    let expected = [
        "'a\\u{1b}[31mred.png",
        "'=1+1.png",
        "'two\\u{a}lines.png",
        "'bidi\\u{202e}gnp.png",
        "'-x.png",
        "'\\u{1b}[2Jbroken.png",
    ];
    assert_eq!(cells, expected);

    // The table names the goal that failed, as it is called.
    let collected = dir.run(["collect", "runs", "--json", "-o", "all.csv"]);
    is_tame(&collected.stdout());
    let report: serde_json::Value = serde_json::from_str(&collected.stdout()).unwrap();
    assert_eq!(report["failed"][0]["goal"], "\u{1b}[2Jbroken.png", "{report}");
    let all = std::fs::read_to_string(dir.path("all.csv")).unwrap();
    assert!(expected.iter().all(|cell| all.contains(cell)), "{all}");
    is_tame(&dir.run(["collect", "runs"]).stdout());

    // One goal, its report and its warnings; a mask, and a table of masks.
    let one = fit(&odd[..1]);
    is_tame(&(one.stdout() + &one.stderr()));
    let masks = dir.run([&["mask", "-o", "masks", "--"], &odd[..], &["\u{1b}[2Jbroken.png"]].concat());
    is_tame(&(masks.stdout() + &masks.stderr()));
    let table = std::fs::read_to_string(dir.path("masks/masks.csv")).unwrap();
    is_tame(&table);
    assert!(table.contains("\n'=1+1.png,") && table.contains("\n'two\\u{a}lines.png,"), "{table}");

    // A list may name goals as tables do.
    let _ = dir.file("goals.csv", "file\n'=1+1.png\n'two\\u{a}lines.png\n");
    let listed = ["fit", "--list", "goals.csv", "--size", "32", "--evaluations", "5", "--from", "acer"];
    let _ = dir.run([&listed[..], &["--individual", "off", "--out", "listed"]].concat()).ok();

    // Species files and grammars, those that are not there and those that are wrong.
    let _ = dir.file("\u{1b}[31m.toml", "levels = 99\n");
    for args in [["grow", "\u{1b}[31m.toml"], ["grow", "\u{1b}[32m.toml"], ["grammar", "\u{1b}[31m.toml"]] {
        let run = dir.run(args);
        is_tame(&(run.stdout() + &run.stderr()));
        assert_eq!(run.code(), 1, "{run}");
    }
}
