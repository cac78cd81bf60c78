//! The similarity of neighbours on the way from one species to another.

use super::maps::{METHODS, Maps, Method};
use super::ranges::grow;
use super::{BLUR, DRAWING, Rows, SEED, progress, stop};
use pleach_blend::draw::picture;
use pleach_silhouette::score::blurred_iou;
use pleach_silhouette::{Bitmap, Rasterizer};
use pleach_tree::Species;
use rayon::prelude::*;

/// Every pair of species in steps: how alike neighbours are.
pub(super) fn smoothness(maps: &Maps, steps: u32, most: usize, rows: &mut Rows) -> anyhow::Result<()> {
    let count = maps.species().len();
    let pairs: Vec<(usize, usize)> =
        (0..count).flat_map(|b| (0..b).map(move |a| (a, b))).take(most).collect();
    for method in METHODS {
        let bar = progress(method.name(), pairs.len() as u64);
        let lines = pairs
            .par_iter()
            .map(|&pair| {
                stop::check()?;
                let line = Line::new(maps, method, pair, steps);
                bar.inc(1);
                line
            })
            .collect::<anyhow::Result<Vec<Line>>>()?;
        bar.finish_and_clear();
        for (pair, line) in pairs.iter().zip(&lines) {
            let names = (maps.species()[pair.0].name.as_str(), maps.species()[pair.1].name.as_str());
            let mut add =
                |measure: &str, value: f64| rows.add("smoothness", names, method.name(), measure, value);
            add("steps", line.overlaps.len() as f64);
            add("steps alike", line.alike(|_| true) as f64);
            add("steps without a switch", line.overlaps.iter().filter(|s| !s.1).count() as f64);
            add("steps without a switch alike", line.alike(|switch| !switch) as f64);
            add("trees that did not grow", line.stunted as f64);
            add("least overlap", line.least(|_| true));
            add("least overlap without a switch", line.least(|switch| !switch));
        }
    }
    Ok(())
}

/// Neighbouring trees whose blurred overlap is at least this are alike.
const ALIKE: f64 = 0.85;

/// Overlap of each two neighbours on the way, and whether something switches between them.
struct Line {
    /// 0 where one of the two did not grow.
    overlaps: Vec<(f64, bool)>,
    /// Trees that did not grow.
    stunted: usize,
}

impl Line {
    fn new(maps: &Maps, method: Method, pair: (usize, usize), steps: u32) -> anyhow::Result<Self> {
        let at = |i: u32| maps.between(method, pair, f64::from(i) / f64::from(steps));
        let species = (0..=steps).map(at).collect::<anyhow::Result<Vec<_>>>()?;
        let mut rasterizer = Rasterizer::new();
        let drawn: Vec<Option<Bitmap>> =
            species.iter().map(|s| Some(picture(&grow(s, SEED)?, &mut rasterizer, DRAWING))).collect();
        let overlap = |pair: &[Option<Bitmap>]| match pair {
            [Some(a), Some(b)] => blurred_iou(a, b, BLUR),
            _ => 0.0,
        };
        let stunted = drawn.iter().filter(|d| d.is_none()).count();
        let pairs = species.windows(2).zip(drawn.windows(2));
        Ok(Self { overlaps: pairs.map(|(s, d)| (overlap(d), switches(&s[0], &s[1]))).collect(), stunted })
    }

    fn alike(&self, counts: impl Fn(bool) -> bool) -> usize {
        self.overlaps.iter().filter(|(overlap, switch)| counts(*switch) && *overlap >= ALIKE).count()
    }

    fn least(&self, counts: impl Fn(bool) -> bool) -> f64 {
        self.overlaps.iter().filter(|(_, s)| counts(*s)).map(|(o, _)| *o).fold(1.0, f64::min)
    }
}

/// Whether a number that cannot change gradually changes: a choice, a sign, a whole number.
fn switches(one: &Species, two: &Species) -> bool {
    let space = one.generator.space();
    let (a, b) = (one.params.values(), two.params.values());
    space.slots().any(|slot| {
        let kind = space.kind_of(slot);
        let read = one.generator.is_active(a, slot) || two.generator.is_active(b, slot);
        let sign = kind.is_flagged() && (one.params.get(slot) < 0.0) != (two.params.get(slot) < 0.0);
        read && (sign || (kind.is_whole() && one.params.get(slot) != two.params.get(slot)))
    })
}
