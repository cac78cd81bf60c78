//! Leaves and blossoms as triangles: unit shapes carried to their places.

mod ear;

use crate::atlas::{Form, bounds};
use crate::block::{Block, Vertex};
use crate::part::Count;
use crate::settings::LeafStyle;
use glam::{Vec2, Vec3, vec3};
use pleach_plant::Leaf;
use pleach_plant::leaf_shape::{BlossomShape, Outline};

/// A unit shape as triangles, in the coordinates of [`pleach_plant::Leaf`].
#[derive(Clone, Debug, Default)]
pub(crate) struct UnitMesh {
    corners: Vec<Corner>,
    triangles: Vec<[u32; 3]>,
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    at: Vec3,
    normal: Vec3,
    uv: [f32; 2],
}

impl UnitMesh {
    /// The leaf in this style.
    pub(crate) fn leaf(shape: &Outline, style: LeafStyle) -> Self {
        match style {
            LeafStyle::Outline => Self::flat(shape.corners()),
            LeafStyle::Reduced => Self::flat(&reduced(shape)),
            LeafStyle::Simple => Self::flat(&simple(shape)),
            LeafStyle::Card => Self::flat(&rectangle(bounds(shape.corners()))),
            LeafStyle::CrossedCards => Self::crossed(shape.width()),
            LeafStyle::None => Self::default(),
        }
    }

    /// The leaf in this style and form; its texture coordinates fill the rectangle around that form.
    pub(crate) fn leaf_in_form(shape: &Outline, style: LeafStyle, form: Form) -> Self {
        let outline = form.outline(shape.corners());
        let around = bounds(&outline);
        let mut mesh = match style {
            LeafStyle::Outline => Self::flat(&outline),
            LeafStyle::Reduced => Self::flat(&form.outline(&reduced(shape))),
            LeafStyle::Simple => Self::flat(&form.outline(&simple(shape))),
            LeafStyle::Card => Self::flat(&rectangle(around)),
            LeafStyle::CrossedCards => Self::crossed_around(around),
            LeafStyle::None => Self::default(),
        };
        let [left, bottom, right, top] = around;
        let part = |x: f32, low: f32, high: f32| ((x - low) / (high - low)).clamp(0.0, 1.0);
        for corner in &mut mesh.corners {
            // A card that stands across the blade shows what is as far from the midrib.
            let across = corner.at.x + corner.at.z;
            corner.uv = [part(across, left, right), 1.0 - part(corner.at.y, bottom, top)];
        }
        mesh
    }

    /// The same with texture coordinates in a part of a picture, of which `cell` gives left, top, right and bottom.
    pub(crate) fn in_cell(mut self, [left, top, right, bottom]: [f32; 4]) -> Self {
        for Corner { uv: [u, v], .. } in &mut self.corners {
            (*u, *v) = (left + (right - left) * *u, top + (bottom - top) * *v);
        }
        self
    }

    /// The blossom in this style.
    pub(crate) fn blossom(shape: BlossomShape, style: LeafStyle) -> Self {
        match style {
            LeafStyle::Outline | LeafStyle::Reduced => Self::petals(shape),
            LeafStyle::Simple => Self::pyramid(shape),
            LeafStyle::Card | LeafStyle::CrossedCards => Self::level_card(shape),
            LeafStyle::None => Self::default(),
        }
    }

    pub(crate) fn count(&self) -> Count {
        Count { vertices: self.corners.len() as u64, triangles: self.triangles.len() as u64 }
    }

    /// Appends the shape at `leaf`; its corners count from `base`.
    pub(crate) fn push(&self, leaf: &Leaf, base: u32, block: &mut Block) {
        let up = leaf.normal();
        let unit = |v: Vec3| v.normalize_or_zero();
        let (x, y, z) = (unit(leaf.across), unit(leaf.along), unit(up));
        for corner in &self.corners {
            let position =
                leaf.position + leaf.across * corner.at.x + leaf.along * corner.at.y + up * corner.at.z;
            let normal = x * corner.normal.x + y * corner.normal.y + z * corner.normal.z;
            block.vertices.push(Vertex { position, normal, uv: Vec2::from(corner.uv) });
        }
        block.triangles.extend(self.triangles.iter().map(|t| t.map(|i| base + i)));
    }

