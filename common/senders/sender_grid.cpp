#include "senders/sender_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/flat_file.h"
#include "senders/paper_vertex.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 6;
constexpr std::uint32_t kPrepassSamples = 2;
constexpr std::uint32_t kReceiversPerCell = 16;
constexpr std::uint32_t kMaxCellsPerAxis = 1024;

/// Every vertex with weight at a visible point that is gathered on the grid.
std::vector<std::uint32_t> touched_vertices(const PerspectiveGrid& grid, const VisiblePoints& seen, const PaperContext* paper) {
  std::vector<bool> touched(grid.vertex_count());
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    if (paper != nullptr && paper->patches.has(seen.reflectors[p])) continue;
    const Interpolation at = interpolate(grid, seen.points[p].position);
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
  float film_aspect, film_height, near, far;
  std::uint32_t columns, rows, slices;
};

Status check(const StoredGrid& g) {
  const auto axis = [](std::uint32_t cells) { return cells >= 1 && cells <= kMaxCellsPerAxis; };
  const bool is_sane = axis(g.columns) && axis(g.rows) && axis(g.slices) && g.near > 0 && g.far > g.near &&
                       std::isfinite(g.far) && g.film_aspect > 0 && std::isfinite(g.film_aspect) &&
                       g.film_height >= 1 && std::isfinite(g.film_height);
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

std::unique_ptr<const PaperContext> paper_context(const World& world, const SenderTree& tree, const PerspectiveGrid& grid,
                                                  const SenderSettings& settings) {
  return settings.gather == Gather::kPaper ? std::make_unique<const PaperContext>(world, tree, grid) : nullptr;
}

VertexSenders classify(const VertexContext& context, std::uint32_t vertex) {
  return context.paper != nullptr ? paper_vertex(context, vertex) : vertex_senders(context, vertex);
}

/// What the slot holds, computed if it is empty; and whether that happened here. Of two threads that fill it, one's result stays.
template <typename Compute>
std::pair<const VertexSenders*, bool> filled(std::atomic<const VertexSenders*>& slot, const Compute& compute) {
  const VertexSenders* known = slot.load(std::memory_order_acquire);
  if (known != nullptr) return {known, false};
  auto mine = std::make_unique<const VertexSenders>(compute());
  if (!slot.compare_exchange_strong(known, mine.get(), std::memory_order_acq_rel)) return {known, false};
  return {mine.release(), true};
}

}  // namespace

ClassifiedView classify_visible(const World& world, const SenderTree& tree, const Camera& camera, int width, int height,
                                const SenderSettings& settings, std::uint64_t seed, const Progress& progress) {
  const ReflectorLookup lookup(world, tree);
  const Prepass film{camera, width, height, kPrepassSamples, seed};
  const VisiblePoints seen = find_visible_points(world, lookup, film, progress);
  ClassifiedView view;
  if (progress.is_cancelled()) return view;
  progress.report("senders");
  view.seen_radiance = mean_reflected(seen);
  SenderGridFile& file = view.file;
  file.grid = fit_grid(camera, width, height, seen.points, settings);
  file.receivers = sort_into_cells(file.grid, seen.points, kReceiversPerCell);
  view.perception = settings.threshold_scale > 0 ? visible_thresholds(world, film, file.grid, seen, settings)
                                                 : even_thresholds(file.grid, settings.threshold);
  file.thresholds = view.perception.values;
  const std::unique_ptr<const PaperContext> paper = paper_context(world, tree, file.grid, settings);
  file.vertices = touched_vertices(file.grid, seen, paper.get());
  file.senders.resize(file.vertices.size());
  const VertexContext context{world, tree, file.grid, file.receivers, file.thresholds, settings, seed, paper.get()};
  parallel_for(progress, "senders", file.vertices.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) file.senders[i] = classify(context, file.vertices[i]);
  });
  return view;
}

std::vector<std::byte> encode(const SenderGridFile& file) {
  std::vector<Lobe> lobes;
  std::vector<CriticalSender> critical;
  std::vector<float> sky;
  std::vector<std::uint32_t> lobe_counts, critical_counts;
  std::vector<SenderClasses> classes;
  for (const VertexSenders& senders : file.senders) {
    lobes.insert(lobes.end(), senders.lobes.begin(), senders.lobes.end());
    critical.insert(critical.end(), senders.critical.begin(), senders.critical.end());
    sky.insert(sky.end(), senders.sky.begin(), senders.sky.end());
    lobe_counts.push_back(static_cast<std::uint32_t>(senders.lobes.size()));
    classes.push_back(senders.classes);
    critical_counts.push_back(static_cast<std::uint32_t>(senders.critical.size()));
  }
  const PerspectiveGrid& g = file.grid;
  FlatFileWriter out("grid", kVersion);
  out.add_value("grid", StoredGrid{g.film_aspect, g.film_height, g.near, g.far, g.columns, g.rows, g.slices});
  out.add("receivers", file.receivers.points);
  out.add("receivers.first", file.receivers.first_of_cell);
  out.add("thresholds", file.thresholds);
  out.add("vertices", file.vertices);
  out.add("lobes", lobes);
  out.add("lobes.count", lobe_counts);
  out.add("critical", critical);
  out.add("critical.count", critical_counts);
  out.add("sky", sky);
  out.add("classes", classes);
  return out.finish();
}

