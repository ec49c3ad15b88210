//! Neighbours, symmetry and conservation.
