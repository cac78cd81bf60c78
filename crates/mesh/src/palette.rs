//! Colours of a species in a season.

use crate::sink::Material;
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::species::{Appearance, Colour, Season};
use pleach_tree::{Species, Tree};

/// How bark is marked in pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BarkPattern {
    /// Furrows along the stem.
    #[default]
    Furrowed,
    /// Pale, with dark level dashes: birch, aspen, cherry.
    Banded,
    /// Rings at even distances: palms, bamboo.
    Ringed,
    /// Nearly even.
    Smooth,
}

/// The colours that a tree is drawn in, and what it wears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Palette {
    /// Bark of trunks; twigs are a little darker in pictures.
    pub bark: Colour,
    /// How bark is marked.
    pub pattern: BarkPattern,
    /// Leaves, in the season's colour.
    pub leaf: Colour,
    /// Blossoms.
    pub blossom: Colour,
    /// Whether leaves are on the tree.
    pub leaves: bool,
    /// Whether blossoms are on the tree.
    pub blossoms: bool,
}

/// What is known of a species beside its file.
struct Looks {
    bark: u32,
    pattern: BarkPattern,
    leaf: u32,
    autumn: u32,
    blossom: u32,
    evergreen: bool,
}

impl Looks {
    const fn new(bark: u32, pattern: BarkPattern, leaf: u32, autumn: u32) -> Self {
        Self { bark, pattern, leaf, autumn, blossom: 0xf4_e3_e6, evergreen: false }
    }

    const fn evergreen(self) -> Self {
        Self { evergreen: true, ..self }
    }

    const fn blossom(self, blossom: u32) -> Self {
        Self { blossom, ..self }
    }
}

impl Palette {
    /// The palette of `species` in `season`; without one, in the season of its file; without that,
    /// in summer's leaves and with whatever blossom the model gives it.
    #[must_use]
    pub fn of(species: &Species, leaf_shape: LeafShape, season: Option<Season>) -> Self {
        Self::from_parts(&species.name, leaf_shape, &species.appearance, season)
    }

    fn from_parts(name: &str, shape: LeafShape, said: &Appearance, season: Option<Season>) -> Self {
        let looks = looks(name, shape);
        let season = season.or(said.season);
        let or = |said: Option<Colour>, known: u32| said.unwrap_or_else(|| colour(known));
        let summer = or(said.leaf, looks.leaf);
        let leaf = match season {
            Some(Season::Spring) if !looks.evergreen => mix(summer, colour(0xa8_c6_4e), 0.45),
            Some(Season::Autumn) if !looks.evergreen => or(said.autumn, looks.autumn),
            Some(Season::Winter) => mix(summer, colour(0x3d_45_38), 0.25),
            _ => summer,
        };
        Self {
            bark: or(said.bark, looks.bark),
            pattern: looks.pattern,
            leaf,
            blossom: or(said.blossom, looks.blossom),
            leaves: looks.evergreen || season != Some(Season::Winter),
            blossoms: matches!(season, None | Some(Season::Spring)),
        }
    }

    /// Takes off `tree` what it does not wear in this season.
    pub fn dress(&self, tree: &mut Tree) {
        if !self.leaves {
            tree.leaves.clear();
        }
        if !self.blossoms {
            tree.blossoms.clear();
        }
    }

    /// The colour of a material.
    #[must_use]
    pub const fn colour(&self, material: Material) -> Colour {
        match material {
            Material::Bark => self.bark,
            Material::Leaf => self.leaf,
            Material::Blossom => self.blossom,
            Material::Card => Colour([255; 3]),
        }
    }
}

