#pragma once
// Trace: all answers of a strategy in an exercise, for a comparison bit by bit.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::conformance {

/// The numbers in the order in which they were returned, in named parts.
class Trace {
public:
    /// Begins a part, such as "displacements at step 2", with this count of numbers per entry.
    void part(std::string name, std::size_t width = 1);
    void add(double value) { values_.push_back(value); }
    void add(const Vec3& value) {
        for (int i = 0; i < 3; ++i) values_.push_back(value[i]);
    }
    template <class T>
    void add(std::span<const T> values) {
        for (const T& value : values) add(value);
    }

    const std::vector<double>& values() const { return values_; }

    /// A part: its values are [begin, end), `width` of them per entry.
    struct Stretch {
        std::size_t begin;
        std::size_t end;
        std::size_t width;
        std::string name;
    };
    std::vector<Stretch> stretches() const;
    /// "entry 12 of displacements at step 2" for the value at `index`.
    std::string place(std::size_t index) const;

    /// Describes the first difference of two traces; nothing if all bits agree.
    static std::optional<std::string> difference(const Trace& a, const Trace& b);
    /// The first value that is neither finite nor, bit for bit, `unwritten`.
    std::optional<std::size_t> first_not_finite() const;
    /// The first value that is `unwritten`.
    std::optional<std::size_t> first_unwritten() const;

private:
    struct Part {
        std::string name;
        std::size_t begin;
        std::size_t width;
    };
    std::vector<Part> parts_;
    std::vector<double> values_;
};

/// A NaN that no computation returns; it fills the outputs before a strategy writes them.
double unwritten();
bool is_unwritten(double value);

}  // namespace dsc::conformance
