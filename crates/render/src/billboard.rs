//! The last level of detail: upright cards through the trunk that show pictures of the tree.
//!
//! Seen from afar a tree and its mirror image from behind have one silhouette, so each card serves
//! two sides. The pictures hold the tree's own colours with the crown's own shade and without sun,
//! since the engine lights them again; a second picture holds the normals, so that a card is lit as the crown is.

use crate::cutoff::cut_out;
use crate::picture::Picture;
use crate::preview::{Flat, Frame, Preview};
use glam::{Vec3, vec3};
use pleach_mesh::card::Card;
use pleach_mesh::twigs::Sheet;
use pleach_mesh::{Material, Palette, Pictures};
use pleach_plant::Tree;
use pleach_plant::trig::sin_cos;
use std::f64::consts::PI;

/// Most cards of a tree.
pub const MAX_SIDES: u32 = 8;
/// Height of a card's picture in pixels.
const HEIGHT: u32 = 512;
/// Widest picture of a card in pixels.
const WIDEST: u32 = 1024;
/// Longest side of the picture that all cards share, in pixels; where there are many, each gets less.
const LONGEST: u32 = 4096;
/// Part of a card around the tree that stays empty, so that neighbours in the picture do not bleed.
const MARGIN: f32 = 0.03;

/// The cards of some trees and the pictures that all of them show.
#[derive(Clone, Debug)]
pub struct Billboards {
    /// Colours and normals. Sides are powers of two; a card is 512 pixels high, less where there are very many.
    pub pictures: Pictures<Picture>,
    /// The cards of each tree; `None` where nothing of it is visible.
    pub cards: Vec<Vec<Card>>,
}

/// What one card is to show.
struct Side {
    azimuth: f64,
    /// Half of width and height of the card, in metres.
    half: [f32; 2],
    /// Height of its middle.
    middle: f32,
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
        let previews: Vec<Preview<'_>> =
            trees.iter().map(|tree| Preview::for_cards(tree, palette, HEIGHT)).collect();
        let all: Vec<Vec<Side>> = previews.iter().map(|preview| all_sides(preview, sides)).collect();
        // Cells of one form for all cards: as wide as the widest needs them.
        let aspect = all.iter().flatten().map(|side| side.half[0] / side.half[1]).fold(0.1, f32::max);
        let mut cell = [((HEIGHT as f32 * aspect) as u32).next_power_of_two().clamp(64, WIDEST), HEIGHT];
        let sheet = Sheet::with_room(trees.len() * sides as usize);
        let longest = |cell: [u32; 2]| (sheet.columns * cell[0]).max(sheet.rows * cell[1]);
        while longest(cell) > LONGEST && cell[1] > 8 {
            cell = cell.map(|pixels| pixels / 2);
        }
        let (width, height) = (sheet.columns * cell[0], sheet.rows * cell[1]);
        let mut color = Picture::transparent(width, height);
        let mut normal = Picture::towards_viewer(width, height);
        let (mut cards, mut number) = (Vec::new(), 0);
        for (preview, sides) in previews.iter().zip(&all) {
            let (mut own, mut is_seen) = (Vec::new(), false);
            for side in sides {
                let (x, y) = (number % sheet.columns * cell[0], number / sheet.columns * cell[1]);
                number += 1;
                let (mut card, flat) = paint(preview, side, cell);
                is_seen |= flat.color.rgba.chunks_exact(4).any(|pixel| pixel[3] > 0);
                color.paste(&flat.color, x, y);
                normal.paste(&flat.normal, x, y);
                // From the cell to the whole.
                let [u, v] = [x as f32 / width as f32, y as f32 / height as f32];
                let [of_u, of_v] = [cell[0] as f32 / width as f32, cell[1] as f32 / height as f32];
                let [left, top, right, bottom] = card.uv;
                card.uv = [u + left * of_u, v + top * of_v, u + right * of_u, v + bottom * of_v];
                own.push(card);
            }
            cards.push(if is_seen { own } else { Vec::new() });
        }
        color.bleed();
        let size = [color.width, color.height];
        let shown = cut_out(&mut color, size);
        let pictures = Pictures { normal: Some(normal), ..Pictures::cut_out(Material::Card, color, shown) };
        Self { pictures, cards }
    }

    /// Whether no tree has a card.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cards.iter().all(Vec::is_empty)
    }
}

/// How large the cards of a tree are.
fn all_sides(preview: &Preview<'_>, sides: u32) -> Vec<Side> {
    let (low, high) = preview.bounds();
    let (middle, half_height) = ((low.z + high.z) / 2.0, ((high.z - low.z) / 2.0 * (1.0 + MARGIN)).max(1e-3));
    let side = |side: u32| {
        let azimuth = PI * f64::from(side) / f64::from(sides);
        let half_width = (preview.reach(right(azimuth)) * (1.0 + MARGIN)).max(0.02 * half_height);
        Side { azimuth, half: [half_width, half_height], middle }
    };
    (0..sides).map(side).collect()
}

/// To the right of someone who looks towards `azimuth`.
fn right(azimuth: f64) -> Vec3 {
    let (sin, cos) = sin_cos(azimuth);
    vec3(cos as f32, sin as f32, 0.0)
}

/// A card, with its place in the cell, and what the cell shows.
fn paint(preview: &Preview<'_>, side: &Side, cell: [u32; 2]) -> (Card, Flat) {
    let Side { azimuth, half, middle } = *side;
    let right = right(azimuth);
    // Pixels are square, so that the card takes a part of the cell.
    let pixels = cell.map(|pixels| pixels as f32);
    let meters = (2.0 * half[0] / pixels[0]).max(2.0 * half[1] / pixels[1]);
    let whole = pixels.map(|pixels| pixels * meters / 2.0);
    let frame = Frame { middle: Vec3::Z * middle, azimuth: azimuth as f32, half: whole, pixels: cell };
    let towards = right.cross(Vec3::Z);
    let turn = |normal: Vec3| vec3(normal.dot(right), normal.z, normal.dot(towards));
    let corner = |x: f32, z: f32| right * (x * half[0]) + Vec3::Z * (middle + z * half[1]);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let [u, v] = [half[0] / whole[0] / 2.0, half[1] / whole[1] / 2.0];
    (Card { corners, uv: [0.5 - u, 0.5 - v, 0.5 + u, 0.5 + v] }, preview.flat(&frame, turn))
}
