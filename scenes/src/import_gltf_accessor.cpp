// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// Accessors as in the glTF 2.0 specification, sections 3.6.2 and 3.11 (normalized integers).

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "import_gltf_internal.h"

namespace rhview::gltf {
namespace {

std::size_t component_bytes(int component_type) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_INT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        case TINYGLTF_COMPONENT_TYPE_DOUBLE:
            return 8;
        default:
            return 0;
    }
}

int component_count(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

/// Sets `span.data` and `span.stride` after checking count × stride against the view and the view against its
/// buffer.
Status locate(const std::string& place, const tinygltf::Model& model, int view_index, std::uint64_t offset,
              bool tightly_packed, ElementSpan& span) {
    if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size()) {
        return Error{fmt::format("{}: buffer view {} does not exist (the file has {}); re-export the file",
                                 place, view_index, model.bufferViews.size())};
    }
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
        return Error{fmt::format("{}: buffer {} does not exist (the file has {}); re-export the file", place,
                                 view.buffer, model.buffers.size())};
    }
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        return Error{
            fmt::format("{}: buffer view {} ends at byte {}+{} of a buffer of {}; re-export the file", place,
                        view_index, view.byteOffset, view.byteLength, data.size())};
    }
    const std::uint64_t element =
        component_bytes(span.component_type) * static_cast<std::uint64_t>(span.components);
    const std::uint64_t stride = tightly_packed || view.byteStride == 0 ? element : view.byteStride;
    const bool fits = span.count == 0 || (offset <= view.byteLength && element <= view.byteLength - offset &&
                                          span.count - 1 <= (view.byteLength - offset - element) / stride);
    if (!fits) {
        return Error{
            fmt::format("{}: {} elements of {} bytes from byte {} do not fit in buffer view {} of {} bytes; "
                        "re-export the file",
                        place, span.count, stride, offset, view_index, view.byteLength)};
    }
    span.data = data.data() + view.byteOffset + offset;
    span.stride = static_cast<std::size_t>(stride);
    return success();
}

Status locate_sparse(const std::string& place, const tinygltf::Model& model, const tinygltf::Accessor& source,
                     CheckedAccessor& checked) {
    const auto& sparse = source.sparse;
    if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > source.count ||
        sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
        component_bytes(sparse.indices.componentType) == 0) {
        return Error{place + ": its sparse part is not valid; re-export the file"};
    }
    checked.sparse_values = checked.base;
    checked.sparse_values.count = static_cast<std::size_t>(sparse.count);
    checked.sparse_indices.count = static_cast<std::size_t>(sparse.count);
    checked.sparse_indices.component_type = sparse.indices.componentType;
    checked.sparse_indices.components = 1;
    if (Status s =
            locate(place + " sparse indices", model, sparse.indices.bufferView,
                   static_cast<std::uint64_t>(sparse.indices.byteOffset), true, checked.sparse_indices);
        !s)
        return s;
    return locate(place + " sparse values", model, sparse.values.bufferView,
                  static_cast<std::uint64_t>(sparse.values.byteOffset), true, checked.sparse_values);
}

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// Decodes with the component type fixed, so that the loop over elements has no switch.
template <class T>
void read_vectors(const ElementSpan& span, std::span<glm::vec3> out) {
    constexpr bool kInteger = std::numeric_limits<T>::is_integer;
    const double scale =
        kInteger && span.normalized ? 1.0 / static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const unsigned char* element = span.data + i * span.stride;
        for (int c = 0; c < 3; ++c) {
            const T raw = load<T>(element + static_cast<std::size_t>(c) * sizeof(T));
            const double value = static_cast<double>(raw) * scale;
            out[i][c] = static_cast<float>(kInteger && span.normalized ? std::max(value, -1.0) : value);
        }
    }
}

