//! The language of declarations, on a small space of its own.

use super::*;
use proptest::prelude::*;
use std::sync::Arc;

/// One parameter of each kind and shape; the last is declared while the program runs.
fn space() -> Arc<ParamSpace> {
    let owned = String::from("made");
    let params = vec![
        Param::scalar("height", Kind::real(0.1, 90.0), 3.0).search([(1.0, 30.0)]).scale([Scale::Log]),
        Param::list("branches", "level", Kind::integer(0, 500), [1.0, 30.0, 4.0])
            .search([(1.0, 3.0), (5.0, 200.0), (0.0, 9.0)])
            .scale([Scale::Count])
            .effect([Effect::Plain, Effect::Layout, Effect::Layout])
            .group("counts"),
        Param::vector("pull", Kind::real(-2.0, 2.0), [0.0, 0.0, 0.5]).neutral(0.0),
        Param::scalar("shape", Kind::choice(1, ["cone", "ball"]), 2.0),
        Param::scalar("turn", Kind::flagged(360.0, "the other way"), -10.0).plausible([(-90.0, 90.0)]),
        Param::scalar(format!("{owned}_here"), Kind::flagged_integer(7, owned.clone()), 0.0)
            .group(owned.clone())
            .doc(format!("{owned} while running"))
            .source(owned),
    ];
    Arc::new(ParamSpace::new(params).unwrap())
}

/// Values of all sorts, the hostile among them.
fn any_value() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -500.0..500.0_f64, (-20_i32..600).prop_map(f64::from)]
}

#[test]
fn slots_follow_the_declarations() {
    let space = space();
    let names: Vec<String> = space.slots().map(|slot| space.slot_name(slot)).collect();
    assert_eq!(
        names,
        [
            "height",
            "branches[0]",
            "branches[1]",
            "branches[2]",
            "pull.x",
            "pull.y",
            "pull.z",
            "shape",
            "turn",
            "made_here"
        ]
    );
    assert_eq!((space.len(), space.defaults().len()), (10, 10));
    for (number, param) in space.params().iter().enumerate() {
        assert_eq!(space.find(&param.name).map(|(found, _)| found), Some(number));
        for (index, slot) in space.slots_of(number).enumerate() {
            assert_eq!(space.info(slot), SlotInfo { param: number, index });
            assert_eq!(space.default_of(slot), space.defaults()[slot.index()]);
        }
    }
}

#[test]
fn what_is_said_for_each_slot_or_for_all_is_found() {
    let space = space();
    let slot = |name: &str| space.select(name).unwrap()[0];
    assert_eq!(space.search_range(slot("branches[1]")), (5.0, 200.0));
    assert_eq!(space.search_range(slot("pull.y")), (-2.0, 2.0), "the allowed range where nothing is said");
    assert_eq!(space.plausible_range(slot("turn")), (-90.0, 90.0));
    assert_eq!(space.plausible_range(slot("height")), (1.0, 30.0), "the search range where nothing is said");
    assert_eq!(space.scale_of(slot("branches[2]")), Scale::Count);
    assert_eq!(space.effect_of(slot("branches[0]")), Effect::Plain);
    assert_eq!(space.effect_of(slot("branches[2]")), Effect::Layout);
    assert_eq!(space.scale_of(slot("turn")), Scale::Linear);
}

#[test]
fn sizes_are_declared_and_not_guessed_from_units() {
    let length = |name: &'static str| Param::scalar(name, Kind::real(0.0, 9.0), 1.0).unit(Unit::Meters);
    let ratio = |name: &'static str| Param::scalar(name, Kind::real(0.0, 9.0), 1.0);
    let space = ParamSpace::new(vec![
        length("height").effect([Effect::Size]),
        length("height_v").effect([Effect::SizeJitter]),
        length("sampling distance"),
        ratio("part_v").effect([Effect::SizeJitter]),
        ratio("step").effect([Effect::Size]),
    ])
    .unwrap();
    let names = |slots: Vec<Slot>| -> Vec<String> { slots.into_iter().map(|s| space.slot_name(s)).collect() };
    assert_eq!(names(space.sizes().collect()), ["height", "height_v", "step"]);
    assert_eq!(names(space.size_jitters().collect()), ["height_v", "part_v"]);
}

