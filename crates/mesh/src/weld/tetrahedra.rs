//! The surface in a brick by marching tetrahedra (Doi and Koide 1991).
//!
//! Each cell is cut into the six tetrahedra around its main diagonal (Freudenthal 1942), the same way
//! everywhere, so that neighbours share their faces. A tetrahedron is crossed in a triangle or a
//! quadrangle, and there is nothing to choose: the surface has no holes and no edge with more than two
//! faces. Each face lies in its tetrahedron and parts the corners inside from those outside, so that no
//! face is turned and no two faces meet but in their common corners and edges. This is true wherever on
//! the edges the corners lie, and for any tetrahedra that fill space.
//!
//! So both may move. A grid point near the surface would make slivers: it gives way, away from the surface.
//! And corners lie where the surface crosses their edges, not where a straight line says.

use super::grid::{Brick, EIGHT, Grid, SIDE, step};
use super::local::Local;
use super::nearby::{Room, Stems};
use glam::{DVec3, IVec3, Vec3, ivec3};

/// Corners stay this part of an edge away from its ends, so that no face shrinks to nothing.
pub(super) const MARGIN: f64 = 0.1;
/// Grid points nearer to the surface than this, in cells, are moved to this distance from it.
///
/// Neighbours that give way towards each other leave a tetrahedron its size up to 0.35 cells, half its
/// least height.
const CLEAR: f64 = 0.15;

/// Each tetrahedron's way from corner 0 to corner 7 of the cell, by the bits x, y and z; all of them turn
/// the same way.
const WAYS: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// Grid points along a brick, those of the next brick's first layer included.
const POINTS: i32 = SIDE + 1;
const POINT_COUNT: usize = (POINTS * POINTS * POINTS) as usize;
/// Edges that start in a brick: seven from each point but those of the last layers.
pub(super) const EDGES: usize = (SIDE * SIDE * SIDE * 7) as usize;

/// An edge, as a brick sees it: which of the eight bricks from this one on it starts in, by the bits x, y
/// and z, and its number there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge(u16);

impl Edge {
    fn new(start: IVec3, direction: usize) -> Self {
        let next = start.cmpeq(IVec3::splat(SIDE));
        let at = IVec3::select(next, IVec3::ZERO, start);
        let number = ((at.z * SIDE + at.y) * SIDE + at.x) * 7 + direction as i32 - 1;
        Self((next.bitmask() as u16) * EDGES as u16 + number as u16)
    }

    pub(super) const fn brick(self) -> usize {
        self.0 as usize / EDGES
    }

    pub(super) const fn number(self) -> u16 {
        self.0 % EDGES as u16
    }
}

/// The surface in a brick.
#[derive(Debug)]
pub(super) struct Piece {
    pub(super) first: IVec3,
    /// The edges of this brick that the surface crosses, in rising order.
    pub(super) edges: Vec<u16>,
    /// Where it crosses them.
    pub(super) corners: Vec<Vec3>,
    /// Counter-clockwise from outside.
    pub(super) triangles: Vec<[Edge; 3]>,
}

/// The grid points of a brick.
struct Points {
    cell: f64,
    at: [DVec3; POINT_COUNT],
    distances: [f64; POINT_COUNT],
    /// An eight that the surface may cross and that has this point.
    eight: [Option<u8>; POINT_COUNT],
    /// What matters to each eight that the surface may cross.
    local: [Option<Local>; 8],
}

const fn index(p: IVec3) -> usize {
    ((p.z * POINTS + p.y) * POINTS + p.x) as usize
}

fn grid_points(side: i32) -> impl Iterator<Item = IVec3> {
    (0..side).flat_map(move |z| (0..side).flat_map(move |y| (0..side).map(move |x| ivec3(x, y, z))))
}

impl Piece {
    /// The surface in `brick`; `None` where it does not enter it.
    pub(super) fn new(grid: &Grid, stems: &Stems, brick: &Brick) -> Option<Self> {
        let mut points = Points::new(grid, stems, brick);
        let inside = points.distances.map(|distance| distance < 0.0);
        if inside.iter().all(|i| *i == inside[0]) {
            return None;
        }
        for i in 0..POINT_COUNT {
            points.give_way(i);
        }
        let mut piece =
            Self { first: brick.first, edges: Vec::new(), corners: Vec::new(), triangles: Vec::new() };
        for p in grid_points(SIDE) {
            let eight = (p / EIGHT).dot(ivec3(1, 2, 4)) as usize;
            for direction in 1..8 {
                let (a, b) = (index(p), index(p + step(direction)));
                if inside[a] != inside[b] {
                    piece.edges.push(Edge::new(p, direction).number());
                    piece.corners.push(points.crossing(eight, a, b).as_vec3());
                }
            }
        }
        for p in grid_points(SIDE) {
            piece.cross(p, &inside);
        }
        Some(piece)
    }

