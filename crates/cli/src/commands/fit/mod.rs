//! `pleach fit`: from goal images to run folders.

mod args;
mod batch;
mod drawing;
mod goal;
mod individual;
mod judged;
pub(super) mod list;
mod live;
mod options;
mod outlined;
mod progress;
mod report;
pub(super) mod request;
pub(super) mod run_folder;
mod several;
mod signals;
mod start;
mod summary;
pub(super) mod table;
mod task;
mod views;
mod watch;

use crate::interrupted::Interrupted;
use crate::{input, output};
use anyhow::{anyhow, bail, ensure};
use args::{BudgetArgs, GoalArgs, IndividualArgs, SearchArgs};
use options::Settings;
use pleach::plan::{Effort, Shares, USUAL_TIME, has_individuals, library};
use pleach_fit::{Budget, FitSettings, IndividualSettings, RulesSettings};
use run_folder::{Mode, RunFolder};
use std::path::{Path, PathBuf};
use std::time::Duration;
use task::{Ended, Task, how_to_go_on};

/// What the run folder of `goal` is called, and its species. Names that are not UTF-8 become so: the
/// species file in the folder is typed as an argument later. None if there is no name that stays inside of
/// the folder of run folders: `...png` is called `..`.
pub(super) fn run_name(goal: &Path) -> Option<String> {
    let name = input::stem(goal)?.to_string_lossy().into_owned();
    (name != "." && name != "..").then_some(name)
}

/// The folder that run folders are made in if nothing is said.
const RUNS: &str = "runs";

