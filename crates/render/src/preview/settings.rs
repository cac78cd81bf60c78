//! How a picture is taken.

use pleach_plant::Color;
use std::str::FromStr;

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

impl FromStr for Background {
    type Err = String;

    /// `studio`, `transparent`, or a colour such as `#dde6ee`.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "studio" => Ok(Self::Studio),
            "transparent" => Ok(Self::Transparent),
            color => Color::parse(color).map(Self::Plain).ok_or_else(|| {
                format!(
                    "the background is `{text}`, expected studio, transparent, or a colour such as #dde6ee"
                )
            }),
        }
    }
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

impl Ground {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Shadow, Self::Grass, Self::None];

    /// The name in flags.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Shadow => "shadow",
            Self::Grass => "grass",
            Self::None => "none",
        }
    }
}

impl FromStr for Ground {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|ground| ground.name() == text).ok_or_else(|| {
            let known = Self::ALL.map(Self::name).join(", ");
            format!("there is no ground `{text}`, expected one of {known}")
        })
    }
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
