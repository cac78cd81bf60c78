//! Time and size of trees: §4.2.2 and §4.2.3 of the dissertation.

use super::plot::{Plot, Scale};
use super::record::{self, Fixed};
use super::spec::{GrowthSpec, species_files};
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use pleach_console::output;
use pleach_tree::{Foliage, Growth, Tree, Workspace};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Times are the least of this many, since other work can only add to them.
const TRIES: usize = 3;

/// A tree.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Grown {
    species: String,
    seed: u64,
    stems: usize,
    bezier_points: usize,
    /// Blossoms too.
    leaves: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_branches_ms: Option<Fixed<4>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_whole_ms: Option<Fixed<4>>,
}

/// A figure of every tree of a species.
type Figures = Vec<(String, Vec<f64>)>;

const STEMS_PLOT: &str = "stems.svg";
const FOLIAGE_PLOT: &str = "foliage.svg";
const COUNTS_PLOT: &str = "complexity.svg";

impl Kind for GrowthSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        let time = self.timed.then(Fixed::default);
        record::columns(&Grown { wall_branches_ms: time, wall_whole_ms: time, ..Grown::default() })
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let plots: &[&str] = if self.timed { &[STEMS_PLOT, FOLIAGE_PLOT] } else { &[COUNTS_PLOT] };
        (plots.iter().map(|name| (*name).to_owned()).collect(), species_files(&self.species).collect())
    }

    /// One row for each tree.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let most = **self.seeds.get_ref();
        let seeds = slice.repetitions.unwrap_or(most).min(most);
        let bar = progress("trees", self.species.len() as u64 * seeds);
        let (mut workspace, mut tree) = (Workspace::default(), Tree::default());
        for name in &self.species {
            let name = name.get_ref().as_str();
            let species = pleach_generators::species(name)?;
            for seed in 1..=seeds {
                journal.job(
                    |row: &Grown| (row.species.as_str(), row.seed) == (name, seed),
                    || {
                        let mut grow = |foliage: Foliage| -> anyhow::Result<f64> {
                            let mut least = f64::INFINITY;
                            for _ in 0..if self.timed { TRIES } else { 1 } {
                                let started = Instant::now();
                                let growth = Growth { foliage, ..Growth::seed(seed) };
                                species.generator.grow(
                                    &species.params,
                                    &growth,
                                    &mut workspace,
                                    &mut tree,
                                )?;
                                least = least.min(started.elapsed().as_secs_f64() * 1e3);
                            }
                            Ok(least)
                        };
                        let branches = if self.timed { Some(grow(Foliage::None)?) } else { None };
                        let whole = grow(Foliage::All)?;
                        Ok(vec![Grown {
                            species: name.to_owned(),
                            seed,
                            stems: tree.stems.len(),
                            bezier_points: tree.knots.len(),
                            leaves: tree.leaves.len() + tree.blossoms.len(),
                            wall_branches_ms: branches.map(Fixed),
                            wall_whole_ms: branches.map(|_| Fixed(whole)),
                        }])
                    },
                )?;
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Grown> = table.records()?;
        let column = |value: fn(&Grown) -> Option<f64>| -> Figures {
            let of = |name: &str| rows.iter().filter(|row| row.species == name).filter_map(value).collect();
            self.species.iter().map(|name| (name.get_ref().to_string(), of(name.get_ref()))).collect()
        };
        let points = column(|row| Some(row.bezier_points as f64));
        let leaves = column(|row| Some(row.leaves as f64));
        if self.timed {
            let branches = column(|row| Some(row.wall_branches_ms?.0));
            let whole = column(|row| Some(row.wall_whole_ms?.0));
            times(outputs, &points, &leaves, &branches, &whole)
        } else {
            counts(outputs, &points, &leaves)
        }
    }
}

