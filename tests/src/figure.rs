//! Log-log figures as SVG: colours that are readable on white and on dark, nothing behind them, lines named at their ends.

use std::fmt::Write;

/// Width and height of a figure, and where its axes lie: left, right, top, bottom.
const SIZE: [f64; 2] = [800.0, 400.0];
const AXES: [f64; 4] = [70.0, 500.0, 58.0, 350.0];
/// Distance between names of lines.
const LEADING: f64 = 18.0;
/// Colour of axes and words.
const INK: &str = "#808a96";

/// A figure with decades along both axes.
#[derive(Clone, Debug)]
pub struct Figure {
    /// What it shows.
    pub title: String,
    /// What stands along the horizontal axis.
    pub across: Axis,
    /// What stands along the vertical axis.
    pub up: Axis,
    /// The lines.
    pub lines: Vec<Line>,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What is measured, and in which unit.
    pub name: String,
    /// How a power of ten is written, by its exponent.
    pub written: fn(i32) -> String,
}

/// A line.
#[derive(Clone, Debug)]
pub struct Line {
    /// What is written at its right end.
    pub name: String,
    /// Its colour, as CSS writes it.
    pub colour: &'static str,
    /// Whether it is dashed.
    pub dashed: bool,
    /// Its points from left to right, above zero.
    pub points: Vec<[f64; 2]>,
}

/// Exponents of the first and the last power of ten along an axis, and where on the page these lie.
#[derive(Clone, Copy)]
struct Decades {
    exponents: [i32; 2],
    ends: [f64; 2],
}

impl Decades {
    /// The decades that hold these numbers, but for what lies less than a tenth beyond a power of ten.
    fn around(numbers: impl Iterator<Item = f64> + Clone, ends: [f64; 2]) -> Self {
        let (low, high) = (numbers.clone().fold(f64::INFINITY, f64::min), numbers.fold(0.0, f64::max));
        let (low, high) = ((low * 1.1).log10().floor() as i32, (high / 1.1).log10().ceil() as i32);
        Self { exponents: [low, high.max(low + 1)], ends }
    }

    fn place(self, number: f64) -> f64 {
        let ([low, high], [from, to]) = (self.exponents.map(f64::from), self.ends);
        from + (to - from) * (number.log10() - low) / (high - low)
    }

    fn ticks(self) -> impl Iterator<Item = (i32, f64)> {
        let [low, high] = self.exponents;
        (low..=high).map(move |exponent| (exponent, self.place(10_f64.powi(exponent))))
    }
}

impl Figure {
    /// The figure as the text of an SVG file; it needs a line with a point.
    pub fn to_svg(&self) -> String {
        let [left, right, top, bottom] = AXES;
        let numbers = |axis: usize| self.lines.iter().flat_map(|line| &line.points).map(move |point| point[axis]);
        let (across, up) = (Decades::around(numbers(0), [left, right]), Decades::around(numbers(1), [bottom, top]));
        let names = [
            text(10.0, 20.0, "start", INK, &self.title),
            text(10.0, top - 14.0, "start", INK, &self.up.name),
            text(0.5 * (left + right), bottom + 40.0, "middle", INK, &self.across.name),
        ];
        let mut svg = names.concat();
        for (exponent, x) in across.ticks() {
            svg += &rule([x, x], [top, bottom]);
            svg += &text(x, bottom + 18.0, "middle", INK, &(self.across.written)(exponent));
        }
        for (exponent, y) in up.ticks() {
            svg += &rule([left, right], [y, y]);
            svg += &text(left - 8.0, y + 4.0, "end", INK, &(self.up.written)(exponent));
        }
        for (line, name_y) in self.lines.iter().zip(self.name_places(up)) {
            svg += &line.drawn(across, up, name_y);
        }
        let [width, height] = SIZE;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"system-ui, sans-serif\" font-size=\"13\" role=\"img\">\n{svg}</svg>\n"
        )
    }

    /// Where names stand: level with the ends of their lines, moved apart as far as they must be.
    fn name_places(&self, up: Decades) -> Vec<f64> {
        let ends = self.lines.iter().map(|line| line.points.last().map_or(0.0, |end| up.place(end[1])));
        let mut places: Vec<(usize, f64)> = ends.enumerate().collect();
        places.sort_by(|one, other| one.1.total_cmp(&other.1));
        for _ in 0..100 {
            for k in 1..places.len() {
                let missing = (LEADING - (places[k].1 - places[k - 1].1)).max(0.0);
                places[k - 1].1 -= 0.5 * missing;
                places[k].1 += 0.5 * missing;
            }
        }
        places.sort_by_key(|place| place.0);
        places.into_iter().map(|(_, y)| y).collect()
    }
}

