// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Searches the cells of normals and their order that `cone_centres` holds: simulated annealing, first of the
// order of Fibonacci cells, then of order and cells together. What is maximised is the mean share of
// uniformly distributed normals that at most R ranges of consecutive cells let a distant viewer skip, as
// `faces_away` would allow with its slack. Prints the table as C++.
//
//   rhview_cluster_order_search R [seed] [order moves] [joint moves]
//
// The defaults made the committed table. Equal arguments give equal tables on one machine; another compiler's
// rounding may lead the search elsewhere.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numeric>
#include <random>
#include <vector>

#include "rhview/rhoctree/facing.h"
#include "rhview/rhoctree/normal_clusters.h"

namespace rhview {
namespace {

constexpr std::size_t kCells = kConeClusters;
constexpr std::size_t kNormals = 20'000;
constexpr std::size_t kViews = 1'000;
constexpr double kGoldenAngle = 2.399963229728653;

/// Evenly spread over the sphere; `turn` keeps one set from falling onto another.
std::vector<glm::dvec3> spread_points(std::size_t count, double turn) {
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double radius = std::sqrt(1.0 - z * z), angle = turn + kGoldenAngle * static_cast<double>(i);
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return points;
}

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double unit() { return static_cast<double>(engine_()) / 4294967296.0; }
    std::size_t below(std::size_t count) {
        return static_cast<std::size_t>(unit() * static_cast<double>(count));
    }
    double bell(double width) { return width * (unit() + unit() + unit() - 1.5); }

  private:
    std::mt19937 engine_;
};

/// What a cell's normals look like from outside.
struct Cell {
    glm::dvec3 centre{0.0};
    glm::dvec3 axis{0.0};
    double sine = 2.0;
    double share = 0.0;  ///< of all normals
};

/// Bits of the `count` places from `first`.
std::uint64_t bits(std::size_t first, std::size_t count) {
    return (count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1) << first;
}

std::uint64_t reversed(std::uint64_t value) {
    value = (value >> 1 & 0x5555555555555555u) | (value & 0x5555555555555555u) << 1;
    value = (value >> 2 & 0x3333333333333333u) | (value & 0x3333333333333333u) << 2;
    value = (value >> 4 & 0x0f0f0f0f0f0f0f0fu) | (value & 0x0f0f0f0f0f0f0f0fu) << 4;
    value = (value >> 8 & 0x00ff00ff00ff00ffu) | (value & 0x00ff00ff00ff00ffu) << 8;
    value = (value >> 16 & 0x0000ffff0000ffffu) | (value & 0x0000ffff0000ffffu) << 16;
    return value >> 32 | value << 32;
}

/// A rearrangement of the places [first, first + count): turned round, or rotated by `shift`.
struct OrderMove {
    std::size_t first = 0, count = 0, shift = 0;
    bool reverse = false;

    [[nodiscard]] std::uint64_t of(std::uint64_t mask) const {
        const std::uint64_t part = bits(first, count), moved = mask & part;
        if (reverse) {
            const std::uint64_t low = reversed(moved >> first) >> (64 - count);
            return (mask & ~part) | low << first;
        }
        return (mask & ~part) | ((moved >> shift | moved << (count - shift)) & part);
    }
    void apply(std::array<std::uint8_t, kCells>& order) const {
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        if (reverse)
            std::reverse(begin, end);
        else
            std::rotate(begin, begin + static_cast<std::ptrdiff_t>(shift), end);
    }
};

OrderMove random_order_move(Random& random) {
    OrderMove move;
    const std::size_t a = random.below(kCells), b = random.below(kCells);
    move.first = std::min(a, b);
    move.count = std::max(a, b) - move.first + 1;
    move.reverse = move.count < 3 || random.unit() < 0.4;
    // Short blocks that travel far are what mends an order late in the search.
    const std::size_t longest =
        random.unit() < 0.5 ? std::min<std::size_t>(4, move.count - 1) : move.count - 1;
    if (!move.reverse) move.shift = 1 + random.below(longest);
    return move;
}

struct Layout {
    std::array<Cell, kCells> cells;
    std::array<std::uint8_t, kCells> order{};  ///< the cell at each place
    std::vector<std::uint8_t> owner;           ///< the cell of each normal
    std::vector<double> nearness;              ///< dot product with its centre
    std::vector<std::uint64_t> skippable;      ///< by view, one bit per place

