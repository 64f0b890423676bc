#include "constraint_spaces.hpp"

namespace octafield::volume {

using frames::Quaternion;
using frames::Sh4;
using frames::Vector4;

ConstraintSpaces::ConstraintSpaces(const BoundaryConstraints& constraints, const Quaternions& frames,
                                   const BlockLaplacian& laplacian)
    : place_(constraints.kind.size(), free) {
    given_ = Sh4Field::Zero(frames.rows(), Sh4::dimension);
    for (Index v = 0; v < frames.rows(); ++v) {
        const Quaternion q = frames::from_wxyz(Vector4(frames.row(v).transpose()));
        const int unknowns = laplacian.is_isolated(v) ? 0 : info(constraints.kind[v]).unknowns;
        if (unknowns == 3) continue;
        if (unknowns == 0) {
            place_[v] = held;
            given_.row(v) = Sh4::embed(q).transpose();
            continue;
        }
        place_[v] = static_cast<Index>(spaces_.size());
        ConstraintKinds::visit(constraints.kind[v], constraints.of(v), [&]<class Kind>(const Kind& kind) {
            if constexpr (PartialConstraintKind<Kind>) {
                const typename Kind::Space space(kind, q);
                given_.row(v) = space.centre().transpose();
                spaces_.emplace_back(space);
            }
        });
    }
}

}  // namespace octafield::volume
