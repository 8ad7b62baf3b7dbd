//! Every error of the library as one.

use crate::numeric::OutOfDomain;

/// Declares the umbrella: one transparent variant for each module's error, each of which has `code` and, where a number
/// can be the reason, `out_of_domain`.
macro_rules! umbrella {
    ($( $(#[$attribute:meta])* $doc:literal $variant:ident($error:ty) $($numbers:ident)?; )+) => {
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

        impl Error {
            /// Short name for scripts; it does not change with the wording of the message.
            #[must_use]
            pub fn code(&self) -> &'static str {
                match self {
                    Self::OutOfDomain(_) => "out-of-domain",
                    $( $(#[$attribute])* Self::$variant(error) => error.code(), )+
                }
            }

            /// The number outside its domain, if that is the reason: quantity, value, unit, limit and remedy.
            #[must_use]
            pub fn out_of_domain(&self) -> Option<&OutOfDomain> {
                match self {
                    Self::OutOfDomain(fault) => Some(fault),
                    $( $(#[$attribute])* Self::$variant(error) => umbrella!(@number error $($numbers)?), )+
                }
            }
        }
    };
    (@number $error:ident numbers) => { $error.out_of_domain() };
    (@number $error:ident) => {{
        let _ = $error;
        None
    }};
}

umbrella! {
    "A file that cannot be read or written." Files(crate::files::FileError);
    "A proof that is not accepted." Proof(crate::proof::inequality::Refusal);
    "A characteristic or its input." Nonlinearity(crate::nonlinearity::NonlinearityError) numbers;
    "No describing function." Describing(crate::describing::DescribingError) numbers;
    "A name or setting that the catalogue does not take." Catalogue(crate::describing::CatalogueError) numbers;
    "A plant that is none." Plant(crate::plant::PlantError) numbers;
    "No harmonic balance." Balance(crate::balance::BalanceError) numbers;
    "No proof of an oscillation." Existence(crate::balance::ExistenceError);
    "No limit cycle." Orbit(crate::orbit::OrbitError) numbers;
    "No record." Experiment(crate::experiment::ExperimentError) numbers;
    "No steady self-oscillation in a record." Features(crate::features::FeatureError);
    "No model." Identify(crate::identify::IdentifyError) numbers;
    "No model from these logs." Identification(crate::identify::Refusal) numbers;
    "No experiment to propose." Design(crate::identify::design::DesignError) numbers;
    "An experiment on board that was broken off." OnBoard(crate::on_board::Fault);
    "A vehicle, a thruster or a demand on them." Vehicle(crate::vehicle::VehicleError) numbers;
    "No controller." Control(crate::control::ControlError) numbers;
    "No process from a record." Process(crate::autotune::ProcessError);
    "A part of the paper that cannot be regenerated." Paper(crate::paper::PaperError) numbers;
    #[cfg(feature = "report")]
    "No report." Report(crate::report::ReportError) numbers;
}
