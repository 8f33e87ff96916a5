//! What a part is made of.

/// A Lambertian surface that may emit.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    /// Diffuse albedo ρ, RGB.
    pub albedo: [f32; 3],
    /// Emitted radiance `L_e`, RGB, the same over the whole part.
    pub radiance: [f32; 3],
    /// Whether it emits from its back too.
    pub double_sided: bool,
}

impl Material {
    /// A surface that reflects and does not emit.
    pub const fn diffuse(albedo: [f32; 3]) -> Self {
        Self { albedo, radiance: [0.0; 3], double_sided: false }
    }

    /// A black surface that emits from its front.
    pub const fn emitting(radiance: [f32; 3]) -> Self {
        Self { albedo: [0.0; 3], radiance, double_sided: false }
    }

    /// The same material, emitting from both sides if it emits.
    pub const fn double_sided(self) -> Self {
        Self { double_sided: true, ..self }
    }

    /// Whether any channel emits.
    pub fn emits(&self) -> bool {
        self.radiance.iter().any(|&l| l > 0.0)
    }

    /// Luminance of the emitted radiance, 0.2126 R + 0.7152 G + 0.0722 B (Rec. 709).
    pub fn luminance(&self) -> f64 {
        let weights = [0.2126, 0.7152, 0.0722];
        self.radiance.iter().zip(weights).map(|(&l, weight)| f64::from(l) * weight).sum()
    }
}
