//! What the default limits come to in memory and time.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::print_stdout, reason = "the table is what the test is run for")]
#![cfg(target_os = "linux")]

mod lists;

use pleach_tree::{Generator as _, Growth, Tree, Workspace};
use pleach_weber_penn::{WeberPenn, space};

/// The number after `key` in a file of `/proc`.
fn field(file: &str, key: &str) -> f64 {
    let text = std::fs::read_to_string(file).unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix(key)).unwrap();
    line.split_whitespace().next().unwrap().parse().unwrap()
}

/// Processor seconds of all threads so far.
fn cpu() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap().split_whitespace().collect();
    // Ticks of a hundredth of a second in user and system mode.
    (fields[11].parse::<f64>().unwrap() + fields[12].parse::<f64>().unwrap()) / 100.0
}

#[test]
#[ignore = "minutes: `cargo test -p pleach-weber-penn --test default_limits -- --ignored --nocapture`"]
fn any_list_takes_at_most_a_gigabyte_and_a_half_and_ten_seconds() {
    let (mut most_cpu, mut most_mb) = (0.0_f64, 0.0_f64);
    for case in 1000..1080 {
        let params = space().check(lists::values(case)).unwrap();
        // Resets the peak of what is resident.
        std::fs::write("/proc/self/clear_refs", "5").unwrap();
        let start = cpu();
        let growth = Growth { parallel: true, ..Growth::seed(case) };
        let mut tree = Tree::default();
        let grown = WeberPenn::default().grow(&params, &growth, &mut Workspace::default(), &mut tree);
        let (seconds, mb) = (cpu() - start, field("/proc/self/status", "VmHWM:") / 1024.0);
        let what = grown.map_or_else(|error| error.to_string(), |()| format!("{} stems", tree.stems.len()));
        println!("{case} {seconds:.2} s {mb:.0} MB {what}");
        (most_cpu, most_mb) = (most_cpu.max(seconds), most_mb.max(mb));
        assert!(seconds < 10.0 && mb < 1500.0, "case {case} took {seconds} s and {mb} MB");
    }
    println!("at most {most_cpu:.2} s and {most_mb:.0} MB");
}
