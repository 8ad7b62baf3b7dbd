//! The regenerated paper as tables and figures: one list of parts drives the summary, the files and the report.

mod figures;
mod story;
mod tables;

use super::{Document, Figure, ReportError, Section, Table};
use crate::paper::audit::{Group, audit};
use crate::paper::consistency::{Consistency, consistency};
use crate::paper::figure15::{Counts, figure15};
use crate::paper::joint::{JointRow, joint};
use crate::paper::table4::{PrintedTable, Table4, table4};

/// Everything the paper prints, regenerated from its printed data.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    printed: PrintedTable,
    /// Table 4.
    pub table4: Table4,
    /// The bars of Fig. 15, from the printed parameters.
    pub figure15: Vec<Counts>,
    /// Each drag law fitted to all experiments at once.
    pub joint: Vec<JointRow>,
    /// Every printed number against its recomputation.
    pub audit: Vec<Group>,
}

impl Reproduction {
    /// Regenerates the numbers; figures are drawn when a part is asked for.
    ///
    /// # Errors
    /// [`ReportError::Paper`] where a fixture is corrupt.
    pub fn new() -> Result<Self, ReportError> {
        let printed = PrintedTable::compiled_in()?;
        let table4 = table4(&printed)?;
        let audit = audit(&printed, &table4)?;
        let levels: Vec<f64> = printed.experiments().iter().map(|row| row.relay_level.value()).collect();
        Ok(Self { figure15: figure15(&levels, &printed.printed())?, joint: joint(&printed)?, table4, audit, printed })
    }

    /// Which delays, errors of the relay level and drag laws no row of Table 4 contradicts; searched for when asked.
    #[must_use]
    pub fn consistency(&self) -> Vec<Consistency> {
        consistency(&self.printed)
    }

    /// One screen: the numbers that people look for first.
    #[must_use]
    pub fn summary(&self) -> String {
        let parts = [self.parameters_table(), self.figure15_table(), self.joint_table(), self.audit_summary()];
        parts.map(|table| table.text()).join("\n")
    }

    /// Parts as one report.
    #[must_use]
    pub fn document(sections: Vec<Section>) -> Document {
        Document {
            title: "Self-oscillation identification, regenerated and audited".to_owned(),
            answer: Vec::new(),
            sections,
            provenance: vec![concat!("Written by selfosc ", env!("CARGO_PKG_VERSION")).to_owned()],
        }
    }
}

/// A part of the paper that can be asked for by name.
pub struct Part {
    /// Its name on the command line.
    pub name: &'static str,
    title: &'static str,
    about: &'static str,
    equations: &'static [&'static str],
    tables: fn(&Reproduction) -> Result<Vec<Table>, ReportError>,
    figures: fn(&Reproduction) -> Result<Vec<Figure>, ReportError>,
}

impl Part {
    /// Its tables.
    ///
    /// # Errors
    /// [`ReportError::Paper`] where its data are not to be had.
    pub fn tables(&self, reproduction: &Reproduction) -> Result<Vec<Table>, ReportError> {
        (self.tables)(reproduction)
    }

    /// The part with its figures.
    ///
    /// # Errors
    /// As [`Self::tables`].
    pub fn section(&self, reproduction: &Reproduction) -> Result<Section, ReportError> {
        Ok(Section {
            title: self.title.to_owned(),
            paragraphs: vec![self.about.to_owned()],
            equations: self.equations.to_vec(),
            tables: self.tables(reproduction)?,
            figures: (self.figures)(reproduction)?,
        })
    }
}

impl std::fmt::Debug for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Part").field("name", &self.name).finish_non_exhaustive()
    }
}

/// A part without content.
const NOTHING: Part =
    Part { name: "", title: "", about: "", equations: &[], tables: |_| Ok(Vec::new()), figures: |_| Ok(Vec::new()) };

