//! A goal's silhouette and what is read in it as evidence: trees are compared by their ink, and by how they stand.

use super::silhouette::{Silhouette, SilhouetteGoal, SilhouetteMemory};
use crate::problem::{Agreement, Evidence, Objective, PlacedTree, Terms};
use pleach_reading::{Reader, Reading};
use pleach_silhouette::Bitmap;
use pleach_tree::StemKind;

/// The silhouette of a goal and what is read in it: trunks, lean, bare height, outline, gaps, which
/// way twigs run, and how much is foliage.
///
/// Every tree is read from its own picture by the code that read the goal, and [`Reading::distance`] takes its part of
/// the value of [`Objective::Balance`]. The other objectives are those of [`Silhouette`].
#[derive(Clone, Debug, Default)]
pub struct MeasuredSilhouette {
    /// What is in the goal, where somebody knows it better; `None`: it is read.
    pub reading: Option<Reading>,
}

/// The part of the value that measures make up.
const SHARE: f64 = 0.3;

/// A goal for [`MeasuredSilhouette`].
#[derive(Debug)]
pub struct MeasuredGoal {
    silhouette: SilhouetteGoal,
    reading: Reading,
}

/// The silhouette of a tree, what is read in it, and buffers.
#[derive(Debug, Default)]
pub struct MeasuredMemory {
    silhouette: SilhouetteMemory,
    reader: Reader,
    reading: Reading,
    stems: Bitmap,
    trunks: u32,
}

impl Evidence for MeasuredSilhouette {
    type Goal = MeasuredGoal;
    type Memory = MeasuredMemory;

    fn prepare(&self, picture: &Bitmap) -> MeasuredGoal {
        let reading = self.reading.clone().unwrap_or_else(|| Reading::from_silhouette(picture));
        MeasuredGoal { silhouette: SilhouetteGoal::new(picture), reading }
    }

    fn draw(&self, placed: &PlacedTree<'_>, memory: &mut MeasuredMemory) {
        memory.silhouette.draw_with_stems(placed, &mut memory.stems);
        let trunks = placed.tree.stems.iter().filter(|stem| stem.kind == StemKind::Trunk);
        memory.trunks = trunks.count() as u32;
    }

    fn compare(&self, goal: &MeasuredGoal, terms: Terms, memory: &mut MeasuredMemory) -> Agreement {
        let agreement = Silhouette.compare(&goal.silhouette, terms, &mut memory.silhouette);
        if terms.objective != Objective::Balance {
            return agreement;
        }
        memory.reader.read(memory.silhouette.picture(), &mut memory.reading);
        let (stems, all) = (memory.stems.ink() as f64, memory.silhouette.picture().ink() as f64);
        memory.reading.foliage_share = (all > 0.0).then(|| 1.0 - stems / all);
        // One trunk may divide below the ground; several stand beside each other.
        let trunks = (memory.trunks > 1).then_some(memory.trunks);
        let distance = goal.reading.distance(&memory.reading, trunks);
        Agreement { value: agreement.value * (1.0 - SHARE) + SHARE * (1.0 - distance), ..agreement }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A round crown, with level or upright strokes, on a trunk.
    fn picture(upright: bool) -> Bitmap {
        Bitmap::from_fn(256, 256, |x, y| {
            let (across, down) = (i64::from(x) - 128, i64::from(y) - 100);
            let stroke = if upright { across } else { down };
            across.abs() < 6 && y < 250 && y > 60
                || across * across + down * down < 80 * 80 && stroke.rem_euclid(12) < 5
        })
    }

    #[test]
    fn a_tree_is_nearer_whose_twigs_run_as_the_goals_do() {
        let evidence = MeasuredSilhouette::default();
        let goal = evidence.prepare(&picture(false));
        let value = |tree: &Bitmap, objective| {
            let mut memory = MeasuredMemory { trunks: 1, ..MeasuredMemory::default() };
            memory.silhouette.set_picture(tree);
            evidence.compare(&goal, Terms { objective, likeness: false }, &mut memory).value
        };
        let [own, other] = [false, true].map(|upright| value(&picture(upright), Objective::Balance));
        assert!((own - 1.0).abs() < 1e-9, "{own}");
        let silhouette = {
            let mut memory = SilhouetteMemory::default();
            memory.set_picture(&picture(true));
            let terms = Terms { objective: Objective::Balance, likeness: false };
            Silhouette.compare(&goal.silhouette, terms, &mut memory).value
        };
        let measures = (other - silhouette * (1.0 - SHARE)) / SHARE;
        assert!(measures < 0.9, "{measures}");
        // Of other objectives measures are no part.
        let terms = Terms { objective: Objective::Iou, likeness: false };
        let mut memory = SilhouetteMemory::default();
        memory.set_picture(&picture(true));
        let iou = Silhouette.compare(&goal.silhouette, terms, &mut memory).value;
        assert_eq!(value(&picture(true), Objective::Iou), iou);
    }
}
