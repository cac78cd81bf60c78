//! The gallery: one sheet with many species, each leafy beside winter.

use anyhow::{Context, ensure};
use pleach_blend::picture::{Anchor, Color, Scene, Shape};
use pleach_mesh::Palette;
use pleach_render::preview::Background;
use pleach_render::{Picture, Preview, PreviewSettings};
use pleach_tree::Season;
use pleach_tree::{Parts, Species, Tree, TreeStats};

/// Pixels of a sheet, at most: a gigabyte of colours.
const MAX_PIXELS: u64 = 1 << 28;

const INK: Color = Color::opaque([40, 44, 40]);
const GRAY: Color = Color::opaque([120, 124, 120]);

/// Species per row, each with two pictures, so that the sheet is about square.
fn across(count: usize) -> u32 {
    (1..).find(|n| 2 * n * n >= count as u32).unwrap_or(1)
}

/// Draws the sheet, `size` pixels per tree; `columns` species per row, by default about a square.
pub(super) fn sheet(
    all: &[Species],
    columns: Option<u32>,
    size: u32,
    parts: Parts,
    grow: impl Fn(&Species) -> anyhow::Result<Tree>,
    settings: &PreviewSettings,
) -> anyhow::Result<Picture> {
    let columns = columns.unwrap_or_else(|| across(all.len())).min(all.len() as u32);
    let rows = (all.len() as u32).div_ceil(columns);
    let (gap, label) = (size / 6, size / 5);
    let (across, down) = (2 * size + gap, size + label + gap / 2);
    let (width, height) = (columns * across + gap, rows * down + gap);
    ensure!(
        u64::from(width) * u64::from(height) <= MAX_PIXELS,
        "a sheet of {width} × {height} pixels is too large, choose a smaller --size"
    );
    let mut page = Scene::new(width, height);
    let settings = PreviewSettings {
        width: size,
        height: size,
        background: Background::Plain(pleach_tree::Color([255; 3])),
        ..*settings
    };
    let mut pictures = Vec::new();
    for (i, species) in (0..).zip(all) {
        let mut tree = grow(species)?;
        let (x, y) = (gap + i % columns * across, gap / 2 + i / columns * down);
        let height = TreeStats::new(&tree).height_m;
        caption(
            &mut page,
            &species.name,
            height,
            (f64::from(x + size), f64::from(y + size)),
            f64::from(size),
        );
        for (k, season) in [(0, None), (1, Some(Season::Winter))] {
            let palette = Palette::new(&species.appearance, season);
            palette.apply_season(&mut tree);
            let picture = Preview::with_parts(&tree, &palette, size, parts).picture(&settings);
            pictures.push((x + k * size, y, picture));
        }
    }
    let png = page.to_png().context("the sheet is too large for this machine's memory")?;
    let page = image::load_from_memory(&png)?.into_rgba8();
    let mut sheet = Picture { width: page.width(), height: page.height(), rgba: page.into_raw() };
    for (x, y, picture) in &pictures {
        sheet.paste(picture, *x, *y);
    }
    Ok(sheet)
}

/// Name and height below the two pictures that meet above `at`.
fn caption(page: &mut Scene, name: &str, height: f64, at: (f64, f64), size: f64) {
    let (em, height) = (size / 13.0, format!("{height:.1} m"));
    let mut line = |text: String, down: f64, em: f64, color: Color| {
        let at = (at.0, at.1 + down * size);
        page.add(Shape::Text { text, at, size: em, anchor: Anchor::Middle, color });
    };
    let mut title = name.replace('_', " ");
    title[..1].make_ascii_uppercase();
    line(title, 0.075, em, INK);
    line(height, 0.145, em * 0.8, GRAY);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_is_about_square() {
        for (count, columns) in [(1, 1), (2, 1), (3, 2), (15, 3), (18, 3), (19, 4), (90, 7)] {
            assert_eq!(across(count), columns, "{count} species");
        }
    }
}
