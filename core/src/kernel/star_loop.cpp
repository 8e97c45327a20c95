// Splits a long list of vertices into blocks of space and runs the blocks in parallel (method.md,
// section 10).
#include "kernel/star_loop.hpp"

namespace dsc::kernel {
namespace {

constexpr unsigned cell_bits = 5;  // per axis
constexpr std::uint32_t cells_an_axis = 1U << cell_bits;

// Spreads five bits to every third position.
std::uint32_t spread(std::uint32_t x) {
    std::uint32_t out = 0;
    for (unsigned bit = 0; bit < cell_bits; ++bit) out |= (x >> bit & 1U) << (3 * bit);
    return out;
}

// Number of a grid cell along the Z-order [Morton1966].
std::uint16_t z_order(const Vec3& p, const Vec3& low, const Vec3& scale) {
    std::uint32_t code = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const double x = (p[axis] - low[axis]) * scale[axis];
        const auto cell =
            static_cast<std::uint32_t>(std::clamp(x, 0.0, static_cast<double>(cells_an_axis - 1)));
        code |= spread(cell) << axis;
    }
    return static_cast<std::uint16_t>(code);
}

}  // namespace

void StarLoop::split(std::span<const mesh::VertexId> vertices) {
    const std::size_t n = vertices.size();
    block_count_ = std::min(most_blocks, n / least_block);
    Vec3 low = complex_.position(vertices.front());
    Vec3 high = low;
    for (const mesh::VertexId v : vertices) {
        low = low.cwiseMin(complex_.position(v));
        high = high.cwiseMax(complex_.position(v));
    }
    // One scale for all axes: cells are cubes.
    const double edge = std::max((high - low).maxCoeff(), 1e-300) / cells_an_axis;
    const Vec3 scale = Vec3::Constant(1.0 / edge);
    cells_.resize(n);
    cell_sizes_.assign(cells_an_axis * cells_an_axis * cells_an_axis, 0);
    for (std::size_t i = 0; i < n; ++i) {
        cells_[i] = z_order(complex_.position(vertices[i]), low, scale);
        ++cell_sizes_[cells_[i]];
    }
    // Consecutive cells form a block until it has its share; then cell_sizes_ becomes the block of
    // each cell.
    std::size_t passed = 0;
    begins_.fill(0);
    for (std::uint32_t& size : cell_sizes_) {
        const std::size_t block = std::min(passed * block_count_ / n, block_count_ - 1);
        passed += size;
        begins_[block + 1] += size;
        size = static_cast<std::uint32_t>(block);
    }
    for (std::size_t b = 0; b < block_count_; ++b) begins_[b + 1] += begins_[b];
    block_of_.resize(std::max(block_of_.size(), complex_.vertex_slots()), no_block);
    order_.resize(n);
    auto next = begins_;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t block = cell_sizes_[cells_[i]];
        order_[next[block]++] = i;
        block_of_[vertices[i]] = static_cast<std::uint8_t>(block);
    }
}

// Gives the moves of a wave the dates that they would have in serial order.
void StarLoop::date_wave(std::size_t count, Workers* workers) {
    std::uint32_t clock = complex_.clock();
    for (std::size_t b = 0; b < count; ++b) {
        blocks_[b].clock = clock;
        clock += blocks_[b].moved;
    }
    for_blocks(workers, count, 1, [this](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            Block& block = blocks_[b];
            block.changed.clear();
            std::uint32_t date = block.clock;
            std::size_t at = 0;
            for (const Entry& entry : block.entries) {
                if (entry.star_size == 0) continue;
                complex_.date_star(entry.vertex,
                                   std::span(block.stars).subspan(at, entry.star_size), ++date,
                                   block.changed);
                at += entry.star_size;
            }
        }
    });
    for (std::size_t b = 0; b < count; ++b)
        complex_.note_changes(blocks_[b].clock + blocks_[b].moved, blocks_[b].changed);
}

void StarLoop::join(std::span<const mesh::VertexId> vertices) {
    for (const mesh::VertexId v : vertices) block_of_[v] = no_block;
    waiting_.clear();
    for (Block& block : blocks_) {
        waiting_.insert(waiting_.end(), block.waiting.begin(), block.waiting.end());
        block.waiting.clear();
    }
    std::sort(waiting_.begin(), waiting_.end());
}

bool StarLoop::meets_another(std::span<const mesh::VertexId> neighbours, std::uint8_t block) const {
    return std::any_of(neighbours.begin(), neighbours.end(), [&](mesh::VertexId w) {
        return block_of_[w] != block && block_of_[w] != no_block;
    });
}

}  // namespace dsc::kernel
