//! Levels of detail from one skeleton.
//!
//! Every level is made from the same tree, so that the silhouette stays where it is and nothing pops:
//! coarser levels get wider tolerances and fewer sides, leaves of four triangles and then of two, and
//! then fewer, larger leaves. What is merged keeps its area: of a run of leaves on a stem, one is drawn
//! with the area of all. Twigs go once they are thinner than the level's tolerance and carry no other
//! stem; what is left of their ink is too thin to be seen from where the level is used.

use crate::settings::{LeafStyle, MeshSettings};
use pleach_plant::{Leaf, Stem, Tree};
use std::borrow::Cow;

/// Most levels that [`levels`] makes, the finest included.
pub const MAX_LEVELS: u32 = 6;

/// A tree made ready for one level of detail.
#[derive(Clone, Debug)]
pub struct Level<'a> {
    /// What is left of the tree.
    pub tree: Cow<'a, Tree>,
    /// How it is meshed.
    pub settings: MeshSettings,
}

/// What a level does.
struct Recipe {
    /// Times the finest tolerance.
    tolerance: f64,
    /// Fewest and most sides of stems.
    sides: (u32, u32),
    leaves: LeafStyle,
    /// Leaves drawn as one.
    merged: usize,
    /// Twigs thinner than this part of the tolerance are dropped.
    twigs: f64,
}

const RECIPES: [Recipe; MAX_LEVELS as usize] = [
    Recipe { tolerance: 1.0, sides: (4, 96), leaves: LeafStyle::Outline, merged: 1, twigs: 0.0 },
    Recipe { tolerance: 2.0, sides: (4, 16), leaves: LeafStyle::Reduced, merged: 1, twigs: 0.0 },
    Recipe { tolerance: 4.0, sides: (3, 10), leaves: LeafStyle::Simple, merged: 1, twigs: 0.0 },
    Recipe { tolerance: 10.0, sides: (3, 8), leaves: LeafStyle::Simple, merged: 3, twigs: 0.2 },
    Recipe { tolerance: 30.0, sides: (3, 6), leaves: LeafStyle::Simple, merged: 8, twigs: 0.2 },
    Recipe { tolerance: 80.0, sides: (3, 4), leaves: LeafStyle::Simple, merged: 25, twigs: 0.2 },
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
        return Level { tree: Cow::Borrowed(tree), settings };
    };
    let tolerance = settings.tolerance * recipe.tolerance;
    let leaves = match settings.leaves {
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
    drop_twigs(&mut coarse, tolerance * recipe.twigs);
    Level { tree: Cow::Owned(coarse), settings }
}

/// Replaces every `run` leaves of one shape on a stem by one with the area of all: the one nearest to
/// their middle, grown about its own centre.
fn merge(leaves: &mut Vec<Leaf>, run: usize) {
    if run < 2 {
        return;
    }
    // Generators may mix the leaves of several stems; neighbours on a stem stay neighbours.
    leaves.sort_by_key(|leaf| (leaf.stem, leaf.shape));
    let mut merged = Vec::with_capacity(leaves.len() / run + 1);
    for alike in leaves.chunk_by(|a, b| (a.stem, a.shape) == (b.stem, b.shape)) {
        for group in alike.chunks(run) {
            let area: f32 = group.iter().map(Leaf::unit_area).sum();
            let middle = group.iter().map(center).sum::<glam::Vec3>() / group.len() as f32;
            let distance = |leaf: &&Leaf| center(leaf).distance_squared(middle);
            let nearest = group.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            let Some(&leaf) = nearest else { continue };
            let growth = (area / leaf.unit_area().max(f32::MIN_POSITIVE)).sqrt();
            merged.push(Leaf {
                position: center(&leaf) - leaf.along * (0.5 * growth),
                along: leaf.along * growth,
                across: leaf.across * growth,
                ..leaf
            });
        }
    }
    *leaves = merged;
}

fn center(leaf: &Leaf) -> glam::Vec3 {
    leaf.position + leaf.along * 0.5
}

/// Removes stems without children whose base is thinner than `radius` metres, unless they are
/// trunks. Leaves stay where they are and pass to the parent.
fn drop_twigs(tree: &mut Tree, radius: f64) {
    let mut carries = vec![false; tree.stems.len()];
    for parent in tree.stems.iter().filter_map(|s| s.parent) {
        carries[parent as usize] = true;
    }
    let thin = |stem: &Stem| tree.knots_of(stem)[0].radius < radius;
    let mut kept = Vec::with_capacity(tree.stems.len());
    // New number of each stem, or its parent's where it goes.
    let mut number: Vec<u32> = Vec::with_capacity(tree.stems.len());
    for (stem, carries) in tree.stems.iter().zip(carries) {
        let parent = stem.parent.map(|p| number[p as usize]);
        match parent {
            Some(parent) if !carries && thin(stem) => number.push(parent),
            _ => {
                number.push(kept.len() as u32);
                kept.push(Stem { parent, ..*stem });
            }
        }
    }
    tree.stems = kept;
    for leaf in tree.leaves.iter_mut().chain(&mut tree.blossoms) {
        leaf.stem = number[leaf.stem as usize];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn leaves_of_stems_and_shapes_are_merged_apart() {
        let leaf = |x: f32, stem: u32, shape: u16| Leaf {
            position: glam::vec3(x, 0.0, 0.0),
            along: glam::Vec3::Z,
            across: glam::Vec3::X,
            stem,
            shape,
        };
        // Two stems take turns, and one of them has leaves of two shapes.
        let mut leaves: Vec<Leaf> = (0..12).map(|i| leaf(i as f32, i % 2, (i % 4 == 3).into())).collect();
        merge(&mut leaves, 3);
        let mut kinds: Vec<(u32, u16)> = leaves.iter().map(|leaf| (leaf.stem, leaf.shape)).collect();
        kinds.sort_unstable();
        assert_eq!(kinds, [(0, 0), (0, 0), (1, 0), (1, 1)]);
        assert!(leaves.iter().all(|leaf| (leaf.unit_area() - 3.0).abs() < 1e-5));
    }

    #[test]
    fn dropped_twigs_leave_a_tree() {
        let mut tree = pleach_generators::preset("quaking_aspen").unwrap().grow(1).unwrap();
        let stems = tree.stems.len();
        drop_twigs(&mut tree, 0.006);
        tree.well_formed().unwrap();
        let left = tree.stems.len();
        assert!(left < stems && left > 10, "{left} of {stems}");
        assert!(tree.stems.iter().filter(|s| s.level == 2).all(|s| tree.knots_of(s)[0].radius >= 0.006));
    }
}
