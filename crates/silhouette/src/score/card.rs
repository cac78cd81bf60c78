//! The score card: every measure beside what says nothing would have.

use super::blur::blurred_iou;
use super::distance::squared_distances;
use super::ellipse::best_ellipse_iou;
use super::likeness::Likeness;
use crate::bitmap::Bitmap;
use pleach_plant::math;
use serde::Serialize;

/// The scores of a picture against a goal of the same size. The names are those of the JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ScoreCard {
    /// Share of equal pixels, in 0..=1 (Hewitt 2017, §4.4.2). Flatters sparse goals: see
    /// `empty_accuracy`.
    pub pixel_accuracy: f64,
    /// Pixel accuracy of an empty picture.
    pub empty_accuracy: f64,
    /// Intersection over union of the ink, in 0..=1; 1 where both are empty. Flatters blobs: see
    /// `best_ellipse_iou`.
    pub iou: f64,
    /// IoU of the best single ellipse, see [`best_ellipse_iou`].
    pub best_ellipse_iou: f64,
    /// Twice the intersection over the sum of the inks (Dice 1945), in 0..=1.
    pub dice: f64,
    /// Boundary F-score, in 0..=1: harmonic mean of the shares of each outline that the other passes
    /// within 0.75 % of the picture's diagonal (Martin, Fowlkes and Malik 2004).
    pub boundary_f: f64,
    /// Chamfer distance: mean distance from each outline to the other, both ways, in picture heights;
    /// 0 is best. The diagonal where only one has ink.
    pub chamfer: f64,
    /// Soft IoU after blurring, see [`BlurredIou`].
    pub blurred_iou: BlurredIou,
    /// How much the two look like trees of one kind, in 0..=1, see [`super::likeness`].
    pub likeness: f64,
    /// The parts of which `likeness` is the weighted mean.
    pub likeness_parts: Likeness,
    /// Numbers of the picture's crown.
    pub crown: Crown,
    /// The same numbers of the goal's.
    pub goal_crown: Crown,
}

/// Σ min / Σ max of the two pictures blurred by a Gaussian, in 0..=1, at three widths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BlurredIou {
    /// Sigma of 1/16 of the picture's height.
    #[serde(rename = "16")]
    pub sixteenth: f64,
    /// Sigma of 1/32.
    #[serde(rename = "32")]
    pub thirty_second: f64,
    /// Sigma of 1/64.
    #[serde(rename = "64")]
    pub sixty_fourth: f64,
}

/// What the shape of a silhouette is like. Lengths in picture heights; all 0 without ink.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Crown {
    /// Share of inked pixels, in 0..=1.
    pub ink: f64,
    /// From the highest to the lowest ink.
    pub height: f64,
    /// From the leftmost to the rightmost ink.
    pub width: f64,
    /// Height of the ink's centroid above the lowest ink.
    pub centroid_height: f64,
    /// Height above the lowest ink up to which rows are narrower than a quarter of the widest.
    pub bare_height: f64,
}

/// Two pictures of different sizes cannot be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the picture has {} × {} pixels and the goal {} × {}; both must have one size", image.0, image.1, goal.0, goal.1)]
pub struct SizeMismatch {
    /// Width and height of the picture.
    pub image: (u32, u32),
    /// Width and height of the goal.
    pub goal: (u32, u32),
}

/// Distance within which outlines agree, as a part of the diagonal.
const BOUNDARY_TOLERANCE: f64 = 0.0075;
/// Rows narrower than this part of the widest are bare trunk.
const BARE: f64 = 0.25;

