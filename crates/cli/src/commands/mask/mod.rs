//! `pleach mask`: from photographs to the silhouettes of the trees in them.

mod many;

use super::advice;
use super::describe::{cannot, means, places};
use super::hints::HintArgs;
use crate::choice::{Choice, one_of};
use crate::segmenter::Segmenter;
use crate::{files, input, output};
use anyhow::{Context, bail, ensure};
use pleach_silhouette::goal::{Goal, GoalWarning};
use pleach_silhouette::mask::{AlphaUse, Background, Mask, MaskOptions, Photo, Segmentation};
use serde::Serialize;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach mask oak.jpg -o oak.png --overlay look.png   and look at what was found
  pleach mask oak.jpg -o oak.png --box 120,40,600,760  the tree in this rectangle
  pleach mask oak.jpg -o oak.png --box 120,40,600,760 --exclude 300,700  but not that
  pleach mask oak.jpg -o oak.png --seed-point 800,420  that tree
  pleach mask shed.jpg -o a.png --background plain    a tree before an even wall
  pleach mask photos/*.jpg -o masks/                  many, with masks/masks.csv
  pleach mask oak.jpg -o oak.png --mask-command 'rembg i {in} {out}'  by another program
  pleach mask oak.jpg -o - | pleach fit - --out oak   from one to the other
  pleach fit oak.jpg --mask auto                      the same in one go

The tree is what differs from the background, and that is what the picture's edges show: a sky, with or \
without a ground below it, or a wall. Where that is doubtful, as before houses and other trees, the tree is \
what has other colours than the edges; what has the tree's own colours is taken for tree. A picture from \
which something was cut out (an alpha channel) is its own mask, and so is one of two tones. A frame, and \
corners that are transparent since a picture was turned, are left out.

Confidence says how likely a mask is a good one, from 0 to 1; look at those below 0.45.

With several photographs, --out is a folder. It gets STEM.png for each, and masks.csv, a row for each, \
the least confident first: where the tree stands, its confidence, and what there is to be said about it. A photograph without a tree is \
named, and the others go on.";

/// Make a silhouette from a photograph, or from many
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct MaskCommand {
    /// The photographs: PNG, JPEG, WebP, TIFF, GIF, BMP or SVG; - for standard input
    #[arg(value_name = "PHOTO", required = true)]
    photos: Vec<PathBuf>,
    /// The mask to write: a PNG of the photograph's size, black tree on white, one bit per pixel; - for
    /// standard output. A folder, such as masks/, for several photographs
    #[arg(short, long, value_name = "FILE|DIR/")]
    out: PathBuf,
    /// Also write the photograph with all but the tree faded, as PNG; another folder for several
    #[arg(long, value_name = "FILE|DIR/")]
    overlay: Option<PathBuf>,
    /// What is behind the tree
    #[arg(long, value_parser = one_of(BACKGROUNDS), default_value = "auto")]
    background: Background,
    /// What an alpha channel is taken for
    #[arg(long, value_parser = one_of(ALPHA), default_value = "auto")]
    alpha: AlphaUse,
    /// A pixel on the tree: column from the left and row from the top, from 0. By default the largest
    /// thing is the tree
    #[arg(long, value_name = "X,Y", value_parser = point)]
    seed_point: Option<(u32, u32)>,
    /// A program that makes the mask, such as 'rembg i {in} {out}': {in} stands for the photograph's file, {out} for
    /// the file that it is to write: the photograph with what is not the tree transparent, or a mask in white on black,
    /// of the photograph's size. Split as by a shell, and run without one
    #[arg(long, value_name = "COMMAND", conflicts_with_all = ["background", "alpha"])]
    mask_command: Option<Segmenter>,
    #[command(flatten)]
    hints: HintArgs,
    /// Fill holes of up to this many pixels; 1 of 100,000 of the picture's by default
    #[arg(long, value_name = "PIXELS")]
    fill_holes: Option<u64>,
    /// Print what was found as JSON, one line for each photograph
    #[arg(long)]
    json: bool,
}

const BACKGROUNDS: &[Choice<Background>] = &[
    ("auto", "Sky, plain and other colours than the edges': the most confident mask", Background::Auto),
    ("sky", "A sky, probably with a ground below it: a faint step at the sides is enough", Background::Sky),
    ("plain", "One smooth background all around", Background::Plain),
];

const ALPHA: &[Choice<AlphaUse>] = &[
    ("auto", "What is opaque is the tree, if the rest is a background", AlphaUse::Auto),
    ("ignore", "Look at the colours of all pixels, transparent ones too", AlphaUse::Ignore),
];

fn point(text: &str) -> Result<(u32, u32), String> {
    text.split_once(',')
        .and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)))
        .ok_or_else(|| "expected X,Y in whole pixels, such as 800,420".to_owned())
}

/// What was found, as JSON.
#[derive(Debug, Serialize)]
struct Found {
    width: u32,
    height: u32,
    ink: f64,
    ground_row: f64,
    axis_column: f64,
    top_row: f64,
    by: &'static str,
    threshold: Option<f64>,
    horizon_rows: Option<[f64; 2]>,
    dropped_pixels: u64,
    filled_pixels: u64,
    touches: Vec<&'static str>,
    confidence: f64,
    warnings: Vec<GoalWarning>,
}

/// A mask, and where its tree stands.
struct Made {
    photo: Photo,
    mask: Mask,
    goal: Goal,
}

impl MaskCommand {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let standard = self.photos.iter().filter(|photo| input::is_standard(photo)).count();
        ensure!(standard < 2, "only one photograph can come from standard input");
        match &self.photos[..] {
            [photo] if !is_folder(&self.out) => self.single(photo),
            photos => many::run(self, photos),
        }
    }

    fn single(&self, photo: &Path) -> anyhow::Result<()> {
        let to_output = input::is_standard(&self.out);
        ensure!(!(to_output && self.json), "the mask and --json would both go to standard output");
        let files = std::iter::once(&self.out).filter(|_| !to_output);
        let outputs: Vec<&Path> = files.chain(&self.overlay).map(|p| &**p).collect();
        for path in &outputs {
            if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("png")) {
                bail!(
                    "{} is not a .png file: pictures are written as PNG; a folder ends in a slash",
                    path.display()
                );
            }
            if same_file(path, photo) {
                bail!("{} is the photograph itself: choose another name", path.display());
            }
        }
        if let [mask, overlay] = outputs[..]
            && mask == overlay
        {
            bail!("mask and overlay would both be {}", mask.display());
        }
        let made = self.make(photo)?;
        if to_output {
            made.mask.bitmap.write_png(&mut std::io::stdout().lock())?;
        } else {
            made.write(&self.out)?;
        }
        if let Some(path) = &self.overlay {
            made.write_overlay(path)?;
        }
        let report = format!("{}\n{}\n{}", means(&made.mask), places(&made.goal), edges(&made.mask));
        if self.json {
            output::json(&made.found())?;
        } else if to_output {
            output::note(report);
        } else {
            output::line(report)?;
        }
        for warning in &made.mask.warnings {
            output::note(format!("warning: {}", advice::warning(warning)));
        }
        for path in outputs {
            output::note(format!("wrote {}", path.display()));
        }
        Ok(())
    }

    /// Reads a photograph and finds the tree in it.
    fn make(&self, photo: &Path) -> anyhow::Result<Made> {
        let options = MaskOptions {
            background: self.background,
            alpha: self.alpha,
            seed_point: self.seed_point,
            fill_holes: self.fill_holes,
            ..MaskOptions::default()
        };
        let encoded = input::picture(photo)?;
        let encoded = match &self.mask_command {
            Some(segmenter) => segmenter.cut_out(&encoded)?,
            None => encoded,
        };
        let picture = Photo::from_encoded(&encoded)?;
        let options = self.hints.hints().over(options, &picture, &encoded.into())?;
        let mask = Mask::from_photo(&picture, &options);
        let mask = mask.map_err(advice::mask_error).with_context(|| cannot(photo))?;
        let goal = Goal::from_bitmap(mask.bitmap.clone()).with_context(|| cannot(photo))?;
        Ok(Made { photo: picture, mask, goal })
    }
}

impl Made {
    fn write(&self, path: &Path) -> anyhow::Result<()> {
        files::write_whole(path, |file| Ok(self.mask.bitmap.write_png(file)?))
    }

    fn write_overlay(&self, path: &Path) -> anyhow::Result<()> {
        let overlay = self.mask.overlay(&self.photo);
        files::write_whole(path, |file| Ok(overlay.write_png(file)?))
    }

    fn found(&self) -> Found {
        let (mask, goal) = (&self.mask, &self.goal);
        let (by, threshold, horizon) = match mask.segmentation {
            Segmentation::Opacity => ("opacity", None, None),
            Segmentation::Colors => ("colours", None, None),
            Segmentation::Cut { .. } => ("cut", None, None),
            Segmentation::TwoTones => ("two-tones", None, None),
            Segmentation::Color { threshold, horizon } => ("colour", Some(threshold), horizon),
        };
        Found {
            width: mask.bitmap.width(),
            height: mask.bitmap.height(),
            ink: mask.bitmap.ink() as f64 / mask.bitmap.area() as f64,
            ground_row: goal.ground_row,
            axis_column: goal.axis_column,
            top_row: goal.top_row,
            by,
            threshold,
            horizon_rows: horizon.map(|h| [h.left, h.right]),
            dropped_pixels: mask.dropped,
            filled_pixels: mask.filled,
            touches: mask.touches.sides(),
            confidence: mask.confidence,
            warnings: mask.warnings.clone(),
        }
    }
}

/// Whether a path is a folder, or is written as one.
fn is_folder(path: &Path) -> bool {
    path.is_dir() || path.as_os_str().as_encoded_bytes().ends_with(b"/")
}

/// Whether both paths lead to one file that is there.
fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

fn edges(mask: &Mask) -> String {
    let edges = match &mask.touches.sides()[..] {
        [] => "the crown is all in the picture".to_owned(),
        sides => format!("the crown touches the frame and is cut off: {}", sides.join(", ")),
    };
    format!("{edges}\nconfidence {:.2} of 1", mask.confidence)
}
