//! Every species keeps the promises of a generator.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach_tree::{Family, conformance};
use pleach_weber_penn::{WeberPennFamily, preset};

fn check(name: &str) {
    conformance::check(&preset(name).unwrap(), |doc| WeberPennFamily.read(doc).unwrap());
}

macro_rules! conformance {
    ($($name:ident),* $(,)?) => {
        $(#[test] fn $name() { check(stringify!($name)); })*

        #[test]
        fn every_species_is_checked() {
            let checked = [$(stringify!($name)),*];
            let known: Vec<&str> = WeberPennFamily.presets().iter().map(|(name, _)| *name).collect();
            assert_eq!(checked.as_slice(), known);
        }
    };
}

conformance!(
    quaking_aspen,
    weeping_willow,
    bamboo,
    palm,
    lombardy_poplar,
    small_pine,
    acer,
    silver_birch,
    douglas_fir,
    apple,
    black_tupelo,
    black_oak,
    european_larch,
    hill_cherry,
    balsam_fir,
    cambridge_oak,
    fan_palm,
    sassafras,
    sphere_tree,
    weeping_willow_o,
);
