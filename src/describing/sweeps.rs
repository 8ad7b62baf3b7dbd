//! Describing functions of many sweeps.

use super::{Boxed, CatalogueError, DescribingError, DescribingFunction, Entry};
use crate::nonlinearity::{
    Absolute, Backlash, Catalogued, DeadZone, DeadZoneSaturation, GainChanging, Preload, Relay, RelayDeadZone,
    RelayDeadZoneHysteresis, RelayHysteresis, Saturation, SaturationAsymmetric, Sinusoid,
};
use crate::numeric::{Lanes, Real};

impl Entry {
    /// Fills the columns with `F_0`, `P` and `Q`, bit for bit those of [`ClosedForm`](super::ClosedForm), of the characteristic
    /// with these parameter values. `sweep` gives bias and amplitude for each place; where there is no describing function,
    /// `undefined` says what to write, or stops. As many places as the shortest column has.
    ///
    /// A piecewise-linear characteristic is evaluated for several sweeps at a time; the other ones gain nothing.
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
        let one = |place| {
            let (bias, amplitude) = sweep(place);
            let sweep = Sinusoid::new(bias, amplitude).map_err(DescribingError::from)?;
            characteristic.describing_function(&sweep).or_else(&undefined)
        };
        let together = self.in_lanes(values);
        let several = |from: usize| {
            let sweeps: [_; Lanes::COUNT] = core::array::from_fn(|lane| sweep(from + lane));
            let sweep = Sinusoid::new(Lanes::from_fn(|lane| sweeps[lane].0), Lanes::from_fn(|lane| sweeps[lane].1));
            together.as_ref()?.describing_function(&sweep.ok()?).ok()
        };
        let columns = f0.chunks_mut(Lanes::COUNT).zip(p.chunks_mut(Lanes::COUNT)).zip(q.chunks_mut(Lanes::COUNT));
        for (block, ((f0, p), q)) in columns.enumerate() {
            let from = block * Lanes::COUNT;
            let full = [&f0, &p, &q].iter().all(|column| column.len() == Lanes::COUNT);
            // What is refused for one of several sweeps is looked at one by one.
            if let Some(df) = full.then(|| several(from)).flatten() {
                for (column, part) in [(f0, df.f0), (p, df.p), (q, df.q)] {
                    column.copy_from_slice(&part.values());
                }
                continue;
            }
            for (lane, ((f0, p), q)) in f0.iter_mut().zip(p).zip(q).enumerate() {
                let df = one(from + lane)?;
                (*f0, *p, *q) = (df.f0, df.p, df.q);
            }
        }
        Ok(())
    }
}

/// The characteristics whose kernels hang on the parameters alone, or on a sweep by [`Real::select`] only.
macro_rules! in_lanes {
    ($($type:ident),+ $(,)?) => {
        impl Entry {
            fn in_lanes(&self, values: &[f64]) -> Option<Boxed<Lanes>> {
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
