//! From what was typed to the options of a fit.

use super::args::{Fit, GoalArgs};
use super::flags;
use super::values::ViewArg;
use anyhow::{Context, bail};
use pleach::{FitOptions, Leaves, MaskFrom, optimizer_with, settings_of};
use pleach_fit::{Optimizer, Setting};

impl Fit {
    /// The options of the fit of a goal whose own are `goal`.
    ///
    /// # Errors
    /// What [`FitOptions::check`] refuses, with options named as on the command line.
    pub(super) fn options(&self, goal: &GoalArgs) -> anyhow::Result<FitOptions> {
        let options = self.as_typed(goal)?;
        options.check().map_err(|error| flags::named(error.into()))?;
        Ok(options)
    }

    /// The same, whether they go together or not.
    pub(super) fn as_typed(&self, goal: &GoalArgs) -> anyhow::Result<FitOptions> {
        let (view, views) = sort(&goal.view)?;
        let search = &self.search;
        let budget = &self.budget;
        Ok(FitOptions {
            height: goal.height,
            size: goal.size,
            // What the command writes is a cut-out, which a mask is made of.
            mask: goal.mask.clone().or(goal.mask_command.as_ref().map(|_| MaskFrom::Auto)),
            hints: goal.hints.hints(),
            wood: goal.wood.clone(),
            reading: goal.corrections.corrections()?,
            tree: goal.tree,
            ground_row: goal.ground_row,
            axis_column: goal.axis_column,
            frame: goal.frame,
            view,
            views,
            free_frame: goal.free_frame,
            holdout_views: goal.holdout_view.clone(),
            leaves: if goal.no_leaves { Leaves::Off } else { goal.leaves },
            appearance: goal.appearance,
            from: search.from.clone(),
            generator: search.generator,
            volume_from: search.volume_from.clone(),
            free: search.free.clone(),
            fix: search.fix.clone(),
            optimizer: optimizer(&search.optimizer, &search.settings)?,
            evolve_rules: search.evolve_rules,
            objective: search.objective,
            seed: search.seed,
            tree_seed: search.tree_seed,
            robust: search.robust,
            individual: self.individual.individual.unwrap_or_default(),
            individuals: self.individual.individuals,
            posterior: self.posterior.posterior,
            timeout: budget.timeout,
            evaluations: budget.evaluations,
            generations: budget.generations,
            target_iou: budget.target_iou,
            name: None,
        })
    }
}

/// The direction of the goal itself, and the further pictures, of what `--view` said.
fn sort(given: &[ViewArg]) -> anyhow::Result<(Option<pleach::Direction>, Vec<pleach::FurtherView>)> {
    let (mut own, mut further) = (None, Vec::new());
    for view in given {
        match view {
            ViewArg::Own(_) if own.is_some() => {
                bail!("the goal was taken from one direction: further ones need a picture, --view AZ=FILE")
            }
            ViewArg::Own(direction) => own = Some(*direction),
            ViewArg::Further(view) => further.push(view.clone()),
        }
    }
    Ok((own, further))
}

/// The optimiser called `name` with `KEY=VALUE` settings applied.
fn optimizer(name: &str, settings: &[String]) -> anyhow::Result<Optimizer> {
    let pairs = settings
        .iter()
        .map(|setting| setting.split_once('=').with_context(|| format!("`--set {setting}` is not KEY=VALUE")))
        .collect::<anyhow::Result<Vec<_>>>()?;
    Ok(optimizer_with(name, pairs)?)
}

/// The settings of the optimiser called `name` with their defaults.
pub(super) fn describe(name: &str) -> anyhow::Result<String> {
    let optimizer: Optimizer = name.parse()?;
    let range = |key: &str| Setting::find(name, key).map_or_else(String::new, |s| s.kind.to_string());
    let lines: Vec<String> = settings_of(&optimizer)
        .iter()
        .map(|(key, value)| format!("  {key}={}  ({})", value.to_string().trim_matches('"'), range(key)))
        .collect();
    Ok(format!("settings of `{name}` and their defaults:\n{}", lines.join("\n")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_taken_within_their_ranges_and_refused_in_words() {
        let set = |name: &str, setting: &str| optimizer(name, &[setting.to_owned()]);
        let Ok(Optimizer::Evolution(settings)) = set("evolution", "children=40") else {
            panic!("children=40")
        };
        assert_eq!(settings.children, 40);
        assert!(set("hewitt", "merge=Mean").is_ok());
        for (name, setting, expected) in [
            ("evolution", "step=-1", "expected a number from 0.000001 to 1 for `step`"),
            ("evolution", "children=1e9", "expected a whole number from 1 to 100000 for `children`"),
            ("evolution", "match_height=1", "expected true or false for `match_height`"),
            ("hewitt", "merge=best", "expected Both or Uniform or Mean for `merge`"),
            ("evolution", "population=60", "`evolution` has no setting `population`"),
            ("evolution", "children", "is not KEY=VALUE"),
        ] {
            let error = set(name, setting).unwrap_err().to_string();
            assert!(error.contains(expected), "{setting}: {error}");
        }
    }

    #[test]
    fn all_settings_are_described_with_their_ranges() {
        let text = describe("hewitt").unwrap();
        assert!(text.contains("  merge=Both  (Both or Uniform or Mean)"), "{text}");
        assert!(text.contains("  population=20  (a whole number from 2 to 100000)"), "{text}");
    }
}
