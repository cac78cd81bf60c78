//! Cards in the place of groups of twigs and leaves.

use super::groups::{Group, Hanging, Hangs};
use crate::foliage::blossom_spread;
use crate::twigs::{MAX_MODELS, Sheet, TwigModel, Twigs};
use glam::{Vec2, Vec3, vec2};
use pleach_plant::{Leaf, Tree};

/// A card for each group, which shows one of at most [`MAX_MODELS`] of them; `numbers` are the level's numbers of the
/// tree's stems.
pub(super) fn twigs(tree: &Tree, hangs: &Hangs<'_>, groups: &[Group], numbers: &[u32]) -> Twigs {
    let mut cards: Vec<Leaf> = groups.iter().map(|group| card(tree, hangs, group)).collect();
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for card in &cards {
        (low, high) = (low.min(middle(card)), high.max(middle(card)));
    }
    let heart = (low + high) / 2.0 - Vec3::Z * (0.25 * (high.z - low.z));
    // Engines turn the normals of a face that is seen from behind. So cards face outwards, as their normals do.
    for card in cards.iter_mut().filter(|card| card.normal().dot(middle(card) - heart) < 0.0) {
        card.across = -card.across;
    }
    let models = choose(&mut cards, |i| hangs.area(&groups[i]));
    let models = models.into_iter().map(|i| model(hangs, &groups[i], cards[i])).collect();
    cards.iter_mut().for_each(|card| card.stem = numbers[card.stem as usize]);
    Twigs { cards, models, first_cell: 0, sheet: Sheet::default(), heart }
}

fn middle(card: &Leaf) -> Vec3 {
    card.position + card.along / 2.0
}

/// The rectangle that covers a group: upright from where the group begins to the middle of it, and across that where it
/// spreads most. Its shape is left open.
fn card(tree: &Tree, hangs: &Hangs<'_>, group: &Group) -> Leaf {
    let mut points = Vec::new();
    hangs.each(group, |what| match what {
        Hanging::Leaf(i) => points.extend(of_leaf(tree, &tree.leaves[i as usize])),
        Hanging::Blossom(i) => points.extend(of_blossom(tree, &tree.blossoms[i as usize])),
        // Only a stretch of a group's own stem is the group's.
        Hanging::Stem(i) if i == group.stem => {}
        Hanging::Stem(i) => {
            let stem = &tree.stems[i as usize];
            points.extend(tree.knots_of(stem).iter().map(|knot| knot.point.as_vec3()));
        }
    });
    let foot = hangs.foot(group);
    let middle = points.iter().sum::<Vec3>() / points.len().max(1) as f32;
    let up = (middle - foot).try_normalize().unwrap_or(Vec3::Z);
    let (side, depth) = (up.any_orthonormal_vector(), up.cross(up.any_orthonormal_vector()));
    let flat = |point: &Vec3| vec2((*point - middle).dot(side), (*point - middle).dot(depth));
    let widest = widest(points.iter().map(flat));
    let across = side * widest.x + depth * widest.y;
    let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    for point in &points {
        let at = vec2((*point - middle).dot(across), (*point - middle).dot(up));
        (low, high) = (low.min(at), high.max(at));
    }
    let size = (high - low).max(Vec2::splat(1e-3));
    Leaf {
        position: middle + across * (low.x + size.x / 2.0) + up * low.y,
        along: up * size.y,
        across: across * size.x,
        stem: group.stem,
        shape: 0,
    }
}

/// The ends and sides of a leaf.
fn of_leaf(tree: &Tree, leaf: &Leaf) -> [Vec3; 4] {
    let side = leaf.across * (tree.outline_of(leaf).width() / 2.0);
    let middle = leaf.position + leaf.along / 2.0;
    [leaf.position, leaf.position + leaf.along, middle - side, middle + side]
}

/// The foot and the rim of a blossom, which opens along its axis.
fn of_blossom(tree: &Tree, blossom: &Leaf) -> [Vec3; 5] {
    let (reach, high) = blossom_spread(tree.blossom_shapes[usize::from(blossom.shape)]);
    let rim = blossom.position + blossom.along * high;
    let (across, depth) = (blossom.across * reach, blossom.normal() * reach);
    [blossom.position, rim - across, rim + across, rim - depth, rim + depth]
}

