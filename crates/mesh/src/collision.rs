//! What things bump into: a few convex prisms around the trunk and the thickest limbs.

use crate::block::{Block, Vertex};
use crate::part::{Count, Material, Part, Source};
use glam::{DVec3, Vec2};
use pleach_plant::{Parts, Stem, Tree, math, piece};
use std::ops::Range;

/// Sides of a prism.
const SIDES: u32 = 8;
/// Places along a piece of a curve at which it is looked at.
const PLACES: u32 = 4;
/// Thinner parts of a stem have no prism: a part of the radius of the thickest stem.
const MIN_RADIUS: f64 = 0.2;
/// How far the axis may leave a prism's, as a part of the radius.
const MAX_BEND: f64 = 0.5;

/// A frustum around a part of a stem: convex, with eight sides. The whole part is inside of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prism {
    /// The middles of both ends, in metres, z up.
    pub ends: [DVec3; 2],
    /// From the middle of each end to the middles of its sides, in metres.
    pub radii: [f64; 2],
}

/// A place on the axis of a stem.
#[derive(Clone, Copy, Debug)]
struct At {
    point: DVec3,
    radius: f64,
}

impl Prism {
    /// No tree has more: the thickest are kept.
    pub const MAX: usize = 32;

    /// Prisms around the trunk and the limbs of `tree` that are at least a fifth as thick as its thickest stem, the
    /// thickest first; roots are left out.
    #[must_use]
    pub fn around(tree: &Tree) -> Vec<Self> {
        let above_ground = || tree.stems.iter().filter(|stem| Parts::LEAFY.has_stem(stem.kind));
        let thickest = |stem: &Stem| tree.knots_of(stem).iter().fold(0.0, |r, knot| f64::max(r, knot.radius));
        let least = MIN_RADIUS * above_ground().map(thickest).fold(0.0, f64::max);
        let mut prisms: Vec<Self> =
            above_ground().flat_map(|stem| along(&places(tree, stem, least))).collect();
        prisms.sort_by(|a, b| b.radii[0].total_cmp(&a.radii[0]));
        prisms.truncate(Self::MAX);
        prisms
    }

    /// The corners of both ends, each around the axis.
    fn corners(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        let [from, to] = self.ends;
        let axis = (to - from).try_normalize().unwrap_or(DVec3::Z);
        let across = axis.any_orthonormal_vector();
        let beside = axis.cross(across);
        let turn = std::f64::consts::TAU / f64::from(SIDES);
        // The sides touch a circle of the radius, so the corners are beyond it.
        let reach = 1.0 / math::sin_cos(turn / 2.0).1;
        self.ends.into_iter().zip(self.radii).flat_map(move |(end, radius)| {
            (0..SIDES).map(move |side| {
                let (sin, cos) = math::sin_cos(turn * f64::from(side));
                let out = across * cos + beside * sin;
                (end + out * (radius * reach), out)
            })
        })
    }
}

/// Places on the axis of `stem` from its base on, as far as it is at least `least` thick.
fn places(tree: &Tree, stem: &Stem, least: f64) -> Vec<At> {
    let knots = tree.knots_of(stem);
    let pieces = knots.windows(2).flat_map(|pair| {
        let curve = piece(&pair[0], &pair[1]);
        (0..PLACES).map(move |place| {
            let t = f64::from(place) / f64::from(PLACES);
            At { point: curve.at(t), radius: pair[0].radius + t * (pair[1].radius - pair[0].radius) }
        })
    });
    let tip = knots.last().map(|knot| At { point: knot.point, radius: knot.radius });
    pieces.chain(tip).take_while(|at| at.radius >= least && at.radius > 0.0).collect()
}

/// Prisms around places that follow each other: each goes on as long as the axis stays near its own.
fn along(places: &[At]) -> Vec<Prism> {
    let mut prisms = Vec::new();
    let mut from = 0;
    while from + 1 < places.len() {
        let mut to = from + 1;
        while to + 1 < places.len() && bend(&places[from..=to + 1]) <= MAX_BEND * places[from].radius {
            to += 1;
        }
        let bend = bend(&places[from..=to]);
        let radii = [places[from], places[to]].map(|at| at.radius + bend);
        prisms.push(Prism { ends: [places[from].point, places[to].point], radii });
        from = to;
    }
    prisms
}

/// How far the surface of a stem leaves the frustum between its ends.
fn bend(places: &[At]) -> f64 {
    let [from, .., to] = places else { return 0.0 };
    let axis = to.point - from.point;
    let beyond = |at: &At| {
        let part = ((at.point - from.point).dot(axis) / axis.length_squared().max(1e-12)).clamp(0.0, 1.0);
        let off = at.point.distance(from.point + axis * part);
        off + at.radius - (from.radius + part * (to.radius - from.radius))
    };
    places.iter().map(beyond).fold(0.0, f64::max)
}

