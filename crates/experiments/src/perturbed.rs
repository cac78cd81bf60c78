//! Fits of trees whose numbers no library has: with the guess that has seen many trees, and without.

use super::fresh::fresh;
use super::pictured::pictured;
use super::record::{self, Fixed};
use super::spec::{Evaluations, Source, species_files};
use super::truth::Truth;
use super::within::{List, SpeciesName, Whole};
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use anyhow::Context;
use pleach::plan::{Origin, library, plan};
use pleach_console::output;
use pleach_fit::{Budget, Control, FitProblem, FitSettings, GoalSettings, GuessLibrary};
use pleach_generators::GeneratorChoice;
use pleach_silhouette::View;
use pleach_tree::Species;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;
use toml::Spanned;

/// A fit of one goal.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Found {
    species: String,
    goal: u32,
    /// Whether the search may start from numbers that are predicted from the goal.
    predicts: bool,
    evaluations: u64,
    /// The species that the first guess names.
    looks_like: String,
    /// Mean likeness of other trees of the goal's own numbers.
    ceiling: Fixed<4>,
    likeness: Fixed<4>,
    iou: Fixed<4>,
    /// Mean likeness of other trees of the numbers that were found.
    fresh: Fixed<4>,
    wall_s: Fixed<1>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PerturbedSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Species by name.
    species: List<Spanned<SpeciesName>>,
    /// Goals around each.
    goals: Whole<1, 1000>,
    /// Trees of each search.
    evaluations: List<Evaluations>,
}

/// A tree around a species, drawn as a goal.
struct Perturbed {
    problem: FitProblem,
    truth: Truth,
}

impl Perturbed {
    fn new(species: &Species, number: u32) -> anyhow::Result<Self> {
        let (truth, tree) = Truth::new(species, number)?;
        let problem = FitProblem::new(species.clone(), pictured(&tree, View::FRONT, true));
        Ok(Self { problem, truth })
    }

    /// Mean likeness of trees of `species` of other seeds.
    fn fresh(&self, species: &Species) -> anyhow::Result<f64> {
        fresh(&self.problem, species, self.truth.seed)
    }

    fn fit(&self, library: &mut GuessLibrary, evaluations: u64) -> anyhow::Result<Found> {
        let search = FitSettings { budget: Budget::evaluations(evaluations), ..FitSettings::default() };
        let (origin, start) = (Origin::Guess { detect_leaves: true }, &self.problem.start);
        let settings = plan(origin, GeneratorChoice::default(), start, search)?;
        let settings = GoalSettings { assessment: None, ..settings };
        let started = Instant::now();
        let clock = || started.elapsed();
        let control = Control::new(&clock, stop::flag());
        let fitted = pleach_fit::fit_goal_with(&self.problem, &settings, library, control)?;
        let wall_s = started.elapsed().as_secs_f64();
        let name = fitted.guess.as_ref().and_then(|guess| guess.names.first());
        Ok(Found {
            evaluations,
            looks_like: name.map_or_else(String::new, |(name, _)| name.clone()),
            likeness: Fixed(fitted.best.score.likeness.unwrap_or_default()),
            iou: Fixed(fitted.best.score.iou),
            fresh: Fixed(self.fresh(&Species { foliage: fitted.problem.foliage, ..fitted.species()? })?),
            wall_s: Fixed(wall_s),
            ..Found::default()
        })
    }
}

impl PerturbedSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.all_differ(&self.species, |name| name.to_string(), "")?;
        Ok(self)
    }
}

impl Kind for PerturbedSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Found::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (Vec::new(), species_files(&self.species).collect())
    }

    /// A row for each fit, goal by goal; a slice has the first few species.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let species = &self.species[..slice.take_of(self.species.len())];
        let goals = *self.goals as u32;
        let most = slice.evaluations.unwrap_or(u64::MAX);
        let bar = progress("goals", species.len() as u64 * *self.goals);
        let drawn = library().drawings().cloned().context("drawings are built in")?;
        let mut libraries = [(false, GuessLibrary::with_drawings(drawn)), (true, library())];
        for goal in 1..=goals {
            for name in species {
                let name = name.get_ref().as_str();
                let own = pleach_generators::species(name)?;
                let perturbed = Perturbed::new(&own, goal)?;
                let mut ceiling = None;
                for evaluations in self.evaluations.iter().map(|one| (**one).min(most)) {
                    for (predicts, library) in &mut libraries {
                        let is_of = |row: &Found| {
                            (row.species.as_str(), row.goal, row.predicts, row.evaluations)
                                == (name, goal, *predicts, evaluations)
                        };
                        journal.job(is_of, || {
                            let own = match ceiling {
                                Some(known) => known,
                                None => perturbed.fresh(&perturbed.truth.species)?,
                            };
                            ceiling = Some(own);
                            let found = perturbed.fit(library, evaluations)?;
                            let species = name.to_owned();
                            let (predicts, ceiling) = (*predicts, Fixed(own));
                            Ok(vec![Found { species, goal, predicts, ceiling, ..found }])
                        })?;
                    }
                }
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, _: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Found> = table.records()?;
        let head = [
            "trees",
            "predicted start",
            "goals",
            "likeness",
            "IoU",
            "fresh",
            "of the truth's",
            "named right",
        ];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        for evaluations in &self.evaluations {
            for predicts in [false, true] {
                let is_of = |row: &&Found| row.evaluations == **evaluations && row.predicts == predicts;
                let of: Vec<&Found> = rows.iter().filter(is_of).collect();
                let mean = |value: fn(&Found) -> f64| {
                    of.iter().map(|row| value(row)).sum::<f64>() / of.len().max(1) as f64
                };
                lines.push(vec![
                    evaluations.to_string(),
                    if predicts { "yes" } else { "no" }.to_owned(),
                    of.len().to_string(),
                    format!("{:.3}", mean(|row| row.likeness.0)),
                    format!("{:.3}", mean(|row| row.iou.0)),
                    format!("{:.3}", mean(|row| row.fresh.0)),
                    format!("{:.3}", mean(|row| row.fresh.0) / mean(|row| row.ceiling.0)),
                    of.iter().filter(|row| row.looks_like == row.species).count().to_string(),
                ]);
            }
        }
        Ok(output::table(&lines, &(2..head.len()).collect::<Vec<_>>()))
    }
}
