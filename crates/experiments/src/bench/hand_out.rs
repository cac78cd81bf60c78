//! The goals as files, for contestants that are not in this program.

use super::BenchOptions;
use super::goal::Goal;
use crate::record::{self, Fixed};
use crate::table::Table;
use anyhow::Result;
use pleach_console::files;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A goal as others need it.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Listed {
    goal: String,
    set: String,
    file: String,
    width: u32,
    height: u32,
    /// From the ground to the highest ink.
    height_m: Fixed<4>,
    meters_per_pixel: record::Exact,
    axis_column: record::Exact,
    ground_row: record::Exact,
    /// CRC-32 of the PNG file.
    crc32: String,
}

impl Listed {
    fn new(goal: &Goal, png: &[u8]) -> Self {
        let frame = goal.frame();
        Self {
            goal: goal.name.clone(),
            set: goal.set.to_string(),
            file: format!("{}.png", goal.name),
            width: frame.width,
            height: frame.height,
            height_m: Fixed(goal.height()),
            meters_per_pixel: record::Exact(frame.meters_per_pixel),
            axis_column: record::Exact(frame.axis_column),
            ground_row: record::Exact(frame.ground_row),
            crc32: format!("{:08x}", crc32fast::hash(png)),
        }
    }
}

/// Writes the pictures of the goals into `folder`, and `goals.csv`, which says where each tree stands. Gives their
/// number. Truths and held-out views are not written.
///
/// # Errors
/// If an option says what cannot be, or a file cannot be written.
pub fn hand_out(options: &BenchOptions, folder: &Path) -> Result<usize> {
    let goals = options.goals()?;
    files::make_folder(folder)?;
    let mut rows = Vec::new();
    for goal in &goals {
        let png = goal.picture().to_png();
        let listed = Listed::new(goal, &png);
        files::write_whole(&folder.join(&listed.file), |file| Ok(std::io::Write::write_all(file, &png)?))?;
        rows.push(record::to_row(&listed)?);
    }
    Table { columns: record::columns(&Listed::default())?, rows }.write(&folder.join("goals.csv"))?;
    Ok(goals.len())
}
