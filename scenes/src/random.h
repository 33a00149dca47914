// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Random numbers that are the same on every machine: the standard's engine, our own distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace rhview {

/// Scrambles all 64 bits. Source: Steele, Lea and Flood, "Fast splittable pseudorandom number generators",
/// 2014.
constexpr std::uint64_t scramble(std::uint64_t value) {
    value += 0x9e3779b97f4a7c15u;
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
}

/// A number that depends on the seed and a place alone: neighbours need no common stream.
constexpr std::uint64_t hash_of_cell(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint64_t hash = scramble(seed ^ static_cast<std::uint64_t>(x));
    hash = scramble(hash ^ static_cast<std::uint64_t>(y));
    return scramble(hash ^ static_cast<std::uint64_t>(z));
}

/// Value noise in [0, 1) over a lattice of step 1, with a continuous slope.
inline double value_noise(std::uint64_t seed, double x, double z) {
    const auto at = [&](std::int64_t cell_x, std::int64_t cell_z) {
        return static_cast<double>(hash_of_cell(seed, cell_x, 0, cell_z) >> 32) * 0x1p-32;
    };
    const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double floor_x = std::floor(x), floor_z = std::floor(z);
    const auto cell_x = static_cast<std::int64_t>(floor_x), cell_z = static_cast<std::int64_t>(floor_z);
    const double tx = smooth(x - floor_x), tz = smooth(z - floor_z);
    const double low = at(cell_x, cell_z) + (at(cell_x + 1, cell_z) - at(cell_x, cell_z)) * tx;
    const double high = at(cell_x, cell_z + 1) + (at(cell_x + 1, cell_z + 1) - at(cell_x, cell_z + 1)) * tx;
    return low + (high - low) * tz;
}

class SceneRandom {
  public:
    explicit SceneRandom(std::uint64_t seed) : engine_(static_cast<std::uint32_t>(scramble(seed))) {}

    /// In [0, 1), a multiple of 2^-32.
    double unit() { return static_cast<double>(next()) * 0x1p-32; }
    /// In [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// In [0, count); `count` is at least 1.
    int below(int count) {
        return static_cast<int>((std::uint64_t{next()} * static_cast<std::uint64_t>(count)) >> 32);
    }
    /// In [low, high], both included.
    int whole(int low, int high) { return low + below(high - low + 1); }
    bool chance(double probability) { return unit() < probability; }

  private:
    std::uint32_t next() { return static_cast<std::uint32_t>(engine_()); }

    std::mt19937 engine_;
};

}  // namespace rhview
