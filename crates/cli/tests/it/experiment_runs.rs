//! Experiments from outside: what they write over, what they refuse, how they end and go on.

use pleach_tests::{Dir, read, root};
use std::time::{Duration, Instant};

/// Fits of three random lists each.
fn fits(goals: &[&str]) -> String {
    let goal = |text: &&str| format!("[[goals]]\n{text}\nheight = 10\n");
    let goals: String = goals.iter().map(goal).collect();
    "kind = \"fits\"\noptimizers = [\"random\"]\nrepetitions = 1\nevaluations = 3\ntree_seed = 1\n".to_owned()
        + &goals
}

#[test]
fn a_goal_in_the_folder_is_not_written_over() {
    let dir = Dir::new();
    let goal = read(&root().join("targets/palm.png"));
    let file = dir.file("palm.png", &goal);
    let _ = dir.file("experiment.toml", fits(&["file = \"palm.png\""]));
    let _ = dir.run(["experiment", "run", "."]).ok();
    assert_eq!(read(&file), goal);
    for name in ["fits/palm.png", "fits/palm-iou.svg", "fits/palm-accuracy.svg", "results.csv"] {
        assert!(dir.path(name).exists(), "{name}");
    }
    // The pictures are outputs of an earlier run: they are made again.
    let _ = dir.run(["experiment", "run", "."]).ok();
}

#[test]
fn a_goal_where_the_pictures_go_is_not_written_over() {
    let goal = read(&root().join("targets/palm.png"));
    let refused = |dir: &Dir| dir.run(["experiment", "run", "."]).fails(1, &["would be written over"]);

    let dir = Dir::new();
    std::fs::create_dir(dir.path("fits")).unwrap();
    let file = dir.file("fits/palm.png", &goal);
    let _ = dir.file("experiment.toml", fits(&["file = \"fits/palm.png\""]));
    refused(&dir);
    assert_eq!(read(&file), goal);
    assert!(!dir.path("results.csv").exists());

    #[cfg(unix)]
    {
        // The folder of pictures is another name of the goal's.
        let dir = Dir::new();
        std::os::unix::fs::symlink(".", dir.path("fits")).unwrap();
        let file = dir.file("palm.png", &goal);
        let _ = dir.file("experiment.toml", fits(&["file = \"palm.png\""]));
        refused(&dir);
        assert_eq!(read(&file), goal);

        // The picture's place is a link to the goal, of either sort.
        for hard in [false, true] {
            let dir = Dir::new();
            std::fs::create_dir(dir.path("fits")).unwrap();
            let file = dir.file("goal.png", &goal);
            if hard {
                std::fs::hard_link(&file, dir.path("fits/palm.png")).unwrap();
            } else {
                std::os::unix::fs::symlink("../goal.png", dir.path("fits/palm.png")).unwrap();
            }
            let _ = dir.file("experiment.toml", fits(&["file = \"goal.png\"\nname = \"palm\""]));
            refused(&dir);
            assert_eq!(read(&file), goal);
        }
    }
}

#[test]
fn two_goals_of_one_name_are_refused_or_told_apart() {
    let dir = Dir::new();
    let goal = read(&root().join("targets/palm.png"));
    std::fs::create_dir(dir.path("b")).unwrap();
    let _ = dir.file("palm.png", &goal);
    let _ = dir.file("b/Palm.png", &goal);
    let _ = dir.file("experiment.toml", fits(&["file = \"palm.png\"", "file = \"b/Palm.png\""]));
    // The second goal begins at line 9.
    dir.run(["experiment", "run", "."]).fails(1, &["experiment.toml:9:1: `Palm` is there twice", "`name`"]);
    let _ = dir
        .file("experiment.toml", fits(&["file = \"palm.png\"", "file = \"b/Palm.png\"\nname = \"other\""]));
    let _ = dir.run(["experiment", "run", "."]).ok();
    assert!(dir.path("fits/palm.png").exists() && dir.path("fits/other.png").exists());
    let _ = dir.file("experiment.toml", fits(&["file = \"palm.png\"\nname = \"../palm\""]));
    dir.run(["experiment", "run", "."]).fails(1, &["experiment.toml:8:8: ", "cannot name files"]);
}

