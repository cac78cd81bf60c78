use super::*;
use crate::view::Projection;
use pleach_tree::{Growth, Stem};

/// Every other stem of a tree, with its leaves.
fn halves(tree: &Tree) -> [Tree; 2] {
    [0, 1].map(|half| {
        let is_in = |stem: u32| stem % 2 == half;
        let own = |leaf: &&Leaf| is_in(leaf.stem);
        let stems = tree.stems.iter().zip(0..).filter(|(_, index)| is_in(*index));
        Tree {
            stems: stems.map(|(stem, _)| Stem { parent: None, ..*stem }).collect(),
            leaves: tree.leaves.iter().filter(own).copied().collect(),
            blossoms: tree.blossoms.iter().filter(own).copied().collect(),
            ..tree.clone()
        }
    })
}

fn layers(tree: &Tree, view: &View, frame: &Frame) -> [Layer; 2] {
    let mut painter = LayerPainter::new(view, frame, Detail::Half);
    halves(tree).map(|half| {
        let mut layer = Layer::default();
        painter.draw(&half, Parts::LEAFY, &mut layer);
        layer
    })
}

fn stacked(layers: &[&Layer], frame: &Frame) -> Stack {
    let mut stack = Stack::new(frame, Detail::Half);
    layers.iter().for_each(|layer| stack.add(layer));
    stack
}

fn picture(stack: &Stack) -> Bitmap {
    let mut picture = Bitmap::default();
    stack.picture(&mut picture);
    picture
}

fn grown(name: &str, seed: u64) -> Tree {
    let species = pleach_generators::preset(name).unwrap();
    let growth = Growth { parallel: true, ..Growth::seed(seed) };
    species.grow_with(&growth).unwrap()
}

/// Trees with leaves, blossoms and blobs, whole, cut off by the frame, from the side and from above, from near by.
fn cases() -> Vec<(Tree, View, Frame)> {
    let near = Projection::Perspective { distance: 60.0 };
    let views = [View::FRONT, View::degrees(37.0, 20.0), View { projection: near, ..View::FRONT }];
    let mut cases = Vec::new();
    for name in ["acer", "hill_cherry", "palm", "stylised_oak"] {
        for view in views {
            let tree = grown(name, 3);
            let frame = Frame::automatic(&tree, &view, Parts::LEAFY, 96, 80);
            let near = Frame { meters_per_pixel: frame.meters_per_pixel / 2.0, axis_column: 90.0, ..frame };
            cases.extend([(tree.clone(), view, frame), (tree, view, near)]);
        }
    }
    cases
}

#[test]
fn the_parts_of_a_tree_over_each_other_are_its_picture() {
    for (tree, view, frame) in cases() {
        let mut whole = Bitmap::default();
        Rasterizer::with_detail(Detail::Half).draw(&tree, &view, &frame, Parts::LEAFY, &mut whole);
        let [a, b] = layers(&tree, &view, &frame);
        let stack = stacked(&[&a, &b], &frame);
        // Leaves of nearly one size in a row share an outline, and their rows are others in halves.
        let off = picture(&stack).differing(&whole);
        assert!(off <= whole.ink() / 100, "{off} of {} pixels", whole.ink());
    }
}

#[test]
fn layers_come_and_go() {
    for (tree, view, frame) in cases() {
        let [a, b] = layers(&tree, &view, &frame);
        let other = grown("lombardy_poplar", 5);
        let [c, d] = layers(&other, &view, &frame);
        let mut stack = stacked(&[&a, &b, &c, &a, &d], &frame);
        let expected = picture(&stacked(&[&a, &b, &d], &frame));
        let (mut tried, before) = (picture(&stack), picture(&stack));
        stack.remove(&c);
        stack.remove(&a);
        assert!(picture(&stack) == expected);
        // What a trial shows is what the exchange then has, and nothing has been exchanged by it.
        stack.add(&c);
        stack.add(&a);
        stack.exchanged(&c, &b, &mut tried);
        assert!(picture(&stack) == before);
        stack.remove(&c);
        stack.add(&b);
        assert!(picture(&stack) == tried);
    }
}

#[test]
fn nothing_is_left_over_from_layer_to_layer() {
    let cases = cases();
    for pair in cases.chunks(2) {
        let (tree, view, frame) = &pair[0];
        let mut painter = LayerPainter::new(view, frame, Detail::Half);
        let (mut first, mut again) = (Layer::default(), Layer::default());
        painter.draw(tree, Parts::LEAFY, &mut first);
        painter.draw(&pair[1].0, Parts::STEMS, &mut again);
        painter.draw(tree, Parts::LEAFY, &mut again);
        assert!(first == again && !first.is_empty());
        painter.draw(&Tree::default(), Parts::LEAFY, &mut again);
        assert!(again.is_empty());
    }
}

/// Frames of odd widths, whose last word is not full.
#[test]
fn pictures_may_be_of_any_width() {
    let tree = grown("acer", 1);
    for width in [1, 7, 63, 65, 130] {
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, width, 50);
        let [a, b] = layers(&tree, &View::FRONT, &frame);
        let mut whole = Bitmap::default();
        Rasterizer::with_detail(Detail::Half).draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut whole);
        let off = picture(&stacked(&[&a, &b], &frame)).differing(&whole);
        assert!(off <= 1 + whole.ink() / 50, "{width}: {off} pixels");
    }
}

/// What is hidden need not be drawn: the picture is the same.
#[test]
fn an_exchange_shows_the_same_with_and_without_a_layer() {
    for (tree, view, frame) in cases() {
        let [a, b] = layers(&tree, &view, &frame);
        let [other, _] = halves(&grown("lombardy_poplar", 5));
        let mut painter = LayerPainter::new(&view, &frame, Detail::Half);
        let mut c = Layer::default();
        painter.draw(&other, Parts::LEAFY, &mut c);
        let stack = stacked(&[&a, &b], &frame);
        for (old, new, tree) in [(&a, &c, &other), (&b, &c, &other), (&a, &a, &halves(&tree)[0])] {
            let (mut with, mut without) = (picture(&stack), picture(&stack));
            stack.exchanged(old, new, &mut with);
            painter.exchanged(tree, Parts::LEAFY, &stack, old, &mut without);
            assert!(with == without);
        }
        let mut again = Layer::default();
        painter.draw(&other, Parts::LEAFY, &mut again);
        assert!(again == c, "nothing is left over");
    }
}
