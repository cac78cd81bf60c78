//! A blend in one call.

use crate::coding::Encoding;
use crate::error::BlendError;
use crate::landmarks::Landmarks;
use pleach_tree::Species;

/// A species called `name` between `species`, at least two of one generator, with as much of each as
/// `shares` says: one number for each, 0 or more, in any unit.
///
/// For many blends of the same species make [`Landmarks`] once.
///
/// ```
/// let [aspen, birch] = ["quaking_aspen", "silver_birch"].map(pleach_generators::species);
/// let mixed = pleach_blend::mix(vec![aspen?, birch?], &[0.7, 0.3], "mixed")?;
/// assert!(!mixed.grow(1)?.stems.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// See [`Landmarks::new`] and [`Landmarks::weights`].
pub fn mix(species: Vec<Species>, shares: &[f64], name: &str) -> Result<Species, BlendError> {
    let landmarks = Landmarks::new(species, Encoding::default())?;
    let weights = landmarks.weights(shares)?;
    Ok(landmarks.species_of(&weights, landmarks.mix(&weights), name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_of_one_species_is_that_species_and_half_is_neither() {
        let species = || ["palm", "acer"].map(|name| pleach_generators::preset(name).unwrap()).to_vec();
        let palm = mix(species(), &[2.0, 0.0], "mine").unwrap();
        assert_eq!((palm.params, palm.name.as_str()), (species()[0].params.clone(), "mine"));
        let half = mix(species(), &[1.0, 1.0], "half").unwrap();
        assert!(species().iter().all(|end| end.params != half.params));
        assert!(mix(species(), &[1.0], "one").is_err());
    }
}
