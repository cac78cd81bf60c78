//! What makes two runs the same run.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Named hashes of everything that decides the course of a fit; budgets are no part of it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fingerprint {
    parts: Vec<(Cow<'static, str>, u64)>,
}

impl Fingerprint {
    /// Adds the part called `name`: whatever `value` says when written as JSON.
    ///
    /// # Panics
    /// If `value` cannot be written as JSON: a mistake in this crate's types.
    #[must_use]
    pub fn with<T: Serialize + ?Sized>(self, name: &'static str, value: &T) -> Self {
        let text = serde_json::to_vec(value).expect("settings are plain values");
        self.with_bytes(name, text)
    }

    /// Adds the part called `name`, made of `bytes`.
    #[must_use]
    pub fn with_bytes(mut self, name: &'static str, bytes: impl AsRef<[u8]>) -> Self {
        self.parts.push((name.into(), Fnv::of(bytes.as_ref())));
        self
    }

    /// The names of the parts of `asked` that are missing here or are not the same.
    #[must_use]
    pub(crate) fn differences(&self, asked: &Self) -> Vec<&'static str> {
        let known: Vec<&'static str> = asked
            .parts
            .iter()
            .filter(|part| !self.parts.contains(part))
            .map(|(name, _)| match name {
                Cow::Borrowed(name) => *name,
                Cow::Owned(_) => "a part of another version",
            })
            .collect();
        if known.is_empty() && self.parts.len() != asked.parts.len() {
            return vec!["a part of another version"];
        }
        known
    }
}

/// The 64-bit hash of Fowler, Noll and Vo (FNV-1a): against accidents, not against intent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fnv;

impl Fnv {
    pub(crate) fn of(bytes: &[u8]) -> u64 {
        bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_published_one() {
        // Test vectors of the FNV page by L. C. Noll.
        assert_eq!(Fnv::of(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(Fnv::of(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(Fnv::of(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn differences_are_named() {
        let one = Fingerprint::default().with("goal", "a").with("seed", &1);
        let two = Fingerprint::default().with("goal", "a").with("seed", &2);
        assert!(one.differences(&one.clone()).is_empty());
        assert_eq!(one.differences(&two), ["seed"]);
        assert_eq!(Fingerprint::default().differences(&one), ["goal", "seed"]);
        assert_eq!(one.differences(&Fingerprint::default()), ["a part of another version"]);
    }
}
