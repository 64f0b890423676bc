#include "octafield/frames/sh4_projection.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "octafield/error.hpp"
#include "sh4_kernel.hpp"

namespace octafield::frames {
namespace {

// Rows of `width` numbers; a row is bad if one of them is not finite or, on demand, all are zero.
void require_rows(const double* rows, int width, std::int64_t n, bool nonzero, const std::string& what) {
    std::vector<std::int32_t> bad;
    for (std::int64_t i = 0; i < n; ++i) {
        // x - x is 0 for finite x and NaN otherwise.
        double difference = 0, largest = 0;
        for (int c = 0; c < width; ++c) {
            const double x = rows[width * i + c];
            difference += x - x;
            largest = std::max(largest, std::abs(x));
        }
        if (!(difference == 0) || (nonzero && !(largest > 0))) bad.push_back(static_cast<std::int32_t>(i));
    }
    if (bad.empty()) return;
    throw InvalidInput(what + " is not finite" + (nonzero ? " or zero" : "") + " (row " + first_few(bad) + ")",
                       "non_finite", bad);
}

void project_with(const sh4::Kernel& kernel, const double* v, const double* guess, std::int64_t n, double* frames,
                  double* distances) {
    require_rows(v, 9, n, false, "the vector to project");
    if (guess) require_rows(guess, 4, n, true, "the guessed quaternion");
    const sh4::Tables& tables = sh4::tables();
    for (std::int64_t first = 0; first < n; first += sh4::chunk)
        kernel.project(tables, v + 9 * first, guess ? guess + 4 * first : nullptr,
                       static_cast<int>(std::min<std::int64_t>(sh4::chunk, n - first)), frames + 4 * first,
                       distances + first);
}

}  // namespace

void sh4_project(const double* v, const double* guess, std::int64_t n, double* frames, double* distances) {
    project_with(sh4::kernels().front(), v, guess, n, frames, distances);
}

void sh4_project(const double* v, const double* guess, std::int64_t n, double* frames, double* distances,
                 std::string_view instruction_set) {
    for (const sh4::Kernel& kernel : sh4::kernels())
        if (kernel.name == instruction_set) return project_with(kernel, v, guess, n, frames, distances);
    throw InvalidInput(
        "instruction set \"" + std::string(instruction_set) + "\" is not available here; see sh4_instruction_sets()",
        "unknown_instruction_set");
}

std::vector<std::string_view> sh4_instruction_sets() {
    std::vector<std::string_view> names;
    for (const sh4::Kernel& kernel : sh4::kernels()) names.push_back(kernel.name);
    return names;
}

}  // namespace octafield::frames
