//! The `experiment.toml` of an experiment on photographs.

use crate::spec::{Evaluations, Source, stem};
use crate::within::{FileName, List, Real, Seconds};
use pleach::FitOptions;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::path::PathBuf;
use std::time::Duration;
use toml::Spanned;

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in super::super) struct PhotographsSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Trees of a search: its results are the same everywhere.
    pub(super) evaluations: Option<Spanned<Evaluations>>,
    /// Seconds of a whole fit; without either, what a fit takes by default.
    seconds: Option<Real<Seconds>>,
    pictures: List<Spanned<PictureSpec>>,
}

/// A picture of a tree.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PictureSpec {
    /// From the experiment's folder.
    pub(super) file: PathBuf,
    /// Pictures of a set are reported together.
    pub(super) set: FileName,
    /// Its name in the results; by default the file's name without its ending.
    name: Option<FileName>,
}

impl PictureSpec {
    /// Its name in the results.
    pub(super) fn name(&self) -> String {
        self.name.as_deref().map_or_else(|| stem(&self.file), str::to_owned)
    }
}

impl PhotographsSpec {
    pub(in super::super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        source.are_names_of_files(&self.pictures, PictureSpec::name)?;
        if let (Some(evaluations), Some(_)) = (&self.evaluations, self.seconds) {
            let message = "`evaluations` beside `seconds`, expected one of them";
            return Err(source.wrong(evaluations.span(), message));
        }
        Ok(self)
    }

    /// The pictures in order.
    pub(super) fn pictures(&self) -> impl ExactSizeIterator<Item = &PictureSpec> {
        self.pictures.iter().map(Spanned::get_ref)
    }

    /// The sets in the order of their first pictures.
    pub(super) fn sets(&self) -> Vec<&str> {
        let mut sets: Vec<&str> = Vec::new();
        for picture in self.pictures() {
            if !sets.contains(&&*picture.set) {
                sets.push(&picture.set);
            }
        }
        sets
    }

    /// What is asked of a fit: what a user gets by default, but for its length.
    pub(super) fn options(&self) -> anyhow::Result<FitOptions> {
        Ok(FitOptions {
            evaluations: self.evaluations.as_ref().map(|count| **count.get_ref()),
            timeout: self.seconds.map(|seconds| Duration::try_from_secs_f64(*seconds)).transpose()?,
            ..FitOptions::default()
        })
    }
}
