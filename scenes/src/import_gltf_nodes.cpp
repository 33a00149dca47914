// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>

#include "import_gltf_internal.h"

namespace rhview::gltf {
namespace {

Result<glm::dmat4> parent_from_node(const std::string& name, const tinygltf::Node& node, std::size_t index) {
    const auto wrong_length = [](const std::vector<double>& values, std::size_t length) {
        return !values.empty() && values.size() != length;
    };
    if (wrong_length(node.matrix, 16) || wrong_length(node.translation, 3) ||
        wrong_length(node.rotation, 4) || wrong_length(node.scale, 3)) {
        return Error{fmt::format(
            "{}: node {}: its transform has a wrong number of values; re-export the file", name, index)};
    }
    glm::dmat4 matrix(1.0);
    if (!node.matrix.empty()) {
        // The last row is 0 0 0 1 in every valid file.
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                matrix[column][row] = node.matrix[static_cast<std::size_t>(4 * column + row)];
        return matrix;
    }
    if (!node.rotation.empty())
        matrix = glm::mat4_cast(glm::normalize(
            glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])));
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        if (!node.scale.empty()) matrix[axis] *= node.scale[i];
        if (!node.translation.empty()) matrix[3][axis] = node.translation[i];
    }
    return matrix;
}

/// The parent of every node, -1 for roots.
Result<std::vector<int>> find_parents(const std::string& name, const tinygltf::Model& model) {
    std::vector<int> parents(model.nodes.size(), -1);
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        for (const int child : model.nodes[node].children) {
            if (child < 0 || static_cast<std::size_t>(child) >= parents.size()) {
                return Error{fmt::format(
                    "{}: node {}: child {} does not exist (the file has {} nodes); re-export the file", name,
                    node, child, parents.size())};
            }
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent != -1) {
                return Error{fmt::format(
                    "{}: node {} is a child of node {} and of node {}; re-export the file with one "
                    "parent per node",
                    name, child, parent, node)};
            }
            parent = static_cast<int>(node);
        }
    }
    return parents;
}

/// With one parent per node, whatever no root reaches hangs in a cycle.
Status check_acyclic(const std::string& name, const tinygltf::Model& model, const std::vector<int>& parents) {
    std::vector<bool> reached(parents.size());
    std::vector<int> stack;
    for (std::size_t node = 0; node < parents.size(); ++node)
        if (parents[node] == -1) stack.push_back(static_cast<int>(node));
    while (!stack.empty()) {
        const auto node = static_cast<std::size_t>(stack.back());
        stack.pop_back();
        reached[node] = true;
        stack.insert(stack.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
    }
    for (std::size_t node = 0; node < parents.size(); ++node) {
        if (!reached[node])
            return Error{
                fmt::format("{}: node {} is below itself (a cycle); re-export the file", name, node)};
    }
    return success();
}

/// The roots to draw, last first: the traversal takes them from the back.
Result<std::vector<int>> scene_roots(const std::string& name, const tinygltf::Model& model,
                                     const std::vector<int>& parents) {
    std::vector<int> roots;
    if (model.defaultScene != -1 &&
        (model.defaultScene < 0 || static_cast<std::size_t>(model.defaultScene) >= model.scenes.size())) {
        return Error{fmt::format("{}: scene {} does not exist (the file has {}); re-export the file", name,
                                 model.defaultScene, model.scenes.size())};
    }
    if (model.scenes.empty()) {
        for (std::size_t node = parents.size(); node-- > 0;)
            if (parents[node] == -1) roots.push_back(static_cast<int>(node));
        return roots;
    }
    const auto scene = static_cast<std::size_t>(model.defaultScene == -1 ? 0 : model.defaultScene);
    std::vector<bool> listed(parents.size());
    for (const int node : model.scenes[scene].nodes) {
        const auto index = static_cast<std::size_t>(node);
        if (node < 0 || index >= parents.size()) {
            return Error{
                fmt::format("{}: scene {}: node {} does not exist (the file has {}); re-export the file",
                            name, scene, node, parents.size())};
        }
        if (parents[index] != -1 || listed[index]) {
            return Error{
                fmt::format("{}: scene {}: node {} is listed twice or is another node's child; "
                            "re-export the file",
                            name, scene, node)};
        }
        listed[index] = true;
    }
    roots.assign(model.scenes[scene].nodes.rbegin(), model.scenes[scene].nodes.rend());
    return roots;
}

}  // namespace

Result<std::vector<PlacedMesh>> place_meshes(const std::string& name, const tinygltf::Model& model) {
    Result<std::vector<int>> parents = find_parents(name, model);
    if (!parents) return parents.error();
    if (Status s = check_acyclic(name, model, *parents); !s) return s.error();
    Result<std::vector<int>> roots = scene_roots(name, model, *parents);
    if (!roots) return roots.error();

    std::vector<PlacedMesh> placed;
    std::vector<std::pair<int, glm::dmat4>> stack;
    for (const int root : *roots) stack.emplace_back(root, glm::dmat4(1.0));
    while (!stack.empty()) {
        const auto [id, world_from_parent] = stack.back();
        stack.pop_back();
        const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(id)];
        Result<glm::dmat4> local = parent_from_node(name, node, static_cast<std::size_t>(id));
        if (!local) return local.error();
        const glm::dmat4 world = world_from_parent * *local;
        if (node.mesh >= 0) {
            if (static_cast<std::size_t>(node.mesh) >= model.meshes.size()) {
                return Error{
                    fmt::format("{}: node {}: mesh {} does not exist (the file has {}); re-export the file",
                                name, id, node.mesh, model.meshes.size())};
            }
            placed.push_back({static_cast<std::size_t>(node.mesh), world});
        }
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            stack.emplace_back(*child, world);
    }
    return placed;
}

}  // namespace rhview::gltf
