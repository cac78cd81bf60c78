//! Trees whose numbers follow from the goal's picture by regression: a search starts from them.

use super::contradiction::NO_START;
use super::goal_context::{GoalContext, is_level};
use super::library::{GuessLibrary, Resemblance, compare_once};
use super::ranking::Alike;
use super::samples::Sample;
use crate::error::FitError;
use crate::predictor::{Answer, Predictors};
use crate::problem::{FitProblem, Genome};
use pleach_tree::{Foliage, Species};

impl GuessLibrary {
    /// The numbers of the first goal's tree, if it is one around the start of `problem`; `None` where nothing was learnt
    /// about that.
    pub(crate) fn predicted(&self, problem: &FitProblem) -> Option<Vec<f64>> {
        let goal = problem.goals.first().filter(|goal| is_level(&goal.view))?;
        self.predictors.as_ref()?.predict(&goal.goal, problem.foliage, [&problem.start]).pop()?
    }

    /// What the first goal says about the numbers of its tree, if that is one around `species`.
    pub(crate) fn answer(&self, problem: &FitProblem, species: &Species) -> Option<Answer> {
        let goal = problem.goals.first().filter(|goal| is_level(&goal.view))?;
        let is_of_them = species.generator.model() == problem.start.generator.model();
        let predictors = self.predictors.as_ref().filter(|_| is_of_them)?;
        predictors.answer(&goal.goal, goal.frame.meters_per_pixel, problem.foliage, species)
    }
}

/// So many candidates, those that look most like the goal.
const CANDIDATES: usize = 4;

/// The trees of the likeliest candidates as the first goal shows them, at its height; `costs` is 1 minus the likeness of
/// each candidate's most similar tree, `alike` begins with the known tree that is nearest. None where nothing was learnt, and
/// none that contradicts what was read of the goal more than that tree does.
pub(super) fn predicted(
    context: &GoalContext<'_>,
    predictors: Option<&Predictors>,
    costs: &[f64],
    alike: &[Alike],
    foliage: Foliage,
) -> Result<Vec<Alike>, FitError> {
    let goal = context.problem.goals.first().filter(|goal| is_level(&goal.view));
    let (Some(predictors), Some(goal)) = (predictors, goal) else { return Ok(Vec::new()) };
    let mut likeliest: Vec<usize> = (0..costs.len()).filter(|&one| costs[one].is_finite()).collect();
    likeliest.sort_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    likeliest.truncate(CANDIDATES);
    let species = |candidate: usize| -> &Species { &context.candidates[candidate].species };
    let numbers = predictors.predict(&goal.goal, foliage, likeliest.iter().map(|&one| species(one)));
    let Some((_, nearest, first)) = alike.first() else { return Ok(Vec::new()) };
    // The seed that the search uses is that of all trees that it may start from.
    let sample = |candidate, values| {
        let genome = Genome { values, ..first.clone() };
        Sample { candidate, is_species: false, is_first: false, may_start: true, genome }
    };
    let predicted = likeliest.iter().zip(numbers).filter_map(|(&one, values)| Some(sample(one, values?)));
    let samples: Vec<Sample> =
        std::iter::once(sample(*nearest, first.values.clone())).chain(predicted).collect();
    let compared = compare_once(context, samples.clone(), foliage)?;
    // A prediction sees a silhouette, and not what was read of it or said by a person.
    let own = compared[0].as_ref().map_or(0.0, |nearest| nearest.contradiction);
    let start = |(sample, found): (Sample, Option<Resemblance>)| {
        let found = found.filter(|found| found.contradiction <= own + NO_START)?;
        let Sample { candidate, mut genome, .. } = sample;
        context.resize(candidate, &mut genome.values, found.factor);
        Some((1.0 - found.likeness + found.contradiction, candidate, genome))
    };
    Ok(samples.into_iter().zip(compared).skip(1).filter_map(start).collect())
}

#[cfg(test)]
mod tests {
    use crate::guess::{Candidate, GuessLibrary, GuessSettings};
    use crate::posterior::Prior;
    use crate::predictor::Predictors;
    use crate::problem::{FitProblem, GoalView};
    use crate::run::FitSettings;
    use crate::space::Freedom;
    use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
    use pleach_tree::Parts;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_search_starts_nearer_to_trees_that_no_library_has() {
        let palm = pleach_generators::preset("palm").unwrap().clone();
        let stop = AtomicBool::new(false);
        let bytes = Predictors::record(std::slice::from_ref(&palm), 400, &(), &stop, |_, _| ()).unwrap();
        let predictors = Predictors::from_bytes(&bytes).unwrap();
        let prior = Prior::new(&palm, &Freedom::default(), Prior::SPREAD).unwrap();
        let mut costs = [0.0; 2];
        for number in 0..6 {
            let (_, tree) = prior.sample(3, number).unwrap();
            let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 128, 128);
            let mut goal = Bitmap::default();
            Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
            let problem = FitProblem::new(palm.clone(), GoalView::new(goal, View::FRONT, frame));
            let guess = |library: GuessLibrary| {
                let (settings, candidates) = (FitSettings::default(), [Candidate::from(palm.clone())]);
                let how = GuessSettings { variants: 4, race: None, ..GuessSettings::default() };
                let mut library = library.for_one_goal();
                library.first_guess(&problem, &settings, &candidates, &how, &stop, |_, _| ()).unwrap()
            };
            let [known, predicted] =
                [GuessLibrary::new(), GuessLibrary::new().with_predictors(predictors.clone())].map(guess);
            let own = [&known, &predicted].map(|found| found.nearest[0].score.cost);
            assert!(own[1] <= own[0]);
            costs.iter_mut().zip(own).for_each(|(sum, cost)| *sum += cost);
            assert_eq!(predicted.names, known.names);
        }
        assert!(costs[1] < 0.95 * costs[0], "{costs:?}");
    }
}
