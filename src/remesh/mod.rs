//! Split, collapse and flip until every edge is valid and the mesh is coarse.
