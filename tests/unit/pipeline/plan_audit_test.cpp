#include "pipeline/plan_audit.h"

#include <cmath>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

AuditNeeds needs(double most_error, double most_paths) { return {2e-4, 5, 0.5, most_error, most_paths, 1U << 18U}; }

TEST(PlanAudit, IsTheCheapestThatDoes) {
  const AuditPlan plan = plan_audit(needs(7e-5, 1e9));
  EXPECT_LE(plan.error, 7.1e-5);
  const AuditPlan better = plan_audit(needs(3.5e-5, 1e9));
  EXPECT_LE(better.error, 3.6e-5);
  EXPECT_GT(better.paths(), 2 * plan.paths());
  // What it states follows from its counts: the choice of pixels and the paths of each.
  EXPECT_NEAR(plan.error, std::sqrt((std::pow(5 * 2e-4, 2) + std::pow(0.5 / plan.samples, 2)) / plan.pixels), 1e-12);
}

TEST(PlanAudit, KeepsToWhatItMayCost) {
  const AuditPlan plan = plan_audit(needs(1e-6, 1e5));
  EXPECT_LE(plan.paths(), 1e5);
  EXPECT_GT(plan.error, 1e-6);
}

TEST(PlanAudit, ASmallImageHasFewPixels) {
  AuditNeeds small = needs(1e-6, 1e5);
  small.all_pixels = 100;
  EXPECT_EQ(plan_audit(small).pixels, 100U);
}

TEST(PlanAudit, IsNeverLessThanWhatIsOfUse) {
  const AuditPlan plan = plan_audit(needs(7e-5, 1));
  EXPECT_GE(plan.pixels, 512U);
  EXPECT_GE(plan.samples, 16U);
}

}  // namespace
}  // namespace radfarm
