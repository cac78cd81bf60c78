//! The surface of a grid with one vertex in each cell that it crosses (Gibson 1998, *Constrained
//! elastic surface nets*).
//!
//! Each edge of the grid from inside to outside is crossed by a quadrangle between the vertices of the
//! four cells around it. A vertex never leaves its cell, so that the quadrangle can be cut into two
//! triangles that both face along the edge: no face is turned inside out.

use super::ellipsoid::Union;
use super::grid::Grid;
use glam::{DVec3, dvec3, uvec3};

/// Vertices stay this part of a cell away from its sides.
const MARGIN: f64 = 0.08;
/// Crossings stay this part of an edge away from its ends.
const CROSSING_MARGIN: f64 = 0.05;
/// No vertex in this cell.
const NONE: u32 = u32::MAX;

/// A closed mesh; triangles are counter-clockwise seen from outside.
#[derive(Debug, Default)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The vertex of each cell, numbered as its lowest sample.
    numbers: Vec<u32>,
}

impl Mesh {
    /// Meshes `grid`, which was sampled from `union`.
    pub(crate) fn build(&mut self, grid: &Grid, union: &Union<'_>) {
        self.vertices.clear();
        self.triangles.clear();
        self.numbers.clear();
        self.numbers.resize(grid.inside.len(), NONE);
        for z in 0..grid.size.z - 1 {
            for y in 0..grid.size.y - 1 {
                for x in 0..grid.size.x - 1 {
                    let first = grid.index(uvec3(x, y, z));
                    let Some(within) = crossing(grid, first) else { continue };
                    let corner = dvec3(f64::from(x), f64::from(y), f64::from(z));
                    self.numbers[first] = self.vertices.len() as u32;
                    self.vertices.push(drawn_to_surface(grid, union, corner, within));
                }
            }
        }
        let strides = grid.strides();
        for index in 0..grid.inside.len() {
            // The last samples along a side are outside, and so are their neighbors across it.
            for (axis, stride) in strides.into_iter().enumerate() {
                let Some(&beyond) = grid.inside.get(index + stride) else { continue };
                if grid.inside[index] != beyond {
                    self.quad(grid, index, axis, beyond);
                }
            }
        }
    }

    /// The quadrangle around the grid's edge from sample `index` along `axis`, whose far end is inside
    /// or not.
    fn quad(&mut self, grid: &Grid, index: usize, axis: usize, is_beyond_inside: bool) {
        let strides = grid.strides();
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        // Counter-clockwise around the axis.
        let cells = [index - strides[b] - strides[c], index - strides[c], index, index - strides[b]];
        let corners = cells.map(|cell| self.numbers[cell]);
        let [p, q, r, s] = corners.map(|i| self.vertices[i as usize]);
        let area =
            |u: DVec3, v: DVec3, w: DVec3| (v[b] - u[b]) * (w[c] - u[c]) - (v[c] - u[c]) * (w[b] - u[b]);
        let along_first = area(p, q, r).min(area(p, r, s));
        let along_second = area(q, r, s).min(area(q, s, p));
        let is_first = if along_first > 0.0 && along_second > 0.0 {
            p.distance_squared(r) <= q.distance_squared(s)
        } else {
            along_first > along_second
        };
        let [i, j, k, l] = corners;
        let halves = if is_first { [[i, j, k], [i, k, l]] } else { [[j, k, l], [j, l, i]] };
        for [u, v, w] in halves {
            self.triangles.push(if is_beyond_inside { [u, w, v] } else { [u, v, w] });
        }
    }
}

/// The mean of where the surface crosses the edges of the cell at `first`, in parts of the cell; none
/// where it crosses none.
fn crossing(grid: &Grid, first: usize) -> Option<DVec3> {
    let strides = grid.strides();
    let corner =
        |c: usize| first + (c & 1) * strides[0] + (c >> 1 & 1) * strides[1] + (c >> 2 & 1) * strides[2];
    let corners: [usize; 8] = std::array::from_fn(corner);
    let inside = corners.map(|c| grid.inside[c]);
    if inside.iter().all(|i| *i == inside[0]) {
        return None;
    }
    // A sample that was put to the other side is not far beyond the surface.
    let forced = 0.25 * grid.cell;
    let distance = |c: usize| {
        let d = grid.distances[corners[c]];
        match (inside[c], d < 0.0) {
            (true, false) => -forced,
            (false, true) => forced,
            _ => d,
        }
    };
    let place = |c: usize| dvec3((c & 1) as f64, (c >> 1 & 1) as f64, (c >> 2 & 1) as f64);
    let (mut sum, mut count) = (DVec3::ZERO, 0.0);
    for (a, b) in EDGES {
        if inside[a] != inside[b] {
            let (from, to) = (distance(a), distance(b));
            let t = (from / (from - to)).clamp(CROSSING_MARGIN, 1.0 - CROSSING_MARGIN);
            sum += place(a).lerp(place(b), t);
            count += 1.0;
        }
    }
    Some(sum / count)
}

/// The vertex `within` the cell at `corner`, moved to the surface as far as the cell allows: chords cut
/// the curves of a coarse grid short.
fn drawn_to_surface(grid: &Grid, union: &Union<'_>, corner: DVec3, within: DVec3) -> DVec3 {
    let point = grid.at(corner + within);
    let distance = union.distance(point);
    let moved = point - union.outwards(point, 0.05 * grid.cell) * distance;
    let within = (moved - grid.low) / grid.cell - corner;
    grid.at(corner + within.clamp(DVec3::splat(MARGIN), DVec3::splat(1.0 - MARGIN)))
}

