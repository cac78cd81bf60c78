//! Helpers of the tests.

use pleach_tree::Species;

/// The fifteen species of the dissertation, in its order.
pub(crate) fn fifteen() -> Vec<Species> {
    pleach_generators::HEWITT_2017.iter().map(|name| species(name)).collect()
}

pub(crate) fn species(name: &str) -> Species {
    pleach_generators::species(name).unwrap()
}

/// Uniform numbers in 0..1 from a seed.
pub(crate) fn uniform(seed: u64) -> impl Iterator<Item = f64> {
    let key = pleach_tree::Key::root(seed);
    (0..).map(move |i| key.unit(0, i))
}
