#include "export/torch_runner.h"

#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <thread>

namespace daumier::exporting {
namespace {

NetworkFunction Doubling() {
  return {std::make_shared<Weights>(), TestFunction({3}, [](const torch::Tensor& x) { return 2 * x; })};
}

TEST(TorchRunner, ReturnsTheOutputsByName) {
  const TorchRunner runner(Doubling(), torch::kCPU);
  const NamedArrays outputs = runner.Run({{"x", FloatArray({2, 3}, {1, 2, 3, 4, 5, 6})}});
  ASSERT_EQ(outputs.size(), 1u);
  EXPECT_EQ(outputs.at("y").shape, (std::vector<int64_t>{2, 3}));
  EXPECT_EQ(outputs.at("y").values, (std::vector<float>{2, 4, 6, 8, 10, 12}));
}

TEST(TorchRunner, NamesTheInputThatIsWrong) {
  const TorchRunner runner(Doubling(), torch::kCPU);
  testing::ExpectError([&] { runner.Run({}); }, "the network reads 'x', which is missing");
  testing::ExpectError([&] { runner.Run({{"x", FloatArray({2, 4})}}); }, "the input 'x' is (2, 4), expected (N, 3)");
}

TEST(TorchRunner, IsThreadSafe) {
  const TorchRunner runner(Doubling(), torch::kCPU);
  std::vector<std::thread> threads;
  std::atomic<int> num_right = 0;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i) {
        const auto value = float(100 * t + i);
        const NamedArrays outputs = runner.Run({{"x", FloatArray({1, 3}, {value, 0, 1})}});
        num_right += outputs.at("y").values == std::vector<float>{2 * value, 0, 2};
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(num_right, 200);
}

}  // namespace
}  // namespace daumier::exporting
