//! Trees with smaller leaves.

use crate::params::{Id, Numbers};
use pleach_tree::leaflet_size;
use pleach_tree::param::table::Parameters;

/// Numbers of leaflets that are offered.
const LEAFLETS: [u32; 3] = [9, 5, 3];
/// Parts of the leaves that get leaflets: leaflets reach further around than their leaf, so that airy crowns have the
/// same ink with fewer.
const PARTS: [f64; 3] = [1.0, 0.85, 0.7];
/// Length of the smallest leaves that are offered, over the tree's height: 9 cm on a tree of 15 m.
const SMALLEST: f64 = 0.006;

/// Lists with leaflets for the simple leaves of `values`; empty where leaves are small or have leaflets already.
pub(crate) fn finer_leaves(values: &[f64]) -> Vec<Vec<f64>> {
    let n = Numbers::read(values);
    let length = n.leaf_length / n.height;
    if n.leaflets > 1 || !n.has_leaves() {
        return Vec::new();
    }
    let is_large = |&&count: &&u32| length * leaflet_size(count) >= SMALLEST;
    let with = |count: u32, part: f64| {
        let mut values = values.to_vec();
        values[Id::leaflets.slot(0).index()] = f64::from(count);
        values[Id::leaf_number.slot(0).index()] *= part;
        values
    };
    let counts = LEAFLETS.iter().filter(is_large);
    counts.flat_map(|&count| PARTS.map(|part| with(count, part))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offered(set: &[(Id, f64)]) -> Vec<(f64, f64)> {
        let mut values = Numbers::space().defaults();
        set.iter().for_each(|&(id, value)| values[id.slot(0).index()] = value);
        let of = |list: &[f64], id: Id| list[id.slot(0).index()];
        let lists = finer_leaves(&values);
        lists.iter().map(|list| (of(list, Id::leaflets), of(list, Id::leaf_number))).collect()
    }

    #[test]
    fn large_leaves_get_leaflets_and_small_ones_do_not() {
        let size =
            |length: f64| offered(&[(Id::height, 10.0), (Id::leaf_length, length), (Id::leaf_number, 10.0)]);
        assert_eq!(size(0.1), [(3.0, 10.0), (3.0, 8.5), (3.0, 7.0)]);
        let counts = |length: f64| size(length).iter().map(|one| one.0).collect::<Vec<_>>();
        assert_eq!(counts(0.3), [9.0, 9.0, 9.0, 5.0, 5.0, 5.0, 3.0, 3.0, 3.0]);
        assert_eq!(size(0.05), []);
        assert_eq!(offered(&[(Id::leaf_length, 1.0), (Id::leaflets, 3.0)]), []);
        assert_eq!(offered(&[(Id::leaf_length, 1.0), (Id::leaf_number, 0.0)]), []);
    }
}
