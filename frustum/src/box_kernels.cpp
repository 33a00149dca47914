// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Highway compiles this file once per instruction set and calls the best that the machine has.
//
// Corners stay in registers. Which of them is a plane's p-vertex is known by the plane's octant, so the
// planes' arithmetic is written once per octant and chosen by a jump that is the same for every box. What is
// kept of the planes is the greatest bit pattern of their values: taken as an unsigned number, that is the
// most negative value if one is negative. Rounding is monotone, so the slack may be added last: the answer is
// that of `classify`, bit for bit. Integer maxima because the units that add are the bottleneck, and because
// they keep NaN. Multiplications and additions stay apart on purpose (box_test.h).

#include "box_kernels.h"

#include <algorithm>
#include <cstring>

// Vectors whose length only the machine knows cannot be members; NEON serves there.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "box_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rhview {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using U = hn::RebindToUnsigned<D>;
using Bits = hn::Vec<U>;

// Vectors at a time: two share a plane's jump and constants.
constexpr std::size_t kVectors = 2;
constexpr std::size_t kLanes = HWY_LANES(float);
constexpr std::size_t kChunk = kVectors * kLanes;
static_assert(64 % kChunk == 0, "a word holds the bits of whole chunks");

// How far ahead memory is asked for: 2 KiB of each array, measured on Zen 5.
constexpr std::size_t kPrefetchBoxes = 512;

/// Corners of a chunk, relative to the eye.
struct Corners {
    V min_x[kVectors], min_y[kVectors], min_z[kVectors];
    V max_x[kVectors], max_y[kVectors], max_z[kVectors];
};

/// Boxes from six arrays.
struct ArraySource {
    const float* array[6];
    explicit ArraySource(const BoxSpans& b) : array{b.min_x, b.min_y, b.min_z, b.max_x, b.max_y, b.max_z} {}

    HWY_INLINE void load(std::size_t first, Corners& c) const {
        const D d;
        for (std::size_t v = 0; v < kVectors; ++v) {
            const std::size_t at = first + v * kLanes;
            c.min_x[v] = hn::LoadU(d, array[0] + at);
            c.min_y[v] = hn::LoadU(d, array[1] + at);
            c.min_z[v] = hn::LoadU(d, array[2] + at);
            c.max_x[v] = hn::LoadU(d, array[3] + at);
            c.max_y[v] = hn::LoadU(d, array[4] + at);
            c.max_z[v] = hn::LoadU(d, array[5] + at);
        }
    }
    HWY_INLINE void prefetch(std::size_t first) const {
        for (const float* values : array)
            for (std::size_t at = 0; at < kChunk; at += 16) hwy::Prefetch(values + first + at);
    }
    [[nodiscard]] float value(std::size_t box, std::size_t which) const { return array[which][box]; }
};

/// Boxes that lie one after another.
struct AabbSource {
    const float* values;
    explicit AabbSource(const Aabb* boxes) : values(&boxes->min.x) {}

    HWY_INLINE void load(std::size_t first, Corners& c) const {
        const D d;
        for (std::size_t v = 0; v < kVectors; ++v) {
            const float* at = values + 6 * (first + v * kLanes);
#if HWY_TARGET == HWY_SCALAR
            c.min_x[v] = hn::LoadU(d, at);
            c.min_y[v] = hn::LoadU(d, at + 1);
            c.min_z[v] = hn::LoadU(d, at + 2);
            c.max_x[v] = hn::LoadU(d, at + 3);
            c.max_y[v] = hn::LoadU(d, at + 4);
            c.max_z[v] = hn::LoadU(d, at + 5);
#else
            // Corners of half the boxes each: min and max alternate.
            V x0, y0, z0, x1, y1, z1;
            hn::LoadInterleaved3(d, at, x0, y0, z0);
            hn::LoadInterleaved3(d, at + 3 * kLanes, x1, y1, z1);
            c.min_x[v] = hn::ConcatEven(d, x1, x0);
            c.min_y[v] = hn::ConcatEven(d, y1, y0);
            c.min_z[v] = hn::ConcatEven(d, z1, z0);
            c.max_x[v] = hn::ConcatOdd(d, x1, x0);
            c.max_y[v] = hn::ConcatOdd(d, y1, y0);
            c.max_z[v] = hn::ConcatOdd(d, z1, z0);
#endif
        }
    }
    HWY_INLINE void prefetch(std::size_t first) const {
        for (std::size_t at = 0; at < 6 * kChunk; at += 16) hwy::Prefetch(values + 6 * first + at);
    }
    [[nodiscard]] float value(std::size_t box, std::size_t which) const {
        return values[6 * box + which];
    }
};

