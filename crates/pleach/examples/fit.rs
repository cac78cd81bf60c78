//! Finds the species of a picture in ten seconds: `cargo run --release -p pleach --example fit -- GOAL.png`

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use pleach::{Control, FitOptions, fit_picture};
use std::error::Error;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or_else(|| "targets/acer.png".to_owned());
    let options =
        FitOptions { height: 12.0, timeout: Some(Duration::from_secs(10)), ..FitOptions::default() };
    let (start, stop) = (Instant::now(), AtomicBool::new(false));
    let report = fit_picture(file.as_str(), &options, Control::new(&|| start.elapsed(), &stop))?;

    let tree = report.best();
    let said = format!("IoU {:.3}, likeness {:.3} with {file}.", tree.scores.iou, tree.scores.likeness);
    println!("{}", tree.species.to_toml(&[said]));
    Ok(())
}
