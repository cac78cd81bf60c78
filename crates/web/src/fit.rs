//! A fit that the page drives, batch by batch.

use crate::error::thrown;
use crate::goal::Goal;
use crate::tree::ink;
use crate::{message, report};
use js_sys::{Array, Function, Uint8Array};
use pleach::plan::library_with;
use pleach::{
    Control, Drawings, FitDrawing, FitOptions, FitProblem, FitReport, FitSource, Foliage, GrowError,
    GuessLibrary, IndividualProgress, LooksLike, Observer, Prepared, Scored, Species, Stepwise, StepwiseRace,
    StopReason,
};
use serde_json::json;
use std::collections::VecDeque;
use std::sync::atomic::AtomicBool;
use std::time::Duration;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

/// How far a fit has come.
enum Stage {
    Prepared(Box<GuessLibrary>),
    /// Generators are searched in turn, to find out which suits the goal.
    Racing(Box<StepwiseRace>),
    Searching(Box<Stepwise>),
    Done(Box<FitReport>),
    /// A step has failed.
    Failed,
}

/// A fit of one goal. Its individuals are scored by `Evaluator`s in other workers.
#[wasm_bindgen]
pub struct Fit {
    prepared: Prepared,
    stage: Stage,
    /// Individuals of the pieces that wait for scores, the oldest first.
    pieces: VecDeque<usize>,
    /// The latest time of the search that the page gave.
    elapsed: Duration,
}

#[wasm_bindgen]
impl Fit {
    /// A fit of `goal`, with the options of `pleach::FitOptions` as JSON; `start` is the text of the species file that
    /// `from` names, if it names one of the page.
    #[wasm_bindgen(constructor)]
    pub fn new(goal: &Goal, options: &str, start: Option<String>) -> Result<Self, JsError> {
        let mut options = FitOptions::from_json(options).map_err(thrown)?;
        let (ground_row, axis_column) = goal.places();
        options.ground_row = options.ground_row.or(ground_row);
        options.axis_column = options.axis_column.or(axis_column);
        let start = start.map(|text| pleach::read_species(text.as_bytes(), "the start")).transpose();
        let source = FitSource {
            start: start.map_err(thrown)?,
            name: Some(goal.species_name()),
            colors: goal.colors.clone(),
            ..goal.ink().clone().into()
        };
        Ok(Self {
            prepared: options.prepare(&source).map_err(thrown)?,
            stage: Stage::Prepared(Box::new(library_with(None).for_one_goal())),
            pieces: VecDeque::new(),
            elapsed: Duration::ZERO,
        })
    }

    /// Drawings of the known species, which make the first guess fast and change nothing of it.
    pub fn use_drawings(&mut self, bytes: Vec<u8>) -> Result<(), JsError> {
        if let Stage::Prepared(library) = &mut self.stage {
            // They stay until the worker is thrown away.
            let drawings = Drawings::from_bytes(bytes.leak()).map_err(thrown)?;
            **library = library_with(Some(drawings)).for_one_goal();
        }
        Ok(())
    }

    /// Compares the goal with the known species; `progress` is called with the trees that are done, and all, and `nearest`
    /// once, with the known tree that is most like the goal: over the goal, one byte per pixel, 1 for tree; and its species
    /// file.
    pub fn compare(&mut self, progress: &Function, nearest: &Function) -> Result<(), JsError> {
        let Stage::Prepared(library) = std::mem::replace(&mut self.stage, Stage::Failed) else {
            return Err(thrown("the goal has been compared with the known species"));
        };
        let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
        let mut callback = Callback(progress);
        let mut first = Nearest { prepared: &self.prepared, function: nearest };
        let control = Control { observers: vec![&mut callback, &mut first], ..Control::new(&clock, &stop) };
        let Prepared { problem, settings, .. } = &self.prepared;
        let race = StepwiseRace::begin(problem, settings, *library, control).map_err(thrown)?;
        self.stage = Stage::Racing(Box::new(race));
        Ok(())
    }

