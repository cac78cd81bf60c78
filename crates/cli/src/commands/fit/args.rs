//! What `pleach fit` is told about the goal, the search and when to stop.

use super::goal::MaskSource;
use super::{individual, options, outlined, start, views};
use crate::input;
use anyhow::ensure;
use pleach::plan::Effort;
use pleach_fit::{IndividualSettings, Objective, RulesSettings, UnknownObjective};
use pleach_generators::GeneratorChoice;
use pleach_tree::Family as _;
use std::num::NonZeroU32;
use std::time::Duration;

#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "The goal")]
pub(super) struct GoalArgs {
    /// Height of the tree in metres: a silhouette does not show it
    #[arg(long, value_name = "METRES", default_value_t = 10.0, value_parser = options::positive)]
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
    pub(super) mask: Option<MaskSource>,
    /// Which of the two tones is the tree
    #[arg(long, value_enum, default_value_t = options::Tone::Auto)]
    pub(super) tree: options::Tone,
    /// Row where the tree stands, in pixels of the goal from its top; detected by default
    #[arg(long, value_name = "PIXELS")]
    pub(super) ground_row: Option<f64>,
    /// Column of the trunk's foot, in pixels of the goal from its left; detected by default
    #[arg(long, value_name = "PIXELS")]
    pub(super) axis_column: Option<f64>,
    /// Scale and place of the tree where they are known: metres per pixel, column of the trunk's foot and row of
    /// the ground, in pixels of the goal. Otherwise they are read off the picture, and registered to a part of a
    /// pixel by the trees that are tried
    #[arg(long, value_name = "METRES,COLUMN,ROW", value_parser = options::frame,
          conflicts_with_all = ["height", "ground_row", "axis_column"])]
    pub(super) frame: Option<options::KnownFrame>,
    /// Direction of the goal's view in degrees: azimuth, and elevation where it is not 0; with a file,
    /// a further picture of the same tree, fitted as well; repeatable. `~AZ=FILE` is from within 15
    /// degrees of it, `auto=FILE` from anywhere around the tree: the azimuth is then searched
    #[arg(long, value_name = "AZ[,EL][=FILE]", allow_hyphen_values = true)]
    pub(super) view: Vec<views::Direction>,
    /// Search the scale (± 20 %) and the place (± 10 % of width and height) of the tree in further
    /// pictures; the goal's own frame is taken as it is
    #[arg(long)]
    pub(super) free_frame: bool,
    /// A further picture of the same tree that is not fitted but scored; repeatable
    #[arg(long, value_name = "AZ[,EL]=FILE", allow_hyphen_values = true)]
    pub(super) holdout_view: Vec<views::KnownPicture>,
    /// Whether the tree has leaves: `auto` looks whether the goal is more like trees with leaves or
    /// like bare ones (with --from auto; otherwise it has)
    #[arg(long, value_enum, default_value_t = start::Leaves::Auto, conflicts_with = "no_leaves")]
    pub(super) leaves: start::Leaves,
    /// The same as --leaves off
    #[arg(long)]
    pub(super) no_leaves: bool,
}

impl GoalArgs {
    /// What was said of leaves.
    pub(super) const fn leaves(&self) -> start::Leaves {
        if self.no_leaves { start::Leaves::Off } else { self.leaves }
    }
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "The search")]
pub(super) struct SearchArgs {
    /// Where to start: from the known species that look most like the goal, from `random` parameter
    /// lists, or from one species (name or file)
    #[arg(long, value_name = "auto|random|SPECIES", default_value = "auto")]
    pub(super) from: start::From,
    /// The generator whose species take part in a first guess, and that `--from random` draws for; `auto`
    /// for all of them. By default weber-penn, or that of the species in --from
    #[arg(long, value_name = "auto|NAME")]
    pub(super) generator: Option<GeneratorChoice>,
    /// Start from a tree of least-cost paths in the outline of a picture: of the `goal`, with its further
    /// views from known directions, or of a file
    #[arg(long, value_name = "goal|FILE", conflicts_with_all = ["from", "evolve_rules"])]
    pub(super) volume_from: Option<outlined::VolumeFrom>,
    /// Parameters that may change: a name, a slot such as length[1], a group, or level:N; repeatable.
    /// All by default; see `pleach params`
    #[arg(long, value_name = "PATTERN")]
    pub(super) free: Vec<String>,
    /// Parameters that keep the start's value; repeatable
    #[arg(long, value_name = "PATTERN")]
    pub(super) fix: Vec<String>,
    /// The optimiser: evolution, cma (CMA-ES with margin), de (differential evolution, SHADE), hewitt
    /// (the dissertation's genetic algorithm) or random
    #[arg(long, value_name = "NAME", default_value = pleach_fit::Optimizer::NAMES[0])]
    pub(super) optimizer: String,
    /// Search the rules of a grammar too, and not only numbers: from the grammar in --from, by default
    /// from nothing; prints the grammar that was found. See docs/grammars.md
    #[arg(long, conflicts_with_all = ["optimizer", "settings"])]
    pub(super) evolve_rules: bool,
    /// A setting of the optimiser, such as children=8 for evolution; repeatable. `--set help` lists them
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(super) settings: Vec<String>,
    /// What is made small: balance (the default), overlap (of trees with a likeness of 0.765; the default with
    /// --evolve-rules), blend, likeness, iou or accuracy
    #[arg(long, value_name = "NAME")]
    pub(super) objective: Option<String>,
    /// Seed of the search
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = input::seed)]
    pub(super) seed: u64,
    /// Seed of the tree, or `any` to search it too
    #[arg(long, value_name = "N|any", default_value = "1", value_parser = options::tree_seed)]
    pub(super) tree_seed: pleach_fit::TreeSeed,
    /// Judge parameters by the mean over this many trees, of the tree seed and those after it
    #[arg(long, value_name = "K", default_value = "1", value_parser = options::seeds)]
    pub(super) robust: NonZeroU32,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "This very tree")]
