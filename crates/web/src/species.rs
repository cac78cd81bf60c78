//! Species, and their numbers.

use crate::error::{thrown, thrown_at};
use crate::grammar_text::line_of;
use crate::tree::Tree;
use pleach::random::Key;
use pleach::{Foliage, Freedom, Gene, Genome, Growth, SearchSpace, TreeSeed};
use serde_json::json;
use std::sync::Arc;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

/// A kind of tree. It never changes: what would change it gives another.
#[wasm_bindgen]
pub struct Species {
    pub(crate) inner: Arc<pleach::Species>,
}

impl From<pleach::Species> for Species {
    fn from(species: pleach::Species) -> Self {
        Self { inner: Arc::new(species) }
    }
}

/// Largest seed that a number of JavaScript holds exactly.
const MAX_SEED: f64 = 9_007_199_254_740_991.0;

/// A seed from a number of JavaScript.
pub(crate) fn seed(number: f64) -> Result<u64, JsError> {
    if (0.0..=MAX_SEED).contains(&number) && number.fract() == 0.0 {
        return Ok(number as u64);
    }
    Err(thrown(format!("the seed is {number}, expected a whole number from 0 to {MAX_SEED}")))
}

/// What the draws of a throw of the dice are for.
const TAKES_ANOTHER: u32 = 1;
const WHERE: u32 = 2;
/// The share of choices that the strongest throw changes.
const CHOICES: f64 = 0.5;

#[wasm_bindgen]
impl Species {
    /// A known species.
    pub fn named(name: &str) -> Result<Self, JsError> {
        // A page has no files, so that a path is an unknown name.
        if pleach::species_names().contains(&name) {
            return Ok(pleach::species(name).map_err(thrown)?.into());
        }
        Err(thrown(format!("there is no species `{name}`")))
    }

    /// Reads the text of a species file; `name` is what errors call it.
    pub fn read(text: &str, name: &str) -> Result<Self, JsError> {
        Ok(pleach::read_species(text.as_bytes(), name).map_err(thrown)?.into())
    }

    /// Name, description, generator, tree seed, and how many stems have draws of their own: JSON.
    #[must_use]
    pub fn info(&self) -> String {
        let species = &self.inner;
        json!({
            "name": species.name,
            "description": species.description,
            "generator": species.generator.family(),
            "tree_seed": species.tree_seed,
            "own_draws": species.individual().map_or(0, pleach::Individual::len),
            "seasons": pleach::Season::NAMES,
        })
        .to_string()
    }

    /// What is declared about every parameter: JSON with the keys of `pleach params --json`.
    #[must_use]
    pub fn declared(&self) -> String {
        json!(self.inner.generator.space().as_ref()).to_string()
    }

    /// One number for every slot.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.inner.params.values().to_vec()
    }

    /// 1 for every slot that has an effect beside the others' present values.
    #[must_use]
    pub fn active(&self) -> Vec<u8> {
        let (generator, values) = (&self.inner.generator, self.inner.params.values());
        generator.space().slots().map(|slot| u8::from(generator.is_active(values, slot))).collect()
    }

    /// The same with other numbers.
    pub fn with_values(&self, values: Vec<f64>) -> Result<Self, JsError> {
        let params = self.inner.generator.space().check(values).map_err(thrown)?;
        Ok(pleach::Species { params, ..(*self.inner).clone() }.into())
    }

    /// The same under another name.
    pub fn named_as(&self, name: &str) -> Result<Self, JsError> {
        pleach::species::check_name(name).map_err(thrown)?;
        Ok(pleach::Species { name: name.to_owned(), ..(*self.inner).clone() }.into())
    }

    /// The same with the seed of the tree that is meant, or without.
    pub fn with_tree_seed(&self, tree_seed: Option<f64>) -> Result<Self, JsError> {
        let tree_seed = tree_seed.map(seed).transpose()?;
        Ok(pleach::Species { tree_seed, ..(*self.inner).clone() }.into())
    }

    /// Throws the dice within what is natural: numbers that have an effect move by up to `strength` of their
    /// plausible range, and some choices change. Slots with a 1 in `locked` stay.
    pub fn dice(&self, throw: f64, locked: &[u8], strength: f64) -> Result<Self, JsError> {
        let (generator, values) = (&self.inner.generator, self.inner.params.values());
        let (freedom, space) = (Freedom::default(), generator.space());
        let space = SearchSpace::from_params(Arc::clone(space), values, &freedom, TreeSeed::Fixed(1));
        let space = space.map_err(thrown)?.plausible(values);
        let (key, strength) = (Key::root(seed(throw)?), strength.clamp(0.0, 1.0));
        let mut thrown_list = Genome::new(values.to_vec(), 1);
        for (gene, slot) in space.genes().iter().filter_map(|gene| Some((gene, gene.slot()?))) {
            let is_locked = locked.get(slot.index()).is_some_and(|&locked| locked != 0);
            if !is_locked && generator.is_active(values, slot) {
                let value = moved(gene, values[slot.index()], key, slot.index() as u32, strength);
                gene.set(&mut thrown_list, value);
            }
        }
        self.with_values(thrown_list.values)
    }

    /// Between this species and `other`, of the same generator: 0 is this one, 1 the other.
    pub fn blended(&self, other: &Self, at: f64, name: &str) -> Result<Self, JsError> {
        if !(0.0..=1.0).contains(&at) {
            return Err(thrown(format!("the place between the species is {at}, expected from 0 to 1")));
        }
        pleach::species::check_name(name).map_err(thrown)?;
        let ends = [self, other].map(|end| (*end.inner).clone()).to_vec();
        let percent = |share: f64, of: &Self| format!("{:.0} % {}", 100.0 * share, of.inner.name);
        let description = format!("{}, {}", percent(1.0 - at, self), percent(at, other));
        let mixed = pleach::mix(ends, &[1.0 - at, at], name).map_err(thrown)?;
        Ok(pleach::Species { description, ..mixed }.into())
    }

    /// The text of the species file.
    #[must_use]
    pub fn to_toml(&self) -> String {
        self.inner.to_toml(&[])
    }

    /// Grows the tree of a seed; unless `leaves` says otherwise, with leaves if the species has them.
    pub fn grow(&self, tree_seed: f64, leaves: Option<bool>) -> Result<Tree, JsValue> {
        let seed = seed(tree_seed)?;
        let refused = |error| thrown_at(&error, line_of(&self.inner, &error));
        let foliage = match leaves {
            None => self.inner.foliage,
            Some(true) => Foliage::All,
            Some(false) => Foliage::None,
        };
        let tree = self.inner.grow_with(&Growth { foliage, ..Growth::seed(seed) }).map_err(refused)?;
        Ok(Tree { species: Arc::clone(&self.inner), seed, inner: tree })
    }
}

/// Where a throw puts `value`.
fn moved(gene: &Gene, value: f64, key: Key, index: u32, strength: f64) -> f64 {
    if gene.is_choice() {
        let takes_another = key.unit(TAKES_ANOTHER, index) < CHOICES * strength;
        let other = gene.low + (key.unit(WHERE, index) * gene.count()).floor();
        return if takes_another { gene.clamp(other) } else { value };
    }
    // From the middle of what is left to both sides, so that a number at its end does not stay there.
    let (here, there) = (gene.to_unit(value), key.unit(WHERE, index));
    gene.from_unit(here + strength * (there - here))
}
