//! Closed surfaces with fewer triangles.
//!
//! Edges are collapsed, the cheapest first. What a collapse costs is how far the vertex that is left is from the planes
//! of all triangles that it stands for, squared and by their areas (Garland and Heckbert 1997, *Surface simplification
//! using quadric error metrics*, §3 to §5). Here a little of the edge's length is added, so that what is flat keeps
//! triangles of a good form, and collapses that turn a triangle over or pinch the surface are left out.

use glam::{DMat3, DVec3, Vec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Fewest triangles of a closed surface that is more than two faces.
pub(crate) const FEWEST: usize = 4;
/// What a metre of an edge costs, as a distance in metres from the planes around it.
const PER_LENGTH: f64 = 0.01;
/// A triangle may turn by so much, as a cosine.
const MAX_TURN: f64 = 0.2;
/// Vertices are put where their distances are least only where that place is certain: determinants below this, of planes
/// weighed to one, are of flat and straight surfaces.
const CERTAIN: f64 = 1e-3;

/// As long as there are more than so many times the triangles that are wanted, edges are not collapsed in their exact order.
const MANY: usize = 4;

/// A closed surface that loses triangles.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    positions: Vec<Vec3>,
    /// Those that are left.
    faces: Vec<Option<[u32; 3]>>,
    left: usize,
    /// The faces at each vertex; some may be gone.
    at: Vec<Vec<u32>>,
    /// How often each vertex has moved.
    moved: Vec<u32>,
    planes: Vec<Planes>,
}

impl Surface {
    pub(crate) fn new(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        let mut at = vec![Vec::new(); positions.len()];
        let mut planes = vec![Planes::NONE; positions.len()];
        for (i, triangle) in (0..).zip(&triangles) {
            let own = Planes::new(triangle.map(|corner| positions[corner as usize].as_dvec3()));
            for &vertex in triangle {
                at[vertex as usize].push(i);
                planes[vertex as usize] = planes[vertex as usize].with(&own);
            }
        }
        let (left, moved) = (triangles.len(), vec![0; positions.len()]);
        Self { positions, faces: triangles.into_iter().map(Some).collect(), left, at, moved, planes }
    }

    /// Triangles that are left.
    pub(crate) const fn left(&self) -> usize {
        self.left
    }

    /// Collapses edges until there are at most so many triangles, as far as the surface stays closed.
    pub(crate) fn collapse(&mut self, target: usize) {
        while self.left > MANY * target && self.collapse_cheap(MANY * target) {}
        if self.left <= target {
            return;
        }
        let mut edges: BinaryHeap<Reverse<Edge>> = self.edges().map(Reverse).collect();
        while self.left > target {
            let Some(Reverse(edge)) = edges.pop() else { break };
            let [a, b] = edge.ends;
            if !self.is_current(&edge) || !self.join_if_sound(a, b) {
                continue;
            }
            for other in self.neighbours(a) {
                edges.push(Reverse(self.edge(a.min(other), a.max(other))));
            }
        }
    }

    /// Collapses edges that are among the cheaper half, in the order of the triangles: as good while far more triangles
    /// are to go, and faster than the order of costs. Returns whether there are fewer triangles than before.
    fn collapse_cheap(&mut self, target: usize) -> bool {
        let before = self.left;
        let mut edges: Vec<Edge> = self.edges().collect();
        let mut costs: Vec<u64> = edges.iter().map(|edge| edge.cost).collect();
        let half = costs.len() / 2;
        let (_, &mut most, _) = costs.select_nth_unstable(half);
        edges.retain(|edge| edge.cost <= most);
        for edge in edges {
            if self.left <= target {
                break;
            }
            let [a, b] = edge.ends;
            // What has moved once in this round waits for the next.
            if self.is_current(&edge) {
                self.join_if_sound(a, b);
            }
        }
        self.left < before
    }

