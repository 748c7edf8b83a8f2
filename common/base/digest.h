#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace radfarm {

/// SHA-256 of a byte sequence that arrives in pieces; 64 lower-case hexadecimal digits. About 1 GB/s.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void update(std::span<const std::byte> bytes);
  void update(std::string_view text) { update(std::as_bytes(std::span(text))); }
  /// The object's bytes; only for types without padding.
  template <typename T>
    requires std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>
  void update_value(const T& value) {
    update(std::as_bytes(std::span(&value, 1)));
  }
  /// The digest of all that was given. Requires: called once, last.
  [[nodiscard]] std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);
[[nodiscard]] std::string sha256_hex(std::string_view text);
/// True for what sha256_hex can return: the only names that blobs may have.
[[nodiscard]] bool is_sha256_hex(std::string_view text);

}  // namespace radfarm
