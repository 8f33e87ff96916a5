//! From the root of the tree to a target.

use twoforms_geometry::frame::Frame;
use twoforms_geometry::real::{Mask, Real, Word};
use twoforms_geometry::vector::{Vector, round};

use super::Tree;
use super::row::{self, CHILD, ROW};
use crate::selection::Picked;

/// The tree at one x.
#[derive(Clone, Copy, Debug)]
pub struct Walk<'t> {
    tree: &'t Tree,
    /// x relative to the tree's origin, and N_x, in world axes.
    x: [f32; 3],
    n_x: [f32; 3],
}

/// A node: its row, its first leaf, how many leaves it has, and how many words pick one of them (0 for all 2³²).
struct Node<R: Real> {
    row: R::Word,
    first: R::Word,
    leaves: R::Word,
    words: R::Word,
}

const ALL_WORDS: f64 = 4_294_967_296.0;

impl<'t> Walk<'t> {
    /// The tree from the origin of `frame`.
    pub fn new(tree: &'t Tree, frame: &Frame) -> Self {
        Self { tree, x: round(frame.x() - tree.origin), n_x: round(frame.n_x()) }
    }

    /// The target that a random word picks, with what is left of the word.
    #[inline(never)]
    pub fn pick<R: Real>(self, word: R::Word) -> Picked<R> {
        R::apart(
            #[inline(always)]
            || {
                let (mut node, mut word) = (self.root::<R>(), word);
                while inner(&node).any() {
                    let (left, right) = self.children(&node);
                    let to_left = R::below(word, left.words);
                    word = choose::<R>(inner(&node), to_left, [word, word, word.wrapping_sub(left.words)]);
                    node = step(&node, to_left, &left, &right);
                }
                let target = self.target::<R>(node.first);
                let u = (R::from_word(word) + R::splat(0.5)) / count::<R>(node.words);
                Picked { piece: target, u, density: self.density_of(node.words, target) }
            },
        )
    }

    /// The probability of picking a target, over its area.
    #[inline(never)]
    pub fn density<R: Real>(self, target: R::Word) -> R {
        R::apart(
            #[inline(always)]
            || {
                let place = R::gather_word(
                    target,
                    #[inline(always)]
                    |k| self.tree.place[k as usize],
                );
                let mut node = self.root::<R>();
                while inner(&node).any() {
                    let (left, right) = self.children(&node);
                    node = step(&node, R::below(place, right.first), &left, &right);
                }
                self.density_of(node.words, target)
            },
        )
    }

    /// The probability of each target.
    pub fn probabilities(self) -> Vec<f64> {
        let mut probabilities = vec![0.0; self.tree.order.len()];
        self.hand_out(&self.root::<f32>(), &mut probabilities);
        probabilities
    }

    fn hand_out(&self, node: &Node<f32>, probabilities: &mut [f64]) {
        if node.leaves > 1 {
            let (left, right) = self.children(node);
            self.hand_out(&left, probabilities);
            self.hand_out(&right, probabilities);
        } else {
            let words = if node.words == 0 { ALL_WORDS } else { f64::from(node.words) };
            probabilities[self.tree.order[node.first as usize] as usize] = words / ALL_WORDS;
        }
    }

    #[inline(always)]
    fn root<R: Real>(&self) -> Node<R> {
        let word = R::Word::splat;
        Node { row: word(0), first: word(0), leaves: word(self.tree.order.len() as u32), words: word(0) }
    }

    /// The children of nodes; of leaves anything. Each target below a child has a word, and what words there are beyond those are
    /// shared in proportion to what the children may give.
    #[inline(always)]
    fn children<R: Real>(&self, node: &Node<R>) -> (Node<R>, Node<R>) {
        let row: [R; ROW] = R::gather(
            node.row,
            #[inline(always)]
            |k| &self.tree.rows[k as usize],
        );
        let leaves = R::gather_word(
            node.row,
            #[inline(always)]
            |k| self.tree.left[k as usize],
        );
        let spare = node.words.wrapping_sub(node.leaves);
        let (_, shared) = R::each(
            R::Mask::splat(true),
            spare,
            [self.share(&row)],
            #[inline(always)]
            |spare, [share]| Some((f64::from(spare) * f64::from(share)) as u32),
        );
        let words = leaves.wrapping_add(shared);
        let next = node.row.wrapping_add(R::Word::splat(1));
        let left = Node { row: next, first: node.first, leaves, words };
        let right = Node {
            row: node.row.wrapping_add(leaves),
            first: node.first.wrapping_add(leaves),
            leaves: node.leaves.wrapping_sub(leaves),
            words: node.words.wrapping_sub(words),
        };
        (left, right)
    }

    /// The share of the left child in what both may give; half of nothing.
    #[inline(always)]
    fn share<R: Real>(&self, row: &[R; ROW]) -> R {
        let (mut left, mut right) = ([R::zero(); CHILD], [R::zero(); CHILD]);
        left.copy_from_slice(&row[..CHILD]);
        right.copy_from_slice(&row[CHILD..]);
        let (x, n_x) = (Vector::splat(self.x), Vector::splat(self.n_x));
        let left = row::importance(&left, x, n_x);
        let both = left + row::importance(&right, x, n_x);
        let some = R::zero().lt(both) & both.lt(R::splat(f32::INFINITY));
        R::select(some, left / both, R::splat(0.5))
    }

    #[inline(always)]
    fn target<R: Real>(&self, place: R::Word) -> R::Word {
        R::gather_word(
            place,
            #[inline(always)]
            |k| self.tree.order[k as usize],
        )
    }

    #[inline(always)]
    fn density_of<R: Real>(&self, words: R::Word, target: R::Word) -> R {
        let [per_area] = R::gather(
            target,
            #[inline(always)]
            |k| [self.tree.per_area[k as usize]],
        );
        count::<R>(words) * R::splat((1.0 / ALL_WORDS) as f32) * per_area
    }
}

/// Which nodes have children.
#[inline(always)]
fn inner<R: Real>(node: &Node<R>) -> R::Mask {
    R::below(R::Word::splat(1), node.leaves)
}

/// To the left child or to the right; leaves stay, at a row that there is.
#[inline(always)]
fn step<R: Real>(node: &Node<R>, to_left: R::Mask, left: &Node<R>, right: &Node<R>) -> Node<R> {
    let inner = inner(node);
    let leaves = choose::<R>(inner, to_left, [node.leaves, left.leaves, right.leaves]);
    let row = choose::<R>(inner, to_left, [node.row, left.row, right.row]);
    Node {
        row: R::select_word(R::below(R::Word::splat(1), leaves), row, R::Word::splat(0)),
        first: choose::<R>(inner, to_left, [node.first, left.first, right.first]),
        leaves,
        words: choose::<R>(inner, to_left, [node.words, left.words, right.words]),
    }
}

#[inline(always)]
fn choose<R: Real>(inner: R::Mask, to_left: R::Mask, [stay, left, right]: [R::Word; 3]) -> R::Word {
    R::select_word(inner, R::select_word(to_left, left, right), stay)
}

/// So many words as a number; zero stands for all.
#[inline(always)]
fn count<R: Real>(words: R::Word) -> R {
    R::select(R::same(words, R::Word::splat(0)), R::splat(ALL_WORDS as f32), R::from_word(words))
}
