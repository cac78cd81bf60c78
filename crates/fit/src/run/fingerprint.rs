//! The identity of a run: two runs with the same fingerprint give the same bits.

use super::settings::FitSettings;
use crate::problem::{FitProblem, GoalView};
use pleach_silhouette::Frame;
use pleach_tree::{Fnv, Foliage, Limits};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Named hashes of everything that decides the course of a fit; budgets are not part of it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Fingerprint {
    /// Family of generators and optimiser, without spaces, for readers.
    name: String,
    parts: Vec<(Cow<'static, str>, u64)>,
}

impl Fingerprint {
    /// The fingerprint of a fit of `problem`.
    pub(crate) fn from_fit(problem: &FitProblem, settings: &FitSettings) -> Self {
        // Exhaustive, here and below: a new field does not compile before it is in or left out by name.
        let FitProblem { start, goals, foliage } = problem;
        let FitSettings {
            optimizer,
            rules,
            budget: _,
            seed,
            tree_seed,
            robust,
            objective,
            start: lists,
            freedom,
            limits,
        } = settings;
        let Limits { stems, leaves, knots, work } = limits;
        let name = format!("{}/{}", start.generator.family(), settings.method_name());
        goal_parts(goals)
            .into_iter()
            .fold(Self::named(&name), |parts, (name, bytes)| parts.with_bytes(name, bytes))
            .with_bytes("leaves (--leaves)", [u8::from(*foliage != Foliage::None)])
            .with_bytes("generator", start.generator.model().to_string())
            .with("fixed values", start.params.values())
            .with("free parameters", freedom)
            .with("optimizer", optimizer)
            .with("the search over rules", rules)
            .with("seed", seed)
            .with("tree seed", tree_seed)
            .with("robust", robust)
            .with("objective", objective)
            .with("start", lists)
            .with("limits", &(stems, leaves, knots, work))
    }

    /// A fingerprint without parts for a run that is called `name`.
    pub(crate) fn named(name: &str) -> Self {
        Self { name: name.replace(char::is_whitespace, "-"), parts: Vec::new() }
    }

    /// The name of the run, as one word.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Adds the part called `name`: the JSON of `value`.
    ///
    /// # Panics
    /// If `value` cannot be written as JSON: a mistake in this crate's types.
    #[must_use]
    pub(crate) fn with<T: Serialize + ?Sized>(self, name: &'static str, value: &T) -> Self {
        let text = serde_json::to_vec(value).expect("settings are plain values");
        self.with_bytes(name, text)
    }

    /// Adds the part called `name`: `bytes`.
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

/// The goals, their views and the heights of their trees, by name, so that the error of a run that differs can say in
/// which.
fn goal_parts(goals: &[GoalView]) -> [(&'static str, Vec<u8>); 4] {
    let mut pictures = Vec::new();
    let mut scales = String::new();
    let mut views = String::new();
    let mut evidences = String::new();
    for GoalView { goal, view, frame, unknown, accuracy, registered, evidence, reading } in goals {
        pictures.extend(format!("{} {}\n", goal.width(), goal.height()).bytes());
        pictures.extend(goal.words().iter().flat_map(|word| word.to_le_bytes()));
        // Users give the tree's height; the scale follows from it and the picture.
        let top = goal.ink_box().map_or(0, |(_, top, _, _)| top);
        let height = (frame.ground_row - f64::from(top)) * frame.meters_per_pixel;
        scales += &format!("{height:.6}\n");
        let Frame { width: _, height: _, meters_per_pixel: _, axis_column, ground_row } = frame;
        views += &format!("{view:?} {unknown:?} {axis_column:?} {ground_row:?}\n");
        views += &format!("{accuracy:?} {registered:?}\n");
        evidences += &format!("{evidence:?}\n");
        if let Some(reading) = reading {
            evidences += &format!("{reading:?}\n");
        }
    }
    [
        ("the goal's picture", pictures),
        ("the tree's height (--height)", scales.into_bytes()),
        ("view, ground or trunk", views.into_bytes()),
        ("evidence", evidences.into_bytes()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Budget;
    use crate::evaluator::Silhouette;
    use crate::method::{Optimizer, RulesSettings, Start};
    use crate::problem::{Accuracy, AnyEvidence, Azimuth, Objective, Placement, Unknown};
    use crate::space::{Freedom, TreeSeed};
    use pleach_reading::Reading;
    use pleach_silhouette::{Bitmap, View};
    use std::num::NonZeroU32;

    /// Copies of `base` that differ from it in one field each, which is that of `other`. The fields are all fields of
    /// the type but those after `without`, or it does not compile.
    macro_rules! each_field {
        ($type:ident { $($field:ident),* } without { $($left:ident),* }: $base:expr, $other:expr) => {{
            let $type { $($field,)* $($left: _,)* } = $other;
            [$((stringify!($field), $type { $field, ..$base.clone() })),*]
        }};
    }

    fn problem() -> FitProblem {
        let frame = Frame { width: 9, height: 9, meters_per_pixel: 1.0, axis_column: 4.0, ground_row: 8.0 };
        let picture = Bitmap::from_fn(9, 9, |x, y| x == 4 && y > 2);
        let start = pleach_generators::preset("palm").unwrap();
        FitProblem::new(start, GoalView::new(picture, View::FRONT, frame))
    }

    #[test]
    fn every_field_of_the_settings_counts_but_the_budget() {
        let (problem, base) = (problem(), FitSettings::default());
        let own = Fingerprint::from_fit(&problem, &base);
        assert_eq!(own, Fingerprint::from_fit(&problem, &base.clone()));
        let longer = FitSettings { budget: Budget::evaluations(7), ..base.clone() };
        assert_eq!(own, Fingerprint::from_fit(&problem, &longer), "a run may be resumed with more");
        let other = FitSettings {
            optimizer: "cma".parse::<Optimizer>().unwrap(),
            rules: Some(RulesSettings::default()),
            budget: Budget::default(),
            seed: 2,
            tree_seed: TreeSeed::Any,
            robust: NonZeroU32::new(2).unwrap(),
            objective: Objective::Iou,
            start: Start::Lists(vec![vec![1.0]]),
            freedom: Freedom { free: vec!["length".to_owned()], fix: Vec::new() },
            limits: Limits { work: 1, ..base.limits },
        };
        let changed = each_field!(FitSettings {
            optimizer, rules, seed, tree_seed, robust, objective, start, freedom, limits
        } without { budget }: base, other);
        for (field, settings) in changed {
            let differences = own.differences(&Fingerprint::from_fit(&problem, &settings));
            assert_eq!(differences.len(), 1, "{field}: {differences:?}");
        }
        let limits = base.limits;
        let changed = [
            Limits { stems: 1, ..limits },
            Limits { leaves: 2, ..limits },
            Limits { knots: 3, ..limits },
            Limits { work: 4, ..limits },
        ];
        for limits in changed {
            let settings = FitSettings { limits, ..base.clone() };
            assert_eq!(own.differences(&Fingerprint::from_fit(&problem, &settings)), ["limits"]);
        }
    }

    #[test]
    fn every_field_of_the_problem_counts() {
        let (base, settings) = (problem(), FitSettings::default());
        let own = Fingerprint::from_fit(&base, &settings);
        let goal = &base.goals[0];
        let frame = Frame { axis_column: 3.0, ..goal.frame };
        let other = GoalView {
            goal: Bitmap::from_fn(9, 9, |x, y| x == 3 && y > 2),
            view: View::degrees(90.0, 0.0),
            frame,
            unknown: Unknown { azimuth: Azimuth::Any, frame: false },
            accuracy: Accuracy::Pixel,
            registered: Placement { scale: 1.1, ..Placement::KNOWN },
            evidence: Some(AnyEvidence::new(Silhouette)),
            reading: Some(Reading::default()),
        };
        let changed = each_field!(GoalView {
            goal, view, frame, unknown, accuracy, registered, evidence, reading
        } without {}: base.goals[0], other);
        for (field, goal) in changed {
            let problem = FitProblem { goals: vec![goal], ..base.clone() };
            let differences = own.differences(&Fingerprint::from_fit(&problem, &settings));
            assert_eq!(differences.len(), 1, "{field}: {differences:?}");
        }
        let higher = GoalView { frame: Frame { meters_per_pixel: 2.0, ..goal.frame }, ..goal.clone() };
        let other = FitProblem {
            start: pleach_generators::preset("acer").unwrap(),
            goals: vec![higher],
            foliage: Foliage::None,
        };
        let changed = each_field!(FitProblem { start, goals, foliage } without {}: base, other);
        for (field, problem) in changed {
            let differences = own.differences(&Fingerprint::from_fit(&problem, &settings));
            assert_eq!(differences.len(), 1, "{field}: {differences:?}");
        }
    }

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
