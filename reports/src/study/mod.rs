//! Studies of schemes and scenes for the report on any paper: what is looked at is data (`[study.…]` of
//! [`PaperText`](crate::paper_text::PaperText)), what is said of it are the report's words.
//!
//! ```
//! use courant_reports::{page::Item, paper_text::PaperText, study::limits_cost};
//! let text = PaperText::from_toml(r#"
//!     command = "courant report example"
//!     [paper]
//!     name = "example"
//!     title = "An example"
//!     citation = "Somebody: Something, Somewhere 1 (2000)"
//!     summary = "It shows limits."
//!     [[item]]
//!     name = "limits_as_roots"
//!     text = "Limits as roots"
//!     columns = [">l/Δξ", "limit", ">degree", "equation"]
//!     [study.limits_cost]
//!     shown = []
//!     schemes = []
//!     kernels = []
//!     ratios = { quick = [], standard = [], full = [] }
//!     roots = ["godunov-sph", "cubic-spline", ["2"]]
//! "#)?;
//! let Item::Table { table, .. } = limits_cost::roots(&text) else { panic!("a table") };
//! assert!(table.to_csv().ends_with("2,1.87500000000000000000000000000,,15/8\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod convergence;
pub mod courant_number;
pub mod disorder;
pub mod kernel_waves;
pub mod limits_by_run;
pub mod limits_cost;
pub mod linear_theory;
pub mod plan;
pub mod predicted_measured;
pub mod riemann_measures;
pub mod riemann_run;
pub mod riemann_tables;
pub mod speed;
pub mod stable_steps;
pub mod step_maps;
pub mod tubes;
pub mod wave_windows;