    fn flat(outline: &[[f32; 2]]) -> Self {
        let widest = outline.iter().map(|p| p[0].abs()).fold(f32::MIN_POSITIVE, f32::max);
        let corners = outline
            .iter()
            .map(|p| Corner {
                at: vec3(p[0], p[1], 0.0),
                normal: Vec3::Z,
                uv: [0.5 + 0.5 * p[0] / widest, 1.0 - p[1]],
            })
            .collect();
        Self { corners, triangles: ear::triangulate(outline) }
    }

    /// Two cards through the middle of the blade, at right angles to each other.
    fn crossed(width: f32) -> Self {
        Self::crossed_around([-width / 2.0, 0.0, width / 2.0, 1.0])
    }

    /// The same of a blade within left, bottom, right and top.
    fn crossed_around([left, bottom, right, top]: [f32; 4]) -> Self {
        let card = |axis: Vec3, normal: Vec3| {
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(s, t): (f32, f32)| Corner {
                at: axis * (left + (right - left) * s) + Vec3::Y * (bottom + (top - bottom) * t),
                normal,
                uv: [s, 1.0 - t],
            })
        };
        let corners = [card(Vec3::X, Vec3::Z), card(Vec3::Z, -Vec3::X)].concat();
        Self { corners, triangles: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]] }
    }

    /// One card across the middle of a rectangle, which shows the part of a picture between the left, top, right and
    /// bottom that `cell` gives.
    pub(crate) fn card(cell: [f32; 4]) -> Self {
        let [left, top, right, bottom] = cell;
        let corners = [
            (-0.5, 0.0, left, bottom),
            (0.5, 0.0, right, bottom),
            (0.5, 1.0, right, top),
            (-0.5, 1.0, left, top),
        ];
        let corners = corners.map(|(x, y, u, v)| Corner { at: vec3(x, y, 0.0), normal: Vec3::Z, uv: [u, v] });
        Self { corners: corners.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    /// One card across the blossom's axis, which shows it from above.
    fn level_card(shape: BlossomShape) -> Self {
        let (reach, high) = blossom_spread(shape);
        let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z): (f32, f32)| Corner {
            at: vec3(x * reach, 0.5 * high, z * reach),
            normal: Vec3::Y,
            uv: [0.5 + 0.5 * x, 0.5 + 0.5 * z],
        });
        Self { corners: corners.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    fn petals(shape: BlossomShape) -> Self {
        let faces = shape.faces();
        let at = |i: u8| Vec3::from(faces.vertices[usize::from(i)]);
        let mut normals = vec![Vec3::ZERO; faces.vertices.len()];
        let mut triangles = Vec::new();
        for polygon in faces.polygons {
            for pair in polygon[1..].windows(2) {
                let [a, b, c] = [polygon[0], pair[0], pair[1]];
                let normal = (at(b) - at(a)).cross(at(c) - at(a));
                for i in [a, b, c] {
                    normals[usize::from(i)] += normal;
                }
                triangles.push([a, b, c].map(u32::from));
            }
        }
        let widest = blossom_spread(shape).0;
        let corners = faces
            .vertices
            .iter()
            .zip(normals)
            .map(|(&[u, v, w], normal)| Corner {
                at: vec3(u, v, w),
                normal: normal.try_normalize().unwrap_or(Vec3::Y),
                uv: [0.5 + 0.5 * u / widest, 0.5 + 0.5 * w / widest],
            })
            .collect();
        Self { corners, triangles }
    }

    /// Four triangles that open from the stalk, as wide and high as the blossom.
    fn pyramid(shape: BlossomShape) -> Self {
        let (reach, high) = blossom_spread(shape);
        let rim = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        let mut corners = vec![Corner { at: Vec3::ZERO, normal: Vec3::Y, uv: [0.5, 0.5] }];
        corners.extend(rim.map(|(x, z): (f32, f32)| Corner {
            at: vec3(x * reach, high, z * reach),
            normal: vec3(-x * high, reach, -z * high).normalize_or_zero(),
            uv: [0.5 + 0.5 * x, 0.5 + 0.5 * z],
        }));
        Self { corners, triangles: vec![[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]] }
    }
}

/// The corners of a rectangle between left, bottom, right and top, counter-clockwise.
fn rectangle([left, bottom, right, top]: [f32; 4]) -> Vec<[f32; 2]> {
    vec![[left, bottom], [right, bottom], [right, top], [left, top]]
}

/// How far a unit blossom reaches from its axis, and how high it is.
#[must_use]
pub fn blossom_spread(shape: BlossomShape) -> (f32, f32) {
    let vertices = shape.faces().vertices;
    let reach = vertices.iter().flat_map(|v| [v[0].abs(), v[2].abs()]).fold(f32::MIN_POSITIVE, f32::max);
    (reach, vertices.iter().map(|v| v[1]).fold(0.0, f32::max))
}

/// The outline with at most three corners on each side, five where there are lobes: those are left out
/// first that change it least (Visvalingam and Whyatt 1993). What that takes from the area, or adds,
/// the width gives back.
fn reduced(shape: &Outline) -> Vec<[f32; 2]> {
    // Lobes need a few more than plain blades.
    let corners = if shape.area() < 0.5 * shape.width() { 6 } else { 4 };
    let mut outline = match shape.half() {
        Some(half) => reduced_half(half, corners),
        None => reduced_closed(shape.corners(), 2 * (corners - 1)),
    };
    let next = outline.iter().cycle().skip(1);
    let area = outline.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f32>() / 2.0;
    let wider = shape.area() / area;
    outline.iter_mut().for_each(|p| p[0] *= wider);
    outline
}

fn twice_area(a: [f32; 2], b: [f32; 2], c: [f32; 2]) -> f32 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}

