#include "frame/tasks.h"

#include <set>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

Settings of_size(int width, int height, int tile, std::uint32_t audited = 0) {
  Settings settings;
  settings.width = width, settings.height = height, settings.tile = tile;
  settings.audit_pixels = audited;
  return settings;
}

TEST(CutTasks, CutsEachImageIntoTheSameTilesAndAuditsOnce) {
  const Settings settings = of_size(100, 60, 16, 500);
  const std::vector<Task> one = cut_tasks(settings, first_round(settings)), three = cut_tasks(settings, first_round(settings), 3);
  const std::size_t tiles = tile_count(settings);
  EXPECT_EQ(three.size() - one.size(), 2 * tiles);
  EXPECT_EQ(three[2 * tiles], (Task{Task::Kind::kTile, static_cast<std::uint32_t>(2 * tiles)}));
  for (std::size_t i = tiles; i < one.size(); ++i) EXPECT_EQ(three[i + 2 * tiles], one[i]);
}

TEST(Tasks, TilesCoverEveryPixelOnce) {
  for (const Settings& settings : {of_size(1, 1, 32), of_size(33, 17, 8), of_size(64, 64, 64), of_size(7, 101, 10),
                                   of_size(40, 3, 1), of_size(31, 31, 32), of_size(97, 89, 13)}) {
    std::vector<int> covered(static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height));
    for (const Task& task : cut_tasks(settings, first_round(settings))) {
      ASSERT_EQ(task.kind, Task::Kind::kTile);
      const PixelRect rect = tile_rect(settings, task.index);
      EXPECT_TRUE(rect.x0 >= 0 && rect.x0 < rect.x1 && rect.x1 <= settings.width);
      EXPECT_TRUE(rect.y0 >= 0 && rect.y0 < rect.y1 && rect.y1 <= settings.height);
      EXPECT_TRUE(rect.width() <= settings.tile && rect.height() <= settings.tile);
      for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) ++covered[static_cast<std::size_t>(y * settings.width + x)];
      }
    }
    EXPECT_EQ(covered, std::vector<int>(covered.size(), 1));
  }
}

TEST(Tasks, ComeTilesFirstEachOnce) {
  const Settings settings = of_size(100, 60, 16, 500);
  const std::vector<Task> tasks = cut_tasks(settings, first_round(settings));
  std::set<std::pair<int, std::uint32_t>> seen;
  bool is_audit = false;
  for (const Task& task : tasks) {
    is_audit = is_audit || task.kind == Task::Kind::kAudit;
    EXPECT_EQ(task.kind == Task::Kind::kAudit, is_audit);
    EXPECT_TRUE(seen.insert({static_cast<int>(task.kind), task.index}).second);
  }
  EXPECT_TRUE(is_audit);
}

TEST(Tasks, AuditTasksHaveTheChosenPixelsInOrder) {
  for (const Settings& settings : {of_size(100, 60, 16, 500), of_size(5, 3, 4, 1000), of_size(64, 64, 8, 1)}) {
    const std::vector<AuditPixel> chosen =
        choose_audit_pixels(settings.width, settings.height, settings.audit_pixels, settings.seed);
    std::size_t next = 0;
    double weight = 0;
    for (const Task& task : cut_tasks(settings, first_round(settings))) {
      if (task.kind != Task::Kind::kAudit) continue;
      const std::vector<AuditPixel> pixels = audit_task_pixels(settings, first_round(settings), task.index);
      EXPECT_FALSE(pixels.empty());
      for (const AuditPixel& pixel : pixels) {
        ASSERT_LT(next, chosen.size());
        EXPECT_TRUE(pixel.x == chosen[next].x && pixel.y == chosen[next].y);
        EXPECT_TRUE(pixel.x >= 0 && pixel.x < settings.width && pixel.y >= 0 && pixel.y < settings.height);
        weight += pixel.weight;
        ++next;
      }
    }
    EXPECT_EQ(next, chosen.size());
    EXPECT_NEAR(weight, 1, 1e-12);
  }
}

}  // namespace
}  // namespace radfarm
