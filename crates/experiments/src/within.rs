//! Types of options that carry their declared range: a value outside is refused with its place in the file.

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, RangeInclusive};
use std::str::FromStr;

/// A whole number from `LOW` to `HIGH`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Whole<const LOW: u64, const HIGH: u64>(u64);

impl<const LOW: u64, const HIGH: u64> Deref for Whole<LOW, HIGH> {
    type Target = u64;

    fn deref(&self) -> &u64 {
        &self.0
    }
}

impl<'de, const LOW: u64, const HIGH: u64> Deserialize<'de> for Whole<LOW, HIGH> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader<const LOW: u64, const HIGH: u64>;
        impl<const LOW: u64, const HIGH: u64> Visitor<'_> for Reader<LOW, HIGH> {
            type Value = Whole<LOW, HIGH>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a whole number from {LOW} to {HIGH}")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
                let inside = u64::try_from(value).ok().filter(|value| (LOW..=HIGH).contains(value));
                inside.map(Whole).ok_or_else(|| E::invalid_value(Unexpected::Signed(value), &self))
            }
        }
        deserializer.deserialize_i64(Reader)
    }
}

/// The meaning of a real option, and its range.
pub(super) trait Quantity {
    const WHAT: &'static str;
    const RANGE: RangeInclusive<f64>;
}

/// A real number in the range of `Q`.
pub(super) struct Real<Q>(f64, PhantomData<Q>);

impl<Q> Clone for Real<Q> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Q> Copy for Real<Q> {}

impl<Q> fmt::Debug for Real<Q> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<Q> Deref for Real<Q> {
    type Target = f64;

    fn deref(&self) -> &f64 {
        &self.0
    }
}

impl<'de, Q: Quantity> Deserialize<'de> for Real<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader<Q>(PhantomData<Q>);
        impl<Q: Quantity> Visitor<'_> for Reader<Q> {
            type Value = Real<Q>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{} from {} to {}", Q::WHAT, Q::RANGE.start(), Q::RANGE.end())
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
                if Q::RANGE.contains(&value) {
                    return Ok(Real(value, PhantomData));
                }
                Err(E::invalid_value(Unexpected::Float(value), &self))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
                self.visit_f64(value as f64)
            }
        }
        deserializer.deserialize_f64(Reader(PhantomData))
    }
}

/// Declares quantities of real options.
macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident: $what:literal, $range:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(super) enum $name {}

        impl Quantity for $name {
            const WHAT: &'static str = $what;
            const RANGE: RangeInclusive<f64> = $range;
        }
    )*};
}

quantities! {
    /// Height of a tree in metres.
    Meters: "a height in metres", 0.001..=1000.0;
    /// An azimuth in degrees.
    Azimuth: "an azimuth in degrees", -360.0..=360.0;
    /// The time of a fit.
    Seconds: "seconds", 0.1..=86_400.0;
    /// A part of a search range.
    Part: "a part of the search range", 0.0..=1.0;
}

/// A list of `MIN` to `MAX` entries.
#[derive(Clone, Debug)]
pub(super) struct List<T, const MIN: usize = 1, const MAX: usize = 1000>(Vec<T>);

impl<T, const MIN: usize, const MAX: usize> Default for List<T, MIN, MAX> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T, const MIN: usize, const MAX: usize> Deref for List<T, MIN, MAX> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<'a, T, const MIN: usize, const MAX: usize> IntoIterator for &'a List<T, MIN, MAX> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<'de, T: Deserialize<'de>, const MIN: usize, const MAX: usize> Deserialize<'de> for List<T, MIN, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = Vec::<T>::deserialize(deserializer)?;
        if (MIN..=MAX).contains(&list.len()) {
            return Ok(Self(list));
        }
        Err(D::Error::custom(format!("{} entries, expected from {MIN} to {MAX}", list.len())))
    }
}

/// A word that names one of a set: an optimiser, an objective.
#[derive(Clone, Debug)]
pub(super) struct Word<T> {
    pub(super) text: String,
    pub(super) value: T,
}

impl<'de, T: FromStr<Err: fmt::Display>> Deserialize<'de> for Word<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        text(deserializer, |text| Ok::<_, T::Err>(Self { text: text.to_owned(), value: text.parse()? }))
    }
}

/// What `parse` makes of a text; a visitor, so that its errors are about the text's own place.
fn text<'de, D: Deserializer<'de>, T, E: fmt::Display>(
    deserializer: D,
    parse: impl FnOnce(&str) -> Result<T, E>,
) -> Result<T, D::Error> {
    struct Reader<F, T, E>(F, PhantomData<(T, E)>);
    impl<T, E: fmt::Display, F: FnOnce(&str) -> Result<T, E>> Visitor<'_> for Reader<F, T, E> {
        type Value = T;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a text")
        }

        fn visit_str<D: Error>(self, text: &str) -> Result<T, D> {
            (self.0)(text).map_err(D::custom)
        }
    }
    deserializer.deserialize_str(Reader(parse, PhantomData))
}

/// A species that exists, by name or by file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SpeciesName(String);

impl Deref for SpeciesName {
    type Target = String;

    fn deref(&self) -> &String {
        &self.0
    }
}

impl<'de> Deserialize<'de> for SpeciesName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        text(deserializer, |name| pleach_generators::species(name).map(|_| Self(name.to_owned())))
    }
}

/// A name that is safe as a part of a file's name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FileName(String);

/// Longest name in bytes: endings are added, and file systems take 255.
const MAX_NAME_CHARS: usize = 100;

impl FromStr for FileName {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let is_bad = |c: char| c.is_control() || matches!(c, '/' | '\\' | ':');
        if name.is_empty() || name.len() > MAX_NAME_CHARS || name.starts_with('.') || name.contains(is_bad) {
            return Err(format!(
                "{name:.60?} cannot name files: expected up to {MAX_NAME_CHARS} bytes without `/`, `\\`, `:` \
                 and control characters, the first one no dot"
            ));
        }
        Ok(Self(name.to_owned()))
    }
}

impl Deref for FileName {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl<'de> Deserialize<'de> for FileName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        text(deserializer, str::parse)
    }
}
