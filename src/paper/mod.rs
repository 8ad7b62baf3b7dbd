//! The paper regenerated from its printed data, and audited against it.
//!
//! N. Mišković, Z. Vukić, M. Barišić, *Identification of Unmanned Underwater Vehicles by Self-Oscillation Method*,
//! AUTOMATIKA 50 (2009) 3-4, 167-183. The paper's "constant" and "linear" drag name the drag coefficient; this
//! project names the force: linear and quadratic.
//!
//! | file | content |
//! |---|---|
//! | `fixtures` | what is printed, read from `fixtures/` |
//! | `printed` | a printed decimal, and the interval it stands for |
//! | `table2`, `table3` | the axes and the identification formulas, printed by evaluating them over symbols |
//! | `table4` | the parameters of 19 experiments, their means and spreads |
//! | `figure15` | the drag law from pairs of experiments |
//! | `quantisation` | errors by the sensor's step: eqs. 37-39 and Fig. 14 |
//! | `relay_figures` | Figs. 5-7 |
//! | `thruster_figure` | Fig. 9 (b) |
//! | `response_figures` | Figs. 12-13, simulated |
//! | `joint` | all experiments together, by exact limit cycles |
//! | `consistency` | delays, errors of the relay level and drag laws that no row contradicts, by branch and bound |
//! | `audit` | every printed number against its recomputation in intervals |

pub mod audit;
mod error;
mod printed;

pub use error::PaperError;
pub use printed::Printed;

internal! {
    mod consistency;
    mod figure15;
    mod fixtures;
    mod joint;
    mod quantisation;
    mod relay_figures;
    mod response_figures;
    mod table2;
    mod table3;
    mod table4;
    mod thruster_figure;
}
