//! A fit that the page drives, batch by batch.

use crate::error::thrown;
use crate::goal::Goal;
use crate::tree::ink;
use crate::{message, report};
use js_sys::{Array, Function, Uint8Array};
use pleach::plan::{DRAWING, Origin, Shares, plan, usual_start};
use pleach::{
    Bitmap, Budget, Control, Drawings, FitProblem, FitSettings, Foliage, Frame, GeneratorChoice, GoalView,
    Growth, GuessLibrary, Observer, Rasterizer, Scored, Species, Stepwise, StopReason, Tree, TreeSeed, View,
};
use serde::Deserialize;
use serde_json::json;
use std::sync::atomic::AtomicBool;
use std::time::Duration;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

/// What the page asks for.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Options {
    /// Metres.
    height: f64,
    #[serde(default)]
    generator: Option<String>,
    seconds: Option<f64>,
    evaluations: Option<u64>,
    #[serde(default = "one")]
    seed: u64,
    #[serde(default = "one")]
    tree_seed: u64,
    /// Whether the tree has leaves; found out if it is not said.
    leaves: Option<bool>,
    /// `guess`, `random`, or the text of a species file.
    #[serde(default)]
    start: Option<String>,
}

const fn one() -> u64 {
    1
}

/// How far a fit has come.
enum Stage {
    Planned {
        settings: Box<pleach::GoalSettings>,
        library: Box<GuessLibrary>,
    },
    Searching(Box<Stepwise>),
    /// A step has failed, or the fit has ended.
    Over,
}

/// A fit of one goal. Its individuals are scored by `Evaluator`s in other workers.
#[wasm_bindgen]
pub struct Fit {
    name: String,
    /// At its own size, with the margins that searches see.
    compared: pleach::Goal,
    working: pleach::Goal,
    height: f64,
    problem: FitProblem,
    stage: Stage,
    /// Individuals of the last batch, piece by piece.
    pieces: Vec<usize>,
    /// The time of the search that the page has told last.
    elapsed: Duration,
}

#[wasm_bindgen]
impl Fit {
    /// A fit of `goal`, with options in JSON.
    #[wasm_bindgen(constructor)]
    pub fn new(goal: &Goal, options: &str) -> Result<Self, JsError> {
        let options: Options = serde_json::from_str(options).map_err(thrown)?;
        let Options { height, seconds, evaluations, .. } = options;
        if !(height.is_finite() && height > 0.0) {
            return Err(thrown(format!("the height is {height} m, expected more than 0")));
        }
        let generator: Option<GeneratorChoice> =
            options.generator.as_deref().map(str::parse).transpose().map_err(thrown)?;
        let start = options.start.as_deref().unwrap_or("guess");
        let (origin, generator, start) = match start {
            "guess" | "random" => {
                let generator = generator.unwrap_or_default();
                let detect_leaves = options.leaves.is_none();
                let origin = if start == "guess" { Origin::Guess { detect_leaves } } else { Origin::Random };
                let usual = usual_start(generator).ok_or_else(|| thrown("a generator has species"))?;
                (origin, generator, usual)
            }
            text => {
                let species = pleach::read_species(text.as_bytes(), "the start").map_err(thrown)?.kind();
                (Origin::Start, GeneratorChoice::Family(species.generator.family()), species)
            }
        };
        let whole = seconds.map(Duration::try_from_secs_f64).transpose().map_err(thrown)?;
        let shares = whole.map(|whole| Shares::new(whole, None));
        let search = FitSettings {
            budget: Budget { timeout: shares.map(|shares| shares.search), evaluations, ..Budget::default() },
            seed: options.seed,
            tree_seed: TreeSeed::Fixed(options.tree_seed),
            ..FitSettings::default()
        };
        let mut settings = plan(origin, generator, &start, search).map_err(thrown)?;
        if let Some(shares) = shares {
            settings = shares.bound(settings, DRAWING, DRAWING);
        }
        let working = goal.working()?;
        let view = GoalView::from_picture(working.bitmap.clone(), View::FRONT, working.frame(height));
        let foliage = if options.leaves == Some(false) { Foliage::None } else { Foliage::All };
        Ok(Self {
            name: goal.species_name(),
            compared: goal.compared()?,
            working,
            height,
            problem: FitProblem { start, goals: vec![view], foliage },
            stage: Stage::Planned {
                settings: Box::new(settings),
                library: Box::new(GuessLibrary::new().for_one_goal()),
            },
            pieces: Vec::new(),
            elapsed: Duration::ZERO,
        })
    }

