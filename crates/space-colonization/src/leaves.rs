//! Leaves on twigs.
//!
//! Weber and Penn 1995, §4.9: so many for each twig by its length, at an angle to it, turned to the light by a part.

use crate::budget::Budget;
use crate::params::{Id, Numbers};
use crate::purpose::LEAF;
use glam::DVec3;
use pleach_tree::trig::sin_cos;
use pleach_tree::{Foliage, GrowError, Key, Leaf, Tree, piece, push_leaflets};
use std::f64::consts::TAU;

/// Cosine and sine of the golden angle: the turn from a leaf to the next.
const GOLDEN: (f64, f64) = (-0.737_368_878_078_32, 0.675_490_294_261_523_6);
/// Part of a twig, from its foot, without leaves.
const BARE: f64 = 0.12;
/// Deviations: of the angle in parts of it, of the size, and of the roll about the leaf's own axis.
const LEAF_V: (f64, f64, f64) = (0.3, 0.2, 0.7);

/// What all leaves of a tree have in common.
#[derive(Debug)]
pub(crate) struct Leaves<'a> {
    n: &'a Numbers,
    /// Leaves for a metre of a twig.
    dense: f64,
}

impl<'a> Leaves<'a> {
    /// `None` for a tree without leaves.
    pub(crate) fn new(n: &'a Numbers, foliage: Foliage) -> Option<Self> {
        let dense = n.leaf_number / (n.twig_length * n.height);
        (foliage == Foliage::All && n.leaf_number > 0.0).then_some(Self { n, dense })
    }

    /// Puts the leaves of the stem `index` of `length` metres, with the draws of `key`.
    pub(crate) fn put(
        &self,
        index: u32,
        length: f64,
        key: Key,
        tree: &mut Tree,
        budget: &mut Budget,
    ) -> Result<(), GrowError> {
        let number = self.dense * length;
        let count = number as u32 + u32::from(key.unit(LEAF, u32::MAX) < number.fract());
        if count == 0 {
            return Ok(());
        }
        let n = self.n;
        let leaves = u64::from(count) * u64::from(n.leaflets);
        budget.work(leaves, Id::leaf_number)?;
        budget.leaves(tree, leaves as usize)?;
        let knots = tree.stems[index as usize].knots();
        let pieces = knots.len() - 1;
        let (sin, cos) = sin_cos(TAU * key.unit(LEAF, u32::MAX - 1));
        let (mut x, mut y) = (cos, sin);
        for leaf in 0..count {
            let far = BARE + (1.0 - BARE) * f64::from(leaf + 1) / f64::from(count);
            let at = far * pieces as f64;
            let i = (at as usize).min(pieces - 1);
            let curve = piece(&tree.knots[knots.start + i], &tree.knots[knots.start + i + 1]);
            let t = at - i as f64;
            let along = curve.tangent(t, DVec3::Z);
            let (right, down) = along.any_orthonormal_pair();
            let outward = right * x + down * y;
            let bits = key.bits(LEAF, leaf);
            // Three draws of 21 bits each, from −1 to 1.
            let draw = |from: u32| ((bits >> from) & 0x1f_ffff) as f64 / 1_048_576.0 - 1.0;
            // The last leaf continues the twig.
            let angle = if leaf + 1 == count { 0.3 * n.leaf_angle } else { n.leaf_angle };
            let (out, on) = sin_cos(angle * (1.0 + LEAF_V.0 * draw(0)));
            let direction = along * on + outward * out;
            // At right angles to the twig and to `outward`, and so to the leaf.
            let own = down * x - right * y;
            let level = direction.cross(DVec3::Z).try_normalize().unwrap_or(own);
            // The shorter way to the level blade.
            let level = if level.dot(own) < 0.0 { -level } else { level };
            let normal = own.cross(direction);
            let rolled = own + normal * (LEAF_V.2 * draw(21));
            let across = rolled.lerp(level, n.leaf_level).try_normalize().unwrap_or(own);
            let size = n.leaf_length * (1.0 + LEAF_V.1 * draw(42));
            let leaf = Leaf {
                position: curve.at(t).as_vec3(),
                along: (direction * size).as_vec3(),
                across: (across * (size * n.leaf_width)).as_vec3(),
                stem: index,
                shape: 0,
            };
            push_leaflets(leaf, n.leaflets, &mut tree.leaves);
            (x, y) = (x * GOLDEN.0 - y * GOLDEN.1, x * GOLDEN.1 + y * GOLDEN.0);
        }
        Ok(())
    }
}
