// Runs the tests of one room. A test that logs a warning fails, unless it called AllowWarnings
// (tests/support/warnings.h).
#include "core/log.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

bool warnings_allowed = false;

class WarningsFail : public ::testing::EmptyTestEventListener {
 public:
  void OnTestStart(const ::testing::TestInfo&) override {
    warnings_allowed = false;
    num_before_ = log::NumWarnings();
  }
  void OnTestEnd(const ::testing::TestInfo&) override {
    const int num_warnings = log::NumWarnings() - num_before_;
    if (!warnings_allowed && num_warnings > 0) {
      ADD_FAILURE() << num_warnings << " warning(s) were logged; call AllowWarnings() where they are meant";
    }
  }

 private:
  int num_before_ = 0;
};

}  // namespace

void AllowWarnings() {
  warnings_allowed = true;
}

}  // namespace daumier::testing

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  // Listeners after the default printer are called before it at the end of a test, so that it prints their failures.
  ::testing::UnitTest::GetInstance()->listeners().Append(new daumier::testing::WarningsFail);
  return RUN_ALL_TESTS();
}