    /// The next search of the race between generators: `recipe` for the `Evaluator`s that score its individuals, and
    /// whose it is. `undefined` once the race is over, and where there is none.
    pub fn next_leg(&mut self) -> Result<Option<Leg>, JsError> {
        let Stage::Racing(race) = &mut self.stage else { return Err(thrown(NOT_RACING)) };
        let Some(leg) = race.next_leg(self.elapsed).map_err(thrown)? else { return Ok(None) };
        self.pieces.clear();
        let recipe = message::recipe(&self.prepared.options, leg.problem, &leg.settings)?;
        Ok(Some(Leg {
            recipe,
            family: leg.family.to_owned(),
            species: leg.species.to_owned(),
            number: leg.number,
            count: leg.count,
        }))
    }

    /// Ends the race, and begins the search with the generator that is ahead. What the goal looks like: JSON.
    pub fn begin(&mut self) -> Result<String, JsError> {
        let Stage::Racing(race) = std::mem::replace(&mut self.stage, Stage::Failed) else {
            return Err(thrown(NOT_RACING));
        };
        // The time of the search begins with it: a race takes longer on a slow machine, and finds the same.
        self.elapsed = Duration::ZERO;
        self.pieces.clear();
        let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
        let fit = race.finish(Control::new(&clock, &stop)).map_err(thrown)?;
        let prepared = fit.prepared();
        let looks_like = json!({
            "looks_like": LooksLike::from_guess(prepared.guess.as_ref()),
            "leaves": prepared.problem.foliage != Foliage::None,
            "species": prepared.problem.start.name,
        });
        self.stage = Stage::Searching(Box::new(fit));
        Ok(looks_like.to_string())
    }

    /// What `Evaluator`s of the search are made of.
    pub fn recipe(&self) -> Result<Vec<u8>, JsError> {
        let prepared = self.search()?.prepared();
        message::recipe(&self.prepared.options, &prepared.problem, &prepared.settings)
    }

    /// The next individuals of the leg of a race, or of the search, in pieces for `workers` workers; none once it is
    /// over, and while others have to be scored first. May be called again before those have their scores. `elapsed` is
    /// in seconds since the leg or the search began.
    pub fn ask(&mut self, workers: usize, elapsed: f64) -> Result<Vec<Uint8Array>, JsError> {
        self.elapsed = seconds(elapsed)?;
        let batch = match &mut self.stage {
            Stage::Racing(race) => race.ask(workers),
            Stage::Searching(search) if search.ended(self.elapsed).is_none() => search.ask(workers),
            Stage::Searching(_) => return Ok(Vec::new()),
            _ => return Err(thrown(NOT_SEARCHING)),
        };
        let size = batch.genomes.len().div_ceil(workers.max(1)).min(self.piece_size(workers)?).max(1);
        let pieces = batch.genomes.chunks(size);
        self.pieces.extend(pieces.clone().map(<[_]>::len));
        pieces.map(|piece| Ok(Uint8Array::from(message::piece(piece, batch.max_size)?.as_slice()))).collect()
    }

    /// Takes what `Evaluator`s gave for the oldest pieces, in the order in which they were asked for.
    pub fn tell(&mut self, scores: &Array, elapsed: f64) -> Result<(), JsError> {
        self.elapsed = seconds(elapsed)?;
        let mut all = Vec::new();
        for bytes in scores.iter() {
            let some = message::scores(&Uint8Array::new(&bytes).to_vec())?;
            if self.pieces.pop_front() != Some(some.len()) {
                return Err(thrown("these are not the scores of the oldest piece"));
            }
            all.extend(some);
        }
        match &mut self.stage {
            Stage::Racing(race) => race.tell(&all, self.elapsed),
            Stage::Searching(search) => {
                let _ = search.tell(&all, self.elapsed);
            }
            _ => return Err(thrown(NOT_SEARCHING)),
        }
        Ok(())
    }

