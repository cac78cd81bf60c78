//! Headings, compared by what matters.

/// Units that a heading may say, since they are those of every table here.
const UNITS: [&str; 6] = ["m", "s", "°", "deg", "degrees", "metres"];

/// `heading` in lower case, letters and digits alone, without a unit that it need not say: `Height (m)` is `height`, and
/// `Height (cm)` is `heightcm`.
#[must_use]
pub fn plain(heading: &str) -> String {
    let (name, unit) = unit(heading);
    let name = if UNITS.contains(&unit) { name } else { heading };
    name.chars().filter(|sign| sign.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// A heading without the unit in brackets at its end, and the unit; empty if there is none.
fn unit(heading: &str) -> (&str, &str) {
    let heading = heading.trim();
    for (open, close) in [('(', ')'), ('[', ']')] {
        if let Some((name, unit)) = heading.strip_suffix(close).and_then(|rest| rest.rsplit_once(open)) {
            return (name.trim(), unit.trim());
        }
    }
    (heading, "")
}