HWY_INLINE Bits bits_of(V value) {
    return hn::BitCast(U(), value);
}

/// Lowers `least` to the plane's values at the p-vertices. Octant bits: whether the normal's x, y, z is not
/// negative.
template <unsigned octant>
HWY_INLINE void lower_to_plane(const KernelPlanes::Plane& plane, const Corners& c, Bits* least) {
    const D d;
    const V x = hn::Set(d, plane.x), y = hn::Set(d, plane.y), z = hn::Set(d, plane.z);
    const V distance = hn::Set(d, plane.distance);
    for (std::size_t v = 0; v < kVectors; ++v) {
        const V p_x = octant & 1 ? c.max_x[v] : c.min_x[v];
        const V p_y = octant & 2 ? c.max_y[v] : c.min_y[v];
        const V p_z = octant & 4 ? c.max_z[v] : c.min_z[v];
        const V product = hn::Add(hn::Add(hn::Mul(x, p_x), hn::Mul(y, p_y)), hn::Mul(z, p_z));
        least[v] = hn::Max(least[v], bits_of(hn::Add(product, distance)));
    }
}

HWY_INLINE void lower_to_plane(const KernelPlanes::Plane& plane, const Corners& c, Bits* least) {
    switch (plane.octant) {
        case 0:
            return lower_to_plane<0>(plane, c, least);
        case 1:
            return lower_to_plane<1>(plane, c, least);
        case 2:
            return lower_to_plane<2>(plane, c, least);
        case 3:
            return lower_to_plane<3>(plane, c, least);
        case 4:
            return lower_to_plane<4>(plane, c, least);
        case 5:
            return lower_to_plane<5>(plane, c, least);
        case 6:
            return lower_to_plane<6>(plane, c, least);
        default:
            return lower_to_plane<7>(plane, c, least);
    }
}

HWY_INLINE V slack_of(const Corners& c, std::size_t v) {
    const D d;
    const Bits x = hn::Max(bits_of(hn::Abs(c.min_x[v])), bits_of(hn::Abs(c.max_x[v])));
    const Bits y = hn::Max(bits_of(hn::Abs(c.min_y[v])), bits_of(hn::Abs(c.max_y[v])));
    const Bits z = hn::Max(bits_of(hn::Abs(c.min_z[v])), bits_of(hn::Abs(c.max_z[v])));
    return hn::Mul(hn::Set(d, kBoxSlack), hn::BitCast(d, hn::Max(hn::Max(x, y), z)));
}

HWY_INLINE std::uint64_t outside_bits(Bits least, V slack) {
    const D d;
    std::uint8_t bytes[8];
    hn::StoreMaskBits(d, hn::Lt(hn::Add(hn::BitCast(d, least), slack), hn::Zero(d)), bytes);
    // Exactly the bytes that were written: a longer load would wait for the store to reach the cache.
    std::uint64_t bits = bytes[0];
    if constexpr (kLanes > 8) bits |= std::uint64_t{bytes[1]} << 8;
    return bits;
}

