//! The areas of input that are spoilt, and their sound results.

mod checkpoints;
mod experiments;
mod grammars;
mod parameters;
mod pictures;
mod species;

pub(super) use checkpoints::Checkpoints;
pub(super) use experiments::Experiments;
pub(super) use grammars::Grammars;
pub(super) use parameters::Parameters;
pub(super) use pictures::Pictures;
pub(super) use species::SpeciesFiles;

use super::verdict::Verdict;
use pleach_fit::Stream;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Growth, Limits, Parts, Species};
use std::path::Path;

/// Input of one sort.
pub(super) trait Area: Send + Sync {
    /// Its name in the results.
    fn name(&self) -> &'static str;

    /// The spoilt input of a case.
    fn input(&self, case: u64) -> Vec<u8>;

    /// Runs the program's code on the input; files may be written into `folder`.
    fn judge(&self, case: u64, folder: &Path) -> Verdict;
}

/// The draws of a case; each area has a lane of its own.
fn draws(lane: u32, case: u64) -> Stream {
    const SEED: u64 = 1;
    Stream::at(SEED, 0x7262_0000 + lane, case, 0)
}

/// Bounds of all trees: what is asked is whether they hold, not how large they may be.
const LIMITS: Limits = Limits { stems: 1_000, leaves: 5_000, knots: 15_000, work: 1_000_000 };

/// Longest message that a person reads.
const MAX_MESSAGE_CHARS: usize = 2_000;

/// A refusal, if its message is one that helps: short, without control characters, and with line and
/// column if it is about text.
fn refused(message: String, has_place: bool) -> Verdict {
    let is_control = |c: char| c.is_control() && c != '\n';
    let is_bidi = |c: char| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let unclear = message.trim().is_empty()
        || message.len() > MAX_MESSAGE_CHARS
        || message.contains(|c| is_control(c) || is_bidi(c))
        || (has_place && !names_a_place(&message));
    if unclear { Verdict::Unclear(message) } else { Verdict::Refused }
}

/// Whether a message has `:LINE:COLUMN:` in it.
fn names_a_place(message: &str) -> bool {
    let is_number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    let parts: Vec<&str> = message.split(':').collect();
    parts.windows(3).any(|three| is_number(three[1]) && is_number(three[2]))
}

/// Grows a tree within [`LIMITS`], on one thread and on many, draws it, and looks whether all is sound.
fn grown(species: &Species, seed: u64) -> Verdict {
    let growth = Growth { limits: LIMITS, ..Growth::seed(seed) };
    let serial = species.grow_with(&growth);
    // Growing twice takes twice as long: one case in four does.
    let parallel = match seed % 4 {
        0 => species.grow_with(&Growth { parallel: true, ..growth }),
        _ => serial.clone(),
    };
    let tree = match (serial, parallel) {
        (Ok(one), Ok(other)) if one == other => one,
        (Err(one), Err(other)) if one == other => return refused(one.to_string(), false),
        (Err(one), Err(other)) => return Verdict::Wrong(format!("`{one}` on one thread, `{other}` on many")),
        _ => return Verdict::Wrong("another tree on one thread than on many".to_owned()),
    };
    if let Err(what) = tree.well_formed() {
        return Verdict::Wrong(what.to_string());
    }
    if tree.stems.len() > LIMITS.stems
        || tree.knots.len() > LIMITS.knots
        || tree.leaves.len() + tree.blossoms.len() > LIMITS.leaves
    {
        return Verdict::Wrong("more than the limits allow".to_owned());
    }
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
    if !(frame.meters_per_pixel.is_finite() && frame.meters_per_pixel > 0.0) {
        return Verdict::Wrong(format!("{} metres to a pixel", frame.meters_per_pixel));
    }
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut bitmap);
    Verdict::Accepted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_judged() {
        assert_eq!(refused("a.toml:3:14: `x` is 3".to_owned(), true), Verdict::Refused);
        for bad in ["", "stream did not contain", "a:3: b", "a:3:4: \u{1b}[31m", "a:3:4: \u{202e}"] {
            assert!(matches!(refused(bad.to_owned(), true), Verdict::Unclear(_)), "{bad:?}");
        }
        assert!(matches!(refused("x".repeat(MAX_MESSAGE_CHARS + 1), false), Verdict::Unclear(_)));
        assert_eq!(refused("plain words".to_owned(), false), Verdict::Refused);
    }
}
