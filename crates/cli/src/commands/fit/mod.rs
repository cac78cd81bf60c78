//! `pleach fit`: from goal images to run folders.

mod aftermath;
mod asked;
mod batch;
mod folder;
mod goal;
mod options;
mod progress;
mod report;
mod start;
mod views;

pub(crate) use start::candidates;

use crate::{input, output};
use aftermath::Aftermath;
use anyhow::{Context, anyhow, bail};
use folder::{RunFolder, Summary};
pub(super) use goal::places;
use goal::{Goals, MaskSource};
use options::Settings;
use pleach_fit::{
    Budget, CheckpointSettings, Control, FitError, FitProblem, FitSettings, GoalView, GuessLibrary,
    Objective, StopReason, Unknown, check_freedom,
};
use pleach_silhouette::goal::Goal;
use pleach_tree::{Foliage, Growth};
use progress::Bar;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The folder that run folders are made in if nothing is said.
const RUNS: &str = "runs";

const EXAMPLES: &str = "Examples:
  pleach fit targets/quaking_aspen.png                a minute of search, results in runs/quaking_aspen
  pleach fit photo.jpg --mask auto -v                 a photograph of a tree before sky or a wall
  pleach fit oak.jpg --height 18 --timeout 5m         a tree of 18 m, five minutes
  pleach fit goal.png --from random --optimizer hewitt --evaluations 20000 --seed 3
  pleach fit goal.png --robust 4                      parameters of which every seed looks like the goal
  pleach fit goal.png --from acer --free crown --free leaves --fix leaf_shape
  pleach fit front.png --view 90=side.png --holdout-view 45=corner.png
  pleach fit front.png --view auto=other.png --free-frame     another picture, from who knows where
  pleach fit goal.png --out DIR --resume              go on after ctrl-C or a crash
  pleach fit goals/*.png --out runs --timeout 2m      a batch: runs/STEM/, runs/summary.csv
  pleach fit goals/*.png --out runs --shard 2/8       goals 2, 10, 18 … of it, for array jobs

The run folder holds best.toml (a species file that `pleach grow` takes), best.png, overlay.png,
history.csv (a row a generation), parameters.csv (how well the goal determines each parameter) and
summary.json; and a checkpoint while the fit is unfinished.

Likeness says how much two silhouettes look like trees of one kind: 1 is the same picture, two trees
of one species have some 0.7, trees of two species some 0.3. A fit ends with what it would be for its
goal, a verdict, and what to do next.

Asked to stop (ctrl-C), a fit writes what it has found and ends with an error; --resume goes on with
it and comes to what it would have come to. The first guess and the judging of the result, which need
some seconds before and after the search, are then made again.

With several goals, the budget is for each. A goal that fails is named and the others go on. With
--resume a batch goes on where it stopped, and skips what was finished with the same options; with
others it is refused.";

/// Fit a generator's parameters to a goal image
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, args_override_self = true)]
pub(crate) struct Fit {
    /// The goal, or several: PNG, JPEG or WebP; black on white, white on black, or by transparency
    #[arg(value_name = "GOAL", required = true)]
    goals: Vec<PathBuf>,
    /// The run folder, runs/GOAL by default; the folder of run folders with several goals, runs by
    /// default
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Go on from the checkpoint in the run folder, or start if the fit was stopped before there was
    /// one; with several goals, skip those that are finished
    #[arg(long)]
    resume: bool,
    /// Fit goals I, I + N, I + 2N … only; the summary is then summary-I-of-N.csv
    #[arg(long, value_name = "I/N")]
    shard: Option<batch::Shard>,
    /// How often the state of the search is saved: what a crash may cost
    #[arg(long, value_name = "TIME", default_value = "1s", value_parser = options::duration)]
    checkpoint_every: Duration,
    /// Start anew over an unfinished fit in the run folder
    #[arg(long, conflicts_with = "resume")]
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
    budget: BudgetArgs,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "The goal")]
struct GoalArgs {
    /// Height of the tree in metres: a silhouette does not show it
    #[arg(long, value_name = "METRES", default_value_t = 10.0, value_parser = options::positive)]
    height: f64,
    /// Longer side of the pictures that the search compares, in pixels; larger goals are reduced. The
    /// score card and best.png have the goal's own size
    #[arg(long, value_name = "PIXELS", default_value_t = 256, value_parser = clap::value_parser!(u32).range(16..=2048))]
    size: u32,
    /// A picture of the goal's size that says what is tree: white on black. With `auto` the goal is a
    /// photograph, and its mask is made as by `pleach mask`
    #[arg(long, value_name = "FILE|auto")]
    mask: Option<MaskSource>,
    /// Which of the two tones is the tree
    #[arg(long, value_enum, default_value_t = options::Tone::Auto)]
    tree: options::Tone,
    /// Row where the tree stands, in pixels of the goal from its top; detected by default
    #[arg(long, value_name = "PIXELS")]
    ground_row: Option<f64>,
    /// Column of the trunk's foot, in pixels of the goal from its left; detected by default
    #[arg(long, value_name = "PIXELS")]
    axis_column: Option<f64>,
    /// Direction of the goal's view in degrees: azimuth, and elevation where it is not 0; with a file,
    /// a further picture of the same tree, fitted as well; repeatable. `~AZ=FILE` is from within 15
    /// degrees of it, `auto=FILE` from anywhere around the tree: the azimuth is then searched
    #[arg(long, value_name = "AZ[,EL][=FILE]", allow_hyphen_values = true)]
    view: Vec<views::Direction>,
    /// Search the scale (± 20 %) and the place (± 10 % of width and height) of the tree in further
    /// pictures; the goal's own frame is taken as it is
    #[arg(long)]
    free_frame: bool,
    /// A further picture of the same tree that is not fitted but scored; repeatable
    #[arg(long, value_name = "AZ[,EL]=FILE", allow_hyphen_values = true)]
    holdout_view: Vec<views::KnownPicture>,
    /// Whether the tree has leaves: `auto` looks whether the goal is more like trees with leaves or
    /// like bare ones (with --from auto; otherwise it has)
    #[arg(long, value_enum, default_value_t = start::Leaves::Auto, conflicts_with = "no_leaves")]
    leaves: start::Leaves,
    /// The same as --leaves off
    #[arg(long)]
    no_leaves: bool,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "The search")]
struct SearchArgs {
    /// Where to start: from the known species that look most like the goal, from `random` parameter
    /// lists, or from one species (name or file)
    #[arg(long, value_name = "auto|random|SPECIES", default_value = "auto")]
    from: start::From,
    /// Parameters that may change: a name, a slot such as length[1], a group, or level:N; repeatable.
    /// All by default; see `pleach params`
    #[arg(long, value_name = "PATTERN")]
    free: Vec<String>,
    /// Parameters that keep the start's value; repeatable
    #[arg(long, value_name = "PATTERN")]
    fix: Vec<String>,
    /// The optimiser: evolution, cma (CMA-ES with margin), de (differential evolution, SHADE), hewitt
    /// (the dissertation's genetic algorithm) or random
    #[arg(long, value_name = "NAME", default_value = pleach_fit::Optimizer::NAMES[0])]
    optimizer: String,
    /// A setting of the optimiser, such as children=40 for evolution; repeatable. `--set help` lists them
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<String>,
    /// What is made small: balance, blend, likeness, iou or accuracy
    #[arg(long, value_name = "NAME", default_value = Objective::default().name())]
    objective: String,
    /// Seed of the search
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = input::seed)]
    seed: u64,
    /// Seed of the tree, or `any` to search it too
    #[arg(long, value_name = "N|any", default_value = "1", value_parser = options::tree_seed)]
    tree_seed: pleach_fit::TreeSeed,
    /// Judge parameters by the mean over this many trees, of the tree seed and those after it
    #[arg(long, value_name = "K", default_value = "1", value_parser = options::seeds)]
    robust: NonZeroU32,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "When to stop (whatever comes first; after a minute if nothing is said)")]
struct BudgetArgs {
    /// After this time, such as 90s, 10m or 2h. The first guess counts; it is made in full, and a first
    /// few trees are tried whatever time is left. Judging the result comes after it
    #[arg(long, value_name = "TIME", value_parser = options::duration)]
    timeout: Option<Duration>,
    /// After this many trees were grown and compared
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    evaluations: Option<u64>,
    /// After this many generations
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    generations: Option<u64>,
    /// When the intersection over union reaches this
    #[arg(long, value_name = "0..1", value_parser = options::share)]
    target_iou: Option<f64>,
}

impl GoalArgs {
    /// What was said of leaves.
    const fn leaves(&self) -> start::Leaves {
        if self.no_leaves { start::Leaves::Off } else { self.leaves }
    }
}

impl Fit {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let settings = self.settings()?;
        let Settings::Fit(settings) = settings else {
            return output::line(options::describe(&self.search.optimizer)?);
        };
        let (_, further) = views::sort(&self.goal_options.view)?;
        if self.goals.len() > 1 && !(further.is_empty() && self.goal_options.holdout_view.is_empty()) {
            bail!("further views are of one tree, and there are {} goals", self.goals.len());
        }
        if self.goal_options.free_frame && further.is_empty() {
            bail!("--free-frame is about further pictures, and there is none: --view auto=FILE");
        }
        // Before a folder is made.
        let start = self.search.from.species()?;
        check_freedom(start.generator.space(), &settings.freedom, settings.tree_seed)?;
        match &self.goals[..] {
            [goal] if self.shard.is_none() => self.single(goal, &settings),
            _ => batch::run(self, &settings),
        }
    }

    /// Fits one goal and shows its score card.
    fn single(&self, goal: &Path, settings: &FitSettings) -> anyhow::Result<()> {
        let goals = Goals::load(goal, &self.goal_options, self.verbose)?;
        let folder = self.folder(goal)?;
        let resume = self.resume && folder.is_unfinished();
        if !resume {
            folder.forget()?;
        }
        let interrupted = || {
            anyhow!(
                "interrupted; `pleach fit {} --out {} --resume` with the same options goes on",
                goal.display(),
                folder.path().display()
            )
        };
        let mut library = GuessLibrary::new();
        let summary = match self.fit(&goals, &folder, settings, &mut library, &catch_signals()?, resume) {
            Err(error) if is_interruption(&error) => return Err(interrupted()),
            result => result?,
        };
        if self.json {
            output::json(&summary)?;
        } else {
            output::line(report::report(&summary, goal, folder.path()))?;
        }
        if summary.interrupted() {
            return Err(interrupted());
        }
        folder.remove_checkpoint();
        Ok(())
    }

    /// Searches, judges and fills the run folder; the checkpoint stays.
    fn fit(
        &self,
        goal: &Goals,
        folder: &RunFolder,
        asked_for: &FitSettings,
        library: &mut GuessLibrary,
        stop: &Arc<AtomicBool>,
        resume: bool,
    ) -> anyhow::Result<Summary> {
        let mut settings = asked_for.clone();
        let mut problem = self.problem(&goal.working)?;
        let checkpoint =
            CheckpointSettings { path: folder.checkpoint(), interval: self.checkpoint_every, resume };
        let mut started = Instant::now();
        let leaves = self.goal_options.leaves();
        let quiet = self.goals.len() > 1;
        let begun = self.search.from.begin(quiet, leaves, (&mut problem, &mut settings), library, stop)?;
        if resume {
            // The first guess is made again, but its time has been counted.
            started = Instant::now();
        }
        let clock = || started.elapsed();
        let mut bar = Bar::new(&settings);
        let control =
            Control { observers: vec![&mut bar], checkpoint: Some(checkpoint), ..Control::new(&clock, stop) };
        let mut outcome = pleach_fit::fit(&problem, &settings, control)?;
        bar.finish();

        let Some(best) = outcome.best.clone().filter(|best| best.score.cost.is_finite()) else {
            if outcome.stop == StopReason::Interrupted {
                return Err(FitError::Interrupted.into());
            }
            bail!("no parameter list that grows a tree was found in {} evaluations", outcome.evaluations);
        };
        let aftermath = match outcome.stop {
            // Whoever waits for the prompt has it at once.
            StopReason::Interrupted => None,
            _ => match Aftermath::of(&problem, &settings, &best, begun.references.clone(), library, stop) {
                Err(FitError::Interrupted) => None,
                result => Some(result?),
            },
        };
        if aftermath.is_none() {
            // The search may have come to its end, the fit has not.
            outcome.stop = StopReason::Interrupted;
        }
        let best = aftermath.as_ref().map_or(&best, |aftermath| &aftermath.best);
        let species = folder::species(&problem, best, &goal.name)?;
        let growth = Growth {
            limits: settings.limits,
            foliage: if problem.foliage { Foliage::All } else { Foliage::None },
            ..Growth::seed(best.genome.tree_seed)
        };
        let tree = species.grow_with(&growth)?;
        let args = &self.goal_options;
        let (view, further) = views::sort(&args.view)?;
        let placements = pleach_fit::placements(&problem.goals, &best.genome.nuisances);
        // The first is the goal's own.
        let views = further
            .iter()
            .zip(placements.iter().skip(1))
            .map(|(picture, placement)| picture.score(&tree, problem.foliage, args.height, placement));
        let holdouts = args.holdout_view.iter();
        let holdouts = holdouts.map(|picture| picture.score(&tree, problem.foliage, args.height));
        folder.write(folder::Results {
            settings: &settings,
            outcome: &outcome,
            best,
            aftermath: aftermath.as_ref(),
            species: &species,
            tree: &tree,
            goal: &goal.full,
            working: &goal.working,
            view: &view,
            views: views.collect::<anyhow::Result<_>>()?,
            holdout_views: holdouts.collect::<anyhow::Result<_>>()?,
            height: args.height,
            foliage: problem.foliage,
            from: self.search.from.to_string(),
            looks_like: begun.looks_like,
            leaves_detected: begun.leaves_detected,
            references: begun.references.as_ref(),
            options: asked::asked(self, asked_for)?,
        })
    }

    fn problem(&self, goal: &Goal) -> anyhow::Result<FitProblem> {
        let start = self.search.from.species()?;
        let GoalArgs { height, size, free_frame, .. } = self.goal_options;
        let (view, further) = views::sort(&self.goal_options.view)?;
        let mut goals = vec![GoalView {
            goal: goal.bitmap.clone(),
            view,
            frame: goal.frame(height),
            unknown: Unknown::default(),
        }];
        for picture in further {
            goals.push(picture.goal_view(height, size, free_frame)?);
        }
        // A picture that cannot be read is told before the search and not after it.
        for picture in &self.goal_options.holdout_view {
            picture.check(height, size)?;
        }
        Ok(FitProblem {
            generator: start.generator,
            base: start.params.values().to_vec(),
            goals,
            foliage: self.goal_options.leaves().are_expected(),
        })
    }

    fn settings(&self) -> anyhow::Result<Settings> {
        let search = &self.search;
        if search.settings.iter().any(|s| s == "help") {
            return Ok(Settings::Help);
        }
        let budget = &self.budget;
        let mut timeout = budget.timeout;
        if timeout.is_none() && budget.evaluations.or(budget.generations).is_none() {
            timeout = Some(Duration::from_secs(60));
        }
        Ok(Settings::Fit(Box::new(FitSettings {
            optimizer: options::optimizer(&search.optimizer, &search.settings)?,
            budget: Budget {
                timeout,
                evaluations: budget.evaluations,
                generations: budget.generations,
                target_iou: budget.target_iou,
            },
            seed: search.seed,
            tree_seed: search.tree_seed,
            robust: search.robust,
            objective: search.objective.parse::<Objective>()?,
            freedom: pleach_fit::Freedom { free: search.free.clone(), fix: search.fix.clone() },
            ..FitSettings::default()
        })))
    }

    fn folder(&self, goal: &Path) -> anyhow::Result<RunFolder> {
        let path = self
            .out
            .clone()
            .unwrap_or_else(|| Path::new(RUNS).join(goal.file_stem().unwrap_or_else(|| "goal".as_ref())));
        RunFolder::open(path, self.resume, self.overwrite)
    }
}

/// Whether this is a fit that was asked to stop before it had anything to show.
fn is_interruption(error: &anyhow::Error) -> bool {
    matches!(error.downcast_ref(), Some(FitError::Interrupted))
}

/// A flag that ctrl-C and a request to end raise.
fn catch_signals() -> anyhow::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        // A second signal means now; the checkpoint on disk is as old as it may be.
        if raised.swap(true, Ordering::SeqCst) {
            std::process::exit(1);
        }
    })
    .context("cannot catch signals")?;
    Ok(stop)
}
