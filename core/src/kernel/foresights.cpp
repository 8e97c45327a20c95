// Judges requests in blocks, and tests whether what was found still holds (method.md, section 10).
#include "kernel/foresights.hpp"

#include <algorithm>

namespace dsc::kernel {
namespace {

bool is_smoothing(const repair::Request& request) {
    return request.operation == repair::Operation::smooth_laplacian;
}

}  // namespace

void Foresights::start(std::span<const repair::Request> requests, Workers* workers) {
    requests_ = requests;
    workers_ = workers != nullptr && workers->threads() > 1 ? workers : nullptr;
    foresights_.clear();
    first_ = 0;
}

Foresight Foresights::of(std::size_t i) {
    if (workers_ == nullptr || is_smoothing(requests_[i])) return {};
    if (i >= first_ + foresights_.size()) look(i);
    return holds(requests_[i]) ? foresights_[i - first_] : Foresight{};
}

// What a judge reads of the requests after i, which end before `end`.
void Foresights::prefetch_tets(std::size_t i, std::size_t end) const {
    constexpr std::size_t near = 3, far = 6;  // requests ahead
    const mesh::Complex& c = bench_.complex;
    const auto tet = [&](std::size_t at, const auto& fetch) {
        if (at < end && requests_[at].tet < c.tet_slots()) fetch(requests_[at].tet);
    };
    tet(i + far, [&c](TetId t) { c.prefetch_tet(t); });
    tet(i + near, [&c](TetId t) {
        c.prefetch_vertices(t);
        c.prefetch_across(t);
    });
}

// The stars of the tet have not changed since the request was judged.
bool Foresights::holds(const repair::Request& request) const {
    const mesh::Complex& c = bench_.complex;
    const TetId t = request.tet;
    if (t >= c.tet_slots() || !c.tet_alive(t)) return false;
    const auto& v = c.tet(t).v;
    return std::all_of(v.begin(), v.end(), [&](VertexId x) { return c.vertex_date(x) <= date_; });
}

// Judges the requests from `first` on, up to the next smoothing, which may change any of them.
void Foresights::look(std::size_t first) {
    const std::span<const repair::Request> rest = requests_.subspan(first);
    const auto end = std::find_if(
        rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(std::min(rest.size(), most)),
        is_smoothing);
    first_ = first;
    date_ = bench_.complex.clock();
    foresights_.assign(static_cast<std::size_t>(end - rest.begin()), {});
    while (judges_.size() * block < foresights_.size())
        judges_.push_back(std::make_unique<Workbench>(bench_.complex));
    for (const std::unique_ptr<Workbench>& judge : judges_) {
        judge->limits = bench_.limits;
        judge->lengths = bench_.lengths;
    }
    workers_->for_blocks(foresights_.size(), block, [this](std::size_t from, std::size_t to) {
        Workbench& judge = *judges_[from / block];
        for (std::size_t i = from; i < to; ++i) {
            prefetch_tets(first_ + i, first_ + to);
            foresights_[i] = foresee(judge, requests_[first_ + i]);
        }
    });
}

}  // namespace dsc::kernel
