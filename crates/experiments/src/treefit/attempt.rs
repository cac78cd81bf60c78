//! One fit of one goal.

use super::goals::{self, Problem};
use super::spec::{From, MethodSpec};
use super::{FRESH, Fit, stop};
use crate::pictured::draw;
use crate::record::Fixed;
use anyhow::Context;
use pleach_fit::{
    Budget, Candidate, Control, FirstGuess, FitProblem, FitSettings, FreshSeeds, GoalSettings, GoalView,
    GuessSettings, Guessing, Objective, Start, TreeSeed, first_guess, fit_goal, fresh_seeds,
};
use pleach_generators::GeneratorChoice;
use pleach_least_cost_path::{SideView, species_around};
use pleach_silhouette::outline;
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::score::likeness::Likeness;
use pleach_tree::{Limits, Species};
use std::time::{Duration, Instant};

/// Seed of the trees that are fitted; own goals are of other seeds.
const TREE_SEED: u64 = 1;

/// The result of a fit.
pub(super) struct Attempt {
    pub(super) row: Fit,
    pub(super) best: Species,
    /// The nearest tree before the search.
    pub(super) guess: Option<Species>,
}

/// First guesses of one goal: several methods start from the same.
#[derive(Default)]
pub(super) struct Guesses {
    known: Vec<(Asked, Guessed)>,
}

/// The inputs of a first guess: generators, objective, tree seed, seed.
type Asked = (GeneratorChoice, Objective, TreeSeed, u64);

struct Guessed {
    found: FirstGuess,
    seconds: Duration,
}

impl Guesses {
    fn get(
        &mut self,
        problem: &FitProblem,
        settings: &FitSettings,
        generator: GeneratorChoice,
    ) -> anyhow::Result<&Guessed> {
        let asked = (generator, settings.objective, settings.tree_seed, settings.seed);
        let at = match self.known.iter().position(|(known, _)| *known == asked) {
            Some(at) => at,
            None => {
                let started = Instant::now();
                let found = first_guess(
                    problem,
                    settings,
                    &generator.known().map(Candidate::from).collect::<Vec<_>>(),
                    &GuessSettings::default(),
                    stop::flag(),
                    |_, _| (),
                )?;
                let guessed = Guessed { found, seconds: started.elapsed() };
                self.known.push((asked, guessed));
                self.known.len() - 1
            }
        };
        Ok(&self.known[at].1)
    }
}

/// A tree of least-cost paths in the outline of `goal`, and the lists of numbers to start from.
fn outlined(goal: &GoalView) -> anyhow::Result<(Species, Vec<Vec<f64>>)> {
    let (_, top, _, _) = goal.goal.ink_box().context("the goal is empty")?;
    let height = (goal.frame.ground_row - f64::from(top)) * goal.frame.meters_per_pixel;
    let rows = outline(&goal.goal, &goal.frame, height);
    let side = SideView { azimuth: goal.view.azimuth, rows };
    species_around(&[side], height).context("the goal has no outline")
}

pub(super) fn fit(
    problem: &Problem,
    guesses: &mut Guesses,
    method: &MethodSpec,
    seed: u64,
) -> anyhow::Result<Attempt> {
    let budget = Budget {
        evaluations: method.evaluations.map(|n| *n),
        timeout: method.seconds.map(|seconds| Duration::try_from_secs_f64(*seconds)).transpose()?,
        ..Budget::default()
    };
    let mut search = FitSettings {
        optimizer: method.optimizer.value.clone(),
        budget,
        seed,
        tree_seed: if method.any_seed { TreeSeed::Any } else { TreeSeed::Fixed(TREE_SEED) },
        objective: method.objective.as_ref().map(|word| word.value).unwrap_or_default(),
        ..FitSettings::default()
    };
    let begun = Instant::now();
    let mut asked = problem.fit.clone();
    let (guess, before) = match method.from {
        From::Auto => {
            let Guessed { found, seconds } = guesses.get(&problem.fit, &search, method.generator())?;
            (Guessing::Known(Box::new(found.clone())), *seconds)
        }
        From::Random => (Guessing::Off, Duration::ZERO),
        From::Outline => {
            let (species, lists) = outlined(&problem.fit.goals[0])?;
            asked.start = species;
            search.start = Start::Lists(lists);
            (Guessing::Off, begun.elapsed())
        }
    };
    let started = Instant::now();
    let clock = || before + started.elapsed();
    // Judged below, by the whole picture where the goal is spoilt.
    let validates = method.validates;
    let settings =
        GoalSettings { search, guess, validates, assessment: None, ..GoalSettings::new(Vec::new()) };
    let fitted = fit_goal(&asked, &settings, Control::new(&clock, stop::flag()))?;
    let seconds = clock().as_secs_f64();
    let best = fitted.species()?;
    let start = Species { tree_seed: Some(TREE_SEED), ..fitted.problem.start.clone() };
    let guess = fitted.guess.as_ref().map(|_| start);
    let (named, confidence) = fitted.guess.as_ref().map_or_else(Default::default, |guess| {
        let (name, confidence) = &guess.names[0];
        (name.clone(), Some(Fixed(*confidence)))
    });

    let drawn = |species: &Species, view: &GoalView| {
        draw(species, species.tree_seed.unwrap_or(TREE_SEED), fitted.problem.foliage, view)
    };
    let card = |species: &Species| -> anyhow::Result<ScoreCard> {
        let goal = &fitted.problem.goals[0];
        Ok(ScoreCard::new(&drawn(species, goal)?, &goal.goal)?)
    };
    // Likeness and IoU of the result in `view`.
    let alike = |view: &GoalView| -> anyhow::Result<[f64; 2]> {
        let picture = drawn(&best, view)?;
        Ok([Likeness::between(&picture, &view.goal).value(), goals::iou(&picture, &view.goal)])
    };
    let scores = card(&best)?;
    let guessed = guess.as_ref().map(card).transpose()?;
    let judged = problem.clean.as_ref().unwrap_or(&problem.fit);
    let judged = FitProblem { start: fitted.problem.start.clone(), ..judged.clone() };
    let (objective, genome) = (fitted.settings.objective, &fitted.best.genome);
    let fresh = fresh_seeds(&judged, objective, Limits::default(), genome, FRESH, stop::flag().into())?;
    let clean = problem.clean.as_ref().map(|clean| alike(&clean.goals[0])).transpose()?;
    let held_out = problem.held_out.as_ref().map(alike).transpose()?;
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
        evaluations: fitted.outcome.evaluations,
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
