//! What was learnt about several species.

use super::basis::Basis;
use super::examples::{Example, examples, features};
use super::numbers::Numbers;
use super::packed::Packed;
use crate::error::FitError;
use crate::posterior::{PosteriorNumber, PosteriorSettings, Prior};
use crate::space::Freedom;
use pleach_silhouette::Bitmap;
use pleach_tree::{Fnv, Foliage, Species};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Directions in which pictures are compared: with twice as many hardly more of a number is explained.
const DIRECTIONS: usize = 128;
/// Trees of each species from which the directions are learnt.
const FOR_DIRECTIONS: u32 = 300;

/// The share of the trees around a species that are at least as strange as a picture that is taken for one of them without
/// reserve.
const FAMILIAR: f64 = 0.2;

/// The numbers of trees from their pictures, for several species.
///
/// Around each species trees of a [`Prior`] are grown and drawn from the front. Of a picture the amounts that likeness
/// compares are taken, as roots, along the 128 directions in which those of all species vary most (principal
/// components); each number is a linear function of these (ridge regression), learnt for trees with leaves and without.
/// Networks of one and two hidden layers, and squares and products of the coordinates, explained no more of the numbers of
/// as many trees.
#[derive(Clone, Debug)]
pub struct Predictors {
    basis: Arc<Basis>,
    /// By species and foliage.
    known: Arc<BTreeMap<u64, Numbers>>,
}

/// As it is kept.
#[derive(Serialize, Deserialize)]
struct Stored {
    directions: Directions,
    known: Vec<(u64, Numbers)>,
}

/// A [`Basis`] as it is kept.
#[derive(Serialize, Deserialize)]
struct Directions {
    means: Vec<f32>,
    directions: Vec<Packed>,
}

impl From<&Basis> for Directions {
    fn from(basis: &Basis) -> Self {
        Self {
            means: basis.means.iter().map(|&mean| mean as f32).collect(),
            directions: basis.directions.iter().map(|one| Packed::new(one)).collect(),
        }
    }
}

impl From<&Directions> for Basis {
    fn from(kept: &Directions) -> Self {
        Self {
            means: kept.means.iter().copied().map(f64::from).collect(),
            directions: kept.directions.iter().map(|one| one.numbers().collect()).collect(),
        }
    }
}

/// What a picture says about the numbers of its tree, if that is one around a known species.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The name of the species.
    pub species: String,
    /// Every number that varies in the prior, in the order of the slots, of a tree as high as the one in the picture.
    pub numbers: Vec<PosteriorNumber>,
    /// The share of the trees around the species whose pictures are at least as far from all others of them, in 0..=1. Near
    /// 0 the picture is not of such a tree, and the intervals cannot be trusted.
    pub familiarity: f64,
}

/// Keeps what [`Predictors::record`] has learnt, so that a run that was stopped goes on where it was. What is kept is
/// that of the same species, trees and program: nothing of it is checked.
pub trait LearntParts {
    /// The part of this `name`, if it is kept.
    fn load(&self, name: &str) -> Option<Vec<u8>>;
    /// Keeps a part.
    fn save(&self, name: &str, part: &[u8]);
}

/// Keeps nothing.
impl LearntParts for () {
    fn load(&self, _: &str) -> Option<Vec<u8>> {
        None
    }

    fn save(&self, _: &str, _: &[u8]) {}
}

/// The bytes are not of this version.
#[derive(Debug, thiserror::Error)]
#[error("no predictors of this version")]
pub struct PredictorError;

const FOLIAGE: [Foliage; 2] = [Foliage::All, Foliage::None];

