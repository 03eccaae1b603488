#include "runtime/plan_builder.h"

#include "core/error.h"
#include "core/log.h"
#include "runtime/operators.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace daumier::runtime {
namespace {

constexpr int kAlwaysRead = 1 << 24;  // Of memory that later nodes may read under another value's name.

}  // namespace

int64_t SizeOf(const Layout& layout) {
  return int64_t(layout.get_size() / sizeof(float));
}

const float* PackedWeights::Packed(const std::string& name, const float* weights, const Layout& from,
                                   const Layout& to) {
  if (from == to) return weights;
  std::vector<std::unique_ptr<Entry>>& entries = entries_[name];
  for (const auto& entry : entries)
    if (entry->layout == to) return entry->numbers.data();
  auto entry = std::make_unique<Entry>(Entry{to, AlignedFloats(size_t(SizeOf(to)))});
  const Primitive reorder = MakeReorder(from, to);
  AlignedFloats scratch(size_t(SizeOf(reorder.scratch)));
  Execute(reorder.primitive,
          {{DNNL_ARG_FROM, dnnl::memory(from, CpuEngine(), const_cast<float*>(weights))},
           {DNNL_ARG_TO, dnnl::memory(to, CpuEngine(), entry->numbers.data())},
           {DNNL_ARG_SCRATCHPAD, dnnl::memory(reorder.scratch, CpuEngine(), scratch.data())}},
          name);
  entries.push_back(std::move(entry));
  return entries.back()->numbers.data();
}

PlanBuilder::PlanBuilder(const Graph& graph, const std::map<std::string, Shape>& inputs, PackedWeights& packed)
    : graph_(graph), packed_(packed) {
  for (const GraphNode& node : graph.nodes)
    for (const std::string& input : node.inputs) ++reads_[input];
  for (const std::string& output : graph.outputs) ++reads_[output];
  FindParts();
  for (const auto& [name, weight] : graph.weights)
    if (!weight.has_integers)
      values_[name] = {weight.shape, PlainLayout(weight.shape), {.constant = weight.numbers.data()}};
  for (const GraphInput& input : graph.inputs) {
    const Shape& shape = inputs.at(input.name);
    const Place place = NewBuffer(CheckedSize(shape, fmt::format("the input '{}'", input.name)));
    values_[input.name] = {shape, PlainLayout(shape), place};
    reads_of_buffers_[place.buffer] += reads_[input.name];
    inputs_.push_back({input.name, shape, place});
  }
}

void PlanBuilder::FindParts() {
  std::map<std::string, int> times;
  for (const GraphNode& node : graph_.nodes) {
    if (node.op != "Concat") continue;
    for (size_t i = 0; i < node.inputs.size(); ++i)
      if (++times[node.inputs[i]] == 1) parts_[node.inputs[i]] = {&node, i};
  }
  std::erase_if(parts_, [&](const auto& part) { return times.at(part.first) > 1; });
}

std::unique_ptr<Plan> PlanBuilder::Build() {
  for (const GraphNode& node : graph_.nodes) PlanNode(node);
  std::vector<PlanPort> outputs;
  for (const std::string& output : graph_.outputs) {
    const Place place = Plain(output);
    outputs.push_back({output, ShapeOf(output), place});
  }
  for (const PlanPort& output : outputs)  // Read after the last step.
    if (output.place.buffer >= 0) buffers_[size_t(output.place.buffer)].last = int(steps_.size());
  return std::make_unique<Plan>(std::move(steps_), std::move(inputs_), std::move(outputs), buffers_,
                                std::move(folded_));
}

void PlanBuilder::PlanNode(const GraphNode& node) {
  for (const std::string& input : node.inputs)
    if (const auto value = values_.find(input); value != values_.end() && value->second.place.buffer >= 0)
      --reads_of_buffers_[value->second.place.buffer];
  if (FoldNode(node)) return;
  try {
    for (const std::string& input : node.inputs)
      if (const auto value = values_.find(input); value != values_.end())
        DAUMIER_CHECK(CheckedSize(value->second.shape, input) > 0, "its input '{}' is empty", input);
    OperatorOf(node)(node, *this);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", node.Text(), error.what()));
  } catch (const std::out_of_range&) {
    throw Error(fmt::format("{} has {} inputs, which is too few", node.Text(), node.inputs.size()));
  } catch (const dnnl::error& error) {
    throw Error(fmt::format("{}: oneDNN refuses it: {}", node.Text(), error.what()));
  }
  DAUMIER_CHECK(values_.contains(node.output), "{} defines no output", node.Text());
}

