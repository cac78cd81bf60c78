//! Optimisers against each other on goals.

use super::plot::{Plot, Scale};
use super::spec::{FitsSpec, GoalSpec};
use super::{Slice, Table, progress};
use crate::{files, output};
use anyhow::Context;
use pleach_fit::{
    Budget, Control, FitProblem, FitSettings, GoalView, Objective, Outcome, Start, TreeSeed, Unknown,
};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::picture;
use pleach_silhouette::{Bitmap, Rasteriser, View};
use pleach_tree::Growth;
use std::path::Path;
use std::sync::atomic::AtomicBool;
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

/// One finished search, for pictures.
pub(super) struct Finished {
    goal: usize,
    optimizer: String,
    outcome: Outcome,
}

pub(super) fn run(folder: &Path, spec: &FitsSpec) -> anyhow::Result<String> {
    let (table, finished) = table(folder, spec, Slice::default())?;
    table.write(&folder.join("results.csv"))?;
    let mut rows = vec![
        ["goal", "optimizer", "accuracy", "worst", "IoU", "worst", "seconds"].map(str::to_owned).to_vec(),
    ];
    for (g, goal) in spec.goals.iter().enumerate() {
        let name = name(goal);
        plot(folder, spec, &table, &name)?;
        pictures(folder, spec, goal, g, &finished)?;
        for optimizer in &spec.optimizers {
            let of: Vec<&Finished> =
                finished.iter().filter(|f| f.goal == g && f.optimizer == *optimizer).collect();
            let scores = |pick: fn(&pleach_fit::Score) -> f64| -> Vec<f64> {
                let mut values: Vec<f64> =
                    of.iter().filter_map(|f| f.outcome.best.as_ref()).map(|b| pick(&b.score)).collect();
                values.sort_by(f64::total_cmp);
                values
            };
            let (accuracy, iou) = (scores(|s| s.accuracy), scores(|s| s.iou));
            let middle = |v: &[f64]| v.get(v.len() / 2).copied().unwrap_or(0.0);
            let seconds: f64 =
                of.iter().map(|f| f.outcome.elapsed.as_secs_f64()).sum::<f64>() / of.len().max(1) as f64;
            rows.push(vec![
                name.clone(),
                optimizer.clone(),
                format!("{:.4}", middle(&accuracy)),
                format!("{:.4}", accuracy.first().unwrap_or(&0.0)),
                format!("{:.4}", middle(&iou)),
                format!("{:.4}", iou.first().unwrap_or(&0.0)),
                format!("{seconds:.0}"),
            ]);
        }
    }
    Ok(format!(
        "medians of {} repetitions of {} evaluations\n\n{}",
        spec.repetitions,
        spec.evaluations,
        output::table(&rows, &[2, 3, 4, 5, 6])
    ))
}

