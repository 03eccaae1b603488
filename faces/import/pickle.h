#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::faces {

/// What a Python pickle holds, as data: nothing of it is executed. A call in the pickle is a value that names
/// the function and holds its arguments.
struct Pickle {
  enum class Kind {
    kNone,
    kBool,
    kInteger,
    kFloat,
    kText,
    kBytes,
    kTuple,
    kList,
    kDictionary,
    kName,
    kCall,
    kReference
  };

  struct Value {
    Kind kind = Kind::kNone;
    int64_t integer = 0;    ///< Of an integer, or 0 and 1.
    double number = 0;      ///< Of a float.
    std::string text = {};  ///< Of text or bytes; of a name "module.name"; of a call that of its function.
    /// Places in `values`: items, the tuple of a call's arguments, the object that a reference (persistent id) names; of a dictionary key and
    /// value in turn.
    std::vector<int> items = {};
  };

  std::vector<Value> values;  ///< Values may share others, also in a circle.
  int root = 0;
  size_t num_bytes = 0;  ///< Up to the end of the pickle, from the beginning of `bytes`.

  const Value& operator[](int place) const { return values[size_t(place)]; }
};

/// Reads a pickle of protocols 2 to 5 that names no functions or classes but those of `allowed` ("module.name").
/// `name` names it in messages. The memory is bounded by the number of bytes, and by kMostPickleValues.
/// collections.OrderedDict() is an empty dictionary; the state that BUILD gives to an object is dropped.
/// @throws Error naming `name` and the byte: another function or class (with its name), an operation that plain data
/// do not need, a truncated or malformed pickle.
Pickle ReadPickle(std::string_view bytes, const std::string& name, const std::set<std::string>& allowed);

/// Most values of a pickle: a state of a network has a few dozen a tensor.
inline constexpr size_t kMostPickleValues = size_t{1} << 20;

}  // namespace daumier::faces
