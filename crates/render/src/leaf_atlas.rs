//! Sheets with pictures of leaves and of blossoms: each shape of a tree in the forms of a [`pleach_mesh::Atlas`], which
//! differ in colour and a little in shape.
//!
//! A cell is filled by the rectangle around its form: u across, v from the tip (0) to the base (1) of a leaf; a blossom
//! is seen from above. What lies outside the outline is transparent and goes on as inside for some pixels, so that
//! filtered edges are not dark.

use crate::blade::{Blade, Look};
use crate::cutoff::cut_out;
use crate::petals;
use crate::picture::{Picture, Relief};
use crate::srgb;
use glam::{Vec2, Vec3, vec2, vec3};
use pleach_mesh::atlas::{Form, bounds, spread};
use pleach_mesh::palette::linear;
use pleach_mesh::twigs::MARGIN;
use pleach_mesh::{Atlas, Material, Palette, Pictures};
use pleach_plant::{Color, Tree};
use rayon::prelude::*;

/// Samples per pixel, across and down.
const SAMPLES: usize = 4;

/// A cell that is to be painted.
struct Cell<'a> {
    /// What is opaque, as closed outlines.
    outlines: Vec<Vec<[f32; 2]>>,
    look: Box<dyn Fn(Vec2) -> Look + Sync + Send + 'a>,
}

/// What a cell shows, pixel by pixel.
struct Painted {
    /// Near the outlines; 0 elsewhere.
    light: Vec<Vec3>,
    /// 0 to 1.
    opacity: Vec<f32>,
    /// Whether a pixel is near an outline or inside.
    near: Vec<bool>,
    /// Directions, where relief was asked for.
    normals: Vec<[u8; 3]>,
}

impl Painted {
    /// Sums of light and of opacity over what is opaque.
    fn sum(&self) -> (Vec3, f32) {
        let all = self.light.iter().zip(&self.opacity);
        all.fold((Vec3::ZERO, 0.0), |(light, opacity), (l, o)| (light + *l * *o, opacity + o))
    }
}

/// The sheets of `tree` in the colours of `palette`: of its leaves, if it has any, and of its blossoms. The longer side
/// has `side` pixels; `relief` says whether there are pictures of normals.
///
/// ```
/// use pleach_mesh::{Material, Palette};
/// use pleach_render::picture::Relief;
///
/// let species = pleach_generators::species("acer")?;
/// let tree = species.grow(1)?;
/// let palette = Palette::new(&species.appearance, None);
/// let sheets = pleach_render::leaf_atlas::paint(&tree, &palette, 512, Relief::Painted);
/// assert_eq!((sheets[0].material, sheets[0].color.width), (Material::Leaf, 512));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn paint(tree: &Tree, palette: &Palette, side: u32, relief: Relief) -> Vec<Pictures<Picture>> {
    let mut sheets = Vec::new();
    if !tree.leaves.is_empty() {
        let blades: Vec<Blade> = tree.leaf_shapes.iter().map(|shape| Blade::new(shape)).collect();
        let cell = |shape: usize, number: usize| {
            let (blade, form, tint) = (&blades[shape], Form::new(number), tint(number));
            let look = move |point: Vec2| {
                let look = blade.look(form.origin(point.into()).into());
                Look { light: look.light * tint, ..look }
            };
            Cell { outlines: vec![form.outline(tree.leaf_shapes[shape].corners())], look: Box::new(look) }
        };
        let of = Sheet { shapes: tree.leaf_shapes.len(), color: palette.leaf, side, relief };
        sheets.push(of.paint(Material::Leaf, cell));
    }
    if !tree.blossoms.is_empty() {
        let cell = |shape: usize, number: usize| {
            let shape = tree.blossom_shapes[shape];
            let tint = Vec3::splat(1.0 + 0.1 * spread(number, 0.618_034))
                * (Vec3::ONE + vec3(0.0, -0.08, -0.05) * (1.0 + spread(number, 0.754_878)));
            let look = move |point: Vec2| {
                let look = petals::look(point);
                Look { light: look.light * tint, ..look }
            };
            Cell { outlines: petals::outlines(shape), look: Box::new(look) }
        };
        let of = Sheet { shapes: tree.blossom_shapes.len(), color: palette.blossom, side, relief };
        sheets.push(of.paint(Material::Blossom, cell));
    }
    sheets
}

