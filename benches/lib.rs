//! The benches: each states its operations and what it is set against.
