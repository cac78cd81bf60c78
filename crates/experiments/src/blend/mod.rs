//! Blends of species: seed's §4.4.1 remade, and what it could not do counted.

mod broken;
mod maps;
mod pictures;
mod ranges;
mod smoothness;

use super::record::{self, Exact};
use super::spec::{BlendSpec, species_files};
use super::{Journal, Kind as Experiment, Outputs, Slice, Table, progress, stop};
use anyhow::Context;
use maps::Maps;
use pleach_blend::draw::{Drawing, silhouettes};
use pleach_blend::{BlendMap, Point, map};
use pleach_console::output;
use pleach_silhouette::Detail;
use pleach_silhouette::score::blurred_iou;
use pleach_tree::{Key, Species};
use ranges::{Ranges, figures, grow};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// One number of one question about one blend, or one group of them.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Answer {
    question: String,
    first: String,
    second: String,
    method: String,
    measure: String,
    value: Exact,
}

/// Collects rows.
struct Rows(Vec<Answer>);

impl Rows {
    fn add(
        &mut self,
        question: &str,
        (first, second): (&str, &str),
        method: &str,
        measure: &str,
        value: f64,
    ) {
        let [question, first, second, method, measure] =
            [question, first, second, method, measure].map(str::to_owned);
        self.0.push(Answer { question, first, second, method, measure, value: Exact::millionths(value) });
    }
}

const DRAWING: Drawing = Drawing { pixels: 128, detail: Detail::Full };
/// Blur of pictures that are compared: a sixteenth of their height.
const BLUR: f64 = 128.0 / 16.0;
const SEED: u64 = 1;

const FIGURE: &str = "figure-4.8.png";
const PALM: &str = "palm.png";

impl Experiment for BlendSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Answer::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let species = species_files(self.species.get_ref());
        ([FIGURE, PALM].map(str::to_owned).to_vec(), species.collect())
    }

    /// A job for each question.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let maps = Maps::new(&self.species()?)?;
        let most = slice.take_of(usize::MAX);
        let mut job = |question: &str, make: &dyn Fn(&mut Rows) -> anyhow::Result<()>| {
            let rows = || {
                let mut rows = Rows(Vec::new());
                make(&mut rows)?;
                Ok(rows.0)
            };
            journal.job(|row: &Answer| row.question == question, rows)
        };
        job("explained variance", &|rows| {
            explained(&maps, rows);
            Ok(())
        })?;
        job("landmark", &|rows| landmarks(&maps, rows))?;
        job("palm", &|rows| broken::palm(&maps, rows))?;
        job("leave one out", &|rows| leave_one_out(&maps, most, rows))?;
        job("smoothness", &|rows| smoothness::smoothness(&maps, *self.steps as u32, most, rows))?;
        if slice.repetitions.is_none() {
            job("random points", &|rows| validity(&maps, *self.points as usize, rows))?;
        }
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let maps = Maps::new(&self.species()?)?;
        pictures::figure(&maps, outputs)?;
        pictures::with_palm(&maps, outputs)?;
        Ok(summary(&table.records()?))
    }
}

impl BlendSpec {
    fn species(&self) -> anyhow::Result<Vec<Species>> {
        self.species.get_ref().iter().map(|name| Ok(pleach_generators::species(name.get_ref())?)).collect()
    }
}

fn explained(maps: &Maps, rows: &mut Rows) {
    for (map, method) in [(&maps.declared, "map"), (&maps.raw, "raw")] {
        let mut together = 0.0;
        for (axis, share) in map.pca().explained().iter().enumerate() {
            together += share;
            rows.add("explained variance", ("", ""), method, &format!("{} axes", axis + 1), together);
        }
    }
}

fn landmarks(maps: &Maps, rows: &mut Rows) -> anyhow::Result<()> {
    for (map, method) in [(&maps.declared, "map"), (&maps.raw, "raw")] {
        for (species, dot) in maps.species().iter().zip(map.dots()) {
            let exact = map.at(*dot)?.params == species.params;
            rows.add("landmark", (&species.name, ""), method, "exact", f64::from(u8::from(exact)));
        }
    }
    Ok(())
}