#[test]
fn options_are_checked_before_anything_runs() {
    let growth = "kind = \"growth\"\ntimed = true\nspecies = [\"palm\"]\nseeds = 9\n";
    let needle = "kind = \"needle\"\nspecies = [\"palm\"]\ndistances = [0.1]\ndraws = 5\n";
    let blend = "kind = \"blend\"\nspecies = [\"palm\", \"quaking_aspen\", \"silver_birch\", \"acer\"]\nsteps = 2\npoints = 5\n";
    let fits = fits(&["file = \"goal.png\""]);
    let treefit = "kind = \"treefit\"\n[[methods]]\nname = \"a\"\noptimizer = \"de\"\nfrom = \"auto\"\nevaluations = 5\n\
                   [[goals]]\nspecies = \"palm\"\nseed = 3\n";
    let rules =
        "kind = \"rules\"\nseconds = 5\nrepetitions = 1\n[[goals]]\nfile = \"goal.png\"\nheight = 10\n";
    let individual =
        "kind = \"individual\"\nseconds = 5\n[[goals]]\nspecies = \"palm\"\nseed = 3\ngroup = \"own\"\n";
    let cases: &[(&str, &str, &str, &[&str])] = &[
        (individual, "seconds = 5", "seconds = 0", &[":2:11: ", "from 0.1 to 86400"]),
        (individual, "\"palm\"", "\"plam\"", &["did you mean `palm`"]),
        (individual, "seed = 3\n", "", &[":3:1: ", "a `species` with a `seed`"]),
        (individual, "seed = 3", "seed = 3\nfile = \"goal.png\"", &[":3:1: ", "a `file` with its `height`"]),
        (rules, "seconds = 5", "seconds = 0", &[":2:11: ", "from 0.1 to 86400"]),
        (rules, "repetitions = 1", "repetitions = 0", &[":3:15: ", "from 1 to 10000"]),
        (rules, "height = 10", "height = 0", &[":6:10: ", "a height in metres from 0.001 to 1000"]),
        (growth, "seeds = 9", "seeds = 0", &[":4:9: ", "integer `0`", "a whole number from 1 to 100000"]),
        (growth, "seeds = 9", "seeds = 1", &[":4:9: ", "at least 2 where trees are timed"]),
        (growth, "seeds = 9", "seeds = 9007199254740992", &[":4:9: ", "from 1 to 100000"]),
        (growth, "seeds = 9", "seeds = 1.5", &[":4:9: ", "a whole number from 1 to 100000"]),
        (growth, "seeds = 9", "seeds = 9\nseed = 1", &[":5:1: ", "unknown field `seed`"]),
        (growth, "[\"palm\"]", "[\"palm\", \"plam\"]", &[":3:20: ", "did you mean `palm`"]),
        (growth, "[\"palm\"]", "[\"palm\", \"palm\"]", &[":3:20: ", "`palm` is there twice"]),
        (growth, "[\"palm\"]", "[]", &[":3:", "0 entries, expected from 1 to 1000"]),
        (growth, "growth", "groth", &[":1:8: ", "unknown variant `groth`", "`growth`"]),
        (needle, "[0.1]", "[0.1, nan]", &[":3:19: ", "from 0 to 1"]),
        (needle, "[0.1]", "[inf]", &[":3:14: ", "a part of the search range from 0 to 1"]),
        (needle, "draws = 5", "draws = 0", &[":4:9: ", "from 1 to 100000"]),
        (blend, "steps = 2", "steps = 0", &[":3:9: ", "from 1 to 1000"]),
        (blend, "\"palm\"", "\"apple\"", &[":2:11: ", "`palm` is missing"]),
        (&fits, "repetitions = 1", "repetitions = 0", &[":3:15: ", "from 1 to 10000"]),
        (&fits, "repetitions = 1", "repetitions = 9007199254740992", &[":3:15: ", "from 1 to 10000"]),
        (&fits, "evaluations = 3", "evaluations = 0", &[":4:15: ", "from 1 to 100000000"]),
        (&fits, "[\"random\"]", "[]", &[":2:", "0 entries"]),
        (&fits, "[\"random\"]", "[\"rondom\"]", &[":2:15: ", "unknown optimizer `rondom`", "evolution"]),
        (&fits, "height = 10", "height = 1e308", &[":8:10: ", "a height in metres from 0.001 to 1000"]),
        (&fits, "tree_seed = 1", "tree_seed = -1", &[":5:13: ", "from 0 to 9007199254740992"]),
        (treefit, "evaluations = 5\n", "", &[":2:1: ", "without `evaluations` or `seconds`"]),
        (treefit, "evaluations = 5", "seconds = 0", &[":6:11: ", "from 0.1 to 86400"]),
        (treefit, "from = \"auto\"", "from = \"aut\"", &[":5:8: ", "`auto`, `random`, `outline`"]),
        (treefit, "seed = 3", "height = 3", &[":7:1: ", "`height` is not for goals that are grown"]),
        (treefit, "seed = 3", "", &[":7:1: ", "missing field `seed`"]),
    ];
    let dir = Dir::new();
    for (text, from, to, words) in cases {
        let spoilt = text.replacen(from, to, 1);
        assert_ne!(spoilt, **text, "{from}");
        let _ = dir.file("experiment.toml", &spoilt);
        for action in ["run", "check"] {
            let run = dir.run(["experiment", action, "."]);
            run.fails(1, &[&["experiment.toml"], *words].concat());
        }
    }
    assert_eq!(std::fs::read_dir(dir.path(".")).unwrap().count(), 1, "nothing is written");
    let none = fits.split("[[goals]]").next().unwrap();
    let _ = dir.file("experiment.toml", none);
    dir.run(["experiment", "run", "."]).fails(1, &["experiment.toml:1:1: ", "missing field `goals`"]);
    let _ = dir.file("experiment.toml", b"kind = \"fits\"\nx = \"\xff\"\n");
    dir.run(["experiment", "run", "."]).fails(1, &["experiment.toml:2:6: ", "expected UTF-8"]);
    dir.run(["experiment", "check", ".", "--repetitions", "0"]).fails(2, &["--repetitions"]);
}

