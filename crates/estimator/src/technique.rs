//! Techniques: `formulation/density[@selection]`, the list of them, and what each is at one x.

use std::fmt;
use std::str::FromStr;

use twoforms_geometry::real::Real;
use twoforms_geometry::segment::{Segment, SurfacePoint};
use twoforms_geometry::view::{Vantage, View};

use crate::density::{
    AreaOnLights, BilinearCosineOnLights, BrdfOfSurface, CosineHemisphere, Density, LuminanceOnLights,
    ProjectedSolidAngleOnLights, Ready, SolidAngleOnLights, TowardLightsMarginally, TowardPreparedLights,
    UniformHemisphere,
};
use crate::estimator::{Estimator, Single};
use crate::formulation::{Area, Formulation, Hemisphere};
use crate::lights::Lights;
use crate::measure::{Measure, Sample};
use crate::query::Query;
use crate::selection::Selection;
use crate::xi::Xi;

/// One way to draw a sample: which integral, which density, and how a light is picked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Technique {
    /// The integral and the density.
    pub kind: Kind,
    /// How a light is picked; [`Selection::Together`] where none is.
    pub selection: Selection,
}

/// A point of a light that a technique came upon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<R: Real> {
    /// y.
    pub(crate) y: SurfacePoint<R>,
    /// From x to y.
    pub(crate) xy: Segment<R>,
    /// The density of coming upon it, per solid angle.
    pub(crate) pdf: R,
    /// Where it was found: where a point was drawn and x sees it.
    pub(crate) seen: R::Mask,
    /// Where a ray was asked for.
    pub(crate) asked: R::Mask,
}

/// The list of techniques: a line for each, with its formulation, its density's type and its name. `@selection` after the
/// name: it picks a light.
macro_rules! techniques {
    (@selects) => { false };
    (@selects selection) => { true };
    ($($(#[$doc:meta])* $kind:ident: $formulation:ident, $density:ident = $name:literal $(@$selects:ident)?,)*) => {
        /// A formulation and a density of its measure.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Kind {
            $($(#[$doc])* $kind,)*
        }

        impl Kind {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// Its name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$kind => $name),* }
            }

            /// Whether a light is picked, and so a selection can be named.
            pub fn selects(self) -> bool {
                match self { $(Self::$kind => techniques!(@selects $($selects)?)),* }
            }
        }

        /// A technique with what it needs of one scene.
        #[derive(Clone, Debug)]
        pub(crate) enum Prepared {
            $($kind($density),)*
        }

        /// A technique at one x.
        pub(crate) enum Local<'a> {
            $($kind(Single<'a, $formulation, <$density as Ready>::At<'a>>),)*
        }

        impl Technique {
            /// Works out what is needed of a scene, which must have a light.
            pub(crate) fn prepare(self, lights: &Lights) -> Prepared {
                match self.kind { $(Kind::$kind => Prepared::$kind(Ready::prepare(lights, self.selection))),* }
            }
        }

        impl Prepared {
            pub(crate) fn depends_on_x(&self) -> bool {
                match self { $(Self::$kind(density) => density.depends_on_x()),* }
            }

            /// The technique's estimator at x, in its simplest form.
            pub(crate) fn boxed<'a>(&'a self, view: &'a View<'a>, query: &'a Query<'a>) -> Box<dyn Estimator + 'a> {
                match self { $(Self::$kind(density) => density.boxed::<$formulation>(view, query)),* }
            }

            pub(crate) fn at<'a>(&'a self, view: &'a View<'a>, query: &'a Query<'a>) -> Local<'a> {
                match self {
                    $(Self::$kind(density) => {
                        Local::$kind(Single::new(view, query, density.at(view, query)))
                    })*
                }
            }
        }

        impl Local<'_> {
            /// Draws a point of the domain, and finds the point of a light that x sees there.
            #[inline(never)]
            pub(crate) fn find<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Found<R> {
                R::apart(
                    #[inline(always)]
                    || match self { $(Self::$kind(single) => single.find(from, xi)),* },
                )
            }

            /// The density of coming upon y, per solid angle.
            #[inline(never)]
            pub(crate) fn pdf_of<R: Real>(
                &self,
                from: &Vantage<R>,
                y: &SurfacePoint<R>,
                xy: &Segment<R>,
            ) -> R {
                R::apart(
                    #[inline(always)]
                    || match self { $(Self::$kind(single) => single.pdf_of(from, y, xy)),* },
                )
            }
        }
    };
}

