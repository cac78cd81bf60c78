//! Likeness: one number for how much two silhouettes look like trees of one kind.
//!
//! Overlap of pixels rewards a blob in the right place above another tree of the same species, for no
//! two trees have their twigs in the same places. Likeness asks what a person compares at a glance:
//! where the masses are, where the outline runs and which way, how thick what is drawn is, and how
//! wide the gaps in it are. Each part is a list of amounts a ≥ 0 of one picture against b of the
//! other, compared by the same rule, Σ min(a, b) / Σ max(a, b) (Ruzicka 1958): 0 where they share
//! nothing, 1 where they are equal, the same both ways. Likeness is their weighted mean:
//!
//! | part | weight | sees | does not see |
//! | --- | ---: | --- | --- |
//! | mass | 0.1 | where a tree stands, how it leans | texture: a blob has the same mass |
//! | rim | 0.3 | the crown's shape and roughness, upright and level edges apart | left and right |
//! | strokes | 0.3 | trunk, branches, leaves: how thick, and which way they run | where they are, how large the tree is |
//! | gaps | 0.3 | how airy a crown is, and how coarsely | where the gaps are, how large the tree is |
//!
//! With S = max(width, height), all lengths are parts of S, so that the same drawing has about the same
//! likeness at any size. Cells have the side S / 16 and are blurred by the binomial weights 1 2 1 both
//! ways, so that crossing from one into the next costs little.
//!
//! - *Mass*: the share of each cell that is inked.
//! - *Rim*: the length of the upright and of the level outline, each in cells by height and by distance
//!   from the ink's mean column, in parts of S. Trees have no left and right of their own: laying both
//!   halves onto each other makes one tree a better witness of its species.
//! - *Strokes*: for rows and for columns, and for k = 0 … 7, Σ ℓ w(ℓ, k) / ink over all runs of ink, ℓ
//!   pixels long, with w(ℓ, k) = max(0, 1 − |log₂(256 ℓ / S) − k|): ink by the thickness of what it is
//!   part of (run lengths: Galloway 1975).
//! - *Gaps*: the same sum over the runs of paper between ink of a row or a column. 0.1 is added to the
//!   lists of both pictures, or the first pinhole in a solid crown would cost the whole part.
//!
//! Two empty pictures have a likeness of 1, an empty one and another of 0.
//!
//! The lists and their weights were chosen among some seventy lists by how well they tell species apart
//! and trees from blobs; `experiments/likeness` has what came of it on other trees, and what is lost
//! without each part.

mod columns;
mod mass;
mod rim;
mod runs;
mod transpose;

use crate::bitmap::Bitmap;
use columns::Columns;
use serde::Serialize;

/// How alike two pictures are by each part, in 0..=1; their weighted mean is [`Likeness::value`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Likeness {
    /// Where the ink is, blurred.
    pub mass: f64,
    /// Where the outline runs, left and right alike.
    pub rim: f64,
    /// How thick what is drawn is.
    pub strokes: f64,
    /// How wide the gaps in it are.
    pub gaps: f64,
}

/// Weights of mass, rim, strokes and gaps, in that order; they add up to 1.
///
/// Whole tenths that tell the species of seeds 1 to 5 apart while the place still counts; others nearby
/// do as well.
const WEIGHTS: [f64; 4] = [0.1, 0.3, 0.3, 0.3];

impl Likeness {
    /// Names of the parts, as in the JSON.
    pub const PARTS: [&'static str; 4] = ["mass", "rim", "strokes", "gaps"];

    /// The likeness of two pictures, which should have the same proportions.
    #[must_use]
    pub fn between(a: &Bitmap, b: &Bitmap) -> Self {
        let mut scratch = Scratch::default();
        Descriptor::new(a, &mut scratch).compare(&Descriptor::new(b, &mut scratch))
    }

    /// The parts in the order of [`Likeness::PARTS`], each in 0..=1.
    #[must_use]
    pub const fn parts(&self) -> [f64; 4] {
        [self.mass, self.rim, self.strokes, self.gaps]
    }

    /// Likeness itself, in 0..=1; 1 for equal pictures.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.mean(|_| true)
    }

    /// Likeness without one of [`Likeness::PARTS`], by its number: what that part is worth.
    ///
    /// # Panics
    /// If there is no such part.
    #[must_use]
    pub fn without(&self, part: usize) -> f64 {
        assert!(part < WEIGHTS.len(), "there are {} parts", WEIGHTS.len());
        self.mean(|i| i != part)
    }

