// What a strategy asks for reaches the host through the strategy's wrapper.
#include <doctest/doctest.h>

#include "fake_catalogue.hpp"

namespace {

namespace hooks = dsc::hooks;

template <class Hook, bool Faces, bool Support>
struct Asking : Hook {
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Asking() = default;
    bool needs_faces_of_points() const override { return Faces; }
    bool needs_support() const override { return Support; }
};

template <bool Faces, bool Support>
struct Velocity final : Asking<hooks::VelocityField, Faces, Support> {
    using Params = typename Asking<hooks::VelocityField, Faces, Support>::Params;
    Velocity(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const hooks::StepContext&) override {}
    void evaluate(hooks::Range, std::span<dsc::Vec3>) const override {}
};
template <bool Faces, bool Support>
struct Refinement final : Asking<hooks::RefinementPolicy, Faces, Support> {
    using Params = typename Asking<hooks::RefinementPolicy, Faces, Support>::Params;
    Refinement(const Params&, const dsc::plugin::Setup&) {}
    void refine(const hooks::RefinementContext&, hooks::RefinementRequests&) override {}
};
template <bool Faces, bool Support>
struct Observer final : Asking<hooks::Observer, Faces, Support> {
    using Params = typename Asking<hooks::Observer, Faces, Support>::Params;
    Observer(const Params&, const dsc::plugin::Setup&) {}
    void begin(const hooks::StepContext&) override {}
    hooks::Figures step(const hooks::StepContext&, const hooks::StepFigures&) override {
        return {};
    }
    hooks::Figures end(const hooks::StepContext&) override { return {}; }
};

template <class Hook>
void check_needs(const FakeCatalogue& catalogue, const char* id, bool faces, bool support) {
    const auto strategy = catalogue.create<Hook>({id, {}}, "here");
    CHECK(strategy->needs_faces_of_points() == faces);
    CHECK(strategy->needs_support() == support);
}

template <bool Faces, bool Support>
void check_kinds() {
    FakeCatalogue catalogue;
    catalogue.add<Velocity<Faces, Support>>("asking", "a velocity");
    catalogue.add<Refinement<Faces, Support>>("asking", "a refinement");
    catalogue.add<Observer<Faces, Support>>("asking", "an observer");
    check_needs<hooks::VelocityField>(catalogue, "asking", Faces, Support);
    check_needs<hooks::RefinementPolicy>(catalogue, "asking", Faces, Support);
    check_needs<hooks::Observer>(catalogue, "asking", Faces, Support);
}

}  // namespace

TEST_CASE("faces of points and support are asked for through the wrapper") {
    check_kinds<false, false>();
    check_kinds<true, false>();
    check_kinds<false, true>();
    check_kinds<true, true>();
}
