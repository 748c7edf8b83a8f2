#include "cli/ladder_rungs.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

namespace radfarm::cli {
namespace {

constexpr std::uint64_t kReferenceSeed = 0x7265666572;  // "refer": of no rung

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    items.push_back(list.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return items;
}

/// The base with one integrator and quality, as a request's JSON names them.
Result<RenderRequest> with(const RenderRequest& base, const std::string& integrator, const std::string& quality) {
  nlohmann::json json = to_json(base);
  json["integrator"] = integrator;
  json["quality"] = quality;
  json["audit"] = false;
  RADFARM_TRY(const RenderRequest request, render_request_from_json(json));
  RADFARM_TRY_STATUS(validate(request));
  return request;
}

}  // namespace

Result<std::vector<Rung>> make_rungs(const RenderRequest& base, const std::string& integrators, const std::string& qualities) {
  std::vector<Rung> rungs;
  for (const std::string& integrator : split(integrators)) {
    for (const std::string& quality : split(qualities)) {
      Result<RenderRequest> request = with(base, integrator, quality);
      if (!request) return annotate(request.error(), "rung " + integrator + "-" + quality);
      rungs.push_back({integrator + "-" + quality, integrator, std::move(*request)});
    }
  }
  return rungs;
}

RenderRequest reference_half(const RenderRequest& base, int samples, int half) {
  RenderRequest request = base;
  request.integrator = RenderRequest::Integrator::kPathTrace;
  request.samples = samples;
  request.audit = false;
  request.seed = base.seed ^ (kReferenceSeed + static_cast<std::uint64_t>(half));
  return request;
}

}  // namespace radfarm::cli
