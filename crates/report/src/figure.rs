//! Figures of lines as SVG: colours that are readable on white and on dark, nothing behind them, lines named beside their ends.

use std::fmt::Write;

/// Width and height of a figure, and where its axes lie: left, right, top, bottom.
const SIZE: [f64; 2] = [800.0, 400.0];
const AXES: [f64; 4] = [70.0, 500.0, 58.0, 350.0];
/// Distance between names of lines.
const LEADING: f64 = 18.0;
/// Colour of axes and words.
const INK: &str = "#808a96";

/// A figure of lines over one axis.
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
    /// How it is divided.
    pub scale: Scale,
}

/// How an axis is divided.
#[derive(Clone, Copy, Debug)]
pub enum Scale {
    /// By powers of ten, written so by their exponent.
    Decades(fn(i32) -> String),
    /// Evenly.
    Even,
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
    /// Whether its points are marked.
    pub marked: bool,
    /// Its points from left to right; above zero along an axis of decades.
    pub points: Vec<[f64; 2]>,
}

/// An axis on the page: its ticks, as numbers and in words, and where the first and the last of them lie.
#[derive(Clone, Debug)]
struct Ruler {
    logarithmic: bool,
    ticks: Vec<(f64, String)>,
    ends: [f64; 2],
}

/// Even ticks, at least.
const TICKS: f64 = 4.0;
/// Decades that have a tick each, at most.
const MOST_DECADES: usize = 9;

impl Ruler {
    fn new(scale: Scale, numbers: impl Iterator<Item = f64> + Clone, ends: [f64; 2]) -> Self {
        match scale {
            Scale::Decades(written) => Self::decades(written, numbers, ends),
            Scale::Even => Self::even(numbers, ends),
        }
    }

    /// The decades that hold these numbers, but for what lies less than a tenth beyond a power of ten; of many each second, third, …
    fn decades(written: fn(i32) -> String, numbers: impl Iterator<Item = f64> + Clone, ends: [f64; 2]) -> Self {
        let (low, high) = range(numbers);
        let (low, high) = ((low * 1.1).log10().floor() as i32, (high / 1.1).log10().ceil() as i32);
        let step = ((high - low) as usize).div_ceil(MOST_DECADES).max(1);
        let first = low.div_euclid(step as i32) * step as i32;
        let exponents = (first..).step_by(step);
        let last = exponents.clone().find(|&exponent| exponent >= high.max(low + 1)).unwrap_or(high);
        let ticks = exponents.take_while(|&exponent| exponent <= last);
        let ticks = ticks.map(|exponent| (10_f64.powi(exponent), written(exponent)));
        Self { logarithmic: true, ticks: ticks.collect(), ends }
    }

    /// Steps of 1, 2 or 5 times a power of ten around these numbers.
    fn even(numbers: impl Iterator<Item = f64> + Clone, ends: [f64; 2]) -> Self {
        let (low, high) = range(numbers);
        let rough = (high - low).max(1e-9 * high.abs()).max(f64::MIN_POSITIVE) / TICKS;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [5.0, 2.0, 1.0].into_iter().map(|k| k * power).find(|&step| step <= rough).unwrap_or(power);
        let (first, last) = ((low / step).floor() as i64, (high / step).ceil() as i64);
        let decimals = (-power.log10().floor()).max(0.0) as usize;
        let tick = |k: i64| (k as f64 * step, format!("{:.decimals$}", k as f64 * step));
        Self { logarithmic: false, ticks: (first..=last.max(first + 1)).map(tick).collect(), ends }
    }

    fn place(&self, number: f64) -> f64 {
        let along = |number: f64| if self.logarithmic { number.log10() } else { number };
        let (low, high) = (along(self.ticks[0].0), along(self.ticks[self.ticks.len() - 1].0));
        let [from, to] = self.ends;
        from + (to - from) * (along(number) - low) / (high - low)
    }
}

/// The least and the largest of some numbers.
fn range(numbers: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    (numbers.clone().fold(f64::INFINITY, f64::min), numbers.fold(f64::NEG_INFINITY, f64::max))
}

