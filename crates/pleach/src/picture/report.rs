//! What a whole fit has found, as data.

use super::drawn::{FitDrawing, FittedTree};
use super::next::NextStep;
use super::optimizer::settings_of;
use super::options::FitOptions;
use super::parameters::{intervals, parameters};
use super::posterior::PosteriorReport;
use super::prepared::{FurtherPicture, Prepared};
use super::readings::Readings;
use super::report_parts::{
    IdentifiabilityCounts, IndividualReport, IntervalsReport, LooksLike, ParameterReport, RulesReport,
    SearchReport, ViewReport, best_of_each_family,
};
use super::sides::{Sides, SidesReport};
use crate::place_at_full_size;
use pleach_fit::{
    Azimuth, Fitted, FoundIndividual, FreshSeeds, Objective, Placement, References, Runner, StopReason,
    Verdict, placements,
};
use pleach_silhouette::goal::GoalWarning;
use pleach_silhouette::score::{ScoreCard, SizeMismatch};
use pleach_tree::Dendrometry;
use pleach_tree::param::SlotError;
use pleach_tree::{Foliage, GrowError, Species, Tree};
use serde::Serialize;
use serde_json::{Map, Value};

/// What a whole fit has found.
///
/// It serialises as one object, whose keys are the same in the program's `summary.json`, in Python and in the page.
/// Scores are against the goal at its own size. What is not written to JSON are the trees themselves and the raw
/// results.
#[derive(Clone, Debug, Serialize)]
pub struct FitReport {
    /// The name of the species that was found.
    pub species: String,
    /// Its family of generators.
    pub generator: String,
    /// The seed of its tree.
    pub tree_seed: u64,
    /// Trees over which parameters were scored.
    pub robust: u32,
    /// How well the kind's own tree matches the goal.
    #[serde(flatten)]
    pub scores: ScoreCard,
    /// How trees of other seeds match it; `None` if one of them does not grow, or the result was not judged.
    pub fresh_seeds: Option<FreshSeeds>,
    /// The goal's own tree, where there is one.
    pub individual: Option<IndividualReport>,
    /// With [`FitOptions::individuals`] above 1: all trees of the goal, the best first.
    pub individuals: Option<SidesReport>,
    /// What likeness and IoU stand beside, at the search's size.
    pub references: Option<References>,
    /// Whether the kind is right.
    pub verdict: Option<Verdict>,
    /// What to do next, the most promising first.
    pub next: Vec<NextStep>,
    /// What is in the goal and in the pictures of the trees that were found, and how they differ.
    pub readings: Readings,
    /// How many of the free parameters the goal determines; `None` if the result was not judged.
    pub determined: Option<IdentifiabilityCounts>,
    /// How well the goal determines each free parameter, and its interval.
    pub parameters: Vec<ParameterReport>,
    /// What those intervals are learnt from; `None` where nothing is known of trees like the goal's.
    pub intervals: Option<IntervalsReport>,
    /// What the goal says about the numbers of its tree, with [`FitOptions::posterior`]; `None` if too few trees of the
    /// prior grew, or the fit was interrupted.
    pub posterior: Option<PosteriorReport>,
    /// Trees that the search has grown and scored.
    pub evaluations: u64,
    /// Generations of the search.
    pub generations: u64,
    /// Time of the first guess and the search together, in seconds.
    pub seconds: f64,
    /// Time of the first guess, in seconds.
    pub first_guess_seconds: f64,
    /// Time of the search, in seconds.
    pub search_seconds: f64,
    /// Time of judging, in seconds; `None` if the result was not judged.
    pub judging_seconds: Option<f64>,
    /// Trees of the search per second.
    pub evaluations_per_second: f64,
    /// What searched: the name of an optimiser, or `rules`.
    pub optimizer: &'static str,
    /// Its settings.
    pub optimizer_settings: Map<String, Value>,
    /// The grammar that a search over rules has found.
    #[serde(flatten)]
    pub rules: Option<RulesReport>,
    /// What the search minimised.
    pub objective: String,
    /// The cost of the result.
    pub cost: f64,
    /// Why the search ended.
    pub stopped_by: StopReason,
    /// Whether the fit came to its end, and was not interrupted.
    pub finished: bool,
    /// The seed of the search.
    pub seed: u64,
    /// Where the search started, as it was asked for.
    pub from: String,
    /// The known species that the goal looks like, the likeliest first; those with a confidence below 0.01 are left
    /// out.
    pub looks_like: Vec<LooksLike>,
    /// How the families of generators did in the race for the goal, the best first; empty if only one was asked.
    pub families: Vec<Runner>,
    /// Whether trees have leaves.
    pub leaves: bool,
    /// Whether the first guess looked for leaves in the goal.
    pub leaves_detected: bool,
    /// How the kind's own tree does in further pictures that were fitted.
    pub views: Vec<ViewReport>,
    /// The same of further pictures that were not fitted.
    pub holdout_views: Vec<ViewReport>,
    /// Patterns of free parameters.
    pub free: Vec<String>,
    /// Patterns of fixed parameters.
    pub fix: Vec<String>,
    /// Height of the goal's tree in metres.
    pub height_m: f64,
    /// The fitted tree in metres.
    pub tree_m: Dendrometry,
    /// Metres per pixel of the goal's file. The key is older than the spelling of identifiers.
    #[serde(rename = "metres_per_pixel")]
    pub meters_per_pixel: f64,
    /// Where the trunk's foot is, in pixels of the goal's file from its left edge.
    pub axis_column: f64,
    /// Where the ground is, in pixels of the goal's file from its top edge.
    pub ground_row: f64,
    /// Width of the goal's file in pixels.
    pub goal_width: u32,
    /// Height of the goal's file in pixels.
    pub goal_height: u32,
    /// Width of the part of the picture that scores are of, with paper beside the tree: other than the goal's where
    /// the picture ends at the tree or shows little else than paper.
    pub compared_width: u32,
    /// Height of that part.
    pub compared_height: u32,
    /// The result at the size of the search.
    pub search: SearchReport,
    /// What about the goal, or its mask, is not as a fit expects.
    pub warnings: Vec<GoalWarning>,
    /// What was asked for.
    pub options: FitOptions,
    /// The version of pleach.
    pub version: &'static str,
    /// The tree of the kind.
    #[serde(skip)]
    pub kind: FittedTree,
    /// The goal's own trees, the best first.
    #[serde(skip)]
    pub trees: Vec<FittedTree>,
    /// Its raw results, history included.
    #[serde(skip)]
    pub fitted: Fitted,
}

