// The text that names the call of a thread.
#include <array>
#include <span>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include <dsc/plugin/guarded.hpp>

using namespace dsc;

TEST_CASE("the call of a thread as a text, with memory and without") {
    CHECK(plugin::current_call().empty());
    std::array<char, 200> room{};
    CHECK(plugin::current_call(std::span(room)) == 0);
    const plugin::Identity who{plugin::Kind::velocity, "fit", "velocity", "own", "1.2.0", "own.so",
                               "a.yaml:6:11"};
    const plugin::Call outer{who, "prepare", 18446744073709551615ULL};
    const plugin::Inside inside(outer);
    const std::string expected =
        "velocity 'fit' (plugin own 1.2.0, own.so, at 'velocity' in the experiment, a.yaml:6:11): "
        "prepare at step 18446744073709551615";
    CHECK(plugin::current_call() == expected);
    CHECK(std::string_view(room.data(), plugin::current_call(std::span(room))) == expected);
    CHECK(plugin::current_call(std::span(room).first(12)) == 12);
    CHECK(std::string_view(room.data(), 12) == "velocity 'fi");
    {
        const plugin::Identity nested{
            plugin::Kind::curvature, "c", "velocity.curvature", "own", "1.2.0", "own.so", ""};
        const plugin::Call inner{nested, "constructor", std::nullopt};
        const plugin::Inside further(inner);
        CHECK(plugin::current_call() == "curvature 'c' (plugin own 1.2.0, own.so, at "
                                        "'velocity.curvature' in the experiment): constructor");
    }
    CHECK(plugin::current_call() == expected);
}