    void order_by(const OrderMove& move) {
        move.apply(order);
        for (std::uint64_t& mask : skippable) mask = move.of(mask);
    }
};

class Search {
  public:
    Search(int max_ranges, std::uint32_t seed) : max_ranges_(max_ranges), random_(seed) {
        const std::vector<glm::dvec3> centres = spread_points(kCells, 0.0);
        for (std::size_t i = 0; i < kCells; ++i) now_.cells[i].centre = centres[i];
        std::iota(now_.order.begin(), now_.order.end(), std::uint8_t{0});
        for (std::size_t i = kCells - 1; i > 0; --i)
            std::swap(now_.order[i], now_.order[random_.below(i + 1)]);
        now_.owner.assign(kNormals, 0);
        now_.nearness.assign(kNormals, -2.0);
        now_.skippable.assign(kViews, 0);
        for (std::size_t n = 0; n < kNormals; ++n) find_owner(now_, n);
        for (std::size_t i = 0; i < kCells; ++i) bound(now_, i);
        value_ = skipped_share(now_);
        next_ = now_;
    }

    [[nodiscard]] double value() const { return value_; }
    [[nodiscard]] const Layout& layout() const { return now_; }

    void anneal_order(std::uint64_t moves, double hot, double cold) {
        for (std::uint64_t i = 0; i < moves; ++i)
            try_order_move(cooled(hot, cold, static_cast<double>(i) / static_cast<double>(moves)));
    }

    void anneal_all(std::uint64_t moves, double hot, double cold) {
        constexpr double kFirstStep = 0.06, kLastStep = 0.01;  // radians, about a quarter of a cell and less
        for (std::uint64_t i = 0; i < moves; ++i) {
            const double progress = static_cast<double>(i) / static_cast<double>(moves);
            const double heat = cooled(hot, cold, progress);
            if (random_.unit() < 0.25)
                try_order_move(heat);
            else
                try_cell_move(heat, cooled(kFirstStep, kLastStep, progress));
        }
    }

  private:
    static double cooled(double hot, double cold, double progress) {
        return hot * std::pow(cold / hot, progress);
    }

    void try_order_move(double heat) {
        const OrderMove move = random_order_move(random_);
        next_.order = now_.order;
        next_.cells = now_.cells;
        move.apply(next_.order);
        for (std::size_t v = 0; v < kViews; ++v) next_.skippable[v] = move.of(now_.skippable[v]);
        const double value = skipped_share(next_);
        if (!accept(value, heat)) return;
        now_.order = next_.order;
        now_.skippable.swap(next_.skippable);
    }

    void try_cell_move(double heat, double step) {
        next_ = now_;
        const std::size_t moved = random_.below(kCells);
        Cell& cell = next_.cells[moved];
        cell.centre += glm::dvec3(random_.bell(step), random_.bell(step), random_.bell(step));
        std::uint64_t touched = std::uint64_t{1} << moved;
        for (std::size_t n = 0; n < kNormals; ++n) {
            const std::uint8_t before = next_.owner[n];
            const double dot = glm::dot(cell.centre, normals_[n]);
            if (before == moved) {
                find_owner(next_, n);
                touched |= std::uint64_t{1} << next_.owner[n];
            } else if (dot > next_.nearness[n]) {
                next_.owner[n] = static_cast<std::uint8_t>(moved);
                next_.nearness[n] = dot;
                touched |= std::uint64_t{1} << before;
            }
        }
        for (; touched != 0; touched &= touched - 1)
            bound(next_, static_cast<std::size_t>(std::countr_zero(touched)));
        if (accept(skipped_share(next_), heat)) std::swap(now_, next_);
    }

    bool accept(double value, double heat) {
        if (value < value_ && random_.unit() >= std::exp((value - value_) / heat)) return false;
        value_ = value;
        return true;
    }

    void find_owner(Layout& layout, std::size_t normal) const {
        double best = -2.0;
        for (std::size_t i = 0; i < kCells; ++i) {
            const double dot = glm::dot(layout.cells[i].centre, normals_[normal]);
            if (dot <= best) continue;
            best = dot;
            layout.owner[normal] = static_cast<std::uint8_t>(i);
        }
        layout.nearness[normal] = best;
    }

