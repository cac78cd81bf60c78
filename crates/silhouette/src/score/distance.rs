//! Exact distances to the nearest marked pixel.
//!
//! Felzenszwalb and Huttenlocher 2012, *Distance transforms of sampled functions*, Theory of
//! Computing 8: the lower envelope of parabolas, column by column and then row by row.

use crate::bitmap::Bitmap;

/// Squared distance in pixels from the middle of each pixel to that of the nearest ink, row by row;
/// infinite without ink.
pub(crate) fn squared_distances(marks: &Bitmap) -> Vec<f32> {
    let (width, height) = (marks.width() as usize, marks.height() as usize);
    let mut field = vec![f32::INFINITY; width * height];
    for y in 0..height {
        for x in marks.ink_in_row(y as u32) {
            field[y * width + x as usize] = 0.0;
        }
    }
    let longest = width.max(height);
    let mut line = Line {
        values: vec![0.0; longest],
        result: vec![0.0; longest],
        apex: vec![0; longest],
        start: vec![0.0; longest + 1],
    };
    for x in 0..width {
        for y in 0..height {
            line.values[y] = field[y * width + x];
        }
        line.transform(height);
        for y in 0..height {
            field[y * width + x] = line.result[y];
        }
    }
    for row in field.chunks_exact_mut(width) {
        line.values[..width].copy_from_slice(row);
        line.transform(width);
        row.copy_from_slice(&line.result[..width]);
    }
    field
}

/// One line of samples and the lower envelope of their parabolas.
struct Line {
    values: Vec<f32>,
    result: Vec<f32>,
    /// Sample at whose place each parabola of the envelope has its apex.
    apex: Vec<usize>,
    /// Where each parabola takes over from the one before.
    start: Vec<f32>,
}

impl Line {
    fn transform(&mut self, length: usize) {
        let Self { values, result, apex, start } = self;
        let mut count = 0;
        for q in 0..length {
            if values[q].is_infinite() {
                continue;
            }
            let mut from = f32::NEG_INFINITY;
            while count > 0 {
                let v = apex[count - 1];
                let (fq, fv) = (values[q] + (q * q) as f32, values[v] + (v * v) as f32);
                from = (fq - fv) / (2 * (q - v)) as f32;
                if from > start[count - 1] {
                    break;
                }
                count -= 1;
                from = f32::NEG_INFINITY;
            }
            apex[count] = q;
            start[count] = from;
            count += 1;
        }
        if count == 0 {
            result[..length].fill(f32::INFINITY);
            return;
        }
        let mut k = 0;
        for (q, out) in result[..length].iter_mut().enumerate() {
            while k + 1 < count && start[k + 1] < q as f32 {
                k += 1;
            }
            let d = q.abs_diff(apex[k]) as f32;
            *out = d * d + values[apex[k]];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_agree_with_trying_every_pixel() {
        for (width, height) in [(17, 23), (70, 9), (1, 5)] {
            let marks = Bitmap::from_fn(width, height, |x, y| (x * 31 + y * 17) % 29 == 3);
            let found = squared_distances(&marks);
            for y in 0..height {
                for x in 0..width {
                    let all = (0..height).flat_map(|v| (0..width).map(move |u| (u, v)));
                    let nearest = all
                        .filter(|&(u, v)| marks.get(u, v))
                        .map(|(u, v)| (u.abs_diff(x).pow(2) + v.abs_diff(y).pow(2)) as f32)
                        .fold(f32::INFINITY, f32::min);
                    assert_eq!(found[(y * width + x) as usize], nearest, "{x}, {y} of {width} × {height}");
                }
            }
        }
    }

    #[test]
    fn without_ink_everything_is_far() {
        assert!(squared_distances(&Bitmap::new(4, 3)).iter().all(|d| d.is_infinite()));
    }
}
