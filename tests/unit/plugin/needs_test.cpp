// What a strategy asks for reaches the host through the strategy's wrapper.
#include <doctest/doctest.h>

#include "fake_catalogue.hpp"

namespace {

template <class Hook, bool Faces, bool Support>
struct Asking : Hook {
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Asking() = default;
    bool needs_faces_of_points() const override { return Faces; }
    bool needs_support() const override { return Support; }
};

template <bool Faces, bool Support>
struct AskingVelocity final : Asking<dsc::hooks::VelocityField, Faces, Support> {
    using Params = typename Asking<dsc::hooks::VelocityField, Faces, Support>::Params;
    AskingVelocity(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<dsc::Vec3>) const override {}
};
template <bool Faces, bool Support>
struct AskingRefinement final : Asking<dsc::hooks::RefinementPolicy, Faces, Support> {
    using Params = typename Asking<dsc::hooks::RefinementPolicy, Faces, Support>::Params;
    AskingRefinement(const Params&, const dsc::plugin::Setup&) {}
    void refine(const dsc::hooks::RefinementContext&, dsc::hooks::RefinementRequests&) override {}
};
template <bool Faces, bool Support>
struct AskingObserver final : Asking<dsc::hooks::Observer, Faces, Support> {
    using Params = typename Asking<dsc::hooks::Observer, Faces, Support>::Params;
    AskingObserver(const Params&, const dsc::plugin::Setup&) {}
    void begin(const dsc::hooks::StepContext&) override {}
    dsc::hooks::Figures step(const dsc::hooks::StepContext&,
                             const dsc::hooks::StepFigures&) override {
        return {};
    }
    dsc::hooks::Figures end(const dsc::hooks::StepContext&) override { return {}; }
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
    catalogue.add<AskingVelocity<Faces, Support>>("asking", "a velocity");
    catalogue.add<AskingRefinement<Faces, Support>>("asking", "a refinement");
    catalogue.add<AskingObserver<Faces, Support>>("asking", "an observer");
    check_needs<dsc::hooks::VelocityField>(catalogue, "asking", Faces, Support);
    check_needs<dsc::hooks::RefinementPolicy>(catalogue, "asking", Faces, Support);
    check_needs<dsc::hooks::Observer>(catalogue, "asking", Faces, Support);
}

}  // namespace

TEST_CASE("faces of points and support are asked for through the wrapper") {
    check_kinds<false, false>();
    check_kinds<true, false>();
    check_kinds<false, true>();
    check_kinds<true, true>();
}
