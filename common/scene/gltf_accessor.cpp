#include "scene/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/check.h"
#include "scene/gltf_check.h"

namespace radfarm {
namespace {

/// Elements in a buffer: `stride` bytes apart, each of `components` values of `component_type`.
struct Elements {
  const char* data = nullptr;
  std::size_t stride = 0;
  int component_type = 0;
  bool normalized = false;
};

template <typename T>
T value_at(const char* address) {
  T value;
  std::memcpy(&value, address, sizeof(T));
  return value;
}

float normalized_value(double value, double largest) { return static_cast<float>(std::max(value / largest, -1.0)); }

float component_value(const Elements& elements, std::size_t element, std::size_t component) {
  const char* base = elements.data + element * elements.stride;
  const bool scaled = elements.normalized;
  switch (elements.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const auto value = value_at<std::int8_t>(base + component);
      return scaled ? normalized_value(value, 127) : static_cast<float>(value);
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const auto value = value_at<std::uint8_t>(base + component);
      return scaled ? normalized_value(value, 255) : static_cast<float>(value);
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const auto value = value_at<std::int16_t>(base + 2 * component);
      return scaled ? normalized_value(value, 32767) : static_cast<float>(value);
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const auto value = value_at<std::uint16_t>(base + 2 * component);
      return scaled ? normalized_value(value, 65535) : static_cast<float>(value);
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
      const auto value = value_at<std::uint32_t>(base + 4 * component);
      return scaled ? normalized_value(value, 4294967295.0) : static_cast<float>(value);
    }
    default:
      return value_at<float>(base + 4 * component);
  }
}

std::uint32_t index_value(const Elements& elements, std::size_t element) {
  const char* base = elements.data + element * elements.stride;
  if (elements.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return value_at<std::uint8_t>(base);
  if (elements.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return value_at<std::uint16_t>(base);
  return value_at<std::uint32_t>(base);
}

/// The elements behind a buffer view; checks once more that the last byte is inside, whatever was proved before.
Elements elements_in(const GltfModel& model, int view_index, std::size_t offset, int component_type,
                     std::size_t components, std::size_t count) {
  const tinygltf::BufferView& view = model.document.bufferViews.at(static_cast<std::size_t>(view_index));
  const std::string& buffer = model.buffers.at(static_cast<std::size_t>(view.buffer));
  const std::size_t component = component_bytes(static_cast<std::size_t>(component_type));
  const std::size_t element = component * components;
  const std::size_t stride = view.byteStride == 0 ? element : view.byteStride;
  RADFARM_CHECK(count > 0 && view.byteOffset + offset + stride * (count - 1) + element <= buffer.size());
  return {buffer.data() + view.byteOffset + offset, stride, component_type, false};
}

std::size_t components_of(const tinygltf::Accessor& accessor) {
  return static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
}

/// Puts the sparse values over the dense ones; the index that is out of range, if any.
Status put_sparse(const GltfModel& model, const tinygltf::Accessor& accessor, std::size_t components,
                  std::vector<float>& values) {
  const auto count = static_cast<std::size_t>(accessor.sparse.count);
  const Elements indices = elements_in(model, accessor.sparse.indices.bufferView,
                                       static_cast<std::size_t>(accessor.sparse.indices.byteOffset),
                                       accessor.sparse.indices.componentType, 1, count);
  Elements replaced =
      elements_in(model, accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset),
                  accessor.componentType, components_of(accessor), count);
  replaced.normalized = accessor.normalized;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = index_value(indices, i);
    if (index >= accessor.count) {
      return fail(Code::kInvalidArgument, "sparse index " + std::to_string(index) + " is out of range (there are " +
                                              std::to_string(accessor.count) + " elements)");
    }
    for (std::size_t c = 0; c < std::min(components, components_of(accessor)); ++c) {
      values[index * components + c] = component_value(replaced, i, c);
    }
  }
  return {};
}

}  // namespace

Result<std::vector<float>> read_floats(const GltfModel& model, int accessor_index, std::size_t components) {
  const tinygltf::Accessor& accessor = model.document.accessors.at(static_cast<std::size_t>(accessor_index));
  const std::string pointer = "/accessors/" + std::to_string(accessor_index);
  const std::size_t stored = std::min(components, components_of(accessor));
  std::vector<float> values(accessor.count * components, 0.0F);
  for (std::size_t i = 0; i < accessor.count; ++i) {
    for (std::size_t c = stored; c < components; ++c) values[i * components + c] = 1.0F;
  }
  if (accessor.bufferView >= 0) {
    Elements elements = elements_in(model, accessor.bufferView, accessor.byteOffset, accessor.componentType,
                                    components_of(accessor), accessor.count);
    elements.normalized = accessor.normalized;
    for (std::size_t i = 0; i < accessor.count; ++i) {
      for (std::size_t c = 0; c < stored; ++c) values[i * components + c] = component_value(elements, i, c);
    }
  }
  if (accessor.sparse.isSparse) {
    if (const Status status = put_sparse(model, accessor, components, values); !status) {
      return annotate(status.error(), pointer + "/sparse");
    }
  }
  const auto bad = std::find_if(values.begin(), values.end(), [](float value) { return !std::isfinite(value); });
  if (bad == values.end()) return values;
  return fail(Code::kInvalidArgument, pointer + ": element " +
                                          std::to_string(static_cast<std::size_t>(bad - values.begin()) / components) +
                                          " is not finite");
}

std::vector<std::uint32_t> read_indices(const GltfModel& model, int accessor_index) {
  const tinygltf::Accessor& accessor = model.document.accessors.at(static_cast<std::size_t>(accessor_index));
  const Elements elements =
      elements_in(model, accessor.bufferView, accessor.byteOffset, accessor.componentType, 1, accessor.count);
  std::vector<std::uint32_t> indices(accessor.count);
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = index_value(elements, i);
  return indices;
}

}  // namespace radfarm
