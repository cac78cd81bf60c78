//! What a plant looks like where that is not form: colours and season, for pictures and exports.
//!
//! Every part is optional. What is missing takes one plain look, [`Look::PLAIN`]. Generators never read it.

mod blend;
mod color;
pub mod oklab;
mod words;

pub use color::Color;
pub use words::{BarkPattern, Season};

/// What is said of colours and season: the table `[appearance]` of a species file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Appearance {
    /// Colour of the bark.
    pub bark: Option<Color>,
    /// How bark is marked.
    pub bark_pattern: Option<BarkPattern>,
    /// Colour of leaves in summer.
    pub leaf: Option<Color>,
    /// Colour of leaves in autumn.
    pub autumn: Option<Color>,
    /// Colour of blossoms.
    pub blossom: Option<Color>,
    /// Whether leaves stay on, and green, all year.
    pub evergreen: Option<bool>,
    /// When the tree is shown.
    pub season: Option<Season>,
}

/// An [`Appearance`] with nothing left open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// Colour of the bark.
    pub bark: Color,
    /// How bark is marked.
    pub bark_pattern: BarkPattern,
    /// Colour of leaves in summer.
    pub leaf: Color,
    /// Colour of leaves in autumn.
    pub autumn: Color,
    /// Colour of blossoms.
    pub blossom: Color,
    /// Whether leaves stay on, and green, all year.
    pub evergreen: bool,
    /// When the tree is shown; `None` for full leaf with whatever blossom the model gives it.
    pub season: Option<Season>,
}

impl Look {
    /// What a species looks like that says nothing.
    pub const PLAIN: Self = Self {
        bark: Color::from_hex(0x6b_5c_4c),
        bark_pattern: BarkPattern::Furrowed,
        leaf: Color::from_hex(0x5c_83_36),
        autumn: Color::from_hex(0xd0_96_2c),
        blossom: Color::from_hex(0xf4_e3_e6),
        evergreen: false,
        season: None,
    };
}

impl Appearance {
    /// The look with nothing left open: [`Look::PLAIN`] fills in what is not said. Evergreens have their
    /// summer's colour in autumn too.
    #[must_use]
    pub fn look(&self) -> Look {
        let plain = Look::PLAIN;
        let leaf = self.leaf.unwrap_or(plain.leaf);
        let evergreen = self.evergreen.unwrap_or(plain.evergreen);
        Look {
            bark: self.bark.unwrap_or(plain.bark),
            bark_pattern: self.bark_pattern.unwrap_or(plain.bark_pattern),
            leaf,
            autumn: if evergreen { leaf } else { self.autumn.unwrap_or(plain.autumn) },
            blossom: self.blossom.unwrap_or(plain.blossom),
            evergreen,
            season: self.season,
        }
    }
}
