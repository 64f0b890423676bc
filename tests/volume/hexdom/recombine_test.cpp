// recombine: hexahedra and wedges of tets.
#include <gtest/gtest.h>

#include "cell_choice.hpp"
#include "mixed_grids.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/recombination.hpp"
#include "octafield/volume/tetrahedralize.hpp"
#include "potential_cells.hpp"

namespace octafield::volume {
namespace {

using testing::CubeGrid;
using testing::expect_sound;
using testing::Filled;
using testing::outside;
using Vector = Eigen::Vector3d;

MixedMesh kuhn(int n, double jitter, unsigned seed) {
    return CubeGrid(
               {n, n, n}, [](int, int, int) { return Filled::kuhn; }, jitter, seed)
        .mesh();
}

TEST(Recombine, EveryCubeOfAGridComesBack) {
    for (const double jitter : {0.0, 0.05, 0.1, 0.15, 0.2}) {
        const MixedMesh mesh = kuhn(8, jitter, 7);
        RecombineReport report;
        const MixedMesh result = recombine(mesh, {}, &report);
        ConformReport conformed;
        const MixedMesh sound = conform(result, &conformed);
        expect_sound(sound);
        printf(
            "jitter %g: potential %d hexahedra %d of %d, wedges %d of %d, tets left %d, flat %d; combined %d raised %d "
            "split %d, least %g\n",
            jitter, report.potential_hexahedra, report.hexahedra, 512, report.wedges, report.potential_wedges,
            int(result.tets.rows()), report.flat_tets, conformed.combined, conformed.raised, conformed.split,
            scaled_jacobians(sound).minCoeff());
    }
}

}  // namespace
}  // namespace octafield::volume