/// The keys of a [`FitReport`] that depend on the clock, nested ones after a dot: two runs differ in them.
pub const TIME_KEYS: [&str; 7] = [
    "seconds",
    "first_guess_seconds",
    "search_seconds",
    "judging_seconds",
    "evaluations_per_second",
    "individual.seconds",
    "individual.trials_per_second",
];

/// Why a result cannot be drawn or scored: not what comes of a fit of the same [`Prepared`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// Its tree does not grow.
    #[error(transparent)]
    Grow(#[from] GrowError),
    /// It has a value that the generator does not allow.
    #[error(transparent)]
    Value(#[from] SlotError),
    /// Its pictures are not the ones that were prepared.
    #[error(transparent)]
    Size(#[from] SizeMismatch),
}

impl FitReport {
    /// The goal's own tree that lies best on the goal; without one the tree of the kind.
    #[must_use]
    pub fn best(&self) -> &FittedTree {
        self.trees.first().unwrap_or(&self.kind)
    }
}

impl Prepared {
    /// Draws and scores what a fit of this has found. One tree is held in memory at a time.
    ///
    /// # Errors
    /// A [`ReportError`] if `fitted` is not of this fit.
    pub fn report(&self, fitted: Fitted) -> Result<FitReport, ReportError> {
        let mut drawing = self.drawing(&fitted.problem, fitted.settings.limits);
        let best = &fitted.best;
        let species = drawing.species(&best.genome)?;
        let tree = drawing.grow(&species)?;
        drawing.placements = self.placements_at_full_size(&tree, &fitted);
        let kind = self.fitted_tree(&drawing, species, &tree)?;
        let tree_m = Dendrometry::new(&tree);
        let holdout_views = self
            .holdout_views
            .iter()
            .map(|picture| self.view_report(&drawing, &tree, picture, &Placement::KNOWN, false))
            .collect::<Result<_, _>>()?;
        drop(tree);

        let mut trees = Vec::new();
        let mut sides = Sides::new(&drawing);
        for found in &fitted.individuals {
            let species = self.named(found.species.clone());
            let tree = drawing.grow(&species)?;
            trees.push(self.fitted_tree(&drawing, species, &tree)?);
            if fitted.individuals.len() > 1 {
                sides.add(&tree, found.individual().len())?;
            }
        }
        let individuals = sides.report(&kind.species);
        let individual =
            fitted.individuals.first().zip(trees.first()).map(|(found, tree)| individual(found, tree));

        let posterior =
            fitted.posterior.as_ref().map(|found| PosteriorReport::new(found, &drawing)).transpose()?;
        let readings = Readings::new(&self.reading, &kind, trees.first());
        let outcome = &fitted.outcome;
        let settings = &fitted.settings;
        let judged = fitted.assessment.as_ref();
        let (full, working) = (&self.goal.full, &self.goal.working);
        let frame = full.original_frame(&drawing.frame());
        let is_measured =
            fitted.problem.goals[0].evidence.is_some() && settings.objective == Objective::Balance;
        let verdict = fitted.verdict(&kind.scores).map(|verdict| {
            let fresh = judged.and_then(|judged| judged.held_out.as_ref());
            let fresh = fresh.map_or(best.score.cost, |fresh| fresh.cost.mean);
            if is_measured {
                readings.judge_colored(verdict, fresh, best.score.cost)
            } else {
                readings.bound(verdict)
            }
        });
        let parameters = parameters(&fitted, &kind.species);
        let leaves = fitted.problem.foliage != Foliage::None;
        let next = NextStep::after(&self.options, verdict.as_ref(), &readings, &self.goal.warnings, leaves);
        let seconds = outcome.elapsed.as_secs_f64();
        let first_guess_seconds = outcome.before_search.as_secs_f64();
        Ok(FitReport {
            species: kind.species.name.clone(),
            generator: kind.species.generator.family().to_owned(),
            tree_seed: best.genome.tree_seed,
            robust: settings.robust.get(),
            scores: kind.scores,
            fresh_seeds: judged.and_then(|judged| judged.held_out),
            individual,
            individuals,
            references: fitted.references().cloned(),
            verdict,
            next,
            readings,
            determined: judged.map(|_| IdentifiabilityCounts::new(&parameters)),
            parameters,
            intervals: intervals(&fitted),
            posterior,
            evaluations: outcome.evaluations,
            generations: outcome.generations,
            seconds,
            first_guess_seconds,
            search_seconds: seconds - first_guess_seconds,
            judging_seconds: judged.map(|judged| judged.elapsed.as_secs_f64()),
            evaluations_per_second: outcome.evaluations as f64 / seconds.max(1e-9),
            optimizer: settings.method_name(),
            optimizer_settings: method_settings(&fitted),
            rules: settings.rules.as_ref().and_then(|_| RulesReport::new(&kind.species)),
            objective: settings.objective.to_string(),
            cost: best.score.cost,
            stopped_by: outcome.stop,
            finished: outcome.stop != StopReason::Interrupted,
            seed: settings.seed,
            from: self.options.from.to_string(),
            looks_like: LooksLike::from_guess(fitted.guess.as_ref()),
            families: best_of_each_family(fitted.guess.as_ref()),
            leaves,
            leaves_detected: self.detects_leaves,
            views: kind.views.clone(),
            holdout_views,
            free: settings.freedom.free.clone(),
            fix: settings.freedom.fix.clone(),
            height_m: self.height,
            tree_m,
            meters_per_pixel: frame.meters_per_pixel,
            axis_column: frame.axis_column,
            ground_row: frame.ground_row,
            goal_width: frame.width,
            goal_height: frame.height,
            compared_width: full.bitmap.width(),
            compared_height: full.bitmap.height(),
            search: SearchReport {
                goal_width: working.bitmap.width(),
                goal_height: working.bitmap.height(),
                goal_ink: working.bitmap.ink() as f64 / working.bitmap.area() as f64,
                iou: best.score.iou,
                pixel_accuracy: best.score.accuracy,
            },
            warnings: self.goal.warnings.clone(),
            options: self.options.spelled_out(),
            version: env!("CARGO_PKG_VERSION"),
            kind,
            trees,
            fitted,
        })
    }

    /// Where `tree`, the result, stands in each picture at its own size: the goal first.
    fn placements_at_full_size(&self, tree: &Tree, fitted: &Fitted) -> Vec<Placement> {
        let found = placements(&fitted.problem.goals, &fitted.best.genome.nuisances);
        let pairs = std::iter::once(&self.goal).chain(self.views.iter().map(|view| &view.goal));
        let foliage = fitted.problem.foliage;
        pairs
            .zip(&fitted.problem.goals)
            .zip(found)
            .map(|((pair, view), found)| {
                // What was searched is found as well as it can be.
                if view.unknown.count() > 0 {
                    return found;
                }
                place_at_full_size(tree, foliage, (&pair.full, &pair.working), view, self.height)
            })
            .collect()
    }

    fn fitted_tree(
        &self,
        drawing: &FitDrawing<'_>,
        species: Species,
        tree: &Tree,
    ) -> Result<FittedTree, ReportError> {
        let (silhouette, original) = drawing.silhouettes(tree);
        let scores = ScoreCard::new(&silhouette, &self.goal.full.bitmap)?;
        let pictures = self.views.iter().zip(drawing.placements.iter().skip(1));
        let views = pictures
            .zip(&self.options.views)
            .map(|((picture, placement), asked)| {
                let azimuth_found = asked.azimuth != Azimuth::Known;
                self.view_report(drawing, tree, picture, placement, azimuth_found)
            })
            .collect::<Result<_, _>>()?;
        let measures = drawing.measures(tree, &silhouette);
        Ok(FittedTree { species, scores, measures, silhouette, original, views })
    }

    fn view_report(
        &self,
        drawing: &FitDrawing<'_>,
        tree: &Tree,
        picture: &FurtherPicture,
        placement: &Placement,
        azimuth_found: bool,
    ) -> Result<ViewReport, ReportError> {
        let goal = &picture.goal.full;
        let (view, frame) = (placement.view(&picture.view), placement.frame(&goal.frame(self.height)));
        let silhouette = drawing.draw(tree, &view, &frame);
        Ok(ViewReport {
            file: picture.name.clone(),
            // As it was found: to radians and back would be another number.
            azimuth: placement.azimuth.unwrap_or_else(|| view.azimuth.to_degrees()),
            elevation: view.elevation.to_degrees(),
            scale: placement.scale,
            offset: placement.offset,
            scores: ScoreCard::new(&silhouette, &goal.bitmap)?,
            azimuth_found,
            silhouette,
        })
    }
}

fn individual(found: &FoundIndividual, tree: &FittedTree) -> IndividualReport {
    let seconds = found.elapsed.as_secs_f64();
    IndividualReport {
        stems: found.individual().len(),
        scores: tree.scores,
        cost_before: found.before.cost,
        cost: found.score.cost,
        trees: found.trees,
        trials: found.trials,
        trials_per_second: found.trials as f64 / seconds.max(1e-9),
        seconds,
        views: tree.views.clone(),
    }
}

/// The settings of what searched.
fn method_settings(fitted: &Fitted) -> Map<String, Value> {
    match &fitted.settings.rules {
        Some(rules) => match serde_json::to_value(rules) {
            Ok(Value::Object(settings)) => settings,
            _ => Map::new(),
        },
        None => settings_of(&fitted.settings.optimizer),
    }
}
