//! Colours as `#rrggbb` and seasons by name, in JSON.

use pleach_plant::{Color, Season};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// For `#[serde(with)]` on an optional colour.
pub(super) mod color {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(color: &Option<Color>, to: S) -> Result<S::Ok, S::Error> {
        color.map(|color| color.to_string()).serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Color>, D::Error> {
        let Some(text) = Option::<String>::deserialize(from)? else { return Ok(None) };
        let wrong =
            || D::Error::custom(format!("a color is written `#rrggbb`, which `{}` is not", shown(&text)));
        Color::parse(&text).map(Some).ok_or_else(wrong)
    }
}

/// For `#[serde(with)]` on an optional season.
pub(super) mod season {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(season: &Option<Season>, to: S) -> Result<S::Ok, S::Error> {
        season.map(Season::name).serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Season>, D::Error> {
        let Some(text) = Option::<String>::deserialize(from)? else { return Ok(None) };
        let names = Season::NAMES.join("`, `");
        let wrong = || D::Error::custom(format!("`{}` is not a season: allowed are `{names}`", shown(&text)));
        Season::from_name(&text).map(Some).ok_or_else(wrong)
    }
}

/// Other people's text, escaped and cut.
fn shown(text: &str) -> String {
    text.chars().take(60).flat_map(char::escape_default).collect()
}
