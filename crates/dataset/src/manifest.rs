//! What a data set says of itself: `manifest.json`.

use crate::arrays::{self, Array};
use crate::columns::{Columns, names_of};
use crate::error::DatasetError;
use crate::folder::{FAILURES, Folder, MANIFEST};
use crate::options::{DatasetOptions, Layer};
use pleach_fit::Prior;
use pleach_tree::Species;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::io::{self, Write as _};

/// The number of the format that is described here.
const FORMAT_VERSION: u32 = 1;

/// What was asked for.
#[derive(Clone, Debug, Serialize)]
struct Arguments {
    count: u32,
    view: Vec<f64>,
    size: u32,
    with: Vec<&'static str>,
    format: &'static str,
    shard: u32,
    spread: f64,
    free: Vec<String>,
    fix: Vec<String>,
    seed: u64,
}

/// A species that trees are drawn around.
#[derive(Clone, Debug, Serialize)]
struct Around {
    name: String,
    generator: &'static str,
    /// Names of its numbers.
    numbers: Vec<String>,
    /// Names of those that vary.
    free: Vec<String>,
    /// Its species file.
    toml: String,
}

/// A direction of view.
#[derive(Clone, Debug, Serialize)]
struct Viewed {
    azimuth_deg: f64,
    elevation_deg: f64,
    projection: &'static str,
    frame: &'static str,
}

/// What is known before the first tree.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Head {
    format_version: u32,
    program: &'static str,
    arguments: Arguments,
    species: Vec<Around>,
    /// Names of the columns of the numbers of all trees.
    numbers: Vec<String>,
    absent_numbers: &'static str,
    views: Vec<Viewed>,
    arrays: Vec<Array>,
    failures_file: &'static str,
}

/// A shard that is finished.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Shard {
    pub(crate) file: String,
    pub(crate) trees: u64,
    pub(crate) failures: u64,
    pub(crate) bytes: u64,
    pub(crate) sha256: String,
}

/// The whole file.
#[derive(Serialize)]
struct Manifest<'a> {
    #[serde(flatten)]
    head: &'a Head,
    /// Whether all shards are there.
    complete: bool,
    draws: u64,
    trees: u64,
    failures: u64,
    shards: &'a [Shard],
}

/// What a run that goes on reads of it.
#[derive(Deserialize)]
struct Found {
    shards: Vec<Shard>,
}

/// Keys that two runs have to agree on; all others follow from them.
const IDENTITY: [&str; 4] = ["format_version", "program", "arguments", "species"];

impl Head {
    pub(crate) fn new(
        species: &[Species],
        priors: &[Prior],
        options: &DatasetOptions,
        columns: &Columns,
    ) -> Self {
        let with = Layer::ALL.into_iter().filter(|&layer| options.has(layer)).map(Layer::name).collect();
        let around = |(one, prior): (&Species, &Prior)| {
            let space = one.params.space();
            Around {
                name: one.name.clone(),
                generator: one.generator.family(),
                numbers: names_of(one).collect(),
                free: prior
                    .genes()
                    .filter_map(|gene| gene.slot())
                    .map(|slot| space.slot_name(slot))
                    .collect(),
                toml: one.to_toml(&[]),
            }
        };
        let viewed = |&azimuth_deg: &f64| Viewed {
            azimuth_deg,
            elevation_deg: 0.0,
            projection: "orthographic",
            frame: "the ground is the bottom edge, the trunk's foot is in the middle, and the larger of height and \
                    width fills 95 % of the picture",
        };
        Self {
            format_version: FORMAT_VERSION,
            program: concat!("pleach ", env!("CARGO_PKG_VERSION")),
            arguments: Arguments {
                count: options.count,
                view: options.views.clone(),
                size: options.size,
                with,
                format: options.format.name(),
                shard: options.shard,
                spread: options.spread,
                free: options.freedom.free.clone(),
                fix: options.freedom.fix.clone(),
                seed: options.seed,
            },
            species: species.iter().zip(priors).map(around).collect(),
            numbers: columns.names.clone(),
            absent_numbers: "NaN: a tree has the numbers of its own species' generator, and all other columns are NaN",
            views: options.views.iter().map(viewed).collect(),
            arrays: arrays::arrays(options, columns),
            failures_file: FAILURES,
        }
    }

    /// Writes the manifest of a run that has finished some shards.
    pub(crate) fn write(
        &self,
        folder: &Folder,
        (draws, complete): (u64, bool),
        shards: &[Shard],
    ) -> Result<(), DatasetError> {
        let (trees, failures) = shards
            .iter()
            .fold((0, 0), |(trees, failures), shard| (trees + shard.trees, failures + shard.failures));
        let manifest = Manifest { head: self, complete, draws, trees, failures, shards };
        folder.write(MANIFEST, |file| {
            serde_json::to_writer_pretty(&mut *file, &manifest)?;
            file.write_all(b"\n")
        })
    }

    /// The finished shards of the data set in `folder`; `None` if there is no manifest.
    ///
    /// # Errors
    /// If it is that of another data set, or of none.
    pub(crate) fn read(&self, folder: &Folder) -> Result<Option<Vec<Shard>>, DatasetError> {
        let path = folder.at(MANIFEST);
        let text = match std::fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            text => text.map_err(DatasetError::io(&path, "cannot be read"))?,
        };
        let wrong = |error: serde_json::Error| DatasetError::Manifest {
            path: path.clone(),
            problem: error.to_string(),
        };
        let then: Value = serde_json::from_str(&text).map_err(wrong)?;
        // Through text as well, so that numbers are read alike.
        let now = serde_json::to_string(self).and_then(|text| serde_json::from_str::<Value>(&text));
        let now = now.map_err(wrong)?;
        let mut differences = Vec::new();
        for key in IDENTITY {
            compare(key, &then[key], &now[key], &mut differences);
        }
        if !differences.is_empty() {
            return Err(DatasetError::OtherArguments { folder: folder.path().to_owned(), differences });
        }
        let found: Found = serde_json::from_value(then).map_err(wrong)?;
        Ok(Some(found.shards))
    }
}

/// In what two values differ, as sentences about what is in them.
fn compare(name: &str, then: &Value, now: &Value, differences: &mut Vec<String>) {
    /// Longest value that is shown.
    const SHOWN: usize = 60;
    if then == now {
        return;
    }
    match (then, now) {
        (Value::Object(before), Value::Object(after)) => {
            for (key, value) in after {
                compare(key, before.get(key).unwrap_or(&Value::Null), value, differences);
            }
        }
        (Value::Array(before), Value::Array(after)) if name == "species" => {
            let names = |all: &[Value]| {
                let names = all.iter().map(|one| one["name"].as_str().unwrap_or("?"));
                names.collect::<Vec<_>>().join(", ")
            };
            let (before, after) = (names(before), names(after));
            differences.push(if before == after {
                format!("the species files of {after} were others")
            } else {
                format!("species was {before}, now {after}")
            });
        }
        _ => {
            let shown = |value: &Value| {
                let text = value.to_string();
                if text.chars().count() > SHOWN {
                    text.chars().take(SHOWN).chain(['…']).collect()
                } else {
                    text
                }
            };
            differences.push(format!("{name} was {}, now {}", shown(then), shown(now)));
        }
    }
}
