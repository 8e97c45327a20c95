#pragma once
// Labelled start meshes for the kernel's tests, by cells of a grid, so that thin parts are one cell
// thick.

#include <cmath>
#include <string>
#include <vector>

#include <dsc/mesh/adopt.hpp>

#include "mesh/meshes.hpp"

namespace dsc::test {

struct LabelledMesh {
    std::string name;
    mesh::Complex complex;
};

/// 8^3 cells, the label of cell (i, j, k) given.
inline mesh::Complex by_cells(const std::function<mesh::Label(int, int, int)>& label, int n = 8) {
    const double size = 3.0 / n;
    const mesh::TetMesh m = grid(n, 1.5, [&](const Vec3& p) {
        const auto cell = [&](double x) { return static_cast<int>(std::floor((x + 1.5) / size)); };
        return label(cell(p.x()), cell(p.y()), cell(p.z()));
    });
    return mesh::adopt(m, "cells", nullptr, 0.0);
}

inline bool between(int low, int x, int high) { return low <= x && x <= high; }

inline std::vector<LabelledMesh> labelled_meshes() {
    std::vector<LabelledMesh> out;
    out.push_back({"block", by_cells([](int i, int j, int k) {
                       return between(2, i, 5) && between(2, j, 5) && between(2, k, 5) ? 1 : 0;
                   })});
    out.push_back({"ring", by_cells([](int i, int j, int k) {
                       const bool square = between(2, i, 5) && between(2, j, 5) && k == 4;
                       const bool hole = between(3, i, 4) && between(3, j, 4);
                       return square && !hole ? 1 : 0;
                   })});
    out.push_back({"two blocks", by_cells([](int i, int j, int k) {
                       return (between(2, i, 3) || between(5, i, 6)) && between(3, j, 5) &&
                                      between(3, k, 5)
                                  ? 1
                                  : 0;
                   })});
    out.push_back({"plate", by_cells([](int i, int j, int k) {
                       return between(2, i, 5) && between(2, j, 5) && k == 4 ? 1 : 0;
                   })});
    out.push_back({"shell", by_cells([](int i, int j, int k) {
                       const bool outer = between(2, i, 5) && between(2, j, 5) && between(2, k, 5);
                       const bool inner = between(3, i, 4) && between(3, j, 4) && between(3, k, 4);
                       return outer && !inner ? 1 : 0;
                   })});
    out.push_back({"two phases", by_cells([](int i, int j, int k) {
                       if (!between(2, i, 5) || !between(2, j, 5) || !between(2, k, 5)) return 0;
                       return i < 4 ? 1 : 2;
                   })});
    out.push_back({"frame", by_cells([](int i, int j, int k) {
                       const auto end = [](int x) { return x == 1 || x == 5 ? 1 : 0; };
                       if (!between(1, i, 5) || !between(1, j, 5) || !between(1, k, 5)) return 0;
                       return end(i) + end(j) + end(k) >= 2 ? 1 : 0;
                   })});
    out.push_back({"dumbbell", by_cells([](int i, int j, int k) {
                       const bool head = (between(1, i, 2) || between(5, i, 6)) &&
                                         between(3, j, 5) && between(3, k, 5);
                       const bool neck = between(1, i, 6) && j == 4 && k == 4;
                       return head || neck ? 1 : 0;
                   })});
    return out;
}

}  // namespace dsc::test