/// Figure 4.5: time over size, and how it grows.
fn times(
    outputs: &Outputs,
    points: &Figures,
    leaves: &Figures,
    branches_ms: &Figures,
    whole_ms: &Figures,
) -> anyhow::Result<String> {
    let pairs =
        |x: &[f64], y: &[f64]| -> Vec<(f64, f64)> { x.iter().copied().zip(y.iter().copied()).collect() };
    let mut stems = Plot::new("Bézier points", "milliseconds for the stems", Scale::Log, Scale::Log);
    let mut foliage =
        Plot::new("leaves and blossoms", "milliseconds for the foliage", Scale::Log, Scale::Log);
    let mut all = Vec::new();
    let mut rows = vec![
        ["species", "Bézier points", "leaves", "stems, ms", "whole, ms", "add-on, ms"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for (i, (name, points)) in points.iter().enumerate() {
        let (leaves, branches, whole) = (&leaves[i].1, &branches_ms[i].1, &whole_ms[i].1);
        let rest: Vec<f64> = whole.iter().zip(branches).map(|(w, b)| (w - b).max(1e-3)).collect();
        stems.dots(name, &pairs(points, branches));
        foliage.dots(name, &pairs(leaves, &rest));
        all.extend(pairs(points, branches));
        rows.push(vec![
            name.clone(),
            format!("{:.0}", median(points)),
            format!("{:.0}", median(leaves)),
            format!("{:.3}", median(branches)),
            format!("{:.2}", median(whole)),
            ADD_ON_MS.iter().find(|(n, _)| n == name).map_or_else(String::new, |(_, ms)| ms.to_string()),
        ]);
    }
    outputs.text(STEMS_PLOT, &stems.svg())?;
    outputs.text(FOLIAGE_PLOT, &foliage.svg())?;
    Ok(format!(
        "medians of one thread; the last column is the reference add-on's processor time\n\n{}\n\n\
         {}",
        output::table(&rows, &[1, 2, 3, 4, 5]),
        exponent(&all).map_or_else(
            || "all trees are of one size: they do not say how time grows with it".to_owned(),
            |exponent| format!(
                "time of the stems grows as Bézier points to the power {exponent:.2} (least squares of the \
                 logarithms)"
            )
        )
    ))
}

/// Mean processor milliseconds of the reference add-on for curves and leaf mesh, measured in Blender
/// 4.2 over its reference seeds on a machine of the same kind.
const ADD_ON_MS: [(&str, u32); 15] = [
    ("quaking_aspen", 1089),
    ("weeping_willow", 134326),
    ("bamboo", 973),
    ("palm", 70),
    ("lombardy_poplar", 1284),
    ("small_pine", 1506),
    ("acer", 111),
    ("silver_birch", 3138),
    ("douglas_fir", 9414),
    ("apple", 1269),
    ("black_tupelo", 14915),
    ("black_oak", 4201),
    ("european_larch", 9724),
    ("hill_cherry", 300),
    ("balsam_fir", 8621),
];

/// Figure 4.7: size by species.
fn counts(outputs: &Outputs, points: &Figures, leaves: &Figures) -> anyhow::Result<String> {
    let mut plot = Plot::new("", "Bézier points", Scale::Index, Scale::Log);
    let mut rows =
        vec![["species", "Bézier points", "sd", "least", "most", "leaves", "sd"].map(str::to_owned).to_vec()];
    for (i, (name, points)) in points.iter().enumerate() {
        plot.dots(name, &points.iter().map(|p| (i as f64, *p)).collect::<Vec<_>>());
        let leaves = &leaves[i].1;
        let least = points.iter().copied().fold(f64::INFINITY, f64::min);
        let most = points.iter().copied().fold(0.0, f64::max);
        let figures = [mean(points), spread(points), least, most, mean(leaves), spread(leaves)];
        rows.push(std::iter::once(name.clone()).chain(figures.map(|f| format!("{f:.0}"))).collect());
    }
    outputs.text(COUNTS_PLOT, &plot.svg())?;
    Ok(output::table(&rows, &[1, 2, 3, 4, 5, 6]))
}

fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Standard deviation.
fn spread(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len().saturating_sub(1).max(1) as f64)
        .sqrt()
}

/// The slope of log y over log x by least squares; `None` where x never changes.
fn exponent(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    let xy: f64 = logs.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    let xx: f64 = logs.iter().map(|p| (p.0 - mx).powi(2)).sum();
    (xx > 0.0).then(|| xy / xx).filter(|slope| slope.is_finite())
}
