//! Fillets: where two stems meet, the corner between them is filled.
//!
//! Only stems that share a vertex of the skeleton flow into each other. If all did, branches that pass
//! each other would melt together.

use super::cone::Cone;
use glam::DVec3;
use pleach_plant::Tree;
use std::ops::Range;

/// Two stems that meet.
#[derive(Clone, Debug)]
pub(super) struct Joint {
    /// Where they meet.
    pub(super) at: DVec3,
    /// Into the corner: on the other side of `at` there is no fillet, and so far along it is whole. The
    /// first stem's end lies within the second, and would raise it all around.
    along: DVec3,
    start: f64,
    /// The two stems' pieces, as numbers of cones.
    pub(super) stems: [Range<usize>; 2],
    /// Where two distances differ by less than this many metres, the corner is filled; positive.
    pub(super) width: f64,
    /// Within this distance of `at`, in metres, the fillet is whole; at twice the distance it has ended.
    reach: f64,
}

impl Joint {
    /// The joints of `tree`, where the pieces of each stem are the cones in its range of `pieces`. The
    /// corner is as wide as the thinner stem's radius times `fillet`.
    pub(super) fn find(tree: &Tree, pieces: &[Range<usize>], cones: &[Cone], fillet: f64) -> Vec<Self> {
        let mut joints: Vec<Self> = Vec::new();
        if fillet <= 0.0 {
            return joints;
        }
        let mut join = |a: usize, b: usize, is_sibling: bool| {
            let (Some(first), Some(second)) = (pieces.get(a), pieces.get(b)) else { return };
            let (Some(base), Some(beside)) = (cones[first.clone()].first(), cones[second.clone()].first())
            else {
                return;
            };
            // The other stem where it is nearest.
            let near = |cone: &Cone| {
                let t = cone.nearest(base.from);
                let [a, b] = cone.radii;
                (base.from.distance(cone.from.lerp(cone.to, t)), a + (b - a) * t)
            };
            let nearest = cones[second.clone()].iter().map(near).min_by(|a, b| a.0.total_cmp(&b.0));
            let (r, s) = (base.radii[0], nearest.map_or(beside.radii[0], |(_, radius)| radius));
            let width = fillet * r.min(s);
            // Between two stems from one place the corner lies half way.
            let beside = if is_sibling { beside.axis() } else { DVec3::ZERO };
            joints.push(Self {
                at: base.from,
                along: (base.axis() + beside).normalize_or_zero(),
                stems: [first.clone(), second.clone()],
                width,
                start: r.max(s).max(width),
                reach: 1.5 * r.max(s) + width,
            });
        };
        let with_parents = tree.stems.iter().enumerate().filter_map(|(i, stem)| Some((i, stem.parent?)));
        with_parents.for_each(|(child, parent)| join(child, parent as usize, false));
        // Stems from one place of one parent: each flows into the next one around.
        let mut of_place: Vec<usize> =
            (0..tree.stems.len()).filter(|&i| tree.stems[i].parent.is_some()).collect();
        let place = |i: usize| (tree.stems[i].parent, tree.stems[i].offset);
        of_place.sort_by(|&a, &b| {
            let ((p, x), (q, y)) = (place(a), place(b));
            p.cmp(&q).then(x.total_cmp(&y)).then(a.cmp(&b))
        });
        for group in of_place.chunk_by(|&a, &b| place(a) == place(b)) {
            let pairs = if group.len() > 2 { group.len() } else { group.len() - 1 };
            (0..pairs).for_each(|i| join(group[i], group[(i + 1) % group.len()], true));
        }
        joints
    }

    /// The most by which it raises the surface, in metres.
    pub(super) fn swell(&self) -> f64 {
        self.width / 4.0
    }

    /// The width of the corner at `p`, in metres; 0 where there is none.
    pub(super) fn width_at(&self, p: DVec3) -> f64 {
        self.width_within(p, 0.0)
    }

    /// No width within `radius` metres of `p` is greater.
    pub(super) fn width_within(&self, p: DVec3, radius: f64) -> f64 {
        let away = p - self.at;
        let ahead = away.dot(self.along) + radius;
        let end = 2.0 * self.reach + radius;
        if ahead <= 0.0 || away.length_squared() >= end * end {
            return 0.0;
        }
        let near = 2.0 - (away.length() - radius) / self.reach;
        self.width * near.clamp(0.0, 1.0) * (ahead / self.start).min(1.0)
    }
}

/// Metres to the surface of two stems that are `a` and `b` metres away, and of a fillet of this width
/// between them.
///
/// The smooth minimum of two distances, by a polynomial.
pub(super) fn filled(a: f64, b: f64, width: f64) -> f64 {
    let near = width - (a - b).abs();
    let least = a.min(b);
    if near > 0.0 && width > 0.0 { least - near * near / (4.0 * width) } else { least }
}
