//! Points on the lights by what they emit.

use std::borrow::Cow;

use glam::DVec3;
use twoforms_geometry::real::Real;
use twoforms_geometry::segment::SurfacePoint;
use twoforms_geometry::view::{Vantage, View};

use super::Ready;
use super::lights::{OnLights, Picking, Spread};
use crate::alone;
use crate::lights::Lights;
use crate::measure::SurfaceArea;
use crate::query::Query;
use crate::selection::{Picker, Piece, Selection};

/// Emitted luminance: Y(y) dA times the sides that emit, Y being the mean luminance over the cell of y. A target that emits
/// by a texture falls into cells of equal area, half a texel long where these are not too many, any other is one cell.
#[derive(Clone, Copy, Debug)]
pub struct ByLuminance<'t> {
    places: &'t Places,
    lights: &'t Lights,
}

/// The cells of all targets.
#[derive(Clone, Debug)]
struct Places {
    /// Each cell in the unit square of its target: its first u, its width in u, its first v, its width in v.
    bounds: Vec<[f32; 4]>,
    targets: Vec<u32>,
    /// Y times sides over each target that is one cell.
    whole: Vec<[f32; 1]>,
}

impl Places {
    fn new(lights: &Lights) -> (Self, Vec<Piece>) {
        let mut places = Self { bounds: Vec::new(), targets: Vec::new(), whole: Vec::new() };
        let mut pieces = Vec::new();
        for target in 0..lights.targets() as u32 {
            let area = lights.areas()[target as usize];
            let value = lights.emitted(target) / area;
            match lights.cells(target) {
                None => places.push(&mut pieces, target, [[0.0, 1.0]; 2], value * area),
                Some(cells) => {
                    for (k, &value) in cells.values().iter().enumerate() {
                        let measure = value * area / cells.values().len() as f64;
                        places.push(&mut pieces, target, cells.bounds(k), measure);
                    }
                }
            }
            places.whole.push([value as f32]);
        }
        // Beyond the last: where nothing is picked.
        places.push(&mut Vec::new(), 0, [[0.0, 1.0]; 2], 0.0);
        (places, pieces)
    }

    fn push(&mut self, pieces: &mut Vec<Piece>, target: u32, [u, v]: [[f64; 2]; 2], measure: f64) {
        pieces.push(Piece { target, measure });
        self.bounds.push([u[0] as f32, (u[1] - u[0]) as f32, v[0] as f32, (v[1] - v[0]) as f32]);
        self.targets.push(target);
    }
}

impl ByLuminance<'_> {
    /// Y times sides at a point of a target in the frame of x.
    fn value(&self, view: &View, target: u32, y: [f32; 3]) -> f32 {
        let (cells, pattern) = (self.lights.cells(target), self.lights.pattern(target));
        let (Some(cells), Some(pattern)) = (cells, pattern) else { return self.places.whole[target as usize][0] };
        let frame = view.frame();
        let y = frame.x() + frame.to_world(DVec3::from_array(y.map(f64::from)));
        cells.value(pattern.coordinates(y)) as f32
    }

    /// The same of a sample by itself.
    #[cold]
    #[inline(never)]
    fn looked_up<R: Real>(self, from: Vantage<R>, y: SurfacePoint<R>) -> R {
        R::apart(
            #[inline(always)]
            || {
                let at = alone::coordinates(from.from_x(y.position));
                R::splat(self.value(from.view(), alone::word::<R>(y.target), at))
            },
        )
    }
}

impl Spread for ByLuminance<'_> {
    #[inline(always)]
    fn point<R: Real>(&self, from: &Vantage<R>, piece: R::Word, [u, v]: [R; 2]) -> SurfacePoint<R> {
        let target = R::gather_word(
            piece,
            #[inline(always)]
            |k| self.places.targets[k as usize],
        );
        let [u0, width, v0, height] = R::gather(
            piece,
            #[inline(always)]
            |k| &self.places.bounds[k as usize],
        );
        from.facet(target).point([u0 + width * u, v0 + height * v], target)
    }

    /// Y times sides.
    #[inline(always)]
    fn per_area<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>) -> R {
        if R::LANES == 1 && self.lights.are_textured() {
            return self.looked_up(*from, *y);
        }
        let [value] = R::gather(
            y.target,
            #[inline(always)]
            |k| &self.places.whole[k as usize],
        );
        value
    }
}

/// `area/luminance`: over all lights together, in proportion to the power that leaves each place, in luminance.
#[derive(Clone, Debug)]
pub struct LuminanceOnLights(Box<Emitting>);

/// All that is worked out for a scene.
#[derive(Clone, Debug)]
struct Emitting {
    places: Places,
    lights: Lights,
    picker: Picker,
}

impl Ready for LuminanceOnLights {
    type Measure = SurfaceArea;
    type At<'a> = OnLights<'a, ByLuminance<'a>>;

    fn prepare(lights: &Lights, selection: Selection) -> Self {
        let (places, pieces) = Places::new(lights);
        let picker = Picker::over(selection, lights, &pieces, Vec::new);
        Self(Box::new(Emitting { places, lights: lights.clone(), picker }))
    }

    fn depends_on_x(&self) -> bool {
        false
    }

    fn at<'a>(&'a self, _: &View, _: &Query) -> OnLights<'a, ByLuminance<'a>> {
        let Emitting { places, lights, picker } = &*self.0;
        OnLights { picking: Picking::Listed(Cow::Borrowed(picker)), spread: ByLuminance { places, lights } }
    }
}
