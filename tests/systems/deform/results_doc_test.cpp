#include "systems/deform/metrics.h"
#include "tests/support/ablation_records.h"

namespace daumier::deform {
namespace {

TEST(ResultsDocument, ShowsTheAblationsOfDeformableModels) {
  testing::ExpectAblationsInResults("configs/deform/", DeformSummaryColumns());
}

}  // namespace
}  // namespace daumier::deform
