//! `courant`: von Neumann stability of numerical schemes, with proof.
//!
//! This facade gathers the crates of the workspace under one name; `ARCHITECTURE.md` says what lives where.
//!
//! ```
//! use courant::analysis::{kernel::Kernel, stability::stability_limit, exact::rational::integer};
//! use courant::analysis::scheme::{AdvectionScheme, Discretisation, Scheme};
//! let scheme = Discretisation::new(AdvectionScheme::GodunovSph, Kernel::CubicSpline, integer(2))?;
//! assert_eq!(stability_limit(&scheme.symbol(), &integer(10)).exact().unwrap().to_string(), "15/8");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use courant_analysis as analysis;
pub use courant_reports as reports;
pub use courant_simulation as simulation;