    /// The edges that there are, each once.
    fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let corners = self.faces.iter().flatten().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        corners.filter(|(a, b)| a < b).map(|(a, b)| self.edge(a, b))
    }

    /// Whether neither end has moved since the edge was noted.
    fn is_current(&self, edge: &Edge) -> bool {
        edge.moved == edge.ends.map(|end| self.moved[end as usize])
    }

    /// Collapses an edge, unless that would turn a triangle over or pinch the surface.
    fn join_if_sound(&mut self, a: u32, b: u32) -> bool {
        let place = self.place(a, b);
        let is_sound = self.stays_closed(a, b) && !self.turns(a, b, place) && !self.turns(b, a, place);
        if is_sound {
            self.join(a, b, place);
        }
        is_sound
    }

    fn neighbours(&self, vertex: u32) -> Vec<u32> {
        let faces = self.at[vertex as usize].iter().filter_map(|&face| self.faces[face as usize]);
        let mut found: Vec<u32> = faces.flatten().filter(|&other| other != vertex).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    fn position(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize].as_dvec3()
    }

    /// Where the vertex that an edge collapses into is put.
    fn place(&self, a: u32, b: u32) -> DVec3 {
        let planes = self.planes[a as usize].with(&self.planes[b as usize]);
        let (from, to) = (self.position(a), self.position(b));
        let middle = (from + to) / 2.0;
        if let Some(best) = planes.nearest(middle).filter(|p| p.distance(middle) <= from.distance(to)) {
            return best;
        }
        let mut best = middle;
        for other in [from, to] {
            if planes.distance(other) < planes.distance(best) {
                best = other;
            }
        }
        best
    }

    fn edge(&self, a: u32, b: u32) -> Edge {
        let planes = self.planes[a as usize].with(&self.planes[b as usize]);
        let length = self.position(a).distance_squared(self.position(b));
        let cost =
            planes.distance(self.place(a, b)).max(0.0) + PER_LENGTH * PER_LENGTH * length * planes.weight;
        // Costs are not negative, so that their bits are in their order.
        Edge { cost: cost.to_bits(), ends: [a, b], moved: [a, b].map(|end| self.moved[end as usize]) }
    }

    /// Whether the surface is still one without the edge: its ends have two neighbours in common and no more.
    fn stays_closed(&self, a: u32, b: u32) -> bool {
        let near = [a, b].map(|end| self.neighbours(end));
        let shared: Vec<u32> = near[0].iter().filter(|n| near[1].contains(n)).copied().collect();
        shared.len() == 2
            && self.left > FEWEST
            && shared.iter().all(|&corner| self.neighbours(corner).len() > 3)
    }

    /// Whether a triangle at `vertex` that stays would turn over if the vertex went to `place`.
    fn turns(&self, vertex: u32, other: u32, place: DVec3) -> bool {
        let faces = self.at[vertex as usize].iter().filter_map(|&face| self.faces[face as usize]);
        faces.filter(|corners| !corners.contains(&other)).any(|corners| {
            let before = corners.map(|corner| self.position(corner));
            let after = corners.map(|corner| if corner == vertex { place } else { self.position(corner) });
            let [before, after] = [before, after].map(|[a, b, c]| (b - a).cross(c - a));
            // What has no area yet may turn; nothing may lose its area.
            before != DVec3::ZERO && before.dot(after) <= MAX_TURN * before.length() * after.length()
        })
    }

    fn join(&mut self, a: u32, b: u32, place: DVec3) {
        self.positions[a as usize] = place.as_vec3();
        self.planes[a as usize] = self.planes[a as usize].with(&self.planes[b as usize]);
        for face in std::mem::take(&mut self.at[b as usize]) {
            let Some(corners) = &mut self.faces[face as usize] else { continue };
            if corners.contains(&a) {
                self.faces[face as usize] = None;
                self.left -= 1;
            } else {
                corners.iter_mut().filter(|corner| **corner == b).for_each(|corner| *corner = a);
                self.at[a as usize].push(face);
            }
        }
        let faces = &self.faces;
        self.at[a as usize].retain(|&face| faces[face as usize].is_some());
        self.moved[a as usize] += 1;
        self.moved[b as usize] += 1;
    }

    /// Six times what is enclosed.
    pub(crate) fn volume(&self) -> f32 {
        let at = |i: u32| self.positions[i as usize];
        self.faces.iter().flatten().map(|&[a, b, c]| at(a).dot(at(b).cross(at(c)))).sum()
    }

    /// Scales about the middle so that it encloses `volume`, as [`Surface::volume`] counts.
    pub(crate) fn grow(&mut self, volume: f32) {
        let now = self.volume();
        let ratio = volume / now;
        if !(ratio.is_finite() && ratio > 0.0) {
            return;
        }
        let scale = pleach_plant::math::powf(ratio, 1.0 / 3.0).clamp(1.0, 1.5);
        let used: Vec<u32> = self.faces.iter().flatten().flatten().copied().collect();
        let middle =
            used.iter().map(|&i| self.positions[i as usize]).sum::<Vec3>() / used.len().max(1) as f32;
        self.positions.iter_mut().for_each(|position| *position = middle + (*position - middle) * scale);
    }

    /// Vertices and triangles that are left.
    pub(crate) fn compact(self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let mut number = vec![u32::MAX; self.positions.len()];
        let mut positions = Vec::new();
        let triangles = self.faces.into_iter().flatten().map(|face| {
            face.map(|corner| {
                let number = &mut number[corner as usize];
                if *number == u32::MAX {
                    *number = positions.len() as u32;
                    positions.push(self.positions[corner as usize]);
                }
                *number
            })
        });
        let triangles = triangles.collect();
        (positions, triangles)
    }
}