const PlannedValue& PlanBuilder::Value(const std::string& name) const {
  const auto found = values_.find(name);
  DAUMIER_CHECK(found != values_.end(), "'{}' has no real numbers (whole ones are known before a run alone)", name);
  return found->second;
}

const GraphTensor* PlanBuilder::Known(const std::string& name) const {
  if (const auto weight = graph_.weights.find(name); weight != graph_.weights.end()) return &weight->second;
  const auto found = folded_.find(name);
  return found == folded_.end() ? nullptr : &found->second;
}

bool PlanBuilder::FoldNode(const GraphNode& node) {
  std::vector<KnownInput> inputs;
  for (const std::string& input : node.inputs) {
    KnownInput known{nullptr, Known(input)};
    if (const auto value = values_.find(input); value != values_.end()) known.shape = &value->second.shape;
    if (known.value != nullptr) known.shape = &known.value->shape;
    inputs.push_back(known);
  }
  std::optional<GraphTensor> computed = folder_.Fold(node, inputs);
  if (!computed) return false;
  const GraphTensor& folded = folded_[node.output] = std::move(*computed);
  if (!folded.has_integers)
    values_[node.output] = {folded.shape, PlainLayout(folded.shape), {.constant = folded.numbers.data()}};
  return true;
}

const GraphTensor& PlanBuilder::Weight(const GraphNode& node, size_t input) const {
  DAUMIER_CHECK(node.Reads(input), "input {} is absent", input);
  const GraphTensor* const found = Known(node.inputs[input]);
  DAUMIER_CHECK(found != nullptr && !found->has_integers,
                "input {}, '{}', is computed or of integers (expected weights)", input, node.inputs[input]);
  return *found;
}

const GraphTensor& PlanBuilder::Whole(const GraphNode& node, size_t input) const {
  DAUMIER_CHECK(node.Reads(input), "input {} is absent", input);
  const GraphTensor* const found = Known(node.inputs[input]);
  DAUMIER_CHECK(found != nullptr && found->has_integers, "input {}, '{}', is no constant of integers", input,
                node.inputs[input]);
  return *found;
}

Place PlanBuilder::In(const std::string& name, const Layout& layout) {
  const PlannedValue& value = Value(name);
  if (value.layout == layout) return value.place;
  auto& converted = converted_[name];
  for (const auto& [made, place] : converted)
    if (made == layout) return place;
  const Place place = NewBuffer(SizeOf(layout));
  AddPrimitive({.op = "layout", .name = name}, MakeReorder(value.layout, layout),
               {{DNNL_ARG_FROM, value.layout, value.place}, {DNNL_ARG_TO, layout, place}});
  converted.emplace_back(layout, place);
  reads_of_buffers_[place.buffer] = kAlwaysRead;
  return place;
}

Place PlanBuilder::Packed(const GraphNode& node, size_t input, const Layout& from, const Layout& to) {
  const GraphTensor& weights = Weight(node, input);
  DAUMIER_CHECK(graph_.weights.contains(node.inputs[input]), "input {}, '{}', depends on shapes (expected weights)",
                input,
                node.inputs[input]);  // Plans share what is packed.
  return {.constant = packed_.Packed(node.inputs[input], weights.numbers.data(), from, to)};
}

bool PlanBuilder::MayOverwrite(const std::string& name) const {
  const Place& place = Value(name).place;
  return place.buffer >= 0 && reads_of_buffers_.at(place.buffer) == 0;
}

Place PlanBuilder::NewBuffer(int64_t size) {
  DAUMIER_CHECK(size <= kMostNumbers, "a tensor has {} numbers (at most {} are allowed)", size, kMostNumbers);
  buffers_.push_back({.size = size});
  return {.buffer = int(buffers_.size()) - 1};
}

std::optional<PlanBuilder::Gathering> PlanBuilder::GatheringOf(const std::string& output) const {
  const auto found = gatherings_.find(output);
  return found == gatherings_.end() ? std::nullopt : std::optional(found->second);
}

