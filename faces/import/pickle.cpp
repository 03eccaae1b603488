#include "faces/import/pickle.h"

#include "core/error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <unordered_map>
#include <utility>

namespace daumier::faces {
namespace {

/// Operations of Python's pickletools, by their bytes.
enum class Operation : uint8_t {
  kMark = '(',
  kStop = '.',
  kPop = '0',
  kPopMark = '1',
  kDup = '2',
  kBinFloat = 'G',
  kBinInt = 'J',
  kBinInt1 = 'K',
  kBinInt2 = 'M',
  kNone = 'N',
  kBinPersId = 'Q',
  kReduce = 'R',
  kBinString = 'T',
  kShortBinString = 'U',
  kBinUnicode = 'X',
  kBinBytes = 'B',
  kShortBinBytes = 'C',
  kAppend = 'a',
  kBuild = 'b',
  kGlobal = 'c',
  kAppends = 'e',
  kBinGet = 'h',
  kLongBinGet = 'j',
  kBinPut = 'q',
  kLongBinPut = 'r',
  kSetItem = 's',
  kTuple = 't',
  kSetItems = 'u',
  kEmptyTuple = ')',
  kEmptyList = ']',
  kEmptyDict = '}',
  kProto = 0x80,
  kNewObj = 0x81,
  kTuple1 = 0x85,
  kTuple2 = 0x86,
  kTuple3 = 0x87,
  kNewTrue = 0x88,
  kNewFalse = 0x89,
  kLong1 = 0x8a,
  kShortBinUnicode = 0x8c,
  kBinUnicode8 = 0x8d,
  kBinBytes8 = 0x8e,
  kStackGlobal = 0x93,
  kMemoize = 0x94,
  kFrame = 0x95,
};

/// Text of a file for a message: what is not printable ASCII as '?', not too long.
std::string Shown(std::string_view text) {
  constexpr size_t kMost = 80;
  std::string shown(text.substr(0, kMost));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return text.size() > kMost ? shown + "..." : shown;
}

class PickleReader {
 public:
  PickleReader(std::string_view bytes, const std::string& name, const std::set<std::string>& allowed)
      : bytes_(bytes), name_(name), allowed_(allowed) {}

