//! `courant`: von Neumann stability of numerical schemes, with proof.
//!
//! This facade gathers the crates of the workspace under one name; `ARCHITECTURE.md` says what lives where.
//!
//! ```
//! use courant::analysis::scheme::Step;
//! let upwind = Step::from_text("u[n+1,j] = u[n,j] - C*(u[n,j] - u[n,j-1])")?;
//! assert_eq!(upwind.limit("C")?.exact().unwrap().to_string(), "1");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use courant_analysis as analysis;
pub use courant_reports as reports;
pub use courant_simulation as simulation;
