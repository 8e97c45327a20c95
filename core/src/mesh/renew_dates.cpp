// Replaces the dates of a complex by their ranks (method.md, section 6.2).
#include <algorithm>
#include <utility>

#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/date_ranks.hpp>

namespace dsc::mesh {

DateRanks Complex::renew_dates() {
    // The list knows tets from date watched_since_ on, that is, after the date before.
    std::uint32_t watched_after = std::max(watched_since_, 1U) - 1;
    const auto for_all = [this, &watched_after](const auto& visit) {
        for (std::uint32_t* date :
             {&taken_clock_, &watched_after, &shape_clock_, &reshaped_since_, &clock_})
            visit(*date);
        for (Tet& tet : tets_) {
            visit(tet.date);
            visit(tet.birth_date);
        }
        for (Vertex& vertex : vertices_) visit(vertex.date);
        for (VertexShape& shape : shapes_) visit(shape.date);
    };
    LargeVector<std::uint32_t> dates;
    dates.reserve(2 * (tets_.size() + vertices_.size()) + 5);
    for_all([&dates](std::uint32_t date) { dates.push_back(date); });
    DateRanks ranks(std::move(dates));
    for_all([&ranks](std::uint32_t& date) { ranks.replace(date); });
    if (watched_since_ != 0) watched_since_ = watched_after + 1;
    return ranks;
}

}  // namespace dsc::mesh
