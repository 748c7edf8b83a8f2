#pragma once

#include <cstddef>
#include <cstdint>

/// What a scene may ask of us, checked before memory is taken. An error above a limit is RESOURCE_EXHAUSTED and names
/// it.
namespace radfarm::limits {

inline constexpr std::size_t kSceneFileBytes = 0xffffffffU;  // 4 GiB: the scene file, and each file it refers to
inline constexpr std::size_t kTriangles = 100'000'000;       // stored ones; instances multiply them freely
inline constexpr std::size_t kVertices = 300'000'000;        // of one accessor or of one OBJ file
inline constexpr std::size_t kInstances = 10'000'000;
inline constexpr std::size_t kLights = 1'000'000;
inline constexpr std::size_t kLightGroups = 16;                     // an image each
inline constexpr std::size_t kTextureSide = 16'384;                   // pixels
inline constexpr std::size_t kIesFileBytes = 16U << 20U;              // a photometric file
inline constexpr std::size_t kUnpackedBytes = 0xffffffffU;          // 4 GiB: what compressed geometry unpacks to
inline constexpr std::size_t kDracoRatio = 1'000;                     // unpacked bytes a packed byte
inline constexpr std::size_t kTextureFileBytes = 512U << 20U;         // one encoded image
inline constexpr std::size_t kTextureTexels = std::size_t{1} << 30U;  // of all textures together
inline constexpr std::size_t kNodeDepth = 1'000;                      // of the glTF node hierarchy
inline constexpr std::size_t kJsonDepth = 100;                        // of nested brackets: tinygltf recurses
inline constexpr std::size_t kPolygonCorners = 2'000;  // of one OBJ face: ear clipping is quadratic or worse
inline constexpr double kCoordinate = 1e18;            // |v| in metres: squares must stay finite in float
inline constexpr double kLight = 1e18;                 // radiance, cd or lux

}  // namespace radfarm::limits
