#include "base/flat_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/check.h"

namespace radfarm {
namespace {

static_assert(std::endian::native == std::endian::little, "flat files are little-endian and used in place");

constexpr std::array<char, 8> kMagic = {'R', 'A', 'D', 'F', 'A', 'R', 'M', '1'};
constexpr std::size_t kAlignment = 64;

struct Header {
  std::array<char, 8> magic;
  std::array<char, 8> kind;
  std::uint32_t version;
  std::uint32_t sections;
};

struct TableEntry {
  std::array<char, 24> name;
  std::uint64_t offset;
  std::uint64_t size;
  std::uint64_t element_size;
};

template <std::size_t N>
std::array<char, N> padded(std::string_view text) {
  RADFARM_CHECK(text.size() <= N);
  std::array<char, N> name{};
  std::copy(text.begin(), text.end(), name.begin());
  return name;
}

template <std::size_t N>
std::string_view unpadded(const std::array<char, N>& name) {
  return {name.data(), static_cast<std::size_t>(std::find(name.begin(), name.end(), '\0') - name.begin())};
}

std::size_t align(std::size_t offset) { return (offset + kAlignment - 1) / kAlignment * kAlignment; }

template <typename T>
void put(std::vector<std::byte>& bytes, std::size_t offset, const T& value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

template <typename T>
T take(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

}  // namespace

void FlatFileWriter::add_bytes(std::string_view name, std::size_t element_size, std::span<const std::byte> bytes) {
  for (const Section& section : sections_) RADFARM_CHECK(section.name != name);
  sections_.push_back({std::string(name), element_size, {bytes.begin(), bytes.end()}});
}

std::vector<std::byte> FlatFileWriter::finish() const {
  std::size_t offset = align(sizeof(Header) + sections_.size() * sizeof(TableEntry));
  std::vector<TableEntry> table;
  for (const Section& section : sections_) {
    table.push_back({padded<24>(section.name), offset, section.bytes.size(), section.element_size});
    offset = align(offset + section.bytes.size());
  }
  std::vector<std::byte> file(offset);
  put(file, 0, Header{kMagic, padded<8>(kind_), version_, static_cast<std::uint32_t>(sections_.size())});
  for (std::size_t i = 0; i < table.size(); ++i) {
    put(file, sizeof(Header) + i * sizeof(TableEntry), table[i]);
    if (table[i].size > 0) std::memcpy(file.data() + table[i].offset, sections_[i].bytes.data(), table[i].size);
  }
  return file;
}

Result<FlatFileReader> FlatFileReader::open(std::span<const std::byte> bytes, std::string_view kind,
                                            std::uint32_t version) {
  const auto damaged = [&](std::string_view what) {
    return fail(Code::kDataLoss, "not a radfarm " + std::string(kind) + " file: " + std::string(what));
  };
  if (bytes.size() < sizeof(Header)) return damaged("shorter than its header");
  const auto header = take<Header>(bytes, 0);
  if (header.magic != kMagic || unpadded(header.kind) != kind) return damaged("wrong kind");
  if (header.version != version) {
    return damaged("version " + std::to_string(header.version) + ", this build reads " + std::to_string(version));
  }
  if (header.sections > (bytes.size() - sizeof(Header)) / sizeof(TableEntry)) return damaged("table is cut off");
  FlatFileReader reader;
  for (std::size_t i = 0; i < header.sections; ++i) {
    const auto entry = take<TableEntry>(bytes, sizeof(Header) + i * sizeof(TableEntry));
    const bool inside = entry.offset <= bytes.size() && entry.size <= bytes.size() - entry.offset;
    if (!inside || entry.offset % kAlignment != 0 || entry.element_size == 0 || entry.size % entry.element_size != 0) {
      return damaged("an array lies outside");
    }
    reader.sections_.push_back(
        {std::string(unpadded(entry.name)), entry.element_size, bytes.subspan(entry.offset, entry.size)});
  }
  return reader;
}

Result<std::span<const std::byte>> FlatFileReader::get_bytes(std::string_view name, std::size_t element_size) const {
  for (const Section& section : sections_) {
    if (section.name != name) continue;
    if (section.element_size != element_size) break;
    return section.bytes;
  }
  return fail(Code::kDataLoss, "array '" + std::string(name) + "' is missing or of another type");
}

}  // namespace radfarm
