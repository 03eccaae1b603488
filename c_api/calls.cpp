#include "c_api/calls.h"

#include "core/log.h"

namespace daumier::c_api {
namespace {

thread_local std::string last_error;

/// A library writes nothing to the stderr of a program by itself.
[[maybe_unused]] const bool is_silent = [] {
  log::SetLevel(log::Level::kOff);
  return true;
}();

}  // namespace

daumier_status Fail(daumier_status status, const char* message) noexcept {
  try {
    last_error = message;
  } catch (...) {  // No memory for the message.
    last_error.clear();
  }
  return status;
}

void CheckBuffer(const void* buffer, size_t size, size_t expected, const char* name) {
  if (buffer == nullptr && expected > 0) throw UsageError(fmt::format("{} is NULL", name));
  if (size != expected) throw UsageError(fmt::format("{} has {} elements (expected {})", name, size, expected));
}

geometry::Points ReadPoints(const float* xyz, size_t size, size_t num_vertices, const char* name) {
  CheckBuffer(xyz, size, 3 * num_vertices, name);
  geometry::Points points(Eigen::Index(num_vertices), 3);
  for (size_t i = 0; i < size; ++i) {
    if (!(std::abs(xyz[i]) <= kMostCm))
      throw UsageError(fmt::format("{}[{}] is {} (expected {} at most, in cm)", name, i, xyz[i], kMostCm));
    points(Eigen::Index(i / 3), Eigen::Index(i % 3)) = double(xyz[i]);
  }
  return points;
}

void WritePoints(const geometry::Points& points, float* xyz, size_t size, const char* name) {
  CheckBuffer(xyz, size, 3 * size_t(points.rows()), name);
  for (size_t i = 0; i < size; ++i) xyz[i] = float(points(Eigen::Index(i / 3), Eigen::Index(i % 3)));
}

void WriteTriangles(const geometry::Triangles& triangles, int32_t* corners, size_t size) {
  CheckBuffer(corners, size, 3 * size_t(triangles.rows()), "corners");
  for (size_t i = 0; i < size; ++i) corners[i] = int32_t(triangles(Eigen::Index(i / 3), Eigen::Index(i % 3)));
}

}  // namespace daumier::c_api

using namespace daumier;
using namespace daumier::c_api;

const char* daumier_version(void) {
  return DAUMIER_VERSION;
}

const char* daumier_last_error(void) {
  return last_error.c_str();
}

daumier_status daumier_set_log_level(daumier_log_level level) {
  return Call([&] {
    switch (level) {
      case DAUMIER_LOG_INFO:
        return log::SetLevel(log::Level::kInfo);
      case DAUMIER_LOG_WARNING:
        return log::SetLevel(log::Level::kWarning);
      case DAUMIER_LOG_OFF:
        return log::SetLevel(log::Level::kOff);
    }
    throw UsageError(fmt::format("the log level {} does not exist", int(level)));
  });
}