/// An outline whose halves mirror each other, from its right half, reduced to `corners`.
fn reduced_half(half: &[[f32; 2]], corners: usize) -> Vec<[f32; 2]> {
    let mut half = half.to_vec();
    // Stalks are too thin to be seen from where this is used.
    half[0][0] = if half.len() > corners { 0.0 } else { half[0][0] };
    while half.len() > corners {
        let cost = |i: &usize| twice_area(half[i - 1], half[*i], half[i + 1]);
        let least = (1..half.len() - 1).min_by(|i, j| cost(i).total_cmp(&cost(j)));
        half.remove(least.unwrap_or(1));
    }
    let left = half.iter().rev().filter(|p| p[0] > 0.0).map(|p| [-p[0], p[1]]);
    half.iter().copied().chain(left).collect()
}

/// Any closed outline reduced to `corners`.
fn reduced_closed(outline: &[[f32; 2]], corners: usize) -> Vec<[f32; 2]> {
    let mut outline = outline.to_vec();
    while outline.len() > corners {
        let n = outline.len();
        let cost = |i: &usize| twice_area(outline[(i + n - 1) % n], outline[*i], outline[(i + 1) % n]);
        let least = (0..n).min_by(|i, j| cost(i).total_cmp(&cost(j)));
        outline.remove(least.unwrap_or(0));
    }
    outline
}

/// Four corners (three where there are no more) with the area and, nearly, the place of the leaf's
/// outline: a rectangle for blades that fill theirs, a kite for all others.
fn simple(shape: &Outline) -> Vec<[f32; 2]> {
    let (area, width) = (shape.area(), shape.width());
    let corners = shape.corners();
    if corners.len() == 3 {
        return corners.to_vec();
    }
    let ends = || corners.iter().map(|p| p[1]);
    let (low, high) = (ends().fold(f32::INFINITY, f32::min), ends().fold(f32::NEG_INFINITY, f32::max));
    let length = high - low;
    if area > 0.75 * width * length {
        let half = area / (2.0 * length);
        return vec![[half, low], [half, high], [-half, high], [-half, low]];
    }
    // The kite is widest where half of the leaf's area lies below.
    let middle = match shape.half() {
        Some(half) => {
            half.windows(2)
                .map(|w| (w[1][1] - w[0][1]) * (w[0][0] + w[1][0]) * (w[0][1] + w[1][1]) / 2.0)
                .sum::<f32>()
                / area
        }
        None => centroid_height(corners, area),
    };
    let half = area / length;
    vec![[0.0, low], [half, middle], [0.0, high], [-half, middle]]
}

