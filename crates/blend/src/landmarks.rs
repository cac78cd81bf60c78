//! The species that a map or a blend is made of, and averaging them.

use crate::coding::{Code, Coding, Encoding};
use crate::error::BlendError;
use pleach_tree::Appearance;
use pleach_tree::param::Effect;
use pleach_tree::{CheckedParams, ParamSpace, Slot, Species};
use std::sync::Arc;

/// How much of each landmark is in a blend: 0 or more each, 1 together.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights(Vec<f64>);

impl Weights {
    /// All of landmark number `index` out of `count`.
    ///
    /// # Panics
    /// If `index` is not below `count`.
    #[must_use]
    pub fn only(index: usize, count: usize) -> Self {
        let mut weights = vec![0.0; count];
        weights[index] = 1.0;
        Self(weights)
    }

    /// From shares that are 0 or more and not all 0; they are divided by their sum.
    pub(crate) fn from_shares(mut shares: Vec<f64>) -> Self {
        let sum: f64 = shares.iter().sum();
        debug_assert!(sum > 0.0 && sum.is_finite());
        shares.iter_mut().for_each(|share| *share /= sum);
        Self(shares)
    }

    /// One weight per landmark, in their order.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.0
    }

    /// The nearest weights that are whole numbers of thirds: those of the counts of a blend. Nearest by
    /// largest remainders; the first of equals.
    #[must_use]
    pub fn quantized(&self) -> Self {
        const PARTS: f64 = 3.0;
        let scaled: Vec<f64> = self.0.iter().map(|w| w * PARTS).collect();
        let mut whole: Vec<f64> = scaled.iter().map(|s| s.floor()).collect();
        let missing = PARTS - whole.iter().sum::<f64>();
        let mut order: Vec<usize> = (0..scaled.len()).collect();
        let rest = |i: usize| scaled[i] - scaled[i].floor();
        order.sort_by(|&a, &b| rest(b).total_cmp(&rest(a)).then(a.cmp(&b)));
        order.iter().take(missing.round() as usize).for_each(|&i| whole[i] += 1.0);
        Self::from_shares(whole)
    }

    /// The landmark with the largest weight, the first of equals.
    #[must_use]
    pub fn dominant(&self) -> usize {
        let mut best = 0;
        for (i, &weight) in self.0.iter().enumerate() {
            if weight > self.0[best] {
                best = i;
            }
        }
        best
    }

    /// The landmarks that take part, each with its weight.
    pub fn present(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.0.iter().copied().enumerate().filter(|(_, w)| *w > 0.0)
    }
}

/// At least two species of one generator, and their features.
#[derive(Clone, Debug)]
pub struct Landmarks {
    species: Vec<Species>,
    coding: Coding,
    codes: Vec<Code>,
    /// Whether a slot matters to a landmark: `active[landmark][slot]`.
    active: Vec<Vec<bool>>,
    /// Whether a slot changes in steps, with all others that arrange parts.
    arranges: Vec<bool>,
}

impl Landmarks {
    /// Checks that `species` can be compared, and codes them.
    ///
    /// # Errors
    /// Fewer than two, not all of one generator with the same parameters, two of one name, or all
    /// with the same numbers.
    pub fn new(species: Vec<Species>, features: Encoding) -> Result<Self, BlendError> {
        let [first, second, ..] = species.as_slice() else {
            return Err(BlendError::TooFew { found: species.len() });
        };
        let space = first.generator.space();
        for (i, other) in species.iter().enumerate() {
            if other.generator.model() != first.generator.model() || other.generator.space() != space {
                return Err(BlendError::MixedGenerators {
                    first: first.name.clone(),
                    first_model: first.generator.model(),
                    second: other.name.clone(),
                    second_model: other.generator.model(),
                });
            }
            if species[..i].iter().any(|earlier| earlier.name == other.name) {
                return Err(BlendError::SameName { name: other.name.clone() });
            }
        }
        if species.iter().all(|other| other.params == first.params) {
            let (first, second) = (first.name.clone(), second.name.clone());
            return Err(BlendError::AllAlike { first, second });
        }
        let values: Vec<&[f64]> = species.iter().map(|s| s.params.values()).collect();
        let coding = Coding::new(features, space, &values);
        let codes = species.iter().map(|s| coding.encode(s.generator.as_ref(), s.params.values())).collect();
        let active_of = |s: &Species| {
            let is_active =
                |slot| features == Encoding::Raw || s.generator.is_active(s.params.values(), slot);
            space.slots().map(is_active).collect()
        };
        let active = species.iter().map(active_of).collect();
        let arranges = |slot| features == Encoding::Declared && space.effect_of(slot) == Effect::Layout;
        let arranges = space.slots().map(arranges).collect();
        Ok(Self { species, coding, codes, active, arranges })
    }

