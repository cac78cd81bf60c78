//! The exam from outside: the same bytes on any number of threads and after a kill, and answers of others.

use pleach_tests::{Dir, root};
use std::time::{Duration, Instant};

/// Two goals, and rows that begin in each of the ways.
const TINY: [&str; 8] = [
    "--only",
    "acer-1,treegen_acer_bare",
    "--rows",
    "default,random,truth,ellipse",
    "--trees",
    "3",
    "--seconds",
    "0",
];

fn tiny<'a>(before: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [before, &["bench", "-o", "exam"], &TINY, more].concat()
}

/// The table without the columns of the clock.
fn timeless(dir: &Dir) -> Vec<String> {
    let text = std::fs::read_to_string(dir.path("exam/results.csv")).unwrap();
    let clock = text.lines().next().unwrap().split(',').filter(|column| column.starts_with("wall_s")).count();
    assert_eq!(clock, 1, "{text}");
    text.lines().map(|line| line.rsplit_once(',').unwrap().0.to_owned()).collect()
}

#[test]
fn an_exam_has_the_same_rows_on_any_number_of_threads_and_after_a_kill() {
    let whole = Dir::new();
    let board = whole.run(tiny(&["--threads", "2"], &[])).ok().to_owned();
    let rows = timeless(&whole);
    // Of two goals, and no truth of a tree of another program.
    assert_eq!(rows.len(), 1 + 2 * 4 - 1, "{rows:#?}");
    for words in ["## perturbed", "## foreign", "| default | 3 trees | 1 |", "| ellipse |  | 1 |"] {
        assert!(board.contains(words), "{words}\n{board}");
    }
    let page = std::fs::read_to_string(whole.path("exam/leaderboard.md")).unwrap();
    assert_eq!(page.trim_end(), board.trim_end());
    assert!(whole.path("exam/leaderboard.csv").exists());

    let killed = Dir::new();
    let mut child = killed.command(tiny(&["--threads", "1"], &[])).spawn().unwrap();
    let partial = killed.path("exam/results.csv.partial");
    let begun = Instant::now();
    while std::fs::read_to_string(&partial).map_or(0, |text| text.lines().count()) < 5 {
        assert!(begun.elapsed() < Duration::from_secs(60), "no rows came");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    let _ = child.wait().unwrap();
    assert!(!killed.path("exam/results.csv").exists(), "the exam was over too soon");
    killed.run(tiny(&[], &[])).fails(1, &["--resume", "--overwrite"]);
    killed.run(tiny(&[], &["--resume", "--photographs", "nowhere"])).fails(1, &["photographs nowhere"]);
    killed.run(["bench", "-o", "exam", "--resume"]).fails(1, &["an exam with other options"]);
    let _ = killed.run(tiny(&["--threads", "1"], &["--resume"])).ok();
    assert_eq!(timeless(&killed), rows);

    // The folder is an experiment as any other.
    let run = whole.run(["experiment", "check", "exam", "--evaluations", "3"]);
    assert!(run.ok().starts_with("7 rows agree"), "{run}");
}

#[test]
fn names_that_the_exam_does_not_know_are_refused() {
    let dir = Dir::new();
    let refused = |args: &[&str], code: i32, words: &[&str]| {
        dir.run([&["bench"], args].concat()).fails(code, words);
    };
    refused(
        &["-o", "exam", "--rows", "defaulted"],
        2,
        &["no row is called `defaulted`, did you mean `default`?"],
    );
    refused(&["-o", "exam", "--only", "foreigns"], 1, &["did you mean `foreign`?"]);
    refused(&["-o", "exam", "--seconds", "-1"], 2, &["expected 0, or seconds from 0.1"]);
    refused(&["--quick"], 2, &["--out"]);
    refused(&["--check", "mine.csv"], 1, &["mine.csv"]);
    assert!(!dir.path("exam").exists());
}

#[test]
fn answers_of_others_are_measured() {
    let dir = Dir::new();
    let _ = dir.run(["bench", "--goals", "goals", "--only", "acer-1,foreign"]).ok();
    let list = std::fs::read_to_string(dir.path("goals/goals.csv")).unwrap();
    let committed = std::fs::read_to_string(root().join("experiments/bench/goals.csv")).unwrap();
    assert_eq!(list.lines().count(), 12);
    assert!(list.lines().all(|line| committed.lines().any(|known| known == line)), "{list}");

    let palm = dir.run(["species", "palm"]).ok().to_owned();
    let _ = dir.file("goals/mine.toml", palm);
    let _ = dir.file("goals/mine.csv", "goal,species,seed,budget\nacer-1,mine.toml,3,100 trees\n");
    let run = dir.run(["bench", "--check", "goals/mine.csv"]);
    assert!(run.ok().contains("| mine | 100 trees | 1 | 0."), "{run}");
    let _ = dir.file("goals/mine.csv", "goal,species\nacer-1,mine.toml\nacer-1,palm\n");
    dir.run(["bench", "--check", "goals/mine.csv"])
        .fails(1, &["mine.csv:3: the goal `acer-1` is there twice"]);
}
