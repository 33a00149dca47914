// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The techniques of the literature on frustum culling, each of which can be switched on and off: to measure
/// what pays on a scene and a machine. What paid is in `BoxHierarchy::cull` and `cull_boxes`; docs/frustum.md
/// has the figures.
///
/// Whatever is chosen, nothing that `classify` does not prove outside is left out.
#pragma once

#include <cstdint>
#include <vector>

#include "rhview/frustum/box_hierarchy.h"

namespace rhview {

/// How one box is tested. The vector loop serves leaves; nodes are then tested as with `PAndNVertex`.
enum class BoxTest {
    EightCorners,  ///< all corners against each plane
    PAndNVertex,   ///< Assarsson & Möller 2000: the corner farthest along the normal, and the nearest
    Radar,  ///< Placeres 2005: all corners in the camera's axes; symmetric perspectives, else PAndNVertex
    VectorWithin,  ///< one box, all planes in one vector
    VectorAcross,  ///< one vector of boxes, plane after plane
};

/// In which order boxes come to be tested.
enum class Traversal {
    Flat,       ///< every box, no hierarchy
    Stack,      ///< a stack of nodes still to be visited
    Stackless,  ///< escape indices
};

/// How the work is shared.
enum class Threads {
    One,
    StaticSplit,   ///< subtrees shared out to two threads beforehand
    WorkStealing,  ///< subtrees taken by whichever of two threads is free
};

/// One choice of each kind: what the ablation compares.
struct CullingTechniques {
    BoxTest test = BoxTest::PAndNVertex;
    Traversal traversal = Traversal::Stackless;
    Threads threads = Threads::One;
    /// The plane that rejected a node last time is tested first. Assarsson & Möller 2000.
    bool plane_coherency = false;
    /// A node smaller than the distance of the frustum's centre from its planes is tested against the three
    /// planes of its octant first; the others are still tested below it. Symmetric perspectives only.
    bool octant_test = false;
    /// A plane that a node is inside of is not tested below it ("inherited inside flags").
    bool masking = false;
    /// While the camera only moves, a node's distances from the planes are last frame's and one addition.
    bool translation_coherency = false;
    /// The box of the frustum's corners is tested before the planes. With a far plane only.
    bool frustum_box_first = false;
};

/// One per view: it remembers frames. The hierarchy outlives it and is not refitted meanwhile.
class TechniqueCuller {
  public:
    /// `tree` outlives it.
    TechniqueCuller(const BoxHierarchy& tree, const CullingTechniques& techniques);

    /// As `BoxHierarchy::cull`.
    HierarchyVisits cull(const View& view, const glm::dvec3& scene_origin, std::vector<OrderRange>& visible);

  private:
    friend class TechniqueWalk;

    /// Of a node; only what the techniques need is allocated.
    struct Distances {
        double p[6], n[6];        ///< of the p- and n-vertex, less what the camera moved until then
        std::uint32_t epoch = 0;  ///< in which they were computed; 0: never
    };
    struct Camera {
        glm::dmat4 clip{0.0};
        glm::dvec3 eye{0.0};
        double moved[6] = {};     ///< along each plane's normal, since the epoch began
        std::uint32_t epoch = 0;  ///< ends when the camera turns or zooms
    };
    void follow_camera(const View& view, const Frustum& frustum);

    const BoxHierarchy& tree_;
    CullingTechniques techniques_;
    std::vector<std::uint8_t> last_plane_;
    std::vector<Distances> distances_;
    Camera camera_;
    std::vector<std::vector<OrderRange>> parts_;  ///< per subtree, with threads
};

}  // namespace rhview