impl ScoreCard {
    /// Scores `image` against `goal`.
    ///
    /// ```
    /// use pleach_silhouette::Bitmap;
    /// use pleach_silhouette::score::ScoreCard;
    ///
    /// let disc = |r: i64| Bitmap::from_fn(64, 64, |x, y| (i64::from(x) - 32).pow(2) + (i64::from(y) - 32).pow(2) < r * r);
    /// let card = ScoreCard::new(&disc(20), &disc(28))?;
    /// assert!((card.iou - (20.0_f64 / 28.0).powi(2)).abs() < 0.02);
    /// # Ok::<(), pleach_silhouette::score::SizeMismatch>(())
    /// ```
    ///
    /// # Errors
    /// If they differ in size.
    pub fn new(image: &Bitmap, goal: &Bitmap) -> Result<Self, SizeMismatch> {
        let sizes = ((image.width(), image.height()), (goal.width(), goal.height()));
        if sizes.0 != sizes.1 {
            return Err(SizeMismatch { image: sizes.0, goal: sizes.1 });
        }
        let area = goal.area().max(1) as f64;
        let (a, b) = (image.ink(), goal.ink());
        let both = image.intersection(goal);
        let ratio = |part: u64, whole: u64| if whole == 0 { 1.0 } else { part as f64 / whole as f64 };
        let (boundary_f, chamfer) = outlines(image, goal);
        let likeness = Likeness::between(image, goal);
        let blurred = |part: f64| blurred_iou(image, goal, f64::from(goal.height()) / part);
        Ok(Self {
            pixel_accuracy: 1.0 - image.differing(goal) as f64 / area,
            empty_accuracy: 1.0 - b as f64 / area,
            iou: ratio(both, a + b - both),
            best_ellipse_iou: best_ellipse_iou(goal),
            dice: ratio(2 * both, a + b),
            boundary_f,
            chamfer,
            blurred_iou: BlurredIou {
                sixteenth: blurred(16.0),
                thirty_second: blurred(32.0),
                sixty_fourth: blurred(64.0),
            },
            likeness: likeness.value(),
            likeness_parts: likeness,
            crown: Crown::new(image),
            goal_crown: Crown::new(goal),
        })
    }
}

/// Inked pixels with paper to a side; beyond the edges is paper.
fn outline(bitmap: &Bitmap) -> Bitmap {
    Bitmap::from_fn(bitmap.width(), bitmap.height(), |x, y| {
        let beside = |x: Option<u32>, y: Option<u32>| x.zip(y).is_some_and(|(x, y)| bitmap.get(x, y));
        bitmap.get(x, y)
            && !(beside(x.checked_sub(1), Some(y))
                && beside(Some(x + 1), Some(y))
                && beside(Some(x), y.checked_sub(1))
                && beside(Some(x), Some(y + 1)))
    })
}

/// Boundary F-score and chamfer distance.
fn outlines(image: &Bitmap, goal: &Bitmap) -> (f64, f64) {
    let height = f64::from(goal.height());
    let diagonal = math::hypot(f64::from(goal.width()), height);
    match (image.ink(), goal.ink()) {
        (0, 0) => return (1.0, 0.0),
        (0, _) | (_, 0) => return (0.0, diagonal / height),
        _ => {}
    }
    let (a, b) = (outline(image), outline(goal));
    let tolerance = (BOUNDARY_TOLERANCE * diagonal).max(1.0);
    // Share of `of` within the tolerance of `to`, and mean distance.
    let directed = |of: &Bitmap, to: &Bitmap| {
        let field = squared_distances(to);
        let (mut near, mut sum, mut n) = (0.0, 0.0, 0.0);
        for y in 0..of.height() {
            for x in of.ink_in_row(y) {
                let distance = f64::from(field[(y * of.width() + x) as usize]).sqrt();
                near += f64::from(u8::from(distance <= tolerance));
                sum += distance;
                n += 1.0;
            }
        }
        (near / n, sum / n)
    };
    let ((precision, to_goal), (recall, from_goal)) = (directed(&a, &b), directed(&b, &a));
    let f = if precision + recall > 0.0 { 2.0 * precision * recall / (precision + recall) } else { 0.0 };
    (f, f64::midpoint(to_goal, from_goal) / height)
}