pub(super) struct IndividualArgs {
    /// How long single branches are dealt anew until the tree lies on the picture: a time such as 20s,
    /// `Ntrees` for as many trees if --timeout leaves time for them, or off. By default a third of --timeout and what judging leaves of
    /// its share, or an eighth as many trees as --evaluations
    #[arg(long, value_name = "TIME|Ntrees|off", value_parser = individual::effort)]
    pub(super) individual: Option<Effort>,
    /// How many trees lie on the goal in the end, each dealt anew from the trunk up: one picture leaves their
    /// depth open. They share the time of --individual
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u8).range(1..=i64::from(IndividualSettings::MAX_COUNT)))]
    pub(super) individuals: u8,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "When to stop (whatever comes first; after a minute if nothing is said)")]
pub(super) struct BudgetArgs {
    /// After this time, such as 90s, 10m or 2h: for all of the fit, from the first guess to the last file. The first
    /// guess is made in full, and a few trees are tried whatever time is left. The result is judged by fewer trees
    /// where time is short, which is said
    #[arg(long, value_name = "TIME", value_parser = options::duration)]
    pub(super) timeout: Option<Duration>,
    /// After this many trees were grown and compared
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) evaluations: Option<u64>,
    /// After this many generations
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) generations: Option<u64>,
    /// When the intersection over union reaches this
    #[arg(long, value_name = "0..1", value_parser = options::share)]
    pub(super) target_iou: Option<f64>,
}

impl SearchArgs {
    /// What is made small: what was said, or what suits the search.
    pub(super) fn objective(&self) -> Result<Objective, UnknownObjective> {
        match &self.objective {
            Some(name) => name.parse(),
            None if self.evolve_rules => Ok(RulesSettings::OBJECTIVE),
            None => Ok(Objective::default()),
        }
    }

    /// The generators that take part: those that `--generator` says, the one of the species in `--from`,
    /// or the default one.
    pub(super) fn generator(&self) -> anyhow::Result<GeneratorChoice> {
        let outlined = pleach_least_cost_path::LeastCostPathFamily.name();
        Ok(match (&self.generator, &self.from) {
            (Some(choice), _) if self.volume_from.is_some() => {
                let family = GeneratorChoice::Family(outlined);
                ensure!(
                    *choice == family,
                    "--volume-from makes a tree of the generator {outlined}, and --generator says {choice}"
                );
                family
            }
            (None, _) if self.volume_from.is_some() => GeneratorChoice::Family(outlined),
            (None, start::From::Auto | start::From::Random) if self.evolve_rules => start::varied_family()?,
            (Some(choice), _) => *choice,
            (None, start::From::Species(name)) => {
                GeneratorChoice::Family(crate::input::species(name)?.generator.family())
            }
            (None, start::From::Auto | start::From::Random) => GeneratorChoice::default(),
        })
    }

    /// The species that the fit starts from, unless a first guess has a better one.
    pub(super) fn start(&self) -> anyhow::Result<pleach_tree::Species> {
        let generator = self.generator()?;
        if self.evolve_rules { self.from.varied(&generator) } else { self.from.species(&generator) }
    }
}
