//! Time and size of trees: §4.2.2 and §4.2.3 of the dissertation.

use super::plot::{Plot, Scale};
use super::spec::GrowthSpec;
use super::{Slice, Table, progress};
use crate::{files, input, output};
use pleach_tree::{Foliage, Growth, Tree, Workspace};
use std::path::Path;
use std::time::Instant;

/// Times are the least of this many, since other work can only add to them.
const TRIES: usize = 3;

const COUNTS: [&str; 5] = ["species", "seed", "stems", "bezier_points", "leaves"];
const TIMES: [&str; 2] = ["wall_branches_ms", "wall_whole_ms"];

/// A figure of every tree of a species.
type Figures = Vec<(String, Vec<f64>)>;

pub(super) fn run(folder: &Path, spec: &GrowthSpec) -> anyhow::Result<String> {
    let table = table(spec, Slice::default())?;
    table.write(&folder.join("results.csv"))?;
    let column = |c: usize| -> Figures {
        let of = |name: &String| {
            table.rows.iter().filter(|row| row[0] == *name).filter_map(|r| r[c].parse().ok()).collect()
        };
        spec.species.iter().map(|name| (name.clone(), of(name))).collect()
    };
    if spec.timed {
        times(folder, &column(3), &column(4), &column(5), &column(6))
    } else {
        counts(folder, &column(3), &column(4))
    }
}

/// Figure 4.5: time over size, and how it grows.
fn times(
    folder: &Path,
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
    files::write_text(&folder.join("stems.svg"), &stems.svg())?;
    files::write_text(&folder.join("foliage.svg"), &foliage.svg())?;
    Ok(format!(
        "medians of one thread; the last column is the reference add-on's processor time\n\n{}\n\n\
         time of the stems grows as Bézier points to the power {:.2} (least squares of the logarithms)",
        output::table(&rows, &[1, 2, 3, 4, 5]),
        exponent(&all)
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
fn counts(folder: &Path, points: &Figures, leaves: &Figures) -> anyhow::Result<String> {
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
    files::write_text(&folder.join("complexity.svg"), &plot.svg())?;
    Ok(output::table(&rows, &[1, 2, 3, 4, 5, 6]))
}

/// One row a tree.
pub(super) fn table(spec: &GrowthSpec, slice: Slice) -> anyhow::Result<Table> {
    let seeds = slice.repetitions.unwrap_or(spec.seeds).min(spec.seeds);
    let bar = progress("trees", spec.species.len() as u64 * seeds);
    let (mut workspace, mut tree) = (Workspace::default(), Tree::default());
    let mut rows = Vec::new();
    for name in &spec.species {
        let species = input::species(name)?;
        for seed in 1..=seeds {
            let mut grow = |foliage: Foliage| -> anyhow::Result<f64> {
                let mut least = f64::INFINITY;
                for _ in 0..TRIES {
                    let started = Instant::now();
                    let growth = Growth { foliage, ..Growth::seed(seed) };
                    species.generator.grow(&species.params, &growth, &mut workspace, &mut tree)?;
                    least = least.min(started.elapsed().as_secs_f64() * 1e3);
                }
                Ok(least)
            };
            let times = if spec.timed { vec![grow(Foliage::None)?, grow(Foliage::All)?] } else { Vec::new() };
            if !spec.timed {
                species.generator.grow(&species.params, &Growth::seed(seed), &mut workspace, &mut tree)?;
            }
            let mut row = vec![
                name.clone(),
                seed.to_string(),
                tree.stems.len().to_string(),
                tree.knots.len().to_string(),
                (tree.leaves.len() + tree.blossoms.len()).to_string(),
            ];
            row.extend(times.iter().map(|ms| format!("{ms:.4}")));
            rows.push(row);
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let mut columns = COUNTS.to_vec();
    if spec.timed {
        columns.extend(TIMES);
    }
    Ok(Table { columns, rows })
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

/// The slope of log y over log x by least squares.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let (mx, my) = (logs.iter().map(|p| p.0).sum::<f64>() / n, logs.iter().map(|p| p.1).sum::<f64>() / n);
    let xy: f64 = logs.iter().map(|p| (p.0 - mx) * (p.1 - my)).sum();
    let xx: f64 = logs.iter().map(|p| (p.0 - mx).powi(2)).sum();
    xy / xx
}
