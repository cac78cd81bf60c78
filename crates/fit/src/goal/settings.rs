//! Settings and result of a whole fit.

use super::deadline::Deadline;
use crate::assess::{Assessment, AssessmentSettings, Verdict};
use crate::control::Outcome;
use crate::guess::{Candidate, FirstGuess, GuessSettings, References};
use crate::individual::{FoundIndividual, IndividualSettings};
use crate::posterior::{Posterior, PosteriorSettings};
use crate::predictor::Answer;
use crate::problem::{FitProblem, Scored};
use crate::run::FitSettings;
use pleach_silhouette::score::ScoreCard;
use pleach_tree::param::SlotError;
use pleach_tree::{Slot, Species};

/// Settings of a whole fit, from the first guess to the assessment of the result.
#[derive(Clone, Debug)]
pub struct GoalSettings {
    /// The search. A first guess replaces its `start`.
    pub search: FitSettings,
    /// Where the first guess comes from.
    pub guess: Guessing,
    /// The known species: a first guess is one of them, and a result's likeness is compared with theirs.
    pub candidates: Vec<Candidate>,
    /// Whether the result is chosen among the former bests of the search by trees of other seeds (validation), and
    /// is not simply the last best. No effect where the objective does not use likeness, and for the
    /// dissertation's algorithm and random lists, which are as they were published.
    pub validates: bool,
    /// How the result is assessed; `None` leaves it as the search has found it.
    pub assessment: Option<AssessmentSettings>,
    /// How this very tree is searched among the trees of the kind, after the search; `None`: not at all.
    pub individual: Option<IndividualSettings>,
    /// What is learnt, in the end, about how surely the goal determines each number; `None`: nothing. The prior is around
    /// the species that the search started from.
    pub posterior: Option<PosteriorSettings>,
    /// Deadline of the whole fit, without the posterior, which takes the time that its trees take; `None`: no deadline.
    /// The stages after the search share the time that is left; the last one has all of it: individuals where they take
    /// the rest, assessment where there are none.
    pub deadline: Option<Deadline>,
}

/// Where the species comes from that a fit starts from.
#[derive(Clone, Debug, Default)]
pub enum Guessing {
    /// The species is the problem's; the search starts as its settings say.
    #[default]
    Off,
    /// The candidates are compared with the goal.
    Compare(GuessSettings),
    /// The candidates were compared before, with the same settings of the search.
    Known(Box<FirstGuess>),
}

impl GoalSettings {
    /// The default search from the candidates that look most like the goal, with an assessment and without
    /// individuals.
    #[must_use]
    pub fn new(candidates: Vec<Candidate>) -> Self {
        Self {
            search: FitSettings::default(),
            guess: Guessing::Compare(GuessSettings::default()),
            candidates,
            validates: true,
            assessment: Some(AssessmentSettings::default()),
            individual: None,
            posterior: None,
            deadline: None,
        }
    }
}

/// The result of a whole fit.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The problem, with the species that the search started from; where its structure was searched too, with
    /// the one that was found.
    pub problem: FitProblem,
    /// The settings of the search, with the lists that it started from.
    pub settings: FitSettings,
    /// The first guess, if one was made.
    pub guess: Option<FirstGuess>,
    /// The search. Its stop reason is also [`StopReason::Interrupted`](crate::StopReason::Interrupted) if the
    /// assessment was interrupted.
    pub outcome: Outcome,
    /// The best individual, with numbers that make no difference to the goal where they are expected.
    pub best: Scored,
    /// The slots of those numbers.
    pub as_expected: Vec<Slot>,
    /// The assessment; `None` if the fit was interrupted or none was asked for.
    pub assessment: Option<Assessment>,
    /// This very tree, or several that all lie on the goal, the best first. Empty if none was asked for, the fit was
    /// interrupted, or stems of the generator have no addresses.
    pub individuals: Vec<FoundIndividual>,
    /// What the goal says about the numbers of its tree; `None` if it was not asked for, too few trees of the prior grew,
    /// or the fit was interrupted.
    pub posterior: Option<Posterior>,
    /// What the goal says about the numbers of its tree if that is one around a known species, by what is built in
    /// ([`crate::Predictors::answer`]): around the species that it looks like, or that the fit started from. `None` where
    /// nothing was learnt about that species, and where the goal is not a level view.
    pub answer: Option<Answer>,
}

impl Fitted {
    /// The species that was found, called and coloured as the one that the search started from.
    ///
    /// # Errors
    /// None: a fit finds allowed values.
    pub fn species(&self) -> Result<Species, SlotError> {
        self.problem.species(&self.best.genome)
    }

    /// Reference values for the likeness of the result, if they are known.
    #[must_use]
    pub fn references(&self) -> Option<&References> {
        let assessed = self.assessment.as_ref().map(|assessment| &assessment.references);
        assessed.or_else(|| self.guess.as_ref().map(|guess| &guess.references))
    }

    /// The verdict on the result, whose silhouette scores `card` against the goal; `None` without another tree to
    /// compare with.
    #[must_use]
    pub fn verdict(&self, card: &ScoreCard) -> Option<Verdict> {
        let held_out = self.assessment.as_ref().and_then(|assessment| assessment.held_out.as_ref());
        let fresh = held_out.map(|fresh| fresh.likeness.mean);
        Verdict::new(card.likeness, fresh, self.references()?, &card.crown, &card.goal_crown)
    }
}
