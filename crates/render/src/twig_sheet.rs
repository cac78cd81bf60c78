//! The picture that cards of twigs show: a few of the tree's own twigs, each stretched over a cell.
//!
//! The pictures hold the twigs' own colours, without sun, since the engine lights them again.

use crate::cutoff::cut_out;
use crate::picture::Picture;
use crate::preview::{Foliage, Frame, Preview};
use glam::{DVec3, Vec3};
use pleach_mesh::twigs::{MARGIN, Sheet};
use pleach_mesh::{Material, Palette, Pictures, TwigModel, Twigs};
use pleach_plant::{Knot, Leaf, Stem, StemKind, Tree};
use std::sync::Arc;

/// Width and height of a cell in pixels.
const CELL: u32 = 256;

/// Paints the models of the levels of some trees, which share a sheet; see [`pleach_mesh::lod::painted`]. There is no
/// picture of normals: with it, and the tangents that it needs, a tree of 50,000 triangles has a third more bytes.
///
/// ```
/// use pleach_mesh::{MeshSettings, Palette, lod};
///
/// let species = pleach_generators::species("quaking_aspen")?;
/// let tree = species.grow(1)?;
/// let levels = lod::budgets(&[&tree], MeshSettings::default(), &[8_000, 2_000])?;
/// let palette = Palette::new(&species.appearance, None);
/// let sheet = pleach_render::twig_sheet::paint(&palette, lod::painted(&[&tree], &levels));
/// let picture = sheet.color;
/// assert!(picture.width.is_power_of_two() && picture.height.is_power_of_two());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn paint<'a>(
    palette: &Palette,
    levels: impl IntoIterator<Item = (&'a Tree, &'a Twigs)>,
) -> Pictures<Picture> {
    let mut color = Picture::transparent(1, 1);
    let mut foliage: Option<Arc<Foliage>> = None;
    for (tree, twigs) in levels {
        let foliage = foliage.get_or_insert_with(|| Arc::new(Foliage::new(tree, palette, CELL as f32 / 2.0)));
        let Sheet { columns, rows } = twigs.sheet;
        let (width, height) = (columns * CELL, rows * CELL);
        if color.width == 1 {
            color = Picture::transparent(width, height);
        }
        for (cell, model) in (twigs.first_cell as u32..).zip(&twigs.models) {
            let (x, y) = (cell % columns * CELL, cell / columns * CELL);
            color.paste(&twig(tree, palette, model, foliage), x, y);
        }
    }
    color.bleed();
    let shown = cut_out(&mut color, [CELL; 2]);
    Pictures::cut_out(Material::Twig, color, shown)
}

/// One twig, stretched so that its card fills a cell but for the margin.
fn twig(tree: &Tree, palette: &Palette, model: &TwigModel, foliage: &Arc<Foliage>) -> Picture {
    let stretched = stretched(tree, model);
    let half = 0.5 / (1.0 - 2.0 * MARGIN);
    let frame = Frame { middle: Vec3::Z * 0.5, azimuth: 0.0, half: [half; 2], pixels: [CELL; 2] };
    let mut picture = Preview::of_twig(&stretched, palette, CELL, Arc::clone(foliage)).colors(&frame);
    keep_coverage(&mut picture);
    picture
}

/// Alpha from which a pixel is surely shown: a little more than what [`cut_out`] takes for shown.
const SHOWN: u32 = 105;

/// Scales alpha so that as many pixels are shown as are covered in all: needles and bare twigs that are thinner than a
/// pixel would be cut out, since no pixel is covered enough.
fn keep_coverage(picture: &mut Picture) {
    let mut counts = [0_u64; 256];
    picture.rgba.chunks_exact(4).for_each(|pixel| counts[usize::from(pixel[3])] += 1);
    let covered = (0_u64..).zip(counts).map(|(alpha, count)| alpha * count).sum::<u64>() / 255;
    let mut shown = 0;
    let least = (1..=255_u32).rev().find(|alpha| {
        shown += counts[*alpha as usize];
        shown >= covered
    });
    let Some(least) = least.filter(|_| covered > 0) else { return };
    for pixel in picture.rgba.chunks_exact_mut(4) {
        pixel[3] = (u32::from(pixel[3]) * SHOWN).div_ceil(least).min(255) as u8;
    }
}

