// The rotation vectors (world axes) that boundary constraints allow to the frames of a field, site by site.
#pragma once

#include <vector>

#include "octafield/parallel.hpp"
#include "octafield/volume/boundary.hpp"

namespace octafield::volume {

class ConstraintTurns {
public:
    explicit ConstraintTurns(const BoundaryConstraints& constraints)
        : constraints_(constraints), unknowns_(constraints.kind.size()), place_(constraints.kind.size()) {
        Index count = 0;
        for (std::size_t v = 0; v < unknowns_.size(); ++v) {
            unknowns_[v] = static_cast<std::uint8_t>(info(constraints.kind[v]).unknowns);
            if (unknowns_[v] == 1 || unknowns_[v] == 2) place_[v] = count++;
        }
        bases_.resize(count);
    }

    // At other frames, on the constraints.
    void move_to(const Quaternions& frames, int threads) {
        parallel_for(frames.rows(), threads, [&](std::int64_t row) {
            const auto v = static_cast<Index>(row);
            if (unknowns_[v] == 0 || unknowns_[v] == 3) return;
            visit(v, [&]<class Kind>(const Kind& kind) {
                bases_[place_[v]].template leftCols<Kind::unknowns>() =
                    kind.tangents(frames::from_wxyz(frames::Vector4(frames.row(v).transpose())));
            });
        });
    }

    int unknowns(std::int64_t v) const { return unknowns_[v]; }
    // Of a site held in part: (3, unknowns), orthonormal; what is beyond has no meaning.
    const TangentBasis<2>& basis(std::int64_t v) const { return bases_[place_[v]]; }

    // The part of a rotation vector that is allowed.
    template <class Real>
    Eigen::Matrix<Real, 3, 1> allowed(std::int64_t v, const Eigen::Matrix<Real, 3, 1>& w) const {
        switch (unknowns_[v]) {
            case 3:
                return w;
            case 0:
                return Eigen::Matrix<Real, 3, 1>::Zero();
            case 1: {
                const Eigen::Matrix<Real, 3, 1> axis = basis(v).col(0).cast<Real>();
                return axis * axis.dot(w);
            }
            default: {
                const Eigen::Matrix<Real, 3, 2> plane = basis(v).cast<Real>();
                return plane * (plane.transpose() * w);
            }
        }
    }

    // The frame q of the site, where the bases are, turned by the allowed part of w. An unmoved frame keeps its bits.
    frames::Quaternion turned(std::int64_t v, const frames::Quaternion& q, const frames::Vector3& w) const {
        if (unknowns_[v] == 0 || w.isZero(0)) return q;
        if (unknowns_[v] == 3) return (frames::exp(w) * q).normalized();
        frames::Quaternion result = q;
        visit(static_cast<Index>(v), [&]<class Kind>(const Kind& kind) {
            const TangentBasis<Kind::unknowns> tangents = basis(v).template leftCols<Kind::unknowns>();
            const Turn<Kind::unknowns> turn = tangents.transpose() * w;
            if (!turn.isZero(0)) result = kind.turned(q, turn);
        });
        return result;
    }

private:
    // visit(kind) at a site held in part.
    template <class Visit>
    void visit(Index v, const Visit& visit) const {
        ConstraintKinds::visit(constraints_.kind[v], constraints_.of(v), [&]<class Kind>(const Kind& kind) {
            if constexpr (PartialConstraintKind<Kind>) visit(kind);
        });
    }

    const BoundaryConstraints& constraints_;
    std::vector<std::uint8_t> unknowns_;
    std::vector<Index> place_;  // in bases_, of sites held in part
    std::vector<TangentBasis<2>> bases_;
};

}  // namespace octafield::volume
