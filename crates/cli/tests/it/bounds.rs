//! Species files that are within every range and still monsters, under limits from outside: memory
//! by the address space, time by the processor's.

#![cfg(target_os = "linux")]

use pleach_tests::{Dir, program, root};
use std::process::{Command, Output};

/// Runs `pleach` with `args` under limits of 1.5 GB and 10 s of processor time.
///
/// Two threads, since each reserves address space beside what it uses.
fn bounded(dir: &Dir, args: &str) -> Output {
    let script = format!("ulimit -v 1500000 && ulimit -t 10 && exec {} {args}", program().display());
    Command::new("sh")
        .args(["-c", &script])
        .current_dir(dir.path("."))
        .env("RAYON_NUM_THREADS", "2")
        .output()
        .unwrap()
}

fn refused(output: &Output, args: &str, words: &[&str]) {
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{args} ended with {}: {told}", output.status);
    for word in words {
        assert!(told.contains(word), "{args}: no `{word}` in {told}");
    }
}

#[test]
fn monsters_end_within_memory_and_time() {
    let dir = Dir::new();
    let cases: [(&str, u64, &[&str]); 6] = [
        ("oom", 1_176_749_032_432_969, &["more than", "because of `"]),
        ("oom", 1, &["more than", "because of `"]),
        ("oom2", 4_351_812_265_460_215, &["more than", "because of `"]),
        ("slow", 7_237_708_135_465_580, &["because of `"]),
        ("slow", 1, &["because of `"]),
        ("slow2", 1, &["more than 500000 stems", "`branches[0]`"]),
    ];
    for (name, seed, words) in cases {
        let file = root().join(format!("tests/data/hostile/{name}.toml"));
        let args = format!("grow {} --stats-only --seed {seed}", file.display());
        refused(&bounded(&dir, &args), &args, words);
    }
    let file = root().join("tests/data/hostile/oom.toml");
    let args = format!("silhouette {} --seed 1176749032432969", file.display());
    refused(&bounded(&dir, &args), &args, &["more than"]);
}

/// What numbers alone say is not grown at all: a tenth of the time would not do.
#[test]
fn plain_monsters_are_refused_at_once() {
    let dir = Dir::new();
    let monster =
        dir.file("m.toml", "levels = 4\nbranches = [1, 1000, 1000, 1000]\nlength = [1, 0.3, 0.6, 0.5]");
    let script = format!(
        "ulimit -v 200000 && ulimit -t 1 && exec {} grow {} --stats-only",
        program().display(),
        monster.display()
    );
    let output = Command::new("sh").args(["-c", &script]).env("RAYON_NUM_THREADS", "1").output().unwrap();
    refused(&output, &script, &["more than 500000 stems", "`branches[3]`, `branches[2]` and `branches[1]`"]);
}

#[test]
fn a_device_is_read_to_the_limit_of_a_file() {
    let dir = Dir::new();
    refused(&bounded(&dir, "grow /dev/zero --stats-only"), "/dev/zero", &["/dev/zero", "4194304 bytes"]);
    refused(&bounded(&dir, "grow - --stats-only < /dev/zero"), "-", &["stdin", "4194304 bytes"]);
}

#[test]
fn a_species_comes_from_standard_input() {
    let dir = Dir::new();
    let _ = dir.file("two.toml", "levels = 2\nbranches = [1, 20, 0, 0]");
    let output = bounded(&dir, "grow - --stats-only --json < two.toml");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let told = String::from_utf8_lossy(&output.stdout).replace(' ', "");
    assert!(told.contains("\"species\":\"stdin\""), "{told}");
    let _ = dir.file("wrong.toml", "\nbrances = [1, 20, 0, 0]");
    let told = bounded(&dir, "grow - --stats-only < wrong.toml");
    refused(&told, "-", &["stdin:2:1: `brances` is not a known name, did you mean `branches`?"]);
}
