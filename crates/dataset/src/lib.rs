//! Training data for machine learning: trees around species, with their numbers and pictures, in shards.
//!
//! ```
//! use pleach_dataset::{Control, DatasetOptions, Mode};
//! use std::sync::atomic::AtomicBool;
//!
//! let species = [pleach_generators::species("palm")?];
//! let options = DatasetOptions { count: 5, size: 32, ..DatasetOptions::default() };
//! let folder = tempfile::tempdir()?;
//! let control = Control { stop: &AtomicBool::new(false), progress: &|_| () };
//! let written = pleach_dataset::write(&species, &options, folder.path(), Mode::New, &control)?;
//! assert_eq!((written.trees, written.shards), (5, 1));
//! assert!(folder.path().join("shard-00000.npz").is_file());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | idea |
//! | --- | --- |
//! | `options` | what is asked for, and whether it can be |
//! | `columns` | the numbers of several species as one row |
//! | `example` | one tree: its numbers, pictures and skeleton |
//! | `arrays` | what a shard holds, array by array |
//! | `npy`, `npz`, `webdataset` | the formats of files |
//! | `manifest`, `failures` | what is said of the shards |
//! | `folder` | files that appear whole or not at all |
//! | `run` | shard after shard |
//!
//! # Invariants
//!
//! A shard is a function of the species, the options and its number. So no thread, platform, clock or interruption
//! changes a byte, and a run that was stopped goes on at any shard.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod arrays;
mod columns;
mod error;
mod example;
mod failures;
mod folder;
mod manifest;
mod npy;
mod npz;
mod options;
mod run;
mod webdataset;

pub use error::DatasetError;
pub use options::{DatasetOptions, Format, Layer};
pub use run::{Control, Mode, Progress, Written, write};
