//! Is likeness a better judge of trees than overlap? Every measure on the same pictures.

mod blobs;
mod figures;
mod measures;
mod pictures;
mod rates;
mod report;
mod walk;

use super::spec::LikenessSpec;
use super::{Slice, Table, progress};
use crate::input;
use measures::Values;
use pictures::Drawn;
use pleach_tree::Species;
use rayon::prelude::*;
use std::path::Path;

/// One number of one question about one set of pictures.
///
/// `against` is what another tree of the species had to beat, or the parameter that walked;
/// `comparisons` how many the value was made from.
const COLUMNS: [&str; 6] = ["question", "set", "against", "measure", "comparisons", "value"];

/// Pixels to a side of all pictures.
const SIDE: u32 = 256;

pub(super) fn run(folder: &Path, spec: &LikenessSpec) -> anyhow::Result<String> {
    let (table, walks) = outcome(folder, spec, Slice::default())?;
    table.write(&folder.join("results.csv"))?;
    figures::curves(folder, &walks, spec)?;
    figures::sheet(folder, spec)?;
    Ok(report::tables(&table))
}

pub(super) fn table(folder: &Path, spec: &LikenessSpec, slice: Slice) -> anyhow::Result<Table> {
    Ok(outcome(folder, spec, slice)?.0)
}

/// A slice has the reference pictures and the walks of the first species.
fn outcome(folder: &Path, spec: &LikenessSpec, slice: Slice) -> anyhow::Result<(Table, Vec<walk::Line>)> {
    let mut rows = Rows(Vec::new());
    for (set, foliage) in [("reference", true), ("reference, bare", false)] {
        let drawn = pictures::read(folder, &spec.reference, &spec.species, foliage)?;
        judge(set, &drawn, &mut rows);
    }
    let all = species(&spec.species)?;
    if slice.repetitions.is_none() {
        own(spec, &all, &mut rows)?;
    }
    let walking = slice.repetitions.map_or(all.len(), |n| all.len().min(n as usize));
    let walks = walk::lines(&all[..walking], spec)?;
    walk::rows(&walks, &mut rows);
    Ok((Table { columns: COLUMNS.to_vec(), rows: rows.0 }, walks))
}

fn species(names: &[String]) -> anyhow::Result<Vec<Species>> {
    names.iter().map(|name| Ok(input::species(name)?)).collect()
}

/// Collects rows.
struct Rows(Vec<Vec<String>>);

impl Rows {
    fn add(&mut self, [question, set, against, measure]: [&str; 4], comparisons: u64, value: f64) {
        let value = format!("{}", (value * 1e6).round() / 1e6);
        let cells = [question, set, against, measure, &comparisons.to_string(), &value];
        self.0.push(cells.map(str::to_owned).to_vec());
    }
}

/// Own trees, each in its own frame and then in the goal's.
fn own(spec: &LikenessSpec, species: &[Species], rows: &mut Rows) -> anyhow::Result<()> {
    let leafy = pictures::draw(species, spec.seeds, true)?;
    let half = |late: bool| -> Vec<Drawn> {
        leafy.iter().filter(|d| (d.seed > spec.tuned_seeds) == late).cloned().collect()
    };
    judge("own, tuned on", &half(false), rows);
    judge("own, not tuned on", &half(true), rows);
    judge("own", &leafy, rows);
    judge("own, bare", &pictures::draw(species, spec.seeds, false)?, rows);

    // Species that had no part in the tuning, among all others.
    let mut more = leafy;
    more.extend(pictures::draw(&self::species(&spec.unseen_species)?, spec.seeds, true)?);
    let pairs = pairs(&more);
    let unseen = |d: &Drawn| spec.unseen_species.contains(&d.species);
    let asked = rates::species(&more, |g, t| pairs[g][t], unseen);
    rates::rows("other species", "own, unseen species", &asked, rows);

    let (goals, values) = pictures::at_goal_scale(species, spec.shared_scale_seeds)?;
    let asked = rates::species(&goals, |g, t| values[g][t], |_| true);
    rates::rows("other species", "own, goal's scale", &asked, rows);
    Ok(())
}

/// Asks a set of pictures of several species whether trees of a goal's species are above others and
/// above the goal's blobs.
fn judge(set: &str, drawn: &[Drawn], rows: &mut Rows) {
    let pairs = pairs(drawn);
    let asked = rates::species(drawn, |g, t| pairs[g][t], |_| true);
    rates::rows("other species", set, &asked, rows);
    for asked in rates::blobs(drawn, |g, t| pairs[g][t]) {
        rates::rows("blobs", set, &[asked], rows);
    }
}

/// Every measure of every two pictures.
fn pairs(drawn: &[Drawn]) -> Vec<Vec<Values>> {
    let bar = progress("goals", drawn.len() as u64);
    // All measures are the same both ways: half of the table is enough.
    let upper: Vec<Vec<Values>> = drawn
        .par_iter()
        .enumerate()
        .map(|(g, goal)| {
            let row = drawn[..=g].iter().map(|other| measures::of(&goal.bitmap, &other.bitmap)).collect();
            bar.inc(1);
            row
        })
        .collect();
    bar.finish_and_clear();
    let value = |a: usize, b: usize| upper[a.max(b)][a.min(b)];
    (0..drawn.len()).map(|a| (0..drawn.len()).map(|b| value(a, b)).collect()).collect()
}
