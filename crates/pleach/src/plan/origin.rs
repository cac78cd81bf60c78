//! Where a fit begins.

use pleach_fit::{
    Candidate, Contradictions, FitSettings, GoalSettings, GuessSettings, Guessing, RaceCriterion,
    RaceSettings, SpaceError, Start, check_freedom,
};
use pleach_generators::GeneratorChoice;
use pleach_tree::Appearance;
use pleach_tree::Species;

/// Where a fit begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// At the known species that the goal looks like.
    Guess {
        /// Whether it is looked for too whether the goal's tree has leaves.
        detect_leaves: bool,
    },
    /// At random lists of numbers.
    Random,
    /// At the numbers of the species at hand.
    Start,
}

/// The whole fit, judged, without this very tree: `search` begins at `origin`, and the known species of
/// `generator` are what a guess is made among and what the result stands beside. `start` is the problem's own
/// species.
///
/// # Errors
/// If a pattern of [`FitSettings::freedom`] names no parameter of any species that takes part, or leaves none free.
pub fn plan(
    origin: Origin,
    generator: GeneratorChoice,
    start: &Species,
    mut search: FitSettings,
) -> Result<GoalSettings, SpaceError> {
    let check =
        |species: &Species| check_freedom(species.generator.space(), &search.freedom, search.tree_seed);
    let mut candidates: Vec<Candidate> = generator.known().map(Candidate::from).collect();
    let guess = if let Origin::Guess { detect_leaves } = origin {
        candidates.retain(|candidate| check(&candidate.species).is_ok());
        if candidates.is_empty() {
            check(start)?;
        }
        let contradictions = Contradictions::Counted;
        // A real tree was grown by none of them.
        let criterion = match generator {
            GeneratorChoice::Trees => RaceCriterion::Cost,
            _ => RaceCriterion::Origin,
        };
        let race = Some(RaceSettings { criterion, ..RaceSettings::default() });
        Guessing::Compare(GuessSettings { detect_leaves, contradictions, race, ..GuessSettings::default() })
    } else {
        check(start)?;
        let lists = || Start::Lists(vec![start.params.values().to_vec()]);
        search.start = if origin == Origin::Start { lists() } else { Start::Random };
        Guessing::Off
    };
    Ok(GoalSettings { search, guess, ..GoalSettings::new(candidates) })
}

/// The species whose generator is searched where a fit begins at none: the first of `generator`'s, without colours.
/// There is one of every generator.
#[must_use]
pub fn usual_start(generator: GeneratorChoice) -> Option<Species> {
    let first = generator.known().next()?;
    Some(Species { appearance: Appearance::default(), ..first })
}

/// Whether any species of `generator` has stems whose draws can be changed one by one. Where none has, a fit ends with
/// the kind, and its search has all the time.
#[must_use]
pub fn has_individuals(generator: GeneratorChoice) -> bool {
    generator.known().any(|species| !species.generator.spreads(species.params.values()).is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_fit::Freedom;

    fn planned(origin: Origin, freedom: &[&str]) -> Result<GoalSettings, SpaceError> {
        let free = freedom.iter().map(|pattern| (*pattern).to_owned()).collect();
        let search = FitSettings { freedom: Freedom { free, fix: Vec::new() }, ..FitSettings::default() };
        plan(origin, GeneratorChoice::Auto, &pleach_generators::species("palm").unwrap(), search)
    }

    #[test]
    fn a_fit_begins_where_it_is_told_to() {
        let guessed = planned(Origin::Guess { detect_leaves: true }, &[]).unwrap();
        assert!(matches!(guessed.guess, Guessing::Compare(how) if how.detect_leaves));
        assert_eq!(guessed.candidates[0].species.name, "quaking_aspen");
        let natural: Vec<&str> = pleach_generators::natural_names().collect();
        assert_eq!(guessed.candidates.len() + natural.len(), pleach_generators::names().len());
        assert!(guessed.candidates.iter().all(|one| !natural.contains(&one.species.name.as_str())));
        assert_eq!(planned(Origin::Random, &[]).unwrap().search.start, Start::Random);
        let palm = pleach_generators::species("palm").unwrap();
        let lists = Start::Lists(vec![palm.params.values().to_vec()]);
        assert_eq!(planned(Origin::Start, &[]).unwrap().search.start, lists);
    }

    #[test]
    fn patterns_that_name_nothing_are_refused_before_a_guess() {
        for origin in [Origin::Guess { detect_leaves: true }, Origin::Random, Origin::Start] {
            let error = planned(origin, &["lenght"]).unwrap_err().to_string();
            assert!(error.contains("lenght"), "{error}");
        }
    }
}
