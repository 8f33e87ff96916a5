//! Random numbers with known moments.

use rand_philox::Philox;

/// A stream of random numbers.
pub struct Stream(Philox);

impl Stream {
    /// The stream `stream` of `seed`.
    pub fn new(seed: u64, stream: u64) -> Self {
        Self(Philox::from_u64_seed_stream(seed, stream))
    }

    /// Uniform in (0, 1).
    pub fn uniform(&mut self) -> f64 {
        ((self.0.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    }

    /// Exponential with mean 1.
    pub fn exponential(&mut self) -> f64 {
        -libm::log(self.uniform())
    }

    /// Standard normal (Box and Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (2.0 * self.exponential()).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.uniform())
    }

    /// Whether an event of probability `p` happens.
    pub fn happens(&mut self, p: f64) -> bool {
        self.uniform() < p
    }

    /// Number of hits in `n` trials of probability `p`, by the gaps between hits.
    pub fn hits(&mut self, n: u64, p: f64) -> u64 {
        let rate = -libm::log1p(-p);
        let (mut hits, mut at) = (0, (self.exponential() / rate).floor());
        while at < n as f64 {
            hits += 1;
            at += 1.0 + (self.exponential() / rate).floor();
        }
        hits
    }

    /// Gamma of shape `a` ≥ 1 and scale 1: the sum of `a` exponentials (Marsaglia and Tsang 2000).
    pub fn gamma(&mut self, a: f64) -> f64 {
        let d = a - 1.0 / 3.0;
        loop {
            let x = self.normal();
            let v = 1.0 + x / (9.0 * d).sqrt();
            let cube = v * v * v;
            if v > 0.0 && libm::log(self.uniform()) < 0.5 * x * x + d - d * cube + d * libm::log(cube) {
                return d * cube;
            }
        }
    }
}

/// A distribution of one replicate's estimate, with its true moments.
pub struct Distribution {
    pub name: String,
    /// σ².
    pub variance: f64,
    /// μ₄/σ⁴.
    pub kurtosis: f64,
    /// Pr(estimate ≠ 0).
    pub non_zero: f64,
    draw: Box<dyn Fn(&mut Stream) -> f64>,
}

impl Distribution {
    /// `replicates` independent estimates.
    pub fn replicates(&self, replicates: usize, stream: &mut Stream) -> Vec<f64> {
        (0..replicates).map(|_| (self.draw)(stream)).collect()
    }

    /// The same times `factor`.
    pub fn scaled(self, factor: f64) -> Self {
        let draw = self.draw;
        Self { variance: self.variance * factor * factor, draw: Box::new(move |s| factor * draw(s)), ..self }
    }
}

pub fn normal() -> Distribution {
    let draw = Box::new(Stream::normal);
    Distribution { name: "normal".into(), variance: 1.0, kurtosis: 3.0, non_zero: 1.0, draw }
}

/// Mean of `n` exponential samples.
pub fn exponential(n: u32) -> Distribution {
    let shape = f64::from(n);
    Distribution {
        name: format!("exponential, N = {n}"),
        variance: 1.0 / shape,
        kurtosis: 3.0 + 6.0 / shape,
        non_zero: 1.0,
        draw: Box::new(move |stream| if n == 1 { stream.exponential() } else { stream.gamma(shape) / shape }),
    }
}

/// Mean of `n` log-normal samples exp(σ Z).
pub fn log_normal(sigma: f64, n: u32) -> Distribution {
    let w = libm::exp(sigma * sigma);
    let excess = w * w * (w * w + 2.0 * w + 3.0) - 6.0;
    Distribution {
        name: format!("log-normal σ = {sigma}, N = {n}"),
        variance: (w - 1.0) * w / f64::from(n),
        kurtosis: 3.0 + excess / f64::from(n),
        non_zero: 1.0,
        draw: Box::new(move |s| (0..n).map(|_| libm::exp(sigma * s.normal())).sum::<f64>() / f64::from(n)),
    }
}

/// What a hit is worth.
#[derive(Clone, Copy, Debug)]
pub enum Worth {
    /// The same each time: two-valued samples.
    One,
    /// Uniform in (0, 1), as a cosine is.
    Uniform,
    /// Exponential: unlike lights, unlike distances.
    Exponential,
}

impl Worth {
    /// Raw moments of order 1 to 4.
    fn moments(self) -> [f64; 4] {
        match self {
            Self::One => [1.0; 4],
            Self::Uniform => [1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0],
            Self::Exponential => [1.0, 2.0, 6.0, 24.0],
        }
    }

    fn draw(self, stream: &mut Stream) -> f64 {
        match self {
            Self::One => 1.0,
            Self::Uniform => stream.uniform(),
            Self::Exponential => stream.exponential(),
        }
    }
}

/// Mean of `n` samples that are hits with probability `p`, else zero.
pub fn hits(worth: Worth, p: f64, n: u64) -> Distribution {
    let [m1, m2, m3, m4] = worth.moments().map(|moment| p * moment);
    let variance = m2 - m1 * m1;
    let fourth = m4 - 4.0 * m1 * m3 + 6.0 * m1 * m1 * m2 - 3.0 * m1 * m1 * m1 * m1;
    Distribution {
        name: format!("hits worth {worth:?}, p = {p}, N = {n}"),
        variance: variance / n as f64,
        kurtosis: 3.0 + (fourth / (variance * variance) - 3.0) / n as f64,
        non_zero: -libm::expm1(n as f64 * libm::log1p(-p)),
        draw: Box::new(move |s| {
            let hits = if n == 1 { u64::from(s.happens(p)) } else { s.hits(n, p) };
            (0..hits).map(|_| worth.draw(s)).sum::<f64>() / n as f64
        }),
    }
}