impl Figure {
    /// The figure as the text of an SVG file; it needs a line with a point.
    pub fn to_svg(&self) -> String {
        let [left, right, top, bottom] = AXES;
        let numbers = |axis: usize| self.lines.iter().flat_map(|line| &line.points).map(move |point| point[axis]);
        let across = Ruler::new(self.across.scale, numbers(0), [left, right]);
        let up = Ruler::new(self.up.scale, numbers(1), [bottom, top]);
        let names = [
            text(10.0, 20.0, "start", INK, &self.title),
            text(10.0, top - 14.0, "start", INK, &self.up.name),
            text(0.5 * (left + right), bottom + 40.0, "middle", INK, &self.across.name),
        ];
        let mut svg = names.concat();
        for (number, words) in &across.ticks {
            let x = across.place(*number);
            svg += &rule([x, x], [top, bottom]);
            svg += &text(x, bottom + 18.0, "middle", INK, words);
        }
        for (number, words) in &up.ticks {
            let y = up.place(*number);
            svg += &rule([left, right], [y, y]);
            svg += &text(left - 8.0, y + 4.0, "end", INK, words);
        }
        for (line, name_y) in self.lines.iter().zip(self.name_places(&up)) {
            svg += &line.drawn(&across, &up, name_y);
        }
        let [width, height] = SIZE;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"system-ui, sans-serif\" font-size=\"13\" role=\"img\">\n{svg}</svg>\n"
        )
    }

    /// Where names stand: level with the ends of their lines, moved apart as far as they must be.
    fn name_places(&self, up: &Ruler) -> Vec<f64> {
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
    fn drawn(&self, across: &Ruler, up: &Ruler, name_y: f64) -> String {
        let places: Vec<[f64; 2]> = self.points.iter().map(|&[x, y]| [across.place(x), up.place(y)]).collect();
        let Some(&[x, y]) = places.last() else { return String::new() };
        let (colour, dashes) = (self.colour, if self.dashed { " stroke-dasharray=\"6 4\"" } else { "" });
        let mut svg = String::new();
        let path = places.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ");
        let _ =
            writeln!(svg, "<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{dashes}/>");
        for [x, y] in places.into_iter().filter(|_| self.marked) {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>");
        }
        let right = across.ends[1];
        let _ = writeln!(
            svg,
            "<polyline points=\"{:.1},{y:.1} {:.1},{y:.1} {:.1},{name_y:.1}\" fill=\"none\" stroke=\"{colour}\" \
             stroke-opacity=\"0.5\"/>",
            x + 5.0,
            right.max(x) + 5.0,
            right.max(x) + 18.0
        );
        svg + &text(right.max(x) + 22.0, name_y + 4.0, "start", colour, &self.name)
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
    use super::{Axis, Figure, LEADING, Line, Ruler, Scale, number, seconds};

    #[test]
    fn powers_of_ten_stand_at_even_distances_and_are_written_with_their_unit() {
        let ruler = Ruler::new(Scale::Decades(number), [970.0, 5e4, 1.05e6].into_iter(), [0.0, 300.0]);
        assert_eq!(ruler.ticks.len(), 4);
        for (k, (tick, words)) in (0..).zip(&ruler.ticks) {
            let place = ruler.place(*tick);
            assert!(*words == number(3 + k) && (place - 100.0 * f64::from(k)).abs() < 1e-9, "{words} at {place}");
        }
        let many = Ruler::new(Scale::Decades(number), [3e-13, 0.1].into_iter(), [0.0, 1.0]);
        let words: Vec<&str> = many.ticks.iter().map(|(_, words)| words.as_str()).collect();
        assert_eq!(words, ["10⁻¹⁴", "10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"]);
        assert_eq!([number(3), number(-12)], ["10³", "10⁻¹²"]);
        assert_eq!([seconds(-6), seconds(-1), seconds(2), seconds(4)], ["1 µs", "100 ms", "100 s", "10⁴ s"]);
    }

    #[test]
    fn even_ticks_are_round_numbers_around_all_others() {
        let words = |numbers: &[f64]| {
            let ruler = Ruler::new(Scale::Even, numbers.iter().copied(), [0.0, 1.0]);
            ruler.ticks.into_iter().map(|(_, words)| words).collect::<Vec<_>>()
        };
        assert_eq!(words(&[1.0, 6.0]), ["1", "2", "3", "4", "5", "6"]);
        assert_eq!(words(&[0.71, 2.74]), ["0.5", "1.0", "1.5", "2.0", "2.5", "3.0"]);
        assert_eq!(words(&[3.0, 3.0]).len(), 2);
    }

    #[test]
    fn names_of_lines_that_end_together_are_told_apart() {
        let line = |y: f64| Line {
            name: "l".into(),
            colour: "red",
            dashed: false,
            marked: true,
            points: vec![[1.0, 1.0], [10.0, y]],
        };
        let axis = || Axis { name: "a".into(), scale: Scale::Decades(number) };
        let lines = vec![line(10.0), line(10.5), line(10.2), line(1000.0)];
        let figure = Figure { title: "t".into(), across: axis(), up: axis(), lines };
        let ruler = Ruler::new(Scale::Decades(number), [1.0, 1000.0].into_iter(), [300.0, 0.0]);
        let mut places = figure.name_places(&ruler);
        assert!(places[1] < places[2] && places[2] < places[0], "in the order of their ends: {places:?}");
        places.sort_by(f64::total_cmp);
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] > LEADING - 0.01), "{places:?}");
    }
}
