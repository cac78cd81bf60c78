//! Colours and layers of rendered trees against what they were rendered with, and sheets of real pictures.
//!
//! ```sh
//! cargo run --release -p pleach-reading --example judge_colors -- judge SEEDS odd|even|all [CSV [FOLDER]]
//! cargo run --release -p pleach-reading --example judge_colors -- sheet FOLDER PICTURE…
//! ```
//!
//! `judge` grows trees of several families, gives each one of the four seasons and colours of leaves, bark and
//! blossoms by its seed, and draws it over transparency and over a sky. Which pixels are wood is known from a second
//! rendering, with red bark and green leaves. Constants are tuned on even seeds; odd seeds judge. Pictures of which
//! something is wrong go to the folder.
//!
//! `sheet` draws for each cut-out picture, side by side: the picture, its wood, its foliage, and bars of the colours
//! of leaves, sunlit and shaded leaves, bark and blossoms.
#![allow(clippy::print_stdout, reason = "it is a program")]
#![allow(clippy::unwrap_used, reason = "a program for engineers")]

#[path = "judge_colors/cases.rs"]
mod cases;
#[path = "judge_colors/ciede2000.rs"]
mod ciede2000;

use cases::{Case, Drawn, cases};
use ciede2000::difference;
use pleach_plant::Color;
use pleach_reading::Colors;
use pleach_silhouette::Bitmap;
use pleach_silhouette::mask::Photo;
use std::fmt::Write as _;
use std::time::Instant;

/// A layer is judged where this part of the tree's pixels is in it.
const MIN_SHARE: f64 = 0.03;

/// The photograph, its layers and bars of its colours side by side.
fn board(photo: &Photo, tree: &Bitmap, colors: &Colors) -> image::RgbImage {
    let (width, height) = (photo.width(), photo.height());
    image::RgbImage::from_fn(3 * width + 60, height, |x, y| {
        if x >= 3 * width {
            let bars = [colors.leaf, colors.leaf_sunlit, colors.leaf_shaded, colors.bark, colors.blossom];
            return image::Rgb(bars[(y * 5 / height) as usize].map_or([255; 3], |Color(rgb)| rgb));
        }
        let u = x % width;
        let [r, g, b, _] = photo.pixels()[(y * width + u) as usize];
        let layer = [tree, &colors.wood, &colors.foliage][(x / width) as usize];
        image::Rgb(match (layer.get(u, y), tree.get(u, y)) {
            (true, _) => [r, g, b],
            (false, true) => [225, 205, 235],
            (false, false) => [200, 200, 255],
        })
    })
}

fn opaque(photo: &Photo) -> Bitmap {
    let at = |x: u32, y: u32| photo.pixels()[(y * photo.width() + x) as usize];
    Bitmap::from_fn(photo.width(), photo.height(), |x, y| at(x, y)[3] >= 128)
}

fn sheet(paths: &[String], folder: &str) {
    for path in paths {
        let photo = Photo::load(path).unwrap();
        let tree = opaque(&photo);
        let start = Instant::now();
        let colors = Colors::read(&photo, &tree).unwrap();
        let name = std::path::Path::new(path).file_stem().unwrap().to_string_lossy().into_owned();
        println!("{name} {:?} {}", start.elapsed(), serde_json::to_string(&colors).unwrap());
        board(&photo, &tree, &colors).save(format!("{folder}/{name}.png")).unwrap();
    }
}

/// Numbers of right ones and of all, per measure.
#[derive(Default)]
struct Table(Vec<(String, usize, usize, f64)>);

impl Table {
    fn add(&mut self, name: &str, is_right: bool, value: f64) {
        let row = match self.0.iter().position(|row| row.0 == name) {
            Some(row) => row,
            None => {
                self.0.push((name.to_owned(), 0, 0, 0.0));
                self.0.len() - 1
            }
        };
        let row = &mut self.0[row];
        row.1 += usize::from(is_right);
        row.2 += 1;
        row.3 += value;
    }
}

fn iou(a: &Bitmap, b: &Bitmap) -> f64 {
    let both = a.intersection(b) as f64;
    both / (a.ink() as f64 + b.ink() as f64 - both).max(1.0)
}

/// What is left of a layer without all that is thinner than three pixels.
fn opened(layer: &Bitmap) -> Bitmap {
    let (width, height) = (layer.width(), layer.height());
    let around = |x: u32, y: u32| {
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        rows.flat_map(move |v| (x.saturating_sub(1)..(x + 2).min(width)).map(move |u| (u, v)))
    };
    let eroded = Bitmap::from_fn(width, height, |x, y| around(x, y).all(|(u, v)| layer.get(u, v)));
    Bitmap::from_fn(width, height, |x, y| around(x, y).any(|(u, v)| eroded.get(u, v)))
}

fn judge(arguments: &[String]) {
    let number = |i: usize| arguments.get(i).map(String::as_str);
    let seeds: u64 = number(0).map_or(4, |n| n.parse().unwrap());
    let which = number(1).unwrap_or("odd");
    let (mut table, mut csv) = (
        Table::default(),
        String::from("name,seed,season,sky,true,read,dE,bark_dE,wood,thick,leaf_conf,wrong\n"),
    );
    for case in cases(seeds) {
        if which != "all" && (case.seed % 2 == 1) != (which == "odd") {
            continue;
        }
        for drawn in case.draw() {
            one(&case, &drawn, &mut table, &mut csv, number(3));
        }
    }
    println!("{:32} {:>6} {:>6} {:>6} {:>8}", "measure", "right", "of", "%", "mean");
    for (name, right, all, sum) in &table.0 {
        let of = (*all).max(1) as f64;
        println!("{name:32} {right:6} {all:6} {:6.1} {:8.3}", 100.0 * *right as f64 / of, sum / of);
    }
    if let Some(path) = number(2) {
        std::fs::write(path, csv).unwrap();
    }
}

