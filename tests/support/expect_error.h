#pragma once
#include "core/error.h"

#include <gtest/gtest.h>

#include <string>

namespace daumier::testing {

/// Expects that `action` throws daumier::Error and that its message holds `part`.
template <class Action>
void ExpectError(Action&& action, const std::string& part) {
  try {
    action();
    ADD_FAILURE() << "no Error was thrown; expected one about '" << part << "'";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << "the message is: " << error.what();
  }
}

}  // namespace daumier::testing
