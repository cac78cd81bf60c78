//! Blurred overlap: how well masses agree, twigs aside.

use crate::bitmap::Bitmap;

/// A picture blurred by a Gaussian, to be compared with others blurred alike.
///
/// The Gaussian is three running means (Wells 1986, *Efficient synthesis of Gaussian filters by
/// cascaded uniform filters*, IEEE PAMI 8): its sigma is within 5 % from 4 pixels up, and any sigma is
/// as fast as another. Beyond the edges is paper.
#[derive(Clone, Debug)]
pub struct Blurred {
    field: Vec<f32>,
}

impl Blurred {
    /// Blurs `bitmap` with a sigma in pixels.
    #[must_use]
    pub fn new(bitmap: &Bitmap, sigma: f64) -> Self {
        Self { field: blurred(bitmap, sigma) }
    }

    /// Soft intersection over union, Σ min / Σ max, of two pictures of one size, in 0..=1; 1 where both
    /// are empty.
    #[must_use]
    pub fn iou(&self, other: &Self) -> f64 {
        let (mut least, mut most) = (0.0, 0.0);
        for (a, b) in self.field.iter().zip(&other.field) {
            least += f64::from(a.min(*b));
            most += f64::from(a.max(*b));
        }
        if most > 0.0 { least / most } else { 1.0 }
    }
}

/// Soft intersection over union of the two pictures blurred by a Gaussian of `sigma` pixels, see
/// [`Blurred`].
pub fn blurred_iou(a: &Bitmap, b: &Bitmap, sigma: f64) -> f64 {
    Blurred::new(a, sigma).iou(&Blurred::new(b, sigma))
}

/// The picture blurred by a Gaussian of `sigma` pixels, inked where it is at least half: its masses
/// without their texture.
#[must_use]
pub fn blob(bitmap: &Bitmap, sigma: f64) -> Bitmap {
    let Blurred { field } = Blurred::new(bitmap, sigma);
    let width = bitmap.width();
    Bitmap::from_fn(width, bitmap.height(), |x, y| field[(y * width + x) as usize] >= 0.5)
}

fn blurred(bitmap: &Bitmap, sigma: f64) -> Vec<f32> {
    let (width, height) = (bitmap.width() as usize, bitmap.height() as usize);
    let mut field = vec![0.0; width * height];
    for y in 0..height {
        for x in bitmap.ink_in_row(y as u32) {
            field[y * width + x as usize] = 1.0;
        }
    }
    let mut line = Vec::new();
    for half in half_widths(sigma) {
        for row in field.chunks_exact_mut(width) {
            line.clear();
            line.extend_from_slice(row);
            running_mean(&line, half, row.iter_mut());
        }
        for x in 0..width {
            line.clear();
            line.extend(field[x..].iter().step_by(width));
            running_mean(&line, half, field[x..].iter_mut().step_by(width));
        }
    }
    field
}

/// Half widths of three running means whose variances add up to sigma².
fn half_widths(sigma: f64) -> [usize; 3] {
    // A mean over 2h + 1 pixels has variance h(h + 1)/3.
    let ideal = (sigma * sigma + 0.25).sqrt() - 0.5;
    let low = ideal.floor();
    let (short, long) = (low * (low + 1.0), (low + 1.0) * (low + 2.0));
    let longer = ((3.0 * sigma * sigma - 3.0 * short) / (long - short)).round().clamp(0.0, 3.0) as usize;
    std::array::from_fn(|i| low as usize + usize::from(i < longer))
}

fn running_mean<'a>(line: &[f32], half: usize, out: impl Iterator<Item = &'a mut f32>) {
    let scale = 1.0 / (2 * half + 1) as f32;
    let mut sum: f32 = line.iter().take(half).sum();
    for (i, out) in out.enumerate() {
        sum += line.get(i + half).copied().unwrap_or(0.0);
        // Rounding may leave a tiny negative sum where all ink has left the window.
        *out = (sum * scale).max(0.0);
        if i >= half {
            sum -= line[i - half];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot_becomes_a_bell_of_the_right_width() {
        for sigma in [4.0, 4.3, 8.0, 16.0] {
            let dot = Bitmap::from_fn(129, 129, |x, y| x == 64 && y == 64);
            let field = blurred(&dot, sigma);
            let (mut mass, mut variance) = (0.0, 0.0);
            for (i, v) in field.iter().enumerate() {
                mass += f64::from(*v);
                variance += f64::from(*v) * ((i % 129) as f64 - 64.0).powi(2);
            }
            assert!((mass - 1.0).abs() < 1e-3, "{mass}");
            assert!((variance.sqrt() / sigma - 1.0).abs() < 0.05, "sigma {sigma}: {}", variance.sqrt());
            let peak = 1.0 / (std::f64::consts::TAU * sigma * sigma);
            assert!((f64::from(field[64 * 129 + 64]) / peak - 1.0).abs() < 0.2);
        }
    }

    #[test]
    fn a_comb_becomes_a_block() {
        // Bars of six in eight pixels: three quarters of ink inside, none outside.
        let comb =
            Bitmap::from_fn(128, 128, |x, y| (32..96).contains(&x) && (32..96).contains(&y) && x % 8 < 6);
        let found = blob(&comb, 8.0);
        assert!((40..88).all(|x| found.get(x, 64)), "no gap is left");
        assert!(!found.get(20, 64) && !found.get(64, 108));
        assert_eq!(blob(&Bitmap::new(9, 9), 2.0), Bitmap::new(9, 9));
    }

    #[test]
    fn shifts_cost_less_than_their_pixels() {
        let line = |x0: u32| Bitmap::from_fn(64, 64, |x, _| x == x0);
        assert_eq!(blurred_iou(&line(30), &line(30), 4.0), 1.0);
        let near = blurred_iou(&line(30), &line(31), 4.0);
        let far = blurred_iou(&line(30), &line(50), 4.0);
        assert!(near > 0.75 && far < 0.05, "{near} {far}");
        assert_eq!(blurred_iou(&Bitmap::new(8, 8), &Bitmap::new(8, 8), 1.0), 1.0);
        assert_eq!(blurred_iou(&line(30), &Bitmap::new(64, 64), 2.0), 0.0);
    }
}
