// Witnesses of prepare.*: state that changes where a strategy shall only prepare.
#include <istream>
#include <ostream>
#include <stdexcept>

#include "witness.hpp"

namespace {

using dsc::Vec3;
using witness::Velocity;

// Counts its preparations, and saves the count; no answer depends on it.
class Counting final : public Velocity {
public:
    using Velocity::Velocity;
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        ++count_;
    }
    void save(std::ostream& out) const override { out << count_ << "\n"; }
    void load(std::istream& in) override {
        if (!(in >> count_)) throw std::runtime_error("no state");
    }

private:
    int count_ = 0;
};

// Momentum from the displacements that were prepared last. If a refinement prepares it between two
// steps, they are not those of the last step.
class Momentum final : public Velocity {
public:
    using Velocity::Velocity;
    void advance(const dsc::hooks::StepContext&) override { before_ = now_; }
    void prepare(const dsc::hooks::StepContext& context) override {
        Velocity::prepare(context);
        length_ = context.target_length;
        now_.resize(context.surface.vertex_count());
        for (std::size_t v = 0; v < now_.size(); ++v) {
            now_[v] = Velocity::displacement(v);
            if (before_.size() == now_.size()) now_[v] += 0.5 * before_[v];
        }
    }
    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3>, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = 0.01 * length_ * unit_normals[i];
    }
    void save(std::ostream& out) const override {
        out.precision(17);
        out << now_.size();
        for (const Vec3& d : now_) out << " " << d.x() << " " << d.y() << " " << d.z();
        out << "\n";
    }
    void load(std::istream& in) override {
        std::size_t count = 0;
        if (!(in >> count) || count > 1000000) throw std::runtime_error("no state");
        now_.assign(count, Vec3::Zero());
        for (Vec3& d : now_) {
            if (!(in >> d.x() >> d.y() >> d.z())) throw std::runtime_error("no state");
        }
    }

protected:
    Vec3 displacement(std::size_t vertex) const override { return now_[vertex]; }

private:
    std::vector<Vec3> before_, now_;
    double length_ = 0.0;
};

// A curvature that depends on how often the size of the surface has changed.
class Startled final : public dsc::hooks::CurvatureEstimator {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Startled(const Params&, const dsc::plugin::Setup&) {}

    void prepare(const dsc::hooks::StepContext& context) override {
        context_ = &context;
        length_ = context.target_length;
        if (context.surface.vertex_count() == size_) return;
        size_ = context.surface.vertex_count();
        ++changes_;
    }
    void evaluate(dsc::hooks::Range range, std::span<double> scalar,
                  std::span<Vec3> vector) const override {
        for (std::size_t i = 0; i < scalar.size(); ++i) {
            scalar[i] = length_ > 0.0 ? changes_ / length_ : 0.0;
            vector[i] = scalar[i] * context_->surface.normals[range.begin + i];
        }
    }
    void save(std::ostream& out) const override { out << size_ << " " << changes_ << "\n"; }
    void load(std::istream& in) override {
        if (!(in >> size_ >> changes_)) throw std::runtime_error("no state");
    }

private:
    const dsc::hooks::StepContext* context_ = nullptr;
    double length_ = 0.0;
    std::size_t size_ = 0;
    int changes_ = 0;
};

}  // namespace

DSC_PLUGIN("bad_prepare", "1.0.0", "MIT", "Witnesses of prepare.*") {
    registrar.add<Counting>("prepare_state", "counts its preparations in its state");
    registrar.add<Momentum>("prepare_surface", "continues from what it has prepared last");
    registrar.add<Startled>("prepare_surface", "counts the surfaces that it has prepared for");
}
