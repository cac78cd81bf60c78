//! Where the ground begins at the picture's sides.

use super::oklab::Oklab;

/// How clear a horizon must be to be one.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepThreshold {
    /// Least step of colour between sky and ground, in Oklab.
    step: f64,
    /// Least ratio of the step to how much colours vary on either side of it.
    ratio: f64,
}

impl StepThreshold {
    /// Well above what light does to a wall.
    pub(super) const STRICT: Self = Self { step: 0.08, ratio: 4.0 };
    /// Where a ground is likely: water and mist differ little from the sky.
    pub(super) const LENIENT: Self = Self { step: 0.04, ratio: 2.0 };
}

/// Horizons lie below this part of the picture's height.
const HIGHEST: f64 = 0.35;
/// Sides that disagree by more than this part of the height do not see the same horizon.
const MAX_SLOPE: f64 = 0.15;

/// A straight line between the picture's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Horizon {
    /// Its row at the left edge, in pixels from the top.
    pub left: f64,
    /// Its row at the right edge, in pixels from the top.
    pub right: f64,
}

impl Horizon {
    /// The line through both sides' horizons. Where they disagree, or one sees none, the lower of the
    /// rows at which both sides change stands for both: a crown that touches a side also ends the sky
    /// there, but only there.
    pub(super) fn detect(left: &[Oklab], right: &[Oklab], clear: StepThreshold) -> Option<Self> {
        let height = left.len().min(right.len()) as f64;
        let found = [step(left, clear), step(right, clear)];
        if let [Some(left), Some(right)] = found
            && (left - right).abs() <= MAX_SLOPE * height
        {
            return Some(Self { left, right });
        }
        let shared = found
            .into_iter()
            .flatten()
            .filter(|&row| changes(left, row, clear) && changes(right, row, clear));
        shared.max_by(f64::total_cmp).map(|row| Self { left: row, right: row })
    }

    /// The row at a column of a picture `width` pixels wide.
    pub(super) fn at(self, x: u32, width: u32) -> f64 {
        self.left + (self.right - self.left) * (f64::from(x) + 0.5) / f64::from(width)
    }
}

/// Sums that give the residual of a straight line through a run of rows.
#[derive(Clone, Copy, Default)]
struct Sums {
    n: f64,
    y: f64,
    yy: f64,
    c: [f64; 3],
    yc: [f64; 3],
    cc: f64,
}

impl Sums {
    fn add(&mut self, y: f64, color: Oklab) {
        self.n += 1.0;
        self.y += y;
        self.yy += y * y;
        for (i, v) in color.into_iter().map(f64::from).enumerate() {
            self.c[i] += v;
            self.yc[i] += y * v;
            self.cc += v * v;
        }
    }

    /// What a line leaves of the squares, and the line's colours at `at`.
    fn line(&self, at: f64) -> (f64, [f64; 3]) {
        let spread = self.yy - self.y * self.y / self.n;
        let mut left = self.cc;
        let colors = std::array::from_fn(|i| {
            let joint = self.yc[i] - self.y * self.c[i] / self.n;
            let slope = if spread > 1e-9 { joint / spread } else { 0.0 };
            left -= self.c[i] * self.c[i] / self.n + slope * joint;
            self.c[i] / self.n + slope * (at - self.y / self.n)
        });
        (left.max(0.0), colors)
    }
}

/// The row before which two straight courses of colour, one above and one below, leave the least
/// of the squares; `None` if there is no clear step of colour there.
fn step(rows: &[Oklab], clear: StepThreshold) -> Option<f64> {
    let mut below = vec![Sums::default(); rows.len() + 1];
    for (y, &color) in rows.iter().enumerate().rev() {
        below[y] = below[y + 1];
        below[y].add(y as f64, color);
    }
    let least = (rows.len() / 50).max(2);
    let mut above = Sums::default();
    let mut best: Option<(f64, usize, f64)> = None;
    for (y, &color) in rows.iter().enumerate() {
        let edge = y as f64 - 0.5;
        if y >= least && y + least <= rows.len() && y as f64 >= HIGHEST * rows.len() as f64 {
            let ((a, over), (b, under)) = (above.line(edge), below[y].line(edge));
            if best.is_none_or(|(squares, ..)| a + b < squares) {
                let step = over.iter().zip(under).map(|(o, u)| (o - u) * (o - u)).sum::<f64>().sqrt();
                best = Some((a + b, y, step));
            }
        }
        above.add(y as f64, color);
    }
    let (squares, row, step) = best?;
    let noise = (squares / rows.len() as f64).sqrt();
    (step >= clear.step && step >= clear.ratio * noise).then_some(row as f64)
}

/// Whether the colours just above a row differ from those just below.
fn changes(rows: &[Oklab], row: f64, clear: StepThreshold) -> bool {
    let (row, reach) = (row as usize, (rows.len() / 20).max(2));
    let mean = |rows: &[Oklab]| -> [f64; 3] {
        std::array::from_fn(|i| rows.iter().map(|c| f64::from(c[i])).sum::<f64>() / rows.len().max(1) as f64)
    };
    let above = mean(&rows[row.saturating_sub(reach)..row.min(rows.len())]);
    let below = mean(&rows[row.min(rows.len())..(row + reach).min(rows.len())]);
    above.iter().zip(below).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt() >= clear.step
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sky that pales downwards, and lawn from a row on.
    fn side(lawn: usize) -> Vec<Oklab> {
        let noise = |y: usize| ((y * 37) % 17) as f32 / 17.0 - 0.5;
        (0..200)
            .map(|y| {
                let sky = [0.6 + 0.001 * y as f32 + 0.01 * noise(y), -0.03, -0.1 + 0.0003 * y as f32];
                if y < lawn { sky } else { [0.5 + 0.06 * noise(y), -0.1, 0.1] }
            })
            .collect()
    }

    #[test]
    fn the_row_where_lawn_begins_is_found_and_none_is_made_up() {
        for lawn in [80, 150, 190] {
            assert_eq!(step(&side(lawn), StepThreshold::STRICT), Some(lawn as f64));
        }
        assert_eq!(step(&side(200), StepThreshold::STRICT), None);
        assert_eq!(step(&[], StepThreshold::STRICT), None);
    }

    #[test]
    fn a_crown_at_one_side_does_not_raise_the_horizon() {
        let mut left = side(160);
        for color in &mut left[75..120] {
            *color = [0.2, 0.0, 0.05];
        }
        let horizon = Horizon::detect(&left, &side(160), StepThreshold::STRICT).unwrap();
        assert!((horizon.at(50, 100) - 160.0).abs() < 1.0, "{horizon:?}");
        // Without a lawn there is none.
        let mut left = side(200);
        for color in &mut left[75..120] {
            *color = [0.2, 0.0, 0.05];
        }
        assert_eq!(Horizon::detect(&left, &side(200), StepThreshold::LENIENT), None);
        assert_eq!(Horizon::detect(&side(200), &left, StepThreshold::LENIENT), None);
        let slope = Horizon::detect(&side(140), &side(160), StepThreshold::STRICT).unwrap();
        assert_eq!((slope.at(0, 100).round(), slope.at(99, 100).round()), (140.0, 160.0));
    }
}
