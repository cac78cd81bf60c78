//! Reading and writing files of a small family.

use super::*;
use crate::conformance::bush::{Bushes, space};
use proptest::prelude::*;

fn read(text: &str) -> Result<Species, SpeciesError> {
    SpeciesDoc::parse("t", text)?.species(&Bushes)
}

/// The issues of `text`, without the name of the file.
fn told(text: &str) -> String {
    let error = read(text).unwrap_err().to_string();
    error.lines().map(|line| line.strip_prefix("t:").unwrap()).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_file_that_says_nothing_is_the_default_species() {
    let species = read("").unwrap();
    assert_eq!((species.name.as_str(), species.description.as_str()), ("", ""));
    assert_eq!(species.params.values(), space().defaults());
    assert_eq!((species.tree_seed, species.appearance), (None, Appearance::default()));
    assert_eq!(species.foliage, Foliage::All);
}

#[test]
fn what_every_file_may_say_is_read_for_the_family() {
    let text = "name = \"a b\"\ndescription = \"of two\\nlines\"\ntree_seed = 9007199254740992\nbare = true\nside = \"right\"\n\
                lean = [1_0, -2.5]\npairs = \"yes\"\n[appearance]\nbark = \"#010203\"";
    let species = read(text).unwrap();
    assert_eq!((species.name.as_str(), species.description.as_str()), ("a b", "of two\nlines"));
    assert_eq!((species.tree_seed, species.foliage), (Some(1 << 53), Foliage::None));
    assert_eq!(species.params.list(3), [10.0, -2.5]);
    assert_eq!(species.params.list(6), [2.0], "a choice by its name");
    assert_eq!(species.appearance.bark.map(|color| color.0), Some([1, 2, 3]));
    assert_eq!(species.generator.structure(), "pairs = \"yes\"\n");
}

#[test]
fn mistakes_are_told_with_their_places() {
    for (text, message) in [
        ("height = 51", "1:10: `height` is 51, which is out of range: allowed is 0 to 50"),
        ("\nheight = nan", "2:10: `height` is NaN, which is not a finite number"),
        ("twigs = 2.5", "1:9: `twigs` is 2.5, which is not a whole number"),
        ("twigs = \"two\"", "1:9: `twigs` is a string, expected a number"),
        ("twigs = [2]", "1:9: `twigs` is an array, expected a single number"),
        ("lean = [1, 2, 3]", "1:8: `lean` has 3 values, expected 2"),
        ("lean = 1", "1:8: `lean` has 1 value, expected 2"),
        ("lean = [1, 100]", "1:12: `lean[1]` is 100, which is out of range: allowed is -90 to 90"),
        (
            "side = \"rihgt\"",
            "1:8: `side` is `rihgt`, which is not one of left, right, did you mean `right`?",
        ),
        ("hieght = 2", "1:1: `hieght` is not a known name, did you mean `height`?"),
        ("pair = \"no\"", "1:1: `pair` is not a known name, did you mean `pairs`?"),
        ("tall = 3", "1:1: `tall` is not a known name here: the height of the bush is `height`"),
        ("seed = 3", "1:1: `seed` is not a known name here: the seed of the tree is `tree_seed`"),
        ("bark = \"#000000\"", "1:1: `bark` is not a known name, did you mean `appearance.bark`?"),
        (
            "tree_seed = -1",
            "1:13: `tree_seed` is -1, which is out of range: allowed is 0 to 9007199254740992",
        ),
        ("bare = 1", "1:8: `bare` is a number, expected true or false"),
        ("name = 3", "1:8: `name` is a number, expected a string"),
        ("pairs = 3", "1:9: `pairs` is a number, expected a string"),
    ] {
        assert_eq!(told(text), message, "{text}");
    }
}

#[test]
fn all_mistakes_are_told_in_order_of_place() {
    let text = "twigs = -1\nname = \"a/b\"\nheight = \"tall\"\npairs = 1\ntree_seed = 0.5\nfoo = 1\n[appearance]\nbark = 0";
    let lines: Vec<String> =
        told(text).lines().map(|line| line.split(':').next().unwrap().to_owned()).collect();
    assert_eq!(lines, ["1", "2", "3", "4", "5", "6", "8"]);
}

#[test]
fn a_list_of_one_number_is_a_list() {
    use crate::param::{Kind, Param, ParamSpace};
    let one = Param::list("one", "year", Kind::real(0.0, 9.0), [1.0]);
    let space = std::sync::Arc::new(ParamSpace::new(vec![one]).unwrap());
    let numbers = |text: &str| SpeciesDoc::parse("t", text).unwrap().numbers(&space, &Bushes);
    assert_eq!(numbers("one = [3]").0, [3.0]);
    let (values, issues) = numbers("one = 3");
    assert_eq!((values, issues.len()), (vec![1.0], 1));
    assert!(issues[0].to_string().contains("is a number, expected an array of numbers"), "{}", issues[0]);
}

#[test]
fn built_in_species_are_known_by_name() {
    assert_eq!(preset(&Bushes, "paired").map(|species| species.tree_seed), Some(Some(12)));
    assert!(preset(&Bushes, "nobody").is_none());
}

proptest! {
    #[test]
    fn any_allowed_values_survive_the_file(
        units in proptest::collection::vec(0.0..=1.0_f64, 8),
        name in "[a-z_ ]{1,20}",
        description in "[ -~\n]{0,60}",
        tree_seed in proptest::option::of(0_u64..1 << 53),
        is_bare in proptest::bool::ANY,
    ) {
        let value = |(slot, unit): (crate::Slot, &f64)| {
            let kind = space().kind_of(slot);
            let (low, high) = kind.range();
            kind.repair(low + (high - low) * unit)
        };
        let values = space().slots().zip(&units).map(value).collect();
        let params = space().check(values).unwrap();
        let foliage = if is_bare { Foliage::None } else { Foliage::All };
        let species = Species { name, description, params, tree_seed, foliage, ..read("pairs = \"yes\"").unwrap() };
        let text = species.to_toml(&[]);
        let again = read(&text).map_err(|error| TestCaseError::fail(format!("{error}\nin\n{text}")))?;
        prop_assert_eq!(&again.name, &species.name);
        prop_assert_eq!(&again.description, &species.description);
        prop_assert_eq!(&again.params, &species.params);
        prop_assert_eq!(again.tree_seed, species.tree_seed);
        prop_assert_eq!(again.foliage, species.foliage);
        prop_assert_eq!(again.generator.model(), species.generator.model());
    }

    #[test]
    fn any_text_is_read_or_told(text in "([a-z_]{0,8} = [\\[\\]0-9.\"a-z, ]{0,12}\n){0,5}") {
        if let Err(error) = read(&text) {
            prop_assert!(!error.issues.is_empty());
            let lines = text.matches('\n').count() + 1;
            for issue in &error.issues {
                prop_assert!((1..=lines).contains(&issue.line), "{}", issue);
            }
        }
    }
}
