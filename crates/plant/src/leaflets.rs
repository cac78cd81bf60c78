//! Compound leaves: small ones in the place of a large one, as on ashes and mesquites.
//!
//! Ours: no paper that pleach follows has them.

use crate::tree::Leaf;

/// Area of all leaflets together over that of a simple leaf of the same length: they overlap.
const AREA: f32 = 1.25;
/// Cosines and sines of the angles between leaflets and the middle of their leaf: 50°, 38°, 62°, 44°, one pair after
/// the other, so that leaves are not combs.
const ANGLES: [(f32, f32); 4] = [
    (0.642_787_6, 0.766_044_4),
    (0.788_010_8, 0.615_661_5),
    (0.469_471_6, 0.882_947_6),
    (0.719_339_8, 0.694_658_4),
];
/// Cosine and sine of the angle by which a leaflet's blade is turned about its own middle, to one side or the other.
const FOLD: (f32, f32) = (0.939_692_6, 0.342_020_1);
/// Part of a leaf, from its base, without leaflets.
const BARE: f32 = 0.05;

/// Length and width of each of `count` leaflets over those of their leaf: a ratio in 0..=1, and 1 for fewer than two.
#[must_use]
pub fn leaflet_size(count: u32) -> f64 {
    f64::from(size(count))
}

fn size(count: u32) -> f32 {
    if count < 2 { 1.0 } else { (AREA / count as f32).sqrt() }
}

/// Adds the leaflets of `leaf` to `leaves`: `count` of them, in pairs along its middle, and one at its end where the
/// number is odd. They fill about the outline of a simple leaf and have the same shape. Of fewer than two, it is
/// `leaf` itself.
pub fn push_leaflets(leaf: Leaf, count: u32, leaves: &mut Vec<Leaf>) {
    let (length, width) = (leaf.along.length(), leaf.across.length());
    if count < 2 || length == 0.0 || width == 0.0 {
        leaves.push(leaf);
        return;
    }
    let (middle, side) = (leaf.along / length, leaf.across / width);
    let normal = side.cross(middle);
    let size = size(count);
    let pairs = count / 2;
    let spacing = (1.0 - BARE - 0.6 * size) / pairs as f32;
    for pair in 0..pairs {
        let (cos, sin) = ANGLES[pair as usize % ANGLES.len()];
        for (which, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let far = BARE + spacing * (pair as f32 + 0.5 * which as f32);
            let along = middle * cos + side * (sign * sin);
            let across = side * cos - middle * (sign * sin);
            let across = across * FOLD.0 + normal * (sign * FOLD.1);
            leaves.push(Leaf {
                position: leaf.position + leaf.along * far,
                along: along * (length * size),
                across: across * (width * size),
                ..leaf
            });
        }
    }
    if count % 2 == 1 {
        leaves.push(Leaf {
            position: leaf.position + leaf.along * (1.0 - size),
            along: leaf.along * size,
            across: leaf.across * size,
            ..leaf
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    const WHOLE: Leaf = Leaf {
        position: Vec3::new(1.0, 2.0, 3.0),
        along: Vec3::new(0.0, 0.0, 0.2),
        across: Vec3::new(0.3, 0.0, 0.0),
        stem: 7,
        shape: 0,
    };

    fn leaflets(count: u32) -> Vec<Leaf> {
        let mut leaves = Vec::new();
        push_leaflets(WHOLE, count, &mut leaves);
        leaves
    }

    #[test]
    fn a_simple_leaf_is_itself() {
        assert_eq!((leaflets(0), leaflets(1)), (vec![WHOLE], vec![WHOLE]));
        let mut flat = Vec::new();
        push_leaflets(Leaf { across: Vec3::ZERO, ..WHOLE }, 5, &mut flat);
        assert_eq!(flat.len(), 1, "a leaf without width has no leaflets");
    }

    #[test]
    fn leaflets_have_the_area_of_their_leaf_and_a_quarter_more() {
        for count in 2..=25 {
            let leaves = leaflets(count);
            assert_eq!(leaves.len(), count as usize);
            let area: f32 = leaves.iter().map(Leaf::unit_area).sum();
            assert!((area / WHOLE.unit_area() - AREA).abs() < 1e-4, "{count}: {area}");
            for leaf in &leaves {
                let size = leaf.along.length() / WHOLE.along.length();
                assert!((f64::from(size) - leaflet_size(count)).abs() < 1e-6);
                assert!(leaf.along.dot(leaf.across).abs() < 1e-6, "{leaf:?}");
                assert_eq!((leaf.stem, leaf.shape), (7, 0));
            }
        }
    }

    #[test]
    fn leaflets_stay_where_their_leaf_is() {
        for count in 2..=25 {
            let tips =
                leaflets(count).into_iter().map(|leaf| (leaf.position + leaf.along - WHOLE.position) / 0.2);
            for tip in tips {
                assert!((0.1..=1.01).contains(&tip.z) && tip.x.abs() < 0.8, "{count}: {tip}");
            }
        }
        // One at the end where the number is odd.
        let end = |count| leaflets(count).iter().filter(|leaf| leaf.along.x == 0.0).count();
        assert_eq!((end(4), end(5), end(9)), (0, 1, 1));
    }
}
