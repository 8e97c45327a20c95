#pragma once
// Wrappers for strategies of each kind: they guard every call, set the strategy's own instance
// number in the contexts, and check the answers. Catalogue::create returns only wrapped strategies.

#include <atomic>
#include <memory>
#include <string>
#include <string_view>

#include <dsc/plugin/guarded.hpp>

namespace dsc::plugin {

/// The usual remedy for faults that only the authors of a plugin can remove.
inline constexpr std::string_view report_it = "report this to the plugin's authors";

/// An entry of a list, as messages name it: "normal 3".
inline std::string entry(std::string_view what, std::size_t index) {
    return std::string(what) + " " + std::to_string(index);
}

/// Identifies the wrapped strategy.
struct Attribution {
    Identity who;
    std::uint64_t instance = 0;

    Call call(std::string_view hook, std::optional<std::uint64_t> step = std::nullopt) const {
        return {who, hook, step};
    }
};

/// Checks attributes of a surface: one finite number per vertex, under allowed names that differ.
/// Throws StrategyFailure.
void check_answer(const Call& current, const hooks::Attributes& attributes, std::size_t vertices);

/// Checks the angles of a rule for creases: above 0, at most pi. Throws StrategyFailure.
void check_answer(const Call& current, const std::optional<repair::CreaseRule>& creases);

/// Refuses figures with names that are not snake_case or that repeat, and values that are not
/// finite.
void check_answer(const Call& current, const hooks::Figures& figures);
/// Refuses warnings without a text, and codes that are not lower-case words joined by dots.
void check_answer(const Call& current, const hooks::Warnings& warnings);

/// Save and load of a wrapped hook of any kind.
template <class Hook>
class Checked : public Hook {
public:
    Checked(std::unique_ptr<Hook> inner, Attribution attribution)
        : inner_(std::move(inner)), attribution_(std::move(attribution)) {}

    void save(std::ostream& out) const override {
        const std::uint64_t step = last_step_.load(std::memory_order_relaxed);
        guarded(call("save", step == no_step ? std::nullopt : std::optional(step)),
                [&] { inner_->save(out); });
    }
    void load(std::istream& in) override {
        guarded(call("load"), [&] { inner_->load(in); });
    }

protected:
    Hook& inner() { return *inner_; }
    const Hook& inner() const { return *inner_; }
    std::uint64_t instance() const { return attribution_.instance; }
    Call call(std::string_view hook, std::optional<std::uint64_t> step = std::nullopt) const {
        return attribution_.call(hook, step);
    }
    /// The answer of a guarded call of this hook, after check_answer() has accepted it.
    template <class Ask>
    auto checked_answer(std::string_view hook, Ask ask,
                        std::optional<std::uint64_t> step = std::nullopt) const {
        const Call current = call(hook, step);
        auto answer = guarded(current, ask);
        check_answer(current, answer);
        return answer;
    }
    /// The context with the strategy's own instance number.
    hooks::StepContext own(const hooks::StepContext& context) const {
        hooks::StepContext copy = context;
        copy.instance = attribution_.instance;
        last_step_.store(context.step, std::memory_order_relaxed);
        return copy;
    }

private:
    static constexpr std::uint64_t no_step = ~std::uint64_t{0};

    std::unique_ptr<Hook> inner_;
    mutable std::atomic<std::uint64_t> last_step_{no_step};  // of the contexts so far
    Attribution attribution_;
};

std::unique_ptr<hooks::Strategy> check_velocity(std::unique_ptr<hooks::VelocityField> inner,
                                                Attribution attribution);
std::unique_ptr<hooks::Strategy> check_curvature(std::unique_ptr<hooks::CurvatureEstimator> inner,
                                                 Attribution attribution);
std::unique_ptr<hooks::Strategy> check_refinement(std::unique_ptr<hooks::RefinementPolicy> inner,
                                                  Attribution attribution);
std::unique_ptr<hooks::Strategy> check_initial_mesh(std::unique_ptr<hooks::InitialMesh> inner,
                                                    Attribution attribution);
std::unique_ptr<hooks::Strategy> check_improvement(std::unique_ptr<hooks::Improvement> inner,
                                                   Attribution attribution);
std::unique_ptr<hooks::Strategy> check_observer(std::unique_ptr<hooks::Observer> inner,
                                                Attribution attribution);
std::unique_ptr<hooks::Strategy> check_filter(std::unique_ptr<hooks::CloudFilter> inner,
                                              Attribution attribution);

}  // namespace dsc::plugin
