//! Options that take one word of a few.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// A word, its line of help, and its value.
pub(crate) type Choice<T> = (&'static str, &'static str, T);

/// Takes one of the words of `choices`, which the help and completions list.
pub(crate) fn one_of<T: Copy + Send + Sync + 'static>(
    choices: &'static [Choice<T>],
) -> impl TypedValueParser<Value = T> {
    let value = |&(word, help, _): &Choice<T>| {
        let value = PossibleValue::new(word);
        if help.is_empty() { value } else { value.help(help) }
    };
    PossibleValuesParser::new(choices.iter().map(value)).try_map(|given| {
        let found = choices.iter().find(|(word, ..)| *word == given);
        found.map(|(.., value)| *value).ok_or("not one of the words")
    })
}

/// What `given` stands for among `choices`, in lower or upper case.
///
/// # Errors
/// The words that are known.
pub(crate) fn word<T: Copy>(choices: &[Choice<T>], given: &str) -> Result<T, String> {
    let found = choices.iter().find(|(word, ..)| word.eq_ignore_ascii_case(given));
    let known = || choices.iter().map(|(word, ..)| *word).collect::<Vec<_>>().join(", ");
    found.map(|(.., value)| *value).ok_or_else(|| format!("expected {}", known()))
}
