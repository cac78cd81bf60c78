//! How a picture is taken.

use pleach_plant::Color;

/// The background.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Background {
    /// A pale wall, a little darker below.
    #[default]
    Studio,
    /// Nothing: the picture has an alpha channel.
    Transparent,
    /// One colour.
    Plain(Color),
}

/// The ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ground {
    /// A floor that shows only the tree's shadow.
    #[default]
    Shadow,
    /// Short grass.
    Grass,
    /// Nothing.
    None,
}

/// How a picture is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreviewSettings {
    /// Width in pixels, 1 to 8192.
    pub width: u32,
    /// Height in pixels, 1 to 8192.
    pub height: u32,
    /// Radians around the tree; 0 looks along +y.
    pub azimuth: f64,
    /// Radians above the horizon, -π/2 to π/2.
    pub elevation: f64,
    /// The background.
    pub background: Background,
    /// The ground.
    pub ground: Ground,
    /// Whether the tree stays inside the picture from any azimuth, for turntables.
    pub all_around: bool,
}

impl Default for PreviewSettings {
    /// 768 × 768 pixels from the front, five degrees up, in the studio.
    fn default() -> Self {
        Self {
            width: 768,
            height: 768,
            azimuth: 0.0,
            elevation: 0.09,
            background: Background::Studio,
            ground: Ground::Shadow,
            all_around: false,
        }
    }
}
