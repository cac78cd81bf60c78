//! Skeletons that are written and read again.

use super::tests::{SPECIES, grown};
use super::{Skeleton, SkeletonFormat};
use pleach_tree::{Stem, StemKind, Tree};

fn again(skeleton: &Skeleton, format: SkeletonFormat) -> Tree {
    let mut bytes = Vec::new();
    skeleton.write(format, &mut bytes).unwrap();
    let species = pleach_generators::read(bytes.as_slice(), &format!("it.{}", format.suffix())).unwrap();
    let tree = species.grow(7).unwrap();
    tree.well_formed().unwrap();
    tree
}

/// Stems that have a length, by parents among them, kinds and levels.
fn topology(tree: &Tree) -> Vec<(Option<u32>, StemKind, u16)> {
    tree.stems.iter().map(|stem| (stem.parent, stem.kind, stem.level)).collect()
}

/// `tree` without roots, which skeletons leave out.
fn above_ground(tree: &Tree) -> Tree {
    let mut kept = Vec::new();
    let mut above = Tree { knots: tree.knots.clone(), ..Tree::default() };
    for stem in &tree.stems {
        let parent = stem.parent.map(|parent| kept[parent as usize]);
        let is_kept = stem.kind != StemKind::Root && parent != Some(None);
        kept.push(is_kept.then_some(above.stems.len() as u32));
        if is_kept {
            above.stems.push(Stem { parent: parent.flatten(), ..*stem });
        }
    }
    above
}

#[test]
fn a_skeleton_that_is_read_has_the_length_and_the_topology_of_the_one_that_was_written() {
    for name in SPECIES {
        let tree = above_ground(&grown(name));
        let written = Skeleton::new(&tree);
        for format in [SkeletonFormat::Swc, SkeletonFormat::Csv] {
            let read = again(&written, format);
            assert!(
                topology(&read) == topology(&tree),
                "{name}: {} and {} stems in {format:?}",
                read.stems.len(),
                tree.stems.len()
            );
            let skeleton = Skeleton::new(&read);
            let off =
                (skeleton.length() / written.length() - 1.0, skeleton.volume() / written.volume() - 1.0);
            // Cylinders have the volume of each frustum, and radii at their ends are found from them.
            assert!(off.0.abs() < 1e-6 && off.1.abs() < 0.005, "{name}: {off:?} in {format:?}");
        }
    }
}
