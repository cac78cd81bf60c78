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

/// Mean, standard deviation and range of every figure over many trees.
pub(super) fn summarize(reports: &[Report<'_>]) -> String {
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
    let mut rows = vec![["", "mean", "sd", "min", "max"].map(str::to_owned).to_vec()];
    for (name, figure) in FIGURES {
        let values: Vec<f64> = reports.iter().map(|r| figure(&r.stats)).collect();
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let sd = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0)).sqrt();
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        rows.push(
            std::iter::once(name.to_owned()).chain([mean, sd, min, max].map(|v| format!("{v:.2}"))).collect(),
        );
    }
    let species = reports.first().map_or("", |r| r.species);
    format!("{species}, {} trees\n\n{}", reports.len(), output::table(&rows, &[1, 2, 3, 4]))
}