/// The same for leaves that are triangles: nothing is cut out, and files are smaller.
#[must_use]
pub fn opaque(mut sheet: Pictures<Picture>) -> Pictures<Picture> {
    sheet.color.rgba.chunks_exact_mut(4).for_each(|pixel| pixel[3] = 255);
    Pictures { cutoff: None, ..sheet }
}

/// How much lighter and warmer the leaves of a form are than the mean.
fn tint(form: usize) -> Vec3 {
    let (light, warmth) = (spread(form, 0.618_034), spread(form, 0.754_878));
    (Vec3::ONE + vec3(0.15, 0.01, -0.1) * warmth) * (1.0 + 0.17 * light)
}

struct Sheet {
    shapes: usize,
    color: Color,
    side: u32,
    relief: Relief,
}

impl Sheet {
    fn paint<'a>(
        &self,
        material: Material,
        cell: impl Fn(usize, usize) -> Cell<'a> + Sync,
    ) -> Pictures<Picture> {
        let atlas = Atlas::new(self.shapes);
        let (columns, rows) = (atlas.sheet.columns, atlas.sheet.rows);
        let pixels = (self.side / columns.max(rows)).max(4);
        let cells: Vec<Painted> = (0..self.shapes * atlas.forms)
            .into_par_iter()
            .map(|i| painted(&cell(i / atlas.forms, i % atlas.forms), pixels as usize, self.relief))
            .collect();
        // The leaves have the palette's colour in the mean.
        let sums: Vec<(Vec3, f32)> = cells.iter().map(Painted::sum).collect();
        let (light, weight) = sums.iter().fold((Vec3::ZERO, 0.0), |(l, w), sum| (l + sum.0, w + sum.1));
        let base = Vec3::from(linear(self.color)) * weight / light.max(Vec3::splat(1e-6));
        let mut color = Picture::transparent(columns * pixels, rows * pixels);
        let mut normal = (self.relief == Relief::Painted).then(|| color.clone());
        for (number, (cell, (light, weight))) in (0..).zip(cells.iter().zip(sums)) {
            let (x, y) = (number % columns * pixels, number / columns * pixels);
            let place = |rgba| Picture { width: pixels, height: pixels, rgba };
            // Far from the leaf is its own mean, for small pictures of the sheet.
            let mean = light / weight.max(1e-6);
            let pixel = |i: usize| {
                let light = if cell.near[i] { cell.light[i] } else { mean };
                let [r, g, b] = (base * light).to_array().map(srgb::encode);
                [r, g, b, (cell.opacity[i] * 255.0).round() as u8]
            };
            color.paste(&place((0..cell.opacity.len()).flat_map(pixel).collect()), x, y);
            if let Some(normal) = &mut normal {
                let opaque = |&[x, y, z]: &[u8; 3]| [x, y, z, 255];
                normal.paste(&place(cell.normals.iter().flat_map(opaque).collect()), x, y);
            }
        }
        let size = [color.width, color.height];
        let shown = cut_out(&mut color, size);
        Pictures { normal, ..Pictures::cut_out(material, color, shown) }
    }
}

fn painted(cell: &Cell<'_>, pixels: usize, relief: Relief) -> Painted {
    let [left, bottom, right, top] = bounds(&cell.outlines.concat());
    let size = vec2(right - left, top - bottom).max(Vec2::splat(1e-6));
    // From pixels to the shape.
    let step = size / ((1.0 - 2.0 * MARGIN) * pixels as f32);
    let corner = vec2(left, top) + vec2(-step.x, step.y) * (MARGIN * pixels as f32);
    let point = |x: f32, y: f32| corner + vec2(x * step.x, -y * step.y);
    let opacity = opacity(&cell.outlines, pixels, |row| point(0.0, row).y, |x| (x - corner.x) / step.x);
    let near = near(&opacity, pixels, pixels / 32 + 1);
    // One pixel more all around, for differences.
    let (wide, is_seen) = (pixels + 2, self::near(&opacity, pixels, pixels / 32 + 2));
    let look = |i: usize| {
        let (x, y) = ((i % wide).saturating_sub(1), (i / wide).saturating_sub(1));
        let (x, y) = (x.min(pixels - 1), y.min(pixels - 1));
        let seen = is_seen[y * pixels + x];
        let (x, y) = ((i % wide) as f32 - 0.5, (i / wide) as f32 - 0.5);
        if seen { (cell.look)(point(x, y)) } else { Look::default() }
    };
    let all: Vec<Look> = (0..wide * wide).map(look).collect();
    let inside = |i: usize| (i / pixels + 1) * wide + i % pixels + 1;
    let normal = |i: usize| {
        if !near[i] {
            return [128, 128, 255];
        }
        let at = inside(i);
        let across = (all[at + 1].height - all[at - 1].height) / (2.0 * step.x);
        let up = (all[at - wide].height - all[at + wide].height) / (2.0 * step.y);
        let direction = vec3(-across, -up, 1.0).normalize();
        direction.to_array().map(|part| (127.5 + 127.5 * part + 0.5) as u8)
    };
    let count = pixels * pixels;
    Painted {
        light: (0..count).map(|i| all[inside(i)].light).collect(),
        normals: if relief == Relief::Painted { (0..count).map(normal).collect() } else { Vec::new() },
        opacity,
        near,
    }
}

