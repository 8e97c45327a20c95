#pragma once
// Parts of an exercise: outputs with margins, a velocity for refinements, comparison by bytes.

#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <dsc/hooks/velocity_field.hpp>

#include "trace.hpp"

namespace dsc::conformance {

// An output with guard entries before and after it, which a strategy must not write.
template <class T>
class Output {
    static constexpr std::size_t margin = 32;

public:
    Output(std::size_t size, const T& fill) : memory_(size + 2 * margin, fill) {}
    std::span<T> entries() {
        return std::span(memory_).subspan(margin, memory_.size() - 2 * margin);
    }
    // "2 entries after its end", or nothing.
    std::string touched() const {
        for (std::size_t i = 0; i < margin; ++i) {
            if (!untouched(memory_[margin - 1 - i]))
                return std::to_string(i + 1) + " entries before its beginning";
            if (!untouched(memory_[memory_.size() - margin + i]))
                return std::to_string(i + 1) + " entries after its end";
        }
        return {};
    }

private:
    static bool untouched(double value) { return is_unwritten(value); }
    static bool untouched(const Vec3& value) {
        return is_unwritten(value.x()) && is_unwritten(value.y()) && is_unwritten(value.z());
    }
    std::vector<T> memory_;
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// A velocity along the normals that decreases with the distance from the middle and scales with the
// surface, for refinements to read.
class Breathing final : public hooks::VelocityField {
public:
    void prepare(const hooks::StepContext& context) override { surface_ = &context.surface; }
    void evaluate(hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const bool rests = surface_->births[range.begin + i] % 3 != 0;
            out[i] = rests ? Vec3::Zero()
                           : Vec3(0.1 * surface_->mean_edge * surface_->normals[range.begin + i]);
        }
    }
    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = (0.05 * std::abs(points[i].x())) * unit_normals[i];
    }

private:
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::conformance
