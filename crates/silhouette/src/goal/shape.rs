//! What in a silhouette is not as in that of a tree.
//!
//! The thresholds are such that nothing is said of the pictures in `targets/` and `tests/data/silhouettes`,
//! which are of trees of many kinds, leafy and bare (`tests/it/warnings.rs`).

use super::hollow;
use super::warning::GoalWarning;
use crate::bitmap::Bitmap;
use crate::pieces;
use crate::touches::Touches;

/// Longer side, in cells, of the picture in which pieces are looked for.
const CELLS: u32 = 256;
/// Pieces nearer than this part of the longer side belong together.
const NEAR: f64 = 0.02;
/// Least part of the largest piece's ink that makes a further one of similar size.
const SIMILAR: f64 = 0.25;
/// A crown that is cut off by the left or right edge has ink along more than this part of it; a tight crop
/// only has tips there.
const CUT: f64 = 0.08;
/// The same of the top edge, which in a tight crop of a narrow tree is short.
const CUT_TOP: f64 = 0.15;
/// Rows of ground are inked in more than this part of the picture's width ...
const WIDE: f64 = 0.9;
/// ... or in more than this part of the ink's, right below rows with less than [`NARROW`] of it.
const WIDER: f64 = 0.6;
const NARROW: f64 = 0.3;
/// Within this part of the height, rows get from narrow to wide where a trunk meets the ground.
const ABRUPT: f64 = 0.03;
/// Ground is at most this part of the picture's height; the rest is a tree with a wide foot.
const DEEPEST: f64 = 0.35;
/// Specks away from the tree that are still taken for leaves or dust.
const MAX_SPECKS: u64 = 12;
/// Pixels in the tone that none of their four neighbours has, per pixel, in noise.
const GRAINY: f64 = 0.025;
/// Pixels of ink with none within [`APART`] pixels, per pixel, in noise: goals have 0.0012 at most, whole, tightly
/// cropped, or at half their size; with one pixel in a hundred turned over they have 0.0024 at least.
const SPECKLED: f64 = 0.0017;
const APART: u32 = 2;
/// Ink per convex hull from which on a shape is solid.
const SOLID: f64 = 0.95;
/// From this part of a picture on, ink is more likely the paper. Goals have at most 0.47, tightly cropped 0.63.
const MOSTLY: f64 = 0.7;
/// Side of the corners of the ink's box that are looked at, as a part of its shorter side.
const CORNER: u32 = 20;
/// Trees leave the corners of their box free, but for what lies at their feet; paper has three or four, each
/// to at least half.
const MAX_CORNERS: usize = 2;
/// Rows narrower than this part of the widest are bare trunk.
const BARE: f64 = 0.25;
/// Least part of the height that is bare trunk at the top of a tree upside down.
const TALL: f64 = 0.1;

/// What is to be said of a silhouette.
pub(crate) fn warnings(ink: &Bitmap) -> Vec<GoalWarning> {
    let mut found = Vec::new();
    let Some(shape) = Shape::new(ink) else { return found };
    let ground = shape.ground();
    let touches = shape.touches(ground.unwrap_or(ink.height()));
    if touches != Touches::default() {
        found.push(GoalWarning::TouchesFrame(touches));
    }
    let (pieces, specks) = shape.pieces();
    if pieces > 1 {
        found.push(GoalWarning::SeveralPieces { pieces });
    }
    if let Some(row) = ground {
        found.push(GoalWarning::Ground { row });
    }
    let lone = shape.lone();
    let is_speckled = lone.apart as f64 > SPECKLED * ink.area() as f64;
    if specks > MAX_SPECKS || is_speckled || shape.grain() > GRAINY {
        found.push(GoalWarning::Noise { specks: lone.count });
    }
    let solidity = shape.solidity();
    if solidity > SOLID {
        found.push(GoalWarning::Solid { solidity });
    } else {
        let share = ink.ink() as f64 / ink.area() as f64;
        if share > MOSTLY || shape.corners() > MAX_CORNERS {
            found.push(GoalWarning::MostlyInk { share });
        }
    }
    if let Some(hollow) = hollow::hollow(ink) {
        found.push(GoalWarning::Outline { hollow });
    }
    if shape.is_upside_down() {
        found.push(GoalWarning::UpsideDown);
    }
    found
}

/// Ink per area of its convex hull, in 0..=1; below this it is not solid.
pub(crate) fn solidity(ink: &Bitmap) -> f64 {
    Shape::new(ink).map_or(0.0, |shape| shape.solidity())
}

/// Pixels of ink that touch none.
#[derive(Default)]
struct Lone {
    count: u64,
    /// Of them, those that are [far](APART) from all other ink.
    apart: u64,
    /// Where the first few are.
    places: Vec<(u32, u32)>,
}

/// A silhouette with what several questions need.
struct Shape<'a> {
    ink: &'a Bitmap,
    left: u32,
    top: u32,
    right: u32,
    bottom: u32,
}

