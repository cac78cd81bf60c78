//! Several trees that all lie on one goal: `--individuals`.

use super::drawing::write_species;
use super::run_folder::Claim;
use super::run_folder::names::{SHEET, individual_file};
use crate::files;
use pleach::{Bitmap, FittedTree, SideTree, SidesReport};
use pleach_silhouette::picture::{self, Picture};

/// Trees in a row of the sheet, each with its view from the side.
const TREES_IN_A_ROW: usize = 4;
const INK: [u8; 3] = [0; 3];

/// Writes the species files of all trees but the first, and a sheet of all over the `goal` at the search's size.
pub(super) fn write(
    claim: &Claim,
    goal: &Bitmap,
    found: &[FittedTree],
    sides: &SidesReport,
) -> anyhow::Result<()> {
    let mut cells = Vec::new();
    for (number, (tree, one)) in found.iter().zip(&sides.trees).enumerate() {
        let SideTree { stems, iou, likeness, front, side, .. } = one;
        if number > 0 {
            let comment =
                format!("A tree on the same goal as individual.toml: {stems} stems have draws of their own.");
            write_species(&claim.file(&individual_file(number)), &tree.species, &[comment])?;
        }
        let label = format!("{}  IoU {iou:.3}, likeness {likeness:.3}", number + 1);
        cells.push((label, picture::overlay(front, goal)));
        let mut turned = Picture::new(side.width(), side.height());
        turned.stamp(side, 0, 0, INK);
        cells.push((format!("{}  from the side", number + 1), turned));
    }
    let cells: Vec<(&str, Picture)> =
        cells.iter().map(|(label, picture): &(String, Picture)| (label.as_str(), picture.clone())).collect();
    let sheet = picture::sheet_of_pictures(&cells, 2 * TREES_IN_A_ROW.min(found.len()));
    files::write_whole(&claim.file(SHEET), |out| Ok(sheet.write_png(out)?))
}

/// All of it in a line.
pub(super) fn line(sides: &SidesReport) -> String {
    let least = |of: fn(&SideTree) -> f64| sides.trees.iter().map(of).fold(1.0, f64::min);
    format!(
        "{} trees lie on the goal with IoU {:.3} or more and likeness {:.3} or more; from the side every two of \
         them share {:.0} % (blurred IoU), free trees of the kind {:.0} %\n",
        sides.trees.len(),
        least(|one| one.iou),
        least(|one| one.likeness),
        100.0 * sides.side_blurred_iou,
        100.0 * sides.free_side_blurred_iou
    )
}
