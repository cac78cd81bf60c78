//! What the default limits come to in memory and time, family by family.

#![allow(clippy::print_stdout, reason = "the table is what the test is run for")]
#![cfg(target_os = "linux")]

use pleach_tree::conformance::list_within;
use pleach_tree::{Family, Growth, Tree, Workspace};

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

/// Grows eighty random lists of a family's species.
///
/// One family for each test: a test resets the peak of the process's memory and reads its time, so that
/// they run one after the other (`--test-threads 1`).
fn any_list_takes_at_most_a_gigabyte_and_a_half_and_ten_seconds(family: &str) {
    let family: &dyn Family = pleach_generators::family(family).unwrap();
    let species = pleach_generators::presets(family);
    let (mut most_cpu, mut most_mb) = (0.0_f64, 0.0_f64);
    for case in 1000..1080 {
        // Five kinds of lists for each species, one after the other.
        let species = &species[(case / 5) as usize % species.len()];
        let params = species.generator.space().check(list_within(species.generator.space(), case)).unwrap();
        // Resets the peak of what is resident.
        std::fs::write("/proc/self/clear_refs", "5").unwrap();
        let start = cpu();
        let growth = Growth { parallel: true, ..Growth::seed(case) };
        let mut tree = Tree::default();
        let grown = species.generator.grow(&params, &growth, &mut Workspace::default(), &mut tree);
        let (seconds, mb) = (cpu() - start, field("/proc/self/status", "VmHWM:") / 1024.0);
        let what = grown.map_or_else(|error| error.to_string(), |()| format!("{} stems", tree.stems.len()));
        println!("{} {case} {seconds:.2} s {mb:.0} MB {what}", species.name);
        (most_cpu, most_mb) = (most_cpu.max(seconds), most_mb.max(mb));
        assert!(seconds < 10.0 && mb < 1500.0, "{}, case {case} took {seconds} s and {mb} MB", species.name);
    }
    println!("{}: at most {most_cpu:.2} s and {most_mb:.0} MB", family.name());
}

/// One test for each family.
macro_rules! families {
    ($($test:ident: $family:literal,)*) => {
        $(
            #[test]
            #[ignore = "nightly: minutes, `cargo test -p pleach-generators --test it default_limits -- --ignored --nocapture --test-threads 1`"]
            fn $test() {
                any_list_takes_at_most_a_gigabyte_and_a_half_and_ten_seconds($family);
            }
        )*

        #[test]
        fn every_family_is_tried() {
            assert_eq!(pleach_generators::family_names(), [$($family),*]);
        }
    };
}

families! {
    weber_penn: "weber-penn",
    lsystem: "lsystem",
    fractal: "fractal",
    least_cost_path: "least-cost-path",
    stylised: "stylised",
    space_colonization: "space-colonization",
}
