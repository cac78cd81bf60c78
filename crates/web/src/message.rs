//! What the worker that runs a search sends to those that score its individuals, and what they send back.

use crate::error::thrown;
use pleach::{
    Bitmap, FitOptions, FitProblem, FitSettings, Foliage, Frame, Genome, GoalView, Limits, Placement, Score,
    Start,
};
use pleach::{Evaluator as Scorer, evaluator};
use pleach_fit::{Evaluate as _, Size};
use serde::{Deserialize, Serialize};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// All that scoring depends on.
#[derive(Serialize, Deserialize)]
struct Recipe {
    /// The options of the fit as JSON: how individuals are scored follows from them.
    options: String,
    species: String,
    leafy: bool,
    lists: Option<Vec<Vec<f64>>>,
    /// The most stems, leaves, knots and steps of a tree.
    limits: (usize, usize, usize, u64),
    /// Width, height and rows of the goal.
    goal: (u32, u32, Vec<u64>),
    /// Metres per pixel, axis and ground.
    frame: [f64; 3],
    /// Where the tree stands against the frame: scale, and offset to the right and down.
    registered: (f64, [f64; 2]),
}

/// Individuals to be scored.
#[derive(Serialize, Deserialize)]
struct Piece {
    genomes: Vec<Genome>,
    most: Size,
}

/// The bytes of the recipe of a search for one picture.
pub(crate) fn recipe(
    options: &FitOptions,
    problem: &FitProblem,
    settings: &FitSettings,
) -> Result<Vec<u8>, JsError> {
    let [GoalView { goal, frame, registered, .. }] = problem.goals.as_slice() else {
        return Err(thrown("the page fits one picture, and there are several"));
    };
    let Limits { stems, leaves, knots, work } = settings.limits;
    let lists = match &settings.start {
        Start::Lists(lists) => Some(lists.clone()),
        Start::Random => None,
    };
    let recipe = Recipe {
        options: serde_json::to_string(options).map_err(thrown)?,
        species: problem.start.to_toml(&[]),
        leafy: problem.foliage != Foliage::None,
        lists,
        limits: (stems, leaves, knots, work),
        goal: (goal.width(), goal.height(), goal.words().to_vec()),
        frame: [frame.meters_per_pixel, frame.axis_column, frame.ground_row],
        registered: (registered.scale, registered.offset),
    };
    postcard::to_stdvec(&recipe).map_err(thrown)
}

/// The bytes of some individuals.
pub(crate) fn piece(genomes: &[Genome], most: Size) -> Result<Vec<u8>, JsError> {
    postcard::to_stdvec(&Piece { genomes: genomes.to_vec(), most }).map_err(thrown)
}

/// The scores of one piece.
pub(crate) fn scores(bytes: &[u8]) -> Result<Vec<Score>, JsError> {
    postcard::from_bytes(bytes).map_err(thrown)
}

/// Scores individuals of a search that another worker runs.
#[wasm_bindgen]
pub struct Evaluator {
    inner: Scorer,
}

#[wasm_bindgen]
impl Evaluator {
    /// From what `Fit.recipe` gives.
    #[wasm_bindgen(constructor)]
    pub fn new(recipe: &[u8]) -> Result<Self, JsError> {
        let Recipe { options, species, leafy, lists, limits, goal, frame, registered } =
            postcard::from_bytes(recipe).map_err(thrown)?;
        let options = FitOptions::from_json(&options).map_err(thrown)?;
        let start = pleach::read_species(species.as_bytes(), "the start").map_err(thrown)?;
        let (width, height, words) = goal;
        let [meters_per_pixel, axis_column, ground_row] = frame;
        let goal = Bitmap::from_words(width, height, words).ok_or_else(|| thrown("the goal is damaged"))?;
        let (scale, offset) = registered;
        let frame = Frame { width, height, meters_per_pixel, axis_column, ground_row };
        let registered = Placement { scale, offset, ..Placement::KNOWN };
        let view =
            GoalView { registered, ..GoalView::new(goal, options.view.unwrap_or_default().view(), frame) };
        let foliage = if leafy { Foliage::All } else { Foliage::None };
        let problem = FitProblem { start, goals: vec![view], foliage };
        let start = lists.map_or(Start::Random, Start::Lists);
        let (stems, leaves, knots, work) = limits;
        let limits = Limits { stems, leaves, knots, work };
        let settings = FitSettings { start, limits, ..options.search() };
        Ok(Self { inner: evaluator(&problem, &settings).map_err(thrown)? })
    }

    /// The scores of a piece of `Fit.ask`.
    pub fn score(&self, piece: &[u8]) -> Result<Vec<u8>, JsError> {
        let Piece { genomes, most } = postcard::from_bytes(piece).map_err(thrown)?;
        postcard::to_stdvec(&self.inner.scores(&genomes, most)).map_err(thrown)
    }
}
