//! Fits of goals that the search has not grown, scored with seeds that it has not seen.

use super::spec::{MethodSpec, TreefitGoal, TreefitSpec};
use super::{Slice, Table, progress};
use crate::commands::fit::candidates;
use crate::{files, output};
use anyhow::{Context, bail};
use pleach_fit::{
    Budget, Control, FitProblem, FitSettings, FreshSeeds, Genome, GoalView, GuessSettings, Start, Unknown,
    first_guess, fresh_seeds,
};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::picture;
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::{Bitmap, Frame, Rasteriser, View};
use pleach_tree::{Foliage, Growth, Limits, Tree, Workspace};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

const COLUMNS: [&str; 23] = [
    "goal",
    "method",
    "repetition",
    "evaluations",
    "named",
    "confidence",
    "guess_likeness",
    "guess_iou",
    "likeness",
    "iou",
    "blurred_iou_64",
    "boundary_f",
    "pixel_accuracy",
    "empty_accuracy",
    "best_ellipse_iou",
    "fresh_likeness",
    "fresh_likeness_sd",
    "fresh_iou",
    "fresh_iou_sd",
    "ceiling_likeness",
    "ceiling_iou",
    "skill",
    "wall_s",
];

/// Side of every goal in pixels.
const SIZE: u32 = 256;
/// Seed of the trees that are fitted; own goals are of other seeds.
const TREE_SEED: u64 = 1;
/// Trees of other seeds that a result, and the truth, is judged by.
const FRESH: usize = 16;

/// A goal with what is known of it.
struct Problem {
    name: String,
    fit: FitProblem,
    /// The parameters that grew it, if they are ours.
    truth: Option<Genome>,
}

/// One finished fit, for the sheet.
struct Finished {
    goal: String,
    method: String,
    pictures: [Bitmap; 3],
}

pub(super) fn run(folder: &Path, spec: &TreefitSpec) -> anyhow::Result<String> {
    let (table, finished) = rows(folder, spec, Slice::default())?;
    table.write(&folder.join("results.csv"))?;
    pictures(folder, spec, &finished)?;
    report(spec, &table)
}

pub(super) fn table(folder: &Path, spec: &TreefitSpec, slice: Slice) -> anyhow::Result<Table> {
    // A slice is a few goals, whole: fits of fewer evaluations have other results.
    let goals = slice.repetitions.map_or(spec.goals.len(), |n| (n as usize).min(spec.goals.len()));
    let few = TreefitSpec { goals: spec.goals[..goals].to_vec(), repetitions: 1, ..spec.clone() };
    Ok(rows(folder, &few, slice)?.0)
}

