//! A fit that is ready to run.

use super::error::PrepareError;
use super::goal_pair::GoalPair;
use super::goal_reading::GoalReading;
use super::options::{FitOptions, Spent};
use super::source::FitSource;
use super::start::FitStart;
use super::volume::Outlined;
use super::words::{MaskFrom, StartFrom, Tone};
use crate::plan::{DRAWING, Shares};
use pleach_fit::{
    Accuracy, AnyEvidence, Control, CostModel, FitError, FitProblem, Fitted, GoalSettings, GoalView,
    GuessLibrary, Guessing, MeasuredSilhouette, Unknown, fit_goal_with,
};
use pleach_generators::GeneratorChoice;
use pleach_reading::{Colors, Reading};
use pleach_silhouette::{Bitmap, GoalOptions, Polarity, View};
use pleach_tree::Foliage;
use pleach_tree::species::safe_name;
use std::borrow::Cow;
use std::path::PathBuf;

/// A further picture of the goal's tree.
#[derive(Clone, Debug)]
pub struct FurtherPicture {
    /// Its name in the options.
    pub name: String,
    /// The direction that it is said to be from.
    pub view: View,
    /// The picture.
    pub goal: GoalPair,
}

/// A fit that is ready to run: its pictures are read, and what is asked for is resolved.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// What was asked for.
    pub options: FitOptions,
    /// What the species that is found is called: a safe name of a file.
    pub name: String,
    /// The goal's picture.
    pub goal: GoalPair,
    /// The direction of the goal's view.
    pub view: View,
    /// Further pictures, which are fitted too.
    pub views: Vec<FurtherPicture>,
    /// Further pictures, which are scored and not fitted.
    pub holdout_views: Vec<FurtherPicture>,
    /// Height of the tree in metres: what was given, or what follows from a known frame.
    pub height: f64,
    /// Whether a first guess looks for leaves.
    pub detects_leaves: bool,
    /// What is fitted.
    pub problem: FitProblem,
    /// What is in the goal's picture.
    pub reading: GoalReading,
    /// How.
    pub settings: GoalSettings,
    shares: Option<Shares>,
}

impl FitOptions {
    /// Reads the pictures of `source`, and resolves the options against them.
    ///
    /// # Errors
    /// A [`PrepareError`]: whatever can be refused is refused here, before the fit.
    pub fn prepare(&self, source: &FitSource) -> Result<Prepared, PrepareError> {
        self.prepare_after(source, &Spent::default())
    }

    /// The same of a fit that goes on from where another ended having used `spent`.
    ///
    /// # Errors
    /// As [`FitOptions::prepare`].
    pub fn prepare_after(&self, source: &FitSource, spent: &Spent) -> Result<Prepared, PrepareError> {
        self.check()?;
        let goal = self.goal(source)?;
        let (reading, corrected) = self.read(source, &goal)?;
        let is_measured = reading.colors.as_ref().is_some_and(|colors| colors.leaves.is_some());
        let FitStart { species, mut foliage, detects_leaves, mut settings, shares, .. } =
            self.for_picture(&reading, &goal.working.bitmap).start(source)?;
        let said = self.reading.says_leaves().then_some(reading.measures.leaves);
        let sure = said.or_else(|| is_measured.then(|| sure_of_leaves(&reading.measures)).flatten());
        if let (true, Some(leaves)) = (detects_leaves, sure) {
            foliage = if leaves { Foliage::All } else { Foliage::None };
            if let Guessing::Compare(guess) = &mut settings.guess {
                guess.detect_leaves = false;
            }
        }
        let height = match self.frame {
            Some(frame) => frame.meters_per_pixel * goal.full.height_in_pixels(),
            None => self.height,
        };
        let view = self.view.unwrap_or_default().view();
        let accuracy = if self.frame.is_some() { Accuracy::Exact } else { Accuracy::Pixel };
        let own = GoalView::new(goal.working.bitmap.clone(), view, goal.working.frame(height));
        let evidence = is_measured.then(|| {
            let measures = corrected.clone().unwrap_or_else(|| Reading::from_silhouette(&own.goal));
            AnyEvidence::new(MeasuredSilhouette { reading: Some(reading.add_foliage(measures)) })
        });
        let mut goals = vec![GoalView { accuracy, evidence, reading: corrected, ..own }];
        let further = |one: &super::direction::FurtherView| -> Result<FurtherPicture, PrepareError> {
            let goal = GoalPair::read(&source.picture(&one.picture), GoalOptions::default(), self.size)?;
            Ok(FurtherPicture { name: one.picture.clone(), view: one.direction.view(), goal })
        };
        let views: Vec<FurtherPicture> = self.views.iter().map(further).collect::<Result<_, _>>()?;
        for (picture, asked) in views.iter().zip(&self.views) {
            let working = &picture.goal.working;
            let unknown = Unknown { azimuth: asked.azimuth, frame: self.free_frame };
            let view = GoalView::from_picture(working.bitmap.clone(), picture.view, working.frame(height));
            goals.push(GoalView { unknown, ..view });
        }
        let holdout_views = self.holdout_views.iter().map(further).collect::<Result<_, _>>()?;
        let mut problem = FitProblem { start: species, goals, foliage };
        if let Some(volume) = &self.volume_from {
            let outlined = Outlined::new(volume, source, &problem.goals, height)?;
            problem.start = outlined.species.clone();
            let GoalSettings { individual, posterior, .. } = settings;
            settings = GoalSettings { individual, posterior, ..outlined.plan(settings.search)? };
        }
        add(&mut settings, spent);
        let prepared = Prepared {
            options: self.after(spent),
            name: safe_name(&self.name.clone().unwrap_or_else(|| source.species_name())),
            reading,
            goal,
            view,
            views,
            holdout_views,
            height,
            detects_leaves,
            problem,
            settings,
            shares,
        };
        Ok(prepared.with_result_cost(DRAWING, DRAWING))
    }

