//! Colours as mixtures of normal distributions: what a tree has, and what is around it.
//!
//! Components are the clusters of k-means (Lloyd, "Least squares quantization in PCM", 1982) with their
//! weights and covariances, and a colour is as likely as its likeliest component makes it, as in Rother,
//! Kolmogorov and Blake, "GrabCut" (2004), section 3.

use super::oklab::Oklab;
use pleach_plant::math;

/// Colours that a mixture is fitted to; more do not change it.
const MAX_SAMPLES: usize = 4_000;
/// Rounds of k-means.
const ROUNDS: usize = 12;
/// Clusters of fewer colours are left out.
const MIN_CLUSTER: usize = 8;
/// Least spread of a component, in Oklab: what the eye can just tell.
const MIN_SPREAD: f64 = 0.02;

/// A mixture of normal distributions of colours.
pub(super) struct Mixture {
    components: Vec<Component>,
}

struct Component {
    mean: [f64; 3],
    /// Upper triangle of the inverse of the covariance: the diagonal, then 01, 02 and 12.
    inverse: [f64; 6],
    /// Logarithm of the weight over the root of the covariance's determinant.
    log_weight: f64,
}

impl Mixture {
    /// The mixture of up to `components` distributions for some colours; `None` if there are too few.
    pub(super) fn fit(colors: &[Oklab], components: usize) -> Option<Self> {
        let stride = colors.len().div_ceil(MAX_SAMPLES).max(1);
        let colors: Vec<[f64; 3]> = colors.iter().step_by(stride).map(|c| c.map(f64::from)).collect();
        let clusters = clusters(&colors, components)?;
        let fitted = |cluster: &Vec<[f64; 3]>| {
            let part = cluster.len() as f64 / colors.len() as f64;
            (cluster.len() >= MIN_CLUSTER).then(|| Component::fit(cluster, part))
        };
        let components: Vec<Component> = clusters.iter().filter_map(fitted).collect();
        (!components.is_empty()).then_some(Self { components })
    }

    /// Logarithm of how likely a colour is, up to a constant.
    pub(super) fn log_likelihood(&self, color: Oklab) -> f64 {
        let color = color.map(f64::from);
        self.components.iter().map(|c| c.log_likelihood(color)).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The colours in clusters, the first guess evenly over their lightness.
fn clusters(colors: &[[f64; 3]], count: usize) -> Option<Vec<Vec<[f64; 3]>>> {
    let mut sorted = colors.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let at = |i: usize| sorted.get((2 * i + 1) * sorted.len() / (2 * count)).copied();
    let mut centers: Vec<[f64; 3]> = (0..count).map(at).collect::<Option<_>>()?;
    let mut clusters = Vec::new();
    for _ in 0..ROUNDS {
        clusters = vec![Vec::new(); count];
        for &color in colors {
            let far = |center: &[f64; 3]| (0..3).map(|i| math::powi(color[i] - center[i], 2)).sum::<f64>();
            let nearest = (0..count).min_by(|&a, &b| far(&centers[a]).total_cmp(&far(&centers[b])))?;
            clusters[nearest].push(color);
        }
        for (center, cluster) in centers.iter_mut().zip(&clusters).filter(|(_, c)| !c.is_empty()) {
            *center = mean(cluster);
        }
    }
    Some(clusters)
}

fn mean(colors: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|i| colors.iter().map(|c| c[i]).sum::<f64>() / colors.len() as f64)
}

impl Component {
    fn fit(cluster: &[[f64; 3]], part: f64) -> Self {
        let mean = mean(cluster);
        let moment = |i: usize, j: usize| {
            let sum: f64 = cluster.iter().map(|c| (c[i] - mean[i]) * (c[j] - mean[j])).sum();
            sum / cluster.len() as f64 + if i == j { MIN_SPREAD * MIN_SPREAD } else { 0.0 }
        };
        let [a, b, c] = [0, 1, 2].map(|i| moment(i, i));
        let (d, e, f) = (moment(0, 1), moment(0, 2), moment(1, 2));
        let determinant = a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e);
        let inverse =
            [b * c - f * f, a * c - e * e, a * b - d * d, e * f - c * d, d * f - b * e, d * e - a * f];
        Self {
            mean,
            inverse: inverse.map(|v| v / determinant),
            log_weight: math::ln(part) - 0.5 * math::ln(determinant),
        }
    }

    fn log_likelihood(&self, color: [f64; 3]) -> f64 {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|i| color[i] - self.mean[i]);
        let [xx, yy, zz, xy, xz, yz] = self.inverse;
        let squares = xx * x * x + yy * y * y + zz * z * z;
        self.log_weight - 0.5 * squares - (xy * x * y + xz * x * z + yz * y * z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_likeliest_in_their_own_mixture() {
        let spread = |i: u32, salt: u32| ((i * 37 + salt * 11) % 23) as f32 / 230.0;
        let of = |centers: [[f32; 3]; 2]| -> Vec<Oklab> {
            (0..400)
                .map(|i| {
                    let [l, a, b] = centers[i as usize % 2];
                    [l + spread(i, 1), a + spread(i, 2), b + spread(i, 3)]
                })
                .collect()
        };
        let (leaves, sky) =
            (of([[0.4, -0.1, 0.1], [0.7, -0.1, 0.1]]), of([[0.8, 0.0, -0.1], [0.95, 0.0, 0.0]]));
        let mixtures = [&leaves, &sky].map(|colors| Mixture::fit(colors, 3).unwrap());
        let is_leaf =
            |color: &&Oklab| mixtures[0].log_likelihood(**color) > mixtures[1].log_likelihood(**color);
        assert_eq!(leaves.iter().filter(is_leaf).count(), 400);
        assert_eq!(sky.iter().filter(is_leaf).count(), 0);
        assert!(Mixture::fit(&leaves[..5], 3).is_none() && Mixture::fit(&[], 3).is_none());
    }

    #[test]
    fn a_component_is_a_normal_distribution() {
        let cluster: Vec<[f64; 3]> = (0..8)
            .map(|i| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)].map(|v| 0.2 * v))
            .collect();
        let component = Component::fit(&cluster, 1.0);
        let variance = 0.01 + MIN_SPREAD * MIN_SPREAD;
        let at = |x: f64| component.log_likelihood([0.1 + x, 0.1, 0.1]);
        assert!((at(0.0) - at(0.3) - 0.09 / (2.0 * variance)).abs() < 1e-9);
        assert!((at(0.0) + 1.5 * variance.ln()).abs() < 1e-9);
    }
}