impl Line {
    fn drawn(&self, across: Decades, up: Decades, name_y: f64) -> String {
        let places: Vec<[f64; 2]> = self.points.iter().map(|&[x, y]| [across.place(x), up.place(y)]).collect();
        let Some(&[x, y]) = places.last() else { return String::new() };
        let (colour, dashes) = (self.colour, if self.dashed { " stroke-dasharray=\"6 4\"" } else { "" });
        let mut svg = String::new();
        let path = places.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ");
        let _ =
            writeln!(svg, "<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{dashes}/>");
        for [x, y] in places {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>");
        }
        let _ = writeln!(
            svg,
            "<line x1=\"{:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{name_y:.1}\" stroke=\"{colour}\" stroke-opacity=\"0.5\"/>",
            x + 5.0,
            x + 18.0
        );
        svg + &text(x + 22.0, name_y + 4.0, "start", colour, &self.name)
    }
}

fn rule([x1, x2]: [f64; 2], [y1, y2]: [f64; 2]) -> String {
    format!(
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{INK}\" stroke-opacity=\"0.3\"/>\n"
    )
}

fn text(x: f64, y: f64, anchor: &str, colour: &str, words: &str) -> String {
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"{colour}\">{}</text>\n", escaped(words))
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;")
}

/// A power of ten as a number: 10³.
pub fn number(exponent: i32) -> String {
    let digit = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    exponent.to_string().chars().fold("10".to_owned(), |text, c| text + &String::from(digit(c)))
}

/// A power of ten as a time in seconds: 100 µs.
pub fn seconds(exponent: i32) -> String {
    let zeros = |exponent: i32| "1".to_owned() + &"0".repeat(exponent as usize);
    match exponent {
        -9..=-7 => zeros(exponent + 9) + " ns",
        -6..=-4 => zeros(exponent + 6) + " µs",
        -3..=-1 => zeros(exponent + 3) + " ms",
        0..=3 => zeros(exponent) + " s",
        _ => number(exponent) + " s",
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Decades, Figure, LEADING, Line, number, seconds};

    #[test]
    fn powers_of_ten_stand_at_even_distances_and_are_written_with_their_unit() {
        let decades = Decades::around([970.0, 5e4, 1.05e6].into_iter(), [0.0, 300.0]);
        let places: Vec<(i32, f64)> = decades.ticks().collect();
        assert_eq!(places.len(), 4);
        for (k, (exponent, place)) in (0..).zip(places) {
            assert!(exponent == 3 + k && (place - 100.0 * f64::from(k)).abs() < 1e-9, "10^{exponent} at {place}");
        }
        assert_eq!([number(3), number(-12)], ["10³", "10⁻¹²"]);
        assert_eq!([seconds(-6), seconds(-1), seconds(2), seconds(4)], ["1 µs", "100 ms", "100 s", "10⁴ s"]);
    }

    #[test]
    fn names_of_lines_that_end_together_are_told_apart() {
        let line =
            |y: f64| Line { name: "l".into(), colour: "red", dashed: false, points: vec![[1.0, 1.0], [10.0, y]] };
        let axis = || Axis { name: "a".into(), written: number };
        let lines = vec![line(10.0), line(10.5), line(10.2), line(1000.0)];
        let figure = Figure { title: "t".into(), across: axis(), up: axis(), lines };
        let mut places = figure.name_places(Decades { exponents: [0, 3], ends: [300.0, 0.0] });
        assert!(places[1] < places[2] && places[2] < places[0], "in the order of their ends: {places:?}");
        places.sort_by(f64::total_cmp);
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] > LEADING - 0.01), "{places:?}");
    }
}
