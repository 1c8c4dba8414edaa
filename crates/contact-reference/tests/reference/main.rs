//! The closed forms against something independent of each: quadratures of point-load solutions,
//! limits, energy balances, tables of other programs.

mod below_the_surface;
mod coated;
mod coupled;
mod pressed;
mod quadrature;
mod sheared;
