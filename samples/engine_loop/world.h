// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// The engine's own data: three materials, two vertex formats. Nothing here knows rhview.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace engine {

/// What the engine's lit materials draw.
struct LitVertex {
    glm::vec3 position;
    glm::vec3 normal;
};

/// What its painted material draws.
struct PaintedVertex {
    glm::vec3 position;
    glm::vec3 colour;
};

struct LitMesh {
    glm::vec3 material_colour;
    std::vector<LitVertex> vertices;
    std::vector<std::uint32_t> indices;
};

struct PaintedMesh {
    std::vector<PaintedVertex> vertices;
    std::vector<std::uint32_t> indices;
};

/// A town of houses with furniture inside.
struct World {
    LitMesh ground;
    LitMesh walls;
    PaintedMesh furniture;
};

World make_world();

}  // namespace engine
