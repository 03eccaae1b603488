#include "studio/job_queue.h"

#include "core/error.h"
#include "core/files.h"
#include "studio/api.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <latch>
#include <thread>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using namespace std::chrono_literals;

/// The job when it has ended.
Json EndedJob(const JobQueue& queue, const std::string& id) {
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < deadline) {
    Json job = queue.Describe(id);
    if (job["state"] != "queued" && job["state"] != "running") return job;
    std::this_thread::sleep_for(1ms);
  }
  ADD_FAILURE() << id << " has not ended";
  return queue.Describe(id);
}

NewJob JobOf(JobWork work) {
  return {.what = "test", .command = "daumier test", .work = std::move(work)};
}

NewJob EmptyJob() {
  return JobOf([](const fs::path&, const Task&) { return Json::object(); });
}

/// A job that runs until it is cancelled, or let go.
class HeldJob {
 public:
  ~HeldJob() { is_free_ = true; }
  NewJob job() {
    return JobOf([this](const fs::path&, const Task& task) {
      has_begun_ = true;
      while (!is_free_) {
        task.ThrowIfCancelled("stopped");
        std::this_thread::sleep_for(1ms);
      }
      return Json::object();
    });
  }
  void WaitUntilItRuns() const {
    while (!has_begun_) std::this_thread::sleep_for(1ms);
  }
  void LetGo() { is_free_ = true; }

 private:
  std::atomic<bool> has_begun_ = false, is_free_ = false;
};

TEST(JobQueue, ADoneJobHasItsResultAndFiles) {
  const testing::TempDir folder;
  JobQueue queue(folder / "jobs");
  const std::string id = queue.Add(JobOf([](const fs::path& place, const Task&) {
    MakeDirectory(place / "stages");
    MakeDirectory(place / ".cache");
    WriteFileAtomically(place / "stages" / "01.png", "picture");
    WriteFileAtomically(place / "head.glb", "head!");
    WriteFileAtomically(place / ".hidden", "no result");
    WriteFileAtomically(place / ".cache" / "head.glb", "no result");
    WriteFileAtomically(place / kJobScratch / "child.err", "11:19 warning: the neck is short\n");
    return Json{{"vertices", 3}};
  }));
  EXPECT_EQ(id, "j-0001");
  const Json job = EndedJob(queue, id);
  EXPECT_EQ(job["id"], id);
  EXPECT_EQ(job["do"], "test");
  EXPECT_EQ(job["state"], "done");
  EXPECT_EQ(job["command"], "daumier test");
  EXPECT_EQ(job["error"], "");
  EXPECT_EQ(job["progress"], "");
  EXPECT_GE(job["seconds"], 0);
  EXPECT_EQ(job["result"], (Json{{"vertices", 3}}));
  EXPECT_EQ(job["warnings"], (Json{"the neck is short"}));
  EXPECT_EQ(job["files"], Json::array({{{"name", "head.glb"}, {"size", 5}}, {{"name", "stages/01.png"}, {"size", 7}}}));
  EXPECT_EQ(ReadFile(queue.FileOf(id, "stages/01.png")), "picture");
}

TEST(JobQueue, GivesOnlyFilesThatAreResults) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "precious", "");
  JobQueue queue(folder / "jobs");
  const auto work = [](const fs::path& place, const Task&) {
    WriteFileAtomically(place / "a.txt", "a");
    return Json::object();
  };
  const std::string id = queue.Add(JobOf(work)), other = queue.Add(JobOf(work));
  EndedJob(queue, id), EndedJob(queue, other);
  EXPECT_EQ(ReadFile(queue.FileOf(id, "a.txt")), "a");
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string("../../precious"),
        std::string("../j-0002/a.txt"), std::string("./a.txt"), std::string("/a.txt"), (folder / "precious").string(),
        std::string(".child/child.err"), std::string("..%2Fj-0002%2Fa.txt"), std::string("a.txt\0", 6),
        std::string("A.TXT"), std::string(5000, 'a')})
    EXPECT_THROW(queue.FileOf(id, name), NotFound) << name;
}

