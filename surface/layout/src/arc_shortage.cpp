#include "arc_shortage.hpp"

#include <coin/Cbc_C_Interface.h>

#include <limits>
#include <map>
#include <memory>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double most_count = 1e6;
constexpr double nothing = 1e-6;

// The matrix of a programme, column after column.
struct Columns {
    std::vector<int> starts = {0}, rows;
    std::vector<double> values;
    void add(const std::map<int, double>& column) {
        for (const auto& [row, value] : column) {
            if (value == 0) continue;
            rows.push_back(row);
            values.push_back(value);
        }
        starts.push_back(static_cast<int>(rows.size()));
    }
};

}  // namespace

std::vector<double> arc_shortages(const ArcProblem& problem) {
    const auto arcs = static_cast<int>(problem.least.size());
    const auto sums = static_cast<int>(problem.sums.size());
    // Rows: the sums, then count + shortage >= least of each arc. Columns: the counts, then the shortages.
    std::vector<std::map<int, double>> of_arc(arcs);
    for (int s = 0; s < sums; ++s) {
        for (const Index arc : problem.sums[s].left) of_arc[arc][s] += 1;
        for (const Index arc : problem.sums[s].right) of_arc[arc][s] -= 1;
    }
    Columns columns;
    for (int a = 0; a < arcs; ++a) {
        of_arc[a][sums + a] = 1;
        columns.add(of_arc[a]);
    }
    for (int a = 0; a < arcs; ++a) columns.add({{sums + a, 1.0}});
    std::vector<double> low(2 * arcs, 0), high(2 * arcs, most_count), cost(2 * arcs, 0);
    for (int a = 0; a < arcs; ++a) cost[arcs + a] = 1;
    std::vector<double> below(sums + arcs, 0), above(sums + arcs, 0);
    for (int a = 0; a < arcs; ++a) {
        below[sums + a] = problem.least[a];
        above[sums + a] = std::numeric_limits<double>::infinity();
    }
    const std::unique_ptr<Cbc_Model, void (*)(Cbc_Model*)> model(Cbc_newModel(), Cbc_deleteModel);
    Cbc_setParameter(model.get(), "log", "0");
    Cbc_setLogLevel(model.get(), 0);
    Cbc_loadProblem(model.get(), 2 * arcs, sums + arcs, columns.starts.data(), columns.rows.data(),
                    columns.values.data(), low.data(), high.data(), cost.data(), below.data(), above.data());
    Cbc_solve(model.get());
    const double* found = Cbc_getColSolution(model.get());
    if (!found || Cbc_isProvenInfeasible(model.get()))
        throw SolverError("the arcs that stand in the way of whole numbers were not found", "solver_failed");
    std::vector<double> result(found + arcs, found + 2 * arcs);
    for (double& shortage : result)
        if (shortage < nothing) shortage = 0;
    return result;
}

}  // namespace octafield::surface::detail
