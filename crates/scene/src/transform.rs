//! Where a node is: its transform in binary64.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};
use serde::Deserialize;

/// How far from one the length of a rotation may be, as rounding to few digits leaves it.
const UNIT: f64 = 1e-3;

/// The transform of a node as the file gives it, and where its instances are.
#[derive(Default, Deserialize)]
pub(crate) struct Placement {
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
    extensions: Option<Extensions>,
}

#[derive(Deserialize)]
struct Extensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    instancing: Option<Instancing>,
}

#[derive(Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, usize>,
}

impl Placement {
    /// The transform from the node to its parent, or what is wrong with it.
    pub fn local(&self) -> Result<DAffine3, String> {
        let parts = self.translation.is_some() || self.rotation.is_some() || self.scale.is_some();
        let local = match self.matrix {
            Some(_) if parts => return Err("has a matrix beside a translation, rotation or scale".into()),
            Some(columns) => from_matrix(&DMat4::from_cols_array(&columns))?,
            None => from_parts(
                self.translation.unwrap_or_default().into(),
                self.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]).into(),
                self.scale.unwrap_or([1.0; 3]).into(),
            )?,
        };
        if local.is_finite() { Ok(local) } else { Err("has a transform that is not finite".into()) }
    }

    /// Accessors of `EXT_mesh_gpu_instancing` by attribute; `None` for a node that stands once.
    pub fn instancing(&self) -> Option<&BTreeMap<String, usize>> {
        let instancing = self.extensions.as_ref()?.instancing.as_ref()?;
        Some(&instancing.attributes)
    }
}

fn from_matrix(matrix: &DMat4) -> Result<DAffine3, String> {
    if matrix.row(3) != DVec4::W {
        return Err("has a matrix whose last row is not 0, 0, 0, 1".into());
    }
    Ok(DAffine3::from_mat4(*matrix))
}

/// Scales, then rotates, then translates: x ↦ R (s ∘ x) + t.
pub(crate) fn from_parts(translation: DVec3, rotation: DVec4, scale: DVec3) -> Result<DAffine3, String> {
    let length = rotation.length();
    let off = (length - 1.0).abs();
    if off.is_nan() || off > UNIT {
        return Err(format!("has a rotation of length {length} where a unit quaternion is due"));
    }
    let matrix3 = rotation_matrix(rotation) * DMat3::from_diagonal(scale);
    Ok(DAffine3 { matrix3, translation })
}

/// The rotation of a quaternion (x, y, z, w) of any length. Dividing by the squared length, instead of normalising
/// first, leaves quarter turns exact: with x = w, both 1 − 2x²/|q|² = 0 and 2xw/|q|² = 1 hold in floating point.
fn rotation_matrix(q: DVec4) -> DMat3 {
    let [x, y, z, w] = q.to_array();
    let squared = q.length_squared();
    let entry = |a: f64| 2.0 * a / squared;
    DMat3::from_cols(
        DVec3::new(1.0 - entry(y * y + z * z), entry(x * y + z * w), entry(x * z - y * w)),
        DVec3::new(entry(x * y - z * w), 1.0 - entry(x * x + z * z), entry(y * z + x * w)),
        DVec3::new(entry(x * z + y * w), entry(y * z - x * w), 1.0 - entry(x * x + y * y)),
    )
}

/// A normal of the surface that `matrix` makes: its inverse transpose, here cofactors and the determinant's sign,
/// applied and brought to unit length; `None` where that has no direction.
pub(crate) fn carry_normal(matrix: &DMat3, normal: DVec3) -> Option<DVec3> {
    let DMat3 { x_axis: x, y_axis: y, z_axis: z } = *matrix;
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    (cofactors * normal * matrix.determinant().signum()).try_normalize()
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3, DVec4};

    use super::{carry_normal, from_parts, rotation_matrix};

    #[test]
    fn quarter_turns_are_exact() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let turn = rotation_matrix(DVec4::new(half, 0.0, 0.0, half));
        assert_eq!(turn, DMat3::from_cols(DVec3::X, DVec3::Z, -DVec3::Y));
    }

    #[test]
    fn parts_apply_scale_then_rotation_then_translation() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let about_z = DVec4::new(0.0, 0.0, half, half);
        let local = from_parts(DVec3::new(10.0, 0.0, 0.0), about_z, DVec3::new(2.0, 3.0, 4.0));
        let carried = local.map(|local| local.transform_point3(DVec3::ONE));
        assert_eq!(carried, Ok(DVec3::new(7.0, 2.0, 4.0)));
    }

    #[test]
    fn rotations_that_are_none_are_refused() {
        for rotation in [DVec4::ZERO, DVec4::splat(1.0), DVec4::NAN] {
            assert!(from_parts(DVec3::ZERO, rotation, DVec3::ONE).is_err());
        }
    }

    #[test]
    fn normals_stay_perpendicular_and_follow_mirrors() {
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Z);
        let normal = carry_normal(&shear, DVec3::X);
        assert_eq!(normal, Some(DVec3::new(1.0, -1.0, 0.0).normalize()));
        let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
        assert_eq!(carry_normal(&mirror, DVec3::Y), Some(DVec3::Y));
        assert_eq!(carry_normal(&DMat3::ZERO, DVec3::Y), None);
    }
}
