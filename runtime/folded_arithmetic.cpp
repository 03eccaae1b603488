#include "runtime/folded_arithmetic.h"

#include "core/error.h"
#include "runtime/onnx_tensor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace daumier::runtime {
namespace {

constexpr int64_t kLowest = std::numeric_limits<int64_t>::min();

int64_t Whole(bool overflows, int64_t value) {
  DAUMIER_CHECK(!overflows, "a whole number has more than 64 bits");
  return value;
}
int64_t SumOfIntegers(int64_t a, int64_t b) {
  int64_t c = 0;
  const bool overflows = __builtin_add_overflow(a, b, &c);
  return Whole(overflows, c);
}
int64_t DifferenceOfIntegers(int64_t a, int64_t b) {
  int64_t c = 0;
  const bool overflows = __builtin_sub_overflow(a, b, &c);
  return Whole(overflows, c);
}
int64_t ProductOfIntegers(int64_t a, int64_t b) {
  int64_t c = 0;
  const bool overflows = __builtin_mul_overflow(a, b, &c);
  return Whole(overflows, c);
}
void CheckDivisor(int64_t a, int64_t b) {
  DAUMIER_CHECK(b != 0 && (a != kLowest || b != -1), "{} is divided by {}", a, b);
}
int64_t QuotientOfIntegers(int64_t a, int64_t b) {
  CheckDivisor(a, b);
  return a / b;
}
/// With the sign of b.
int64_t RestOfIntegers(int64_t a, int64_t b) {
  CheckDivisor(a, b);
  const int64_t rest = a % b;
  return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}
int64_t NegatedInteger(int64_t a) {
  return DifferenceOfIntegers(0, a);
}
int64_t IntegerFromReal(double number) {
  DAUMIER_CHECK(std::abs(number) < 0x1p62, "{} is cast to a whole number", number);
  return static_cast<int64_t>(number);
}

using IntegerFunction = int64_t (*)(int64_t, int64_t);
const std::map<std::string, IntegerFunction>& IntegerFunctions() {
  static const std::map<std::string, IntegerFunction> functions = {
      {"Add", SumOfIntegers},
      {"And", [](int64_t a, int64_t b) -> int64_t { return a != 0 && b != 0; }},
      {"Div", QuotientOfIntegers},
      {"Max", [](int64_t a, int64_t b) { return std::max(a, b); }},
      {"Min", [](int64_t a, int64_t b) { return std::min(a, b); }},
      {"Mod", RestOfIntegers},
      {"Mul", ProductOfIntegers},
      {"Or", [](int64_t a, int64_t b) -> int64_t { return a != 0 || b != 0; }},
      {"Sub", DifferenceOfIntegers}};
  return functions;
}

using RealFunction = float (*)(float, float);
const std::map<std::string, RealFunction>& RealFunctions() {
  static const std::map<std::string, RealFunction> functions = {{"Add", [](float a, float b) { return a + b; }},
                                                                {"Div", [](float a, float b) { return a / b; }},
                                                                {"Max", [](float a, float b) { return std::max(a, b); }},
                                                                {"Min", [](float a, float b) { return std::min(a, b); }},
                                                                {"Mul", [](float a, float b) { return a * b; }},
                                                                {"Pow", [](float a, float b) { return std::pow(a, b); }},
                                                                {"Sub", [](float a, float b) { return a - b; }}};
  return functions;
}

/// -1, 0 or 1 to whether the comparison holds.
using Comparison = bool (*)(int);
const std::map<std::string, Comparison>& Comparisons() {
  static const std::map<std::string, Comparison> comparisons = {
      {"Equal", [](int order) { return order == 0; }},
      {"Greater", [](int order) { return order > 0; }},
      {"GreaterOrEqual", [](int order) { return order >= 0; }},
      {"Less", [](int order) { return order < 0; }},
      {"LessOrEqual", [](int order) { return order <= 0; }}};
  return comparisons;
}

using UnaryOfReal = float (*)(float);
const std::map<std::string, UnaryOfReal>& UnariesOfReals() {
  static const std::map<std::string, UnaryOfReal> functions = {{"Abs", [](float x) { return std::abs(x); }},
                                                               {"Ceil", [](float x) { return std::ceil(x); }},
                                                               {"Exp", [](float x) { return std::exp(x); }},
                                                               {"Floor", [](float x) { return std::floor(x); }},
                                                               {"Neg", [](float x) { return -x; }},
                                                               {"Reciprocal", [](float x) { return 1 / x; }},
                                                               {"Round", [](float x) { return std::rint(x); }},
                                                               {"Sqrt", [](float x) { return std::sqrt(x); }}};
  return functions;
}
using UnaryOfInteger = int64_t (*)(int64_t);
const std::map<std::string, UnaryOfInteger>& UnariesOfIntegers() {
  static const std::map<std::string, UnaryOfInteger> functions = {
      {"Abs", [](int64_t x) { return x < 0 ? NegatedInteger(x) : x; }},
      {"Neg", NegatedInteger},
      {"Not", [](int64_t x) -> int64_t { return x == 0; }}};
  return functions;
}

template <class T, class F>
std::vector<T> Mapped(const std::vector<T>& from, const F& f) {
  std::vector<T> to(from.size());
  std::ranges::transform(from, to.begin(), f);
  return to;
}

GraphTensor CastTo(int64_t type, const GraphTensor& from) {
  GraphTensor cast{.shape = from.shape, .has_integers = !IsRealType(type)};
  DAUMIER_CHECK(type >= kFloat32 && type <= kBfloat16 && type != kString, "it casts to the element type {}", type);
  if (from.has_integers && !cast.has_integers) {
    for (const int64_t number : from.integers) cast.numbers.push_back(float(number));
  } else if (!from.has_integers && cast.has_integers) {
    for (const float number : from.numbers)
      cast.integers.push_back(type == kBool ? int64_t{number != 0} : IntegerFromReal(number));
  } else {
    cast.integers = from.integers;
    cast.numbers = from.numbers;
  }
  if (type == kBool)
    for (int64_t& number : cast.integers) number = number != 0;
  return cast;
}

template <class T>
std::vector<int64_t> Compared(const std::vector<T>& a, const std::vector<T>& b, Comparison holds) {
  std::vector<int64_t> results(a.size());
  for (size_t i = 0; i < a.size(); ++i) results[i] = holds(int(a[i] > b[i]) - int(a[i] < b[i]));
  return results;
}

template <class T>
T ReducedNumbers(const std::string& f, const std::vector<T>& numbers) {
  DAUMIER_CHECK(!numbers.empty(), "its input is empty");
  if (f == "ReduceMax") return *std::ranges::max_element(numbers);
  if (f == "ReduceMin") return *std::ranges::min_element(numbers);
  using Total = std::conditional_t<std::is_same_v<T, float>, double, T>;
  Total total = f == "ReduceProd" ? 1 : 0;
  for (const T number : numbers) {
    if constexpr (std::is_same_v<T, float>) {
      total = f == "ReduceProd" ? total * number : total + number;
    } else {
      total = f == "ReduceProd" ? ProductOfIntegers(total, number) : SumOfIntegers(total, number);
    }
  }
  return T(total);
}

}  // namespace