impl Crown {
    /// Measures `bitmap`.
    #[must_use]
    pub fn new(bitmap: &Bitmap) -> Self {
        let Some((left, top, right, bottom)) = bitmap.ink_box() else { return Self::default() };
        let unit = 1.0 / f64::from(bitmap.height());
        let reach = |y: u32| {
            let mut xs = bitmap.ink_in_row(y);
            let first = xs.next();
            first.map_or(0, |first| xs.last().unwrap_or(first) - first + 1)
        };
        let widest = (top..=bottom).map(reach).max().unwrap_or(0);
        let bare =
            (top..=bottom).rev().take_while(|&y| f64::from(reach(y)) < BARE * f64::from(widest)).count();
        let ink = bitmap.ink() as f64;
        let heights = (top..=bottom).map(|y| f64::from(bottom - y) + 0.5);
        let moment: f64 =
            (top..=bottom).zip(heights).map(|(y, h)| h * bitmap.ink_in_row(y).count() as f64).sum();
        Self {
            ink: ink / bitmap.area() as f64,
            height: f64::from(bottom - top + 1) * unit,
            width: f64::from(right - left + 1) * unit,
            centroid_height: moment / ink * unit,
            bare_height: bare as f64 * unit,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(cx: f64, cy: f64, r: f64) -> Bitmap {
        Bitmap::from_fn(128, 128, |x, y| (f64::from(x) + 0.5 - cx).hypot(f64::from(y) + 0.5 - cy) <= r)
    }

    #[test]
    fn a_perfect_picture_has_perfect_scores() {
        let goal = disc(64.0, 64.0, 30.0);
        let card = ScoreCard::new(&goal, &goal).unwrap();
        assert_eq!(
            (card.pixel_accuracy, card.iou, card.dice, card.boundary_f, card.chamfer),
            (1.0, 1.0, 1.0, 1.0, 0.0)
        );
        assert_eq!(card.likeness, 1.0);
        assert_eq!(card.blurred_iou, BlurredIou { sixteenth: 1.0, thirty_second: 1.0, sixty_fourth: 1.0 });
        assert!(card.best_ellipse_iou > 0.97);
        assert!((card.empty_accuracy - (1.0 - card.goal_crown.ink)).abs() < 1e-12);
    }

    #[test]
    fn scores_fall_as_a_picture_walks_away() {
        let goal = disc(64.0, 64.0, 20.0);
        let cards: Vec<ScoreCard> = (0..5)
            .map(|i| ScoreCard::new(&disc(64.0 + 6.0 * f64::from(i), 64.0, 20.0), &goal).unwrap())
            .collect();
        for w in cards.windows(2) {
            assert!(w[1].iou < w[0].iou && w[1].dice < w[0].dice && w[1].chamfer > w[0].chamfer);
            assert!(w[1].blurred_iou.sixteenth < w[0].blurred_iou.sixteenth);
            assert!(w[1].boundary_f <= w[0].boundary_f && w[1].likeness < w[0].likeness);
        }
        // Two discs of radius r at distance d: the lens over the union.
        let (r, d) = (20.0_f64, 12.0_f64);
        let lens = 2.0 * r * r * (d / (2.0 * r)).acos() - d / 2.0 * (4.0 * r * r - d * d).sqrt();
        let iou = lens / (2.0 * std::f64::consts::PI * r * r - lens);
        assert!((cards[2].iou - iou).abs() < 0.01);
    }

    #[test]
    fn empty_pictures_score_without_nonsense() {
        let (empty, goal) = (Bitmap::new(128, 128), disc(64.0, 64.0, 20.0));
        let card = ScoreCard::new(&empty, &goal).unwrap();
        assert_eq!((card.iou, card.dice, card.boundary_f), (0.0, 0.0, 0.0));
        assert_eq!(card.pixel_accuracy, card.empty_accuracy);
        assert!((card.chamfer - 2.0_f64.sqrt()).abs() < 1e-12);
        let card = ScoreCard::new(&empty, &empty).unwrap();
        assert_eq!((card.iou, card.dice, card.boundary_f, card.chamfer), (1.0, 1.0, 1.0, 0.0));
    }

    #[test]
    fn sizes_must_agree() {
        let error = ScoreCard::new(&Bitmap::new(3, 4), &Bitmap::new(5, 4)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the picture has 3 × 4 pixels and the goal 5 × 4; both must have one size"
        );
    }

    #[test]
    fn crowns_are_measured_in_picture_heights() {
        let tree = Bitmap::from_fn(100, 100, |x, y| {
            if y >= 60 { (48..52).contains(&x) } else { y >= 20 && (20..80).contains(&x) }
        });
        let crown = Crown::new(&tree);
        assert!((crown.height - 0.8).abs() < 1e-12 && (crown.width - 0.6).abs() < 1e-12);
        assert!((crown.bare_height - 0.4).abs() < 1e-12);
        assert!((crown.ink - 0.256).abs() < 1e-12);
    }
}
