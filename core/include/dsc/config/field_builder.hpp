#pragma once
// FieldBuilder: completes the declaration of one parameter. ParamSchema (params.hpp) returns it.

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <dsc/config/schema.hpp>

namespace dsc::config {

/// Completes the field that was just declared; every call returns the builder. doc() is mandatory.
class FieldBuilder {
public:
    FieldBuilder(Schema& schema, std::size_t index) : schema_(&schema), index_(index) {}

    /// Both ends belong to the range, unless open_low() or open_high() excludes one. The bounds may
    /// be followed by their unit, which is that of the parameter; see unit().
    FieldBuilder& range(double low, double high) { return at_least(low).at_most(high); }
    FieldBuilder& range(double low, double high, std::string unit_text) {
        return range(low, high).unit(std::move(unit_text));
    }
    FieldBuilder& at_least(double low) { return field().minimum = Bound{low, false}, *this; }
    FieldBuilder& at_least(double low, std::string unit_text) {
        return at_least(low).unit(std::move(unit_text));
    }
    FieldBuilder& at_most(double high) { return field().maximum = Bound{high, false}, *this; }
    FieldBuilder& greater(double low) { return field().minimum = Bound{low, true}, *this; }
    FieldBuilder& greater(double low, std::string unit_text) {
        return greater(low).unit(std::move(unit_text));
    }
    FieldBuilder& less(double high) { return field().maximum = Bound{high, true}, *this; }
    FieldBuilder& open_low() { return field().minimum.value().open = true, *this; }
    FieldBuilder& open_high() { return field().maximum.value().open = true, *this; }
    /// Smallest and largest number of items of a list.
    FieldBuilder& size(std::size_t least,
                       std::size_t greatest = std::numeric_limits<std::size_t>::max());
    /// "dimensionless" for a pure number, "length" for normalised units, "target lengths (L)",
    /// "steps", "radians", "seconds", ...
    FieldBuilder& unit(std::string text) { return field().unit = std::move(text), *this; }
    /// What the parameter does, for the person who writes the experiment.
    FieldBuilder& doc(std::string text) { return field().doc = std::move(text), *this; }
    /// The parameter must be given; the struct's value is then not a default.
    FieldBuilder& required();
    /// May stay unset (`null`). Implied by a std::optional member.
    FieldBuilder& optional();
    /// Accepted extensions of a file, with the dot and in lower case.
    FieldBuilder& extensions(std::vector<std::string> list) {
        return field().extensions = std::move(list), *this;
    }
    /// Accepted items of a list of strings.
    FieldBuilder& choices(std::vector<std::string> list) {
        return field().choices = std::move(list), *this;
    }
    /// A list of strings also accepts integers, as their digits.
    FieldBuilder& or_integers() { return tag("or_integers"); }
    /// An item of a list of strings may also be a map with this one key: `- KEY: text`.
    FieldBuilder& or_keyed(const std::string& key) { return tag("or_keyed " + key); }
    FieldBuilder& tag(std::string name) { return field().tags.push_back(std::move(name)), *this; }
    /// Time or memory grows with it: tests keep it at or below its default.
    FieldBuilder& costly() { return tag("costly"); }
    /// The first page of the documentation leaves it out.
    FieldBuilder& advanced() { return tag("advanced"); }

private:
    Field& field() { return schema_->field(index_); }
    Schema* schema_;
    std::size_t index_;
};

}  // namespace dsc::config
