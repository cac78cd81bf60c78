//! Fits by other evidence than silhouettes: the ink in each row of the picture, wherever in the row it is.
//!
//! ```text
//! cargo run --release -p pleach-fit --example ink_per_row
//! ```

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "an example says what it has found; a test panics"
)]

use pleach_fit::{
    Agreement, AnyEvidence, Budget, Control, Evidence, FitError, FitProblem, FitSettings, GoalView, Outcome,
    PlacedTree, Terms, fit,
};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View, silhouette};
use pleach_tree::Parts;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Ink per row.
#[derive(Debug)]
struct InkPerRow;

impl Evidence for InkPerRow {
    type Goal = Vec<u32>;
    type Memory = (Rasterizer, Bitmap);

    fn prepare(&self, picture: &Bitmap) -> Vec<u32> {
        rows(picture).collect()
    }

    fn draw(&self, placed: &PlacedTree<'_>, (rasterizer, picture): &mut (Rasterizer, Bitmap)) {
        rasterizer.draw(placed.tree, &placed.view, &placed.frame, placed.parts, picture);
    }

    fn compare(&self, goal: &Vec<u32>, _: Terms, (_, picture): &mut (Rasterizer, Bitmap)) -> Agreement {
        let both = goal.iter().zip(rows(picture));
        let (less, more) = both.fold((0, 0), |(less, more), (&a, b)| (less + a.min(b), more + a.max(b)));
        Agreement::from_value(f64::from(less) / f64::from(more.max(1)))
    }
}

fn rows(picture: &Bitmap) -> impl Iterator<Item = u32> {
    (0..picture.height()).map(|y| picture.row(y).iter().map(|word| word.count_ones()).sum())
}

/// A poplar as the goal, and a palm as the start: with this evidence, or by silhouettes.
fn search(evidence: Option<AnyEvidence>, evaluations: u64) -> Result<Outcome, FitError> {
    let [palm, poplar] =
        ["palm", "lombardy_poplar"].map(|name| pleach_generators::preset(name).expect("a known species"));
    let tree = poplar.grow(1).expect("a species grows");
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
    let goal = GoalView::new(silhouette(&tree, View::FRONT, 64), View::FRONT, frame);
    let problem = FitProblem::new(palm, GoalView { evidence, ..goal });
    let settings = FitSettings { budget: Budget::evaluations(evaluations), ..FitSettings::default() };
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    fit(&problem, &settings, Control::new(&clock, &stop))
}

fn main() -> Result<(), FitError> {
    for (name, evidence) in [("silhouette", None), ("ink per row", Some(AnyEvidence::new(InkPerRow)))] {
        let outcome = search(evidence, 1000)?;
        println!(
            "{name}: cost {:.3} after {}",
            outcome.best.map_or(1.0, |best| best.score.cost),
            outcome.evaluations
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_minimises_the_evidence() {
        let by_rows = search(Some(AnyEvidence::new(InkPerRow)), 400).unwrap();
        let first = by_rows.history[0].best_cost;
        let best = by_rows.best.unwrap();
        assert!(best.score.cost < 0.15 && best.score.cost < 0.8 * first, "{} from {first}", best.score.cost);
        assert_eq!((best.score.iou, best.score.likeness), (0.0, None), "no silhouette was compared");
        let by_silhouette = search(None, 400).unwrap().best.unwrap();
        assert!(by_silhouette.score.iou > 0.0 && by_silhouette.genome != best.genome);
    }
}
