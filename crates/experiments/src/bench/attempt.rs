//! A contestant at work on a goal.

use super::answer::Answer;
use super::budget::Budget;
use super::contestant::Contestant;
use super::goal::Goal;
use super::row::Row;
use crate::pictured::SIZE;
use crate::record::Fixed;
use crate::stop;
use anyhow::{Context, bail};
use pleach::plan::library;
use pleach::{Effort, FitOptions, FitSource, KnownFrame, Prepared, StartFrom};
use pleach_fit::{Control, Evaluator, FirstGuess, FitError, FitProblem, Genome, GuessLibrary, Guessing};
use pleach_generators::GeneratorChoice;
use pleach_silhouette::score::best_ellipse;
use pleach_tree::{Limits, Species};
use std::time::Instant;

/// The seed of the tree that fits look at, and of a known species as it is.
const TREE_SEED: u64 = 1;

/// What contestants know before they see a goal.
pub(super) struct Arena {
    /// The known species, and the predictors that have seen many trees.
    library: GuessLibrary,
    /// The known species alone.
    known: GuessLibrary,
}

impl Arena {
    pub(super) fn new() -> anyhow::Result<Self> {
        let library = library();
        let drawings = library.drawings().cloned().context("drawings are built in")?;
        Ok(Self { library, known: GuessLibrary::with_drawings(drawings) })
    }

    /// The row of `contestant` on `goal`.
    pub(super) fn row(&mut self, contestant: Contestant, goal: &Goal, budget: Budget) -> anyhow::Result<Row> {
        let started = Instant::now();
        let (answer, trees) = self.answer(contestant, goal, budget)?;
        let seconds = started.elapsed().as_secs_f64();
        Ok(Row {
            row: contestant.name().to_owned(),
            budget,
            wall_trees: trees,
            wall_s: Some(Fixed(seconds)),
            ..answer.row(goal)?
        })
    }

    /// The answer, and how many trees a search has grown for it.
    fn answer(
        &mut self,
        contestant: Contestant,
        goal: &Goal,
        budget: Budget,
    ) -> anyhow::Result<(Answer, Option<u64>)> {
        let answer = match contestant {
            Contestant::Truth => {
                let own = goal.own.as_ref().context("the goal's own numbers are not known")?;
                Answer::tree(own.truth.species.clone(), own.truth.seed.wrapping_add(1))
            }
            Contestant::Ellipse => Answer::Picture(best_ellipse(goal.picture())),
            Contestant::Guess => {
                let found = guess(&mut self.library, &prepared(contestant, goal, budget)?)?;
                Answer::tree(Species { foliage: found.foliage, ..found.species }, TREE_SEED)
            }
            Contestant::Retrieval => nearest(&mut self.known, &prepared(contestant, goal, budget)?)?,
            Contestant::Default
            | Contestant::Cma
            | Contestant::De
            | Contestant::Hewitt
            | Contestant::Random => return search(&mut self.library, &prepared(contestant, goal, budget)?),
        };
        Ok((answer, None))
    }
}

/// A fit as the program makes it of the picture in its frame, but for the assessment of what was found: the exam does
/// that for all contestants alike.
fn prepared(contestant: Contestant, goal: &Goal, budget: Budget) -> anyhow::Result<Prepared> {
    let frame = goal.frame();
    let mut options = FitOptions {
        frame: Some(KnownFrame {
            meters_per_pixel: frame.meters_per_pixel,
            axis_column: frame.axis_column,
            ground_row: frame.ground_row,
        }),
        size: SIZE,
        individual: Effort::Off,
        evaluations: budget.trees(),
        timeout: budget.timeout()?,
        ..FitOptions::default()
    };
    if let Some((optimizer, from_random)) = contestant.search() {
        options.optimizer = optimizer;
        if from_random {
            options.from = StartFrom::Random;
            options.generator = Some(GeneratorChoice::default());
        }
    }
    let mut prepared = options.prepare(&FitSource::from(goal.picture().clone()))?;
    prepared.settings.assessment = None;
    // A race between generators grows trees that no budget of trees counts.
    if let (Guessing::Compare(how), None) = (&mut prepared.settings.guess, options.timeout) {
        how.race = None;
    }
    Ok(prepared)
}

fn search(library: &mut GuessLibrary, prepared: &Prepared) -> anyhow::Result<(Answer, Option<u64>)> {
    let started = Instant::now();
    let clock = || started.elapsed();
    let fitted = match prepared.fit(library, Control::new(&clock, stop::flag())) {
        Ok(fitted) => fitted,
        Err(FitError::NothingGrew { evaluations }) => return Ok((Answer::Nothing, Some(evaluations))),
        Err(error) => return Err(error.into()),
    };
    let species = Species {
        foliage: fitted.problem.foliage,
        name: fitted.problem.start.name.clone(),
        ..fitted.species()?
    };
    Ok((Answer::tree(species, fitted.best.genome.tree_seed), Some(fitted.outcome.evaluations)))
}

/// The first guess that a fit begins with.
fn guess(library: &mut GuessLibrary, prepared: &Prepared) -> anyhow::Result<FirstGuess> {
    let Guessing::Compare(how) = &prepared.settings.guess else { bail!("the fit begins without a guess") };
    let (search, candidates) = (&prepared.settings.search, &prepared.settings.candidates);
    Ok(library.first_guess(&prepared.problem, search, candidates, how, stop::flag(), |_, _| ())?)
}

/// The known species that the goal is named after, as it is in its file but for its height.
fn nearest(library: &mut GuessLibrary, prepared: &Prepared) -> anyhow::Result<Answer> {
    let found = guess(library, prepared)?;
    let (name, _) = found.names.first().context("the goal looks like no known species")?;
    let named = prepared.settings.candidates.iter().find(|one| one.species.name == *name);
    let start =
        Species { foliage: found.foliage, ..named.context("a name is a candidate's")?.species.clone() };
    let problem = FitProblem { foliage: found.foliage, start, ..prepared.problem.clone() };
    let objective = prepared.settings.search.objective;
    let evaluator = Evaluator::new(&problem, objective, Limits::DEFAULT)?.with_height_matching();
    let own = Genome::new(problem.start.params.values().to_vec(), TREE_SEED);
    let values = evaluator.pictures(&own, |_| ()).unwrap_or(own.values);
    let params = problem.start.params.space().check(values)?;
    Ok(Answer::tree(Species { params, ..problem.start }, TREE_SEED))
}
