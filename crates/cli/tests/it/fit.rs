//! `pleach fit`, as a user runs it: results and determinism.

use pleach_tests::{Dir, read, results, small, target};
use std::collections::HashMap;
use std::path::Path;

#[test]
fn the_run_folder_holds_what_it_should() {
    let dir = Dir::new();
    // Another tree than the search begins with: that one could not be better.
    let _ = dir.run(["silhouette", "acer", "--seed", "3", "--size", "256", "-o", "goal.png"]).ok();
    let goal = "goal.png".to_owned();
    let run = dir.run(small(&goal, "run", &["--size", "64", "--evaluations", "300", "--json"]));
    let printed = run.json();
    let folder = dir.path("run");
    let summary: serde_json::Value = serde_json::from_slice(&read(&folder.join("summary.json"))).unwrap();
    assert_eq!(summary, printed);
    let keys = [
        "pixel_accuracy",
        "empty_accuracy",
        "iou",
        "best_ellipse_iou",
        "dice",
        "boundary_f",
        "chamfer",
        "blurred_iou",
        "likeness",
        "likeness_parts",
        "species",
        "generator",
        "tree_seed",
        "evaluations",
        "seconds",
        "evaluations_per_second",
        "optimizer",
    ];
    for key in keys {
        assert!(summary.get(key).is_some(), "`{key}` is missing in {summary}");
    }
    assert_eq!(summary["evaluations"], 300);
    for key in ["16", "32", "64"] {
        assert!(summary["blurred_iou"][key].is_number());
    }
    let names = |folder: &Path| {
        let mut names: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    };
    let expected = [
        "best.png",
        "best.toml",
        "history.csv",
        "overlay.png",
        "parameters.csv",
        "reading.json",
        "reading.png",
        "render.png",
        "search-state",
        "summary.json",
    ];
    assert_eq!(names(&folder), expected);

    // The card is of the goal's own size; what the search saw of a tree of 64 pixels stands beside it. The crown
    // reaches nearly to the edges of its picture, so that margins come on top.
    let search = &summary["search"];
    let pixels = |value: &serde_json::Value| value.as_u64().unwrap();
    assert_eq!((pixels(&summary["goal_width"]), pixels(&summary["goal_height"])), (256, 256));
    assert!((64..=64 * 3 / 2).contains(&pixels(&search["goal_width"])), "{search}");
    assert!(pixels(&search["goal_height"]) <= 64 && pixels(&summary["compared_width"]) > 256, "{summary}");
    let history = String::from_utf8(read(&folder.join("history.csv"))).unwrap();
    let last: f64 = history.lines().last().unwrap().split(',').nth(4).unwrap().parse().unwrap();
    // Numbers that went back to the start may have cost a little, and the last generation is cut off.
    assert!((search["iou"].as_f64().unwrap() - last).abs() < 0.05, "{search} {last}");
    assert_ne!(search["iou"], summary["iou"]);

    // How it does with other seeds, and what of it the goal determines.
    assert_eq!(summary["fresh_seeds"]["count"], 16);
    assert!(summary["fresh_seeds"]["iou"]["sd"].as_f64().unwrap() > 0.0);
    let parameters = String::from_utf8(read(&folder.join("parameters.csv"))).unwrap();
    let count = |word: &str| parameters.lines().filter(|line| line.split(',').nth(2) == Some(word)).count();
    assert_eq!(summary["determined"]["determined"], count("determined"));
    assert_eq!(summary["determined"]["not_seen"], count("not-seen"));
    assert!(count("determined") > 0 && count("not-seen") > 0, "{parameters}");
    // What is built in knows acers: the numbers that vary around one have intervals, narrower where they are seen.
    assert_eq!(
        (&summary["intervals"]["species"], &summary["intervals"]["is_familiar"]),
        (&serde_json::json!("acer"), &serde_json::json!(true))
    );
    let mut table = csv::Reader::from_reader(parameters.as_bytes());
    let rows: Vec<HashMap<String, String>> = table.deserialize().map(Result::unwrap).collect();
    let known: Vec<&HashMap<String, String>> = rows.iter().filter(|row| !row["shrunk"].is_empty()).collect();
    assert!(known.len() > 30, "{parameters}");
    for row in known {
        let number = |column: &str| row[column].parse::<f64>().unwrap();
        let [low, median, high] = ["low", "median", "high"].map(number);
        assert!(low <= median && median <= high && number("low_before") <= number("high_before"), "{row:?}");
        let word = match number("shrunk") {
            0.5.. => "determined",
            0.2.. => "loosely",
            _ => "not-seen",
        };
        assert_eq!(row["seen"], word, "{row:?}");
    }
    // A variation of size is not seen in one tree, so other seeds keep the size of the goal.
    let best = String::from_utf8(read(&folder.join("best.toml"))).unwrap();
    assert!(best.contains("0 are g_scale_v, length_v[0]") && best.contains("\ng_scale_v = 0\n"), "{best}");

    // The picture has the goal's size, the card is that of `score` with what lies beyond the picture's edges, and the
    // species grows the picture.
    let best = folder.join("best.png");
    assert_eq!(image::open(&best).unwrap().to_luma8().dimensions(), (256, 256));
    let card = dir.run(["score", best.to_str().unwrap(), &goal, "--json"]).json();
    let (inside, all) = (card["iou"].as_f64().unwrap(), summary["iou"].as_f64().unwrap());
    assert!(
        all <= inside + 1e-9 && inside - all < 0.02,
        "{inside} in the picture, {all} with what is beyond it"
    );
    let grown = dir.run(["grow", "run/best.toml", "--stats-only", "--json"]).json();
    assert_eq!(grown["seed"], summary["tree_seed"]);
    assert_eq!(names(&dir.path("")), ["goal.png", "run"], "nothing is written beside the run folder");
}