  Pickle Read() && {
    if (Number<uint8_t>() != uint8_t(Operation::kProto)) Fail("is no pickle of protocol 2 or above");
    const int protocol = Number<uint8_t>();
    DAUMIER_CHECK(protocol >= 2 && protocol <= 5, "{}: a pickle of protocol {}, expected 2 to 5", name_, protocol);
    for (uint8_t byte = Number<uint8_t>(); Operation(byte) != Operation::kStop; byte = Number<uint8_t>()) Do(byte);
    pickle_.root = Pop();
    pickle_.num_bytes = place_;
    return std::move(pickle_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw Error(fmt::format("{}: byte {} of the pickle {}", name_, place_, what));
  }

  std::string_view Take(uint64_t count) {
    if (count > bytes_.size() - place_) Fail("is beyond its end: the file is truncated or damaged");
    const std::string_view taken = bytes_.substr(place_, count);
    place_ += count;
    return taken;
  }
  /// Little-endian, as this machine.
  template <class T>
  T Number() {
    static_assert(std::endian::native == std::endian::little);
    T number;
    std::memcpy(&number, Take(sizeof(T)).data(), sizeof(T));
    return number;
  }
  std::string_view Line() {
    const size_t end = bytes_.find('\n', place_);
    if (end == std::string_view::npos) Fail("begins a line without an end: the file is truncated or damaged");
    const std::string_view line = Take(end - place_);
    Take(1);
    return line;
  }

  int Make(Pickle::Value value) {
    if (pickle_.values.size() >= kMostPickleValues)
      Fail(fmt::format("makes more than {} values, more than tensors need", kMostPickleValues));
    pickle_.values.push_back(std::move(value));
    return int(pickle_.values.size()) - 1;
  }
  void Push(Pickle::Value value) { stack_.push_back(Make(std::move(value))); }
  /// Values that lie above the last mark are in the stack's part that belongs to it.
  size_t Floor() const { return marks_.empty() ? 0 : marks_.back(); }
  int Pop() {
    if (stack_.size() <= Floor()) Fail("takes a value that is not there");
    const int place = stack_.back();
    stack_.pop_back();
    return place;
  }
  int Top() const {
    if (stack_.size() <= Floor()) Fail("takes a value that is not there");
    return stack_.back();
  }
  std::vector<int> PopToMark() {
    if (marks_.empty()) Fail("takes a mark that is not there");
    std::vector<int> items(stack_.begin() + ptrdiff_t(marks_.back()), stack_.end());
    stack_.resize(marks_.back());
    marks_.pop_back();
    return items;
  }
  void PushTuple(int count) {
    std::vector<int> items(static_cast<size_t>(count));
    for (int i = count - 1; i >= 0; --i) items[size_t(i)] = Pop();
    Push({.kind = Pickle::Kind::kTuple, .items = std::move(items)});
  }
  void PushText(Pickle::Kind kind, std::string_view text) { Push({.kind = kind, .text = std::string(text)}); }
  void PushInteger(int64_t integer) { Push({.kind = Pickle::Kind::kInteger, .integer = integer}); }
  void PushName(std::string_view module, std::string_view name) {
    const std::string full = std::string(module) + "." + std::string(name);
    if (!allowed_.contains(full)) {
      throw Error(fmt::format(
          "{}: the pickle names '{}', which only Python can make, by running code; expected a dictionary of tensors",
          name_, Shown(full)));
    }
    PushText(Pickle::Kind::kName, full);
  }

  void AddItems(Pickle::Kind kind, const std::vector<int>& items) {
    Pickle::Value& container = pickle_.values[size_t(Top())];
    if (container.kind != kind)
      Fail(kind == Pickle::Kind::kList ? "adds to what is no list" : "sets items of no dictionary");
    if (kind == Pickle::Kind::kDictionary && items.size() % 2 != 0) Fail("sets a key without a value");
    container.items.insert(container.items.end(), items.begin(), items.end());
  }

  void Call() {
    const int arguments = Pop(), function = Pop();
    if (pickle_[function].kind != Pickle::Kind::kName || pickle_[arguments].kind != Pickle::Kind::kTuple)
      Fail("calls no function");
    const std::string text = pickle_[function].text;
    if (text == "collections.OrderedDict" && pickle_[arguments].items.empty())
      return Push({.kind = Pickle::Kind::kDictionary});
    Push({.kind = Pickle::Kind::kCall, .text = text, .items = {arguments}});
  }

  void Store(uint32_t key) { memo_[key] = Top(); }
  void Fetch(uint32_t key) {
    const auto found = memo_.find(key);
    if (found == memo_.end()) Fail(fmt::format("takes the value {} of its memory, which is not there", key));
    stack_.push_back(found->second);
  }

  /// Two's complement, of any length; those beyond 64 bits are no sizes.
  void PushLong() {
    const std::string_view digits = Take(Number<uint8_t>());
    if (digits.size() > sizeof(int64_t)) return PushText(Pickle::Kind::kBytes, digits);
    uint64_t number = !digits.empty() && static_cast<uint8_t>(digits.back()) >= 128 ? ~uint64_t{0} : 0;
    std::memcpy(&number, digits.data(), digits.size());
    PushInteger(static_cast<int64_t>(number));
  }

  void PushFloat() {
    uint64_t bits = 0;
    for (const char byte : Take(sizeof(double))) bits = bits << 8 | static_cast<uint8_t>(byte);
    Push({.kind = Pickle::Kind::kFloat, .number = std::bit_cast<double>(bits)});
  }

  void Do(uint8_t byte) {
    using enum Operation;
    switch (Operation(byte)) {
      case kFrame:
        Take(sizeof(uint64_t));
        return;
      case kMark:
        marks_.push_back(stack_.size());
        return;
      case kPop:
        Pop();
        return;
      case kPopMark:
        PopToMark();
        return;
      case kDup:
        stack_.push_back(Top());
        return;
      case kNone:
        return Push({});
      case kNewTrue:
        return Push({.kind = Pickle::Kind::kBool, .integer = 1});
      case kNewFalse:
        return Push({.kind = Pickle::Kind::kBool});
      case kBinInt:
        return PushInteger(Number<int32_t>());
      case kBinInt1:
        return PushInteger(Number<uint8_t>());
      case kBinInt2:
        return PushInteger(Number<uint16_t>());
      case kLong1:
        return PushLong();
      case kBinFloat:
        return PushFloat();
      case kShortBinUnicode:
        return PushText(Pickle::Kind::kText, Take(Number<uint8_t>()));
      case kBinUnicode:
        return PushText(Pickle::Kind::kText, Take(Number<uint32_t>()));
      case kBinUnicode8:
        return PushText(Pickle::Kind::kText, Take(Number<uint64_t>()));
      case kShortBinString:  // Text of Python 2.
        return PushText(Pickle::Kind::kText, Take(Number<uint8_t>()));
      case kBinString:
        return PushText(Pickle::Kind::kText, Take(Number<uint32_t>()));
      case kShortBinBytes:
        return PushText(Pickle::Kind::kBytes, Take(Number<uint8_t>()));
      case kBinBytes:
        return PushText(Pickle::Kind::kBytes, Take(Number<uint32_t>()));
      case kBinBytes8:
        return PushText(Pickle::Kind::kBytes, Take(Number<uint64_t>()));
      case kEmptyTuple:
        return PushTuple(0);
      case kTuple1:
        return PushTuple(1);
      case kTuple2:
        return PushTuple(2);
      case kTuple3:
        return PushTuple(3);
      case kTuple: {
        std::vector<int> items = PopToMark();
        return Push({.kind = Pickle::Kind::kTuple, .items = std::move(items)});
      }
      case kEmptyList:
        return Push({.kind = Pickle::Kind::kList});
      case kEmptyDict:
        return Push({.kind = Pickle::Kind::kDictionary});
      case kAppend: {
        const int item = Pop();
        return AddItems(Pickle::Kind::kList, {item});
      }
      case kAppends: {
        const std::vector<int> items = PopToMark();
        return AddItems(Pickle::Kind::kList, items);
      }
      case kSetItem: {
        const int value = Pop(), key = Pop();
        return AddItems(Pickle::Kind::kDictionary, {key, value});
      }
      case kSetItems: {
        const std::vector<int> items = PopToMark();
        return AddItems(Pickle::Kind::kDictionary, items);
      }
      case kGlobal: {
        const std::string_view module = Line();
        return PushName(module, Line());
      }
      case kStackGlobal: {
        const int name = Pop(), module = Pop();
        if (pickle_[name].kind != Pickle::Kind::kText || pickle_[module].kind != Pickle::Kind::kText)
          Fail("names a class by no text");
        return PushName(std::string(pickle_[module].text), std::string(pickle_[name].text));
      }
      case kReduce:
      case kNewObj:
        return Call();
      case kBuild:
        Pop(), Top();
        return;
      case kBinPersId: {
        const int object = Pop();
        return Push({.kind = Pickle::Kind::kReference, .items = {object}});
      }
      case kBinPut:
        return Store(Number<uint8_t>());
      case kLongBinPut:
        return Store(Number<uint32_t>());
      case kMemoize:
        return Store(uint32_t(memo_.size()));
      case kBinGet:
        return Fetch(Number<uint8_t>());
      case kLongBinGet:
        return Fetch(Number<uint32_t>());
      default:
        break;
    }
    Fail(fmt::format("is the operation 0x{:02x}, which tensors do not need", byte));
  }

  const std::string_view bytes_;
  const std::string& name_;
  const std::set<std::string>& allowed_;
  size_t place_ = 0;
  Pickle pickle_;
  std::vector<int> stack_;
  std::vector<size_t> marks_;
  std::unordered_map<uint32_t, int> memo_;
};

}  // namespace

Pickle ReadPickle(std::string_view bytes, const std::string& name, const std::set<std::string>& allowed) {
  return PickleReader(bytes, name, allowed).Read();
}

}  // namespace daumier::faces