    /// Drawings of the known species, which make the first guess fast and change nothing of it.
    pub fn use_drawings(&mut self, bytes: Vec<u8>) -> Result<(), JsError> {
        if let Stage::Planned { library, .. } = &mut self.stage {
            // They stay until the worker is thrown away.
            let drawings = Drawings::from_bytes(bytes.leak()).map_err(thrown)?;
            **library = GuessLibrary::with_drawings(drawings).for_one_goal();
        }
        Ok(())
    }

    /// Makes the first guess; `progress` is called with the trees that are done, and all. What it looks like: JSON.
    pub fn guess(&mut self, progress: &Function) -> Result<String, JsError> {
        let Stage::Planned { settings, library } = std::mem::replace(&mut self.stage, Stage::Over) else {
            return Err(thrown("the first guess has been made"));
        };
        let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
        let mut told = Told(progress);
        let control = Control { observers: vec![&mut told], ..Control::new(&clock, &stop) };
        let fit = Stepwise::begin(&self.problem, &settings, *library, control).map_err(thrown)?;
        let begun = fit.begun();
        let names: Vec<_> = begun.guess.iter().flat_map(|guess| &guess.names).collect();
        let looks_like = json!({
            "looks_like": names,
            "leaves": begun.problem.foliage != Foliage::None,
            "species": begun.problem.start.name,
        });
        self.stage = Stage::Searching(Box::new(fit));
        Ok(looks_like.to_string())
    }

    /// What `Evaluator`s are made of.
    pub fn recipe(&self) -> Result<Vec<u8>, JsError> {
        message::recipe(self.search()?.begun())
    }

    /// The next batch in at most `parts` pieces, `elapsed` seconds after the fit began; none once the search is over.
    pub fn ask(&mut self, parts: usize, elapsed: f64) -> Result<Vec<Uint8Array>, JsError> {
        self.elapsed = seconds(elapsed)?;
        let now = self.elapsed;
        let Stage::Searching(search) = &mut self.stage else { return Err(thrown(NOT_SEARCHING)) };
        if search.ended(now).is_some() {
            return Ok(Vec::new());
        }
        let batch = search.ask(parts);
        let size = batch.genomes.len().div_ceil(parts.max(1)).max(1);
        let pieces = batch.genomes.chunks(size);
        self.pieces = pieces.clone().map(<[_]>::len).collect();
        pieces.map(|piece| Ok(Uint8Array::from(message::piece(piece, batch.most)?.as_slice()))).collect()
    }

    /// Takes what `Evaluator`s gave for the pieces of the last batch, in their order.
    pub fn tell(&mut self, scores: &Array, elapsed: f64) -> Result<(), JsError> {
        self.elapsed = seconds(elapsed)?;
        let mut all = Vec::new();
        for (bytes, expected) in scores.iter().zip(&self.pieces) {
            let some = message::scores(&Uint8Array::new(&bytes).to_vec())?;
            if some.len() != *expected {
                return Err(thrown("scores are missing"));
            }
            all.extend(some);
        }
        if scores.length() as usize != self.pieces.len() {
            return Err(thrown("scores are missing"));
        }
        let now = self.elapsed;
        let Stage::Searching(search) = &mut self.stage else { return Err(thrown(NOT_SEARCHING)) };
        let _ = search.tell(&all, now);
        Ok(())
    }

    /// How far the search has come: JSON.
    pub fn progress(&self) -> Result<String, JsError> {
        let search = self.search()?;
        let score = search.best().map(|best| best.score).filter(|score| score.cost.is_finite());
        Ok(json!({
            "evaluations": search.evaluations(),
            "generation": search.history().len(),
            "cost": score.map(|score| score.cost),
            "iou": score.map(|score| score.iou),
            "likeness": search.likeness(),
            "used": search.used(self.elapsed),
            "ended": search.ended(self.elapsed).map(|stop: StopReason| stop.to_string()),
        })
        .to_string())
    }