TEST(JobQueue, WhatAJobThrowsIsItsError) {
  const testing::TempDir folder;
  JobQueue queue(folder.path());
  const std::string ours = queue.Add(JobOf([](const fs::path& place, const Task&) -> Json {
    WriteFileAtomically(place / "half.glb", "half");
    throw Error("no face was found in the picture. Name another one");
  }));
  const std::string theirs =
      queue.Add(JobOf([](const fs::path&, const Task&) -> Json { throw std::out_of_range("map::at"); }));
  const Json job = EndedJob(queue, ours);
  EXPECT_EQ(job["state"], "failed");
  EXPECT_EQ(job["error"], "no face was found in the picture. Name another one");
  EXPECT_EQ(job["files"], Json::array()) << "what a failed job has left is no result";
  EXPECT_THROW(queue.FileOf(ours, "half.glb"), NotFound);
  EXPECT_EQ(EndedJob(queue, theirs)["state"], "failed");
  EXPECT_EQ(EndedJob(queue, queue.Add(EmptyJob()))["state"], "done") << "the queue continues";
}

TEST(JobQueue, AJobThatWaitsIsCancelledAtOnce) {
  const testing::TempDir folder;
  HeldJob held;
  std::atomic<bool> was_done = false;
  JobQueue queue(folder.path());
  const std::string running = queue.Add(held.job());
  held.WaitUntilItRuns();
  const std::string waiting = queue.Add(JobOf([&](const fs::path&, const Task&) {
    was_done = true;
    return Json::object();
  }));
  EXPECT_EQ(queue.Describe(running)["state"], "running");
  EXPECT_EQ(queue.Describe(waiting)["state"], "queued");
  queue.Cancel(waiting);
  EXPECT_EQ(queue.Describe(waiting)["state"], "cancelled");
  EXPECT_EQ(queue.Describe(running)["state"], "running");
  held.LetGo();
  EXPECT_EQ(EndedJob(queue, running)["state"], "done");
  EndedJob(queue, queue.Add(EmptyJob()));
  EXPECT_FALSE(was_done);
  EXPECT_EQ(queue.Describe(waiting)["state"], "cancelled");
}

TEST(JobQueue, AJobThatRunsIsCancelledWhenItHasEnded) {
  const testing::TempDir folder;
  HeldJob held;
  JobQueue queue(folder.path());
  const std::string id = queue.Add(held.job());
  held.WaitUntilItRuns();
  queue.Cancel(id);
  const Json job = EndedJob(queue, id);
  EXPECT_EQ(job["state"], "cancelled");
  EXPECT_EQ(job["error"], "");
  EXPECT_EQ(job["files"], Json::array());
  queue.Cancel(id);
  EXPECT_EQ(queue.Describe(id)["state"], "cancelled") << "twice is once";
  const std::string done = queue.Add(EmptyJob());
  EndedJob(queue, done);
  queue.Cancel(done);
  EXPECT_EQ(queue.Describe(done)["state"], "done") << "what is done stays done";
}

TEST(JobQueue, TakesNoMoreThanMayWait) {
  const testing::TempDir folder;
  HeldJob held;
  JobQueue queue(folder.path());
  queue.Add(held.job());
  held.WaitUntilItRuns();
  std::string last;
  for (size_t i = 0; i < JobQueue::kMostWaiting; ++i) last = queue.Add(EmptyJob());
  ExpectError([&] { queue.Add(EmptyJob()); }, "16 jobs are waiting already");
  EXPECT_THROW(queue.Add(EmptyJob()), UsageError);
  queue.Cancel(last);
  EXPECT_NO_THROW(queue.Add(EmptyJob())) << "a cancelled job waits no more";
}

TEST(JobQueue, OldResultsGo) {
  const testing::TempDir folder;
  JobQueue queue(folder.path());
  for (size_t i = 0; i <= JobQueue::kMostKept; ++i) {
    EndedJob(queue, queue.Add(EmptyJob()));
    if (i + 1 < JobQueue::kMostKept) {
      EXPECT_NO_THROW(queue.Describe("j-0001")) << i;
    }
  }
  EXPECT_THROW(queue.Describe("j-0001"), NotFound);
  EXPECT_FALSE(fs::exists(folder / "j-0001"));
  EXPECT_EQ(queue.Describe("j-0002")["state"], "done");
  EXPECT_TRUE(fs::exists(folder / "j-0002"));
}

