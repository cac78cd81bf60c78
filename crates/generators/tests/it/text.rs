//! Whatever text is given as a species: it is read, or refused with a place, and never a panic.

use pleach_generators::{RegistryError, families, read, read_text};
use pleach_tree::SpeciesError;
use pleach_tree::species::check_name;
use proptest::prelude::*;

/// The texts of all species that come with pleach.
fn known() -> Vec<&'static str> {
    families().iter().flat_map(|family| family.presets().iter().map(|(_, text)| *text)).collect()
}

/// Checks what is promised of every text.
fn check(text: &str) -> Result<(), TestCaseError> {
    match read_text("t.toml", text) {
        Ok(species) => {
            let written = species.to_toml(&["again\nand = again".to_owned()]);
            let again = read_text("again.toml", &written);
            let again = again.map_err(|error| TestCaseError::fail(format!("{error}\nin\n{written}")))?;
            prop_assert_eq!(&again.name, &species.name);
            prop_assert_eq!(&again.description, &species.description);
            prop_assert_eq!(&again.params, &species.params);
            prop_assert_eq!(again.tree_seed, species.tree_seed);
            prop_assert_eq!(&again.appearance, &species.appearance);
            prop_assert_eq!(again.generator.model(), species.generator.model());
            prop_assert!(species.name.is_empty() || check_name(&species.name).is_ok());
        }
        Err(error) => placed(&error, text)?,
    }
    Ok(())
}

fn placed(told: &SpeciesError, text: &str) -> Result<(), TestCaseError> {
    let SpeciesError { issues, .. } = told;
    let drawing = told.draw(false);
    prop_assert!(!drawing.chars().any(|c| c.is_control() && c != '\n'), "{:?}", drawing);
    prop_assert!(!issues.is_empty());
    let lines = text.matches('\n').count() + 1;
    let error = told.to_string();
    prop_assert!(error.lines().count() <= 21, "{}", error);
    for issue in issues {
        prop_assert!((1..=lines).contains(&issue.line), "{}", issue);
        let line = text.split('\n').nth(issue.line - 1).unwrap_or_default();
        prop_assert!((1..=line.chars().count() + 1).contains(&issue.column), "{}", issue);
        let said = issue.to_string();
        prop_assert!(said.chars().count() < 600, "{}", said);
        prop_assert!(!said.chars().any(char::is_control), "{:?}", said);
    }
    Ok(())
}

/// A value as somebody, or a broken disk, might write it.
fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<f64>().prop_map(|v| format!("{v:?}")),
        any::<i64>().prop_map(|v| v.to_string()),
        (-3.0..30.0).prop_map(|v: f64| v.to_string()),
        prop::collection::vec(-2.0..9.0, 0..6).prop_map(|v: Vec<f64>| format!("{v:?}")),
        Just("[[], {}, \"x\", true]".to_owned()),
        Just("{ shape = \"sphere\", center = [0, 0, 8], radius = 5 }".to_owned()),
        Just("[{ shape = \"box\", min = [-1, -1, 0], max = [1e5, 1, 9.5] }]".to_owned()),
        Just("1979-05-27T07:32:00Z".to_owned()),
        any::<String>().prop_map(|text| format!("{text:?}")),
        ".{0,300}".prop_map(|text| format!("'''{text}'''")),
        Just("0x7fffffffffffffffffff".to_owned()),
    ]
}

const KEYS: [&str; 17] = [
    "name",
    "description",
    "generator",
    "tree_seed",
    "bare",
    "appearance",
    "levels",
    "branches",
    "shape",
    "ratio",
    "prune_inside",
    "prune_obstacles",
    "tropism",
    "leaf_shape",
    "leaf_blos_num",
    "[appearance]\nbark",
    "nonsense",
];

/// A line of a species file, known key or not.
fn line() -> impl Strategy<Value = String> {
    (prop::sample::select(&KEYS[..]), value()).prop_map(|(key, value)| format!("{key} = {value}\n"))
}

/// A built-in species with some of its text damaged.
fn damaged() -> impl Strategy<Value = String> {
    let damage = prop_oneof![
        any::<char>().prop_map(|c| c.to_string()),
        value(),
        line(),
        Just(String::new()),
        Just("\n".to_owned()),
        Just("]".to_owned()),
        Just("=".to_owned()),
        "[0-9]{1,30}",
        Just("9".repeat(500)),
        Just("k".repeat(5000)),
    ];
    let one = (any::<prop::sample::Index>(), 0_usize..40, damage);
    (prop::sample::select(known()), prop::collection::vec(one, 1..6)).prop_map(|(text, damages)| {
        let mut text: Vec<char> = text.chars().collect();
        for (at, removed, put) in damages {
            let from = at.index(text.len() + 1);
            let to = (from + removed).min(text.len());
            text.splice(from..to, put.chars());
        }
        text.into_iter().collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text(text in any::<String>()) {
        check(&text)?;
    }

    #[test]
    fn lines_of_a_species(lines in prop::collection::vec(line(), 0..5)) {
        check(&lines.concat())?;
    }

    #[test]
    fn damaged_species(text in damaged()) {
        check(&text)?;
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300), known in prop::sample::select(known())) {
        let mut long = known.as_bytes().to_vec();
        long.extend_from_slice(&bytes);
        for bytes in [&bytes, &long] {
            match (read(bytes.as_slice(), "it"), std::str::from_utf8(bytes)) {
                (Err(RegistryError::Species(error)), Ok(text)) => placed(&error, text)?,
                (Err(RegistryError::Species(error)), Err(_)) => {
                    prop_assert!(error.issues[0].line >= 1 && error.issues[0].column >= 1);
                }
                (Err(RegistryError::Picture { .. }), _) | (Ok(_), Ok(_)) => {}
                (read, _) => prop_assert!(false, "{:?}", read.map(|s| s.name)),
            }
        }
    }
}

#[test]
fn every_known_species_is_written_and_read() {
    known().into_iter().for_each(|text| check(text).unwrap());
}

#[test]
fn nesting_and_length_have_an_end() {
    for text in ["a = ".to_owned() + &"[".repeat(200_000), "x".repeat(1 << 20), "k = 1\n".repeat(10_000)] {
        check(&text).unwrap();
    }
    let many: String = (0..10_000).map(|i| format!("key{i} = 1\n")).collect();
    check(&many).unwrap();
    assert!(read_text("t.toml", &many).unwrap_err().to_string().ends_with("and 9980 more mistakes"));
}
