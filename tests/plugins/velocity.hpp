#pragma once
// A velocity that does not move, for plugins whose fault is elsewhere.

#include <algorithm>

#include <dsc/plugin/plugin.hpp>

namespace {

class Still final : public dsc::hooks::VelocityField {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Still(const Params&, const dsc::plugin::Setup&) {}
    void prepare(const dsc::hooks::StepContext&) override {}
    void evaluate(dsc::hooks::Range, std::span<dsc::Vec3> out) const override {
        std::fill(out.begin(), out.end(), dsc::Vec3::Zero());
    }
};

}  // namespace
