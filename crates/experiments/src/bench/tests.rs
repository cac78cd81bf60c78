//! The exam's goals, its part that is asked for, and answers of others.

use super::{BenchOptions, check_submissions, hand_out};
use crate::{Slice, check};
use std::path::{Path, PathBuf};

fn asked(only: &[&str]) -> BenchOptions {
    BenchOptions {
        only: Some(only.iter().map(|name| (*name).to_owned()).collect()),
        ..BenchOptions::default()
    }
}

/// What comes of a submission with this text.
fn checked(folder: &Path, text: &str) -> Result<String, String> {
    let path = folder.join("mine.csv");
    std::fs::write(&path, text).unwrap();
    let options = asked(&["acer-1", "treegen_acer_bare"]);
    check_submissions(&options, &[path], None).map_err(|error| format!("{error:#}"))
}

/// A change here is another exam: its results cannot be compared with earlier ones.
#[test]
fn the_goals_are_those_of_the_exam() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(hand_out(&BenchOptions::default(), folder.path()).unwrap(), 70);
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../experiments/bench/goals.csv");
    let [own, committed] =
        [folder.path().join("goals.csv"), committed].map(|path| std::fs::read_to_string(path).unwrap());
    for (own, committed) in own.lines().zip(committed.lines()) {
        assert_eq!(own, committed);
    }
    assert_eq!(own.lines().count(), committed.lines().count());
    assert!(folder.path().join("weeping_willow-4.png").exists());
}

#[test]
fn answers_that_are_wrong_say_where() {
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name);
    std::fs::write(
        here("small.png"),
        pleach_silhouette::Bitmap::from_fn(64, 64, |x, y| x > 20 && y > 9).to_png(),
    )
    .unwrap();
    std::fs::write(here("broken.toml"), "name = \"a\"\nlenght = 3\n").unwrap();
    let cases: &[(&str, &[&str])] = &[
        ("", &["mine.csv is empty, expected a table with the columns goal, species and seed"]),
        ("goal,species,seed\n", &["mine.csv has no answer, expected a line for each goal"]),
        ("goal,spieces\n", &["mine.csv:1: no column is called `spieces`, did you mean `species`?"]),
        ("goal,species,goal\n", &["mine.csv:1: the headings `goal` and `goal` mean the same column"]),
        ("species,seed\n", &["mine.csv:1: the column `goal` is missing"]),
        ("goal,seed\n", &["mine.csv:1: a column `species` or `picture` is missing"]),
        ("goal,species\nacre-1,palm\n", &["mine.csv:2: no goal is called", "did you mean `acer-1`?"]),
        (
            "goal,species\ntreegen_acer_bare,palm\nacer-1,palm\ntreegen_acer_bare,acer\n",
            &["mine.csv:4: the goal `treegen_acer_bare` is there twice, first in line 2"],
        ),
        ("goal,species\nacer-1,none.toml\n", &["mine.csv:2: cannot read the species file", "none.toml"]),
        ("goal,species\nacer-1,plam\n", &["mine.csv:2: no species", "did you mean `palm`"]),
        ("goal,species\nacer-1,broken.toml\n", &["mine.csv:2: ", "broken.toml:2:1", "did you mean `length`"]),
        ("goal,species,seed\nacer-1,palm,-1\n", &["mine.csv:2: `seed` is `-1`, expected a whole number"]),
        ("goal,species,seconds\nacer-1,palm,soon\n", &["mine.csv:2: `seconds` is `soon`"]),
        ("goal,species,budget\nacer-1,palm,9\n", &["mine.csv:2: `9` is not a budget", "`100 trees`"]),
        ("goal,species,picture\nacer-1,palm,a.png\n", &["mine.csv:2: there are both"]),
        ("goal,species,picture\nacer-1,,\n", &["mine.csv:2: there is neither"]),
        ("goal,picture\nacer-1,none.png\n", &["mine.csv:2: ", "none.png"]),
        (
            "goal,picture\nacer-1,small.png\n",
            &["mine.csv:2: the picture is 64 × 64 pixels, expected 256 × 256 as the goal `acer-1` is"],
        ),
        ("goal,seed,picture\nacer-1,3,small.png\n", &["mine.csv:2: a `seed` is beside a `picture`"]),
        ("goal,species\nacer-1\n", &["mine.csv:2: the row has 1 cell, expected 2"]),
    ];
    for (text, words) in cases {
        let error = checked(folder.path(), text).unwrap_err();
        assert!(words.iter().all(|word| error.contains(word)), "{text}\n{error}");
    }
    let none = check_submissions(&asked(&["palm-1"]), &[here("none.csv")], None).unwrap_err();
    assert!(format!("{none:#}").contains("none.csv"), "{none:#}");
}

