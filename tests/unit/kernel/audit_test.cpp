// The audit compares the queues with a full scan: it is silent on a sound kernel and speaks when a
// wake-up is lost.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/kernel/deformer.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;

namespace {

// Runs a shrinking and twisting ball with the audit on; returns its complaint.
std::string audited(std::uint64_t drop_wake_up) {
    DeformerOptions options;
    options.audit = true;
    options.drop_wake_up = drop_wake_up;
    Deformer d(mesh::adopt(test::ball_grid(10, 0.9), "ball"), options);
    try {
        for (int step = 0; step < 8; ++step) {
            const mesh::Complex& c = d.complex();
            std::vector<mesh::VertexId> v(c.interface_vertices().begin(),
                                          c.interface_vertices().end());
            std::sort(v.begin(), v.end(), [&c](auto a, auto b) { return c.birth(a) < c.birth(b); });
            std::vector<Vec3> displacements;
            for (const auto x : v)
                displacements.push_back(0.08 * Vec3(-c.position(x).y(), c.position(x).x(), 0) -
                                        0.05 * c.position(x));
            d.step(v, displacements, test::quality_policy());
        }
    } catch (const GeometryError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("the audit finds nothing on a sound kernel") { CHECK(audited(0) == ""); }

TEST_CASE("the audit notices a lost wake-up, wherever it is lost") {
    for (const std::uint64_t lost : {1U, 500U, 6000U, 9000U}) {
        CAPTURE(lost);
        CHECK(audited(lost).find("the queues of the kernel lost a change") != std::string::npos);
    }
}
