#include "studio/job_queue.h"

#include "core/error.h"
#include "core/files.h"
#include "studio/api.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

/// Lines of what a child has printed to stderr; a line of progress ends with a carriage return.
std::vector<std::string> PrintedLines(const fs::path& scratch) {
  const fs::path file = scratch / "child.err";
  std::vector<std::string> lines;
  if (!fs::is_regular_file(file)) return lines;
  std::string line;
  for (const char c : ReadFile(file) + "\n") {
    if (c != '\n' && c != '\r') {
      line += c;
    } else if (!line.empty()) {
      lines.push_back(std::exchange(line, {}));
    }
  }
  return lines;
}

constexpr std::string_view kWarning = "warning: ";

}  // namespace

std::string ProgressOf(const fs::path& scratch) {
  std::string last;
  for (std::string& line : PrintedLines(scratch))
    if (line.find(kWarning) == std::string::npos) last = std::move(line);
  return last;
}

std::vector<std::string> WarningsOf(const fs::path& scratch) {
  std::vector<std::string> warnings;
  for (const std::string& line : PrintedLines(scratch))
    if (const size_t place = line.find(kWarning); place != std::string::npos)
      warnings.push_back(line.substr(place + kWarning.size()));
  return warnings;
}

std::vector<std::string> ResultFiles(const fs::path& folder) {
  std::vector<std::string> files;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->path().filename().string().starts_with('.')) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file()) {
      files.push_back(entry->path().lexically_relative(folder).generic_string());
    }
  }
  std::ranges::sort(files);
  return files;
}

JobQueue::JobQueue(fs::path folder) : folder_(std::move(folder)) {
  std::error_code failure;
  fs::remove_all(folder_, failure);  // Results of an earlier start.
  MakeDirectory(folder_);
  worker_ = std::jthread([this](std::stop_token stop) { Run(std::move(stop)); });
}

JobQueue::~JobQueue() {
  const std::scoped_lock lock(mutex_);
  waiting_.clear();
  for (auto& [id, job] : jobs_) job.stop.request_stop();
  worker_.request_stop();
}

std::string JobQueue::Add(NewJob added) {
  const std::scoped_lock lock(mutex_);
  if (waiting_.size() >= kMostWaiting)
    throw UsageError(fmt::format("{} jobs are waiting already. Cancel some, or wait", waiting_.size()));
  const std::string id = fmt::format("j-{:04}", ++num_added_);
  Job& job = jobs_[id];
  job.job = std::move(added);
  job.folder = folder_ / id;
  waiting_.push_back(id);
  kept_.push_back(id);
  DropOld();
  changed_.notify_all();
  return id;
}

void JobQueue::DropOld() {
  while (kept_.size() > kMostKept) {
    const auto oldest = std::ranges::find_if(kept_, [&](const std::string& id) {
      const std::string& state = jobs_.at(id).state;
      return state != "queued" && state != "running";
    });
    if (oldest == kept_.end()) return;
    std::error_code failure;
    fs::remove_all(jobs_.at(*oldest).folder, failure);
    jobs_.erase(*oldest);
    kept_.erase(oldest);
  }
}

void JobQueue::Run(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [&] { return !waiting_.empty(); })) {
    Job& job = jobs_.at(waiting_.front());
    waiting_.pop_front();
    Do(job, lock);
  }
}

void JobQueue::Do(Job& job, std::unique_lock<std::mutex>& lock) {
  job.state = "running";
  job.watch.emplace();
  std::string state = "done", error;
  Json result = Json::object();
  std::vector<std::string> files;
  lock.unlock();
  try {
    MakeDirectory(job.folder / kJobScratch);
    result = job.job.work(job.folder, Task(job.stop.get_token()));
    files = ResultFiles(job.folder);
  } catch (const Cancelled&) {
    state = "cancelled";
  } catch (const std::exception& failure) {
    state = "failed";
    error = WithoutFolder(failure.what(), job.folder);
  }
  lock.lock();
  job.files = std::move(files);
  job.state = std::move(state);
  job.error = std::move(error);
  job.result = std::move(result);
  job.seconds = job.watch->seconds();
}

const JobQueue::Job& JobQueue::Find(std::string_view id) const {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) throw NotFound(fmt::format("there is no job '{}' any more", id.substr(0, 40)));
  return found->second;
}

Json JobQueue::Describe(std::string_view id) const {
  const std::scoped_lock lock(mutex_);
  const Job& job = Find(id);
  Json files = Json::array();
  for (const std::string& name : job.files) {
    std::error_code failure;
    const auto size = fs::file_size(job.folder / name, failure);
    if (!failure) files.push_back({{"name", name}, {"size", size}});
  }
  return {{"id", id},
          {"do", job.job.what},
          {"state", job.state},
          {"seconds", job.state == "running" ? job.watch->seconds() : job.seconds},
          {"progress", job.state == "running" ? ProgressOf(job.folder / kJobScratch) : ""},
          {"command", job.job.command},
          {"note", job.job.note},
          {"error", job.error},
          {"warnings", WarningsOf(job.folder / kJobScratch)},
          {"files", std::move(files)},
          {"result", job.result}};
}

void JobQueue::Cancel(std::string_view id) {
  const std::scoped_lock lock(mutex_);
  Find(id);
  Job& job = jobs_.find(id)->second;
  job.stop.request_stop();
  if (std::erase(waiting_, id) > 0) job.state = "cancelled";
}

fs::path JobQueue::FileOf(std::string_view id, std::string_view name) const {
  const std::scoped_lock lock(mutex_);
  const Job& job = Find(id);
  if (std::ranges::count(job.files, name) == 0)
    throw NotFound(fmt::format("the job {} has no file '{}'", id, name.substr(0, 60)));
  return job.folder / name;
}

}  // namespace daumier::studio