/// One prism as a source of triangles.
#[derive(Clone, Copy, Debug)]
pub struct Collision<'a>(pub &'a Prism);

impl Source for Collision<'_> {
    fn parts(&self, mesh: usize) -> Vec<Part> {
        let sides = u64::from(SIDES);
        // Two for each side, and what is left of the two ends.
        let count = Count { vertices: 2 * sides, triangles: 2 * sides + 2 * (sides - 2) };
        vec![Part::plain(mesh, Material::Collision, count)]
    }

    fn ranges(&self, _: Material) -> Vec<Range<usize>> {
        std::iter::once(0..1).collect()
    }

    fn fill(&self, _: Material, _: Range<usize>, block: &mut Block) {
        let base = block.vertices.len() as u32;
        let vertex = |(position, normal): (DVec3, DVec3)| Vertex {
            position: position.as_vec3(),
            normal: normal.as_vec3(),
            uv: Vec2::ZERO,
        };
        block.vertices.extend(self.0.corners().map(vertex));
        for side in 0..SIDES {
            let next = (side + 1) % SIDES;
            let [a, b, c, d] = [side, next, SIDES + next, SIDES + side].map(|corner| base + corner);
            block.triangles.extend([[a, b, c], [a, c, d]]);
        }
        for corner in 1..SIDES - 1 {
            block.triangles.push([base, base + corner + 1, base + corner]);
            let top = base + SIDES;
            block.triangles.push([top, top + corner, top + corner + 1]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(name: &str) -> Tree {
        pleach_generators::preset(name).unwrap().grow(1).unwrap()
    }

    #[test]
    fn thick_stems_are_inside_of_convex_prisms() {
        for name in ["quaking_aspen", "palm", "acer", "bamboo", "weeping_willow"] {
            let tree = tree(name);
            let prisms = Prism::around(&tree);
            assert!((1..=Prism::MAX).contains(&prisms.len()), "{name}: {}", prisms.len());
            let feet = tree.stems.iter().filter(|stem| stem.parent.is_none());
            let feet = feet.map(|stem| tree.knots_of(stem)[0]);
            let thickest = feet.max_by(|a, b| a.radius.total_cmp(&b.radius)).unwrap();
            assert!(prisms.iter().any(|prism| prism.ends[0] == thickest.point), "{name}: the foot");
            for prism in &prisms {
                let mut block = Block::default();
                Collision(prism).fill(Material::Collision, 0..1, &mut block);
                let [part] = Collision(prism).parts(0)[..] else { panic!("one part") };
                assert_eq!(part.count.vertices, block.vertices.len() as u64);
                assert_eq!(part.count.triangles, block.triangles.len() as u64);
                let place = |corner: u32| block.vertices[corner as usize].position.as_dvec3();
                for triangle in &block.triangles {
                    let [a, b, c] = triangle.map(place);
                    let out = (b - a).cross(c - a).normalize();
                    let size = prism.radii[0].max(prism.ends[0].distance(prism.ends[1]));
                    for vertex in &block.vertices {
                        let beyond = (vertex.position.as_dvec3() - a).dot(out);
                        assert!(beyond <= 1e-4 * size.max(1.0), "{name}: {beyond} beyond a face");
                    }
                }
            }
        }
    }

    #[test]
    fn a_bent_stem_has_several_and_is_inside_of_them() {
        let at = |x: f64, z: f64| At { point: DVec3::new(x, 0.0, z), radius: 0.1 };
        let straight: Vec<At> = (0..20).map(|i| at(0.0, f64::from(i))).collect();
        assert_eq!(along(&straight).len(), 1);
        let bent: Vec<At> = (0..20).map(|i| at(0.02 * f64::from(i * i), f64::from(i))).collect();
        let prisms = along(&bent);
        assert!(prisms.len() > 4, "{}", prisms.len());
        for one in &bent {
            let inside = |prism: &Prism| {
                let [from, to] = prism.ends;
                let axis = to - from;
                let part = (one.point - from).dot(axis) / axis.length_squared();
                let radius = prism.radii[0] + part * (prism.radii[1] - prism.radii[0]);
                (-1e-9..=1.0 + 1e-9).contains(&part)
                    && one.point.distance(from + axis * part) + one.radius <= radius + 1e-9
            };
            assert!(prisms.iter().any(inside), "{:?}", one.point);
        }
    }
}
