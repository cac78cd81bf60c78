//! When each vertex of a tree comes to be and from where, so that a shader can let the tree grow.
//!
//! All tips grow equally fast: the time of a place on a stem is in proportion to its distance from the ground along the
//! stems, and is [`LAST`] at the farthest place of the tree. A vertex of bark is on the axis of its stem at that time,
//! and one of a leaf, blossom, card or blob where that is attached; from then to time 1, when the tree is as it is in
//! the file, it moves outwards evenly. `docs/growth.md` has the same as shaders.
//!
//! Each vertex of a mesh with growth data carries four numbers, [`Emergence::to_array`]: `TEXCOORD_1` and `TEXCOORD_2`
//! in GLB files, and properties `growth_…` in PLY.
//!
//! | set | numbers |
//! | --- | --- |
//! | `TEXCOORD_1` | the time, 0 to [`LAST`]; x of the way from the vertex back to where it comes from, in metres and in the file's axes |
//! | `TEXCOORD_2` | y and z of that way |
//!
//! [`Emergence::to_array`]: crate::block::Emergence::to_array

use crate::block::Emergence;
use crate::nearest::nearest;
use glam::{DVec3, Vec3};
use pleach_plant::Tree;

/// The time at which the farthest place of a tree comes to be; what is there has the rest to become whole.
pub const LAST: f32 = 0.9;
/// Pieces in which the length of a curve is measured.
const STEPS: u32 = 8;

/// Where a vertex is at `time`, from 0, when nothing is there, to 1: all in metres, or any axes that both have.
#[must_use]
pub fn grown(position: Vec3, emergence: &Emergence, time: f32) -> Vec3 {
    let Emergence { time: own, toward } = *emergence;
    position + toward * (1.0 - ((time - own) / (1.0 - own)).clamp(0.0, 1.0))
}

/// How far every place of a tree is from the ground, along the stems.
#[derive(Clone, Debug)]
pub struct Ages<'a> {
    tree: &'a Tree,
    /// Metres from the ground to the base of each stem.
    bases: Vec<f64>,
    /// Metres to the farthest place.
    farthest: f64,
}

impl<'a> Ages<'a> {
    /// The ages of `tree`.
    #[must_use]
    pub fn new(tree: &'a Tree) -> Self {
        let mut new = Self { tree, bases: Vec::with_capacity(tree.stems.len()), farthest: 0.0 };
        for stem in &tree.stems {
            let foot = tree.knots_of(stem)[0].point;
            let base = stem.parent.map_or(0.0, |parent| new.metres_near(parent, foot));
            let length: f64 = tree.pieces_of(stem).map(|(piece, ..)| piece.length(STEPS)).sum();
            new.bases.push(base);
            new.farthest = new.farthest.max(base + length);
        }
        new
    }

    /// The same of a part of the tree that `whole` is of: at the pace of the whole tree.
    #[must_use]
    pub fn at_pace_of(self, whole: &Ages<'_>) -> Self {
        Self { farthest: whole.farthest, ..self }
    }

    fn time(&self, metres: f64) -> f32 {
        (f64::from(LAST) * metres / self.farthest.max(f64::MIN_POSITIVE)).clamp(0.0, f64::from(LAST)) as f32
    }

    /// The time of the place that is `along` metres from the base of stem number `stem`.
    ///
    /// # Panics
    /// If the tree has no such stem.
    #[must_use]
    pub fn at(&self, stem: u32, along: f64) -> f32 {
        self.time(self.bases[stem as usize] + along)
    }

    /// The time of the place of stem number `stem` that is nearest to `point`.
    ///
    /// # Panics
    /// If the tree has no such stem.
    #[must_use]
    pub fn near(&self, stem: u32, point: Vec3) -> f32 {
        self.time(self.metres_near(stem, point.as_dvec3()))
    }

    fn metres_near(&self, stem: u32, point: DVec3) -> f64 {
        let knots = self.tree.knots_of(&self.tree.stems[stem as usize]);
        self.bases[stem as usize] + nearest(knots, point).along
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_farther_along_comes_later() {
        for name in ["quaking_aspen", "weeping_willow", "black_tupelo"] {
            let tree = pleach_generators::preset(name).unwrap().grow(2).unwrap();
            let ages = Ages::new(&tree);
            let mut last = 0.0_f32;
            for (i, stem) in tree.stems.iter().enumerate() {
                let (base, tip) = (ages.at(i as u32, 0.0), ages.at(i as u32, tree.length_of(stem)));
                assert!((0.0..=LAST).contains(&base) && base <= tip, "{name} {i}");
                last = last.max(tip);
                let Some(parent) = stem.parent else { continue };
                let carrier = &tree.stems[parent as usize];
                let ends = [0.0, tree.length_of(carrier)].map(|along| ages.at(parent, along));
                assert!(ends[0] <= base && base <= ends[1] + 1e-6, "{name} {i}");
            }
            assert!((last - LAST).abs() < 0.01, "{name}: {last}");
        }
    }

    #[test]
    fn a_vertex_goes_from_where_it_comes_from_to_its_place() {
        let own = Emergence { time: 0.5, toward: Vec3::new(-1.0, 0.0, 2.0) };
        let position = Vec3::new(3.0, 1.0, 5.0);
        assert_eq!(grown(position, &own, 0.0), position + own.toward);
        assert_eq!(grown(position, &own, 0.5), position + own.toward);
        assert_eq!(grown(position, &own, 0.75), position + own.toward / 2.0);
        assert_eq!(grown(position, &own, 1.0), position);
        assert_eq!(own.to_array(), [0.5, -1.0, 0.0, 2.0]);
    }

    #[test]
    fn a_tree_of_nothing_has_no_ages() {
        let tree = Tree::default();
        assert_eq!(Ages::new(&tree).time(3.0), LAST);
    }
}