fn rows(folder: &Path, spec: &TreefitSpec, slice: Slice) -> anyhow::Result<(Table, Vec<Finished>)> {
    let most = slice.evaluations.unwrap_or(u64::MAX);
    let methods: Vec<&MethodSpec> = spec.methods.iter().filter(|m| m.evaluations <= most).collect();
    if methods.is_empty() {
        bail!("every method makes more than {most} evaluations");
    }
    let bar = progress("fits", spec.goals.len() as u64 * methods.len() as u64 * spec.repetitions);
    let mut table = Table { columns: COLUMNS.to_vec(), rows: Vec::new() };
    let mut finished = Vec::new();
    for goal in &spec.goals {
        let problem = problem(folder, goal)?;
        for method in &methods {
            for repetition in 1..=spec.repetitions {
                let (row, result) = fit(&problem, method, repetition)?;
                table.rows.push(row);
                finished.extend((repetition == 1).then_some(result));
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    Ok((table, finished))
}

fn problem(folder: &Path, spec: &TreefitGoal) -> anyhow::Result<Problem> {
    let base = pleach_generators::preset("quaking_aspen").context("the default species is built in")?;
    let view = View::FRONT;
    let (name, goal, truth) = match spec {
        TreefitGoal::Own { species, seed, bare } => {
            let species = pleach_generators::species(species)?;
            let tree = species.grow(*seed)?;
            let frame = Frame::automatic(&tree, &view, !bare, SIZE, SIZE);
            let mut bitmap = Bitmap::default();
            Rasteriser::new().draw(&tree, &view, &frame, !bare, &mut bitmap);
            let truth = Genome::new(species.params.values().to_vec(), *seed);
            let name = if *bare { format!("{}_bare", species.name) } else { species.name.clone() };
            (name, GoalView { goal: bitmap, view, frame, unknown: Unknown::default() }, Some(truth))
        }
        TreefitGoal::File { file, height, .. } => {
            let options = GoalOptions { max_side: Some(SIZE), ..GoalOptions::default() };
            let picture = Goal::load(folder.join(file), &options)?;
            let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let frame = picture.frame(*height);
            (name, GoalView { frame, goal: picture.bitmap, view, unknown: Unknown::default() }, None)
        }
    };
    let fit = FitProblem {
        generator: Arc::clone(&base.generator),
        base: base.params.values().to_vec(),
        goals: vec![goal],
        foliage: !spec.is_bare(),
    };
    Ok(Problem { name, fit, truth })
}

fn fit(problem: &Problem, method: &MethodSpec, seed: u64) -> anyhow::Result<(Vec<String>, Finished)> {
    let started = Instant::now();
    let mut fit = problem.fit.clone();
    let mut settings = FitSettings {
        optimizer: method.optimizer.parse()?,
        budget: Budget::evaluations(method.evaluations),
        seed,
        tree_seed: pleach_fit::TreeSeed::Fixed(TREE_SEED),
        ..FitSettings::default()
    };
    if let Some(objective) = &method.objective {
        settings.objective = objective.parse()?;
    }
    let mut named = (String::new(), String::new());
    let mut guess = None;
    if method.from == "auto" {
        let found = first_guess(&fit, &settings, &candidates(&fit), &GuessSettings::default(), |_, _| ())?;
        named = (found.names[0].0.clone(), number(found.names[0].1));
        fit.base = found.nearest[0].values.clone();
        guess = Some(Genome::new(fit.base.clone(), TREE_SEED));
        settings.start = Start::Lists(found.nearest.into_iter().map(|guess| guess.values).collect());
    } else if method.from != "random" {
        bail!("`from = \"{}\"`: expected auto or random", method.from);
    }
    let clock = || started.elapsed();
    let outcome = pleach_fit::fit(&fit, &settings, Control::new(&clock, &AtomicBool::new(false)))?;
    let best = outcome.best.filter(|best| best.score.cost.is_finite());
    let best = best.with_context(|| format!("{}: nothing grew", problem.name))?.genome;

    let GoalView { goal, .. } = &fit.goals[0];
    let draw = |genome: &Genome| draw(&fit, genome);
    let picture = draw(&best)?;
    let card = ScoreCard::of(&picture, goal)?;
    let guess = guess.map(|genome| draw(&genome)).transpose()?;
    let guessed = guess.as_ref().map(|picture| ScoreCard::of(picture, goal)).transpose()?;
    let judge = |genome: &Genome| fresh_seeds(&fit, settings.objective, Limits::default(), genome, FRESH);
    let fresh = judge(&best)?;
    let ceiling = problem.truth.as_ref().map(judge).transpose()?.flatten();
    let fresh_number = |of: fn(&FreshSeeds) -> f64| fresh.as_ref().map(of).map_or_else(String::new, number);
    let ceiling_number =
        |of: fn(&FreshSeeds) -> f64| ceiling.as_ref().map(of).map_or_else(String::new, number);
    let guess_number = |of: fn(&ScoreCard) -> f64| guessed.as_ref().map(of).map_or_else(String::new, number);
    // The ellipse scores nothing and other trees of the true parameters all that can be asked for.
    let skill = match (&fresh, &ceiling) {
        (Some(fresh), Some(ceiling)) => {
            let floor = card.best_ellipse_iou;
            number((fresh.iou.mean - floor) / (ceiling.iou.mean - floor))
        }
        _ => String::new(),
    };
    let row = vec![
        problem.name.clone(),
        method.name.clone(),
        seed.to_string(),
        outcome.evaluations.to_string(),
        named.0,
        named.1,
        guess_number(|card| card.likeness),
        guess_number(|card| card.iou),
        number(card.likeness),
        number(card.iou),
        number(card.blurred_iou.sixty_fourth),
        number(card.boundary_f),
        number(card.pixel_accuracy),
        number(card.empty_accuracy),
        number(card.best_ellipse_iou),
        fresh_number(|fresh| fresh.likeness.mean),
        fresh_number(|fresh| fresh.likeness.sd),
        fresh_number(|fresh| fresh.iou.mean),
        fresh_number(|fresh| fresh.iou.sd),
        ceiling_number(|fresh| fresh.likeness.mean),
        ceiling_number(|fresh| fresh.iou.mean),
        skill,
        format!("{:.1}", started.elapsed().as_secs_f64()),
    ];
    let other = draw(&Genome { tree_seed: TREE_SEED + 1, ..best })?;
    let pictures = [guess.unwrap_or_else(|| Bitmap::new(SIZE, SIZE)), picture, other];
    Ok((row, Finished { goal: problem.name.clone(), method: method.name.clone(), pictures }))
}

fn number(value: f64) -> String {
    format!("{value:.4}")
}

fn draw(problem: &FitProblem, genome: &Genome) -> anyhow::Result<Bitmap> {
    let params = problem.generator.space().check(genome.values.clone())?;
    let mut tree = Tree::default();
    let foliage = if problem.foliage { Foliage::All } else { Foliage::None };
    let growth = Growth { foliage, ..Growth::seed(genome.tree_seed) };
    problem.generator.grow(&params, &growth, &mut Workspace::default(), &mut tree)?;
    let GoalView { view, frame, .. } = &problem.goals[0];
    let mut bitmap = Bitmap::default();
    Rasteriser::new().draw(&tree, view, frame, problem.foliage, &mut bitmap);
    Ok(bitmap)
}

/// Goal, first guess, fit, and a tree of the fit with another seed: two goals a row, of the first method.
fn pictures(folder: &Path, spec: &TreefitSpec, finished: &[Finished]) -> anyhow::Result<()> {
    let mut sheet = Vec::new();
    for goal in &spec.goals {
        let problem = problem(folder, goal)?;
        let of_goal = |f: &&Finished| f.goal == problem.name && f.method == spec.methods[0].name;
        let Some(result) = finished.iter().find(of_goal) else { continue };
        sheet.push((problem.name.clone(), problem.fit.goals[0].goal.shrunk(0.5)));
        for (label, picture) in ["first guess", "fit", "another seed"].into_iter().zip(&result.pictures) {
            sheet.push((label.to_owned(), picture.shrunk(0.5)));
        }
    }
    let picture = picture::sheet(&sheet, 8);
    files::write_whole(&folder.join("sheet.png"), |file| Ok(picture.write_png(file)?))
}

/// Medians of each method over own and over other goals.
fn report(spec: &TreefitSpec, table: &Table) -> anyhow::Result<String> {
    let column = |name: &str| COLUMNS.iter().position(|c| *c == name).context("a declared column");
    let shown =
        ["likeness", "iou", "best_ellipse_iou", "fresh_likeness", "fresh_iou", "ceiling_likeness", "wall_s"];
    let mut rows = vec![["goals", "method"].into_iter().chain(shown).map(str::to_owned).collect::<Vec<_>>()];
    for own in [true, false] {
        for method in &spec.methods {
            let is_own = |row: &[String]| -> anyhow::Result<bool> {
                Ok(row[column("ceiling_likeness")?].is_empty() != own)
            };
            let mut of = Vec::new();
            for row in table.rows.iter().filter(|row| row[1] == method.name) {
                if is_own(row)? {
                    of.push(row);
                }
            }
            let mut line = vec![if own { "own" } else { "foreign" }.to_owned(), method.name.clone()];
            for name in shown {
                let at = column(name)?;
                let mut values: Vec<f64> = of.iter().filter_map(|row| row[at].parse().ok()).collect();
                values.sort_by(f64::total_cmp);
                line.push(values.get(values.len() / 2).map_or_else(String::new, |v| format!("{v:.3}")));
            }
            rows.push(line);
        }
    }
    Ok(format!("medians\n\n{}", output::table(&rows, &[2, 3, 4, 5, 6, 7, 8])))
}
