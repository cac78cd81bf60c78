//! Draws docs/photographs.png: a photograph of a tree, what is masked, what is read, and the tree that a fit found. The
//! photograph is drawn, too.
//!
//! ```sh
//! cargo run --release -p pleach-experiments --example photograph -- draw oak.png
//! pleach mask oak.png --box 80,40,560,662 -o mask.png --overlay look.png
//! pleach read oak.png --box 80,40,560,662 -o oak/
//! pleach fit oak.png --box 80,40,560,662 --height 14 --timeout 60s
//! cargo run --release -p pleach-experiments --example photograph -- \
//!     sheet docs/photographs.png oak.png look.png oak/reading.png runs/oak/individual-render.png
//! ```

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use anyhow::Context;
use image::{Rgb, RgbImage};
use pleach_mesh::Palette;
use pleach_render::preview::Background;
use pleach_render::{Picture, Preview, PreviewSettings, png_file};
use std::path::Path;

/// The tree that is photographed.
const SPECIES: &str = "cambridge_oak";
const SEED: u64 = 12;
/// Width and height of the photograph, and of a picture of the sheet.
const PHOTO: (u32, u32) = (720, 720);
const SMALL: (u32, u32) = (240, 240);
/// Part of the height at which lawn and far hills meet.
const HORIZON: f64 = 0.8;

type Light = [f64; 3];

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let usage = "expected `draw PHOTO`, or `sheet OUT PICTURE ...`";
    let (what, out) = arguments.split_first().context(usage)?;
    let (out, pictures) = out.split_first().context(usage)?;
    match what.as_str() {
        "draw" => photograph()?.save(out)?,
        "sheet" => sheet(out, pictures)?,
        _ => anyhow::bail!("{usage}"),
    }
    println!("wrote {out}");
    Ok(())
}

/// A tree on a lawn, with its shadow, before far hills and a sky with some clouds.
fn photograph() -> anyhow::Result<RgbImage> {
    let species = pleach_generators::species(SPECIES)?;
    let tree = species.grow(SEED)?;
    let palette = Palette::new(&species.appearance, None);
    let (width, height) = PHOTO;
    let settings =
        PreviewSettings { width, height, background: Background::Transparent, ..PreviewSettings::default() };
    let drawn = Preview::new(&tree, &palette, width).picture(&settings);
    Ok(RgbImage::from_fn(width, height, |x, y| {
        let at = (y as usize * width as usize + x as usize) * 4;
        let behind = behind(f64::from(x), f64::from(y));
        let cover = f64::from(drawn.rgba[at + 3]) / 255.0;
        Rgb(std::array::from_fn(|c| {
            let seen = behind[c] + cover * (f64::from(drawn.rgba[at + c]) - behind[c]);
            let grain = 6.0 * (chance(x.into(), y.into(), 90 + c as u32) - 0.5);
            (seen + grain).clamp(0.0, 255.0) as u8
        }))
    }))
}

/// What is behind the tree.
fn behind(x: f64, y: f64) -> Light {
    let down = y / f64::from(PHOTO.1);
    let rim = HORIZON - 0.035 - 0.05 * noise(x, 0.0, 60.0, 1) - 0.012 * noise(x, 0.0, 9.0, 2);
    if down < rim {
        let sky = mix([96.0, 148.0, 214.0], [206.0, 224.0, 240.0], down / HORIZON);
        let clouds = noise(x, 2.0 * y, 160.0, 3) + 0.5 * noise(x, 2.0 * y, 50.0, 4) - 0.75;
        return mix(sky, [244.0, 245.0, 247.0], 1.6 * clouds);
    }
    if down < HORIZON {
        let light = 0.5 * noise(x, y, 14.0, 5) + 0.5 * noise(x, y, 4.0, 6);
        return mix([142.0, 170.0, 196.0], [160.0, 186.0, 208.0], light);
    }
    // Blades are smaller the farther away they are.
    let near = (down - HORIZON) / (1.0 - HORIZON);
    let light = 0.5 * noise(x, 4.0 * y, 8.0 + 30.0 * near, 7) + 0.5 * noise(x, y, 2.0, 8);
    mix([104.0, 140.0, 58.0], [152.0, 178.0, 84.0], light)
}

fn mix(from: Light, to: Light, share: f64) -> Light {
    let share = share.clamp(0.0, 1.0);
    std::array::from_fn(|c| from[c] + share * (to[c] - from[c]))
}

/// Smooth noise from 0 to 1, with bumps of some `size` pixels.
fn noise(x: f64, y: f64, size: f64, salt: u32) -> f64 {
    let (x, y) = (x / size, y / size);
    let (left, top) = (x.floor(), y.floor());
    let ease = |v: f64| v * v * (3.0 - 2.0 * v);
    let (right, below) = (ease(x - left), ease(y - top));
    let row = |y: f64| {
        let (a, b) = (chance(left, y, salt), chance(left + 1.0, y, salt));
        a + right * (b - a)
    };
    let (a, b) = (row(top), row(top + 1.0));
    a + below * (b - a)
}

/// A number from 0 to 1 for a place, without order.
fn chance(x: f64, y: f64, salt: u32) -> f64 {
    let mut h = (x as u64) << 40 ^ (y as u64) << 20 ^ u64::from(salt);
    for _ in 0..3 {
        h = (h ^ h >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    (h >> 40) as f64 / f64::from(1 << 24)
}

/// The pictures side by side on white, each as large as fits.
fn sheet(out: &str, pictures: &[String]) -> anyhow::Result<()> {
    let (width, height) = SMALL;
    let across = width * pictures.len() as u32;
    let mut page = RgbImage::from_pixel(across, height, Rgb([255; 3]));
    for (x, path) in (0..across).step_by(width as usize).zip(pictures) {
        let picture = image::open(Path::new(path)).with_context(|| format!("reading {path}"))?.to_rgb8();
        let scale = (f64::from(width) / f64::from(picture.width()))
            .min(f64::from(height) / f64::from(picture.height()));
        let side = |of: u32| ((f64::from(of) * scale).round() as u32).max(1);
        let (wide, high) = (side(picture.width()), side(picture.height()));
        let small = image::imageops::resize(&picture, wide, high, image::imageops::FilterType::CatmullRom);
        image::imageops::replace(&mut page, &small, (x + (width - wide) / 2).into(), (height - high).into());
    }
    let rgba = page.pixels().flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255]).collect();
    let mut file = std::io::BufWriter::new(std::fs::File::create(out)?);
    png_file::write_indexed(&mut file, &Picture { width: across, height, rgba })?;
    Ok(())
}
