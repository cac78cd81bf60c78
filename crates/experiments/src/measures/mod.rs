//! How a tree's silhouette matches the goal's.

mod crown;
mod edges;

use crown::crown;
use edges::boundary_f;
use pleach_reading::Reading;
use pleach_silhouette::score::{ScoreCard, SizeMismatch};
use pleach_silhouette::{Bitmap, Frame, outline};
use pleach_tree::math;

/// Half of the widest gap that a crown's outline closes, in heights of the goal.
const HALF_GAP: f64 = 0.015;
/// Distance within which edges agree, in diagonals of the picture.
const TOLERANCE: f64 = 0.01;

/// How a tree's silhouette matches the goal's; lengths in heights of the goal, unless they are said to be of readings,
/// which have their own tree's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Measures {
    /// Intersection over union.
    pub(super) iou: f64,
    /// The same of the two crowns, gaps closed and holes filled.
    pub(super) crown_iou: f64,
    /// How far the left edge of the silhouette is off, the mean over 48 heights …
    pub(super) left: f64,
    /// … and the right one.
    pub(super) right: f64,
    /// Boundary F-score of all ink …
    pub(super) boundary_f: f64,
    /// … and of the two crowns.
    pub(super) crown_f: f64,
    /// Likeness.
    pub(super) likeness: f64,
    /// Width, as a part of the goal's.
    pub(super) width: f64,
    /// Thickness of the trunk, as a part of the goal's, each in its own tree's heights; `None` where one is not known.
    pub(super) trunk: Option<f64>,
    /// By how many degrees the lean is off; `None` where one is not known.
    pub(super) lean: Option<f64>,
    /// Whether there are as many feet: 1 or 0, or the share of trees that have as many.
    pub(super) feet: f64,
    /// By how much the first fork is off; `None` where one of the two has none.
    pub(super) fork: Option<f64>,
}

impl Measures {
    /// The means of `all`, each over the trees that have it; `None` of no trees.
    pub(super) fn mean(all: &[Self]) -> Option<Self> {
        let mean = |of: &dyn Fn(&Self) -> Option<f64>| {
            let values: Vec<f64> = all.iter().filter_map(of).collect();
            (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
        };
        Some(Self {
            iou: mean(&|one| Some(one.iou))?,
            crown_iou: mean(&|one| Some(one.crown_iou))?,
            left: mean(&|one| Some(one.left))?,
            right: mean(&|one| Some(one.right))?,
            boundary_f: mean(&|one| Some(one.boundary_f))?,
            crown_f: mean(&|one| Some(one.crown_f))?,
            likeness: mean(&|one| Some(one.likeness))?,
            width: mean(&|one| Some(one.width))?,
            trunk: mean(&|one| one.trunk),
            lean: mean(&|one| one.lean),
            feet: mean(&|one| Some(one.feet))?,
            fork: mean(&|one| one.fork),
        })
    }
}

/// A goal that silhouettes are measured against.
pub(super) struct Judge<'a> {
    goal: &'a Bitmap,
    reading: &'a Reading,
    frame: Frame,
    /// In metres.
    height: f64,
    /// Half of the widest gap that is closed, in pixels.
    radius: u32,
    crown: Bitmap,
    /// How far it reaches, in metres.
    outline: Vec<Option<[f64; 2]>>,
}

impl<'a> Judge<'a> {
    /// The goal, what was read in it, and the frame in which its tree is `height` metres high.
    pub(super) fn new(goal: &'a Bitmap, reading: &'a Reading, frame: Frame, height: f64) -> Self {
        let pixels = HALF_GAP * height / frame.meters_per_pixel;
        let radius = (pixels.round() as u32).max(1);
        let outline = outline(goal, &frame, height);
        Self { goal, reading, frame, height, radius, crown: crown(goal, radius), outline }
    }

    /// A silhouette of the goal's size, and what is read in it.
    ///
    /// # Errors
    /// If it is of another size.
    pub(super) fn measure(&self, picture: &Bitmap, reading: &Reading) -> Result<Measures, SizeMismatch> {
        let card = ScoreCard::new(picture, self.goal)?;
        let crown = crown(picture, self.radius);
        let (both, inks) = (self.crown.intersection(&crown), self.crown.ink() + crown.ink());
        let [left, right] = self.off(picture);
        let diagonal = math::hypot(f64::from(self.goal.width()), f64::from(self.goal.height()));
        let tolerance = (TOLERANCE * diagonal).max(1.0);
        let goal = self.reading;
        let distance = |(one, other): (f64, f64)| (one - other).abs();
        Ok(Measures {
            iou: card.iou,
            crown_iou: both as f64 / (inks - both).max(1) as f64,
            left,
            right,
            boundary_f: boundary_f(picture, self.goal, tolerance),
            crown_f: boundary_f(&crown, &self.crown, tolerance),
            likeness: card.likeness,
            width: card.crown.width / card.goal_crown.width,
            trunk: reading.trunk_width().zip(goal.trunk_width()).map(|(tree, goal)| tree / goal),
            lean: reading.lean_deg.zip(goal.lean_deg).map(distance),
            feet: f64::from(u8::from(reading.feet.len() == goal.feet.len())),
            fork: reading.first_fork.zip(goal.first_fork).map(distance),
        })
    }

