//! Readings of grown trees against their skeletons, and the models of confidence that follow from them.
//!
//! ```text
//! cargo run --release -p pleach-experiments --example calibrate_reading -- [SEEDS [MODELS [CSV [FOLDER]]]]
//! ```
//!
//! Grows species of all five families, leafy and bare, upright, leaned by up to 20°, and as clumps of two to four,
//! draws them at 256 pixels (some at 600), and reads the pictures. Constants are tuned on even seeds; odd seeds judge.
//! The table says which part of the readings is right, and for each class of confidence how many of its readings
//! are; the same for ragged masks of the same trees, as they are cut out of photographs. No photograph takes part. To
//! MODELS goes `crates/reading/src/confidence/models.rs`, fitted to the even seeds. The CSV has a row per picture with
//! what confidences are made from. Pictures with a wrong measure go to the folder, with the reading on the left and the
//! truth on the right.
#![allow(clippy::print_stdout, reason = "it is a program")]
#![allow(clippy::unwrap_used, reason = "a program for engineers")]

mod calibrate;
mod ragged;
#[path = "../../src/reading/trees.rs"]
mod trees;

use calibrate::{Model, Sample};
use pleach_reading::{Reader, Reading, annotate};
use pleach_silhouette::picture::sheet_of_pictures;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use ragged::{Dice, ragged};
use std::fmt::Write as _;
use trees::{Case, draw};

/// Ragged masks of every tree, of one of these sizes each.
const RAGGED: usize = 3;
const RAGGED_SIZES: [u32; 4] = [128, 256, 256, 600];

