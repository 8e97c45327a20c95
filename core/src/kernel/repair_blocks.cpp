// Executes requests in blocks of space: assigns them, runs the blocks, takes their results
// (method.md, section 10).
#include "kernel/repair_blocks.hpp"

#include <numeric>
#include <variant>

namespace dsc::kernel {
namespace {

using repair::Operation;
using repair::Request;

constexpr unsigned most_waves = 3;
constexpr std::size_t least_block = 128;    // requests
constexpr std::size_t most_samples = 4096;  // that decide about the planes between blocks
constexpr std::size_t assigned = 2048;      // requests that a thread assigns at a time
constexpr std::uint8_t no_block = 0xff;

// Slots that the request may take. A block that has too few slots defers requests.
mesh::LaneRoom room_for(Operation operation) {
    switch (operation) {
        case Operation::edge_split: return {8, 1};
        case Operation::face_split: return {4, 1};
        case Operation::vertex_split: return {12, 1};
        case Operation::compound: return {1, 1};
        case Operation::edge_removal:
        case Operation::interface_flip:
        case Operation::face_removal: return {1, 0};
        default: return {0, 0};
    }
}

// Keeps what happens to vertices until the destinations can follow, one block after the other.
class EditLog final : public EditListener {
public:
    explicit EditLog(VertexFields& fields) : fields_(fields) {}

    void on_split(const Split& split) override {
        fields_.follow(split);
        edits_.emplace_back(split);
    }
    void on_merge(const Merge& merge) override {
        fields_.follow(merge);
        edits_.emplace_back(merge);
    }
    void replay(Destinations& destinations) {
        for (const auto& edit : edits_) {
            if (const auto* split = std::get_if<Split>(&edit)) {
                destinations.on_split(*split);
            } else {
                destinations.on_merge(std::get<Merge>(edit));
            }
        }
        edits_.clear();
    }

private:
    VertexFields& fields_;
    std::vector<std::variant<Split, Merge>> edits_;
};

}  // namespace

// The work of one block; on a cache line of its own.
struct alignas(64) RepairBlocks::Part {
    struct Done {
        std::uint32_t request;
        std::uint32_t date;
        Outcome outcome;
    };
    mesh::Lane lane;
    Workbench bench;
    EditLog log;
    std::vector<std::uint32_t> requests;
    std::vector<Done> done;
    std::vector<std::uint32_t> deferred;

    Part(const Workbench& main, SpaceBlocks& blocks, VertexFields& fields)
        : bench(main, lane, blocks), log(fields) {
        bench.listener = &log;
    }
};

void RepairBlocks::run(std::span<const Request> requests, Workers* workers,
                       const Executed& executed) {
    waiting_.resize(requests.size());
    std::iota(waiting_.begin(), waiting_.end(), 0U);
    // Vertices are given to blocks in every wave, which must be little beside the requests.
    const std::size_t least = std::max(least_split, bench_.complex.vertex_slots() / 256);
    for (unsigned wave = 0; wave < most_waves && waiting_.size() >= least; ++wave) {
        assign(requests, workers, wave);
        for (std::size_t b = 0; b < parts_.size(); ++b) open(b, requests);
        bench_.refusals().grow(bench_.complex.vertex_slots());
        fields_.grow();
        for_blocks(workers, parts_.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t b = begin; b < end; ++b) work(b, requests);
        });
        for (std::size_t b = 0; b < parts_.size(); ++b) close(b, executed);
        std::sort(waiting_.begin(), waiting_.end());
    }
    for (const std::uint32_t i : waiting_) {
        const Outcome outcome = execute(bench_, requests[i]);
        executed(i, outcome, bench_.clock());
    }
}

unsigned RepairBlocks::levels() const {
    unsigned levels = 1;
    while (levels < SpaceBlocks::most_levels && waiting_.size() >> (levels + 1) >= least_block)
        ++levels;
    return levels;
}

