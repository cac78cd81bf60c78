//! Statistics of one tree or many, as text and as JSON.

use crate::output;
use pleach_tree::{Species, Tree, TreeStats};
use serde::Serialize;

/// The statistics of a tree under the names that scripts rely on.
#[derive(Debug, Serialize)]
pub(super) struct Report<'a> {
    species: &'a str,
    generator: &'a str,
    seed: u64,
    #[serde(flatten)]
    stats: TreeStats,
}

impl<'a> Report<'a> {
    /// The statistics of `tree` as it stands there: in winter without the leaves that it has shed.
    pub(super) fn new(species: &'a Species, seed: u64, tree: &Tree) -> Self {
        Self {
            species: &species.name,
            generator: species.generator.family(),
            seed,
            stats: TreeStats::new(tree),
        }
    }
}

/// One tree's statistics as text.
pub(super) fn describe(report: &Report<'_>) -> String {
    let stats = &report.stats;
    let mut rows = vec![
        ["level", "stems", "Bézier points", "length", "mean length", "mean radius"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for level in 0..stats.stems.len() {
        rows.push(vec![
            level.to_string(),
            stats.stems[level].to_string(),
            stats.bezier_points[level].to_string(),
            format!("{:.2} m", stats.length_total_m[level]),
            format!("{:.3} m", stats.length_mean_m[level]),
            format!("{:.2} mm", 1000.0 * stats.radius_mean_m[level]),
        ]);
    }
    format!(
        "{} (seed {}), {:.2} m high, {:.2} × {:.2} m wide, lowest branch at {:.2} m\n\
         {} leaves ({:.2} m²), {} blossoms\n\n{}",
        report.species,
        report.seed,
        stats.height_m,
        stats.crown_width_x_m,
        stats.crown_width_y_m,
        stats.lowest_branch_m,
        stats.leaves,
        stats.leaf_area_m2,
        stats.blossoms,
        output::table(&rows, &[0, 1, 2, 3, 4, 5])
    )
}

/// A figure of a tree, and what it is called.
type Figure = (&'static str, fn(&TreeStats) -> f64);

const FIGURES: [Figure; 8] = [
    ("stems", |s| s.stems.iter().sum::<usize>() as f64),
    ("Bézier points", |s| s.bezier_points.iter().sum::<usize>() as f64),
    ("leaves", |s| s.leaves as f64),
    ("blossoms", |s| s.blossoms as f64),
    ("height, m", |s| s.height_m),
    ("width x, m", |s| s.crown_width_x_m),
    ("width y, m", |s| s.crown_width_y_m),
    ("leaf area, m²", |s| s.leaf_area_m2),
];

/// Mean, standard deviation and range of every figure over many trees, which come one after the other and
/// are not kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Summary {
    trees: u64,
    figures: [Running; FIGURES.len()],
}

impl Summary {
    /// Takes in one more tree.
    pub(super) fn add(&mut self, report: &Report<'_>) {
        self.trees += 1;
        for (running, (_, figure)) in self.figures.iter_mut().zip(FIGURES) {
            running.add(figure(&report.stats), self.trees);
        }
    }

    /// A table of the trees of `species`.
    pub(super) fn text(&self, species: &str) -> String {
        let mut rows = vec![["", "mean", "sd", "min", "max"].map(str::to_owned).to_vec()];
        for (running, (name, _)) in self.figures.iter().zip(FIGURES) {
            let sd = (running.squares / (self.trees as f64 - 1.0).max(1.0)).sqrt();
            let numbers = [running.mean, sd, running.min, running.max].map(|v| format!("{v:.2}"));
            rows.push(std::iter::once(name.to_owned()).chain(numbers).collect());
        }
        format!("{species}, {} trees\n\n{}", self.trees, output::table(&rows, &[1, 2, 3, 4]))
    }
}

/// Mean, range and sum of squared differences from the mean of numbers so far, after Welford (1962).
#[derive(Clone, Copy, Debug)]
struct Running {
    mean: f64,
    squares: f64,
    min: f64,
    max: f64,
}

impl Default for Running {
    fn default() -> Self {
        Self { mean: 0.0, squares: 0.0, min: f64::INFINITY, max: f64::NEG_INFINITY }
    }
}

impl Running {
    /// Takes in number `count`, from 1.
    fn add(&mut self, value: f64, count: u64) {
        let off = value - self.mean;
        self.mean += off / count as f64;
        self.squares += off * (value - self.mean);
        self.min = self.min.min(value);
        self.max = self.max.max(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_sums_are_those_of_the_whole() {
        let values = [1e6 + 3.0, 1e6 + 1.0, 1e6 + 4.0, 1e6 + 1.0, 1e6 + 5.0];
        let mut running = Running::default();
        values.into_iter().zip(1..).for_each(|(value, count)| running.add(value, count));
        assert!((running.mean - (1e6 + 2.8)).abs() < 1e-9, "{running:?}");
        assert!((running.squares - 12.8).abs() < 1e-8, "{running:?}");
        assert_eq!((running.min, running.max), (1e6 + 1.0, 1e6 + 5.0));
    }
}
