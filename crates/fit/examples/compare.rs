//! Optimisers against each other on goals that pleach has grown itself, at equal evaluations.
//!
//! ```text
//! cargo run --release -p pleach-fit --example compare -- \
//!     [--evaluations N] [--timeout SECONDS] [--species a,b|all] [--seeds N] [--optimizers a,b] \
//!     [--objective NAME] [--settings JSON] [--csv FILE] [--clock wall|cpu] \
//!     [--goal-seed N] [--from random|known|others]
//! ```
//!
//! Every goal is its species' tree of seed 1 (or another), leafy, from the front, 256 × 256; fits use
//! tree seed 1. They start from random lists, from the nearest of the known species, or from the
//! nearest of all species but the goal's own. One row a run, then the mean of each optimiser. With
//! `--clock cpu` the timeout counts the processor's time, all threads together: for a machine that
//! does other work too (Linux only).

#![allow(clippy::print_stdout, reason = "a program that prints a table")]

use pleach_fit::{
    Budget, Candidate, Control, FitProblem, FitSettings, GoalView, GuessSettings, Objective, Optimizer,
    Start, TreeSeed, first_guess, fit,
};
use pleach_silhouette::score::best_ellipse_iou;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Species;
use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::io::Write as _;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

const TREE_SEED: u64 = 1;
const SIZE: u32 = 256;

/// The fifteen species of Hewitt 2017.
const FIFTEEN: [&str; 15] = [
    "quaking_aspen",
    "weeping_willow",
    "bamboo",
    "palm",
    "lombardy_poplar",
    "small_pine",
    "acer",
    "silver_birch",
    "douglas_fir",
    "apple",
    "black_tupelo",
    "black_oak",
    "european_larch",
    "hill_cherry",
    "balsam_fir",
];

fn problem(species: &Species, seed: u64) -> Result<FitProblem, Box<dyn Error>> {
    let tree = species.grow(seed)?;
    let frame = Frame::automatic(&tree, &View::FRONT, true, SIZE, SIZE);
    let mut goal = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, true, &mut goal);
    let problem = FitProblem::new(species.clone(), GoalView::new(goal, View::FRONT, frame));
    Ok(problem.with_values(species.generator.space().defaults())?)
}

/// The nearest of the known species, without the one called `except`.
fn known(problem: &FitProblem, settings: &FitSettings, except: &str) -> Result<Start, Box<dyn Error>> {
    let candidate = |name: &str| Some(Candidate { species: pleach_generators::preset(name)? });
    let names = FIFTEEN.iter().filter(|name| **name != except);
    let candidates: Vec<Candidate> = names.filter_map(|name| candidate(name)).collect();
    let guess = first_guess(
        problem,
        settings,
        &candidates,
        &GuessSettings::default(),
        &AtomicBool::new(false),
        |_, _| (),
    )?;
    Ok(guess.start())
}

