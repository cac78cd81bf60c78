//! The meaning of a species' numbers, as features that can be compared and averaged.
//!
//! The dissertation put the plain list of numbers into principal components (Hewitt 2017, §3.3.1)
//! and found that signs which are switches and a `taper` that means three things spoil the blends
//! (§4.4.1). Here each number becomes one or more features by its declaration:
//!
//! | number | features | unit |
//! | --- | --- | --- |
//! | of [scale](pleach_tree::param::Scale) `Linear` or `FineNearZero` | itself | widths of its search range |
//! | of scale `Log` | its logarithm | widths of its search range |
//! | of scale `Count`, up to 9 | itself | widths of its search range |
//! | of scale `Count`, beyond 9 | ln(1 + n) | widths of its search range |
//! | choice | one for each name, 1 or 0 | 1/√2: two different choices are 1 apart |
//! | flagged | a *switch*, 1 or 0, and two *magnitudes*, one for each meaning of the sign | 1; widths of the range on that side |
//! | with [breakpoints](pleach_tree::Param::breakpoints) | one for each regime: how far through it the number is | the regime's width |
//!
//! A feature is **missing** where it means nothing: everything about levels, leaves, blossoms or
//! pruning that a species does not have ([`Generator::is_active`]), and the magnitude of the meaning
//! that a flagged number has not chosen. Zero is the start of both meanings of a flag, so there
//! neither is missing. Missing features add nothing to a distance and do not take part in an
//! average.
//!
//! No declared choice has a real order, so none is coded by its number. Counts are compared and
//! averaged as ratios because they multiply from level to level: this way the number of leaves of a
//! blend lies between those of its species.

mod slot;

use pleach_tree::math;
pub use slot::Feature;
use slot::SlotCode;

use pleach_tree::{Generator, ParamSpace, Slot};

/// How the numbers of a species become features.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// By declaration, as this module describes.
    #[default]
    Declared,
    /// The plain list of numbers: the dissertation's way, kept to be measured against.
    Raw,
}

/// The features of one species.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    /// One a feature, `None` where it means nothing to this species.
    pub values: Vec<Option<f64>>,
}

/// The translation between the slots of a parameter space and features.
#[derive(Clone, Debug)]
pub struct Coding {
    slots: Vec<SlotCode>,
    features: Vec<Feature>,
    kind: Encoding,
}

impl Coding {
    /// The coding of `space`, with units from its search ranges, or from `examples` (full lists of
    /// values) where these reach beyond them.
    #[must_use]
    pub fn new(kind: Encoding, space: &ParamSpace, examples: &[&[f64]]) -> Self {
        let mut features = Vec::new();
        let slots = space
            .slots()
            .map(|slot| {
                let (low, high) = space.search_range(slot);
                let values = examples.iter().map(|values| values[slot.index()]);
                let span = values.fold((low, high), |(a, b), v| (a.min(v), b.max(v)));
                match kind {
                    Encoding::Declared => SlotCode::declared(space, slot, span, &mut features),
                    Encoding::Raw => SlotCode::raw(space, slot, &mut features),
                }
            })
            .collect();
        Self { slots, features, kind }
    }

    /// The features in order: those of one slot stand together, slots in their own order.
    #[must_use]
    pub fn features(&self) -> &[Feature] {
        &self.features
    }

    /// Which kind of coding this is.
    #[must_use]
    pub const fn kind(&self) -> Encoding {
        self.kind
    }

    /// The features of a list of values, one per slot, each allowed by its declaration.
    #[must_use]
    pub fn encode(&self, generator: &dyn Generator, values: &[f64]) -> Code {
        let mut code = vec![None; self.features.len()];
        for ((slot, coder), &value) in (0..).map(Slot::new).zip(&self.slots).zip(values) {
            if self.kind == Encoding::Raw || generator.is_active(values, slot) {
                coder.encode(value, &mut code);
            }
        }
        Code { values: code }
    }

    /// The value of `slot` that fits its features best: valid by kind and range, and
    /// rounded to twelve digits, since 0.55 reads better than 0.5499999999999999. `None` if its
    /// features are missing.
    ///
    /// `features` are all features, of which only those of the slot are read.
    #[must_use]
    pub fn decode(&self, space: &ParamSpace, slot: Slot, features: &[Option<f64>]) -> Option<f64> {
        self.slots[slot.index()].decode(features).map(|value| space.kind_of(slot).repair(rounded(value)))
    }

    /// The numbers of the features of `slot`.
    #[must_use]
    pub fn features_of(&self, slot: Slot) -> std::ops::Range<usize> {
        self.slots[slot.index()].features()
    }
}

