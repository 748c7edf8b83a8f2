#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/status.h"

namespace radfarm {

/// Types whose bytes may be stored and used in place. Wider than trivially copyable: Imath's vectors spell out a copy
/// constructor that copies bytes.
template <typename T>
concept Flat = std::is_standard_layout_v<T> && std::is_trivially_destructible_v<T>;

/// Stored artefacts are flat files: a header, a table of named arrays, then the arrays, little-endian and 64-byte aligned,
/// used in place from mapped memory. docs/formats.md has the layout. A writer's bytes depend only on what was added, in
/// order, so the digest of a file is the digest of its contents.
class FlatFileWriter {
 public:
  /// `kind` is at most 8 characters, such as "scene"; `version` is the kind's own.
  FlatFileWriter(std::string_view kind, std::uint32_t version) : kind_(kind), version_(version) {}

  /// Requires: a T without padding, and a name of at most 24 characters not yet used.
  template <Flat T>
  void add(std::string_view name, std::span<const T> values) {
    add_bytes(name, sizeof(T), std::as_bytes(values));
  }
  template <Flat T>
  void add(std::string_view name, const std::vector<T>& values) {
    add(name, std::span<const T>(values));
  }
  template <Flat T>
  void add_value(std::string_view name, const T& value) {
    add(name, std::span<const T>(&value, 1));
  }
  void add_text(std::string_view name, std::string_view text) { add(name, std::span<const char>(text)); }

  [[nodiscard]] std::vector<std::byte> finish() const;

 private:
  struct Section {
    std::string name;
    std::size_t element_size;
    std::vector<std::byte> bytes;
  };
  void add_bytes(std::string_view name, std::size_t element_size, std::span<const std::byte> bytes);

  std::string kind_;
  std::uint32_t version_;
  std::vector<Section> sections_;
};

/// Views into a flat file's bytes, which must outlive the reader. Every offset and size is checked before use, so damaged
/// or hostile bytes give DATA_LOSS, never a read outside.
class FlatFileReader {
 public:
  static Result<FlatFileReader> open(std::span<const std::byte> bytes, std::string_view kind, std::uint32_t version);

  /// The array called `name`; DATA_LOSS when it is missing or its elements are not of T's size.
  template <Flat T>
  Result<std::span<const T>> get(std::string_view name) const {
    RADFARM_TRY(const std::span<const std::byte> bytes, get_bytes(name, sizeof(T)));
    return std::span<const T>(reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T));
  }
  template <typename T>
  Result<std::vector<T>> copy(std::string_view name) const {
    RADFARM_TRY(const std::span<const T> values, get<T>(name));
    return std::vector<T>(values.begin(), values.end());
  }
  template <typename T>
  Result<T> get_value(std::string_view name) const {
    RADFARM_TRY(const std::span<const T> values, get<T>(name));
    if (values.size() != 1) return fail(Code::kDataLoss, std::string(name) + ": is not a single value");
    return values[0];
  }
  Result<std::string> get_text(std::string_view name) const {
    RADFARM_TRY(const std::span<const char> text, get<char>(name));
    return std::string(text.begin(), text.end());
  }

 private:
  struct Section {
    std::string name;
    std::size_t element_size;
    std::span<const std::byte> bytes;
  };
  Result<std::span<const std::byte>> get_bytes(std::string_view name, std::size_t element_size) const;

  std::vector<Section> sections_;
};

}  // namespace radfarm
