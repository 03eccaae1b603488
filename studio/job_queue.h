#pragma once
#include "core/json.h"
#include "core/stopwatch.h"
#include "core/task.h"

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace daumier::studio {

/// What a job does in its folder. Returns facts for the page; what it throws is the job's error.
using JobWork = std::function<Json(const std::filesystem::path& folder, const Task& task)>;

struct NewJob {
  std::string what;       ///< "avatar"
  std::string command;    ///< What a person types for the same; may be empty.
  std::string note = {};  ///< What the command does not do, or why there is none; may be empty.
  JobWork work;
};

/// Jobs one after the other, on a thread of their own, each in a folder j-NNNN below `folder`, which is emptied first: results are
/// there until kMostKept later jobs have been added, or the program ends. Thread-safe.
class JobQueue {
 public:
  static constexpr size_t kMostKept = 24, kMostWaiting = 16;

  explicit JobQueue(std::filesystem::path folder);
  /// Cancels what runs, and waits for it.
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// Returns the id. @throws UsageError if kMostWaiting jobs wait.
  std::string Add(NewJob job);
  /// {id, do, state: queued, running, done, failed or cancelled, seconds, progress, command, note, error, warnings, files: [{name, size}, ...], result}.
  /// @throws NotFound.
  Json Describe(std::string_view id) const;
  /// Its state becomes cancelled at once if it waits, else when it has ended. @throws NotFound.
  void Cancel(std::string_view id);
  /// A file of a job that is done. @throws NotFound.
  std::filesystem::path FileOf(std::string_view id, std::string_view name) const;

 private:
  struct Job {
    NewJob job;
    std::string state = "queued", error;
    std::filesystem::path folder;
    std::stop_source stop;
    std::optional<Stopwatch> watch = {};  ///< Since it began.
    double seconds = 0;
    Json result = Json::object();
    std::vector<std::string> files = {};
  };
  void Run(std::stop_token stop);
  void Do(Job& job, std::unique_lock<std::mutex>& lock);
  const Job& Find(std::string_view id) const;
  void DropOld();

  const std::filesystem::path folder_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::map<std::string, Job, std::less<>> jobs_;
  std::deque<std::string> waiting_, kept_;
  int num_added_ = 0;
  std::jthread worker_;  ///< The last member: it uses all others.
};

/// In a job's folder: what a child of it prints (core/child_process.h).
inline constexpr const char* kJobScratch = ".child";

/// Files of a job's folder that are its results: those without a name that begins with a dot, their own or a folder's.
std::vector<std::string> ResultFiles(const std::filesystem::path& folder);

/// The last line of progress that a child has printed into `scratch` (core/child_process.h); empty without one.
std::string ProgressOf(const std::filesystem::path& scratch);
/// Its warnings, a sentence each.
std::vector<std::string> WarningsOf(const std::filesystem::path& scratch);

}  // namespace daumier::studio
