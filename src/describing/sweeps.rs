//! Describing functions of many sweeps.

use super::closed_form::over_kernels;
use super::{CatalogueError, DescribingError, DescribingFunction, Entry};
use crate::nonlinearity::{
    Absolute, Backlash, Catalogued, DeadZone, DeadZoneSaturation, GainChanging, PiecewiseLinear, Preload, Relay,
    RelayDeadZone, RelayDeadZoneHysteresis, RelayHysteresis, Saturation, SaturationAsymmetric, Sinusoid,
};
use crate::numeric::{Lanes, Real};

impl Entry {
    /// Fills the columns with `F_0`, `P` and `Q`, bit for bit those of [`ClosedForm`](super::ClosedForm), of the characteristic
    /// with these parameter values. `sweep` gives bias and amplitude for each place; where there is no describing function,
    /// `undefined` gives the entry to write, or stops. As many places as the shortest column has.
    ///
    /// A piecewise-linear characteristic is evaluated for several sweeps at a time; the rest gain nothing.
    ///
    /// # Errors
    /// That of [`Entry::build`], of the first sweep outside its domain, or what `undefined` gives. Columns are then filled in
    /// part.
    ///
    /// ```
    /// use selfosc::{Error, describing::{DescribingError, Entry}};
    /// let (amplitudes, mut columns) = ([0.5, 1.0, 2.0], [[0.0; 3]; 3]);
    /// let relay = Entry::find("relay")?;
    /// let refuse = |error: DescribingError| Err(Error::from(error));
    /// relay.over_sweeps(&[1.0], |place| (0.0, amplitudes[place]), refuse, columns.each_mut().map(|column| &mut column[..]))?;
    /// assert_eq!(columns[1][1], 2.0 * columns[1][2]);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn over_sweeps<E: From<CatalogueError> + From<DescribingError>>(
        &self,
        values: &[f64],
        sweep: impl Fn(usize) -> (f64, f64),
        undefined: impl Fn(DescribingError) -> Result<DescribingFunction<f64>, E>,
        [f0, p, q]: [&mut [f64]; 3],
    ) -> Result<(), E> {
        let characteristic = self.build::<f64>(values)?;
        let one = |bias, amplitude| {
            let sweep = Sinusoid::new(bias, amplitude).map_err(DescribingError::from)?;
            characteristic.describing_function(&sweep).or_else(&undefined)
        };
        let together = self.in_lanes(values);
        let count = f0.len().min(p.len()).min(q.len());
        let (mut biases, mut amplitudes) = ([0.0; BLOCK], [0.0; BLOCK]);
        for from in (0..count).step_by(BLOCK) {
            let size = BLOCK.min(count - from);
            for place in 0..size {
                (biases[place], amplitudes[place]) = sweep(from + place);
            }
            let mut done = 0;
            while done < size {
                let rest = from + done..from + size;
                let columns = [&mut f0[rest.clone()], &mut p[rest.clone()], &mut q[rest]];
                let filled = |group: &dyn SideBySide| group.fill(&biases[done..size], &amplitudes[done..size], columns);
                done += together.as_deref().map_or(0, filled);
                // A group with a refused sweep is evaluated sweep by sweep, and so is the remainder.
                let alone = done..size.min(done + Lanes::COUNT);
                for place in alone {
                    let df = one(biases[place], amplitudes[place])?;
                    (f0[from + place], p[from + place], q[from + place]) = (df.f0, df.p, df.q);
                }
                done += Lanes::COUNT;
            }
        }
        Ok(())
    }
}

/// Sweeps whose biases and amplitudes are looked up before they are evaluated.
const BLOCK: usize = 64;

/// A characteristic over several sweeps side by side.
trait SideBySide {
    /// Fills the columns up to the first sweeps that are refused, or to the last that are too few; returns how many are filled.
    fn fill(&self, biases: &[f64], amplitudes: &[f64], columns: [&mut [f64]; 3]) -> usize;
}

impl<C: PiecewiseLinear<Number = Lanes>> SideBySide for C {
    fn fill(&self, biases: &[f64], amplitudes: &[f64], [f0, p, q]: [&mut [f64]; 3]) -> usize {
        let sweeps = biases.as_chunks().0.iter().zip(amplitudes.as_chunks().0);
        let columns = f0.as_chunks_mut().0.iter_mut().zip(p.as_chunks_mut().0).zip(q.as_chunks_mut().0);
        let mut filled = 0;
        for ((bias, amplitude), ((f0, p), q)) in sweeps.zip(columns) {
            let Some(sweep) = Sinusoid::if_defined(Lanes::new(*bias), Lanes::new(*amplitude)) else { break };
            if self.periodic(&sweep).is_err() {
                break;
            }
            let df = over_kernels(self, &sweep);
            if ![df.f0, df.p, df.q].into_iter().all(Lanes::is_finite) {
                break;
            }
            (*f0, *p, *q) = (df.f0.values(), df.p.values(), df.q.values());
            filled += Lanes::COUNT;
        }
        filled
    }
}

/// The characteristics whose kernels hang on the parameters alone, or on a sweep by [`Real::select`] only.
macro_rules! in_lanes {
    ($($type:ident),+ $(,)?) => {
        impl Entry {
            fn in_lanes(&self, values: &[f64]) -> Option<Box<dyn SideBySide>> {
                let values: Vec<_> = values.iter().map(|&value| Lanes::from_f64(value)).collect();
                $(
                    if self.name == <$type<Lanes> as Catalogued<Lanes>>::NAME {
                        return Some(Box::new($type::from_values(&values).ok()?));
                    }
                )+
                None
            }
        }
    };
}

in_lanes!(
    Absolute,
    Backlash,
    DeadZone,
    DeadZoneSaturation,
    GainChanging,
    Preload,
    Relay,
    RelayDeadZone,
    RelayDeadZoneHysteresis,
    RelayHysteresis,
    Saturation,
    SaturationAsymmetric,
);