/// The part of each pixel that some outline covers. `height` is that of a row in the shape, and `column` where its x is
/// in pixels.
fn opacity(
    outlines: &[Vec<[f32; 2]>],
    pixels: usize,
    height: impl Fn(f32) -> f32,
    column: impl Fn(f32) -> f32,
) -> Vec<f32> {
    let mut opacity = vec![0.0; pixels * pixels];
    let mut covered = vec![false; pixels * SAMPLES];
    let mut crossings = Vec::new();
    for row in 0..pixels * SAMPLES {
        covered.fill(false);
        let y = height((row as f32 + 0.5) / SAMPLES as f32);
        for outline in outlines {
            crossings.clear();
            let next = outline.iter().cycle().skip(1);
            for (&[ax, ay], &[bx, by]) in outline.iter().zip(next) {
                if (ay > y) != (by > y) {
                    crossings.push(column(ax + (bx - ax) * (y - ay) / (by - ay)));
                }
            }
            crossings.sort_by(f32::total_cmp);
            for pair in crossings.chunks_exact(2) {
                let sample = |x: f32| ((x * SAMPLES as f32 + 0.5).max(0.0) as usize).min(covered.len());
                let (from, to) = (sample(pair[0]), sample(pair[1]));
                covered[from..to.max(from)].fill(true);
            }
        }
        let pixel = row / SAMPLES * pixels;
        for (i, _) in covered.iter().enumerate().filter(|(_, covered)| **covered) {
            opacity[pixel + i / SAMPLES] += 1.0 / (SAMPLES * SAMPLES) as f32;
        }
    }
    opacity
}

