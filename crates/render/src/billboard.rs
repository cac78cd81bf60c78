//! The last level of detail: upright cards through the trunk that show pictures of the tree.
//!
//! Seen from afar a tree and its mirror image from behind have one silhouette, so each card serves
//! two sides. The pictures hold the tree's own colours with the crown's own shade and without sun,
//! since the engine lights them again.

use crate::picture::Picture;
use crate::preview::{Frame, Preview};
use glam::{Vec3, vec3};
use pleach_mesh::Palette;
use pleach_mesh::card::Card;
use pleach_plant::Tree;
use pleach_plant::trig::sin_cos;
use std::f64::consts::PI;

/// Most cards of a tree.
pub const MAX_SIDES: u32 = 8;
/// Height of a card's picture in pixels.
const HEIGHT: u32 = 256;
/// Part of a card around the tree that stays empty, so that neighbours in the picture do not bleed.
const MARGIN: f32 = 0.03;

/// The cards of some trees and the one picture that all of them show.
#[derive(Clone, Debug)]
pub struct Billboards {
    /// One row per tree, one column per side.
    pub picture: Picture,
    /// The cards of each tree; `None` where nothing of it is visible.
    pub cards: Vec<Vec<Card>>,
}

impl Billboards {
    /// Paints `trees`, each from `sides` (1 to [`MAX_SIDES`]) directions spread over half a turn, the
    /// first looking along +y.
    ///
    /// ```
    /// use pleach_mesh::Palette;
    /// use pleach_render::Billboards;
    ///
    /// let species = pleach_generators::species("palm")?;
    /// let billboards = Billboards::paint(&[&species.grow(1)?], &Palette::new(&species.appearance, None), 2);
    /// assert_eq!(billboards.cards[0].len(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn paint(trees: &[&Tree], palette: &Palette, sides: u32) -> Self {
        let sides = sides.clamp(1, MAX_SIDES);
        let painted: Vec<Vec<(Card, Picture)>> =
            trees.iter().map(|tree| paint(tree, palette, sides)).collect();
        let widest = painted.iter().flatten().map(|(_, p)| p.width).max().unwrap_or(1);
        let (width, height) = (widest * sides, HEIGHT * painted.len().max(1) as u32);
        let mut picture = Picture::transparent(width, height);
        let mut cards = Vec::new();
        for (row, views) in (0..).zip(painted) {
            let place = |column: u32, mut card: Card, view: &Picture, whole: &mut Picture| {
                let (x, y) = (column * widest, row * HEIGHT);
                whole.paste(view, x, y);
                let part = |at: u32, of: u32| at as f32 / of as f32;
                card.uv =
                    [part(x, width), part(y, height), part(x + view.width, width), part(y + HEIGHT, height)];
                card
            };
            cards.push(
                (0..).zip(&views).map(|(i, (card, view))| place(i, *card, view, &mut picture)).collect(),
            );
        }
        picture.bleed();
        Self { picture, cards }
    }

    /// Whether no tree has a card.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cards.iter().all(Vec::is_empty)
    }
}

fn paint(tree: &Tree, palette: &Palette, sides: u32) -> Vec<(Card, Picture)> {
    let preview = Preview::new(tree, palette, HEIGHT);
    let (low, high) = preview.bounds();
    let (middle, half_height) = ((low.z + high.z) / 2.0, (high.z - low.z) / 2.0 * (1.0 + MARGIN));
    let views: Vec<(Card, Picture)> = (0..sides)
        .map(|side| {
            let azimuth = PI * f64::from(side) / f64::from(sides);
            let (sin, cos) = sin_cos(azimuth);
            let right = vec3(cos as f32, sin as f32, 0.0);
            let half_width = (preview.reach(right) * (1.0 + MARGIN)).max(0.02 * half_height);
            let width = (HEIGHT as f32 * half_width / half_height.max(1e-3)).ceil();
            let frame = Frame {
                middle: Vec3::Z * middle,
                azimuth: azimuth as f32,
                half: [half_width, half_height],
                pixels: [(width as u32).clamp(8, 4 * HEIGHT), HEIGHT],
            };
            let corner = |x: f32, z: f32| right * (x * half_width) + Vec3::Z * (middle + z * half_height);
            let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            (Card { corners, uv: [0.0, 0.0, 1.0, 1.0] }, preview.flat(&frame))
        })
        .collect();
    let is_seen = |(_, view): &(Card, Picture)| view.rgba.chunks_exact(4).any(|pixel| pixel[3] > 0);
    if views.iter().any(is_seen) { views } else { Vec::new() }
}
