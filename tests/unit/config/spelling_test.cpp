#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <dsc/config/spelling.hpp>

using dsc::config::closest;
using dsc::config::edit_distance;

TEST_CASE("edit distance of known pairs") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("alpha", "alpha") == 0);
    CHECK(edit_distance("alhpa", "alpha") == 1);
    CHECK(edit_distance("alph", "alpha") == 1);
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("ca", "abc") == 3);  // optimal string alignment, not the unrestricted
                                             // distance 2
}

TEST_CASE("edit distance is symmetric and obeys its bounds") {
    const std::vector<std::string> words = {"",      "a",     "ab",   "ba",       "abc",
                                            "alpha", "alhpa", "beta", "per_area", "area"};
    for (const std::string& a : words) {
        for (const std::string& b : words) {
            const std::size_t d = edit_distance(a, b);
            CHECK(d == edit_distance(b, a));
            CHECK((d == 0) == (a == b));
            CHECK(d <= std::max(a.size(), b.size()));
            CHECK(d >= std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
        }
    }
}

TEST_CASE("did you mean") {
    CHECK(closest("alhpa", {"beta", "alpha", "gamma"}) == "alpha");
    CHECK(closest("velocty", {"velocity"}) == "velocity");
    CHECK_FALSE(closest("surface", {"velocity", "seed"}));
    CHECK_FALSE(closest("k", {"n"}));  // all of the word would change
    CHECK(closest("impliict_fairyng", {"implicit_fairing"}) == "implicit_fairing");
    CHECK(closest("ab", {"abx", "aby"}) == "abx");  // the first of equals
    CHECK_FALSE(closest(std::string(100000, 'a'), {"alpha"}));
    CHECK_FALSE(closest("x", {}));
}
