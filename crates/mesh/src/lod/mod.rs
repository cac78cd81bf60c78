//! Levels of detail from one skeleton.
//!
//! Every level is made from the same tree, so that the silhouette stays where it is and nothing pops:
//! coarser levels get wider tolerances and fewer sides, leaves of four triangles and then of two, and
//! then fewer, larger leaves. What is merged keeps its area: of a run of leaves on a stem, one is drawn
//! with the area of all. Twigs go once they are thinner than a part of the level's tolerance; what is left of their ink
//! is too thin to be seen from where the level is used.
//!
//! There are levels of fixed coarseness ([`levels`]) and levels of so many triangles ([`budgets`]).

mod blobs;
mod budget;
mod cards;
mod groups;
mod ink;
mod merge;
mod stems;

pub use budget::{BUDGETS, TooFew, budgets, painted};

use crate::mesher::Mesher;
use crate::settings::{LeafStyle, MeshSettings};
use crate::twigs::Twigs;
use merge::merge;
use pleach_plant::Tree;
use std::borrow::Cow;
use stems::Kept;

/// Most levels that [`levels`] makes, the finest included.
pub const MAX_LEVELS: u32 = 6;

/// A tree made ready for one level of detail.
#[derive(Clone, Debug)]
pub struct Level<'a> {
    /// The tree that this is a level of.
    pub whole: &'a Tree,
    /// What is left of the tree.
    pub tree: Cow<'a, Tree>,
    /// How it is meshed.
    pub settings: MeshSettings,
    /// Cards that stand for its twigs and leaves.
    pub twigs: Option<Twigs>,
}

impl Level<'_> {
    /// What meshes it.
    #[must_use]
    pub fn mesher(&self) -> Mesher<'_> {
        self.mesher_without(&[])
    }

    /// The same without the stems for which `left_out` says so.
    #[must_use]
    pub fn mesher_without<'m>(&'m self, left_out: &'m [bool]) -> Mesher<'m> {
        let mesher = Mesher::without(&self.tree, self.settings, left_out).growing_with(self.whole);
        match &self.twigs {
            Some(twigs) => mesher.with_twigs(twigs),
            None => mesher,
        }
    }
}

/// What a level does.
struct Recipe {
    /// Times the finest tolerance.
    tolerance: f64,
    /// Fewest and most sides of stems.
    sides: (u32, u32),
    leaves: LeafStyle,
    /// Leaves drawn as one.
    merged: f64,
    /// Twigs thinner than this part of the tolerance go.
    twigs: f64,
}

const RECIPES: [Recipe; MAX_LEVELS as usize] = [
    Recipe { tolerance: 1.0, sides: (4, 96), leaves: LeafStyle::Outline, merged: 1.0, twigs: 0.0 },
    Recipe { tolerance: 2.0, sides: (4, 16), leaves: LeafStyle::Reduced, merged: 1.0, twigs: 0.0 },
    Recipe { tolerance: 4.0, sides: (3, 10), leaves: LeafStyle::Simple, merged: 1.0, twigs: 0.0 },
    Recipe { tolerance: 10.0, sides: (3, 8), leaves: LeafStyle::Simple, merged: 3.0, twigs: 0.2 },
    Recipe { tolerance: 30.0, sides: (3, 6), leaves: LeafStyle::Simple, merged: 8.0, twigs: 0.2 },
    Recipe { tolerance: 80.0, sides: (3, 4), leaves: LeafStyle::Simple, merged: 25.0, twigs: 0.2 },
];

/// `count` levels of `tree`, the finest first, which is `tree` itself after `settings`. At most
/// [`MAX_LEVELS`].
///
/// ```
/// use pleach_mesh::{MeshSettings, Mesher, lod};
///
/// let tree = pleach_generators::species("palm")?.grow(1)?;
/// let levels = lod::levels(&tree, MeshSettings::default(), 3);
/// let count = |level: &lod::Level<'_>| Mesher::new(&level.tree, level.settings).count().triangles;
/// assert!(count(&levels[0]) > count(&levels[1]) && count(&levels[1]) > count(&levels[2]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn levels(tree: &Tree, settings: MeshSettings, count: u32) -> Vec<Level<'_>> {
    (0..count.min(MAX_LEVELS)).map(|level| self::level(tree, settings, level)).collect()
}

/// Level number `level` of `tree`: 0 is `tree` itself after `settings`, the coarsest is
/// [`MAX_LEVELS`] − 1.
#[must_use]
pub fn level(tree: &Tree, settings: MeshSettings, level: u32) -> Level<'_> {
    let Some(recipe) = RECIPES.get(level as usize).filter(|_| level > 0) else {
        return Level { whole: tree, tree: Cow::Borrowed(tree), settings, twigs: None };
    };
    let tolerance = settings.tolerance * recipe.tolerance;
    let leaves = match settings.leaves {
        LeafStyle::Outline if settings.pictured => recipe.leaves.pictured(),
        LeafStyle::Outline => recipe.leaves,
        chosen => chosen,
    };
    let settings = MeshSettings {
        tolerance,
        min_sides: settings.min_sides.min(recipe.sides.0),
        max_sides: settings.max_sides.min(recipe.sides.1),
        leaves,
        ..settings
    };
    let mut coarse = tree.clone();
    merge(&mut coarse.leaves, recipe.merged);
    merge(&mut coarse.blossoms, recipe.merged);
    Kept::new(&coarse, tolerance * recipe.twigs).thin(&mut coarse);
    Level { whole: tree, tree: Cow::Owned(coarse), settings, twigs: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_plant::Leaf;

    fn area(tree: &Tree) -> f32 {
        tree.leaves.iter().map(Leaf::unit_area).sum()
    }

    #[test]
    fn merged_leaves_keep_the_area_and_hang_on_stems_that_exist() {
        let tree = pleach_generators::preset("quaking_aspen").unwrap().grow(1).unwrap();
        let mut last = usize::MAX;
        for (n, level) in levels(&tree, MeshSettings::default(), 99).iter().enumerate() {
            level.tree.well_formed().unwrap();
            assert!((area(&level.tree) / area(&tree) - 1.0).abs() < 1e-3, "level {n}");
            assert!(level.tree.leaves.len() <= last, "level {n}");
            last = level.tree.leaves.len();
        }
        assert!(last * 10 < tree.leaves.len());
    }
}
