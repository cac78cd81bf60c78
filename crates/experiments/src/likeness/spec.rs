//! The `experiment.toml` of an experiment about likeness.

use super::line::{Line, MIN_STEPS};
use crate::spec::Source;
use crate::within::{List, SpeciesName, Whole};
use anyhow::Context;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::path::PathBuf;
use toml::Spanned;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in super::super) struct LikenessSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Species by name.
    pub(in super::super) species: List<Spanned<SpeciesName>, 2>,
    /// Species that had no part in the choice of weights.
    pub(in super::super) unseen_species: List<Spanned<SpeciesName>, 0>,
    /// Seeds 1 to this of each species.
    pub(in super::super) seeds: Whole<2, 100>,
    /// Seeds 1 to this had a part in the choice of weights.
    pub(in super::super) tuned_seeds: Spanned<Whole<0, 100>>,
    /// Seeds 1 to this of each species are drawn in each other's frames.
    pub(in super::super) shared_scale_seeds: Whole<1, 100>,
    /// Folders of pictures by another program, from the experiment's: the first of seed 1, and so on.
    pub(in super::super) reference: List<PathBuf, 0, 100>,
    /// Parameters that walk away from the truth, as slots.
    pub(in super::super) walks: List<Spanned<String>, 1, 100>,
    /// Steps of each walk; shorter ones say too little about order.
    pub(in super::super) walk_steps: Whole<{ MIN_STEPS as u64 }, 100>,
    /// Species whose first tree that the weights have not seen is the goal of a row of the sheet.
    pub(in super::super) sheet: List<Spanned<String>, 1, 100>,
    /// The walks, once they are made: curves need more of them than their rows say.
    #[serde(skip)]
    pub(in super::super) walked: std::sync::OnceLock<Vec<Line>>,
}

impl LikenessSpec {
    pub(in super::super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.all_differ(self.species.iter().chain(&self.unseen_species), |name| name.to_string(), "")?;
        let (seeds, tuned) = (*self.seeds, **self.tuned_seeds.get_ref());
        if tuned >= seeds {
            let message = format!("{tuned} of {seeds} seeds, expected at most {}", seeds - 1);
            return Err(source.wrong(self.tuned_seeds.span(), message));
        }
        let space = pleach_generators::preset("quaking_aspen").context("the default species is built in")?;
        for walk in &self.walks {
            if let Err(problem) = space.generator.space().select(walk.get_ref()) {
                return Err(source.wrong(walk.span(), format!("`{}` {problem}", walk.get_ref())));
            }
        }
        for name in &self.sheet {
            if !self.species.iter().any(|species| **species.get_ref() == *name.get_ref()) {
                let message = format!("`{}` is not among the species", name.get_ref());
                return Err(source.wrong(name.span(), message));
            }
        }
        source.all_differ(&self.walks, String::clone, "")?;
        source.all_differ(&self.sheet, String::clone, "")?;
        Ok(self)
    }
}