/// A colour as intensities of light, 0 to 1 (IEC 61966-2-1).
#[must_use]
pub fn linear(Colour(channels): Colour) -> [f32; 3] {
    channels.map(|c| {
        let c = f32::from(c) / 255.0;
        if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

const fn colour(hex: u32) -> Colour {
    Colour([(hex >> 16) as u8, (hex >> 8) as u8, hex as u8])
}

/// `a` with the part `t` of `b`, channel by channel.
fn mix(Colour(a): Colour, Colour(b): Colour, t: f32) -> Colour {
    let channel = |i: usize| (f32::from(a[i]) * (1.0 - t) + f32::from(b[i]) * t).round() as u8;
    Colour([channel(0), channel(1), channel(2)])
}

/// Chosen by eye from photographs of each species; unknown ones by their leaves.
fn looks(name: &str, shape: LeafShape) -> Looks {
    use BarkPattern::{Banded, Furrowed, Ringed, Smooth};
    match name {
        "quaking_aspen" => Looks::new(0xb9_b5_a2, Banded, 0x6f_97_3c, 0xe3_b0_2e),
        "weeping_willow" | "weeping_willow_o" => Looks::new(0x6e_61_4e, Furrowed, 0x7f_9a_45, 0xcf_b2_45),
        "bamboo" => Looks::new(0x86_9a_45, Ringed, 0x6d_94_3a, 0xc2_b0_55).evergreen(),
        "palm" => Looks::new(0x8d_7b_62, Ringed, 0x5c_86_35, 0x5c_86_35).evergreen(),
        "fan_palm" => Looks::new(0x7e_6c_55, Ringed, 0x66_8a_45, 0x66_8a_45).evergreen(),
        "lombardy_poplar" => Looks::new(0x78_6c_58, Furrowed, 0x5d_85_36, 0xdb_b6_33),
        "small_pine" => Looks::new(0x7a_56_40, Furrowed, 0x45_68_38, 0x45_68_38).evergreen(),
        "acer" => Looks::new(0x71_65_57, Smooth, 0x5f_87_34, 0xc8_54_1f),
        "silver_birch" => Looks::new(0xd9_d6_cc, Banded, 0x74_97_41, 0xe0_b8_38),
        "douglas_fir" => Looks::new(0x63_4f_3f, Furrowed, 0x3c_5f_38, 0x3c_5f_38).evergreen(),
        "balsam_fir" => Looks::new(0x6d_65_5b, Smooth, 0x3a_5d_3f, 0x3a_5d_3f).evergreen(),
        "european_larch" => Looks::new(0x76_5d_4b, Furrowed, 0x78_96_48, 0xd6_9b_2d),
        "apple" => Looks::new(0x6f_60_50, Smooth, 0x64_8a_3b, 0xc9_a0_36).blossom(0xf7_e9_ec),
        "hill_cherry" => Looks::new(0x6b_50_46, Banded, 0x76_8f_46, 0xc7_5a_2a).blossom(0xf3_c9_d6),
        "black_tupelo" => Looks::new(0x5b_52_4a, Furrowed, 0x52_7b_33, 0xb3_33_22),
        "black_oak" => Looks::new(0x55_4c_43, Furrowed, 0x50_77_31, 0xa8_5a_2a),
        "cambridge_oak" => Looks::new(0x66_5a_4a, Furrowed, 0x58_7c_33, 0xb3_7a_30),
        "sassafras" => Looks::new(0x72_5a_45, Furrowed, 0x66_8b_38, 0xd8_7a_28),
        _ if shape == LeafShape::Linear => Looks::new(0x6d_57_46, Furrowed, 0x4b_6e_3a, 0xc2_9a_3a),
        _ => Looks::new(0x6b_5c_4c, Furrowed, 0x5c_83_36, 0xd0_96_2c),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn palette(name: &str, season: Option<Season>) -> Palette {
        Palette::of(&pleach_generators::preset(name).unwrap(), LeafShape::Elliptic, season)
    }

    #[test]
    fn winter_is_bare_but_for_evergreens() {
        assert!(!palette("quaking_aspen", Some(Season::Winter)).leaves);
        assert!(palette("small_pine", Some(Season::Winter)).leaves);
        assert!(palette("quaking_aspen", None).leaves);
    }

    #[test]
    fn seasons_change_leaves_and_files_have_the_last_word() {
        let [summer, autumn] = [None, Some(Season::Autumn)].map(|s| palette("acer", s).leaf);
        assert_ne!(summer, autumn);
        let red = Colour([255, 0, 0]);
        let said = Appearance { autumn: Some(red), season: Some(Season::Autumn), ..Appearance::default() };
        assert_eq!(Palette::from_parts("acer", LeafShape::Maple, &said, None).leaf, red);
        let spring = Palette::from_parts("acer", LeafShape::Maple, &said, Some(Season::Spring));
        assert_ne!(spring.leaf, red, "an argument wins over the file");
    }

    #[test]
    fn middle_grey_is_a_fifth_of_the_light() {
        assert!((linear(colour(0x80_80_80))[0] - 0.216).abs() < 1e-3);
        assert_eq!(linear(colour(0xff_ff_ff)), [1.0; 3]);
    }
}
