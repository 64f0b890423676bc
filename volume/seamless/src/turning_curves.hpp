// Singular curves that go on with another type: against the axis that frames turn about round them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge_matchings.hpp"

namespace octafield::volume::detail {

// Singular triangles from tet to tet, each a quarter turn, as far as two of them are in a tet.
struct CurveChain {
    std::vector<Index> rows;  // of the triangle table, in order
    std::vector<Index> tets;  // one between each row and the next; of closed chains between last and first, too
    std::vector<Eigen::Vector3d> axes;  // (rows) the axis of the turn, right-handed as seen along the chain
    bool closed = false;
};

std::vector<CurveChain> curve_chains(const TetDomain& domain, const Quaternions& frames,
                                     const EdgeMatchings& matchings);

// Where the axis changes from along the chain to against it, or back: the place in rows, and 1 where the parameter
// along the axis is highest there, -1 where it is lowest. Ups and downs of less than `least` are passed over.
struct CurveTurn {
    std::size_t at;
    int sense;
};
std::vector<CurveTurn> curve_turns(const TetDomain& domain, const CurveChain& chain, double least);

}  // namespace octafield::volume::detail
