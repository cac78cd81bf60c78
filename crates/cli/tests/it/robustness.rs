//! The program under limits of the system: 1.5 GB of addresses and ten seconds of processor time.
//! What is wrong is refused with a message and an exit code, whatever it is.
//!
//! `experiments/robustness` asks the same of many more cases, within one process.

#![cfg(unix)]

use pleach_tests::{Dir, program};
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Output};

/// Runs the program under the limits.
fn limited(dir: &Dir, args: &[&str]) -> Output {
    let mut command = Command::new("sh");
    command.current_dir(dir.path("."));
    command.args(["-c", "ulimit -v 1500000; ulimit -t 10; exec \"$0\" \"$@\""]).arg(program());
    command.args(args).output().unwrap()
}

/// Runs it and checks how it ends: a result, or a refusal that a person can read.
#[track_caller]
fn ends_well(dir: &Dir, what: &str, args: &[&str]) -> bool {
    let Output { status, stderr, .. } = limited(dir, args);
    let message = String::from_utf8_lossy(&stderr);
    let shown: String = message.chars().take(2000).collect();
    assert_eq!(status.signal(), None, "{what}: {args:?} {shown}");
    assert!(!message.contains("panicked"), "{what}: {shown}");
    if !status.success() {
        assert!(matches!(status.code(), Some(1 | 2)), "{what}: {status}, {shown}");
        assert!(message.contains("error"), "{what}: {shown}");
    }
    status.success()
}

const NUMBERS: [&str; 6] = ["nan", "inf", "1e308", "-1", "1e5", "9223372036854775807"];

#[test]
fn numbers_of_a_species_file_are_replaced_one_by_one() {
    let dir = Dir::new();
    let text = dir.run(["species", "acer", "--toml"]);
    let text = if text.code() == 0 {
        text.stdout()
    } else {
        std::fs::read_to_string(pleach_tests::root().join("species/weber-penn/acer.toml")).unwrap()
    };
    let digits = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let starts: Vec<usize> = text
        .char_indices()
        .filter(|&(at, c)| {
            c.is_ascii_digit()
                && !text[..at].ends_with(|c: char| digits(c) || c.is_alphanumeric() || c == '_')
        })
        .map(|(at, _)| at)
        .collect();
    assert!(starts.len() > 60, "{}", starts.len());
    let mut refused = 0;
    for (case, &at) in starts.iter().enumerate().step_by(3) {
        let number = NUMBERS[case / 3 % NUMBERS.len()];
        let rest = text[at..].trim_start_matches(digits);
        let _ = dir.file("spoilt.toml", format!("{}{number}{rest}", &text[..at]));
        let what = format!("{number} at byte {at}");
        let grow = [
            "grow",
            "spoilt.toml",
            "--seed",
            "1",
            "--stats-only",
            "--max-stems",
            "20000",
            "--max-leaves",
            "50000",
        ];
        refused += usize::from(!ends_well(&dir, &what, &grow));
    }
    assert!(refused > 5, "{refused}");
}

#[test]
fn files_that_are_none() {
    let dir = Dir::new();
    let deep = "[".repeat(200_000);
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("empty", Vec::new()),
        ("nul", vec![0; 100_000]),
        ("not text", (0..=255).cycle().take(5000).collect()),
        ("deep", format!("a = {deep}").into_bytes()),
        ("deep tables", "[a.".repeat(50_000).into_bytes()),
        ("inline tables", format!("a = {}", "{a=".repeat(50_000)).into_bytes()),
        ("long key", format!("{} = 1", "k".repeat(1 << 20)).into_bytes()),
        ("long line", format!("name = \"{}\"", "x".repeat(1 << 20)).into_bytes()),
        ("many keys", (0..50_000).map(|i| format!("k{i} = {i}\n")).collect::<String>().into_bytes()),
        ("png head", b"\x89PNG\r\n\x1a\n".repeat(1000)),
        ("jpeg head", b"\xff\xd8\xff\xe0".repeat(1000)),
        ("webp head", b"RIFF\xff\xff\xff\x7fWEBPVP8L".repeat(100)),
        ("tiff head", b"II*\0\x08\0\0\0\xff\xff".repeat(100)),
        ("checkpoint", b"pleach-checkpoint 2 99999999999999999999 0\n{}".to_vec()),
    ];
    for (what, bytes) in files {
        let _ = dir.file("input", &bytes);
        let _ = dir.file("experiment.toml", &bytes);
        let commands: [&[&str]; 6] = [
            &["grow", "./input", "--seed", "1", "--stats-only", "--json"],
            &["score", "input", "input"],
            &["mask", "input"],
            &["fit", "input", "--evaluations", "3", "--out", "run"],
            &["map", "--species", "palm,acer,./input"],
            &["experiment", "run", "."],
        ];
        for args in commands {
            let well = ends_well(&dir, what, args);
            // A name, or nothing at all, is a whole species file.
            let is_species = ["empty", "long line"].contains(&what) && args[0] == "grow";
            assert!(!well || is_species, "{what}: {args:?} is taken");
        }
    }
    assert!(!dir.path("results.csv").exists());
}

#[test]
fn words_of_the_command_line() {
    let dir = Dir::new();
    let commands: [&[&str]; 14] = [
        &["silhouette", "palm", "--size", "99999999", "-o", "a.png"],
        &["silhouette", "palm", "--size", "-1", "-o", "a.png"],
        &["render", "palm", "--size", "4000000000", "-o", "a.png"],
        &["silhouette", "palm", "--view", "1e308,1e308", "-o", "a.png"],
        &["grow", "palm", "--seed", "18446744073709551616"],
        &["grow", "palm", "--seeds", "9..1"],
        &["blend", "palm", "acer", "--at", "nan"],
        &["blend", "palm", "acer", "--at", "1e308"],
        &["map", "--point=nan,nan"],
        &["fit", "nothing.png", "--evaluations", "18446744073709551615"],
        &["fit", "nothing.png", "--timeout", "1e308s"],
        &["grow", "/dev/null/palm.toml"],
        &["grow", "palm", "--threads", "100000"],
        &["experiment", "run", "/dev/null"],
    ];
    for args in commands {
        assert!(!ends_well(&dir, "words", args), "{args:?} is taken");
    }
}
