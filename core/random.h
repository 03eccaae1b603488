#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace daumier {

/// xoshiro256** [Blackman and Vigna 2018] with its own distributions, so that a seed gives the same bytes with
/// every compiler. Normal() uses the C library's log and cos: its last bit may differ between C libraries.
class Rng {
 public:
  using State = std::array<uint64_t, 4>;

  explicit Rng(uint64_t seed);
  explicit Rng(const State& state) : state_(state) {}

  uint64_t Bits();
  /// Uniform in [0, 1), 53 bits.
  double Uniform();
  /// Uniform in [low, high).
  double Uniform(double low, double high);
  /// Standard normal, by Box-Muller; one call uses two draws and keeps nothing.
  double Normal();
  /// Uniform in {0, ..., count - 1}, without modulo bias. @throws Error if count is 0.
  uint64_t Below(uint64_t count);
  /// A uniformly random order of 0..count-1 (Fisher-Yates).
  std::vector<int> Permutation(int count);

  const State& state() const { return state_; }

 private:
  State state_;
};

/// The random stream of one purpose: streams of different (seed, purpose, index) are independent of each other.
Rng Stream(uint64_t seed, std::string_view purpose, uint64_t index = 0);

}  // namespace daumier
