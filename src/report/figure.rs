//! Figures as SVG.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::series::DashedLineSeries;

use super::ReportError;
use super::table::escaped_html;

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// A line through the points.
    Line,
    /// A dashed line through the points.
    Dashed,
    /// A thin line through the points, of a band.
    Thin,
    /// A dot at each point.
    Dots,
    /// A small dot at each of many points.
    Points,
    /// An arrow head at the second of two points, seen from the first.
    Arrow,
    /// A bar from zero to each point, so wide in units of the x axis.
    Bars {
        /// Width of a bar.
        width: f64,
    },
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; empty for none, and then drawn in the colour of the series before.
    pub label: String,
    /// How it is drawn.
    pub mark: Mark,
    /// Points (x, y).
    pub points: Vec<(f64, f64)>,
}

/// A pair of axes and its curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    x_label: String,
    y_label: String,
    y_limits: Option<(f64, f64)>,
    equal_axes: bool,
    strip: bool,
    beside: bool,
    rows: Vec<String>,
    series: Vec<Series>,
}

impl Panel {
    /// Empty axes; labels name quantity and unit.
    #[must_use]
    pub fn new(x_label: &str, y_label: &str) -> Self {
        Self {
            x_label: x_label.to_owned(),
            y_label: y_label.to_owned(),
            y_limits: None,
            equal_axes: false,
            strip: false,
            beside: false,
            rows: Vec::new(),
            series: Vec::new(),
        }
    }

    /// The panel with the y axis held to a range instead of spanning the data.
    #[must_use]
    pub fn y_limits(self, from: f64, to: f64) -> Self {
        Self { y_limits: Some((from, to)), ..self }
    }

    /// The panel with equal scales on both axes.
    #[must_use]
    pub fn equal_axes(self) -> Self {
        Self { equal_axes: true, ..self }
    }

    /// A low panel, as suits a signal over time.
    #[must_use]
    pub fn strip(self) -> Self {
        Self { strip: true, ..self }
    }

    /// The panel to the right of the one before, in place of below it.
    #[must_use]
    pub fn beside(self) -> Self {
        Self { beside: true, ..self }
    }

    /// The panel with names in place of numbers at 0, 1, ... of its y axis, the first at the top.
    #[must_use]
    pub fn rows(self, names: impl IntoIterator<Item = String>) -> Self {
        Self { rows: names.into_iter().collect(), ..self }
    }

    /// The panel with a further series.
    #[must_use]
    pub fn with(mut self, label: &str, mark: Mark, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.series.push(Series { label: label.to_owned(), mark, points: points.into_iter().collect() });
        self
    }

    /// The range of a coordinate over all series, with a margin.
    fn range(&self, of: fn(&(f64, f64)) -> f64) -> (f64, f64) {
        let values = self.series.iter().flat_map(|series| series.points.iter().map(of));
        let (from, to) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), v| (from.min(v), to.max(v)));
        let margin = 0.04 * if to > from { to - from } else { 1.0 };
        (from - margin, to + margin)
    }

    fn x_range(&self) -> (f64, f64) {
        let half_bar = |series: &Series| if let Mark::Bars { width } = series.mark { width } else { 0.0 };
        let widest = self.series.iter().map(half_bar).fold(0.0, f64::max);
        let (from, to) = self.range(|point| point.0);
        (from - widest, to + widest)
    }

    /// Both ranges, the shorter axis lengthened where a unit is to be as long on both.
    fn ranges(&self) -> [(f64, f64); 2] {
        let (x, y) = (self.x_range(), self.y_range());
        if !self.equal_axes {
            return [x, y];
        }
        let unit = ((x.1 - x.0) / f64::from(PLOT.0)).max((y.1 - y.0) / f64::from(PLOT.1));
        let wide = |(from, to): (f64, f64), length: u32| {
            let more = 0.5 * (unit * f64::from(length) - (to - from));
            (from - more, to + more)
        };
        [wide(x, PLOT.0), wide(y, PLOT.1)]
    }

    /// With room at the top for the legend.
    #[allow(clippy::cast_precision_loss, reason = "a number of rows")]
    fn y_range(&self) -> (f64, f64) {
        if !self.rows.is_empty() {
            return (self.rows.len() as f64 - 0.4, -0.6);
        }
        let (from, to) = self.range(|point| point.1);
        let from = if self.has_bars() { 0.0 } else { from };
        let entries = self.named().count();
        let legend = if entries > 1 { LEGEND_ENTRY * entries as f64 / f64::from(self.height()) } else { 0.0 };
        self.y_limits.unwrap_or((from, to + (to - from) * legend / (1.0 - legend)))
    }

    /// In pixels; a row of names takes the same height in every figure.
    fn height(&self) -> u32 {
        let rows = u32::try_from(self.rows.len()).unwrap_or(1);
        match rows {
            0 if self.strip => STRIP,
            0 => SIZE.1,
            rows => 2 * MARGIN + BELOW + ROW * (rows + 1),
        }
    }

    fn named(&self) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(|series| !series.label.is_empty())
    }

    fn has_bars(&self) -> bool {
        self.series.iter().any(|series| matches!(series.mark, Mark::Bars { .. }))
    }
}