    /// How far the leg or the search has come: JSON.
    pub fn progress(&self) -> Result<String, JsError> {
        let best = self.best()?;
        let score = best.map(|best| best.score).filter(|score| score.cost.is_finite());
        let (evaluations, generation, likeness, used, ended) = match &self.stage {
            Stage::Racing(race) => {
                (race.evaluations(), 0, score.and_then(|score| score.likeness), race.used(), None)
            }
            _ => {
                let search = self.search()?;
                let ended = search.ended(self.elapsed);
                let (generation, used) = (search.history().len(), search.used(self.elapsed));
                (search.evaluations(), generation, search.likeness(), used, ended)
            }
        };
        Ok(json!({
            "evaluations": evaluations,
            "generation": generation,
            "cost": score.map(|score| score.cost),
            "iou": score.map(|score| score.iou),
            "likeness": likeness,
            "used": used,
            "ended": ended.map(|stop: StopReason| stop.to_string()),
        })
        .to_string())
    }

    /// The best tree so far over the goal: one byte per pixel, 1 for tree; empty before there is one.
    pub fn best_silhouette(&self) -> Result<Vec<u8>, JsError> {
        let Some(best) = self.best()?.filter(|best| best.score.cost.is_finite()) else {
            return Ok(Vec::new());
        };
        let drawing = self.drawing()?;
        let species = drawing.species(&best.genome).map_err(thrown)?;
        over_goal(&drawing, &species).map_err(thrown)
    }

    /// The species file of the best tree so far.
    pub fn best_toml(&self) -> Result<String, JsError> {
        let best = self.best()?.ok_or_else(|| thrown("no tree has been tried yet"))?;
        Ok(self.drawing()?.species(&best.genome).map_err(thrown)?.to_toml(&[]))
    }

    /// Ends the search, judges the result, searches the goal's own tree, and reports: JSON. `progress` is called with
    /// the word `judging`, then with `individual` and the share of its time that is used.
    pub fn finish(&mut self, progress: &Function) -> Result<String, JsError> {
        let Stage::Searching(search) = std::mem::replace(&mut self.stage, Stage::Failed) else {
            return Err(thrown(NOT_SEARCHING));
        };
        let started = js_sys::Date::now();
        let before = self.elapsed;
        let clock = || before + Duration::from_secs_f64((js_sys::Date::now() - started).max(0.0) / 1000.0);
        let stop = AtomicBool::new(false);
        let mut callback = Callback(progress);
        let control = Control { observers: vec![&mut callback], ..Control::new(&clock, &stop) };
        let fitted = search.finish(control).map_err(thrown)?;
        let found = self.prepared.report(fitted).map_err(thrown)?;
        let said = report::to_json(&found)?;
        self.stage = Stage::Done(Box::new(found));
        Ok(said)
    }

    /// A tree that was found over the goal: one byte per pixel, 1 for tree. 0 is the tree of the kind, others are the
    /// goal's own, the best first.
    pub fn found_silhouette(&self, which: usize) -> Result<Vec<u8>, JsError> {
        let Stage::Done(report) = &self.stage else { return Err(thrown("the fit has not ended")) };
        let tree = std::iter::once(&report.kind).chain(&report.trees).nth(which);
        Ok(ink(tree.ok_or_else(|| thrown("there is no such tree"))?.over_file()))
    }
}

/// Seconds that a worker scores between two messages: short, so that no other has nothing to do for long, and much longer
/// than the messages take.
const PIECE: f64 = 0.02;

const NOT_SEARCHING: &str =
    "there is no search: the first guess has to be made, and the fit not to have ended";

const NOT_RACING: &str =
    "there is no race: the goal has to be compared first, and the search not to have begun";

impl Fit {
    fn search(&self) -> Result<&Stepwise, JsError> {
        match &self.stage {
            Stage::Searching(search) => Ok(search),
            _ => Err(thrown(NOT_SEARCHING)),
        }
    }

