//! The program from outside, in one test program so that it is linked once.
//!
//! | file | what belongs there |
//! | --- | --- |
//! | `grow.rs`, `silhouette.rs`, `fit.rs`, … | one file per command, run as a user would |
//! | `interruption.rs` | fits that are killed or asked to stop, and go on |
//! | `cluster.rs`, `collect.rs` | many workers at one batch, and what they leave |
//! | `ruler.rs` | goals of ours at their own numbers, and with other margins |
//! | `run_folder.rs` | what a fit does to the files that are there |
//! | `pictures.rs` | pictures from pipes, in odd formats, broken off, not of a tree |
//! | `grow_formats.rs`, `help.rs`, `shell.rs` | options of every format, help texts, standard output and shells |
//! | `bad_input.rs` | everything that must end in a clear error |
//! | `reference_stats.rs` | our trees against those of the reference generator |
//! | `experiments.rs` | a slice of each experiment against its committed results |
//! | `experiment_runs.rs` | what experiments write over and refuse, how they end and go on |
//! | `odd_files.rs` | links, pipes and left-over files in run folders; names that terminals and spreadsheets obey |
//! | `robustness.rs` | spoilt input under limits of memory and time |

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod bad_input;
mod bare;
mod batch;
mod bench;
mod blend;
mod bounds;
mod cluster;
mod collect;
mod dataset;
mod engine_files;
mod evolve;
mod experiment_runs;
mod experiments;
mod export;
mod fit;
mod grammar;
mod grow;
mod grow_formats;
mod help;
mod import;
mod individual;
mod interruption;
mod judged;
mod map;
mod mask;
mod measured;
mod odd_files;
mod params;
mod parity;
mod pictures;
mod pivot_painter;
mod posterior;
mod read;
mod reference_stats;
mod render;
mod robustness;
mod ruler;
mod run_folder;
mod shell;
mod silhouette;
mod skeletons;
mod weld;
