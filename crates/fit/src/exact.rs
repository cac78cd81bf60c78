//! Numbers that come back from a file as the same bits, infinities included.
//!
//! JSON has no infinity, and a cost may be one; so costs are written as the 16 hexadecimal digits
//! of their bits.

/// `#[serde(with = "exact::number")]` for an `f64`.
pub(crate) mod number {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub(crate) fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:016x}", value.to_bits()))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        let digits = String::deserialize(deserializer)?;
        u64::from_str_radix(&digits, 16).map(f64::from_bits).map_err(D::Error::custom)
    }
}

/// `#[serde(with = "exact::list")]` for a `Vec<f64>`: one string, 16 digits a number.
pub(crate) mod list {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};
    use std::fmt::Write as _;

    pub(crate) fn serialize<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
        let mut digits = String::with_capacity(16 * values.len());
        for value in values {
            // Writing to a string cannot fail.
            let _ = write!(digits, "{:016x}", value.to_bits());
        }
        serializer.serialize_str(&digits)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
        let digits = String::deserialize(deserializer)?;
        if !digits.is_ascii() || digits.len() % 16 != 0 {
            return Err(D::Error::custom("expected 16 hexadecimal digits a number"));
        }
        (0..digits.len() / 16)
            .map(|i| u64::from_str_radix(&digits[16 * i..16 * (i + 1)], 16).map(f64::from_bits))
            .collect::<Result<_, _>>()
            .map_err(D::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use serde::{Deserialize, Serialize};

    #[derive(Serialize, Deserialize)]
    struct Both {
        #[serde(with = "super::number")]
        one: f64,
        #[serde(with = "super::list")]
        many: Vec<f64>,
    }

    #[test]
    fn any_bits_survive() {
        let many = vec![0.1, -0.0, f64::INFINITY, f64::MIN_POSITIVE / 8.0, f64::NAN];
        let text = serde_json::to_string(&Both { one: f64::NEG_INFINITY, many: many.clone() }).unwrap();
        let back: Both = serde_json::from_str(&text).unwrap();
        assert_eq!(back.one, f64::NEG_INFINITY);
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&back.many), bits(&many));
    }

    #[test]
    fn damaged_digits_are_errors() {
        for text in [r#"{"one":"zz","many":""}"#, r#"{"one":"00","many":"123"}"#] {
            assert!(serde_json::from_str::<Both>(text).is_err(), "{text}");
        }
    }
}