    /// How far the two sides of `picture` are from the goal's. Where one of the two has no ink, it reaches no farther
    /// than its axis.
    fn off(&self, picture: &Bitmap) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let rows = outline(picture, &self.frame, self.height);
        for (row, goal) in rows.iter().zip(&self.outline) {
            let (row, goal) = (row.unwrap_or_default(), goal.unwrap_or_default());
            for side in 0..2 {
                sum[side] += (row[side] - goal[side]).abs();
            }
        }
        sum.map(|sum| sum / (self.outline.len() as f64 * self.height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_reading::Foot;

    const FRAME: Frame =
        Frame { width: 120, height: 120, meters_per_pixel: 0.1, axis_column: 60.0, ground_row: 110.0 };

    /// A crown of `width` pixels on a trunk, 10 metres high.
    fn tree(width: u32) -> Bitmap {
        Bitmap::from_fn(120, 120, |x, y| {
            let within = |width: u32| (60 - width / 2..60 + width / 2).contains(&x);
            (10..80).contains(&y) && within(width) || (80..110).contains(&y) && within(6)
        })
    }

    fn reading(width: f64, lean: f64, feet: usize) -> Reading {
        Reading {
            feet: vec![Foot { x: 0.0, width }; feet],
            lean_deg: Some(lean),
            first_fork: (feet == 1).then_some(0.3),
            ..Reading::default()
        }
    }

    #[test]
    fn a_goal_matches_itself_and_a_wider_tree_is_wider() {
        let (goal, read) = (tree(40), reading(0.06, 2.0, 1));
        let judge = Judge::new(&goal, &read, FRAME, 10.0);
        let same = judge.measure(&goal, &read).unwrap();
        let perfect = Measures {
            iou: 1.0,
            crown_iou: 1.0,
            boundary_f: 1.0,
            crown_f: 1.0,
            likeness: same.likeness,
            width: 1.0,
            trunk: Some(1.0),
            lean: Some(0.0),
            feet: 1.0,
            fork: Some(0.0),
            ..Measures::default()
        };
        assert_eq!(same, perfect);
        assert!(same.likeness > 0.999);

        let wide = judge.measure(&tree(60), &reading(0.03, -5.0, 2)).unwrap();
        assert_eq!(
            (wide.width, wide.trunk, wide.lean, wide.feet, wide.fork),
            (1.5, Some(0.5), Some(7.0), 0.0, None)
        );
        // Ten pixels to each side, over seven tenths of the height.
        for off in [wide.left, wide.right] {
            assert!((off - 0.07).abs() < 0.004, "{off}");
        }
        assert!((wide.iou - 2980.0 / 4380.0).abs() < 1e-12 && (wide.crown_iou - wide.iou).abs() < 0.02);
        assert!(wide.boundary_f < 0.7 && wide.crown_f < 0.7);
        assert!(judge.measure(&Bitmap::new(9, 9), &read).is_err());
    }

    #[test]
    fn gaps_count_in_the_overlap_and_not_in_that_of_crowns() {
        let (goal, read) = (tree(40), Reading::default());
        let judge = Judge::new(&goal, &read, FRAME, 10.0);
        let airy = Bitmap::from_fn(120, 120, |x, y| goal.get(x, y) && (x % 3 == 0 || y >= 80));
        let measured = judge.measure(&airy, &read).unwrap();
        assert!(measured.iou < 0.5 && measured.crown_iou > 0.9, "{measured:?}");
        assert_eq!((measured.trunk, measured.lean, measured.fork), (None, None, None));
    }

    #[test]
    fn means_are_over_the_trees_that_have_a_measure() {
        let of = |iou: f64, trunk: Option<f64>| Measures { iou, trunk, ..Measures::default() };
        let mean = Measures::mean(&[of(0.2, Some(1.5)), of(0.6, None)]).unwrap();
        assert!((mean.iou - 0.4).abs() < 1e-12);
        assert_eq!((mean.trunk, mean.lean), (Some(1.5), None));
        assert_eq!(Measures::mean(&[]), None);
    }
}