fn one(case: &Case, drawn: &Drawn, table: &mut Table, csv: &mut String, folder: Option<&str>) {
    let colors = Colors::read(&drawn.photo, &drawn.tree).unwrap();
    let all = drawn.tree.ink() as f64;
    let mut wrong = String::new();
    let mut add = |name: &str, is_right: bool, value: f64| {
        table.add(name, is_right, value);
        if !is_right {
            let _ = write!(wrong, "{name} ");
        }
    };
    let leafy_right = colors.leaves == Some(drawn.has_leaves);
    add("leafy or bare", leafy_right, colors.leaves_confidence);
    if colors.leaves_confidence >= 0.7 {
        add("leafy or bare, confidence >= 0.7", leafy_right, colors.leaves_confidence);
    }
    add("season", colors.season == Some(drawn.season), colors.season_confidence);
    add(
        &format!("season {}", drawn.season.name()),
        colors.season == Some(drawn.season),
        colors.season_confidence,
    );
    let (mut wood_iou, mut thick_iou, mut leaf_distance, mut signed) =
        (f64::NAN, f64::NAN, f64::NAN, String::new());
    if drawn.has_leaves {
        if drawn.wood.ink() as f64 >= MIN_SHARE * all {
            wood_iou = iou(&colors.wood, &drawn.wood);
            add("wood IoU >= 0.6, of leafy", wood_iou >= 0.6, wood_iou);
        }
        let thick = opened(&drawn.wood);
        if thick.ink() as f64 >= MIN_SHARE * all {
            // Twigs of one or two pixels count neither way.
            let missed = (thick.ink() - thick.intersection(&colors.wood)) as f64;
            let (found, wrong) =
                (thick.intersection(&colors.wood) as f64, colors.wood.intersection(&drawn.foliage) as f64);
            thick_iou = found / (found + missed + wrong).max(1.0);
            add("the same of limbs of 3 pixels", thick_iou >= 0.6, thick_iou);
        }
        let foliage = iou(&colors.foliage, &drawn.foliage);
        add("foliage IoU >= 0.6", foliage >= 0.6, foliage);
        if drawn.foliage.ink() as f64 >= MIN_SHARE * all {
            leaf_distance = colors.leaf.map_or(100.0, |leaf| difference(leaf, drawn.leaf));
            add("leaf within 8", leaf_distance <= 8.0, leaf_distance);
        }
        if colors.leaf_confidence >= 0.7 {
            add("leaf within 8, confidence >= 0.7", leaf_distance <= 8.0, leaf_distance);
        }
        let _ = write!(signed, "{} {}", drawn.leaf, colors.leaf.map_or(String::new(), |c| c.to_string()));
        let blossom = colors.blossom.is_some() == drawn.blossom.is_some();
        add("blossom or none", blossom, colors.blossom_confidence);
        if let (Some(read), Some(given)) = (colors.blossom, drawn.blossom) {
            let distance = difference(read, given);
            add("blossom within 12", distance <= 12.0, distance);
        }
    } else {
        let part = colors.wood.ink() as f64 / all;
        add("wood IoU >= 0.6, of bare", part >= 0.6, part);
    }
    let bark_distance = colors.bark.map_or(100.0, |bark| difference(bark, drawn.bark));
    if drawn.wood.ink() as f64 >= MIN_SHARE * all {
        add("bark within 12", bark_distance <= 12.0, bark_distance);
        if colors.bark_confidence >= 0.7 {
            add("bark within 12, confidence >= 0.7", bark_distance <= 12.0, bark_distance);
        }
    }
    let read = format!("{:?} {:?}", colors.season, colors.leaves).replace("Some", "");
    let (name, seed, season, sky) = (&case.name, case.seed, drawn.season.name(), drawn.over_sky);
    let _ = writeln!(
        csv,
        "{name},{seed},{season},{sky},{} {signed} {} {} bark {} {},{read},{leaf_distance:.1},{bark_distance:.1},{wood_iou:.2},{thick_iou:.2},{:.2},{wrong}",
        drawn.has_leaves,
        colors.leaf_sunlit.map_or(String::new(), |c| c.to_string()),
        colors.leaf_shaded.map_or(String::new(), |c| c.to_string()),
        drawn.bark,
        colors.bark.map_or(String::new(), |c| c.to_string()),
        colors.leaf_confidence
    );
    if let Some(folder) = folder.filter(|_| !wrong.is_empty()) {
        board(&drawn.photo, &drawn.tree, &colors)
            .save(format!("{folder}/{name}_{seed}_{season}_{sky}.png"))
            .unwrap();
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.first().map(String::as_str) {
        Some("sheet") if arguments.len() > 2 => sheet(&arguments[2..], &arguments[1]),
        Some("judge") => judge(&arguments[1..]),
        _ => println!("judge SEEDS odd|even|all [CSV [FOLDER]], or sheet FOLDER PICTURE…"),
    }
}
