//! Whether a first guess names the family of generators that a goal is of.

use super::pictured::pictured;
use super::record::{self, Fixed};
use super::spec::{Seed, Source, species_files};
use super::within::{List, SpeciesName};
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use anyhow::Context;
use pleach_console::output;
use pleach_fit::{
    Candidate, FitProblem, FitSettings, GoalView, GuessLibrary, GuessSettings, RaceSettings, Runner,
};
use pleach_silhouette::View;
use pleach_silhouette::picture::sheet;
use pleach_tree::Foliage;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;
use toml::Spanned;

/// The family that a goal was taken for.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Named {
    /// Number of the goal, from 1.
    goal: usize,
    species: String,
    /// Whether its leaves were left out.
    bare: bool,
    seed: u64,
    family: String,
    /// The family that was named, and its nearest species.
    named: String,
    nearest: String,
    /// Family, likeness before the race and cost after it, of all that ran, best first.
    runners: String,
    wall_s: Fixed<1>,
}

const SHEET: &str = "goals.png";
/// Goals across the sheet.
const COLUMNS: usize = 10;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FamiliesSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Species of goals with their foliage, one goal each time that a name stands here.
    leafy: List<Spanned<SpeciesName>>,
    /// Species of goals without.
    bare: List<Spanned<SpeciesName>, 0>,
    /// Seed of the first goal; the next one has the next seed.
    first_seed: Seed,
}

impl FamiliesSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        for name in self.leafy.iter().chain(self.bare.iter()) {
            if pleach_generators::preset(name.get_ref().as_str()).is_none() {
                return Err(source.wrong(name.span(), "expected a species that comes with pleach"));
            }
        }
        Ok(self)
    }

    /// Every goal: species, and whether it is bare.
    fn goals(&self) -> Vec<(&str, bool)> {
        let leafy = self.leafy.iter().map(|name| (name.get_ref().as_str(), false));
        leafy.chain(self.bare.iter().map(|name| (name.get_ref().as_str(), true))).collect()
    }

    /// The families that goals are of: one is named among them, so that a new family changes nothing here.
    fn families(&self) -> Vec<&'static str> {
        let goals = self.goals();
        let species = goals.iter().filter_map(|(name, _)| pleach_generators::preset(name));
        species.map(|species| species.generator.family()).collect()
    }

    fn seed(&self, number: usize) -> u64 {
        *self.first_seed + number as u64
    }
}

impl Kind for FamiliesSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Named::default())
    }

    fn files(&self, _: &Path) -> (Vec<String>, Vec<PathBuf>) {
        (vec![SHEET.to_owned()], species_files(&self.leafy).chain(species_files(&self.bare)).collect())
    }

    /// One row per goal; a slice has the first few.
    fn rows(&self, _: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let goals = self.goals();
        let goals = &goals[..slice.take_of(goals.len())];
        let families = self.families();
        let candidates: Vec<Candidate> = pleach_generators::families()
            .iter()
            .filter(|family| families.contains(&family.name()))
            .flat_map(|family| pleach_generators::presets(*family))
            .map(Candidate::from)
            .collect();
        let mut library = GuessLibrary::new();
        let bar = progress("goals", goals.len() as u64);
        for (i, &(species, bare)) in goals.iter().enumerate() {
            let number = i + 1;
            journal.job(
                |row: &Named| row.goal == number,
                || Ok(vec![self.named(number, species, bare, &candidates, &mut library)?]),
            )?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, _: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Named> = table.records()?;
        let mut cells = Vec::new();
        for row in &rows {
            let right = if row.family == row.named { "" } else { "WRONG " };
            let view = goal(&row.species, row.bare, row.seed)?;
            cells.push((format!("{right}{}: {}", row.species, row.named), view.goal));
        }
        outputs.picture(SHEET, &sheet(&cells, COLUMNS))?;
        Ok(confusion(&rows))
    }
}

/// How many goals of each family were taken for each.
fn confusion(rows: &[Named]) -> String {
    let names = pleach_generators::families().iter().map(|family| family.name());
    let names: Vec<&str> = names.filter(|name| rows.iter().any(|row| row.family == *name)).collect();
    let head = ["goals of", "goals", "right"].into_iter().chain(names.iter().copied());
    let mut lines = vec![head.map(str::to_owned).collect::<Vec<_>>()];
    let line = |of: &str, rows: &[&Named]| {
        let right = rows.iter().filter(|row| row.family == row.named).count();
        let counts = names.iter().map(|name| rows.iter().filter(|row| row.named == *name).count());
        let share = format!("{:.0} %", 100.0 * right as f64 / rows.len().max(1) as f64);
        [of.to_owned(), rows.len().to_string(), share]
            .into_iter()
            .chain(counts.map(|count| count.to_string()))
            .collect::<Vec<_>>()
    };
    for name in &names {
        let of: Vec<&Named> = rows.iter().filter(|row| row.family == *name).collect();
        lines.push(line(name, &of));
    }
    lines.push(line("all", &rows.iter().collect::<Vec<_>>()));
    output::table(&lines, &(1..lines[0].len()).collect::<Vec<_>>())
}

/// The picture of a tree.
fn goal(species: &str, bare: bool, seed: u64) -> anyhow::Result<GoalView> {
    Ok(pictured(&pleach_generators::species(species)?.grow(seed)?, View::FRONT, !bare))
}

impl FamiliesSpec {
    fn named(
        &self,
        number: usize,
        species: &str,
        bare: bool,
        candidates: &[Candidate],
        library: &mut GuessLibrary,
    ) -> anyhow::Result<Named> {
        let seed = self.seed(number - 1);
        let start = candidates.first().context("species come with pleach")?.species.clone();
        let mut problem = FitProblem::new(start, goal(species, bare, seed)?);
        problem.foliage = Foliage::All;
        let how = GuessSettings {
            detect_leaves: true,
            race: Some(RaceSettings::default()),
            ..GuessSettings::default()
        };
        let started = Instant::now();
        let found = library.first_guess(
            &problem,
            &FitSettings::default(),
            candidates,
            &how,
            stop::flag(),
            |_, _| (),
        )?;
        let family = pleach_generators::species(species)?.generator.family();
        let first = found.runners.first().context("a guess has a winner")?;
        let said = |one: &Runner| format!("{} {:.3} {:.3}", one.family, one.likeness, one.reached);
        Ok(Named {
            goal: number,
            species: species.to_owned(),
            bare,
            seed,
            family: family.to_owned(),
            named: first.family.to_owned(),
            nearest: first.species.clone(),
            runners: found.runners.iter().map(said).collect::<Vec<_>>().join("; "),
            wall_s: Fixed(started.elapsed().as_secs_f64()),
        })
    }
}
