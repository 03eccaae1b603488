#include "core/num_cores.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

std::string ReadIfThere(const fs::path& path) {
  std::ifstream file(path);  // Not core/files.h: the renderer installs alone with this file.
  std::ostringstream text;
  if (file) text << file.rdbuf();
  return text.str();
}

/// The least limit of the control groups of this process and of those around them, 0 if there is none.
int CoresOfControlGroups() {
  std::vector<int> limits = {CoresOfQuota(ReadIfThere("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") + " " +
                                          ReadIfThere("/sys/fs/cgroup/cpu/cpu.cfs_period_us"))};
  std::istringstream groups(ReadIfThere("/proc/self/cgroup"));
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::/")) continue;  // The line of cgroup version 2: "0::/user.slice/...".
    const fs::path root = "/sys/fs/cgroup";
    for (fs::path group = root / line.substr(4);; group = group.parent_path()) {
      limits.push_back(CoresOfQuota(ReadIfThere(group / "cpu.max")));
      if (group == root || !group.has_relative_path()) break;
    }
  }
  std::erase(limits, 0);
  return limits.empty() ? 0 : *std::min_element(limits.begin(), limits.end());
}

}  // namespace

int CoresOfQuota(std::string_view quota_and_period) {
  std::istringstream text{std::string(quota_and_period)};
  double quota = 0, period = 0;
  if (!(text >> quota >> period) || quota <= 0 || period <= 0) return 0;
  return static_cast<int>(std::ceil(std::min(quota / period, 1e6)));
}

int NumCores() {
  cpu_set_t affinity;
  const int num_allowed = sched_getaffinity(0, sizeof(affinity), &affinity) == 0
                              ? CPU_COUNT(&affinity)
                              : static_cast<int>(std::thread::hardware_concurrency());
  static const int quota = CoresOfControlGroups();  // Some ten files under /proc and /sys.
  return std::max(1, quota > 0 ? std::min(quota, num_allowed) : num_allowed);
}

}  // namespace daumier
