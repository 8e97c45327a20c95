#pragma once
// Numbers per interface vertex that follow the edits: target lengths, and the attributes of
// strategies (method.md, section 9).

#include <string>
#include <string_view>

#include "kernel/workbench.hpp"

namespace dsc::kernel {

/// Fields by name. A vertex made by a split gets the value interpolated between the edge's ends;
/// after a collapse the kept end keeps its value; a vertex that comes to the interface in another
/// way gets the mean of its neighbours at the next settle(). All edits are reported on to `next`,
/// so another listener can follow. Nothing is allocated without fields.
class VertexFields final : public EditListener {
public:
    VertexFields(const mesh::Complex& complex, EditListener& next)
        : complex_(complex), next_(next) {}

    bool empty() const { return columns_.empty(); }
    /// Sets a field on these vertices; all others have no value. Creates the field if it is new.
    /// Sizes are equal. `otherwise` is for vertices that cannot get a value from neighbours. [step]
    void set(std::string_view name, std::span<const VertexId> vertices,
             std::span<const double> values, double otherwise);
    void remove(std::string_view name);
    /// Gives every interface vertex without a value the mean of its neighbours, ring after ring,
    /// and `otherwise` to vertices that are connected to no vertex with a value. [step]
    void settle();

    /// The values by vertex, NaN if there is none; null if there is no such field. Valid until the
    /// next change.
    const std::vector<double>* find(std::string_view name) const;
    /// Names in the order in which they were set first.
    std::vector<std::string> names() const;

    void on_split(VertexId vertex, VertexId a, VertexId b, double s) override;
    void on_collapse(VertexId kept, VertexId removed, double s) override;
    void on_interface_collapse(VertexId kept) override { next_.on_interface_collapse(kept); }

    void save(StateWriter& out) const;
    void load(StateReader& in);

private:
    struct Column {
        std::string name;
        double otherwise;
        std::vector<double> values;
    };

    void grow();
    bool claim(VertexId v);
    double value(const Column& column, VertexId v) const;
    bool lacks(VertexId v) const;
    bool fill_from_neighbours(std::vector<VertexId>& missing);

    const mesh::Complex& complex_;
    EditListener& next_;
    std::vector<std::uint32_t> births_;  // per vertex: birth of the vertex to which the values
                                         // belong
    std::vector<Column> columns_;
};

}  // namespace dsc::kernel
