#include "estimate/task_result.h"

#include "base/flat_file.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 5;

}  // namespace

std::vector<std::byte> encode(const TileResult& result) {
  FlatFileWriter file("tile", kVersion);
  file.add_value("rect", result.rect);
  file.add("pixels", result.pixels);
  file.add("aovs", result.aovs);
  file.add("sharing", result.sharing);
  file.add("needs", result.needs);
  file.add_value("counters", result.counters);
  return file.finish();
}

std::vector<std::byte> encode(const AuditResult& result) {
  FlatFileWriter file("audit", kVersion);
  file.add("pixels", result.pixels);
  file.add_value("counters", result.counters);
  return file.finish();
}

Result<TileResult> decode_tile_result(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "tile", kVersion));
  TileResult result;
  RADFARM_TRY(result.rect, file.get_value<PixelRect>("rect"));
  RADFARM_TRY(result.pixels, file.copy<PixelSums>("pixels"));
  RADFARM_TRY(result.aovs, file.copy<AovSums>("aovs"));
  RADFARM_TRY(result.sharing, file.copy<SharingSums>("sharing"));
  RADFARM_TRY(result.needs, file.copy<PixelNeeds>("needs"));
  RADFARM_TRY(result.counters, file.get_value<Counters>("counters"));
  const PixelRect& rect = result.rect;
  const bool is_inside = rect.x0 >= 0 && rect.y0 >= 0 && rect.x1 > rect.x0 && rect.y1 > rect.y0 &&
                         rect.x1 <= 1 << 20 && rect.y1 <= 1 << 20;
  if (!is_inside || result.pixels.size() != static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height())) {
    return fail(Code::kDataLoss, "tile result: its rectangle and its pixels do not agree");
  }
  const auto agrees = [&](std::size_t size) { return size == 0 || size == result.pixels.size(); };
  if (!agrees(result.aovs.size()) || !agrees(result.sharing.size()) || !agrees(result.needs.size())) {
    return fail(Code::kDataLoss, "tile result: its pixels and their AOVs, or what they share or need, do not agree");
  }
  return result;
}

Result<AuditResult> decode_audit_result(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "audit", kVersion));
  AuditResult result;
  RADFARM_TRY(result.pixels, file.copy<AuditResult::Pixel>("pixels"));
  RADFARM_TRY(result.counters, file.get_value<Counters>("counters"));
  return result;
}

}  // namespace radfarm
