// Names of events and sums of counts.
#include "dsc/kernel/step_report.hpp"

namespace dsc::kernel {
namespace {

struct CountedKind {
    std::string_view name;
    std::uint64_t EventCounts::*count;
};
// In the order of Event::Kind.
constexpr std::array counted_kinds = {
    CountedKind{"merge", &EventCounts::merge},
    CountedKind{"split", &EventCounts::split},
    CountedKind{"handle_opened", &EventCounts::handle_opened},
    CountedKind{"handle_closed", &EventCounts::handle_closed},
    CountedKind{"vanished", &EventCounts::vanished},
    CountedKind{"born", &EventCounts::born},
    CountedKind{"unpinched", &EventCounts::unpinched},
};

}  // namespace

std::string_view name(Event::Kind kind) {
    return counted_kinds[static_cast<std::size_t>(kind)].name;
}

void EventCounts::add(Event::Kind kind) {
    ++(this->*counted_kinds[static_cast<std::size_t>(kind)].count);
}

EventCounts& EventCounts::operator+=(const EventCounts& other) {
    for (const CountedKind& kind : counted_kinds) this->*kind.count += other.*kind.count;
    return *this;
}

OperationCounts& OperationCounts::operator+=(const OperationCounts& other) {
    tried += other.tried;
    committed += other.committed;
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += other.refused[i];
    return *this;
}

}  // namespace dsc::kernel
