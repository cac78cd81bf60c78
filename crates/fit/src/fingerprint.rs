//! What makes two runs the same run.

use crate::problem::{FitProblem, GoalView};
use crate::settings::FitSettings;
use pleach_tree::{Fnv, Foliage};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Named hashes of everything that decides the course of a fit; budgets are not part of it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Fingerprint {
    /// Family of generators and optimiser, without spaces: for people.
    of: String,
    parts: Vec<(Cow<'static, str>, u64)>,
}

impl Fingerprint {
    /// That of a fit of `problem`.
    pub(crate) fn from_fit(problem: &FitProblem, settings: &FitSettings) -> Self {
        let limits = &settings.limits;
        let of = format!("{}/{}", problem.start.generator.family(), settings.method_name());
        let parts = goal_parts(problem)
            .into_iter()
            .fold(Self::named(&of), |parts, (name, bytes)| parts.with_bytes(name, bytes))
            .with_bytes("generator", problem.start.generator.model().to_string())
            .with("fixed values", problem.start.params.values())
            .with("free parameters", &settings.freedom)
            .with("optimizer", &settings.optimizer)
            .with("seed", &settings.seed)
            .with("tree seed", &settings.tree_seed)
            .with("robust", &settings.robust)
            .with("objective", &settings.objective)
            .with("start", &settings.start)
            .with("limits", &(limits.stems, limits.leaves, limits.knots, limits.work));
        match &settings.rules {
            Some(rules) => parts.with("the search over rules", rules),
            None => parts,
        }
    }

    /// Without parts, of a run that is called `of`.
    pub(crate) fn named(of: &str) -> Self {
        Self { of: of.replace(char::is_whitespace, "-"), parts: Vec::new() }
    }

    /// What the run is of, as one word.
    pub(crate) fn of(&self) -> &str {
        &self.of
    }

    /// Adds the part called `name`: whatever `value` says when written as JSON.
    ///
    /// # Panics
    /// If `value` cannot be written as JSON: a mistake in this crate's types.
    #[must_use]
    pub(crate) fn with<T: Serialize + ?Sized>(self, name: &'static str, value: &T) -> Self {
        let text = serde_json::to_vec(value).expect("settings are plain values");
        self.with_bytes(name, text)
    }

    /// Adds the part called `name`, made of `bytes`.
    #[must_use]
    pub(crate) fn with_bytes(mut self, name: &'static str, bytes: impl AsRef<[u8]>) -> Self {
        self.parts.push((name.into(), Fnv::hash(bytes.as_ref())));
        self
    }

    /// The names of the parts of `asked` that are missing here or are not the same.
    #[must_use]
    pub(crate) fn differences(&self, asked: &Self) -> Vec<&'static str> {
        let known: Vec<&'static str> = asked
            .parts
            .iter()
            .filter(|part| !self.parts.contains(part))
            .map(|(name, _)| match name {
                Cow::Borrowed(name) => *name,
                Cow::Owned(_) => "a part of another version",
            })
            .collect();
        if known.is_empty() && self.parts.len() != asked.parts.len() {
            return vec!["a part of another version"];
        }
        known
    }
}

/// The goals, where they were taken from and how large their trees are: by name, so that a run that
/// differs in one of them can say in which.
fn goal_parts(problem: &FitProblem) -> [(&'static str, Vec<u8>); 4] {
    let mut pictures = Vec::new();
    let mut scales = String::new();
    let mut views = String::new();
    for GoalView { goal, view, frame, unknown, accuracy, registered } in &problem.goals {
        pictures.extend(format!("{} {}\n", goal.width(), goal.height()).bytes());
        pictures.extend(goal.words().iter().flat_map(|word| word.to_le_bytes()));
        // What is asked for is the tree's height; the scale follows from it and the picture.
        let top = goal.ink_box().map_or(0, |(_, top, _, _)| top);
        let height = (frame.ground_row - f64::from(top)) * frame.meters_per_pixel;
        scales += &format!("{height:.6}\n");
        views += &format!("{view:?} {unknown:?} {:?} {:?}\n", frame.axis_column, frame.ground_row);
        views += &format!("{accuracy:?} {registered:?}\n");
    }
    let leaves = vec![u8::from(problem.foliage != Foliage::None)];
    [
        ("the goal's picture", pictures),
        ("the tree's height (--height)", scales.into_bytes()),
        ("view, ground or trunk", views.into_bytes()),
        ("leaves (--leaves)", leaves),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_named() {
        let one = Fingerprint::default().with("goal", "a").with("seed", &1);
        let two = Fingerprint::default().with("goal", "a").with("seed", &2);
        assert!(one.differences(&one.clone()).is_empty());
        assert_eq!(one.differences(&two), ["seed"]);
        assert_eq!(Fingerprint::default().differences(&one), ["goal", "seed"]);
        assert_eq!(one.differences(&Fingerprint::default()), ["a part of another version"]);
    }
}
