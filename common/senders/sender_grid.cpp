#include "senders/sender_grid.h"

#include <algorithm>
#include <cmath>

#include "base/flat_file.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 3;
constexpr std::uint32_t kPrepassSamples = 2;
constexpr std::uint32_t kReceiversPerCell = 16;
constexpr std::uint32_t kMaxCellsPerAxis = 1024;

/// Every vertex with weight at a visible point.
std::vector<std::uint32_t> touched_vertices(const PerspectiveGrid& grid, const std::vector<ReceiverPoint>& points) {
  std::vector<bool> touched(grid.vertex_count());
  for (const ReceiverPoint& point : points) {
    const Interpolation at = interpolate(grid, point.position);
    for (std::size_t i = 0; i < 4; ++i) {
      if (at.weights[i] > 0) touched[at.vertices[i]] = true;
    }
  }
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t id = 0; id < touched.size(); ++id) {
    if (touched[id]) vertices.push_back(id);
  }
  return vertices;
}

/// A grid without its camera: a fixed layout.
struct StoredGrid {
  float film_aspect, near, far;
  std::uint32_t columns, rows, slices;
};

Status check(const StoredGrid& g) {
  const auto axis = [](std::uint32_t cells) { return cells >= 1 && cells <= kMaxCellsPerAxis; };
  const bool is_sane = axis(g.columns) && axis(g.rows) && axis(g.slices) && g.near > 0 && g.far > g.near &&
                       std::isfinite(g.far) && g.film_aspect > 0 && std::isfinite(g.film_aspect);
  if (!is_sane) return fail(Code::kDataLoss, "grid: its shape is out of range");
  return {};
}

/// Cuts a flat array into the pieces that `counts` gives; DATA_LOSS when they do not add up.
template <typename T>
Result<std::vector<std::vector<T>>> cut(std::span<const T> all, std::span<const std::uint32_t> counts) {
  std::vector<std::vector<T>> pieces;
  for (const std::uint32_t count : counts) {
    if (count > all.size()) return fail(Code::kDataLoss, "grid: a list is cut off");
    pieces.emplace_back(all.begin(), all.begin() + count);
    all = all.subspan(count);
  }
  if (!all.empty()) return fail(Code::kDataLoss, "grid: lists are left over");
  return pieces;
}

}  // namespace

SenderGridFile classify_visible(const World& world, const SenderTree& tree, const Camera& camera, int width, int height,
                                const SenderSettings& settings, std::uint64_t seed, const Progress& progress) {
  progress.report("senders");
  const std::vector<ReceiverPoint> points = find_visible_points(world, camera, width, height, kPrepassSamples, seed);
  SenderGridFile file;
  file.grid = fit_grid(camera, width, height, points, settings);
  file.receivers = sort_into_cells(file.grid, points, kReceiversPerCell);
  file.vertices = touched_vertices(file.grid, points);
  file.senders.resize(file.vertices.size());
  const VertexContext context{world, tree, file.grid, file.receivers, settings, seed};
  parallel_for(progress, "senders", file.vertices.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) file.senders[i] = vertex_senders(context, file.vertices[i]);
  });
  return file;
}

std::vector<std::byte> encode(const SenderGridFile& file) {
  std::vector<Lobe> lobes;
  std::vector<CriticalSender> critical;
  std::vector<float> sky;
  std::vector<std::uint32_t> lobe_counts, critical_counts;
  for (const VertexSenders& senders : file.senders) {
    lobes.insert(lobes.end(), senders.lobes.begin(), senders.lobes.end());
    critical.insert(critical.end(), senders.critical.begin(), senders.critical.end());
    sky.insert(sky.end(), senders.sky.begin(), senders.sky.end());
    lobe_counts.push_back(static_cast<std::uint32_t>(senders.lobes.size()));
    critical_counts.push_back(static_cast<std::uint32_t>(senders.critical.size()));
  }
  const PerspectiveGrid& g = file.grid;
  FlatFileWriter out("grid", kVersion);
  out.add_value("grid", StoredGrid{g.film_aspect, g.near, g.far, g.columns, g.rows, g.slices});
  out.add("receivers", file.receivers.points);
  out.add("receivers.first", file.receivers.first_of_cell);
  out.add("vertices", file.vertices);
  out.add("lobes", lobes);
  out.add("lobes.count", lobe_counts);
  out.add("critical", critical);
  out.add("critical.count", critical_counts);
  out.add("sky", sky);
  return out.finish();
}