/// Panels under a title.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Name of its file.
    pub name: &'static str,
    /// Title above the panels.
    pub title: String,
    /// Below the panels on a page: the quantities drawn and the feature to look for.
    pub caption: &'static str,
    /// From top to bottom, but for those [beside](Panel::beside) the one before.
    pub panels: Vec<Panel>,
}

/// Parts of a pixel that are drawn: the library rounds places to whole units, and a curve has finer ones.
const FINE: u32 = 10;
/// Width of a figure and height of a panel, in pixels.
const SIZE: (u32, u32) = (900, 420);
const TITLE_HEIGHT: u32 = 40;
/// Between the upper edge and the title, in pixels.
const ABOVE: u32 = 8;
/// Heights of a low panel and of a row of names.
const STRIP: u32 = 250;
const ROW: u32 = 21;
/// Around the axes of a panel, and for the labels below and beside them, in pixels.
const MARGIN: u32 = 14;
const BELOW: u32 = 52;
const BESIDE: u32 = 72;
/// Room for names in place of numbers.
const BESIDE_NAMES: u32 = 170;
/// Size of the plot area.
const PLOT: (u32, u32) = (SIZE.0 - 2 * MARGIN - BESIDE, SIZE.1 - 2 * MARGIN - BELOW);
/// Height of a legend's entry with its share of the border, in pixels.
const LEGEND_ENTRY: f64 = 30.0;
/// Width of the drawing for each tick of the x axis.
const TICK: usize = px(80) as usize;
const FONT: &str = "sans-serif";

/// A length in pixels, as it is drawn.
const fn px(length: u32) -> u32 {
    length * FINE
}

/// The same where the library wants a sign.
#[allow(clippy::cast_possible_wrap, reason = "lengths of a figure")]
const fn signed(length: u32) -> i32 {
    (length * FINE) as i32
}

/// Colours that people who confuse red and green tell apart (Okabe and Ito).
const PALETTE: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

impl Figure {
    /// The figure as SVG: the same data give the same text.
    ///
    /// # Errors
    /// [`ReportError::Figure`] where a panel has no finite points.
    pub fn svg(&self) -> Result<String, ReportError> {
        let failed = |reason: String| ReportError::Figure { figure: self.name, reason };
        let points = || self.panels.iter().flat_map(|panel| &panel.series).flat_map(|series| &series.points);
        if self.panels.iter().any(|panel| panel.series.iter().all(|series| series.points.is_empty()))
            || !points().all(|point| point.0.is_finite() && point.1.is_finite())
        {
            return Err(failed("a panel without points, or a point that is not finite".to_owned()));
        }
        let mut svg = String::new();
        let axes = self.draw(&mut svg).map_err(|error| failed(error.to_string()))?;
        Ok(self.described(&svg, &axes))
    }

    fn height(&self) -> u32 {
        TITLE_HEIGHT + self.row_heights().sum::<u32>()
    }

    /// Panels side by side.
    fn rows(&self) -> impl Iterator<Item = &[Panel]> {
        self.panels.chunk_by(|_, next| next.beside)
    }

