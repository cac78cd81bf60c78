//! The arguments of `pleach fit`, as they are typed.

use super::super::corrections::CorrectionArgs;
use super::super::hints::HintArgs;
use super::help;
use super::run_folder::Mode;
use super::values::{self, Shard, ViewArg};
use crate::choice::one_of;
use crate::input;
use crate::segmenter::Segmenter;
use pleach::{
    AppearanceFrom, Effort, FurtherView, GeneratorChoice, KnownFrame, Leaves, MaskFrom, Objective, Optimizer,
    StartFrom, Tone, TreeSeed, VolumeFrom, parse_duration,
};
use pleach_fit::IndividualSettings;
use std::num::NonZeroU32;
use std::path::PathBuf;
use std::time::Duration;

/// Fit a generator's parameters to a goal image
#[derive(Debug, clap::Args)]
#[command(after_help = help::EXAMPLES, args_override_self = true)]
pub(crate) struct Fit {
    /// The goal, or several: PNG, JPEG, WebP, TIFF, GIF, BMP or SVG; black on white, white on black, or by transparency;
    /// `-` is standard input
    #[arg(value_name = "GOAL", required_unless_present = "list")]
    pub(super) goals: Vec<PathBuf>,
    /// A CSV file of goals, each with options of its own; see below
    #[arg(long, value_name = "FILE", conflicts_with = "goals")]
    pub(super) list: Option<PathBuf>,
    /// The run folder, runs/GOAL by default; the folder of run folders with several goals, runs by
    /// default
    #[arg(short, long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Go on from the checkpoint in the run folder, or start if the fit was stopped before there was
    /// one; a fit that is finished is left as it is
    #[arg(long)]
    pub(super) resume: bool,
    /// Search on from where a finished fit ended: budgets count from there. Ends as one longer fit
    #[arg(long = "continue", conflicts_with = "resume")]
    pub(super) go_on: bool,
    /// Fit goals I, I + N, I + 2N … only; the summary is then summary-I-of-N.csv
    #[arg(long, value_name = "I/N")]
    pub(super) shard: Option<Shard>,
    /// How often the state of the search is saved: what a crash may cost
    #[arg(long, value_name = "TIME", default_value = "1s", value_parser = parse_duration)]
    pub(super) checkpoint_every: Duration,
    /// Start over, replacing any fit in the run folder
    #[arg(long, conflicts_with_all = ["resume", "go_on"])]
    pub(super) overwrite: bool,
    /// Say more: what was found in the goal
    #[arg(short, long)]
    pub(super) verbose: bool,
    /// Print the summary as JSON
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    pub(super) goal_options: GoalArgs,
    #[command(flatten)]
    pub(super) search: SearchArgs,
    #[command(flatten)]
    pub(super) individual: IndividualArgs,
    #[command(flatten)]
    pub(super) posterior: PosteriorArgs,
    #[command(flatten)]
    pub(super) budget: BudgetArgs,
}