/// What came of it: for each measure whether it is right (`None`: cannot be judged) and the confidence.
struct Outcome {
    case: Case,
    results: Vec<(&'static str, Option<bool>, f64)>,
    details: String,
    values: Vec<(&'static str, f64)>,
    /// 0 for the picture as drawn, then the number of the ragged mask.
    mask: usize,
    texture: Vec<f64>,
    stem: Vec<f64>,
}

/// Judges the picture of a case and its ragged masks.
fn judge_all(case: &Case, reader: &mut Reader, folder: Option<&str>) -> Option<Vec<Outcome>> {
    let tree = case.grow()?;
    let view = View::FRONT;
    let mut picture = Bitmap::default();
    let mut outcomes = Vec::new();
    let name = case.name.bytes().fold(11, |key: u64, byte| key.wrapping_mul(31) + u64::from(byte));
    for mask in 0..=RAGGED {
        let kind = (case.lean + 20.0) as u64 + 41 * case.stems as u64 + 1000 * mask as u64;
        let mut dice = Dice::new(name.wrapping_add(case.seed * 10_007 + kind));
        let sizes = RAGGED_SIZES;
        let size = if mask == 0 { case.size } else { sizes[dice.between(0.0, sizes.len() as f64) as usize] };
        let frame = Frame::automatic(&tree, &view, case.parts, size, size);
        let truth = Reading::from_skeleton(&tree, &view, &frame, case.parts);
        Rasterizer::new().draw(&tree, &view, &frame, case.parts, &mut picture);
        let mut cut = 0.0;
        if mask > 0 {
            let Some((worn, part)) = ragged(&picture, &mut dice) else { continue };
            (picture, cut) = (worn, part);
        }
        let case = Case { size, ..case.clone() };
        outcomes.extend(judge(case, mask, cut, truth, &picture, reader, folder.filter(|_| mask == 0)));
    }
    Some(outcomes)
}

fn judge(
    case: Case,
    mask: usize,
    cut: f64,
    truth: Reading,
    picture: &Bitmap,
    reader: &mut Reader,
    folder: Option<&str>,
) -> Option<Outcome> {
    let mut reading = Reading::default();
    reader.read(picture, &mut reading);
    let first = truth.feet.first()?;
    let is_one = truth.feet.len() == reading.feet.len();
    let widest = |r: &Reading| r.feet.iter().map(|foot| foot.width).fold(0.0, f64::max);
    // Of a trunk of four pixels, half a pixel is more than 12 %.
    let width = (widest(&reading) / widest(&truth) - 1.0).abs();
    let pixels = (widest(&reading) - widest(&truth)).abs() * reader.evidence().values()[13].1;
    let lean = reading.lean_deg.zip(truth.lean_deg).map(|(a, b)| a - b);
    let bare = reading.bare_height.zip(truth.bare_height).map(|(a, b)| a - b);
    let sees_fork = truth.first_fork_confidence > 0.5;
    let fork = match (reading.first_fork, truth.first_fork) {
        (Some(a), Some(b)) => Some((a - b).abs() <= 0.08),
        (None, None) => Some(true),
        // A fork that foliage hides need not be found.
        (None, Some(_)) => sees_fork.then_some(false),
        (Some(_), None) => Some(false),
    };
    let visible = (truth.first_fork.is_some() && sees_fork).then_some(fork).flatten();
    let has_width = first.width > 0.0;
    let mut results = vec![
        ("feet", Some(is_one), reading.feet_confidence),
        ("feet_seen", (truth.feet_confidence > 0.5).then_some(is_one), reading.feet_confidence),
        ("width", (is_one && has_width).then_some(width <= 0.15), reading.width_confidence),
        (
            "width_px",
            (is_one && has_width).then_some(width <= 0.15 || pixels <= 0.5),
            reading.width_confidence,
        ),
        // A person can tell the lean of a trunk that is seen over a tenth of the height.
        (
            "lean_seen",
            lean.filter(|_| is_one && truth.bare_height >= Some(0.1)).map(|l| l.abs() <= 3.0),
            reading.lean_deg_confidence,
        ),
        ("lean", lean.filter(|_| is_one).map(|l| l.abs() <= 3.0), reading.lean_deg_confidence),
        ("bare", bare.filter(|_| is_one).map(|b| b.abs() <= 0.05), reading.bare_height_confidence),
        ("fork", fork.filter(|_| is_one), reading.first_fork_confidence),
        ("seen", visible.filter(|_| is_one), reading.first_fork_confidence),
        (
            "leaves",
            (truth.leaves_confidence > 0.5).then_some(reading.leaves == truth.leaves),
            reading.leaves_confidence,
        ),
    ];
    if cut > 0.0 {
        // Without its foot the tree has another height; whether it has leaves remains.
        results.iter_mut().filter(|result| result.0 != "leaves").for_each(|result| result.1 = None);
    }
    let mut details = String::new();
    let _ = write!(
        details,
        "feet {}/{} width {:.3}/{:.3} lean {:.1}/{:.1} bare {:.2}/{:.2} fork {:?}/{:?} ({}) leaves {}",
        reading.feet.len(),
        truth.feet.len(),
        widest(&reading),
        widest(&truth),
        reading.lean_deg.unwrap_or(f64::NAN),
        truth.lean_deg.unwrap_or(f64::NAN),
        reading.bare_height.unwrap_or(f64::NAN),
        truth.bare_height.unwrap_or(f64::NAN),
        reading.first_fork.map(|f| (100.0 * f).round() / 100.0),
        truth.first_fork.map(|f| (100.0 * f).round() / 100.0),
        truth.first_fork_confidence,
        truth.leaves,
    );
    let mut values = reader.evidence().values();
    values.push(("true_leaves", f64::from(u8::from(truth.leaves))));
    if let Some(folder) = folder.filter(|_| results.iter().any(|result| result.1 == Some(false))) {
        let shown = Reading { crown: reading.crown.clone(), ..truth };
        let wrong: Vec<&str> = results.iter().filter(|r| r.1 == Some(false)).map(|r| r.0).collect();
        let sheet = sheet_of_pictures(
            &[(&wrong.join(" "), annotate(picture, &reading)), ("truth", annotate(picture, &shown))],
            2,
        );
        let path = format!("{folder}/{}_{}_{:.0}_{}.png", case.name, case.seed, case.lean, case.stems);
        sheet.write_png(&mut std::fs::File::create(path).unwrap()).unwrap();
    }
    let (texture, stem) = (reader.evidence().texture().to_vec(), reader.evidence().stem().to_vec());
    Some(Outcome { case, results, details, values, mask, texture, stem })
}

fn cases(seeds: u64) -> Vec<Case> {
    let mut cases = Vec::new();
    for name in trees::names() {
        for seed in 0..seeds {
            let key = seed + name.bytes().fold(7, |key: u64, byte| key.wrapping_mul(31) + u64::from(byte));
            let size = if draw(key, 1) < 0.2 { 600 } else { 256 };
            let angle = 40.0 * draw(key, 2) - 20.0;
            let stems = 2 + (3.0 * draw(key, 3)) as usize;
            let case = |lean, stems, parts| Case { name: name.to_owned(), seed, lean, stems, parts, size };
            cases.push(case(0.0, 1, Parts::LEAFY));
            cases.push(case(angle, 1, Parts::LEAFY));
            cases.push(case(if draw(key, 4) < 0.5 { angle } else { 0.0 }, 1, Parts::BARE));
            if draw(key, 5) < 0.5 {
                let parts = if draw(key, 6) < 0.7 { Parts::LEAFY } else { Parts::BARE };
                cases.push(case(0.0, stems, parts));
            }
        }
    }
    cases
}

/// What the models are of: constant, measure, description.
const MODELS: [(&str, &str, &str); 6] = [
    ("LEAVES", "leaves", "Whether there are leaves, from [`super::Evidence::texture`]."),
    ("FEET", "feet", "That the number of feet is right, from [`super::Evidence::stem`]."),
    ("WIDTH", "width", "That the width is right to 15 %, from [`super::Evidence::stem`]."),
    ("LEAN", "lean", "That the lean is right to 3°, from [`super::Evidence::stem`]."),
    ("BARE", "bare", "That the bare height is right to 5 % of the height, from [`super::Evidence::stem`]."),
    ("FORK", "fork", "That the first fork is right to 8 % of the height, from [`super::Evidence::stem`]."),
];

/// A sparse tree in leaf is called bare more often than the reverse: leafy trees weigh more, sparse ones, from these
/// gaps on, so many times more.
const LEAFY_WEIGHT: f64 = 1.3;
const SPARSE: f64 = 0.3;
const SPARSE_WEIGHT: f64 = 3.0;

/// Models of these outcomes, as a source file.
fn models(outcomes: &[&Outcome], judged: &[&Outcome]) -> String {
    let mut text = "//! Logistic models of what was read on grown trees: fitted by ridge regression, from what the example\n//! \
        `calibrate_reading` of `pleach-experiments` measures,\n//! to the even seeds, as drawn and as ragged masks.\n\nuse super::logistic::Logistic;\n"
        .to_owned();
    for (name, measure, what) in MODELS {
        let samples = |outcomes: &[&Outcome]| -> Vec<Sample> {
            let sample = |o: &&Outcome| {
                let result = o.results.iter().find(|result| result.0 == measure)?.1?;
                if measure != "leaves" {
                    // All masks of a tree weigh as much as its picture.
                    let weight = if o.mask > 0 { 1.0 / RAGGED as f64 } else { 1.0 };
                    return Some((o.stem.clone(), f64::from(u8::from(result)), weight));
                }
                let is_leafy = o.values.last()?.1;
                let leafy = if o.texture[0] > SPARSE { SPARSE_WEIGHT * LEAFY_WEIGHT } else { LEAFY_WEIGHT };
                let weight = if is_leafy > 0.0 { leafy } else { 1.0 };
                Some((o.texture.clone(), is_leafy, weight))
            };
            outcomes.iter().filter_map(sample).collect()
        };
        let model = Model::fit(&samples(outcomes));
        text += &model.source(name, what);
        let judged = samples(judged);
        let of = |so: f64| {
            let part: Vec<&Sample> = judged.iter().filter(|sample| sample.1 == so).collect();
            let hits =
                part.iter().filter(|sample| (model.probability(&sample.0) >= 0.5) == (so > 0.5)).count();
            format!("{hits} of {}", part.len())
        };
        println!("model {name}, odd seeds: {} of those that are so, {} of the others", of(1.0), of(0.0));
    }
    text
}

fn report(title: &str, outcomes: &[&Outcome]) {
    println!("{title}: {} pictures", outcomes.len());
    let Some(first) = outcomes.first() else { return };
    for (place, &(name, ..)) in first.results.iter().enumerate() {
        let judged: Vec<(bool, f64)> =
            outcomes.iter().filter_map(|o| Some((o.results[place].1?, o.results[place].2))).collect();
        let right = |part: &[&(bool, f64)]| part.iter().filter(|j| j.0).count();
        let all: Vec<&(bool, f64)> = judged.iter().collect();
        print!(
            "  {name:<22} {:>5.1} % of {:>4}  ",
            100.0 * right(&all) as f64 / all.len().max(1) as f64,
            all.len()
        );
        for (low, high) in [(0.0, 0.3), (0.3, 0.5), (0.5, 0.7), (0.7, 0.85), (0.85, 0.95), (0.95, 1.01)] {
            let part: Vec<&(bool, f64)> = judged.iter().filter(|j| j.1 >= low && j.1 < high).collect();
            if part.is_empty() {
                print!(" |      -       ");
            } else {
                let mean = part.iter().map(|j| j.1).sum::<f64>() / part.len() as f64;
                print!(" | {:.2}:{:.2} ({:>3})", mean, right(&part) as f64 / part.len() as f64, part.len());
            }
        }
        println!();
    }
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let seeds = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(4);
    let (sources, csv, folder) = (arguments.next(), arguments.next(), arguments.next());
    let all = std::sync::Mutex::new(cases(seeds).into_iter().map(Some).collect::<Vec<_>>());
    let count = all.lock().unwrap().len();
    let next = std::sync::atomic::AtomicUsize::new(0);
    let outcomes = std::sync::Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                let mut reader = Reader::new();
                loop {
                    let i = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    if i >= count {
                        return;
                    }
                    let case = all.lock().unwrap()[i].take().unwrap();
                    let found = judge_all(&case, &mut reader, folder.as_deref()).unwrap_or_default();
                    outcomes.lock().unwrap().extend(found.into_iter().map(|outcome| (i, outcome)));
                }
            });
        }
    });
    let mut outcomes = outcomes.into_inner().unwrap();
    outcomes.sort_by_key(|(i, _)| *i);
    let outcomes: Vec<Outcome> = outcomes.into_iter().map(|(_, outcome)| outcome).collect();
    let of = |odd: u64| outcomes.iter().filter(move |o| o.case.seed % 2 == odd);
    report("even seeds, tuned on", &of(0).filter(|o| o.mask == 0).collect::<Vec<_>>());
    report("odd seeds, judged", &of(1).filter(|o| o.mask == 0).collect::<Vec<_>>());
    report("odd seeds, judged by ragged masks", &of(1).filter(|o| o.mask > 0).collect::<Vec<_>>());
    if let Some(path) = sources {
        std::fs::write(path, models(&of(0).collect::<Vec<_>>(), &of(1).collect::<Vec<_>>())).unwrap();
    }
    if let Some(path) = csv {
        let mut text = String::new();
        for o in &outcomes {
            if text.is_empty() {
                text += "name,seed,lean,stems,leafy,size,mask";
                o.results.iter().for_each(|r| {
                    let _ = write!(text, ",{0},{0}_confidence", r.0);
                });
                o.values.iter().for_each(|v| {
                    let _ = write!(text, ",e_{}", v.0);
                });
                text += ",details\n";
            }
            let c = &o.case;
            let leafy = u8::from(c.parts == Parts::LEAFY);
            let _ =
                write!(text, "{},{},{:.1},{},{leafy},{},{}", c.name, c.seed, c.lean, c.stems, c.size, o.mask);
            for r in &o.results {
                let _ = write!(text, ",{},{:.3}", r.1.map_or("", |right| if right { "1" } else { "0" }), r.2);
            }
            o.values.iter().for_each(|v| {
                let _ = write!(text, ",{:.5}", v.1);
            });
            let _ = writeln!(text, ",{}", o.details);
        }
        std::fs::write(path, text).unwrap();
    }
}
