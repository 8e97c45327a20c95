#pragma once
// What a strategy written in Python sees: the contexts of the hooks as read-only NumPy arrays.

#include <memory>
#include <span>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <dsc/hooks/context.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/hooks/refinement_policy.hpp>

#include "lent.hpp"
#include "volume.hpp"

namespace dsc::python {

namespace py = pybind11;

/// The cloud; it shares the points, so it may be kept.
struct CloudView {
    cloud::TargetCloud cloud;
};

/// The velocity that a refinement may sample.
struct VelocityView {
    const hooks::VelocityField* velocity = nullptr;  ///< null after the call
};

/// The context of a step, and of a refinement.
class StepView {
public:
    explicit StepView(const hooks::StepContext& context)
        : context_(&context),
          volume_(std::make_shared<VolumeArrays>(VolumeArrays{context.volume})) {}
    explicit StepView(const hooks::RefinementContext& context)
        : context_(&context.step),
          refinement_(&context),
          volume_(std::make_shared<VolumeArrays>(VolumeArrays{context.step.volume})),
          velocity_(std::make_shared<VelocityView>(VelocityView{context.velocity})) {}

    /// Throws UsageError "python.context" after the call.
    const hooks::StepContext& context() const;
    const hooks::RefinementContext& refinement() const;
    const std::shared_ptr<VelocityView>& velocity() const { return velocity_; }
    const std::shared_ptr<VolumeArrays>& volume() const { return volume_; }
    Lent& lent() { return lent_; }

    /// Ends the call.
    void close();
    void abandon() noexcept;

private:
    const hooks::StepContext* context_;
    const hooks::RefinementContext* refinement_ = nullptr;
    std::shared_ptr<VolumeArrays> volume_;
    std::shared_ptr<VelocityView> velocity_;
    Lent lent_;
};

/// The context of a generator of initial meshes.
class BuildView {
public:
    explicit BuildView(const hooks::InitialMeshContext& context) : context_(&context) {}
    const hooks::InitialMeshContext& context() const;
    void close() { context_ = nullptr; }

private:
    const hooks::InitialMeshContext* context_;
};

/// Calls `body(python_object_of_the_context)` and closes the context whatever happens. The GIL must
/// be held.
template <class View, class Context, class Body>
auto with_view(const Context& context, Body&& body) {
    const auto view = std::make_shared<View>(context);
    try {
        auto result = body(py::cast(view));
        view->close();
        return result;
    } catch (...) {
        if constexpr (requires { view->abandon(); }) {
            view->abandon();
        } else {
            view->close();
        }
        throw;
    }
}

void declare_contexts(py::module_& module);

}  // namespace dsc::python
