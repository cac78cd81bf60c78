//! Trees whose numbers follow from the goal's picture by regression: a search starts from them.

use super::contradiction::{NO_START, contradiction};
use super::goal_context::{GoalContext, is_level};
use super::measured::draw;
use super::ranking::Alike;
use crate::control::interrupt;
use crate::error::FitError;
use crate::predictor::Predictors;
use crate::problem::Genome;
use pleach_reading::Reader;
use pleach_silhouette::Bitmap;
use pleach_tree::{Foliage, Species};

/// So many candidates, those that look most like the goal.
const CANDIDATES: usize = 4;

/// The trees of the likeliest candidates as the first goal shows them; `costs` is 1 minus the likeness of each candidate's
/// most similar tree. None where nothing was learnt.
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
    // The seed that the search uses is that of all trees that it may start from.
    let Some((_, _, first)) = alike.first() else { return Ok(Vec::new()) };
    let known: Vec<(usize, Vec<f64>)> = likeliest
        .into_iter()
        .zip(numbers)
        .filter_map(|(candidate, values)| Some((candidate, values?)))
        .collect();
    let of = |candidate: usize, genome: &Genome| {
        let Some(reading) = &context.reading else { return Some(0.0) };
        let (mut picture, mut reader) = (Bitmap::default(), Reader::new());
        draw(context, candidate, genome, foliage, &mut picture)?;
        let trunks = species(candidate).generator.trunks(&genome.values);
        Some(context.weight * contradiction(reading, &picture, trunks, &mut reader))
    };
    // A prediction sees a silhouette, and not what was read of it or said by a person.
    let allowed = alike.first().and_then(|(_, candidate, genome)| of(*candidate, genome)).unwrap_or_default();
    let found = interrupt::map(&known, context.stop, |(candidate, values)| {
        let genome = Genome { values: values.clone(), ..first.clone() };
        let values = context.models.evaluator(*candidate).pictures(&genome, |_| ())?;
        let genome = Genome { values, ..genome };
        (of(*candidate, &genome)? <= allowed + NO_START).then_some((costs[*candidate], *candidate, genome))
    })?;
    Ok(found.into_iter().flatten().collect())
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
        let bytes = Predictors::record(std::slice::from_ref(&palm), 400, &stop, |_, _| ()).unwrap();
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
            let cost = |one: usize, found: &crate::guess::FirstGuess| (one, found.nearest[0].score.cost);
            for (one, cost) in [cost(0, &known), cost(1, &predicted)] {
                costs[one] += cost;
            }
            assert!(predicted.nearest[0].score.cost <= known.nearest[0].score.cost);
            assert_eq!(predicted.names, known.names);
        }
        assert!(costs[1] < 0.95 * costs[0], "{costs:?}");
    }
}
