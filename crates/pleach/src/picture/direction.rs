//! Directions of view, in degrees, and further pictures.

use pleach_fit::{Azimuth, ROUGH_AZIMUTH};
use pleach_silhouette::View;
use std::fmt;
use std::str::FromStr;

/// A direction of view in degrees; `AZ` or `AZ,EL` as text.
///
/// Kept in degrees, so that it is written as it was given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Direction {
    /// Degrees around the trunk, counter-clockwise seen from above; 0 is the front.
    pub azimuth: f64,
    /// Degrees above the horizon, from −90 to 90.
    pub elevation: f64,
}

impl Direction {
    /// The view from there.
    #[must_use]
    pub fn view(self) -> View {
        View::degrees(self.azimuth, self.elevation)
    }

    /// Whether both angles are numbers and the elevation is one.
    pub(super) fn is_valid(self) -> bool {
        self.azimuth.is_finite() && (-90.0..=90.0).contains(&self.elevation)
    }
}

impl FromStr for Direction {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let number = |part: &str| part.trim().parse::<f64>().ok();
        let (azimuth, elevation) = text.split_once(',').unwrap_or((text, "0"));
        number(azimuth)
            .zip(number(elevation))
            .map(|(azimuth, elevation)| Self { azimuth, elevation })
            .filter(|direction| direction.is_valid())
            .ok_or("expected azimuth, or azimuth,elevation, in degrees, the elevation from -90 to 90")
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.azimuth)?;
        if self.elevation == 0.0 { Ok(()) } else { write!(f, ",{}", self.elevation) }
    }
}

/// A further picture of the goal's tree, and from where it was taken so far as that is known: `AZ[,EL]=PICTURE`,
/// `~AZ[,EL]=PICTURE` for within 15 degrees of it, or `auto=PICTURE` for anywhere around the tree.
///
/// Azimuths count from the goal's.
#[derive(Clone, Debug, PartialEq)]
pub struct FurtherView {
    /// From where, or from about where.
    pub direction: Direction,
    /// How far the azimuth is known.
    pub azimuth: Azimuth,
    /// The name of the picture in [`super::FitSource::pictures`], or a file.
    pub picture: String,
}

impl FurtherView {
    /// A picture from a known direction.
    #[must_use]
    pub fn known(direction: Direction, picture: impl Into<String>) -> Self {
        Self { direction, azimuth: Azimuth::Known, picture: picture.into() }
    }
}

impl FromStr for FurtherView {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (from, picture) = text.split_once('=').unwrap_or((text, ""));
        if picture.is_empty() {
            return Err("expected a direction and a picture, such as 90=side.png".to_owned());
        }
        let (direction, azimuth) = match (from, from.strip_prefix('~')) {
            ("auto", _) => (Direction::default(), Azimuth::Any),
            (_, Some(about)) => (about.parse()?, Azimuth::Within(ROUGH_AZIMUTH)),
            _ => {
                let known: Result<Direction, _> = from.parse();
                (known.map_err(|error| format!("{error}; or auto=FILE, ~AZ=FILE"))?, Azimuth::Known)
            }
        };
        Ok(Self { direction, azimuth, picture: picture.to_owned() })
    }
}

impl fmt::Display for FurtherView {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.azimuth {
            Azimuth::Any => write!(f, "auto")?,
            Azimuth::Within(_) => write!(f, "~{}", self.direction)?,
            Azimuth::Known => write!(f, "{}", self.direction)?,
        }
        write!(f, "={}", self.picture)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_written_as_they_were_given() {
        for text in ["0", "33.3", "-90", "10,5.5"] {
            assert_eq!(text.parse::<Direction>().unwrap().to_string(), text);
        }
        for text in ["", "a", "1,91", "nan", "1,2,3"] {
            assert!(text.parse::<Direction>().is_err(), "{text}");
        }
    }

    #[test]
    fn further_pictures_are_written_as_they_were_given() {
        for text in ["90=side.png", "~45,5=a=b.png", "auto=other.png"] {
            assert_eq!(text.parse::<FurtherView>().unwrap().to_string(), text);
        }
        for text in ["90", "90=", "x=side.png", "~auto=side.png"] {
            assert!(text.parse::<FurtherView>().is_err(), "{text}");
        }
    }
}