    fn mean(&self, counts: impl Fn(usize) -> bool) -> f64 {
        let (mut sum, mut total) = (0.0, 0.0);
        for (i, (weight, part)) in WEIGHTS.iter().zip(self.parts()).enumerate() {
            if counts(i) {
                sum += weight * part;
                total += weight;
            }
        }
        // Equal pictures have exactly 1, however the sums were rounded.
        (sum / total).min(1.0)
    }
}

/// What likeness needs to know of one picture: some 6 kB, whatever its size.
#[derive(Clone, Debug, PartialEq)]
pub struct Descriptor {
    empty: bool,
    mass: [f32; mass::AMOUNTS],
    rim: [f32; rim::AMOUNTS],
    strokes: [f32; runs::AMOUNTS],
    gaps: [f32; runs::AMOUNTS],
}

/// Memory that is reused from one picture to the next; allocates only if pictures grow.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    transposed: Bitmap,
    columns: Columns,
    runs: runs::Counts,
}

impl Descriptor {
    /// Describes `picture`.
    #[must_use]
    pub fn new(picture: &Bitmap, scratch: &mut Scratch) -> Self {
        let Scratch { transposed, columns, runs } = scratch;
        transpose::transpose(picture, transposed);
        let [strokes, gaps] = runs.amounts(picture, transposed);
        Self {
            empty: picture.ink() == 0,
            mass: mass::amounts(picture, columns),
            rim: rim::amounts(picture, transposed, columns),
            strokes,
            gaps,
        }
    }

    /// All amounts, mass, rim, strokes and gaps one after the other, each 0 or more.
    pub fn amounts(&self) -> impl Iterator<Item = f32> {
        let lists = [&self.mass[..], &self.rim, &self.strokes, &self.gaps];
        lists.into_iter().flatten().copied()
    }

    /// The likeness of the two pictures, which should have the same proportions.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Likeness {
        match (self.empty, other.empty) {
            (true, true) => Likeness { mass: 1.0, rim: 1.0, strokes: 1.0, gaps: 1.0 },
            (false, false) => Likeness {
                mass: shared(&self.mass, &other.mass),
                rim: shared(&self.rim, &other.rim),
                strokes: shared(&self.strokes, &other.strokes),
                gaps: shared(&self.gaps, &other.gaps),
            },
            _ => Likeness { mass: 0.0, rim: 0.0, strokes: 0.0, gaps: 0.0 },
        }
    }
}

/// Σ min / Σ max of two lists of amounts; 1 where both are all 0.
fn shared(a: &[f32], b: &[f32]) -> f64 {
    let (mut least, mut most) = ([0.0_f32; LANES], [0.0_f32; LANES]);
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for i in 0..LANES {
            least[i] += a[i].min(b[i]);
            most[i] += a[i].max(b[i]);
        }
    }
    let sum = |lanes: [f32; LANES]| lanes.iter().map(|&v| f64::from(v)).sum::<f64>();
    let (least, most) = (sum(least), sum(most));
    if most > 0.0 { least / most } else { 1.0 }
}

/// Sums run side by side, which the compiler turns into vector instructions; lists are multiples of it.
const LANES: usize = 8;

/// Cells along the longer side of a picture.
const CELLS: usize = 16;

/// Amounts in `CELLS` × `CELLS` cells, row by row from the top.
type Cells = [f32; CELLS * CELLS];

/// Blurs cells by the binomial weights 1 2 1 along columns and rows, so that little changes when ink
/// crosses from one cell into the next. Beyond the edges is nothing; `mirrored` at the left edge there
/// is what lies right of it.
fn smooth(cells: &mut Cells, mirrored: bool) {
    let above = *cells;
    for (i, cell) in cells.iter_mut().enumerate() {
        let up = if i >= CELLS { above[i - CELLS] } else { 0.0 };
        let down = above.get(i + CELLS).copied().unwrap_or(0.0);
        *cell = 0.25 * (up + 2.0 * above[i] + down);
    }
    for row in cells.chunks_exact_mut(CELLS) {
        let mut left = if mirrored { row[0] } else { 0.0 };
        for x in 0..CELLS {
            let here = row[x];
            let right = row.get(x + 1).copied().unwrap_or(0.0);
            row[x] = 0.25 * (left + 2.0 * here + right);
            left = here;
        }
    }
}

#[cfg(test)]
mod tests;
