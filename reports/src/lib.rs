//! Placeholder until the next commit.

pub mod certificate_file;