/// Height of the centroid of a closed outline.
fn centroid_height(corners: &[[f32; 2]], area: f32) -> f32 {
    let next = corners.iter().cycle().skip(1);
    let moment = |(p, q): (&[f32; 2], &[f32; 2])| (p[1] + q[1]) * (p[0] * q[1] - q[0] * p[1]);
    corners.iter().zip(next).map(moment).sum::<f32>() / (6.0 * area)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_plant::leaf_shape::LeafShape;

    fn area(mesh: &UnitMesh) -> f32 {
        let corner = |i: u32| mesh.corners[i as usize].at;
        let cross = |t: &[u32; 3]| (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]));
        mesh.triangles.iter().map(|t| cross(t).length() / 2.0).sum()
    }

    #[test]
    fn simpler_leaves_keep_the_area() {
        let lopsided = [[0.0, 0.0], [0.4, 0.1], [0.1, 0.3], [0.3, 0.6], [0.0, 1.0], [-0.1, 0.8], [-0.2, 0.2]];
        let lopsided = Outline::new("lopsided", lopsided.to_vec()).unwrap();
        let known = LeafShape::ALL.into_iter().map(|shape| shape.outline().as_ref());
        for shape in known.chain([&lopsided]) {
            let name = shape.name();
            for (style, most) in [(LeafStyle::Reduced, 9), (LeafStyle::Simple, 2)] {
                let mesh = UnitMesh::leaf(shape, style);
                assert!((area(&mesh) - shape.area()).abs() < 1e-5, "{name} {style:?}");
                assert!(mesh.triangles.len() <= most, "{name} {style:?}");
            }
        }
    }

    #[test]
    fn texture_coordinates_fill_the_unit_square() {
        let all = LeafShape::ALL.into_iter().map(|s| UnitMesh::leaf(s.outline(), LeafStyle::Outline));
        let blossoms = BlossomShape::ALL.into_iter().map(|s| UnitMesh::blossom(s, LeafStyle::Outline));
        for mesh in all.chain(blossoms) {
            for corner in &mesh.corners {
                assert!(corner.uv.iter().all(|c| (-1e-6..=1.0 + 1e-6).contains(c)), "{:?}", corner.uv);
                assert!((corner.normal.length() - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn a_blossom_keeps_its_faces() {
        for shape in BlossomShape::ALL {
            let mesh = UnitMesh::blossom(shape, LeafStyle::Outline);
            assert!((area(&mesh) - shape.faces().area()).abs() < 1e-4, "{shape:?}");
        }
    }

    #[test]
    fn a_leaf_stands_where_the_tree_says() {
        let (along, across) = (Vec3::Z * 2.0, Vec3::X * 3.0);
        let leaf = Leaf { position: vec3(1.0, 2.0, 3.0), along, across, stem: 0, shape: 0 };
        let mut block = Block::default();
        UnitMesh::leaf(LeafShape::Rectangle.outline(), LeafStyle::Outline).push(&leaf, 10, &mut block);
        let corners: Vec<Vec3> = block.vertices.iter().map(|v| v.position).collect();
        assert!(corners.contains(&vec3(2.5, 2.0, 5.0)) && corners.contains(&vec3(-0.5, 2.0, 3.0)));
        assert_eq!(block.vertices[0].normal, vec3(0.0, -1.0, 0.0));
        assert!(block.triangles.iter().flatten().all(|i| (10..14).contains(i)));
    }
}