    fn row_heights(&self) -> impl Iterator<Item = u32> {
        self.rows().map(|row| row.iter().map(Panel::height).max().unwrap_or(0))
    }

    /// The drawing in the size of its pixels, with words for who cannot see it, and its axes for who points at it.
    fn described(&self, svg: &str, axes: &[String]) -> String {
        let places = axes.join(";");
        let axes = self.panels.iter().map(|panel| match &*panel.y_label {
            "" => panel.x_label.clone(),
            y_label => format!("{y_label} over {}", panel.x_label),
        });
        let words = format!("{}: {}", self.title, axes.collect::<Vec<_>>().join("; "));
        let (width, height) = (SIZE.0, self.height());
        let drawn = format!(r#"<svg width="{}" height="{}""#, px(width), px(height));
        let shown = format!(
            r#"<svg role="img" aria-label="{}" data-axes="{places}" width="{width}" height="{height}""#,
            escaped_html(&words)
        );
        svg.replacen(&drawn, &shown, 1)
    }

    /// Draws; the answer is each panel's [`Panel::draw`].
    fn draw(&self, svg: &mut String) -> Result<Vec<String>, Box<dyn std::error::Error>> {
        let root = SVGBackend::with_string(svg, (px(SIZE.0), px(self.height()))).into_drawing_area();
        root.fill(&WHITE)?;
        let root = root.margin(px(ABOVE), 0, 0, 0).titled(&self.title, (FONT, px(20)))?;
        let below = self.row_heights().scan(0, |below, height| {
            *below += signed(height);
            Some(*below)
        });
        let areas = root.split_by_breakpoints([] as [i32; 0], below.take(self.rows().count() - 1).collect::<Vec<_>>());
        let areas: Vec<_> = self.rows().zip(&areas).flat_map(|(row, area)| area.split_evenly((1, row.len()))).collect();
        let axes = self.panels.iter().zip(&areas).map(|(panel, area)| panel.draw(area)).collect::<Result<_, _>>()?;
        root.present()?;
        Ok(axes)
    }
}

impl Panel {
    /// Draws; the answer is left, top, right, bottom in the drawing, and the numbers at left, right, bottom, top, with commas.
    fn draw(&self, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<String, Box<dyn std::error::Error>> {
        let [(x_from, x_to), (y_from, y_to)] = self.ranges();
        let mut chart = ChartBuilder::on(area)
            .margin(px(MARGIN))
            .x_label_area_size(px(BELOW))
            .y_label_area_size(px(if self.rows.is_empty() { BESIDE } else { BESIDE_NAMES }))
            .build_cartesian_2d(x_from..x_to, y_from..y_to)?;
        let mut mesh = chart.configure_mesh();
        // Bars stand at whole numbers.
        let bars = self.has_bars();
        let x_tick = |value: &f64| if bars && value.fract() != 0.0 { String::new() } else { tick(*value) };
        if bars {
            mesh.disable_x_mesh();
        }
        mesh.x_desc(&self.x_label)
            .y_desc(&self.y_label)
            .axis_desc_style((FONT, px(17)))
            .label_style((FONT, px(15)))
            .x_label_formatter(&x_tick)
            .y_label_formatter(&|value| self.y_tick(*value))
            .x_labels(area.dim_in_pixel().0 as usize / TICK)
            .y_labels(if self.strip { 5 } else { self.rows.len().max(9) })
            .set_all_tick_mark_size(px(4))
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(225, 225, 225).stroke_width(FINE))
            .axis_style(BLACK.stroke_width(FINE))
            .draw()?;
        let mut colour = PALETTE[0];
        for series in &self.series {
            if let Some(place) = self.named().position(|other| other == series) {
                colour = PALETTE[place % PALETTE.len()];
            }
            series.draw(&mut chart, colour)?;
        }
        if self.named().count() > 1 {
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::UpperRight)
                .margin(px(10))
                .legend_area_size(px(30))
                .label_font((FONT, px(16)))
                .background_style(WHITE.mix(0.9))
                .border_style(RGBColor(200, 200, 200).stroke_width(FINE))
                .draw()?;
        }
        let (across, down) = chart.plotting_area().get_pixel_range();
        // Names are no numbers to point at.
        let [low, high] = if self.rows.is_empty() { [y_from, y_to] } else { [0.0; 2] };
        let places = [across.start, down.start, across.end, down.end].map(|place| place.to_string()).join(",");
        Ok(format!("{places},{x_from},{x_to},{low},{high}"))
    }
}

