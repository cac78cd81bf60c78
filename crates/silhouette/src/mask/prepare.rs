//! What is known without a look at the background: opacity, and what is not part of the picture.

use super::confidence::{FIRM_OPACITY, LOOSE_OPACITY};
use super::photo::Photo;
use super::score::Foreground;
use super::{AlphaUse, Segmentation};
use crate::bitmap::Bitmap;
use crate::goal::GoalWarning;
use crate::goal::alpha::{self, Alpha, OPAQUE};
use crate::goal::border;
use crate::goal::ink::{self, MIN_ALPHA_RANGE, Polarity};
use crate::goal::read::Tones;
use std::borrow::Cow;

/// A picture as a tree is looked for in it.
pub(super) struct Prepared<'a> {
    /// The picture, with the nearest colours where there is none of it.
    pub(super) photo: Cow<'a, Photo>,
    /// The pixels that are of the picture; all if there is none.
    pub(super) inside: Option<Bitmap>,
    /// The tree, where the picture itself marks it.
    pub(super) foreground: Option<Foreground>,
    pub(super) warnings: Vec<GoalWarning>,
}

impl<'a> Prepared<'a> {
    pub(super) fn new(photo: &'a Photo, use_of_alpha: AlphaUse) -> Self {
        let mut prepared =
            Self { photo: Cow::Borrowed(photo), inside: None, foreground: None, warnings: Vec::new() };
        let (least, most) = photo.opacities();
        if most.saturating_sub(least) >= MIN_ALPHA_RANGE {
            prepared.look_at_alpha(photo, use_of_alpha);
        }
        if prepared.foreground.is_none() {
            prepared.leave_out_frame();
            prepared.foreground = two_tones(&prepared.photo);
        }
        prepared
    }

    fn look_at_alpha(&mut self, photo: &Photo, use_of_alpha: AlphaUse) {
        let (width, height) = (photo.width(), photo.height());
        let beyond = |least: u8| Bitmap::from_fn(width, height, |x, y| photo.opacity(x, y) >= least);
        let below = |most: u8| Bitmap::from_fn(width, height, |x, y| photo.opacity(x, y) < most);
        let given = |ink, firm, loose| Foreground::given(Segmentation::Opacity, ink, firm, loose);
        let opaque = beyond(OPAQUE);
        match (alpha::role(&opaque, |x, y| photo.light(x, y)), use_of_alpha) {
            (Alpha::Picture, _) => {
                self.warnings.push(GoalWarning::AlphaIgnored {
                    transparent: 1.0 - opaque.ink() as f64 / opaque.area() as f64,
                });
                let certain = alpha::certain(width, height, |x, y| photo.opacity(x, y));
                self.photo = Cow::Owned(photo.extended(&certain));
                self.inside = Some(certain);
            }
            (Alpha::Tree | Alpha::Around, AlphaUse::Ignore) => {
                self.photo = Cow::Owned(photo.clone().opaque());
            }
            (Alpha::Tree, AlphaUse::Auto) => {
                self.foreground = Some(given(opaque, beyond(FIRM_OPACITY), beyond(LOOSE_OPACITY)));
            }
            (Alpha::Around, AlphaUse::Auto) => {
                self.warnings.push(GoalWarning::TransparentTree);
                self.foreground = Some(given(below(OPAQUE), below(LOOSE_OPACITY), below(FIRM_OPACITY)));
            }
        }
    }

    fn leave_out_frame(&mut self) {
        let photo = &self.photo;
        let (width, height) = (photo.width(), photo.height());
        let light: Vec<u8> = places(width, height).map(|(x, y)| photo.light(x, y)).collect();
        let Some(frame) = border::frame(&light, width, height) else { return };
        let picture = frame.inside(width, height);
        self.photo = Cow::Owned(photo.extended(&picture));
        self.inside = Some(match self.inside.take() {
            Some(other) => border::within(&other, &picture),
            None => picture,
        });
        self.warnings.push(GoalWarning::Frame(frame));
    }
}

fn places(width: u32, height: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

/// The tree in a picture of two greys, which is a mask already, however near to each other they are.
fn two_tones(photo: &Photo) -> Option<Foreground> {
    let mut seen: Vec<[u8; 3]> = Vec::new();
    for &[r, g, b, _] in photo.pixels() {
        if !seen.contains(&[r, g, b]) {
            if seen.len() == 2 || r != g || g != b {
                return None;
            }
            seen.push([r, g, b]);
        }
    }
    let (width, height) = (photo.width(), photo.height());
    let light: Vec<u8> = photo.pixels().iter().map(|pixel| pixel[0]).collect();
    let opacity = vec![255; light.len()];
    let mut tones = Tones { width, height, light, opacity, colors: Vec::new(), stride: 1, several: false };
    // Of one tone, there is no tree.
    let reading = (seen.len() == 2).then(|| ink::ink_of(&mut tones, Polarity::Auto).ok()).flatten()?;
    let ink = reading.ink;
    Some(Foreground::given(Segmentation::TwoTones, ink.clone(), ink.clone(), ink))
}
