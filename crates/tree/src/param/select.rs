//! Choosing several slots by one word.

use super::declaration::{Param, Shape};
use super::error::{Problem, nearest};
use super::space::{ParamSpace, Slot};

impl ParamSpace {
    /// The groups of parameters, in the order in which their first parameters are declared.
    #[must_use]
    pub fn groups(&self) -> Vec<&str> {
        let mut groups: Vec<&str> = Vec::new();
        for param in self.params() {
            if !groups.contains(&param.group.as_ref()) {
                groups.push(&param.group);
            }
        }
        groups
    }

    /// The parameters of one group, in order of declaration.
    pub fn of_group<'a>(&'a self, group: &'a str) -> impl Iterator<Item = &'a Param> {
        self.params().iter().filter(move |param| param.group == group)
    }

    /// What lists are numbered by (`level`) and the length of the longest such list, in order of
    /// declaration: `level:0` and so on are patterns.
    #[must_use]
    pub fn list_indices(&self) -> Vec<(&str, usize)> {
        let mut all: Vec<(&str, usize)> = Vec::new();
        for param in self.params() {
            let Shape::List { len, index } = &param.shape else { continue };
            match all.iter_mut().find(|(word, _)| word == index) {
                Some((_, longest)) => *longest = (*longest).max(*len),
                None => all.push((index, *len)),
            }
        }
        all
    }

    /// The slots that `pattern` names: a slot (`length[1]`), a parameter (`length`), a group
    /// (`leaves`), or `level:N` for index N of every list that is numbered by level.
    ///
    /// # Errors
    /// [`Problem::UnknownPattern`] with the nearest name and all groups.
    pub fn select(&self, pattern: &str) -> Result<Vec<Slot>, Problem> {
        let indexed = pattern.split_once(':').and_then(|(word, n)| Some((word, n.parse::<usize>().ok()?)));
        let chosen: Vec<Slot> = self
            .slots()
            .filter(|&slot| {
                let param = self.param_of(slot);
                let is_indexed = match (&param.shape, indexed) {
                    (Shape::List { index, .. }, Some((word, n))) => {
                        index == word && self.info(slot).index == n
                    }
                    _ => false,
                };
                param.name == pattern
                    || param.group == pattern
                    || self.slot_name(slot) == pattern
                    || is_indexed
            })
            .collect();
        if chosen.is_empty() { Err(self.unknown(pattern)) } else { Ok(chosen) }
    }

    fn unknown(&self, pattern: &str) -> Problem {
        let groups = self.groups();
        let lists = self.list_indices();
        let indexed: Vec<String> =
            lists.iter().flat_map(|&(word, len)| (0..len).map(move |n| format!("{word}:{n}"))).collect();
        let slots: Vec<String> = self.slots().map(|slot| self.slot_name(slot)).collect();
        let names = self.params().iter().map(|param| param.name.as_ref());
        let all = slots.iter().chain(&indexed).map(String::as_str).chain(groups.iter().copied()).chain(names);
        Problem::UnknownPattern {
            nearest: nearest(pattern, all),
            groups: groups.iter().map(|&group| group.to_owned()).collect(),
            lists: lists.into_iter().map(|(word, len)| (word.to_owned(), len)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Kind;
    use super::*;

    fn space() -> ParamSpace {
        let kind = || Kind::real(0.0, 1.0);
        ParamSpace::new(vec![
            Param::scalar("width", kind(), 0.5).group("crown"),
            Param::list("length", "level", kind(), [0.5; 4]).group("stems"),
            Param::vector("pull", kind(), [0.5; 3]).group("stems"),
            Param::scalar("depth", kind(), 0.5).group("crown"),
            Param::list("growth", "year", kind(), [0.5; 2]).group("time"),
            Param::list("bend", "level", kind(), [0.5; 3]).group("stems"),
        ])
        .unwrap()
    }

    #[test]
    fn slots_are_chosen_by_name_group_and_level() {
        let select = |pattern: &str| -> Vec<usize> {
            space().select(pattern).unwrap().into_iter().map(Slot::index).collect()
        };
        assert_eq!(space().groups(), ["crown", "stems", "time"]);
        assert_eq!(select("crown"), [0, 8]);
        assert_eq!(select("length"), [1, 2, 3, 4]);
        assert_eq!((select("length[2]"), select("pull.y")), (vec![3], vec![6]));
        assert_eq!(
            (select("level:2"), select("level:3"), select("year:1")),
            (vec![3, 13], vec![4], vec![10])
        );
    }

    #[test]
    fn what_names_nothing_is_told_what_would() {
        let error = |pattern: &str| space().select(pattern).unwrap_err().to_string();
        let groups = "Groups are crown, stems, time; levels are level:0, level:1, level:2, level:3; \
                      years are year:0, year:1";
        assert_eq!(error("foo"), format!("is not a known name. {groups}"));
        assert_eq!(error("crwn"), format!("is not a known name, did you mean `crown`? {groups}"));
        assert!(error("lenght[1]").contains("did you mean `length[1]`?"), "{}", error("lenght[1]"));
        assert!(error("level:9").contains("did you mean `level:"), "{}", error("level:9"));
    }
}
