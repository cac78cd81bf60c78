//! What a mesh should be like.

use pleach_plant::Parts;

/// How leaves and blossoms become triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LeafStyle {
    /// Leaf outlines and blossoms as the model has them.
    #[default]
    Outline,
    /// At most nine triangles for each leaf, along the outline and with its area; blossoms as they are.
    Reduced,
    /// Two triangles for each leaf, with the area of the outline; four for each blossom.
    Simple,
    /// One rectangle for each leaf and each blossom, which shows its picture: see [`MeshSettings::pictured`].
    Card,
    /// Two crossed cards through the middle of each leaf and one across each blossom, for pictures
    /// of leaves.
    CrossedCards,
    /// No foliage at all.
    None,
}

/// How finely a tree is meshed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshSettings {
    /// How far the bark may stray from the model's surface, in metres; positive. The number of
    /// triangles grows as `tolerance^-1/2` along a stem and around it alike.
    pub tolerance: f64,
    /// Fewest sides of a stem, at least 3.
    pub min_sides: u32,
    /// Most sides of a stem, at least `min_sides`, at most [`MeshSettings::MAX_SIDES`].
    pub max_sides: u32,
    /// How leaves are drawn, and blossoms where [`MeshSettings::blossoms`] says nothing else.
    pub leaves: LeafStyle,
    /// How blossoms are drawn, if not as leaves are.
    pub blossoms: Option<LeafStyle>,
    /// Whether leaves and blossoms show their cells of an [`crate::Atlas`] and have its forms.
    pub pictured: bool,
    /// Whether the normals of leaves and blossoms lean outwards, so that a crown is lit as a body, and its leaves still
    /// differ. Those of instances do not.
    pub rounded: bool,
    /// Whether each corner carries wind data.
    pub wind: bool,
    /// Whether each corner carries growth data.
    pub growth: bool,
    /// What of the tree becomes triangles.
    pub parts: Parts,
}

impl MeshSettings {
    /// No stem gets more sides than this.
    pub const MAX_SIDES: u32 = 96;

    /// Settings for a tolerance in metres, everything else as by default.
    #[must_use]
    pub fn with_tolerance(tolerance: f64) -> Self {
        Self { tolerance, ..Self::default() }
    }

    /// The settings with every number moved into its range.
    pub(crate) fn clamped(mut self) -> Self {
        self.tolerance = if self.tolerance.is_finite() { self.tolerance.clamp(1e-5, 1e3) } else { 1e3 };
        self.min_sides = self.min_sides.clamp(3, Self::MAX_SIDES);
        self.max_sides = self.max_sides.clamp(self.min_sides, Self::MAX_SIDES);
        self
    }
}

impl LeafStyle {
    /// What takes the place of this style where leaves show pictures: fewer triangles than an outline has are those of a
    /// rectangle, whose picture has the outline.
    #[must_use]
    pub const fn pictured(self) -> Self {
        match self {
            Self::Reduced | Self::Simple => Self::Card,
            Self::Outline | Self::Card | Self::CrossedCards | Self::None => self,
        }
    }

    /// Whether a leaf's outline is in its picture alone, which has to be cut out.
    #[must_use]
    pub const fn is_cut_out(self) -> bool {
        matches!(self, Self::Card | Self::CrossedCards)
    }
}

impl Default for MeshSettings {
    /// Two millimetres, 4 to 48 sides, leaves as outlines with rounded normals, neither wind nor growth; everything but roots.
    fn default() -> Self {
        Self {
            tolerance: 0.002,
            min_sides: 4,
            max_sides: 48,
            leaves: LeafStyle::Outline,
            blossoms: None,
            pictured: false,
            rounded: true,
            wind: false,
            growth: false,
            parts: Parts::LEAFY,
        }
    }
}
