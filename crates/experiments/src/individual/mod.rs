//! This very tree: how a goal's own tree lies on the picture, and whether it is still one of its kind.

mod goals;
mod natural;

use super::pictured::{draw, write_species};
use super::record::{self, Fixed};
use super::spec::Source;
use super::within::{List, Real, Seconds};
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use anyhow::{Context, bail};
use goals::IndividualGoal;
use natural::Natural;
use pleach_console::{files, output};
use pleach_fit::{
    Budget, Candidate, Control, FitSettings, Fitted, GoalSettings, GoalView, GuessLibrary,
    IndividualSettings, fit_goal_with, fresh_seeds,
};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, View, picture};
use pleach_tree::{Limits, Species};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use toml::Spanned;

/// Trees of other seeds that the kind is judged by.
const FRESH: usize = 16;
/// Goal, kind, individual, the individual from its side; two goals in a row.
const COLUMNS: usize = 8;
const SHEET: &str = "sheet.png";
/// The direction of a second picture, and of one that is held out, in degrees.
const SIDE: f64 = 90.0;
const HELD_OUT: f64 = 45.0;

fn species_file(goal: &str) -> String {
    format!("fits/{goal}.toml")
}

/// A goal's own tree, beside the tree of the kind that it began as.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Row {
    goal: String,
    group: String,
    best_ellipse_iou: Fixed<4>,
    kind_iou: Fixed<4>,
    kind_likeness: Fixed<4>,
    kind_boundary_f: Fixed<4>,
    /// Of trees of other seeds, the mean.
    fresh_likeness: Option<Fixed<4>>,
    iou: Fixed<4>,
    likeness: Fixed<4>,
    boundary_f: Fixed<4>,
    /// The same in the second picture, and in one that was held out, of the individual and of the kind.
    side_iou: Option<Fixed<4>>,
    side_likeness: Option<Fixed<4>>,
    held_out_likeness: Option<Fixed<4>>,
    kind_held_out_likeness: Option<Fixed<4>>,
    /// Likeness of the view from the side to side views of other trees of the kind, and of those to each other.
    turned_likeness: Fixed<4>,
    free_likeness: Fixed<4>,
    /// Distances of the distributions (Kolmogorov–Smirnov) of first branches to those of free trees, and the
    /// least of their probabilities if both were drawn alike.
    ks_azimuth: Fixed<3>,
    ks_pitch: Fixed<3>,
    ks_length: Fixed<3>,
    ks_curvature: Fixed<3>,
    least_p: Fixed<4>,
    stems: usize,
    wall_trials: u64,
    wall_trials_per_second: Fixed<0>,
    wall_s: Fixed<1>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IndividualSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Seconds of a whole fit but for judging, a third of them for the individual.
    seconds: Real<Seconds>,
    goals: List<Spanned<IndividualGoal>>,
}

impl IndividualSpec {
    pub(super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.are_names_of_files(&self.goals, IndividualGoal::name)?;
        for goal in self.goals.iter() {
            if let Err(message) = goal.get_ref().check() {
                return Err(source.wrong(goal.span(), message));
            }
        }
        Ok(self)
    }

    fn goals(&self) -> impl Iterator<Item = &IndividualGoal> {
        self.goals.iter().map(Spanned::get_ref)
    }
}

impl Kind for IndividualSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Row::default())
    }

    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let written = self.goals().map(|goal| species_file(&goal.name())).chain([SHEET.to_owned()]);
        (written.collect(), self.goals().filter_map(|goal| Some(folder.join(goal.file.as_ref()?))).collect())
    }

    fn rows(&self, folder: &Path, _: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        if !journal.is_kept() {
            bail!("fits that end by the clock find something else on every machine: nothing to check");
        }
        let bar = progress("fits", self.goals.len() as u64);
        let candidates: Vec<Candidate> = pleach_generators::presets(pleach_generators::default_family())
            .into_iter()
            .map(Candidate::from)
            .collect();
        let mut library = GuessLibrary::new();
        for goal in self.goals() {
            let name = goal.name();
            let make = || {
                let row = self.fit(folder, goal, &candidates, &mut library);
                Ok(vec![row.with_context(|| name.clone())?])
            };
            journal.job(|row: &Row| row.goal == name, make)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, folder: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        self.sheet(folder, outputs)?;
        let rows: Vec<Row> = table.records()?;
        Ok(report(&rows))
    }
}

fn report(rows: &[Row]) -> String {
    let head = ["goals", "", "IoU", "above ellipse", "likeness", "boundary F", "kind IoU", "kind likeness"];
    let mut lines = vec![head.map(str::to_owned).to_vec()];
    let mut groups: Vec<&str> = rows.iter().map(|row| row.group.as_str()).collect();
    groups.dedup();
    for group in groups {
        let of = || rows.iter().filter(|row| row.group == group);
        let median = |value: &dyn Fn(&Row) -> f64| {
            let mut values: Vec<f64> = of().map(value).collect();
            values.sort_by(f64::total_cmp);
            let (low, high) = (values[(values.len() - 1) / 2], values[values.len() / 2]);
            format!("{:.3}", f64::midpoint(low, high))
        };
        let above = of().filter(|row| row.iou.0 > row.best_ellipse_iou.0).count();
        lines.push(vec![
            group.to_owned(),
            of().count().to_string(),
            median(&|row| row.iou.0),
            format!("{above}, by {}", median(&|row| row.iou.0 - row.best_ellipse_iou.0)),
            median(&|row| row.likeness.0),
            median(&|row| row.boundary_f.0),
            median(&|row| row.kind_iou.0),
            median(&|row| row.kind_likeness.0),
        ]);
    }
    let odd = rows.iter().filter(|row| row.least_p.0 < 0.01).count();
    let mean = |value: &dyn Fn(&Row) -> f64| rows.iter().map(value).sum::<f64>() / rows.len() as f64;
    format!(
        "medians of each group\n{}\n\nfrom the side they have a likeness of {:.3} to other trees of the kind, which have {:.3} \
         to each other (means); the draws of {odd} of {} are told from the species' own at one in a hundred",
        output::table(&lines, &[1, 2, 4, 5, 6, 7]),
        mean(&|row| row.turned_likeness.0),
        mean(&|row| row.free_likeness.0),
        rows.len(),
    )
}