fn wall_time() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Time that all threads of this process have had, in steps of a hundredth of a second.
fn cpu_time() -> Duration {
    let stat = fs::read_to_string("/proc/self/stat").expect("--clock cpu needs Linux");
    // The name, in parentheses, may hold spaces; user and system time are the 12th and 13th after it.
    let after = stat.rsplit(')').next().unwrap_or_default();
    let ticks: u64 = after.split_whitespace().skip(11).take(2).filter_map(|t| t.parse::<u64>().ok()).sum();
    Duration::from_millis(10 * ticks)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut given: BTreeMap<String, String> = BTreeMap::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(flag) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{flag} needs a value"))?;
        given.insert(flag.trim_start_matches('-').to_owned(), value);
    }
    let mut take = |name: &str, default: &str| given.remove(name).unwrap_or_else(|| default.to_owned());
    let evaluations: u64 = take("evaluations", "2000").parse()?;
    let timeout: f64 = take("timeout", "0").parse()?;
    let species = take("species", "all");
    let seeds: u64 = take("seeds", "1").parse()?;
    let optimizers = take("optimizers", &Optimizer::NAMES.join(","));
    let objective: Objective = take("objective", Objective::default().name()).parse()?;
    let settings = take("settings", "");
    let csv = take("csv", "");
    let clock = match take("clock", "wall").as_str() {
        "wall" => wall_time,
        "cpu" => cpu_time,
        other => return Err(format!("--clock {other}: wall or cpu").into()),
    };
    let goal_seed: u64 = take("goal-seed", "1").parse()?;
    let from = take("from", "random");
    if let Some(unknown) = given.keys().next() {
        return Err(format!("unknown flag --{unknown}").into());
    }

    let names: Vec<&str> = if species == "all" { FIFTEEN.to_vec() } else { species.split(',').collect() };
    let mut file = if csv.is_empty() { None } else { Some(fs::File::create(&csv)?) };
    if let Some(file) = &mut file {
        writeln!(file, "species,optimizer,seed,evaluations,empty_accuracy,accuracy,iou,cost,seconds")?;
    }
    let mut means: BTreeMap<&str, ([f64; 3], f64)> = BTreeMap::new();
    for name in names {
        let species = pleach_generators::preset(name).ok_or_else(|| format!("no species `{name}`"))?;
        let problem = problem(&species, goal_seed)?;
        let goal = &problem.goals[0].goal;
        let ellipse = best_ellipse_iou(goal);
        let empty = 1.0 - goal.ink() as f64 / goal.area() as f64;
        for optimizer in optimizers.split(',') {
            let mut line = String::new();
            let (mut sum, mut seconds, mut made) = ([0.0; 3], 0.0, 0);
            for seed in 1..=seeds {
                let optimizer = if settings.is_empty() {
                    optimizer.parse()?
                } else {
                    serde_json::from_str::<Optimizer>(&settings)?
                };
                let mut settings = FitSettings {
                    optimizer,
                    objective,
                    seed,
                    tree_seed: TreeSeed::Fixed(TREE_SEED),
                    budget: Budget {
                        evaluations: (evaluations > 0).then_some(evaluations),
                        timeout: (timeout > 0.0).then(|| Duration::from_secs_f64(timeout)),
                        ..Budget::default()
                    },
                    ..FitSettings::default()
                };
                let started = clock();
                let clock = move || clock() - started;
                match from.as_str() {
                    "random" => {}
                    "known" => settings.start = known(&problem, &settings, "")?,
                    "others" => settings.start = known(&problem, &settings, name)?,
                    other => return Err(format!("--from {other}: random, known or others").into()),
                }
                let outcome = fit(&problem, &settings, Control::new(&clock, &AtomicBool::new(false)))?;
                let score = outcome.best.ok_or("nothing was evaluated")?.score;
                for (sum, value) in sum.iter_mut().zip([score.accuracy, score.iou, score.cost]) {
                    *sum += value;
                }
                seconds += outcome.elapsed.as_secs_f64();
                made += outcome.evaluations;
                line +=
                    &format!(" {:.3} ({} stems, {} leaves)", score.iou, score.size.stems, score.size.leaves);
                if let Some(file) = &mut file {
                    let (accuracy, iou, cost) = (score.accuracy, score.iou, score.cost);
                    writeln!(
                        file,
                        "{name},{},{seed},{},{empty},{accuracy},{iou},{cost},{}",
                        settings.optimizer.name(),
                        outcome.evaluations,
                        outcome.elapsed.as_secs_f64()
                    )?;
                }
            }
            let n = seeds as f64;
            let [accuracy, iou, cost] = sum.map(|s| s / n);
            println!(
                "{name:16} {optimizer:10} empty {empty:.3} ellipse {ellipse:.3} accuracy {accuracy:.4} iou {iou:.4} cost {cost:.4} {:7} evaluations {:6.1} s |{line}",
                made / seeds,
                seconds / n,
            );
            let entry = means.entry(optimizer).or_default();
            for (sum, value) in entry.0.iter_mut().zip([accuracy, iou, cost]) {
                *sum += value;
            }
            entry.1 += 1.0;
        }
    }
    for (optimizer, ([accuracy, iou, cost], n)) in means {
        println!("MEAN {optimizer:10} accuracy {:.4} iou {:.4} cost {:.4}", accuracy / n, iou / n, cost / n);
    }
    Ok(())
}