    /// The most individuals of a piece: what takes a worker about `PIECE`, once the time of an individual is known.
    fn piece_size(&self, workers: usize) -> Result<usize, JsError> {
        let evaluations = match &self.stage {
            Stage::Racing(race) => race.evaluations(),
            _ => self.search()?.evaluations(),
        };
        if evaluations == 0 || self.elapsed.is_zero() {
            return Ok(usize::MAX);
        }
        let each = self.elapsed.as_secs_f64() * workers as f64 / evaluations as f64;
        Ok((PIECE / each) as usize)
    }

    /// The best individual of the leg or of the search.
    fn best(&self) -> Result<Option<&Scored>, JsError> {
        match &self.stage {
            Stage::Racing(race) => Ok(race.best()),
            _ => Ok(self.search()?.best()),
        }
    }

    /// Draws the trees of the leg or of the search.
    fn drawing(&self) -> Result<FitDrawing<'_>, JsError> {
        if let Stage::Racing(race) = &self.stage {
            let leg = race.leg().ok_or_else(|| thrown(NOT_SEARCHING))?;
            return Ok(self.prepared.drawing(leg.problem, leg.settings.limits));
        }
        let prepared = self.search()?.prepared();
        Ok(self.prepared.drawing(&prepared.problem, prepared.settings.limits))
    }
}

/// A search of the race between generators.
#[wasm_bindgen(getter_with_clone)]
pub struct Leg {
    /// What `Evaluator`s of its individuals are made of.
    pub recipe: Vec<u8>,
    /// The family of the generator that is searched.
    pub family: String,
    /// The known species that its trees are nearest to.
    pub species: String,
    /// Its number in its round, from 1.
    pub number: usize,
    /// Searches of the round.
    pub count: usize,
}

fn seconds(elapsed: f64) -> Result<Duration, JsError> {
    Duration::try_from_secs_f64(elapsed).map_err(thrown)
}

/// The tree of `species` over the goal: one byte per pixel, 1 for tree.
fn over_goal(drawing: &FitDrawing<'_>, species: &Species) -> Result<Vec<u8>, GrowError> {
    let (silhouette, original) = drawing.silhouettes(&drawing.grow(species)?);
    Ok(ink(original.as_ref().unwrap_or(&silhouette)))
}

/// Calls a function of the page.
struct Callback<'a>(&'a Function);

impl Observer for Callback<'_> {
    fn guessing(&mut self, done: usize, all: usize) {
        // An error in the page's function does not end the fit.
        let _ = self.0.call2(&JsValue::NULL, &JsValue::from_f64(done as f64), &JsValue::from_f64(all as f64));
    }

    fn assessing(&mut self) {
        let _ = self.0.call1(&JsValue::NULL, &JsValue::from_str("judging"));
    }

    fn individual(&mut self, progress: &IndividualProgress) {
        let (stage, used) = (JsValue::from_str("individual"), JsValue::from_f64(progress.used));
        let _ = self.0.call2(&JsValue::NULL, &stage, &used);
    }
}

/// Draws the known tree that is most like the goal, for a function of the page.
struct Nearest<'a> {
    prepared: &'a Prepared,
    function: &'a Function,
}

impl Observer for Nearest<'_> {
    fn nearest(&mut self, species: &Species, foliage: Foliage) {
        let Prepared { problem, settings, .. } = self.prepared;
        let problem = FitProblem { start: species.clone(), foliage, goals: problem.goals.clone() };
        let drawing = self.prepared.drawing(&problem, settings.search.limits);
        let species = self.prepared.named(species.clone());
        // A tree that does not grow is not shown, and the fit goes on.
        let Ok(ink) = over_goal(&drawing, &species) else { return };
        let ink = Uint8Array::from(ink.as_slice());
        let _ = self.function.call2(&JsValue::NULL, &ink, &JsValue::from_str(&species.to_toml(&[])));
    }
}