void read_vectors(const ElementSpan& span, std::span<glm::vec3> out) {
    switch (span.component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read_vectors<std::int8_t>(span, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read_vectors<std::uint8_t>(span, out);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read_vectors<std::int16_t>(span, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read_vectors<std::uint16_t>(span, out);
        case TINYGLTF_COMPONENT_TYPE_INT:
            return read_vectors<std::int32_t>(span, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read_vectors<std::uint32_t>(span, out);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return read_vectors<float>(span, out);
        default:
            return read_vectors<double>(span, out);
    }
}

template <class T>
void read_scalars(const ElementSpan& span, std::span<std::uint32_t> out) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = load<T>(span.data + i * span.stride);
}

bool is_index_type(int component_type) {
    return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

void read_indices(const ElementSpan& span, std::span<std::uint32_t> out) {
    switch (span.component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read_scalars<std::uint8_t>(span, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read_scalars<std::uint16_t>(span, out);
        default:
            return read_scalars<std::uint32_t>(span, out);
    }
}

Error wrong_index_type(const std::string& place) {
    return Error{place + ": indices must be unsigned bytes, shorts or ints; re-export the file"};
}

/// Base elements, then the sparse replacements over them.
template <class T, class Read>
Result<std::vector<T>> decode(const std::string& place, const CheckedAccessor& accessor, const Read& read) {
    std::vector<T> values(accessor.base.count);
    if (accessor.base.data != nullptr) read(accessor.base, values);
    if (accessor.sparse_indices.count == 0) return values;
    std::vector<std::uint32_t> targets(accessor.sparse_indices.count);
    if (!is_index_type(accessor.sparse_indices.component_type))
        return wrong_index_type(place + " sparse indices");
    read_indices(accessor.sparse_indices, targets);
    std::vector<T> replacements(targets.size());
    read(accessor.sparse_values, replacements);
    for (std::size_t i = 0; i < targets.size(); ++i) {
        if (targets[i] >= values.size()) {
            return Error{
                fmt::format("{}: sparse index {} is out of range (the accessor has {} elements); "
                            "re-export the file",
                            place, targets[i], values.size())};
        }
        values[targets[i]] = replacements[i];
    }
    return values;
}

}  // namespace

Result<CheckedAccessor> check_accessor(const std::string& place, const tinygltf::Model& model, int accessor) {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) {
        return Error{fmt::format("{}: accessor {} does not exist (the file has {}); re-export the file",
                                 place, accessor, model.accessors.size())};
    }
    const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
    CheckedAccessor checked;
    checked.base.count = source.count;
    checked.base.component_type = source.componentType;
    checked.base.components = component_count(source.type);
    checked.base.normalized = source.normalized;
    if (component_bytes(source.componentType) == 0 || checked.base.components == 0) {
        return Error{
            fmt::format("{}: accessor {} has component type {}, which is none of glTF's for vertices; "
                        "re-export the file",
                        place, accessor, source.componentType)};
    }
    if (source.bufferView != -1) {
        if (Status s = locate(place, model, source.bufferView, source.byteOffset, false, checked.base); !s)
            return s.error();
    }
    if (source.sparse.isSparse) {
        if (Status s = locate_sparse(place, model, source, checked); !s) return s.error();
    }
    return checked;
}

Result<std::vector<glm::vec3>> decode_vectors(const std::string& place, const CheckedAccessor& accessor) {
    if (accessor.base.components < 3)
        return Error{place + ": must have three components; re-export the file"};
    const auto read = [](const ElementSpan& span, std::vector<glm::vec3>& out) { read_vectors(span, out); };
    return decode<glm::vec3>(place, accessor, read);
}

Result<std::vector<std::uint32_t>> decode_indices(const std::string& place, const CheckedAccessor& accessor) {
    if (accessor.base.components != 1 || !is_index_type(accessor.base.component_type))
        return wrong_index_type(place);
    const auto read = [](const ElementSpan& span, std::vector<std::uint32_t>& out) {
        read_indices(span, out);
    };
    return decode<std::uint32_t>(place, accessor, read);
}

}  // namespace rhview::gltf
