//! From a tree in a small picture to all of its pixels, twigs and gaps.
//!
//! Where the sky is behind, a pixel is tree if it is farther from the sky's colour than half of what is usual for the
//! tree around, as in [`super::score`]: that keeps twigs of a pixel and opens gaps of one. Elsewhere its own colour and
//! the small picture's answer decide together.
//!
//! In a box that a person showed, a shadow that the cut took for tree is then taken away again, as in
//! [`super::score`]; what was marked stays.

use super::Segmentation;
use super::clear_sky::ClearSky;
use super::cut::{Cut, Seed, Seeds};
use super::ground::Ground;
use super::oklab::Converter;
use super::photo::Photo;
use super::reduced::Stretched;
use super::score::{Foreground, MIN_DISTANCE};
use super::shadow;
use crate::bitmap::Bitmap;

/// Twigs reach beyond the small picture's tree by this part of its longer side.
const TWIGS: f64 = 0.07;
/// What is behind a pixel is looked for within this part of the small picture's longer side.
const BEHIND: f64 = 0.02;
/// How much the small picture's answer speaks for its side, as a logarithm of likelihoods.
const NEIGHBORS: f32 = 5.0;
/// A pixel that has so much tree around it is not before the sky, from −1 to 1.
const DEEP: f32 = 0.9;
/// Of what is not tree around a pixel before the sky, at least this part is sky.
const BEFORE_SKY: f32 = 0.7;
/// What is half way between sky and tree, as a part of the tree's distance from the sky.
const HALF: f32 = 0.5;
/// The tree's distance from the sky counts up to this, in spreads.
const MAX_DISTANCE: f32 = 40.0;
/// Factor on the least distance from the sky of what is firmly tree; loosely, one over it.
const FIRM: f32 = 1.5;
/// What speaks for tree by more, or by less, is firm or loose.
const MARGIN: f32 = 2.0;

/// The tree's pixels.
pub(super) fn refined(photo: &Photo, converter: &Converter, cut: &Cut, given: &Seeds<'_>) -> Foreground {
    let region = given.region;
    let small = &cut.small;
    let side = f64::from(small.width.max(small.height));
    let cells = |part: f64| (part * side).ceil() as u32;
    let tree: Vec<f32> = cut.is_tree.iter().map(|&is| f32::from(u8::from(is))).collect();
    let mut away: Vec<f32> = Vec::with_capacity(tree.len());
    for y in 0..small.height {
        for x in 0..small.width {
            away.push(cut.sky.distance(small, small.middle(x, y), small.colors[small.index(x, y)]));
        }
    }
    let skies: Vec<f32> = cut
        .is_tree
        .iter()
        .zip(&away)
        .map(|(is, away)| if !is && ClearSky::is_sky(*away) { 1.0 } else { 0.0 })
        .collect();
    let mut around = small.box_mean(&tree, 1);
    for (around, seed) in around.iter_mut().zip(&cut.seeds) {
        if matches!(seed, Seed::Tree | Seed::Trunk) {
            *around = 1.0;
        }
    }
    let behind = cells(BEHIND);
    let (wide_tree, wide_sky) = (small.box_mean(&tree, behind), small.box_mean(&skies, behind));
    // The mean of the tree's distances, each as often as it is large: cells that are part sky count little.
    let weighted = |power: i32| -> Vec<f32> {
        let of = |(t, a): (&f32, &f32)| {
            let a = a.min(MAX_DISTANCE);
            t * if power == 2 { a * a } else { a }
        };
        small.box_mean(&tree.iter().zip(&away).map(of).collect::<Vec<_>>(), behind)
    };
    let (once, twice) = (weighted(1), weighted(2));
    let near = small.box_mean(&tree, cells(TWIGS));
    // Of what is not tree around, the part that is sky; and the least distance from it.
    let is_before_sky: Vec<f32> = wide_tree
        .iter()
        .zip(&wide_sky)
        .map(|(tree, sky)| if *sky > 0.0 { sky / (1.0 - tree).max(1e-6) } else { 0.0 })
        .collect();
    let least: Vec<f32> = once
        .iter()
        .zip(&twice)
        .map(|(once, twice)| {
            let mean = if *once > 1e-3 { twice / once } else { 0.0 };
            (HALF * mean).max(MIN_DISTANCE as f32)
        })
        .collect();

    let (width, height) = (photo.width(), photo.height());
    let new = || Bitmap::new(width, height);
    let (mut ink, mut firm, mut loose, mut shade) = (new(), new(), new(), new());
    let ground = given.is_shown.then(|| Ground::new(cut, &region)).flatten();
    let columns = small.columns();
    let mut fields =
        [&near, &around, &is_before_sky, &least].map(|field| Stretched::new(small, field, &columns));
    for y in region.y..region.y + region.height {
        let row = small.row(y - small.part.y);
        let [near, around, is_before_sky, least] = fields.each_mut().map(|field| field.row(&row));
        for x in region.x..region.x + region.width {
            let at = (x - small.part.x) as usize;
            let is_marked = |strokes: Option<&Bitmap>| strokes.is_some_and(|ink| ink.get(x, y));
            if is_marked(given.include) {
                [&mut ink, &mut firm, &mut loose].into_iter().for_each(|map| map.set(x, y, true));
                continue;
            }
            if near[at] <= 0.0 || is_marked(given.exclude) {
                continue;
            }
            let color = converter.oklab(photo.rgb(x, y));
            let inside = 2.0 * around[at] - 1.0;
            let away = cut.sky.distance(small, (x, y), color);
            let (for_tree, margin) = if is_before_sky[at] > BEFORE_SKY && inside < DEEP {
                // As a logarithm of ratios, so that both kinds of margin are sums.
                ((away / least[at]).min(9.0) - 1.0, FIRM - 1.0)
            } else {
                let by_color = cut.by_color(y, color);
                let sky = if ClearSky::is_sky(away) { NEIGHBORS } else { 0.0 };
                (NEIGHBORS * inside + by_color - sky, MARGIN)
            };
            ink.set(x, y, for_tree > 0.0);
            firm.set(x, y, for_tree > margin);
            let is_loose = for_tree > -margin.min(1.0 - 1.0 / FIRM);
            loose.set(x, y, is_loose);
            if is_loose && let Some(ground) = &ground {
                shade.set(x, y, ground.is_shade((x, y), color));
            }
        }
    }
    let shadow = shadow::on_ground(&ink, &shade);
    [&mut ink, &mut firm, &mut loose].into_iter().for_each(|map| map.subtract(&shadow));
    Foreground { ink, horizon: None, segmentation: Segmentation::Cut { region }, firm, loose }
}