#[test]
#[ignore = "nightly: ten whole fits; the library compares them too"]
fn every_optimizer_is_the_same_on_any_number_of_threads() {
    let dir = Dir::new();
    let goal = target("acer.png");
    for optimizer in pleach_fit::Optimizer::NAMES {
        let run = |threads: &str| {
            let out = format!("{optimizer}-{threads}");
            let more =
                ["--evaluations", "120", "--optimizer", optimizer, "--threads", threads, "--seed", "5"];
            let _ = dir.run(small(&goal, &out, &more)).ok();
            results(&dir.path(&out))
        };
        let one = run("1");
        assert!(one == run("8"), "{optimizer}");
    }
}

/// By default a fit starts from what the goal looks like, and says so.
#[test]
fn the_first_guess_names_the_species_and_starts_the_fit() {
    let dir = Dir::new();
    // A tree of a seed that the fit does not use.
    let _ = dir.run(["silhouette", "palm", "--seed", "21", "--size", "128", "-o", "palm.png"]).ok();
    let args = ["fit", "palm.png", "--size", "140", "--evaluations", "60", "--individual", "off", "--json"];
    let run = |more: &[&str]| dir.run([&args[..], more].concat());
    let auto = run(&["--out", "auto"]);
    assert!(auto.stderr().contains("looks like palm"), "{}", auto.stderr());
    let auto = auto.json();
    assert_eq!((&auto["from"], &auto["looks_like"][0]["species"]), (&"auto".into(), &"palm".into()));
    let random = run(&["--out", "random", "--from", "random"]).json();
    assert_eq!(random["looks_like"].as_array().unwrap().len(), 0);
    let iou = |summary: &serde_json::Value| summary["iou"].as_f64().unwrap();
    assert!(iou(&auto) > iou(&random), "{} {}", iou(&auto), iou(&random));
    // The guess is part of the promise of equal bits.
    let again = run(&["--out", "again", "--threads", "3"]);
    let _ = again.json();
    assert!(results(&dir.path("auto")) == results(&dir.path("again")));
    run(&["--out", "x", "--from", "small_pin"]).fails(1, &["small_pin", "did you mean `small_pine`?"]);
}