#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "The goal")]
pub(super) struct GoalArgs {
    /// Height of the tree in metres: a silhouette does not show it
    #[arg(long, value_name = "METRES", default_value_t = 10.0, value_parser = values::height)]
    pub(super) height: f64,
    /// Longer side of the pictures that the search compares, in pixels; larger goals are reduced. Where a goal ends
    /// at its tree, or shows little else than paper, the tree gets a margin: its own longer side is then 95 % of
    /// this, and what a tree has beyond the goal's edges counts. The score card and best.png have the goal's own
    /// scale
    #[arg(long, value_name = "PIXELS", default_value_t = 256, value_parser = clap::value_parser!(u32).range(16..=2048))]
    pub(super) size: u32,
    /// A picture of the goal's size, or of its shape, that says what is tree: white on black. With `auto` the goal is a
    /// photograph, and its mask is made as by `pleach mask`
    #[arg(long, value_name = "FILE|auto")]
    pub(super) mask: Option<MaskFrom>,
    /// A program that makes the mask of a photograph, as in `pleach mask`
    #[arg(long, value_name = "COMMAND", conflicts_with = "mask")]
    pub(super) mask_command: Option<Segmenter>,
    #[command(flatten)]
    pub(super) hints: HintArgs,
    /// A picture of the goal's size that says what of the tree is wood, trunk and branches: black on white
    #[arg(long, value_name = "FILE")]
    pub(super) wood: Option<String>,
    #[command(flatten)]
    pub(super) corrections: CorrectionArgs,
    /// Which of the two tones is the tree
    #[arg(long, default_value = "auto", value_parser = one_of(values::TONES))]
    pub(super) tree: Tone,
    /// Row where the tree stands, in pixels of the goal from its top; detected by default
    #[arg(long, value_name = "PIXELS")]
    pub(super) ground_row: Option<f64>,
    /// Column of the trunk's foot, in pixels of the goal from its left; detected by default
    #[arg(long, value_name = "PIXELS")]
    pub(super) axis_column: Option<f64>,
    /// Scale and place of the tree where they are known: metres per pixel, column of the trunk's foot and row of
    /// the ground, in pixels of the goal. Otherwise they are read off the picture, and registered to a part of a
    /// pixel by the trees that are tried
    #[arg(long, value_name = "METRES,COLUMN,ROW", value_parser = values::frame,
          conflicts_with_all = ["height", "ground_row", "axis_column"])]
    pub(super) frame: Option<KnownFrame>,
    /// Direction of the goal's view in degrees: azimuth, and elevation where it is not 0; with a file,
    /// a further picture of the same tree, fitted as well; repeatable. `~AZ=FILE` is from within 15
    /// degrees of it, `auto=FILE` from anywhere around the tree: the azimuth is then searched
    #[arg(long, value_name = "AZ[,EL][=FILE]", allow_hyphen_values = true)]
    pub(super) view: Vec<ViewArg>,
    /// Search the scale (± 20 %) and the place (± 10 % of width and height) of the tree in further
    /// pictures; the goal's own frame is taken as it is
    #[arg(long)]
    pub(super) free_frame: bool,
    /// A further picture of the same tree that is not fitted but scored; repeatable
    #[arg(long, value_name = "AZ[,EL]=FILE", allow_hyphen_values = true, value_parser = values::known_view)]
    pub(super) holdout_view: Vec<FurtherView>,
    /// Whether the tree has leaves: `auto` looks whether the goal is more like trees with leaves or
    /// like bare ones (with --from auto; with --from SPECIES as its file says; otherwise it has)
    #[arg(long, default_value = "auto", value_parser = one_of(values::LEAVES), conflicts_with = "no_leaves")]
    pub(super) leaves: Leaves,
    /// Where the colours and the season of the result come from
    #[arg(long, default_value = "picture", value_parser = one_of(values::APPEARANCES))]
    pub(super) appearance: AppearanceFrom,
    /// The same as --leaves off
    #[arg(long)]
    pub(super) no_leaves: bool,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "The search")]
