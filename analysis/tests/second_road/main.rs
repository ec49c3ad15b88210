//! What the library says, by roads that share nothing with it: literature, dense sampling, Sturm's theorem, values refined elsewhere,
//! printed relations, a particle code of its own.

mod catalogue;
mod dense_sampling;
mod long_waves;
mod method_of_lines;
mod particle_limits;
mod printed_relations;
mod random_schemes;
mod refusals;
mod ring_linearisation;
mod several_dimensions;
