//! Files that are broken, or that mean harm: an error with a place, and nothing else.

use pleach_import::translate;
use proptest::prelude::*;

fn told(name: &str, text: &str) -> String {
    translate(name, text).unwrap_err().to_string()
}

#[test]
fn code_is_not_run() {
    let message = told("x.py", "params = {\n  'g_scale': __import__('os').system('id'),\n}");
    assert!(message.starts_with("x.py:2:14: `__import__` is here"), "{message}");
    assert!(message.contains("code in them is not run"), "{message}");
    assert!(told("x.py", "import bpy\nparams = {'g_scale': 1}").starts_with("x.py:1:1: `import` is here"));
    assert!(told("x.py", "params = {'g_scale': 1}\nimport os").starts_with("x.py:2:1: `import` is here"));
    assert!(told("x.py", "params = {'g_scale': [x for x in y]}").starts_with("x.py:1:23: `x` is here"));
}

#[test]
fn values_of_the_wrong_kind_have_places() {
    let message =
        told("x.py", "params = {\n 'g_scale': 'high',\n 'curve': [1, 2],\n 'levels': {},\n 'branches': 3\n}");
    let lines: Vec<&str> = message.lines().collect();
    assert_eq!(lines.len(), 4, "{message}");
    assert_eq!(lines[0], "x.py:2:13: `g_scale` is the string `high`, expected a number");
    assert_eq!(lines[1], "x.py:3:11: `curve` has 2 values, expected 4");
    assert_eq!(lines[2], "x.py:4:12: `levels` is a dictionary, expected a number");
    assert_eq!(lines[3], "x.py:5:14: `branches` is a number, expected a list of numbers");
    let message = told(
        "x.xml",
        "<arbaro>\n <species>\n  <param name='Scale' value='tall'/>\n  <param value='1'/>\n </species>\n</arbaro>",
    );
    assert!(
        message
            .starts_with("x.xml:3:30: `Scale` is the string `tall`, expected a number\nx.xml:4:3: `param` "),
        "{message}"
    );
    assert!(
        told("x.json", r#"{"branch": 3}"#)
            .starts_with("x.json:1:12: a number is here, expected a dictionary")
    );
    assert!(
        told("x.json", r#"{"branch": {"length": {"one": 3}}}"#)
            .contains("x.json:1:24: `length` is the string `one`")
    );
    assert!(told("x.json", "[1, 2]").contains("not a species of tree-gen, Sapling or ez-tree"));
    assert!(told("x.json", "{}").contains("not a species of tree-gen, Sapling or ez-tree"));
}

#[test]
fn documents_that_grow_are_refused() {
    let bomb =
        "<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY b 'ha'><!ENTITY c '&b;&b;'>]>\n<arbaro>&c;</arbaro>";
    let message = told("x.xml", bomb);
    assert!(message.starts_with("x.xml:2:1: a document type is here"), "{message}");
    assert!(
        told("x.xml", "<arbaro>&c;</arbaro>").starts_with("x.xml:1:9: "),
        "{}",
        told("x.xml", "<arbaro>&c;</arbaro>")
    );
    assert!(told("x.xml", &"<a>".repeat(20_000)).starts_with("x.xml:1:"));
    assert!(told("x.xml", &"<a/>".repeat(16_000)).starts_with("x.xml:1:"));
    let many = format!("<arbaro>{}</arbaro>", "<a/>".repeat(16_000));
    assert!(told("x.xml", &many).contains("more than 2000 elements"), "{}", told("x.xml", &many));
    let spaces = "<arbaro>\n<species xmlns:a='b'></species></arbaro>";
    assert!(
        told("x.xml", spaces).starts_with("x.xml:2:10: a namespace is here"),
        "{}",
        told("x.xml", spaces)
    );
    assert!(told("x.xml", "<arbaro>\n</arbaro>").starts_with("x.xml:1:1: `<arbaro>` has no `<species>`"));
    assert!(
        told("x.xml", "<arbaro>\n<species>").starts_with("x.xml:2:10: "),
        "{}",
        told("x.xml", "<arbaro>\n<species>")
    );
}

#[test]
fn nesting_has_an_end() {
    for open in ["[", "(", "{'a':", "{1:["] {
        let message = told("x.py", &open.repeat(10_000));
        assert!(message.contains("nested here more than 16 deep"), "{message}");
    }
    let deep = format!("{{\"branch\": {}1{}}}", "[".repeat(15), "]".repeat(15));
    assert!(told("x.json", &deep).contains("a list is here, expected a dictionary"));
}

#[test]
fn what_overflows_or_is_no_level_has_a_place() {
    let force = "{'branch': {\n'force': {'strength': 1e308, 'direction': {'x': 0, 'y': 1e9}}}}";
    assert!(told("x.json", force).starts_with("x.json:2:10: "), "{}", told("x.json", force));
    for level in ["-1", "0.5", "'4'", "'a'"] {
        let text = format!("{{'branch': {{'length': {{{level}: 5}}}}}}");
        let message = told("x.json", &text);
        assert!(message.contains("a level from 0 to 3"), "{text}: {message}");
    }
    assert!(told("x.json", "{\"\\u0062ranch\": 1}").starts_with("x.json:1:3: an escape is here"));
}

/// Anything with a name that one of the programs has, too.
#[test]
fn other_files_are_no_species() {
    for text in ["{\"type\": \"module\", \"name\": \"x\"}", "{\"seed\": 1}", "{'levels': 3}"] {
        assert!(told("x.json", text).contains("not a species of tree-gen, Sapling or ez-tree"), "{text}");
    }
    let long = format!("{{'g_scale': 6, {}}}", "'a': 1, ".repeat(10_000));
    assert!(told("x.py", &long).contains("expected a species of at most 65536"), "{}", told("x.py", &long));
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "\\PC*", name in "x\\.(py|json|xml|toml)") {
        let _ = translate(&name, &text);
    }

    #[test]
    fn any_text_of_brackets_and_words(words in prop::collection::vec(
        prop::sample::select(vec!["{", "}", "[", "]", "(", ")", "'a'", "'g_scale'", "\"branch\"", ":", ",", "1", "-", "e", "\n", "#", "ä",
            "<arbaro>", "<species>", "<param name='Scale' value='", "'/>", "</species>", "</arbaro>", "params ="]), 0..40))
    {
        let text = words.concat();
        if let Err(error) = translate("x.py", &text) {
            prop_assert!(error.to_string().starts_with("x.py:"), "{}", error);
            let _ = error.draw(false);
        }
    }
}
