//! Grows a tree and measures it: `cargo run -p pleach --example grow -- quaking_aspen 1`

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use pleach::{Bounds, Parts};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or_else(|| "quaking_aspen".to_owned());
    let seed = arguments.next().map_or(Ok(1), |seed| seed.parse())?;

    let species = pleach::species(&name)?;
    let tree = species.grow(seed)?;
    println!("{name}, seed {seed}: {} stems, {} leaves", tree.stems.len(), tree.leaves.len());
    if let Some(Bounds { min, max }) = Bounds::new(&tree, Parts::LEAFY) {
        println!("{:.1} m high, {:.1} m wide", max.z, (max.x - min.x).max(max.y - min.y));
    }
    Ok(())
}
