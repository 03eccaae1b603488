#pragma once
#include <string_view>

namespace daumier {

/// Cores that this process may use: its CPU affinity, cut by the CPU quotas of its control groups as they were at
/// the first call. At least 1.
int NumCores();

/// The cores that a cgroup quota allows, rounded up: "200000 100000" (quota and period, in microseconds) is 2. 0 if it
/// contains "max", a quota of -1, or nothing readable: no limit.
int CoresOfQuota(std::string_view quota_and_period);

}  // namespace daumier
