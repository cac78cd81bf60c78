//! One fit of one goal.

use super::goals::{self, Problem};
use super::spec::{From, MethodSpec};
use super::{FRESH, Fit, stop};
use crate::record::Fixed;
use anyhow::Context;
use pleach_fit::{
    Budget, Candidate, Control, FirstGuess, FitProblem, FitSettings, FreshSeeds, Genome, GuessSettings,
    Objective, Start, TreeSeed, first_guess, fresh_seeds,
};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::score::likeness::Likeness;
use pleach_tree::Limits;
use std::time::{Duration, Instant};

/// Seed of the trees that are fitted; own goals are of other seeds.
const TREE_SEED: u64 = 1;

/// What came of a fit.
pub(super) struct Attempt {
    pub(super) row: Fit,
    pub(super) best: Genome,
    /// The nearest tree before the search.
    pub(super) guess: Option<Genome>,
}

/// First guesses of one goal: several methods start from the same.
#[derive(Default)]
pub(super) struct Guesses {
    known: Vec<(Objective, TreeSeed, u64, Guessed)>,
}

struct Guessed {
    found: FirstGuess,
    seconds: Duration,
}

impl Guesses {
    fn of(&mut self, problem: &FitProblem, settings: &FitSettings) -> anyhow::Result<&Guessed> {
        let FitSettings { objective, tree_seed, seed, .. } = *settings;
        let is_same = |known: &(Objective, TreeSeed, u64, Guessed)| {
            (known.0, known.1, known.2) == (objective, tree_seed, seed)
        };
        let at = match self.known.iter().position(is_same) {
            Some(at) => at,
            None => {
                let started = Instant::now();
                let found = first_guess(
                    problem,
                    settings,
                    &candidates(problem),
                    &GuessSettings::default(),
                    stop::flag(),
                    |_, _| (),
                )?;
                let guessed = Guessed { found, seconds: started.elapsed() };
                self.known.push((objective, tree_seed, seed, guessed));
                self.known.len() - 1
            }
        };
        Ok(&self.known[at].3)
    }
}

pub(super) fn fit(
    problem: &Problem,
    guesses: &mut Guesses,
    method: &MethodSpec,
    seed: u64,
) -> anyhow::Result<Attempt> {
    let mut fit = problem.fit.clone();
    let budget = Budget {
        evaluations: method.evaluations.map(|n| *n),
        timeout: method.seconds.map(|seconds| Duration::try_from_secs_f64(*seconds)).transpose()?,
        ..Budget::default()
    };
    let mut settings = FitSettings {
        optimizer: method.optimizer.value.clone(),
        budget,
        seed,
        tree_seed: if method.any_seed { TreeSeed::Any } else { TreeSeed::Fixed(TREE_SEED) },
        objective: method.objective.as_ref().map(|word| word.value).unwrap_or_default(),
        ..FitSettings::default()
    };
    let mut first = None;
    match method.from {
        From::Auto => {
            let Guessed { found, seconds } = guesses.of(&fit, &settings)?;
            fit.base = found.nearest[0].values.clone();
            settings.start = Start::Lists(found.nearest.iter().map(|guess| guess.values.clone()).collect());
            let (name, confidence) = found.names[0].clone();
            first = Some((name, confidence, *seconds));
        }
        From::Random => (),
    }
    let guess = first.as_ref().map(|_| Genome::new(fit.base.clone(), TREE_SEED));
    let (named, confidence, before) = first.map_or_else(Default::default, |(name, confidence, seconds)| {
        (name, Some(Fixed(confidence)), seconds)
    });
    let started = Instant::now();
    let clock = || before + started.elapsed();
    let outcome = pleach_fit::fit(&fit, &settings, Control::new(&clock, stop::flag()))?;
    let seconds = clock().as_secs_f64();
    let best = outcome.best.filter(|best| best.score.cost.is_finite()).context("nothing grew")?.genome;

    let card = |genome: &Genome| -> anyhow::Result<ScoreCard> {
        Ok(ScoreCard::of(&goals::draw(&fit, genome, &fit.goals[0])?, &fit.goals[0].goal)?)
    };
    let scores = card(&best)?;
    let guessed = guess.as_ref().map(card).transpose()?;
    let judged = problem.clean.as_ref().unwrap_or(&problem.fit);
    let fresh = fresh_seeds(judged, settings.objective, Limits::default(), &best, FRESH, stop::flag())?;
    let clean = problem.clean.as_ref().map(|clean| alike(problem, &best, &clean.goals[0])).transpose()?;
    let held_out = problem.held_out.as_ref().map(|view| alike(problem, &best, view)).transpose()?;
    let ceiling = problem.ceiling;
    let of_fresh = |of: fn(&FreshSeeds) -> f64| fresh.as_ref().map(|fresh| Fixed(of(fresh)));
    // The ellipse scores nothing and other trees of the true parameters all that can be asked for.
    let skill = fresh.as_ref().zip(ceiling).map(|(fresh, ceiling)| {
        let floor = scores.best_ellipse_iou;
        Fixed((fresh.iou.mean - floor) / (ceiling.iou - floor))
    });
    let row = Fit {
        goal: problem.name.clone(),
        kind: problem.spec.kind().name().to_owned(),
        method: method.name.clone(),
        repetition: seed,
        evaluations: outcome.evaluations,
        named,
        confidence,
        guess_likeness: guessed.as_ref().map(|card| Fixed(card.likeness)),
        guess_iou: guessed.as_ref().map(|card| Fixed(card.iou)),
        likeness: Fixed(scores.likeness),
        iou: Fixed(scores.iou),
        blurred_iou_64: Fixed(scores.blurred_iou.sixty_fourth),
        boundary_f: Fixed(scores.boundary_f),
        pixel_accuracy: Fixed(scores.pixel_accuracy),
        empty_accuracy: Fixed(scores.empty_accuracy),
        best_ellipse_iou: Fixed(scores.best_ellipse_iou),
        clean_likeness: clean.map(|[likeness, _]| Fixed(likeness)),
        clean_iou: clean.map(|[_, iou]| Fixed(iou)),
        held_out_likeness: held_out.map(|[likeness, _]| Fixed(likeness)),
        held_out_iou: held_out.map(|[_, iou]| Fixed(iou)),
        fresh_likeness: of_fresh(|fresh| fresh.likeness.mean),
        fresh_likeness_sd: of_fresh(|fresh| fresh.likeness.sd),
        fresh_iou: of_fresh(|fresh| fresh.iou.mean),
        fresh_iou_sd: of_fresh(|fresh| fresh.iou.sd),
        ceiling_likeness: ceiling.map(|ceiling| Fixed(ceiling.likeness)),
        ceiling_iou: ceiling.map(|ceiling| Fixed(ceiling.iou)),
        skill,
        wall_s: Fixed(seconds),
    };
    Ok(Attempt { row, best, guess })
}

/// Likeness and IoU of an individual in `view`.
fn alike(problem: &Problem, genome: &Genome, view: &pleach_fit::GoalView) -> anyhow::Result<[f64; 2]> {
    let picture = goals::draw(&problem.fit, genome, view)?;
    Ok([Likeness::of(&picture, &view.goal).value(), goals::iou(&picture, &view.goal)])
}

/// The known species as candidates of a first guess.
fn candidates(problem: &FitProblem) -> Vec<Candidate> {
    let species = pleach_generators::names().into_iter().filter_map(pleach_generators::preset);
    species
        .filter(|s| s.generator.model() == problem.generator.model())
        .map(|s| Candidate { name: s.name.clone(), values: s.params.values().to_vec() })
        .collect()
}
