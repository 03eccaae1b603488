#pragma once

namespace daumier::testing {

/// The test that calls this logs warnings on purpose; every other one fails by a logged warning.
void AllowWarnings();

}  // namespace daumier::testing
