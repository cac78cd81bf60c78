//! A trunk that a cut has lost.
//!
//! Trunks are thin, and the cheapest cut would rather do without: its rim costs more than its inside gains. But a
//! person drags a box down to the foot. So where the tree that was found ends higher, the best upright strip from there
//! down is looked for, one that differs from what is at its left and at its right, with the rows in order (dynamic
//! programming: Bellman, 1957).

use super::clear_sky::apart;
use super::oklab::Oklab;
use super::reduced::Reduced;

/// Half widths of trunks, as parts of the box's width, and at least a cell.
const HALF_WIDTHS: [f64; 4] = [0.008, 0.015, 0.03, 0.055];
/// A trunk is looked for within this part of the box's width from the middle of the crown's lower rim.
const REACH: f64 = 0.3;
/// Crowns that end higher above the foot than this part of the box's height have lost a trunk ...
const LOST: f64 = 0.02;
/// ... and those that end higher than this have lost more.
const MAX_LOST: f64 = 0.6;
/// A trunk differs from both sides by this on average, in Oklab.
const MIN_CONTRAST: f32 = 0.05;
/// Cost of one cell to the side from one row to the next, in the same unit.
const BEND: f32 = 0.03;
/// Cost of a place at [`REACH`] from the middle.
const ASIDE: f32 = 0.1;
/// The strip begins in the crown by this part of the box's height.
const OVERLAP: f64 = 0.08;

/// The box in cells: first column, first row, columns and rows.
pub(super) type Cells = (u32, u32, u32, u32);

/// The cells in the middle of the trunk, from the crown down to the box's foot; empty if there is no trunk to be seen,
/// or it was not lost.
pub(super) fn lost(small: &Reduced, is_tree: &[bool], (left, top, width, height): Cells) -> Vec<(u32, u32)> {
    let is = |x: u32, y: u32| is_tree[small.index(x, y)];
    let (right, foot) = ((left + width).min(small.width), (top + height).min(small.height));
    // The crown ends where fewer cells of a row are tree than a trunk's.
    let row = |y: u32| (left..right).filter(|&x| is(x, y)).count() as f64;
    let Some(end) = (top..foot).rev().find(|&y| row(y) > 0.0) else { return Vec::new() };
    let missing = f64::from(foot - 1 - end) / f64::from(height);
    if !(LOST..=MAX_LOST).contains(&missing) {
        return Vec::new();
    }
    let first = end.saturating_sub((OVERLAP * f64::from(height)) as u32).max(top);
    // The middle of the tree, by its mass.
    let (mut sum, mut count) = (0.0, 0.0_f64);
    for y in top..foot {
        for x in (left..right).filter(|&x| is(x, y)) {
            sum += f64::from(x);
            count += 1.0;
        }
    }
    let middle = sum / count.max(1.0);
    let reach = (REACH * f64::from(width)).max(2.0);
    let from = ((middle - reach).max(f64::from(left)) as u32).max(1);
    let to = ((middle + reach) as u32 + 1).min(right);
    if to <= from {
        return Vec::new();
    }
    let mut best: Option<(f32, Vec<(u32, u32)>)> = None;
    for part in HALF_WIDTHS {
        let half = ((part * f64::from(width)).round() as u32).max(1);
        let aside = |x: u32| {
            let far = ((f64::from(x) - middle) / reach) as f32;
            ASIDE * far * far
        };
        let (contrast, path) = path(small, from..to, first..foot, half, &aside);
        if contrast >= MIN_CONTRAST && best.as_ref().is_none_or(|(most, _)| contrast > *most) {
            let core = half - 1;
            let cells = path.into_iter().flat_map(|(x, y)| {
                (x.saturating_sub(core)..=(x + core).min(small.width - 1)).map(move |x| (x, y))
            });
            best = Some((contrast, cells.collect()));
        }
    }
    best.map_or_else(Vec::new, |(_, cells)| cells)
}

/// The path down with the most contrast to both sides, and the mean of that.
fn path(
    small: &Reduced,
    columns: std::ops::Range<u32>,
    rows: std::ops::Range<u32>,
    half: u32,
    aside: &dyn Fn(u32) -> f32,
) -> (f32, Vec<(u32, u32)>) {
    let count = columns.len();
    let mut totals: Vec<f32> = vec![0.0; count];
    let mut from: Vec<Vec<i8>> = Vec::with_capacity(rows.len());
    for y in rows.clone() {
        let sums = prefix(small, y);
        let mut next = Vec::with_capacity(count);
        let mut steps = Vec::with_capacity(count);
        for (i, x) in columns.clone().enumerate() {
            let gain = contrast(&sums, small.width, x, half) - aside(x);
            let mut best = (totals[i], 0_i8);
            for step in [-1_i8, 1] {
                if let Some(total) = i.checked_add_signed(step.into()).and_then(|j| totals.get(j))
                    && total - BEND > best.0
                {
                    best = (total - BEND, step);
                }
            }
            next.push(best.0 + gain);
            steps.push(best.1);
        }
        totals = next;
        from.push(steps);
    }
    let Some((mut i, total)) = totals.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else {
        return (0.0, Vec::new());
    };
    let mut cells = Vec::with_capacity(rows.len());
    for (y, steps) in rows.clone().zip(&from).rev() {
        cells.push((columns.start + i as u32, y));
        i = i.saturating_add_signed(steps[i].into()).min(count - 1);
    }
    (total / rows.len().max(1) as f32, cells)
}

/// Sums of a row's colours up to each cell.
fn prefix(small: &Reduced, y: u32) -> Vec<[f32; 3]> {
    let mut sums = vec![[0.0; 3]];
    let mut sum = [0.0; 3];
    for x in 0..small.width {
        sum.iter_mut().zip(small.colors[small.index(x, y)]).for_each(|(s, c)| *s += c);
        sums.push(sum);
    }
    sums
}

/// How much a strip differs from the less different of its sides.
fn contrast(sums: &[[f32; 3]], width: u32, x: u32, half: u32) -> f32 {
    let mean = |first: u32, end: u32| -> Option<Oklab> {
        (first < end && end <= width).then(|| {
            let count = (end - first) as f32;
            std::array::from_fn(|c| (sums[end as usize][c] - sums[first as usize][c]) / count)
        })
    };
    // Sides of the strip's own width, beyond a cell that may be part of both.
    let wide = 2 * half + 1;
    let (Some(start), end) = (x.checked_sub(half), x + half + 1) else { return 0.0 };
    let Some(strip) = mean(start, end) else { return 0.0 };
    let before = start.checked_sub(1).and_then(|end| mean(end.saturating_sub(wide), end));
    let after = mean(end + 1, (end + 1 + wide).min(width));
    match (before, after) {
        (Some(before), Some(after)) => apart(strip, before).min(apart(strip, after)),
        _ => 0.0,
    }
}
