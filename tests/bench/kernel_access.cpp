#include "kernel_access.hpp"

#include <dsc/geometry/quality.hpp>
#include <dsc/kernel/deformer.hpp>

#include "kernel/movement.hpp"
#include "kernel/operations.hpp"

namespace dsc::bench {

struct Operations::State {
    explicit State(mesh::Complex start) : complex(std::move(start)), bench(complex) {}

    mesh::Complex complex;
    kernel::Workbench bench;
    kernel::DeformerOptions options;
};

Operations::Operations(mesh::Complex complex, double length)
    : state_(std::make_unique<State>(std::move(complex))) {
    const kernel::DeformerOptions& options = state_->options;
    kernel::Limits& limits = state_->bench.limits;
    limits.length = length;
    limits.quality_floor = options.quality_floor;
    limits.edit_distance = options.max_edit_distance * length;
    limits.edit_volume = options.max_edit_volume * geometry::regular_tet_volume(length);
}
Operations::~Operations() = default;
Operations::Operations(Operations&&) noexcept = default;
Operations& Operations::operator=(Operations&&) noexcept = default;

mesh::Complex& Operations::complex() { return state_->complex; }

bool Operations::move(mesh::VertexId v, const Vec3& destination) {
    return kernel::move_towards(state_->bench, v, destination, state_->options.free_path) !=
           kernel::Motion::blocked;
}

bool Operations::apply(const repair::Request& request) {
    last_ = kernel::execute(state_->bench, request);
    return !last_.refused();
}

bool Operations::remove_face(mesh::TetId t, unsigned face, float accept_above) {
    last_ = kernel::remove_faces(state_->bench, t, face, accept_above);
    return !last_.refused();
}

}  // namespace dsc::bench
