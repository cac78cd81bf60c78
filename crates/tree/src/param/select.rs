//! Choosing several slots by one word.

use super::declaration::{Layout, Param};
use super::error::{Problem, nearest};
use super::space::ParamSpace;

/// What a pattern for a level begins with: `level:2`.
const LEVEL: &str = "level:";

impl ParamSpace {
    /// The groups of parameters, in the order in which their first parameters are declared.
    #[must_use]
    pub fn groups(&self) -> Vec<&'static str> {
        let mut groups = Vec::new();
        for param in self.params() {
            if !groups.contains(&param.group) {
                groups.push(param.group);
            }
        }
        groups
    }

    /// The parameters of one group, in order of declaration.
    pub fn of_group<'a>(&'a self, group: &'a str) -> impl Iterator<Item = &'a Param> {
        self.params().iter().filter(move |param| param.group == group)
    }

    /// The slots that `pattern` names: a slot (`length[1]`), a parameter (`length`), a group
    /// (`leaves`), or `level:N` for index N of every per-level parameter.
    ///
    /// # Errors
    /// [`Problem::UnknownPattern`] with the nearest name and all groups.
    pub fn select(&self, pattern: &str) -> Result<Vec<usize>, Problem> {
        let level = pattern.strip_prefix(LEVEL).and_then(|n| n.parse::<usize>().ok());
        let chosen: Vec<usize> = (0..self.len())
            .filter(|&slot| {
                let param = self.param_of(slot);
                param.name == pattern
                    || param.group == pattern
                    || self.slot_name(slot) == pattern
                    || (param.layout == Layout::PerLevel && level == Some(self.slots()[slot].index))
            })
            .collect();
        if chosen.is_empty() { Err(self.unknown(pattern)) } else { Ok(chosen) }
    }

    fn unknown(&self, pattern: &str) -> Problem {
        let groups = self.groups();
        let per_level = self.params().iter().any(|param| param.layout == Layout::PerLevel);
        let levels: Vec<String> =
            (0..Layout::PerLevel.len()).filter(|_| per_level).map(|n| format!("{LEVEL}{n}")).collect();
        let slots: Vec<String> = (0..self.len()).map(|slot| self.slot_name(slot)).collect();
        let names = self.params().iter().map(|param| param.name.as_ref());
        let all = slots.iter().chain(&levels).map(String::as_str).chain(groups.iter().copied()).chain(names);
        Problem::UnknownPattern {
            nearest: nearest(pattern, all),
            groups: groups.iter().map(|&group| group.to_owned()).collect(),
            levels,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Kind, Unit};
    use super::*;
    use std::borrow::Cow;

    fn param(name: &'static str, layout: Layout, group: &'static str) -> Param {
        Param {
            name: Cow::Borrowed(name),
            layout,
            kind: Kind::Real { min: 0.0, max: 1.0 },
            search: Cow::Owned(vec![(0.0, 1.0)]),
            unit: Unit::Ratio,
            default: Cow::Owned(vec![0.5; layout.len()]),
            group,
            doc: Cow::Borrowed(""),
            source: "",
        }
    }

    fn space() -> ParamSpace {
        ParamSpace::new(vec![
            param("width", Layout::Scalar, "crown"),
            param("length", Layout::PerLevel, "stems"),
            param("pull", Layout::Vector, "stems"),
            param("depth", Layout::Scalar, "crown"),
        ])
    }

    #[test]
    fn slots_are_chosen_by_name_group_and_level() {
        let select = |pattern: &str| space().select(pattern).unwrap();
        assert_eq!(space().groups(), ["crown", "stems"]);
        assert_eq!(select("crown"), [0, 8]);
        assert_eq!(select("length"), [1, 2, 3, 4]);
        assert_eq!((select("length[2]"), select("level:2"), select("pull.y")), (vec![3], vec![3], vec![6]));
    }

    #[test]
    fn what_names_nothing_is_told_what_would() {
        let error = |pattern: &str| space().select(pattern).unwrap_err().to_string();
        let groups = "Groups are crown, stems; levels are level:0, level:1, level:2, level:3";
        assert_eq!(error("foo"), format!("is not a known name. {groups}"));
        assert_eq!(error("crwn"), format!("is not a known name, did you mean `crown`? {groups}"));
        assert!(error("lenght[1]").contains("did you mean `length[1]`?"), "{}", error("lenght[1]"));
        assert!(error("level:9").contains("did you mean `level:"), "{}", error("level:9"));
    }
}