impl IndividualSpec {
    fn fit(
        &self,
        folder: &Path,
        goal: &IndividualGoal,
        candidates: &[Candidate],
        library: &mut GuessLibrary,
    ) -> anyhow::Result<Row> {
        let problem = goal.problem(folder)?;
        let whole = Duration::try_from_secs_f64(*self.seconds)?;
        let budget = Budget { timeout: Some(whole * 2 / 3), ..Budget::default() };
        let settings = GoalSettings {
            search: FitSettings { budget, ..FitSettings::default() },
            validates: false,
            assessment: None,
            individual: Some(IndividualSettings::time(whole / 3)),
            ..GoalSettings::new(candidates.to_vec())
        };
        let started = Instant::now();
        let clock = || started.elapsed();
        let fitted = fit_goal_with(&problem, &settings, library, Control::new(&clock, stop::flag()))?;
        let seconds = clock().as_secs_f64();
        let Fitted { best, individuals, problem, .. } = &fitted;
        let found = individuals.first().context("a generator whose stems have addresses was fitted")?;
        let (kind, seed, foliage) = (fitted.species()?, best.genome.tree_seed, problem.foliage);
        let card = |species: &Species, view: &GoalView| {
            ScoreCard::new(&draw(species, seed, foliage, view)?, &view.goal).map_err(anyhow::Error::from)
        };
        let front = &problem.goals[0];
        let (before, after) = (card(&kind, front)?, card(&found.species, front)?);
        let side = problem.goals.get(1).map(|view| card(&found.species, view)).transpose()?;
        let held_out = goal.held_out(HELD_OUT)?;
        let held_out_likeness = |species: &Species| -> anyhow::Result<Option<Fixed<4>>> {
            Ok(held_out
                .as_ref()
                .map(|view| card(species, view))
                .transpose()?
                .map(|card| Fixed(card.likeness)))
        };
        let objective = fitted.settings.objective;
        let fresh =
            fresh_seeds(problem, objective, Limits::default(), &best.genome, FRESH, stop::flag().into())?;
        let natural = Natural::new(&found.species, front, foliage)?;
        if !stop::is_raised() {
            files::make_folder(&folder.join("fits"))?;
            let name = goal.name();
            write_species(&folder.join(species_file(&name)), &name, &found.species)?;
        }
        let [azimuth, pitch, length, curvature] = natural.distances;
        Ok(Row {
            goal: goal.name(),
            group: goal.group().to_owned(),
            best_ellipse_iou: Fixed(after.best_ellipse_iou),
            kind_iou: Fixed(before.iou),
            kind_likeness: Fixed(before.likeness),
            kind_boundary_f: Fixed(before.boundary_f),
            fresh_likeness: fresh.map(|fresh| Fixed(fresh.likeness.mean)),
            iou: Fixed(after.iou),
            likeness: Fixed(after.likeness),
            boundary_f: Fixed(after.boundary_f),
            side_iou: side.as_ref().map(|side| Fixed(side.iou)),
            side_likeness: side.as_ref().map(|side| Fixed(side.likeness)),
            held_out_likeness: held_out_likeness(&found.species)?,
            kind_held_out_likeness: held_out_likeness(&kind)?,
            turned_likeness: Fixed(natural.turned_likeness),
            free_likeness: Fixed(natural.free_likeness),
            ks_azimuth: Fixed(azimuth),
            ks_pitch: Fixed(pitch),
            ks_length: Fixed(length),
            ks_curvature: Fixed(curvature),
            least_p: Fixed(natural.least_p),
            stems: found.individual().len(),
            wall_trials: found.trials,
            wall_trials_per_second: Fixed(found.trials as f64 / found.elapsed.as_secs_f64().max(1e-9)),
            wall_s: Fixed(seconds),
        })
    }

    /// Every goal with its kind and its own tree, from the front and from the side.
    fn sheet(&self, folder: &Path, outputs: &Outputs) -> anyhow::Result<()> {
        let mut cells = Vec::new();
        for goal in self.goals() {
            let name = goal.name();
            let problem = goal.problem(folder)?;
            let (view, foliage) = (&problem.goals[0], problem.foliage);
            let path = folder.join(species_file(&name));
            let species = pleach_generators::species(&path.to_string_lossy())?;
            let seed = species.tree_seed.with_context(|| format!("{} has no seed", path.display()))?;
            let side = GoalView { view: View::degrees(SIDE, 0.0), ..view.clone() };
            let small = |bitmap: &Bitmap| bitmap.downscaled(0.5);
            cells.push((name, small(&view.goal)));
            cells.push(("kind".to_owned(), small(&draw(&species.kind(), seed, foliage, view)?)));
            cells.push(("individual".to_owned(), small(&draw(&species, seed, foliage, view)?)));
            cells.push(("its side".to_owned(), small(&draw(&species, seed, foliage, &side)?)));
        }
        outputs.picture(SHEET, &picture::sheet(&cells, COLUMNS))
    }
}
