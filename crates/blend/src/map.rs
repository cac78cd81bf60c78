//! The map: point → parameters and parameters → point.

use crate::coding::Encoding;
use crate::error::BlendError;
use crate::landmarks::{Landmarks, Weights};
use crate::natural::NaturalNeighbor;
use crate::pca::Pca;
use crate::plane::{Hull, Point};
use pleach_tree::math;
use pleach_tree::{CheckedParams, Slot, Species};

/// The settings of a map.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// How numbers become features.
    ///
    /// [`Encoding::Raw`] gives the dissertation's map: the plain numbers, and of a point only what its
    /// two axes hold, so that not even a species' own dot gives that species.
    pub features: Encoding,
    /// Where the dots stand instead of at their principal components: one point per species. The
    /// layout by looks gives these.
    pub dots: Option<Vec<Point>>,
}

/// A tree species at a point of the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Blend {
    /// Valid parameters.
    pub params: CheckedParams,
    /// How much of which landmark it is made of. For an extrapolated point, those at the nearest place
    /// of the hull.
    pub weights: Weights,
    /// How far outside the hull of the landmarks the point is; 0 inside.
    pub outside: f64,
}

impl Blend {
    /// Whether the point lies outside the hull, so that the tree is extrapolated.
    #[must_use]
    pub fn is_extrapolated(&self) -> bool {
        self.outside > 0.0
    }
}

/// Species as dots on a plane, and a blend for every point of it.
#[derive(Clone, Debug)]
pub struct BlendMap {
    landmarks: Landmarks,
    pca: Pca,
    dots: Vec<Point>,
    natural: NaturalNeighbor,
    by_components: bool,
}

impl BlendMap {
    /// The map of `species`, at least two of one generator.
    ///
    /// # Errors
    /// See [`Landmarks::new`]; [`BlendError::WeightCount`] for the wrong number of dots, and
    /// [`BlendError::NotFinitePoint`] for one that is not finite.
    pub fn new(species: Vec<Species>, settings: Settings) -> Result<Self, BlendError> {
        let landmarks = Landmarks::new(species, settings.features)?;
        let rows: Vec<&[Option<f64>]> = landmarks.codes().iter().map(|c| c.values.as_slice()).collect();
        let pca = Pca::fit(&rows)?;
        let by_components = settings.dots.is_none();
        let dots = match settings.dots {
            Some(dots) if dots.len() != rows.len() => {
                return Err(BlendError::WeightCount { expected: rows.len(), found: dots.len() });
            }
            Some(dots) => dots,
            None => rows
                .iter()
                .map(|row| Point { x: pca.coordinate(0, row), y: pca.coordinate(1, row) })
                .collect(),
        };
        if let Some(&Point { x, y }) = dots.iter().find(|dot| !dot.is_finite()) {
            return Err(BlendError::NotFinitePoint { x, y });
        }
        let natural = NaturalNeighbor::new(&dots);
        Ok(Self { landmarks, pca, dots, natural, by_components })
    }

    /// The species and their features.
    #[must_use]
    pub const fn landmarks(&self) -> &Landmarks {
        &self.landmarks
    }

    /// The principal components of the landmarks' features.
    #[must_use]
    pub const fn pca(&self) -> &Pca {
        &self.pca
    }

    /// Where each landmark stands, in their order.
    #[must_use]
    pub fn dots(&self) -> &[Point] {
        &self.dots
    }

    /// The hull of the dots.
    #[must_use]
    pub const fn hull(&self) -> &Hull {
        self.natural.hull()
    }

    /// The part of the box from `low` to `high` in which landmark number `landmark` is the nearest.
    #[must_use]
    pub fn region(&self, landmark: usize, low: Point, high: Point) -> Vec<Point> {
        self.natural.region(landmark, low, high)
    }

    /// Whether the plane's axes are the first two principal components.
    #[must_use]
    pub const fn is_by_components(&self) -> bool {
        self.by_components
    }

    /// The tree at `point`.
    ///
    /// Inside the hull it is made of the landmarks around, by [natural-neighbour weights](NaturalNeighbor);
    /// on a landmark's dot it is that landmark, bit for bit. Outside, the blend of the nearest place
    /// of the hull is moved along the principal axes, and marked as extrapolated. With
    /// [`Encoding::Raw`] it is the axes' back-projection and nothing else.
    ///
    /// # Errors
    /// [`BlendError::NotFinitePoint`] if a coordinate is not finite.
    pub fn at(&self, point: Point) -> Result<Blend, BlendError> {
        if !point.is_finite() {
            return Err(BlendError::NotFinitePoint { x: point.x, y: point.y });
        }
        let (weights, place) = self.natural.weights(point);
        let params = if self.landmarks.coding().kind() == Encoding::Raw && self.by_components {
            let features: Vec<_> = self.pca.back(&[point.x, point.y]).into_iter().map(Some).collect();
            self.landmarks.decode(&weights, &features, |_| true)
        } else if place.distance > 0.0 && self.by_components {
            self.moved(&weights, point - place.point)
        } else {
            self.landmarks.mix(&weights)
        };
        Ok(Blend { params, weights, outside: place.distance })
    }

