//! Where stems stand on their parents.

use super::{Stem, Tree};

/// Points of each piece that are tried, and halvings of what lies around the nearest of them.
const TRIED: u32 = 16;
const HALVINGS: u32 = 20;

impl Tree {
    /// Where `stem` stands on its parent: the number of the piece of the parent's spline that is nearest to the first
    /// knot of `stem`, plus the curve parameter in that piece, 0 to 1. 2.25 is a quarter of the way from the parent's
    /// third knot to its fourth. `None` without a parent.
    #[must_use]
    pub fn place_of(&self, stem: &Stem) -> Option<f64> {
        let parent = &self.stems[stem.parent? as usize];
        let foot = self.knots_of(stem)[0].point;
        let (mut found, mut least) = (0.0, f64::INFINITY);
        for (number, (piece, ..)) in self.pieces_of(parent).enumerate() {
            let (mut t, mut distance) = (0.0, f64::INFINITY);
            let mut try_at = |other: f64, t: &mut f64| {
                let there = piece.at(other).distance_squared(foot);
                if there < distance {
                    (*t, distance) = (other, there);
                }
            };
            for step in 0..=TRIED {
                try_at(f64::from(step) / f64::from(TRIED), &mut t);
            }
            let mut reach = 1.0 / f64::from(TRIED);
            for _ in 0..HALVINGS {
                reach /= 2.0;
                let (below, above) = ((t - reach).max(0.0), (t + reach).min(1.0));
                try_at(below, &mut t);
                try_at(above, &mut t);
            }
            if distance < least {
                (found, least) = (number as f64 + t, distance);
            }
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::{Knot, StemKind};
    use glam::{DVec3, dvec3};

    /// A pole of two pieces of 1 m, and a branch that starts beside it.
    fn pole_and_branch(foot: DVec3) -> Tree {
        let knot = |point: DVec3, along: DVec3| Knot {
            point,
            handle_in: point - along / 3.0,
            handle_out: point + along / 3.0,
            radius: 0.1,
        };
        let stem = |parent, level, kind, first_knot, knot_count| Stem {
            parent,
            level,
            kind,
            number: 0,
            offset: 0.0,
            first_knot,
            knot_count,
        };
        Tree {
            stems: vec![stem(None, 0, StemKind::Trunk, 0, 3), stem(Some(0), 1, StemKind::Branch, 3, 2)],
            knots: vec![
                knot(DVec3::ZERO, DVec3::Z),
                knot(DVec3::Z, DVec3::Z),
                knot(DVec3::Z * 2.0, DVec3::Z),
                knot(foot, DVec3::X),
                knot(foot + DVec3::X, DVec3::X),
            ],
            ..Tree::default()
        }
    }

    #[test]
    fn a_branch_stands_beside_the_nearest_point_of_its_parent() {
        let place = |foot| {
            let tree = pole_and_branch(foot);
            assert_eq!(tree.place_of(&tree.stems[0]), None);
            tree.place_of(&tree.stems[1]).unwrap()
        };
        assert!((place(dvec3(0.05, 0.0, 1.3)) - 1.3).abs() < 1e-6);
        assert!((place(dvec3(0.0, -0.2, 0.77)) - 0.77).abs() < 1e-6);
        assert_eq!(place(dvec3(0.0, 0.0, 5.0)), 2.0);
        assert_eq!(place(dvec3(0.1, 0.0, -1.0)), 0.0);
    }
}
