#include "core/toml_bounds.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

/// "a.a. ... .a" with that many dots.
std::string Dotted(int num_dots) {
  std::string key = "a";
  for (int i = 0; i < num_dots; ++i) key += ".a";
  return key;
}

std::string Nested(int depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

TEST(TomlBounds, KeysAndNamesOfTables) {
  EXPECT_EQ(TooDeepInToml(Dotted(100) + " = 1\n[" + Dotted(100) + "]\n"), "");
  EXPECT_EQ(TooDeepInToml("b = 1\n" + Dotted(101) + " = 1"), "line 2: a key has more than 100 dots");
  EXPECT_EQ(TooDeepInToml("[" + Dotted(200) + "]"), "line 1: a key has more than 100 dots");
  EXPECT_EQ(TooDeepInToml("[[" + Dotted(200) + "]]"), "line 1: a key has more than 100 dots");
  EXPECT_EQ(TooDeepInToml("b = {c = 1, " + Dotted(200) + " = 1}"), "line 1: a key has more than 100 dots");
  std::string quoted = "\"x\"";
  for (int i = 0; i < 200; ++i) quoted += " . 'x'";
  EXPECT_EQ(TooDeepInToml(quoted), "line 1: a key has more than 100 dots");
}

TEST(TomlBounds, Values) {
  EXPECT_EQ(TooDeepInToml("a = " + Nested(32)), "");
  EXPECT_EQ(TooDeepInToml("a = " + Nested(33)), "line 1: values are nested more than 32 deep");
  std::string many = "a = [";
  for (int i = 0; i < 300; ++i) many += "[0.5],\n";
  EXPECT_EQ(TooDeepInToml(many + "]"), "") << "next to each other";
}

TEST(TomlBounds, TextsAndCommentsMayHoldAnyNumber) {
  const std::string dots(300, '.');
  EXPECT_EQ(TooDeepInToml("a = \"" + dots + "\" # " + dots + Nested(40)), "");
  EXPECT_EQ(TooDeepInToml("a = '" + dots + "\\'\n"), "") << "no escapes in literal text";
  EXPECT_EQ(TooDeepInToml("a = \"\\\"" + dots + "\""), "") << "an escaped quote";
  EXPECT_EQ(TooDeepInToml("a = \"\"\"\n\"\"" + dots + "\n" + dots + "\"\"\"\n"), "") << "of several lines";
}

TEST(TomlBounds, WhatFollowsATextCounts) {
  for (const std::string text :
       {"\"\"", "''", "\"\"\"b\"\"\"", "\"\"\"\"b\"\"\"\"", "'''b'''''", "\"\\\\\"", "\"\"\"\\\\\"\"\""})
    EXPECT_EQ(TooDeepInToml("a = {b = " + text + ", " + Dotted(200) + " = 1}"), "line 1: a key has more than 100 dots")
        << text;
  EXPECT_EQ(TooDeepInToml("a = \"open\n" + Dotted(200)), "line 2: a key has more than 100 dots");
  EXPECT_EQ(TooDeepInToml("a = \"open\\\n" + Dotted(200)), "line 2: a key has more than 100 dots");
}

}  // namespace
}  // namespace daumier
