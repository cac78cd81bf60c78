//! The numbers of several species as one row.

use pleach_tree::Species;

/// Every number that one of some species has, by name, and where those of each species go.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Columns {
    /// Names of the columns: those of the first species in its order, then those that the next one adds.
    pub(crate) names: Vec<String>,
    /// For each species, the column of each of its numbers.
    places: Vec<Vec<usize>>,
}

impl Columns {
    pub(crate) fn new(species: &[Species]) -> Self {
        let mut names: Vec<String> = Vec::new();
        let mut places = Vec::new();
        for one in species {
            let place = |name: String| {
                names.iter().position(|known| *known == name).unwrap_or_else(|| {
                    names.push(name);
                    names.len() - 1
                })
            };
            places.push(names_of(one).map(place).collect());
        }
        Self { names, places }
    }

    /// The numbers of a tree of species `index` as a row; NaN where its species has no such number.
    pub(crate) fn row(&self, index: usize, values: &[f64]) -> Vec<f64> {
        let mut row = vec![f64::NAN; self.names.len()];
        for (&place, &value) in self.places[index].iter().zip(values) {
            row[place] = value;
        }
        row
    }
}

/// The names of the numbers of a species, in its order.
pub(crate) fn names_of(species: &Species) -> impl Iterator<Item = String> + '_ {
    let space = species.params.space();
    space.slots().map(|slot| space.slot_name(slot))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_a_place_for_every_number_of_every_species() {
        let species = ["quaking_aspen", "coffey_winter_oak", "palm"]
            .map(|name| pleach_generators::preset(name).unwrap());
        let columns = Columns::new(&species);
        let [aspen, oak, palm] = [0, 1, 2].map(|i| columns.row(i, species[i].params.values()));
        assert_eq!(aspen.len(), columns.names.len());
        let own = species[0].params.values();
        assert_eq!(&aspen[..own.len()], own);
        assert!(aspen[own.len()..].iter().all(|value| value.is_nan()) && aspen.len() > own.len());
        // One generator, one set of columns.
        assert_eq!(&palm[..own.len()], species[2].params.values());
        let column = |name: &str| columns.names.iter().position(|known| known == name).unwrap();
        for (name, &value) in names_of(&species[1]).zip(species[1].params.values()) {
            assert_eq!(oak[column(&name)], value, "{name}");
        }
        assert!(oak[column("g_scale")].is_nan());
    }
}