impl<'a> Shape<'a> {
    fn new(ink: &'a Bitmap) -> Option<Self> {
        let (left, top, right, bottom) = ink.ink_box()?;
        Some(Self { ink, left, top, right, bottom })
    }

    fn width(&self) -> f64 {
        f64::from(self.right - self.left + 1)
    }

    fn height(&self) -> f64 {
        f64::from(self.bottom - self.top + 1)
    }

    fn inked(&self, y: u32) -> f64 {
        f64::from(self.ink.row(y).iter().map(|word| word.count_ones()).sum::<u32>())
    }

    /// First and last column with ink.
    fn ends(&self, y: u32) -> Option<(u32, u32)> {
        let row = self.ink.row(y);
        let first = row.iter().position(|&word| word != 0)?;
        let last = row.iter().rposition(|&word| word != 0)?;
        Some((
            first as u32 * 64 + row[first].trailing_zeros(),
            last as u32 * 64 + 63 - row[last].leading_zeros(),
        ))
    }

    /// How wide a row is from its first to its last ink.
    fn reach(&self, y: u32) -> f64 {
        self.ends(y).map_or(0.0, |(first, last)| f64::from(last - first + 1))
    }

    /// The sides along which the crown is cut off, above the row `ground`.
    fn touches(&self, ground: u32) -> Touches {
        let (width, height) = (self.ink.width(), self.ink.height());
        let column = |x| (0..ground).filter(|&y| self.ink.get(x, y)).count() as f64;
        let cut = |inked: f64, most: f64| inked > most.max(2.0);
        Touches {
            left: cut(column(0), CUT * f64::from(height)),
            top: cut(if ground > 0 { self.inked(0) } else { 0.0 }, CUT_TOP * f64::from(width)),
            right: cut(column(width - 1), CUT * f64::from(height)),
        }
    }

    /// The first row of a strip of ground at the bottom of the ink.
    fn ground(&self) -> Option<u32> {
        let deepest = (DEEPEST * self.height()) as u32;
        let strip = |least: f64| {
            let rows = (self.top..=self.bottom).rev().take_while(|&y| self.inked(y) > least).count() as u32;
            // A strip of one row may be where a fir's lowest branches end.
            (rows >= 2 && rows <= deepest).then(|| self.bottom + 1 - rows)
        };
        if let Some(row) = strip(WIDE * f64::from(self.ink.width()))
            && self.inked(row.saturating_sub(self.abrupt())) < WIDER * f64::from(self.ink.width())
        {
            return Some(row);
        }
        let row = strip(WIDER * self.width())?;
        let above = row.checked_sub(self.abrupt())?;
        (above > self.top && self.reach(above) < NARROW * self.width()).then_some(row)
    }

    /// Rows within which the edge of ground lies.
    fn abrupt(&self) -> u32 {
        (ABRUPT * self.height()).ceil() as u32
    }

    /// How many pieces are of similar size, and how many lone pixels lie away from the largest.
    fn pieces(&self) -> (usize, u64) {
        let cell = self.ink.width().max(self.ink.height()).div_ceil(CELLS);
        let mut cells = Bitmap::new(self.ink.width().div_ceil(cell), self.ink.height().div_ceil(cell));
        for y in self.top..=self.bottom {
            for x in self.ink.ink_in_row(y) {
                cells.set(x / cell, y / cell, true);
            }
        }
        let near = NEAR / 2.0 * f64::from(cells.width().max(cells.height()));
        let grounds = pieces::widened(&cells, near.round() as u32);
        let sizes = pieces::sizes(&cells, &grounds);
        let largest = sizes.first().copied().unwrap_or(0) as f64;
        let similar = sizes.iter().filter(|&&size| size as f64 >= SIMILAR * largest).count();
        let lone = self.lone().places;
        let Some(tree) = pieces::piece(&cells, &grounds, None) else { return (similar, 0) };
        let away = lone.iter().filter(|&&(x, y)| !tree.get(x / cell, y / cell)).count();
        (similar, away as u64)
    }

    /// Pixels of ink with no ink among their eight neighbours.
    fn lone(&self) -> Lone {
        const MAX: usize = 4096;
        let mut found = Lone::default();
        let blank = vec![0; self.ink.row(0).len()];
        let row = |y: Option<u32>| match y {
            Some(y) if y < self.ink.height() => self.ink.row(y),
            _ => &blank[..],
        };
        for y in self.top..=self.bottom {
            let rows = [row(y.checked_sub(1)), row(Some(y)), row(Some(y + 1))];
            for i in 0..blank.len() {
                let here = rows[1][i];
                if here == 0 {
                    continue;
                }
                let mut near = rows[0][i] | rows[2][i];
                for row in rows {
                    let before = i.checked_sub(1).map_or(0, |i| row[i]);
                    let after = row.get(i + 1).copied().unwrap_or(0);
                    near |= row[i] << 1 | before >> 63 | row[i] >> 1 | after << 63;
                }
                let mut lone = here & !near;
                while lone != 0 {
                    let x = i as u32 * 64 + lone.trailing_zeros();
                    found.count += 1;
                    found.apart += u64::from(self.is_apart(x, y));
                    if found.places.len() < MAX {
                        found.places.push((x, y));
                    }
                    lone &= lone - 1;
                }
            }
        }
        found
    }

