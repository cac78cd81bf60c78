//! The layout by looks: near on the map is near to the eye.
//!
//! How unlike two species are is one less the blurred overlap of their silhouettes, each in its own
//! frame so that size does not count, in the mean over several seeds. Multidimensional scaling finds
//! dots whose distances are as near to these as a plane allows: classical scaling (Torgerson 1952) to
//! start, then stress majorisation (SMACOF, de Leeuw 1977), which never makes it worse.

use crate::draw::{DrawError, Drawing, silhouettes};
use crate::plane::Point;
use pleach_silhouette::Detail;
use pleach_silhouette::score::blurred_iou;
use pleach_tree::Species;
use pleach_tree::math;
use rayon::prelude::*;

/// Seeds 1 to this of each species are compared.
pub const SEEDS: u64 = 4;

/// Silhouettes are this wide and high.
const PIXELS: u32 = 128;

/// Blur, in parts of the picture's height: masses count, twigs do not.
const BLUR: f64 = 1.0 / 32.0;

/// How unlike each pair of `species` looks, 0 to 1; a symmetric matrix, 0 on its diagonal.
///
/// # Errors
/// The first species that does not grow.
pub fn unlikeness(species: &[Species]) -> Result<Vec<Vec<f64>>, DrawError> {
    let drawing = Drawing { pixels: PIXELS, detail: Detail::Half };
    let drawn = (1..=SEEDS).map(|seed| silhouettes(species, seed, drawing)).collect::<Result<Vec<_>, _>>()?;
    let count = species.len();
    let pairs: Vec<(usize, usize)> = (0..count).flat_map(|i| (0..i).map(move |j| (i, j))).collect();
    let unlike: Vec<f64> = pairs
        .par_iter()
        .map(|&(i, j)| {
            let overlap = |row: &Vec<_>| blurred_iou(&row[i], &row[j], f64::from(PIXELS) * BLUR);
            1.0 - drawn.iter().map(overlap).sum::<f64>() / drawn.len() as f64
        })
        .collect();
    let mut matrix = vec![vec![0.0; count]; count];
    for (&(i, j), unlike) in pairs.iter().zip(unlike) {
        matrix[i][j] = unlike;
        matrix[j][i] = unlike;
    }
    Ok(matrix)
}

/// Dots on a plane whose distances are as near to `distances` as they can be: a symmetric matrix, 0 on
/// its diagonal. Centred on the origin, the longer spread along x.
#[must_use]
pub fn scale(distances: &[Vec<f64>]) -> Vec<Point> {
    let mut dots = classical(distances);
    let mut last = stress(distances, &dots);
    for _ in 0..STEPS {
        dots = majorized(distances, &dots);
        let now = stress(distances, &dots);
        if last - now <= MIN_GAIN * last {
            break;
        }
        last = now;
    }
    turned(&dots)
}

/// Part of the distances that a layout does not show: Kruskal's stress 1, 0 for a perfect one.
#[must_use]
pub fn stress(distances: &[Vec<f64>], dots: &[Point]) -> f64 {
    let (mut off, mut all) = (0.0, 0.0);
    for (i, row) in distances.iter().enumerate() {
        for (j, wanted) in row.iter().enumerate().take(i) {
            off += math::powi(dots[i].distance(dots[j]) - wanted, 2);
            all += wanted * wanted;
        }
    }
    if all > 0.0 { (off / all).sqrt() } else { 0.0 }
}

const STEPS: usize = 500;
const MIN_GAIN: f64 = 1e-7;