/// The direction in which points about the origin spread most.
fn widest(points: impl Iterator<Item = Vec2>) -> Vec2 {
    let (mut xx, mut xy, mut yy) = (0.0_f32, 0.0_f32, 0.0_f32);
    for point in points {
        xx += point.x * point.x;
        xy += point.x * point.y;
        yy += point.y * point.y;
    }
    // Half of the angle whose cosine and sine are these.
    let (cos, sin) = (xx - yy, 2.0 * xy);
    let length = (cos * cos + sin * sin).sqrt();
    if length <= 0.0 {
        return Vec2::X;
    }
    let half =
        vec2(((1.0 + cos / length) / 2.0).max(0.0).sqrt(), ((1.0 - cos / length) / 2.0).max(0.0).sqrt());
    if sin < 0.0 { vec2(half.x, -half.y) } else { half }
}

/// Sorts cards into bins of about one size, gives each the number of its bin as its shape, and returns the card of each
/// bin whose content is nearest to the bin's mean.
fn choose(cards: &mut [Leaf], area: impl Fn(usize) -> f32) -> Vec<usize> {
    let bins = (MAX_MODELS as f64).sqrt() as usize;
    let mut order: Vec<usize> = (0..cards.len()).collect();
    order.sort_by(|&a, &b| cards[a].along.length_squared().total_cmp(&cards[b].along.length_squared()));
    let mut models = Vec::new();
    for high in split(&mut order, bins) {
        high.sort_by(|&a, &b| cards[a].across.length_squared().total_cmp(&cards[b].across.length_squared()));
        for alike in split(high, bins) {
            let fill = |i: usize| area(i) / cards[i].unit_area().max(f32::MIN_POSITIVE);
            let mean = alike.iter().map(|&i| fill(i)).sum::<f32>() / alike.len() as f32;
            let off = |i: usize| (fill(i) - mean).abs();
            let Some(model) = alike.iter().copied().min_by(|&a, &b| off(a).total_cmp(&off(b))) else {
                continue;
            };
            alike.iter().for_each(|&i| cards[i].shape = models.len() as u16);
            models.push(model);
        }
    }
    models
}

/// `list` in at most `parts` parts of about the same length, none of them empty.
fn split<T>(list: &mut [T], parts: usize) -> impl Iterator<Item = &mut [T]> {
    let length = list.len().div_ceil(parts).max(1);
    list.chunks_mut(length)
}

fn model(hangs: &Hangs<'_>, group: &Group, card: Leaf) -> TwigModel {
    let mut model = TwigModel { card, stems: Vec::new(), leaves: Vec::new(), blossoms: Vec::new() };
    hangs.each(group, |what| match what {
        Hanging::Stem(i) => model.stems.push(i),
        Hanging::Leaf(i) => model.leaves.push(i),
        Hanging::Blossom(i) => model.blossoms.push(i),
    });
    model
}

#[cfg(test)]
mod tests {
    use super::super::stems::Kept;
    use super::*;
    use crate::settings::MeshSettings;

    #[test]
    fn points_spread_most_along_their_line() {
        for direction in [vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(0.6, 0.8), vec2(0.6, -0.8), vec2(-0.8, 0.6)] {
            let found = widest((-5..=5).map(|i| direction * i as f32));
            assert!(found.dot(direction).abs() > 0.9999, "{direction} {found}");
        }
        assert_eq!(widest(std::iter::empty()), Vec2::X);
    }

    #[test]
    fn cards_cover_their_leaves_and_share_few_models_of_their_size() {
        let tree = pleach_generators::preset("quaking_aspen").unwrap().grow(1).unwrap();
        let kept = Kept::new(&tree, 0.01);
        let hangs = Hangs::new(&tree, &kept, MeshSettings::default());
        let groups = hangs.groups(800);
        let twigs = twigs(&tree, &hangs, &groups, &kept.number);
        assert_eq!((twigs.cards.len(), twigs.models.len()), (groups.len(), MAX_MODELS));
        let stems = kept.stems(&tree).len();
        for (group, card) in groups.iter().zip(&twigs.cards) {
            assert!((card.stem as usize) < stems && usize::from(card.shape) < twigs.models.len());
            let (along, across) = (card.along.normalize(), card.across.normalize());
            assert!(along.dot(across).abs() < 1e-3);
            hangs.each(group, |what| {
                let Hanging::Leaf(i) = what else { return };
                let at = tree.leaves[i as usize].position - card.position;
                assert!((-1e-3..=card.along.length() + 1e-3).contains(&at.dot(along)));
                assert!(at.dot(across).abs() <= card.across.length() / 2.0 + 1e-3);
            });
        }
        // The most of them are nearly of the size of what they show.
        let ratio = |card: &Leaf| card.unit_area() / twigs.models[usize::from(card.shape)].card.unit_area();
        let alike = twigs.cards.iter().filter(|card| (0.5..2.0).contains(&ratio(card))).count();
        assert!(alike * 10 > twigs.cards.len() * 8, "{alike} of {}", twigs.cards.len());
    }
}
