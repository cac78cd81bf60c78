//! A picture with rows and columns exchanged, 64 × 64 pixels at a time.

use crate::bitmap::Bitmap;

/// Makes `out` the picture whose pixel (y, x) is the pixel (x, y) of `picture`.
pub(super) fn transpose(picture: &Bitmap, out: &mut Bitmap) {
    let (width, height) = (picture.width(), picture.height());
    out.reset(height, width);
    let mut block = [0_u64; 64];
    for top in (0..height).step_by(64) {
        let rows = (height - top).min(64);
        for left in (0..width).step_by(64) {
            for (y, word) in (0..64).zip(&mut block) {
                *word = if y < rows { picture.row(top + y)[left as usize / 64] } else { 0 };
            }
            turn(&mut block);
            for (x, word) in (0..(width - left).min(64)).zip(&block) {
                out.row_mut(left + x)[top as usize / 64] = *word;
            }
        }
    }
}

/// Transposes 64 words of 64 bits: quarters of the square are exchanged across its diagonal, then
/// quarters of the quarters, down to single bits.
fn turn(block: &mut [u64; 64]) {
    let mut half = 32;
    // The low `half` bits of every group of 2 `half`.
    let mut low = u64::MAX >> 32;
    while half > 0 {
        for start in (0..64).step_by(2 * half) {
            for i in start..start + half {
                let (upper, lower) = (block[i], block[i + half]);
                block[i] = upper & low | (lower & low) << half;
                block[i + half] = upper >> half & low | lower & !low;
            }
        }
        half /= 2;
        low ^= low << half;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_become_columns() {
        let mut out = Bitmap::default();
        for (width, height) in [(64, 64), (130, 70), (1, 1), (5, 200), (256, 256), (0, 3)] {
            let picture = Bitmap::from_fn(width, height, |x, y| (x * 7 + y * y * 13 + x * y) % 5 < 2);
            transpose(&picture, &mut out);
            assert_eq!(out, Bitmap::from_fn(height, width, |x, y| picture.get(y, x)));
        }
    }
}
