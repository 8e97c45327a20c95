#pragma once
// Remembers which smoothings were refused, so that they are not tried again in vain (method.md,
// section 6.2).

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <dsc/mesh/complex.hpp>
#include <dsc/repair/contract.hpp>

namespace dsc::kernel {

/// The kinds of smoothing for which refusals are remembered.
enum class Smoother : std::uint8_t { laplacian, optimise };

/// A refused smoothing would be refused again as long as nothing in the vertex' star has changed.
/// Threads may ask and note at the same time if each has vertices of its own and grow() was called.
class RefusalMemory {
public:
    /// Makes room for this number of vertex slots. [step]
    void grow(std::size_t slots) {
        if (memory_.size() < slots) memory_.resize(slots);
    }
    /// Forgets all refusals, because the limits have changed. [step]
    void clear() { memory_.clear(); }

    /// The reason of the last refusal, or nothing if an attempt is useful.
    std::optional<repair::Refusal> find(const mesh::Complex& complex, mesh::VertexId v,
                                        Smoother smoother, float accept_above) const {
        if (v >= memory_.size()) return std::nullopt;
        const auto i = static_cast<std::size_t>(smoother);
        const Entry& entry = memory_[v];
        if (complex.vertex_date(v) > entry.date[i] || !entry.last[i].refused()) return std::nullopt;
        if (smoother == Smoother::laplacian && entry.accept_above != accept_above)
            return std::nullopt;
        return entry.last[i].reason();
    }
    /// Notes a refusal when the change clock was `date`.
    void note(mesh::VertexId v, Smoother smoother, float accept_above, repair::Refusal refusal,
              std::uint32_t date) {
        const auto i = static_cast<std::size_t>(smoother);
        Entry& entry = memory_[v];
        entry.date[i] = date;
        entry.last[i] = refusal;
        if (smoother == Smoother::laplacian) entry.accept_above = accept_above;
    }

private:
    // By kind of smoothing: the change clock and the reason. If another vertex takes the slot, its
    // star is younger than the remembered clock.
    struct Entry {
        std::array<std::uint32_t, 2> date = {0, 0};
        float accept_above = 0.0F;  // of the Laplacian; the other kind has no bound
        std::array<repair::Outcome, 2> last = {};
    };
    std::vector<Entry> memory_;  // per vertex
};

}  // namespace dsc::kernel
