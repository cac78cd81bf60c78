//! The collar of a branch: where it leaves the side of its parent it is wider, so that the one surface goes over into
//! the other.
//!
//! Inside of the parent the branch widens evenly up to where it first comes out of the parent. From there it narrows,
//! fast at first, up to [`LENGTH`] of its radii beyond where its axis comes out. The axis, and all of the branch beyond
//! that, stay as they are.

use super::path::{Corner, Ring};
use crate::nearest::nearest;
use pleach_plant::{Stem, StemKind, Tree};

/// By what part of its radius a branch is wider at the surface of its parent, at most.
const SWELL: f64 = 0.6;
/// So many radii from where its axis comes out of the parent a branch is as thick as it is without a collar.
const LENGTH: f64 = 2.0;
/// At the surface of its parent a branch is at most this part as thick as the parent, or it would stand out at its sides.
const WIDEST: f64 = 0.9;
/// A branch leaves its parent as if at an angle of at least this sine.
const FLATTEST: f64 = 0.35;
/// Metres: a swelling of less is not worth its triangles, since one has to come close to see it.
const SLIGHTEST: f64 = 0.004;
/// Where rings stand on the collar, in parts of its length.
const RINGS: [f64; 4] = [0.0, 0.22, 0.5, 1.0];

/// Where a branch has its collar: from where it is widest to where it is as without, in metres along it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Collar {
    surface: f64,
    end: f64,
    swell: f64,
}

impl Collar {
    /// The collar of `stem`, `None` if it needs none: trunks, forks, and branches on which it would be less than
    /// `tolerance` or [`SLIGHTEST`] or longer than half of the branch.
    fn new(tree: &Tree, stem: &Stem, rings: &[Ring], tolerance: f64) -> Option<Self> {
        if stem.kind != StemKind::Branch {
            return None;
        }
        let knots = tree.knots_of(&tree.stems[stem.parent? as usize]);
        let Ring { center, tangent, radius, .. } = *rings.first()?;
        let place = nearest(knots, center);
        let (from, to) = (&knots[place.knot], &knots[place.knot + 1]);
        let axis = (to.point - from.point).try_normalize()?;
        let thick = from.radius + (to.radius - from.radius) * place.part;
        let swell = SWELL.min(WIDEST * thick / radius - 1.0);
        if swell * radius < tolerance.max(SLIGHTEST) {
            return None;
        }
        let depth = thick - center.distance(from.point.lerp(to.point, place.part));
        let cos = tangent.dot(axis).abs();
        let sin = (1.0 - cos * cos).max(0.0).sqrt().max(FLATTEST);
        let axis_leaves = depth.max(0.0) / sin;
        // The surfaces meet earlier than that on the side of the obtuse angle, and where the parent's turns away at both
        // sides. A ring that is widest later would stand out there.
        let wide = (1.0 + swell) * radius;
        let part = wide / thick;
        let turned = (1.0 - part * part).max(0.0).sqrt();
        let surface = (axis_leaves * turned - wide * cos / sin).max(0.0);
        let end = axis_leaves + LENGTH * radius;
        (end < rings.last()?.along / 2.0).then_some(Self { surface, end, swell })
    }

    /// How many times as thick the branch is at `along`.
    fn at(&self, along: f64) -> f64 {
        let part = if along < self.surface {
            along / self.surface
        } else {
            let left = ((self.end - along) / (self.end - self.surface)).clamp(0.0, 1.0);
            left * left
        };
        1.0 + self.swell * part
    }
}

/// Gives the rings of `stem` their collar, with more rings where it needs them.
pub(super) fn widen(tree: &Tree, stem: &Stem, tolerance: f64, rings: &mut Vec<Ring>, corners: &mut [Corner]) {
    let Some(collar) = Collar::new(tree, stem, rings, tolerance) else { return };
    let length = collar.end - collar.surface;
    for part in RINGS {
        let along = collar.surface + part * length;
        let after = rings.partition_point(|ring| ring.along < along);
        let (Some(a), Some(b)) = (rings.get(after.wrapping_sub(1)), rings.get(after)) else { continue };
        let room = 0.05 * length;
        if along - a.along < room || b.along - along < room {
            continue;
        }
        let t = (along - a.along) / (b.along - a.along);
        let ring = Ring {
            center: a.center.lerp(b.center, t),
            tangent: a.tangent.lerp(b.tangent, t).try_normalize().unwrap_or(a.tangent),
            radius: a.radius + (b.radius - a.radius) * t,
            along,
            tiles: a.tiles + (b.tiles - a.tiles) * t,
            ..*a
        };
        rings.insert(after, ring);
        corners.iter_mut().filter(|corner| corner.ring >= after).for_each(|corner| corner.ring += 1);
    }
    rings.iter_mut().for_each(|ring| ring.radius *= collar.at(ring.along));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_branch_is_widest_at_the_surface_of_its_parent() {
        let collar = Collar { surface: 0.2, end: 0.4, swell: 0.6 };
        assert_eq!([0.0, 0.1, 0.2, 0.4, 9.0].map(|at| collar.at(at)), [1.0, 1.3, 1.6, 1.0, 1.0]);
        assert!((collar.at(0.3) - 1.15).abs() < 1e-9);
        let on_top = Collar { surface: 0.0, ..collar };
        assert_eq!(on_top.at(0.0), 1.6);
    }

    #[test]
    fn branches_have_collars_and_trunks_have_none() {
        let tree = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
        let mut path = super::super::Path::default();
        let (mut with, mut branches) = (0, 0);
        for stem in &tree.stems {
            path.trace(&tree, stem, 1e-3);
            let before = path.rings.clone();
            widen(&tree, stem, 1e-3, &mut path.rings, &mut path.corners);
            if stem.kind != StemKind::Branch {
                assert_eq!(path.rings.len(), before.len());
                continue;
            }
            // Twigs have none, which would stand out by less than is seen.
            branches += usize::from(before[0].radius * SWELL > SLIGHTEST);
            let is_wider = |(a, b): (&Ring, &Ring)| a.radius > 1.3 * b.radius;
            let last = |rings: &[Ring]| rings[rings.len() - 1].radius;
            assert_eq!(last(&path.rings), last(&before));
            assert!(path.rings.windows(2).all(|pair| pair[0].along < pair[1].along + 1e-12));
            if path.rings.len() > before.len() {
                let widest = path.rings.iter().map(|ring| ring.radius).fold(0.0, f64::max);
                let parent = tree.knots_of(&tree.stems[stem.parent.unwrap() as usize]);
                assert!(widest <= parent[0].radius);
                with += 1;
            } else {
                assert!(!path.rings.iter().zip(&before).any(is_wider));
            }
        }
        assert!(branches > 20 && 4 * with > branches, "{with} of {branches}");
    }
}
