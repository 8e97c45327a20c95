#include "snapshots.hpp"

#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

#include <dsc/base/random.hpp>
#include <dsc/mesh/adopt.hpp>

#include "pipeline.hpp"

namespace dsc::bench {
namespace {

constexpr std::string_view million_cells = "cells=60";

struct Store {
    Plugins plugins;
    std::unique_ptr<Protocol> protocol;
    std::map<std::string, Snapshot, std::less<>> made;

    Protocol& run() {
        if (!protocol) {
            protocol = std::make_unique<Protocol>(plugins, thesis(plugins, "teapot", false));
            keep("start");
        }
        return *protocol;
    }
    void keep(const std::string& name) {
        const kernel::Deformer& deformer = protocol->body().deformer();
        made[name] = {deformer.complex(), deformer.target_length()};
    }
};

Store& store() {
    static Store all;
    return all;
}

template <class Element>
std::vector<Element> shuffled(std::vector<Element> order, std::uint64_t seed) {
    RandomStream random(RandomKey{seed, stream_id("bench.shuffle"), 0, 0});
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
    return order;
}

// The same mesh with its vertices and tets numbered at random: the worst that a memory can be asked
// for.
mesh::TetMesh renumber(const mesh::TetMesh& mesh) {
    std::vector<std::uint32_t> points(mesh.points.size()), tets(mesh.tets.size());
    std::iota(points.begin(), points.end(), 0U);
    std::iota(tets.begin(), tets.end(), 0U);
    points = shuffled(std::move(points), 1);
    tets = shuffled(std::move(tets), 2);
    mesh::TetMesh out;
    out.points.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) out.points[points[i]] = mesh.points[i];
    for (const std::uint32_t t : tets) {
        auto tet = mesh.tets[t];
        for (std::uint32_t& v : tet) v = points[v];
        out.tets.push_back(tet);
        out.labels.push_back(mesh.labels[t]);
    }
    return out;
}

Snapshot with_length(mesh::Complex complex) {
    const double length = kernel::Deformer(complex).target_length();
    return {std::move(complex), length};
}

}  // namespace

const Snapshot& snapshot(std::string_view name) {
    Store& all = store();
    if (const auto found = all.made.find(name); found != all.made.end()) return found->second;
    if (name == "start") {
        all.run();
    } else if (name == "step5" || name == "step120") {
        // Always both: the later one passes the earlier.
        all.run().run_to(5);
        all.keep("step5");
        all.run().run_to(120);
        all.keep("step120");
    } else if (name == "million" || name == "shuffled") {
        const std::vector<std::string> parameters = {std::string(million_cells)};
        const mesh::Complex ordered = initial_complex(all.plugins, strategy("grid", parameters));
        all.made["shuffled"] = with_length(mesh::adopt(renumber(ordered.to_mesh()), "shuffled"));
        all.made["million"] = with_length(ordered);
    }
    return all.made.at(std::string(name));
}

const cloud::TargetCloud& target_cloud() { return store().run().cloud(); }

}  // namespace dsc::bench
