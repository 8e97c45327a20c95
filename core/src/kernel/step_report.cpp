// Names of events and sums of counts.
#include "dsc/kernel/step_report.hpp"

namespace dsc::kernel {

std::string_view name(Event::Kind kind) {
    constexpr std::array<std::string_view, 7> names = {
        "merge", "split", "handle_opened", "handle_closed", "vanished", "born", "unpinched"};
    return names[static_cast<std::size_t>(kind)];
}

void OperationCounts::add(repair::Outcome outcome) {
    ++tried;
    ++(outcome.refused() ? refused[static_cast<std::size_t>(outcome.reason())] : committed);
}

OperationCounts& OperationCounts::operator+=(const OperationCounts& other) {
    tried += other.tried;
    committed += other.committed;
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += other.refused[i];
    return *this;
}

}  // namespace dsc::kernel
