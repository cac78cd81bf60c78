//! Masks of another size than their picture's.

use crate::bitmap::Bitmap;

/// Whether two sizes have one aspect ratio, but for what rounding to whole pixels does.
pub(super) fn is_alike(a: (u32, u32), b: (u32, u32)) -> bool {
    let (small, large) = if a.0.max(a.1) <= b.0.max(b.1) { (a, b) } else { (b, a) };
    // The smaller one is the larger one times a factor for which both sides came within a pixel.
    let scaled = |side: u32, from: u32, to: u32| f64::from(side) * f64::from(to) / f64::from(from);
    let (width, height) = (f64::from(small.0), f64::from(small.1));
    (scaled(large.1, large.0, small.0) - height).abs() <= 1.0
        || (scaled(large.0, large.1, small.1) - width).abs() <= 1.0
}

/// `ink` at another size: black where at least half of a pixel's area was.
pub(super) fn resampled(ink: &Bitmap, width: u32, height: u32) -> Bitmap {
    let columns: Vec<_> = (0..width).map(|x| shares(x, width, ink.width())).collect();
    let mut across = vec![0.0_f64; width as usize];
    let mut out = Bitmap::new(width, height);
    for y in 0..height {
        across.fill(0.0);
        let rows = shares(y, height, ink.height());
        let whole: f64 = rows.iter().map(|(_, share)| share).sum();
        for &(row, part) in &rows {
            for (sum, column) in across.iter_mut().zip(&columns) {
                let inked: f64 =
                    column.iter().filter(|(x, _)| ink.get(*x, row)).map(|(_, share)| share).sum();
                let all: f64 = column.iter().map(|(_, share)| share).sum();
                *sum += part * inked / all;
            }
        }
        for (x, &sum) in (0..).zip(&across) {
            out.set(x, y, sum >= 0.5 * whole);
        }
    }
    out
}

/// The pixels of a line of `from` that lie under pixel `at` of one of `to`, and how much of each does.
fn shares(at: u32, to: u32, from: u32) -> Vec<(u32, f64)> {
    let scale = f64::from(from) / f64::from(to);
    let (first, end) = (f64::from(at) * scale, (f64::from(at + 1) * scale).min(f64::from(from)));
    let part = |pixel: u32| (end.min(f64::from(pixel + 1)) - first.max(f64::from(pixel))).max(0.0);
    let pixels = first as u32..(end.ceil() as u32).clamp(first as u32 + 1, from);
    pixels.map(|pixel| (pixel, part(pixel))).filter(|(_, part)| *part > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_one_aspect_are_alike_up_to_a_pixel() {
        for (a, b) in
            [((4000, 3000), (1024, 768)), ((120, 100), (60, 50)), ((1000, 667), (500, 334)), ((9, 9), (9, 9))]
        {
            assert!(is_alike(a, b) && is_alike(b, a), "{a:?} {b:?}");
        }
        for (a, b) in [((120, 100), (50, 50)), ((100, 120), (120, 100)), ((1000, 667), (500, 337))] {
            assert!(!is_alike(a, b) && !is_alike(b, a), "{a:?} {b:?}");
        }
    }

    #[test]
    fn shapes_stay_where_they_are_at_any_size() {
        let at = |side: u32| {
            Bitmap::from_fn(side, side, |x, y| {
                let part = |v: u32| (f64::from(v) + 0.5) / f64::from(side) - 0.5;
                part(x).hypot(part(y) * 1.3) < 0.35
            })
        };
        for (from, to) in [(200, 100), (100, 200), (100, 237), (237, 100), (64, 64)] {
            let made = resampled(&at(from), to, to);
            let wrong = made.differing(&at(to)) as f64 / at(to).ink() as f64;
            assert!(wrong < 0.02, "{from} to {to}: {wrong}");
        }
        assert_eq!(resampled(&at(64), 64, 64), at(64));
    }
}
