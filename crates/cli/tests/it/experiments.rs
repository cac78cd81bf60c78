//! A slice of every experiment against its committed results.

use pleach_tests::Dir;

fn check(name: &str, slice: &[&str]) {
    let folder = pleach_tests::root().join("experiments").join(name);
    let args = [&["experiment", "check", folder.to_str().unwrap()], slice].concat();
    let run = Dir::new().run(&args);
    let agreed: usize = run.ok().split(' ').next().unwrap().parse().unwrap();
    assert!(agreed > 0, "{run}");
}

#[test]
fn hewitt_ga() {
    check("hewitt-ga", &["--repetitions", "1", "--evaluations", "500"]);
}

#[test]
fn generation_time() {
    check("generation-time", &["--repetitions", "2"]);
}

#[test]
#[ignore = "nightly: half a minute"]
fn blend() {
    check("blend", &["--repetitions", "1"]);
}

#[test]
#[ignore = "nightly: half a minute"]
fn treefit() {
    check("treefit", &["--repetitions", "2", "--evaluations", "100"]);
}

#[test]
#[ignore = "nightly: ten seconds and more"]
fn needle() {
    check("needle", &["--repetitions", "2"]);
}

#[test]
#[ignore = "nightly: half a minute"]
fn yao() {
    check("yao", &["--repetitions", "1"]);
}

#[test]
fn stylised() {
    check("stylised", &["--repetitions", "2"]);
}

#[test]
#[ignore = "nightly: ten seconds and more"]
fn families() {
    check("families", &["--repetitions", "1"]);
}

#[test]
#[ignore = "nightly: ten seconds and more"]
fn bench() {
    check("bench", &["--repetitions", "2", "--evaluations", "100"]);
}

#[test]
fn lsystem_fit() {
    check("lsystem-fit", &["--repetitions", "1"]);
}

#[test]
fn complexity() {
    check("complexity", &["--repetitions", "3"]);
}

#[test]
fn lsystem_time() {
    check("lsystem-time", &["--repetitions", "2"]);
}

#[test]
#[ignore = "nightly: ten seconds and more"]
fn likeness() {
    check("likeness", &["--repetitions", "1"]);
}

/// The first block of each area: two thousand cases.
#[test]
fn robustness() {
    check("robustness", &["--repetitions", "1"]);
}

#[test]
fn changed_results_are_found() {
    let dir = Dir::new();
    let folder = pleach_tests::root().join("experiments/complexity");
    let spec = std::fs::read_to_string(folder.join("experiment.toml")).unwrap();
    let results = std::fs::read_to_string(folder.join("results.csv")).unwrap();
    let _ = dir.file("experiment.toml", spec);
    let line = results.lines().nth(1).unwrap();
    let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
    cells[3].push('1');
    let _ = dir.file("results.csv", results.replace(line, &cells.join(",")));
    dir.run(["experiment", "check", ".", "--repetitions", "1"]).fails(1, &["no row like"]);
}

/// One method of a benchmark is run again without the others, and a killed run goes on.
#[test]
fn a_benchmark_is_remade_in_parts() {
    let dir = Dir::new();
    let method = |name: &str, seed: &str| {
        format!(
            "[[methods]]\nname = \"{name}\"\noptimizer = \"{seed}\"\nfrom = \"random\"\nevaluations = 20\n"
        )
    };
    let goals = "[[goals]]\nspecies = \"palm\"\nseed = 3\nsecond_view = 90.0\nheld_out = 45.0\n\
                 [[goals]]\nspecies = \"palm\"\nseed = 3\ndegraded = \"cut-off\"\n";
    let spec = ["kind = \"treefit\"\n", &method("a", "hewitt"), &method("b", "random"), goals].concat();
    let _ = dir.file("experiment.toml", spec);
    let run = |more: &[&str]| dir.run([&["experiment", "run", "."], more].concat());
    assert!(run(&[]).ok().contains("two-views"));
    let table = || std::fs::read_to_string(dir.path("results.csv")).unwrap();
    let whole = table();
    let rows: Vec<&str> = whole.lines().collect();
    assert_eq!(rows.len(), 5, "{whole}");
    assert!(rows[1].starts_with("palm_two_views,two-views,a,1,20,"), "{whole}");
    assert!(dir.path("sheet.png").exists() && dir.path("fits/palm_cut_off.toml").exists());
    let timeless = |row: &str| row.rsplit_once(',').unwrap().0.to_owned();

    // Rows of the other method are not touched: a mark in one stays.
    let marked = whole.replace(rows[2], &format!("{}9", rows[2]));
    let _ = dir.file("results.csv", &marked);
    let _ = run(&["--method", "a"]).ok();
    let again = table();
    assert_eq!(again.lines().nth(2), marked.lines().nth(2));
    assert_eq!(again.lines().nth(1).map(timeless), Some(timeless(rows[1])));

    // What a killed run had finished is taken over, mark and all, and the rest is run.
    let partial: Vec<&str> = marked.lines().take(3).collect();
    let _ = dir.file("results.csv.partial", partial.join("\n") + "\n");
    let _ = run(&["--resume"]).ok();
    let resumed = table();
    assert_eq!(resumed.lines().take(3).collect::<Vec<_>>(), partial);
    assert_eq!(resumed.lines().map(timeless).nth(4), Some(timeless(rows[4])));
    assert!(!dir.path("results.csv.partial").exists());

    // A run that was killed twice has rows with others missing before them.
    let (first, last) = (format!("{}\n", rows[0]), format!("{}9\n", rows[4]));
    let _ = dir.file("results.csv.partial", first + &last);
    let _ = run(&["--resume"]).ok();
    assert_eq!(table().lines().nth(4), Some(last.trim_end()));

    run(&["--method", "c"]).fails(1, &["no method `c`", "a, b"]);
    let other = pleach_tests::root().join("experiments/complexity");
    dir.run(["experiment", "run", other.to_str().unwrap(), "--method", "a"]).fails(1, &["kind treefit"]);
}
