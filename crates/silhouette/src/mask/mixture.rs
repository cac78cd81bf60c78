//! Colours as mixtures of normal distributions: what a tree has, and what is around it.
//!
//! Components are the clusters of k-means (Lloyd, "Least squares quantization in PCM", 1982) with their
//! weights and covariances, and a colour is as likely as its likeliest component makes it, as in Rother,
//! Kolmogorov and Blake, "GrabCut" (2004), section 3.

use pleach_plant::math;

/// Colours that a mixture is fitted to; more do not change it.
const MAX_SAMPLES: usize = 4_000;
/// Rounds of k-means.
const ROUNDS: usize = 12;
/// Clusters of fewer colours are left out.
const MIN_CLUSTER: usize = 8;
/// Least spread of a component, in Oklab: what the eye can just tell.
const MIN_SPREAD: f64 = 0.02;

/// A colour, and perhaps where it is seen, in the units of a colour.
pub(super) type Feature<const N: usize> = [f32; N];

/// A mixture of normal distributions of colours.
pub(super) struct Mixture<const N: usize> {
    components: Vec<Component<N>>,
}

struct Component<const N: usize> {
    mean: [f64; N],
    /// Lower triangle of the inverse of the covariance's Cholesky factor.
    whiten: [[f64; N]; N],
    /// Logarithm of the weight over the root of the covariance's determinant.
    log_weight: f64,
}

impl<const N: usize> Mixture<N> {
    /// The mixture of up to `components` distributions for some colours; `None` if there are too few.
    pub(super) fn fit(colors: &[Feature<N>], components: usize) -> Option<Self> {
        let stride = colors.len().div_ceil(MAX_SAMPLES).max(1);
        let colors: Vec<[f64; N]> = colors.iter().step_by(stride).map(|c| c.map(f64::from)).collect();
        let clusters = clusters(&colors, components)?;
        let fitted = |cluster: &Vec<[f64; N]>| {
            let part = cluster.len() as f64 / colors.len() as f64;
            (cluster.len() >= MIN_CLUSTER).then(|| Component::fit(cluster, part))
        };
        let components: Vec<Component<N>> = clusters.iter().filter_map(fitted).collect();
        (!components.is_empty()).then_some(Self { components })
    }

    /// Logarithm of how likely a colour is, up to a constant.
    pub(super) fn log_likelihood(&self, color: Feature<N>) -> f64 {
        let color = color.map(f64::from);
        self.components.iter().map(|c| c.log_likelihood(color)).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The colours in clusters, the first guess evenly over their lightness.
fn clusters<const N: usize>(colors: &[[f64; N]], count: usize) -> Option<Vec<Vec<[f64; N]>>> {
    let mut sorted = colors.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let at = |i: usize| sorted.get((2 * i + 1) * sorted.len() / (2 * count)).copied();
    let mut centers: Vec<[f64; N]> = (0..count).map(at).collect::<Option<_>>()?;
    let mut clusters = Vec::new();
    for _ in 0..ROUNDS {
        clusters = vec![Vec::new(); count];
        for &color in colors {
            let far = |center: &[f64; N]| (0..N).map(|i| math::powi(color[i] - center[i], 2)).sum::<f64>();
            let nearest = (0..count).min_by(|&a, &b| far(&centers[a]).total_cmp(&far(&centers[b])))?;
            clusters[nearest].push(color);
        }
        for (center, cluster) in centers.iter_mut().zip(&clusters).filter(|(_, c)| !c.is_empty()) {
            *center = mean(cluster);
        }
    }
    Some(clusters)
}

fn mean<const N: usize>(colors: &[[f64; N]]) -> [f64; N] {
    std::array::from_fn(|i| colors.iter().map(|c| c[i]).sum::<f64>() / colors.len() as f64)
}

impl<const N: usize> Component<N> {
    fn fit(cluster: &[[f64; N]], part: f64) -> Self {
        let mean = mean(cluster);
        let moment = |i: usize, j: usize| {
            let sum: f64 = cluster.iter().map(|c| (c[i] - mean[i]) * (c[j] - mean[j])).sum();
            sum / cluster.len() as f64 + if i == j { MIN_SPREAD * MIN_SPREAD } else { 0.0 }
        };
        // The Cholesky factor of the covariance, row by row, and its inverse by substitution.
        let mut factor = [[0.0; N]; N];
        let mut whiten = [[0.0; N]; N];
        let mut log_weight = math::ln(part);
        for i in 0..N {
            for j in 0..=i {
                let dot: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                let left = moment(i, j) - dot;
                factor[i][j] = if i == j { left.max(1e-12).sqrt() } else { left / factor[j][j] };
            }
            #[expect(clippy::needless_range_loop, reason = "rows and columns of two matrices")]
            for j in 0..i {
                let dot: f64 = (j..i).map(|k| factor[i][k] * whiten[k][j]).sum();
                whiten[i][j] = -dot / factor[i][i];
            }
            whiten[i][i] = 1.0 / factor[i][i];
            log_weight -= math::ln(factor[i][i]);
        }
        Self { mean, whiten, log_weight }
    }

    fn log_likelihood(&self, color: [f64; N]) -> f64 {
        let away: [f64; N] = std::array::from_fn(|i| color[i] - self.mean[i]);
        let mut squares = 0.0;
        for i in 0..N {
            let along: f64 = self.whiten[i][..=i].iter().zip(away).map(|(w, a)| w * a).sum();
            squares += along * along;
        }
        self.log_weight - 0.5 * squares
    }
}

#[cfg(test)]
mod tests {
    use super::super::oklab::Oklab;
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
        assert!(Mixture::fit(&leaves[..5], 3).is_none() && Mixture::<3>::fit(&[], 3).is_none());
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
