//! Products of domains and of densities: pairs, arrays, and vectors, whose length is known at run time alone.

use crate::density::{Density, Point};
use crate::domain::Domain;

/// Takes the first so many numbers away.
fn take<'x>(xi: &mut &'x [f64], count: usize) -> &'x [f64] {
    let (first, rest) = xi.split_at(count);
    *xi = rest;
    first
}

impl<A: Domain, B: Domain> Domain for (A, B) {
    type Point = (A::Point, B::Point);

    fn dimension(&self) -> usize {
        self.0.dimension() + self.1.dimension()
    }

    fn measure(&self) -> f64 {
        self.0.measure() * self.1.measure()
    }

    fn contains(&self, (x, y): &Self::Point) -> bool {
        self.0.contains(x) && self.1.contains(y)
    }

    fn at(&self, mut xi: &[f64]) -> Self::Point {
        (self.0.at(take(&mut xi, self.0.dimension())), self.1.at(xi))
    }
}

impl<D: Domain, const K: usize> Domain for [D; K] {
    type Point = [D::Point; K];

    fn dimension(&self) -> usize {
        self.iter().map(D::dimension).sum()
    }

    fn measure(&self) -> f64 {
        self.iter().map(D::measure).product()
    }

    fn contains(&self, x: &Self::Point) -> bool {
        self.iter().zip(x).all(|(side, x)| side.contains(x))
    }

    fn at(&self, mut xi: &[f64]) -> Self::Point {
        self.each_ref().map(|side| side.at(take(&mut xi, side.dimension())))
    }
}

impl<D: Domain> Domain for Vec<D> {
    type Point = Vec<D::Point>;

    fn dimension(&self) -> usize {
        self.iter().map(D::dimension).sum()
    }

    fn measure(&self) -> f64 {
        self.iter().map(D::measure).product()
    }

    fn contains(&self, x: &Self::Point) -> bool {
        self.iter().zip(x).all(|(side, x)| side.contains(x))
    }

    fn at(&self, mut xi: &[f64]) -> Self::Point {
        self.iter().map(|side| side.at(take(&mut xi, side.dimension()))).collect()
    }
}

impl<P: Density, Q: Density> Density for (P, Q) {
    type Domain = (P::Domain, Q::Domain);

    fn dimension(&self) -> usize {
        self.0.dimension() + self.1.dimension()
    }

    fn sample(&self, mut xi: &[f64]) -> Point<Self> {
        (self.0.sample(take(&mut xi, self.0.dimension())), self.1.sample(xi))
    }

    fn pdf(&self, (x, y): &Point<Self>) -> f64 {
        self.0.pdf(x) * self.1.pdf(y)
    }
}

impl<P: Density, const K: usize> Density for [P; K] {
    type Domain = [P::Domain; K];

    fn dimension(&self) -> usize {
        self.iter().map(P::dimension).sum()
    }

    fn sample(&self, mut xi: &[f64]) -> Point<Self> {
        self.each_ref().map(|part| part.sample(take(&mut xi, part.dimension())))
    }

    fn pdf(&self, x: &Point<Self>) -> f64 {
        self.iter().zip(x).map(|(part, x)| part.pdf(x)).product()
    }
}

impl<P: Density> Density for Vec<P> {
    type Domain = Vec<P::Domain>;

    fn dimension(&self) -> usize {
        self.iter().map(P::dimension).sum()
    }

    fn sample(&self, mut xi: &[f64]) -> Point<Self> {
        self.iter().map(|part| part.sample(take(&mut xi, part.dimension()))).collect()
    }

    fn pdf(&self, x: &Point<Self>) -> f64 {
        self.iter().zip(x).map(|(part, x)| part.pdf(x)).product()
    }
}
