//! The silhouette of a goal as evidence: the ink of a tree against the ink of its picture.

use crate::problem::{Agreement, Evidence, Objective, PlacedTree, Terms};
use pleach_silhouette::score::fast::{Overlaps, PreparedGoal, Scratch};
use pleach_silhouette::score::likeness::{self, Descriptor};
use pleach_silhouette::{Bitmap, Detail, Rasterizer};
use pleach_tree::math;

/// The silhouette of a goal: the evidence of goals that have no other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silhouette;

/// A silhouette that others are compared with.
#[derive(Debug)]
pub struct SilhouetteGoal {
    pub(crate) picture: Bitmap,
    overlaps: PreparedGoal,
    descriptor: Descriptor,
}

/// The silhouette of a tree, and buffers to draw and compare it.
#[derive(Debug)]
pub struct SilhouetteMemory {
    rasterizer: Rasterizer,
    picture: Bitmap,
    buffers: Buffers,
}

/// Buffers of comparisons.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    overlaps: Scratch,
    likeness: likeness::Scratch,
}

impl Default for SilhouetteMemory {
    fn default() -> Self {
        Self {
            rasterizer: Rasterizer::for_searches(Detail::Half),
            picture: Bitmap::default(),
            buffers: Buffers::default(),
        }
    }
}

impl SilhouetteMemory {
    /// Draws `placed`, and its stems alone into `stems`.
    pub(super) fn draw_with_stems(&mut self, placed: &PlacedTree<'_>, stems: &mut Bitmap) {
        let PlacedTree { tree, view, frame, parts, helpers } = placed;
        let pictures = [stems, &mut self.picture];
        self.rasterizer.helped(*helpers).draw_with_stems(tree, view, frame, *parts, pictures);
    }

    /// The picture of the tree that was drawn last.
    pub(super) const fn picture(&self) -> &Bitmap {
        &self.picture
    }

    #[cfg(test)]
    pub(super) fn set_picture(&mut self, picture: &Bitmap) {
        self.picture.clone_from(picture);
    }
}

impl Evidence for Silhouette {
    type Goal = SilhouetteGoal;
    type Memory = SilhouetteMemory;

    fn prepare(&self, picture: &Bitmap) -> SilhouetteGoal {
        SilhouetteGoal::new(picture)
    }

    fn draw(&self, placed: &PlacedTree<'_>, memory: &mut SilhouetteMemory) {
        let PlacedTree { tree, view, frame, parts, helpers } = placed;
        memory.rasterizer.helped(*helpers).draw(tree, view, frame, *parts, &mut memory.picture);
    }

    fn compare(&self, goal: &SilhouetteGoal, terms: Terms, memory: &mut SilhouetteMemory) -> Agreement {
        goal.compare(&memory.picture, terms, &mut memory.buffers)
    }
}

impl SilhouetteGoal {
    pub(crate) fn new(picture: &Bitmap) -> Self {
        Self {
            picture: picture.clone(),
            overlaps: PreparedGoal::new(picture),
            descriptor: Descriptor::new(picture, &mut likeness::Scratch::default()),
        }
    }

    /// How `picture` agrees with the goal.
    pub(crate) fn compare(&self, picture: &Bitmap, terms: Terms, buffers: &mut Buffers) -> Agreement {
        let overlaps = self.overlaps.overlaps(picture, &mut buffers.overlaps);
        let accuracy = 1.0 - overlaps.differing as f64 / self.picture.area() as f64;
        let iou = overlaps.iou();
        let likeness = (terms.likeness || terms.objective.uses_likeness()).then(|| {
            let descriptor = Descriptor::new(picture, &mut buffers.likeness);
            self.descriptor.compare(&descriptor).value()
        });
        let alike = likeness.unwrap_or_default();
        let value = match terms.objective {
            Objective::Accuracy => accuracy,
            Objective::Iou => iou,
            Objective::Blend => blend(&overlaps),
            Objective::Likeness => alike,
            Objective::Balance => f64::midpoint(blend(&overlaps), alike),
            Objective::Overlap => {
                f64::midpoint(iou, blend(&overlaps)) * math::powi((alike / MAX_LIKENESS).min(1.0), 2)
            }
        };
        Agreement { value, iou, accuracy, likeness }
    }
}

/// Likeness above which [`Objective::Overlap`] does not rise any more: a little less than two trees of a species
/// have to each other, and enough for 0.75 where a picture is drawn more finely than in a search.
const MAX_LIKENESS: f64 = 0.765;

/// The mean of overlaps over cell sizes: cells of 32, 16, 8, 4 and 2 pixels, then single pixels.
///
/// All weigh the same: chosen by experiment over the fifteen species.
pub(crate) fn blend(overlaps: &Overlaps) -> f64 {
    // `pyramid` goes from cells of 2 pixels up. The order of the sum decides its last bit.
    let scales = overlaps.pyramid.iter().rev().copied().chain([overlaps.iou()]);
    let (sum, count) = scales.fold((0.0, 0.0), |(sum, count), overlap| (sum + overlap, count + 1.0));
    sum / count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A filled box.
    fn picture(left: u32, right: u32) -> Bitmap {
        Bitmap::from_fn(64, 64, |x, y| (8..60).contains(&y) && (left..right).contains(&x))
    }

    #[test]
    fn overlap_counts_nearness_up_to_a_likeness() {
        let goal = SilhouetteGoal::new(&picture(20, 40));
        let agreement = |picture: &Bitmap, objective| {
            goal.compare(picture, Terms { objective, likeness: true }, &mut Buffers::default())
        };
        for (left, right) in [(20, 40), (21, 40), (4, 60)] {
            let picture = picture(left, right);
            let found = agreement(&picture, Objective::Overlap);
            let overlaps = f64::midpoint(found.iou, agreement(&picture, Objective::Blend).value);
            let share = (found.likeness.unwrap() / MAX_LIKENESS).min(1.0);
            assert!((found.value - overlaps * share * share).abs() < 1e-12, "{left} to {right}");
        }
        // Beside each other: a search sees which of two is nearer.
        let [near, far] = [(42, 60), (50, 60)].map(|(l, r)| agreement(&picture(l, r), Objective::Overlap));
        assert!(near.iou == 0.0 && far.iou == 0.0 && near.value > far.value);
    }
}