const EXAMPLES: &str = "Examples:
  pleach fit targets/quaking_aspen.png  a minute; results in runs/quaking_aspen
  pleach fit photo.jpg --mask auto -v  a photograph of a tree before a sky
  pleach fit oak.jpg --height 18 --timeout 5m  a tree of 18 m, five minutes
  pleach fit goal.png --from random --optimizer hewitt --evaluations 20000
  pleach fit goal.png --robust 4  parameters of which every seed is like it
  pleach fit goal.png --from acer --free crown --free leaves --fix leaf_shape
  pleach fit goal.png --evolve-rules --timeout 2m  a grammar from nothing
  pleach fit goal.png --individual 2m --timeout 3m  longer for this very tree, branch by branch
  pleach fit goal.png --individuals 8  eight trees on one goal: depth is free
  pleach fit front.png --view 90=side.png --holdout-view 45=corner.png
  pleach fit goal.png --volume-from goal  a crown that follows the outline
  pleach fit front.png --view auto=other.png --free-frame  from who knows where
  pleach fit goal.png --out DIR --resume  go on after ctrl-C or a crash
  pleach fit goal.png --out DIR --continue --timeout 5m  search on
  pleach fit goals/*.png --out runs --timeout 2m  a batch: runs/summary.csv
  pleach fit goals/*.png --out runs --shard 2/8  goals 2, 10, 18 ..., for arrays
  pleach fit --list goals.csv --out runs  a height, view, mask ... for each goal

Likeness says how much two silhouettes look like trees of one kind: how much ink stands where, how \
ragged the rim is, how thick the strokes and how large the gaps are. It is 1 for the same picture; a fit \
ends with what other trees of the species, trees of another species and an ellipse would have for its \
goal, a verdict, and what to do next.

The run folder holds best.toml (a species file that `pleach grow` takes), best.png, overlay.png (grey is \
agreement, orange is missing, blue is too much), render.png, history.csv (a row per generation), \
parameters.csv (how well the goal determines each parameter) and summary.json; with --mask auto mask.png, \
with further views an overlay of each. That is the kind; individual.toml is this very tree, whose branches \
were dealt anew one by one until they lie on the picture, with individual.png, overlay-individual.png and \
individual-render.png. With --individuals there are individual-2.toml and so on, and individuals.png, a sheet of \
all trees from the front and from the side. Most of them are written while the search runs, too. The file \
`checkpoint` is there while a fit is unfinished, `search-state` once it is finished, for --continue.

A finished fit is replaced only by a fit of the same goal with the same options, or with --overwrite, and \
only once the new one is complete; until then that one is in the folder `unfinished` inside.

Asked to stop (ctrl-C), a fit writes what it has found and ends with code 130; --resume goes on with it \
and comes to what it would have come to. The first guess, the judging of the result, and the search for \
this very tree are then made again.

With several goals, the budget is for each. A goal that fails is named and the others go on. With --resume \
a batch goes on where it stopped, and skips what was finished with the same options; with others it is \
refused. Several processes may fit one batch at a time, each goal is then fitted by one of them; \
`pleach collect` joins what they leave.

A --list is a CSV file with a header: the column `file`, and any of `height`, `view`, `mask`, `tree`, \
`ground_row`, `axis_column` and `leaves`; an empty cell means the option of the command line. Paths are \
relative to the list.";

/// Fit a generator's parameters to a goal image
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, args_override_self = true)]
pub(crate) struct Fit {
    /// The goal, or several: PNG, JPEG, WebP or TIFF; black on white, white on black, or by transparency;
    /// `-` is standard input
    #[arg(value_name = "GOAL", required_unless_present = "list")]
    goals: Vec<PathBuf>,
    /// A CSV file of goals, each with options of its own; see below
    #[arg(long, value_name = "FILE", conflicts_with = "goals")]
    list: Option<PathBuf>,
    /// The run folder, runs/GOAL by default; the folder of run folders with several goals, runs by
    /// default
    #[arg(short, long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Go on from the checkpoint in the run folder, or start if the fit was stopped before there was
    /// one; a fit that is finished is left as it is
    #[arg(long)]
    resume: bool,
    /// Search on from where a finished fit ended: budgets count from there. Ends as one longer fit
    #[arg(long = "continue", conflicts_with = "resume")]
    go_on: bool,
    /// Fit goals I, I + N, I + 2N … only; the summary is then summary-I-of-N.csv
    #[arg(long, value_name = "I/N")]
    shard: Option<batch::Shard>,
    /// How often the state of the search is saved: what a crash may cost
    #[arg(long, value_name = "TIME", default_value = "1s", value_parser = options::duration)]
    checkpoint_every: Duration,
    /// Start over, replacing any fit in the run folder
    #[arg(long, conflicts_with_all = ["resume", "go_on"])]
    overwrite: bool,
    /// Say more: what was found in the goal
    #[arg(short, long)]
    verbose: bool,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    goal_options: GoalArgs,
    #[command(flatten)]
    search: SearchArgs,
    #[command(flatten)]
    individual: IndividualArgs,
    #[command(flatten)]
    budget: BudgetArgs,
}

impl Fit {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let settings = self.settings()?;
        let Settings::Fit(settings) = settings else {
            return output::line(options::describe(&self.search.optimizer)?);
        };
        let (_, further) = views::sort(&self.goal_options.view)?;
        if self.is_batch() && !(further.is_empty() && self.goal_options.holdout_view.is_empty()) {
            bail!("further views are of one tree, and there are {} goals", self.goals.len());
        }
        if self.goal_options.free_frame && further.is_empty() {
            bail!("--free-frame is about further pictures, and there is none: --view auto=FILE");
        }
        // Before a folder is made.
        let (from, generator) = (&self.search.from, &self.search.generator()?);
        from.plan(*generator, self.goal_options.leaves(), &self.search.start()?, &settings)?;
        match &self.goals[..] {
            [goal] if !self.is_batch() => self.single(goal, &settings),
            _ => batch::run(self, &settings),
        }
    }

    /// Whether there is a folder of run folders.
    const fn is_batch(&self) -> bool {
        self.goals.len() != 1 || self.shard.is_some()
    }

    const fn mode(&self) -> Mode {
        match (self.resume, self.go_on, self.overwrite) {
            (true, ..) => Mode::Resume,
            (_, true, _) => Mode::Continue,
            (.., true) => Mode::Overwrite,
            _ => Mode::New,
        }
    }

    /// Fits one goal and shows its score card.
    fn single(&self, goal: &Path, settings: &FitSettings) -> anyhow::Result<()> {
        let path = self
            .out
            .clone()
            .unwrap_or_else(|| Path::new(RUNS).join(run_name(goal).unwrap_or_else(|| "goal".to_owned())));
        let task = Task {
            goal: goal.to_owned(),
            args: self.goal_options.clone(),
            folder: RunFolder::at(path.clone()),
        };
        let mode = self.mode();
        if mode == Mode::Resume
            && let Some(summary) = task.done_before(self, settings)?
        {
            output::note(format!(
                "{} holds a finished fit of the same; --continue searches on",
                path.display()
            ));
            return if self.json { output::json(&summary) } else { Ok(()) };
        }
        let mut library = library().for_one_goal();
        let ended = task.run(self, settings, mode, &mut library, &signals::catch()?)?;
        let (summary, interrupted) = match ended {
            Ended::Finished(summary) => (Some(summary), None),
            Ended::Interrupted(summary) => {
                let has_begun = summary.is_some() || RunFolder::at(path.clone()).is_unfinished();
                (summary, Some(Interrupted::new(how_to_go_on(goal, &path, mode, has_begun))))
            }
        };
        if let Some(summary) = summary {
            if self.json {
                output::json(&summary)?;
            } else {
                let folder = RunFolder::at(path).of_results(interrupted.is_some());
                output::line(report::report(&summary, goal, &folder))?;
            }
        }
        interrupted.map_or(Ok(()), |interrupted| Err(interrupted.into()))
    }

    /// The time for the whole fit, if it is bounded.
    fn timeout(&self) -> Option<Duration> {
        let BudgetArgs { timeout, evaluations, generations, .. } = &self.budget;
        timeout.or(evaluations.or(*generations).is_none().then_some(USUAL_TIME))
    }

    /// How this very tree is searched, if it is.
    fn individual_settings(&self) -> anyhow::Result<Option<IndividualSettings>> {
        let count = self.individual.individuals;
        let asked_for = self.individual.individual;
        // Where a generator is known to have no stems to be dealt anew, its search gets the time.
        let generator = self.search.generator()?;
        if self.search.evolve_rules || !has_individuals(generator) {
            let trees = if self.search.evolve_rules { "evolved grammars" } else { generator.name() };
            ensure!(
                count == 1 && asked_for.is_none_or(|effort| effort == Effort::Off),
                "stems of {trees} cannot be dealt other draws one by one: leave out --individual and --individuals"
            );
            return Ok(None);
        }
        let effort = asked_for.unwrap_or_default();
        let one = effort
            .settings(self.timeout(), self.budget.evaluations)
            .map_err(|error| anyhow!("--individual: {error} (--timeout)"))?;
        ensure!(one.is_some() || count == 1, "--individuals asks for trees, and --individual is off");
        Ok(one.map(|one| IndividualSettings { count, ..one }))
    }

    /// How the time is shared out, if it is bounded.
    fn shares(&self) -> anyhow::Result<Option<Shares>> {
        let individual = self.individual_settings()?;
        Ok(self.timeout().map(|whole| Shares::new(whole, individual.as_ref())))
    }

    fn settings(&self) -> anyhow::Result<Settings> {
        let search = &self.search;
        if search.settings.iter().any(|s| s == "help") {
            return Ok(Settings::Help);
        }
        let budget = &self.budget;
        Ok(Settings::Fit(Box::new(FitSettings {
            optimizer: options::optimizer(&search.optimizer, &search.settings)?,
            rules: search.evolve_rules.then(RulesSettings::default),
            budget: Budget {
                timeout: self.shares()?.map(|shares| shares.search),
                evaluations: budget.evaluations,
                generations: budget.generations,
                target_iou: budget.target_iou,
                kept: None,
            },
            seed: search.seed,
            tree_seed: search.tree_seed,
            robust: search.robust,
            objective: search.objective()?,
            freedom: pleach_fit::Freedom { free: search.free.clone(), fix: search.fix.clone() },
            ..FitSettings::default()
        })))
    }
}