#[test]
fn answers_of_others_stand_beside_an_exam() {
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name);
    let options = asked(&["acer-1"]);
    hand_out(&options, folder.path()).unwrap();
    std::fs::write(here("same.csv"), "goal,picture,seconds\nacer-1,acer-1.png,2\n").unwrap();
    std::fs::write(here("known.csv"), "Notes;Goal;Species;Seconds\nnone, yet;acer-1;acer;1,5\n").unwrap();
    let files = [here("same.csv"), here("known.csv")];
    let text = check_submissions(&options, &files, Some(&here("out"))).unwrap();
    let line =
        |name: &str| text.lines().find(|line| line.starts_with(&format!("| {name} |"))).unwrap().to_owned();
    assert!(line("same").contains("| 1.000 ± 0.000 |") && line("same").contains("| 2.0 ± 0.0 |"), "{text}");
    assert!(!line("known").contains("1.000"), "{text}");
    let written = |name: &str| std::fs::read_to_string(here("out").join(name)).unwrap();
    assert_eq!(written("leaderboard.md").trim_end(), text);
    assert_eq!(written("checked.csv").lines().count(), 3);
    assert!(written("leaderboard.csv").contains("perturbed,same,,1,iou,1.0000,1.0000,1.0000\n"));

    // With the rows of an exam in the same folder.
    std::fs::rename(here("out/checked.csv"), here("out/results.csv")).unwrap();
    std::fs::write(here("more.csv"), "goal,species,seed\nacer-1,palm,1\n").unwrap();
    let text = check_submissions(&options, &[here("more.csv")], Some(&here("out"))).unwrap();
    assert!(["| same |", "| known |", "| more |"].iter().all(|row| text.contains(row)), "{text}");
    assert_eq!(written("checked.csv").lines().count(), 2);
    let twice = check_submissions(&options, &[here("known.csv")], Some(&here("out"))).unwrap_err();
    assert!(twice.to_string().contains("a row is called `known` already, rename the file"), "{twice}");
}

#[test]
fn what_is_asked_for_is_written_and_read() {
    let folder = tempfile::tempdir().unwrap();
    let exam = folder.path().join("exam");
    let options = BenchOptions {
        rows: Some(vec!["ellipse".to_owned()]),
        trees: Some(vec![5]),
        seconds: Some(Vec::new()),
        ..asked(&["palm-1"])
    };
    options.write(&exam, false).unwrap();
    options.write(&exam, false).unwrap();
    let text = || std::fs::read_to_string(exam.join("experiment.toml")).unwrap();
    assert_eq!(
        text(),
        "kind = \"bench\"\nrows = [\"ellipse\"]\nonly = [\"palm-1\"]\ntrees = [5]\nseconds = []\n"
    );
    let other = BenchOptions { photographs: Some(PathBuf::from("nowhere")), ..options.clone() };
    assert!(format!("{:#}", other.write(&exam, true).unwrap_err()).contains("folder of photographs nowhere"));
    let other = BenchOptions { around: Some(1), ..options };
    assert!(other.write(&exam, false).unwrap_err().to_string().contains("an exam with other options"));
    other.write(&exam, true).unwrap();
    assert!(text().contains("around = 1"));

    let cases = [
        ("rows = [\"ellipses\"]", ":2:9: no row is called `ellipses`, did you mean `ellipse`?"),
        ("rows = [\"guess\", \"guess\"]", ":2:18: `guess` is there twice"),
        ("only = [\"palm-5\"]", ":2:8: no goal and no set of goals is called `palm-5`"),
        ("around = 5", ":2:10: "),
        ("trees = [0]", ":2:10: "),
        ("photographs = \"none\"", ":2:15: cannot read the folder of photographs"),
    ];
    for (line, message) in cases {
        std::fs::write(exam.join("experiment.toml"), format!("kind = \"bench\"\n{line}\n")).unwrap();
        let error = format!("{:#}", check(&exam, Slice::default()).unwrap_err());
        assert!(error.contains(message), "{line}\n{error}");
    }
    std::fs::write(exam.join("experiment.toml"), "kind = \"growth\"\n").unwrap();
    assert!(other.write(&exam, true).unwrap_err().to_string().contains("another kind of experiments"));
}