    /// The same with the usual generators of a goal that was read so: a picture is mostly of a real tree, unless it is drawn
    /// in flat colours, as icons are.
    fn for_picture(&self, reading: &GoalReading, goal: &Bitmap) -> Cow<'_, Self> {
        let is_open = self.generator.is_none()
            && self.from == StartFrom::Auto
            && self.volume_from.is_none()
            && !self.evolve_rules;
        if !is_open {
            return Cow::Borrowed(self);
        }
        let has_colors = reading.colors.as_ref().is_some_and(|colors| colors.leaves.is_some());
        let generator = if reading.colors.as_ref().is_some_and(Colors::is_drawn) {
            GeneratorChoice::DRAWINGS
        } else if has_colors || goal.ink_box().is_some_and(|(_, top, _, bottom)| bottom + 1 - top >= SHOWN) {
            GeneratorChoice::Trees
        } else {
            return Cow::Borrowed(self);
        };
        Cow::Owned(Self { generator: Some(generator), ..self.clone() })
    }

    /// The goal's picture.
    fn goal(&self, source: &FitSource) -> Result<GoalPair, PrepareError> {
        let options = self.goal_options();
        if self.is_photograph() {
            return GoalPair::of_photograph(source, &self.hints, options, self.size);
        }
        let pair = GoalPair::read(&source.goal, options, self.size)?;
        Ok(GoalPair { colors: source.colors(), ..pair })
    }

    /// Whether the goal is said to be a photograph.
    pub(super) fn is_photograph(&self) -> bool {
        self.mask == Some(MaskFrom::Auto) || self.mask.is_none() && !self.hints.is_empty()
    }

    /// How the goal's picture is read.
    pub(super) fn goal_options(&self) -> GoalOptions {
        GoalOptions {
            mask: match &self.mask {
                Some(MaskFrom::File(file)) => Some(PathBuf::from(file)),
                Some(MaskFrom::Auto) | None => None,
            },
            polarity: match self.tree {
                Tone::Auto => Polarity::Auto,
                Tone::Dark => Polarity::DarkTree,
                Tone::Light => Polarity::LightTree,
            },
            ground_row: self.frame.map_or(self.ground_row, |frame| Some(frame.ground_row)),
            axis_column: self.frame.map_or(self.axis_column, |frame| Some(frame.axis_column)),
            ..GoalOptions::default()
        }
    }
}

/// From this confidence on, what is read of a picture in colour decides whether there are leaves, and no drawing of a
/// known species is asked. Of 40 cut-outs of real trees with colours, all are read right.
const SURE: f64 = 0.6;

/// A silhouette that is as many pixels high shows how a tree stands and whether it has leaves. Of smaller ones that is
/// misread, and known trees are taken for some of another generator.
const SHOWN: u32 = 100;

fn sure_of_leaves(measures: &Reading) -> Option<bool> {
    (measures.leaves_confidence >= SURE).then_some(measures.leaves)
}

/// Adds what earlier parts have used to the budgets of the search.
fn add(settings: &mut GoalSettings, spent: &Spent) {
    let budget = &mut settings.search.budget;
    budget.timeout = budget.timeout.map(|time| time + spent.time);
    budget.evaluations = budget.evaluations.map(|count| count + spent.evaluations);
    budget.generations = budget.generations.map(|count| count + spent.generations);
}

impl Prepared {
    /// The same fit for a caller that does more with its result than to draw and score it: `writing` is what it takes
    /// for the tree of the kind and for an individual, `further` for each further individual. Where time is bounded,
    /// the fit leaves time for it.
    #[must_use]
    pub fn with_result_cost(self, writing: CostModel, further: CostModel) -> Self {
        let settings = match self.shares {
            Some(shares) => shares.bound(self.settings, writing, further),
            None => self.settings,
        };
        Self { settings, ..self }
    }

    /// Runs the fit; `library` keeps trees of the known species from goal to goal.
    ///
    /// # Errors
    /// See [`FitError`].
    pub fn fit(&self, library: &mut GuessLibrary, control: Control<'_>) -> Result<Fitted, FitError> {
        fit_goal_with(&self.problem, &self.settings, library, control)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read_surely_decides_about_leaves() {
        let read = |leaves, leaves_confidence| {
            sure_of_leaves(&Reading { leaves, leaves_confidence, ..Reading::default() })
        };
        assert_eq!((read(true, SURE), read(false, 0.9)), (Some(true), Some(false)));
        assert_eq!(read(true, SURE.next_down()), None);
    }
}