/// Each species from the others at its own coordinates.
fn leave_one_out(maps: &Maps, most: usize, rows: &mut Rows) -> anyhow::Result<()> {
    let codes = maps.declared.landmarks().codes();
    let all = maps.species();
    for (i, species) in all.iter().enumerate().take(most) {
        stop::check()?;
        let others: Vec<Species> = all.iter().filter(|s| s.name != species.name).cloned().collect();
        let without = Maps::new(&others)?;
        let code =
            |s: &Species| maps.declared.landmarks().coding().encode(s.generator.as_ref(), s.params.values());
        let nearest = others
            .iter()
            .min_by(|a, b| {
                let far = |s: &Species| map::distance(&code(s).values, &codes[i].values);
                far(a).total_cmp(&far(b))
            })
            .context("there are other species")?;
        let guesses = [
            (
                "map",
                without.declared.species_at(&without.declared.at(without.declared.locate(species))?, "guess"),
            ),
            ("raw", without.raw.species_at(&without.raw.at(without.raw.locate(species))?, "guess")),
            ("nearest", nearest.clone()),
        ];
        for (method, guess) in guesses {
            let far = map::distance(&code(&guess).values, &codes[i].values);
            rows.add("leave one out", (&species.name, ""), method, "parameter distance", far);
            let unlike = unlike(species, &guess);
            rows.add("leave one out", (&species.name, ""), method, "silhouette distance", unlike);
        }
    }
    Ok(())
}

/// One less the blurred overlap in the mean over four seeds.
fn unlike(one: &Species, two: &Species) -> f64 {
    const SEEDS: u64 = 4;
    let pair = [one.clone(), two.clone()];
    let overlaps = (1..=SEEDS).map(|seed| {
        // A tree that does not grow has no overlap.
        silhouettes(&pair, seed, DRAWING).map_or(0.0, |drawn| blurred_iou(&drawn[0], &drawn[1], BLUR))
    });
    1.0 - overlaps.sum::<f64>() / SEEDS as f64
}

/// Random points of the hull: do all grow, and into something like a tree?
fn validity(maps: &Maps, points: usize, rows: &mut Rows) -> anyhow::Result<()> {
    let map = &maps.declared;
    let ranges = Ranges::new(maps.species())?;
    let points = inside(map, points);
    let bar = progress("points", points.len() as u64);
    let verdicts: Vec<(bool, bool)> = points
        .par_iter()
        .enumerate()
        .map(|(i, point)| {
            stop::check()?;
            bar.inc(1);
            let blend = map.at(*point)?;
            let valid = map.landmarks().space().check(blend.params.values().to_vec()).is_ok();
            match grow(&map.species_at(&blend, "blend"), i as u64) {
                Some(tree) => Ok((valid, ranges.contain(figures(&tree)))),
                None => Ok((false, false)),
            }
        })
        .collect::<anyhow::Result<_>>()?;
    bar.finish_and_clear();
    let count = |what: fn(&(bool, bool)) -> bool| verdicts.iter().filter(|v| what(v)).count() as f64;
    rows.add("random points", ("", ""), "map", "points", verdicts.len() as f64);
    rows.add("random points", ("", ""), "map", "grown", count(|v| v.0));
    rows.add("random points", ("", ""), "map", "not degenerate", count(|v| v.1));
    Ok(())
}

fn inside(map: &BlendMap, count: usize) -> Vec<Point> {
    let reach = map.dots().iter().fold(0.0_f64, |r, d| r.max(d.x.abs()).max(d.y.abs()));
    let key = Key::root(SEED);
    let draw = |i: u32| (2.0 * key.unit(0, i) - 1.0) * reach;
    let points = (0..).map(|i| Point { x: draw(2 * i), y: draw(2 * i + 1) });
    points.filter(|p| map.hull().contains(*p)).take(count).collect()
}

/// Sums and extremes of the table by question, method and measure.
fn summary(answers: &[Answer]) -> String {
    let mut rows =
        vec![["question", "method", "measure", "rows", "sum", "mean", "least"].map(str::to_owned).to_vec()];
    let mut seen: Vec<[String; 3]> = Vec::new();
    let key_of = |row: &'_ Answer| [row.question.clone(), row.method.clone(), row.measure.clone()];
    for row in answers.iter().filter(|row| row.question != "explained variance") {
        let key = key_of(row);
        if !seen.contains(&key) {
            seen.push(key);
        }
    }
    for key in seen {
        let of = answers.iter().filter(|row| key_of(row) == key);
        let values: Vec<f64> = of.map(|row| row.value.0).collect();
        let sum: f64 = values.iter().sum();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let numbers = [sum, sum / values.len().max(1) as f64, least].map(|v| format!("{v:.3}"));
        let head = key.into_iter().chain([values.len().to_string()]);
        rows.push(head.chain(numbers).collect());
    }
    output::table(&rows, &[3, 4, 5, 6])
}
