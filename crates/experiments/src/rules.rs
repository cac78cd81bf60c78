//! Grammars evolved from nothing, goal by goal: overlap, likeness and length of the grammars found.

use super::pictured::{draw, load_view, write_species};
use super::record::{self, Fixed};
use super::spec::{GoalSpec, Repetitions, Source};
use super::within::{List, Real, Seconds};
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use anyhow::{Context, bail};
use pleach_console::{files, output};
use pleach_fit::{
    Budget, Control, FitProblem, FitSettings, GoalSettings, Guessing, RulesSettings, fit_goal, fresh_seeds,
};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, picture};
use pleach_tree::{Foliage, Limits, SpeciesDoc};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use toml::Spanned;

/// Likeness from which on a silhouette is counted as one of the goal's kind.
const ALIKE: f64 = 0.75;
/// Trees of other seeds that a grammar is judged by.
const FRESH: usize = 16;
/// Goal, found, over each other, another seed; two goals in a row.
const COLUMNS: usize = 8;
const SHEET: &str = "sheet.png";

fn species_file(goal: &str) -> String {
    format!("fits/{goal}.toml")
}

/// A grammar that was found.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Found {
    goal: String,
    repetition: u64,
    evaluations: u64,
    iou: Fixed<4>,
    best_ellipse_iou: Fixed<4>,
    likeness: Fixed<4>,
    /// Of trees of other seeds, the mean.
    fresh_iou: Option<Fixed<4>>,
    fresh_likeness: Option<Fixed<4>>,
    /// Words and signs of the grammar.
    length: usize,
    wall_s: Fixed<1>,
}

impl Found {
    fn is_above_ellipse(&self) -> bool {
        self.iou.0 > self.best_ellipse_iou.0
    }

    fn is_alike(&self) -> bool {
        self.likeness.0 >= ALIKE
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RulesSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// The goals.
    goals: List<Spanned<GoalSpec>>,
    /// Seconds of a search.
    seconds: Real<Seconds>,
    /// Searches for each goal, seeded 1, 2, ….
    repetitions: Repetitions,
}

impl RulesSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.are_names_of_files(&self.goals, GoalSpec::name)?;
        Ok(self)
    }

    fn goals(&self) -> impl Iterator<Item = &GoalSpec> {
        self.goals.iter().map(Spanned::get_ref)
    }
}