/// Trees that take some seconds in all, and some milliseconds each.
const MANY: &str = "kind = \"growth\"\ntimed = false\nspecies = [\"silver_birch\", \"palm\"]\nseeds = 80\n";

/// Starts a run and ends it with `signal` once it has written down some rows.
fn ended_by(dir: &Dir, signal: &str) -> std::process::Output {
    let mut command = dir.command(["experiment", "run", "."]);
    let piped = std::process::Stdio::piped;
    let child = command.stdout(piped()).stderr(piped()).spawn().unwrap();
    let partial = dir.path("results.csv.partial");
    let begun = Instant::now();
    while std::fs::metadata(&partial).map_or(0, |meta| meta.len()) < 1000 {
        assert!(begun.elapsed() < Duration::from_secs(60), "no rows came");
        std::thread::sleep(Duration::from_millis(2));
    }
    let kill = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(kill.unwrap().success(), "the run was over too soon");
    child.wait_with_output().unwrap()
}

#[test]
#[cfg(unix)]
fn an_experiment_that_is_ended_goes_on_to_the_same_results() {
    let whole = Dir::new();
    let _ = whole.file("experiment.toml", MANY);
    let _ = whole.run(["experiment", "run", "."]).ok();
    let results = |dir: &Dir| String::from_utf8(read(&dir.path("results.csv"))).unwrap();

    for signal in ["-INT", "-TERM", "-KILL"] {
        let dir = Dir::new();
        let _ = dir.file("experiment.toml", MANY);
        let output = ended_by(&dir, signal);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        if signal != "-KILL" {
            assert_eq!(output.status.code(), Some(130), "{message}");
            assert!(message.contains("experiment run . --resume"), "{message}");
        }
        assert!(!dir.path("results.csv").exists());
        let kept = String::from_utf8(read(&dir.path("results.csv.partial"))).unwrap();
        assert!(kept.lines().count() > 10 && kept.ends_with('\n'), "{kept}");

        // A new run does not throw the rows away unasked, and another experiment does not take them.
        dir.run(["experiment", "run", "."]).fails(1, &["--resume", "--overwrite"]);
        let _ = dir.file("experiment.toml", MANY.replace("80", "81"));
        dir.run(["experiment", "run", ".", "--resume"]).fails(1, &["another experiment.toml"]);
        let _ = dir.file("experiment.toml", MANY);
        assert_eq!(String::from_utf8(read(&dir.path("results.csv.partial"))).unwrap(), kept);

        // A row that a kill has cut short is made again; a mark shows that the others are not.
        let marked = kept.replacen("silver_birch,2,", "silver_birch,2,7", 1);
        let cut = &marked[..marked.len() - 3];
        let _ = dir.file("results.csv.partial", cut);
        let _ = dir.run(["experiment", "run", ".", "--resume"]).ok();
        assert_eq!(results(&dir), results(&whole).replacen("silver_birch,2,", "silver_birch,2,7", 1));
        assert!(!dir.path("results.csv.partial").exists());

        let _ = dir.file("results.csv.partial", cut);
        let _ = dir.run(["experiment", "run", ".", "--overwrite"]).ok();
        assert_eq!(results(&dir), results(&whole));
    }
}

