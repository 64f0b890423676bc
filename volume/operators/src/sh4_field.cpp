#include "sh4_field.hpp"

#include "octafield/frames/quaternion.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {

Sh4Field embedded(const Quaternions& frames, int threads) {
    Sh4Field field(frames.rows(), frames::Sh4::dimension);
    parallel_for(frames.rows(), threads, [&](std::int64_t v) {
        field.row(v) = frames::Sh4::embed(frames::from_wxyz(frames::Vector4(frames.row(v).transpose()))).transpose();
    });
    return field;
}

}  // namespace octafield::volume