techniques! {
    /// p(Ψ) = 1/2π.
    HemisphereUniform: Hemisphere, UniformHemisphere = "hemisphere/uniform",
    /// p(Ψ) = cosθ/π.
    HemisphereCosine: Hemisphere, CosineHemisphere = "hemisphere/cosine",
    /// As the surface reflects: directions mirrored at visible normals of GGX mixed with the cosine; the cosine alone where
    /// f_r is the same for all directions.
    HemisphereBrdf: Hemisphere, BrdfOfSurface = "hemisphere/brdf",
    /// The density of `area/uniform`, the integral over the hemisphere.
    HemisphereTowardLights: Hemisphere, TowardPreparedLights = "hemisphere/toward-lights" @selection,
    /// The same directions with their true density.
    HemisphereTowardLightsMarginal: Hemisphere, TowardLightsMarginally = "hemisphere/toward-lights-marginal" @selection,
    /// Points on the lights, uniform over their area.
    AreaUniform: Area, AreaOnLights = "area/uniform" @selection,
    /// Points on the targets that face x, uniform in solid angle.
    AreaSolidAngle: Area, SolidAngleOnLights = "area/solid-angle" @selection,
    /// Points on what rises above the horizon of the targets that face x, uniform in projected solid angle.
    AreaProjectedSolidAngle: Area, ProjectedSolidAngleOnLights = "area/projected-solid-angle" @selection,
    /// The same targets as by solid angle, times a cosine that is bilinear over each.
    AreaBilinearCosine: Area, BilinearCosineOnLights = "area/bilinear-cosine" @selection,
    /// Points on the lights in proportion to the luminance that they emit, textures included.
    AreaLuminance: Area, LuminanceOnLights = "area/luminance",
}

impl<F: Formulation, D: Density<F::Measure>> Single<'_, F, D> {
    #[inline(always)]
    fn find<R: Real>(&self, from: &Vantage<R>, xi: Xi<R>) -> Found<R> {
        let (Sample { at, pdf }, some) = self.density.sample(from, xi).parts();
        let some = some & from.wanted();
        let (y, seen) = F::seen(&from.only(some), &at).parts();
        let xy = Segment::to(&y);
        let pdf = F::Measure::per_solid_angle(pdf, &xy).value();
        Found { y, xy, pdf, seen: seen & some, asked: some & F::asks(&at) }
    }

    #[inline(always)]
    fn pdf_of<R: Real>(&self, from: &Vantage<R>, y: &SurfacePoint<R>, xy: &Segment<R>) -> R {
        let pdf = self.density.pdf(from, &F::Measure::point(y, xy));
        pdf.map(|pdf| F::Measure::per_solid_angle(pdf, xy).value()).or_zero()
    }
}

impl Technique {
    /// Drawn over all lights together.
    pub const fn of(kind: Kind) -> Self {
        Self { kind, selection: Selection::Together }
    }

    /// All techniques: each kind with every selection it can have.
    pub fn all() -> Vec<Self> {
        let selections = |kind: Kind| if kind.selects() { &Selection::ALL[..] } else { &[Selection::Together] };
        let of = |&kind: &Kind| selections(kind).iter().map(move |&selection| Self { kind, selection });
        Kind::ALL.iter().flat_map(of).collect()
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.kind.name(), self.selection.suffix())
    }
}

impl FromStr for Technique {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::all().into_iter().find(|technique| technique.to_string() == name).ok_or(())
    }
}
