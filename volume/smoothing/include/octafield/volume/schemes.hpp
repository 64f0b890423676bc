// What can be minimised: one row for each scheme. Solvers, Python, the command line, reports, and what studies expect of
// time and memory are all taken from this table (src/scheme_table.cpp; docs/extend.md adds a row).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

enum class SchemeSort {
    embedding,               // vectors of frames: a representation of frames/registry.hpp
    embedding_with_lengths,  // of tensors, with the lengths of the axes as further unknowns
    metric,                  // a difference of frames for each edge, in place of that of vectors
};

struct SchemeSolver {
    SmoothSolver solver;
    double bytes_per_tet;  // of the process's peak beyond the mesh, frames at vertices (docs/scaling.md)
};

struct Scheme {
    std::string name;  // SmoothOptions::representation
    SchemeSort sort;
    std::string equation;  // what is minimised, one line
    std::string meaning;   // one clause for tables
    // The harmonic field of the angle metric is its limit on refined meshes, at second order without singular curves.
    bool consistent;
    bool descends;                      // no step raises the objective
    std::vector<SchemeSolver> solvers;  // those that go with it; the first is the default
    double seconds_per_million_tets;    // CPU, recipe and analysis, by the default solver; 0: not measured
    std::string colour;                 // in plots: "#rrggbb"; "text": the text's; none: one of those kept for others
    bool compared;                      // by a comparison that is not told which
};

// Embeddings in the order of frames/registry.hpp, then odeco_lengths, then metrics.
const std::vector<Scheme>& schemes();
const Scheme& scheme(std::string_view name);  // throws InvalidInput that lists the names

}  // namespace octafield::volume
