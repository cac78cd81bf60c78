//! How well a goal determines each parameter, and between which values it lies.

use super::report_parts::{IntervalsReport, ParameterReport};
use pleach_fit::{Fitted, Identifiability, Posterior, PosteriorNumber};
use pleach_tree::Species;

/// What is known of the numbers of the goal's tree: learnt for this fit if it was asked for, else what is built in.
struct Known<'a> {
    species: &'a str,
    familiarity: f64,
    numbers: &'a [PosteriorNumber],
}

impl<'a> Known<'a> {
    fn new(fitted: &'a Fitted) -> Option<Self> {
        let own = fitted.posterior.as_ref().map(|learnt| Self {
            species: &fitted.problem.start.name,
            familiarity: learnt.familiarity,
            numbers: &learnt.numbers,
        });
        own.or_else(|| {
            fitted.answer.as_ref().map(|answer| Self {
                species: &answer.species,
                familiarity: answer.familiarity,
                numbers: &answer.numbers,
            })
        })
    }

    fn is_familiar(&self) -> bool {
        self.familiarity >= Posterior::STRANGE
    }
}

/// Every free parameter of a result that was judged.
pub(super) fn parameters(fitted: &Fitted, species: &Species) -> Vec<ParameterReport> {
    let space = species.generator.space();
    let known = Known::new(fitted);
    let profiles = fitted.assessment.iter().flat_map(|assessment| &assessment.profiles);
    profiles
        .map(|profile| {
            let number =
                known.as_ref().and_then(|known| known.numbers.iter().find(|n| n.slot == profile.slot));
            let interval = number.filter(|_| known.as_ref().is_some_and(Known::is_familiar));
            ParameterReport {
                slot: space.slot_name(profile.slot),
                value: fitted.best.genome.values[profile.slot.index()],
                seen: number.map_or(profile.seen, |number| Identifiability::from_shrunk(number.shrunk)),
                shrunk: number.map(|number| number.shrunk),
                interval: interval.map(|number| number.posterior),
                before: interval.map(|number| number.prior),
            }
        })
        .collect()
}

/// What the intervals are learnt from; `None` where nothing is known of such trees.
pub(super) fn intervals(fitted: &Fitted) -> Option<IntervalsReport> {
    let known = Known::new(fitted)?;
    let (species, familiarity, is_familiar) =
        (known.species.to_owned(), known.familiarity, known.is_familiar());
    Some(IntervalsReport { species, familiarity, is_familiar })
}
