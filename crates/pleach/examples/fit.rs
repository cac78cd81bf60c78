//! Finds the species of a picture in ten seconds: `cargo run --release -p pleach --example fit -- GOAL.png`

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use pleach::{
    Budget, Candidate, Control, FitProblem, FitSettings, Goal, GoalOptions, GoalSettings, GoalView, View,
};
use std::error::Error;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or_else(|| "targets/acer.png".to_owned());
    let goal = Goal::load(&file, &GoalOptions { max_side: Some(256), ..GoalOptions::default() })?;
    let frame = goal.frame(12.0); // metres, from the ground to the top
    let problem = FitProblem::new(pleach::species("acer")?, GoalView::new(goal.bitmap, View::FRONT, frame));

    let known = pleach::species_names().into_iter().map(pleach::species);
    let candidates = known.map(|species| species.map(Candidate::from)).collect::<Result<_, _>>()?;
    let budget = Budget { timeout: Some(Duration::from_secs(10)), ..Budget::default() };
    let search = FitSettings { budget, ..FitSettings::default() };
    let settings = GoalSettings { search, ..GoalSettings::new(candidates) };
    let (start, stop) = (Instant::now(), AtomicBool::new(false));
    let fitted = pleach::fit_goal(&problem, &settings, Control::new(&|| start.elapsed(), &stop))?;

    let said = format!("IoU {:.3} with {file}.", fitted.best.score.iou);
    println!("{}", fitted.species()?.to_toml(&[said]));
    Ok(())
}