Result<SenderGridFile> decode_sender_grid(std::span<const std::byte> bytes, const Camera& camera,
                                          const SenderTree& tree, std::size_t sky_patches) {
  RADFARM_TRY(const FlatFileReader in, FlatFileReader::open(bytes, "grid", kVersion));
  RADFARM_TRY(const StoredGrid stored, in.get_value<StoredGrid>("grid"));
  RADFARM_TRY_STATUS(check(stored));
  SenderGridFile file;
  file.grid = {camera,     stored.film_aspect, stored.film_height, stored.near,
               stored.far, stored.columns,     stored.rows,        stored.slices};
  RADFARM_TRY(file.receivers.points, in.copy<ReceiverPoint>("receivers"));
  RADFARM_TRY(file.receivers.first_of_cell, in.copy<std::uint32_t>("receivers.first"));
  RADFARM_TRY(file.thresholds, in.copy<float>("thresholds"));
  RADFARM_TRY(file.vertices, in.copy<std::uint32_t>("vertices"));
  RADFARM_TRY(const std::span<const Lobe> lobes, in.get<Lobe>("lobes"));
  RADFARM_TRY(const std::span<const std::uint32_t> lobe_counts, in.get<std::uint32_t>("lobes.count"));
  RADFARM_TRY(const std::span<const CriticalSender> critical, in.get<CriticalSender>("critical"));
  RADFARM_TRY(const std::span<const std::uint32_t> critical_counts, in.get<std::uint32_t>("critical.count"));
  RADFARM_TRY(const std::span<const SenderClasses> classes, in.get<SenderClasses>("classes"));
  const auto& first = file.receivers.first_of_cell;
  const bool cells_fit = first.size() == file.grid.cell_count() + 1 && std::is_sorted(first.begin(), first.end()) &&
                         first.front() == 0 && first.back() == file.receivers.points.size();
  const bool vertices_fit =
      lobe_counts.size() == file.vertices.size() && critical_counts.size() == file.vertices.size() &&
      classes.size() == file.vertices.size() &&
      std::all_of(file.vertices.begin(), file.vertices.end(), [&](auto id) { return id < file.grid.vertex_count(); });
  const bool senders_fit = std::all_of(critical.begin(), critical.end(),
                                       [&](const CriticalSender& s) { return s.node < tree.nodes.size(); });
  const auto is_threshold = [](float t) { return t >= 0 && std::isfinite(t); };
  const bool thresholds_fit = file.thresholds.size() == file.grid.vertex_count() &&
                              std::all_of(file.thresholds.begin(), file.thresholds.end(), is_threshold);
  if (!thresholds_fit) return fail(Code::kDataLoss, "grid: its thresholds are not those of its vertices");
  if (!cells_fit || !vertices_fit || !senders_fit) return fail(Code::kDataLoss, "grid: an index lies outside");
  RADFARM_TRY(auto lobe_lists, cut(lobes, lobe_counts));
  RADFARM_TRY(auto critical_lists, cut(critical, critical_counts));
  RADFARM_TRY(const std::span<const float> sky, in.get<float>("sky"));
  if (sky.size() != file.vertices.size() * sky_patches) return fail(Code::kDataLoss, "grid: not made for this sky");
  for (std::size_t i = 0; i < file.vertices.size(); ++i) {
    const auto seen = sky.subspan(i * sky_patches, sky_patches);
    file.senders.push_back({std::move(lobe_lists[i]), std::move(critical_lists[i]), {seen.begin(), seen.end()}, classes[i]});
  }
  return file;
}

SenderGrid::SenderGrid(SenderGridFile file, const World& world, const SenderTree& tree, const SenderSettings& settings,
                       std::uint64_t seed)
    : grid_(std::move(file.grid)),
      receivers_(std::move(file.receivers)),
      thresholds_(std::move(file.thresholds)),
      paper_(paper_context(world, tree, grid_, settings)),
      context_{world, tree, grid_, receivers_, thresholds_, settings, seed, paper_.get()},
      slots_(grid_.vertex_count()),
      patch_slots_(paper_ != nullptr ? paper_->patches.vertex_count() : 0) {
  for (std::size_t i = 0; i < file.vertices.size(); ++i) {
    slots_[file.vertices[i]] = new VertexSenders(std::move(file.senders[i]));
  }
}

SenderGrid::~SenderGrid() {
  for (const auto& slot : slots_) delete slot.load();
  for (const auto& slot : patch_slots_) delete slot.load();
}

const VertexSenders& SenderGrid::at(std::uint32_t vertex) const {
  const auto [senders, is_new] = filled(slots_[vertex], [&] { return classify(context_, vertex); });
  if (is_new) computed_.fetch_add(1, std::memory_order_relaxed);
  return *senders;
}

const PatchMesh* SenderGrid::patches() const { return paper_ != nullptr ? &paper_->patches : nullptr; }

const VertexSenders& SenderGrid::at_patch_vertex(std::uint32_t vertex) const {
  return *filled(patch_slots_[vertex], [&] { return paper_patch_vertex(context_, vertex); }).first;
}

}  // namespace radfarm
