//! A goal that pleach has drawn scores 1 at its own numbers, whatever the margins of its picture are.

use pleach_silhouette::Bitmap;
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_tests::Dir;
use serde_json::Value;
use std::path::Path;

/// Draws a tree of a species and returns its height in metres.
fn draw(dir: &Dir, species: &str, seed: u64, size: u32, to: &str) -> f64 {
    let (seed, size) = (seed.to_string(), size.to_string());
    let _ = dir.run(["silhouette", species, "--seed", &seed, "--size", &size, "-o", to]).ok();
    let stats = dir.run(["grow", species, "--seed", &seed, "--stats-only", "--json"]).json();
    number(&stats, "height_m")
}

/// The summary of a fit of the kind alone.
fn fit(dir: &Dir, goal: &str, out: &str, options: &[&str]) -> Value {
    dir.run([&["fit", goal, "--out", out, "--individual", "off", "--json"], options].concat()).json()
}

fn number(summary: &Value, key: &str) -> f64 {
    summary[key].as_f64().unwrap_or_else(|| panic!("`{key}` is a number"))
}

fn ink(path: &Path) -> Bitmap {
    Goal::load(path, &GoalOptions::default()).unwrap().bitmap
}

/// `tree` without its margins in a picture of `size`, with `left` and `above` of paper before it.
fn placed(tree: &Bitmap, size: (u32, u32), left: u32, above: u32) -> Bitmap {
    let (x0, y0, x1, y1) = tree.ink_box().unwrap();
    Bitmap::from_fn(size.0, size.1, |x, y| {
        let (x, y) = (x.wrapping_sub(left), y.wrapping_sub(above));
        x <= x1 - x0 && y <= y1 - y0 && tree.get(x0 + x, y0 + y)
    })
}

#[test]
fn a_goal_of_ours_scores_one_at_its_own_numbers() {
    let dir = Dir::new();
    for (species, seed, size) in [
        ("palm", 7, 256),
        ("palm", 1, 128),
        ("acer", 7, 256),
        ("acer", 7, 1024),
        ("quaking_aspen", 7, 256),
        ("bamboo", 1, 256),
        ("lombardy_poplar", 1, 256),
    ] {
        let height = draw(&dir, species, seed, size, "goal.png").to_string();
        let (number_of_seed, out) = (seed.to_string(), format!("{species}_{size}"));
        let options =
            ["--from", species, "--tree-seed", &number_of_seed, "--height", &height, "--evaluations", "1"];
        let summary = fit(&dir, "goal.png", &out, &options);
        let (iou, likeness) = (number(&summary, "iou"), number(&summary, "likeness"));
        assert!(iou >= 0.97 && likeness >= 0.98, "{species} {seed} at {size}: {iou}, likeness {likeness}");
        // The scores are those of the file that is written.
        let written = [number(&summary, "goal_width"), number(&summary, "goal_height")];
        assert_eq!(written, [f64::from(size); 2]);
        let (best, goal) = (ink(&dir.path(&out).join("best.png")), ink(&dir.path("goal.png")));
        let both = goal.intersection(&best) as f64;
        let written = both / (goal.ink() as f64 + best.ink() as f64 - both);
        assert!((written - iou).abs() < 0.01, "{species}: best.png has {written}, the summary {iou}");
    }
}

#[test]
fn margins_change_nothing() {
    let dir = Dir::new();
    draw(&dir, "acer", 3, 256, "acer.png");
    let tree = ink(&dir.path("acer.png"));
    let (x0, y0, x1, y1) = tree.ink_box().unwrap();
    let (width, height) = (x1 - x0 + 1, y1 - y0 + 1);
    let margin = 6 * width.max(height) / 10;
    let pictures = [
        ("tight", placed(&tree, (width, height), 0, 0)),
        ("padded", placed(&tree, (width + 2 * margin, height + 2 * margin), margin, margin)),
        ("aside", placed(&tree, (width + margin, height + 3), margin, 3)),
        ("small", placed(&tree, (3000, 2000), 900, 700)),
    ];
    let mut summaries = Vec::new();
    for (name, picture) in pictures {
        let goal = format!("{name}.png");
        picture.write_png(&mut std::fs::File::create(dir.path(&goal)).unwrap()).unwrap();
        let summary = fit(&dir, &goal, name, &["--from", "acer", "--evaluations", "12", "--tree-seed", "2"]);
        let best = ink(&dir.path(name).join("best.png"));
        assert_eq!((best.width(), best.height()), (picture.width(), picture.height()), "{name}");
        let keys = ["iou", "likeness", "boundary_f", "pixel_accuracy", "compared_width", "cost"];
        summaries.push((name, keys.map(|key| number(&summary, key))));
    }
    for (name, summary) in &summaries {
        assert_eq!(*summary, summaries[0].1, "{name} and {}", summaries[0].0);
    }
}

#[test]
fn a_known_frame_is_taken_as_it_is() {
    let dir = Dir::new();
    draw(&dir, "palm", 7, 128, "palm.png");
    let options = ["--from", "palm", "--tree-seed", "7", "--evaluations", "1", "--frame", "0.05,64,128"];
    let summary = fit(&dir, "palm.png", "run", &options);
    let found = ["metres_per_pixel", "axis_column", "ground_row"].map(|key| number(&summary, key));
    assert!((found[0] - 0.05).abs() < 1e-12, "{found:?}");
    assert_eq!(found[1..], [64.0, 128.0]);

    let refused = |frame: &str| dir.run(["fit", "palm.png", "--out", "no", "--frame", frame]);
    refused("0.05,64").fails(2, &["metres per pixel"]);
    refused("0,64,128").fails(2, &["metres per pixel"]);
    refused("0.05,64,900").fails(1, &["ground row", "900"]);
}
