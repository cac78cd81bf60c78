//! Whether numbers are still like a tree's: within twice the range of the species.

use super::{DRAWING, SEED};
use pleach_blend::draw::{each_tree, picture};
use pleach_silhouette::{Frame, Rasterizer, View};
use pleach_tree::{Growth, Limits, Parts, Species, Tree};

/// Smallest and largest height, ink and number of stems among species; twice as far is still a tree.
pub(super) struct Ranges([(f64, f64); 3]);

pub(super) const GENEROUS: f64 = 2.0;

impl Ranges {
    pub(super) fn new(species: &[Species]) -> anyhow::Result<Self> {
        let known = each_tree(species, SEED, |tree, _| figures(tree))?;
        let range = |i: usize| {
            known
                .iter()
                .map(|f| f[i])
                .fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)))
        };
        Ok(Self([range(0), range(1), range(2)]))
    }

    pub(super) fn contain(&self, figures: [f64; 3]) -> bool {
        self.0.iter().zip(figures).all(|((low, high), v)| (low / GENEROUS..=high * GENEROUS).contains(&v))
    }

    pub(super) fn hold(&self, species: &Species, seed: u64) -> bool {
        grow(species, seed).is_some_and(|tree| self.contain(figures(&tree)))
    }
}

pub(super) fn figures(tree: &Tree) -> [f64; 3] {
    let frame = Frame::automatic(tree, &View::FRONT, Parts::LEAFY, DRAWING.pixels, DRAWING.pixels);
    let bitmap = picture(tree, &mut Rasterizer::new(), DRAWING);
    let (left, top, right, bottom) = bitmap.ink_box().unwrap_or_default();
    let height = (frame.ground_row - f64::from(top)) * frame.meters_per_pixel;
    let area = f64::from(right - left + 1) * f64::from(bottom - top + 1);
    [height, bitmap.ink() as f64 / area, tree.stems.len() as f64]
}

/// Grows a tree of at most twice the stems and leaves of the largest species; a larger one counts as
/// not grown.
pub(super) fn grow(species: &Species, seed: u64) -> Option<Tree> {
    let usual = Limits::default();
    let limits = Limits { stems: usual.stems / 5, leaves: usual.leaves / 5, knots: usual.knots / 5, ..usual };
    species.grow_with(&Growth { limits, ..Growth::seed(seed) }).ok()
}