std::vector<std::string> FoldedArithmeticNames() {
  std::vector<std::string> names = {"Cast"};
  const auto add = [&](const auto& functions) {
    for (const auto& [name, function] : functions) names.push_back(name);
  };
  add(IntegerFunctions());
  add(RealFunctions());
  add(Comparisons());
  add(UnariesOfReals());
  add(UnariesOfIntegers());
  return names;
}

std::optional<GraphTensor> FoldedUnary(const GraphNode& node, const GraphTensor& from) {
  if (node.op == "Cast") return CastTo(node.Integer("to", 0), from);
  GraphTensor result{.shape = from.shape, .has_integers = from.has_integers};
  if (from.has_integers) {
    const auto found = UnariesOfIntegers().find(node.op);
    if (found == UnariesOfIntegers().end()) return std::nullopt;
    result.integers = Mapped(from.integers, found->second);
  } else {
    const auto found = UnariesOfReals().find(node.op);
    if (found == UnariesOfReals().end()) return std::nullopt;
    result.numbers = Mapped(from.numbers, found->second);
  }
  return result;
}

std::optional<GraphTensor> FoldedBinary(const std::string& f, const GraphTensor& a, const GraphTensor& b) {
  DAUMIER_CHECK(a.has_integers == b.has_integers, "{} of integers and other numbers", f);
  GraphTensor result{.shape = a.shape, .has_integers = a.has_integers};
  if (const auto comparison = Comparisons().find(f); comparison != Comparisons().end()) {
    result.integers = a.has_integers ? Compared(a.integers, b.integers, comparison->second)
                                     : Compared(a.numbers, b.numbers, comparison->second);
    result.has_integers = true;
  } else if (a.has_integers) {
    const auto function = IntegerFunctions().find(f);
    if (function == IntegerFunctions().end()) return std::nullopt;
    for (size_t i = 0; i < a.integers.size(); ++i)
      result.integers.push_back(function->second(a.integers[i], b.integers[i]));
  } else {
    const auto function = RealFunctions().find(f);
    if (function == RealFunctions().end()) return std::nullopt;
    for (size_t i = 0; i < a.numbers.size(); ++i)
      result.numbers.push_back(function->second(a.numbers[i], b.numbers[i]));
  }
  return result;
}

GraphTensor FoldedReduction(const std::string& f, const GraphTensor& from) {
  if (from.has_integers) return {.integers = {ReducedNumbers(f, from.integers)}, .has_integers = true};
  return {.numbers = {ReducedNumbers(f, from.numbers)}};
}

std::optional<GraphTensor> FoldedRange(const GraphTensor& first, const GraphTensor& end, const GraphTensor& step,
                                       int64_t most) {
  const auto number = [](const GraphTensor& tensor) {
    DAUMIER_CHECK(tensor.integers.size() + tensor.numbers.size() == 1, "an end of its range has {} numbers",
                  tensor.integers.size() + tensor.numbers.size());
    return tensor.has_integers ? double(tensor.integers[0]) : double(tensor.numbers[0]);
  };
  const double from = number(first), to = number(end), by = number(step);
  DAUMIER_CHECK(by != 0, "it goes from {} to {} by 0", from, to);
  const double count = std::max(std::ceil((to - from) / by), 0.0);
  if (count > double(most)) return std::nullopt;
  GraphTensor range{.shape = {int64_t(count)}, .has_integers = first.has_integers};
  for (int64_t i = 0; i < range.shape[0]; ++i) {
    if (range.has_integers) {
      range.integers.push_back(IntegerFromReal(from + double(i) * by));
    } else {
      range.numbers.push_back(float(from + double(i) * by));
    }
  }
  return range;
}

std::vector<int64_t> IndicesOf(const std::vector<int64_t>& indices, int64_t size) {
  std::vector<int64_t> counted;
  for (const int64_t index : indices) {
    DAUMIER_CHECK(index >= -size && index < size, "there is no index {} of {}", index, size);
    counted.push_back(index < 0 ? index + size : index);
  }
  return counted;
}

}  // namespace daumier::runtime
