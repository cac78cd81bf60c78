//! The result of a first guess.

use crate::method::Start;
use crate::problem::{FitProblem, Score};
use pleach_tree::{Foliage, Species};
use serde::Serialize;

/// The known species that a goal looks like, before any search.
#[derive(Clone, Debug)]
pub struct FirstGuess {
    /// The species to start from: the nearest candidate with the numbers of the first of `nearest`, in the
    /// colours of the likeliest.
    pub species: Species,
    /// The nearest lists of the species' generator, best first; at least one.
    pub nearest: Vec<Guess>,
    /// The best list of a race, if there was one and it is better than all of these.
    pub raced: Option<Guess>,
    /// How the generators that the goal may be of did in the race, the winner first.
    pub runners: Vec<Runner>,
    /// The candidates of the species' family with the confidence that the goal is theirs, in 0..=1, the
    /// likeliest first; sums to 1.
    pub names: Vec<(String, f64)>,
    /// Whether the goal is taken for a tree with leaves: the value for `FitProblem::foliage`. All of the above is of
    /// such trees.
    pub foliage: Foliage,
    /// Reference values for the likeness of a fit.
    pub references: References,
}

impl FirstGuess {
    /// The lists that a search starts from.
    #[must_use]
    pub fn start(&self) -> Start {
        let lists = self.raced.iter().chain(&self.nearest);
        Start::Lists(lists.map(|guess| guess.values.clone()).collect())
    }

    /// `problem` with the species that it looks like to start from, with leaves or without.
    #[must_use]
    pub fn problem(&self, problem: &FitProblem) -> FitProblem {
        FitProblem { start: self.species.clone(), goals: problem.goals.clone(), foliage: self.foliage }
    }
}

/// One of the nearest lists.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// The candidate that it is, or is a variation of.
    pub name: String,
    /// One value per slot, resized to the goal's height.
    pub values: Vec<f64>,
    /// Its score with the problem's tree seed.
    pub score: Score,
}

/// How a generator did in the race for a goal.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Runner {
    /// Its family.
    pub family: &'static str,
    /// Its species that was nearest to the goal before the race.
    pub species: String,
    /// Likeness of the tree of its family that is most like the goal, before any search.
    pub likeness: f64,
    /// Least cost of its trees before the race: see [`crate::Objective`].
    pub guessed: f64,
    /// Least cost after it; the same where there was no race.
    pub reached: f64,
}

/// Likeness and overlap of two silhouettes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Reference {
    /// Likeness, in 0..=1.
    pub likeness: f64,
    /// Intersection over union, in 0..=1.
    pub iou: f64,
}

/// Reference values for a fit's likeness and overlap, at the size at which the search compares.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct References {
    /// The known species that the goal looks most like; `None` without candidates.
    pub species: Option<String>,
    /// Those of two trees of that species, drawn as the goal is: the mean over pairs of seeds. Other seeds of a fit
    /// cannot do better.
    pub same_species: Option<Reference>,
    /// Those of a tree of another species to the goal: the median over species.
    pub other_species: Option<Reference>,
    /// Those of the best single ellipse to the goal: a shape that is not a tree.
    pub best_ellipse: Reference,
}
