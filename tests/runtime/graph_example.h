#pragma once
#include "runtime/graph_runner.h"

#include <gtest/gtest.h>

#include <utility>

namespace daumier::runtime {

/// A graph from "x" (and "z") to "y", made node by node.
class GraphExample {
 public:
  explicit GraphExample(Shape input, std::vector<std::string> outputs = {"y"}) {
    graph.inputs = {{"x", std::move(input)}};
    graph.outputs = std::move(outputs);
  }
  GraphExample& Weight(const std::string& name, Shape shape, std::vector<float> numbers) {
    graph.weights[name] = {.shape = std::move(shape), .numbers = std::move(numbers)};
    return *this;
  }
  GraphExample& Integers(const std::string& name, std::vector<int64_t> integers) {
    graph.weights[name] = {.shape = {int64_t(integers.size())}, .integers = std::move(integers), .has_integers = true};
    return *this;
  }
  GraphExample& Node(const std::string& op, std::vector<std::string> inputs, const std::string& output,
                     std::map<std::string, GraphAttribute> attributes = {}) {
    graph.nodes.push_back({op, op + "_" + output, std::move(inputs), output, std::move(attributes)});
    return *this;
  }
  FloatArray Run(const FloatArray& x) const { return GraphRunner(graph).Run({{"x", x}}).at("y"); }
  FloatArray Run(const FloatArray& x, const FloatArray& z) const {
    return GraphRunner(graph).Run({{"x", x}, {"z", z}}).at("y");
  }

  Graph graph;
};

/// Numbers of a fixed sequence in [-1, 1].
inline std::vector<float> FixedNumbers(size_t count, uint32_t seed = 1) {
  std::vector<float> numbers(count);
  for (float& number : numbers) {
    seed = seed * 1664525u + 1013904223u;
    number = float(seed >> 8) / float(1 << 23) - 1;
  }
  return numbers;
}

inline FloatArray FixedArray(Shape shape, uint32_t seed = 1) {
  FloatArray array(std::move(shape));
  array.values = FixedNumbers(array.values.size(), seed);
  return array;
}

/// Whether two arrays differ by less than `share` of the largest number.
inline void ExpectNear(const FloatArray& found, const FloatArray& expected, double share = 1e-5) {
  ASSERT_EQ(found.shape, expected.shape);
  double largest = 1e-30, difference = 0;
  for (size_t i = 0; i < found.values.size(); ++i) {
    largest = std::max(largest, std::abs(double(expected.values[i])));
    difference = std::max(difference, std::abs(double(found.values[i]) - expected.values[i]));
  }
  EXPECT_LE(difference, share * largest);
}

}  // namespace daumier::runtime
