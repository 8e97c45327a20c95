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
    judged_.clear();
    next_ = end_ = 0;
}

Foresight Foresights::of(std::size_t i) {
    if (workers_ == nullptr || !foreseeable(requests_[i])) return {};
    if (i >= end_) look(i);
    while (judged_[next_].request < i) ++next_;
    prefetch_stars(next_);
    const Judged& judged = judged_[next_];
    return judged.known.is_empty() || !holds(judged) ? Foresight{} : judged.known;
}

// What a judge reads after judged_[i], up to `end`.
void Foresights::prefetch_tets(std::size_t i, std::size_t end) const {
    constexpr std::size_t near = 3, far = 6;  // requests ahead
    const mesh::Complex& c = bench_.complex;
    const auto tet = [&](std::size_t at, const auto& fetch) {
        if (at >= end) return;
        const TetId t = requests_[judged_[at].request].tet;
        if (t < c.tet_slots()) fetch(t);
    };
    tet(i + far, [&c](TetId t) { c.prefetch_tet(t); });
    tet(i + near, [&c](TetId t) {
        c.prefetch_vertices(t);
        c.prefetch_across(t);
    });
}

// What the thread that executes the requests reads of those after judged_[i].
void Foresights::prefetch_stars(std::size_t i) const {
    constexpr std::size_t next = 1, near = 2, far = 4;  // requests ahead
    const mesh::Complex& c = bench_.complex;
    const auto ends = [&](std::size_t at, const auto& fetch) {
        if (at >= judged_.size()) return;
        const CollapseChoice& choice = judged_[at].known.choice;
        if (choice.a == mesh::none) return;
        fetch(choice.a);
        fetch(choice.b);
    };
    if (i + far < judged_.size() && !judged_[i + far].known.is_empty()) {
        for (const VertexId v : judged_[i + far].vertices) c.prefetch_vertex(v);
    }
    ends(i + far, [&c](VertexId v) { c.prefetch_star_entry(v); });
    // Only a vertex that no earlier request has removed has a star.
    ends(i + near, [&c](VertexId v) {
        if (c.vertex_alive(v)) c.prefetch_star(v);
    });
    ends(i + next, [&c](VertexId v) {
        if (c.vertex_alive(v)) c.prefetch_star_tets(v);
    });
}

// The stars of the tet's vertices, and so the tet, have not changed since the request was judged.
bool Foresights::holds(const Judged& judged) const {
    return std::all_of(judged.vertices.begin(), judged.vertices.end(),
                       [this](VertexId v) { return bench_.complex.vertex_date(v) <= date_; });
}

void Foresights::judge(Workbench& bench, Judged& judged) const {
    const repair::Request& request = requests_[judged.request];
    judged.known = foresee(bench, request);
    if (!judged.known.is_empty()) judged.vertices = bench_.complex.tet(request.tet).v;
}

// Judges the next requests from `first` on, up to a smoothing, which may change any of them.
void Foresights::look(std::size_t first) {
    judged_.clear();
    next_ = 0;
    date_ = bench_.complex.clock();
    for (end_ = first; end_ < requests_.size() && judged_.size() < most; ++end_) {
        if (is_smoothing(requests_[end_])) break;
        if (foreseeable(requests_[end_])) judged_.push_back({end_, {}, {}});
    }
    while (judges_.size() * block < judged_.size())
        judges_.push_back(std::make_unique<Workbench>(bench_.complex));
    for (const std::unique_ptr<Workbench>& judge : judges_) {
        judge->limits = bench_.limits;
        judge->lengths = bench_.lengths;
    }
    workers_->for_blocks(judged_.size(), block, [this](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            prefetch_tets(i, to);
            judge(*judges_[from / block], judged_[i]);
        }
    });
}

}  // namespace dsc::kernel
