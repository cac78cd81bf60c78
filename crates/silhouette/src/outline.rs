//! How far a tree reaches to the left and to the right, height by height.

use crate::bitmap::Bitmap;
use crate::view::Frame;

/// Ink at each end of a row that is not counted, in permille: single twigs are no crown.
const STRAY: usize = 15;

/// Heights at which an outline is read.
const ROWS: u32 = 48;

/// At 48 even heights from the ground to `height` meters, how far the ink of `bitmap` reaches to the
/// left and to the right of the foot, in meters; negative where all of it is on the other side. `None`
/// where there is no ink.
///
/// Each row is a band of pixels, so that gaps between branches do not count.
#[must_use]
pub fn outline(bitmap: &Bitmap, frame: &Frame, height: f64) -> Vec<Option<[f64; 2]>> {
    let steps = f64::from(ROWS - 1);
    let pixel = |z: f64| (frame.ground_row - z / frame.meters_per_pixel).max(0.0);
    let meters = |column: f64| (column - frame.axis_column) * frame.meters_per_pixel;
    let row = |i: u32| {
        let (at, half) = (height * f64::from(i) / steps, 0.5 * height / steps);
        let (top, bottom) = (pixel(at + half).floor() as u32, pixel(at - half).ceil() as u32);
        let mut columns: Vec<u32> =
            (top..bottom.min(bitmap.height())).flat_map(|y| bitmap.ink_in_row(y)).collect();
        columns.sort_unstable();
        let stray = columns.len() * STRAY / 1000;
        let (first, last) = (columns.get(stray)?, columns.get(columns.len().checked_sub(stray + 1)?)?);
        Some([-meters(f64::from(*first)), meters(f64::from(*last) + 1.0)])
    };
    (0..ROWS).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_measured_from_the_foot() {
        // A bar of 20 pixels to the right of the foot and 10 to the left, from row 20 to row 59.
        let bitmap = Bitmap::from_fn(100, 100, |x, y| (40..70).contains(&x) && (20..60).contains(&y));
        let frame =
            Frame { width: 100, height: 100, meters_per_pixel: 0.1, axis_column: 50.0, ground_row: 100.0 };
        let rows = outline(&bitmap, &frame, 8.0);
        assert_eq!(rows.len(), ROWS as usize);
        assert_eq!(rows[0], None, "nothing stands on the ground");
        let [left, right] = rows[35].unwrap();
        assert!((left - 1.0).abs() < 0.11 && (right - 2.0).abs() < 0.11, "{left} {right}");
    }
}
