//! Directions and frames.

use glam::DVec3;
use twoforms_geometry::frame::Frame;
use twoforms_geometry::vector::{Direction, Vector};

use crate::draws::Draws;

fn length(v: Vector<f32>) -> f64 {
    DVec3::from_array(v.to_array().map(f64::from)).length()
}

#[test]
fn directions_are_unit() {
    let mut draws = Draws::new(800);
    for k in 0..1_000_000 {
        let cos = if k % 4 == 0 { draws.unit_f32().powi(8) } else { draws.unit_f32() };
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        let polar = Direction::polar(cos, sin, draws.unit_f32()).vector();
        assert!((length(polar) - 1.0).abs() < 2e-7, "{polar:?} has length {}", length(polar));
        let v = Vector::from(draws.in_cube().as_vec3().to_array());
        let of = Direction::of(v, 1.0 / v.length()).vector();
        assert!((length(of) - 1.0).abs() < 2e-7, "{of:?} has length {}", length(of));
    }
}

#[test]
fn azimuths_fall_where_they_should() {
    for (turns, expected) in
        [(0.0, [1.0, 0.0]), (0.25, [0.0, 1.0]), (0.5, [-1.0, 0.0]), (0.75, [0.0, -1.0]), (1.0, [1.0, 0.0])]
    {
        let [x, y, z] = Direction::polar(0.6_f32, 0.8, turns).vector().to_array();
        assert_eq!(([x, y], z), (expected.map(|c: f32| c * 0.8), 0.6), "{turns} turns");
    }
}

#[test]
fn frames_carry_there_and_back() {
    let mut draws = Draws::new(801);
    for k in 0..100_000 {
        let tilt = 10.0_f64.powi(-(k % 17));
        let n_x = match k % 3 {
            0 => draws.direction(),
            1 => (DVec3::NEG_Z + draws.in_cube() * tilt).normalize(),
            _ => (DVec3::Z + draws.in_cube() * tilt).normalize(),
        };
        let frame = Frame::new(draws.in_cube() * 100.0, n_x);
        let p = draws.in_cube() * 100.0;
        let local = frame.localize(p);
        assert!((frame.x() + frame.to_world(local) - p).length() < 1e-12);
        assert!((local.length() - (p - frame.x()).length()).abs() < 1e-12);
        assert!((local.z - n_x.dot(p - frame.x())).abs() < 1e-12);
        assert_eq!(frame.n_x(), n_x);
    }
}
