#include "estimate/photon_result.h"

#include "base/flat_file.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 1;

}  // namespace

void add(const PhotonResult& more, PhotonResult& sum) {
  sum.paths += more.paths;
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
    sum.pixels[i].direct += more.pixels[i].direct;
    sum.pixels[i].indirect += more.pixels[i].indirect;
    sum.pixels[i].specular += more.pixels[i].specular;
  }
}

std::vector<std::byte> encode(const PhotonResult& result) {
  FlatFileWriter file("photons", kVersion);
  file.add_value("paths", result.paths);
  file.add("pixels", result.pixels);
  return file.finish();
}

Result<PhotonResult> decode_photon_result(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "photons", kVersion));
  PhotonResult result;
  RADFARM_TRY(result.paths, file.get_value<std::uint64_t>("paths"));
  RADFARM_TRY(result.pixels, file.copy<PhotonPixel>("pixels"));
  return result;
}

}  // namespace radfarm
