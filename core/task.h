#pragma once
#include "core/error.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

namespace daumier {

/// `done` of `total` units of a stage. The views are valid during the callback only.
struct TaskProgress {
  std::string_view stage;  ///< "sketches"; empty if the task has no stage.
  int64_t done, total;
  std::string_view unit;  ///< What is counted, the plural: "faces".
  std::string_view note;  ///< "loss 0.5"; may be empty.
};

/// Receives reports in the thread that makes them, from several threads at once if the task is shared between threads.
using ProgressCallback = std::function<void(const TaskProgress&)>;

/// The error of a cancelled task. What is finished stays on disk.
class Cancelled : public Error {
 public:
  using Error::Error;
};

/// Cancellation and progress of a long function, its last argument: `const Task& task = {}`. A default Task is never
/// cancelled and silent. Cheap to copy; copies share the stop state and the callback. All members are thread-safe.
struct Task {
  std::stop_token stop;
  std::shared_ptr<const ProgressCallback> progress;  ///< Null: silent.
  std::string stage;                                 ///< Of reports.

  Task() = default;
  explicit Task(std::stop_token stop_token, ProgressCallback callback = nullptr)
      : stop(std::move(stop_token)),
        progress(callback ? std::make_shared<const ProgressCallback>(std::move(callback)) : nullptr) {}

  /// The same task whose reports have this stage.
  Task Stage(std::string name) const {
    Task task = *this;
    task.stage = std::move(name);
    return task;
  }

  bool cancelled() const { return stop.stop_requested(); }

  /// The message states what is finished and how to resume; it is formatted only if the task is cancelled:
  ///   task.ThrowIfCancelled("{}: stopped after {} shards; the same command resumes", folder, num_done);
  /// @throws Cancelled if the task is cancelled.
  template <class... Args>
  void ThrowIfCancelled(fmt::format_string<Args...> message, Args&&... args) const {
    if (cancelled()) throw Cancelled(fmt::format(message, std::forward<Args>(args)...));
  }

  /// Calls the callback, once a call. Counts of a stage begin before its first unit, at 0 or at what an earlier
  /// session has finished, and do not fall.
  void Report(int64_t done, int64_t total, std::string_view unit, std::string_view note = "") const {
    if (progress) (*progress)({stage, done, total, unit, note});
  }
};

}  // namespace daumier