Place PlanBuilder::Grown(const Place& place, int64_t size) {
  int64_t& held = buffers_.at(size_t(place.buffer)).size;
  held = std::max(held, size);
  return place;
}

/// Parts lie one behind the other where all sizes before the axis are 1. In blocks of channels, every part but the last
/// has whole blocks.
std::optional<Place> PlanBuilder::PlaceInGathering(const GraphNode& node, const Shape& shape, const Layout& layout) {
  const auto part = parts_.find(node.output);
  const int block = BlockOf(layout, shape);
  if (part == parts_.end() || block == 0) return std::nullopt;
  const GraphNode& concatenation = *part->second.concatenation;
  int64_t axis = concatenation.Integer("axis", 0);
  if (axis < 0) axis += int64_t(shape.size());
  if (axis < 0 || axis >= int64_t(shape.size()) || (block > 1 && axis != 1)) return std::nullopt;
  if (std::any_of(shape.begin(), shape.begin() + axis, [](int64_t size) { return size != 1; })) return std::nullopt;
  const auto gathering = gatherings_.find(concatenation.output);
  if (gathering != gatherings_.end() && gathering->second.block != block) return std::nullopt;
  int64_t before = 0;
  for (size_t i = 0; i < part->second.index; ++i) {
    const auto earlier = values_.find(concatenation.inputs[i]);
    if (earlier == values_.end() || earlier->second.shape.size() != shape.size()) return std::nullopt;
    before += earlier->second.shape[size_t(axis)];
  }
  if (before % block != 0) return std::nullopt;
  int64_t row = 1;
  for (size_t i = size_t(axis) + 1; i < shape.size(); ++i) row *= shape[i];
  Gathering& gathered = gatherings_[concatenation.output];
  if (gathered.block == 0) gathered = {NewBuffer(0), block};
  Place place = gathered.place;
  place.offset = before * row;
  Grown(place, place.offset + SizeOf(layout));
  return place;
}

Place PlanBuilder::NewOutput(const GraphNode& node, const Shape& shape, const Layout& layout) {
  if (const std::optional<Place> place = PlaceInGathering(node, shape, layout)) return *place;
  return NewBuffer(SizeOf(layout));
}

void PlanBuilder::Define(const GraphNode& node, const Shape& shape, const Layout& layout, const Place& place) {
  DAUMIER_CHECK(CheckedSize(shape, "its output") > 0, "its output is empty");
  values_[node.output] = {shape, layout, place};
  if (place.buffer >= 0) reads_of_buffers_[place.buffer] += reads_[node.output];
}

void PlanBuilder::Touch(const Place& place) {
  if (place.buffer < 0) return;
  PlanBuffer& buffer = buffers_[size_t(place.buffer)];
  const int step = int(steps_.size());
  const bool is_input =
      std::ranges::any_of(inputs_, [&](const PlanPort& input) { return input.place.buffer == place.buffer; });
  if (buffer.first < 0 && !is_input) buffer.first = step;
  buffer.last = step;
}

void PlanBuilder::AddPrimitive(const GraphNode& node, const Primitive& primitive, std::vector<PlanArgument> arguments) {
  if (const int64_t size = SizeOf(primitive.scratch); size > 0)
    arguments.push_back({DNNL_ARG_SCRATCHPAD, primitive.scratch, NewBuffer(size)});
  for (const PlanArgument& argument : arguments) Touch(argument.place);
  if (primitive.kernel.starts_with("ref") && node.op != "layout")
    log::Warn("{} runs by oneDNN's reference code ({}), which is slow", node.Text(), primitive.kernel);
  steps_.push_back({node.Text(), primitive.kernel, primitive.primitive, std::move(arguments)});
}

void PlanBuilder::AddOwn(const GraphNode& node, std::span<const Place> places, std::function<void(Arena&)> own) {
  for (const Place& place : places) Touch(place);
  steps_.push_back({.node = node.Text(), .kernel = "ours", .own = std::move(own)});
}

void PlanBuilder::AddCopy(const GraphNode& node, const Place& from, const Place& to, int64_t count) {
  if (from == to) return;
  AddOwn(node, std::array{from, to},
         [=](Arena& arena) { std::memcpy(arena.At(to), arena.At(from), size_t(count) * sizeof(float)); });
}

}  // namespace daumier::runtime
