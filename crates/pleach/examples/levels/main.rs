//! How alike levels of detail with a budget are to their trees: `cargo run --release -p pleach --example levels -- 30000,8000
//! quaking_aspen acer`, a row of CSV for each species and budget.

#![allow(clippy::print_stdout, reason = "an example says what it has found")]

mod compared;

use compared::{Compared, compare};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let budgets = args.next().unwrap_or_else(|| "50000,30000,8000,2000".to_owned());
    let budgets = budgets.split(',').map(str::parse).collect::<Result<Vec<u32>, _>>()?;
    println!("species,budget,triangles,cards,likeness,ink,halved_likeness,halved_ink");
    for name in args {
        for (budget, level) in budgets.iter().zip(compare(&name, &budgets)?) {
            let Compared { triangles, has_cards, whole, halved } = level;
            print!("{name},{budget},{triangles},{has_cards}");
            println!(",{:.3},{:.3},{:.3},{:.3}", whole.likeness, whole.ink, halved.likeness, halved.ink);
        }
    }
    Ok(())
}
