#include <algorithm>
#include <cmath>

#include "cell_choice.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/recombination.hpp"

namespace octafield::volume {
namespace {

using namespace detail;

void require_options(const RecombineOptions& options) {
    if (!(options.min_scaled_jacobian > 0 && options.min_scaled_jacobian < 1))
        throw InvalidInput("min_scaled_jacobian is to lie between 0 and 1", "min_scaled_jacobian");
    if (!(options.max_boundary_fold >= 0 && options.max_boundary_fold < 2))
        throw InvalidInput("max_boundary_fold is an angle in radians, from 0 to below 2", "max_boundary_fold");
}

void require_cells(const MixedMesh& mesh, const Edges& kept, const Triangles& walls) {
    for (const CellDefect& defect : find_cell_defects(mesh))
        if (defect.kind != "mismatched_face") throw GeometryError(defect.message, defect.kind, defect.cells);
    if (kept.size() && (kept.minCoeff() < 0 || kept.maxCoeff() >= mesh.vertices.rows()))
        throw InvalidInput("kept_edges name vertices that do not exist", "index_out_of_range");
    if (walls.size() && (walls.minCoeff() < 0 || walls.maxCoeff() >= mesh.vertices.rows()))
        throw InvalidInput("walls name vertices that do not exist", "index_out_of_range");
}

class Recombiner {
public:
    Recombiner(const MixedMesh& mesh, const RecombineOptions& options, RecombineReport& report)
        : mesh_(mesh),
          options_(options),
          report_(report),
          topology_(mesh.tets, static_cast<Index>(mesh.vertices.rows())),
          walls_(topology_.marked(options.walls)),
          surroundings_(mesh, topology_, options.kept_edges, walls_, options.max_boundary_fold),
          table_(topology_),
          taken_(mesh.tets.rows(), 0) {}

    MixedMesh run() {
        MixedMesh result = mesh_;
        const PotentialCells hexahedra = potential_hexahedra(search());
        report_.potential_hexahedra = hexahedra.count();
        append(result.hexahedra, hexahedra, choose(hexahedron_shape, hexahedra), report_.hexahedra);
        if (options_.wedges) {
            const PotentialCells wedges = potential_wedges(search());
            report_.potential_wedges = wedges.count();
            append(result.wedges, wedges, choose(wedge_shape, wedges), report_.wedges);
        }
        std::vector<Eigen::Index> left;
        for (Eigen::Index tet = 0; tet < mesh_.tets.rows(); ++tet)
            if (!taken_[tet]) left.push_back(tet);
        result.tets = mesh_.tets(left, Eigen::all);
        return result;
    }

private:
    TetSearch search() const {
        return {topology_, mesh_.vertices, mesh_.tets, options_.min_scaled_jacobian, taken_, options_.threads, walls_};
    }

    std::vector<Index> choose(const CellShape& shape, const PotentialCells& cells) {
        // Many poor cells or few good ones: a cube is worth two of quality 0.25.
        std::vector<double> weights(cells.count());
        for (Index cell = 0; cell < cells.count(); ++cell) weights[cell] = 0.5 + 2 * cells.quality[cell];
        std::vector<Index> chosen = choose_cells(surroundings_, shape, cells, weights, table_, options_.threads);
        for (const Index cell : chosen) {
            for (const Index tet : cells.tets_of(cell)) taken_[tet] = 1;
            take_flat_tets(*surroundings_.claims(shape, cells.ids[cell].data(), cells.inner_pairs[cell]));
        }
        table_.settle();
        return chosen;
    }

    // Tets on the four vertices of a quad, outside it: the quad is as good on their other side, and may meet another
    // there.
    void take_flat_tets(const CellClaims& claims) {
        for (int f = 0; f < claims.count; ++f) {
            const Index flat = claims.faces[f].flat;
            if (flat < 0 || taken_[flat]) continue;
            taken_[flat] = 1;
            ++report_.flat_tets;
        }
    }

    template <int Corners>
    static void append(Rows<Index, Corners>& rows, const PotentialCells& cells, const std::vector<Index>& chosen,
                       Index& count) {
        Eigen::Index row = rows.rows();
        count = static_cast<Index>(chosen.size());
        rows.conservativeResize(row + count, Corners);
        for (const Index cell : chosen) std::copy_n(cells.ids[cell].begin(), Corners, rows.row(row++).data());
    }

    const MixedMesh& mesh_;
    const RecombineOptions& options_;
    RecombineReport& report_;
    const TetTopology topology_;
    const std::vector<std::uint8_t> walls_;
    const TetSurroundings surroundings_;
    ClaimTable table_;
    std::vector<std::uint8_t> taken_;
};

}  // namespace

MixedMesh recombine(const MixedMesh& mesh, const RecombineOptions& options, RecombineReport* report) {
    require_options(options);
    require_cells(mesh, options.kept_edges, options.walls);
    RecombineReport own;
    return Recombiner(mesh, options, report ? *report = {} : own).run();
}

}  // namespace octafield::volume
