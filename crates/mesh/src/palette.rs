//! Colours of a species in a season.

use crate::part::Material;
pub use pleach_plant::BarkPattern;
use pleach_plant::math;
use pleach_plant::{Appearance, Color, Look, Season, Tree};
use std::borrow::Cow;

/// The colours that a tree is drawn in, and what it wears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Palette {
    /// Bark of trunks; twigs are a little darker in pictures.
    pub bark: Color,
    /// How bark is marked.
    pub pattern: BarkPattern,
    /// Leaves, in the season's colour.
    pub leaf: Color,
    /// Blossoms.
    pub blossom: Color,
    /// Whether leaves are on the tree.
    pub leaves: bool,
    /// Whether blossoms are on the tree.
    pub blossoms: bool,
}

impl Palette {
    /// The palette of a species of this `appearance` in `season`; without one, in the season that it says; without
    /// that, in summer's leaves and with whatever blossom the model gives it.
    #[must_use]
    pub fn new(appearance: &Appearance, season: Option<Season>) -> Self {
        Self::in_season(&appearance.look(), season)
    }

    fn in_season(look: &Look, season: Option<Season>) -> Self {
        let season = season.or(look.season);
        let leaf = match season {
            Some(Season::Spring) if !look.evergreen => mix(look.leaf, YOUNG_LEAF, 0.45),
            Some(Season::Autumn) => look.autumn,
            Some(Season::Winter) => mix(look.leaf, WINTER_SHADE, 0.25),
            _ => look.leaf,
        };
        Self {
            bark: look.bark,
            pattern: look.bark_pattern,
            leaf,
            blossom: look.blossom,
            leaves: look.evergreen || season != Some(Season::Winter),
            blossoms: matches!(season, None | Some(Season::Spring)),
        }
    }

    /// Takes off `tree` what it does not wear in this season.
    pub fn apply_season(&self, tree: &mut Tree) {
        if !self.leaves {
            tree.leaves.clear();
            tree.blobs.clear();
            tree.blob_vertices.clear();
            tree.blob_triangles.clear();
        }
        if !self.blossoms {
            tree.blossoms.clear();
        }
    }

    /// `tree` as it is in this season; itself where there is nothing to take off.
    #[must_use]
    pub fn dressed<'a>(&self, tree: &'a Tree) -> Cow<'a, Tree> {
        let wears_leaves = !tree.leaves.is_empty() || !tree.blobs.is_empty();
        if (self.leaves || !wears_leaves) && (self.blossoms || tree.blossoms.is_empty()) {
            return Cow::Borrowed(tree);
        }
        let mut dressed = tree.clone();
        self.apply_season(&mut dressed);
        Cow::Owned(dressed)
    }

    /// The colour of a material.
    #[must_use]
    pub const fn color(&self, material: Material) -> Color {
        match material {
            Material::Bark => self.bark,
            Material::Leaf | Material::Twig => self.leaf,
            Material::Blossom => self.blossom,
            Material::Card => Color([255; 3]),
            Material::Collision => Color([128; 3]),
        }
    }
}

/// A colour as intensities of light, 0 to 1 (IEC 61966-2-1).
#[must_use]
pub fn linear(Color(channels): Color) -> [f32; 3] {
    channels.map(|c| {
        let c = f32::from(c) / 255.0;
        if c <= 0.040_45 { c / 12.92 } else { math::powf((c + 0.055) / 1.055, 2.4) }
    })
}

/// What spring's leaves are mixed with.
const YOUNG_LEAF: Color = Color::from_hex(0xa8_c6_4e);
/// What evergreens are mixed with in winter.
const WINTER_SHADE: Color = Color::from_hex(0x3d_45_38);

/// `a` with the part `t` of `b`, channel by channel.
fn mix(Color(a): Color, Color(b): Color, t: f32) -> Color {
    let channel = |i: usize| (f32::from(a[i]) * (1.0 - t) + f32::from(b[i]) * t).round() as u8;
    Color([channel(0), channel(1), channel(2)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn palette(name: &str, season: Option<Season>) -> Palette {
        Palette::new(&pleach_generators::preset(name).unwrap().appearance, season)
    }

    #[test]
    fn winter_is_bare_but_for_evergreens() {
        assert!(!palette("quaking_aspen", Some(Season::Winter)).leaves);
        assert!(palette("small_pine", Some(Season::Winter)).leaves);
        assert!(palette("quaking_aspen", None).leaves);
    }

    #[test]
    fn seasons_change_leaves_and_arguments_have_the_last_word() {
        let [summer, autumn] = [None, Some(Season::Autumn)].map(|s| palette("acer", s).leaf);
        assert_ne!(summer, autumn);
        let mut species = pleach_generators::preset("acer").unwrap();
        let red = Color([255, 0, 0]);
        species.appearance.autumn = Some(red);
        species.appearance.season = Some(Season::Autumn);
        assert_eq!(Palette::new(&species.appearance, None).leaf, red);
        assert_ne!(
            Palette::new(&species.appearance, Some(Season::Spring)).leaf,
            red,
            "an argument wins over the file"
        );
        species.appearance.evergreen = Some(true);
        assert_eq!(Palette::new(&species.appearance, None).leaf, summer, "an evergreen does not turn");
    }

    #[test]
    fn every_species_says_its_colours() {
        assert_eq!(Palette::new(&Appearance::default(), None), Palette::in_season(&Look::PLAIN, None));
        for name in pleach_generators::names() {
            let species = pleach_generators::preset(name).unwrap();
            assert!(species.appearance.bark.is_some() && species.appearance.bark_pattern.is_some(), "{name}");
            assert!(species.appearance.leaf.is_some(), "{name}");
        }
        let birch = palette("silver_birch", None);
        assert_eq!((birch.bark, birch.pattern), (Color::from_hex(0xd9_d6_cc), BarkPattern::Banded));
    }

    #[test]
    fn middle_grey_is_a_fifth_of_the_light() {
        assert!((linear(Color([0x80; 3]))[0] - 0.216).abs() < 1e-3);
        assert_eq!(linear(Color([0xff; 3])), [1.0; 3]);
    }
}
