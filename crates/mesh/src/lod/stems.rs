//! Which stems are thick enough to be drawn.

use pleach_plant::{Stem, StemKind, Tree};

/// The stems of a tree that are drawn, and what takes the place of the others.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    /// Whether each stem is drawn.
    pub(super) is_kept: Vec<bool>,
    /// New number of each stem, or that of the stem that it grows from, at first hand or not.
    pub(super) number: Vec<u32>,
}

impl Kept {
    /// Keeps the stems whose base is at least `radius` metres thick and that grow from such stems, and in any case the
    /// thickest of all, so that what hangs on the others has a stem.
    pub(super) fn new(tree: &Tree, radius: f64) -> Self {
        let base = |stem: &Stem| tree.knots_of(stem)[0].radius;
        let thickest = (0..tree.stems.len())
            .filter(|&i| tree.stems[i].parent.is_none() && tree.stems[i].kind != StemKind::Root)
            .reduce(|a, b| if base(&tree.stems[b]) > base(&tree.stems[a]) { b } else { a });
        let (mut is_kept, mut number) =
            (Vec::with_capacity(tree.stems.len()), Vec::with_capacity(tree.stems.len()));
        let mut count = 0_u32;
        let mut main = 0;
        for (i, stem) in tree.stems.iter().enumerate() {
            let parent = stem.parent.map(|parent| parent as usize);
            let keep = thickest == Some(i)
                || (base(stem) >= radius && parent.is_none_or(|parent: usize| is_kept[parent]));
            if thickest == Some(i) {
                main = count;
            }
            is_kept.push(keep);
            number.push(if keep { count } else { parent.map_or(u32::MAX, |parent| number[parent]) });
            count += u32::from(keep);
        }
        // A trunk that is not drawn hands over to the thickest.
        number.iter_mut().filter(|number| **number == u32::MAX).for_each(|number| *number = main);
        Self { is_kept, number }
    }

    /// Whether a single stem is left.
    pub(super) fn is_one(&self) -> bool {
        self.is_kept.iter().filter(|kept| **kept).count() <= 1
    }

    /// Takes the other stems off `tree`. What hung on one hangs where it is on the stem that takes its place.
    pub(super) fn thin(&self, tree: &mut Tree) {
        tree.stems = self.stems(tree);
        for leaf in tree.leaves.iter_mut().chain(&mut tree.blossoms) {
            leaf.stem = self.number[leaf.stem as usize];
        }
        tree.blobs.iter_mut().for_each(|blob| blob.stem = self.number[blob.stem as usize]);
    }

    /// The stems that are drawn, with their parents' new numbers.
    pub(super) fn stems(&self, tree: &Tree) -> Vec<Stem> {
        let kept = tree.stems.iter().zip(&self.is_kept).filter(|(_, kept)| **kept);
        let parent = |stem: &Stem| stem.parent.map(|parent| self.number[parent as usize]);
        kept.map(|(stem, _)| Stem { parent: parent(stem), ..*stem }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_stems_go_with_all_that_grows_from_them() {
        for name in ["quaking_aspen", "bamboo", "black_oak"] {
            let mut tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
            let kept = Kept::new(&tree, 0.02);
            let before = tree.stems.len();
            kept.thin(&mut tree);
            tree.well_formed().unwrap();
            assert!((1..before).contains(&tree.stems.len()), "{name}: {} of {before}", tree.stems.len());
            assert!(tree.stems[1..].iter().all(|stem| tree.knots_of(stem)[0].radius >= 0.02), "{name}");
            assert_eq!(Kept::new(&tree, f64::INFINITY).stems(&tree).len(), 1, "{name}: the trunk stays");
        }
    }
}
