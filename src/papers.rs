//! The papers this program implements, as items that other documentation links to: `cargo doc`
//! then checks every citation.
//!
//! | symbol | code | meaning |
//! | --- | --- | --- |
//! | u | material position | coordinates in the flat, undeformed cloth (m) |
//! | x, v | position, velocity | in the world (m), (m/s) |
//! | F = dx/du | deformation gradient | 3x2, per face |
//! | M | [`SymTensor2`](crate::math::SymTensor2) | sizing tensor (1/m^2): an edge du is valid if du^T M du <= 1 |
//! | nu | view factor | 0..1, scales M by nu^2 |
//! | m, T, k | `margin_m`, `anticipation_frames`, `buckling_exponent` | settings of the view |

/// Koh, Narain, O'Brien: *View-Dependent Adaptive Cloth Simulation with Buckling Compensation*,
/// IEEE TVCG 2015. Holds wherever it differs from [`VD14`].
pub enum VD15 {}

/// Koh, Narain, O'Brien: *View-Dependent Adaptive Cloth Simulation*, SCA 2014.
pub enum VD14 {}

/// Brown, Samii, O'Brien, Narain: *Resampling Adaptive Cloth Simulations onto Fixed-Topology
/// Meshes*, SCA 2015 poster.
pub enum RS15 {}

/// Narain, Samii, O'Brien: *Adaptive Anisotropic Remeshing for Cloth Simulation*, ACM TOG 2012.
pub enum NSO12 {}

/// Narain, Pfaff, O'Brien: *Folding and Crumpling Adaptive Sheets*, ACM TOG 2013.
pub enum NPO13 {}

/// Wang, O'Brien, Ramamoorthi: *Data-Driven Elastic Models for Cloth: Modeling and Measurement*,
/// ACM TOG 2011.
pub enum WOR11 {}

/// Baraff, Witkin: *Large Steps in Cloth Simulation*, SIGGRAPH 1998.
pub enum BW98 {}

/// Bridson, Marino, Fedkiw: *Simulation of Clothing with Folds and Wrinkles*, SCA 2003.
pub enum BMF03 {}

/// Müller, Heidelberger, Hennix, Ratcliff: *Position Based Dynamics*, Journal of Visual
/// Communication and Image Representation 2007.
pub enum MHHR07 {}

/// Cooper: *The Stiffness of Woven Textiles*, Journal of the Textile Institute 1960.
pub enum C60 {}

/// Grinspun, Gingold, Reisman, Zorin: *Computing Discrete Shape Operators on General Meshes*,
/// Computer Graphics Forum (Eurographics) 2006.
pub enum GGRZ06 {}

/// Neunteufel, Schoeberl: *The Hellan-Herrmann-Johnson Method for Nonlinear Shells*, Computers &
/// Structures 2019. The method for plates is of Hellan (1967), Herrmann (1967) and Johnson (1973).
pub enum NS19 {}

/// Fritsch, Carlson: *Monotone Piecewise Cubic Interpolation*, SIAM J. Numer. Anal. 1980.
pub enum FC80 {}

/// Baerentzen, Aanaes: *Signed Distance Computation Using the Angle Weighted Pseudonormal*,
/// IEEE TVCG 2005.
pub enum BA05 {}

/// Olano, Greer: *Triangle Scan Conversion using 2D Homogeneous Coordinates*, Graphics Hardware
/// 1997.
pub enum OG97 {}

/// Felzenszwalb, Huttenlocher: *Distance Transforms of Sampled Functions*, Theory of Computing 2012.
pub enum FH12 {}

/// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: *FLIP: A Difference Evaluator
/// for Alternating Images*, HPG 2020.
pub enum FLIP20 {}

/// Cuthill, McKee: *Reducing the Bandwidth of Sparse Symmetric Matrices*, ACM 1969; reversed as in
/// George 1971.
pub enum CM69 {}

/// Meijerink, van der Vorst: *An Iterative Solution Method for Linear Systems of Which the
/// Coefficient Matrix is a Symmetric M-Matrix*, Math. Comp. 1977.
pub enum MV77 {}

/// Li, Kaufman, Jiang: *Codimensional Incremental Potential Contact*, ACM TOG 2021: additive
/// continuous collision detection.
pub enum LKJ21 {}

/// Bridson, Fedkiw, Anderson: *Robust Treatment of Collisions, Contact and Friction for Cloth
/// Animation*, ACM TOG 2002.
pub enum BFA02 {}

/// Romero, Ly, Rasheed, Charrondiere, Lazarus, Neukirch, Bertails-Descoubes: *Physical Validation of
/// Simulators in Computer Graphics*, ACM TOG 2021.
pub enum RLBD21 {}

/// Cerda, Mahadevan: *Geometry and Physics of Wrinkling*, Physical Review Letters 2003.
pub enum CM03 {}

/// Southwell: *On the Analysis of Experimental Observations in Problems of Elastic Stability*,
/// Proceedings of the Royal Society A 1932.
pub enum S32 {}

/// Memon, Chaklie, Yesuf, Zhu: *Study on Effect of Leather Rigidity and Thickness on Drapability of
/// Sheep Garment Leather*, Materials 14 (2021) 4553.
pub enum MCYZ21 {}

/// Harmon, Vouga, Tamstorf, Grinspun: *Robust Treatment of Simultaneous Collisions*, ACM TOG 2008.
pub enum HVTG08 {}

/// Volino, Magnenat-Thalmann: *Resolving Surface Collisions through Intersection Contour
/// Minimization*, ACM TOG 2006.
pub enum VMT06 {}

/// Chen, Hsu, Liu, Macklin, Yang, Yuksel: *Offset Geometric Contact*, ACM TOG 2025: bounds on the ways
/// of vertices in place of continuous tests.
pub enum CHLMYY25 {}
