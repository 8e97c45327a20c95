// The lists of changed and refused tets, and the audit that finds a missed tet (method.md,
// section 6.2).
#include "kernel/queues.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>
#include <dsc/mesh/date_ranks.hpp>

namespace dsc::kernel {
namespace {

constexpr std::size_t judged = 2048;  // tets that a thread judges at a time

}  // namespace

bool RepairQueues::awake(VertexId v, std::uint32_t blocked_at) {
    const bool changed = complex_.vertex_date(v) > blocked_at;
    return changed && !lost();
}

void RepairQueues::drop_dead(Workers* workers) {
    if (complex_.tet_count() == complex_.tet_slots() && drop_ == 0) return;
    filter_.keep_if(
        workers, dirty_, [this](TetId t) { return complex_.in_use(t) && !lost(); }, [](TetId) {});
}

// Nearly all refused tets have changed since the last round, and so have a place in the list.
void RepairQueues::drop_changed_failures(std::uint32_t previous_clock, Workers* workers) {
    filter_.keep_if(
        workers, failed_now_,
        [this, previous_clock](const Failure& failure) {
            return complex_.tet_alive(failure.tet) && complex_.date(failure.tet) <= previous_clock;
        },
        [this](const Failure& failure) { complex_.prefetch(failure.tet); });
}

void RepairQueues::judge_all(std::uint32_t previous_clock, Workers& workers) {
    verdicts_.resize(failed_.size());
    workers.for_blocks(failed_.size(), judged,
                       [this, previous_clock](std::size_t begin, std::size_t end) {
                           for (std::size_t i = begin; i < end; ++i)
                               verdicts_[i] = judge(failed_[i], previous_clock);
                       });
}

std::span<const TetId> RepairQueues::next_round(Workers* workers) {
    const std::uint32_t previous_clock = last_clock_;
    last_clock_ = complex_.clock();
    complex_.take_changes(dirty_);
    drop_dead(workers);
    changed_ = dirty_.size();
    drop_changed_failures(previous_clock, workers);
    // Of several failures of a slot in a round, the first one counts.
    seen_.clear();
    for (const Failure& failure : failed_now_) {
        if (seen_.insert(failure.tet)) failed_.push_back(failure);
    }
    failed_now_.clear();
    seen_.clear();
    // Several threads judge in advance; one thread judges each failure when it comes to it.
    const bool in_advance = workers != nullptr && workers->threads() > 1;
    if (in_advance) judge_all(previous_clock, *workers);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < failed_.size(); ++i) {
        const Verdict verdict = in_advance ? verdicts_[i] : judge(failed_[i], previous_clock);
        if (verdict == Verdict::keep) {
            failed_[kept++] = failed_[i];
        } else if (verdict == Verdict::wake && seen_.insert(failed_[i].tet) && !lost()) {
            dirty_.push_back(failed_[i].tet);
        }
    }
    failed_.resize(kept);
    if (audit_) check(previous_clock);
    return dirty_;
}

void RepairQueues::fail(TetId t, std::uint32_t birth_date, std::uint32_t date) {
    if (!failed_now_.empty() && failed_now_.back().tet == t) return;
    const Failure failure = {t, birth_date, date};
    failed_now_.push_back(failure);
    if (!audit_) return;
    memory_.resize(std::max(memory_.size(), complex_.tet_slots()), Failure{mesh::none, 0, 0});
    memory_[t] = failure;
}

// The full scan: every tet that changed since the last round, or whose neighbourhood changed after
// a failure, must be in the list.
void RepairQueues::check(std::uint32_t previous_clock) {
    memory_.resize(std::max(memory_.size(), complex_.tet_slots()), Failure{mesh::none, 0, 0});
    std::vector<char> offered(complex_.tet_slots(), 0);
    for (const TetId t : dirty_) offered[t] = 1;
    for (TetId t = 0; t < complex_.tet_slots(); ++t) {
        if (!complex_.tet_alive(t) || offered[t] != 0) continue;
        const bool changed = complex_.date(t) > previous_clock;
        const Failure& failure = memory_[t];
        const bool woken = failure.tet == t && failure.birth_date == complex_.birth_date(t) &&
                           out_of_date(t, failure.date);
        if (!changed && !woken) {
            continue;
        }
        throw GeometryError(
            "kernel.audit", fmt::format("audit of tet {}", t),
            fmt::format("it {}, but it is in no queue; the queues of the kernel lost a change",
                        changed ? "changed" : "must be tried again"),
            "please report it with the experiment");
    }
    // A tet in the list is tried again; its failure counts only if it fails again.
    for (const TetId t : dirty_) memory_[t].tet = mesh::none;
}

void RepairQueues::renew(const mesh::DateRanks& ranks) {
    ranks.replace(last_clock_);
    for (std::vector<Failure>* list : {&failed_, &failed_now_, &memory_}) {
        for (Failure& failure : *list) {
            ranks.replace(failure.birth_date);
            ranks.replace(failure.date);
        }
    }
}

void RepairQueues::save(StateWriter& out) const {
    out.list(failed_);
    out.list(failed_now_);
    out.value(last_clock_);
}

void RepairQueues::load(StateReader& in) {
    in.list(failed_);
    in.list(failed_now_);
    in.value(last_clock_);
    if (!audit_) return;
    memory_.assign(complex_.tet_slots(), Failure{mesh::none, 0, 0});
    for (const std::vector<Failure>* list : {&failed_, &failed_now_}) {
        for (const Failure& failure : *list) memory_[failure.tet] = failure;
    }
}

}  // namespace dsc::kernel
