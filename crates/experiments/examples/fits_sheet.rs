//! Draws docs/fits.png: goals of other programs, and trees of what was fitted to them.
//!
//! ```sh
//! cargo run --release -p pleach-experiments --example fits_sheet -- docs/fits.png
//! ```
//!
//! The fits are those of `experiments/individual`: a minute each, a third of it for the goal's own tree.

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use anyhow::Context;
use pleach_blend::picture::{Anchor, Color, Scene, Shape};
use pleach_mesh::Palette;
use pleach_render::preview::Background;
use pleach_render::{Picture, Preview, PreviewSettings, png_file};
use pleach_silhouette::goal::{Goal, GoalOptions};
use std::path::Path;

/// Goal, what is written below it, and the species whose colours the fit gets: silhouettes have none.
const GOALS: [(&str, &str, &str); 6] = [
    ("treegen_quaking_aspen", "quaking aspen of tree-gen", "quaking_aspen"),
    ("treegen_black_oak", "black oak of tree-gen", "black_oak"),
    ("treegen_small_pine", "small pine of tree-gen", "small_pine"),
    ("arbaro_lombardy_poplar", "Lombardy poplar of Arbaro", "lombardy_poplar"),
    ("arbaro_black_tupelo", "black tupelo of Arbaro", "black_tupelo"),
    ("sapling_small_maple", "small maple of Sapling", "acer"),
];
/// Height and width of a picture.
const SIZE: u32 = 232;
/// What is left free between two rows of pictures, and beside them.
const GAP: u32 = 20;
/// What is left free around a goal.
const MARGIN: u32 = 9;
const LABEL: u32 = 46;
const INK: Color = Color::opaque([40, 44, 40]);
const GRAY: Color = Color::opaque([110, 114, 110]);

fn main() -> anyhow::Result<()> {
    let out = std::env::args().nth(1).context("expected the PNG file to write")?;
    let (block, row) = (3 * SIZE + GAP, SIZE + LABEL);
    let rows = GOALS.len().div_ceil(2) as u32;
    let mut page = Scene::new(2 * block + GAP, rows * row + GAP);
    let mut pictures = Vec::new();
    for (i, (goal, name, like)) in (0..).zip(GOALS) {
        let (x, y) = (GAP + i % 2 * block, GAP / 2 + i / 2 * row);
        let texts = [(name, INK), ("this very tree", GRAY), ("another of its kind", GRAY)];
        for (k, (text, color)) in (0..).zip(texts) {
            let at = (f64::from(x + k * SIZE + SIZE / 2), f64::from(y + SIZE + 20));
            let text = text.to_owned();
            page.add(Shape::Text { text, at, size: 15.0, anchor: Anchor::Middle, color });
        }
        pictures.push((x, y, silhouette(&format!("targets/{goal}.png"))?));
        for (k, further) in [(1, 0), (2, 1)] {
            let tree = fitted(&format!("experiments/individual/fits/{goal}.toml"), like, further)?;
            pictures.push((x + k * SIZE, y, tree));
        }
    }
    let png = page.to_png().context("the page is too large")?;
    let page = image::load_from_memory(&png)?.into_rgba8();
    let mut sheet = Picture { width: page.width(), height: page.height(), rgba: page.into_raw() };
    for (x, y, picture) in &pictures {
        sheet.paste(picture, *x, *y);
    }
    let mut file = std::io::BufWriter::new(std::fs::File::create(&out)?);
    png_file::write_indexed(&mut file, &sheet)?;
    println!("wrote {out}");
    Ok(())
}

/// The goal in grey levels, with a margin as the trees beside it have.
fn silhouette(path: &str) -> anyhow::Result<Picture> {
    let goal = Goal::load(Path::new(path), &GoalOptions::default())?;
    let ink = |x: u32, y: u32| if goal.bitmap.get(x, y) { 0 } else { 255 };
    let (width, height) = (goal.bitmap.width(), goal.bitmap.height());
    let large = image::GrayImage::from_fn(width, height, |x, y| image::Luma([ink(x, y)]));
    let (inner, margin) = (SIZE - 2 * MARGIN, MARGIN);
    let small = image::imageops::resize(&large, inner, inner, image::imageops::FilterType::CatmullRom);
    let mut rgba = Vec::new();
    for y in 0..SIZE {
        for x in 0..SIZE {
            let inside = (margin..SIZE - margin).contains(&x) && (margin..SIZE - margin).contains(&y);
            // Black at a quarter is kinder to the eye beside shaded pictures.
            let gray = if inside { small.get_pixel(x - margin, y - margin).0[0] } else { 255 };
            let gray = 40 + (u32::from(gray) * 215 / 255) as u8;
            rgba.extend([gray, gray, gray, 255]);
        }
    }
    Ok(Picture { width: SIZE, height: SIZE, rgba })
}

/// A tree of the fit at `path`: its own tree, or one that is `further` seeds after it and of its kind.
fn fitted(path: &str, like: &str, further: u64) -> anyhow::Result<Picture> {
    let mut species = pleach_generators::read_file(Path::new(path))?;
    let seed = species.tree_seed.context("a fit has a seed")? + further;
    let mut tree = species.grow(seed)?;
    like.clone_into(&mut species.name);
    let palette = Palette::new(&species.appearance, None);
    palette.apply_season(&mut tree);
    let white = Background::Plain(pleach_tree::Color([255; 3]));
    // As level as the goal.
    let settings = PreviewSettings {
        width: SIZE,
        height: SIZE,
        elevation: 0.0,
        background: white,
        ..PreviewSettings::default()
    };
    Ok(Preview::new(&tree, &palette, SIZE).picture(&settings))
}
