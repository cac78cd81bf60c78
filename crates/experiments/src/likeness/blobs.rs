//! Shapes that overlap a goal well without being a tree.

use super::SIDE;
use pleach_silhouette::Bitmap;
use pleach_silhouette::score::{best_ellipse, blob};

/// Names of the blobs.
pub(super) const BLOBS: [&str; 5] =
    ["ellipse", "convex hull", "blurred 1/64", "blurred 1/32", "blurred 1/16"];

/// The goal's best ellipse, its filled convex hull, and its ink blurred by parts of the height and cut at half.
pub(super) fn blobs_like(goal: &Bitmap) -> [Bitmap; BLOBS.len()] {
    let blurred = |part: f64| blob(goal, f64::from(SIDE) / part);
    [best_ellipse(goal), hull(goal), blurred(64.0), blurred(32.0), blurred(16.0)]
}

/// The filled convex hull of the ink.
fn hull(goal: &Bitmap) -> Bitmap {
    // First and last ink of each row, top to bottom: the hull's left and right chains bend one way only.
    let ends: Vec<[f64; 3]> = (0..goal.height())
        .filter_map(|y| {
            let mut xs = goal.ink_in_row(y);
            let first = xs.next()?;
            Some([f64::from(y), f64::from(first), f64::from(xs.last().unwrap_or(first))])
        })
        .collect();
    let chain = |end: usize, sign: f64| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for row in &ends {
            let point = [row[0], row[end]];
            while let [.., a, b] = chain[..] {
                let turn = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
                if sign * turn > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain
    };
    let (left, right) = (chain(1, 1.0), chain(2, -1.0));
    let at = |chain: &[[f64; 2]], y: f64| {
        let above = chain.iter().rev().find(|p| p[0] <= y)?;
        let below = chain.iter().find(|p| p[0] >= y)?;
        let part = if below[0] > above[0] { (y - above[0]) / (below[0] - above[0]) } else { 0.0 };
        Some(above[1] + part * (below[1] - above[1]))
    };
    let mut filled = Bitmap::new(goal.width(), goal.height());
    for y in 0..goal.height() {
        if let Some((from, to)) = at(&left, f64::from(y)).zip(at(&right, f64::from(y))) {
            (from.ceil() as u32..=to.floor() as u32).for_each(|x| filled.set(x, y, true));
        }
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_fills_what_is_hollow_and_adds_nothing_to_what_is_not() {
        let ring = |inner: u32| {
            Bitmap::from_fn(100, 100, move |x, y| {
                let square = x.abs_diff(50).pow(2) + y.abs_diff(50).pow(2);
                square <= 1600 && square >= inner
            })
        };
        let (full, hollow) = (ring(0), ring(900));
        assert_eq!(hull(&hollow), hull(&full));
        let found = hull(&full);
        assert_eq!(found.intersection(&full), full.ink());
        assert!(found.ink() - full.ink() < 40, "corners of pixels only");
        let star = Bitmap::from_ascii("#...#\n.....\n..#..\n.....\n#...#\n");
        assert_eq!(hull(&star).ink(), 25);
        assert_eq!(hull(&Bitmap::new(4, 4)).ink(), 0);
    }
}