TEST(JobQueue, JobsComeOneAfterTheOtherInTheirOrder) {
  const testing::TempDir folder;
  JobQueue queue(folder.path());
  std::atomic<int> num_running = 0;
  std::vector<int> order;
  std::string last;
  for (int i = 0; i < 5; ++i)
    last = queue.Add(JobOf([&, i](const fs::path& place, const Task&) {
      EXPECT_EQ(++num_running, 1);
      EXPECT_TRUE(fs::is_directory(place / kJobScratch));
      order.push_back(i);
      std::this_thread::sleep_for(2ms);
      --num_running;
      return Json::object();
    }));
  EndedJob(queue, last);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(JobQueue, ItsEndCancelsWhatRunsAndForgetsWhatWaits) {
  const testing::TempDir folder;
  HeldJob held;
  std::atomic<bool> was_done = false;
  {
    JobQueue queue(folder.path());
    queue.Add(held.job());
    queue.Add(JobOf([&](const fs::path&, const Task&) {
      was_done = true;
      return Json::object();
    }));
    held.WaitUntilItRuns();
  }
  EXPECT_FALSE(was_done);
}

TEST(JobQueue, TheFolderIsEmptiedFirst) {
  const testing::TempDir folder;
  MakeDirectory(folder / "jobs/j-0001");
  WriteFileAtomically(folder / "jobs/j-0001/head.glb", "old");
  JobQueue queue(folder / "jobs");
  EXPECT_TRUE(fs::is_empty(folder / "jobs"));
  EXPECT_THROW(queue.Describe("j-0001"), NotFound);
  EXPECT_EQ(EndedJob(queue, queue.Add(EmptyJob()))["files"], Json::array());
}

TEST(JobQueue, UnknownJobsAreNotFound) {
  const testing::TempDir folder;
  JobQueue queue(folder.path());
  queue.Add(EmptyJob());
  for (const char* id : {"", "j-0002", "j-1", "..", "../j-0001", "j-0001/"}) {
    EXPECT_THROW(queue.Describe(id), NotFound) << id;
    EXPECT_THROW(queue.Cancel(id), NotFound) << id;
    EXPECT_THROW(queue.FileOf(id, "a"), NotFound) << id;
  }
  ExpectError([&] { queue.Describe("j-0002"); }, "there is no job 'j-0002' any more");
}

TEST(JobQueue, ShowsTheProgressOfAChild) {
  const testing::TempDir folder;
  JobQueue queue(folder.path());
  std::latch is_written(1), is_seen(1);
  const std::string id = queue.Add(JobOf([&](const fs::path& place, const Task&) {
    WriteFileAtomically(place / kJobScratch / "child.err", "12:00:00 info Reading\nsketches 3/8\rsketches 4/8\r");
    is_written.count_down();
    is_seen.wait();
    return Json::object();
  }));
  is_written.wait();
  EXPECT_EQ(queue.Describe(id)["progress"], "sketches 4/8");
  is_seen.count_down();
  EXPECT_EQ(EndedJob(queue, id)["progress"], "");
}

TEST(JobQueue, ProgressIsTheLastLineThatIsNoWarning) {
  const testing::TempDir scratch;
  EXPECT_EQ(ProgressOf(scratch.path()), "");
  EXPECT_TRUE(WarningsOf(scratch.path()).empty());
  EXPECT_EQ(ProgressOf(scratch / "nothing"), "");
  WriteFileAtomically(scratch / "child.err",
                      "12:00:00 warning: first\nsketches 1/8\r\nsketches 2/8\n12:00:01 warning: second one\n\n");
  EXPECT_EQ(ProgressOf(scratch.path()), "sketches 2/8");
  EXPECT_EQ(WarningsOf(scratch.path()), (std::vector<std::string>{"first", "second one"}));
  WriteFileAtomically(scratch / "child.err", "\r\n\n");
  EXPECT_EQ(ProgressOf(scratch.path()), "");
}

TEST(JobQueue, IsUsedFromSeveralThreads) {
  const testing::TempDir folder;
  JobQueue queue(folder.path());
  std::vector<std::future<void>> threads;
  for (int thread = 0; thread < 4; ++thread)
    threads.push_back(std::async(std::launch::async, [&, thread] {
      for (int i = 0; i < 4; ++i) {
        const std::string own = std::to_string(thread) + std::to_string(i);
        const std::string id = queue.Add(JobOf([own](const fs::path& place, const Task&) {
          WriteFileAtomically(place / "own.txt", own);
          return Json{{"own", own}};
        }));
        if (i == 3) queue.Cancel(id);
        const Json job = EndedJob(queue, id);
        if (job["state"] == "cancelled") continue;
        EXPECT_EQ(job["result"]["own"], own);
        EXPECT_EQ(ReadFile(queue.FileOf(id, "own.txt")), own);
      }
    }));
  for (auto& thread : threads) thread.get();
}

}  // namespace
}  // namespace daumier::studio
