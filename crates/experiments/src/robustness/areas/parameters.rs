//! Random lists of parameters within their declared ranges.

use super::{Area, draws, grown};
use crate::robustness::verdict::Verdict;
use pleach_fit::Stream;
use pleach_tree::Species;
use std::path::Path;

const LANE: u32 = 2;

/// Lists around all species that come with pleach.
pub(in super::super) struct Parameters {
    presets: Vec<Species>,
}

/// Where values come from.
#[derive(Clone, Copy)]
enum Spread {
    /// Evenly over the range of searches.
    Search,
    /// Evenly over all that is allowed.
    Allowed,
    /// Evenly over the orders of magnitude of the allowed range.
    Orders,
    /// The ends of the allowed range, zero, and their neighbours.
    Corners,
}

const SPREADS: [Spread; 4] = [Spread::Search, Spread::Allowed, Spread::Orders, Spread::Corners];

impl Parameters {
    pub(in super::super) fn new() -> Self {
        let presets =
            pleach_generators::families().iter().flat_map(|family| pleach_generators::presets(*family));
        Self { presets: presets.collect() }
    }

    /// A list within the ranges: all numbers are drawn, or a few of a species'.
    fn species(&self, case: u64) -> Species {
        let mut draws = draws(LANE, case);
        let mut species = self.presets[draws.below(self.presets.len())].clone();
        let space = species.generator.space();
        let spread = SPREADS[draws.below(SPREADS.len())];
        let share = if draws.chance(0.5) { 1.0 } else { 3.0 / space.len() as f64 };
        let mut values = species.params.values().to_vec();
        for (slot, value) in space.slots().zip(&mut values) {
            if draws.chance(share) {
                let range = match spread {
                    Spread::Search => space.search_range(slot),
                    _ => space.kind_of(slot).range(),
                };
                *value = drawn(spread, range, &mut draws);
            }
        }
        space.repair(&mut values);
        if let Ok(params) = space.check(values) {
            species.params = params;
        }
        species
    }
}

fn drawn(spread: Spread, (low, high): (f64, f64), draws: &mut Stream) -> f64 {
    // Ranges without end stop where a tree is larger than the Earth.
    let (low, high) = (low.max(-1e9), high.min(1e9));
    match spread {
        Spread::Search | Spread::Allowed => low + draws.unit() * (high - low),
        Spread::Orders => {
            let sign = if low < 0.0 && draws.chance(0.5) { -1.0 } else { 1.0 };
            let most = if sign < 0.0 { -low } else { high };
            sign * most * 10.0_f64.powf(-9.0 * draws.unit())
        }
        Spread::Corners => [low, high, 0.0, low.next_up(), high.next_down(), 1e-300][draws.below(6)],
    }
}

impl Area for Parameters {
    fn name(&self) -> &'static str {
        "parameters"
    }

    fn input(&self, case: u64) -> Vec<u8> {
        self.species(case).to_toml(&[]).into_bytes()
    }

    fn judge(&self, case: u64, _: &Path) -> Verdict {
        grown(&self.species(case), case)
    }
}
