#include "runtime/plan.h"

#include "core/error.h"

#include <algorithm>
#include <numeric>

namespace daumier::runtime {
namespace {

constexpr int64_t kLine = 16;  // Numbers in a cache line, at which buffers begin.
constexpr size_t kMostFree = 4;

struct Offsets {
  std::vector<int64_t> of_buffers;
  int64_t end = 0;
};

/// The largest buffers first, each at the lowest place where none lies that is in use at the same time.
Offsets PlaceBuffers(const std::vector<PlanBuffer>& buffers) {
  std::vector<size_t> order(buffers.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](size_t i) { return buffers[i].size; });
  Offsets offsets{std::vector<int64_t>(buffers.size())};
  std::vector<size_t> placed;  // By their offsets.
  for (const size_t i : order) {
    const PlanBuffer& buffer = buffers[i];
    const int64_t size = (buffer.size + kLine - 1) / kLine * kLine;
    int64_t begin = 0;
    for (const size_t other : placed) {
      const PlanBuffer& earlier = buffers[other];
      if (earlier.last < buffer.first || buffer.last < earlier.first) continue;
      if (offsets.of_buffers[other] - begin >= size) break;
      begin = std::max(begin, offsets.of_buffers[other] + (earlier.size + kLine - 1) / kLine * kLine);
    }
    offsets.of_buffers[i] = begin;
    offsets.end = std::max(offsets.end, begin + size);
    placed.insert(std::ranges::upper_bound(placed, begin, {}, [&](size_t b) { return offsets.of_buffers[b]; }), i);
  }
  return offsets;
}

}  // namespace

Plan::Plan(std::vector<PlanStep> steps, std::vector<PlanPort> inputs, std::vector<PlanPort> outputs,
           const std::vector<PlanBuffer>& buffers, std::map<std::string, GraphTensor> constants)
    : steps_(std::move(steps)),
      inputs_(std::move(inputs)),
      outputs_(std::move(outputs)),
      constants_(std::move(constants)) {
  Offsets offsets = PlaceBuffers(buffers);
  DAUMIER_CHECK(offsets.end <= kMostNumbers, "a run of the graph needs {} numbers (at most {} are allowed)",
                offsets.end, kMostNumbers);
  offsets_ = std::move(offsets.of_buffers);
  arena_size_ = offsets.end;
}

std::unique_ptr<Plan::Context> Plan::Borrow() const {
  {
    const std::lock_guard lock(mutex_);
    if (!free_.empty()) {
      std::unique_ptr<Context> context = std::move(free_.back());
      free_.pop_back();
      return context;
    }
  }
  auto context = std::make_unique<Context>(Context{Arena(offsets_, arena_size_), {}});
  for (const PlanStep& step : steps_) {
    auto& arguments = context->arguments.emplace_back();
    for (const PlanArgument& argument : step.arguments)
      arguments.emplace(argument.key, dnnl::memory(argument.layout, CpuEngine(), context->arena.At(argument.place)));
  }
  return context;
}

void Plan::Return(std::unique_ptr<Context> context) const {
  const std::lock_guard lock(mutex_);
  if (free_.size() < kMostFree) free_.push_back(std::move(context));
}

NamedArrays Plan::Run(const NamedArrays& inputs) const {
  std::unique_ptr<Context> context = Borrow();
  for (const PlanPort& input : inputs_) std::ranges::copy(inputs.at(input.name).values, context->arena.At(input.place));
  for (size_t i = 0; i < steps_.size(); ++i) {
    if (steps_[i].own) {
      steps_[i].own(context->arena);
    } else {
      Execute(steps_[i].primitive, context->arguments[i], steps_[i].node);
    }
  }
  NamedArrays outputs;
  for (const PlanPort& output : outputs_) {
    FloatArray& array = outputs[output.name] = FloatArray(output.shape);
    std::copy_n(std::as_const(context->arena).At(output.place), array.values.size(), array.values.begin());
  }
  Return(std::move(context));
  return outputs;
}

}  // namespace daumier::runtime
