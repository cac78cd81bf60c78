//! Fillets: where two stems meet, the corner between them is filled.
//!
//! Only stems that share a vertex of the skeleton flow into each other. If all did, branches that pass
//! each other would melt together.

use super::cone::Cone;
use glam::DVec3;
use pleach_tree::Tree;
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
    /// Within so many metres of `at` the fillet is whole, and at twice as many there is none.
    pub(super) reach: f64,
}

impl Joint {
    /// The joints of `tree`, where the pieces of each stem are the cones in its range of `pieces`. The
    /// corner is as wide as the thinner stem's radius times `fillet`. Raises the cones' swell.
    pub(super) fn find(tree: &Tree, pieces: &[Range<usize>], cones: &mut [Cone], fillet: f64) -> Vec<Self> {
        let mut joints: Vec<Self> = Vec::new();
        if fillet <= 0.0 {
            return joints;
        }
        let ahead = |cone: &Cone| (cone.to - cone.from).normalize_or_zero();
        let mut join = |a: usize, b: usize, is_sibling: bool| {
            let (Some(first), Some(second)) = (pieces.get(a), pieces.get(b)) else { return };
            let (Some(base), false) = (cones.get(first.start).copied(), second.is_empty()) else { return };
            // The other stem where it is nearest.
            let near = |i: &usize| base.from.distance(cones[*i].from.midpoint(cones[*i].to));
            let Some(other) = second.clone().min_by(|i, j| near(i).total_cmp(&near(j))) else { return };
            let [r, s] = [base.radii[0], cones[other].radii[0].max(cones[other].radii[1])];
            let width = fillet * r.min(s);
            // Between two stems from one place the corner lies half way.
            let beside = if is_sibling { ahead(&cones[second.start]) } else { DVec3::ZERO };
            let joint = Self {
                at: base.from,
                along: (ahead(&base) + beside).normalize_or_zero(),
                stems: [first.clone(), second.clone()],
                width,
                start: r.max(s).max(width),
                reach: 1.5 * r.max(s) + width,
            };
            for i in joint.stems.iter().flat_map(Clone::clone) {
                cones[i].swell = cones[i].swell.max(width / 4.0);
            }
            joints.push(joint);
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

    /// Smallest and largest coordinates of what it changes.
    pub(super) fn bounds(&self) -> (DVec3, DVec3) {
        let reach = DVec3::splat(2.0 * self.reach);
        (self.at - reach, self.at + reach)
    }

    /// The cones of its two stems that reach so far.
    pub(super) fn sides<'a>(&self, cones: &'a [Cone]) -> [Vec<&'a Cone>; 2] {
        let (low, high) = self.bounds();
        let meets = |cone: &&Cone| {
            let (from, to) = cone.bounds(self.width);
            from.cmple(high).all() && to.cmpge(low).all()
        };
        [0, 1].map(|side| cones[self.stems[side].clone()].iter().filter(meets).collect())
    }

    /// Metres from `p` to the surface of both stems and the fillet between them; none where it has no
    /// part in the surface: farther than `margin` metres from it, or no corner.
    pub(super) fn distance(&self, sides: &[Vec<&Cone>; 2], p: DVec3, margin: f64) -> Option<f64> {
        let away = (2.0 - p.distance(self.at) / self.reach).clamp(0.0, 1.0);
        let ahead = ((p - self.at).dot(self.along) / self.start).clamp(0.0, 1.0);
        let width = self.width * away * ahead;
        if width <= 0.0 {
            return None;
        }
        let nearest = |side: &[&Cone]| side.iter().map(|c| c.distance(p)).fold(f64::INFINITY, f64::min);
        // Where one stem is far, so is the fillet.
        let a = nearest(&sides[0]);
        if a > margin + 1.25 * width {
            return None;
        }
        let b = nearest(&sides[1]);
        let near = width - (a - b).abs();
        // The smooth minimum of two distances, by a polynomial. It changes by at most 1.4 metres per metre,
        // the fading included.
        (near > 0.0).then(|| a.min(b) - near * near / (4.0 * width))
    }
}
