// Rounds of a job, in one process: what goes on gives the bits of what is rendered at once.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "image/digest.h"
#include "pipeline/next_round.h"
#include "pipeline/pipeline.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using Integrator = RenderRequest::Integrator;
using Results = std::vector<std::vector<std::byte>>;

RenderRequest small_request(Integrator integrator) {
  RenderRequest request;
  request.integrator = integrator;
  request.quality = RenderRequest::Quality::kPreview;
  request.width = request.height = 24;
  request.tile = 9;
  if (integrator == Integrator::kPaths) request.photons = 4000;
  return request;
}

class Job {
 public:
  explicit Job(const RenderRequest& request, const std::string& scene = "cornell")
      : files_(*prepare(test::own_scene_path(scene), request)),
        prepared_(*Prepared::open(files_.scene, files_.solution, files_.view)) {}

  /// All tasks of a round; `before`: what those of an earlier one returned.
  Results run(const Round& round, const Results& before = {}) const {
    const std::vector<Task> tasks = *cut_tasks(files_.view, round);
    Results results;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      TaskRound of{round, {}};
      if (i < before.size() && tasks[i].kind != Task::Kind::kAudit) of.before = before[i];
      results.push_back(*run_task(prepared_, tasks[i], of));
    }
    return results;
  }
  Round first() const { return *first_round(files_.view); }
  AssembledRound assemble(const Round& round, const Results& results) const {
    return *assemble_round(files_.view, round, results);
  }
  const Prepared& prepared() const { return prepared_; }

 private:
  PreparedFiles files_;
  Prepared prepared_;
};

class RoundsOf : public testing::TestWithParam<Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, RoundsOf,
                         testing::Values(Integrator::kGather, Integrator::kFullGather, Integrator::kPathTrace,
                                         Integrator::kRadiosity, Integrator::kPaths));

TEST_P(RoundsOf, SumsThatGoOnAreThoseOfARenderThatTookAllAtOnce) {
  const Job job(small_request(GetParam()));
  Round second = job.first(), third = job.first();
  second.number = 1, second.scale = 1.7;
  third.number = 2, third.scale = 4;
  const Results resumed = job.run(third, job.run(second, job.run(job.first()))), once = job.run(third);
  ASSERT_EQ(resumed.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(resumed[i], once[i]) << i;
  EXPECT_NE(job.run(job.first())[0], once[0]);
}

TEST(Rounds, ResumedTilesKeepAovsAndLightGroups) {
  RenderRequest request = small_request(Integrator::kGather);
  request.aov = {"all", "light"};
  const Job job(request);
  Round second = job.first();
  second.number = 1, second.scale = 3;
  EXPECT_EQ(job.run(second, job.run(job.first())), job.run(second));
}

TEST(Rounds, EachAuditHasFreshPixelsAndPaths) {
  const Job job(small_request(Integrator::kPathTrace));
  Round second = job.first();
  second.number = 1;
  const Results one = job.run(job.first()), two = job.run(second, one);
  EXPECT_EQ(one[0], two[0]) << "no more samples: the same tile";
  EXPECT_NE(one.back(), two.back()) << "another audit";
}

TEST(Rounds, NoiseFallsAsThePixelsSay) {
  const Job job(small_request(Integrator::kGather));
  Round second = job.first();
  second.number = 1, second.scale = 8;
  const Results first = job.run(job.first());
  const AssembledRound one = job.assemble(job.first(), first), two = job.assemble(second, job.run(second, first));
  const auto at = [&](double scale) {
    for (const NoiseAt& noise : one.figures().noise) {
      if (noise.scale >= scale * 0.999) return noise;
    }
    return NoiseAt();
  };
  EXPECT_NEAR(two.figures().noise[0].samples, at(8).samples, 0.01 * at(8).samples);
  EXPECT_LT(two.figures().noise[0].noise, one.figures().noise[0].noise);
  // Few pixels, whose noise is itself known from two halves: within a factor of two.
  EXPECT_GT(two.figures().noise[0].noise, 0.5 * at(8).noise);
  EXPECT_LT(two.figures().noise[0].noise, 2 * at(8).noise);
}

TEST(Rounds, ATargetChoosesSettingsThatAreRecorded) {
  RenderRequest request = small_request(Integrator::kGather);
  request.error = 0.1;
  const Job coarse(request);
  request.error = 0.02;
  const Job fine(request);
  const auto resolved = [](const Job& job) {
    const nlohmann::json report = *finish(job.assemble(job.first(), job.run(job.first())), {{}, {0.1, 0}, true, {}, 0}).report;
    return report["settings"]["resolved"];
  };
  const nlohmann::json a = resolved(coarse), b = resolved(fine);
  EXPECT_LT(a["level"], b["level"]);
  EXPECT_GT(a["noise"], b["noise"]);
  EXPECT_NEAR(b["target_error"].get<double>(), 0.02, 1e-9);
  EXPECT_EQ(b["round"]["number"], 0);
}

TEST(Rounds, TheReportTellsOfEachAndOfTheNextHalving) {
  const Job job(small_request(Integrator::kGather));
  const Results results = job.run(job.first());
  AssembledRound round = job.assemble(job.first(), results);
  RoundFigures figures = round.figures();
  figures.light_cpu_seconds = 3, figures.audit_cpu_seconds = 1, figures.prepare_cpu_seconds = 0, figures.wall_seconds = 2;
  RoundFigures more = figures;
  more.kind = RoundFigures::Kind::kMoreSamples;
  more.round.number = 1, more.round.scale = 2;
  const nlohmann::json report = *finish(std::move(round), {{}, {0.05, 0}, false, {figures, more}, 0}).report;
  EXPECT_EQ(report["accuracy"]["target"], 0.05);
  EXPECT_EQ(report["accuracy"]["target_met"], false);
  EXPECT_EQ(report["accuracy"]["audit_cpu_share"], 0.25);
  ASSERT_EQ(report["rounds"].size(), 2U);
  EXPECT_EQ(report["rounds"][0]["kind"], "first");
  EXPECT_EQ(report["rounds"][1]["kind"], "more samples");
  EXPECT_EQ(report["rounds"][1]["settings"], (nlohmann::json{{"scale", 2.0}}));
  EXPECT_EQ(report["rounds"][1]["cpu_s"], 4.0);
  EXPECT_GT(report["next_halving"]["cpu_s"], 0);
}

TEST(Rounds, NonsenseFromTheNetworkIsRefused) {
  const Job job(small_request(Integrator::kPathTrace));
  const Results results = job.run(job.first());
  Round nonsense = job.first();
  nonsense.scale = 0;
  EXPECT_EQ(run_task(job.prepared(), {Task::Kind::kTile, 0}, {nonsense, {}}).error().code, Code::kInvalidArgument);
  EXPECT_EQ(run_task(job.prepared(), {Task::Kind::kTile, 0}, {job.first(), results[1]}).error().code, Code::kDataLoss);
  EXPECT_EQ(run_task(job.prepared(), {Task::Kind::kTile, 0}, {job.first(), results.back()}).error().code, Code::kDataLoss);
}

}  // namespace
}  // namespace radfarm