    /// The cap of a cell's normals (Badoiu & Clarkson 2003: step towards the farthest, ever less), and from
    /// where it can be skipped. The sampled normals leave out the cell's rim: half their spacing is added.
    void bound(Layout& layout, std::size_t index) {
        members_.clear();
        glm::dvec3 axis(0.0);
        for (std::size_t n = 0; n < kNormals; ++n)
            if (layout.owner[n] == index) members_.push_back(normals_[n]), axis += normals_[n];
        Cell& cell = layout.cells[index];
        cell.share = static_cast<double>(members_.size()) / static_cast<double>(kNormals);
        cell.sine = 2.0;
        double best = 0.05;
        for (int step = 3; !members_.empty() && step < 27; ++step) {
            axis = glm::normalize(axis);
            double least = 2.0;
            glm::dvec3 farthest(0.0);
            for (const glm::dvec3& normal : members_) {
                const double dot = glm::dot(axis, normal);
                if (dot < least) least = dot, farthest = normal;
            }
            if (least > best) {
                best = least;
                cell.axis = axis;
                cell.sine = std::sin(std::acos(std::min(least, 1.0)) + kRim);
            }
            axis += (farthest - axis) / static_cast<double>(step);
        }
        const auto place = std::find(layout.order.begin(), layout.order.end(), index) - layout.order.begin();
        const std::uint64_t bit = std::uint64_t{1} << place;
        const double sine = cell.sine + static_cast<double>(kFacingSlack);
        for (std::size_t v = 0; v < kViews; ++v) {
            std::uint64_t& mask = layout.skippable[v];
            mask = glm::dot(cell.axis, views_[v]) > sine ? mask | bit : mask & ~bit;
        }
    }

    /// What lies before the first cell that is needed, after the last, and in the largest gaps between.
    [[nodiscard]] double skipped_share(const Layout& layout) const {
        std::array<double, kCells + 1> before{};
        for (std::size_t i = 0; i < kCells; ++i)
            before[i + 1] = before[i] + layout.cells[layout.order[i]].share;
        double total = 0.0;
        for (std::uint64_t mask : layout.skippable) {
            double ends = 0.0, largest = 0.0, second = 0.0;
            while (mask != 0) {
                const int first = std::countr_zero(mask), count = std::countr_one(mask >> first);
                const auto past = static_cast<std::size_t>(first + count);
                const double share = before[past] - before[static_cast<std::size_t>(first)];
                mask &= ~bits(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
                if (first == 0 || past == kCells) {
                    ends += share;
                } else {
                    second = std::max(second, std::min(largest, share));
                    largest = std::max(largest, share);
                }
            }
            total += ends + (max_ranges_ > 1 ? largest : 0.0) + (max_ranges_ > 2 ? second : 0.0);
        }
        return total / static_cast<double>(kViews);
    }

    static_assert(kCells <= 64);
    inline static const double kRim = 0.5 * std::sqrt(4.0 * 3.14159265358979 / static_cast<double>(kNormals));

    int max_ranges_;
    Random random_;
    std::vector<glm::dvec3> normals_ = spread_points(kNormals, 0.5);
    std::vector<glm::dvec3> views_ = spread_points(kViews, 1.1);
    std::vector<glm::dvec3> members_;
    Layout now_, next_;
    double value_ = 0.0;
};

void print_table(const Search& search, int max_ranges) {
    const Layout& layout = search.layout();
    std::printf("    // R = %d\n    {{\n", max_ranges);
    for (std::size_t i = 0; i < kCells; ++i) {
        const glm::dvec3& c = layout.cells[layout.order[i]].centre;
        std::printf("        {%.5ff, %.5ff, %.5ff},\n", c.x, c.y, c.z);
    }
    std::printf("    }},\n");
}

int run(int argc, char** argv) {
    const int max_ranges = argc > 1 ? std::atoi(argv[1]) : 0;
    if (max_ranges < 1 || max_ranges > kMaxClusterRanges) {
        std::fprintf(stderr,
                     "usage: rhview_cluster_order_search R(1-3) [seed] [order moves] [joint moves]\n");
        return 2;
    }
    const auto number = [&](int index, std::uint64_t otherwise) {
        return argc > index ? std::strtoull(argv[index], nullptr, 10) : otherwise;
    };
    Search search(max_ranges, static_cast<std::uint32_t>(number(2, 1)));
    search.anneal_order(number(3, 400'000), 0.003, 1e-5);
    std::fprintf(stderr, "order of Fibonacci cells: %.4f drawn\n", 1.0 - search.value());
    search.anneal_all(number(4, 200'000), 3e-4, 1e-6);
    std::fprintf(stderr, "order and cells: %.4f drawn\n", 1.0 - search.value());
    print_table(search, max_ranges);
    return 0;
}

}  // namespace
}  // namespace rhview

int main(int argc, char** argv) {
    return rhview::run(argc, argv);
}
