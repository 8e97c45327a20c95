// Saves and loads a complex.
#include <type_traits>

#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

// The data of the tets are saved as one list per member.
void Complex::save(StateWriter& out) const {
    const auto list = [&](const auto member) {
        std::vector<std::decay_t<decltype(data_.front().*member)>> values;
        values.reserve(data_.size());
        for (const TetData& tet : data_) values.push_back(tet.*member);
        out.list(values);
    };
    out.list(vertices_);
    out.list(tets_);
    list(&TetData::label);
    list(&TetData::quality);
    list(&TetData::date);
    list(&TetData::birth_date);
    out.list(free_vertices_);
    out.list(free_tets_);
    out.list(interface_);
    out.list(changes_);
    out.value(taken_clock_);
    out.value(clock_);
    out.value(next_birth_);
    out.value(box_.low);
    out.value(box_.high);
}

Complex Complex::load(StateReader& in) {
    Complex c;
    const auto list = [&](const auto member) {
        std::vector<std::decay_t<decltype(c.data_.front().*member)>> values;
        in.list(values);
        if (values.size() != c.tets_.size())
            throw IoError(
                "state.damaged", "saved complex", "",
                "its lists have different lengths, so it is damaged or is not a saved complex",
                "start the run again");
        for (std::size_t t = 0; t < values.size(); ++t) c.data_[t].*member = values[t];
    };
    in.list(c.vertices_);
    c.shape_dates_.assign(c.vertices_.size(), 0);
    c.stars_.grow(c.vertices_.size());
    in.list(c.tets_);
    c.data_.resize(c.tets_.size());
    list(&TetData::label);
    list(&TetData::quality);
    list(&TetData::date);
    list(&TetData::birth_date);
    in.list(c.free_vertices_);
    in.list(c.free_tets_);
    in.list(c.interface_);
    in.list(c.changes_);
    in.value(c.taken_clock_);
    in.value(c.clock_);
    in.value(c.next_birth_);
    in.value(c.box_.low);
    in.value(c.box_.high);
    return c;
}

}  // namespace dsc::mesh
