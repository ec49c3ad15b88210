//! Studies of schemes and scenes for the report on any paper: what is looked at is data (`[study.…]` of
//! [`PaperText`](crate::paper_text::PaperText)), what is said of it are the report's words.

pub mod convergence;
pub mod courant_number;
pub mod disorder;
pub mod growth;
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
