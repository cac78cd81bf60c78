//! Optimisers against each other on goals.

use super::plot::{Plot, Scale};
use super::spec::{FitsSpec, GoalSpec};
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use crate::output;
use anyhow::Context;
use pleach_fit::{
    Budget, Control, FitProblem, FitSettings, Genome, GoalView, Objective, Optimizer, Outcome, Start,
    TreeSeed,
};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::picture;
use pleach_silhouette::{Bitmap, Rasterizer, View};
use std::path::{Path, PathBuf};
use std::time::Instant;

const COLUMNS: [&str; 10] = [
    "goal",
    "optimizer",
    "repetition",
    "evaluations",
    "generation",
    "cost",
    "accuracy",
    "iou",
    "empty_accuracy",
    "wall_s",
];

/// Evaluations at which a row is written: 1, 2, 5, 10, 20, 50, ….
fn milestones(most: u64) -> Vec<u64> {
    let mut list: Vec<u64> =
        (0..=12).flat_map(|d| [1, 2, 5].map(|m| m * 10_u64.pow(d))).filter(|m| *m < most).collect();
    list.push(most);
    list
}

/// Plots of a goal: the column that is shown, and what it is called in the picture and in its file.
const PLOTS: [(usize, &str, &str); 2] =
    [(6, "pixel accuracy", "accuracy"), (7, "intersection over union", "iou")];

fn plot_file(goal: &str, kind: &str) -> String {
    format!("fits/{goal}-{kind}.svg")
}

fn sheet_file(goal: &str) -> String {
    format!("fits/{goal}.png")
}

impl Kind for FitsSpec {
    fn columns(&self) -> Vec<&'static str> {
        COLUMNS.to_vec()
    }

    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let of = |name: String| {
            let plots = PLOTS.map(|(_, _, kind)| plot_file(&name, kind));
            plots.into_iter().chain([sheet_file(&name)])
        };
        let goals = || self.goals.iter().map(|goal| goal.get_ref());
        (
            goals().map(GoalSpec::name).flat_map(of).collect(),
            goals().map(|goal| folder.join(&goal.file)).collect(),
        )
    }

    /// Runs every search and writes down its milestones.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        let repetitions = slice.repetitions.unwrap_or(u64::MAX).min(*self.repetitions);
        let evaluations = slice.evaluations.unwrap_or(u64::MAX).min(*self.evaluations);
        let searches = self.goals.len() as u64 * self.optimizers.len() as u64 * repetitions;
        let bar = progress("searches", searches);
        for goal in &self.goals {
            let goal = goal.get_ref();
            let name = goal.name();
            let problem = problem(folder, goal)?;
            let empty = 1.0 - problem.goals[0].goal.ink() as f64 / problem.goals[0].goal.area() as f64;
            for optimizer in &self.optimizers {
                let optimizer = optimizer.get_ref();
                for repetition in 1..=repetitions {
                    let key = [name.clone(), optimizer.text.clone(), repetition.to_string()];
                    journal.job(
                        |row| row[..3] == key,
                        || {
                            let outcome = search(&problem, self, &optimizer.value, repetition, evaluations)?;
                            Ok(self.milestones(&outcome, &key, evaluations, empty))
                        },
                    )?;
                    bar.inc(1);
                }
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, folder: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let mut rows = vec![
            ["goal", "optimizer", "accuracy", "worst", "IoU", "worst", "seconds"].map(str::to_owned).to_vec(),
        ];
        for goal in &self.goals {
            let goal = goal.get_ref();
            let name = goal.name();
            self.plot(outputs, table, &name)?;
            self.pictures(folder, outputs, goal, table)?;
            for optimizer in &self.optimizers {
                let optimizer = &optimizer.get_ref().text;
                let ends = self.ends(table, &name, optimizer);
                let sorted = |column: usize| -> Vec<f64> {
                    let mut values: Vec<f64> =
                        ends.iter().filter_map(|(_, row)| row[column].parse().ok()).collect();
                    values.sort_by(f64::total_cmp);
                    values
                };
                let (accuracy, iou, seconds) = (sorted(6), sorted(7), sorted(9));
                // Searches that are over before their first generation have no rows.
                let cell = |value: Option<f64>, digits: usize| {
                    value.map_or_else(String::new, |value| format!("{value:.digits$}"))
                };
                let middle = |v: &[f64]| v.get(v.len() / 2).copied();
                let mean = seconds.iter().sum::<f64>() / seconds.len() as f64;
                rows.push(vec![
                    name.clone(),
                    optimizer.clone(),
                    cell(middle(&accuracy), 4),
                    cell(accuracy.first().copied(), 4),
                    cell(middle(&iou), 4),
                    cell(iou.first().copied(), 4),
                    cell(seconds.first().map(|_| mean), 0),
                ]);
            }
        }
        Ok(format!(
            "medians of {} repetitions of {} evaluations\n\n{}",
            *self.repetitions,
            *self.evaluations,
            output::table(&rows, &[2, 3, 4, 5, 6])
        ))
    }
}

