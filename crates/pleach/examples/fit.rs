//! Searches the species of a picture for ten seconds: `cargo run --release -p pleach --example fit -- GOAL.png`

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use pleach::{Budget, Control, FitProblem, FitSettings, Goal, GoalOptions, GoalView, Unknown, View};
use std::error::Error;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or_else(|| "targets/acer.png".to_owned());
    let mut species = pleach::species("acer")?;
    let goal = Goal::load(&file, &GoalOptions { max_side: Some(256), ..GoalOptions::default() })?;
    let frame = goal.frame(12.0); // metres, from the ground to the top
    let view = GoalView { goal: goal.bitmap, view: View::FRONT, frame, unknown: Unknown::default() };
    let (generator, base) = (species.generator.clone(), species.generator.space().defaults());
    let problem = FitProblem { generator, base, goals: vec![view], foliage: true };

    let budget = Budget { timeout: Some(Duration::from_secs(10)), ..Budget::default() };
    let (start, stop) = (Instant::now(), AtomicBool::new(false));
    let settings = FitSettings { budget, ..FitSettings::default() };
    let outcome = pleach::fit(&problem, &settings, Control::new(&|| start.elapsed(), &stop))?;

    let best = outcome.best.ok_or("no time to try a tree")?;
    species.params = species.generator.space().check(best.genome.values)?;
    println!("{}", species.to_toml(&[format!("IoU {:.3} with {file}.", best.score.iou)]));
    Ok(())
}
