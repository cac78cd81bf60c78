//! How stems sway: what shaders and animations need to know.
//!
//! Weber and Penn 1995, §4.7, treat a stem as an elastic rod that turns about its base and sways as
//! a sum of sines whose amplitude grows with length over radius and whose pace falls with length.
//! Here each stem gets one amplitude, one frequency and one phase after the same reasoning; the
//! constants are this crate's own:
//!
//! * the first natural frequency of a rod clamped at one end, 0.28 · c · r / l² with c = √(E/ρ) =
//!   3,500 m/s for green wood, over three for what it carries, between 0.15 and 3 Hz;
//! * the static lean of such a rod in a steady wind, in proportion to l / r: 1° at l / r = 65 (a trunk
//!   in a fresh breeze), at most 8°;
//! * the phase, which spreads stems evenly over a turn in the order of the tree.
//!
//! Each vertex of a mesh with wind data carries fourteen numbers, [`Wind::to_array`]: `TEXCOORD_1` to `TEXCOORD_7` in GLB
//! files, and properties `wind_…` in PLY.
//!
//! | set | numbers |
//! | --- | --- |
//! | `TEXCOORD_1` | x and y of the pivot of the vertex' own body, in metres and in the file's axes |
//! | `TEXCOORD_2` | z of it; x of the bend: along the body, as long as the radians by which each metre of it turns in a fresh breeze |
//! | `TEXCOORD_3` | y and z of the bend |
//! | `TEXCOORD_4` | x and y of the pivot of the body that carries it |
//! | `TEXCOORD_5` | z of it, x of its bend |
//! | `TEXCOORD_6` | y and z of its bend |
//! | `TEXCOORD_7` | whole part: level, 0 for trunks, 1 for limbs, 2 for twigs and all that they carry, and what is left: phase in turns; whole part: how far a leaf's vertex flutters in millimetres, and what is left: phase of the body that carries it |
//!
//! Trunks sway with the ground under them, by their height alone, and their bend is 0. [`moved`] is what shaders do with
//! the numbers.
//!
//! [`Wind::to_array`]: crate::block::Wind::to_array

mod bodies;
mod formula;

pub use bodies::Bodies;
pub use formula::{Breeze, moved};

use pleach_plant::Tree;

/// What part of a turn separates neighbours: no two of a run come close.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// How one stem sways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sway {
    /// Phase in turns, 0 to 1.
    pub phase: f64,
    /// Frequency in Hz.
    pub frequency: f64,
    /// Largest angle, in radians, in a fresh breeze.
    pub amplitude: f64,
}

impl Sway {
    /// How stem number `index` of `tree` sways.
    #[must_use]
    pub fn new(tree: &Tree, index: usize) -> Self {
        let stem = &tree.stems[index];
        let radius = tree.knots_of(stem).iter().map(|k| k.radius).fold(0.0, f64::max).max(1e-4);
        let length = tree.length_of(stem).max(0.05);
        let frequency = 0.28 * 3500.0 / 3.0 * radius / (length * length);
        Self {
            phase: (index as f64 * GOLDEN).fract(),
            frequency: frequency.clamp(0.15, 3.0),
            amplitude: (length / radius / 65.0).min(8.0).to_radians(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thick_stems_sway_less_and_slower_than_twigs() {
        let tree = pleach_generators::preset("quaking_aspen").unwrap().grow_bare(1).unwrap();
        let trunk = Sway::new(&tree, 0);
        let twig = tree.stems.iter().position(|s| s.level == 2).unwrap();
        let twig = Sway::new(&tree, twig);
        assert!(trunk.amplitude < 0.5 * twig.amplitude, "{trunk:?} {twig:?}");
        assert!(trunk.frequency < twig.frequency);
        assert!((0.15..=3.0).contains(&trunk.frequency));
    }
}