    /// The mix by `weights`, moved by `step` of the plane along the axes.
    fn moved(&self, weights: &Weights, step: Point) -> CheckedParams {
        let shift = |f: usize| step.x * self.pca.loading(0, f) + step.y * self.pca.loading(1, f);
        let mut features = self.landmarks.average(weights);
        for (f, feature) in features.iter_mut().enumerate() {
            *feature = feature.map(|value| value + shift(f));
        }
        let moved = |slot: Slot| self.landmarks.coding().features_of(slot).any(|f| shift(f) != 0.0);
        self.landmarks.decode(weights, &features, moved)
    }

    /// The point at which a species stands.
    ///
    /// On the plane of principal components this is their projection, so a landmark's parameters give
    /// its dot. On another layout it is the mean of the dots, those of similar parameters counting
    /// most (Shepard's weights, the fourth power of the inverse distance).
    ///
    /// Numbers that are not active in the species say nothing about it.
    #[must_use]
    pub fn locate(&self, species: &Species) -> Point {
        let code = self.landmarks.coding().encode(species.generator.as_ref(), species.params.values()).values;
        if self.by_components {
            return Point { x: self.pca.coordinate(0, &code), y: self.pca.coordinate(1, &code) };
        }
        let mut mean = Point::default();
        let mut sum = 0.0;
        for (landmark, &dot) in self.landmarks.codes().iter().zip(&self.dots) {
            let distance = distance(&landmark.values, &code);
            if distance == 0.0 {
                return dot;
            }
            let weight = math::powi(distance, -4);
            mean = mean + dot * weight;
            sum += weight;
        }
        mean * (1.0 / sum)
    }

    /// The point `at` of the way from landmark `first` to landmark `second`.
    ///
    /// # Errors
    /// [`BlendError::NotBetween`] outside `0.0..=1.0`.
    pub fn between(&self, first: usize, second: usize, at: f64) -> Result<Point, BlendError> {
        if !(0.0..=1.0).contains(&at) {
            return Err(BlendError::NotBetween { at });
        }
        Ok(self.dots[first].towards(self.dots[second], at))
    }

    /// How far the features of landmark number `landmark` are from what two axes hold of them.
    #[must_use]
    pub fn residual(&self, landmark: usize) -> f64 {
        let code = &self.landmarks.codes()[landmark].values;
        let back = self.pca.back(&[self.pca.coordinate(0, code), self.pca.coordinate(1, code)]);
        let square = |(value, back): (&Option<f64>, &f64)| value.map_or(0.0, |v| math::powi(v - back, 2));
        code.iter().zip(&back).map(square).sum::<f64>().sqrt()
    }

    /// The blend as a species called `name`, ready to grow or to be written.
    #[must_use]
    pub fn species_at(&self, blend: &Blend, name: &str) -> Species {
        self.landmarks.species_of(&blend.weights, blend.params.clone(), name)
    }

    /// The parameters that weigh most on an axis: slot, and the change of its main feature over one
    /// unit of the axis, the heaviest first. The weight of a slot is the length of its part of the
    /// axis.
    #[must_use]
    pub fn top_loadings(&self, axis: usize) -> Vec<Loading> {
        let coding = self.landmarks.coding();
        let mut loadings: Vec<Loading> = self
            .landmarks
            .space()
            .slots()
            .map(|slot| {
                let parts = coding.features_of(slot).map(|f| (f, self.pca.loading(axis, f)));
                let (mut weight, mut main) = (0.0, (coding.features_of(slot).start, 0.0_f64));
                for (feature, loading) in parts {
                    weight += loading * loading;
                    if loading.abs() > main.1.abs() {
                        main = (feature, loading);
                    }
                }
                Loading { slot, weight: weight.sqrt(), feature: main.0, loading: main.1 }
            })
            .collect();
        loadings.sort_by(|a, b| b.weight.total_cmp(&a.weight).then(a.slot.cmp(&b.slot)));
        loadings
    }
}

/// How much a slot has to do with an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loading {
    /// The slot.
    pub slot: Slot,
    /// Length of the slot's part of the axis, 0 to 1; the squares of all slots sum to 1.
    pub weight: f64,
    /// The slot's feature with the largest loading.
    pub feature: usize,
    /// Its loading, with its sign.
    pub loading: f64,
}

/// Distance between two codes: root mean square over the features that both have, times the root of
/// the number of all features, so that codes that share few are comparable to codes that share all.
#[must_use]
pub fn distance(one: &[Option<f64>], two: &[Option<f64>]) -> f64 {
    let both = one.iter().zip(two).filter_map(|(a, b)| Some((*a)? - (*b)?));
    let (sum, count) = both.fold((0.0, 0.0_f64), |(sum, count), d| (sum + d * d, count + 1.0));
    (sum / count.max(1.0) * one.len() as f64).sqrt()
}

#[cfg(test)]
mod tests;
