//! Is likeness a better judge of trees than overlap? Every measure on the same pictures.

mod blobs;
mod figures;
mod line;
mod measures;
mod pictures;
mod rates;
mod report;
mod spec;
mod walk;

use super::record::{self, Exact};
use super::spec::species_files;
use super::within::SpeciesName;
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use measures::{MEASURES, Seen, Values};
use pictures::Drawn;
use pleach_silhouette::Bitmap;
use pleach_tree::Species;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
pub(super) use spec::LikenessSpec;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// One number of one question about one set of pictures.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Answer {
    question: String,
    set: String,
    /// The competitor that another tree of the species had to beat, or the parameter that changed.
    against: String,
    measure: String,
    /// How many the value was made from.
    comparisons: u64,
    value: Exact,
}

/// Pixels to a side of all pictures.
const SIDE: u32 = 256;

impl Kind for LikenessSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Answer::default())
    }

    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let written = figures::CURVES.into_iter().map(figures::curve_file).chain([figures::SHEET.to_owned()]);
        let pictures = [true, false].map(|foliage| pictures::files(folder, self, foliage));
        let read = pictures.into_iter().flatten().map(|(_, _, path)| path);
        let species = species_files(self.species.iter().chain(&self.unseen_species));
        (written.collect(), read.chain(species).collect())
    }

    /// A slice has the reference pictures and the walks of the first species.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        for (set, foliage) in [("reference", true), ("reference, bare", false)] {
            let make = || rows(|rows| judge(set, &pictures::read(folder, self, foliage)?, rows));
            journal.job(|row: &Answer| row.question != "walk" && row.set == set, make)?;
        }
        let all = species(&self.species)?;
        if slice.repetitions.is_none() {
            let is_own = |row: &Answer| row.question != "walk" && row.set.starts_with("own");
            journal.job(is_own, || rows(|rows| own(self, &all, rows)))?;
        }
        let walking = &all[..slice.take_of(all.len())];
        journal.job(
            |row: &Answer| row.question == "walk",
            || {
                let lines = walk::lines(walking, self)?;
                rows(|rows| {
                    walk::rows(self.walked.get_or_init(|| lines), rows);
                    Ok(())
                })
            },
        )
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        // Rows that an unfinished run has left do not come with their walks.
        if self.walked.get().is_none() {
            let _ = self.walked.set(walk::lines(&species(&self.species)?, self)?);
        }
        figures::curves(outputs, self.walked.get().map_or(&[], Vec::as_slice), self)?;
        figures::sheet(outputs, self)?;
        Ok(report::tables(&table.records()?))
    }
}

fn species(names: &[Spanned<SpeciesName>]) -> anyhow::Result<Vec<Species>> {
    names.iter().map(|name| Ok(pleach_generators::species(name.get_ref())?)).collect()
}

/// The results that `make` collects.
fn rows(make: impl FnOnce(&mut Rows) -> anyhow::Result<()>) -> anyhow::Result<Vec<Answer>> {
    let mut rows = Rows(Vec::new());
    make(&mut rows)?;
    Ok(rows.0)
}

/// Collects rows.
struct Rows(Vec<Answer>);

impl Rows {
    fn add(&mut self, texts: [&str; 4], comparisons: u64, value: f64) {
        let [question, set, against, measure] = texts.map(str::to_owned);
        self.0.push(Answer { question, set, against, measure, comparisons, value: Exact::millionths(value) });
    }
}

/// Own trees, each in its own frame and then in the goal's.
fn own(spec: &LikenessSpec, species: &[Species], rows: &mut Rows) -> anyhow::Result<()> {
    let leafy = pictures::draw(species, *spec.seeds, true)?;
    let tuned = **spec.tuned_seeds.get_ref();
    let half =
        |late: bool| -> Vec<Drawn> { leafy.iter().filter(|d| (d.seed > tuned) == late).cloned().collect() };
    judge("own, tuned on", &half(false), rows)?;
    judge("own, not tuned on", &half(true), rows)?;
    judge("own", &leafy, rows)?;
    moved("own", &leafy, rows);
    judge("own, bare", &pictures::draw(species, *spec.seeds, false)?, rows)?;

    // Species that had no part in the tuning, among all others.
    let mut more = leafy;
    let unseen = self::species(&spec.unseen_species)?;
    more.extend(pictures::draw(&unseen, *spec.seeds, true)?);
    let pairs = pairs(&more)?;
    let unseen = |d: &Drawn| unseen.iter().any(|species| species.name == d.species);
    let asked = rates::species(&more, |g, t| pairs[g][t], unseen);
    rates::rows("other species", "own, unseen species", &asked, rows);

    let (goals, values) = pictures::at_goal_scale(species, *spec.shared_scale_seeds)?;
    let asked = rates::species(&goals, |g, t| values[t][g], |_| true);
    rates::rows("other species", "own, goal's scale", &asked, rows);
    Ok(())
}

/// Asks a set of pictures of several species whether trees of a goal's species are above others and
/// above the goal's blobs.
fn judge(set: &str, drawn: &[Drawn], rows: &mut Rows) -> anyhow::Result<()> {
    let pairs = pairs(drawn)?;
    let asked = rates::species(drawn, |g, t| pairs[g][t], |_| true);
    rates::rows("other species", set, &asked, rows);
    for asked in rates::blobs(drawn, |g, t| pairs[g][t]) {
        rates::rows("blobs", set, &[asked], rows);
    }
    Ok(())
}

/// What every measure says of goals that are moved aside by a sixteenth of the picture, as far as they
/// stay in it, and of their mirror images: the mean.
fn moved(set: &str, drawn: &[Drawn], rows: &mut Rows) {
    const ASIDE: u32 = SIDE / 16;
    let aside = |goal: &Bitmap| {
        let (_, _, right, _) = goal.ink_box()?;
        (right + ASIDE < SIDE)
            .then(|| Bitmap::from_fn(SIDE, SIDE, |x, y| x.checked_sub(ASIDE).is_some_and(|x| goal.get(x, y))))
    };
    let mirrored = |goal: &Bitmap| Some(Bitmap::from_fn(SIDE, SIDE, |x, y| goal.get(SIDE - 1 - x, y)));
    let ways: [(&str, &dyn Fn(&Bitmap) -> Option<Bitmap>); 2] =
        [("aside by 1/16", &aside), ("mirrored", &mirrored)];
    for (way, change) in ways {
        let changed = |d: &Drawn| Some(measures::compare(&d.seen, &Seen::new(change(&d.seen.bitmap)?)));
        let values: Vec<Values> = drawn.iter().filter_map(changed).collect();
        for (m, measure) in MEASURES.iter().enumerate() {
            let mean = values.iter().map(|v| v[m]).sum::<f64>() / values.len().max(1) as f64;
            rows.add(["moved", set, way, measure], values.len() as u64, mean);
        }
    }
}

/// Every measure of every two pictures.
fn pairs(drawn: &[Drawn]) -> anyhow::Result<Vec<Vec<Values>>> {
    let bar = progress("goals", drawn.len() as u64);
    // All measures are the same both ways: half of the table is enough.
    let upper: Vec<Vec<Values>> = drawn
        .par_iter()
        .enumerate()
        .map(|(g, goal)| {
            stop::check()?;
            let row = drawn[..=g].iter().map(|other| measures::compare(&goal.seen, &other.seen)).collect();
            bar.inc(1);
            Ok(row)
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();
    let value = |a: usize, b: usize| upper[a.max(b)][a.min(b)];
    Ok((0..drawn.len()).map(|a| (0..drawn.len()).map(|b| value(a, b)).collect()).collect())
}