    /// The best tree so far over the goal: one byte a pixel, 1 for tree; empty before there is one.
    pub fn best_silhouette(&self) -> Result<Vec<u8>, JsError> {
        let search = self.search()?;
        let Some(best) = search.best().filter(|best| best.score.cost.is_finite()) else {
            return Ok(Vec::new());
        };
        let problem = &search.begun().problem;
        let tree = grown(&found(problem, best)?, problem.foliage)?;
        let frame = problem.goals[0].registered.frame(&self.compared.frame(self.height));
        Ok(ink(&drawn(&tree, &self.compared.original_frame(&frame), problem.foliage)))
    }

    /// The species file of the best tree so far.
    pub fn best_toml(&self) -> Result<String, JsError> {
        let search = self.search()?;
        let best = search.best().ok_or_else(|| thrown("no tree has been tried yet"))?;
        Ok(self.named(found(&search.begun().problem, best)?).to_toml(&[]))
    }

    /// Ends the search, judges the result, and reports: JSON. `progress` is called with the word `judging`.
    pub fn finish(&mut self, progress: &Function) -> Result<String, JsError> {
        let Stage::Searching(search) = std::mem::replace(&mut self.stage, Stage::Over) else {
            return Err(thrown(NOT_SEARCHING));
        };
        let started = js_sys::Date::now();
        let before = self.elapsed;
        let clock = || before + Duration::from_secs_f64((js_sys::Date::now() - started).max(0.0) / 1000.0);
        let stop = AtomicBool::new(false);
        let mut told = Told(progress);
        let control = Control { observers: vec![&mut told], ..Control::new(&clock, &stop) };
        let fitted = search.finish(control).map_err(thrown)?;
        let species = self.named(fitted.species().map_err(thrown)?);
        let (foliage, goals) = (fitted.problem.foliage, (&self.compared, &self.working));
        let tree = grown(&species, foliage)?;
        let view = &fitted.problem.goals[0];
        let place = pleach::place_at_full_size(&tree, foliage, goals, view, self.height);
        let picture = drawn(&tree, &place.frame(&self.compared.frame(self.height)), foliage);
        report::of(&species, &picture, &self.compared.bitmap, &fitted)
    }
}

const NOT_SEARCHING: &str =
    "there is no search: the first guess has to be made, and the fit not to have ended";

impl Fit {
    fn search(&self) -> Result<&Stepwise, JsError> {
        match &self.stage {
            Stage::Searching(search) => Ok(search),
            _ => Err(thrown(NOT_SEARCHING)),
        }
    }

    fn named(&self, species: Species) -> Species {
        Species { name: self.name.clone(), description: String::new(), ..species }
    }
}

fn grown(species: &Species, foliage: Foliage) -> Result<Tree, JsError> {
    let growth = Growth { foliage, ..Growth::seed(species.tree_seed.unwrap_or(1)) };
    species.grow_with(&growth).map_err(thrown)
}

fn drawn(tree: &Tree, frame: &Frame, foliage: Foliage) -> Bitmap {
    let mut picture = Bitmap::default();
    Rasterizer::new().draw(tree, &View::FRONT, frame, foliage.into(), &mut picture);
    picture
}

fn found(problem: &FitProblem, best: &Scored) -> Result<Species, JsError> {
    problem.species(&best.genome).map_err(thrown)
}

fn seconds(elapsed: f64) -> Result<Duration, JsError> {
    Duration::try_from_secs_f64(elapsed).map_err(thrown)
}

/// Calls a function of the page.
struct Told<'a>(&'a Function);

impl Observer for Told<'_> {
    fn guessing(&mut self, done: usize, all: usize) {
        // What the page makes of it is its own affair.
        let _ = self.0.call2(&JsValue::NULL, &JsValue::from_f64(done as f64), &JsValue::from_f64(all as f64));
    }

    fn judging(&mut self) {
        let _ = self.0.call1(&JsValue::NULL, &JsValue::from_str("judging"));
    }
}
