//! A smaller picture of the same tree.

use crate::bitmap::Bitmap;

impl Bitmap {
    /// The picture at `factor` times its size, black where more than half of a pixel's area was.
    ///
    /// Where exactly half was, ink and paper take turns, as in drawn trees: at half the size that is
    /// every fourth pixel at the rim of a crown, and a tree would come out fatter by a tenth.
    ///
    /// The factor is the same in both directions, so that shapes keep their proportions; the last row
    /// and column take what half a pixel of rounding leaves.
    ///
    /// # Panics
    /// If `factor` is not above 0 and at most 1.
    #[must_use]
    pub fn downscaled(&self, factor: f64) -> Self {
        assert!(factor > 0.0 && factor <= 1.0, "a factor of {factor} makes no smaller picture");
        shrink(self, factor)
    }
}

pub(super) fn shrink(ink: &Bitmap, factor: f64) -> Bitmap {
    let size = |n: u32| ((f64::from(n) * factor).round() as u32).max(1);
    let (width, height) = (size(ink.width()), size(ink.height()));
    let columns = shares(ink.width(), width, factor);
    let mut across = vec![0.0_f64; width as usize];
    let mut out = Bitmap::new(width, height);
    let whole = 1.0 / (factor * factor);
    for y in 0..height {
        across.fill(0.0);
        let (from, to) = (f64::from(y) / factor, f64::from(y + 1) / factor);
        for row in from as u32..(to.ceil() as u32).min(ink.height()) {
            let share = (to.min(f64::from(row) + 1.0) - from.max(f64::from(row))).max(0.0);
            for x in ink.ink_in_row(row) {
                let (first, here) = columns[x as usize];
                if let Some(sum) = across.get_mut(first as usize) {
                    *sum += share * here;
                }
                if let Some(sum) = across.get_mut(first as usize + 1) {
                    *sum += share * (1.0 - here);
                }
            }
        }
        for (x, &area) in across.iter().enumerate() {
            let more = area - 0.5 * whole;
            let is_ink = if more.abs() < 1e-9 * whole { (x as u32 + y) % 2 == 1 } else { more > 0.0 };
            out.set(x as u32, y, is_ink);
        }
    }
    out
}

/// For each column the first that it falls into after shrinking, and its part that falls in there.
fn shares(from: u32, to: u32, factor: f64) -> Vec<(u32, f64)> {
    let share = |x: u32| {
        let (left, right) = (f64::from(x) * factor, f64::from(x + 1) * factor);
        let edge = left.floor() + 1.0;
        // Rounding may put an edge a hair before or behind a whole number: still one column.
        (left as u32, ((edge - left) / (right - left)).clamp(0.0, 1.0))
    };
    debug_assert!(to > 0);
    (0..from).map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_blocks_stay_whole() {
        let ink = Bitmap::from_fn(160, 80, |x, y| (x / 8 + y / 8).is_multiple_of(2));
        let small = shrink(&ink, 0.125);
        assert_eq!(small, Bitmap::from_fn(20, 10, |x, y| (x + y).is_multiple_of(2)));
    }

    #[test]
    fn from_half_the_area_on_it_is_ink_and_ties_take_turns() {
        let columns = |ink: &[u32]| shrink(&Bitmap::from_fn(16, 16, |x, _| ink.contains(&(x % 4))), 0.25);
        assert_eq!(columns(&[0, 1, 3]).ink(), 16);
        assert_eq!(columns(&[2]).ink(), 0);
        assert_eq!(columns(&[0, 2]), Bitmap::from_fn(4, 4, |x, y| (x + y) % 2 == 1));
    }

    #[test]
    fn a_disc_keeps_its_area_at_odd_factors() {
        let disc =
            Bitmap::from_fn(301, 301, |x, y| (f64::from(x) - 150.0).hypot(f64::from(y) - 150.0) < 120.0);
        for factor in [0.9, 0.37, 0.1] {
            let area = shrink(&disc, factor).ink() as f64 / (factor * factor);
            assert!((area / disc.ink() as f64 - 1.0).abs() < 0.03, "{factor}: {area}");
        }
    }
}