impl FitsSpec {
    /// The rows of a search.
    fn milestones(
        &self,
        outcome: &Outcome,
        key: &[String; 3],
        evaluations: u64,
        empty: f64,
    ) -> Vec<Vec<String>> {
        let mut rows = Vec::new();
        for milestone in milestones(*self.evaluations) {
            // A row is a whole generation, the last one within the milestone.
            let row = outcome.history.iter().rfind(|row| row.evaluations <= milestone);
            let Some(row) = row.filter(|_| milestone <= evaluations) else { continue };
            let numbers = [
                row.evaluations.to_string(),
                row.generation.to_string(),
                row.best_cost.to_string(),
                row.accuracy.to_string(),
                row.iou.to_string(),
                empty.to_string(),
                format!("{:.2}", row.elapsed_s),
            ];
            rows.push(key.iter().cloned().chain(numbers).collect());
        }
        rows.dedup();
        rows
    }

    /// Where each search of an optimiser ended, with its repetition.
    fn ends<'a>(&self, table: &'a Table, goal: &str, optimizer: &str) -> Vec<(u64, &'a Vec<String>)> {
        let end = |repetition: u64| {
            let is_of = |row: &&Vec<String>| row[..3] == [goal, optimizer, &repetition.to_string()];
            Some((repetition, table.rows.iter().rfind(is_of)?))
        };
        (1..=*self.repetitions).filter_map(end).collect()
    }
}

fn problem(folder: &Path, goal: &GoalSpec) -> anyhow::Result<FitProblem> {
    let picture = Goal::load(folder.join(&goal.file), &GoalOptions::default())?;
    let height = *goal.height;
    let start = pleach_generators::preset("quaking_aspen").context("the default species is built in")?;
    let frame = picture.frame(height);
    Ok(FitProblem::new(start, GoalView::new(picture.bitmap, View::FRONT, frame)))
}

fn search(
    problem: &FitProblem,
    spec: &FitsSpec,
    optimizer: &Optimizer,
    seed: u64,
    evaluations: u64,
) -> anyhow::Result<Outcome> {
    let settings = FitSettings {
        optimizer: optimizer.clone(),
        budget: Budget::evaluations(evaluations),
        seed,
        tree_seed: TreeSeed::Fixed(*spec.tree_seed),
        objective: spec.objective.as_ref().map_or_else(Objective::default, |word| word.value),
        start: Start::Random,
        ..FitSettings::default()
    };
    let started = Instant::now();
    let clock = || started.elapsed();
    Ok(pleach_fit::fit(problem, &settings, Control::new(&clock, stop::flag()))?)
}

impl FitsSpec {
    /// Accuracy and IoU over evaluations, a line for each repetition.
    fn plot(&self, outputs: &Outputs, table: &Table, goal: &str) -> anyhow::Result<()> {
        for (column, label, kind) in PLOTS {
            let mut plot = Plot::new("evaluations", label, Scale::Log, Scale::Linear);
            for optimizer in &self.optimizers {
                let optimizer = &optimizer.get_ref().text;
                for repetition in 1..=*self.repetitions {
                    let of =
                        table.rows.iter().filter(|r| r[..3] == [goal, optimizer, &repetition.to_string()]);
                    let points: Vec<(f64, f64)> =
                        of.filter_map(|r| Some((r[3].parse().ok()?, r[column].parse().ok()?))).collect();
                    plot.line(&format!("{optimizer} {repetition}"), &points, *optimizer == "hewitt");
                }
            }
            outputs.text(&plot_file(goal, kind), &plot.svg())?;
        }
        Ok(())
    }

    /// Goal, start and the median search of each optimiser side by side. The median is searched once
    /// more: rows have no trees, and a search is the same each time.
    fn pictures(
        &self,
        folder: &Path,
        outputs: &Outputs,
        goal: &GoalSpec,
        table: &Table,
    ) -> anyhow::Result<()> {
        let name = goal.name();
        let problem = problem(folder, goal)?;
        let GoalView { goal: target, view, frame, .. } = &problem.goals[0];
        let draw = |genome: &Genome| -> anyhow::Result<Bitmap> {
            let tree = problem.species(genome)?.grow(genome.tree_seed)?;
            let mut bitmap = Bitmap::default();
            Rasterizer::new().draw(&tree, view, frame, true, &mut bitmap);
            Ok(bitmap)
        };
        let mut sheet = vec![("goal".to_owned(), target.clone())];
        let start = search(&problem, self, &"random".parse()?, 1, 1)?;
        if let Some(best) = start.best {
            sheet.push(("start".to_owned(), draw(&best.genome)?));
        }
        for optimizer in &self.optimizers {
            let optimizer = optimizer.get_ref();
            let mut ends = self.ends(table, &name, &optimizer.text);
            let cost = |row: &[String]| row[5].parse::<f64>().unwrap_or(f64::INFINITY);
            ends.sort_by(|a, b| cost(a.1).total_cmp(&cost(b.1)));
            let Some((repetition, _)) = ends.get(ends.len() / 2) else { continue };
            let median = search(&problem, self, &optimizer.value, *repetition, *self.evaluations)?;
            stop::check()?;
            if let Some(best) = median.best {
                let score = best.score;
                let label =
                    format!("{}: IoU {:.3}, {:.1} %", optimizer.text, score.iou, 100.0 * score.accuracy);
                sheet.push((label, draw(&best.genome)?));
            }
        }
        let columns = sheet.len();
        outputs.picture(&sheet_file(&name), &picture::sheet(&sheet, columns))
    }
}
