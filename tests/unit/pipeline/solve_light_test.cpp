// One solution serves every camera and job; what waits for a preparation hears of it and can end it.
#include <array>
#include <filesystem>
#include <mutex>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "frame/view.h"
#include "image/digest.h"
#include "pipeline/pipeline.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using nlohmann::json;

RenderRequest small_request() {
  RenderRequest request;
  request.quality = RenderRequest::Quality::kPreview;
  request.width = request.height = 16;
  request.samples = 1;
  request.audit = false;
  return request;
}

std::string image_of(const PreparedFiles& files) {
  const Result<Prepared> prepared = Prepared::open(files.scene, files.solution, files.view);
  EXPECT_TRUE(prepared);
  std::vector<std::vector<std::byte>> results;
  const std::vector<Task> tasks = *cut_tasks(files.view);
  for (const Task& task : tasks) results.push_back(*run_task(*prepared, task));
  return image_digest(finish(files.view, results, {})->image);
}

class ReuseTest : public testing::Test {
 protected:
  PreparedFiles prepared(const RenderRequest& request, const std::string& scene = "cornell") const {
    PrepareContext context;
    context.solutions = SolutionStore(folder_.path(), 1U << 30U);
    Result<PreparedFiles> files = prepare(test::own_scene_path(scene), request, context);
    EXPECT_TRUE(files) << files.error().message;
    return std::move(*files);
  }
  static json facts(const PreparedFiles& files) { return json::parse(decode_views(files.view)->at(0).facts); }
  bool is_reused(const RenderRequest& request) const { return facts(prepared(request))["solution"]["reused"]; }

  TemporaryDirectory folder_ = *TemporaryDirectory::create("radfarm-reuse");
};

TEST_F(ReuseTest, ASecondJobHasTheSameImageAndSaysThatItSolvedNothing) {
  const PreparedFiles first = prepared(small_request()), second = prepared(small_request());
  EXPECT_EQ(first.solution, second.solution);
  EXPECT_EQ(image_of(first), image_of(second));
  EXPECT_EQ(image_of(first), image_of(*prepare(test::own_scene_path("cornell"), small_request())));
  json a = facts(first), b = facts(second);
  EXPECT_FALSE(a["solution"]["reused"]);
  EXPECT_TRUE(b["solution"]["reused"]);
  for (json* said : {&a, &b}) {
    (*said)["solution"].erase("reused");
    said->erase("stages");
    said->erase("expected");  // in seconds
    said->erase("peak_memory_bytes");
  }
  EXPECT_EQ(a, b) << "counts, energy and digest are reported all the same";
}

TEST_F(ReuseTest, OtherViewsOfTheSceneUseIt) {
  (void)prepared(small_request());
  RenderRequest other = small_request();
  RenderRequest::PlacedCamera camera;
  camera.eye = {0.1, 0.2, 0.9};
  camera.look_at = {0, 0, 0};
  other.camera = camera;
  EXPECT_TRUE(is_reused(other)) << "camera";
  other.width = 20;
  EXPECT_TRUE(is_reused(other)) << "size";
  other.samples = 3;
  EXPECT_TRUE(is_reused(other)) << "samples";
  other.audit = true;
  EXPECT_TRUE(is_reused(other)) << "audit";
  other.tile = 8;
  EXPECT_TRUE(is_reused(other)) << "tile";
  other.threshold = 0.1F;
  EXPECT_TRUE(is_reused(other)) << "threshold";
}

TEST_F(ReuseTest, WhereAllThatReflectsIsASenderOneSolutionServesTheFullAndThePapersGather) {
  (void)prepared(small_request());
  RenderRequest other = small_request();
  other.integrator = RenderRequest::Integrator::kFullGather;
  EXPECT_FALSE(is_reused(other));
  EXPECT_TRUE(is_reused(other)) << "again";
  other.integrator = RenderRequest::Integrator::kGather;
  other.gather = Gather::kPaper;
  EXPECT_TRUE(is_reused(other)) << "paper";
}

