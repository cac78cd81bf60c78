//! Where names and thumbnails go, so that they cover neither each other nor the dots.

use pleach_tree::math;

type Pair = (f64, f64);

/// Directions that are tried around a dot.
const DIRECTIONS: u32 = 24;
/// Distances that are tried between a dot and its box, in pixels.
const GAPS: [f64; 8] = [3.0, 14.0, 28.0, 46.0, 68.0, 94.0, 124.0, 160.0];
/// Rounds in which every box looks for a better place.
const ROUNDS: usize = 6;

/// The upper left corner of a box of each of `sizes` beside its dot, within `window` (left, top, right,
/// bottom). Greedy: in every round each box takes the best place given the others.
pub(super) fn boxes(dots: &[Pair], sizes: &[Pair], window: [f64; 4]) -> Vec<Pair> {
    // Above its dot to start with.
    let mut corners: Vec<Option<Pair>> = vec![None; dots.len()];
    for _ in 0..ROUNDS {
        for i in 0..dots.len() {
            let mut best: Option<(f64, Pair)> = None;
            for corner in candidates(dots[i], sizes[i]) {
                let mut cost = outside(corner, sizes[i], window) * 50.0;
                cost += (middle_distance(corner, sizes[i], dots[i])) * 4.0;
                for (j, dot) in dots.iter().enumerate() {
                    let around = ((dot.0 - 6.0, dot.1 - 6.0), (12.0, 12.0));
                    cost += overlap((corner, sizes[i]), around) * 12.0;
                    if let Some(other) = corners[j].filter(|_| j != i) {
                        cost += overlap((corner, sizes[i]), (other, sizes[j])) * 3.0;
                        // The line to the box runs free of the others, and theirs of it.
                        cost += hidden(dots[i], (corner, sizes[i]), (other, sizes[j])) * 250.0;
                        cost += hidden(dots[j], (other, sizes[j]), (corner, sizes[i])) * 250.0;
                    }
                }
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, corner));
                }
            }
            corners[i] = best.map(|(_, corner)| corner);
        }
    }
    corners.into_iter().zip(dots).map(|(corner, dot)| corner.unwrap_or(*dot)).collect()
}

/// Corners of boxes around `dot`, so that the box's edge is a gap away from it.
fn candidates(dot: Pair, size: Pair) -> impl Iterator<Item = Pair> {
    GAPS.into_iter().flat_map(move |gap| {
        (0..DIRECTIONS).map(move |k| {
            let angle = std::f64::consts::TAU * (f64::from(k) / f64::from(DIRECTIONS) - 0.25);
            let (sin, cos) = math::sin_cos(angle);
            // From the box's middle to its edge in this direction.
            let to_edge = (size.0 / 2.0 / cos.abs().max(1e-9)).min(size.1 / 2.0 / sin.abs().max(1e-9));
            let middle = (dot.0 + cos * (to_edge + gap + 5.0), dot.1 + sin * (to_edge + gap + 5.0));
            (middle.0 - size.0 / 2.0, middle.1 - size.1 / 2.0)
        })
    })
}

fn middle_distance(corner: Pair, size: Pair, dot: Pair) -> f64 {
    math::hypot(corner.0 + size.0 / 2.0 - dot.0, corner.1 + size.1 / 2.0 - dot.1)
}

/// The point of a box that is nearest to `dot`.
pub(super) fn nearest(dot: Pair, corner: Pair, size: Pair) -> Pair {
    (dot.0.clamp(corner.0, corner.0 + size.0), dot.1.clamp(corner.1, corner.1 + size.1))
}

/// Which part of the line from `dot` to its own box lies under `other`.
fn hidden(dot: Pair, own: (Pair, Pair), other: (Pair, Pair)) -> f64 {
    const SAMPLES: u32 = 8;
    let to = nearest(dot, own.0, own.1);
    let under = |k: &u32| {
        let part = f64::from(*k) / f64::from(SAMPLES);
        let at = (dot.0 + part * (to.0 - dot.0), dot.1 + part * (to.1 - dot.1));
        nearest(at, other.0, other.1) == at
    };
    (0..SAMPLES).filter(under).count() as f64 / f64::from(SAMPLES)
}

/// Area in which two boxes overlap.
fn overlap(one: (Pair, Pair), two: (Pair, Pair)) -> f64 {
    let along = |a: f64, w: f64, b: f64, v: f64| ((a + w).min(b + v) - a.max(b)).max(0.0);
    along(one.0.0, one.1.0, two.0.0, two.1.0) * along(one.0.1, one.1.1, two.0.1, two.1.1)
}

/// By how many pixels a box reaches out of the window.
fn outside(corner: Pair, size: Pair, [left, top, right, bottom]: [f64; 4]) -> f64 {
    let out = |low: f64, high: f64, from: f64, to: f64| (from - low).max(0.0) + (high - to).max(0.0);
    out(corner.0, corner.0 + size.0, left, right) + out(corner.1, corner.1 + size.1, top, bottom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_of_a_crowd_do_not_overlap() {
        let dots: Vec<Pair> =
            (0..9).map(|i| (400.0 + f64::from(i % 3) * 40.0, 300.0 + f64::from(i / 3) * 40.0)).collect();
        let sizes = vec![(90.0, 90.0); 9];
        let placed = boxes(&dots, &sizes, [0.0, 0.0, 900.0, 700.0]);
        for i in 0..9 {
            assert_eq!(outside(placed[i], sizes[i], [0.0, 0.0, 900.0, 700.0]), 0.0);
            for j in 0..i {
                let common = overlap((placed[i], sizes[i]), (placed[j], sizes[j]));
                assert!(common < 0.15 * 8100.0, "{i} and {j}: {common}");
            }
        }
    }
}
