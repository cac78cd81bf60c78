//! Leaves on the twigs that end.

use crate::numbers::{Id, Numbers};
use crate::purpose::LEAF;
use glam::{DVec3, Vec3};
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::math;
use pleach_tree::trig::sin_cos;
use pleach_tree::{Blame, GrowError, Key, Leaf, Limits, Tree};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The turn from one leaf to the next: the golden angle, in turns.
const GOLDEN: f64 = 0.381_966;
/// Largest relative deviation of a leaf from `leaf_length`.
const JITTER: f64 = 0.15;

/// Puts leaves along the ends of all stems of `tree`, of which each has a key among `tips`.
pub(crate) fn put(n: &Numbers, tips: &[Key], limits: &Limits, tree: &mut Tree) -> Result<(), GrowError> {
    let number = n.leaf_number as u32;
    if number == 0 {
        return Ok(());
    }
    let shape = LeafShape::from_number(n.leaf_shape as i64).unwrap_or_default();
    tree.leaf_shapes.push(Arc::clone(shape.outline()));
    let last = if n.levels > 1.0 { n.reach * math::powi(n.shrink, n.levels as i32 - 2) } else { 0.3 };
    let longest = n.leaf_zone * n.crown_radius * last;
    for (index, tip) in tips.iter().enumerate() {
        if tree.leaves.len() + number as usize > limits.leaves {
            let blame = Blame(vec![Id::leaf_number.slot_name(0), Id::branching.slot_name(0)]);
            return Err(GrowError::TooManyLeaves { limit: limits.leaves, blame });
        }
        let knots = tree.stems[index].knots();
        let mut piece = knots.end - 2;
        let mut passed = 0.0;
        for i in 0..number {
            let key = tip.child(LEAF, i);
            let far = longest * (f64::from(i) + 0.5 * key.unit(0, 0)) / f64::from(number);
            // From the tip back to the piece that holds it; the first piece holds the rest.
            let chord = |piece: usize| tree.knots[piece].point.distance(tree.knots[piece + 1].point);
            while piece > knots.start && passed + chord(piece) < far {
                passed += chord(piece);
                piece -= 1;
            }
            let (a, b) = (tree.knots[piece], tree.knots[piece + 1]);
            let t = 1.0 - ((far - passed) / chord(piece).max(1e-9)).clamp(0.0, 1.0);
            let curve = pleach_tree::spline::Cubic::new(a.point, a.handle_out, b.handle_in, b.point);
            let (at, along) = (curve.at(t), curve.tangent(t, DVec3::Z));
            tree.leaves.push(leaf(n, at, along, f64::from(i), key, index as u32));
        }
    }
    Ok(())
}

fn leaf(n: &Numbers, at: DVec3, along: DVec3, number: f64, key: Key, stem: u32) -> Leaf {
    let (x, y) = along.any_orthonormal_pair();
    let (sin, cos) = sin_cos(TAU * (GOLDEN * number + 0.2 * key.unit(1, 0)));
    let (out, on) = sin_cos(n.leaf_angle.to_radians() * (1.0 + 0.3 * key.signed(2, 0)));
    let direction = along * on + (x * cos + y * sin) * out;
    // The blade lies level, as light has it, but for a roll.
    let level = direction.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
    let normal = level.cross(direction);
    let (roll_sin, roll_cos) = sin_cos(0.9 * key.signed(3, 0));
    let across = level * roll_cos + normal * roll_sin;
    let length = n.leaf_length * (1.0 + JITTER * key.signed(4, 0));
    let vector = |v: DVec3| -> Vec3 { v.as_vec3() };
    Leaf {
        position: vector(at),
        along: vector(direction * length),
        across: vector(across * (length * n.leaf_width)),
        stem,
        shape: 0,
    }
}
