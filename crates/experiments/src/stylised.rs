//! Time, memory and vertices of stylised trees: Lorite 2021, §4.2, Tables 4.1 to 4.3.

use super::record::{self, Fixed};
use super::spec::{Repetitions, Source};
use super::within::{FileName, List, Part, Real, Whole};
use super::{Journal, Kind, Outputs, Slice, Table, progress};
use anyhow::Context;
use pleach_console::output;
use pleach_mesh::weld::{self, WeldSettings};
use pleach_tree::{Growth, Parts, Species, StemKind, Tree, Workspace};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;
use toml::Spanned;

/// The species whose numbers are replaced by a setting's.
const SPECIES: &str = "stylised_oak";
/// Seeds that are tried for a tree with just the counts of a setting.
const SEEDS: u64 = 10_000;
/// Trees whose times are compared, at the start of a run and at its end.
const SOME: usize = 100;
/// How often the skin is made: it takes far longer than the tree.
const SKINS: usize = 20;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StylisedSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Trees of each setting.
    repetitions: Repetitions,
    /// Side of the skin's cells in millimetres.
    cell_mm: Whole<1, 1000>,
    tests: List<Spanned<Setting>>,
}

/// A setting of Table 4.1.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Setting {
    name: FileName,
    roots: Whole<0, 16>,
    trunks: Whole<1, 4>,
    branches: Whole<0, 48>,
    leaves: Whole<0, 48>,
    /// Of trunks, roots, branches and leaves.
    randomness: Real<Part>,
    /// Milliseconds that the report gives.
    reported_ms: Whole<1, 1_000_000>,
}

/// A setting's tree, many times.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Timed {
    test: String,
    /// The first seed whose tree has the counts of the setting.
    seed: u64,
    roots: usize,
    trunks: usize,
    branches: usize,
    blobs: usize,
    knots: usize,
    blob_vertices: usize,
    skin_vertices: usize,
    /// Bytes that the tree's arrays hold after the first trees and after the last.
    tree_bytes_first: usize,
    tree_bytes_last: usize,
    /// Means of the first and the last hundred trees, and the slowest tree; without its skin.
    wall_tree_first_ms: Fixed<3>,
    wall_tree_last_ms: Fixed<3>,
    wall_tree_worst_ms: Fixed<3>,
    wall_tree_median_ms: Fixed<3>,
    /// The skin alone.
    wall_skin_median_ms: Fixed<3>,
    wall_skin_worst_ms: Fixed<3>,
    /// Resident memory of the process in megabytes after the first trees and after the last; 0 where the
    /// system does not tell.
    wall_resident_first_mb: Fixed<1>,
    wall_resident_last_mb: Fixed<1>,
}

impl StylisedSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.all_differ(&self.tests, |test| test.name.to_string(), "")?;
        Ok(self)
    }
}

impl Kind for StylisedSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Timed::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (Vec::new(), Vec::new())
    }

    /// One row for each setting; a slice has fewer repetitions.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let bar = progress("settings", self.tests.len() as u64);
        let repetitions = slice.take_of(*self.repetitions as usize);
        for test in &self.tests {
            let test = test.get_ref();
            journal.job(
                |row: &Timed| *row.test == *test.name,
                || Ok(vec![timed(test, repetitions, *self.cell_mm as f64 / 1000.0)?]),
            )?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, _: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Timed> = table.records()?;
        let mut lines = vec![
            ["test", "theirs, ms", "first 100, ms", "last 100, ms", "median", "worst", "skin, ms", "worst"]
                .into_iter()
                .chain(["knots", "of blobs", "of skin", "MB first", "MB last"])
                .map(str::to_owned)
                .collect::<Vec<_>>(),
        ];
        for row in &rows {
            let of = |test: &&Spanned<Setting>| *test.get_ref().name == *row.test;
            let reported = self.tests.iter().find(of).map_or(0, |test| *test.get_ref().reported_ms);
            lines.push(vec![
                row.test.clone(),
                reported.to_string(),
                row.wall_tree_first_ms.to_string(),
                row.wall_tree_last_ms.to_string(),
                row.wall_tree_median_ms.to_string(),
                row.wall_tree_worst_ms.to_string(),
                row.wall_skin_median_ms.to_string(),
                row.wall_skin_worst_ms.to_string(),
                row.knots.to_string(),
                row.blob_vertices.to_string(),
                row.skin_vertices.to_string(),
                row.wall_resident_first_mb.to_string(),
                row.wall_resident_last_mb.to_string(),
            ]);
        }
        Ok(output::table(&lines, &(1..lines[0].len()).collect::<Vec<_>>()))
    }
}