/// Asked for all generators, a fit says which family it has chosen, and how the others did.
#[test]
fn the_family_is_chosen() {
    let dir = Dir::new();
    let args = ["silhouette", "coffey_pine", "--seed", "21", "--size", "96", "-o", "pine.png"];
    let _ = dir.run(args).ok();
    let args = ["fit", "pine.png", "--size", "64", "--evaluations", "20", "--out", "run", "--json"];
    let run = dir.run([&args[..], &["--generator", "auto"]].concat());
    assert!(run.stderr().contains("family fractal: "), "{}", run.stderr());
    let summary = run.json();
    assert_eq!(summary["generator"], "fractal");
    let families = summary["families"].as_array().unwrap();
    assert!(families.len() >= 3 && families[0]["family"] == "fractal", "{families:?}");
    assert!(families.iter().all(|one| one["reached"].as_f64() <= one["guessed"].as_f64()), "{families:?}");
}

#[test]
fn a_volume_is_taken_from_the_goal_or_another_picture() {
    let dir = Dir::new();
    for (species, view, file) in [
        ("black_oak", "0", "goal.png"),
        ("black_oak", "90", "side.png"),
        ("lombardy_poplar", "0", "other.png"),
    ] {
        let _ = dir.run(["silhouette", species, "--size", "96", "--view", view, "-o", file]).ok();
    }
    let fit = |out: &str, more: &[&str]| {
        // The tree that a search would begin with.
        let args = ["fit", "goal.png", "--size", "64", "--evaluations", "1", "--out", out, "--json"];
        dir.run([&args[..], more].concat())
    };
    let width = |summary: &serde_json::Value| {
        summary["crown"]["width"].as_f64().unwrap() / summary["goal_crown"]["width"].as_f64().unwrap()
    };
    let own = fit("goal", &["--volume-from", "goal"]).json();
    assert_eq!(own["generator"], "least-cost-path");
    assert!((0.7..1.2).contains(&width(&own)), "{own}");
    // Of two views the hull; a poplar is narrow.
    let _ = fit("hull", &["--volume-from", "goal", "--view", "90=side.png"]).json();
    let foreign = fit("other", &["--volume-from", "other.png"]).json();
    assert!(width(&foreign) < 0.5, "{foreign}");
    assert!(results(&dir.path("goal")) != results(&dir.path("hull")));
    let _ = fit("again", &["--volume-from", "goal", "--threads", "1"]).json();
    assert!(results(&dir.path("goal")) == results(&dir.path("again")));
    fit("x", &["--volume-from", "goal", "--generator", "fractal"])
        .fails(1, &["--volume-from", "least-cost-path"]);
    fit("x", &["--volume-from", "nowhere.png"]).fails(1, &["nowhere.png"]);
    assert!(!dir.path("x").exists());
}

#[test]
fn another_seed_is_another_search() {
    let dir = Dir::new();
    let goal = target("acer.png");
    let _ = dir.run(small(&goal, "a", &["--evaluations", "200", "--seed", "1"])).ok();
    let _ = dir.run(small(&goal, "b", &["--evaluations", "200", "--seed", "2"])).ok();
    assert!(results(&dir.path("a")) != results(&dir.path("b")));
}

/// Judged by three trees, the mean is what the summary says it is.
#[test]
fn a_robust_fit_says_so() {
    let dir = Dir::new();
    let goal = target("acer.png");
    let robust = dir.run(small(&goal, "run", &["--evaluations", "40", "--robust", "3", "--json"])).json();
    assert_eq!(robust["robust"], 3);
    let single = dir.run(small(&goal, "one", &["--evaluations", "40", "--json"])).json();
    assert_ne!(robust["cost"], single["cost"]);
    dir.run(small(&goal, "x", &["--robust", "0"])).fails(2, &["from 1 to 64"]);
    dir.run(small(&goal, "x", &["--robust", "65"])).fails(2, &["from 1 to 64"]);
}