    /// Adds the triangles in the cell that starts at point `first`.
    fn cross(&mut self, first: IVec3, inside: &[bool; POINT_COUNT]) {
        let mut is_in = [false; 8];
        for (corner, is_in) in is_in.iter_mut().enumerate() {
            *is_in = inside[index(first + step(corner))];
        }
        if is_in.iter().all(|i| *i == is_in[0]) {
            return;
        }
        for way in WAYS {
            let (mut within, mut beyond) = ([0; 4], [0; 4]);
            let (mut n, mut m) = (0, 0);
            // Each step of a corner within past one beyond turns the tetrahedron over.
            let mut turned = false;
            for corner in way {
                if is_in[corner] {
                    turned ^= m % 2 == 1;
                    within[n] = corner;
                    n += 1;
                } else {
                    beyond[m] = corner;
                    m += 1;
                }
            }
            // An edge starts at its lower corner, whose bits are all among the other's.
            let edge = |(a, b): (usize, usize)| Edge::new(first + step(a & b), a ^ b);
            let mut add = |ends: [(usize, usize); 3]| {
                let [a, b, c] = ends.map(edge);
                self.triangles.push(if turned { [a, c, b] } else { [a, b, c] });
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
}

impl Points {
    fn new(grid: &Grid, stems: &Stems, brick: &Brick) -> Self {
        let mut points = Self {
            cell: grid.cell,
            at: [DVec3::ZERO; POINT_COUNT],
            distances: [f64::NAN; POINT_COUNT],
            eight: [None; POINT_COUNT],
            local: Default::default(),
        };
        let mut room = Room::default();
        for eight in 0..8 {
            let first = step(eight) * EIGHT;
            let (center, radius) = grid.ball(brick.first + first, EIGHT);
            match brick.nearby.within(stems, center, radius, &mut room) {
                Ok(nearby) => {
                    let mut local = Local::new(stems, &nearby, center);
                    for p in grid_points(EIGHT + 1).map(|p| first + p) {
                        let i = index(p);
                        if points.eight[i].is_none() {
                            points.eight[i] = Some(eight as u8);
                            points.at[i] = grid.at(brick.first + p);
                            points.distances[i] = local.distance(points.at[i]);
                        }
                    }
                    points.local[eight] = Some(local);
                }
                // The surface is elsewhere, and only the side matters.
                Err(is_inside) => {
                    for i in grid_points(EIGHT + 1).map(|p| index(first + p)) {
                        if points.eight[i].is_none() {
                            points.distances[i] = if is_inside { f64::NEG_INFINITY } else { f64::INFINITY };
                        }
                    }
                }
            }
        }
        points
    }

    /// The distance at `p`, which is in the eight of grid point number `i` or near it.
    fn distance(&mut self, i: usize, p: DVec3) -> f64 {
        let local = self.eight[i].and_then(|eight| self.local[usize::from(eight)].as_mut());
        local.map_or(f64::INFINITY, |local| local.distance(p))
    }

    /// Moves grid point number `i` away from the surface if it is very near to it.
    fn give_way(&mut self, i: usize) {
        let (at, distance) = (self.at[i], self.distances[i]);
        let clear = CLEAR * self.cell;
        if distance.abs() >= clear {
            return;
        }
        let small = 0.01 * self.cell;
        let slope = DVec3::AXES.map(|axis| self.distance(i, at + axis * small) - distance);
        let Some(outwards) = DVec3::from_array(slope).try_normalize() else { return };
        let to = at + outwards * (clear - distance.abs()) * if distance < 0.0 { -1.0 } else { 1.0 };
        let there = self.distance(i, to);
        // In a gap between stems there may be no such way.
        if (there < 0.0) == (distance < 0.0) && there.abs() > distance.abs() {
            (self.at[i], self.distances[i]) = (to, there);
        }
    }

    /// Where the surface crosses the edge between two points of eight number `eight`, one within and one
    /// beyond.
    fn crossing(&mut self, eight: usize, a: usize, b: usize) -> DVec3 {
        let (from, to) = (self.at[a], self.at[b]);
        let (x, y) = (self.distances[a], self.distances[b]);
        let first = x / (x - y);
        let middle = from.lerp(to, first);
        let z = self.local[eight].as_mut().map_or(0.0, |local| local.distance(middle));
        let part =
            if (z < 0.0) == (x < 0.0) { first + (1.0 - first) * z / (z - y) } else { first * x / (x - z) };
        from.lerp(to, part.clamp(MARGIN, 1.0 - MARGIN))
    }
}