impl Series {
    fn draw<'a>(&self, chart: &mut Chart<'a>, colour: RGBColor) -> Result<(), Box<dyn std::error::Error>> {
        let points = self.points.iter().copied();
        let line = colour.stroke_width(px(2));
        let drawn = match self.mark {
            Mark::Line => chart.draw_series(LineSeries::new(points, line))?,
            Mark::Thin => chart.draw_series(LineSeries::new(points, colour.stroke_width(px(1))))?,
            Mark::Dashed => chart.draw_series(DashedLineSeries::new(points, px(7), px(5), line))?,
            Mark::Dots => chart.draw_series(points.map(|point| Circle::new(point, px(5), colour.filled())))?,
            Mark::Points => chart.draw_series(points.map(|point| Circle::new(point, px(2), colour.filled())))?,
            Mark::Arrow => {
                let pixels: Vec<_> = self.points.iter().map(|point| chart.backend_coord(point)).collect();
                let heads: Vec<_> = points.skip(1).zip(arrow_head(&pixels)).collect();
                chart.draw_series(
                    heads.into_iter().map(|(tip, head)| EmptyElement::at(tip) + Polygon::new(head, colour.filled())),
                )?
            }
            Mark::Bars { width } => {
                let half = width / 2.0;
                chart.draw_series(
                    points.map(|(x, y)| Rectangle::new([(x - half, 0.0), (x + half, y)], colour.filled())),
                )?
            }
        };
        if self.label.is_empty() {
            return Ok(());
        }
        let mark = self.mark;
        drawn.label(&self.label).legend(move |(x, y)| match mark {
            Mark::Line => PathElement::new([(x, y), (x + signed(22), y)], line).into_dyn(),
            Mark::Thin => PathElement::new([(x, y), (x + signed(22), y)], colour.stroke_width(px(1))).into_dyn(),
            Mark::Dashed => DashedPathElement::new([(x, y), (x + signed(22), y)], px(7), px(5), line).into_dyn(),
            Mark::Dots => Circle::new((x + signed(11), y), px(5), colour.filled()).into_dyn(),
            Mark::Points | Mark::Arrow => Circle::new((x + signed(11), y), px(2), colour.filled()).into_dyn(),
            Mark::Bars { .. } => {
                let corners = [(x + signed(5), y - signed(6)), (x + signed(17), y + signed(6))];
                Rectangle::new(corners, colour.filled()).into_dyn()
            }
        });
        Ok(())
    }
}

/// Corners of a head at the second of two places, seen from it; none where the places do not tell a direction.
#[allow(clippy::cast_possible_truncation, reason = "places on a page")]
fn arrow_head(pixels: &[(i32, i32)]) -> Option<Vec<(i32, i32)>> {
    let &[(from_x, from_y), (to_x, to_y)] = pixels else { return None };
    let (along, across) = (f64::from(to_x) - f64::from(from_x), f64::from(to_y) - f64::from(from_y));
    let length = libm::hypot(along, across);
    if length == 0.0 {
        return None;
    }
    let (along, across) = (along / length, across / length);
    let corner = |ahead: f64, aside: f64| {
        let place = |a: f64, b: f64| (f64::from(FINE) * (ahead * a + aside * b)).round() as i32;
        (place(along, -across), place(across, along))
    };
    Some(vec![corner(9.0, 0.0), corner(-7.0, 7.0), corner(-7.0, -7.0)])
}

impl Panel {
    /// A number, or the row's name where rows have names.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number, from zero on")]
    fn y_tick(&self, value: f64) -> String {
        if self.rows.is_empty() {
            return tick(value);
        }
        let whole = value >= 0.0 && value.fract() == 0.0;
        self.rows.get(value as usize).filter(|_| whole).cloned().unwrap_or_default()
    }
}

/// A tick's number without trailing zeros, with a typographic minus.
fn tick(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.replace('-', "\u{2212}") }
}
