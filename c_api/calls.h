#pragma once
#include "c_api/daumier.h"
#include "core/error.h"
#include "geometry/mesh.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>

/// What every function of the C library does: no exception leaves it, and a status that is not DAUMIER_OK has a message.
namespace daumier::c_api {

/// Keeps the message for daumier_last_error(), and returns the status. Never throws.
daumier_status Fail(daumier_status status, const char* message) noexcept;

/// DAUMIER_OK, or what work() throws as a status: UsageError is misuse.
template <class Work>
daumier_status Call(Work&& work) noexcept {
  try {
    std::forward<Work>(work)();
    return DAUMIER_OK;
  } catch (const UsageError& error) {
    return Fail(DAUMIER_MISUSED, error.what());
  } catch (const std::exception& error) {
    return Fail(DAUMIER_FAILED, error.what());
  } catch (...) {
    return Fail(DAUMIER_FAILED, "an unknown error");
  }
}

/// @throws UsageError naming the argument if it is NULL.
template <class T>
T& Given(T* argument, const char* name) {
  if (argument == nullptr) throw UsageError(fmt::format("{} is NULL", name));
  return *argument;
}

/// @throws UsageError naming the buffer unless it is given and has the expected number of elements.
void CheckBuffer(const void* buffer, size_t size, size_t expected, const char* name);

/// The largest coordinate of a face, cm: beyond it no sum of squares is in doubt.
inline constexpr float kMostCm = 1e4f;

/// 3V numbers as V x 3. @throws UsageError as CheckBuffer, or if a number is not finite or beyond kMostCm.
geometry::Points ReadPoints(const float* xyz, size_t size, size_t num_vertices, const char* name);
/// @throws UsageError as CheckBuffer.
void WritePoints(const geometry::Points& points, float* xyz, size_t size, const char* name);
/// @throws UsageError as CheckBuffer.
void WriteTriangles(const geometry::Triangles& triangles, int32_t* corners, size_t size);

}  // namespace daumier::c_api
