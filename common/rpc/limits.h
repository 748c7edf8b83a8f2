#pragma once

#include <cstddef>
#include <cstdint>

namespace radfarm::limits {

/// What a peer may send. Every limit is checked where bytes enter and named in the error.

inline constexpr std::size_t kMessageBytes = std::size_t{64} << 20U;      // one gRPC message
inline constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;         // one chunk of a streamed blob or result
inline constexpr std::uint64_t kBlobBytes = std::uint64_t{16} << 30U;     // one blob
inline constexpr std::uint64_t kResultBytes = std::uint64_t{256} << 20U;  // one task's result
inline constexpr std::size_t kSceneFiles = 10000;
inline constexpr std::uint64_t kSceneBytes = std::uint64_t{4} << 30U;  // all files of one scene
inline constexpr std::size_t kRequestJsonBytes = std::size_t{64} << 10U;
inline constexpr std::size_t kNameBytes = 200;   // display names
inline constexpr std::size_t kIdBytes = 100;     // request ids, worker names
inline constexpr std::size_t kPathBytes = 1000;  // one relative path
inline constexpr std::uint32_t kLeaseWaitMs = 60000;
inline constexpr std::uint32_t kWorkerThreads = 1024;

}  // namespace radfarm::limits
