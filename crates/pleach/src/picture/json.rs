//! How options look in JSON.

use pleach_fit::{Optimizer, TreeSeed};
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};
use std::fmt::Display;
use std::str::FromStr;
use std::time::Duration;

/// A value as the text that it is read from.
pub(super) mod text {
    use super::*;

    pub(in super::super) fn serialize<T: Display, S: Serializer>(
        value: &T,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_str(value)
    }

    pub(in super::super) fn deserialize<'de, T, D>(deserializer: D) -> Result<T, D::Error>
    where
        T: FromStr<Err: Display>,
        D: Deserializer<'de>,
    {
        String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}

/// The same of a value that may be absent.
pub(super) mod optional_text {
    use super::*;

    pub(in super::super) fn serialize<T: Display, S: Serializer>(
        value: &Option<T>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        value.as_ref().map(ToString::to_string).serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, T, D>(deserializer: D) -> Result<Option<T>, D::Error>
    where
        T: FromStr<Err: Display>,
        D: Deserializer<'de>,
    {
        let text = Option::<String>::deserialize(deserializer)?;
        text.map(|text| text.parse().map_err(D::Error::custom)).transpose()
    }
}

/// The same of a list.
pub(super) mod texts {
    use super::*;

    pub(in super::super) fn serialize<T: Display, S: Serializer>(
        values: &[T],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(values.iter().map(ToString::to_string))
    }

    pub(in super::super) fn deserialize<'de, T, D>(deserializer: D) -> Result<Vec<T>, D::Error>
    where
        T: FromStr<Err: Display>,
        D: Deserializer<'de>,
    {
        let texts = Vec::<String>::deserialize(deserializer)?;
        texts.iter().map(|text| text.parse().map_err(D::Error::custom)).collect()
    }
}

/// A time as seconds.
pub(super) mod seconds {
    use super::*;

    pub(in super::super) fn serialize<S: Serializer>(
        time: &Option<Duration>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        time.map(|time| time.as_secs_f64()).serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Duration>, D::Error> {
        let seconds = Option::<f64>::deserialize(deserializer)?;
        let wrong = |seconds| D::Error::custom(format!("a time is {seconds} s, expected above 0 s"));
        seconds.map(|seconds| Duration::try_from_secs_f64(seconds).map_err(|_| wrong(seconds))).transpose()
    }
}

/// The seed of a tree as a number, or `any`.
pub(super) mod tree_seed {
    use super::*;

    #[derive(Serialize, Deserialize)]
    #[serde(untagged, expecting = "the seed of a tree is a whole number of 0 or more, or \"any\"")]
    enum Written {
        Number(u64),
        Word(Word),
    }

    #[derive(Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Word {
        Any,
    }

    pub(in super::super) fn serialize<S: Serializer>(
        seed: &TreeSeed,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match *seed {
            TreeSeed::Fixed(seed) => Written::Number(seed),
            TreeSeed::Any => Written::Word(Word::Any),
        }
        .serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<TreeSeed, D::Error> {
        Ok(match Written::deserialize(deserializer)? {
            Written::Number(seed) => TreeSeed::Fixed(seed),
            Written::Word(Word::Any) => TreeSeed::Any,
        })
    }
}

/// An optimiser: its name, or an object of its name and those of its settings that are not as by default.
pub(super) mod optimizer {
    use super::*;
    use crate::picture::optimizer::optimizer_with;

    pub(in super::super) fn serialize<S: Serializer>(
        optimizer: &Optimizer,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let name = optimizer.name();
        match name.parse::<Optimizer>() {
            Ok(usual) if usual == *optimizer => serializer.serialize_str(name),
            _ => optimizer.serialize(serializer),
        }
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Optimizer, D::Error> {
        let (name, settings) = match Value::deserialize(deserializer)? {
            Value::String(name) => (name, Map::new()),
            Value::Object(one) if one.len() == 1 => {
                let (name, settings) = one.into_iter().next().unwrap_or_default();
                (name, read(settings)?)
            }
            other => {
                return Err(D::Error::custom(format!(
                    "the optimizer is {other}, expected its name, or an object of its name and its settings"
                )));
            }
        };
        let texts = settings.iter().map(|(key, value)| {
            let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            (key.as_str(), text)
        });
        optimizer_with(&name, texts).map_err(D::Error::custom)
    }

    fn read<T: DeserializeOwned, E: serde::de::Error>(value: Value) -> Result<T, E> {
        serde_json::from_value(value).map_err(E::custom)
    }
}