/// The species with the numbers of `test`.
fn species(test: &Setting) -> anyhow::Result<Species> {
    let species = pleach_generators::species(SPECIES)?;
    let space = species.generator.space();
    let mut values = space.defaults();
    let (trunks, branches) = (*test.trunks as f64, *test.branches as f64);
    let randomness = *test.randomness;
    let numbers = [
        ("trunks", trunks),
        ("root_quantity", 100.0 * *test.roots as f64 / 16.0),
        ("branch_quantity", 100.0 * branches / trunks / 12.0),
        ("leaves_quantity", 100.0 * *test.leaves as f64 / branches.max(1.0)),
        ("dead_branches", 0.0),
        ("trunk_randomness", randomness),
        ("root_randomness", randomness),
        ("branch_randomness", randomness),
        ("leaves_randomness", randomness),
    ];
    for (name, value) in numbers {
        let (slot, _) = space.find(name).with_context(|| format!("{SPECIES} has no {name}"))?;
        values[slot] = value;
    }
    let params = space.check(values)?;
    Ok(Species { params, ..species })
}

fn count(tree: &Tree, kinds: &[StemKind]) -> usize {
    tree.stems.iter().filter(|stem| kinds.contains(&stem.kind)).count()
}

fn counts(tree: &Tree) -> [usize; 4] {
    [
        count(tree, &[StemKind::Root]),
        count(tree, &[StemKind::Trunk, StemKind::Fork]),
        count(tree, &[StemKind::Branch]),
        tree.blobs.len(),
    ]
}

/// Bytes that the arrays of `tree` have room for.
fn bytes(tree: &Tree) -> usize {
    fn room<T>(list: &Vec<T>) -> usize {
        list.capacity() * size_of::<T>()
    }
    room(&tree.stems)
        + room(&tree.knots)
        + room(&tree.blobs)
        + room(&tree.blob_vertices)
        + room(&tree.blob_triangles)
}

/// Resident memory of this process in megabytes, where the system tells it as Linux does.
fn resident_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let kilobytes = line.and_then(|rest| rest.split_whitespace().next()?.parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) / 1024.0
}

fn timed(test: &Setting, repetitions: usize, cell: f64) -> anyhow::Result<Timed> {
    let species = species(test)?;
    let wanted = [*test.roots, *test.trunks, *test.branches, *test.leaves].map(|n| n as usize);
    let (mut workspace, mut tree) = (Workspace::default(), Tree::default());
    let mut grow = |seed: u64, tree: &mut Tree| {
        species.generator.grow(&species.params, &Growth::seed(seed), &mut workspace, tree)
    };
    let mut seed = 0;
    loop {
        seed += 1;
        grow(seed, &mut tree)?;
        if counts(&tree) == wanted {
            break;
        }
        if seed == SEEDS {
            anyhow::bail!("no tree of {SEEDS} seeds has the counts of test {}", &*test.name);
        }
    }
    // What the search for a seed has left does not count.
    let mut tree = Tree::default();
    let settings = WeldSettings { fillet: 1.0, parts: Parts::ALL, ..WeldSettings::new(cell) };
    let (mut of_tree, mut of_skin) = (Vec::new(), Vec::new());
    let mut row = Timed { test: test.name.to_string(), seed, ..Timed::default() };
    for i in 1..=repetitions {
        let started = Instant::now();
        grow(seed, &mut tree)?;
        of_tree.push(started.elapsed().as_secs_f64() * 1e3);
        if i == SOME.min(repetitions) {
            (row.tree_bytes_first, row.wall_resident_first_mb) = (bytes(&tree), Fixed(resident_mb()));
        }
    }
    (row.tree_bytes_last, row.wall_resident_last_mb) = (bytes(&tree), Fixed(resident_mb()));
    for _ in 0..SKINS.min(repetitions) {
        let started = Instant::now();
        row.skin_vertices = weld::surface(&tree, &settings)?.vertices.len();
        of_skin.push(started.elapsed().as_secs_f64() * 1e3);
    }
    [row.roots, row.trunks, row.branches, row.blobs] = counts(&tree);
    (row.knots, row.blob_vertices) = (tree.knots.len(), tree.blob_vertices.len());
    let some = SOME.min(repetitions);
    let mean = |times: &[f64]| Fixed(times.iter().sum::<f64>() / times.len() as f64);
    let worst = |times: &[f64]| Fixed(times.iter().copied().fold(0.0, f64::max));
    row.wall_tree_first_ms = mean(&of_tree[..some]);
    row.wall_tree_last_ms = mean(&of_tree[repetitions - some..]);
    row.wall_tree_worst_ms = worst(&of_tree);
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        Fixed(times[times.len() / 2])
    };
    row.wall_tree_median_ms = median(&mut of_tree);
    row.wall_skin_worst_ms = worst(&of_skin);
    row.wall_skin_median_ms = median(&mut of_skin);
    Ok(row)
}