/// The parts of `model`, moved so that its card is the unit square from x = −0.5 and z = 0, seen along y.
fn stretched(tree: &Tree, model: &TwigModel) -> Tree {
    let card = &model.card;
    let (width, height) = (card.across.length().max(1e-6), card.along.length().max(1e-6));
    let depth = (width * height).sqrt();
    // Seen along y, x is to the right and z up.
    let axes =
        [card.across / (width * width), card.normal() / (height * depth), card.along / (height * height)];
    let turn = |v: Vec3| Vec3::from(axes.map(|axis| axis.dot(v)));
    let place = |point: DVec3| turn((point - card.position.as_dvec3()).as_vec3()).as_dvec3();
    let leaf = |leaf: &Leaf| Leaf {
        position: place(leaf.position.as_dvec3()).as_vec3(),
        along: turn(leaf.along),
        across: turn(leaf.across),
        stem: 0,
        ..*leaf
    };
    let mut moved = Tree {
        leaves: model.leaves.iter().map(|&i| leaf(&tree.leaves[i as usize])).collect(),
        blossoms: model.blossoms.iter().map(|&i| leaf(&tree.blossoms[i as usize])).collect(),
        leaf_shapes: tree.leaf_shapes.clone(),
        blossom_shapes: tree.blossom_shapes.clone(),
        ..Tree::default()
    };
    for &i in &model.stems {
        let stem = &tree.stems[i as usize];
        let first_knot = moved.knots.len() as u32;
        moved.knots.extend(tree.knots_of(stem).iter().map(|knot| Knot {
            point: place(knot.point),
            handle_in: place(knot.handle_in),
            handle_out: place(knot.handle_out),
            radius: knot.radius / f64::from(width),
        }));
        moved.stems.push(Stem { parent: None, kind: StemKind::Trunk, offset: 0.0, first_knot, ..*stem });
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_mesh::{MeshSettings, lod};

    #[test]
    fn what_is_thinner_than_a_pixel_is_shown() {
        let mut picture = Picture::transparent(100, 100);
        // A tenth of the pixels is covered by a third, as by needles.
        picture.rgba.chunks_exact_mut(40).for_each(|pixels| pixels[3] = 85);
        picture.rgba[3] = 120;
        keep_coverage(&mut picture);
        let shown = picture.rgba.chunks_exact(4).filter(|pixel| u32::from(pixel[3]) >= SHOWN).count();
        assert!((330..=1000).contains(&shown), "{shown}");
        let mut whole = Picture::transparent(10, 10);
        whole.rgba.chunks_exact_mut(8).for_each(|pixels| pixels[3] = 255);
        keep_coverage(&mut whole);
        assert!(whole.rgba.chunks_exact(8).all(|pixels| pixels[3] >= 105 && pixels[7] == 0));
    }

    /// What is shown spans its cell but for what is too thin there: petals do not reach all of a blossom's rim, and the
    /// tips of twigs are thinner than a pixel.
    #[test]
    fn a_twig_fills_its_cell() {
        for name in ["quaking_aspen", "hill_cherry", "small_pine"] {
            let species = pleach_generators::preset(name).unwrap();
            let tree = species.grow(1).unwrap();
            let levels = lod::budgets(&[&tree], MeshSettings::default(), &[5_000]).unwrap();
            let twigs = levels[0][0].twigs.as_ref().unwrap();
            let palette = Palette::new(&species.appearance, None);
            let foliage = Arc::new(Foliage::new(&tree, &palette, 64.0));
            for model in &twigs.models {
                let picture = twig(&tree, &palette, model, &foliage);
                let shown: Vec<(u32, u32)> = (0..CELL * CELL)
                    .filter(|i| picture.rgba[(*i * 4 + 3) as usize] > 100)
                    .map(|i| (i % CELL, i / CELL))
                    .collect();
                assert!(shown.len() > 500, "{name}: {}", shown.len());
                for side in [|p: &(u32, u32)| p.0, |p: &(u32, u32)| p.1] {
                    let (low, high) =
                        (shown.iter().map(side).min().unwrap(), shown.iter().map(side).max().unwrap());
                    assert!(high - low >= CELL * 3 / 4, "{name}: {low} to {high}");
                }
            }
        }
    }
}
