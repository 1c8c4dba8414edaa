//! What the solver is built of, each part against what does not use it: kernels, convolution, what
//! the plan leaves out, the grid of the path, answers to what users ask.

mod answers;
mod convolution;
mod halving;
#[path = "../kernel_tables/mod.rs"]
mod kernel_tables;
mod kernels;
mod path_grid;
mod skip;
#[allow(dead_code, reason = "these tests draw no logarithms")]
#[path = "../splitmix/mod.rs"]
mod splitmix;
mod yielding;
