//! Trees with known colours and layers.

use pleach_mesh::Palette;
use pleach_mesh::palette::BarkPattern;
use pleach_plant::{Appearance, Color, Season, Tree};
use pleach_render::preview::{Background, Ground};
use pleach_render::{Preview, PreviewSettings};
use pleach_silhouette::Bitmap;
use pleach_silhouette::mask::Photo;

/// Of each family some that differ in form; palms have green stalks, which are neither.
const SPECIES: [&str; 18] = [
    "acer",
    "black_oak",
    "silver_birch",
    "quaking_aspen",
    "weeping_willow",
    "small_pine",
    "apple",
    "hill_cherry",
    "cambridge_oak",
    "douglas_fir",
    "leafy_elm",
    "leafy_maple",
    "leafy_oak",
    "aspen_falling_profile",
    "grammar_pine",
    "coffey_old_tree",
    "stylised_round",
    "stylised_baobab",
];
const GREENS: [u32; 8] = [0x5c8336, 0x3c5f38, 0x7d9a4d, 0x4a6f2f, 0x6f973c, 0x35523a, 0x82906a, 0x5f8734];
const AUTUMNS: [u32; 6] = [0xd0962c, 0xe3b02e, 0xc8541f, 0xa85a2a, 0xb83a24, 0xd97a1e];
const BARKS: [u32; 8] = [0x6b5c4c, 0x554c43, 0xb9b5a2, 0x77736a, 0x6d4c37, 0x8a7a63, 0x5b4a3c, 0xd9d6cc];
const BLOSSOMS: [u32; 3] = [0xf4e3e6, 0xf6f4ef, 0xeeb4c6];
const SIZE: u32 = 288;
const SKY: Color = Color::from_hex(0x9c_c4_ea);

/// A tree to be drawn.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) seed: u64,
    season: Season,
}

/// A picture of which all is known.
pub(crate) struct Drawn {
    pub(crate) photo: Photo,
    pub(crate) tree: Bitmap,
    pub(crate) wood: Bitmap,
    pub(crate) foliage: Bitmap,
    pub(crate) has_leaves: bool,
    /// What the colours say: summer too where an evergreen stands in winter, or spring has no blossom to be seen.
    pub(crate) season: Season,
    pub(crate) leaf: Color,
    pub(crate) bark: Color,
    pub(crate) blossom: Option<Color>,
    pub(crate) over_sky: bool,
}

pub(crate) fn cases(seeds: u64) -> Vec<Case> {
    let mut cases = Vec::new();
    for name in SPECIES {
        for seed in 0..seeds {
            cases.extend(Season::ALL.map(|season| Case { name: name.to_owned(), seed, season }));
        }
    }
    cases
}

/// A number that is a function of a seed and a purpose.
fn draw(seed: u64, purpose: u64) -> usize {
    let mut x = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ purpose.wrapping_mul(0xD1B5_4A32_D192_ED03);
    x ^= x >> 31;
    x = x.wrapping_mul(0x94D0_49BB_1331_11EB);
    (x >> 33) as usize
}

impl Case {
    /// The tree over transparency and over a sky.
    pub(crate) fn draw(&self) -> Vec<Drawn> {
        let mut species = pleach_generators::preset(&self.name).unwrap();
        let number = self.name.bytes().fold(self.seed, |sum, byte| sum * 31 % 1_000_003 + u64::from(byte));
        let pick =
            |from: &[u32], purpose: u64| Some(Color::from_hex(from[draw(number, purpose) % from.len()]));
        species.appearance = Appearance {
            leaf: pick(&GREENS, 1),
            autumn: pick(&AUTUMNS, 2),
            bark: pick(&BARKS, 3),
            blossom: pick(&BLOSSOMS, 4),
            ..species.appearance
        };
        let mut tree = species.grow(self.seed).unwrap();
        let palette = Palette::new(&species.appearance, Some(self.season));
        palette.apply_season(&mut tree);
        let truth = Palette {
            bark: Color([255, 0, 0]),
            pattern: BarkPattern::Plain,
            leaf: Color([0, 255, 0]),
            blossom: Color([0, 0, 255]),
            ..palette
        };
        let known = picture(&tree, &truth);
        let size = (known.width(), known.height());
        let photo = picture(&tree, &palette);
        let layer = |holds: fn([u8; 4]) -> bool| {
            Bitmap::from_fn(size.0, size.1, |x, y| holds(known.pixels()[(y * size.0 + x) as usize]))
        };
        let mask = layer(|[.., a]| a >= 128);
        let wood = layer(|[r, g, b, a]| a >= 128 && r > g && r > b);
        let foliage = layer(|[r, g, b, a]| a >= 128 && (g >= r || b >= r));
        let petals = layer(|[r, g, b, a]| a >= 128 && b > r && b > g).ink();
        let blossom = (50 * petals > mask.ink()).then_some(palette.blossom);
        let has_leaves = foliage.ink() > 0;
        let is_evergreen = species.appearance.look().evergreen;
        let season = match self.season {
            Season::Spring if blossom.is_some() => Season::Spring,
            Season::Autumn if !is_evergreen && has_leaves => Season::Autumn,
            _ if !has_leaves => Season::Winter,
            _ => Season::Summer,
        };
        [photo.clone(), over_sky(&photo)]
            .map(|photo| Drawn {
                over_sky: photo.pixels()[0][3] == 255,
                photo,
                tree: mask.clone(),
                wood: wood.clone(),
                foliage: foliage.clone(),
                has_leaves,
                season,
                leaf: palette.leaf,
                bark: palette.bark,
                blossom,
            })
            .into()
    }
}

/// The picture before a sky.
fn over_sky(photo: &Photo) -> Photo {
    Photo::from_fn(photo.width(), photo.height(), |x, y| {
        let [r, g, b, a] = photo.pixels()[(y * photo.width() + x) as usize];
        let mix = |tree: u8, sky: u8| {
            let [tree, sky] = [tree, sky].map(|v| f64::from(v) * f64::from(v));
            (sky + (tree - sky) * f64::from(a) / 255.0).sqrt().round() as u8
        };
        [mix(r, SKY.0[0]), mix(g, SKY.0[1]), mix(b, SKY.0[2]), 255]
    })
}

fn picture(tree: &Tree, palette: &Palette) -> Photo {
    let settings = PreviewSettings {
        width: SIZE,
        height: SIZE,
        background: Background::Transparent,
        ground: Ground::None,
        ..PreviewSettings::default()
    };
    let picture = Preview::new(tree, palette, SIZE).picture(&settings);
    Photo::from_fn(SIZE, SIZE, |x, y| {
        let at = 4 * (y * SIZE + x) as usize;
        [picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2], picture.rgba[at + 3]]
    })
}
