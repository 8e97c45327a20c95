#include "time_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace dsc::app {
namespace {

constexpr std::size_t remembered = 20;  // number of last steps whose cost counts
constexpr double cheap = 0.15;          // fraction of them that cost less than the cost used
constexpr double usual_growth = 1.35;   // growth of the vertices per refinement, until one was seen

}  // namespace

TimeEstimate::TimeEstimate(const std::vector<run::Series>& schedule) {
    for (const run::Series& item : schedule) {
        if (!item.steps) refinements_.push_back(planned_);
        for (std::uint64_t step = item.every.value_or(0);
             step != 0 && step <= item.steps.value_or(0); step += *item.every)
            refinements_.push_back(planned_ + step);
        planned_ += item.steps.value_or(0);
    }
}

std::uint64_t TimeEstimate::refinements_between(std::uint64_t from, std::uint64_t to) const {
    const auto at = [this](std::uint64_t step) {
        return std::lower_bound(refinements_.begin(), refinements_.end(), step);
    };
    return static_cast<std::uint64_t>(at(to) - at(from));
}

void TimeEstimate::add(std::uint64_t step, std::size_t interface_vertices, double seconds) {
    const double vertices = static_cast<double>(interface_vertices);
    if (step_ && step > *step_) {
        const auto refined = static_cast<double>(refinements_between(*step_, step));
        if (refined > 0 && vertices > 0 && vertices_ > 0) {
            growths_ += refined;
            growth_ += std::log(vertices / vertices_);
        }
        costs_.push_back((seconds - seconds_) /
                         (std::max(vertices, 1.0) * static_cast<double>(step - *step_)));
        if (costs_.size() > remembered) costs_.erase(costs_.begin());
    }
    step_ = step;
    vertices_ = vertices;
    seconds_ = seconds;
}

std::optional<double> TimeEstimate::remaining() const {
    if (costs_.empty()) return std::nullopt;
    std::vector<double> sorted = costs_;
    std::sort(sorted.begin(), sorted.end());
    const double cost =
        sorted[static_cast<std::size_t>(cheap * static_cast<double>(sorted.size() - 1))];
    const double factor = growths_ > 0 ? std::exp(growth_ / growths_) : usual_growth;
    double vertices = vertices_;
    double work = 0;
    std::uint64_t reached = *step_;
    for (auto next = std::lower_bound(refinements_.begin(), refinements_.end(), reached);
         next != refinements_.end() && *next < planned_; ++next) {
        work += vertices * static_cast<double>(*next - reached);
        reached = *next;
        vertices *= factor;
    }
    work += vertices * static_cast<double>(planned_ - std::min(reached, planned_));
    return work * cost;
}

}  // namespace dsc::app