/// Runs every search and writes down its milestones.
pub(super) fn table(folder: &Path, spec: &FitsSpec, slice: Slice) -> anyhow::Result<(Table, Vec<Finished>)> {
    let repetitions = slice.repetitions.unwrap_or(spec.repetitions).min(spec.repetitions);
    let evaluations = slice.evaluations.unwrap_or(spec.evaluations).min(spec.evaluations);
    let searches = spec.goals.len() as u64 * spec.optimizers.len() as u64 * repetitions;
    let bar = progress("searches", searches);
    let mut rows = Vec::new();
    let mut finished = Vec::new();
    for (g, goal) in spec.goals.iter().enumerate() {
        let problem = problem(folder, goal)?;
        let empty = 1.0 - problem.goals[0].goal.ink() as f64 / problem.goals[0].goal.area() as f64;
        for optimizer in &spec.optimizers {
            for repetition in 1..=repetitions {
                let outcome = search(&problem, spec, optimizer, repetition, evaluations)?;
                for milestone in milestones(spec.evaluations) {
                    // A row is a whole generation, the last one within the milestone.
                    let row = outcome.history.iter().rfind(|row| row.evaluations <= milestone);
                    let Some(row) = row.filter(|_| milestone <= evaluations) else { continue };
                    rows.push(vec![
                        name(goal),
                        optimizer.clone(),
                        repetition.to_string(),
                        row.evaluations.to_string(),
                        row.generation.to_string(),
                        row.best_cost.to_string(),
                        row.accuracy.to_string(),
                        row.iou.to_string(),
                        empty.to_string(),
                        format!("{:.2}", row.elapsed_s),
                    ]);
                }
                rows.dedup();
                finished.push(Finished { goal: g, optimizer: optimizer.clone(), outcome });
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    Ok((Table { columns: COLUMNS.to_vec(), rows }, finished))
}

fn name(goal: &GoalSpec) -> String {
    goal.file.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn problem(folder: &Path, goal: &GoalSpec) -> anyhow::Result<FitProblem> {
    let picture = Goal::load(folder.join(&goal.file), &GoalOptions::default())?;
    let base = pleach_generators::preset("quaking_aspen").context("the default species is built in")?;
    Ok(FitProblem {
        base: base.params.values().to_vec(),
        generator: base.generator,
        goals: vec![GoalView {
            frame: picture.frame(goal.height),
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
    optimizer: &str,
    seed: u64,
    evaluations: u64,
) -> anyhow::Result<Outcome> {
    let settings = FitSettings {
        optimizer: optimizer.parse()?,
        budget: Budget::evaluations(evaluations),
        seed,
        tree_seed: TreeSeed::Fixed(spec.tree_seed),
        objective: spec.objective.as_deref().map_or_else(|| Ok(Objective::default()), str::parse)?,
        start: Start::Random,
        ..FitSettings::default()
    };
    let started = Instant::now();
    let clock = || started.elapsed();
    Ok(pleach_fit::fit(problem, &settings, Control::new(&clock, &AtomicBool::new(false)))?)
}

/// Accuracy and IoU over evaluations, a line a repetition.
fn plot(folder: &Path, spec: &FitsSpec, table: &Table, goal: &str) -> anyhow::Result<()> {
    for (column, label) in [(6, "pixel accuracy"), (7, "intersection over union")] {
        let mut plot = Plot::new("evaluations", label, Scale::Log, Scale::Linear);
        for optimizer in &spec.optimizers {
            for repetition in 1..=spec.repetitions {
                let of = table
                    .rows
                    .iter()
                    .filter(|r| r[0] == goal && r[1] == *optimizer && r[2] == repetition.to_string());
                let points: Vec<(f64, f64)> =
                    of.filter_map(|r| Some((r[3].parse().ok()?, r[column].parse().ok()?))).collect();
                plot.line(&format!("{optimizer} {repetition}"), &points, *optimizer == "hewitt");
            }
        }
        let kind = if column == 6 { "accuracy" } else { "iou" };
        files::write_text(&folder.join(format!("{goal}-{kind}.svg")), &plot.svg())?;
    }
    Ok(())
}

/// Goal, start and the median search of each optimiser side by side.
fn pictures(
    folder: &Path,
    spec: &FitsSpec,
    goal: &GoalSpec,
    g: usize,
    finished: &[Finished],
) -> anyhow::Result<()> {
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
        Rasteriser::new().draw(&tree, view, frame, true, &mut bitmap);
        Ok(bitmap)
    };
    let mut sheet = vec![("goal".to_owned(), target.clone())];
    let start = search(&problem, spec, "random", 1, 1)?;
    if let Some(best) = start.best {
        sheet.push(("start".to_owned(), draw(&best.genome.values, best.genome.tree_seed)?));
    }
    for optimizer in &spec.optimizers {
        let mut of: Vec<&pleach_fit::Scored> = finished
            .iter()
            .filter(|f| f.goal == g && f.optimizer == *optimizer)
            .filter_map(|f| f.outcome.best.as_ref())
            .collect();
        of.sort_by(|a, b| a.score.cost.total_cmp(&b.score.cost));
        if let Some(best) = of.get(of.len() / 2) {
            let label =
                format!("{optimizer}: IoU {:.3}, {:.1} %", best.score.iou, 100.0 * best.score.accuracy);
            sheet.push((label, draw(&best.genome.values, best.genome.tree_seed)?));
        }
    }
    let columns = sheet.len();
    let picture = picture::sheet(&sheet, columns);
    files::write_whole(&folder.join(format!("{}.png", name(goal))), |file| Ok(picture.write_png(file)?))
}
