#include "studio/shape_document.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::studio {
namespace {

using testing::ExpectError;

ShapeDocument ShapeOf(const char* text) {
  return ShapeFromJson(Json::parse(text));
}

void ExpectNoShape(const char* text, const std::string& why) {
  ExpectError([&] { ShapeOf(text); }, why);
  EXPECT_THROW(ShapeOf(text), UsageError) << text;
}

TEST(ShapeDocument, OfAnEmptyObjectIsTheMeanFace) {
  EXPECT_EQ(ShapeOf("{}"), ShapeDocument());
  EXPECT_EQ(ShapeDocument().base, "mean");
}

TEST(ShapeDocument, HasWhatItsJsonHas) {
  const ShapeDocument shape = ShapeOf(R"({"base": "f-0001", "toward": {"face": "s-0002", "share": 0.25},
      "controls": {"nose_width_left": -3, "brow_height": 3}, "exaggeration": 0.4, "caricature": 2,
      "handles": [{"vertex": 7, "move": [-10, 0.5, 10]}, {"vertex": 0, "move": [0, 0, 0]}],
      "expressions": {"jawOpen": -1, "mouthPucker": 2}, "gains": {"jawOpen": 3, "cheekPuff": 0}})");
  EXPECT_EQ(shape.base, "f-0001");
  EXPECT_EQ(shape.toward, (ShapeDocument::Toward{"s-0002", 0.25}));
  EXPECT_EQ(shape.controls, (std::map<std::string, double>{{"nose_width_left", -3}, {"brow_height", 3}}));
  EXPECT_EQ(shape.exaggeration, 0.4);
  EXPECT_EQ(shape.caricature, 2);
  ASSERT_EQ(shape.handles.size(), 2u);
  EXPECT_EQ(shape.handles[0], (ShapeHandle{7, {-10, 0.5, 10}}));
  EXPECT_EQ(shape.expressions, (std::map<std::string, double>{{"jawOpen", -1}, {"mouthPucker", 2}}));
  EXPECT_EQ(shape.gains, (std::map<std::string, double>{{"jawOpen", 3}, {"cheekPuff", 0}}));
}

TEST(ShapeDocument, WhatIsNullIsAbsent) {
  Json json = ShapeSchema()["properties"];
  for (Json& value : json) value = nullptr;
  EXPECT_EQ(json.size(), 8u);
  EXPECT_EQ(ShapeFromJson(json), ShapeDocument());
}

TEST(ShapeDocument, NeutralLacksTheExpressionAlone) {
  ShapeDocument shape =
      ShapeOf(R"({"base": "f-0001", "caricature": 1, "expressions": {"jawOpen": 1}, "gains": {"jawOpen": 2}})");
  EXPECT_FALSE(shape.Neutral() == shape);
  EXPECT_EQ(shape.Neutral(), ShapeOf(R"({"base": "f-0001", "caricature": 1})"));
  shape.expressions.clear(), shape.gains.clear();
  EXPECT_EQ(shape.Neutral(), shape);
}

TEST(ShapeDocument, AnUnknownKeySuggestsTheNearest) {
  ExpectNoShape(R"({"basee": "mean"})", "a shape has no 'basee'; did you mean 'base'?");
  ExpectNoShape(R"({"control": {}})", "did you mean 'controls'?");
  ExpectNoShape(R"({"Expressions": {}})", "did you mean 'expressions'?");
  ExpectNoShape(R"({"qwertyuiop": 1})", "a shape has no 'qwertyuiop'");
  ExpectNoShape(R"({"basee": null})", "a shape has no 'basee'");
}

