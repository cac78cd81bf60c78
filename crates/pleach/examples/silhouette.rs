//! Draws a silhouette: `cargo run -p pleach --example silhouette -- silver_birch birch.png`

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use pleach::View;
use std::error::Error;
use std::fs::File;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "silver_birch".to_owned());
    let file = arguments.next().unwrap_or_else(|| format!("{name}.png"));

    let tree = pleach::species(&name)?.grow(1)?;
    let picture = pleach::silhouette(&tree, View::degrees(30.0, 10.0), 256);
    picture.write_png(&mut File::create(&file)?)?;
    println!("{file}: {} of {} pixels are tree", picture.ink(), picture.area());
    Ok(())
}
