//! Shared by the tests of the shaders that do what fixed function does: vertices, matrices and fragments by chance, and what checks them.

pub(crate) mod cases;
pub(crate) mod check;
pub(crate) mod fragments;
pub(crate) mod matrices;
pub(crate) mod random;