TEST(ShapeDocument, NamesTheKeyOfAWrongType) {
  for (const char* text : {"[]", "3", "null", "\"mean\""}) ExpectNoShape(text, "a shape is an object");
  ExpectNoShape(R"({"base": 3})", "'base' is 3, expected a name");
  ExpectNoShape(R"({"toward": "f-0001"})", "'toward' is {");
  ExpectNoShape(R"({"toward": {"face": "f-0001"}})", "'toward' is {");
  ExpectNoShape(R"({"toward": {"face": 3, "share": 0}})", "'face' is 3");
  ExpectNoShape(R"({"toward": {"face": "f-0001", "share": "half"}})", "'share' is \"half\"");
  ExpectNoShape(R"({"controls": [1]})", "'controls' is no object of numbers");
  ExpectNoShape(R"({"controls": {"nose_width": "wide"}})", "'nose_width' is \"wide\"");
  ExpectNoShape(R"({"expressions": {"jawOpen": true}})", "'jawOpen' is true");
  ExpectNoShape(R"({"gains": 1})", "'gains' is no object");
  ExpectNoShape(R"({"caricature": null, "exaggeration": {}})", "'exaggeration' is {}");
  ExpectNoShape(R"({"handles": {}})", "'handles' is no list");
  for (const char* handle : {"3", "{}", R"({"vertex": 3})", R"({"vertex": 1.5, "move": [0, 0, 0]})",
                             R"({"vertex": "3", "move": [0, 0, 0]})", R"({"vertex": 3, "move": [0, 0]})",
                             R"({"vertex": 3, "move": {"x": 0, "y": 0, "z": 0}})", R"({"move": [0, 0, 0]})"})
    ExpectNoShape((std::string(R"({"handles": [)") + handle + "]}").c_str(), "'handles' is a list of");
  ExpectNoShape(R"({"handles": [{"vertex": 3, "move": [0, 0, "far"]}]})", "'move' is \"far\"");
}

TEST(ShapeDocument, NamesTheKeyThatIsOutOfRange) {
  ExpectNoShape(R"({"toward": {"face": "f-0001", "share": 1.01}})", "'share' is 1.01, expected a number from 0 to 1");
  ExpectNoShape(R"({"toward": {"face": "f-0001", "share": -0.01}})", "'share' is -0.01");
  ExpectNoShape(R"({"controls": {"nose_width": 3.1}})", "'nose_width' is 3.1, expected a number from -3 to 3");
  ExpectNoShape(R"({"exaggeration": 0.41})", "'exaggeration' is 0.41, expected a number from 0 to 0.4");
  ExpectNoShape(R"({"caricature": -1})", "'caricature' is -1");
  ExpectNoShape(R"({"caricature": 2.5})", "expected a number from 0 to 2");
  ExpectNoShape(R"({"expressions": {"jawOpen": 2.1}})", "'jawOpen' is 2.1, expected a number from -1 to 2");
  ExpectNoShape(R"({"expressions": {"jawOpen": -1.1}})", "'jawOpen' is -1.1");
  ExpectNoShape(R"({"gains": {"jawOpen": 3.1}})", "'jawOpen' is 3.1, expected a number from 0 to 3");
  ExpectNoShape(R"({"gains": {"jawOpen": -0.1}})", "'jawOpen' is -0.1");
  ExpectNoShape(R"({"handles": [{"vertex": 3, "move": [0, 10.5, 0]}]})",
                "'move' is 10.5, expected a number from -10 to 10");
  ExpectError([] { ShapeFromJson({{"caricature", std::nan("")}}); }, "'caricature' is");
  ExpectError([] { ShapeFromJson({{"caricature", HUGE_VAL}}); }, "'caricature' is");
}

TEST(ShapeDocument, AVertexBeyondAnyIntegerOfOursIsRefused) {
  ExpectNoShape(R"({"handles": [{"vertex": 4294967301, "move": [0, 0, 1]}]})", "");
  ExpectNoShape(R"({"handles": [{"vertex": -4294967291, "move": [0, 0, 1]}]})", "");
}

TEST(ShapeDocument, ItsSchemaHasItsRanges) {
  const Json properties = ShapeSchema()["properties"];
  EXPECT_EQ(properties["caricature"]["maximum"], kMostCaricature);
  EXPECT_EQ(properties["exaggeration"]["maximum"], kMostExaggeration);
  EXPECT_EQ(properties["expressions"]["additionalProperties"]["minimum"], kLeastExpression);
  EXPECT_EQ(properties["gains"]["additionalProperties"]["maximum"], kMostGain);
  EXPECT_EQ(properties["toward"]["properties"]["share"]["maximum"], 1);
}

}  // namespace
}  // namespace daumier::studio
