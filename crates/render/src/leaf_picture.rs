//! Pictures of one leaf and of one blossom, for the cards of [`pleach_mesh::LeafStyle::CrossedCards`].
//!
//! They fill the card's texture coordinates: u across, v from the tip (0) to the base (1) of a leaf;
//! a blossom is seen from above. Pixels outside are transparent and have the leaf's colour, so that
//! filtered edges are not dark.

use crate::picture::Picture;
use pleach_mesh::{Material, Palette, blossom_spread};
use pleach_plant::Color;
use pleach_plant::Tree;
use pleach_plant::leaf_shape::{BlossomShape, Outline};

/// Height and width in pixels.
const SIDE: u32 = 128;
/// Samples per pixel, across and down.
const SAMPLES: u32 = 4;

type Point = [f32; 2];

/// The pictures that the cards of `tree` show.
#[must_use]
pub fn leaf_pictures(tree: &Tree, palette: &Palette) -> Vec<(Material, Picture)> {
    let leaves = tree.leaf_shapes.iter().map(|shape| (Material::Leaf, leaf(shape, palette.leaf)));
    let blossoms =
        tree.blossom_shapes.iter().map(|&shape| (Material::Blossom, blossom(shape, palette.blossom)));
    leaves.chain(blossoms).collect()
}

/// A leaf of this shape and colour, with its midrib and veins.
#[must_use]
pub fn leaf(shape: &Outline, color: Color) -> Picture {
    let outline = shape.corners();
    let widest = outline.iter().map(|p| p[0].abs()).fold(f32::MIN_POSITIVE, f32::max);
    let blade: Vec<Point> = outline.iter().map(|p| [0.5 + 0.5 * p[0] / widest, 1.0 - p[1]]).collect();
    // Needles have no visible side veins.
    let veins = if widest > 0.1 { 7.0 } else { 0.0 };
    draw(&[blade], |u, v| leaf_shade(u, v, veins), color)
}

/// A blossom of this shape and colour from above, darker towards its heart.
#[must_use]
pub fn blossom(shape: BlossomShape, color: Color) -> Picture {
    let faces = shape.faces();
    let reach = blossom_spread(shape).0;
    let at = |i: &u8| {
        let [x, _, z] = faces.vertices[usize::from(*i)];
        [0.5 + 0.5 * x / reach, 0.5 + 0.5 * z / reach]
    };
    let petals: Vec<Vec<Point>> = faces.polygons.iter().map(|p| p.iter().map(at).collect()).collect();
    let shade = |u: f32, v: f32| 0.78 + 0.3 * ((u - 0.5).hypot(v - 0.5) * 2.0).min(1.0);
    draw(&petals, shade, color)
}

/// Lighter ribs, each with a darker side, that leave the middle at an acute angle.
fn leaf_shade(u: f32, v: f32, veins: f32) -> f32 {
    let ridge = |distance: f32, width: f32| (1.0 - distance / width).clamp(0.0, 1.0);
    let across = (u - 0.5).abs();
    let mut shade = 0.94 + 0.28 * ridge(across, 0.03);
    if veins > 0.0 {
        let place = (v + across * 0.9) * veins;
        let distance = (place - place.round()).abs() / veins;
        shade += (0.14 * ridge(distance, 0.02) - 0.07 * ridge((distance - 0.035).abs(), 0.03))
            * (1.0 - 1.6 * across).max(0.0);
    }
    shade
}

fn draw(polygons: &[Vec<Point>], shade: impl Fn(f32, f32) -> f32, Color(color): Color) -> Picture {
    let mut rgba = Vec::with_capacity((SIDE * SIDE * 4) as usize);
    for (y, x) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (y, x))) {
        let sample = |i: u32| (i as f32 + 0.5) / (SIDE * SAMPLES) as f32;
        let covered = (0..SAMPLES * SAMPLES)
            .filter(|i| {
                let p = [sample(x * SAMPLES + i % SAMPLES), sample(y * SAMPLES + i / SAMPLES)];
                polygons.iter().any(|polygon| inside(polygon, p))
            })
            .count();
        let middle = |i: u32| (i as f32 + 0.5) / SIDE as f32;
        let light = if covered > 0 { shade(middle(x), middle(y)) } else { 1.0 };
        rgba.extend(color.map(|c| (f32::from(c) * light).round().clamp(0.0, 255.0) as u8));
        rgba.push((covered as u32 * 255 / (SAMPLES * SAMPLES)) as u8);
    }
    Picture { width: SIDE, height: SIDE, rgba }
}

/// Whether a ray to the right from `p` leaves the polygon an odd number of times.
fn inside(polygon: &[Point], p: Point) -> bool {
    let mut inside = false;
    for (i, &[bx, by]) in polygon.iter().enumerate() {
        let [ax, ay] = polygon[(i + polygon.len() - 1) % polygon.len()];
        if (ay > p[1]) != (by > p[1]) && p[0] < ax + (bx - ax) * (p[1] - ay) / (by - ay) {
            inside = !inside;
        }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_plant::leaf_shape::LeafShape;

    const GREEN: Color = Color([90, 140, 50]);

    fn covered(picture: &Picture) -> f32 {
        let alpha: u64 = picture.rgba.chunks_exact(4).map(|p| u64::from(p[3])).sum();
        alpha as f32 / 255.0 / (SIDE * SIDE) as f32
    }

    #[test]
    fn a_picture_covers_the_leaf_and_no_more() {
        for shape in LeafShape::ALL {
            let outline = shape.outline();
            let picture = leaf(outline, GREEN);
            let wanted = outline.area() / outline.width();
            assert!((covered(&picture) - wanted).abs() < 0.01, "{shape:?}: {} {wanted}", covered(&picture));
        }
    }

    #[test]
    fn blossoms_have_petals_and_gaps_and_no_dark_edges() {
        for shape in BlossomShape::ALL {
            let picture = blossom(shape, Color([240, 200, 210]));
            assert!((0.15..0.9).contains(&covered(&picture)), "{shape:?}: {}", covered(&picture));
            assert!(picture.rgba.chunks_exact(4).all(|p| p[0] > 170), "{shape:?}");
        }
    }
}