TEST_F(ReuseTest, OtherLightOrAccuracyIsSolvedAnew) {
  (void)prepared(small_request());
  RenderRequest other = small_request();
  other.seed = 2;
  EXPECT_FALSE(is_reused(other)) << "seed";
  other = small_request();
  other.quality = RenderRequest::Quality::kStandard;
  EXPECT_FALSE(is_reused(other)) << "quality";
  other = small_request();
  other.effects = "-interreflection";
  EXPECT_FALSE(is_reused(other)) << "interreflection";
  EXPECT_TRUE(facts(prepared(other))["energy"]["absorbed"].is_null()) << "reused, and still nothing was solved";
  const auto reused_with_sky = [&](const std::string& sky) {
    RenderRequest request = small_request();
    request.env = sky;
    return facts(prepared(request, "effects/open_plane_sky"))["solution"]["reused"].get<bool>();
  };
  EXPECT_FALSE(reused_with_sky("sky:overcast,lux=50"));
  EXPECT_TRUE(reused_with_sky("sky:overcast,lux=50"));
  EXPECT_FALSE(reused_with_sky("sky:overcast,lux=60"));
}

TEST_F(ReuseTest, ADamagedEntryIsSolvedAgainAndReplaced) {
  (void)prepared(small_request());
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
  }
  EXPECT_FALSE(is_reused(small_request()));
  EXPECT_TRUE(is_reused(small_request()));
}

/// A context that notes the phases it hears of and cancels at the first report of one of them.
struct Listener {
  explicit Listener(std::string cancel_in = "") : cancel_at(std::move(cancel_in)) {}
  PrepareContext context() {
    const auto hear = [this](std::string_view phase, std::uint64_t, std::uint64_t) {
      const std::lock_guard lock(mutex);
      heard.insert(std::string(phase));
      if (phase == cancel_at) stop.request_stop();
    };
    return {SolutionStore(), Progress(hear, stop.get_token())};
  }
  std::string cancel_at;
  std::mutex mutex;
  std::set<std::string> heard;
  std::stop_source stop;
};

constexpr std::array kPhases = {"load", "load: light", "acceleration", "effects", "effects: materials", "effects: pilot",
                                "effects: trapped light", "radiosity", "radiosity: reach", "radiosity: patches",
                                "radiosity: clusters",
                                "radiosity: links", "radiosity: direct light", "radiosity: solving", "radiosity: measuring links",
                                "radiosity: light paths", "senders: visible points", "senders"};

TEST(PrepareProgress, TellsEveryPhase) {
  Listener listener;
  ASSERT_TRUE(prepare(test::own_scene_path("cornell"), small_request(), listener.context()));
  for (const char* phase : kPhases) {
    EXPECT_TRUE(listener.heard.contains(phase)) << phase;
  }
}

TEST(PrepareProgress, ACancelInAnyPhaseEndsItThereAndKeepsNothing) {
  const auto folder = TemporaryDirectory::create("radfarm-cancel");
  for (const char* phase : kPhases) {
    Listener listener(phase);
    PrepareContext context = listener.context();
    if (!std::string_view(phase).starts_with("senders")) context.solutions = SolutionStore(folder->path(), 1U << 30U);
    const Result<PreparedFiles> files = prepare(test::own_scene_path("cornell"), small_request(), context);
    ASSERT_FALSE(files) << phase;
    EXPECT_EQ(files.error().code, Code::kCancelled) << phase;
    EXPECT_TRUE(listener.heard.contains("senders") == (std::string_view(phase) == "senders")) << phase;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder->path()));
}

TEST(PrepareProgress, ACancelAmongTheElementsKeepsNothing) {
  const auto folder = TemporaryDirectory::create("radfarm-cancel");
  RenderRequest request = small_request();
  request.integrator = RenderRequest::Integrator::kRadiosity;
  for (const char* phase : {"radiosity: elements", "radiosity: element mesh"}) {
    Listener listener(phase);
    PrepareContext context = listener.context();
    context.solutions = SolutionStore(folder->path(), 1U << 30U);
    const Result<PreparedFiles> files = prepare(test::own_scene_path("cornell"), request, context);
    ASSERT_FALSE(files) << phase;
    EXPECT_EQ(files.error().code, Code::kCancelled) << phase;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder->path()));
}

}  // namespace
}  // namespace radfarm
