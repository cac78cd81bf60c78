//! Closed surfaces within the surface.

use super::stitch::Surface;
use glam::{DVec3, Vec3};

impl Surface {
    /// Without the walls of hollows: where twigs close around some air, it is invisible, and a printer would
    /// have to.
    pub(super) fn without_hollows(self) -> Self {
        let shells = Shells::new(self.corners.len(), &self.triangles);
        if shells.count() < 2 {
            return self;
        }
        // Six times the volume within each shell, by the divergence theorem; hollows face inwards.
        let mut volumes = vec![0.0; self.corners.len()];
        for t in &self.triangles {
            let shell = shells.of[t[0] as usize] as usize;
            let [a, b, c] = t.map(|i| (self.corners[i as usize] - self.corners[shell]).as_dvec3());
            volumes[shell] += a.dot(DVec3::cross(b, c));
        }
        let stays = |i: u32| volumes[shells.of[i as usize] as usize] > 0.0;
        let mut numbers = vec![0; self.corners.len()];
        let mut corners: Vec<Vec3> = Vec::with_capacity(self.corners.len());
        for (i, corner) in self.corners.iter().enumerate() {
            numbers[i] = corners.len() as u32;
            if stays(i as u32) {
                corners.push(*corner);
            }
        }
        let kept = self.triangles.iter().filter(|t| stays(t[0]));
        Self { triangles: kept.map(|t| t.map(|i| numbers[i as usize])).collect(), corners }
    }
}

/// Which corners hang together.
pub(super) struct Shells {
    /// The first corner of each corner's shell.
    of: Vec<u32>,
}

impl Shells {
    pub(super) fn new(corners: usize, triangles: &[[u32; 3]]) -> Self {
        let mut of: Vec<u32> = (0..corners as u32).collect();
        fn first(of: &mut [u32], mut i: u32) -> u32 {
            while of[i as usize] != i {
                of[i as usize] = of[of[i as usize] as usize];
                i = of[i as usize];
            }
            i
        }
        for &[a, b, c] in triangles {
            for (a, b) in [(a, b), (b, c)] {
                let (a, b) = (first(&mut of, a), first(&mut of, b));
                of[a.max(b) as usize] = a.min(b);
            }
        }
        // Each corner points to a lower one of its shell, whose first corner is known by then.
        for i in 0..of.len() {
            of[i] = of[of[i] as usize];
        }
        Self { of }
    }

    /// Number of shells; a vertex without a face is one.
    pub(super) fn count(&self) -> usize {
        self.of.iter().enumerate().filter(|(i, first)| **first == *i as u32).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of eight corners around `at`, inside out if its half side is negative.
    fn cube(at: Vec3, half: f32) -> Surface {
        let corner = |i: u32| {
            let side = |bit: u32| if i >> bit & 1 == 1 { half } else { -half };
            at + Vec3::new(side(0), side(1), side(2))
        };
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let halves = |q: [u32; 4]| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]];
        Surface {
            corners: (0..8).map(corner).collect(),
            triangles: quads.into_iter().flat_map(halves).collect(),
        }
    }

    fn both(a: Surface, b: Surface) -> Surface {
        let shift = a.corners.len() as u32;
        let moved = b.triangles.into_iter().map(|t| t.map(|i| i + shift));
        Surface {
            triangles: a.triangles.into_iter().chain(moved).collect(),
            corners: [a.corners, b.corners].concat(),
        }
    }

    #[test]
    fn hollows_go_and_islands_stay() {
        let at = Vec3::new(30.0, -20.0, 5.0);
        let solid = || cube(at, 1.0);
        assert_eq!(both(solid(), cube(at, -0.5)).without_hollows(), solid());
        assert_eq!(both(cube(at, -0.5), solid()).without_hollows(), solid());
        let two = || both(solid(), cube(at + 5.0, 1.0));
        assert_eq!(two().without_hollows(), two());
    }
}
