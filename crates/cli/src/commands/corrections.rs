//! What is otherwise in a picture than it is read, as it is typed.

use crate::{regular, text};
use anyhow::Context;
use pleach::Corrections;
use serde_json::Value;
use std::path::PathBuf;

/// A corrected reading, and measures that a person sees better.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct CorrectionArgs {
    /// A reading.json, or a part of one, with what is otherwise in the picture than it is read: values that differ are
    /// sure
    #[arg(long, value_name = "FILE")]
    reading: Option<PathBuf>,
    /// How many trunks there are
    #[arg(long, value_name = "N", value_parser = trunks)]
    pub(super) trunks: Option<u32>,
    /// How wide the main trunk is, in heights of the tree
    #[arg(long, value_name = "PART", value_parser = width)]
    pub(super) trunk_width: Option<f64>,
    /// How far the trunk leans from the vertical, in degrees, positive to the right
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = lean)]
    pub(super) lean: Option<f64>,
    /// Up to what part of the height the trunk is bare
    #[arg(long, value_name = "0..1", value_parser = share)]
    pub(super) bare_height: Option<f64>,
    /// At what part of the height the trunk first forks; `none` if it does not
    #[arg(long, value_name = "0..1|none", value_parser = fork)]
    first_fork: Option<Fork>,
}

/// Where a trunk first forks, if it does.
#[derive(Clone, Copy, Debug)]
struct Fork(Option<f64>);

impl CorrectionArgs {
    /// Whether nothing is corrected.
    pub(super) fn is_empty(&self) -> bool {
        let Self { reading, trunks, trunk_width, lean, bare_height, first_fork } = self;
        let numbers = [trunk_width, lean, bare_height];
        reading.is_none()
            && trunks.is_none()
            && first_fork.is_none()
            && numbers.into_iter().all(Option::is_none)
    }

    /// What the library is told: single measures in place of those in the file.
    ///
    /// # Errors
    /// The file cannot be read, or is not one of measures.
    pub(super) fn corrections(&self) -> anyhow::Result<Corrections> {
        let mut corrections = match &self.reading {
            None => Corrections::default(),
            Some(path) => {
                let json = regular::read_text(path)?;
                let wrong = || format!("{} is not a reading", text::path(path));
                Corrections::from_json(&json)
                    .map_err(|error| anyhow::anyhow!(error.problem))
                    .with_context(wrong)?
            }
        };
        let fork = self.first_fork.map(|Fork(height)| height.map_or(Value::Null, Value::from));
        let typed = [
            ("trunks", self.trunks.map(Value::from)),
            ("trunk_width", self.trunk_width.map(Value::from)),
            ("lean_deg", self.lean.map(Value::from)),
            ("bare_height", self.bare_height.map(Value::from)),
            ("first_fork", fork),
        ];
        for (key, value) in typed {
            if let Some(value) = value {
                corrections = corrections.confirmed(key, value);
            }
        }
        Ok(corrections)
    }
}

pub(super) fn trunks(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| (1..=64).contains(count));
    count.ok_or_else(|| "expected a whole number from 1 to 64".to_owned())
}

pub(super) fn width(text: &str) -> Result<f64, String> {
    number(text, 0.001, 2.0).ok_or_else(|| "expected heights of the tree from 0.001 to 2".to_owned())
}

pub(super) fn lean(text: &str) -> Result<f64, String> {
    number(text, -90.0, 90.0).ok_or_else(|| "expected degrees from -90 to 90".to_owned())
}

pub(super) fn share(text: &str) -> Result<f64, String> {
    number(text, 0.0, 1.0).ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

fn fork(text: &str) -> Result<Fork, String> {
    if text == "none" { Ok(Fork(None)) } else { share(text).map(|height| Fork(Some(height))) }
}

fn number(text: &str, least: f64, most: f64) -> Option<f64> {
    text.parse().ok().filter(|number| (least..=most).contains(number))
}
