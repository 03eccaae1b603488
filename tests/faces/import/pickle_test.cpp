#include "faces/import/pickle.h"

#include "core/error.h"
#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::ExpectError;

const std::set<std::string> kPickleNames = {"torch.FloatStorage"};

/// A pickle of protocol 2 of these operations.
Pickle ReadOperations(const std::string& operations) {
  return ReadPickle("\x80\x02" + operations + ".", "a.pkl", kPickleNames);
}

Pickle::Value RootOfOperations(const std::string& operations) {
  const Pickle pickle = ReadOperations(operations);
  return pickle[pickle.root];
}

TEST(ReadPickle, NumbersAreReadInEveryWidth) {
  EXPECT_EQ(RootOfOperations("K\xff").integer, 255);
  EXPECT_EQ(RootOfOperations("M\x01\x02").integer, 0x201);
  EXPECT_EQ(RootOfOperations("J\xfe\xff\xff\xff").integer, -2);
  EXPECT_EQ(RootOfOperations(std::string("\x8a\x00", 2)).integer, 0);
  EXPECT_EQ(RootOfOperations("\x8a\x01\xff").integer, -1);
  EXPECT_EQ(RootOfOperations(std::string("\x8a\x02\xff\x00", 4)).integer, 255);
  EXPECT_EQ(RootOfOperations("\x8a\x09" + std::string(9, '\x01')).kind, Pickle::Kind::kBytes);
  EXPECT_EQ(RootOfOperations("G" + std::string("\x3f\xd0\0\0\0\0\0\0", 8)).number, 0.25);
  EXPECT_EQ(RootOfOperations("\x88").integer, 1);
  EXPECT_EQ(RootOfOperations("\x89").kind, Pickle::Kind::kBool);
  EXPECT_EQ(RootOfOperations("N").kind, Pickle::Kind::kNone);
}

TEST(ReadPickle, ContainersHoldTheirItems) {
  const Pickle pickle =
      ReadOperations("}(X\x01" + std::string(3, '\0') + "aK\x01X\x01" + std::string(3, '\0') + "b](K\x02K\x03" + "eu");
  const Pickle::Value& root = pickle[pickle.root];
  ASSERT_EQ(root.kind, Pickle::Kind::kDictionary);
  ASSERT_EQ(root.items.size(), 4u);
  EXPECT_EQ(pickle[root.items[2]].text, "b");
  const Pickle::Value& list = pickle[root.items[3]];
  ASSERT_EQ(list.items.size(), 2u);
  EXPECT_EQ(pickle[list.items[1]].integer, 3);
  EXPECT_EQ(RootOfOperations("K\x01K\x02K\x03\x87").items.size(), 3u);
  EXPECT_EQ(RootOfOperations("]K\x01"
                             "a")
                .items.size(),
            1u);
  EXPECT_EQ(RootOfOperations(")").kind, Pickle::Kind::kTuple);
}

TEST(ReadPickle, StoredValuesAreTheSameValueWhereTheyAreTaken) {
  const Pickle pickle = ReadOperations("K\x07q\x05h\x05\x86");
  const std::vector<int>& items = pickle[pickle.root].items;
  EXPECT_EQ(items[0], items[1]);
  const Pickle circle = ReadOperations(
      "]q\x01h\x01"
      "a");  // A list that holds itself.
  EXPECT_EQ(circle[circle.root].items, std::vector<int>{circle.root});
}

TEST(ReadPickle, EndsWhereThePickleEnds) {
  const std::string bytes = "\x80\x02K\x01.rest";
  EXPECT_EQ(ReadPickle(bytes, "a.pkl", kPickleNames).num_bytes, 5u);
}

TEST(ReadPickle, RefusesEveryOtherNameAndSaysWhich) {
  EXPECT_EQ(RootOfOperations("ctorch\nFloatStorage\n").text, "torch.FloatStorage");
  ExpectError([] { ReadOperations("cos\nsystem\nX\x02" + std::string(3, '\0') + "ls\x85R"); },
              "the pickle names 'os.system'");
  ExpectError(
      [] {
        ReadOperations(
            "\x8c\x08"
            "builtins\x8c\x04"
            "eval\x93");
      },
      "the pickle names 'builtins.eval'");
  ExpectError([] { ReadOperations("c\x1b[2J\nx\n"); }, "the pickle names '?[2J.x'");
  ExpectError([] { ReadOperations("(iposix\nsystem\n"); }, "the operation 0x69");  // INST of protocol 0.
}

TEST(ReadPickle, RefusesMalformedOnes) {
  ExpectError([] { ReadPickle("", "a.pkl", kPickleNames); }, "a.pkl: byte 0");
  ExpectError([] { ReadPickle("K\x01.", "a.pkl", kPickleNames); }, "is no pickle");
  ExpectError([] { ReadPickle("\x80\x09K\x01.", "a.pkl", kPickleNames); }, "protocol 9");
  ExpectError([] { ReadOperations(""); }, "takes a value that is not there");
  ExpectError([] { ReadOperations("K\x01(0"); }, "takes a value that is not there");
  ExpectError([] { ReadOperations("t"); }, "takes a mark that is not there");
  ExpectError([] { ReadOperations("h\x05"); }, "takes the value 5 of its memory");
  ExpectError(
      [] {
        ReadOperations(
            "K\x01K\x02"
            "a");
      },
      "adds to what is no list");
  ExpectError([] { ReadOperations("}(K\x01u"); }, "a key without a value");
  ExpectError([] { ReadOperations("K\x01)R"); }, "calls no function");
  ExpectError([] { ReadOperations("X\xff\xff\xff\x7f"); }, "truncated");
  ExpectError([] { ReadOperations("ctorch"); }, "a line without an end");
}

TEST(ReadPickle, MemoryIsBounded) {
  ExpectError([] { ReadOperations(std::string(kMostPickleValues + 1, 'N')); }, "more than 1048576 values");
  // A long tuple that is an argument again and again is not copied.
  std::string many = "(" + std::string(1000, 'N') + "tq\x01";
  for (int i = 0; i < 1000; ++i) many += "ctorch\nFloatStorage\nh\x01R";
  EXPECT_EQ(ReadOperations(many)[0].kind, Pickle::Kind::kNone);
}

TEST(ReadPickle, RandomBytesGiveAnErrorOrAValue) {
  Rng rng(4);
  int num_refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string bytes = "\x80\x02";
    for (uint64_t k = 0; k < rng.Below(40); ++k) bytes += static_cast<char>(rng.Below(256));
    try {
      ReadPickle(bytes, "a.pkl", kPickleNames);
    } catch (const Error&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 4000);
}

}  // namespace
}  // namespace daumier::faces
