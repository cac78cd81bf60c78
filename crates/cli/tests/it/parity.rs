//! A fit says the same by the program, by Python and in the page: the cases of `tests/data/parity.json`, key by key and
//! bit by bit. Python's and the page's own tests read the same file; `PLEACH_BLESS=1` writes it again from the program.

use pleach_tests::{Dir, root};
use serde_json::{Map, Value};

/// What only the program has: what it was asked for, as files.
const OF_THE_PROGRAM: [&str; 3] = ["goal", "goal_sha256", "inputs_sha256"];

/// `report` without what depends on the clock.
fn without_times(report: &Map<String, Value>) -> Map<String, Value> {
    let mut report = report.clone();
    for key in pleach::TIME_KEYS {
        let mut keys = key.split('.').collect::<Vec<_>>();
        let last = keys.pop().unwrap();
        let place = keys
            .iter()
            .try_fold(&mut report, |place, key| place.get_mut(*key).and_then(Value::as_object_mut));
        if let Some(place) = place {
            assert!(place.remove(last).is_some(), "{key} is not in the report");
        }
    }
    report
}

#[test]
fn the_program_reports_what_the_others_do() {
    let path = root().join("tests/data/parity.json");
    let mut known: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(known["times"], serde_json::json!(pleach::TIME_KEYS));
    let bless = std::env::var_os("PLEACH_BLESS").is_some();
    let dir = Dir::new();
    for case in known["cases"].as_array_mut().unwrap() {
        let name = case["name"].as_str().unwrap();
        let goal = root().join(case["goal"].as_str().unwrap());
        let mut args = vec!["fit", goal.to_str().unwrap(), "--out", name];
        args.extend(case["flags"].as_array().unwrap().iter().map(|flag| flag.as_str().unwrap()));
        let _ = dir.run(args).ok();
        let summary = std::fs::read(dir.path(name).join("summary.json")).unwrap();
        let mut found: Map<String, Value> = serde_json::from_slice(&summary).unwrap();
        for key in OF_THE_PROGRAM {
            assert!(found.remove(key).is_some(), "{name}: {key}");
        }
        let found = without_times(&found);

        // The flags are these options.
        let options: pleach::FitOptions = serde_json::from_value(case["options"].clone()).unwrap();
        assert_eq!(found["options"], serde_json::to_value(options.spelled_out()).unwrap(), "{name}");
        if bless {
            case["report"] = Value::Object(found);
            continue;
        }
        let expected = case["report"].as_object().unwrap();
        assert_eq!(
            found.keys().collect::<Vec<_>>(),
            expected.keys().collect::<Vec<_>>(),
            "{name}: other keys"
        );
        for (key, value) in expected {
            assert_eq!(found[key], *value, "{name}: {key}");
        }
    }
    if bless {
        std::fs::write(&path, serde_json::to_string_pretty(&known).unwrap() + "\n").unwrap();
    }
}
