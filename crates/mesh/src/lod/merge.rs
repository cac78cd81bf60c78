//! Fewer, larger leaves.

use glam::Vec3;
use pleach_plant::Leaf;

/// Replaces each `run` neighbours of one shape on a stem, at least 1 and on average where it is no whole number, by one
/// leaf with the area of all: the one nearest to their middle, grown about its own centre.
pub(super) fn merge(leaves: &mut Vec<Leaf>, run: f64) {
    if run <= 1.0 {
        return;
    }
    // Generators may mix the leaves of several stems; neighbours on a stem stay neighbours.
    leaves.sort_by_key(|leaf| (leaf.stem, leaf.shape));
    let mut merged = Vec::with_capacity((leaves.len() as f64 / run) as usize + 1);
    let mut before = 0.0_f64;
    for alike in leaves.chunk_by(|a, b| (a.stem, a.shape) == (b.stem, b.shape)) {
        // What a stem has too little of for a whole run counts for the next one.
        let count = ((alike.len() as f64 / run + before) as usize).clamp(1, alike.len());
        before = (alike.len() as f64 / run + before - count as f64).clamp(-1.0, 1.0);
        let end = |group: usize| group * alike.len() / count;
        merged.extend((0..count).filter_map(|group| one_for(&alike[end(group)..end(group + 1)])));
    }
    *leaves = merged;
}

fn one_for(group: &[Leaf]) -> Option<Leaf> {
    let area: f32 = group.iter().map(Leaf::unit_area).sum();
    let middle = group.iter().map(center).sum::<Vec3>() / group.len() as f32;
    let distance = |leaf: &&Leaf| center(leaf).distance_squared(middle);
    let &leaf = group.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let growth = (area / leaf.unit_area().max(f32::MIN_POSITIVE)).sqrt();
    Some(Leaf {
        position: center(&leaf) - leaf.along * (0.5 * growth),
        along: leaf.along * growth,
        across: leaf.across * growth,
        ..leaf
    })
}

fn center(leaf: &Leaf) -> Vec3 {
    leaf.position + leaf.along * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    fn leaf(x: f32, stem: u32, shape: u16) -> Leaf {
        Leaf { position: glam::vec3(x, 0.0, 0.0), along: Vec3::Z, across: Vec3::X, stem, shape }
    }

    #[test]
    fn leaves_of_stems_and_shapes_are_merged_apart() {
        // Two stems take turns, and one of them has leaves of two shapes.
        let mut leaves: Vec<Leaf> = (0..12).map(|i| leaf(i as f32, i % 2, (i % 4 == 3).into())).collect();
        merge(&mut leaves, 3.0);
        let mut kinds: Vec<(u32, u16)> = leaves.iter().map(|leaf| (leaf.stem, leaf.shape)).collect();
        kinds.sort_unstable();
        assert_eq!(kinds, [(0, 0), (0, 0), (1, 0), (1, 1)]);
        assert!(leaves.iter().all(|leaf| (leaf.unit_area() - 3.0).abs() < 1e-5));
    }

    #[test]
    fn a_run_may_be_a_fraction() {
        let leaves: Vec<Leaf> = (0..1000).map(|i| leaf(i as f32, i / 7, 0)).collect();
        for (run, expected) in [(1.25, 800), (1.6, 625), (2.5, 400)] {
            let mut merged = leaves.clone();
            merge(&mut merged, run);
            assert!(merged.len().abs_diff(expected) <= 8, "{run}: {}", merged.len());
            let area: f32 = merged.iter().map(Leaf::unit_area).sum();
            assert!((area - 1000.0).abs() < 0.1, "{run}: {area}");
        }
    }
}
