//! What the goal says about the numbers of its tree: `--posterior`.

use super::drawing::write_species;
use super::judged::readable;
use super::run_folder::Claim;
use super::run_folder::names::{POSTERIOR_SHEET, sample_file};
use crate::commands::sheet::{render, sheet};
use crate::{files, output};
use pleach::{FitDrawing, Interval, NumberReport, PosteriorReport};
use pleach_render::png_file;

/// Pixels a side of each tree on the sheet.
const SIZE: u32 = 256;
/// Numbers that are said, those that the picture tells most about.
const SHOWN: usize = 8;
/// A variance that is smaller by less is not worth a line.
const LEAST: f64 = 0.1;

/// Writes the species files of the trees that the goal may be of, and a sheet of them.
pub(super) fn write(claim: &Claim, drawing: &FitDrawing<'_>, found: &PosteriorReport) -> anyhow::Result<()> {
    let mut trees = Vec::new();
    for (number, species) in found.samples.iter().enumerate() {
        let comment = format!(
            "A tree that the goal may be of, drawn from the posterior around {}: see posterior.csv.",
            found.species
        );
        write_species(&claim.file(&sample_file(number)), species, &[comment])?;
        trees.push(drawing.grow(species).ok().map(|tree| render(&tree, species, SIZE)));
    }
    // It may be that none grows.
    if trees.is_empty() {
        return Ok(());
    }
    let sheet = sheet(&trees, SIZE);
    files::write_whole(&claim.file(POSTERIOR_SHEET), |out| Ok(png_file::write(out, &[sheet], 0)?))
}

/// Rows of `posterior.csv`, the header first.
pub(super) fn table(found: &PosteriorReport) -> Vec<Vec<String>> {
    let header = [
        "parameter",
        "shrunk",
        "prior_low",
        "prior_median",
        "prior_high",
        "posterior_low",
        "posterior_median",
        "posterior_high",
    ];
    let rows = found.numbers.iter().map(|NumberReport { slot, prior, posterior, shrunk }| {
        let ends = [prior, posterior].into_iter().flat_map(|of| [of.low, of.median, of.high]);
        let numbers = ends.map(|value| value.to_string());
        [slot.clone(), format!("{shrunk:.3}")].into_iter().chain(numbers).collect()
    });
    std::iter::once(header.map(str::to_owned).to_vec()).chain(rows).collect()
}

/// The numbers that the picture tells most about.
pub(super) fn said(found: &PosteriorReport) -> String {
    let mut told: Vec<&NumberReport> = found.numbers.iter().filter(|one| one.shrunk >= LEAST).collect();
    told.sort_by(|a, b| b.shrunk.total_cmp(&a.shrunk));
    let (shown, all) = (told.len().min(SHOWN), found.numbers.len());
    let head = ["nine in ten from", "to", "before from", "to"];
    let mut rows = vec![std::iter::once(String::new()).chain(head.map(str::to_owned)).collect::<Vec<_>>()];
    for one in &told[..shown] {
        let ends = |of: &Interval| [readable(of.low), readable(of.high)];
        let ends = ends(&one.posterior).into_iter().chain(ends(&one.prior));
        rows.push(std::iter::once(one.slot.clone()).chain(ends).collect());
    }
    let more = match told.len() - shown {
        0 => String::new(),
        more => format!(", {more} more in posterior.csv"),
    };
    let strange = if found.is_familiar {
        String::new()
    } else {
        format!(
            "the picture is unlike those of trees around {}: these intervals cannot be trusted; --from SPECIES learns \
             from trees around another\n",
            found.species
        )
    };
    let table = if told.is_empty() { String::new() } else { output::table(&rows, &[1, 2, 3, 4]) + "\n" };
    format!(
        "\nlearnt from {} trees around {}: the picture tells something about {} of {all} numbers{more}\n{table}{strange}",
        found.trees,
        found.species,
        told.len(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(is_familiar: bool) -> PosteriorReport {
        let number = |slot: &str, shrunk| NumberReport {
            slot: slot.to_owned(),
            prior: Interval { low: 0.25, median: 1.0, high: 12.5 },
            posterior: Interval { low: 0.5, median: 1.0, high: 1.25 },
            shrunk,
        };
        let numbers = vec![number("length[1]", 0.05), number("ratio", 0.7)];
        let species = "quaking_aspen".to_owned();
        let (trees, failures, samples) = (300, 0, Vec::new());
        PosteriorReport { species, trees, failures, familiarity: 0.5, is_familiar, numbers, samples }
    }

    #[test]
    fn what_the_picture_tells_is_said_and_the_rest_is_in_the_file() {
        let text = said(&report(true));
        assert!(text.contains("something about 1 of 2 numbers\n"), "{text}");
        assert!(text.contains("ratio") && !text.contains("length[1]"), "{text}");
        assert!(text.contains("0.500") && text.contains("12.5"), "{text}");
        assert!(!text.contains("cannot be trusted") && said(&report(false)).contains("cannot be trusted"));
        let table = table(&report(true));
        assert_eq!(table[2], ["ratio", "0.700", "0.25", "1", "12.5", "0.5", "1", "1.25"]);
        assert_eq!(readable(0.0), "0");
        assert_eq!(readable(-1234.5), "-1234");
    }
}
