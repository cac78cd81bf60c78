//! Fits of goals that the search has not grown, scored with seeds that it has not seen.

mod attempt;
mod goals;
mod report;
mod sheet;
mod spec;

pub(super) use spec::TreefitSpec;

use super::{Part, Slice, Table, progress};
use crate::files;
use anyhow::{Context, bail};
use attempt::Guesses;
use goals::Problem;
use pleach_fit::Genome;
use pleach_tree::Species;
use pleach_tree::species::Appearance;
use spec::MethodSpec;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const COLUMNS: [&str; 28] = [
    "goal",
    "kind",
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
    "clean_likeness",
    "clean_iou",
    "held_out_likeness",
    "held_out_iou",
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
/// Trees of other seeds that a result, and the truth, is judged by.
const FRESH: usize = 16;
/// Nobody ends an experiment but by killing it.
static RUNS_ON: AtomicBool = AtomicBool::new(false);

/// Finished rows by goal, method and repetition.
type Rows = HashMap<[String; 3], Vec<String>>;

fn key(row: &[String]) -> [String; 3] {
    [row[0].clone(), row[2].clone(), row[3].clone()]
}

fn rows(path: &Path) -> anyhow::Result<impl Iterator<Item = ([String; 3], Vec<String>)>> {
    Ok(Table::read(path, &COLUMNS)?.rows.into_iter().map(|row| (key(&row), row)))
}

/// Where an unfinished run keeps its rows.
fn unfinished(folder: &Path) -> PathBuf {
    folder.join("results.csv.partial")
}

/// What is run, and what is known already.
struct Plan<'a> {
    folder: &'a Path,
    spec: &'a TreefitSpec,
    methods: Vec<&'a MethodSpec>,
    /// At most so many fits of one goal by one method.
    repetitions: u64,
    known: Rows,
    /// Whether rows and fits are written down as they come.
    keeps: bool,
}

pub(super) fn run(folder: &Path, spec: &TreefitSpec, part: &Part) -> anyhow::Result<String> {
    let mut known = Rows::new();
    if !part.methods.is_empty() {
        for name in &part.methods {
            if spec.methods.iter().all(|method| method.name != *name) {
                let names: Vec<&str> = spec.methods.iter().map(|method| method.name.as_str()).collect();
                bail!("there is no method `{name}`; the experiment has {}", names.join(", "));
            }
        }
        known.extend(rows(&folder.join("results.csv"))?);
        known.retain(|[_, method, _], _| !part.methods.contains(method));
    }
    let partial = unfinished(folder);
    if part.resume && partial.exists() {
        known.extend(rows(&partial)?);
    }
    let methods = spec.methods.iter().collect();
    let plan = Plan { folder, spec, methods, repetitions: u64::MAX, known, keeps: true };
    let table = plan.table()?;
    table.write(&folder.join("results.csv"))?;
    let _ = std::fs::remove_file(partial);
    sheet::draw(folder, spec)?;
    report::of(spec, &table)
}

/// A slice is a few goals, whole: fits of fewer evaluations have other results.
pub(super) fn table(folder: &Path, spec: &TreefitSpec, slice: Slice) -> anyhow::Result<Table> {
    let count = slice.repetitions.map_or(spec.goals.len(), |n| (n as usize).min(spec.goals.len()));
    let most = slice.evaluations.unwrap_or(u64::MAX);
    let is_in = |m: &&MethodSpec| m.seconds.is_none() && m.evaluations.is_some_and(|n| n <= most);
    let methods: Vec<&MethodSpec> = spec.methods.iter().filter(is_in).collect();
    if methods.is_empty() {
        bail!("every method makes more than {most} evaluations");
    }
    let spec = TreefitSpec { goals: spec.goals[..count].to_vec(), methods: spec.methods.clone() };
    Plan { folder, spec: &spec, methods, repetitions: 1, known: Rows::new(), keeps: false }.table()
}

impl Plan<'_> {
    fn table(mut self) -> anyhow::Result<Table> {
        let repetitions = |method: &MethodSpec| method.repetitions.unwrap_or(1).min(self.repetitions);
        let mut jobs = Vec::new();
        for goal in &self.spec.goals {
            for method in self.methods.iter().filter(|method| method.fits(goal.kind())) {
                jobs.extend((1..=repetitions(method)).map(|repetition| (goal, *method, repetition)));
            }
        }
        let bar = progress("fits", jobs.len() as u64);
        let mut current: Option<(Problem, Guesses)> = None;
        let mut table = Table { columns: COLUMNS.to_vec(), rows: Vec::new() };
        for (goal, method, repetition) in jobs {
            let name = goal.name();
            let row = match self.known.remove(&[name.clone(), method.name.clone(), repetition.to_string()]) {
                Some(row) => row,
                None => {
                    let (problem, guesses) = match current.take().filter(|(problem, _)| problem.name == name)
                    {
                        Some(same) => current.insert(same),
                        None => {
                            let problem = Problem::with_ceiling(self.folder, goal)?;
                            current.insert((problem, Guesses::default()))
                        }
                    };
                    let result = attempt::fit(problem, guesses, method, repetition)
                        .with_context(|| format!("{name}, {}, repetition {repetition}", method.name))?;
                    if self.keeps && repetition == 1 && method.name == self.spec.methods[0].name {
                        let fits = self.folder.join("fits");
                        files::make_folder(&fits)?;
                        write_species(&fits.join(format!("{name}.toml")), &name, problem, &result.best)?;
                        if let Some(guess) = &result.guess {
                            let file = fits.join(format!("{name}-guess.toml"));
                            write_species(&file, &name, problem, guess)?;
                        }
                    }
                    result.row
                }
            };
            table.rows.push(row);
            if self.keeps {
                // A run that is killed twice keeps what the first one had finished beyond this place.
                let mut all = table.clone();
                all.rows.extend(self.known.values().cloned());
                all.rows[table.rows.len()..].sort();
                all.write(&unfinished(self.folder))?;
            }
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(table)
    }
}

/// A fit as a species file, so that anybody can grow it.
fn write_species(path: &Path, name: &str, problem: &Problem, genome: &Genome) -> anyhow::Result<()> {
    let generator = Arc::clone(&problem.fit.generator);
    let params = generator.space().check(genome.values.clone())?;
    let species = Species {
        name: name.to_owned(),
        description: String::new(),
        generator,
        params,
        tree_seed: Some(genome.tree_seed),
        appearance: Appearance::default(),
    };
    files::write_text(path, &species.to_toml(&[]))
}