Result<SenderGridFile> decode_sender_grid(std::span<const std::byte> bytes, const Camera& camera,
                                          const SenderTree& tree, std::size_t sky_patches) {
  RADFARM_TRY(const FlatFileReader in, FlatFileReader::open(bytes, "grid", kVersion));
  RADFARM_TRY(const StoredGrid stored, in.get_value<StoredGrid>("grid"));
  RADFARM_TRY_STATUS(check(stored));
  SenderGridFile file;
  file.grid = {camera, stored.film_aspect, stored.near, stored.far, stored.columns, stored.rows, stored.slices};
  RADFARM_TRY(file.receivers.points, in.copy<ReceiverPoint>("receivers"));
  RADFARM_TRY(file.receivers.first_of_cell, in.copy<std::uint32_t>("receivers.first"));
  RADFARM_TRY(file.vertices, in.copy<std::uint32_t>("vertices"));
  RADFARM_TRY(const std::span<const Lobe> lobes, in.get<Lobe>("lobes"));
  RADFARM_TRY(const std::span<const std::uint32_t> lobe_counts, in.get<std::uint32_t>("lobes.count"));
  RADFARM_TRY(const std::span<const CriticalSender> critical, in.get<CriticalSender>("critical"));
  RADFARM_TRY(const std::span<const std::uint32_t> critical_counts, in.get<std::uint32_t>("critical.count"));
  const auto& first = file.receivers.first_of_cell;
  const bool cells_fit = first.size() == file.grid.cell_count() + 1 && std::is_sorted(first.begin(), first.end()) &&
                         first.front() == 0 && first.back() == file.receivers.points.size();
  const bool vertices_fit =
      lobe_counts.size() == file.vertices.size() && critical_counts.size() == file.vertices.size() &&
      std::all_of(file.vertices.begin(), file.vertices.end(), [&](auto id) { return id < file.grid.vertex_count(); });
  const bool senders_fit = std::all_of(critical.begin(), critical.end(),
                                       [&](const CriticalSender& s) { return s.node < tree.nodes.size(); });
  if (!cells_fit || !vertices_fit || !senders_fit) return fail(Code::kDataLoss, "grid: an index lies outside");
  RADFARM_TRY(auto lobe_lists, cut(lobes, lobe_counts));
  RADFARM_TRY(auto critical_lists, cut(critical, critical_counts));
  RADFARM_TRY(const std::span<const float> sky, in.get<float>("sky"));
  if (sky.size() != file.vertices.size() * sky_patches) return fail(Code::kDataLoss, "grid: not made for this sky");
  for (std::size_t i = 0; i < file.vertices.size(); ++i) {
    const auto seen = sky.subspan(i * sky_patches, sky_patches);
    file.senders.push_back({std::move(lobe_lists[i]), std::move(critical_lists[i]), {seen.begin(), seen.end()}});
  }
  return file;
}

SenderGrid::SenderGrid(SenderGridFile file, const World& world, const SenderTree& tree, const SenderSettings& settings,
                       std::uint64_t seed)
    : grid_(std::move(file.grid)),
      receivers_(std::move(file.receivers)),
      context_{world, tree, grid_, receivers_, settings, seed},
      slots_(grid_.vertex_count()) {
  for (std::size_t i = 0; i < file.vertices.size(); ++i) {
    slots_[file.vertices[i]] = new VertexSenders(std::move(file.senders[i]));
  }
}

SenderGrid::~SenderGrid() {
  for (const auto& slot : slots_) delete slot.load();
}

const VertexSenders& SenderGrid::at(std::uint32_t vertex) const {
  const VertexSenders* known = slots_[vertex].load(std::memory_order_acquire);
  if (known != nullptr) return *known;
  auto mine = std::make_unique<const VertexSenders>(vertex_senders(context_, vertex));
  if (!slots_[vertex].compare_exchange_strong(known, mine.get(), std::memory_order_acq_rel)) return *known;
  computed_.fetch_add(1, std::memory_order_relaxed);
  return *mine.release();
}

}  // namespace radfarm
