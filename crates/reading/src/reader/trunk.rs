//! The trunk's axis, its lean, and how far up it is bare.

use super::grid::Grid;
use super::trace::{Rows, Sample, line, visible};

/// Ink within this part of the height beside the trunk belongs to a branch or to foliage.
const BESIDE: f64 = 0.05;
/// Rows over which that ink is added up, as a part of the height.
const WINDOW: f64 = 0.03;
/// Ink per row beside the trunk, as a part of the height, from which on something leaves the trunk.
const LEAVES_TRUNK: f64 = 0.004;
/// The lean is that of the lowest part of the trunk: at least so much of the height, at most so much.
pub(crate) const LEAN_FROM: f64 = 0.03;
pub(crate) const LEAN_AT_LEAST: f64 = 0.12;
pub(crate) const LEAN_AT_MOST: f64 = 0.5;

/// The height in rows up to which nothing leaves the trunk.
pub(super) fn bare_rows(grid: &Grid, rows: Rows, samples: &[Sample], room: f64) -> usize {
    let beside = (BESIDE * rows.count as f64).max(3.0).min(room);
    let window = rows.part(WINDOW).max(3);
    let least = (LEAVES_TRUNK * rows.count as f64).max(0.8) * window as f64;
    let first = samples.first().map_or(0, |sample| sample.height);
    let flare = rows.part(LEAN_FROM);
    let excess = |sample: &Sample| -> f64 {
        if sample.height < flare {
            return 0.0;
        }
        let half = sample.width / 2.0;
        // Where the run is the trunk's own, its edges are the trunk's.
        let (left, right) = if sample.edges == 2 {
            (sample.run.left as f64, sample.run.right as f64)
        } else {
            (sample.center - half * 1.1 - 0.5, sample.center + half * 1.1 + 0.5)
        };
        let y = rows.row(sample.height);
        let (left, right) = (left.floor(), right.ceil());
        f64::from(
            grid.ink_between(y, (left - beside) as i64, left as i64)
                + grid.ink_between(y, right as i64, (right + beside) as i64),
        )
    };
    let mut sum = 0.0;
    for (i, sample) in samples.iter().enumerate() {
        sum += excess(sample);
        // Ink that left the window counts until the sum matters.
        if sum < least {
            continue;
        }
        let from = (i + 1).saturating_sub(window);
        sum = samples[from..=i].iter().map(excess).sum();
        if sum >= least {
            // The lowest row of the window with any ink beside the trunk.
            let lowest = samples[from..=i].iter().find(|sample| excess(sample) > 0.0);
            return lowest.map_or(first, |sample| sample.height);
        }
    }
    samples.last().map_or(0, |sample| sample.height + 1)
}

/// Slope of the axis, in columns per row, of the part of the trunk below the height `bare`; and the rows used.
pub(super) fn slope(rows: Rows, samples: &[Sample], bare: usize) -> Option<(f64, usize)> {
    let to = bare.clamp(rows.part(LEAN_AT_LEAST), rows.part(LEAN_AT_MOST).max(1));
    let from = rows.part(LEAN_FROM).min(to / 3);
    let part = samples[..visible(samples)].iter();
    let seen = part.filter(|sample| sample.edges > 0 && (from..to.max(from + 3)).contains(&sample.height));
    let count = seen.clone().count();
    line(seen.map(|sample| (sample.height as f64, sample.center))).map(|(slope, _)| (slope, count))
}
