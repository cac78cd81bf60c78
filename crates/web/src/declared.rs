//! Declared parameters, for sliders and choices.

use pleach::param::{Kind, Scale};
use pleach::{ParamSpace, Slot};
use serde_json::{Value, json};

/// What is declared of every parameter of `space`.
pub(crate) fn parameters(space: &ParamSpace) -> Value {
    let of = |(number, param): (usize, &pleach::Param)| {
        let slots: Vec<Value> = space.slots_of(number).map(|slot| one(space, slot)).collect();
        let (first, choices) = match &param.kind {
            Kind::Choice { first, names } => (*first, names.iter().map(ToString::to_string).collect()),
            _ => (0, Vec::new()),
        };
        json!({
            "name": param.name,
            "group": param.group,
            "doc": param.doc,
            "source": param.source,
            "unit": param.unit.to_string(),
            "kind": if param.kind.is_choice() { "choice" } else if param.kind.is_whole() { "integer" } else { "real" },
            "choices": choices,
            "first": first,
            "slots": slots,
        })
    };
    space.params().iter().enumerate().map(of).collect()
}

fn one(space: &ParamSpace, slot: Slot) -> Value {
    let (low, high) = space.kind_of(slot).range();
    let bound = |value: f64| value.is_finite().then_some(value);
    json!({
        "slot": space.slot_name(slot),
        "index": slot.index(),
        "range": [bound(low), bound(high)],
        "search": space.search_range(slot),
        "plausible": space.plausible_range(slot),
        "log": space.scale_of(slot) == Scale::Log,
        "default": space.default_of(slot),
    })
}
