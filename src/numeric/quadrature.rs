//! Plain quadrature: adaptive Gauss-Kronrod with 7 and 15 nodes. Estimates its error and proves nothing.

/// Nodes in `[0, 1)` and weights of the 15-point Kronrod rule, and the weights of the 7-point Gauss rule on every second
/// node (Piessens et al., QUADPACK, 1983).
pub(crate) const RULE: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_67),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_83, 0.417_959_183_673_469_4),
];

/// Part of a cell's error that either half of it is taken to have still. With a smooth integrand the part is far
/// smaller; for `x^p` with its zero at an end it is `2^(-p-1)`.
const CARRIED: f64 = 1.0 / 16.0;

/// An integral with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadrature {
    /// The integral.
    pub value: f64,
    /// Estimated absolute error.
    pub estimate: f64,
    /// The absolute error asked for: above the estimate unless the cells ran out.
    pub tolerance: f64,
    /// Cells used.
    pub cells: usize,
}

/// The integral of `f` from `from` to `to`, to `tolerance` relative to the integral of its magnitude, in at most `cells`
/// cells. The estimate can be fooled by a function that has structure between the nodes.
///
/// ```
/// use selfosc::numeric::quadrature::integrate;
/// let q = integrate(&mut |x: f64| x.exp(), 0.0, 1.0, 1e-13, 100);
/// assert!((q.value - (1f64.exp() - 1.0)).abs() < 1e-14);
/// ```
pub fn integrate(f: &mut dyn FnMut(f64) -> f64, from: f64, to: f64, tolerance: f64, cells: usize) -> Quadrature {
    let first = Panel { estimate: f64::INFINITY, ..Panel::new(f, from, to) };
    let mut heap = std::collections::BinaryHeap::from([first]);
    let total =
        |heap: &std::collections::BinaryHeap<Panel>, part: fn(&Panel) -> f64| heap.iter().map(part).sum::<f64>();
    loop {
        let (estimate, magnitude) = (total(&heap, |cell| cell.estimate), total(&heap, |cell| cell.magnitude));
        if estimate <= tolerance * magnitude || heap.len() >= cells {
            break;
        }
        let Some(worst) = heap.pop() else { break };
        let middle = 0.5 * (worst.from + worst.to);
        if !(worst.from < middle && middle < worst.to) {
            heap.push(worst);
            break;
        }
        let halves = [Panel::new(f, worst.from, middle), Panel::new(f, middle, worst.to)];
        // The two rules can agree by chance: `|I_left + I_right - I|` is an independent estimate, far above the halves' own error.
        let change = (halves[0].value + halves[1].value - worst.value).abs();
        heap.extend(halves.map(|half| Panel { estimate: half.estimate.max(CARRIED * change), ..half }));
    }
    Quadrature {
        value: total(&heap, |cell| cell.value),
        estimate: total(&heap, |cell| cell.estimate),
        tolerance: tolerance * total(&heap, |cell| cell.magnitude),
        cells: heap.len(),
    }
}

#[derive(Clone, Copy, PartialEq)]
struct Panel {
    from: f64,
    to: f64,
    value: f64,
    estimate: f64,
    magnitude: f64,
}

impl Panel {
    fn new(f: &mut dyn FnMut(f64) -> f64, from: f64, to: f64) -> Self {
        let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
        let (mut kronrod, mut gauss, mut magnitude) = (0.0, 0.0, 0.0);
        for (node, weight, gauss_weight) in RULE {
            let sides: &[f64] = if node == 0.0 { &[0.0] } else { &[-1.0, 1.0] };
            for side in sides {
                let y = f(centre + side * half * node);
                kronrod += weight * y;
                gauss += gauss_weight * y;
                magnitude += weight * y.abs();
            }
        }
        // The error of the Gauss rule: larger by orders of magnitude than Kronrod's, and harder to fool than its power.
        let estimate = ((kronrod - gauss) * half).abs();
        let magnitude = magnitude * half.abs();
        Self { from, to, value: kronrod * half, estimate, magnitude }
    }
}

impl Eq for Panel {}
impl Ord for Panel {
    fn cmp(&self, other: &Self) -> core::cmp::Ordering {
        self.estimate.total_cmp(&other.estimate)
    }
}
impl PartialOrd for Panel {
    fn partial_cmp(&self, other: &Self) -> Option<core::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
