// The parts of a relabelling by a refinement: new labels, and the events that follow (method.md,
// section 8.6).
#include <algorithm>

#include "kernel/deformer_state.hpp"

namespace dsc::kernel {

Event Deformer::State::take_labels(std::span<const TetId> tets, std::span<const mesh::Label> labels,
                                   std::vector<VertexId>& touched) {
    Event event;
    event.step = step;
    for (std::size_t i = 0; i < tets.size(); ++i) {
        const TetId t = tets[i];
        if (t >= complex.tet_slots() || !complex.tet_alive(t) || complex.label(t) == labels[i])
            continue;
        const auto v = complex.tet(t).v;
        if (std::any_of(v.begin(), v.end(), [&](VertexId x) { return complex.on_box(x); }))
            continue;
        const double volume = complex.volume(t);
        event.label = complex.label(t);
        event.place = 0.25 * (complex.position(v[0]) + complex.position(v[1]) +
                              complex.position(v[2]) + complex.position(v[3]));
        event.volume += volume;
        bench.commit(Relabelling{std::span(&t, 1), labels[i], volume});
        touched.insert(touched.end(), v.begin(), v.end());
        ++event.tets;
    }
    std::sort(touched.begin(), touched.end(),
              [&](VertexId a, VertexId b) { return complex.birth(a) < complex.birth(b); });
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    return event;
}

void append_changes(const Event& event, const mesh::InterfaceCounts& before,
                    const mesh::InterfaceCounts& after, std::size_t unpinched,
                    std::vector<Event>& events) {
    const auto append = [&](Event::Kind kind, long times) {
        for (long i = 0; i < times; ++i) events.emplace_back(event).kind = kind;
    };
    const long shells = static_cast<long>(after.shells) - static_cast<long>(before.shells);
    append(Event::Kind::born, shells);
    append(Event::Kind::vanished, -shells);
    append(Event::Kind::handle_opened, after.genus() - before.genus());
    append(Event::Kind::handle_closed, before.genus() - after.genus());
    append(Event::Kind::unpinched, static_cast<long>(unpinched));
}

}  // namespace dsc::kernel