/// An edge as it was when it was noted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Edge {
    cost: u64,
    ends: [u32; 2],
    moved: [u32; 2],
}

/// Planes, each by its area: xᵀAx + 2bᵀx + c is the sum of squared distances of x from them.
#[derive(Clone, Copy, Debug)]
struct Planes {
    a: DMat3,
    b: DVec3,
    c: f64,
    weight: f64,
}

impl Planes {
    const NONE: Self = Self { a: DMat3::ZERO, b: DVec3::ZERO, c: 0.0, weight: 0.0 };

    /// That of one triangle.
    fn new([p, q, r]: [DVec3; 3]) -> Self {
        let normal = (q - p).cross(r - p);
        let weight = normal.length() / 2.0;
        let Some(n) = normal.try_normalize() else { return Self::NONE };
        let d = -n.dot(p);
        let a = DMat3::from_cols(n * n.x, n * n.y, n * n.z) * weight;
        Self { a, b: n * (d * weight), c: d * d * weight, weight }
    }

    fn with(&self, other: &Self) -> Self {
        Self {
            a: self.a + other.a,
            b: self.b + other.b,
            c: self.c + other.c,
            weight: self.weight + other.weight,
        }
    }

    /// The sum at `p`.
    fn distance(&self, p: DVec3) -> f64 {
        p.dot(self.a * p) + 2.0 * self.b.dot(p) + self.c
    }

    /// Where the sum is least, near `near`; `None` where planes are too alike to say.
    fn nearest(&self, near: DVec3) -> Option<DVec3> {
        let a = self.a * (1.0 / self.weight.max(f64::MIN_POSITIVE));
        if a.determinant() < CERTAIN {
            return None;
        }
        // From a place nearby, so that little is lost to rounding.
        let down = -(self.a * near + self.b) / self.weight;
        Some(near + a.inverse() * down).filter(|p| p.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// A closed tube of `n` sides, `rings` high.
    fn tube(n: u32, rings: u32) -> Surface {
        let mut positions = Vec::new();
        for ring in 0..rings {
            for j in 0..n {
                let turn = f64::from(j) / f64::from(n) * std::f64::consts::TAU;
                positions.push(DVec3::new(turn.cos(), turn.sin(), 0.1 * f64::from(ring)).as_vec3());
            }
        }
        let last = f64::from(rings - 1) * 0.1;
        positions.extend([Vec3::ZERO, Vec3::Z * last as f32]);
        let (bottom, top) = (n * rings, n * rings + 1);
        let mut triangles = Vec::new();
        for j in 0..n {
            let k = (j + 1) % n;
            triangles.push([bottom, k, j]);
            triangles.push([top, (rings - 1) * n + j, (rings - 1) * n + k]);
            for ring in 0..rings - 1 {
                let (a, b) = (ring * n, (ring + 1) * n);
                triangles.extend([[a + j, a + k, b + k], [a + j, b + k, b + j]]);
            }
        }
        Surface::new(positions, triangles)
    }

    #[test]
    fn a_tube_keeps_its_form_and_stays_closed() {
        let mut surface = tube(24, 50);
        let (before, whole) = (surface.volume(), surface.left());
        surface.collapse(whole / 20);
        assert!((whole / 20 - 1..=whole / 20).contains(&surface.left()));
        assert!((surface.volume() / before - 1.0).abs() < 0.05, "{} of {before}", surface.volume());
        let (positions, triangles) = surface.compact();
        let mut edges = BTreeMap::new();
        for [a, b, c] in &triangles {
            for (a, b) in [(a, b), (b, c), (c, a)] {
                *edges.entry((a.min(b), a.max(b))).or_insert(0) += if a < b { 1 } else { -1 };
            }
        }
        assert!(edges.values().all(|count| *count == 0), "an edge has one face");
        assert!(edges.len() == triangles.len() * 3 / 2, "an edge has more than two faces");
        // Triangles go where the surface bends: few are spent on the height, where 45 of 50 rings were.
        let is_between = |p: &&Vec3| p.z > 0.2 && p.z < 4.7;
        assert!(positions.iter().filter(is_between).count() < positions.len() * 2 / 3);
    }

    #[test]
    fn the_last_triangles_stay() {
        let mut surface = tube(6, 3);
        surface.collapse(0);
        assert!(surface.left() >= FEWEST && surface.volume() > 0.0, "{}", surface.left());
    }
}
