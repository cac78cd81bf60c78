//! How many branches a tree has for certain, by its numbers alone.
//!
//! A lower bound: trees that are certain to be too large are refused before anything grows, and no
//! others. Where nothing is left to chance it is the exact number.

use crate::model::Model;
use crate::params::Id;
use pleach_tree::{Blame, GrowError, Growth, Limits};

/// Branches shorter than this part of the trunk are left out: as the apical ratio goes to 0, central
/// branches shrink to nothing, and so does their number.
pub(crate) const MIN_LENGTH: f64 = 1e-4;

/// The least number of branches, the trunk included, and of stems, of which a branch and its central
/// daughter are one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Certain {
    branches: f64,
    stems: f64,
}

/// The parameters that make a tree large.
pub(crate) fn blame(model: &Model) -> Blame {
    let central = model.has_central().then_some(Id::apical_ratio);
    let large = [Id::generations, Id::side_branches].into_iter().chain(central);
    Blame(large.map(|id| id.slot_name(0)).collect())
}

/// The error of a tree that is certain to be too large.
pub(crate) fn refusal(model: &Model, growth: &Growth) -> Option<GrowError> {
    let Certain { branches, stems } = Certain::new(model);
    let Limits { stems: max_stems, knots, work, .. } = growth.limits;
    let blame = || blame(model);
    if branches > work as f64 {
        Some(GrowError::TooMuchWork { limit: work, blame: blame() })
    } else if stems > max_stems as f64 {
        Some(GrowError::TooManyStems { limit: max_stems, blame: blame() })
    } else if branches + stems > knots as f64 {
        Some(GrowError::TooManyKnots { limit: knots, blame: blame() })
    } else {
        None
    }
}

impl Certain {
    fn new(model: &Model) -> Self {
        let sides = &model.side_branches;
        let sides = f64::from(Model::sides(sides.nominal - sides.deviation));
        let scale = model.scale.nominal - model.scale.deviation;
        let apical = model.apical_ratio.nominal - model.apical_ratio.deviation;
        let side = Model::side_scale(scale);
        let mut certain = Self::tree(sides, 0.0, generations(model, side));
        if model.has_central() {
            let central = Model::central_scale(scale, apical);
            let whole = Self::tree(sides, 1.0, generations(model, side.min(central)));
            // Where central branches are soon too short, there are the side branches' own.
            certain.branches = certain.branches.max(whole.branches);
            certain.stems = certain.stems.max(whole.stems);
        }
        certain
    }

    /// A tree without chance: as many `sides` and `central` branches at each node.
    fn tree(sides: f64, central: f64, generations: u16) -> Self {
        let (mut generation, mut branches, mut stems) = (1.0, 1.0, 1.0);
        for _ in 0..generations {
            stems += generation * sides;
            generation *= sides + central;
            branches += generation;
        }
        Self { branches, stems }
    }
}

/// Generations that are all there, if no branch is shorter than `scale` times its parent.
fn generations(model: &Model, scale: f64) -> u16 {
    let kept = if model.drop > 0.0 { model.drop_from - 1 } else { model.generations };
    let most = kept.min(model.generations);
    let mut length = 1.0;
    // Twice the least length, so that rounding does not decide.
    let is_long = |_: &u16| {
        length *= scale;
        length >= 2.0 * MIN_LENGTH
    };
    (0..most).take_while(is_long).count() as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Numbers;
    use pleach_tree::param::table::Parameters;

    fn values(set: &[(Id, f64)]) -> Vec<f64> {
        let mut values = Numbers::space().defaults();
        set.iter().for_each(|&(id, value)| values[id.slot(0).index()] = value);
        values
    }

    fn certain(set: &[(Id, f64)]) -> (f64, f64) {
        let Certain { branches, stems } = Certain::new(&Model::new(&values(set)));
        (branches, stems)
    }

    #[test]
    fn regular_trees_are_counted_exactly() {
        use Id::{apical_ratio, generations, side_branches};
        assert_eq!(certain(&[(generations, 9.0)]), (1023.0, 1023.0));
        assert_eq!(certain(&[(generations, 9.0), (apical_ratio, 1.0)]), (29_524.0, 19_683.0));
        let [branches, _] = [certain(&[(generations, 14.0), (apical_ratio, 1.0)]).0, 0.0];
        assert_eq!(branches, 7_174_453.0);
        assert_eq!(certain(&[(generations, 60.0), (side_branches, 0.0)]), (1.0, 1.0));
    }

    #[test]
    fn what_is_left_to_chance_is_not_certain() {
        use Id::{apical_ratio, drop, drop_from, generations, side_branches_v};
        assert_eq!(certain(&[(generations, 9.0), (drop, 0.1), (drop_from, 3.0)]), (7.0, 7.0));
        assert_eq!(certain(&[(generations, 3.0), (side_branches_v, 1.0)]), (4.0, 4.0));
        // Central branches so short that they are left out.
        assert_eq!(certain(&[(generations, 3.0), (apical_ratio, 1e-5)]), (15.0, 15.0));
    }

    #[test]
    fn a_tree_of_sixty_generations_is_refused_with_the_blame() {
        for apical in [0.0, 1.0] {
            let model =
                Model::new(&values(&[(Id::generations, 60.0), (Id::apical_ratio, apical), (Id::scale, 1.0)]));
            let told = refusal(&model, &Growth::seed(1)).unwrap().to_string();
            assert!(told.contains("more than 40000000 steps, because of `generations`"), "{told}");
        }
        let model = Model::new(&values(&[(Id::generations, 13.0), (Id::apical_ratio, 1.0)]));
        let told = refusal(&model, &Growth::seed(1)).unwrap().to_string();
        assert!(
            told.contains("500000 stems, because of `generations`, `side_branches` and `apical_ratio`"),
            "{told}"
        );
        assert_eq!(refusal(&Model::new(&Numbers::space().defaults()), &Growth::seed(1)), None);
    }
}
