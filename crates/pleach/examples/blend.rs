//! A species between two others: `cargo run -p pleach --example blend -- palm acer 0.3`

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let first = arguments.next().unwrap_or_else(|| "quaking_aspen".to_owned());
    let second = arguments.next().unwrap_or_else(|| "silver_birch".to_owned());
    let part: f64 = arguments.next().map_or(Ok(0.5), |part| part.parse())?;

    let ends = vec![pleach::species(&first)?, pleach::species(&second)?];
    let between = pleach::mix(ends, &[1.0 - part, part], "between")?;
    let tree = between.grow(1)?;
    println!("{}", between.to_toml(&[format!("{} stems, {} leaves.", tree.stems.len(), tree.leaves.len())]));
    Ok(())
}
