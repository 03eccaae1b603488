#include "core/random.h"

#include "core/error.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

namespace daumier {
namespace {

/// One step of SplitMix64 [Steele et al. 2014]: a bijection of 64-bit words that spreads every bit of its input.
uint64_t Mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace

Rng::Rng(uint64_t seed) {
  for (uint64_t& word : state_) {
    word = Mix(seed);
    seed += 0x9e3779b97f4a7c15;
  }
}

uint64_t Rng::Bits() {
  const uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Rng::Uniform() {
  return static_cast<double>(Bits() >> 11) * 0x1p-53;
}

double Rng::Uniform(double low, double high) {
  const double value = low + (high - low) * Uniform();
  return value < high ? value : std::nextafter(high, low);  // The sum may round up to `high`.
}

double Rng::Normal() {
  const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
  return radius * std::cos(2 * std::numbers::pi * Uniform());
}

uint64_t Rng::Below(uint64_t count) {
  DAUMIER_CHECK(count > 0, "a random number below 0 was requested");
  const uint64_t num_surplus = -count % count;  // 2^64 mod count: without these, every remainder is equally likely.
  uint64_t bits = Bits();
  while (bits < num_surplus) bits = Bits();
  return bits % count;
}

std::vector<int> Rng::Permutation(int count) {
  DAUMIER_CHECK(count >= 0, "a permutation of {} elements was requested", count);
  std::vector<int> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[Below(i)]);
  return order;
}

Rng Stream(uint64_t seed, std::string_view purpose, uint64_t index) {
  uint64_t hash = Mix(seed);
  for (const char c : purpose) hash = Mix(hash ^ static_cast<unsigned char>(c));
  return Rng(Mix(Mix(hash ^ purpose.size()) ^ index));
}

}  // namespace daumier
