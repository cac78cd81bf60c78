//! What is asked of a result once the search has ended: how it does with other seeds, what of it the
//! goal determines, and what its likeness is worth.

use super::start::candidates;
use crate::output;
use indicatif::ProgressBar;
use pleach_fit::{
    FitError, FitProblem, FitSettings, FreshSeeds, GuessLibrary, Profile, References, Scored, Seen, Start,
    fresh_seeds, profile, put_back_unseen, settled,
};
use pleach_tree::{Limits, ParamSpace, Slot};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Trees of other seeds that a result is judged by.
const FRESH: usize = 16;

/// The judged result.
pub(super) struct Aftermath {
    /// The best individual, with numbers that nobody sees back at the start's values.
    pub(super) best: Scored,
    /// How other seeds do; none if one of them does not grow.
    pub(super) fresh: Option<FreshSeeds>,
    /// One for every free number.
    pub(super) profiles: Vec<Profile>,
    /// Slots that went back to the start's value.
    pub(super) put_back: Vec<Slot>,
    /// What its likeness stands beside.
    pub(super) references: References,
    /// What all this took.
    pub(super) seconds: f64,
    /// Slots of variations of size, which are 0.
    settled: Vec<Slot>,
}

impl Aftermath {
    /// Judges `best`; `references` are those of the first guess, if there was one.
    /// [`FitError::Interrupted`] once `stop` is raised.
    pub(super) fn of(
        problem: &FitProblem,
        settings: &FitSettings,
        best: &Scored,
        references: Option<References>,
        library: &mut GuessLibrary,
        stop: &AtomicBool,
    ) -> Result<Self, FitError> {
        let started = Instant::now();
        let bar = if output::is_watched() { ProgressBar::new_spinner() } else { ProgressBar::hidden() };
        bar.enable_steady_tick(Duration::from_millis(100));
        bar.set_message("judging the result: other seeds, and every parameter");
        // A search gives up trees that `grow` does not.
        let judge = |genome| fresh_seeds(problem, settings.objective, Limits::default(), genome, FRESH, stop);
        // Without other seeds there is no spread to compare with; then a hundredth is seen.
        let fresh = judge(&best.genome)?;
        let tolerance = fresh.as_ref().map_or(0.01, |fresh| fresh.cost.sd);
        let profiles = profile(problem, settings, best, tolerance, stop)?;
        let before = &best.genome.values;
        let (best, put_back) = match &settings.start {
            Start::Random => (best.clone(), Vec::new()),
            Start::Lists(lists) => {
                put_back_unseen(problem, settings, best, &profiles, &lists[0], tolerance, stop)?
            }
        };
        // Numbers that no tree reads went back for the reader of the file; the trees are the same.
        let fresh = if same_trees(problem, before, &best.genome.values, &put_back) {
            fresh
        } else {
            judge(&best.genome)?
        };
        let references = match references {
            Some(references) => references,
            None => library.references(problem, settings, &candidates(problem), stop)?,
        };
        bar.finish_and_clear();
        let settled = settled(problem, settings, &best.genome)?;
        let seconds = started.elapsed().as_secs_f64();
        Ok(Self { fresh, best, profiles, put_back, references, seconds, settled })
    }

    /// Comments of the species file: what the goal does not show.
    pub(super) fn comments(&self, space: &ParamSpace) -> Vec<String> {
        let sentences = [
            ("One picture shows one size, so no other is grown: 0 are", &self.settled),
            ("Not seen in the goal, so as where the search started:", &self.put_back),
        ];
        let of = |(start, slots): (&str, &Vec<Slot>)| {
            let names: Vec<String> = slots.iter().map(|&slot| space.slot_name(slot)).collect();
            (!names.is_empty()).then(|| format!("{start} {}.", names.join(", ")))
        };
        sentences.into_iter().filter_map(of).collect()
    }

    /// How many numbers are determined, loosely determined, and not seen.
    pub(super) fn counts(&self) -> [usize; 3] {
        [Seen::Determined, Seen::Loosely, Seen::NotSeen]
            .map(|seen| self.profiles.iter().filter(|profile| profile.seen == seen).count())
    }

    /// Rows of `parameters.csv`, the header first.
    pub(super) fn table(&self, space: &ParamSpace) -> Vec<Vec<String>> {
        let [small, large] = pleach_fit::profile::STEPS.map(|step| format!("{:.0}%", 100.0 * step));
        let header = vec![
            "parameter".to_owned(),
            "value".to_owned(),
            "seen".to_owned(),
            format!("cost_rise_down_{small}"),
            format!("cost_rise_up_{small}"),
            format!("cost_rise_down_{large}"),
            format!("cost_rise_up_{large}"),
        ];
        let rows = self.profiles.iter().map(|profile| {
            let seen = match profile.seen {
                Seen::Determined => "determined",
                Seen::Loosely => "loosely",
                Seen::NotSeen => "not-seen",
            };
            let mut row = vec![
                space.slot_name(profile.slot),
                self.best.genome.values[profile.slot.index()].to_string(),
                seen.to_owned(),
            ];
            row.extend(profile.rises.iter().flatten().map(|rise| {
                rise.filter(|rise| rise.is_finite()).map_or_else(String::new, |rise| format!("{rise:.5}"))
            }));
            row
        });
        std::iter::once(header).chain(rows).collect()
    }
}

/// Whether lists that differ in `slots` only, one after the other, grow the same trees from any seed.
fn same_trees(problem: &FitProblem, before: &[f64], after: &[f64], slots: &[Slot]) -> bool {
    let mut values = before.to_vec();
    slots.iter().all(|&slot| {
        let is_active = problem.generator.is_active(&values, slot);
        values[slot.index()] = after[slot.index()];
        !is_active
    })
}
