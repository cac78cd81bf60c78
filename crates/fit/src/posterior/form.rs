//! The form of a tree, and how far it is from that of its species.

use pleach_tree::{Growth, Parts, Species, Tree, Workspace};

/// Trees of the species that its form is the mean of: their seeds.
const SEEDS: std::ops::RangeInclusive<u64> = 1..=3;
/// How many times as many stems, or as much leaf area, a tree may have as its species, and the reverse.
const AMOUNT: f64 = 4.0;
/// How many times as wide for its height it may be, and the reverse.
const WIDTH: f64 = 2.0;

/// What a person sees first: how much there is of a tree, and how wide it is for its height.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Form {
    /// Stems on each level, roots left out.
    stems: Vec<f64>,
    /// Area of leaves and blossoms by the square of the height of the stems.
    foliage: f64,
    /// Larger of the two extents of the stems by their height.
    width: f64,
}

impl Form {
    /// The form of `tree`; `None` of a tree without height.
    pub(super) fn new(tree: &Tree) -> Option<Self> {
        let above_ground = || tree.stems.iter().filter(|stem| Parts::LEAFY.has_stem(stem.kind));
        let points = || above_ground().flat_map(|stem| tree.knots_of(stem)).map(|knot| knot.point);
        let mut stems = vec![0.0; tree.level_count()];
        above_ground().for_each(|stem| stems[usize::from(stem.level)] += 1.0);
        let extent = points().reduce(|a, b| a.max(b))? - points().reduce(|a, b| a.min(b))?;
        if extent.z <= 0.0 {
            return None;
        }
        let leaves = tree.leaves.iter().map(|leaf| leaf.unit_area() * tree.outline_of(leaf).area());
        let of_blossom = |shape: u16| tree.blossom_shapes[usize::from(shape)].faces().area();
        let blossoms = tree.blossoms.iter().map(|leaf| leaf.unit_area() * of_blossom(leaf.shape));
        let area = leaves.chain(blossoms).fold(0.0, |sum, area| sum + f64::from(area));
        Some(Self { stems, foliage: area / (extent.z * extent.z), width: extent.x.max(extent.y) / extent.z })
    }

    /// The mean form of some trees of `species`; `None` where they do not grow within the limits of `growth`.
    pub(super) fn of_species(species: &Species, growth: &Growth<'_>) -> Option<Self> {
        let (mut workspace, mut tree) = (Workspace::default(), Tree::default());
        let mut sum = Self::default();
        for seed in SEEDS {
            let growth = Growth { seed, ..*growth };
            species.generator.grow(&species.params, &growth, &mut workspace, &mut tree).ok()?;
            let one = Self::new(&tree)?;
            sum.stems.resize(sum.stems.len().max(one.stems.len()), 0.0);
            sum.stems.iter_mut().zip(&one.stems).for_each(|(sum, count)| *sum += count);
            sum.foliage += one.foliage;
            sum.width += one.width;
        }
        let count = SEEDS.count() as f64;
        Some(Self {
            stems: sum.stems.iter().map(|stems| stems / count).collect(),
            foliage: sum.foliage / count,
            width: sum.width / count,
        })
    }

    /// How many times too much or too little `tree` has of anything, by the bounds of the amounts: at most 1 where it
    /// is within all of them. What this form has less than one of may be there or not.
    pub(super) fn distance(&self, tree: &Self) -> f64 {
        let stems = self.stems.iter().enumerate().filter(|(_, own)| **own >= 1.0);
        let stems = stems.map(|(level, own)| (*own, tree.stems.get(level).copied().unwrap_or(0.0), AMOUNT));
        let others = [(self.foliage, tree.foliage, AMOUNT), (self.width, tree.width, WIDTH)];
        let others = others.into_iter().filter(|(own, ..)| *own > 0.0);
        let beyond = |(own, other, bound): (f64, f64, f64)| (own / other).max(other / own) / bound;
        stems.chain(others).map(beyond).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(stems: &[f64], foliage: f64, width: f64) -> Form {
        Form { stems: stems.to_vec(), foliage, width }
    }

    #[test]
    fn a_tree_is_as_far_as_the_amount_that_is_farthest_off() {
        let own = form(&[1.0, 20.0, 0.5], 3.0, 0.5);
        assert_eq!(own.distance(&own), 0.5, "the same, of at most twice as wide");
        assert_eq!(own.distance(&form(&[1.0, 80.0], 3.0, 0.5)), 1.0);
        assert_eq!(own.distance(&form(&[1.0, 5.0, 9.0, 9.0], 3.0, 0.5)), 1.0, "other levels are no matter");
        assert_eq!(own.distance(&form(&[1.0, 20.0], 24.0, 0.5)), 2.0);
        assert_eq!(own.distance(&form(&[1.0, 20.0], 3.0, 2.0)), 2.0);
        assert_eq!(own.distance(&form(&[1.0, 20.0], 0.0, 0.5)), f64::INFINITY, "no leaves");
        assert_eq!(own.distance(&form(&[1.0], 3.0, 0.5)), f64::INFINITY, "no branches");
        let bare = form(&[1.0, 20.0], 0.0, 0.5);
        assert_eq!(bare.distance(&form(&[1.0, 20.0], 7.0, 0.5)), 0.5);
    }

    #[test]
    fn the_form_of_a_species_is_that_of_its_trees() {
        let palm = pleach_generators::preset("palm").unwrap();
        let own = Form::of_species(&palm, &Growth::default()).unwrap();
        assert_eq!(own.stems[0], 1.0);
        let tree = Form::new(&palm.grow(9).unwrap()).unwrap();
        assert!(own.distance(&tree) < 1.0);
        let bare = Growth { foliage: pleach_tree::Foliage::None, ..Growth::default() };
        assert_eq!(Form::of_species(&palm, &bare).unwrap().foliage, 0.0);
        assert_eq!(Form::new(&Tree::default()), None);
    }
}
