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
//! Each corner of a mesh with wind data carries two groups of four numbers (`_WIND_PIVOT` and
//! `_WIND_SWAY` in GLB files, eight properties in PLY):
//!
//! | group | numbers |
//! | --- | --- |
//! | `_WIND_PIVOT` | x, y, z of the stem's base in metres and in the file's axes; phase in turns, 0 to 1 |
//! | `_WIND_SWAY` | level (0 trunk; leaves one more than their stem), place along the stem 0 to 1, frequency in Hz, amplitude in radians |
//!
//! A shader turns a vertex about its pivot by `amplitude · place · sin(2π (frequency · time + phase))`.

use crate::block::Wind;
use glam::Vec3;
use pleach_plant::{Leaf, Stem, Tree};

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

/// Wind data of a stem's corners, up to the place along it.
pub(crate) fn of_stem(tree: &Tree, index: usize) -> Wind {
    let stem = &tree.stems[index];
    let pivot = tree.knots_of(stem)[0].point.as_vec3();
    let sway = Sway::new(tree, index);
    wind(pivot, sway, stem.level)
}

/// Wind data of a leaf's corners, up to the place along it: it flutters about its stalk.
pub(crate) fn of_leaf(leaf: &Leaf, index: usize, stem: &Stem) -> Wind {
    let sway =
        Sway { phase: (index as f64 * GOLDEN).fract(), frequency: 3.0, amplitude: 12.0_f64.to_radians() };
    wind(leaf.position, sway, stem.level.saturating_add(1))
}

fn wind(pivot: Vec3, sway: Sway, level: u16) -> Wind {
    Wind {
        pivot,
        phase: sway.phase as f32,
        level: f32::from(level),
        place: 0.0,
        frequency: sway.frequency as f32,
        amplitude: sway.amplitude as f32,
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
