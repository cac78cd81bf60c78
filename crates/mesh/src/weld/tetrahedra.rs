//! The surface of a field by marching tetrahedra (Doi and Koide 1991).
//!
//! Each cell is cut into the six tetrahedra around its main diagonal (Freudenthal 1942), the same way
//! everywhere, so that neighbours share their faces. A tetrahedron is crossed in a triangle or a
//! quadrangle, and there is nothing to choose: the surface has no holes and no edge with more than two
//! faces.

use super::field::{Field, place, unplace};
use glam::{DVec3, IVec3, Vec3, ivec3};

/// Corners stay this part of an edge away from its ends, so that no triangle shrinks to nothing.
const MARGIN: f32 = 0.02;

/// Each tetrahedron's way from corner 0 to corner 7 of the cell, by the bits x, y and z.
const WAYS: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// Corners and triangles, counter-clockwise from outside.
#[derive(Debug, Default)]
pub(super) struct Surface {
    pub(super) corners: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Surface {
    pub(super) fn new(field: &Field) -> Self {
        let mut edges = Vec::new();
        // No cell is longer than √3 cells, over which a distance with fillets changes by 1.4 times as much.
        let reach = (2.5 * field.cell) as f32;
        for (i, &start) in field.places.iter().enumerate() {
            if field.distances[i].abs() < reach {
                cross(field, i, unplace(start), &mut edges);
            }
        }
        let mut numbers: Vec<u64> = edges.concat();
        numbers.sort_unstable();
        numbers.dedup();
        let corners = numbers.iter().map(|&edge| corner(field, edge)).collect();
        let number = |edge: &u64| numbers.binary_search(edge).unwrap_or(0) as u32;
        let triangles = edges.iter().map(|t| [number(&t[0]), number(&t[1]), number(&t[2])]).collect();
        Self { corners, triangles }
    }
}

fn step(corner: usize) -> IVec3 {
    ivec3((corner & 1) as i32, (corner >> 1 & 1) as i32, (corner >> 2 & 1) as i32)
}

/// Adds the triangles in the cell that starts at point number `first`, each corner as the edge that it
/// lies on: number of the point where the edge starts, and its direction in the last three bits.
fn cross(field: &Field, first: usize, at: IVec3, triangles: &mut Vec<[u64; 3]>) {
    let mut points = [first; 8];
    for (corner, point) in points.iter_mut().enumerate().skip(1) {
        match field.places.binary_search(&place(at + step(corner))) {
            Ok(found) => *point = found,
            // Far from the surface on this side, so the surface does not come here.
            Err(_) => return,
        }
    }
    let inside = points.map(|p| field.distances[p] < 0.0);
    if inside.iter().all(|i| *i == inside[0]) {
        return;
    }
    let edge = |a: usize, b: usize| (points[a.min(b)] as u64) << 3 | (a ^ b) as u64;
    for way in WAYS {
        let (mut within, mut beyond) = ([0; 4], [0; 4]);
        let (mut n, mut m) = (0, 0);
        for corner in way {
            if inside[corner] {
                within[n] = corner;
                n += 1;
            } else {
                beyond[m] = corner;
                m += 1;
            }
        }
        // Out of the stem: from the corners within to those beyond.
        let mut add = |ends: [(usize, usize); 3]| {
            let corners = ends.map(|(a, b)| local(field, &points, a, b));
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let outwards = step(ends[0].1) - step(ends[0].0);
            let [a, b, c] = ends.map(|(a, b)| edge(a, b));
            let turned = normal.dot(outwards.as_vec3()) < 0.0;
            triangles.push(if turned { [a, c, b] } else { [a, b, c] });
        };
        let ([a, b, c, _], [p, q, r, _]) = (within, beyond);
        match n {
            1 => add([(a, p), (a, q), (a, r)]),
            3 => add([(a, p), (b, p), (c, p)]),
            2 => {
                add([(a, p), (a, q), (b, q)]);
                add([(a, p), (b, q), (b, p)]);
            }
            _ => {}
        }
    }
}

/// How far along the edge from a point at distance `from` to one at `to` the surface lies, 0 to 1.
fn part(from: f32, to: f32) -> f32 {
    (from / (from - to)).clamp(MARGIN, 1.0 - MARGIN)
}

/// Where the surface crosses the edge from corner `a`, within, to corner `b`, beyond, in cells.
fn local(field: &Field, points: &[usize; 8], a: usize, b: usize) -> Vec3 {
    let t = part(field.distances[points[a]], field.distances[points[b]]);
    step(a).as_vec3().lerp(step(b).as_vec3(), t)
}

fn corner(field: &Field, edge: u64) -> Vec3 {
    let (start, direction) = ((edge >> 3) as usize, step((edge & 7) as usize));
    let at = unplace(field.places[start]);
    let far = field.places.binary_search(&place(at + direction)).unwrap_or(start);
    let t = part(field.distances[start], field.distances[far]);
    let point: DVec3 = field.at(at) + direction.as_dvec3() * (f64::from(t) * field.cell);
    point.as_vec3()
}
