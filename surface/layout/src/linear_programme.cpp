#include "linear_programme.hpp"

#include <coin/Cbc_C_Interface.h>

#include <memory>

namespace octafield::surface::detail {

std::optional<std::vector<double>> LinearProgramme::least(const LinearSum& sum) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const std::size_t numbers = most.size();
    if (numbers == 0) return std::vector<double>{};
    std::vector<std::map<int, double>> columns(numbers);
    std::vector<double> below, above;
    const auto add_row = [&](const LinearSum& row, double high) {
        for (const auto& [number, factor] : row.factors)
            if (factor != 0) columns[number][static_cast<int>(below.size())] = factor;
        below.push_back(-row.constant);
        above.push_back(high);
    };
    for (const LinearSum& row : none) add_row(row, -row.constant);
    for (const LinearSum& row : enough) add_row(row, infinite);
    std::vector<int> starts = {0}, rows;
    std::vector<double> values;
    for (const auto& column : columns) {
        for (const auto& [row, value] : column) {
            rows.push_back(row);
            values.push_back(value);
        }
        starts.push_back(static_cast<int>(rows.size()));
    }
    std::vector<double> cost(numbers, 0), low(numbers, 0);
    for (const auto& [number, factor] : sum.factors) cost[number] = factor;
    const std::unique_ptr<Cbc_Model, void (*)(Cbc_Model*)> model(Cbc_newModel(), Cbc_deleteModel);
    Cbc_setParameter(model.get(), "log", "0");
    Cbc_setLogLevel(model.get(), 0);
    Cbc_loadProblem(model.get(), static_cast<int>(numbers), static_cast<int>(below.size()), starts.data(), rows.data(),
                    values.data(), low.data(), most.data(), cost.data(), below.data(), above.data());
    Cbc_solve(model.get());
    const double* found = Cbc_getColSolution(model.get());
    if (!found || !Cbc_isProvenOptimal(model.get())) return {};
    return std::vector<double>(found, found + numbers);
}

}  // namespace octafield::surface::detail