pub(super) struct SearchArgs {
    /// Where to start: from the known species that look most like the goal, from `random` parameter
    /// lists, or from one species (name or file)
    #[arg(long, value_name = "auto|random|SPECIES", default_value = "auto")]
    pub(super) from: StartFrom,
    /// The generator whose species take part in a first guess, and that `--from random` draws for: `auto`
    /// for all of them, `trees` for weber-penn and space-colonization. By default that of the species in --from, for a
    /// drawing in flat colors stylised, for other pictures trees (of silhouettes those of 100 pixels and more), and
    /// else weber-penn
    #[arg(long, value_name = "auto|trees|NAME")]
    pub(super) generator: Option<GeneratorChoice>,
    /// Start from a tree of least-cost paths in the outline of a picture: of the `goal`, with its further
    /// views from known directions, or of a file
    #[arg(long, value_name = "goal|FILE", conflicts_with_all = ["from", "evolve_rules"])]
    pub(super) volume_from: Option<VolumeFrom>,
    /// Parameters that may change: a name, a slot such as length[1], a group, or level:N; repeatable.
    /// All by default; see `pleach params`
    #[arg(long, value_name = "PATTERN")]
    pub(super) free: Vec<String>,
    /// Parameters that keep the start's value; repeatable
    #[arg(long, value_name = "PATTERN")]
    pub(super) fix: Vec<String>,
    /// The optimiser: evolution, cma (CMA-ES with margin), de (differential evolution, SHADE), hewitt
    /// (the dissertation's genetic algorithm) or random
    #[arg(long, value_name = "NAME", default_value = Optimizer::NAMES[0])]
    pub(super) optimizer: String,
    /// Search the rules of a grammar too, and not only numbers: from the grammar in --from, by default
    /// from nothing; prints the grammar that was found. See docs/grammars.md
    #[arg(long, conflicts_with_all = ["optimizer", "settings"])]
    pub(super) evolve_rules: bool,
    /// A setting of the optimiser, such as children=8 for evolution; repeatable. `--set help` lists them
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(super) settings: Vec<String>,
    /// What the search minimises: balance (the default), overlap (of trees with a likeness of 0.765; the default with
    /// --evolve-rules), blend, likeness, iou or accuracy
    #[arg(long, value_name = "NAME")]
    pub(super) objective: Option<Objective>,
    /// Seed of the search
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = input::seed)]
    pub(super) seed: u64,
    /// Seed of the tree, or `any` to search it too
    #[arg(long, value_name = "N|any", default_value = "1", value_parser = values::tree_seed)]
    pub(super) tree_seed: TreeSeed,
    /// Judge parameters by the mean over this many trees, of the tree seed and those after it
    #[arg(long, value_name = "K", default_value = "1", value_parser = values::robust)]
    pub(super) robust: NonZeroU32,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "This very tree")]
pub(super) struct IndividualArgs {
    /// How long single branches are re-sampled until the tree lies on the picture: a time such as 20s, a
    /// number of trees such as 400trees if --timeout leaves time for them, or off. By default a third of --timeout and what
    /// judging leaves of its share, or an eighth as many trees as --evaluations
    #[arg(long, value_name = "TIME|Ntrees|off")]
    pub(super) individual: Option<Effort>,
    /// How many trees lie on the goal in the end, each re-sampled from the trunk up: one picture leaves their
    /// depth open. They share the time of --individual
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u8).range(1..=i64::from(IndividualSettings::MAX_COUNT)))]
    pub(super) individuals: u8,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "How sure it is")]
pub(super) struct PosteriorArgs {
    /// Learn from this many trees, 2000 by default, how surely the picture determines each number, and draw eight trees
    /// that it may be of. The trees are around the species that the search started from; they are grown after all
    /// else, and not within --timeout
    #[arg(long, value_name = "TREES", num_args = 0..=1, default_missing_value = "2000",
          value_parser = clap::value_parser!(u32).range(100..=20_000))]
    pub(super) posterior: Option<u32>,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "When to stop (whatever comes first; after a minute by default)")]
pub(super) struct BudgetArgs {
    /// After this time, such as 90s, 10m or 2h: for all of the fit, from the first guess to the last file. The first
    /// guess is made in full, and a few trees are tried whatever time is left. The result is judged by fewer trees
    /// where time is short, which is said
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub(super) timeout: Option<Duration>,
    /// After this many trees were grown and compared
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) evaluations: Option<u64>,
    /// After this many generations
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) generations: Option<u64>,
    /// When the intersection over union reaches this
    #[arg(long, value_name = "0..1", value_parser = values::share)]
    pub(super) target_iou: Option<f64>,
}

impl Fit {
    /// Whether there is a folder of run folders.
    pub(super) const fn is_batch(&self) -> bool {
        self.goals.len() != 1 || self.shard.is_some()
    }

    /// What to do about what is in a run folder.
    pub(super) const fn mode(&self) -> Mode {
        match (self.resume, self.go_on, self.overwrite) {
            (true, ..) => Mode::Resume,
            (_, true, _) => Mode::Continue,
            (.., true) => Mode::Overwrite,
            _ => Mode::New,
        }
    }
}
