//! Trees that are read: of all families, upright and leaning, alone and in clumps, leafy and bare.

use glam::{DVec3, Vec3};
use pleach_tree::{Foliage, Growth, Parts, Tree, math};

/// Species that are curves, herbs or rows, not trees with a trunk.
const NOT_TREES: [&str; 15] = [
    "abop_dragon",
    "abop_gosper",
    "abop_hilbert",
    "abop_hilbert_space",
    "abop_koch_island",
    "abop_sierpinski",
    "abop_row_of_trees",
    "abop_plant_a",
    "abop_plant_b",
    "abop_plant_c",
    "abop_plant_d",
    "abop_plant_e",
    "abop_plant_f",
    "abop_plant_stochastic",
    "abop_flowering_plant",
];

/// Names of the species that are trees, but for those that differ from others by the size of their leaves.
pub(super) fn names() -> Vec<&'static str> {
    let natural: Vec<&str> = pleach_generators::natural_names().collect();
    let is_wanted = |name: &&str| !NOT_TREES.contains(name) && !natural.contains(name);
    pleach_generators::names().into_iter().filter(is_wanted).collect()
}

/// A tree, or a clump of several.
#[derive(Clone, Debug)]
pub(super) struct Case {
    pub(super) name: String,
    pub(super) seed: u64,
    /// Degrees to the right.
    pub(super) lean: f64,
    pub(super) stems: usize,
    /// With leaves or without.
    pub(super) parts: Parts,
    /// Longer side of its silhouette in pixels.
    pub(super) size: u32,
}

/// A number in 0..1 that is a function of a seed and a purpose.
pub(super) fn draw(seed: u64, purpose: u64) -> f64 {
    let mut x = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ purpose.wrapping_mul(0xD1B5_4A32_D192_ED03);
    x ^= x >> 31;
    x = x.wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^= x >> 29;
    (x >> 11) as f64 / (1_u64 << 53) as f64
}

/// Leans a tree to the right by an angle in degrees and moves it to the right by metres.
fn lean(tree: &mut Tree, degrees: f64, right: f64) {
    let (sin, cos) = math::sin_cos(degrees.to_radians());
    let turn = |p: DVec3| DVec3::new(p.x * cos + p.z * sin, p.y, p.z * cos - p.x * sin);
    let turned = |p: Vec3| turn(p.as_dvec3()).as_vec3();
    let move_to = DVec3::X * right;
    for knot in &mut tree.knots {
        knot.point = turn(knot.point) + move_to;
        knot.handle_in = turn(knot.handle_in) + move_to;
        knot.handle_out = turn(knot.handle_out) + move_to;
    }
    for leaf in tree.leaves.iter_mut().chain(&mut tree.blossoms) {
        leaf.position = turned(leaf.position) + move_to.as_vec3();
        (leaf.along, leaf.across) = (turned(leaf.along), turned(leaf.across));
    }
    tree.blob_vertices.iter_mut().for_each(|v| *v = turned(*v) + move_to.as_vec3());
}

impl Case {
    /// Grows it; `None` if it does not grow.
    pub(super) fn grow(&self) -> Option<Tree> {
        let species = pleach_generators::preset(&self.name)?;
        let foliage = if self.parts == Parts::LEAFY { Foliage::All } else { Foliage::None };
        let grow = |seed| species.grow_with(&Growth { foliage, ..Growth::seed(seed) }).ok();
        let mut tree = grow(self.seed)?;
        let height = tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
        lean(&mut tree, self.lean, 0.0);
        for i in 1..self.stems {
            let mut other = grow(self.seed + 1000 * i as u64)?;
            let side = if i % 2 == 1 { 1.0 } else { -1.0 };
            let away = 0.07 + 0.12 * draw(self.seed, 20 + i as u64);
            lean(
                &mut other,
                side * 12.0 * draw(self.seed, 30 + i as u64),
                side * height * away * i.div_ceil(2) as f64,
            );
            tree.append(&other, |_| false);
        }
        tree.well_formed().ok()?;
        Some(tree)
    }
}
