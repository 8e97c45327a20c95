// Names of events and sums of counts.
#include "dsc/kernel/step_report.hpp"

namespace dsc::kernel {
namespace {

struct Kind {
    std::string_view name;
    std::uint64_t EventCounts::*count;
};
// In the order of Event::Kind.
constexpr std::array kinds = {
    Kind{"merge", &EventCounts::merge},
    Kind{"split", &EventCounts::split},
    Kind{"handle_opened", &EventCounts::handle_opened},
    Kind{"handle_closed", &EventCounts::handle_closed},
    Kind{"vanished", &EventCounts::vanished},
    Kind{"born", &EventCounts::born},
    Kind{"unpinched", &EventCounts::unpinched},
};

}  // namespace

std::string_view name(Event::Kind kind) { return kinds[static_cast<std::size_t>(kind)].name; }

void EventCounts::add(Event::Kind kind) { ++(this->*kinds[static_cast<std::size_t>(kind)].count); }

EventCounts& EventCounts::operator+=(const EventCounts& other) {
    for (const Kind& kind : kinds) this->*kind.count += other.*kind.count;
    return *this;
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
