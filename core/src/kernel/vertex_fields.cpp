// Numbers per interface vertex: target lengths and attributes, and how they follow the edits
// (method.md, section 9).
#include "kernel/vertex_fields.hpp"

#include <cmath>
#include <limits>

#include <dsc/base/error.hpp>
#include <dsc/base/state.hpp>

namespace dsc::kernel {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// Interpolates between two values, one or both of which may be missing.
double between(double a, double b, double s) {
    if (std::isnan(a)) return b;
    return std::isnan(b) ? a : (1.0 - s) * a + s * b;
}

}  // namespace

void VertexFields::grow() {
    if (births_.size() >= complex_.vertex_slots()) return;
    births_.resize(complex_.vertex_slots(), mesh::none);
    for (Column& column : columns_) column.values.resize(births_.size(), no_value);
}

// Assigns the slot to v; true if another vertex used it before.
bool VertexFields::claim(VertexId v) {
    if (births_[v] == complex_.birth(v)) return false;
    births_[v] = complex_.birth(v);
    for (Column& column : columns_) column.values[v] = no_value;
    return true;
}

double VertexFields::value(const Column& column, VertexId v) const {
    return v < births_.size() && births_[v] == complex_.birth(v) ? column.values[v] : no_value;
}

bool VertexFields::lacks(VertexId v) const {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const Column& column) { return std::isnan(value(column, v)); });
}

void VertexFields::set(std::string_view name, std::span<const VertexId> vertices,
                       std::span<const double> values, double otherwise) {
    auto column = std::find_if(columns_.begin(), columns_.end(),
                               [&](const Column& c) { return c.name == name; });
    if (column == columns_.end())
        column = columns_.insert(columns_.end(), {std::string(name), otherwise, {}});
    column->otherwise = otherwise;
    grow();
    column->values.assign(births_.size(), no_value);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        claim(vertices[i]);
        column->values[vertices[i]] = values[i];
    }
}

void VertexFields::remove(std::string_view name) {
    const auto named = [&](const Column& c) { return c.name == name; };
    columns_.erase(std::remove_if(columns_.begin(), columns_.end(), named), columns_.end());
    if (columns_.empty()) births_.clear();
}

const std::vector<double>* VertexFields::find(std::string_view name) const {
    const auto column = std::find_if(columns_.begin(), columns_.end(),
                                     [&](const Column& c) { return c.name == name; });
    return column == columns_.end() ? nullptr : &column->values;
}

std::vector<std::string> VertexFields::names() const {
    std::vector<std::string> names;
    for (const Column& column : columns_) names.push_back(column.name);
    return names;
}

void VertexFields::on_split(VertexId vertex, VertexId a, VertexId b, double s) {
    if (!empty()) {
        grow();
        claim(vertex);
        for (Column& column : columns_)
            column.values[vertex] = between(value(column, a), value(column, b), s);
    }
    next_.on_split(vertex, a, b, s);
}

void VertexFields::on_collapse(VertexId kept, VertexId removed, double s) {
    // The removed id no longer exists, but its slot is not used again yet. An end that is not on
    // the interface is ignored.
    if (!empty() && complex_.on_interface(kept)) {
        grow();
        claim(kept);
        for (Column& column : columns_) {
            if (std::isnan(column.values[kept])) column.values[kept] = value(column, removed);
        }
    }
    next_.on_collapse(kept, removed, s);
}

// One ring: gives values to those of `missing` that have a neighbour with a value; the others stay
// in `missing`. False if none got a value.
bool VertexFields::fill_from_neighbours(std::vector<VertexId>& missing) {
    struct Found {
        VertexId vertex;
        std::size_t column;
        double value;
    };
    std::vector<Found> found;
    std::vector<TetId> star;
    std::vector<VertexId> ring;
    for (const VertexId v : missing) {
        complex_.star(v, star);
        ring.clear();
        for (const TetId t : star) {
            for (unsigned f = 0; f < 4; ++f) {
                if (complex_.tet(t).v[f] == v || !complex_.interface_face(t, f)) continue;
                for (const auto k : mesh::face_vertices[f]) ring.push_back(complex_.tet(t).v[k]);
            }
        }
        std::sort(ring.begin(), ring.end(),
                  [&](VertexId a, VertexId b) { return complex_.birth(a) < complex_.birth(b); });
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (!std::isnan(columns_[i].values[v])) continue;
            double sum = 0.0;
            unsigned count = 0;
            for (const VertexId w : ring) {
                const double known = value(columns_[i], w);
                if (std::isnan(known)) continue;
                sum += known;
                ++count;
            }
            if (count > 0) found.push_back({v, i, sum / count});
        }
    }
    // All at once, so that the order of the vertices has no influence.
    for (const Found& f : found) columns_[f.column].values[f.vertex] = f.value;
    missing.erase(
        std::remove_if(missing.begin(), missing.end(), [this](VertexId v) { return !lacks(v); }),
        missing.end());
    return !found.empty();
}

void VertexFields::settle() {
    if (empty()) return;
    grow();
    std::vector<VertexId> missing;
    for (const VertexId v : complex_.interface_vertices()) {
        claim(v);
        if (lacks(v)) missing.push_back(v);
    }
    while (!missing.empty() && fill_from_neighbours(missing)) {
    }
    for (const VertexId v : missing) {
        for (Column& column : columns_) {
            if (std::isnan(column.values[v])) column.values[v] = column.otherwise;
        }
    }
}

void VertexFields::save(StateWriter& out) const {
    out.list(births_);
    out.value<std::uint64_t>(columns_.size());
    for (const Column& column : columns_) {
        out.text(column.name);
        out.value(column.otherwise);
        out.list(column.values);
    }
}

void VertexFields::load(StateReader& in) {
    columns_.clear();
    in.list(births_);
    bool fits = births_.size() <= complex_.vertex_slots();
    for (auto count = in.value<std::uint64_t>(); count > 0; --count) {
        Column& column = columns_.emplace_back();
        column.name = std::string(in.text());
        in.value(column.otherwise);
        in.list(column.values);
        fits = fits && column.values.size() == births_.size();
    }
    if (!fits)
        throw IoError("state.damaged", "saved state", "",
                      "the numbers per vertex do not fit the complex", "start the run again");
}

}  // namespace dsc::kernel