/// Two pictures of one tree are fitted, a third one is only scored.
#[test]
fn several_views_are_fitted_and_others_held_out() {
    let dir = Dir::new();
    for (view, file) in [("0", "front.png"), ("90", "side.png"), ("45", "corner.png")] {
        let args = ["silhouette", "hill_cherry", "--seed", "4", "--size", "96", "--view", view, "-o", file];
        let _ = dir.run(args).ok();
    }
    let args = ["fit", "front.png", "--from", "hill_cherry", "--size", "64", "--individual", "off"];
    let run = |more: &[&str]| dir.run([&args[..], &["--evaluations", "60", "--json"], more].concat());
    let both = run(&["--out", "both", "--view", "90=side.png", "--holdout-view", "45=corner.png"]).json();
    assert_eq!((&both["views"][0]["file"], &both["views"][0]["azimuth"]), (&"side.png".into(), &90.0.into()));
    assert_eq!(both["holdout_views"][0]["file"], "corner.png");
    assert_eq!(both["options"]["views"], serde_json::json!(["90=side.png"]));
    assert!(both["holdout_views"][0]["iou"].as_f64().unwrap() > 0.0);
    let front = run(&["--out", "front"]).json();
    assert!(front["views"].as_array().unwrap().is_empty());
    assert_ne!(front["cost"], both["cost"], "the second picture counts");
    // The direction of the goal itself is a view without a file.
    let turned = run(&["--out", "turned", "--view", "180"]).json();
    assert_ne!(front["cost"], turned["cost"]);

    run(&["--view", "90", "--view", "45"]).fails(1, &["one direction", "--view AZ=FILE"]);
    run(&["--view", "90=none.png"]).fails(1, &["none.png"]);
    run(&["--holdout-view", "90=none.png"]).fails(1, &["none.png"]);
    run(&["--holdout-view", "90"]).fails(2, &["90=side.png"]);
    run(&["--view", "up=side.png"]).fails(2, &["azimuth"]);
    run(&["side.png", "--view", "90=side.png"]).fails(1, &["2 goals"]);
}

/// From where a further picture was taken, and in which frame, is found by the way.
#[test]
fn views_from_somewhere_are_found() {
    let dir = Dir::new();
    for (view, file) in [("0", "front.png"), ("75", "other.png")] {
        let args = ["silhouette", "acer", "--seed", "1", "--size", "96", "--view", view, "-o", file];
        let _ = dir.run(args).ok();
    }
    let args = ["fit", "front.png", "--from", "acer", "--individual", "off", "--seed", "2", "--json"];
    let run = |more: &[&str]| dir.run([&args[..], more].concat());
    let fit = |out: &str, view: &str, threads: &str, evaluations: &str, more: &[&str]| {
        let args = ["--out", out, "--view", view, "--threads", threads, "--evaluations", evaluations];
        run(&[&args[..], more].concat())
    };
    let found = fit("auto", "auto=other.png", "1", "300", &["--height", "6"]).json();
    let view = &found["views"][0];
    assert!((0.0..=360.0).contains(&view["azimuth"].as_f64().unwrap()), "{view}");
    // Its frame was read off the picture: registered by a few pixels, and not searched.
    assert!((view["scale"].as_f64().unwrap() - 1.0).abs() <= 0.05, "{view}");
    assert!(view["offset"].as_array().unwrap().iter().all(|part| part.as_f64().unwrap().abs() <= 0.06));
    let again = fit("again", "auto=other.png", "3", "300", &["--height", "6"]).json();
    assert_eq!(again["views"], found["views"]);
    assert!(results(&dir.path("auto")) == results(&dir.path("again")));

    let about = fit("about", "~60=other.png", "2", "300", &["--free-frame"]).json();
    let view = &about["views"][0];
    assert!((45.0..=75.0).contains(&view["azimuth"].as_f64().unwrap()), "{view}");
    assert!((0.8..=1.2).contains(&view["scale"].as_f64().unwrap()), "{view}");
    assert!(view["offset"].as_array().unwrap().iter().all(|part| part.as_f64().unwrap().abs() <= 0.1));
    let best = String::from_utf8(read(&dir.path("about/best.toml"))).unwrap();
    assert!(!best.contains("azimuth"), "no parameter of the tree: {best}");
    // Without `--json` the azimuth is said, and what is known is not.
    let told = ["fit", "front.png", "--from", "acer", "--evaluations", "50", "--view", "auto=other.png"];
    let told = dir.run([&told[..], &["--size", "96", "--individual", "off", "--out", "told"]].concat()).ok();
    let line = told.lines().find(|line| line.starts_with("view other.png")).unwrap();
    assert!(line.contains(", from ") && line.ends_with('°'), "{line}");

    run(&["--view", "auto"]).fails(2, &["auto=side.png"]);
    run(&["--view", "~40"]).fails(2, &["auto=side.png"]);
    run(&["--view", "~up=other.png"]).fails(2, &["azimuth"]);
    run(&["--view", "auto="]).fails(2, &["a picture"]);
    run(&["--view", "auto=none.png"]).fails(1, &["none.png"]);
    run(&["--holdout-view", "auto=other.png"]).fails(2, &["90=side.png"]);
    run(&["--free-frame"]).fails(1, &["--view auto=FILE"]);
}