/// Classical scaling: the two main axes of the doubly centred squared distances, by power iteration.
fn classical(distances: &[Vec<f64>]) -> Vec<Point> {
    let n = distances.len();
    let square = |i: usize, j: usize| distances[i][j] * distances[i][j];
    let row_mean: Vec<f64> = (0..n).map(|i| (0..n).map(|j| square(i, j)).sum::<f64>() / n as f64).collect();
    let mean = row_mean.iter().sum::<f64>() / n as f64;
    let mut product: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| -0.5 * (square(i, j) - row_mean[i] - row_mean[j] + mean)).collect())
        .collect();
    let mut axes = [vec![0.0; n], vec![0.0; n]];
    for (number, axis) in axes.iter_mut().enumerate() {
        // Any start that is not at right angles to the axis; the second differs from the first.
        let mut v: Vec<f64> = (0..n).map(|i| ((i + 1) * (2 * number + 3)) as f64 % 7.0 - 2.9).collect();
        let mut value = 0.0;
        for _ in 0..STEPS {
            let image: Vec<f64> =
                product.iter().map(|row| row.iter().zip(&v).map(|(a, b)| a * b).sum()).collect();
            let length = image.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length <= 1e-12 {
                break;
            }
            value = image.iter().zip(&v).map(|(a, b)| a * b).sum();
            v = image.into_iter().map(|x| x / length).collect();
        }
        for (i, row) in product.iter_mut().enumerate() {
            row.iter_mut().enumerate().for_each(|(j, cell)| *cell -= value * v[i] * v[j]);
        }
        *axis = v.into_iter().map(|x| x * value.max(0.0).sqrt()).collect();
    }
    let [x, y] = axes;
    x.into_iter().zip(y).map(|(x, y)| Point { x, y }).collect()
}

/// One step of stress majorisation (the Guttman transform).
fn majorized(distances: &[Vec<f64>], dots: &[Point]) -> Vec<Point> {
    let n = dots.len();
    (0..n)
        .map(|i| {
            let mut sum = Point::default();
            for j in (0..n).filter(|&j| j != i) {
                let apart = dots[i] - dots[j];
                let length = apart.length();
                let pull = if length > 1e-12 { distances[i][j] / length } else { 0.0 };
                sum = sum + apart * pull;
            }
            sum * (1.0 / n as f64)
        })
        .collect()
}

/// Moved to the origin and turned so that the longest spread lies along x.
fn turned(dots: &[Point]) -> Vec<Point> {
    let mean = dots.iter().fold(Point::default(), |m, d| m + *d) * (1.0 / dots.len().max(1) as f64);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for d in dots.iter().map(|d| *d - mean) {
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    let (sin, cos) = math::sin_cos(0.5 * math::atan2(2.0 * xy, xx - yy));
    let along = |d: Point| Point { x: cos * d.x + sin * d.y, y: cos * d.y - sin * d.x };
    dots.iter().map(|d| along(*d - mean)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{species, uniform};

    #[test]
    fn points_of_a_plane_are_found_again() {
        let mut draws = uniform(3);
        let mut draw = || 4.0 * draws.next().unwrap();
        let dots: Vec<Point> = (0..12).map(|_| Point { x: draw(), y: draw() }).collect();
        let matrix: Vec<Vec<f64>> =
            dots.iter().map(|a| dots.iter().map(|b| a.distance(*b)).collect()).collect();
        let found = scale(&matrix);
        assert!(stress(&matrix, &found) < 1e-3, "{}", stress(&matrix, &found));
        assert!((found[0].distance(found[5]) - matrix[0][5]).abs() < 1e-2);
    }

    #[test]
    fn majorisation_never_makes_it_worse() {
        // Four points all 1 apart do not fit on a plane.
        let matrix: Vec<Vec<f64>> =
            (0..4).map(|i| (0..4).map(|j| f64::from(u8::from(i != j))).collect()).collect();
        let mut dots: Vec<Point> = (0..4).map(|i| Point { x: f64::from(i), y: f64::from(i * i) }).collect();
        let mut last = stress(&matrix, &dots);
        for _ in 0..20 {
            dots = majorized(&matrix, &dots);
            let now = stress(&matrix, &dots);
            assert!(now <= last + 1e-12);
            last = now;
        }
        assert!((0.05..0.3).contains(&last), "{last}");
    }

    #[test]
    fn firs_look_more_like_firs_than_like_palms() {
        let unlike = unlikeness(&["balsam_fir", "small_pine", "palm"].map(species)).unwrap();
        assert!(unlike[0][1] < unlike[0][2] && unlike[0][1] < unlike[1][2], "{unlike:?}");
        assert_eq!((unlike[0][0], unlike[1][0]), (0.0, unlike[0][1]));
    }
}
