//! The `experiment.toml` of the exam: all of it, unless something is left out.

use super::budget::Budget;
use super::contestant::Contestant;
use super::goal::{AROUND, Origin, only};
use crate::spec::{Evaluations, Source};
use crate::within::{List, Real, Seconds, Whole, Word};
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// Trees of a search.
const TREES: [u64; 2] = [100, 1000];
/// Seconds of a fit.
const SECONDS: [f64; 2] = [5.0, 60.0];

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in super::super) struct BenchSpec {
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    #[serde(rename = "question")]
    _question: Option<String>,
    /// Who takes part; all by default.
    rows: Option<List<Spanned<Word<Contestant>>>>,
    /// Sets of goals, or goals, by name; all by default.
    only: Option<Spanned<List<String>>>,
    /// Goals around each species.
    around: Option<Whole<1, AROUND>>,
    /// Trees of searches.
    trees: Option<List<Evaluations, 0>>,
    /// Seconds of fits.
    seconds: Option<List<Real<Seconds>, 0>>,
    /// A folder of pictures of trees, from the experiment's folder.
    photographs: Option<Spanned<PathBuf>>,
}

impl BenchSpec {
    pub(in super::super) fn checked(self, source: &Source) -> anyhow::Result<Self> {
        if let Some(rows) = &self.rows {
            source.all_differ(rows, |word| word.text.clone(), "")?;
        }
        let folder = source.path.parent().unwrap_or(Path::new(""));
        if let Some(photographs) = &self.photographs {
            let found = Origin::all(AROUND, Some(&folder.join(photographs.get_ref())));
            found.map_err(|error| source.wrong(photographs.span(), format!("{error:#}")))?;
        }
        if let Some(words) = &self.only {
            let named = only(self.all(folder)?, &texts(words.get_ref()));
            named.map_err(|message| source.wrong(words.span(), message))?;
        }
        Ok(self)
    }

    fn all(&self, folder: &Path) -> anyhow::Result<Vec<Origin>> {
        let photographs = self.photographs.as_ref().map(|path| folder.join(path.get_ref()));
        Origin::all(self.around.map_or(AROUND, |around| *around), photographs.as_deref())
    }

    /// The goals in order; paths are from `folder`.
    pub(super) fn origins(&self, folder: &Path) -> anyhow::Result<Vec<Origin>> {
        let all = self.all(folder)?;
        match &self.only {
            None => Ok(all),
            Some(words) => only(all, &texts(words.get_ref())).map_err(anyhow::Error::msg),
        }
    }

    /// Who takes part.
    pub(super) fn contestants(&self) -> Vec<Contestant> {
        let named =
            |rows: &List<Spanned<Word<Contestant>>>| rows.iter().map(|word| word.get_ref().value).collect();
        self.rows.as_ref().map_or_else(|| Contestant::ALL.to_vec(), named)
    }

    /// The budgets in the order in which they are run: what is the same everywhere comes first.
    pub(super) fn budgets(&self) -> Vec<Budget> {
        let trees =
            self.trees.as_ref().map_or_else(|| TREES.to_vec(), |trees| trees.iter().map(|n| **n).collect());
        let seconds =
            self.seconds.as_ref().map_or_else(|| SECONDS.to_vec(), |all| all.iter().map(|s| **s).collect());
        std::iter::once(Budget::Free)
            .chain(trees.into_iter().map(Budget::Trees))
            .chain(seconds.into_iter().map(Budget::Seconds))
            .collect()
    }
}

fn texts(words: &List<String>) -> Vec<&str> {
    words.iter().map(String::as_str).collect()
}
