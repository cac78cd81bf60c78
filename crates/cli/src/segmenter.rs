//! Another program's segmenter: a command that reads a photograph and writes a mask or a cut-out of it.

use crate::other_program::{self, last_of};
use anyhow::{Context, bail, ensure};
use pleach_silhouette::goal::Encoded;
use pleach_silhouette::mask::Photo;
use std::path::{Path, PathBuf};
use std::process::ExitStatus;
use std::str::FromStr;
use std::time::Duration;

/// What stands for the photograph's file in a command, and what for the file that it is to write.
const PLACES: [&str; 2] = ["{in}", "{out}"];

/// The first run of a segmenter may fetch its weights, which are hundreds of megabytes.
const MAX_TIME: Duration = Duration::from_secs(600);

/// A command such as `rembg i {in} {out}`: split into words as a shell would split them, and run without a shell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Segmenter {
    /// As it was given.
    text: String,
    /// The program and its arguments.
    words: Vec<String>,
}

impl FromStr for Segmenter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words = shell_words::split(text).map_err(|_| "a quotation mark is missing".to_owned())?;
        for place in PLACES {
            if !words.iter().skip(1).any(|word| word.contains(place)) {
                return Err(format!(
                    "{place} is missing: expected a program and its arguments, such as 'rembg i {{in}} {{out}}'"
                ));
            }
        }
        Ok(Self { text: text.to_owned(), words })
    }
}

impl Segmenter {
    /// The command as it was given.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// Runs the command. Returns the photograph with what is not the tree transparent, as PNG.
    ///
    /// # Errors
    /// The command cannot be run, fails, takes longer than ten minutes, or writes no picture of the photograph's size
    /// that is a mask or a cut-out.
    pub(crate) fn cut_out(&self, photo: &Encoded) -> anyhow::Result<Encoded> {
        self.cut_out_within(photo, MAX_TIME)
    }

    fn cut_out_within(&self, photo: &Encoded, time: Duration) -> anyhow::Result<Encoded> {
        let said = || format!("--mask-command `{}`", self.text);
        let folder = tempfile::tempdir().context("no temporary folder")?;
        let place = |name: &str| folder.path().join(name);
        // A copy: it may come from standard input, and a name may begin with a hyphen.
        let is_png = photo.bytes().starts_with(b"\x89PNG");
        let ending = photo.name().extension().and_then(|e| e.to_str()).filter(|_| !is_png).unwrap_or("png");
        let [input, output, log] = [place(&format!("photo.{ending}")), place("mask.png"), place("log.txt")];
        std::fs::write(&input, photo.bytes()).with_context(|| format!("cannot write {}", input.display()))?;
        let status = self.run(&input, &output, &log, time).with_context(said)?;
        if !status.success() {
            bail!("{} failed: {status}{}", said(), last_of(&log));
        }
        ensure!(output.is_file(), "{} wrote no file in the place of {{out}}{}", said(), last_of(&log));
        let name = photo.name();
        (|| cut_out(&Photo::from_encoded(photo)?, &Photo::load(&output)?, name))().with_context(said)
    }

    /// Runs the command to its end.
    fn run(&self, input: &Path, output: &Path, log: &Path, time: Duration) -> anyhow::Result<ExitStatus> {
        let words = self.words.iter().map(|word| {
            let [photo, mask] = PLACES;
            word.replace(photo, &input.to_string_lossy()).replace(mask, &output.to_string_lossy())
        });
        other_program::run(&words.collect::<Vec<_>>(), log, time)
    }
}

/// The photograph, transparent where `answer` is: where it has no opacity, or, if it is opaque all over and has no
/// colours, where it is dark.
fn cut_out(photo: &Photo, answer: &Photo, name: &Path) -> anyhow::Result<Encoded> {
    let (width, height) = (photo.width(), photo.height());
    ensure!(
        (answer.width(), answer.height()) == (width, height),
        "it wrote {} × {} pixels, and the photograph has {width} × {height}",
        answer.width(),
        answer.height()
    );
    let pixels = answer.pixels();
    let has_opacity = pixels.iter().any(|pixel| pixel[3] < 255);
    let is_gray = || pixels.iter().all(|[r, g, b, _]| r == g && g == b);
    ensure!(
        has_opacity || is_gray(),
        "it wrote a picture in colours without transparent pixels: expected a cut-out, or a mask in white on black"
    );
    let cut = |(&[r, g, b, _], mask): (&[u8; 4], &[u8; 4])| {
        [r, g, b, if has_opacity { mask[3] } else { 255 * (mask[0] / 128) }]
    };
    let bytes: Vec<u8> = photo.pixels().iter().zip(pixels).flat_map(cut).collect();
    let picture =
        image::RgbaImage::from_raw(width, height, bytes).context("a picture has all of its pixels")?;
    let mut png = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut png, image::ImageFormat::Png)?;
    Ok(Encoded::new(PathBuf::from(name), png.into_inner()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn commands_are_split_as_a_shell_would() {
        let command: Segmenter = "seg --model 'a b' \"{in}\" -o {out}".parse().unwrap();
        assert_eq!(command.words, ["seg", "--model", "a b", "{in}", "-o", "{out}"]);
        for (wrong, why) in
            [("rembg i {in}", "{out}"), ("{in} {out}", "{in}"), ("", "{in}"), ("a 'b", "quotation")]
        {
            let error = wrong.parse::<Segmenter>().unwrap_err();
            assert!(error.contains(why), "{wrong}: {error}");
        }
    }

    #[test]
    fn a_mask_and_a_cut_out_say_the_same() {
        let tree = |x: u32| x < 20;
        let photo = Photo::from_fn(40, 20, |x, y| [x as u8, y as u8, 9, 255]);
        let mask =
            Photo::from_fn(40, 20, |x, _| if tree(x) { [200, 200, 200, 255] } else { [30, 30, 30, 255] });
        let cut = Photo::from_fn(40, 20, |x, _| [0, 0, 0, if tree(x) { 255 } else { 0 }]);
        let of = |answer: &Photo| cut_out(&photo, answer, "p.png".as_ref()).unwrap();
        assert_eq!(of(&mask).bytes(), of(&cut).bytes());
        let read = Photo::from_encoded(&of(&cut)).unwrap();
        assert_eq!((read.pixels()[3], read.pixels()[30][3]), ([3, 0, 9, 255], 0));
        // Neither a mask nor a cut-out, and of another size.
        assert!(cut_out(&photo, &photo, "p.png".as_ref()).unwrap_err().to_string().contains("colours"));
        let small = Photo::from_fn(20, 20, |_, _| [0; 4]);
        assert!(cut_out(&photo, &small, "p.png".as_ref()).unwrap_err().to_string().contains("40 × 20"));
    }

    #[test]
    #[cfg(unix)]
    fn a_command_that_hangs_is_stopped() {
        let photo = Encoded::new("p.png", vec![0; 8]);
        let command: Segmenter = "sh -c 'sleep 60' {in} {out}".parse().unwrap();
        let started = Instant::now();
        let error = command.cut_out_within(&photo, Duration::from_millis(50)).unwrap_err();
        assert!(format!("{error:#}").contains("had not ended"), "{error:#}");
        assert!(started.elapsed() < Duration::from_secs(30));
    }
}