#[test]
fn fixed_parameters_keep_their_values() {
    let dir = Dir::new();
    // Not a goal that the start has drawn: at its own numbers nothing is better.
    let goal = target("hill_cherry.png");
    let _ = dir
        .run(small(
            &goal,
            "run",
            &["--evaluations", "200", "--free", "crown", "--free", "length[1]", "--fix", "levels"],
        ))
        .ok();
    let fitted = dir.run(["species", "run/best.toml", "--json"]).json();
    let start = dir.run(["species", "acer", "--json"]).json();
    let (fitted, start) = (&fitted["parameters"], &start["parameters"]);
    let mut changed: Vec<&str> = Vec::new();
    for (name, value) in fitted.as_object().unwrap() {
        if *value != start[name] {
            changed.push(name);
        }
    }
    assert!(!changed.is_empty());
    for name in changed {
        assert!(["shape", "g_scale", "g_scale_v", "length"].contains(&name), "`{name}` was not free");
    }
    assert_eq!(fitted["length"][0], start["length"][0]);
    dir.run(small(&goal, "x", &["--free", "crwn"])).fails(1, &["crwn", "did you mean `crown`?"]);
}

#[test]
fn a_time_budget_ends_a_fit_and_a_target_ends_it_sooner() {
    let dir = Dir::new();
    let goal = target("acer.png");
    let timed = dir.run(small(&goal, "timed", &["--timeout", "1s", "--json"])).json();
    assert_eq!(timed["stopped_by"], "timeout");
    // The first guess takes longer than this, and what it found is tried.
    let short = ["fit", &goal, "--out", "short", "--size", "140", "--timeout", "1ms", "--json"];
    let short = dir.run(short).json();
    assert_eq!(short["stopped_by"], "timeout");
    assert!(short["evaluations"].as_u64().unwrap() > 0);
    let reached =
        dir.run(small(&goal, "target", &["--target-iou", "0.05", "--evaluations", "5000", "--json"])).json();
    assert_eq!(reached["stopped_by"], "target-iou");
    assert!(reached["evaluations"].as_u64().unwrap() < 5000);
}

#[test]
fn optimizers_and_their_settings_are_told() {
    let dir = Dir::new();
    let goal = target("acer.png");
    let settings = dir.run(["fit", &goal, "--optimizer", "hewitt", "--set", "help"]).ok();
    assert!(settings.contains("population=") && settings.contains("flip_chance="), "{settings}");
    for (name, setting) in [("cma", "near_step=0.03"), ("de", "archive=1")] {
        let settings = dir.run(["fit", &goal, "--optimizer", name, "--set", "help"]).ok();
        assert!(settings.contains("population=") && settings.contains(setting), "{settings}");
    }
    dir.run(small(&goal, "x", &["--optimizer", "newton"]))
        .fails(1, &["newton", "hewitt", "evolution", "cma", "de"]);
    dir.run(small(&goal, "x", &["--optimizer", "hewitt", "--set", "pop=3"]))
        .fails(1, &["`pop`", "population"]);
    dir.run(small(&goal, "x", &["--objective", "beauty"])).fails(2, &["beauty", "iou"]);
}
