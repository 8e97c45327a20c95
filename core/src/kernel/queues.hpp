#pragma once
// The tets that a repair round must look at, and the audit that proves that none is missed
// (method.md, section 6.2).

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/large_vector.hpp>
#include <dsc/base/parallel_filter.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::kernel {

using mesh::TetId;
using mesh::VertexId;

/// Changed tets and remembered failures. A failed tet is offered again only after a tet at one of
/// its vertices has changed.
class RepairQueues {
public:
    /// `drop_wake_up`: for tests of the audit, the n-th wake-up from now is dropped; 0: none.
    RepairQueues(mesh::Complex& complex, bool audit, std::uint64_t drop_wake_up)
        : complex_(complex), audit_(audit), drop_(drop_wake_up) {}

    /// Collects the tets of the round: first those that changed since the last call, then tets
    /// whose failure is out of date. Throws GeometryError if the audit finds a missed tet.
    /// `workers`: null for one thread. [step]
    std::span<const TetId> next_round(Workers* workers);
    /// Those tets of the round whose failure was out of date.
    std::span<const TetId> woken() const { return std::span(dirty_).subspan(changed_); }
    /// The tets of the round are not needed any more. Their memory serves for the next changes.
    /// [step]
    void forget_round() {
        complex_.reuse(dirty_);
        changed_ = 0;
    }
    /// Remembers that a request on this tet was refused in this round, when the change clock was
    /// `date`. `birth_date` is that of the tet.
    void fail(TetId t, std::uint32_t birth_date, std::uint32_t date);
    /// Whether a blocked vertex may be tried again: its star has changed since `blocked_at`.
    bool awake(VertexId v, std::uint32_t blocked_at);

    std::size_t failures() const { return failed_.size(); }

    /// The dates of the complex have been replaced. Between rounds. [step]
    void renew(const mesh::DateRanks& ranks);

    /// Between rounds. The audit starts again with an empty memory. [step]
    void save(StateWriter& out) const;
    void load(StateReader& in);

private:
    struct Failure {
        TetId tet;
        std::uint32_t birth_date;
        std::uint32_t date;
    };
    enum class Verdict : std::uint8_t { drop, keep, wake };
    Verdict judge(const Failure& failure, std::uint32_t previous_clock) const {
        const TetId t = failure.tet;
        if (!complex_.tet_alive(t) || complex_.birth_date(t) != failure.birth_date)
            return Verdict::drop;
        // Tets that changed since the last round are already in the list.
        if (complex_.date(t) > previous_clock) return Verdict::drop;
        return out_of_date(t, failure.date) ? Verdict::wake : Verdict::keep;
    }
    void drop_dead(Workers* workers);
    void drop_changed_failures(std::uint32_t previous_clock, Workers* workers);
    void judge_all(std::uint32_t previous_clock, Workers& workers);

    bool lost() { return drop_ != 0 && --drop_ == 0; }
    bool out_of_date(TetId t, std::uint32_t date) const {
        const auto& v = complex_.tet(t).v;
        return std::any_of(v.begin(), v.end(),
                           [&](VertexId x) { return complex_.vertex_date(x) > date; });
    }
    void check(std::uint32_t previous_clock);

    mesh::Complex& complex_;
    bool audit_;
    std::uint64_t drop_;
    LargeVector<TetId> dirty_;
    std::size_t changed_ = 0;  // how many of them have changed; they come first
    std::vector<Failure> failed_;
    std::vector<Failure> failed_now_;
    mesh::TetIndex seen_;
    std::vector<Verdict> verdicts_;  // per failure; for several threads
    std::vector<Failure> memory_;    // audit only, per tet: its last failure, independent of the
                                     // queues
    ParallelFilter filter_;
    std::uint32_t last_clock_ = 0;
};

}  // namespace dsc::kernel
