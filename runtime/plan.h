#pragma once
#include "core/array.h"
#include "runtime/primitives.h"
#include "runtime/siren_kernel.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace daumier::runtime {

/// Where the numbers of a value lie during a run: in a buffer of the arena, or in memory that is never written.
struct Place {
  int buffer = -1;     ///< -1: at `constant`.
  int64_t offset = 0;  ///< In numbers.
  const float* constant = nullptr;

  bool operator==(const Place&) const = default;
};

/// The memory of one run: all buffers of a plan, of which those that are not needed at the same time overlap.
class Arena {
 public:
  Arena(const std::vector<int64_t>& offsets, int64_t size) : offsets_(offsets), numbers_(size_t(size)) {}

  const float* At(const Place& place) const {
    return place.buffer < 0 ? place.constant + place.offset
                            : numbers_.data() + offsets_[size_t(place.buffer)] + place.offset;
  }
  float* At(const Place& place) { return const_cast<float*>(std::as_const(*this).At(place)); }

 private:
  const std::vector<int64_t>& offsets_;
  AlignedFloats numbers_;
};

struct PlanArgument {
  int key;  ///< DNNL_ARG_...
  Layout layout;
  Place place;
};

/// A primitive of oneDNN, or a loop of our own.
struct PlanStep {
  std::string node, kernel;  ///< kernel: the code that runs, "ours" for a loop of our own.
  dnnl::primitive primitive = {};
  std::vector<PlanArgument> arguments = {};
  std::function<void(Arena&)> own = {};
};

struct PlanPort {
  std::string name;
  Shape shape;
  Place place;
};

/// A buffer of the arena, in use from the first to the last of some steps.
struct PlanBuffer {
  int64_t size = 0;
  int first = -1, last = -1;  ///< -1: before all steps.
};

/// A graph ready to be run with inputs of one shape by a number of threads.
class Plan {
 public:
  /// constants: what places of the plan may lie in, in addition to weights. @throws Error if the arena is larger than
  /// kMostNumbers.
  Plan(std::vector<PlanStep> steps, std::vector<PlanPort> inputs, std::vector<PlanPort> outputs,
       const std::vector<PlanBuffer>& buffers, std::map<std::string, GraphTensor> constants = {});
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  /// May be called from several threads, each of which has memory of its own. The inputs have the plan's shapes.
  NamedArrays Run(const NamedArrays& inputs) const;

  const std::vector<PlanStep>& steps() const { return steps_; }
  int64_t arena_size() const { return arena_size_; }  ///< In numbers.

 private:
  /// Memory of a run, with the arguments of its primitives.
  struct Context {
    Arena arena;
    std::vector<std::unordered_map<int, dnnl::memory>> arguments;
  };
  std::unique_ptr<Context> Borrow() const;
  void Return(std::unique_ptr<Context> context) const;

  const std::vector<PlanStep> steps_;
  const std::vector<PlanPort> inputs_, outputs_;
  const std::map<std::string, GraphTensor> constants_;
  std::vector<int64_t> offsets_;
  int64_t arena_size_ = 0;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Context>> free_;
};

}  // namespace daumier::runtime