#[test]
fn experiments_are_listed_with_their_questions() {
    let dir = Dir::new();
    let experiments = root().join("experiments");
    let experiments = experiments.to_str().unwrap();
    let list = dir.run(["experiment", "list", experiments]).ok();
    for name in ["treefit", "robustness", "hewitt-ga"] {
        let line =
            list.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{name}\n{list}"));
        assert!(line.ends_with('?'), "{line}");
    }
    // Without a word, those of `experiments`.
    let mut here = dir.command(["experiment"]);
    let output = here.current_dir(root()).output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap().lines().next(), list.lines().next());
    dir.run(["experiment"]).fails(1, &["cannot read the folder experiments"]);
    dir.run(["experiment", "list", "."]).fails(1, &["holds no experiment"]);
}

#[test]
fn grammars_that_evolve_leave_a_row_a_species_and_a_sheet() {
    let dir = Dir::new();
    let _ = dir.file("goal.png", read(&root().join("targets/palm.png")));
    let rules =
        "kind = \"rules\"\nseconds = 1\nrepetitions = 2\n[[goals]]\nfile = \"goal.png\"\nheight = 10\n";
    let _ = dir.file("experiment.toml", rules);
    let run = dir.run(["experiment", "run", "."]);
    assert!(run.ok().contains("of 2 searches"), "{run}");
    let rows = String::from_utf8(read(&dir.path("results.csv"))).unwrap();
    let lines: Vec<&str> = rows.lines().collect();
    assert!(lines[0].starts_with("goal,repetition,evaluations,iou,best_ellipse_iou,likeness,"), "{rows}");
    assert!(lines[1].starts_with("goal,1,") && lines[2].starts_with("goal,2,"), "{rows}");
    assert!(dir.path("sheet.png").exists());
    let _ = dir.run(["grow", "fits/goal.toml", "--seed", "9", "-o", "tree.glb"]).ok();
    dir.run(["experiment", "check", "."]).fails(1, &["nothing to check"]);
}

#[test]
#[ignore = "nightly: ten seconds and more"]
fn goals_own_trees_are_searched_and_shown() {
    let dir = Dir::new();
    let goals = "kind = \"individual\"\nseconds = 2\n[[goals]]\nspecies = \"acer\"\nseed = 3\nleaves = false\n\
                 group = \"bare\"\n[[goals]]\nspecies = \"palm\"\nseed = 3\ntwo_views = true\ngroup = \"two-views\"\n";
    let _ = dir.file("experiment.toml", goals);
    let run = dir.run(["experiment", "run", "."]);
    assert!(run.ok().contains("medians of each group"), "{run}");
    let rows = String::from_utf8(read(&dir.path("results.csv"))).unwrap();
    let lines: Vec<&str> = rows.lines().collect();
    assert!(lines[0].starts_with("goal,group,best_ellipse_iou,kind_iou,"), "{rows}");
    assert!(
        lines[1].starts_with("acer_bare,bare,") && lines[2].starts_with("palm_two_views,two-views,"),
        "{rows}"
    );
    assert!(dir.path("sheet.png").exists());
    let _ = dir.run(["grow", "fits/acer_bare.toml", "-o", "tree.glb"]).ok();
    dir.run(["experiment", "check", "."]).fails(1, &["nothing to check"]);
}
