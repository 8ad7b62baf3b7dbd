//! Every error of the library as one.

use crate::numeric::OutOfDomain;

/// Declares the umbrella: one transparent variant for each module's error.
macro_rules! umbrella {
    ($( $(#[$attribute:meta])* $doc:literal $variant:ident($error:ty); )+) => {
        /// Any error of this library, for callers that do not tell the modules apart: `?` turns every module's error into
        /// it. The text names value, limit and remedy.
        ///
        /// ```
        /// use selfosc::{nonlinearity::RelayHysteresis, orbit::limit_cycle, plant::DragAxis};
        /// fn period_s(alpha: f64) -> Result<f64, selfosc::Error> {
        ///     let axis = DragAxis::linear(alpha, 0.1)?;
        ///     Ok(limit_cycle(&axis, &RelayHysteresis::new(1.0, 0.2, 0.0)?)?.period_s)
        /// }
        /// let error = period_s(-1.0).unwrap_err();
        /// assert_eq!(error.code(), "out-of-domain");
        /// let fault = error.out_of_domain().unwrap();
        /// assert_eq!((fault.quantity, fault.value, fault.unit), ("alpha", -1.0, "F s^2/x"));
        /// ```
        #[derive(Clone, Debug, PartialEq, thiserror::Error)]
        #[non_exhaustive]
        pub enum Error {
            /// A number outside its domain.
            #[error(transparent)]
            OutOfDomain(#[from] OutOfDomain),
            $( $(#[$attribute])* #[doc = $doc] #[error(transparent)] $variant(#[from] $error), )+
        }

        crate::numeric::codes! { pub Error { OutOfDomain.0, $( $(#[$attribute])* $variant.0 ),+ } }
    };
}

umbrella! {
    "A file that cannot be read or written." Files(crate::files::FileError);
    "A proof that is not accepted." Proof(crate::proof::inequality::Refusal);
    "A characteristic or its input." Nonlinearity(crate::nonlinearity::NonlinearityError);
    "No describing function." Describing(crate::describing::DescribingError);
    "A name or setting that the catalogue does not take." Catalogue(crate::describing::CatalogueError);
    "A plant that is none." Plant(crate::plant::PlantError);
    "No harmonic balance." Balance(crate::balance::BalanceError);
    "No proof of an oscillation." Existence(crate::balance::ExistenceError);
    "No limit cycle." Orbit(crate::orbit::OrbitError);
    "No record." Experiment(crate::experiment::ExperimentError);
    "No steady self-oscillation in a record." Features(crate::features::FeatureError);
    "No model." Identify(crate::identify::IdentifyError);
    "No model from these logs." Identification(crate::identify::Refusal);
    "No experiment to propose." Design(crate::identify::design::DesignError);
    "An experiment on board that was broken off." OnBoard(crate::on_board::Fault);
    "A vehicle, a thruster or a demand on them." Vehicle(crate::vehicle::VehicleError);
    "No controller." Control(crate::control::ControlError);
    "No process from a record." Process(crate::autotune::ProcessError);
    "A part of the paper that cannot be regenerated." Paper(crate::paper::PaperError);
    #[cfg(feature = "report")]
    "No report." Report(crate::report::ReportError);
}