impl Predictors {
    /// Learns from `trees` trees around each of `species`, at most [`PosteriorSettings::MAX_TREES`], with leaves and again
    /// without, and returns bytes for [`Predictors::from_bytes`]: a hundred kB, and some five for each species and kind
    /// of foliage. What `parts` keep is not learnt again. `notify` is told how many kinds of trees were learnt, and of
    /// how many.
    ///
    /// # Errors
    /// A species whose numbers cannot vary, [`FitError::Interrupted`] once `stop` is raised.
    ///
    /// # Panics
    /// None: numbers can be stored.
    pub fn record(
        species: &[Species],
        trees: u64,
        parts: &dyn LearntParts,
        stop: &AtomicBool,
        mut notify: impl FnMut(usize, usize),
    ) -> Result<Vec<u8>, FitError> {
        let trees = u32::try_from(trees.min(PosteriorSettings::MAX_TREES as u64)).unwrap_or(u32::MAX);
        let mut kinds = Vec::new();
        for one in species {
            for foliage in FOLIAGE {
                let one = Species { foliage, ..one.clone() };
                kinds.push((key(&one, foliage), Prior::new(&one, &Freedom::default(), Prior::SPREAD)?));
            }
        }
        // What is stored is what coordinates are taken by, then and now.
        let mut first: Vec<Vec<Example>> = Vec::new();
        let directions = kept(parts, "directions", || {
            for (_, prior) in &kinds {
                first.push(examples(prior, 0..trees.min(FOR_DIRECTIONS), stop)?);
            }
            let rows = first.iter().flatten().map(|example| example.features.clone()).collect();
            Ok(Directions::from(&Basis::learn(rows, DIRECTIONS)))
        })?;
        let basis = Basis::from(&directions);
        let mut first = first.into_iter();
        let mut known = Vec::new();
        for (done, (key, prior)) in kinds.iter().enumerate() {
            if stop.load(Ordering::Relaxed) {
                return Err(FitError::Interrupted);
            }
            let mut some = first.next().unwrap_or_default();
            let learn = || {
                // All of them, if the directions were kept.
                let from = if some.is_empty() { 0 } else { trees.min(FOR_DIRECTIONS) };
                some.extend(examples(prior, from..trees, stop)?);
                Ok(Numbers::learn(prior, &basis, &some))
            };
            known.push((*key, kept(parts, &format!("{key:016x}"), learn)?));
            notify(done + 1, kinds.len());
        }
        Ok(postcard::to_allocvec(&Stored { directions, known }).expect("numbers can be stored"))
    }

