//! Pictures of blends.

use super::maps::{Maps, Method};
use super::{FIGURE, Outputs, PALM, SEED};
use pleach_blend::draw::{Drawing, silhouettes};
use pleach_silhouette::{Bitmap, Detail, picture as sheets};
use pleach_tree::Species;
use rayon::prelude::*;

/// Figure 4.8: quaking aspen and silver birch, and what lies between them.
pub(super) fn figure(maps: &Maps, outputs: &Outputs) -> anyhow::Result<()> {
    let named = |name: &str| maps.declared.landmarks().named(name);
    let pair = (named("quaking_aspen")?, named("silver_birch")?);
    let mut row = vec![("quaking aspen".to_owned(), maps.species()[pair.0].clone())];
    for (method, label) in [
        (Method::Raw, "half way, raw"),
        (Method::Straight, "half way, straight"),
        (Method::Map, "half way, map"),
    ] {
        row.push((label.to_owned(), maps.between(method, pair, 0.5)?));
    }
    row.push(("silver birch".to_owned(), maps.species()[pair.1].clone()));
    outputs.picture(FIGURE, &sheet(row, 5, 300))
}

/// The palm half way to each other species, raw above ours.
pub(super) fn with_palm(maps: &Maps, outputs: &Outputs) -> anyhow::Result<()> {
    let palm = maps.declared.landmarks().named("palm")?;
    let others: Vec<usize> = (0..maps.species().len()).filter(|&i| i != palm).collect();
    let mut cells = Vec::new();
    for chunk in others.chunks(7) {
        for method in [Method::Raw, Method::Straight, Method::Map] {
            for &other in chunk {
                let label = format!("{} {}", method.name(), maps.species()[other].name);
                cells.push((label, maps.between(method, (palm, other), 0.5)?));
            }
        }
    }
    outputs.picture(PALM, &sheet(cells, 7, 176))
}

fn sheet(cells: Vec<(String, Species)>, columns: usize, pixels: u32) -> sheets::Picture {
    let drawing = Drawing { pixels, detail: Detail::Full };
    let cells: Vec<(String, Bitmap)> = cells
        .into_par_iter()
        .map(|(label, species)| match silhouettes(&[species], SEED, drawing) {
            Ok(mut drawn) => (label, drawn.remove(0)),
            Err(_) => (format!("{label}: grows no tree"), Bitmap::new(pixels, pixels)),
        })
        .collect();
    sheets::sheet(&cells, columns)
}