#[test]
fn contradictions_are_told() {
    let real = || Param::scalar("a", Kind::real(0.0, 1.0), 0.5);
    let list = || Param::list("a", "level", Kind::real(0.0, 1.0), [0.5; 3]);
    let fault = |param: Param| ParamSpace::new(vec![param]).map(|_| ()).unwrap_err().fault;
    let not_allowed = |what, value| Fault::NotAllowed { what, value };
    let bad = |what, low, high| Fault::BadRange { what, low, high };
    assert_eq!(fault(Param::list("a", "level", Kind::real(0.0, 1.0), [])), Fault::Empty);
    assert_eq!(fault(Param::scalar("a", Kind::choice(1, [""; 0]), 1.0)), Fault::Empty);
    assert_eq!(fault(Param::scalar("a", Kind::real(0.0, 1.0), 2.0)), not_allowed("default", 2.0));
    assert_eq!(fault(Param::scalar("a", Kind::real(1.0, 0.0), 0.5)), bad("kind", 1.0, 0.0));
    assert_eq!(fault(real().search([(0.5, 1.5)])), not_allowed("search", 1.5));
    assert_eq!(fault(real().search([(0.5, 0.4)])), bad("search", 0.5, 0.4));
    assert_eq!(fault(real().search([(0.0, 0.5)]).plausible([(0.0, 0.6)])), bad("plausible", 0.0, 0.6));
    assert_eq!(fault(real().scale([Scale::Log])), Fault::NotPositive { low: 0.0 });
    assert_eq!(fault(real().neutral(-1.0)), not_allowed("neutral", -1.0));
    assert_eq!(fault(real().breakpoints([0.5, 0.5])), Fault::Breakpoints);
    assert_eq!(fault(Param::scalar("a", Kind::integer(0, 9), 1.0).breakpoints([2.0])), Fault::Breakpoints);
    let never_zero = Param::scalar("a", Kind::real(1.0, 2.0), 1.0);
    assert_eq!(fault(never_zero.effect([Effect::SizeJitter])), not_allowed("effect", 0.0));
    let wrong = |what, found| Fault::WrongLength { what, expected: 3, found };
    assert_eq!(fault(list().search([(0.0, 1.0); 2])), wrong("search", 2));
    assert_eq!(fault(list().scale([Scale::Linear; 4])), wrong("scale", 4));
    assert_eq!(fault(list().effect([])), wrong("effect", 0));
    assert_eq!(fault(list().handle(3, Handle::Height)), wrong("handle", 4));
    let twice = ParamSpace::new(vec![real(), list()]).unwrap_err();
    assert_eq!(twice.to_string(), "the parameter `a` is declared twice");
}

#[test]
fn checked_values_belong_to_their_space() {
    let one = space();
    let params = one.check(one.defaults()).unwrap();
    assert_eq!(params.values_in(&one), Ok(one.defaults().as_slice()));
    assert!(params.values_in(&space()).is_ok(), "an equal space, made again");
    let other = Arc::new(ParamSpace::new(vec![Param::scalar("a", Kind::real(0.0, 1.0), 0.5)]).unwrap());
    assert_eq!(params.values_in(&other), Err(ForeignParams));
    // As many values, and yet not the same.
    let mut declared = one.params().to_vec();
    declared[0] = declared[0].clone().doc("something else");
    let similar = Arc::new(ParamSpace::new(declared).unwrap());
    assert_eq!(params.values_in(&similar), Err(ForeignParams));
    assert_ne!(params, similar.check(one.defaults()).unwrap());
}

#[test]
fn values_that_are_not_allowed_leave_the_old_ones() {
    let space = space();
    let mut params = space.check(space.defaults()).unwrap();
    let before = params.clone();
    let mut values = space.defaults();
    values[2] = 501.0;
    let error = params.set(&values).unwrap_err();
    assert_eq!(error.slot, "branches[1]");
    assert_eq!(error.problem, Problem::OutOfRange { value: 501.0, min: 0.0, max: 500.0 });
    assert_eq!(params, before);
    values[2] = 2.5;
    assert_eq!(params.set(&values).unwrap_err().problem, Problem::NotWhole { value: 2.5 });
    assert_eq!(
        params.set(&values[1..]).unwrap_err().problem,
        Problem::WrongLength { expected: 10, found: 9 }
    );
    values[2] = 400.0;
    assert_eq!(params.set(&values), Ok(()));
    assert_eq!(params.list(1), [1.0, 400.0, 4.0]);
}

proptest! {
    #[test]
    fn repaired_values_are_allowed_and_allowed_values_stay(value in any_value(), index in 0_usize..10) {
        let (space, slot) = (space(), Slot::new(index));
        let repaired = space.kind_of(slot).repair(value);
        prop_assert_eq!(space.check_slot(slot, repaired), Ok(()));
        prop_assert_eq!(space.kind_of(slot).repair(repaired), repaired);
        prop_assert_eq!(space.check_slot(slot, value).is_ok(), value == repaired);
    }

    #[test]
    fn any_list_can_be_repaired(mut values in proptest::collection::vec(any_value(), 10)) {
        let space = space();
        space.repair(&mut values);
        prop_assert!(space.check(values).is_ok());
    }

    #[test]
    fn every_slot_is_selected_by_its_names(index in 0_usize..10) {
        let (space, slot) = (space(), Slot::new(index));
        prop_assert_eq!(space.select(&space.slot_name(slot)), Ok(vec![slot]));
        let (param, place) = (space.param_of(slot), space.info(slot));
        prop_assert!(space.select(&param.name).unwrap().contains(&slot));
        prop_assert!(space.select(&param.group).unwrap().contains(&slot));
        let by_level = space.select(&format!("level:{}", place.index));
        let is_by_level = matches!(&param.shape, Shape::List { index, .. } if index == "level");
        prop_assert_eq!(by_level.is_ok_and(|slots| slots.contains(&slot)), is_by_level);
    }

    #[test]
    fn any_pattern_selects_or_is_told(pattern in ".{0,20}") {
        let space = space();
        match space.select(&pattern) {
            Ok(slots) => prop_assert!(!slots.is_empty()),
            Err(problem) => prop_assert!(problem.to_string().contains("Groups are other, counts, made")),
        }
    }
}