    /// Reads the bytes of [`Predictors::record`].
    ///
    /// # Errors
    /// [`PredictorError`] for other bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PredictorError> {
        let Stored { directions, known } = postcard::from_bytes(bytes).map_err(|_| PredictorError)?;
        let Directions { means, directions: rows } = &directions;
        let is_whole = means.iter().all(|mean| mean.is_finite())
            && rows.iter().all(|one| one.len() == means.len() && one.is_finite())
            && known.iter().all(|(_, numbers)| numbers.are_sums_over(rows.len()));
        if !is_whole {
            return Err(PredictorError);
        }
        let basis = Basis::from(&directions);
        Ok(Self { basis: Arc::new(basis), known: Arc::new(known.into_iter().collect()) })
    }

    /// The number of species.
    #[must_use]
    pub fn species(&self) -> usize {
        self.known.len() / FOLIAGE.len()
    }

    /// The numbers of the tree in `picture`, for every one of `species` that is known: one value per slot, as in species
    /// files, of a tree of any height. `None` for others, and where nothing is seen.
    pub fn predict<'a>(
        &self,
        picture: &Bitmap,
        foliage: Foliage,
        species: impl IntoIterator<Item = &'a Species>,
    ) -> Vec<Option<Vec<f64>>> {
        let at = self.coordinates(picture);
        let of = |species: &Species| {
            let (numbers, prior) = self.known(species, foliage)?;
            Some(numbers.predict(species.params.values(), prior.genes(), at.as_ref()?))
        };
        species.into_iter().map(of).collect()
    }

    /// What `picture`, whose pixels have sides of `meters_per_pixel`, says about the numbers of its tree, if that is one
    /// around `species`: for each number that varies in the prior an interval before and since, of a tree as high as the
    /// one in the picture. `None` where `species` is not known and where nothing is seen.
    ///
    /// Over trees of the prior an interval holds the truth nine times in ten; the shape of the spread is the same for all
    /// pictures. [`crate::PosteriorModel`] learns the same for the very views of a fit, and draws samples.
    #[must_use]
    pub fn answer(
        &self,
        picture: &Bitmap,
        meters_per_pixel: f64,
        foliage: Foliage,
        species: &Species,
    ) -> Option<Answer> {
        let (numbers, prior) = self.known(species, foliage)?;
        let (_, top, _, bottom) = picture.ink_box()?;
        let height = f64::from(bottom + 1 - top) * meters_per_pixel;
        let at = self.coordinates(picture)?;
        Some(Answer {
            species: species.name.clone(),
            familiarity: numbers.familiarity(&at),
            numbers: numbers.answer(species, &prior, height, &at),
        })
    }

    /// How probable `picture` is among the pictures of trees around each of `species`, up to a constant: logarithms, of
    /// amounts that depend on each other as if they did not, so that differences are too large. `None` for a species
    /// that is not known.
    ///
    /// A picture that is strange to every species says nothing, and one that is nearly so says less: how far it is from
    /// each of them is then a matter of what is strange in it.
    pub(crate) fn log_densities<'a>(
        &self,
        picture: &Bitmap,
        foliage: Foliage,
        species: impl IntoIterator<Item = &'a Species>,
    ) -> Option<Vec<Option<f64>>> {
        let at = self.coordinates(picture)?;
        let known = species.into_iter().map(|species| self.known.get(&key(species, foliage)));
        let found: Vec<_> =
            known.map(|one| one.map(|one| (one.log_density(&at), one.familiarity(&at)))).collect();
        let (_, familiarity) = found.iter().flatten().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let weight = (familiarity / FAMILIAR).min(1.0);
        Some(found.into_iter().map(|one| Some(weight * one?.0)).collect())
    }

    fn known(&self, species: &Species, foliage: Foliage) -> Option<(&Numbers, Prior)> {
        let numbers = self.known.get(&key(species, foliage))?;
        Some((numbers, Prior::new(species, &Freedom::default(), Prior::SPREAD).ok()?))
    }

    fn coordinates(&self, picture: &Bitmap) -> Option<Vec<f64>> {
        let features = features(picture).filter(|features| features.len() == self.basis.means.len())?;
        Some(self.basis.coordinates(&features))
    }
}

/// What `parts` keep under `name`, or what `learn` returns, which is kept then.
fn kept<T: Serialize + DeserializeOwned>(
    parts: &dyn LearntParts,
    name: &str,
    learn: impl FnOnce() -> Result<T, FitError>,
) -> Result<T, FitError> {
    if let Some(part) = parts.load(name).and_then(|bytes| postcard::from_bytes(&bytes).ok()) {
        return Ok(part);
    }
    let part = learn()?;
    parts.save(name, &postcard::to_allocvec(&part).expect("numbers can be stored"));
    Ok(part)
}

