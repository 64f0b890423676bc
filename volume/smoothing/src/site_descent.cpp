#include "site_descent.hpp"

#include <algorithm>

namespace octafield::volume {

SiteDescent::SiteDescent(const BlockLaplacian& laplacian, const ConstraintSpaces& spaces,
                         const FieldProjector& projector, int threads)
    : laplacian_(laplacian), spaces_(spaces), projector_(projector), threads_(threads) {
    const SparseMatrix& matrix = laplacian.matrix();
    constexpr int none = -1;
    std::vector<int> colour(matrix.rows(), none);
    std::vector<Index> taken_by;  // per colour: the last site next to one of that colour
    for (Index v = 0; v < matrix.rows(); ++v) {
        if (spaces.is_held(v)) continue;
        for (SparseMatrix::InnerIterator entry(matrix, v); entry; ++entry)
            if (const int c = colour[entry.row()]; c != none) taken_by[c] = v;
        std::size_t first = 0;
        while (first < taken_by.size() && taken_by[first] == v) ++first;
        if (first == taken_by.size()) {
            taken_by.push_back(none);
            colours_.emplace_back();
        }
        colour[v] = static_cast<int>(first);
        colours_[first].push_back(v);
    }
}

void SiteDescent::sweep(Sh4Field& field, Quaternions& frames) const {
    for (const std::vector<Index>& sites : colours_) {
        Sh4Field wanted(sites.size(), frames::Sh4::dimension);
        parallel_for(static_cast<std::int64_t>(sites.size()), threads_, [&](std::int64_t k) {
            const Index v = sites[k];
            wanted.row(k).setZero();
            for (SparseMatrix::InnerIterator entry(laplacian_.matrix(), v); entry; ++entry)
                if (entry.row() != v) wanted.row(k) -= entry.value() * field.row(entry.row());
        });
        projector_.project_sites(sites, wanted, field, frames);
    }
}

}  // namespace octafield::volume
