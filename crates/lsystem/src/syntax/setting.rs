//! The settings of a grammar's header.

use super::{Dialect, Expr, Span};
use pleach_tree::leaf_shape::LeafShape;

/// The form of a setting's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Number,
    /// Three numbers in parentheses.
    Vector,
    /// One of the words, which are numbered from 0.
    Word(&'static [&'static str]),
}

/// A setting of the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SettingKey {
    /// Number of derivation steps.
    Steps,
    /// Turn of a symbol without an argument, degrees.
    Angle,
    /// Length of a step without an argument.
    Step,
    /// Metres per unit of length.
    Scale,
    /// The turtle's width before the first `!`.
    Width,
    /// Radius per width.
    Thickness,
    /// Factor of the width at a `!` without an argument.
    Thinning,
    /// Factor of the width at each `[`.
    BranchThinning,
    /// The vector that stems bend towards.
    Tropism,
    /// How far they bend: degrees per piece in Hewitt's dialect, radians in the book's.
    Elasticity,
    /// Largest random deflection of a piece, degrees.
    Bendiness,
    /// Shape of the leaves.
    LeafShape,
    /// Length of a leaf, metres.
    LeafScale,
    /// Width of a leaf as a part of its length.
    LeafScaleX,
    /// How far leaves turn to the light, 0 to 1.
    LeafBend,
    /// What branches end in.
    Tips,
}

/// Words of `leaf_shape`, numbered as in species files; 0 is the default shape.
const LEAF_SHAPES: [&str; LeafShape::ALL.len() + 1] = {
    let mut words = ["default"; LeafShape::ALL.len() + 1];
    let mut i = 0;
    while i < LeafShape::ALL.len() {
        words[LeafShape::ALL[i] as usize] = LeafShape::ALL[i].name();
        i += 1;
    }
    words
};

impl SettingKey {
    /// All of them, in the order of the normal form.
    pub const ALL: [Self; 16] = [
        Self::Steps,
        Self::Angle,
        Self::Step,
        Self::Scale,
        Self::Width,
        Self::Thickness,
        Self::Thinning,
        Self::BranchThinning,
        Self::Tropism,
        Self::Elasticity,
        Self::Bendiness,
        Self::LeafShape,
        Self::LeafScale,
        Self::LeafScaleX,
        Self::LeafBend,
        Self::Tips,
    ];

    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Steps => "steps",
            Self::Angle => "angle",
            Self::Step => "step",
            Self::Scale => "scale",
            Self::Width => "width",
            Self::Thickness => "thickness",
            Self::Thinning => "thinning",
            Self::BranchThinning => "branch_thinning",
            Self::Tropism => "tropism",
            Self::Elasticity => "elasticity",
            Self::Bendiness => "bendiness",
            Self::LeafShape => "leaf_shape",
            Self::LeafScale => "leaf_scale",
            Self::LeafScaleX => "leaf_scale_x",
            Self::LeafBend => "leaf_bend",
            Self::Tips => "tips",
        }
    }

    /// The form of its value.
    #[must_use]
    pub const fn shape(self) -> Shape {
        match self {
            Self::Tropism => Shape::Vector,
            Self::LeafShape => Shape::Word(&LEAF_SHAPES),
            Self::Tips => Shape::Word(&["bare", "leaf"]),
            _ => Shape::Number,
        }
    }

    /// Smallest and largest value.
    #[must_use]
    pub const fn range(self) -> (f64, f64) {
        match self {
            Self::Steps => (0.0, 100_000.0),
            Self::Angle => (-360.0, 360.0),
            Self::Bendiness => (0.0, 180.0),
            Self::Elasticity | Self::Tropism => (-1000.0, 1000.0),
            Self::LeafShape => (0.0, LeafShape::ALL.len() as f64),
            Self::LeafBend | Self::Tips => (0.0, 1.0),
            Self::Thinning | Self::BranchThinning => (0.0, 10.0),
            _ => (0.0, 1e6),
        }
    }

    /// The value where a grammar is silent.
    #[must_use]
    pub const fn default(self, dialect: Dialect) -> f64 {
        match self {
            Self::Angle => 90.0,
            Self::Steps | Self::Tropism | Self::Bendiness | Self::LeafBend | Self::Tips => 0.0,
            Self::Elasticity => match dialect {
                Dialect::Abop => 0.0,
                Dialect::Hewitt => 1.0,
            },
            Self::Width => 0.1,
            Self::Thickness => 0.5,
            Self::LeafShape => LeafShape::Elliptic as u8 as f64,
            Self::LeafScale => 0.2,
            Self::Step | Self::Scale | Self::Thinning | Self::BranchThinning | Self::LeafScaleX => 1.0,
        }
    }

    /// The setting with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|key| key.name() == name)
    }
}

/// A setting as it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Which.
    pub key: SettingKey,
    /// One expression, or three of a vector. Words are names.
    pub values: Vec<Expr>,
    /// Where it stands.
    pub span: Span,
}
