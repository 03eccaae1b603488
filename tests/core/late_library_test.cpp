#include "core/late_library.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

TEST(LateLibrary, AFunctionOfALibraryCanBeCalled) {
  const LateLibrary mathematics("libm.so.6", "computes");
  double (*const square_root)(double) = mathematics["sqrt"];
  EXPECT_EQ(square_root(9.0), 3.0);
}

TEST(LateLibrary, WhatIsMissingIsNamedWithTheRepair) {
  testing::ExpectError([] { LateLibrary("libnone.so.1", "reads none"); },
                       "libnone.so.1 cannot be loaded, which reads none (");
  const LateLibrary mathematics("libm.so.6", "computes");
  testing::ExpectError([&] { mathematics["no_such"]; },
                       "libm.so.6 has no no_such. Install the version that Daumier was built with");
}

}  // namespace
}  // namespace daumier