// A vertex that belongs to the block of the request; none if the request names no tet or is stale.
VertexId RepairBlocks::home_of(const Request& request) const {
    const mesh::Complex& c = bench_.complex;
    const TetId t = request.tet;
    if (t == mesh::none || t >= c.tet_slots() || !c.tet_alive(t) ||
        c.birth_date(t) != request.birth_date)
        return mesh::none;
    const auto& corners = c.tet(t).v;
    const bool named =
        std::all_of(request.vertices.begin(), request.vertices.end(),
                    [&](VertexId v) { return v == mesh::none || mesh::has_vertex(c.tet(t), v); });
    if (!named) return mesh::none;
    return request.vertices[0] != mesh::none ? request.vertices[0] : corners[0];
}

// Gives each waiting request to a block; those that belong to none stay in waiting_.
void RepairBlocks::assign(std::span<const Request> requests, Workers* workers, unsigned wave) {
    const std::size_t n = waiting_.size();
    samples_.clear();
    const std::size_t stride = (n + most_samples - 1) / most_samples;
    for (std::size_t at = 0; at < n; at += stride) {
        const VertexId home = home_of(requests[waiting_[at]]);
        if (home != mesh::none) samples_.push_back(home);
    }
    blocks_.split(samples_, levels(), wave, workers);
    numbers_.resize(n);
    for_blocks(workers, n, assigned, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; ++at) {
            const VertexId home = home_of(requests[waiting_[at]]);
            numbers_[at] =
                home == mesh::none ? no_block : static_cast<std::uint8_t>(blocks_.block_of(home));
        }
    });
    while (parts_.size() < blocks_.count())
        parts_.push_back(std::make_shared<Part>(bench_, blocks_, fields_));
    std::size_t kept = 0;
    for (std::size_t at = 0; at < n; ++at) {
        if (numbers_[at] == no_block) {
            waiting_[kept++] = waiting_[at];
        } else {
            parts_[numbers_[at]]->requests.push_back(waiting_[at]);
        }
    }
    waiting_.resize(kept);
}

void RepairBlocks::open(std::size_t block, std::span<const Request> requests) {
    Part& part = *parts_[block];
    mesh::LaneRoom room;
    for (const std::uint32_t i : part.requests) {
        const mesh::LaneRoom more = room_for(requests[i].operation);
        room.tets += more.tets;
        room.vertices += more.vertices;
    }
    bench_.complex.open(part.lane, room);
    part.bench.enter(static_cast<unsigned>(block));
    part.bench.limits = bench_.limits;
    part.bench.lengths = bench_.lengths;
    part.bench.sums = {};
    part.bench.crease_exceptions = 0;
    for (const VertexId slot : part.lane.free_vertices())
        blocks_.give(slot, static_cast<unsigned>(block));
}

void RepairBlocks::work(std::size_t block, std::span<const Request> requests) {
    Part& part = *parts_[block];
    for (const std::uint32_t i : part.requests) {
        const Outcome outcome = execute(part.bench, requests[i]);
        if (part.bench.take_deferred() && outcome.refused()) {
            part.deferred.push_back(i);
            continue;
        }
        // Other blocks may change vertices of a tet at the border at the same time. Then the
        // refusal counts from the beginning.
        const bool whole =
            !outcome.refused() || outcome == Refusal::stale || part.bench.owns(requests[i].tet);
        part.done.push_back({i, whole ? part.bench.clock() : bench_.clock(), outcome});
    }
}

void RepairBlocks::close(std::size_t block, const Executed& executed) {
    Part& part = *parts_[block];
    bench_.complex.close(part.lane);
    for (const VertexId v : part.lane.created()) fields_.renew(v);
    part.log.replay(destinations_);
    bench_.sums += part.bench.sums;
    bench_.crease_exceptions += part.bench.crease_exceptions;
    for (const Part::Done& done : part.done) executed(done.request, done.outcome, done.date);
    waiting_.insert(waiting_.end(), part.deferred.begin(), part.deferred.end());
    part.requests.clear();
    part.done.clear();
    part.deferred.clear();
}

}  // namespace dsc::kernel
