//! `pleach silhouette`, as a user runs it.

use image::GenericImageView;
use pleach_tests::Dir;

fn png(dir: &Dir, args: &[&str]) -> image::DynamicImage {
    let out = dir.path("out.png");
    let args = [&["silhouette"], args, &["-o", out.to_str().unwrap()]].concat();
    let _ = dir.run(args).ok();
    image::open(out).unwrap()
}

#[test]
fn the_picture_is_black_on_white_with_the_tree_where_it_should_be() {
    let dir = Dir::new();
    let picture = png(&dir, &["quaking_aspen", "--seed", "1", "--size", "200"]);
    assert_eq!(picture.dimensions(), (200, 200));
    let gray = picture.to_luma8();
    assert!(gray.pixels().all(|p| p[0] == 0 || p[0] == 255));
    let ink: Vec<(u32, u32)> =
        gray.enumerate_pixels().filter(|(_, _, p)| p[0] == 0).map(|(x, y, _)| (x, y)).collect();
    let top = ink.iter().map(|p| p.1).min().unwrap();
    assert!((8..=11).contains(&top), "95 % of the height is filled, not from row {top}");
    let foot: Vec<u32> = ink.iter().filter(|p| p.1 == 199).map(|p| p.0).collect();
    let middle = f64::from(foot.iter().sum::<u32>()) / foot.len() as f64;
    assert!((middle - 99.5).abs() < 1.0, "the trunk's foot is in the middle, not at {middle}");
    // One bit per pixel: a 200 × 200 picture is at most 5,200 bytes before compression.
    assert!(std::fs::metadata(dir.path("out.png")).unwrap().len() < 5_200);
}

#[test]
fn views_and_leaves_make_a_difference() {
    let dir = Dir::new();
    let front = png(&dir, &["hill_cherry", "--size", "128"]);
    let side = png(&dir, &["hill_cherry", "--size", "128", "--view", "90"]);
    let above = png(&dir, &["hill_cherry", "--size", "128", "--view", "-30,60"]);
    let bare = png(&dir, &["hill_cherry", "--size", "128", "--no-leaves"]);
    let ink = |p: &image::DynamicImage| p.to_luma8().pixels().filter(|p| p[0] == 0).count();
    assert!(front != side && front != above);
    assert!(ink(&bare) * 3 < ink(&front) * 2);
}

#[test]
fn four_views_are_one_picture_of_every_family() {
    let dir = Dir::new();
    for species in ["small_pine", "abop_bush", "coffey_whorls"] {
        let sheet = png(&dir, &[species, "--size", "256", "--four-views"]).to_luma8();
        assert_eq!(sheet.dimensions(), (256, 256));
        for (x, y) in [(0, 0), (128, 0), (0, 128), (128, 128)] {
            let quarter = image::imageops::crop_imm(&sheet, x, y, 128, 128).to_image();
            let ink = quarter.pixels().filter(|p| p[0] == 0).count();
            assert!(ink > 100, "{species}: {ink} pixels in the quarter at {x}, {y}");
        }
    }
    // What lies in the plane from west to east is a line from the east, and from above.
    let sheet = png(&dir, &["coffey_umbrella", "--size", "256", "--four-views"]).to_luma8();
    let ink = |x: u32, y: u32, width: u32, height: u32| {
        image::imageops::crop_imm(&sheet, x, y, width, height)
            .to_image()
            .pixels()
            .filter(|p| p[0] == 0)
            .count()
    };
    let (beside, above) = (ink(0, 128, 128, 128), ink(128, 128, 128, 128));
    assert!(beside > 0 && beside == ink(59, 128, 10, 128), "from the east, around the middle column");
    assert!(above > 0 && above == ink(128, 187, 128, 10), "from above, around the middle row");
    assert!(ink(0, 0, 128, 128) > 2 * beside);
    dir.run(["silhouette", "palm", "--four-views", "--view", "90"]).fails(2, &["--four-views", "--view"]);
    let text = dir.run(["silhouette", "palm", "--four-views"]).ok();
    assert!(text.lines().count() > 30, "{text}");
}

#[test]
fn without_a_file_the_tree_is_drawn_in_the_terminal() {
    let text = Dir::new().run(["silhouette", "palm"]).ok();
    assert!(text.lines().count() > 30 && text.contains('⣿'), "{text}");
}

#[test]
fn another_tree_of_the_species_is_likelier_than_one_that_overlaps_more() {
    let dir = Dir::new();
    for (name, species, seed) in
        [("goal", "palm", "1"), ("same", "palm", "4"), ("other", "silver_birch", "2")]
    {
        let _ = dir
            .run(["silhouette", species, "--seed", seed, "--size", "128", "-o", &format!("{name}.png")])
            .ok();
    }
    let score = |name: &str| dir.run(["score", &format!("{name}.png"), "goal.png", "--json"]).json();
    let (same, other, itself) = (score("same"), score("other"), score("goal"));
    let number = |card: &serde_json::Value, key: &str| card[key].as_f64().unwrap();
    assert_eq!(number(&itself, "likeness"), 1.0);
    assert!(number(&same, "iou") < number(&other, "iou"), "{same} {other}");
    assert!(number(&same, "likeness") > number(&other, "likeness"), "{same} {other}");
    assert!(number(&same["likeness_parts"], "gaps") <= 1.0);
    let table = dir.run(["score", "same.png", "goal.png"]).ok();
    assert!(table.starts_with("likeness") && table.contains("strokes"), "{table}");
}

#[test]
fn wrong_arguments_are_told() {
    let dir = Dir::new();
    dir.run(["silhouette", "palm", "--view", "0,100"]).fails(2, &["-90 to 90"]);
    dir.run(["silhouette", "palm", "--size", "4"]).fails(2, &["8..=8192"]);
    dir.run(["silhouette", "palm", "-o", "palm.gif"]).fails(1, &["palm.gif", "PNG"]);
    dir.run(["silhouette", "plam"]).fails(1, &["`plam`", "did you mean `palm`?"]);
}