/// Every part, in the order of the paper.
pub const PARTS: &[Part] = &[
    Part {
        name: "table2",
        title: "Table 2: uncoupled axes",
        about: "Each axis obeys eq. 6, nu its speed and tau its command; derivatives of the hydrodynamic force are negative.",
        equations: &[r"\alpha \dot\nu + \beta(\nu)\, \nu = \delta + \tau"],
        tables: |_| Ok(vec![tables::table2(), tables::symbols("table2-symbols", 0)]),
        ..NOTHING
    },
    Part {
        name: "table3",
        title: "Table 3: identification formulas",
        about: "The formulas are printed by the functions that the program identifies with, evaluated over symbols. P and Q are \
                those of a relay with hysteresis whose sweep passes both switching levels (condition 40).",
        tables: |reproduction| reproduction.table3(),
        ..NOTHING
    },
    Part {
        name: "table4",
        title: "Table 4: the yaw axis from 19 experiments",
        about: "Recomputed from the printed relay levels, switching levels, amplitudes, biases and periods, with a delay of \
                0.2 s, beside what is printed.",
        tables: |reproduction| Ok(vec![reproduction.parameters_table(), reproduction.table4()]),
        ..NOTHING
    },
    Part {
        name: "quantisation",
        title: "Quantisation: eqs. 37-39",
        about: "At X_m = sqrt(2) x_a the inertia is insensitive, to first order, to an error of the amplitude.",
        tables: |_| Ok(vec![tables::quantisation()]),
        figures: |_| Ok(vec![figures::quantisation()]),
        ..NOTHING
    },
    Part {
        name: "fig5",
        title: "Fig. 5: relay with hysteresis and level offset",
        about: "Drawn for C = 1, x_a = 1, d = 0.3.",
        figures: |_| Ok(vec![figures::figure5()?]),
        ..NOTHING
    },
    Part {
        name: "fig6",
        title: "Fig. 6: output under a biased sinusoid",
        about: "The same relay under 0.4 + 2 sin: a bias of the input makes the output asymmetric in time.",
        figures: |_| Ok(vec![figures::figure6()?]),
        ..NOTHING
    },
    Part {
        name: "fig7",
        title: "Fig. 7: late switching in discrete time",
        about: "A relay set to 3 that sees 2.15 and then 6.57 switches at 6.57: the level to compute with is the measured one.",
        figures: |_| Ok(vec![figures::figure7()]),
        ..NOTHING
    },
    Part {
        name: "fig9",
        title: "Fig. 9 (b): thruster map",
        about: "The paper prints no coefficients: readings are those of this project's own pool vehicle, rounded to 0.1 N.",
        figures: |_| Ok(vec![figures::figure9()?]),
        ..NOTHING
    },
    Part {
        name: "fig12",
        title: "Fig. 12: responses in an experiment, simulated",
        about: "Simulated, not measured: the quadratic drag of all experiments together (delay 0.2 s), C = 8.23e-2 N m, half-width \
                10 degrees, a disturbance of 0.5e-2 N m; compass in whole degrees, a command held for 0.1 s, delays of 0.1 s each way.",
        figures: |reproduction| Ok(vec![reproduction.figure12()?]),
        ..NOTHING
    },
    Part {
        name: "fig13",
        title: "Fig. 13: no hysteresis, simulated",
        about: "Simulated as Fig. 12 with half-width 0: sampling and delay alone keep a small oscillation of few degrees, which the \
                method cannot use.",
        figures: |reproduction| Ok(vec![reproduction.figure13()?]),
        ..NOTHING
    },
    Part {
        name: "fig14",
        title: "Fig. 14: relative errors and quantisation bounds",
        about: "Errors of the printed parameters against their means; bounds from eqs. 37-39 for an amplitude error of 1 degree.",
        tables: |reproduction| Ok(vec![reproduction.figure14_table()]),
        figures: |reproduction| Ok(vec![reproduction.figure14()]),
        ..NOTHING
    },
    Part {
        name: "fig15",
        title: "Fig. 15: the drag law from two experiments",
        about: "All pairs with different relay levels, decided by eqs. 41-42; quadratic drag counts as correct.",
        tables: |reproduction| Ok(vec![reproduction.figure15_table()]),
        figures: |reproduction| Ok(vec![reproduction.figure15()]),
        ..NOTHING
    },
    Part {
        name: "joint",
        title: "All experiments together",
        about: "One vehicle for all 19 experiments, exact limit cycles in place of first harmonics, least squares of ln T and ln X_m: \
                first with the paper's delay of 0.2 s, then with the delay estimated too.",
        tables: |reproduction| Ok(vec![reproduction.joint_table()]),
        ..NOTHING
    },
    Part {
        name: "audit",
        title: "Audit: printed against recomputed",
        about: "Printed inputs are known to half a unit of their column's last decimal. A printed number agrees where it meets \
                the range that such inputs allow, in interval arithmetic. Then all rows at once: which delay of the loop and which \
                error of the relay level no row of Table 4 contradicts.",
        tables: |reproduction| {
            Ok(vec![reproduction.audit_summary(), reproduction.consistency_table(), reproduction.audit_table()])
        },
        ..NOTHING
    },
];
