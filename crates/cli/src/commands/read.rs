//! `pleach read`: what is in a picture of a tree.

use super::advice;
use super::corrections::CorrectionArgs;
use super::fit::flags;
use super::fit::values::TONES;
use super::hints::HintArgs;
use crate::choice::one_of;
use crate::segmenter::Segmenter;
use crate::{files, input, output};
use pleach::{Colors, FitOptions, FitSource, GoalReading, MaskFrom, PictureReading, Tone, read_picture};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  pleach read goal.png  a table of what is in the picture
  pleach read oak.jpg --box 120,40,600,760 -o oak/  and look at oak/reading.png
  pleach read oak.jpg --mask-command 'rembg i {in} {out}' --json  for a script
  pleach read oak.png --wood limbs.png  with what of it is wood
  pleach read oak.png --trunks 1 --lean -8  what a person sees better

What is in a picture of a tree: its feet (where trunks meet the ground), how far the trunk leans, up to what height it \
is bare, where it forks, the outline of the crown, gaps, twigs, and whether there are leaves; of a picture in colour \
also its colours and the season. Each has a confidence from 0 to 1: of feet, widths, leans and bare heights at 0.9 \
about nine in ten were right on trees that pleach drew. Lengths are in heights of the tree.

What looks like a photograph is masked first, as by `pleach mask`; --box, --include and --exclude show the tree in it.

With --out, the folder gets reading.json, reading.png (the measures drawn over the tree) and, of a photograph, \
mask.png. A fit reads its goal in the same way, and takes the same corrections.";

/// Say what is in a picture of a tree
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Read {
    /// The picture: PNG, JPEG, WebP, TIFF, GIF, BMP or SVG; - for standard input
    #[arg(value_name = "PICTURE")]
    picture: PathBuf,
    /// The folder for reading.json, reading.png and mask.png
    #[arg(short, long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// A picture of the same size, or shape, that says what is tree: white on black. With `auto` the picture is a
    /// photograph; by default that is decided by its tones
    #[arg(long, value_name = "FILE|auto")]
    mask: Option<MaskFrom>,
    /// A program that makes the mask of a photograph, as in `pleach mask`
    #[arg(long, value_name = "COMMAND", conflicts_with = "mask")]
    mask_command: Option<Segmenter>,
    #[command(flatten)]
    hints: HintArgs,
    /// A picture of the same size that says what of the tree is wood, trunk and branches: black on white
    #[arg(long, value_name = "FILE")]
    wood: Option<String>,
    #[command(flatten)]
    corrections: CorrectionArgs,
    /// Which of the two tones is the tree
    #[arg(long, default_value = "auto", value_parser = one_of(TONES))]
    tree: Tone,
    /// Print the measures as JSON
    #[arg(long)]
    json: bool,
}

impl Read {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let read = self.read()?;
        if self.json {
            output::json(&read.found)?;
        } else {
            output::line(table(&read.found))?;
        }
        for warning in &read.found.warnings {
            output::note(format!("warning: {}", advice::warning(warning)));
        }
        self.write(&read)
    }

    fn read(&self) -> anyhow::Result<PictureReading> {
        let picture = input::picture(&self.picture)?;
        let (picture, mask) = match &self.mask_command {
            Some(segmenter) => (segmenter.cut_out(&picture)?, Some(MaskFrom::Auto)),
            None => (picture, self.mask.clone()),
        };
        let hints = self.hints.hints();
        let reading = self.corrections.corrections()?;
        let wood = self.wood.clone();
        let options = FitOptions { mask, hints, wood, reading, tree: self.tree, ..FitOptions::default() };
        let source = FitSource { pictures: input::converted_pictures(&options)?, ..picture.into() };
        read_picture(source, &options).map_err(flags::named)
    }

    /// Writes the files of `--out`.
    fn write(&self, read: &PictureReading) -> anyhow::Result<()> {
        let Some(folder) = &self.out else { return Ok(()) };
        files::make_folder(folder)?;
        let (json, drawn, mask) =
            (folder.join("reading.json"), folder.join("reading.png"), folder.join("mask.png"));
        files::write_text(&json, &(serde_json::to_string_pretty(&read.found)? + "\n"))?;
        files::write_whole(&drawn, |file| Ok(read.annotated().write_png(file)?))?;
        let mut written = vec![json, drawn];
        if let Some(made) = &read.mask {
            files::write_whole(&mask, |file| Ok(made.bitmap.write_png(file)?))?;
            written.push(mask);
        }
        for path in written {
            output::note(format!("wrote {}", path.display()));
        }
        Ok(())
    }
}

/// The measures in plain words, a line each, with their confidences.
fn table(found: &GoalReading) -> String {
    let head = ["", "in the picture", "confidence"].map(str::to_owned).to_vec();
    let line = |(name, value, confidence): (&str, String, f64)| {
        vec![name.to_owned(), value, format!("{confidence:.2}")]
    };
    let colors = found.colors.iter().flat_map(Colors::table);
    let lines = found.measures.table().into_iter().chain(colors).map(line);
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(lines).collect();
    let mask = found.mask_confidence.map_or_else(String::new, |confidence| {
        format!("\n\nthe tree was found in a photograph, confidence {confidence:.2} of 1")
    });
    format!("{}{mask}", output::table(&rows, &[2]).trim_end())
}