impl Kind for RulesSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Found::default())
    }

    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let written = self.goals().map(|goal| species_file(&goal.name())).chain([SHEET.to_owned()]);
        (written.collect(), self.goals().map(|goal| folder.join(&goal.file)).collect())
    }

    fn rows(&self, folder: &Path, _: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        if !journal.is_kept() {
            bail!("searches that end by the clock find something else on every machine: nothing to check");
        }
        let bar = progress("searches", self.goals.len() as u64 * *self.repetitions);
        for goal in self.goals() {
            let name = goal.name();
            for repetition in 1..=*self.repetitions {
                let is_of = |row: &Found| (&row.goal, row.repetition) == (&name, repetition);
                let make = || {
                    let found = self.search(folder, goal, repetition);
                    Ok(vec![found.with_context(|| format!("{name}, repetition {repetition}"))?])
                };
                journal.job(is_of, make)?;
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, folder: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        self.sheet(folder, outputs)?;
        let found: Vec<Found> = table.records()?;
        let head = ["goal", "IoU", "best ellipse", "likeness", "fresh likeness", "words", "trees", "both"];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        for row in &found {
            let both = row.is_above_ellipse() && row.is_alike();
            lines.push(vec![
                row.goal.clone(),
                row.iou.to_string(),
                row.best_ellipse_iou.to_string(),
                row.likeness.to_string(),
                row.fresh_likeness.map_or_else(String::new, |fresh| fresh.to_string()),
                row.length.to_string(),
                row.evaluations.to_string(),
                if both { "yes" } else { "" }.to_owned(),
            ]);
        }
        let count = |is: &dyn Fn(&Found) -> bool| found.iter().filter(|row| is(row)).count();
        Ok(format!(
            "{}\n\nof {} searches {} are above the best ellipse, {} have a likeness of {ALIKE}, {} both",
            output::table(&lines, &[1, 2, 3, 4, 5, 6]),
            found.len(),
            count(&Found::is_above_ellipse),
            count(&Found::is_alike),
            count(&|row| row.is_above_ellipse() && row.is_alike()),
        ))
    }
}

impl RulesSpec {
    /// One search; of the first repetition the grammar is kept as well.
    fn search(&self, folder: &Path, goal: &GoalSpec, seed: u64) -> anyhow::Result<Found> {
        let problem = problem(folder, goal)?;
        let search = FitSettings {
            budget: Budget {
                timeout: Some(Duration::try_from_secs_f64(*self.seconds)?),
                ..Budget::default()
            },
            seed,
            objective: RulesSettings::OBJECTIVE,
            rules: Some(RulesSettings::default()),
            ..FitSettings::default()
        };
        let settings =
            GoalSettings { search, guess: Guessing::Off, assessment: None, ..GoalSettings::new(Vec::new()) };
        let started = Instant::now();
        let clock = || started.elapsed();
        let fitted = fit_goal(&problem, &settings, Control::new(&clock, stop::flag()))?;
        let seconds = clock().as_secs_f64();
        let species = fitted.species()?;
        let tree_seed = fitted.best.genome.tree_seed;
        let view = &fitted.problem.goals[0];
        let card = ScoreCard::new(&draw(&species, tree_seed, Foliage::All, view)?, &view.goal)?;
        let (objective, genome) = (fitted.settings.objective, &fitted.best.genome);
        let fresh =
            fresh_seeds(&fitted.problem, objective, Limits::default(), genome, FRESH, stop::flag().into())?;
        if seed == 1 && !stop::is_raised() {
            files::make_folder(&folder.join("fits"))?;
            let name = goal.name();
            let path = folder.join(species_file(&name));
            write_species(&path, &name, &species)?;
        }
        let variation = species.generator.variation().context("a searched grammar can be searched")?;
        Ok(Found {
            goal: goal.name(),
            repetition: seed,
            evaluations: fitted.outcome.evaluations,
            iou: Fixed(card.iou),
            best_ellipse_iou: Fixed(card.best_ellipse_iou),
            likeness: Fixed(card.likeness),
            fresh_iou: fresh.as_ref().map(|fresh| Fixed(fresh.iou.mean)),
            fresh_likeness: fresh.as_ref().map(|fresh| Fixed(fresh.likeness.mean)),
            length: variation.length(&variation.own()),
            wall_s: Fixed(seconds),
        })
    }

    /// Every goal with what was found for it.
    fn sheet(&self, folder: &Path, outputs: &Outputs) -> anyhow::Result<()> {
        let mut cells = Vec::new();
        for goal in self.goals() {
            let name = goal.name();
            let problem = problem(folder, goal)?;
            let view = &problem.goals[0];
            let path = folder.join(species_file(&name));
            let species = pleach_generators::species(&path.to_string_lossy())?;
            let seed = species.tree_seed.with_context(|| format!("{} has no seed", path.display()))?;
            let found = draw(&species, seed, Foliage::All, view)?;
            let (width, height) = (found.width(), found.height());
            let differs = Bitmap::from_fn(width, height, |x, y| found.get(x, y) != view.goal.get(x, y));
            let small = |bitmap: &Bitmap| bitmap.downscaled(0.5);
            cells.push((name, small(&view.goal)));
            cells.push(("found".to_owned(), small(&found)));
            cells.push(("difference".to_owned(), small(&differs)));
            cells.push(("another seed".to_owned(), small(&draw(&species, seed + 1, Foliage::All, view)?)));
        }
        outputs.picture(SHEET, &picture::sheet(&cells, COLUMNS))
    }
}

/// The goal, and a family's species without rules to begin with.
fn problem(folder: &Path, goal: &GoalSpec) -> anyhow::Result<FitProblem> {
    let varied = || pleach_generators::families().iter().find_map(|f| Some((*f, f.blank()?)));
    let (family, blank) = varied().context("a family has rules")?;
    let start = SpeciesDoc::parse("blank", blank)?.species(family)?;
    Ok(FitProblem::new(start, load_view(folder, &goal.file, *goal.height)?))
}
