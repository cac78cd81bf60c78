//! A skeleton of joints that sways: few enough to animate, fine enough to look alive.

use crate::wind::Sway;
use glam::DVec3;
use pleach_plant::Tree;

/// Joints along each trunk and each clone of it.
const ALONG_TRUNKS: u32 = 4;
/// Joints along each branch of level 1.
const ALONG_BRANCHES: u32 = 2;
/// No more joints than this; further branches move with their parents.
const MAX_JOINTS: usize = 1000;

/// One joint: what hangs on it turns about its pivot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// The joint that carries it; always a smaller number.
    pub parent: Option<u16>,
    /// In metres.
    pub pivot: DVec3,
    /// How it sways. The joints of one stem share its sway between them.
    pub sway: Sway,
}

/// The joints of a tree and which stem hangs on which.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rig {
    /// Joints, parents before children.
    pub joints: Vec<Joint>,
    stems: Vec<Bones>,
}

/// A stem's run of joints, or the one joint of an ancestor that carries all of it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bones {
    first: u16,
    count: u16,
    /// Length of the stem's spline in metres.
    length: f64,
}

impl Rig {
    /// Joints for trunks and their branches; everything smaller moves with what carries it.
    #[must_use]
    pub fn new(tree: &Tree) -> Self {
        let mut rig = Self::default();
        for (i, stem) in tree.stems.iter().enumerate() {
            let parent = stem.parent.map(|p| rig.joint_at(p, stem.offset));
            let wanted = match stem.level {
                0 => ALONG_TRUNKS,
                1 => ALONG_BRANCHES,
                _ => 0,
            };
            let length: f64 = tree.pieces_of(stem).map(|(piece, ..)| piece.length(8)).sum();
            let bones = match parent {
                Some(joint) if wanted == 0 || rig.joints.len() + wanted as usize > MAX_JOINTS => {
                    Bones { first: joint, count: 1, length }
                }
                _ => rig.add(tree, i, parent, wanted.max(1), length),
            };
            rig.stems.push(bones);
        }
        rig
    }

    fn add(&mut self, tree: &Tree, i: usize, parent: Option<u16>, count: u32, length: f64) -> Bones {
        let stem = &tree.stems[i];
        let whole = Sway::new(tree, i);
        let sway = Sway { amplitude: whole.amplitude / f64::from(count), ..whole };
        let first = self.joints.len() as u16;
        let pieces: Vec<_> = tree.pieces_of(stem).map(|(piece, ..)| piece).collect();
        for k in 0..count {
            let parent = if k == 0 { parent } else { Some(first + k as u16 - 1) };
            let place = f64::from(k) / f64::from(count) * pieces.len() as f64;
            let piece = &pieces[(place as usize).min(pieces.len() - 1)];
            self.joints.push(Joint { parent, pivot: piece.at(place.fract()), sway });
        }
        Bones { first, count: count as u16, length }
    }

    /// The joint that moves stem number `stem` at `along` metres from its base.
    #[must_use]
    pub fn joint_at(&self, stem: u32, along: f64) -> u16 {
        let Bones { first, count, length } = self.stems[stem as usize];
        let step = (along / length.max(1e-9) * f64::from(count)).floor();
        first + step.clamp(0.0, f64::from(count - 1)) as u16
    }

    /// The joint of stem number `stem` whose pivot is nearest to `point`.
    #[must_use]
    pub fn joint_near(&self, stem: u32, point: DVec3) -> u16 {
        let Bones { first, count, .. } = self.stems[stem as usize];
        let distance = |j: u16| self.joints[usize::from(j)].pivot.distance_squared(point);
        (first..first + count).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stem_hangs_on_a_joint_and_parents_come_first() {
        for name in ["quaking_aspen", "black_tupelo", "palm"] {
            let tree = pleach_generators::preset(name).unwrap().grow_bare(3).unwrap();
            let rig = Rig::new(&tree);
            assert!(rig.joints.len() <= MAX_JOINTS && rig.joints.len() >= 4, "{name}");
            for (i, joint) in rig.joints.iter().enumerate() {
                assert!(joint.parent.is_none_or(|p| usize::from(p) < i));
                assert!(joint.pivot.is_finite());
            }
            for stem in 0..tree.stems.len() as u32 {
                assert!(usize::from(rig.joint_at(stem, 1e9)) < rig.joints.len());
            }
        }
    }
}
