//! What a contestant answers to a goal, and how it is measured.

use super::goal::Goal;
use super::row::Row;
use crate::fresh::fresh;
use crate::measures::Judge;
use crate::pictured::draw;
use crate::record::Fixed;
use pleach_reading::Reading;
use pleach_silhouette::Bitmap;
use pleach_tree::Species;

/// Trees of other seeds have those after this: the same for all contestants, and far from all that a fit looks at.
const OTHERS: u64 = 7_770_000;

/// An answer.
#[derive(Clone, Debug)]
pub(super) enum Answer {
    /// A tree: a species, whose foliage says whether it has leaves, and a seed.
    Tree { species: Box<Species>, seed: u64 },
    /// A silhouette of the goal's size.
    Picture(Bitmap),
    /// Nothing that could be drawn.
    Nothing,
}

impl Answer {
    pub(super) fn tree(species: Species, seed: u64) -> Self {
        Self::Tree { species: Box::new(species), seed }
    }

    /// The answer's row, measured; what identifies it is the caller's.
    ///
    /// # Errors
    /// A picture of another size, or an interruption.
    pub(super) fn row(&self, goal: &Goal) -> anyhow::Result<Row> {
        let (picture, tree) = match self {
            Self::Picture(picture) => (picture.clone(), None),
            Self::Nothing => (Bitmap::new(goal.picture().width(), goal.picture().height()), None),
            Self::Tree { species, seed } => {
                let drawn = draw(species, *seed, species.foliage, &goal.problem.goals[0]);
                // One that is too large to grow is like nothing.
                let empty = || Bitmap::new(goal.picture().width(), goal.picture().height());
                (drawn.unwrap_or_else(|_| empty()), Some(species))
            }
        };
        let mut row = measured(goal, &picture)?;
        if matches!(self, Self::Nothing) {
            row.fresh = Some(Fixed(0.0));
        }
        if let Some(species) = tree {
            species.generator.family().clone_into(&mut row.family);
            row.species.clone_from(&species.name);
            row.fresh = Some(Fixed(fresh(&goal.problem, species, OTHERS)?));
            if let Some(own) = &goal.own {
                row.side = Some(Fixed(fresh(&own.side, species, OTHERS)?));
                row.numbers_off = own.truth.numbers_off(species).map(Fixed);
            }
        }
        Ok(row)
    }
}

/// The measures that need no tree.
fn measured(goal: &Goal, picture: &Bitmap) -> anyhow::Result<Row> {
    let read = Reading::from_silhouette(goal.picture());
    let judge = Judge::new(goal.picture(), &read, *goal.frame(), goal.height());
    let own = Reading::from_silhouette(picture);
    let measures = judge.measure(picture, &own)?;
    let fixed = |value: f64| Some(Fixed(value));
    let architecture = if picture.ink() == 0 { 0.0 } else { 1.0 - read.distance(&own, None) };
    Ok(Row {
        goal: goal.name.clone(),
        set: goal.set,
        group: goal.group.clone(),
        likeness: fixed(measures.likeness),
        iou: fixed(measures.iou),
        boundary_f: fixed(measures.boundary_f),
        crown_iou: fixed(measures.crown_iou),
        architecture: fixed(architecture),
        ..Row::default()
    })
}

#[cfg(test)]
mod tests {
    use super::super::goal::Origin;
    use super::*;
    use pleach_silhouette::score::best_ellipse;

    fn value(cell: Option<Fixed<4>>) -> f64 {
        cell.unwrap().0
    }

    #[test]
    fn the_goals_own_tree_is_perfect_and_nothing_is_nothing() {
        let goal = Origin::Around { species: "lombardy_poplar", number: 1 }.goal().unwrap();
        let own = goal.own.clone().unwrap();
        let row = Answer::tree(own.truth.species.clone(), own.truth.seed).row(&goal).unwrap();
        for cell in [row.iou, row.boundary_f, row.crown_iou, row.architecture] {
            assert_eq!(value(cell), 1.0, "{row:?}");
        }
        assert_eq!(row.numbers_off, Some(Fixed(0.0)));
        // Trees of other seeds are alike from both sides, and are not the same.
        for cell in [row.fresh, row.side] {
            assert!((0.6..0.999).contains(&value(cell)), "{row:?}");
        }
        assert_ne!(row.fresh, row.side);
        let ellipse = Answer::Picture(best_ellipse(goal.picture())).row(&goal).unwrap();
        assert!(value(ellipse.iou) > 0.3 && value(ellipse.likeness) < value(row.fresh), "{ellipse:?}");
        assert!(ellipse.fresh.is_none() && ellipse.side.is_none() && ellipse.family.is_empty());
        let nothing = Answer::Nothing.row(&goal).unwrap();
        for cell in [nothing.fresh, nothing.likeness, nothing.iou, nothing.boundary_f, nothing.architecture] {
            assert_eq!(value(cell), 0.0, "{nothing:?}");
        }
        assert!(Answer::Picture(Bitmap::new(9, 9)).row(&goal).is_err());
    }
}