fn key(species: &Species, foliage: Foliage) -> u64 {
    let (model, values) = (species.generator.model(), species.params.values());
    Fnv::hash(format!("{model} {values:?} {foliage:?}").as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_silhouette::{Frame, Rasterizer, View};
    use pleach_tree::Parts;
    use std::sync::Mutex;

    fn palm() -> Species {
        pleach_generators::preset("palm").unwrap().clone()
    }

    fn recorded(trees: u64) -> Vec<u8> {
        Predictors::record(&[palm()], trees, &(), &AtomicBool::new(false), |_, _| ()).unwrap()
    }

    fn picture(species: &Species, seed: u64) -> Bitmap {
        let tree = species.grow(seed).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 128, 128);
        let mut picture = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
        picture
    }

    #[test]
    fn what_is_learnt_comes_nearer_to_a_tree_than_its_species() {
        let predictors = Predictors::from_bytes(&recorded(400)).unwrap();
        assert_eq!(predictors.species(), 1);
        let (palm, freedom) = (palm(), Freedom::default());
        let prior = Prior::new(&palm, &freedom, Prior::SPREAD).unwrap();
        let slot = palm.params.space().select("base_size[0]").unwrap()[0].index();
        let own = palm.params.values()[slot];
        let (mut unfitted, mut fitted) = (0.0, 0.0);
        for number in 0..24 {
            let Some((truth, _)) = prior.sample(5, number) else { continue };
            let picture = picture(&truth, truth.tree_seed.unwrap());
            let found = predictors.predict(&picture, Foliage::All, [&palm]).remove(0).unwrap();
            let truth = truth.params.values()[slot];
            fitted += (found[slot] - truth).powi(2);
            unfitted += (own - truth).powi(2);
            assert!(palm.params.space().check(found).is_ok());
        }
        assert!(fitted < 0.6 * unfitted, "{fitted} {unfitted}");
    }

    #[test]
    fn intervals_hold_the_truth_nine_times_in_ten() {
        let predictors = Predictors::from_bytes(&recorded(800)).unwrap();
        let palm = palm();
        let prior = Prior::new(&palm, &Freedom::default(), Prior::SPREAD).unwrap();
        let (mut held, mut all, mut shrunk) = (0, 0, 0);
        let (mut familiar, mut trees) = (0, 0);
        for number in 0..60 {
            let Ok((truth, tree)) = prior.try_sample(5, number) else { continue };
            // As large as the pictures that were learnt from: in smaller ones all that is thin looks thicker.
            let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
            let mut picture = Bitmap::default();
            Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
            let answer = predictors.answer(&picture, frame.meters_per_pixel, Foliage::All, &palm).unwrap();
            familiar += usize::from(answer.familiarity >= 0.01);
            trees += 1;
            for PosteriorNumber { slot, prior, posterior, shrunk: how } in answer.numbers {
                let value = truth.params.values()[slot.index()];
                assert!(posterior.low <= posterior.median && posterior.median <= posterior.high);
                assert!((0.0..=1.0).contains(&how) && prior.low <= prior.high);
                // What was resized to the picture's height is known to a pixel of it only.
                held += usize::from((posterior.low - 1e-9..=posterior.high + 1e-9).contains(&value));
                all += 1;
                shrunk += usize::from(posterior.high - posterior.low < 0.8 * (prior.high - prior.low));
            }
        }
        let share = f64::from(held as u32) / f64::from(all as u32);
        assert!((0.86..0.95).contains(&share), "{share} of {all}");
        assert!(shrunk >= 60, "{shrunk}");
        assert!(familiar + 4 >= trees, "{familiar} of {trees}");
        let block = Bitmap::from_fn(128, 128, |x, y| (9..119).contains(&x) && (20..126).contains(&y));
        let strange = predictors.answer(&block, 0.1, Foliage::All, &palm).unwrap();
        assert!(strange.familiarity < 0.01, "{}", strange.familiarity);
    }

    #[test]
    fn others_are_not_known_and_an_empty_picture_says_nothing() {
        let predictors = Predictors::from_bytes(&recorded(120)).unwrap();
        let (palm, poplar) = (palm(), pleach_generators::preset("lombardy_poplar").unwrap().clone());
        let found = predictors.predict(&picture(&palm, 3), Foliage::None, [&poplar, &palm]);
        assert!(found[0].is_none() && found[1].is_some());
        assert_eq!(predictors.predict(&Bitmap::new(8, 8), Foliage::All, [&palm]), [None]);
        let answer =
            |picture: &Bitmap, species: &Species| predictors.answer(picture, 0.1, Foliage::All, species);
        assert!(answer(&picture(&palm, 3), &palm).is_some());
        assert!(answer(&picture(&palm, 3), &poplar).is_none() && answer(&Bitmap::new(8, 8), &palm).is_none());
    }

    #[test]
    fn a_picture_is_most_probable_among_those_of_its_species() {
        let known = ["palm", "lombardy_poplar"].map(|name| pleach_generators::preset(name).unwrap().clone());
        let stop = AtomicBool::new(false);
        let bytes = Predictors::record(&known, 200, &(), &stop, |_, _| ()).unwrap();
        let predictors = Predictors::from_bytes(&bytes).unwrap();
        let acer = pleach_generators::preset("acer").unwrap().clone();
        let all = [&known[0], &known[1], &acer];
        let densities = |picture: &Bitmap| predictors.log_densities(picture, Foliage::All, all).unwrap();
        for (own, species) in known.iter().enumerate() {
            let found = densities(&picture(species, 3));
            assert!(found[own] > found[1 - own] && found[2].is_none(), "{}: {found:?}", species.name);
        }
        // What is strange to all of them says nothing.
        let block = Bitmap::from_fn(128, 128, |x, y| (9..119).contains(&x) && (20..126).contains(&y));
        assert!(densities(&block).iter().flatten().all(|density| *density == 0.0));
        assert!(predictors.log_densities(&Bitmap::new(8, 8), Foliage::All, all).is_none());
    }

    #[test]
    fn they_are_the_same_bytes_on_any_number_of_threads_and_no_others_are_read() {
        let on = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let bytes = on(1).install(|| recorded(100));
        assert_eq!(bytes, on(3).install(|| recorded(100)));
        assert!(Predictors::from_bytes(&bytes[..bytes.len() / 2]).is_err());
        assert!(Predictors::from_bytes(&[0xff; 64]).is_err());
        // A number that is none.
        let mut stored: Stored = postcard::from_bytes(&bytes).unwrap();
        stored.directions.means[0] = f32::NAN;
        let bad = postcard::to_allocvec(&stored).unwrap();
        assert!(Predictors::from_bytes(&bad).is_err());
    }

    /// Stops after some parts.
    #[derive(Default)]
    struct Memory {
        parts: Mutex<BTreeMap<String, Vec<u8>>>,
        stop: AtomicBool,
    }

    impl LearntParts for Memory {
        fn load(&self, name: &str) -> Option<Vec<u8>> {
            self.parts.lock().unwrap().get(name).cloned()
        }

        fn save(&self, name: &str, part: &[u8]) {
            self.parts.lock().unwrap().insert(name.to_owned(), part.to_vec());
            self.stop.store(true, Ordering::Relaxed);
        }
    }

    #[test]
    fn a_run_that_was_stopped_goes_on() {
        let memory = Memory::default();
        let mut runs = 0;
        let bytes = loop {
            runs += 1;
            memory.stop.store(false, Ordering::Relaxed);
            match Predictors::record(&[palm()], 100, &memory, &memory.stop, |_, _| ()) {
                Ok(bytes) => break bytes,
                Err(error) => assert!(matches!(error, FitError::Interrupted)),
            }
        };
        assert_eq!((runs, memory.parts.lock().unwrap().len()), (3, 3), "directions, with leaves, without");
        assert_eq!(bytes, recorded(100));
        // What is kept by another version is learnt again.
        memory.parts.lock().unwrap().values_mut().for_each(|part| *part = vec![0xff; 64]);
        let stop = AtomicBool::new(false);
        assert_eq!(bytes, Predictors::record(&[palm()], 100, &memory, &stop, |_, _| ()).unwrap());
    }

    #[test]
    fn learning_ends_when_asked_to() {
        let found = Predictors::record(&[palm()], 100, &(), &AtomicBool::new(true), |_, _| ());
        assert!(matches!(found, Err(FitError::Interrupted)));
    }
}
