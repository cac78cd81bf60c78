//! Whether an individual can be distinguished from the trees that its species draws.

use super::SIDE;
use crate::pictured::draw;
use pleach_fit::GoalView;
use pleach_silhouette::View;
use pleach_silhouette::score::likeness::{Descriptor, Scratch};
use pleach_tree::{Foliage, Growth, Species, Stem, StemKind, Tree};
use std::f64::consts::PI;

/// Trees that the species draws, to compare with.
const FREE: u64 = 8;
/// The first of their seeds is so far from the individual's.
const FIRST: u64 = 2000;

/// How an individual compares with free trees of its kind.
pub(super) struct Natural {
    /// Likeness of its view from the side to theirs, and of theirs to each other; means.
    pub(super) turned_likeness: f64,
    pub(super) free_likeness: f64,
    /// Kolmogorov–Smirnov distances of azimuth, pitch, length and curvature of first branches.
    pub(super) distances: [f64; 4],
    /// The least probability of such distances by chance.
    pub(super) least_p: f64,
}

impl Natural {
    /// Compares the individual of `species`, which stands as `front` shows it.
    pub(super) fn new(species: &Species, front: &GoalView, foliage: Foliage) -> anyhow::Result<Self> {
        let own = species.tree_seed.unwrap_or_default();
        let side = GoalView { view: View::degrees(SIDE, 0.0), ..front.clone() };
        let seeds: Vec<u64> = (0..FREE).map(|i| own + FIRST + i).collect();
        let mut scratch = Scratch::default();
        let mut described = |seed: u64| -> anyhow::Result<Descriptor> {
            Ok(Descriptor::new(&draw(species, seed, foliage, &side)?, &mut scratch))
        };
        let turned = described(own)?;
        let free = seeds.iter().map(|&seed| described(seed)).collect::<anyhow::Result<Vec<_>>>()?;
        let alike = |a: &Descriptor, b: &Descriptor| a.compare(b).value();
        let pairs = || (0..free.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let grow = |seed: u64| species.grow_with(&Growth { foliage: Foliage::None, ..Growth::seed(seed) });
        let chosen = branches(&grow(own)?);
        let mut drawn: [Vec<f64>; 4] = Default::default();
        for &seed in &seeds {
            for (all, more) in drawn.iter_mut().zip(branches(&grow(seed)?)) {
                all.extend(more);
            }
        }
        let (mut distances, mut least_p) = ([0.0; 4], 1.0_f64);
        for ((distance, chosen), drawn) in distances.iter_mut().zip(chosen).zip(drawn) {
            let (d, p) = kolmogorov_smirnov(chosen, drawn);
            *distance = d;
            least_p = least_p.min(p);
        }
        Ok(Self {
            turned_likeness: free.iter().map(|one| alike(&turned, one)).sum::<f64>() / free.len() as f64,
            free_likeness: pairs().map(|(i, j)| alike(&free[i], &free[j])).sum::<f64>()
                / pairs().count() as f64,
            distances,
            least_p,
        })
    }
}

/// Azimuth, pitch, length and curvature of all branches of trunks.
fn branches(tree: &Tree) -> [Vec<f64>; 4] {
    let mut all: [Vec<f64>; 4] = Default::default();
    let is_branch = |stem: &&Stem| stem.level == 1 && stem.kind == StemKind::Branch;
    for stem in tree.stems.iter().filter(is_branch) {
        for (values, value) in all.iter_mut().zip(shape_of(tree, stem)) {
            values.push(value);
        }
    }
    all
}

/// Azimuth and pitch of a stem's foot in radians, its length in metres, and by which part its ends are nearer
/// to each other than it is long.
fn shape_of(tree: &Tree, stem: &Stem) -> [f64; 4] {
    let knots = tree.knots_of(stem);
    let (first, last) = (&knots[0], &knots[knots.len() - 1]);
    let along = (first.handle_out - first.point).normalize_or_zero();
    let length = tree.length_of(stem);
    let chord = first.point.distance(last.point);
    [along.y.atan2(along.x), along.z.clamp(-1.0, 1.0).acos(), length, 1.0 - chord / length.max(1e-9)]
}

/// The greatest distance of the distributions of two samples, and the probability of one as great of samples of
/// the same distribution (asymptotically; Kolmogorov 1933, Smirnov 1948). 0 and 1 where one is empty.
fn kolmogorov_smirnov(mut a: Vec<f64>, mut b: Vec<f64>) -> (f64, f64) {
    if a.is_empty() || b.is_empty() {
        return (0.0, 1.0);
    }
    a.sort_by(f64::total_cmp);
    b.sort_by(f64::total_cmp);
    let below = |sample: &[f64], x: f64| sample.partition_point(|v| *v <= x) as f64 / sample.len() as f64;
    let distance = a.iter().chain(&b).map(|&x| (below(&a, x) - below(&b, x)).abs()).fold(0.0, f64::max);
    let (n, m) = (a.len() as f64, b.len() as f64);
    let size = (n * m / (n + m)).sqrt();
    // Stephens' correction for small samples.
    let lambda = distance * (size + 0.12 + 0.11 / size);
    let p = if lambda < 0.3 {
        1.0
    } else if lambda < 1.18 {
        let term = |k: f64| (-(2.0 * k - 1.0).powi(2) * PI * PI / (8.0 * lambda * lambda)).exp();
        1.0 - (2.0 * PI).sqrt() / lambda * (1..=20).map(|k| term(f64::from(k))).sum::<f64>()
    } else {
        let term = |k: i32| {
            f64::from(if k % 2 == 1 { 1 } else { -1 }) * (-2.0 * f64::from(k * k) * lambda * lambda).exp()
        };
        2.0 * (1..=20).map(term).sum::<f64>()
    };
    (distance, p.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_tree::Key;

    fn sample(seed: u64, count: u32, shift: f64) -> Vec<f64> {
        (0..count).map(|i| Key::root(seed).unit(0, i) + shift).collect()
    }

    #[test]
    fn samples_of_one_distribution_are_told_apart_as_often_as_the_probability_says() {
        let p = |seed: u64| kolmogorov_smirnov(sample(seed, 60, 0.0), sample(seed + 5000, 300, 0.0)).1;
        let below = |level: f64| (0..1000).filter(|&seed| p(seed) < level).count();
        for (level, expected) in [(0.5, 350..650), (0.1, 60..140), (0.01, 1..25)] {
            assert!(expected.contains(&below(level)), "{level}: {}", below(level));
        }
    }

    #[test]
    fn other_distributions_are_told() {
        let (distance, p) = kolmogorov_smirnov(sample(1, 100, 0.3), sample(2, 800, 0.0));
        assert!((0.2..0.45).contains(&distance) && p < 1e-4, "{distance} {p}");
        assert_eq!(kolmogorov_smirnov(vec![1.0], vec![2.0]).0, 1.0);
        assert_eq!(kolmogorov_smirnov(Vec::new(), vec![2.0]), (0.0, 1.0));
    }
}