/// The edges of a cell by the bits x, y and z of their ends.
const EDGES: [(usize, usize); 12] =
    [(0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)];

#[cfg(test)]
mod tests {
    use super::super::Ellipsoid;
    use super::*;
    use glam::{DMat3, DQuat};
    use pleach_tree::Blob;
    use proptest::prelude::*;

    fn meshed(parts: &[Ellipsoid], fillet: f64, cell: f64) -> Mesh {
        let union = Union { parts, fillet };
        let (mut grid, mut mesh) = (Grid::default(), Mesh::default());
        grid.sample(&union, cell);
        mesh.build(&grid, &union);
        mesh
    }

    fn ball(center: DVec3, radius: f64) -> Ellipsoid {
        Ellipsoid::new(center, DVec3::splat(radius), DMat3::IDENTITY)
    }

    fn volume(mesh: &Mesh) -> f64 {
        let at = |i: u32| mesh.vertices[i as usize];
        mesh.triangles.iter().map(|t| at(t[0]).dot(at(t[1]).cross(at(t[2]))) / 6.0).sum()
    }

    /// Vertices less edges plus faces.
    fn euler(mesh: &Mesh) -> i64 {
        mesh.vertices.len() as i64 - mesh.triangles.len() as i64 / 2
    }

    #[test]
    fn a_ball_is_round_at_every_level_of_detail() {
        for (cell, low, high, off) in [(0.9, 24, 40, 0.3), (0.45, 80, 170, 0.1), (0.1, 1500, 3500, 0.005)] {
            let mesh = meshed(&[ball(dvec3(0.3, 0.2, 0.1), 1.0)], 0.15, cell);
            let count = mesh.vertices.len();
            assert!((low..=high).contains(&count), "{count} vertices with cells of {cell}");
            assert!(Blob::is_closed(&mesh.triangles) && euler(&mesh) == 2);
            let ratio = volume(&mesh) / (4.0 / 3.0 * std::f64::consts::PI);
            assert!((1.0 - off..1.0 + off).contains(&ratio), "{ratio} of the volume with cells of {cell}");
        }
    }

    #[test]
    fn balls_that_do_not_touch_are_joined() {
        let mesh = meshed(&[ball(DVec3::ZERO, 1.0), ball(dvec3(3.0, 2.0, -1.0), 0.7)], 0.1, 0.3);
        assert!(Blob::is_closed(&mesh.triangles));
        assert_eq!(euler(&mesh), 2, "one piece without handles");
    }

    #[test]
    fn a_ball_smaller_than_a_cell_is_closed() {
        let mesh = meshed(&[ball(dvec3(0.33, 0.21, 0.47), 1e-6)], 1e-7, 0.9);
        assert!(Blob::is_closed(&mesh.triangles) && volume(&mesh) > 0.0);
        assert_eq!(mesh.vertices.len(), 8);
    }

    fn ellipsoid() -> impl Strategy<Value = Ellipsoid> {
        let number = || -1.0_f64..1.0;
        (
            [number(), number(), number()],
            [0.05..1.0_f64, 0.05..1.0, 0.05..1.0],
            [number(), number(), number()],
        )
            .prop_map(|(center, radii, turn)| {
                let axes = DMat3::from_quat(DQuat::from_scaled_axis(DVec3::from(turn) * 3.0));
                Ellipsoid::new(DVec3::from(center) * 1.5, DVec3::from(radii), axes)
            })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]
        #[test]
        fn any_union_is_one_closed_surface_with_no_face_turned(
            parts in prop::collection::vec(ellipsoid(), 1..6),
            fillet in 0.01_f64..0.5,
            cell in 0.15_f64..1.2,
        ) {
            let union = Union { parts: &parts, fillet };
            let (mut grid, mut mesh) = (Grid::default(), Mesh::default());
            grid.sample(&union, cell);
            mesh.build(&grid, &union);
            prop_assert!(Blob::is_closed(&mesh.triangles));
            prop_assert!(volume(&mesh) > 0.0);
            prop_assert_eq!(pieces(&mesh), 1);
            // Two triangles around each edge of the grid, which both face along it.
            let mut halves = mesh.triangles.iter();
            let strides = grid.strides();
            for index in 0..grid.inside.len() {
                for (axis, stride) in strides.into_iter().enumerate() {
                    let Some(&beyond) = grid.inside.get(index + stride) else { continue };
                    if grid.inside[index] == beyond {
                        continue;
                    }
                    for t in halves.by_ref().take(2) {
                        let [a, b, c] = t.map(|i| mesh.vertices[i as usize]);
                        let along = (b - a).cross(c - a)[axis];
                        let outwards = if beyond { -along } else { along };
                        prop_assert!(outwards > 0.0);
                    }
                }
            }
        }
    }

    fn pieces(mesh: &Mesh) -> usize {
        let mut parent: Vec<usize> = (0..mesh.vertices.len()).collect();
        fn root(parent: &mut [usize], mut i: usize) -> usize {
            while parent[i] != i {
                parent[i] = parent[parent[i]];
                i = parent[i];
            }
            i
        }
        for t in &mesh.triangles {
            for k in 1..3 {
                let (a, b) = (root(&mut parent, t[0] as usize), root(&mut parent, t[k] as usize));
                parent[a] = b;
            }
        }
        (0..parent.len()).filter(|&i| parent[i] == i).count()
    }
}
