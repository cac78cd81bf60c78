//! Colour pictures of trees whose layers and colours are known.

use super::trees::{Case, draw};
use pleach_mesh::Palette;
use pleach_mesh::palette::BarkPattern;
use pleach_render::preview::{Background, Ground};
use pleach_render::{Preview, PreviewSettings};
use pleach_silhouette::Bitmap;
use pleach_silhouette::mask::Photo;
use pleach_tree::{Appearance, Color, Parts, Season, Tree};

const GREENS: [u32; 8] = [0x5c8336, 0x3c5f38, 0x7d9a4d, 0x4a6f2f, 0x6f973c, 0x35523a, 0x82906a, 0x5f8734];
const AUTUMNS: [u32; 6] = [0xd0962c, 0xe3b02e, 0xc8541f, 0xa85a2a, 0xb83a24, 0xd97a1e];
const BARKS: [u32; 8] = [0x6b5c4c, 0x554c43, 0xb9b5a2, 0x77736a, 0x6d4c37, 0x8a7a63, 0x5b4a3c, 0xd9d6cc];
const BLOSSOMS: [u32; 3] = [0xf4e3e6, 0xf6f4ef, 0xeeb4c6];
/// Side of a picture in pixels.
const SIZE: u32 = 288;

/// A picture of which all is known.
pub(super) struct Drawn {
    pub(super) photo: Photo,
    pub(super) tree: Bitmap,
    pub(super) wood: Bitmap,
    pub(super) foliage: Bitmap,
    /// What the colours say: summer too where an evergreen stands in winter, or spring has no blossom to be seen.
    pub(super) season: Season,
    pub(super) leaf: Color,
    pub(super) bark: Color,
}

impl Drawn {
    /// `tree`, that of `case`, in a season and in colours that follow from its seed.
    pub(super) fn new(case: &Case, mut tree: Tree) -> Option<Self> {
        let species = pleach_generators::preset(&case.name)?;
        let key = case.name.bytes().fold(case.seed, |sum, byte| sum * 31 % 1_000_003 + u64::from(byte));
        let pick = |from: &[u32], purpose: u64| {
            let number = (draw(key, purpose) * from.len() as f64) as usize;
            from.get(number).copied().map(Color::from_hex)
        };
        let appearance = Appearance {
            leaf: pick(&GREENS, 41),
            autumn: pick(&AUTUMNS, 42),
            bark: pick(&BARKS, 43),
            blossom: pick(&BLOSSOMS, 44),
            ..species.appearance
        };
        let is_leafy = case.parts == Parts::LEAFY;
        let seasons = if is_leafy { &Season::ALL[..3] } else { &Season::ALL[3..] };
        let season = seasons[(draw(key, 45) * seasons.len() as f64) as usize];
        let palette = Palette::new(&appearance, Some(season));
        palette.apply_season(&mut tree);
        let truth = Palette {
            bark: Color([255, 0, 0]),
            pattern: BarkPattern::Plain,
            leaf: Color([0, 255, 0]),
            blossom: Color([0, 0, 255]),
            ..palette
        };
        let (known, photo) = (picture(&tree, &truth), picture(&tree, &palette));
        let layer = |holds: fn([u8; 4]) -> bool| {
            Bitmap::from_fn(SIZE, SIZE, |x, y| holds(known.pixels()[(y * SIZE + x) as usize]))
        };
        let mask = layer(|[.., a]| a >= 128);
        let wood = layer(|[r, g, b, a]| a >= 128 && r > g && r > b);
        let foliage = layer(|[r, g, b, a]| a >= 128 && (g >= r || b >= r));
        let petals = layer(|[r, g, b, a]| a >= 128 && b > r && b > g).ink();
        let has_leaves = foliage.ink() > 0;
        let season = match season {
            _ if !has_leaves => Season::Winter,
            Season::Spring if 50 * petals > mask.ink() => Season::Spring,
            Season::Autumn if !appearance.look().evergreen => Season::Autumn,
            _ => Season::Summer,
        };
        Some(Self { photo, tree: mask, wood, foliage, season, leaf: palette.leaf, bark: palette.bark })
    }
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
