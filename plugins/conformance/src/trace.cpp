#include "trace.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <fmt/core.h>

namespace dsc::conformance {
namespace {

// a signalling NaN with a special payload
constexpr std::uint64_t unwritten_bits = 0x7ff4dead0000beefULL;

}  // namespace

double unwritten() { return std::bit_cast<double>(unwritten_bits); }

// A copy of a signalling NaN may become quiet, which sets one bit.
bool is_unwritten(double value) {
    constexpr std::uint64_t quiet = 0x0008000000000000ULL;
    return (std::bit_cast<std::uint64_t>(value) | quiet) == (unwritten_bits | quiet);
}

void Trace::part(std::string name, std::size_t width) {
    parts_.push_back({std::move(name), values_.size(), width});
}

std::vector<Trace::Stretch> Trace::stretches() const {
    std::vector<Stretch> all;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const std::size_t end = i + 1 < parts_.size() ? parts_[i + 1].begin : values_.size();
        all.push_back({parts_[i].begin, end, parts_[i].width, parts_[i].name});
    }
    return all;
}

std::string Trace::place(std::size_t index) const {
    const auto behind = std::find_if(parts_.begin(), parts_.end(),
                                     [index](const Part& p) { return p.begin > index; });
    if (behind == parts_.begin()) return "value " + std::to_string(index);
    const Part& part = *(behind - 1);
    return fmt::format("entry {} of {}", (index - part.begin) / part.width, part.name);
}

std::optional<std::string> Trace::difference(const Trace& a, const Trace& b) {
    const std::size_t count = std::min(a.values_.size(), b.values_.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (std::bit_cast<std::uint64_t>(a.values_[i]) ==
            std::bit_cast<std::uint64_t>(b.values_[i]))
            continue;
        return fmt::format("{}: {:.17g} against {:.17g}", a.place(i), a.values_[i], b.values_[i]);
    }
    if (a.values_.size() == b.values_.size()) return std::nullopt;
    return fmt::format("{} against {} numbers, equal up to {}", a.values_.size(), b.values_.size(),
                       count == 0 ? "nothing" : a.place(count - 1));
}

std::optional<std::size_t> Trace::first_not_finite() const {
    const auto found = std::find_if(values_.begin(), values_.end(), [](double value) {
        return !std::isfinite(value) && !is_unwritten(value);
    });
    return found == values_.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - values_.begin()));
}

std::optional<std::size_t> Trace::first_unwritten() const {
    const auto found = std::find_if(values_.begin(), values_.end(), is_unwritten);
    return found == values_.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - values_.begin()));
}

}  // namespace dsc::conformance
