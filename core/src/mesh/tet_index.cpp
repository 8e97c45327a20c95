// The table from tets to places: insertion and growth.
#include "dsc/mesh/tet_index.hpp"

namespace dsc::mesh {

void TetIndex::grow() {
    std::vector<std::uint64_t> keys(2 * keys_.size(), 0);
    std::vector<std::uint32_t> places(keys.size(), 0);
    keys.swap(keys_);
    places.swap(places_);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (keys[i] < stamp_) continue;
        const std::size_t at = slot_of(static_cast<std::uint32_t>(keys[i]));
        keys_[at] = keys[i];
        places_[at] = places[i];
    }
}

}  // namespace dsc::mesh
