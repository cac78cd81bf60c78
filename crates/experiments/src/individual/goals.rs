//! Goals of individuals: pictures, and trees of known species.

use super::SIDE;
use crate::pictured::{load_view, pictured};
use crate::spec::{Seed, stem};
use crate::within::{FileName, Meters, Real, SpeciesName};
use anyhow::Context;
use pleach_fit::{FitProblem, GoalView};
use pleach_silhouette::View;
use pleach_tree::{Foliage, Tree};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A goal: a picture with the height of its tree, or a species with the seed of one.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IndividualGoal {
    /// Its name; by default its file's or its species'.
    name: Option<FileName>,
    /// The picture, from the experiment's folder.
    pub(super) file: Option<PathBuf>,
    /// Height of its tree in metres.
    height: Option<Real<Meters>>,
    species: Option<SpeciesName>,
    seed: Option<Seed>,
    /// Whether its tree has leaves.
    #[serde(default = "yes")]
    leaves: bool,
    /// Whether there is a second picture, from the side; of species only.
    #[serde(default)]
    two_views: bool,
    /// Its group of goals in the report.
    group: FileName,
}

const fn yes() -> bool {
    true
}

impl IndividualGoal {
    /// Its name in the results.
    pub(super) fn name(&self) -> String {
        if let Some(name) = &self.name {
            return name.to_string();
        }
        let bare = if self.leaves { "" } else { "_bare" };
        let views = if self.two_views { "_two_views" } else { "" };
        match (&self.file, &self.species) {
            (Some(file), _) => stem(file),
            (None, Some(species)) => format!("{}{bare}{views}", species.as_str()),
            (None, None) => String::new(),
        }
    }

    pub(super) fn group(&self) -> &str {
        &self.group
    }

    /// How it is spoilt, if it is.
    pub(super) fn check(&self) -> Result<(), &'static str> {
        match (&self.file, self.height.is_some(), &self.species, self.seed.is_some()) {
            (Some(_), true, None, false) if !self.two_views => Ok(()),
            (None, false, Some(species), true) if pleach_generators::preset(species.as_str()).is_some() => {
                Ok(())
            }
            (None, false, Some(_), true) => Err("expected a species that comes with pleach"),
            _ => Err("expected a `file` with its `height`, or a `species` with a `seed`"),
        }
    }

    fn foliage(&self) -> Foliage {
        if self.leaves { Foliage::All } else { Foliage::None }
    }

    fn tree(&self) -> anyhow::Result<Option<Tree>> {
        let (Some(species), Some(seed)) = (&self.species, &self.seed) else { return Ok(None) };
        let species = pleach_generators::species(species.as_str())?;
        Ok(Some(if self.leaves { species.grow(**seed)? } else { species.grow_bare(**seed)? }))
    }

    /// The problem to fit; a first guess finds the species.
    pub(super) fn problem(&self, folder: &Path) -> anyhow::Result<FitProblem> {
        let start = pleach_generators::presets(pleach_generators::default_family());
        let start = start.into_iter().next().context("a generator has species that are built in")?;
        let goals = match self.tree()? {
            Some(tree) => {
                let views = [View::FRONT, View::degrees(SIDE, 0.0)];
                let views = views.into_iter().take(1 + usize::from(self.two_views));
                views.map(|view| pictured(&tree, view, self.leaves)).collect()
            }
            None => {
                let file = self.file.as_ref().context("a goal without a species has a file")?;
                let height = self.height.as_ref().context("a picture has a height")?;
                vec![load_view(folder, file, **height)?]
            }
        };
        Ok(FitProblem { start, goals, foliage: self.foliage() })
    }

    /// The picture from another direction, of goals with two views.
    pub(super) fn held_out(&self, degrees: f64) -> anyhow::Result<Option<GoalView>> {
        let tree = self.tree()?.filter(|_| self.two_views);
        Ok(tree.map(|tree| pictured(&tree, View::degrees(degrees, 0.0), self.leaves)))
    }
}