/// Whether a pixel has one that is not transparent within `reach`.
fn near(opacity: &[f32], pixels: usize, reach: usize) -> Vec<bool> {
    let row = |row: &[bool]| {
        let mut near = vec![false; pixels];
        for i in (0..pixels).filter(|&i| row[i]) {
            near[i.saturating_sub(reach)..(i + reach + 1).min(pixels)].fill(true);
        }
        near
    };
    let turned = |all: &[bool]| -> Vec<bool> {
        (0..pixels * pixels).map(|i| all[i % pixels * pixels + i / pixels]).collect()
    };
    let rows = |all: &[bool]| -> Vec<bool> { all.chunks(pixels).flat_map(row).collect() };
    let shown: Vec<bool> = opacity.iter().map(|opacity| *opacity > 0.0).collect();
    turned(&rows(&turned(&rows(&shown))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_plant::Leaf;
    use pleach_plant::leaf_shape::{BlossomShape, LeafShape};
    use std::sync::Arc;

    const GREEN: Color = Color([90, 140, 50]);
    const PINK: Color = Color([240, 200, 210]);

    fn sheets(leaf: LeafShape, blossom: BlossomShape, side: u32) -> Vec<Pictures<Picture>> {
        let one = Leaf { position: Vec3::ZERO, along: Vec3::Z, across: Vec3::X, stem: 0, shape: 0 };
        let tree = Tree {
            leaves: vec![one],
            blossoms: vec![one],
            leaf_shapes: vec![Arc::clone(leaf.outline())],
            blossom_shapes: vec![blossom],
            ..Tree::default()
        };
        let species = pleach_generators::preset("acer").unwrap();
        let palette = Palette { leaf: GREEN, blossom: PINK, ..Palette::new(&species.appearance, None) };
        paint(&tree, &palette, side, Relief::Painted)
    }

    /// The pixels of each of 16 cells.
    fn cells(picture: &Picture) -> Vec<Vec<[u8; 4]>> {
        let size = picture.width / 4;
        let pixel = |x: u32, y: u32| {
            let at = ((y * picture.width + x) * 4) as usize;
            std::array::from_fn(|c| picture.rgba[at + c])
        };
        let of = |cell: u32| {
            let (x, y) = (cell % 4 * size, cell / 4 * size);
            (0..size * size).map(|i| pixel(x + i % size, y + i / size)).collect()
        };
        (0..16).map(of).collect()
    }

    fn covered(cell: &[[u8; 4]]) -> f32 {
        cell.iter().map(|p| f32::from(p[3]) / 255.0).sum::<f32>() / cell.len() as f32
    }

    #[test]
    fn each_cell_covers_its_form_and_no_more() {
        for shape in LeafShape::ALL {
            let sheet = sheets(shape, BlossomShape::ALL[0], 512).remove(0);
            for (number, cell) in cells(&sheet.color).iter().enumerate() {
                let corners = Form::new(number).outline(shape.outline().corners());
                let [left, bottom, right, top] = bounds(&corners);
                let next = corners.iter().cycle().skip(1);
                let area =
                    corners.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f32>() / 2.0;
                let inner = (1.0 - 2.0 * MARGIN) * (1.0 - 2.0 * MARGIN);
                let wanted = area / ((right - left) * (top - bottom)) * inner;
                assert!(
                    (covered(cell) - wanted).abs() < 0.012,
                    "{shape:?} {number}: {} {wanted}",
                    covered(cell)
                );
            }
        }
    }

    #[test]
    fn leaves_differ_and_have_the_palettes_colour_in_the_mean() {
        let sheet = sheets(LeafShape::Maple, BlossomShape::ALL[0], 512).remove(0);
        let mean = |cells: &[Vec<[u8; 4]>]| {
            let (mut sum, mut weight) = ([0.0; 3], 0.0);
            for pixel in cells.iter().flatten() {
                let light = linear(Color([pixel[0], pixel[1], pixel[2]]));
                (0..3).for_each(|c| sum[c] += light[c] * f32::from(pixel[3]));
                weight += f32::from(pixel[3]);
            }
            sum.map(|s| s / weight)
        };
        let cells = cells(&sheet.color);
        for (found, wanted) in mean(&cells).into_iter().zip(linear(GREEN)) {
            assert!((found / wanted - 1.0).abs() < 0.03, "{found} {wanted}");
        }
        let greens: Vec<f32> = cells.iter().map(|cell| mean(std::slice::from_ref(cell))[1]).collect();
        let (least, most) =
            (greens.iter().copied().fold(1.0, f32::min), greens.iter().copied().fold(0.0, f32::max));
        assert!(most > 1.2 * least && most < 1.8 * least, "{greens:?}");
    }

    #[test]
    fn blossoms_have_petals_and_gaps_and_no_dark_edges() {
        for shape in BlossomShape::ALL {
            let sheet = sheets(LeafShape::Maple, shape, 512).remove(1);
            assert_eq!(sheet.material, Material::Blossom);
            for cell in cells(&sheet.color) {
                assert!((0.15..0.9).contains(&covered(&cell)), "{shape:?}: {}", covered(&cell));
                assert!(cell.iter().all(|p| p[0] > 130), "{shape:?}");
            }
        }
    }

    #[test]
    fn a_folded_blade_looks_to_both_sides() {
        let sheet = sheets(LeafShape::Elliptic, BlossomShape::ALL[0], 512).remove(0);
        let normal = sheet.normal.unwrap();
        let leaf = &cells(&normal)[0];
        let mean = |from: usize, to: usize| {
            let rows = (40..90).flat_map(|y| (from..to).map(move |x| y * 128 + x));
            rows.clone().map(|i| f64::from(leaf[i][0])).sum::<f64>() / rows.count() as f64
        };
        // The halves are folded up, so that each looks towards the other.
        let (left, right) = (mean(20, 60), mean(68, 108));
        assert!(left > 140.0 && right < 116.0, "{left} {right}");
        assert!(leaf.iter().all(|p| p[2] > 128), "nothing looks down");
    }
}
