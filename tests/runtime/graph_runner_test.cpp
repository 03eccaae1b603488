#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <unistd.h>
#include <fstream>
#include <limits>

namespace daumier::runtime {
namespace {

/// A small U-Net: two levels, a skip that is added and one that is concatenated, a head of few channels.
GraphExample SmallUnet() {
  const std::map<std::string, GraphAttribute> same = {{"pads", std::vector<int64_t>{1, 1, 1, 1}}};
  const std::map<std::string, GraphAttribute> half = {{"pads", std::vector<int64_t>{1, 1, 1, 1}},
                                                      {"strides", std::vector<int64_t>{2, 2}}};
  const std::map<std::string, GraphAttribute> nearest = {{"mode", std::string("nearest")},
                                                         {"coordinate_transformation_mode", std::string("asymmetric")},
                                                         {"nearest_mode", std::string("floor")}};
  GraphExample example({-1, 1, 16, 16}, {"y", "z"});
  example.Weight("w1", {16, 1, 3, 3}, FixedNumbers(16 * 9, 1))
      .Weight("w2", {24, 16, 3, 3}, FixedNumbers(24 * 16 * 9, 2));
  example.Weight("w3", {16, 24, 1, 1}, FixedNumbers(16 * 24, 3))
      .Weight("w4", {5, 32, 3, 3}, FixedNumbers(5 * 32 * 9, 4));
  example.Weight("w5", {16, 16, 3, 3}, FixedNumbers(16 * 16 * 9, 5)).Weight("s", {4}, {1, 1, 2, 2});
  example.Node("Conv", {"x", "w1"}, "c1", same).Node("Relu", {"c1"}, "a");
  example.Node("Conv", {"a", "w2"}, "c2", half).Node("Relu", {"c2"}, "b");
  example.Node("Conv", {"b", "w3"}, "c3").Node("Resize", {"c3", "", "s"}, "u", nearest);
  example.Node("Conv", {"a", "w5"}, "c5", same).Node("Add", {"c5", "u"}, "d");
  example.Node("Concat", {"d", "u"}, "e", {{"axis", int64_t{1}}}).Node("Conv", {"e", "w4"}, "y", same);
  example.Node("ReduceMax", {"b"}, "z", {{"axes", std::vector<int64_t>{2, 3}}, {"keepdims", int64_t{0}}});
  return example;
}

TEST(GraphRunner, GivesEachSampleOfABatchWhatItGetsAlone) {
  const GraphRunner runner(SmallUnet().graph);
  const FloatArray x = FixedArray({7, 1, 16, 16});
  const NamedArrays together = runner.Run({{"x", x}});
  for (int64_t n = 0; n < 7; ++n) {
    const NamedArrays alone = runner.Run({{"x", {{1, 1, 16, 16}, {x.row(n), x.row(n) + 256}}}});
    for (const char* name : {"y", "z"}) {
      FloatArray part = alone.at(name);
      part.values.assign(together.at(name).row(n), together.at(name).row(n) + together.at(name).row_size());
      ExpectNear(part, alone.at(name), 1e-6);
    }
  }
}

TEST(GraphRunner, RunsNoReferenceCode) {
  for (const GraphRunner::Step& step : GraphRunner(SmallUnet().graph).StepsFor({{"x", FloatArray({1, 1, 16, 16})}}))
    EXPECT_FALSE(step.kernel.starts_with("ref")) << step.node << ": " << step.kernel;
}

TEST(GraphRunner, MayBeCalledFromThreads) {
  const GraphRunner runner(SmallUnet().graph);
  testing::ExpectTheSameFromThreads(20, [&] {
    std::vector<float> values;
    for (const int64_t batch : {1, 2}) {
      const NamedArrays outputs = runner.Run({{"x", FixedArray({batch, 1, 16, 16}, 7)}});
      values.insert(values.end(), outputs.at("y").values.begin(), outputs.at("y").values.end());
    }
    return values;
  });
}

int64_t ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  int64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

TEST(GraphRunner, TakesNoMoreMemoryAfterManyRuns) {
  const GraphRunner runner(SmallUnet().graph);
  const auto run = [&](int times) {
    for (int i = 0; i < times; ++i) runner.Run({{"x", FloatArray({1 + i % 7, 1, 16, 16})}});
  };
  run(200);  // More batch sizes than plans are kept.
  const int64_t before = ResidentBytes();
  run(10000);
  EXPECT_LE(ResidentBytes() - before, 2 << 20);
}

TEST(GraphRunner, NamesTheInputThatIsWrong) {
  const GraphRunner runner(GraphExample({-1, 3}).Node("Relu", {"x"}, "y").graph);
  const auto error_of = [&](const FloatArray& x, const std::string& part) {
    testing::ExpectError([&] { runner.Run({{"x", x}}); }, part);
  };
  testing::ExpectError([&] { runner.Run({}); }, "the network reads 'x', which is missing");
  error_of(FloatArray({2, 4}), "the input 'x' is (2, 4), expected (-1, 3)");
  error_of(FloatArray({0, 3}), "the input 'x' is (0, 3)");
  error_of({{1, 3}, {1, 2}}, "the input 'x' has 2 numbers for the shape (1, 3)");
  error_of({{1, 3}, {1, std::numeric_limits<float>::quiet_NaN(), 2}}, "the input 'x' has numbers that are not finite");
}

TEST(GraphRunner, NamesTheNodeThatItCannotCompute) {
  const GraphRunner runner(GraphExample({-1, 3}).Node("Bernoulli", {"x"}, "y").graph);
  testing::ExpectError(
      [&] {
        runner.Run({{"x", FloatArray({1, 3})}});
      },
      "node 'Bernoulli_y' (Bernoulli): the operator is not run here");
}

TEST(GraphRunner, RefusesARunThatNeedsTooMuchMemory) {
  GraphExample example({-1, 1});
  example.Integers("s", {1, 1 << 27});
  example.Node("Expand", {"x", "s"}, "a")
      .Node("Exp", {"a"}, "b")
      .Node("Add", {"a", "b"}, "c")
      .Node("Mul", {"a", "c"}, "y");
  testing::ExpectError([&] { example.Run(FloatArray({1, 1})); }, "numbers (at most");
}

}  // namespace
}  // namespace daumier::runtime