    /// Whether a pixel of ink has none within [`APART`] pixels.
    fn is_apart(&self, x: u32, y: u32) -> bool {
        let columns = x.saturating_sub(APART)..=(x + APART).min(self.ink.width() - 1);
        let mut rows = y.saturating_sub(APART)..=(y + APART).min(self.ink.height() - 1);
        rows.all(|b| columns.clone().all(|a| (a, b) == (x, y) || !self.ink.get(a, b)))
    }

    /// Share of pixels, of ink or paper, whose four neighbours are all of the other tone.
    fn grain(&self) -> f64 {
        let (width, height) = (self.ink.width(), self.ink.height());
        let mut lone = 0_u64;
        for y in 1..height.saturating_sub(1) {
            let [above, here, below] = [y - 1, y, y + 1].map(|y| self.ink.row(y));
            for (i, &word) in here.iter().enumerate() {
                let before = i.checked_sub(1).map_or(0, |i| here[i]);
                let after = here.get(i + 1).copied().unwrap_or(0);
                let (left, right) = (word << 1 | before >> 63, word >> 1 | after << 63);
                let ink = word & !(left | right | above[i] | below[i]);
                let paper = !word & left & right & above[i] & below[i];
                lone += u64::from((ink | paper).count_ones());
            }
        }
        lone as f64 / (f64::from(width) * f64::from(height))
    }

    /// How many corners of the ink's box are ink.
    fn corners(&self) -> usize {
        let (right, bottom) = (self.right + 1, self.bottom + 1);
        let side = ((right - self.left).min(bottom - self.top) / CORNER).max(1);
        let is_inked = |&(left, top): &(u32, u32)| {
            let pixels = (top..top + side).flat_map(|y| (left..left + side).map(move |x| (x, y)));
            2 * pixels.filter(|&(x, y)| self.ink.get(x, y)).count() >= (side * side) as usize
        };
        let corners = [
            (self.left, self.top),
            (right - side, self.top),
            (self.left, bottom - side),
            (right - side, bottom - side),
        ];
        corners.iter().filter(|corner| is_inked(corner)).count()
    }

    /// Ink per area of its convex hull.
    fn solidity(&self) -> f64 {
        // Corners of the first and last pixels of the rows, from top to bottom on either side.
        let (mut left, mut right): (Vec<[f64; 2]>, Vec<[f64; 2]>) = Default::default();
        for y in self.top..=self.bottom {
            let Some((first, last)) = self.ends(y) else { continue };
            for y in [y, y + 1] {
                push_convex(&mut left, [f64::from(first), f64::from(y)], -1.0);
                push_convex(&mut right, [f64::from(last + 1), f64::from(y)], 1.0);
            }
        }
        let around: Vec<[f64; 2]> = right.into_iter().chain(left.into_iter().rev()).collect();
        let doubled: f64 =
            around.iter().zip(around.iter().cycle().skip(1)).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
        self.ink.ink() as f64 / (doubled / 2.0).abs().max(1.0)
    }

    /// Whether a long narrow part of even width at the top suddenly becomes wide, and the bottom is not
    /// narrow: a trunk that points up.
    fn is_upside_down(&self) -> bool {
        let reaches: Vec<f64> = (self.top..=self.bottom).map(|y| self.reach(y)).collect();
        let widest = reaches.iter().copied().fold(0.0, f64::max);
        let bare = |reach: &f64| *reach < BARE * widest;
        let above = reaches.iter().take_while(|reach| bare(reach)).count();
        let below = reaches.iter().rev().take_while(|reach| bare(reach)).count();
        if (above as f64) < TALL * self.height() || below * 3 > above {
            return false;
        }
        let mean = |rows: &[f64]| rows.iter().sum::<f64>() / rows.len().max(1) as f64;
        let (upper, lower) = reaches[..above].split_at(above / 2);
        // A fir's top widens all the way; a trunk does only a little.
        let even = mean(lower) < 1.6 * mean(upper);
        let beyond = &reaches[above..(above + self.abrupt() as usize).min(reaches.len())];
        even && beyond.iter().copied().fold(0.0, f64::max) > 1.4 * BARE * widest
    }
}

/// Adds a point to the side of a convex hull, whose last points it may make inner ones; Andrew 1979.
fn push_convex(hull: &mut Vec<[f64; 2]>, point: [f64; 2], side: f64) {
    while let [.., a, b] = hull[..] {
        let turn = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
        // From top to bottom, the left side bulges to the left. Points on a line would hide those before.
        if side * turn > 0.0 {
            break;
        }
        hull.pop();
    }
    hull.push(point);
}
