//! The choice of instructions.

use std::fmt;

use fearless_simd::{Level, Simd};

use super::Kernel;
use super::sixteen::Lanes;

/// The instructions that a kernel is run with.
#[derive(Clone, Copy, Debug)]
pub struct Instructions(Choice);

#[derive(Clone, Copy, Debug)]
enum Choice {
    Scalar,
    Lanes(Level),
}

impl Instructions {
    /// One sample after the other: the reference.
    pub const SCALAR: Self = Self(Choice::Scalar);

    /// The best that this machine has.
    pub fn best() -> Self {
        Self(Choice::Lanes(Level::new()))
    }

    /// All that this machine has, the scalar reference first.
    pub fn all() -> Vec<Self> {
        let level = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let lanes =
            [level.as_sse2().map(Level::Sse2), level.as_avx2().map(Level::Avx2), level.as_avx512().map(Level::Avx512)];
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let lanes = [Some(level)];
        let lanes = lanes.into_iter().flatten().map(|level| Self(Choice::Lanes(level)));
        std::iter::once(Self::SCALAR).chain(lanes).collect()
    }

    /// Runs a kernel with these instructions.
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            Choice::Scalar => kernel.run::<f32>(),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(Level::Avx512(simd)) => vectorize(simd, kernel),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(Level::Avx2(simd)) => vectorize(simd, kernel),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(level) => match level.as_sse2() {
                Some(simd) => vectorize(simd, kernel),
                None => kernel.run::<f32>(),
            },
            #[cfg(target_arch = "aarch64")]
            Choice::Lanes(Level::Neon(simd)) => vectorize(simd, kernel),
            #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
            #[allow(unreachable_patterns)]
            Choice::Lanes(_) => kernel.run::<f32>(),
        }
    }
}

/// What they are called: scalar, SSE2, AVX2, AVX-512 or NEON.
impl fmt::Display for Instructions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.0 {
            Choice::Scalar => "scalar",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(Level::Avx512(_)) => "AVX-512",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(Level::Avx2(_)) => "AVX2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Choice::Lanes(level) if level.as_sse2().is_some() => "SSE2",
            #[cfg(target_arch = "aarch64")]
            Choice::Lanes(Level::Neon(_)) => "NEON",
            #[allow(unreachable_patterns)]
            Choice::Lanes(_) => "scalar",
        })
    }
}

/// Runs a kernel with the best instructions of this machine.
pub fn run<K: Kernel>(kernel: K) -> K::Output {
    Instructions::best().run(kernel)
}

fn vectorize<S: Simd, K: Kernel>(simd: S, kernel: K) -> K::Output {
    simd.vectorize(
        #[inline(always)]
        || kernel.run::<Lanes<S>>(),
    )
}

#[cfg(test)]
mod tests {
    use super::Instructions;

    #[test]
    fn instructions_are_told_apart_by_name() {
        let names: Vec<String> = Instructions::all().iter().map(Instructions::to_string).collect();
        assert_eq!(names[0], "scalar");
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
        assert_eq!(Instructions::best().to_string(), names[names.len() - 1]);
    }
}