/// A chunk of boxes from `first` on: one bit each, set where a box is outside.
template <class Source>
HWY_INLINE std::uint64_t cull_chunk(const KernelPlanes& planes, const Source& source, std::size_t first) {
    const D d;
    Corners c;
    source.load(first, c);
    const V eye_x = hn::Set(d, planes.eye[0]), eye_y = hn::Set(d, planes.eye[1]),
            eye_z = hn::Set(d, planes.eye[2]);
    Bits least[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) {
        c.min_x[v] = hn::Sub(c.min_x[v], eye_x);
        c.min_y[v] = hn::Sub(c.min_y[v], eye_y);
        c.min_z[v] = hn::Sub(c.min_z[v], eye_z);
        c.max_x[v] = hn::Sub(c.max_x[v], eye_x);
        c.max_y[v] = hn::Sub(c.max_y[v], eye_y);
        c.max_z[v] = hn::Sub(c.max_z[v], eye_z);
        least[v] = hn::Zero(U());
    }
    for (std::uint32_t i = 0; i < planes.count; ++i) lower_to_plane(planes.planes[i], c, least);
    std::uint64_t outside = 0;
    for (std::size_t v = 0; v < kVectors; ++v)
        outside |= outside_bits(least[v], slack_of(c, v)) << v * kLanes;
    return outside;
}

/// What does not fill a chunk is copied, so nothing behind it is read.
template <class Source>
HWY_INLINE std::uint64_t cull_rest(const KernelPlanes& planes, const Source& source, std::size_t first,
                                   std::size_t count) {
    HWY_ALIGN float rest[6][kChunk] = {};
    for (std::size_t which = 0; which < 6; ++which)
        for (std::size_t box = 0; box < count; ++box) rest[which][box] = source.value(first + box, which);
    return cull_chunk(planes, ArraySource({rest[0], rest[1], rest[2], rest[3], rest[4], rest[5], kChunk}), 0);
}

/// A word of 64 boxes, or what is left.
template <class Source>
HWY_INLINE std::uint64_t cull_some(const KernelPlanes& planes, const Source& source, std::size_t first,
                                   std::size_t count, bool prefetch) {
    std::uint64_t outside = 0;
    std::size_t done = 0;
    for (; done + kChunk <= count; done += kChunk) {
        if (prefetch) source.prefetch(first + done + kPrefetchBoxes);
        outside |= cull_chunk(planes, source, first + done) << done;
    }
    if (done < count) outside |= cull_rest(planes, source, first + done, count - done) << done;
    return count >= 64 ? ~outside : ~outside & ((std::uint64_t{1} << count) - 1);
}

void array_loop(const KernelPlanes* views, std::size_t view_count, const BoxSpans& boxes,
                std::uint64_t* visible) {
    const std::size_t words = visibility_words(boxes.count);
    const ArraySource source(boxes);
    for (std::size_t word = 0; word < words; ++word) {
        const std::size_t first = 64 * word, left = boxes.count - first;
        for (std::size_t view = 0; view < view_count; ++view)
            visible[view * words + word] =
                cull_some(views[view], source, first, std::min<std::size_t>(64, left),
                          view == 0 && left > kPrefetchBoxes + 64);
    }
}

void aabb_loop(const KernelPlanes& planes, const Aabb* boxes, std::size_t count, std::uint64_t* visible) {
    if (count == 0) return;
    const AabbSource source(boxes);
    for (std::size_t first = 0; first < count; first += 64)
        visible[first / 64] = cull_some(planes, source, first, std::min<std::size_t>(64, count - first),
                                        count - first > kPrefetchBoxes + 64);
}

std::uint64_t word_loop(const KernelPlanes& planes, const BoxSpans& boxes) {
    return cull_some(planes, ArraySource(boxes), 0, boxes.count, false);
}

}  // namespace HWY_NAMESPACE
}  // namespace rhview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rhview {

HWY_EXPORT(array_loop);
HWY_EXPORT(aabb_loop);
HWY_EXPORT(word_loop);

void cull_arrays(const KernelPlanes* views, std::size_t view_count, const BoxSpans& boxes,
                 std::uint64_t* visible) {
    HWY_DYNAMIC_DISPATCH(array_loop)(views, view_count, boxes, visible);
}

void cull_aabbs(const KernelPlanes& planes, const Aabb* boxes, std::size_t count, std::uint64_t* visible) {
    HWY_DYNAMIC_DISPATCH(aabb_loop)(planes, boxes, count, visible);
}

std::uint64_t cull_word(const KernelPlanes& planes, const BoxSpans& boxes) {
    return HWY_DYNAMIC_DISPATCH(word_loop)(planes, boxes);
}

}  // namespace rhview
#endif
