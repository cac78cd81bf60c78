//! Optimisers against each other on goals.

use super::plot::{Plot, Scale};
use super::record::{self, Exact, Fixed};
use super::spec::{FitsSpec, GoalSpec};
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use anyhow::Context;
use pleach_console::output;
use pleach_fit::{
    Budget, Control, FitProblem, FitSettings, GoalView, Objective, Optimizer, Outcome, Start, TreeSeed,
    Unknown,
};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::picture;
use pleach_silhouette::{Bitmap, Rasterizer, View};
use pleach_tree::{Growth, Parts};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A search at a milestone.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Reached {
    goal: String,
    optimizer: String,
    repetition: u64,
    evaluations: u64,
    generation: u64,
    cost: Exact,
    accuracy: Exact,
    iou: Exact,
    empty_accuracy: Exact,
    wall_s: Fixed<2>,
}

impl Reached {
    fn is_of(&self, goal: &str, optimizer: &str, repetition: u64) -> bool {
        (self.goal.as_str(), self.optimizer.as_str(), self.repetition) == (goal, optimizer, repetition)
    }
}

/// Evaluations at which a row is written: 1, 2, 5, 10, 20, 50, ….
fn milestones(most: u64) -> Vec<u64> {
    let mut list: Vec<u64> =
        (0..=12).flat_map(|d| [1, 2, 5].map(|m| m * 10_u64.pow(d))).filter(|m| *m < most).collect();
    list.push(most);
    list
}

/// Plots of a goal: the column that is shown, and what it is called in the picture and in its file.
const PLOTS: [(fn(&Reached) -> f64, &str, &str); 2] = [
    (|row| row.accuracy.0, "pixel accuracy", "accuracy"),
    (|row| row.iou.0, "intersection over union", "iou"),
];

fn plot_file(goal: &str, kind: &str) -> String {
    format!("fits/{goal}-{kind}.svg")
}

fn sheet_file(goal: &str) -> String {
    format!("fits/{goal}.png")
}

impl Kind for FitsSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Reached::default())
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
                    let key = Reached {
                        goal: name.clone(),
                        optimizer: optimizer.text.clone(),
                        repetition,
                        empty_accuracy: Exact(empty),
                        ..Reached::default()
                    };
                    journal.job(
                        |row: &Reached| row.is_of(&name, &optimizer.text, repetition),
                        || {
                            let outcome = search(&problem, self, &optimizer.value, repetition, evaluations)?;
                            Ok(self.milestones(&outcome, &key, evaluations))
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
        let reached: Vec<Reached> = table.records()?;
        for goal in &self.goals {
            let goal = goal.get_ref();
            let name = goal.name();
            self.plot(outputs, &reached, &name)?;
            self.pictures(folder, outputs, goal, &reached)?;
            for optimizer in &self.optimizers {
                let optimizer = &optimizer.get_ref().text;
                let ends = self.ends(&reached, &name, optimizer);
                let sorted = |column: fn(&Reached) -> f64| -> Vec<f64> {
                    let mut values: Vec<f64> = ends.iter().map(|row| column(row)).collect();
                    values.sort_by(f64::total_cmp);
                    values
                };
                let accuracy = sorted(|row| row.accuracy.0);
                let iou = sorted(|row| row.iou.0);
                let seconds = sorted(|row| row.wall_s.0);
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
    /// The rows of a search; what they have in common is in `key`.
    fn milestones(&self, outcome: &Outcome, key: &Reached, evaluations: u64) -> Vec<Reached> {
        let mut rows = Vec::new();
        for milestone in milestones(*self.evaluations) {
            // A row is a whole generation, the last one within the milestone.
            let row = outcome.history.iter().rfind(|row| row.evaluations <= milestone);
            let Some(row) = row.filter(|_| milestone <= evaluations) else { continue };
            rows.push(Reached {
                evaluations: row.evaluations,
                generation: row.generation,
                cost: Exact(row.best_cost),
                accuracy: Exact(row.accuracy),
                iou: Exact(row.iou),
                wall_s: Fixed(row.elapsed_s),
                ..key.clone()
            });
        }
        rows.dedup_by_key(|row| row.generation);
        rows
    }

    /// Where each search of an optimiser ended.
    fn ends<'a>(&self, rows: &'a [Reached], goal: &str, optimizer: &str) -> Vec<&'a Reached> {
        let end = |repetition: u64| rows.iter().rfind(|row| row.is_of(goal, optimizer, repetition));
        (1..=*self.repetitions).filter_map(end).collect()
    }
}

fn problem(folder: &Path, goal: &GoalSpec) -> anyhow::Result<FitProblem> {
    let picture = Goal::load(folder.join(&goal.file), &GoalOptions::default())?;
    let height = *goal.height;
    let base = pleach_generators::preset("quaking_aspen").context("the default species is built in")?;
    Ok(FitProblem {
        base: base.params.values().to_vec(),
        generator: base.generator,
        goals: vec![GoalView {
            frame: picture.frame(height),
            goal: picture.bitmap,
            view: View::FRONT,
            unknown: Unknown::default(),
        }],
        foliage: true,
    })
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
    fn plot(&self, outputs: &Outputs, rows: &[Reached], goal: &str) -> anyhow::Result<()> {
        for (column, label, kind) in PLOTS {
            let mut plot = Plot::new("evaluations", label, Scale::Log, Scale::Linear);
            for optimizer in &self.optimizers {
                let optimizer = &optimizer.get_ref().text;
                for repetition in 1..=*self.repetitions {
                    let of = rows.iter().filter(|row| row.is_of(goal, optimizer, repetition));
                    let points: Vec<(f64, f64)> =
                        of.map(|row| (row.evaluations as f64, column(row))).collect();
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
        rows: &[Reached],
    ) -> anyhow::Result<()> {
        let name = goal.name();
        let problem = problem(folder, goal)?;
        let GoalView { goal: target, view, frame, .. } = &problem.goals[0];
        let draw = |values: &[f64], seed: u64| -> anyhow::Result<Bitmap> {
            let params = problem.generator.space().check(values.to_vec())?;
            let mut tree = pleach_tree::Tree::default();
            problem.generator.grow(
                &params,
                &Growth::seed(seed),
                &mut pleach_tree::Workspace::default(),
                &mut tree,
            )?;
            let mut bitmap = Bitmap::default();
            Rasterizer::new().draw(&tree, view, frame, Parts::LEAFY, &mut bitmap);
            Ok(bitmap)
        };
        let mut sheet = vec![("goal".to_owned(), target.clone())];
        let start = search(&problem, self, &"random".parse()?, 1, 1)?;
        if let Some(best) = start.best {
            sheet.push(("start".to_owned(), draw(&best.genome.values, best.genome.tree_seed)?));
        }
        for optimizer in &self.optimizers {
            let optimizer = optimizer.get_ref();
            let mut ends = self.ends(rows, &name, &optimizer.text);
            ends.sort_by(|a, b| a.cost.0.total_cmp(&b.cost.0));
            let Some(Reached { repetition, .. }) = ends.get(ends.len() / 2) else { continue };
            let median = search(&problem, self, &optimizer.value, *repetition, *self.evaluations)?;
            stop::check()?;
            if let Some(best) = median.best {
                let score = best.score;
                let label =
                    format!("{}: IoU {:.3}, {:.1} %", optimizer.text, score.iou, 100.0 * score.accuracy);
                sheet.push((label, draw(&best.genome.values, best.genome.tree_seed)?));
            }
        }
        let columns = sheet.len();
        outputs.picture(&sheet_file(&name), &picture::sheet(&sheet, columns))
    }
}