/// To twelve significant digits.
fn rounded(value: f64) -> f64 {
    if !value.is_finite() {
        return value;
    }
    if value.abs() < 1e-200 {
        return 0.0;
    }
    let digits = 11 - math::log10(value.abs()).floor() as i32;
    let power = math::powi(10.0, digits.abs());
    if digits >= 0 { (value * power).round() / power } else { (value / power).round() * power }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::fifteen;
    use proptest::prelude::*;

    fn coding() -> (pleach_tree::Species, Coding) {
        let all = fifteen();
        let values: Vec<&[f64]> = all.iter().map(|s| s.params.values()).collect();
        let aspen = all[0].clone();
        let coding = Coding::new(Encoding::Declared, aspen.generator.space(), &values);
        (aspen, coding)
    }

    fn feature(coding: &Coding, name: &str) -> usize {
        coding.features().iter().position(|f| f.name == name).unwrap_or_else(|| {
            panic!(
                "no feature `{name}` in {:?}",
                coding.features().iter().map(|f| &f.name).collect::<Vec<_>>()
            )
        })
    }

    #[test]
    fn every_number_of_every_species_survives_its_code() {
        for kind in [Encoding::Declared, Encoding::Raw] {
            let all = fifteen();
            let values: Vec<&[f64]> = all.iter().map(|s| s.params.values()).collect();
            let space = all[0].generator.space();
            let coding = Coding::new(kind, space, &values);
            for species in &all {
                let values = species.params.values();
                let code = coding.encode(species.generator.as_ref(), values);
                for slot in space.slots() {
                    match coding.decode(space, slot, &code.values) {
                        Some(value) => {
                            let off = (value - species.params.get(slot)).abs();
                            let (name, slot_name) = (&species.name, space.slot_name(slot));
                            assert!(off < 1e-9 * value.abs().max(1.0), "{name} {slot_name}: {value}");
                        }
                        None => assert!(!species.generator.is_active(values, slot)),
                    }
                }
            }
        }
    }

    #[test]
    fn a_flag_has_a_switch_and_two_magnitudes() {
        let (aspen, coding) = coding();
        let space = aspen.generator.space();
        let slot = space.select("down_angle_v[1]").unwrap()[0];
        let [switch, plus, minus] = coding.features_of(slot).collect::<Vec<_>>()[..] else { panic!() };
        let mut values = aspen.params.values().to_vec();
        let mut code_of = |v: f64| {
            values[slot.index()] = v;
            let code = coding.encode(aspen.generator.as_ref(), &values).values;
            (code[switch], code[plus], code[minus])
        };
        // The search range is −90 to 30 degrees.
        assert_eq!(code_of(-45.0), (Some(1.0), None, Some(0.5)));
        assert_eq!(code_of(15.0), (Some(0.0), Some(0.5), None));
        assert_eq!(code_of(0.0), (Some(0.0), Some(0.0), Some(0.0)));
    }

    #[test]
    fn taper_is_split_into_its_regimes() {
        let (palm, coding) = (crate::testing::species("palm"), coding().1);
        let code = coding.encode(palm.generator.as_ref(), palm.params.values());
        let parts: Vec<f64> = ["taper[0] to 1", "taper[0] 1 to 2", "taper[0] from 2"]
            .iter()
            .map(|name| code.values[feature(&coding, name)].unwrap())
            .collect();
        // 2.15: through the first two regimes and 0.15 of the way to the search range's end at 2.4.
        assert_eq!(parts[..2], [1.0, 1.0]);
        assert!((parts[2] - 0.15 / 0.4).abs() < 1e-12);
    }

    #[test]
    fn levels_that_a_species_has_not_are_missing() {
        let (palm, coding) = (crate::testing::species("palm"), coding().1);
        let code = coding.encode(palm.generator.as_ref(), palm.params.values());
        for name in ["length[2]", "taper[3] to 1", "curve[2]", "blossom_scale", "prune_width"] {
            assert_eq!(code.values[feature(&coding, name)], None, "{name}");
        }
        assert!(code.values[feature(&coding, "length[1]")].is_some());
    }

    #[test]
    fn rounding_drops_the_noise_of_the_last_bits_only() {
        assert_eq!(
            [0.549_999_999_999_999_9, 97.999_999_999_999_99, -1e-300, 0.0].map(rounded),
            [0.55, 98.0, 0.0, 0.0]
        );
        assert_eq!(rounded(16.124_515_496_597_1), 16.124_515_496_6);
    }

    #[test]
    fn units_are_comparable() {
        let (aspen, coding) = coding();
        let code = coding.encode(aspen.generator.as_ref(), aspen.params.values());
        let height = code.values[feature(&coding, "g_scale")].unwrap();
        assert!((height - (13.0_f64 / 4.0).ln() / (45.0_f64 / 4.0).ln()).abs() < 1e-12, "a log of 4 to 45 m");
        // Searched by ratio like a logarithm, averaged by difference.
        let base = code.values[feature(&coding, "base_size[0]")].unwrap();
        assert!((base - (0.3 - 0.01) / 0.95).abs() < 1e-12, "a length of 0.01 to 0.96: {base}");
        let branches = code.values[feature(&coding, "branches[1] where > 0")].unwrap();
        assert!((branches - 51.0_f64.ln() / 251.0_f64.ln()).abs() < 1e-12, "1 + n, a log of 1 to 251");
        let chosen = code.values[feature(&coding, "shape = tend_flame")].unwrap();
        assert!((chosen - 0.5_f64.sqrt()).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn any_features_give_allowed_values(features in proptest::collection::vec(-3.0..3.0_f64, 200)) {
            let (aspen, coding) = coding();
            let space = aspen.generator.space();
            let features: Vec<Option<f64>> = features.into_iter().map(Some).collect();
            prop_assert!(coding.features().len() <= features.len());
            let values = space.slots().map(|s| coding.decode(space, s, &features).unwrap()).collect();
            prop_assert!(space.check(values).is_ok());
        }
    }
}
