//! Pictures for people: each goal, a tree of its kind and this very tree.

use super::row::{Row, Which};
use super::spec::PictureSpec;
use anyhow::Context;
use image::imageops::{self, FilterType};
use image::{Rgba, RgbaImage};
use pleach_mesh::Palette;
use pleach_render::preview::{Background, Ground};
use pleach_render::{Picture as Shaded, Preview, PreviewSettings};
use pleach_silhouette::mask::Photo;
use pleach_silhouette::picture::{Picture, sheet_of_pictures};
use pleach_tree::{Color, Species};
use std::path::Path;

/// Height and width of a picture.
const SIZE: u32 = 160;
/// The largest part of it that a goal takes: trees are drawn with such a margin.
const FILLED: f64 = 0.92;
/// Opacity from which a pixel is tree.
const OPAQUE: u8 = 128;
const COLUMNS: usize = 3;

/// One line per picture.
pub(super) fn draw<'a>(
    folder: &Path,
    pictures: impl Iterator<Item = &'a PictureSpec>,
    rows: &[Row],
    file: impl Fn(&str) -> String,
) -> anyhow::Result<Shaded> {
    let mut cells = Vec::new();
    for picture in pictures {
        let name = picture.name();
        let path = folder.join(file(&name));
        let species = pleach_generators::read_file(&path)?;
        let label = |which: Which, word: &str| {
            let row = rows.iter().find(|row| row.picture == name && row.which == which);
            row.map_or_else(|| word.to_owned(), |row| format!("{word}: IoU {:.2}", row.iou.0))
        };
        let seed = species.tree_seed.with_context(|| format!("{} has no seed", path.display()))?;
        cells.push((name.clone(), goal(&folder.join(&picture.file))?));
        cells.push((label(Which::Kind, "kind"), shaded(&species.kind(), seed)?));
        cells.push((label(Which::Tree, "tree"), shaded(&species, seed)?));
    }
    let cells: Vec<(&str, Picture)> =
        cells.iter().map(|(label, cell)| (label.as_str(), cell.clone())).collect();
    Ok(in_colors(&sheet_of_pictures(&cells, COLUMNS)))
}

/// The tree in the picture at `path`, on white.
fn goal(path: &Path) -> anyhow::Result<Picture> {
    let photo = Photo::load(path).with_context(|| format!("cannot use {}", path.display()))?;
    let image = RgbaImage::from_fn(photo.width(), photo.height(), |x, y| {
        let [r, g, b, a] = photo.pixels()[(y * photo.width() + x) as usize];
        let over = |light: u8| (u32::from(light) * u32::from(a) + 255 * (255 - u32::from(a))) / 255;
        Rgba([over(r) as u8, over(g) as u8, over(b) as u8, a])
    });
    let inked = || image.enumerate_pixels().filter(|(.., color)| color.0[3] >= OPAQUE);
    let side = |of: fn(u32, u32) -> u32| {
        let low = inked().map(|(x, y, _)| of(x, y)).min();
        low.zip(inked().map(|(x, y, _)| of(x, y)).max())
    };
    let (left, right) = side(|x, _| x).context("a goal has a tree")?;
    let (top, bottom) = side(|_, y| y).context("a goal has a tree")?;
    let (width, height) = (right - left + 1, bottom - top + 1);
    let tree = imageops::crop_imm(&image, left, top, width, height).to_image();
    let factor = FILLED * f64::from(SIZE) / f64::from(width.max(height));
    let scaled = |side: u32| ((f64::from(side) * factor).round() as u32).max(1);
    let small = imageops::resize(&tree, scaled(width), scaled(height), FilterType::Triangle);
    let mut cell = Picture::new(SIZE, SIZE);
    let (x, y) = ((SIZE - small.width()) / 2, (SIZE - small.height()) / 2);
    for (column, row, color) in small.enumerate_pixels() {
        let [r, g, b, _] = color.0;
        cell.set(x + column, y + row, [r, g, b]);
    }
    Ok(cell)
}

/// A tree of `species` in its colours.
fn shaded(species: &Species, seed: u64) -> anyhow::Result<Picture> {
    let mut tree = species.grow(seed)?;
    let palette = Palette::new(&species.appearance, None);
    palette.apply_season(&mut tree);
    // As level as the goal.
    let settings = PreviewSettings {
        width: SIZE,
        height: SIZE,
        elevation: 0.0,
        background: Background::Plain(Color([255; 3])),
        ground: Ground::None,
        ..PreviewSettings::default()
    };
    let picture = Preview::new(&tree, &palette, SIZE).picture(&settings);
    let mut cell = Picture::new(SIZE, SIZE);
    for (place, color) in (0..).zip(picture.rgba.chunks_exact(4)) {
        cell.set(place % SIZE, place / SIZE, [color[0], color[1], color[2]]);
    }
    Ok(cell)
}

/// The same picture, for a file of few colours.
fn in_colors(picture: &Picture) -> Shaded {
    let (width, height) = (picture.width(), picture.height());
    let pixel = |x: u32, y: u32| {
        let [r, g, b] = picture.get(x, y);
        [r, g, b, 255]
    };
    let rgba = (0..height).flat_map(|y| (0..width).flat_map(move |x| pixel(x, y))).collect();
    Shaded { width, height, rgba }
}
