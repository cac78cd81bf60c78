//! Several trees that all lie on one goal, compared from the side.

use super::drawn::FitDrawing;
use pleach_silhouette::score::{ScoreCard, blurred_iou};
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{Growth, Limits, Species, Tree};
use serde::Serialize;

/// The direction of the view from the side, in degrees from the goal's.
const SIDE: f64 = 90.0;
/// How far the seeds of free trees are from the kind's own: beyond those that it was judged by.
const FIRST_FREE: u64 = 3000;
/// Longer side of a picture over the blur that side views are compared with.
const BLUR: f64 = 64.0;

/// Several trees on one goal: how they match it, and how much they differ in depth, which the goal leaves open.
#[derive(Clone, Debug, Serialize)]
pub struct SidesReport {
    /// The trees, the best first, at the size of the search.
    pub trees: Vec<SideTree>,
    /// The mean blurred IoU (sigma 1/64) of every two of their views from the side: 1 where they are one tree.
    pub side_blurred_iou: f64,
    /// The same of as many free trees of the kind.
    pub free_side_blurred_iou: f64,
}

/// One of several trees on a goal.
#[derive(Clone, Debug, Serialize)]
pub struct SideTree {
    /// Stems with draws of their own.
    pub stems: usize,
    /// Intersection over union with the goal, in 0..=1.
    pub iou: f64,
    /// Likeness to the goal, in 0..=1.
    pub likeness: f64,
    /// Boundary F-score against the goal, in 0..=1.
    pub boundary_f: f64,
    /// From the goal's direction, of the size of the search.
    #[serde(skip)]
    pub front: Bitmap,
    /// From the side, in a square about the trunk.
    #[serde(skip)]
    pub side: Bitmap,
}

/// Draws trees from the front and from the side.
pub(super) struct Sides<'a> {
    drawing: &'a FitDrawing<'a>,
    front_frame: Frame,
    side: View,
    /// A square about the trunk: from the side a tree may be wider than its picture.
    side_frame: Frame,
    trees: Vec<SideTree>,
}

impl<'a> Sides<'a> {
    pub(super) fn new(drawing: &'a FitDrawing<'a>) -> Self {
        let prepared = drawing.prepared;
        let working = prepared.goal.working.frame(prepared.height);
        let front = drawing.problem.goals[0].registered.frame(&working);
        let side = View { azimuth: prepared.view.azimuth + SIDE.to_radians(), ..prepared.view };
        let width = front.width.max(front.height);
        let side_frame = Frame { width, axis_column: f64::from(width) / 2.0, ..front };
        Self { drawing, front_frame: front, side, side_frame, trees: Vec::new() }
    }

    /// Adds the tree of an individual with draws of its own for this number of `stems`.
    pub(super) fn add(
        &mut self,
        tree: &Tree,
        stems: usize,
    ) -> Result<(), pleach_silhouette::score::SizeMismatch> {
        let prepared = self.drawing.prepared;
        let front = self.drawing.draw(tree, &prepared.view, &self.front_frame);
        let card = ScoreCard::new(&front, &prepared.goal.working.bitmap)?;
        let ScoreCard { iou, likeness, boundary_f, .. } = card;
        self.trees.push(SideTree { stems, iou, likeness, boundary_f, front, side: self.side(tree) });
        Ok(())
    }

    fn side(&self, tree: &Tree) -> Bitmap {
        self.drawing.draw(tree, &self.side, &self.side_frame)
    }

    /// The report, if there are several trees; `kind` is the species whose individuals they are.
    pub(super) fn report(self, kind: &Species) -> Option<SidesReport> {
        if self.trees.len() < 2 {
            return None;
        }
        let own = kind.tree_seed.unwrap_or_default();
        let mut free = Vec::new();
        for seed in (0..self.trees.len() as u64).map(|i| own.wrapping_add(FIRST_FREE + i)) {
            let growth = Growth {
                limits: Limits::default(),
                foliage: self.drawing.problem.foliage,
                ..Growth::seed(seed)
            };
            // One that is too large to grow says nothing of the others.
            if let Ok(tree) = kind.grow_with(&growth) {
                free.push(self.side(&tree));
            }
        }
        let sides: Vec<&Bitmap> = self.trees.iter().map(|tree| &tree.side).collect();
        let side_blurred_iou = alike(&sides);
        let free_side_blurred_iou = alike(&free.iter().collect::<Vec<_>>());
        Some(SidesReport { trees: self.trees, side_blurred_iou, free_side_blurred_iou })
    }
}

/// The mean blurred IoU of every two pictures; 1 of less than two.
fn alike(pictures: &[&Bitmap]) -> f64 {
    let pairs = pictures.iter().enumerate().flat_map(|(i, a)| pictures[..i].iter().map(move |b| (a, b)));
    let (sum, count) = pairs.fold((0.0, 0), |(sum, count), (a, b)| {
        let sigma = f64::from(a.width().max(a.height())) / BLUR;
        (sum + blurred_iou(a, b, sigma), count + 1)
    });
    if count == 0 { 1.0 } else { sum / f64::from(count) }
}
