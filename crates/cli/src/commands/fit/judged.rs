//! What the assessment of a result says in its species file and in `parameters.csv`.

use pleach_fit::{Assessment, Genome, Identifiability, PROFILE_STEPS};
use pleach_tree::{ParamSpace, Slot};

/// Comments of the species file: what the goal does not show.
pub(super) fn comments(assessment: &Assessment, space: &ParamSpace) -> Vec<String> {
    let sentences = [
        ("One picture shows one size, so no other is grown: 0 are", &assessment.settled),
        ("Not seen in the goal, so as where the search started:", &assessment.put_back),
    ];
    let of = |(start, slots): (&str, &Vec<Slot>)| {
        let names: Vec<String> = slots.iter().map(|&slot| space.slot_name(slot)).collect();
        (!names.is_empty()).then(|| format!("{start} {}.", names.join(", ")))
    };
    sentences.into_iter().filter_map(of).collect()
}

/// Rows of `parameters.csv`, the header first.
pub(super) fn table(assessment: &Assessment, best: &Genome, space: &ParamSpace) -> Vec<Vec<String>> {
    let [small, large] = PROFILE_STEPS.map(|step| format!("{:.0}%", 100.0 * step));
    let header = vec![
        "parameter".to_owned(),
        "value".to_owned(),
        "seen".to_owned(),
        format!("cost_rise_down_{small}"),
        format!("cost_rise_up_{small}"),
        format!("cost_rise_down_{large}"),
        format!("cost_rise_up_{large}"),
    ];
    let rows = assessment.profiles.iter().map(|profile| {
        let seen = match profile.seen {
            Identifiability::Determined => "determined",
            Identifiability::Loosely => "loosely",
            Identifiability::NotSeen => "not-seen",
            Identifiability::NotTried => "not-tried",
        };
        let mut row = vec![
            space.slot_name(profile.slot),
            best.values[profile.slot.index()].to_string(),
            seen.to_owned(),
        ];
        row.extend(profile.rises.iter().flatten().map(|rise| {
            rise.filter(|rise| rise.is_finite()).map_or_else(String::new, |rise| format!("{rise:.5}"))
        }));
        row
    });
    std::iter::once(header).chain(rows).collect()
}