    /// The species, in the order given.
    #[must_use]
    pub fn species(&self) -> &[Species] {
        &self.species
    }

    /// How their numbers become features.
    #[must_use]
    pub const fn coding(&self) -> &Coding {
        &self.coding
    }

    /// Their features, in the same order.
    #[must_use]
    pub fn codes(&self) -> &[Code] {
        &self.codes
    }

    /// The parameters that all of them share.
    #[must_use]
    pub fn space(&self) -> &Arc<ParamSpace> {
        self.species[0].generator.space()
    }

    /// The landmark called `name`.
    ///
    /// # Errors
    /// [`BlendError::UnknownSpecies`], with the nearest name.
    pub fn named(&self, name: &str) -> Result<usize, BlendError> {
        self.species.iter().position(|s| s.name == name).ok_or_else(|| {
            let names = self.species.iter().map(|s| s.name.as_str());
            BlendError::UnknownSpecies {
                name: name.to_owned(),
                nearest: pleach_tree::param::nearest(name, names),
            }
        })
    }

    /// Weights from shares in any unit, one per landmark.
    ///
    /// # Errors
    /// The wrong number of them, one below 0 or not finite, or all 0.
    pub fn weights(&self, shares: &[f64]) -> Result<Weights, BlendError> {
        if shares.len() != self.species.len() {
            return Err(BlendError::WeightCount { expected: self.species.len(), found: shares.len() });
        }
        for (species, &value) in self.species.iter().zip(shares) {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(BlendError::BadWeight { name: species.name.clone(), value });
            }
        }
        let most = shares.iter().copied().fold(0.0, f64::max);
        if most == 0.0 {
            return Err(BlendError::NoWeight);
        }
        // By the largest first, so that the sum of huge shares stays finite.
        Ok(Weights::from_shares(shares.iter().map(|share| share / most).collect()))
    }

    /// Weights of two landmarks: all of `first` at 0, all of `second` at 1.
    ///
    /// # Errors
    /// [`BlendError::NotBetween`] outside `0.0..=1.0`.
    pub fn between(&self, first: usize, second: usize, at: f64) -> Result<Weights, BlendError> {
        if !(0.0..=1.0).contains(&at) {
            return Err(BlendError::NotBetween { at });
        }
        let mut shares = vec![0.0; self.species.len()];
        shares[first] += 1.0 - at;
        shares[second] += at;
        Ok(Weights::from_shares(shares))
    }

    /// The average of the landmarks' features; each feature over those landmarks that have it,
    /// `None` where none has.
    #[must_use]
    pub fn average(&self, weights: &Weights) -> Vec<Option<f64>> {
        let mut sums = vec![(0.0, 0.0); self.coding.features().len()];
        for (landmark, weight) in weights.present() {
            for (sum, value) in sums.iter_mut().zip(&self.codes[landmark].values) {
                if let Some(value) = value {
                    sum.0 += weight * value;
                    sum.1 += weight;
                }
            }
        }
        sums.into_iter().map(|(sum, weight)| (weight > 0.0).then(|| sum / weight)).collect()
    }

    /// The blend of the landmarks: valid parameters.
    ///
    /// Real numbers change gradually with the weights. Choices and signs take the side with more
    /// weight among those landmarks to which they matter. Counts, and other numbers that arrange the
    /// layout of a tree ([`Effect::Layout`]), change together, by the nearest weights
    /// in [thirds](Weights::quantized): of 250 branches each one more would shuffle all the others, so
    /// they change in three larger steps and are constant in between. A slot on which all landmarks with weight
    /// agree keeps their number bit for bit, so all weight on one landmark gives that landmark exactly.
    #[must_use]
    pub fn mix(&self, weights: &Weights) -> CheckedParams {
        self.decode(weights, &self.average(weights), |_| false)
    }

    /// Like [`Landmarks::mix`], from features moved away from the average; `moved` tells which slots
    /// were.
    pub(crate) fn decode(
        &self,
        weights: &Weights,
        features: &[Option<f64>],
        moved: impl Fn(Slot) -> bool,
    ) -> CheckedParams {
        let space = self.space();
        let whole = weights.quantized();
        let whole_features = self.average(&whole);
        let dominant = weights.dominant();
        let mut params = self.species[dominant].params.clone();
        let values = space
            .slots()
            .map(|slot| {
                let arranges = self.arranges[slot.index()] && !moved(slot);
                let (weights, features) =
                    if arranges { (&whole, whole_features.as_slice()) } else { (weights, features) };
                let mut active = weights.present().filter(|(l, _)| self.active[*l][slot.index()]);
                // No species uses this slot: keep the nearest species' value.
                let Some((one, _)) = active.next() else { return params.get(slot) };
                let value = |landmark: usize| self.species[landmark].params.get(slot);
                if !moved(slot) && active.all(|(l, _)| value(l).to_bits() == value(one).to_bits()) {
                    return value(one);
                }
                self.coding.decode(space, slot, features).unwrap_or_else(|| value(dominant))
            })
            .collect::<Vec<f64>>();
        params.set(&values).expect("decoded values are repaired by their kinds");
        params
    }

    /// A species called `name` with these parameters, and an appearance
    /// [blended](pleach_tree::Appearance::blend) by the weights: everything else beside the
    /// numbers is that of the landmark with the largest weight.
    #[must_use]
    pub fn species_of(&self, weights: &Weights, params: CheckedParams, name: &str) -> Species {
        let nearest = &self.species[weights.dominant()];
        let looks: Vec<_> = weights.present().map(|(l, w)| (&self.species[l].appearance, w)).collect();
        Species {
            name: name.to_owned(),
            description: self.describe(weights),
            params,
            tree_seed: None,
            appearance: Appearance::blend(&looks),
            ..nearest.clone()
        }
    }

    /// The recipe in words, the largest part first: `0.6 silver_birch, 0.4 quaking_aspen`. Parts below
    /// half a per cent are left out.
    #[must_use]
    pub fn describe(&self, weights: &Weights) -> String {
        let mut parts: Vec<(usize, f64)> = weights.present().filter(|(_, w)| *w >= 0.005).collect();
        parts.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let parts =
            parts.iter().map(|(l, w)| format!("{} {}", (w * 100.0).round() / 100.0, self.species[*l].name));
        parts.collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{fifteen, species};

    fn pair(first: &str, second: &str) -> Landmarks {
        Landmarks::new(vec![species(first), species(second)], Encoding::Declared).unwrap()
    }

    fn value(params: &CheckedParams, landmarks: &Landmarks, slot: &str) -> f64 {
        params.get(landmarks.space().select(slot).unwrap()[0])
    }

    #[test]
    fn all_weight_on_one_gives_it_exactly() {
        for kind in [Encoding::Declared, Encoding::Raw] {
            let landmarks = Landmarks::new(fifteen(), kind).unwrap();
            for (i, species) in landmarks.species().iter().enumerate() {
                assert_eq!(landmarks.mix(&Weights::only(i, 15)), species.params, "{}", species.name);
            }
        }
    }

    #[test]
    fn halfway_is_the_mean_of_reals_and_of_logarithms() {
        let two = pair("quaking_aspen", "silver_birch");
        let mix = two.mix(&two.between(0, 1, 0.5).unwrap());
        assert!((value(&mix, &two, "ratio_power") - 1.35).abs() < 1e-12);
        assert!((value(&mix, &two, "g_scale") - (13.0_f64 * 20.0).sqrt()).abs() < 1e-9);
        assert!((value(&mix, &two, "tropism.z") + 0.75).abs() < 1e-12);
        // 50 and 30 branches: the cube root of 51 · 51 · 31, less 1, is 42.2.
        let thirds = two.mix(&two.between(0, 1, 1.0 / 3.0).unwrap());
        assert_eq!(value(&thirds, &two, "branches[1]"), 42.0);
        assert_eq!(value(&mix, &two, "ratio"), 0.015, "what both agree on stays");
    }

    #[test]
    fn what_one_species_has_not_comes_from_the_other() {
        let two = pair("palm", "silver_birch");
        for at in [0.1, 0.4, 0.6, 0.9] {
            let mix = two.mix(&two.between(0, 1, at).unwrap());
            // The palm's zeros for levels that it has not are never read.
            if value(&mix, &two, "levels") > 2.0 {
                assert_eq!(value(&mix, &two, "length[2]"), 0.4, "at {at}");
                assert_eq!(value(&mix, &two, "taper[2]"), 1.0, "at {at}");
            }
            let taper = value(&mix, &two, "taper[0]");
            assert!((taper - (2.15 - 1.15 * at)).abs() < 1e-9, "at {at}: {taper}");
        }
    }

    #[test]
    fn signs_and_choices_switch_in_the_middle_and_magnitudes_do_not_mix() {
        let two = pair("palm", "quaking_aspen");
        // Leaves to two sides at 120 degrees on the palm, round the twig by 140 on the aspen.
        for (at, rotate, shape) in
            [(0.1, -120.0, 3.0), (0.49, -120.0, 3.0), (0.51, 140.0, 7.0), (0.9, 140.0, 7.0)]
        {
            let mix = two.mix(&two.between(0, 1, at).unwrap());
            assert_eq!(value(&mix, &two, "rotate[2]"), rotate, "at {at}");
            assert_eq!(value(&mix, &two, "shape"), shape, "at {at}");
        }
    }

    #[test]
    fn colours_blend_with_the_numbers() {
        let two = pair("quaking_aspen", "black_oak");
        let at = |part: f64| {
            let weights = two.between(0, 1, part).unwrap();
            two.species_of(&weights, two.mix(&weights), "mix").appearance
        };
        assert_eq!(at(0.0), two.species()[0].appearance);
        assert_eq!(at(1.0), two.species()[1].appearance);
        let light = |part: f64| at(part).bark.map(|color| color.0[1]).unwrap();
        assert!(light(0.0) > light(0.25) && light(0.25) > light(0.75) && light(0.75) > light(1.0));
        assert_eq!(at(0.4).bark_pattern, two.species()[0].appearance.bark_pattern);
        assert_eq!(at(0.6).bark_pattern, two.species()[1].appearance.bark_pattern);
    }

    #[test]
    fn weights_are_shares() {
        let two = pair("palm", "quaking_aspen");
        assert_eq!(two.weights(&[3.0, 1.0]).unwrap().values(), [0.75, 0.25]);
        assert_eq!(two.weights(&[1e308, 1e308]).unwrap().values(), [0.5, 0.5]);
        let quarter = two.between(0, 1, 0.25).unwrap();
        assert_eq!(two.mix(&two.weights(&[3.0, 1.0]).unwrap()), two.mix(&quarter));
        assert_eq!(two.describe(&quarter), "0.75 palm, 0.25 quaking_aspen");
    }

    #[test]
    fn what_cannot_be_blended_is_told() {
        let two = pair("palm", "quaking_aspen");
        assert!(
            matches!(two.weights(&[-1.0, 2.0]), Err(BlendError::BadWeight { value, .. }) if value == -1.0)
        );
        assert!(matches!(two.weights(&[f64::NAN, 2.0]), Err(BlendError::BadWeight { .. })));
        assert!(matches!(two.weights(&[f64::INFINITY, 2.0]), Err(BlendError::BadWeight { .. })));
        assert_eq!(two.weights(&[0.0, 0.0]), Err(BlendError::NoWeight));
        assert_eq!(two.weights(&[1.0]), Err(BlendError::WeightCount { expected: 2, found: 1 }));
        assert_eq!(two.between(0, 1, 2.0), Err(BlendError::NotBetween { at: 2.0 }));
        assert!(two.between(0, 1, f64::NAN).is_err());
        let message = two.named("quaking_aspn").unwrap_err().to_string();
        assert!(message.contains("did you mean `quaking_aspen`"), "{message}");

        let one = |species| Landmarks::new(species, Encoding::Declared).map(|_| ()).unwrap_err();
        assert_eq!(one(vec![species("palm")]), BlendError::TooFew { found: 1 });
        assert_eq!(
            one(vec![species("palm"), species("palm")]),
            BlendError::SameName { name: "palm".to_owned() }
        );
        let solid =
            "name = \"cut\"\nprune_obstacles = [{ shape = \"sphere\", center = [0, 0, 9], radius = 1 }]";
        let cut = pleach_generators::read_text("cut", solid).unwrap();
        let other = Species { name: "twice".to_owned(), ..cut.clone() };
        let mixed = one(vec![species("palm"), cut.clone()]);
        assert!(mixed.to_string().contains("weber-penn and `cut` by another model of weber-penn"), "{mixed}");
        assert!(matches!(one(vec![cut, other]), BlendError::AllAlike { .. }), "the same solids go together");
        let mut twin = species("palm");
        twin.name = "twin".to_owned();
        let (first, second) = ("palm".to_owned(), "twin".to_owned());
        assert_eq!(one(vec![species("palm"), twin]), BlendError::AllAlike { first, second });
    }
}
