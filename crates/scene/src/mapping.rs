//! Mappings: which texture a material shows, by which coordinates.

use glam::{DAffine2, DMat2, DVec2, Vec2};
use gltf::json::texture::Info;

use crate::texture::Texture;

/// A texture of a material: which, by which set of texture coordinates, moved how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping {
    /// Index into the scene's textures.
    pub texture: usize,
    /// The n of `TEXCOORD_n`.
    pub set: u32,
    /// From the coordinates of the set to those of the texture (`KHR_texture_transform`).
    pub transform: DAffine2,
}

impl Mapping {
    /// The mapping that a file describes, of the scene's texture `texture`; `None` where its numbers are not finite.
    pub(crate) fn new(texture: usize, info: &Info) -> Option<Self> {
        let transform = transform(info);
        transform.is_finite().then_some(Self { texture, set: set(info), transform })
    }

    /// Linear red, green, blue and alpha at the point (u, v) of the set.
    pub(crate) fn at(&self, textures: &[Texture], uv: DVec2) -> [f32; 4] {
        textures[self.texture].at(self.transform.transform_point2(uv))
    }
}

/// The set of coordinates that a file's texture asks for.
pub(crate) fn set(info: &Info) -> u32 {
    let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
    transform.and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord)
}

/// (u', v') = offset + R S (u, v): S scales, and R turns counter-clockwise as seen in the image, where v runs down:
/// R = (cos φ, sin φ; −sin φ, cos φ).
fn transform(info: &Info) -> DAffine2 {
    let extensions = info.extensions.as_ref();
    let Some(transform) = extensions.and_then(|extensions| extensions.texture_transform.as_ref()) else {
        return DAffine2::IDENTITY;
    };
    let (sin, cos) = libm::sincos(f64::from(transform.rotation.0));
    let turn = DMat2::from_cols(DVec2::new(cos, -sin), DVec2::new(sin, cos));
    let scale = DMat2::from_diagonal(Vec2::from(transform.scale.0).as_dvec2());
    DAffine2::from_mat2_translation(turn * scale, Vec2::from(transform.offset.0).as_dvec2())
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use gltf::json::texture::Info;
    use serde_json::json;

    use super::Mapping;

    fn moved(transform: &serde_json::Value, uv: [f64; 2]) -> DVec2 {
        let json = json!({"index": 0, "texCoord": 3, "extensions": {"KHR_texture_transform": transform}});
        let info: Info = serde_json::from_value(json).expect("it is right");
        Mapping::new(0, &info).expect("it is finite").transform.transform_point2(uv.into())
    }

    /// The example of the extension's own text: the lower left quadrant, turned.
    #[test]
    fn scales_then_turns_then_moves() {
        let quadrant = json!({"offset": [0, 1], "rotation": std::f64::consts::FRAC_PI_2, "scale": [0.5, 0.5]});
        for (corner, expected) in [([0., 0.], [0., 1.]), ([1., 0.], [0., 0.5]), ([0., 1.], [0.5, 1.])] {
            let found = moved(&quadrant, corner);
            assert!(found.distance(expected.into()) < 1e-7, "{corner:?}: {found}");
        }
        assert_eq!(moved(&json!({"offset": [0, 1], "scale": [1, -1]}), [0.25, 0.125]), DVec2::new(0.25, 0.875));
    }

    #[test]
    fn the_set_may_be_overridden() {
        let json = json!({"index": 0, "texCoord": 3, "extensions": {"KHR_texture_transform": {"texCoord": 1}}});
        let overridden: Info = serde_json::from_value(json).expect("it is right");
        let plain: Info = serde_json::from_value(json!({"index": 0, "texCoord": 3})).expect("it is right");
        assert_eq!([super::set(&overridden), super::set(&plain)], [1, 3]);
    }
}
